//! Where the density belongs: a fluid of 2000 kg/m³ given in SI, and a uniformly accelerated one.

use super::channel::Column;
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::exact::poiseuille::Channel;
use lahar::collision::CollisionChoice;
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Setup, WallRule, YieldTreatment};
use lahar::solver::run::Backend;
use lahar::units::Units;

/// ρ in kg/m³ of `poiseuille-si-density`.
pub const DENSITY: f64 = 2000.0;

/// The densities with which stress and viscosity go to the lattice: σ0 Δt²/(ρΔx²), μ Δt/(ρΔx²).
#[derive(Clone, Copy)]
pub struct Conversion {
    /// What the yield stress is divided by.
    pub yield_stress_density: f64,
    /// What the viscosity is divided by.
    pub viscosity_density: f64,
}

/// A channel in SI.
pub const SI_DENSITY: Claim = Claim {
    id: "poiseuille-si-density",
    title: "A Bingham fluid of 2000 kg/m³ given in SI flows at its exact speed",
    tags: &["L6", "Y3", "ERRATA 7", "ERRATA 8", "ERRATA 9", "ERRATA 10"],
    measures: "velocity in m/s in the middle of a channel 0.2 m high; σ0 = 50 Pa, μ = 10 Pa s, G = 1000 N/m³, N = 32",
    reference: Reference { source: "u = (G/2μ)(h − σ0/G)² = 0.125 m/s", uncertainty: 0.0 },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "Δt (ms)", short: &[1.0], full: &[0.5, 1.0] },
    order: None,
    tolerance: Tolerance {
        value: 5e-3,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "the closed form of the scheme is off by (32/N²)(1/16 + 2θμ) = 2.4e-3 of the velocity, with the \
                  lattice viscosity μ = 0.128 of Δt = 1 ms; a density forgotten is a factor 2000",
    },
    kind: Kind::Verification,
    measure: |backend, dt| {
        si(backend, dt, Conversion { yield_stress_density: DENSITY, viscosity_density: DENSITY })
    },
};

/// The measurement of `poiseuille-si-density` with a hook for wrong conversions.
pub fn si(backend: &dyn Backend, dt_ms: f64, conversion: Conversion) -> Result<Sample, VerifyError> {
    let (n, height, yield_stress, viscosity, force) = (32, 0.2, 50.0, 10.0, 1000.0);
    let (dx, dt) = (height / n as f64, dt_ms * 1e-3);
    let column = Column {
        n,
        law: Law::Bingham {
            sigma0: Units::new(dx, dt, conversion.yield_stress_density).stress_to_lattice(yield_stress),
            mu: Units::new(dx, dt, conversion.viscosity_density).viscosity_to_lattice(viscosity),
        },
        force: Units::new(dx, dt, DENSITY).force_to_lattice(force),
        collision: CollisionChoice::default(),
        yielding: YieldTreatment::Exact,
        wall: WallRule::ViscosityIndependent,
    };
    // From rest; the slowest mode decays within some 5000 steps at Δt = 1 ms.
    let mut run = backend.start(&column.setup())?;
    run.advance(40_000)?;
    let u = run.fields().velocity[n / 2][0];
    let exact = Channel {
        law: Law::Bingham { sigma0: yield_stress, mu: viscosity },
        half_width: 0.5 * height,
        force,
    };
    Ok(Sample::relative(dt_ms, u * dx / dt, exact.plug_velocity()))
}

/// Nothing shears where everything accelerates alike.
pub const UNIFORM_ACCELERATION: Claim = Claim {
    id: "shear-rate-uniform-acceleration",
    title: "A uniformly accelerated fluid has no shear rate and the velocity of free fall",
    tags: &["L4", "L5", "Y1", "ERRATA 5", "ERRATA 75"],
    measures: "γ̇ |F|/|u| over |F|²: the shear rate per step of fall, plus the relative error of the velocity; BGK, \
               F = (1e-4, −5e-5, 2e-5), 500 steps",
    reference: Reference {
        source: "u = F (t + ½) (the half step is that of [L4] at the start), γ̇ = 0",
        uncertainty: 0.0,
    },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "tau", short: &[0.6, 1.0, 1.8], full: &[0.55, 0.6, 0.8, 1.0, 1.8] },
    order: None,
    tolerance: Tolerance {
        value: 1e-7,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "rounding: 500 additions to populations of size 0.1, 5e-15, against u = 0.06 and γ̇ measured in units of \
                  F = 1e-4; without the force in Q the shear rate is of the order of u F, 6e-2 in these units",
    },
    kind: Kind::Verification,
    measure: |backend, tau| {
        let force = [1e-4, -5e-5, 2e-5];
        let mut setup = Setup::periodic([2, 2, 2], Law::Newtonian { mu: (tau - 0.5) / 3.0 });
        setup.collision = CollisionChoice::Bgk;
        setup.force = BodyForce::Constant(force);
        let mut run = backend.start(&setup)?;
        run.advance(500)?;
        let fields = run.fields();
        let shear = fields.shear_rate.iter().fold(0.0, |a: f64, b| if *b <= a { a } else { *b }) / 1e-4;
        let u: Vec<f64> = fields.velocity.iter().flatten().copied().collect();
        let exact: Vec<f64> = (0..u.len()).map(|k| force[k % 3] * 500.0).collect();
        let velocity = Sample::linf(tau, &u, &exact).error;
        Ok(Sample::absolute(tau, shear + velocity, 0.0)
            .with("γ̇/F", shear)
            .with("error of the velocity", velocity))
    },
};
