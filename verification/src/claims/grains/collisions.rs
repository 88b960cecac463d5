//! One head-on collision of two spheres: Hertz without damping.

use super::support::{Bounce, POISSON, RADIUS, bounce, elastic, head_on, mass, setup, worst};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::exact::grains::collision::{hertz_force, hertz_overlap, hertz_stiffness, hertz_time};
use crate::reference_values::find;
use lahar::solver::run::Backend;

/// What is varied inside a rung: Young's modulus (Pa), radii (m), speed (m/s).
const CASES: [(f64, (f64, f64), f64); 5] = [
    (70e9, (RADIUS, RADIUS), 1.0),
    (70e9, (RADIUS, RADIUS), 0.01),
    (70e9, (RADIUS, RADIUS), 10.0),
    (7e6, (5e-4, 5e-4), 0.1),
    (7e8, (RADIUS, 5.0 * RADIUS), 0.5),
];

/// The collisions of a rung with the closed forms of their time, overlap and force.
fn collide(steps: f64) -> Result<Vec<(Bounce, [f64; 3])>, VerifyError> {
    let one = |&(young, radii, v): &(f64, (f64, f64), f64)| {
        let mut s = head_on(setup(young, elastic()), radii, v, 0.0);
        s.steps_per_contact = steps;
        let m = mass(radii.0) * mass(radii.1) / (mass(radii.0) + mass(radii.1));
        let k = hertz_stiffness(young, POISSON, radii);
        Ok((bounce(&s)?, [hertz_time(m, k, v), hertz_overlap(m, k, v), hertz_force(m, k, v)]))
    };
    CASES.iter().map(one).collect()
}

/// One of the three numbers, the worst collision of the rung; the rest go into further columns.
fn sample(steps: f64, pick: fn(&Bounce) -> f64, k: usize) -> Result<Sample, VerifyError> {
    let all = collide(steps)?;
    let errors: Vec<f64> = all.iter().map(|(b, exact)| pick(b) / exact[k] - 1.0).collect();
    let (first, exact) = &all[0];
    let elastic: Vec<f64> = all.iter().map(|(b, _)| b.restitution - 1.0).collect();
    let mut sample =
        Sample::relative(steps, pick(first), exact[k]).with("|restitution - 1|", worst(&elastic));
    sample.error = worst(&errors);
    Ok(sample)
}

const STEPS: Ladder = Ladder {
    parameter: "N (steps per contact)",
    short: &[50.0, 100.0, 200.0],
    full: &[25.0, 50.0, 100.0, 200.0, 400.0, 800.0, 1600.0],
};

/// Contact time.
pub const TIME: Claim = Claim {
    id: "hertz-contact-time",
    title: "An elastic collision lasts as long as Hertz's formula says, whatever size, stiffness and speed",
    tags: &["D1", "D3", "000 Sec 2.1"],
    measures: "Contact time, relative; worst of five collisions: speeds 0.01 to 10 m/s, E from 7 MPa to 70 GPa, radii \
               0.5 to 25 mm, equal and unequal",
    reference: Reference {
        source: "t_c = (4/5) sqrt(pi) Gamma(2/5)/Gamma(9/10) delta_max/v, Landau & Lifshitz, Theory of Elasticity, section 9",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: STEPS,
    order: Some(OrderBand { expected: 2.0, band: 0.1, at_least: false }),
    tolerance: Tolerance {
        value: 2e-5,
        at: Rung::At(200.0),
        basis: Basis::Derived,
        because: "Velocity Verlet lets an oscillation of half-period N steps run pi^2/(24 N^2) wrong, 1.0e-5 at N = 200; \
                  doubled because Hertz's spring is up to 1.5 times as stiff at depth as the mean one",
    },
    kind: Kind::Verification,
    measure: |_, steps| sample(steps, |b| b.time, 0),
};

/// Largest overlap.
pub const OVERLAP: Claim = Claim {
    id: "hertz-overlap",
    title: "An elastic collision goes as deep as Hertz's formula says",
    tags: &["D1", "D3", "000 Sec 2.1"],
    measures: "Largest overlap (top of the parabola through the three deepest samples), relative; worst of the same five",
    reference: Reference {
        source: "delta_max = (5 m v^2/(4 k))^(2/5), energy balance of k delta^(3/2)",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: STEPS,
    order: Some(OrderBand { expected: 2.0, band: 0.1, at_least: false }),
    tolerance: Tolerance {
        value: 2.5e-5,
        at: Rung::At(200.0),
        basis: Basis::Derived,
        because: "Velocity Verlet conserves a shadow energy that differs by (1/8) omega^2 dt^2 = pi^2/(8 N^2) of itself, \
                  3.1e-5 at N = 200; 2/5 of that, 1.2e-5, goes into the overlap; doubled for the stiffness at depth",
    },
    kind: Kind::Verification,
    measure: |_, steps| sample(steps, |b| b.overlap, 1),
};

/// The independently computed example.
pub const TABLE: Claim = Claim {
    id: "hertz-table",
    title: "Two glass spheres of 5 mm at 1 m/s: time, overlap and force as computed outside lahar",
    tags: &["D1", "000 Sec 2.1"],
    measures: "Contact time, largest overlap and largest force; the worst of the three",
    reference: Reference {
        source: "reference_values.json `hertz_example_glass_5mm`: 30.78022098 us, 10.45781283 um, 82.92465034 N",
        uncertainty: 1e-7,
    },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "N (steps per contact)", short: &[2000.0], full: &[2000.0, 8000.0] },
    order: None,
    tolerance: Tolerance {
        value: 4e-7,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "The errors of `hertz-contact-time` and `hertz-overlap` carried on as 1/N^2 from N = 200 to 2000: 2e-7 \
                  and 3e-7; the reference has 8 digits",
    },
    kind: Kind::Verification,
    measure: table,
};

fn table(_: &dyn Backend, steps: f64) -> Result<Sample, VerifyError> {
    let entry = find("hertz_example_glass_5mm", &[])?;
    let mut material = super::support::material(entry.input("E")?);
    (material.poisson, material.density_kg_m3) = (entry.input("nu")?, entry.input("rho")?);
    let r = entry.input("a")?;
    let mut s = setup(material.young_pa, elastic());
    s.materials.list[0] = material;
    let mut s = head_on(s, (r, r), entry.input("v")?, 0.0);
    s.steps_per_contact = steps;
    let b = bounce(&s)?;
    let pairs = [(b.time, "tc"), (b.overlap, "delta_max"), (b.force, "Fmax")];
    let mut errors = Vec::new();
    for (value, key) in pairs {
        errors.push(value / entry.field(key)? - 1.0);
    }
    let mut sample = Sample::relative(steps, b.time, entry.field("tc")?)
        .with("error of the overlap", errors[1])
        .with("error of the force", errors[2]);
    sample.error = worst(&errors);
    Ok(sample)
}
