//! Square ducts and round pipes, one cell long.

use std::sync::Arc;

use super::channel::{BINGHAM, Steady, THESIS, run_steady};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::exact::duct::RectangularDuct;
use crate::exact::flow_curve::FlowCurve;
use crate::exact::pipe::Pipe;
use crate::exhibit::{Entry, Exhibit, ExhibitData, Table};
use lahar::boundary::cut::cut_cells;
use lahar::collision::{CollisionChoice, OddRate};
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Face, FlowPoint, Setup, SolidMotion, WallRule};
use lahar::solver::run::Backend;

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

/// A round pipe along x of radius R cells on a staircase, driven at wall stress 1 of `law`.
#[derive(Clone, Copy, Debug)]
pub struct RoundPipe {
    /// R in cells.
    pub radius: f64,
    /// The law, lattice units.
    pub law: Law,
    /// Body force.
    pub force: f64,
    /// Wall rule.
    pub wall: WallRule,
    /// Whether the wall lies in its place; on a staircase if not.
    pub cut: bool,
}

impl RoundPipe {
    /// `law` in units of radius 1 and wall stress 1; `viscosity` and `speed` as for the channels.
    pub fn new(radius: f64, law: &Law, viscosity: f64, speed: f64, wall: WallRule) -> Self {
        let fastest = Pipe { law: *law, radius: 1.0, force: 2.0 }.plug_velocity();
        let rate = speed / (fastest * radius);
        let scale = super::channel::Scale { n: 0, rate, stress: viscosity * rate };
        Self { radius, law: scale.law(law), force: 2.0 * scale.stress / radius, wall, cut: false }
    }

    /// The same with its wall in its place \[B4\].
    pub fn cut(self) -> Self {
        Self { cut: true, ..self }
    }

    /// The exact flow.
    pub fn exact(&self) -> Pipe<Law> {
        Pipe { law: self.law, radius: self.radius, force: self.force }
    }

    fn cells(&self) -> usize {
        2 * self.radius.ceil() as usize + 2
    }

    /// Distance of a cell's centre from the axis.
    fn offset(&self, [_, j, k]: [usize; 3]) -> [f64; 2] {
        let middle = 0.5 * self.cells() as f64;
        [j as f64 + 0.5 - middle, k as f64 + 0.5 - middle]
    }

    /// The set-up, started from the exact flow.
    pub fn setup(&self) -> Setup {
        let pipe = *self;
        let m = self.cells();
        let mut setup = Setup::periodic([1, m, m], self.law);
        setup.wall_rule = self.wall;
        setup.force = BodyForce::Constant([self.force, 0.0, 0.0]);
        setup.solid_motion = vec![SolidMotion::default()];
        let outside = |cell: usize| pipe.distance(setup.coordinates(cell)) > pipe.radius;
        setup.solids = (0..setup.cells()).map(|cell| u8::from(outside(cell))).collect();
        if self.cut {
            let middle = 0.5 * m as f64;
            let outside = |[_, y, z]: [f64; 3]| {
                let (y, z) = (y - middle, z - middle);
                (y * y + z * z).sqrt() > pipe.radius
            };
            setup.cuts = cut_cells(&setup, outside).into();
        }
        setup.initial = Some(Arc::new(move |at| {
            let ([y, z], r) = (pipe.offset(at), pipe.distance(at));
            let exact = pipe.exact();
            let rate = -exact.law.rate(exact.stress(r));
            let gradient = if r > 0.0 { [0.0, rate * y / r, rate * z / r] } else { [0.0; 3] };
            FlowPoint {
                density: 1.0,
                velocity: [exact.velocity(r), 0.0, 0.0],
                gradient: [gradient, [0.0; 3], [0.0; 3]],
            }
        }));
        setup
    }

    fn distance(&self, at: [usize; 3]) -> f64 {
        let [y, z] = self.offset(at);
        (y * y + z * z).sqrt()
    }

    /// Runs to the steady state and compares with the exact flow.
    pub fn measure(&self, backend: &dyn Backend) -> Result<Sample, VerifyError> {
        let setup = self.setup();
        let exact = self.exact();
        let relaxation = self.radius * self.radius * exact.law.rate_slope(exact.wall_stress()) / 5.8;
        let interval = (0.1 * relaxation).max(20.0) as u64;
        let steady = run_steady(backend, &setup, 1e-5, interval, 400 * interval)?;
        let fluid = |cell: &usize| !setup.is_solid(*cell);
        let computed: Vec<f64> =
            (0..setup.cells()).filter(fluid).map(|cell| steady.fields.velocity[cell][0]).collect();
        let reference: Vec<f64> = (0..setup.cells())
            .filter(fluid)
            .map(|cell| exact.velocity(self.distance(setup.coordinates(cell))))
            .collect();
        let flux = computed.iter().sum::<f64>() / exact.flow_rate();
        Ok(Sample::l2(self.radius, &computed, &reference)
            .with("flux / exact", flux)
            .with("largest velocity / exact", self.fastest(&steady) / exact.plug_velocity())
            .with("steps", steady.steps as f64))
    }

    fn fastest(&self, steady: &Steady) -> f64 {
        steady.velocity(0).into_iter().fold(0.0, |a, b| if b > a || b.is_nan() { b } else { a })
    }
}

const RADII: Ladder =
    Ladder { parameter: "R (cells)", short: &[6.0, 10.0, 14.0], full: &[6.0, 10.0, 14.0, 20.0, 30.0, 44.0] };

