//! How many steps of the grains a step of the fluid holds.

use crate::dem::{Grain, Shape};
use crate::plan::error::PlanProblem;
use crate::plan::facts::Facts;
use crate::plan::grains::GrainPlan;
use crate::plan::scale::Scales;
use crate::plan::warning::LUBRICATED_GAP;
use crate::scene::Scene;
use crate::setup::suspension::Lubrication;
use crate::setup::suspension::lubrication::STIFFEST;
use crate::units::Units;

/// Most sub-steps that are chosen.
const MOST: f64 = 1e6;

/// What was found on the way to the sub-steps.
#[derive(Clone, Copy, Debug)]
pub(in crate::plan) struct Stepping {
    pub sub_steps: u32,
    pub given: bool,
    /// Gap below which the friction of lubrication is limited, cells; 0 without lubrication.
    pub limited_gap: f64,
    /// Whether lubrication asked for more steps than contacts.
    pub for_gaps: bool,
}

/// Viscosity in a gap that closes, Pa s: at the largest rate expected, or at 1/s where nothing moves, there without
/// the yield stress.
pub(super) fn gap_viscosity(facts: &Facts, scales: &Scales) -> f64 {
    let (curve, rate) = (facts.curve(), scales.shear_rate_max);
    if rate > 0.0 { curve.apparent_viscosity(rate) } else { curve.plastic_viscosity(1.0) }
}

/// How many steps of the grains a step of the fluid holds.
pub(super) fn sub_steps(
    scene: &Scene,
    units: &Units,
    grains: &GrainPlan,
    lubrication: Option<Lubrication>,
    viscosity: f64,
) -> Result<Stepping, PlanProblem> {
    let contact_step = grains.numbers.time_step_s;
    // A share of 1e-9 above a whole number is rounding.
    let for_contacts = (units.dt_s / contact_step * (1.0 - 1e-9)).ceil().max(1.0);
    let stiffness = lubrication.map_or(0.0, |_| stiffest_gap(grains, units, viscosity));
    let cutoff = lubrication.map_or(0.0, |rules| rules.cutoff);
    // 6πμR²(1/h − 1/h_c) = STIFFEST m n.
    let steps_for = |gap: f64| (stiffness * (1.0 / gap - 1.0 / cutoff)).max(0.0).ceil();
    let gap_of = |steps: f64| if stiffness > 0.0 { 1.0 / (steps / stiffness + 1.0 / cutoff) } else { 0.0 };
    let for_gaps = if stiffness > 0.0 { steps_for(LUBRICATED_GAP.min(cutoff)) } else { 1.0 };
    let given = scene.coupling().sub_steps;
    let needed = for_contacts.max(for_gaps);
    if let Some(steps) = given {
        let limited_gap = gap_of(f64::from(steps));
        if limited_gap > LUBRICATED_GAP * (1.0 + 1e-9) && for_gaps > f64::from(steps) {
            return Err(PlanProblem::LubricationStep {
                steps,
                needed: for_gaps,
                gap: limited_gap,
                allowed: LUBRICATED_GAP,
            });
        }
        return Ok(Stepping { sub_steps: steps, given: true, limited_gap, for_gaps: false });
    }
    if needed.is_nan() || needed > MOST {
        return Err(PlanProblem::TooManySubSteps { needed, most: MOST });
    }
    let sub_steps = needed as u32;
    let limited_gap = gap_of(needed);
    Ok(Stepping { sub_steps, given: false, limited_gap, for_gaps: for_gaps > for_contacts })
}

/// 6πμR²/(0.5 m) in lattice units, of the sphere and grain for which it is largest: against a wall, which is stiffer
/// than against an equal grain.
fn stiffest_gap(grains: &GrainPlan, units: &Units, viscosity: f64) -> f64 {
    let mu = units.viscosity_to_lattice(viscosity);
    let mass_unit = units.rho0_kg_per_m3 * units.dx_m * units.dx_m * units.dx_m;
    let setup = &grains.setup;
    let of = |grain: &Grain| {
        let density = setup.materials.list[grain.material].density_kg_m3;
        let cube = grain.radius * grain.radius * grain.radius;
        let mass = 4.0 / 3.0 * std::f64::consts::PI * density * cube / mass_unit;
        let share = match grain.shape {
            Shape::Sphere => 1.0,
            Shape::Clump(k) => setup.clumps.get(k).map_or(1.0, |clump| {
                let largest = clump.members.iter().map(|member| member.radius).fold(0.0, f64::max);
                largest / clump.equivalent_radius()
            }),
        };
        let radius = units.length_to_lattice(share * grain.radius);
        6.0 * std::f64::consts::PI * mu * radius * radius / (STIFFEST * mass)
    };
    setup.grains.iter().filter(|grain| !grain.driven).map(of).fold(0.0, f64::max)
}
