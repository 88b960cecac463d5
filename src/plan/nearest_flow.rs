//! Which flow of the table of work and precision a scene is nearest to.

use super::cells::Cells;
use super::facts::Facts;
use super::lower::operator;
use super::numbers::Numbers;
use super::surface::Pool;
use super::text::short;
use crate::plan::work::{Case, Operator, Scheme, Walls};
use crate::rheology::Law;
use crate::scene::{BodyForce, Boundary, InitialVelocity, Operator as SceneOperator, YieldChoice};
use crate::setup::{Setup, WallRule};

/// Flow index of the flows of the table.
const FLOW_INDEX: f64 = 0.33;

/// Kind of law, as far as the table tells them apart.
#[derive(Clone, Copy, PartialEq)]
enum Fluid {
    Newtonian,
    Bingham,
    HerschelBulkley,
}

fn fluid(law: &Law) -> Result<Fluid, String> {
    match law {
        Law::Newtonian { .. } => Ok(Fluid::Newtonian),
        Law::Bingham { .. } => Ok(Fluid::Bingham),
        Law::HerschelBulkley { .. } => Ok(Fluid::HerschelBulkley),
        // The table is what was measured; it has these three, and says so of any other.
        other => Err(format!("no flow of the table has a {}", other.name())),
    }
}

/// How the flow index differs from that of a flow of the table.
fn index_difference(law: &Law, case: Case) -> Option<String> {
    let of_power = matches!(case, Case::ChannelHerschelBulkley | Case::FilmHerschelBulkley);
    match *law {
        Law::HerschelBulkley { n, .. } if of_power && (n - FLOW_INDEX).abs() > 0.1 => {
            Some(format!("its flow index is {FLOW_INDEX}, not {n}"))
        }
        _ => None,
    }
}

/// The nearest flow of the table.
pub(super) struct Nearest {
    pub case: Case,
    /// Cells that count.
    pub along: f64,
    /// How it differs from the scene, where errors are alike nevertheless.
    pub differences: Vec<String>,
}

/// The nearest flow; why there is none, or why its errors are not those of the scene.
pub(super) fn case_of(facts: &Facts, numbers: &Numbers, cells: &Cells) -> Result<Nearest, String> {
    let scene = facts.scene;
    let (mut differences, mut beyond) = (Vec::new(), Vec::new());
    let fluid = fluid(&facts.laws[0])?;
    if scene.grains.is_some() {
        return Err("the scene has grains, and no flow of the table".to_owned());
    }
    if !scene.layers.is_empty() {
        return Err("the scene has several fluids, the flows of the table one".to_owned());
    }
    if facts.faces.iter().flatten().any(|b| matches!(b, Boundary::MovingWall { .. }))
        || scene.solids.iter().any(|s| s.velocity_m_per_s != [0.0; 3] || s.spin_rad_per_s != [0.0; 3])
    {
        return Err("walls drive the scene, and no flow of the table".to_owned());
    }
    if scene.fluid.body_force.is_some_and(|force| !matches!(force, BodyForce::Constant { .. })) {
        return Err("the force changes with time, and in no flow of the table".to_owned());
    }
    let (case, along) = if let Some(depth) = numbers.depth_cells {
        (surface_case(facts, cells, fluid, &mut beyond)?, depth)
    } else if numbers.gap_cells.is_finite() {
        (channel_case(facts, fluid)?, numbers.gap_cells)
    } else {
        (Case::Vortex, wave(facts, numbers, fluid, &mut differences)?)
    };
    beyond.extend(index_difference(&facts.laws[0], case));
    if !beyond.is_empty() {
        let (name, but) = (case.name(), beyond.join(", and "));
        return Err(format!("outside of the table: its nearest flow is `{name}`, but {but}"));
    }
    Ok(Nearest { case, along, differences })
}

fn surface_case(
    facts: &Facts,
    cells: &Cells,
    fluid: Fluid,
    beyond: &mut Vec<String>,
) -> Result<Case, String> {
    let (scene, closed, force) = (facts.scene, facts.closed, facts.forces.extremes[0]);
    let Some(pool) = &cells.pool else { return Err("the scene has no fluid".to_owned()) };
    if pool.fall > 0.0 {
        return Err("the fluid falls through air, and in no flow of the table".to_owned());
    }
    let along = |a: usize| a != pool.up.index() && force[a] != 0.0;
    if pool.level && scene.solids.is_empty() && !(0..3).any(|a| along(a) && closed[a]) {
        if !(0..3).any(along) {
            return Err("nothing drives the fluid, which lies level".to_owned());
        }
        let walls = |a: usize| a != pool.up.index() && facts.faces[a].contains(&Boundary::NoSlip);
        if (0..3).any(walls) {
            beyond.push("it has no walls beside it".to_owned());
        }
        return Ok(match fluid {
            Fluid::Newtonian => Case::FilmNewtonian,
            Fluid::Bingham => Case::FilmBingham,
            Fluid::HerschelBulkley => Case::FilmHerschelBulkley,
        });
    }
    if !scene.solids.is_empty() {
        beyond.push("it has no solids".to_owned());
    }
    if (0..3).any(along) {
        beyond.push("its floor is horizontal".to_owned());
    }
    beyond.extend(shape_difference(pool, fluid));
    beyond.extend(yield_difference(facts, pool));
    Ok(match fluid {
        Fluid::Newtonian => Case::DamBreak,
        Fluid::Bingham => Case::Slump,
        Fluid::HerschelBulkley => {
            beyond.push("its fluid is a Bingham fluid".to_owned());
            Case::Slump
        }
    })
}

