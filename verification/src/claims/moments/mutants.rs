//! Misprints of the papers about equilibrium, moments and shear rate.

use super::equilibrium::{Formula, RIGHT, largest_residual};
use super::shear_rate::{couette, couette_sample};

use crate::claim::{Sample, VerifyError};
use crate::claims::mutants_physics::{Mistake, Mistaken};
use crate::mutant::{Mutant, Subject};
use lahar::lattice::equilibrium::equilibrium;
use lahar::lattice::moments::{magnitude, moments, second};
use lahar::lattice::{Q, W};
use lahar::solver::run::Backend;

/// 004 Eq 3.44 as printed: 1 − u²/c_s² in place of 1 − u²/(2c_s²).
fn equilibrium_3_44(rho: f64, u: &[f64; 3]) -> [f64; Q] {
    let right = equilibrium(rho - 1.0, rho, u);
    let u2 = (u[0] * u[0] + u[1] * u[1]) + u[2] * u[2];
    std::array::from_fn(|i| right[i] - 1.5 * W[i] * rho * u2)
}

/// Shear-rate tensors and magnitudes at one cell of a Couette flow by a formula of the papers.
fn couette_by(
    backend: &dyn Backend,
    tau: f64,
    formula: fn(&[f64; Q], f64) -> (f64, f64),
) -> Result<Sample, VerifyError> {
    let run = couette(backend, tau)?;
    let (signed, size) = formula(&run.populations(2), tau);
    Ok(couette_sample(tau, signed, size))
}

/// S = (1/2τc_s²) Σ c c (f − f_eq), the sign and density as printed in 001 Eq 9 and 004 Eq 3.27.
fn printed_strain(h: &[f64; Q], tau: f64) -> [f64; 6] {
    moments(h, &[0.0; 3]).q.map(|q| 1.5 / tau * q)
}

pub(super) const MUTANTS: &[Mutant] = &[
    Mutant {
        id: "equilibrium-full-u-squared",
        erratum: "ERRATA 55 (004 Eq 3.44)",
        description: "Equilibrium with 1 − u²/c_s² in place of 1 − u²/(2c_s²).",
        caught_by: "equilibrium-moments",
        rung: Some(0.1),
        subject: Subject::Measure(|_, speed| {
            Ok(largest_residual(&Formula { equilibrium: equilibrium_3_44, ..RIGHT }, speed))
        }),
    },
    Mutant {
        id: "third-moment-with-weights",
        erratum: "ERRATA 57 (004 Eq 3.55c)",
        description: "Third moment of the equilibrium summed with an extra factor w_i.",
        caught_by: "equilibrium-moments",
        rung: Some(0.1),
        subject: Subject::Measure(|_, speed| {
            let factor = |order: usize, i: usize| if order == 3 { W[i] } else { 1.0 };
            Ok(largest_residual(&Formula { factor, ..RIGHT }, speed))
        }),
    },
    Mutant {
        id: "quadrature-without-prefactor",
        erratum: "ERRATA 54 (004 Eq 3.43)",
        description: "Moments taken over the scaled velocity c/(√2 c_s) without the factor (√2 c_s)^m.",
        caught_by: "equilibrium-moments",
        rung: Some(0.0),
        subject: Subject::Measure(|_, speed| {
            let factor = |order: usize, _: usize| [1.0, 1.5_f64.sqrt(), 1.5, 1.5 * 1.5_f64.sqrt()][order];
            Ok(largest_residual(&Formula { factor, ..RIGHT }, speed))
        }),
    },
    Mutant {
        id: "velocity-without-half-force",
        erratum: "ERRATA 75 (000 Eqs 4–5, 001 Eqs 3–4)",
        description: "Velocity Σ c f/ρ without F/2 in equilibrium and force term.",
        caught_by: "conservation-collision",
        rung: None,
        subject: Subject::Backend(|| Box::new(Mistaken(Mistake::NoForceInVelocity))),
    },
    Mutant {
        id: "force-source-without-relaxation",
        erratum: "ERRATA 75 (force term unspecified in 000 and 001)",
        description: "Force source added in full, without 1 − 1/(2τ), next to a velocity that holds F/2.",
        caught_by: "conservation-collision",
        rung: None,
        subject: Subject::Backend(|| Box::new(Mistaken(Mistake::FullSource))),
    },
    Mutant {
        id: "shear-rate-without-force-correction",
        erratum: "ERRATA 5 (all three papers)",
        description: "Non-equilibrium tensor without ½(uF + Fu).",
        caught_by: "acceleration-without-shear",
        rung: None,
        subject: Subject::Backend(|| Box::new(Mistaken(Mistake::NoForceInStress))),
    },
    Mutant {
        id: "shear-rate-of-full-populations",
        erratum: "ERRATA 1 (000 Eq 13)",
        description: "γ_ab = 3/(2τ) Σ c_a c_b f, without subtracting the equilibrium.",
        caught_by: "strain-tensor-couette",
        rung: Some(0.8),
        subject: Subject::Measure(|backend, tau| {
            couette_by(backend, tau, |h, tau| {
                let f: [f64; Q] = std::array::from_fn(|i| h[i] + W[i]);
                let gamma = second(&f).map(|pi| 1.5 / tau * pi);
                (2.0 * gamma[3], 2.0 * magnitude(&gamma))
            })
        }),
    },
    Mutant {
        id: "shear-rate-with-wrong-sign",
        erratum: "ERRATA 2 (001 Eq 9, 004 Eq 3.27)",
        description: "S = +1/(2τc_s²) Σ c c (f − f_eq): the factor −1/ρ is missing.",
        caught_by: "strain-tensor-couette",
        rung: Some(0.8),
        subject: Subject::Measure(|backend, tau| {
            couette_by(backend, tau, |h, tau| {
                let s = printed_strain(h, tau);
                (2.0 * s[3], 2.0 * magnitude(&s))
            })
        }),
    },
    Mutant {
        id: "shear-rate-of-half-the-tensor",
        erratum: "ERRATA 3 (004 Eq 3.3 with 3.27)",
        description: "γ̇ = √(½ S:S), which is right for 2S, applied to S.",
        caught_by: "strain-tensor-couette",
        rung: Some(0.8),
        subject: Subject::Measure(|backend, tau| {
            couette_by(backend, tau, |h, tau| {
                let s = printed_strain(h, tau).map(|s| -s);
                (2.0 * s[3], magnitude(&s))
            })
        }),
    },
    Mutant {
        id: "shear-rate-is-the-second-invariant",
        erratum: "ERRATA 4 (000 Eqs 2, 14; 004 Eq 3.35)",
        description: "The second invariant ½ S:S itself taken for the shear rate.",
        caught_by: "strain-tensor-couette",
        rung: Some(0.8),
        subject: Subject::Measure(|backend, tau| {
            couette_by(backend, tau, |h, tau| {
                let s = printed_strain(h, tau).map(|s| -s);
                (2.0 * s[3], magnitude(&s) * magnitude(&s))
            })
        }),
    },
];
