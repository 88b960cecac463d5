//! Unyielded material held by walls and by a bed under a force: creep and ringing.
//!
//! The force is switched on at step 0, which sets an elastic wave ringing; what is left when it has
//! died is creep. Both are given in units of the half-way wall's creep 2θF/ρ \[K3\].

use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::collision::{CollisionChoice, OddRate};
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Face, Setup, SolidMotion, WallRule};
use lahar::solver::run::{Backend, Run};

/// Force per volume, lattice units: wall stresses near 1e-4, as in a scene of a few dozen cells.
const FORCE: f64 = 1e-5;
/// The default floor θ = τ⁻ − ½.
const THETA: f64 = 0.05;
/// Cells between the walls.
const WIDTH: usize = 12;
/// Yield stress over the largest stress the force needs.
const MARGIN: f64 = 1.3;

/// What holds the material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Hold {
    /// Two lattice-aligned walls normal to axis `b`, force along axis `a`.
    Walls(usize, usize),
    /// Staircase walls along the lattice direction (dx, dy), force along it and across.
    Oblique(i64, i64),
    /// A bed below and a mirror plane above, gravity tilted: three parts normal, one along.
    Bed,
}

/// Which cure for the creep is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Cure {
    wall: bool,
    source: bool,
}

const CURES: [(&str, Cure); 4] = [
    ("neither", Cure { wall: false, source: false }),
    ("wall rule [B3]", Cure { wall: true, source: false }),
    ("source [K6]", Cure { wall: false, source: true }),
    ("both", Cure { wall: true, source: true }),
];

fn setup(hold: Hold, theta: f64, cure: Cure) -> Setup {
    let mut setup = match hold {
        Hold::Walls(a, b) => walls(a, b),
        Hold::Oblique(dx, dy) => oblique(dx, dy),
        Hold::Bed => bed(),
    };
    setup.collision = CollisionChoice::CentralMoment(OddRate { floor: theta, ..OddRate::default() });
    setup.wall_rule = if cure.wall { WallRule::ViscosityIndependent } else { WallRule::HalfWay };
    setup.stress_source = cure.source;
    setup
}

fn solid(stress: f64) -> Law {
    Law::HerschelBulkley { sigma0: MARGIN * stress, k: 0.1, n: 0.5 }
}

fn walls(a: usize, b: usize) -> Setup {
    let mut extents = [1; 3];
    extents[b] = WIDTH;
    let mut setup = Setup::periodic(extents, solid(FORCE * WIDTH as f64 / 2.0));
    setup.faces[b] = [Face::NoSlip; 2];
    let mut force = [0.0; 3];
    force[a] = FORCE;
    setup.force = BodyForce::Constant(force);
    setup
}

/// A periodic box whose cells are solid in a band along (dx, dy): a channel with staircase walls.
fn oblique(dx: i64, dy: i64) -> Setup {
    let n = WIDTH;
    // The channel is at most n/√2 cells wide; twice that stress holds every slope in use.
    let mut setup = Setup::periodic([n, n, 1], solid(FORCE * n as f64));
    let band = |cell: usize| {
        let (x, y) = ((cell % n) as i64, (cell / n) as i64);
        (dx * y - dy * x).rem_euclid(n as i64) < n as i64 / 3
    };
    setup.solids = (0..n * n).map(|cell| u8::from(band(cell))).collect();
    setup.solid_motion = vec![SolidMotion::default()];
    let length = ((dx * dx + dy * dy) as f64).sqrt();
    let along = [dx as f64 / length, dy as f64 / length];
    setup.force = BodyForce::Constant([FORCE * (along[0] - along[1]), FORCE * (along[1] + along[0]), 0.0]);
    setup
}

fn bed() -> Setup {
    let mut setup = Setup::periodic([1, WIDTH, 1], solid(FORCE * WIDTH as f64));
    setup.faces[1] = [Face::NoSlip, Face::FreeSlip];
    setup.force = BodyForce::Constant([FORCE, -3.0 * FORCE, 0.0]);
    setup
}

