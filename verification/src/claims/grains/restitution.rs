//! Restitution under the damping laws, attraction cut off.

use super::support::{Bounce, POISSON, RADIUS, bounce, head_on, mass, setup, smooth, worst};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::exact::grains::collision::{hertz_stiffness, oscillator, visco_elastic};
use crate::reference_values::find;
use lahar::dem::{NormalLaw, Setup};
use lahar::solver::run::Backend;

/// Young's modulus, Pa.
const YOUNG: f64 = 7e7;

/// Two equal spheres with the visco-elastic law of dimensionless damping `a` at speed `v`.
fn visco_elastic_setup(a: f64, v: f64, steps: f64) -> Setup {
    let k = hertz_stiffness(YOUNG, POISSON, (RADIUS, RADIUS));
    let time_s = a / (libm::pow(k / (0.5 * mass(RADIUS)), 0.4) * libm::pow(v, 0.2));
    with_law(NormalLaw::ViscoElastic { time_s }, v, steps)
}

fn with_law(normal: NormalLaw, v: f64, steps: f64) -> Setup {
    let mut s = head_on(setup(YOUNG, smooth(normal)), (RADIUS, RADIUS), v, 0.0);
    s.steps_per_contact = steps;
    s
}

/// The visco-elastic collision of dimensionless damping `a` at `v` m/s.
pub(super) fn visco_elastic_bounce(a: f64, v: f64, steps: f64) -> Result<Bounce, VerifyError> {
    bounce(&visco_elastic_setup(a, v, steps))
}

/// Tsuji's collision.
pub(super) fn tsuji_bounce(alpha: f64, v: f64, steps: f64) -> Result<Bounce, VerifyError> {
    bounce(&with_law(NormalLaw::TsujiAlpha { alpha }, v, steps))
}

/// Adds both conventions to a sample.
fn conventions(s: Sample, b: &Bounce, textbook: f64) -> Sample {
    s.with("textbook value (attraction included)", textbook)
        .with("least force in contact / largest", b.least_force / b.force)
        .with("steps without force at the end", f64::from(b.forceless_steps))
}

/// Against the table.
pub const VISCO_ELASTIC_TABLE: Claim = Claim {
    id: "restitution-visco-elastic-table",
    title: "Visco-elastic restitution is the tabulated one, without attraction",
    tags: &["D1", "000 Sec 2.1", "HARD_CASES H15"],
    measures: "Restitution with the force cut off at zero; further column: the value with attraction, which it must not be",
    reference: Reference {
        source: "reference_values.json `restitution_viscoelastic_F0_A0.05`, `_A0.2`, field e_F0: 0.918132856, 0.72208544",
        uncertainty: 1e-6,
    },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "A (with k = m = v = 1)", short: &[0.05, 0.2], full: &[0.05, 0.2] },
    order: None,
    tolerance: Tolerance {
        value: 1e-5,
        at: Rung::Every,
        basis: Basis::Reference,
        because: "H15's bound; 4000 steps leave 0.208 (3/2) A dt^1.5 e = 1.0e-6 (the trapezoidal rule on a force that starts \
                  like the root of time), the reference has 7 digits",
    },
    kind: Kind::Verification,
    measure: |_, a| {
        let name =
            if a == 0.05 { "restitution_viscoelastic_F0_A0.05" } else { "restitution_viscoelastic_F0_A0.2" };
        let entry = find(name, &[])?;
        let b = visco_elastic_bounce(entry.input("A")?, entry.input("v")?, 4000.0)?;
        Ok(conventions(Sample::absolute(a, b.restitution, entry.field("e_F0")?), &b, entry.field("e_x0")?))
    },
};

/// Steps of the two ladders below.
const FINE: f64 = 2000.0;

