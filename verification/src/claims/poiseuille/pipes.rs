//! Round pipes, one cell long, their walls on stairs \[B1\] or in their place \[B4\].

use std::sync::Arc;

use super::channel::{BINGHAM, Steady, THESIS, run_steady};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::exact::flow_curve::FlowCurve;
use crate::exact::pipe::Pipe;
use crate::exhibit::{Entry, Exhibit, ExhibitData, Table};
use lahar::boundary::cut::cut_cells;
use lahar::rheology::Law;
use lahar::setup::{BodyForce, FlowPoint, Setup, SolidMotion, WallRule};
use lahar::solver::run::Backend;

/// How a round wall is made of cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Surface {
    /// Half-way between cells \[B1\].
    Stairs,
    /// In its place \[B4\].
    Cut,
}

/// A round pipe along x of radius R cells, driven at wall stress 1 of `law`.
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
    /// How the wall is made of cells.
    pub surface: Surface,
}

impl RoundPipe {
    /// `law` in units of radius 1 and wall stress 1; `viscosity` and `speed` as for the channels.
    pub fn new(radius: f64, law: &Law, viscosity: f64, speed: f64, wall: WallRule) -> Self {
        let fastest = Pipe { law: *law, radius: 1.0, force: 2.0 }.plug_velocity();
        let rate = speed / (fastest * radius);
        let scale = super::channel::Scale { n: 0, rate, stress: viscosity * rate };
        Self {
            radius,
            law: scale.law(law),
            force: 2.0 * scale.stress / radius,
            wall,
            surface: Surface::Stairs,
        }
    }

