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

impl Need {
    /// A pass, and why the run has it or has it not.
    pub(super) const fn of(pass: &'static str, needed: bool, yes: &'static str, no: &'static str) -> Self {
        Self { pass, needed, because: if needed { yes } else { no } }
    }
}

pub(super) fn passes(scene: &Scene, setup: &Setup) -> Vec<Need> {
    let mut needs = surface_passes(setup);
    needs.extend(flow_passes(setup));
    if !setup.solids.is_empty() {
        let cut = !setup.cuts.is_empty();
        let no = "solids end half-way between cells, or are stairs [B1]";
        needs.push(Need::of("cut links", cut, "surfaces of solids lie in their place [B4]", no));
    }
    let steady = scene.stop.steady.is_some();
    needs.push(Need::of("steadiness check", steady, "`stop.steady` was given", "runs to the end time"));
    if scene.stop.arrested.is_some() {
        needs.push(Need::of("check for rest", true, "`stop.arrested` was given", ""));
    }
    needs
}

fn flow_passes(setup: &Setup) -> [Need; 9] {
    let varies = !setup.fluids.iter().all(|law| law.constant_tau().is_some());
    let lagged = matches!(setup.yielding, YieldTreatment::LaggedClamped { .. });
    let forced = match setup.force {
        BodyForce::Constant(f) => norm(f) > 0.0,
        BodyForce::Oscillating { .. } | BodyForce::Stepped { .. } => true,
    };
    let walls = setup.faces.iter().flatten().any(|face| *face != Face::Periodic);
    [
        Need::of(
            "shear-rate solve",
            varies,
            "the viscosity depends on the shear rate [Y3]",
            "all fluids are Newtonian: one relaxation time each",
        ),
        Need::of(
            "relaxation-time field",
            lagged,
            "the lagged scheme reads the previous step [Y4]",
            "solved within the cell; nothing is stored",
        ),
        Need::of(
            "solid lookup",
            !setup.solids.is_empty(),
            "links may end in solids [B1]",
            "no solids inside the box",
        ),
        Need::of(
            "grains",
            setup.grains.is_some(),
            "links, covered cells, contacts and lubrication [C1]-[C6]",
            "no grains in the fluid: no owners, no links, no contacts",
        ),
        Need::of("fluid lookup", !setup.fluid_of_cell.is_empty(), "each cell names its fluid", "one fluid"),
        Need::of("wall links", walls, "faces with walls or mirrors [B1] [B2]", "all faces are periodic"),
        Need::of("body force", forced, "gravity or a body force acts [L5]", "no force"),
        Need::of(
            "wall-slip correction",
            setup.wall_rule == WallRule::ViscosityIndependent,
            "`viscosity_independent` was chosen [B3]",
            "plain half-way walls",
        ),
        Need::of("third-moment source", setup.stress_source, "`stress_source` was chosen [K6]", "not chosen"),
    ]
}

fn surface_passes(setup: &Setup) -> Vec<Need> {
    let Some(surface) = &setup.free_surface else {
        let none = "fluid fills the box: no mass, fill or conversion passes";
        return vec![Need::of("free surface", false, "", none)];
    };
    vec![
        Need::of(
            "mass exchange and conversions",
            true,
            "`fluid.initial` leaves room for a free surface [F1] [F4]",
            "",
        ),
        Need::of("ledger", true, "mass and momentum are booked in every step [F5]", ""),
        Need::of(
            "acceleration in surface cells",
            surface.force == SurfaceForce::ByFillAndInertia,
            "`by_fill_and_inertia` was chosen [F3]",
            "only for `by_fill_and_inertia` [F3]",
        ),
        Need::of(
            "normals of the surface",
            surface.excess == ExcessRule::AlongNormal,
            "`along_normal` was chosen [F4]",
            "excess mass is shared evenly [F4]",
        ),
        Need::of("loads on solids", setup.loads, "a `force` probe asks for them [C7]", "no `force` probe"),
    ]
}