/// Largest speed over the box, in units of 2θF/ρ with the default θ.
fn speed(run: &dyn Run) -> f64 {
    let fields = run.fields();
    let largest = fields.velocity.iter().flatten().fold(0.0_f64, |m, u| m.max(u.abs()));
    largest / (2.0 * THETA * FORCE)
}

/// Largest speed left after `steps`.
fn rest_speed(backend: &dyn Backend, setup: &Setup, steps: u64) -> Result<f64, VerifyError> {
    let mut run = backend.start(setup)?;
    run.advance(steps)?;
    Ok(speed(run.as_ref()))
}

/// The six pairs (force axis, wall axis), by rung number 1–6.
const PAIRS: [(usize, usize); 6] = [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)];

fn pair(rung: f64) -> Hold {
    let (a, b) = PAIRS[(rung as usize).clamp(1, 6) - 1];
    Hold::Walls(a, b)
}

/// Steps after which the elastic ringing has fallen below rounding: the slowest mode of twelve cells
/// loses a factor e every 1200 steps or so at θ = 0.05 (measured), 1e-21 in all.
const SETTLED: u64 = 60_000;

const DEFAULT: Cure = Cure { wall: true, source: false };

fn aligned(backend: &dyn Backend, rung: f64) -> Result<Sample, VerifyError> {
    let left = rest_speed(backend, &setup(pair(rung), THETA, DEFAULT), SETTLED)?;
    Ok(Sample::absolute(rung, left, 0.0))
}

fn staircase(backend: &dyn Backend, rung: f64) -> Result<Sample, VerifyError> {
    let hold = Hold::Oblique(rung as i64, 1);
    let left = rest_speed(backend, &setup(hold, THETA, DEFAULT), SETTLED)?;
    Ok(Sample::absolute(rung, left, 0.0))
}

fn half_way(backend: &dyn Backend, theta: f64) -> Result<Sample, VerifyError> {
    let cure = Cure { wall: false, source: false };
    let mut run = backend.start(&setup(Hold::Walls(0, 1), theta, cure))?;
    // The ringing decays in proportion to θ.
    run.advance((SETTLED as f64 * THETA / theta) as u64)?;
    let creep = run.fields().velocity[WIDTH / 2][0] / FORCE;
    Ok(Sample::relative(theta, creep, 2.0 * theta))
}

fn long_rest(backend: &dyn Backend, steps: f64) -> Result<Sample, VerifyError> {
    let left = rest_speed(backend, &setup(Hold::Bed, THETA, DEFAULT), steps as u64)?;
    Ok(Sample::absolute(steps, left, 0.0))
}

/// Rest between lattice-aligned walls.
pub const ALIGNED: Claim = Claim {
    id: "resting-layer-creep",
    title: "Unyielded material between aligned walls comes to rest in all six shear directions",
    tags: &["Y3", "K3", "B3"],
    measures: "largest speed left, over the half-way wall's creep 2θF/ρ (θ = 0.05)",
    reference: Reference { source: "a rigid body held by walls does not move", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "pair (force, wall): 1 xy, 2 xz, 3 yx, 4 yz, 5 zx, 6 zy",
        short: &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0],
        full: &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 1e-10,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "rounding: stresses of 1e-4 carry 1e-20 of noise, 1e-14 of the creep unit 1e-6, fed \
                  back over some 1/θ steps per reflection; what is left of the ringing is below 1e-12",
    },
    kind: Kind::Verification,
    measure: aligned,
};

