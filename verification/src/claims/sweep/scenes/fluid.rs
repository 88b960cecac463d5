//! Errors of a scene with fluid, run as its plan says.

use super::draw::{Exact, G};
use crate::claim::VerifyError;
use lahar::plan::Plan;
use lahar::solver::run::{Backend, Fields, Run};
use lahar::solver::steady::{SteadyRule, run_to_steady};

/// Change still to come at which a run is taken for steady, of the largest speed.
const STEADY: f64 = 1e-4;
/// Relaxations after which a run should be steady.
pub const RELAXATIONS: f64 = 12.0;
/// Relaxations within which a run has to become steady.
const PATIENCE: f64 = 40.0;
/// Looks at a period.
const LOOKS: u64 = 8;

/// Errors, and why there are none.
pub enum Ended {
    /// It ran; where it did not become steady, the largest at any look.
    Errors([f64; 2]),
    /// A guard stopped it.
    Failed(String),
}

/// Steps of the slowest relaxation: (2L/π)²/ν with the least tangent viscosity.
pub fn relaxation(plan: &Plan, n: f64) -> f64 {
    let numbers = &plan.numbers;
    let across = numbers.depth_cells.unwrap_or(0.5 * numbers.gap_cells);
    let across = 2.0 * across.max(1.0) / std::f64::consts::PI;
    across * across * 3.0 / ((numbers.tau_plastic - 0.5) * n.min(1.0))
}

/// Steps that a scene takes.
pub fn steps(plan: &Plan, exact: &Exact) -> f64 {
    let numbers = &plan.numbers;
    match exact {
        Exact::Film(film) => RELAXATIONS * relaxation(plan, index(&film.law)),
        Exact::Channel(channel) => RELAXATIONS * relaxation(plan, index(&channel.law)),
        // A wall drives the whole gap: twice the half.
        Exact::Shear(..) | Exact::Layers(..) => 4.0 * RELAXATIONS * relaxation(plan, flow_index(plan)),
        Exact::StartUp(_) | Exact::Oscillating(..) | Exact::Pool(_) | Exact::Grains(_) => {
            numbers.steps as f64
        }
    }
}

/// Flow index of the plan's point; 1 where it has none.
fn flow_index(plan: &Plan) -> f64 {
    use lahar::plan::expected::Kind;
    plan.numbers.expected.like().filter(|like| like.kind == Kind::Couette).map_or(0.5, |like| like.at[1])
}

const fn index(law: &lahar::rheology::Law) -> f64 {
    use lahar::rheology::Law;
    match *law {
        Law::HerschelBulkley { n, .. } | Law::PowerLaw { n, .. } | Law::Papanastasiou { n, .. } => n,
        Law::Newtonian { .. } | Law::Bingham { .. } => 1.0,
    }
}

/// Runs a scene and compares it.
///
/// # Errors
/// The backend refuses.
pub fn run(backend: &dyn Backend, plan: &Plan, exact: &Exact) -> Result<Ended, VerifyError> {
    let mut run = backend.start(&plan.setup)?;
    match exact {
        Exact::Film(_) | Exact::Channel(_) | Exact::Shear(..) | Exact::Layers(..) => {
            let time = steps(plan, exact) / RELAXATIONS;
            let interval = (0.2 * time).ceil().max(20.0) as u64;
            let max_steps = (PATIENCE * time) as u64 + 40 * interval;
            match run_to_steady(run.as_mut(), SteadyRule { tolerance: STEADY, interval, max_steps }) {
                Ok(found) if found.steady => Ok(Ended::Errors(compare(plan, run.as_ref(), exact))),
                Ok(_) => Ok(unsteady(run.as_mut(), plan, exact, interval)),
                Err(stopped) => Ok(Ended::Failed(format!("stopped at step {}", stopped.step))),
            }
        }
        Exact::Oscillating(wall, periods) => {
            let period = 2.0 * std::f64::consts::PI / wall.frequency / plan.units.dt_s;
            let mut worst = 0.0_f64;
            for look in 0..LOOKS {
                let due = ((periods + look as f64 / LOOKS as f64) * period).round() as u64;
                if let Err(stopped) = run.advance(due.saturating_sub(run.step())) {
                    return Ok(Ended::Failed(format!("stopped at step {}", stopped.step)));
                }
                let time = run.step() as f64 * plan.units.dt_s;
                let speed = |y: f64| wall.velocity(y, time);
                worst = worst.max(across(plan, &run.fields(), speed) / wall.speed);
            }
            Ok(Ended::Errors([worst, f64::NAN]))
        }
        Exact::StartUp(_) | Exact::Pool(_) | Exact::Grains(_) => match run.advance(plan.steps) {
            Ok(()) => Ok(Ended::Errors(compare(plan, run.as_ref(), exact))),
            Err(stopped) => Ok(Ended::Failed(format!("stopped at step {}", stopped.step))),
        },
    }
}

