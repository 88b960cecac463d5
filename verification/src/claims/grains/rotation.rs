//! Free rotation of clumps.

use super::support::{RADIUS, elastic, odd_clump, setup, worst};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::exact::grains::top::Top;
use lahar::dem::{Clump, Dem, Grain, Integrator, Orientation, V3};

/// Spin at the start, almost about the intermediate axis, rad/s.
pub(super) const SPIN: [f64; 3] = [0.5, 100.0, 1.0];

/// A free clump whose principal axes are those of the scene at the start.
pub(super) fn free(clump: Clump, spin: V3, dt: f64, integrator: Integrator) -> Result<Dem, VerifyError> {
    let mut s = setup(7e6, elastic());
    s.clumps = vec![clump];
    s.grains = vec![Grain::clump(0, RADIUS, V3::zeros(), Orientation::identity(), 0).spinning(spin)];
    s.time_step_s = Some(dt);
    // Nothing to collide with.
    s.design_speed_m_s = 1e-4;
    s.integrator = integrator;
    Ok(Dem::new(&s)?)
}

/// Spin about the intermediate principal axis, rad/s.
pub(super) fn middle_spin(d: &Dem) -> f64 {
    d.bodies().orientation[0].inverse_transform_vector(&d.bodies().spin[0]).y
}

/// Angular momentum from attitude and spin, not the one the code carries along; and the energy.
fn momentum_and_energy(d: &Dem) -> (V3, f64) {
    let b = d.bodies();
    let (q, w) = (&b.orientation[0], &b.spin[0]);
    let l = q * q.inverse_transform_vector(w).component_mul(&b.inertia[0]);
    (l, 0.5 * w.dot(&l))
}

/// Largest changes of angular momentum, energy and |q| over a run.
fn drift(clump: Clump, integrator: Integrator, steps: u64) -> Result<[f64; 3], VerifyError> {
    let mut d = free(clump, V3::from(SPIN), 5e-5, integrator)?;
    let (l0, e0) = momentum_and_energy(&d);
    let mut worst = [0.0f64; 3];
    for _ in 0..100 {
        d.step(steps / 100)?;
        let (l, e) = momentum_and_energy(&d);
        let now = [
            (l - l0).norm() / l0.norm(),
            (e / e0 - 1.0).abs(),
            (d.bodies().orientation[0].norm() - 1.0).abs(),
        ];
        worst = [0, 1, 2].map(|k| worst[k].max(now[k]));
    }
    Ok(worst)
}

/// Conservation.
pub const CONSERVATION: Claim = Claim {
    id: "free-clump-conservation",
    title: "A free clump keeps angular momentum and energy over a million steps",
    tags: &["D4", "000 Sec 2.1", "ERRATA 33", "HARD_CASES H17"],
    measures: "Largest relative change of |L| (from attitude and spin) and of the energy, worst of an asymmetric clump of three \
               spheres near its intermediate axis (Verlet and Gear) and a tetrahedral clump; omega dt = 5e-3",
    reference: Reference { source: "Zero: Euler's equations without torque", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "n (steps)", short: &[1e5], full: &[1e5, 1e6] },
    order: None,
    tolerance: Tolerance {
        value: 1e-12,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "The implicit midpoint rotation keeps both exactly; rounding of 1e-16 in each of 1e6 steps is a random walk of 1e-13; \
                  ten times that (H17 asks for 1e-8)",
    },
    kind: Kind::Verification,
    measure: |_, steps| {
        let n = steps as u64;
        let odd = drift(odd_clump()?, Integrator::Verlet, n)?;
        let gear = drift(odd_clump()?, Integrator::Gear, n)?;
        let tetrahedron = drift(Clump::tetrahedron(1.0, 1.5)?, Integrator::Verlet, n)?;
        let both = |d: [f64; 3]| worst(&d[..2]);
        let error = worst(&[both(odd), both(gear), both(tetrahedron)]);
        Ok(Sample::absolute(steps, error, 0.0)
            .with("asymmetric, Verlet", both(odd))
            .with("asymmetric, Gear", both(gear))
            .with("tetrahedral", both(tetrahedron))
            .with("| |q| - 1 |", worst(&[odd[2], gear[2], tetrahedron[2]])))
    },
};

/// Mean period from twenty changes of sign of the middle spin.
fn flip_period(steps_per_radian: f64) -> Result<(f64, f64), VerifyError> {
    let mut d = free(odd_clump()?, V3::from(SPIN), 0.01 / steps_per_radian, Integrator::Verlet)?;
    let i = d.bodies().inertia[0];
    let exact = Top::new([i.x, i.y, i.z], SPIN).period();
    let (mut times, mut before) = (Vec::new(), middle_spin(&d));
    while times.len() < 21 && d.time() < 15.0 * exact {
        d.step(1)?;
        let now = middle_spin(&d);
        if now * before < 0.0 {
            times.push(d.time() - d.time_step() * now / (now - before));
        }
        before = now;
    }
    match times.get(20) {
        Some(last) => Ok(((last - times[0]) / 10.0, exact)),
        None => {
            Err(VerifyError::Numerics { what: "flips", detail: format!("{} instead of 21", times.len()) })
        }
    }
}

/// Flips about the intermediate axis.
pub const FLIP: Claim = Claim {
    id: "free-clump-flip-period",
    title: "An asymmetric clump tumbles about its intermediate axis with the period of the elliptic integral",
    tags: &["D4", "ERRATA 33", "HARD_CASES H17"],
    measures: "Period of the spin in the clump's frame, from twenty flips; spin 100 rad/s with 1 % about the other axes",
    reference: Reference {
        source: "T = 4 K(m)/lambda, Landau & Lifshitz, Mechanics, section 37",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "N (steps per radian)",
        short: &[25.0, 50.0, 100.0],
        full: &[12.5, 25.0, 50.0, 100.0, 200.0, 400.0, 800.0],
    },
    order: Some(OrderBand { expected: 2.0, band: 0.1, at_least: false }),
    tolerance: Tolerance {
        value: 3.5e-7,
        at: Rung::At(100.0),
        basis: Basis::AfterSeeing,
        because: "2.2e-3/N^2, the constant of the coarsest rung, gives 2.2e-7 at N = 100; half as much again (H17 asks for 1e-3)",
    },
    kind: Kind::Verification,
    measure: |_, steps| {
        let (period, exact) = flip_period(steps)?;
        Ok(Sample::relative(steps, period, exact))
    },
};