/// Against the integral, other dampings.
pub const VISCO_ELASTIC: Claim = Claim {
    id: "restitution-visco-elastic",
    title: "Visco-elastic restitution follows the integral of its law for any damping",
    tags: &["D1", "000 Sec 2.1"],
    measures: "Restitution, 2000 steps per contact, at 0.7 m/s",
    reference: Reference {
        source: "Brilliantov's equation as a polynomial system (x = w^2, dt = 2 w ds), classical Runge-Kutta, ended at zero force",
        uncertainty: 1e-12,
    },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "a (damping A (k/m)^0.4 v^0.2)",
        short: &[0.01, 0.05, 0.11, 0.2, 0.5],
        full: &[0.003, 0.01, 0.03, 0.05, 0.08, 0.11, 0.15, 0.2, 0.3, 0.5, 0.7],
    },
    order: None,
    tolerance: Tolerance {
        value: 8e-6,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "The damping force starts like the root of time: the trapezoidal rule errs by -zeta(-1/2) = 0.208 of \
                  (3/2) a dt^1.5, times e 4.9e-6 at most with dt = 3.22/2000 contact times; the rest is of order dt^2 = 3e-6",
    },
    kind: Kind::Verification,
    measure: |_, a| {
        let (b, exact) = (visco_elastic_bounce(a, 0.7, FINE)?, visco_elastic(a));
        Ok(conventions(Sample::absolute(a, b.restitution, exact.cut_off), &b, exact.textbook))
    },
};

/// Its order.
pub const VISCO_ELASTIC_ORDER: Claim = Claim {
    id: "restitution-visco-elastic-order",
    title: "Across a visco-elastic contact the error falls with order 1.5, not 2",
    tags: &["D1", "D3"],
    measures: "Restitution at a = 0.2",
    reference: Reference {
        source: "As for `restitution-visco-elastic`; order 3/2 from the root of time with which the damping starts",
        uncertainty: 1e-12,
    },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "N (steps per contact)",
        short: &[500.0, 1000.0, 2000.0, 4000.0],
        full: &[125.0, 250.0, 500.0, 1000.0, 2000.0, 4000.0, 8000.0, 16000.0],
    },
    order: Some(OrderBand { expected: 1.5, band: 0.25, at_least: false }),
    tolerance: Tolerance {
        value: 2e-6,
        at: Rung::At(4000.0),
        basis: Basis::Derived,
        because: "0.208 (3/2) a dt^1.5 e = 1.0e-6 with dt = 3.22/4000, and dt^2 = 6.5e-7 from where the step falls at the \
                  cut-off",
    },
    kind: Kind::Verification,
    measure: |_, steps| {
        let (b, exact) = (visco_elastic_bounce(0.2, 0.7, steps)?, visco_elastic(0.2));
        Ok(conventions(Sample::absolute(steps, b.restitution, exact.cut_off), &b, exact.textbook))
    },
};

/// Dependence on speed.
pub const VISCO_ELASTIC_SPEED: Claim = Claim {
    id: "restitution-visco-elastic-speed",
    title: "Visco-elastic restitution falls with speed as a ~ v^(1/5) demands",
    tags: &["D1", "000 Sec 2.1"],
    measures: "Restitution at one dissipative constant A (a = 0.1 at 1 m/s), 2000 steps per contact",
    reference: Reference {
        source: "As for `restitution-visco-elastic`, with a = 0.1 v^(1/5)",
        uncertainty: 1e-12,
    },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "v (m/s)",
        short: &[0.01, 0.1, 1.0],
        full: &[1e-3, 3e-3, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 5e-6,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "As for `restitution-visco-elastic` with a = 0.125 at most: 2.1e-6, and 2.6e-6 of order dt^2",
    },
    kind: Kind::Verification,
    measure: |_, v| {
        // A of a = 0.1 at 1 m/s.
        let a = 0.1 * libm::pow(v, 0.2);
        let (b, exact) = (visco_elastic_bounce(a, v, FINE)?, visco_elastic(a));
        Ok(conventions(Sample::absolute(v, b.restitution, exact.cut_off), &b, exact.textbook))
    },
};