/// Steps between the looks at a flow that does not become steady: odd and even, a few and many.
const APART: [u64; 4] = [1, 2, 7, 24];

/// The largest errors of a flow that goes on changing, over several looks.
fn unsteady(run: &mut dyn Run, plan: &Plan, exact: &Exact, interval: u64) -> Ended {
    let mut worst = compare(plan, run, exact);
    for steps in APART.into_iter().chain([interval / 2, interval]) {
        if let Err(stopped) = run.advance(steps) {
            return Ended::Failed(format!("stopped at step {}", stopped.step));
        }
        for (worst, error) in worst.iter_mut().zip(compare(plan, run, exact)) {
            *worst = if error.abs() > worst.abs() { error } else { *worst };
        }
    }
    Ended::Errors(worst)
}

/// Largest difference of the speed along x from a function of y, m/s.
fn across(plan: &Plan, fields: &Fields, speed: impl Fn(f64) -> f64) -> f64 {
    let difference = |cell: usize| {
        let y = plan.units.cell_centre_m(plan.setup.coordinates(cell))[1];
        (plan.units.velocity_to_si(fields.velocity[cell][0]) - speed(y)).abs()
    };
    (0..plan.setup.cells()).map(difference).fold(0.0, f64::max)
}

fn magnitude(u: &[f64; 3]) -> f64 {
    (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]).sqrt()
}

/// Largest speed, and the sum of speeds along x, over fluid cells by their fill; lattice units.
fn sums(fields: &Fields, fluid: impl Fn(usize) -> f64) -> [f64; 3] {
    let mut sums = [0.0_f64; 3];
    for (cell, u) in fields.velocity.iter().enumerate() {
        let fill = fluid(cell);
        if fill > 0.0 {
            sums = [sums[0].max(magnitude(u)), sums[1] + fill * u[0], sums[2] + fill];
        }
    }
    sums
}

fn compare(plan: &Plan, run: &dyn Run, exact: &Exact) -> [f64; 2] {
    let (fields, units) = (run.fields(), &plan.units);
    let fill = |cell: usize| fields.fill.get(cell).copied().unwrap_or(1.0);
    let [largest, along, volume] = sums(&fields, fill);
    match exact {
        Exact::Film(film) => {
            let mean = units.velocity_to_si(along) / (film.thickness / units.dx_m);
            [
                mean / (film.flux() / film.thickness) - 1.0,
                units.velocity_to_si(largest) / film.surface_velocity() - 1.0,
            ]
        }
        Exact::Channel(channel) => {
            let mean = units.velocity_to_si(along) / volume;
            [
                mean / (channel.flux() / (2.0 * channel.half_width)) - 1.0,
                units.velocity_to_si(largest) / channel.plug_velocity() - 1.0,
            ]
        }
        Exact::StartUp(start) => {
            let time = run.step() as f64 * units.dt_s;
            [across(plan, &fields, |y| start.velocity(y, time)) / start.wall_speed, f64::NAN]
        }
        Exact::Shear(speed, gap) => [across(plan, &fields, |y| speed * y / gap) / speed, f64::NAN],
        Exact::Layers(layers, speed) => [across(plan, &fields, |y| layers.velocity(y)) / speed, f64::NAN],
        Exact::Pool(depth) => {
            let drawn = plan.numbers.volume_m3.unwrap_or(f64::NAN) / (units.dx_m * units.dx_m * units.dx_m);
            [units.velocity_to_si(largest) / (G * depth).sqrt(), volume / drawn - 1.0]
        }
        Exact::Oscillating(..) | Exact::Grains(_) => [f64::NAN; 2],
    }
}
