//! Which passes over the cells a run needs, and which it does not pay for.

use serde::Serialize;

use crate::scene::Scene;
use crate::scene::force::norm;
use crate::setup::{BodyForce, ExcessRule, Face, Setup, SurfaceForce, WallRule, YieldTreatment};

/// A pass over the cells, and whether this run has it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Need {
    /// The pass.
    pub pass: &'static str,
    /// Whether the run has it.
    pub needed: bool,
    /// Why, or why not.
    pub because: &'static str,
}

pub(super) fn passes(scene: &Scene, setup: &Setup) -> Vec<Need> {
    let need = |pass, needed, because| Need { pass, needed, because };
    let constant = setup.fluids.iter().all(|law| law.constant_tau().is_some());
    let lagged = matches!(setup.yielding, YieldTreatment::LaggedClamped { .. });
    let forced = match setup.force {
        BodyForce::Constant(f) => norm(f) > 0.0,
        BodyForce::Oscillating { .. } | BodyForce::Stepped { .. } => true,
    };
    let walls = setup.faces.iter().flatten().any(|face| *face != Face::Periodic);
    let mut needs = surface_passes(setup);
    needs.extend(vec![
        if constant {
            need("shear-rate solve", false, "all fluids are Newtonian: one relaxation time each")
        } else {
            need("shear-rate solve", true, "the viscosity depends on the shear rate [Y3]")
        },
        if lagged {
            need("relaxation-time field", true, "the lagged scheme reads the previous step [Y4]")
        } else {
            need("relaxation-time field", false, "solved within the cell; nothing is stored")
        },
        if setup.solids.is_empty() {
            need("solid lookup", false, "no solids inside the box")
        } else {
            need("solid lookup", true, "links may end in solids [B1]")
        },
        if setup.grains.is_some() {
            need("grains", true, "links, covered cells, contacts and lubrication [C1]-[C6]")
        } else {
            need("grains", false, "no grains in the fluid: no owners, no links, no contacts")
        },
        if setup.fluid_of_cell.is_empty() {
            need("fluid lookup", false, "one fluid")
        } else {
            need("fluid lookup", true, "each cell names its fluid")
        },
        if walls {
            need("wall links", true, "faces with walls or mirrors [B1] [B2]")
        } else {
            need("wall links", false, "all faces are periodic")
        },
        if forced {
            need("body force", true, "gravity or a body force acts [L5]")
        } else {
            need("body force", false, "no force")
        },
        if setup.wall_rule == WallRule::ViscosityIndependent {
            need("wall-slip correction", true, "`viscosity_independent` was chosen [B3]")
        } else {
            need("wall-slip correction", false, "plain half-way walls")
        },
        if setup.stress_source {
            need("third-moment source", true, "`stress_source` was chosen [K6]")
        } else {
            need("third-moment source", false, "not chosen")
        },
        if scene.stop.steady.is_some() {
            need("steadiness check", true, "`stop.steady` was given")
        } else {
            need("steadiness check", false, "runs to the end time")
        },
    ]);
    if scene.stop.arrested.is_some() {
        needs.push(need("check for rest", true, "`stop.arrested` was given"));
    }
    needs
}

fn surface_passes(setup: &Setup) -> Vec<Need> {
    let need = |pass, needed, because| Need { pass, needed, because };
    let Some(surface) = &setup.free_surface else {
        return vec![need("free surface", false, "fluid fills the box: no mass, fill or conversion passes")];
    };
    vec![
        need(
            "mass exchange and conversions",
            true,
            "`fluid.initial` leaves room for a free surface [F1] [F4]",
        ),
        need("ledger", true, "mass and momentum are booked in every step [F5]"),
        if surface.force == SurfaceForce::ByFillAndInertia {
            need("acceleration in surface cells", true, "`by_fill_and_inertia` was chosen [F3]")
        } else {
            need("acceleration in surface cells", false, "only for `by_fill_and_inertia` [F3]")
        },
        if surface.excess == ExcessRule::AlongNormal {
            need("normals of the surface", true, "`along_normal` was chosen [F4]")
        } else {
            need("normals of the surface", false, "excess mass is shared evenly [F4]")
        },
        if setup.loads {
            need("loads on solids", true, "a `force` probe asks for them [C7]")
        } else {
            need("loads on solids", false, "no `force` probe")
        },
    ]
}
