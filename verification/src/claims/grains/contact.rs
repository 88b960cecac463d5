//! The tangential spring under a rigid motion of the pair.

use super::support::{elastic, material};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use lahar::dem::contact::{
    Contact, ContactEquations, Geometry, History, Losses, Memory, Motion, Rolling, StandardContact, react,
};
use lahar::dem::{Materials, Orientation, PairProperties, V3};

/// How long a contact is turned, s.
const TIME: f64 = 2.0;

/// Stretches the spring of a contact, turns the pair rigidly (tilt and twist) for two seconds in `steps` steps, and
/// compares the tangential force with the first one turned.
pub(super) fn turned<E: ContactEquations>(equations: &E, steps: f64) -> Result<Sample, VerifyError> {
    let pair = PairProperties { friction: 10.0, ..elastic() };
    let table = Materials::single(material(7e6), pair).compile()?;
    let law = table.law(0, 0);
    let omega = V3::new(0.3, -0.5, 0.8);
    let dt = TIME / steps;
    let attitude = |t: f64| Orientation::from_scaled_axis(omega * t);
    let normal = V3::new(1.0, 0.2, -0.3).normalize();
    let mut history = History::default();
    let (mut rolling, mut losses) = (Rolling::default(), Losses::default());
    let mut force = |t: f64, slip: V3| {
        let g = Geometry { normal: attitude(t) * normal, overlap: 1e-5, radius: 2.5e-3, mass: 1e-3 };
        let m = Motion { slip, relative_spin: V3::zeros(), mean_spin: omega };
        let contact = Contact { law, geometry: g, motion: m, dt };
        let memory = Memory { history: &mut history, rolling: &mut rolling, losses: &mut losses };
        react(equations, &contact, memory).tangential
    };
    let across = normal.cross(&V3::x()).normalize() * 1e-3;
    force(0.0, across);
    let first = force(0.0, V3::zeros());
    let mut last = first;
    for k in 1..=steps as u64 {
        last = force(k as f64 * dt, V3::zeros());
    }
    let error = (attitude(TIME).inverse() * last - first).norm() / first.norm();
    Ok(Sample { error, ..Sample::absolute(steps, last.norm(), first.norm()) })
}

/// Objectivity.
pub const CARRIED: Claim = Claim {
    id: "spring-turns-with-contact",
    title: "A stretched tangential spring turns with the pair that carries it",
    tags: &["D2", "000 Sec 2.1"],
    measures: "Tangential force after the pair has tilted and twisted rigidly by 2 rad, turned back, against the force before; over \
               its size",
    reference: Reference {
        source: "The same force: a rigid motion changes nothing in a material (objectivity)",
        uncertainty: 0.0,
    },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "n (steps)",
        short: &[250.0, 500.0, 1000.0, 2000.0],
        full: &[125.0, 250.0, 500.0, 1000.0, 2000.0, 4000.0],
    },
    order: Some(OrderBand { expected: 2.0, band: 0.2, at_least: true }),
    tolerance: Tolerance {
        value: 1e-8,
        at: Rung::At(2000.0),
        basis: Basis::AfterSeeing,
        because: "A twist by angle a per step is made as 1 - a^2/2 and a, short by a^3/6 (second order over a time): 0.0245/n^2, the \
                  constant of the coarsest rung, gives 6.1e-9 at n = 2000; half as much again",
    },
    kind: Kind::Verification,
    measure: |_, steps| turned(&StandardContact, steps),
};