/// Tsuji against the table.
pub const TSUJI_TABLE: Claim = Claim {
    id: "restitution-tsuji-table",
    title: "Tsuji's restitution is the tabulated one, without attraction",
    tags: &["D1", "000 Sec 2.1"],
    measures: "Restitution with the force cut off at zero, 4000 steps per contact; further column: the value with attraction",
    reference: Reference {
        source: "reference_values.json `restitution_tsuji_alpha0.1`, `_alpha0.6`, field e_F0: 0.872291467, 0.484938946",
        uncertainty: 1e-6,
    },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "alpha", short: &[0.1, 0.6], full: &[0.1, 0.6] },
    order: None,
    tolerance: Tolerance {
        value: 2e-5,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "The damping force starts like the fourth root of time: the trapezoidal rule errs by -zeta(-1/4) = 0.320 of \
                  alpha dt^1.25, times e 1.3e-5 at alpha = 0.6 with dt = 3.22/4000; half as much again for order dt^1.5",
    },
    kind: Kind::Verification,
    measure: |_, alpha| {
        let name = if alpha == 0.1 { "restitution_tsuji_alpha0.1" } else { "restitution_tsuji_alpha0.6" };
        let entry = find(name, &[])?;
        let b = tsuji_bounce(alpha, 0.7, 4000.0)?;
        Ok(conventions(
            Sample::absolute(alpha, b.restitution, entry.field("e_F0")?),
            &b,
            entry.field("e_x0")?,
        ))
    },
};

/// Tsuji against the closed form.
pub const TSUJI: Claim = Claim {
    id: "restitution-tsuji",
    title: "Tsuji's restitution follows its closed form from weak to overdamped",
    tags: &["D1", "000 Sec 2.1"],
    measures: "Restitution, 2000 steps per contact, at 0.7 m/s; alpha = sqrt(5) is critical damping",
    reference: Reference {
        source: "The damped linear oscillator in y = delta^(5/4), b = alpha/sqrt(5), ended at zero force (Schwager & Poeschel 2007)",
        uncertainty: 0.0,
    },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "alpha",
        short: &[0.02, 0.1, 0.35, 0.6, 1.5, 3.0],
        full: &[0.0, 0.005, 0.02, 0.05, 0.1, 0.2, 0.35, 0.6, 1.0, 1.5, 2.2, 3.0, 5.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 5e-5,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "0.320 alpha dt^1.25 e with dt = 3.22/2000: alpha e is largest near alpha = 1.6, where this is 3.5e-5; half \
                  as much again for higher orders",
    },
    kind: Kind::Verification,
    measure: |_, alpha| {
        let (b, exact) = (tsuji_bounce(alpha, 0.7, FINE)?, oscillator(alpha / 5f64.sqrt()));
        Ok(conventions(Sample::absolute(alpha, b.restitution, exact.cut_off), &b, exact.textbook))
    },
};

/// Tsuji at other speeds.
pub const TSUJI_SPEED: Claim = Claim {
    id: "restitution-tsuji-speed",
    title: "Tsuji's restitution does not depend on speed",
    tags: &["D1", "000 Sec 2.1"],
    measures: "Largest less least restitution over speeds 0.01, 0.1, 1 and 5 m/s, 500 steps in each contact",
    reference: Reference {
        source: "Zero: scaled with contact time and overlap, the law has no other number in it (reference_values.json \
                 `restitution_tsuji_velocity_independence`)",
        uncertainty: 0.0,
    },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "alpha",
        short: &[0.1, 0.6, 2.0],
        full: &[0.02, 0.1, 0.35, 0.6, 1.0, 2.0, 4.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 2e-11,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "Steps scale with the contact, so only rounding differs: the overlap (4e-6 m at 0.01 m/s) is a difference of \
                  lengths of 1e-2 m, 1.7e-18/4e-6 = 4e-13 in each of up to 1000 steps, at random: 1.3e-11",
    },
    kind: Kind::Verification,
    measure: tsuji_speed,
};