/// Rest between staircase walls.
pub const OBLIQUE: Claim = Claim {
    id: "resting-layer-oblique",
    title: "Unyielded material between staircase walls comes to rest",
    tags: &["Y3", "K3", "B3"],
    measures: "largest speed left, over 2θF/ρ (θ = 0.05)",
    reference: Reference { source: "a rigid body held by walls does not move", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "slope of the walls, cells along x per cell up",
        short: &[1.0],
        full: &[1.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 1e-6,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "as for aligned walls, with an allowance of 1e4 for the stress field at the steps, \
                  which is not linear in the distance from the wall",
    },
    kind: Kind::Verification,
    measure: staircase,
};

/// The creep of the plain half-way wall.
pub const HALF_WAY: Claim = Claim {
    id: "resting-layer-half-way",
    title: "With plain half-way walls an unyielded layer creeps at 2θF/ρ",
    tags: &["K3", "B1"],
    measures: "creep velocity over F/ρ",
    reference: Reference {
        source: "2θ, from the steady link equation with ω⁺ = 0 (REFERENCES §1 with τ⁺ → ∞)",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "θ", short: &[0.05, 0.2], full: &[0.01, 0.05, 0.2] },
    order: None,
    tolerance: Tolerance {
        value: 6e-5,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "corrections of relative order σ/ρ, and the wall stress is 6e-5 in lattice units",
    },
    kind: Kind::PredictedFailure,
    measure: half_way,
};

/// A layer on a bed over many steps.
pub const BED: Claim = Claim {
    id: "resting-layer-bed",
    title: "A layer resting on a bed under tilted gravity neither creeps nor rings up",
    tags: &["Y3", "K3", "B2", "B3"],
    measures: "largest speed left, over 2θF/ρ (θ = 0.05)",
    reference: Reference { source: "a rigid layer below yield does not move", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "steps", short: &[1e5], full: &[1e5, 1e6] },
    order: None,
    tolerance: Tolerance {
        value: 1e-2,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "the bed cell yields while the load settles and returns to rest algebraically in \
                  time (n = 0.5): 1 % of the half-way creep at 1e5 steps, falling",
    },
    kind: Kind::Verification,
    measure: long_rest,
};

/// Creep and ringing for every hold, θ and cure.
pub const CURES_TABLE: Exhibit = Exhibit {
    id: "resting-layer-cures",
    caption: "Unyielded material under a force F: largest speed left, over F/ρ, after the given number \
              of steps. A θ of zero rings undamped; half-way walls creep at 2θ where they are aligned \
              with the grid. The wall rule [B3] rests on aligned and on 1:1 walls and cuts the creep on \
              other staircases to a quarter; the source [K6] rests on aligned walls and makes most \
              staircases worse. [B3] with θ = 0.05 is therefore the default.",
    timed: false,
    run: cures_table,
};

fn cures_table(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let holds = [
        ("walls, xy", Hold::Walls(0, 1)),
        ("bed, tilted gravity", Hold::Bed),
        ("staircase 1:1", Hold::Oblique(1, 1)),
        ("staircase 2:1", Hold::Oblique(2, 1)),
        ("staircase 3:1", Hold::Oblique(3, 1)),
    ];
    let thetas: &[f64] = if full { &[0.0, 0.01, 0.05, 0.2] } else { &[0.0, 0.05, 0.2] };
    let mut columns = vec!["held by", "theta", "cure", "1e3 steps", "1e4 steps", "3e4 steps"];
    if full {
        columns.extend(["1e5 steps", "1e6 steps (aligned)"]);
    }
    let mut table = Table::new("Largest speed over F/ρ", &columns);
    for (name, hold) in holds {
        for &theta in thetas {
            for (cure_name, cure) in CURES {
                let mut row = vec![name.into(), theta.into(), cure_name.into()];
                let checkpoints: &[u64] = match (full, hold) {
                    (false, _) => &[1_000, 10_000, 30_000],
                    (true, Hold::Oblique(..)) => &[1_000, 10_000, 30_000, 100_000],
                    (true, _) => &[1_000, 10_000, 30_000, 100_000, 1_000_000],
                };
                let mut run = backend.start(&setup(hold, theta, cure))?;
                for &steps in checkpoints {
                    let entry = match run.advance(steps - run.step()) {
                        Ok(()) => (speed(run.as_ref()) * 2.0 * THETA).into(),
                        Err(stopped) => format!("stopped at step {}", stopped.step).into(),
                    };
                    row.push(entry);
                }
                row.resize(columns.len(), "".into());
                table.push(row);
            }
        }
    }
    Ok(ExhibitData { tables: vec![table], ..ExhibitData::default() })
}
