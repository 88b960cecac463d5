//! Square ducts, one cell long.

use super::channel::run_steady;
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance};
use crate::exact::duct::RectangularDuct;
use lahar::collision::{CollisionChoice, OddRate};
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Face, Setup};

/// Square duct.
pub const SQUARE_DUCT: Claim = Claim {
    id: "duct-square",
    title: "Newtonian flow in a square duct converges at second order",
    tags: &["K2", "B1", "L5"],
    measures: "relative L2 error of the velocity, TRT Λ = 3/16, τ = 1",
    reference: Reference { source: "Fourier series of the rectangular duct", uncertainty: 1e-14 },
    metric: Metric::L2,
    ladder: Ladder {
        parameter: "N (cells across)",
        short: &[12.0, 16.0, 24.0],
        full: &[12.0, 16.0, 24.0, 32.0, 48.0, 64.0],
    },
    order: Some(OrderBand { expected: 2.0, band: 0.2, at_least: false }),
    tolerance: Tolerance {
        value: 2e-3,
        at: Rung::At(24.0),
        basis: Basis::Derived,
        because: "truncation Δx²/12 of the fourth derivatives, of order G/(μ h²): (1/12)(2/24)²·4 = 2.3e-3 of u_max at \
                  most, and they are that large only near the corners",
    },
    kind: Kind::Verification,
    measure: |backend, n| {
        let cells = n as usize;
        let mu = 1.0 / 6.0;
        let duct = RectangularDuct {
            mu,
            half_width: 0.5 * n,
            half_height: 0.5 * n,
            force: 4.0 * mu * 1e-2 / (n * n),
        };
        let mut setup = Setup::periodic([1, cells, cells], Law::Newtonian { mu });
        setup.collision = CollisionChoice::Trt(OddRate::fixed(3.0 / 16.0));
        setup.faces[1] = [Face::NoSlip; 2];
        setup.faces[2] = [Face::NoSlip; 2];
        setup.force = BodyForce::Constant([duct.force, 0.0, 0.0]);
        let interval = (0.05 * n * n / mu).max(20.0) as u64;
        let steady = run_steady(backend, &setup, 1e-7, interval, 200 * interval)?;
        let place = |x: usize| x as f64 + 0.5 - 0.5 * n;
        let exact: Vec<f64> = (0..setup.cells())
            .map(|cell| setup.coordinates(cell))
            .map(|[_, j, k]| duct.velocity(place(j), place(k)))
            .collect();
        let computed = steady.velocity(0);
        let mean = computed.iter().sum::<f64>() / (n * n * duct.mean_velocity());
        Ok(Sample::l2(n, &computed, &exact).with("flux / exact", mean).with("steps", steady.steps as f64))
    },
};