fn tsuji_speed(_: &dyn Backend, alpha: f64) -> Result<Sample, VerifyError> {
    let found: Result<Vec<f64>, VerifyError> =
        [0.01, 0.1, 1.0, 5.0].iter().map(|&v| Ok(tsuji_bounce(alpha, v, 500.0)?.restitution)).collect();
    let found = found?;
    let (least, largest) = found.iter().fold((f64::MAX, f64::MIN), |(a, b), &e| (a.min(e), b.max(e)));
    let exact = oscillator(alpha / 5f64.sqrt()).cut_off;
    Ok(Sample::absolute(alpha, largest - least, 0.0).with("restitution", found[0]).with("closed form", exact))
}

/// The restitution asked for.
pub const ASKED_FOR: Claim = Claim {
    id: "restitution-as-asked",
    title: "The linear law and Tsuji's give the restitution they are asked for",
    tags: &["D1"],
    measures: "|restitution - wished| of the linear spring and dashpot, worst of e = 0.95, 0.5, 0.2; further column: Tsuji's",
    reference: Reference { source: "The number in the material table", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "N (steps per contact)",
        short: &[250.0, 500.0, 1000.0, 2000.0],
        full: &[125.0, 250.0, 500.0, 1000.0, 2000.0, 4000.0, 8000.0],
    },
    order: Some(OrderBand { expected: 1.0, band: 0.15, at_least: false }),
    tolerance: Tolerance {
        value: 2.5e-4,
        at: Rung::At(2000.0),
        basis: Basis::Derived,
        because: "A dashpot acts from the first instant; touching without overlap has no force in the code, so half a step of \
                  damping is lost: b pi/N of the speed, b pi e/N = 2.30e-4 at e = 0.2 (b = 0.731); a tenth for order 1/N^2",
    },
    kind: Kind::Verification,
    measure: |_, steps| {
        let (mut linear, mut tsuji) = (Vec::new(), Vec::new());
        for e in [0.95, 0.5, 0.2] {
            let law = NormalLaw::Linear { stiffness_n_m: 1e5, restitution: e, tangential_ratio: 2.0 / 7.0 };
            linear.push(bounce(&with_law(law, 0.3, steps))?.restitution - e);
            tsuji.push(bounce(&with_law(NormalLaw::Tsuji { restitution: e }, 0.3, steps))?.restitution - e);
        }
        Ok(Sample::absolute(steps, worst(&linear), 0.0).with("Tsuji's", worst(&tsuji)))
    },
};

/// No attraction.
pub const NO_ATTRACTION: Claim = Claim {
    id: "no-attraction",
    title: "No damping law ever attracts",
    tags: &["D1", "HARD_CASES H15"],
    measures: "How far the normal force is below zero anywhere in the contact, over the largest; infinite if the cut-off was \
               never needed. Laws: visco-elastic a = A, Tsuji alpha = 3 A, linear e = 1 - A",
    reference: Reference { source: "Zero: dry grains do not stick", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "A", short: &[0.2, 0.5, 0.7], full: &[0.05, 0.1, 0.2, 0.35, 0.5, 0.7] },
    order: None,
    tolerance: Tolerance {
        value: 0.0,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "The force is max(0, ...): exact",
    },
    kind: Kind::Verification,
    measure: |_, a| {
        let linear =
            NormalLaw::Linear { stiffness_n_m: 1e5, restitution: 1.0 - a, tangential_ratio: 2.0 / 7.0 };
        let found = [
            visco_elastic_bounce(a, 1.0, 1000.0)?,
            tsuji_bounce(3.0 * a, 1.0, 1000.0)?,
            bounce(&with_law(linear, 1.0, 1000.0))?,
        ];
        let below = |b: &Bounce| {
            if b.forceless_steps == 0 { f64::INFINITY } else { (-b.least_force / b.force).max(0.0) }
        };
        let steps: u32 = found.iter().map(|b| b.forceless_steps).sum();
        Ok(Sample::absolute(a, worst(&found.each_ref().map(below)), 0.0)
            .with("steps of 3000 at which the cut-off acted", f64::from(steps)))
    },
};
