//! Rigid plugs that move obliquely to the grid: D3Q19 has no xyz moment.

use std::sync::Arc;

use super::support::{from_middle, largest};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::exact::flow_curve::FlowCurve;
use crate::exact::poiseuille::Channel;
use lahar::rheology::Law;
use lahar::setup::{BodyForce, FlowPoint, Setup, WallRule};
use lahar::solver::run::Backend;

/// A Bingham channel, walls normal to y, driven along `direction` (x and z components); the plug is
/// half as wide as the channel.
#[derive(Clone, Copy, Debug)]
pub struct Oblique {
    pub direction: [f64; 3],
    pub cells: usize,
    pub tau: f64,
    /// Plug speed U, lattice units.
    pub speed: f64,
}

/// What is seen in the plug, less a cell on either side.
#[derive(Clone, Debug)]
pub struct Plug {
    /// u(0) − u(y) over U, at every cell.
    pub lag: Vec<f64>,
    /// u(0) − u(y) over U, as the missing moment predicts it at every cell.
    pub predicted: Vec<f64>,
    /// σ0/(ρ c_s²), the elastic strain at yield: twice n_x n_z of it is predicted for the whole plug.
    pub strain: f64,
}

impl Oblique {
    fn unit(&self) -> [f64; 3] {
        let length = (self.direction.iter().map(|d| d * d).sum::<f64>()).sqrt();
        self.direction.map(|d| d / length)
    }

    /// Starts from the exact flow and runs until the spurious stress has had time to reach σ0 and the
    /// flow to follow.
    pub fn run(&self, backend: &dyn Backend) -> Result<Plug, VerifyError> {
        let (cells, unit) = (self.cells, self.unit());
        let nu = (self.tau - 0.5) / 3.0;
        let h = 0.5 * cells as f64;
        // Plug speed Gh²/8μ where the plug is half as wide as the channel.
        let force = 8.0 * nu * self.speed / (h * h);
        let sigma0 = 0.5 * force * h;
        let law = Law::Bingham { sigma0, mu: nu };
        let flow = Channel { law, half_width: h, force };
        let mut setup = Setup::channel(cells, law, 0.0);
        setup.force = BodyForce::Constant(unit.map(|d| d * force));
        setup.wall_rule = WallRule::ViscosityIndependent;
        setup.initial = Some(Arc::new(move |[_, j, _]| {
            let y = from_middle(j, cells);
            let (u, rate) = (flow.velocity(y), -law.rate(force * y.abs()) * y.signum());
            let gradient = std::array::from_fn(|a| [0.0, unit[a] * rate, 0.0]);
            FlowPoint { density: 1.0, velocity: unit.map(|d| d * u), gradient }
        }));
        let mut run = backend.start(&setup)?;
        run.advance((4.0 * h / self.speed + 2.0 * h * h / nu) as u64)?;
        let fields = run.fields();
        let along = |j: usize| {
            let u = fields.velocity[j];
            (u[0] * unit[0] + u[1] * unit[1]) + u[2] * unit[2]
        };
        let half_plug = 0.5 * h;
        let inside = |j: &usize| from_middle(*j, cells).abs() < half_plug - 1.0;
        let shape = |j: usize| {
            let part = from_middle(j, cells) / half_plug;
            1.0 - (1.0 - part * part).sqrt()
        };
        let middle = cells / 2;
        let scale = 6.0 * unit[0] * unit[2] * sigma0;
        Ok(Plug {
            lag: (0..cells).filter(inside).map(|j| (along(middle) - along(j)) / self.speed).collect(),
            predicted: (0..cells).filter(inside).map(|j| scale * (shape(j) - shape(middle))).collect(),
            strain: 3.0 * sigma0,
        })
    }
}

fn oblique(backend: &dyn Backend, direction: [f64; 3], speed: f64) -> Result<Sample, VerifyError> {
    let case = Oblique { direction, cells: 32, tau: 0.8, speed };
    let plug = case.run(backend)?;
    let reynolds = speed * 16.0 / 0.1;
    Ok(Sample::linf(speed, &plug.lag, &plug.predicted)
        .with("spread / U [-]", largest(plug.lag.iter().copied()))
        .with("Ma2/Re [-]", 3.0 * speed * speed / reynolds)
        .with("yield stress / (rho c_s2) [-]", plug.strain))
}

/// Direction (1, 0, 1).
pub const DIAGONAL: Claim = claim(
    "plug-oblique-101",
    "A plug that moves along (1,0,1) shears by sigma0/(rho c_s^2) of its speed, as the missing xyz moment predicts.",
    |backend, speed| oblique(backend, [1.0, 0.0, 1.0], speed),
);
/// Direction (1, 0, ½).
pub const SKEW: Claim = claim(
    "plug-oblique-102",
    "A plug that moves along (1,0,1/2) shears by 4/5 of sigma0/(rho c_s^2) of its speed.",
    |backend, speed| oblique(backend, [1.0, 0.0, 0.5], speed),
);

const fn claim(
    id: &'static str,
    title: &'static str,
    measure: fn(&dyn Backend, f64) -> Result<Sample, VerifyError>,
) -> Claim {
    Claim {
        id,
        title,
        tags: &["K3", "Y3", "L2"],
        measures: "u(0) - u(y) inside the plug, largest difference over the largest",
        reference: Reference {
            source: "stress balance in the plug: the missing moment feeds Q_xz at the rate U (n_x F_z + n_z F_x); \
                     u(0) - u(y) = 6 n_x n_z U sigma0 (1 - sqrt(1 - (y/h_p)^2))",
            uncertainty: 0.0,
        },
        metric: Metric::LInf,
        ladder: Ladder {
            parameter: "U (lattice units)",
            short: &[0.005, 0.01, 0.02],
            full: &[0.0025, 0.005, 0.01, 0.02, 0.04],
        },
        order: None::<OrderBand>,
        tolerance: Tolerance {
            value: 1.0 / 64.0,
            at: Rung::Every,
            basis: Basis::AfterSeeing,
            because: "second order in the 8 cells of half a plug",
        },
        kind: Kind::PredictedFailure,
        measure,
    }
}
