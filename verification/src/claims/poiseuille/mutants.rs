//! Wrong variants that the claims of this study must catch.

use super::channel::steady_column;
use super::couette::{Reported, shear_rate};
use super::density::{Conversion, DENSITY, si};
use crate::claim::{Sample, VerifyError};
use crate::claims::mutants_physics::{Mistake, Mistaken};
use crate::mutant::{Mutant, Subject};
use lahar::collision::CollisionChoice;
use lahar::setup::WallRule;
use lahar::solver::run::Backend;

/// All of them.
pub const MUTANTS: &[Mutant] = &[
    Mutant {
        id: "wall-factor-two",
        erratum: "ERRATA 14 (000 Eq 10)",
        description: "Moving walls give 2 w_i ρ c·u_w instead of 6.",
        caught_by: "couette-newtonian",
        rung: Some(0.8),
        subject: Subject::Backend(|| Box::new(Mistaken(Mistake::WallFactor))),
    },
    Mutant {
        id: "wall-at-the-node",
        erratum: "ERRATA 15 (000 Eq 10)",
        description: "The reflected population arrives one cell further, so the wall sits on the first node.",
        caught_by: "poiseuille-newtonian-bgk-slip",
        rung: Some(0.8),
        subject: Subject::Measure(wall_at_the_node),
    },
    Mutant {
        id: "shear-rate-from-f",
        erratum: "ERRATA 1 (000 Eq 13)",
        description: "The shear rate is taken from f, not f − f_eq: a fluid at rest shears.",
        caught_by: "poiseuille-plug-cells",
        rung: Some(0.5),
        subject: Subject::Backend(|| Box::new(Mistaken(Mistake::EquilibriumKept))),
    },
    Mutant {
        id: "shear-rate-halved",
        erratum: "ERRATA 3 (004 Eq 3.3 with 3.27)",
        description: "√(½ S:S) of the strain rate S: the yield stress doubles and the thesis' channel stands still.",
        caught_by: "poiseuille-from-rest",
        rung: Some(1.0),
        subject: Subject::Backend(|| Box::new(Mistaken(Mistake::ShearRateHalved))),
    },
    Mutant {
        id: "shear-rate-halved-reported",
        erratum: "ERRATA 3 (004 Eq 3.3 with 3.27)",
        description: "The same in the shear rate that is reported.",
        caught_by: "shear-rate-couette",
        rung: Some(0.8),
        subject: Subject::Measure(|b, tau| shear_rate(b, tau, |r| Reported { rate: 0.5 * r.rate, ..r })),
    },
    Mutant {
        id: "stress-sign",
        erratum: "ERRATA 2 (001 Eq 9, 004 Eq 3.27)",
        description: "+1/(2τc_s²) instead of −: the stress has the wrong sign.",
        caught_by: "shear-rate-couette",
        rung: Some(0.8),
        subject: Subject::Measure(|b, tau| shear_rate(b, tau, |r| Reported { stress: -r.stress, ..r })),
    },
    Mutant {
        id: "shear-rate-without-density",
        erratum: "ERRATA 2 (001 Eq 9, 004 Eq 3.27)",
        description: "The factor 1/ρ of the shear rate is missing.",
        caught_by: "shear-rate-couette",
        rung: Some(0.8),
        subject: Subject::Measure(|b, tau| {
            shear_rate(b, tau, |r| Reported { rate: r.rate * r.density, ..r })
        }),
    },
    Mutant {
        id: "yield-stress-without-density",
        erratum: "ERRATA 7, 8, 9 (000 Eqs 2 and 14, 001 Eqs 6 and 8)",
        description: "σ_y/γ̇ enters ν without being divided by ρ.",
        caught_by: "poiseuille-si-density",
        rung: Some(1.0),
        subject: Subject::Measure(|b, dt| {
            si(b, dt, Conversion { yield_stress_density: 1.0, viscosity_density: DENSITY })
        }),
    },
    Mutant {
        id: "viscosity-without-density",
        erratum: "ERRATA 9, 10 (001 Eqs 2 and 6, 004 Eq 3.26)",
        description: "The dynamic viscosity is used as the kinematic one.",
        caught_by: "poiseuille-si-density",
        rung: Some(1.0),
        subject: Subject::Measure(|b, dt| {
            si(b, dt, Conversion { yield_stress_density: DENSITY, viscosity_density: 1.0 })
        }),
    },
    Mutant {
        id: "no-force-in-stress",
        erratum: "ERRATA 5 (000, 001, 004)",
        description: "The non-equilibrium tensor lacks ½(uF + Fu).",
        caught_by: "shear-rate-uniform-acceleration",
        rung: Some(1.0),
        subject: Subject::Backend(|| Box::new(Mistaken(Mistake::NoForceInStress))),
    },
    Mutant {
        id: "no-force-in-velocity",
        erratum: "ERRATA 75 (000 Eqs 4–5, 001 Eqs 3–4)",
        description: "The velocity lacks half the force.",
        caught_by: "poiseuille-newtonian-magic",
        rung: Some(0.8),
        subject: Subject::Backend(|| Box::new(Mistaken(Mistake::NoForceInVelocity))),
    },
    Mutant {
        id: "spin-reversed",
        erratum: "ERRATA 18 (004 Eq 3.38)",
        description: "u_w = u_p + r × ω: a rotating cylinder drags the fluid the wrong way.",
        caught_by: "taylor-couette",
        rung: Some(16.0),
        subject: Subject::Backend(|| Box::new(Mistaken(Mistake::SpinReversed))),
    },
    Mutant {
        id: "wall-slip-apparent-viscosity",
        erratum: "design [B3] as first written",
        description: "The wall's slip is computed with the apparent instead of the tangent viscosity.",
        caught_by: "poiseuille-scheme-closed-form",
        rung: Some(5.0),
        subject: Subject::Backend(|| Box::new(Mistaken(Mistake::ApparentViscosityAtWall))),
    },
    Mutant {
        id: "wall-slip-explicit",
        erratum: "design [B3] until it became a law by stress",
        description: "The wall's slip follows the stress of its own cell: the wall cell alternates between two states.",
        caught_by: "poiseuille-thesis-channel",
        rung: Some(16.0),
        subject: Subject::Backend(|| Box::new(Mistaken(Mistake::ExplicitWallSlip))),
    },
    super::fast_wall::IDLE,
    Mutant {
        id: "wall-slip-by-pressure",
        erratum: "design [B3]",
        description: "The wall's slip answers F − ∇p of the moment: waves along the wall outrun the lattice.",
        caught_by: "duct-waves-die",
        rung: Some(8.0),
        subject: Subject::Backend(|| Box::new(Mistaken(Mistake::PressureDrivenSlip))),
    },
];

/// The measurement of `poiseuille-newtonian-bgk-slip` with walls on the first and last node: what
/// flows is a channel one cell narrower, read as if it had its full width.
fn wall_at_the_node(backend: &dyn Backend, tau: f64) -> Result<Sample, VerifyError> {
    let full = super::channel::Column::newtonian(16, tau, 1e-4, CollisionChoice::Bgk, WallRule::HalfWay);
    let narrow = super::channel::Column { n: 15, ..full };
    let u = steady_column(backend, &narrow, 1e-13)?.velocity(0);
    let exact = full.exact()?;
    let expected = crate::exact::slip::slip_velocity_bgk(full.force, 1.0, tau);
    let middle = narrow.n / 2;
    Ok(Sample::relative(tau, u[middle] - exact.velocity(narrow.height(middle)), expected))
}
