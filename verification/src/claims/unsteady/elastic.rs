//! Unyielded cells are an elastic solid of shear modulus ρc_s²: what that does, and what damps it.

use core::f64::consts::PI;

use super::start_up::{self, Fluid, Start};
use super::stopping;
use super::support::{Oscillation, central, column, from_middle, starting_profile};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::exact::shear_wave::standing_wave_frequency;
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::rheology::Law;
use lahar::setup::{Setup, WallRule, YieldTreatment};
use lahar::solver::run::Backend;

/// Wall-held solid, force switched on far below yield: the lowest mode and the first peak of the
/// speed in the middle over F h/(ρ c_s).
fn ring(backend: &dyn Backend, cells: usize, floor: f64) -> Result<(Oscillation, f64), VerifyError> {
    let (force, n) = (1e-6, cells as f64);
    let law = Law::Bingham { sigma0: 10.0 * force * n, mu: 0.1 };
    let mut setup = Setup::channel(cells, law, force);
    setup.wall_rule = WallRule::ViscosityIndependent;
    setup.collision = central(floor);
    let mut run = backend.start(&setup)?;
    let period = 1.0 / standing_wave_frequency(n);
    let mut samples = Vec::new();
    let mut peak = 0.0_f64;
    for _ in 0..(5.0 * period) as usize {
        let fields = run.fields();
        let shape = |j: usize| libm::cos(PI * from_middle(j, cells) / n);
        samples.push((0..cells).map(|j| fields.velocity[j][0] * shape(j)).sum());
        peak = peak.max(fields.velocity[cells / 2][0]);
        run.advance(1)?;
    }
    let lag = (0.125 * period) as usize;
    let wave = Oscillation::fit(&samples, lag).ok_or_else(no_fit)?;
    Ok((wave, peak / (force * 0.5 * n * 3.0_f64.sqrt())))
}

fn ringing(backend: &dyn Backend, n: f64) -> Result<Sample, VerifyError> {
    let (wave, peak) = ring(backend, n as usize, 0.05)?;
    let k = PI / n;
    Ok(Sample::relative(n, wave.frequency / (2.0 * PI), standing_wave_frequency(n))
        .with("decay rate / k2 [lattice units]", wave.decay / (k * k))
        .with("first peak in the middle / (F h / rho c_s) [-]", peak))
}

/// Frequency of an unyielded solid between walls.
pub const RINGING: Claim = Claim {
    id: "unyielded-rings-elastically",
    title: "An unyielded solid between walls rings at c_s/2H when a force is switched on: it is elastic, with modulus rho c_s^2.",
    tags: &["Y3", "K3", "B3"],
    measures: "frequency of the lowest shear mode, relative",
    reference: Reference {
        source: "shear waves of an elastic solid of modulus rho c_s^2 (with the relaxation rate 0, dQ/dt = -rho c_s^2 dev(2S))",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "N (cells across)",
        short: &[16.0, 32.0, 64.0],
        full: &[16.0, 32.0, 64.0, 128.0],
    },
    order: Some(OrderBand { expected: 2.0, band: 0.1, at_least: false }),
    tolerance: Tolerance {
        value: 1e-4,
        at: Rung::Last,
        basis: Basis::Derived,
        because: "lattice dispersion k^2/24 at N = 64, k = pi/N",
    },
    kind: Kind::PredictedFailure,
    measure: ringing,
};

/// A standing shear wave of 32 cells in a periodic box of unyielded material: no wall damps it.
fn free_wave(backend: &dyn Backend, floor: f64) -> Result<Oscillation, VerifyError> {
    let (n, k) = (32, 2.0 * PI / 32.0);
    let mut setup = Setup::periodic([1, n, 1], Law::Bingham { sigma0: 1.0, mu: 0.1 });
    setup.collision = central(floor);
    setup.initial = Some(starting_profile(n, move |y| 1e-5 * libm::sin(k * y), |_| 0.0));
    let mut run = backend.start(&setup)?;
    let period = n as f64 * 3.0_f64.sqrt();
    let mut samples = Vec::new();
    for _ in 0..(5.0 * period) as usize {
        let u = column(run.as_ref());
        samples.push(u.iter().enumerate().map(|(j, u)| u * libm::sin(k * from_middle(j, n))).sum());
        run.advance(1)?;
    }
    Oscillation::fit(&samples, (0.125 * period) as usize).ok_or_else(no_fit)
}

