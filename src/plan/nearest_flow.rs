//! Which flow of the table of work and precision a scene is nearest to.

use super::cells::Cells;
use super::lower::operator;
use super::numbers::Numbers;
use super::scale::closed_axes;
use crate::plan::work::{Case, Operator, Scheme, Walls};
use crate::scene::force::{extreme_forces, total_force};
use crate::scene::{
    BodyForce, Boundary, InitialVelocity, Operator as SceneOperator, Rheology, Scene, YieldChoice,
};
use crate::setup::{Setup, WallRule};

/// Kind of law, as far as the table tells them apart.
#[derive(Clone, Copy, PartialEq)]
enum Fluid {
    Newtonian,
    Bingham,
    HerschelBulkley,
}

fn fluid(law: &Rheology, differences: &mut Vec<String>) -> Result<Fluid, String> {
    match *law {
        Rheology::Newtonian { .. } => Ok(Fluid::Newtonian),
        Rheology::Bingham { .. } => Ok(Fluid::Bingham),
        Rheology::HerschelBulkley { flow_index, .. } => {
            if (flow_index - 0.33).abs() > 0.1 {
                differences.push(format!("its flow index is 0.33, not {flow_index}"));
            }
            Ok(Fluid::HerschelBulkley)
        }
        Rheology::PowerLaw { .. } => Err("no flow of the table has a power law".to_owned()),
        Rheology::Papanastasiou { .. } => Err("no flow of the table has a Papanastasiou law".to_owned()),
    }
}

/// The nearest flow, the cells that count, and how the scene differs; or why there is none.
pub(super) fn case_of(
    scene: &Scene,
    numbers: &Numbers,
    cells: &Cells,
) -> Result<(Case, f64, Vec<String>), String> {
    let mut differences = Vec::new();
    let fluid = fluid(&scene.fluid.rheology, &mut differences)?;
    if scene.grains.is_some() {
        return Err("the scene has grains, and no flow of the table".to_owned());
    }
    if !scene.layers.is_empty() {
        return Err("the scene has several fluids, the flows of the table one".to_owned());
    }
    if scene
        .domain
        .boundaries
        .by_axis()
        .into_iter()
        .flatten()
        .any(|b| matches!(b, Boundary::MovingWall { .. }))
        || scene.solids.iter().any(|s| s.velocity_m_per_s != [0.0; 3] || s.spin_rad_per_s != [0.0; 3])
    {
        return Err("walls drive the scene, and no flow of the table".to_owned());
    }
    if scene.fluid.body_force.is_some_and(|force| !matches!(force, BodyForce::Constant { .. })) {
        return Err("the force changes with time, and in no flow of the table".to_owned());
    }
    let (case, along) = if let Some(depth) = numbers.depth_cells {
        (surface_case(scene, cells, fluid, &mut differences)?, depth)
    } else if numbers.gap_cells.is_finite() {
        (channel_case(scene, fluid, &mut differences)?, numbers.gap_cells)
    } else {
        (Case::Vortex, wave(scene, numbers, fluid, &mut differences)?)
    };
    Ok((case, along, differences))
}

fn surface_case(
    scene: &Scene,
    cells: &Cells,
    fluid: Fluid,
    differences: &mut Vec<String>,
) -> Result<Case, String> {
    let Some(pool) = &cells.pool else { return Err("the scene has no fluid".to_owned()) };
    if pool.fall > 0.0 {
        return Err("the fluid falls through air, and in no flow of the table".to_owned());
    }
    let force = extreme_forces(&total_force(scene))[0];
    let closed = closed_axes(scene);
    let along = |a: usize| a != pool.up.index() && force[a] != 0.0;
    if pool.level && scene.solids.is_empty() && !(0..3).any(|a| along(a) && closed[a]) {
        if !(0..3).any(along) {
            return Err("nothing drives the fluid, which lies level".to_owned());
        }
        return Ok(match fluid {
            Fluid::Newtonian => Case::FilmNewtonian,
            Fluid::Bingham => Case::FilmBingham,
            Fluid::HerschelBulkley => Case::FilmHerschelBulkley,
        });
    }
    if !scene.solids.is_empty() {
        differences.push("it has no solids".to_owned());
    }
    if (0..3).any(along) {
        differences.push("its floor is horizontal".to_owned());
    }
    Ok(match fluid {
        Fluid::Newtonian => Case::DamBreak,
        Fluid::Bingham => Case::Slump,
        Fluid::HerschelBulkley => {
            differences.retain(|d| !d.starts_with("its flow index"));
            differences.push("its fluid is a Bingham fluid".to_owned());
            Case::Slump
        }
    })
}

fn channel_case(scene: &Scene, fluid: Fluid, differences: &mut Vec<String>) -> Result<Case, String> {
    if !scene.solids.is_empty() {
        return Err("the box has solids inside, the channels of the table plane walls only".to_owned());
    }
    let walls =
        scene.domain.boundaries.by_axis().into_iter().filter(|faces| faces.contains(&Boundary::NoSlip));
    if walls.count() > 1 {
        return Err("walls along two axes make a duct, and the table has plane channels".to_owned());
    }
    if scene.domain.boundaries.by_axis().into_iter().flatten().any(|b| b == Boundary::FreeSlip) {
        differences.push("it has no mirror plane".to_owned());
    }
    let force = extreme_forces(&total_force(scene))[0];
    let closed = closed_axes(scene);
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
    scene: &Scene,
    numbers: &Numbers,
    fluid: Fluid,
    differences: &mut Vec<String>,
) -> Result<f64, String> {
    if fluid != Fluid::Newtonian {
        return Err("the table has no flow without walls of a fluid with a yield stress".to_owned());
    }
    let counts: [f64; 3] = match scene.fluid.initial_velocity {
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
pub(super) fn scheme_of(scene: &Scene, setup: &Setup, case: Case) -> Option<Scheme> {
    let yields =
        !matches!(case, Case::ChannelNewtonian | Case::Vortex | Case::FilmNewtonian | Case::DamBreak);
    let operator = match (&scene.numerics.yield_treatment, operator(scene)) {
        (YieldChoice::LaggedClamped(_), SceneOperator::Bgk) if yields => Operator::LaggedClamp,
        (YieldChoice::Exact, SceneOperator::Bgk) if !yields => Operator::Bgk,
        (YieldChoice::Exact, SceneOperator::CentralMoment) => Operator::CentralMoment,
        (YieldChoice::Exact, SceneOperator::Trt) => Operator::Trt,
        _ => return None,
    };
    let walls = match (case, setup.wall_rule) {
        (Case::Vortex, _) => Walls::None,
        (_, WallRule::HalfWay) => Walls::HalfWay,
        (_, WallRule::ViscosityIndependent) => Walls::Independent,
    };
    Some(Scheme { operator, walls })
}