/// L2 error times R: constant if the staircase displaces the wall by a fixed part of a cell.
fn scaled(backend: &dyn Backend, pipe: &RoundPipe) -> Result<Sample, VerifyError> {
    let mut sample = pipe.measure(backend)?;
    let plain = sample.error;
    sample.error *= pipe.radius;
    Ok(sample.with("relative L2 error", plain))
}

/// Newtonian pipe, mean over four radii.
pub const PIPE: Claim = Claim {
    id: "pipe-newtonian",
    title: "Newtonian pipe flow on a staircase of cells converges at first order",
    tags: &["K3", "B1", "L5"],
    measures: "root mean square over the radii R, R + ¼, R + ½, R + ¾ of the relative L2 error; half-way walls, τ = 1",
    reference: Reference { source: "u = G(R² − r²)/(4μ) (Hagen-Poiseuille)", uncertainty: 0.0 },
    metric: Metric::L2,
    ladder: RADII,
    order: Some(OrderBand { expected: 1.0, band: 0.4, at_least: true }),
    tolerance: Tolerance {
        value: 0.29,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "a wall displaced by δ changes u by Gδ R/(2μ), 2√3 δ/R of its root mean square; δ is half a cell at most, \
                  1.73/R = 0.29 at R = 6, and about a tenth of one on average",
    },
    kind: Kind::Verification,
    measure: |backend, radius| {
        let law = Law::Newtonian { mu: 0.2 };
        let mut squares = 0.0;
        for quarter in 0..4 {
            let r = radius + 0.25 * f64::from(quarter);
            let error = RoundPipe::new(r, &law, 1.0 / 1.2, 0.01, WallRule::HalfWay).measure(backend)?.error;
            squares += 0.25 * error * error;
        }
        let mut sample = RoundPipe::new(radius, &law, 1.0 / 1.2, 0.01, WallRule::HalfWay).measure(backend)?;
        let alone = sample.error;
        sample.error = squares.sqrt();
        Ok(sample.with("error at R alone", alone))
    },
};

/// Bingham pipe.
pub const PIPE_BINGHAM: Claim = Claim {
    id: "pipe-bingham",
    title: "In a Bingham pipe on a staircase of cells the error is at most 3.1/R: 12 % at R = 6, 3 % at 14",
    tags: &["Y3", "K3", "B1"],
    measures: "relative L2 error of the velocity times R in cells, half-way walls, plug half of the radius, Δt/Δx² = 0.5",
    reference: Reference { source: "Buckingham 1921, Reiner 1926", uncertainty: 0.0 },
    metric: Metric::L2,
    ladder: RADII,
    order: None,
    tolerance: Tolerance {
        value: 3.1,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "first order: half a cell of wall displacement times the wall shear rate 2.5 (wall stress and radius 1), \
                  over the root mean square velocity 0.65·0.625",
    },
    kind: Kind::Verification,
    measure: |backend, radius| {
        scaled(backend, &RoundPipe::new(radius, &BINGHAM, 0.5, 0.01, WallRule::HalfWay))
    },
};

/// Herschel-Bulkley pipe.
pub const PIPE_HB: Claim = Claim {
    id: "pipe-herschel-bulkley",
    title: "In a Herschel-Bulkley pipe (n = 0.33) on a staircase of cells the error is at most 5.8/R: 32 % at R = 6, 2.5 % at 44",
    tags: &["Y3", "K3", "B1"],
    measures: "relative L2 error of the velocity times R in cells, half-way walls, plug half of the radius, Δt/Δx² = 2",
    reference: Reference { source: "Q = (8π/G³)∫σ²γ̇ dσ (Rabinowitsch 1929)", uncertainty: 0.0 },
    metric: Metric::L2,
    ladder: RADII,
    order: None,
    tolerance: Tolerance {
        value: 5.8,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "first order: half a cell of wall displacement times the wall shear rate 16.06, over the root mean square \
                  velocity 0.7·1.993",
    },
    kind: Kind::Verification,
    measure: |backend, radius| {
        scaled(backend, &RoundPipe::new(radius, &THESIS, 2.0, 0.01, WallRule::HalfWay))
    },
};

/// What the wall rule does on a staircase.
pub const STAIRCASE: Exhibit = Exhibit {
    id: "pipe-wall-rules",
    caption: "Round pipes with half-way and with viscosity-independent walls: the staircase decides the order, the wall rule the size of the error.",
    timed: false,
    run: |backend, full| {
        let columns =
            ["fluid", "R [cells]", "half-way: L2 error", "flux / exact", "[B3]: L2 error", "flux / exact"];
        let mut table = Table::new("Wall rules on a staircase", &columns);
        let radii: &[f64] = if full { &[6.0, 10.0, 14.0, 20.0, 30.0] } else { &[6.0, 10.0] };
        for (name, law, viscosity) in [
            ("Newtonian", Law::Newtonian { mu: 0.2 }, 1.0 / 1.2),
            ("Bingham", BINGHAM, 0.5),
            ("HB n = 0.33", THESIS, 2.0),
        ] {
            for &radius in radii {
                let mut row: Vec<Entry> = vec![name.into(), radius.into()];
                for wall in [WallRule::HalfWay, WallRule::ViscosityIndependent] {
                    match RoundPipe::new(radius, &law, viscosity, 0.01, wall).measure(backend) {
                        Ok(sample) => {
                            row.push(sample.error.into());
                            row.push(sample.extra.get("flux / exact").copied().unwrap_or(f64::NAN).into());
                        }
                        Err(VerifyError::NotSteady { .. }) => row.extend(["not steady".into(), "".into()]),
                        Err(error) => return Err(error),
                    }
                }
                table.push(row);
            }
        }
        Ok(ExhibitData { tables: vec![table], ..ExhibitData::default() })
    },
};
