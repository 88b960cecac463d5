//! Rigid plugs that move obliquely to the grid: D3Q19 has no xyz moment.

use std::sync::Arc;

use super::support::{from_middle, largest};
use crate::rheology::Law;
use crate::solver::run::Backend;
use crate::solver::setup::{BodyForce, FlowPoint, Setup, WallRule};
use crate::verify::claim::{
    Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::verify::exact::flow_curve::FlowCurve;
use crate::verify::exact::poiseuille::Channel;

/// Bingham channel along `direction` (walls normal to y), plug half the width, largest speed `speed`.
///
/// Returns the spread of velocity over the exact plug, less a cell on either side, over the speed.
pub fn channel_spread(
    backend: &dyn Backend,
    direction: [f64; 3],
    cells: usize,
    tau: f64,
    speed: f64,
    wall: WallRule,
) -> Result<(f64, f64), VerifyError> {
    let nu = (tau - 0.5) / 3.0;
    let h = 0.5 * cells as f64;
    // Plug speed G h²/(8 μ) at half plug width.
    let force = 8.0 * nu * speed / (h * h);
    let law = Law::Bingham { sigma0: 0.5 * force * h, mu: nu };
    let flow = Channel { law, half_width: h, force };
    let length = (direction.iter().map(|d| d * d).sum::<f64>()).sqrt();
    let unit = direction.map(|d| d / length);
    let mut setup = Setup::channel(cells, law, 0.0);
    setup.force = BodyForce::Constant(unit.map(|d| d * force));
    setup.wall_rule = wall;
    setup.initial = Some(Arc::new(move |[_, j, _]| {
        let y = from_middle(j, cells);
        let u = flow.velocity(y);
        let rate = -law.rate(force * y.abs()) * y.signum();
        let mut gradient = [[0.0; 3]; 3];
        for a in 0..3 {
            gradient[a][1] = unit[a] * rate;
        }
        FlowPoint { density: 1.0, velocity: unit.map(|d| d * u), gradient }
    }));
    let mut run = backend.start(&setup)?;
    // Spurious stress grows by about U F per step and has to reach σ0; then the flow has to follow.
    run.advance((4.0 * h / speed + 2.0 * h * h / nu) as u64)?;
    let fields = run.fields();
    let along = |u: &[f64; 3]| u[0] * unit[0] + u[1] * unit[1] + u[2] * unit[2];
    let plug: Vec<f64> = (0..cells)
        .filter(|&j| from_middle(j, cells).abs() < 0.5 * h - 1.0)
        .map(|j| along(&fields.velocity[j]))
        .collect();
    let (least, most) = plug.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &u| (a.min(u), b.max(u)));
    let across = largest(fields.velocity.iter().map(|u| u[0] * unit[2] - u[2] * unit[0]));
    Ok(((most - least) / speed, across / speed))
}

/// Exploration.
pub const EXPLORE: Claim = Claim {
    id: "plug-explore",
    title: "x",
    tags: &["Y3"],
    measures: "x",
    reference: Reference { source: "x", uncertainty: 0.0 },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "U", short: &[0.0025, 0.005, 0.01, 0.02, 0.04], full: &[0.0025, 0.005, 0.01, 0.02, 0.04] },
    order: None::<OrderBand>,
    tolerance: Tolerance { value: 1.0, at: Rung::Last, because: "x" },
    kind: Kind::Verification,
    measure: |backend, speed| {
        for (d, cells, tau) in [([1.0, 0.0, 0.0], 32, 0.8), ([1.0, 0.0, 0.5], 32, 0.8), ([1.0, 0.0, 1.0], 32, 0.8), ([1.0, 0.0, 1.0], 16, 0.8), ([1.0, 0.0, 1.0], 32, 0.65)] {
            let (s, a) = channel_spread(backend, d, cells, tau, speed, WallRule::ViscosityIndependent)?;
            let re = speed * 0.5 * cells as f64 / ((tau - 0.5) / 3.0);
            let ma2 = 3.0 * speed * speed;
            eprintln!("U {speed} {d:?} N {cells} tau {tau} spread {s:.3e} across {a:.3e} over Ma2/Re {:.3}", s / (ma2 / re));
        }
        Ok(Sample::relative(speed, 1.0, 1.0))
    },
};
