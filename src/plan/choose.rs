//! The time step of a plan: as given, or chosen among those that pass all checks.

use super::error::PlanProblem;
use super::judge::Flow;
use super::surface::Pool;
use super::time_step::{StepRule, TAU, free, reference_viscosity};

/// Δt in s and what fixed it: as given, or the usual choice, or where that fails a check the nearest step that passes all.
///
/// # Errors
/// Neither a velocity nor a viscosity is known.
pub(super) fn choose(flow: &Flow, pool: Option<&Pool>) -> Result<(f64, StepRule), PlanProblem> {
    let Flow { facts, scales, .. } = *flow;
    let scene = facts.scene;
    let dx = scene.domain.spacing_m;
    let rho = scene.fluid.density_kg_per_m3;
    let numerics = &scene.numerics;
    // A given step needs it, too: without it nothing can be said of τ.
    let viscosity = reference_viscosity(facts, scales).ok_or(PlanProblem::NoShearRate)?;
    if let Some(dt) = numerics.time_step_s {
        return Ok((dt, StepRule::Given));
    }
    // [L6]: Δt = (τ − ½) ρ Δx² / (3 μ).
    let of_tau = |tau: f64| (tau - 0.5) / 3.0 * rho * dx * dx / viscosity;
    let of_speed = |u: f64| u * dx / scales.velocity;
    if let Some(tau) = numerics.relaxation_time {
        return Ok((of_tau(tau), StepRule::RelaxationTime));
    }
    if let Some(mach) = numerics.target_mach {
        if scales.velocity <= 0.0 {
            return Err(PlanProblem::NoSpeed);
        }
        return Ok((of_speed(mach / 3.0_f64.sqrt()), StepRule::TargetMach));
    }
    let usual = free(facts, scales, pool, TAU, viscosity);
    if flow.allows(usual.0, 1.0) {
        return Ok(usual);
    }
    Ok(flow.nearest_step(usual.0).map_or(usual, |dt| (dt, StepRule::Admissible)))
}