    /// The same with another surface.
    pub fn with(self, surface: Surface) -> Self {
        Self { surface, ..self }
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
        if self.surface != Surface::Stairs {
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

const STAIRS: Ladder =
    Ladder { parameter: "R (cells)", short: &[6.0, 10.0, 14.0], full: &[6.0, 10.0, 14.0, 20.0, 30.0, 44.0] };
const CUT: Ladder =
    Ladder { parameter: "R (cells)", short: &[6.0, 8.0, 12.0], full: &[6.0, 8.0, 12.0, 24.0] };

/// A fluid in pipes: law for radius and wall stress 1, and Δt/Δx² with it.
struct Fluid {
    law: Law,
    viscosity: f64,
}

const NEWTONIAN: Fluid = Fluid { law: Law::Newtonian { mu: 0.2 }, viscosity: 1.0 / 1.2 };
const PLASTIC: Fluid = Fluid { law: BINGHAM, viscosity: 0.5 };
const THINNING: Fluid = Fluid { law: THESIS, viscosity: 0.5 };

/// Root mean square of the relative L2 error over R, R + ¼, R + ½, R + ¾: how the cells lie in the circle is chance.
fn over_quarters(
    backend: &dyn Backend,
    radius: f64,
    surface: Surface,
    fluid: &Fluid,
) -> Result<Sample, VerifyError> {
    let wall = match surface {
        Surface::Stairs => WallRule::HalfWay,
        Surface::Cut => WallRule::ViscosityIndependent,
    };
    let pipe = |r| RoundPipe::new(r, &fluid.law, fluid.viscosity, 0.01, wall).with(surface).measure(backend);
    let mut sample = pipe(radius)?;
    let alone = sample.error;
    let mut squares = alone * alone;
    for quarter in [0.25, 0.5, 0.75] {
        let error = pipe(radius + quarter)?.error;
        squares += error * error;
    }
    sample.error = (0.25 * squares).sqrt();
    Ok(sample.with("error at R alone", alone))
}

/// Newtonian pipe on stairs.
pub const PIPE: Claim = Claim {
    id: "pipe-newtonian",
    title: "Newtonian pipe flow on a staircase of cells converges at first order",
    tags: &["K3", "B1", "L5"],
    measures: "root mean square over the radii R, R + ¼, R + ½, R + ¾ of the relative L2 error; half-way walls, τ = 1",
    reference: Reference { source: "u = G(R² − r²)/(4μ) (Hagen-Poiseuille)", uncertainty: 0.0 },
    metric: Metric::L2,
    ladder: STAIRS,
    order: Some(OrderBand { expected: 1.0, band: 0.4, at_least: true }),
    tolerance: Tolerance {
        value: 0.072,
        at: Rung::At(14.0),
        basis: Basis::Derived,
        because: "a wall displaced by δ changes u by Gδ R/(2μ), 2√3 δ/R of its root mean square; δ lies anywhere within half a cell, \
                  0.29 in root mean square, which makes 1/R",
    },
    kind: Kind::Verification,
    measure: |backend, radius| over_quarters(backend, radius, Surface::Stairs, &NEWTONIAN),
};

/// Bingham pipe on stairs.
pub const PIPE_BINGHAM: Claim = Claim {
    id: "pipe-bingham",
    title: "In a Bingham pipe on a staircase of cells the error is at most 1.8/R",
    tags: &["Y3", "K3", "B1"],
    measures: "root mean square over the radii R, R + ¼, R + ½, R + ¾ of the relative L2 error; half-way walls, plug half of the radius, Δt/Δx² = 0.5",
    reference: Reference { source: "Buckingham 1921, Reiner 1926", uncertainty: 0.0 },
    tolerance: Tolerance {
        value: 0.127,
        at: Rung::At(14.0),
        basis: Basis::Derived,
        because: "as `pipe-newtonian`: 0.29 cells of wall displacement times the wall shear rate 2.5 (wall stress and radius 1), \
                  over the root mean square velocity 0.65·0.625, make 1.78/R",
    },
    measure: |backend, radius| over_quarters(backend, radius, Surface::Stairs, &PLASTIC),
    ..PIPE
};

/// Herschel-Bulkley pipe on stairs.
pub const PIPE_HB: Claim = Claim {
    id: "pipe-herschel-bulkley",
    title: "In a Herschel-Bulkley pipe (n = 0.33) on a staircase of cells the error is at most 3.3/R",
    reference: Reference { source: "Q = (8π/G³)∫σ²γ̇ dσ (Rabinowitsch 1929)", uncertainty: 0.0 },
    order: None,
    tolerance: Tolerance {
        value: 0.238,
        at: Rung::At(14.0),
        basis: Basis::Derived,
        because: "as `pipe-newtonian`: 0.29 cells of wall displacement times the wall shear rate 16.06, over the root mean square \
                  velocity 0.7·1.993, make 3.33/R",
    },
    measure: |backend, radius| over_quarters(backend, radius, Surface::Stairs, &THINNING),
    ..PIPE_BINGHAM
};

/// Newtonian pipe in its place.
pub const CUT_PIPE: Claim = Claim {
    id: "pipe-newtonian-cut",
    title: "Newtonian pipe flow within a wall at its true place converges at second order",
    tags: &["K3", "B4", "L5"],
    measures: "root mean square over the radii R, R + ¼, R + ½, R + ¾ of the relative L2 error; τ = 1",
    reference: Reference { source: "u = G(R² − r²)/(4μ) (Hagen-Poiseuille)", uncertainty: 0.0 },
    metric: Metric::L2,
    ladder: CUT,
    order: Some(OrderBand { expected: 2.0, band: 0.3, at_least: true }),
    tolerance: Tolerance {
        value: 0.03,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "a link that is cut at q sees the curvature G/(2μ) times Λ = 3/16 to ¾ q², off by less than 9/16 of \
                  ½(G/2μ); over the root mean square GR²/(4√3 μ) of u that is 0.98/R², 0.027 at R = 6",
    },
    kind: Kind::Verification,
    measure: |backend, radius| over_quarters(backend, radius, Surface::Cut, &NEWTONIAN),
};

/// Bingham pipe in its place.
pub const CUT_PIPE_BINGHAM: Claim = Claim {
    id: "pipe-bingham-cut",
    title: "In a Bingham pipe within a wall at its true place the error is of second order",
    tags: &["Y3", "K3", "B4"],
    measures: "root mean square over the radii R, R + ¼, R + ½, R + ¾ of the relative L2 error; plug half of the radius, Δt/Δx² = 0.5",
    reference: Reference { source: "Buckingham 1921, Reiner 1926", uncertainty: 0.0 },
    tolerance: Tolerance {
        value: 0.06,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "4.1 % at R = 6, and half as much on top; the bend of the rate that links miss over their length makes 3.5/R²",
    },
    measure: |backend, radius| over_quarters(backend, radius, Surface::Cut, &PLASTIC),
    ..CUT_PIPE
};

/// Herschel-Bulkley pipe in its place.
pub const CUT_PIPE_HB: Claim = Claim {
    id: "pipe-herschel-bulkley-cut",
    title: "In a Herschel-Bulkley pipe (n = 0.33) within a wall at its true place the error is below 20 % from R = 6 on",
    reference: Reference { source: "Q = (8π/G³)∫σ²γ̇ dσ (Rabinowitsch 1929)", uncertainty: 0.0 },
    order: None,
    tolerance: Tolerance {
        value: 0.2,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "17 % at R = 6 (stairs 31), and a fifth on top; 4 % at R = 12",
    },
    measure: |backend, radius| over_quarters(backend, radius, Surface::Cut, &THINNING),
    ..CUT_PIPE_BINGHAM
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
