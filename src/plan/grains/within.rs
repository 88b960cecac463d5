//! Grains inside solids that are skins for contacts \[D5\].

use std::ops::Range;

use crate::dem::{Grain, Period, Setup, Shape as Form, V3};
use crate::geometry::Shape;
use crate::plan::PlanProblem;
use crate::scene::dry::DryScene;

/// No centre of a sphere inside a solid whose surface is a mesh.
///
/// Contacts see a mesh as a skin: what lies wholly inside touches nothing and would fall through the body. Solids
/// of the other kinds push out whatever is in them, so the check of overlaps finds those. Driven grains may stand in
/// a solid, as part of a bed.
///
/// # Errors
/// The first such grain and the solid.
pub(super) fn outside_solids(
    scene: &DryScene,
    setup: &Setup,
    sets: &[(String, Range<usize>)],
) -> Result<(), (String, PlanProblem)> {
    for (i, solid) in scene.solids.iter().enumerate() {
        // An inverted cone is a funnel: open at both ends, so that it has no inside.
        let Some(shape) = solid.shape.as_ref().filter(|shape| !solid.invert && has_skin(shape)) else {
            continue;
        };
        for (grain, g) in setup.grains.iter().enumerate().filter(|(_, g)| !g.driven) {
            if spheres(setup, g).any(|centre| skin_contains(shape, folded(setup.period, centre))) {
                let (grain, solid) = (super::name(sets, grain), solid.name.clone());
                return Err((format!("solids[{i}]"), PlanProblem::GrainInSolid { grain, solid }));
            }
        }
    }
    Ok(())
}

/// Whether any part of the shape becomes a mesh.
fn has_skin(shape: &Shape) -> bool {
    match shape {
        Shape::Union(parts) => parts.iter().any(has_skin),
        Shape::Polygon { .. } | Shape::Heightfield(_) | Shape::Cone { .. } => true,
        _ => false,
    }
}

/// Whether a part of the shape that becomes a mesh holds the point.
fn skin_contains(shape: &Shape, at: V3) -> bool {
    match shape {
        Shape::Union(parts) => parts.iter().any(|part| skin_contains(part, at)),
        _ => has_skin(shape) && shape.contains(at.into()),
    }
}

/// Centres of the spheres of a grain, m.
fn spheres<'a>(setup: &'a Setup, grain: &'a Grain) -> impl Iterator<Item = V3> + 'a {
    let members = match grain.shape {
        Form::Sphere => None,
        Form::Clump(k) => setup.clumps.get(k),
    };
    let scale = members.map_or(1.0, |clump| grain.radius / clump.equivalent_radius());
    let of_clump = members.into_iter().flat_map(|clump| &clump.members);
    let centres = of_clump.map(move |member| grain.position + grain.orientation * member.centre * scale);
    centres.chain(members.is_none().then_some(grain.position))
}

/// The place in the box that a periodic place stands for.
fn folded(Period(period): Period, at: V3) -> V3 {
    V3::from_fn(|k, _| period[k].map_or(at[k], |length| at[k] - length * (at[k] / length).floor()))
}
