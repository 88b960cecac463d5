//! A Bingham channel whose force drops below yield stops in finite time (hard case H14).

use std::sync::OnceLock;

use super::start_up::Fluid;
use super::support::{from_middle, largest, no_reference, starting_profile};
use crate::rheology::Law;
use crate::solver::run::Backend;
use crate::solver::setup::{BodyForce, Setup, WallRule, YieldTreatment};
use crate::verify::claim::{
    Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::verify::exact::ExactError;
use crate::verify::exact::flow_curve::FlowCurve;
use crate::verify::exact::poiseuille::Channel;
use crate::verify::exact::viscoplastic_1d::{Flow1d, LowerEnd, Scheme};

/// Force after the step over the force before: wall stress 2σ0 before, σ0/2 after.
const AFTER: f64 = 0.25;

/// Kinetic energy, over that before the step, at which the flow counts as stopped.
pub const STOPPED: f64 = 1e-6;

/// Times of a stop, in h²/ν.
#[derive(Clone, Copy, Debug)]
pub struct Stop {
    /// Every velocity is exactly zero.
    pub rest: f64,
    /// The kinetic energy has fallen to [`STOPPED`].
    pub energy: f64,
}

/// The stop of the ideal fluid, in one dimension; `cells` intervals and steps of `dt`.
fn ideal(cells: usize, dt: f64) -> Result<Stop, ExactError> {
    let flow = Flow1d {
        law: Fluid::Bingham.law(1.0, 1.0),
        density: 1.0,
        length: 1.0,
        cells,
        lower: LowerEnd::Symmetry,
        wall_speed: 0.0,
        scheme: Scheme::Sdirk2,
    };
    let from = flow.steady_half_channel(1.0)?;
    let rest = flow.stopping_time(&from, AFTER, dt, 1.0)?;
    let threshold = STOPPED * from.kinetic_energy_over_density();
    let mut now = from;
    loop {
        let next = flow.step(&now, dt, &|_| AFTER)?;
        let (a, b) = (now.kinetic_energy_over_density(), next.kinetic_energy_over_density());
        if b <= threshold {
            // Linear in the speed, which falls almost linearly.
            let part = (a.sqrt() - threshold.sqrt()) / (a.sqrt() - b.sqrt());
            return Ok(Stop { rest, energy: now.time + part * dt });
        }
        now = next;
    }
}

/// The reference, computed once per process.
fn reference() -> Result<Stop, VerifyError> {
    static STORE: OnceLock<Result<Stop, ExactError>> = OnceLock::new();
    STORE.get_or_init(|| ideal(512, 2e-4)).clone().map_err(no_reference)
}

/// A stop in lattice units.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    pub cells: usize,
    pub tau: f64,
    pub wall: WallRule,
    pub yielding: YieldTreatment,
}

/// Re = U h/ν with U = Gh²/μ.
const REYNOLDS: f64 = 0.1;

/// What is seen of a stop.
#[derive(Clone, Debug)]
pub struct Seen {
    /// Kinetic energy over that before the step, at every step after it.
    pub energy: Vec<f64>,
    /// Largest speed at the end, over the plug speed before the step.
    pub left: f64,
    /// Largest speed at the end over F/ρ.
    pub left_per_force: f64,
    /// Steps per h²/ν.
    pub unit: f64,
}