/// Length over height of the block of the table's dam break, and diameter over height of its heap.
const LENGTHS: [f64; 2] = [4.0, 7.0];
/// σ0/(ρgH) of the heap.
const YIELD: f64 = 0.025;
/// Factor within which a scene is like the table's flow: the error of a spread goes with the cells that it is deep at the end,
/// which both numbers decide.
const ALIKE: f64 = 1.5;

fn alike(a: f64, b: f64) -> bool {
    (1.0 / ALIKE..=ALIKE).contains(&(a / b))
}

/// How the proportions of what is let go differ from those of the table.
fn shape_difference(pool: &Pool, fluid: Fluid) -> Option<String> {
    let [dam, heap] = LENGTHS;
    let wanted = if fluid == Fluid::Newtonian { dam } else { heap };
    let longest = (0..3).filter(|&a| a != pool.up.index()).map(|a| pool.runs[a]).fold(0.0, f64::max);
    // A quarter or half of it may stand at mirrors.
    let found = [1.0, 2.0].map(|whole| whole * longest / pool.depth);
    let differs = !found.iter().any(|&found| alike(found, wanted));
    let (longest, wanted) = (short(found[0]), short(wanted));
    differs.then(|| format!("it is {wanted} times as long as high, not {longest}"))
}

/// How the yield stress differs from that of the table's heap.
fn yield_difference(facts: &Facts, pool: &Pool) -> Option<String> {
    let stress = facts.curve().plastic_stress();
    let weight = facts.forces.extremes[0][pool.up.index()].abs() * pool.depth;
    let found = stress / weight;
    let differs = stress > 0.0 && !alike(found, YIELD);
    differs.then(|| format!("its yield stress is {YIELD} of ρgH, not {}", short(found)))
}

fn channel_case(facts: &Facts, fluid: Fluid) -> Result<Case, String> {
    let (closed, force) = (facts.closed, facts.forces.extremes[0]);
    if !facts.scene.solids.is_empty() {
        return Err("the box has solids inside, the channels of the table plane walls only".to_owned());
    }
    let walls = facts.faces.iter().filter(|faces| faces.contains(&Boundary::NoSlip));
    if walls.count() > 1 {
        return Err("walls along two axes make a duct, and the table has plane channels".to_owned());
    }
    if !(0..3).any(|a| !closed[a] && force[a] != 0.0) {
        return Err("no force drives the fluid along the walls".to_owned());
    }
    Ok(match fluid {
        Fluid::Newtonian => Case::ChannelNewtonian,
        Fluid::Bingham => Case::ChannelBingham,
        Fluid::HerschelBulkley => Case::ChannelHerschelBulkley,
    })
}

/// Cells of the shortest wave of a periodic flow.
fn wave(
    facts: &Facts,
    numbers: &Numbers,
    fluid: Fluid,
    differences: &mut Vec<String>,
) -> Result<f64, String> {
    if fluid != Fluid::Newtonian {
        return Err("the table has no flow without walls of a fluid with a yield stress".to_owned());
    }
    let counts: [f64; 3] = match facts.scene.fluid.initial_velocity {
        InitialVelocity::AtRest | InitialVelocity::Uniform { .. } => {
            return Err("without walls and waves the scene has no length to count cells along".to_owned());
        }
        InitialVelocity::TaylorGreen { normal, wave_counts, .. } => {
            let mut counts = [0.0; 3];
            for (axis, count) in normal.others().into_iter().zip(wave_counts) {
                counts[axis] = f64::from(count).abs();
            }
            counts
        }
        InitialVelocity::ShearWave { wave_counts, .. } => {
            differences.push("its waves are vortices in a plane".to_owned());
            wave_counts.map(|count| f64::from(count).abs())
        }
        InitialVelocity::TaylorGreen3d { wave_counts, .. } | InitialVelocity::Abc { wave_counts, .. } => {
            differences.push("its vortices are two-dimensional".to_owned());
            wave_counts.map(|count| f64::from(count).abs())
        }
    };
    let shortest = (0..3)
        .filter(|&a| counts[a] > 0.0)
        .map(|a| numbers.extents[a] as f64 / counts[a])
        .fold(f64::INFINITY, f64::min);
    if shortest.is_finite() { Ok(shortest) } else { Err("the initial flow has no wave".to_owned()) }
}

/// The scheme of a scene in the table; `None` where it has none like it.
pub(super) fn scheme_of(facts: &Facts, setup: &Setup, case: Case) -> Option<Scheme> {
    let yields =
        !matches!(case, Case::ChannelNewtonian | Case::Vortex | Case::FilmNewtonian | Case::DamBreak);
    let operator = match (&facts.scene.numerics.yield_treatment, operator(facts)) {
        (YieldChoice::LaggedClamped(_), SceneOperator::Bgk) if yields => Operator::LaggedClamp,
        (YieldChoice::Exact, SceneOperator::Bgk) if !yields => Operator::Bgk,
        (YieldChoice::Exact, SceneOperator::CentralMoment) => Operator::CentralMoment,
        (YieldChoice::Exact, SceneOperator::Trt) => Operator::Trt,
        // The table is what was measured: any other pair is not in it.
        _ => return None,
    };
    let walls = match (case, setup.wall_rule) {
        (Case::Vortex, _) => Walls::None,
        (_, WallRule::HalfWay) => Walls::HalfWay,
        (_, WallRule::ViscosityIndependent) => Walls::Independent,
    };
    Some(Scheme { operator, walls })
}