fn no_fit() -> VerifyError {
    VerifyError::Numerics { what: "the fit of the elastic wave", detail: "no damped oscillation".into() }
}

fn damping(backend: &dyn Backend, floor: f64) -> Result<Sample, VerifyError> {
    let wave = free_wave(backend, floor)?;
    let k = 2.0 * PI / 32.0;
    let (held, _) = ring(backend, 32, floor)?;
    Ok(Sample::relative(floor, wave.decay, floor * k * k / 3.0)
        .with("frequency / (c_s k) [-]", wave.frequency * 3.0_f64.sqrt() / k)
        .with(
            "between [B3] walls 32 cells apart, decay / (theta k2/3) [-]",
            held.decay / (floor * PI * PI / 3072.0),
        ))
}

/// Damping of the elastic waves.
pub const DAMPING: Claim = Claim {
    id: "unyielded-damping",
    title: "Elastic waves in an unyielded solid decay at theta k^2/3: the floor theta is all that damps them.",
    tags: &["Y3", "K3", "K6"],
    measures: "decay rate of a standing shear wave of 32 cells in a periodic box, relative",
    reference: Reference {
        source: "third moments that relax with tau- = 1/2 + theta let the stress diffuse at 2 theta/3",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "theta", short: &[0.05, 0.2, 0.5], full: &[0.02, 0.05, 0.1, 0.2, 0.5, 1.0] },
    order: None,
    tolerance: Tolerance {
        value: 2e-2,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "next order in k = pi/16: k^2/2",
    },
    kind: Kind::PredictedFailure,
    measure: damping,
};

/// What the floor θ does to the elastic waves.
pub const AGAINST_FLOOR: Exhibit = Exhibit {
    id: "elastic-waves-against-theta",
    caption: "Elastic waves of unyielded material against the floor theta of the odd relaxation time, with \
              the viscosity-independent wall: their damping, and the errors they leave in a start and a stop.",
    timed: false,
    run: against_floor,
};

fn against_floor(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let floors: &[f64] = if full { &[0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0] } else { &[0.05, 0.2, 0.5, 1.0] };
    let wall = WallRule::ViscosityIndependent;
    let mut table = Table::new(
        "Unyielded material against theta (Bingham, 32 cells, plastic tau 0.8, [B3])",
        &[
            "theta",
            "damping / k2",
            "sudden start, error",
            "smooth start, error",
            "stop: KE(T_stop)/KE(0)",
            "stop: most KE/KE(0) after 1.2 T_stop",
            "stop: KE/KE(0) at 4 T_stop",
        ],
    );
    for &floor in floors {
        let (wave, _) = ring(backend, 32, floor)?;
        let k = PI / 32.0;
        let case = |start| start_up::Case { fluid: Fluid::Bingham, start, wall, cells: 32, tau: 0.8, floor };
        let sudden = case(Start::Sudden).sample(backend, floor)?;
        let smooth = case(Start::Smooth).sample(backend, floor)?;
        let rest = stopping::reference()?.rest;
        let stop = stopping::Case { cells: 32, tau: 0.8, wall, yielding: YieldTreatment::Exact, floor };
        let seen = stop.run(backend, 4.0 * rest)?;
        let at_stop = seen.energy.get((rest * seen.unit) as usize).copied().unwrap_or(f64::NAN);
        table.push(vec![
            floor.into(),
            (wave.decay / (k * k)).into(),
            sudden.error.into(),
            smooth.error.into(),
            at_stop.into(),
            seen.most_after(1.2 * rest).into(),
            seen.energy.last().copied().unwrap_or(f64::NAN).into(),
        ]);
    }
    Ok(ExhibitData { tables: vec![table], ..ExhibitData::default() })
}