impl Case {
    /// Steady flow for ½ h²/ν, then the step, then `longest` h²/ν more.
    pub fn run(&self, backend: &dyn Backend, longest: f64) -> Result<Seen, VerifyError> {
        let nu = (self.tau - 0.5) / 3.0;
        let h = 0.5 * self.cells as f64;
        let unit = h * h / nu;
        let force = REYNOLDS * nu / h * nu / (h * h);
        let law: Law = Fluid::Bingham.law(force * h, nu);
        let steady = Channel { law, half_width: h, force };
        let settle = (0.5 * unit) as u64;
        let mut setup = Setup::channel(self.cells, law, force);
        setup.force = BodyForce::Stepped {
            before: [force, 0.0, 0.0],
            after: [AFTER * force, 0.0, 0.0],
            at: settle,
        };
        setup.wall_rule = self.wall;
        setup.yielding = self.yielding;
        let gradient = move |y: f64| -law.rate(force * y.abs()) * y.signum();
        setup.initial = Some(starting_profile(self.cells, move |y| steady.velocity(y), gradient));
        let mut run = backend.start(&setup)?;
        run.advance(settle - 1)?;
        let first = run.totals().kinetic_energy;
        run.advance(1)?;
        let mut energy = Vec::new();
        for _ in 0..(longest * unit) as u64 {
            energy.push(run.totals().kinetic_energy / first);
            run.advance(1)?;
        }
        let speed = largest(run.fields().velocity.iter().map(|u| u[0]));
        debug_assert!(from_middle(0, self.cells) < 0.0);
        Ok(Seen {
            energy,
            left: speed / steady.plug_velocity(),
            left_per_force: speed / (AFTER * force),
            unit,
        })
    }
}

impl Seen {
    /// First time, in h²/ν, from which on the kinetic energy stays below `level`.
    pub fn stays_below(&self, level: f64) -> f64 {
        match self.energy.iter().rposition(|&e| e >= level) {
            None => 0.0,
            Some(last) if last + 1 == self.energy.len() => f64::INFINITY,
            Some(last) => {
                let (a, b) = (self.energy[last].sqrt(), self.energy[last + 1].sqrt());
                (last as f64 + (a - level.sqrt()) / (a - b)) / self.unit
            }
        }
    }
}

/// Exploration.
pub const EXPLORE: Claim = Claim {
    id: "bingham-stop-explore",
    title: "x",
    tags: &["Y3"],
    measures: "x",
    reference: Reference { source: "x", uncertainty: 0.0 },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "tau", short: &[0.55, 0.65, 0.8], full: &[0.55, 0.65, 0.8] },
    order: None::<OrderBand>,
    tolerance: Tolerance { value: 1.0, at: Rung::Last, because: "x" },
    kind: Kind::Verification,
    measure: |backend, tau| {
        let r = reference()?;
        eprintln!("T_stop {} T_energy {}", r.rest, r.energy);
        for (cells, wall) in [
            (16, WallRule::HalfWay),
            (16, WallRule::ViscosityIndependent),
            (32, WallRule::ViscosityIndependent),
            (64, WallRule::ViscosityIndependent),
        ] {
            let case = Case { cells, tau, wall, yielding: YieldTreatment::Exact };
            let seen = case.run(backend, 4.0 * r.rest)?;
            let at = |f: f64| seen.energy[((f * r.rest * seen.unit) as usize).min(seen.energy.len() - 1)];
            eprintln!(
                "tau {tau} N {cells} {wall:?} T(1e-2) {:.4} T(1e-4) {:.4} T(1e-6) {:.4}; E at .9 {:.2e} 1 {:.2e} 1.1 {:.2e} 1.5 {:.2e} 2 {:.2e} 3 {:.2e} end {:.2e}; left {:.3e} per F {:.3e}",
                seen.stays_below(1e-2) / r.rest, seen.stays_below(1e-4) / r.rest, seen.stays_below(1e-6) / r.rest,
                at(0.9), at(1.0), at(1.1), at(1.5), at(2.0), at(3.0), at(3.99), seen.left, seen.left_per_force
            );
        }
        for ratio in [500.0, 1000.0, 2000.0, 4000.0, 8000.0, 16000.0] {
            let tau_max = 0.5 + ratio * (tau - 0.5);
            let case = Case { cells: 32, tau, wall: WallRule::ViscosityIndependent, yielding: YieldTreatment::ImplicitClamped { tau_min: 0.5, tau_max } };
            let seen = case.run(backend, 4.0 * r.rest)?;
            eprintln!("clamped {ratio} T(1e-2) {:.4} T(1e-4) {:.4} T(1e-6) {:.4} left {:.3e} x ratio {:.4}",
                seen.stays_below(1e-2) / r.rest, seen.stays_below(1e-4) / r.rest, seen.stays_below(1e-6) / r.rest, seen.left, seen.left * ratio);
        }
        Ok(Sample::relative(tau, r.rest, r.energy))
    },
};
