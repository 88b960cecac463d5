//! Closed forms of scenes that come with lahar, in SI.

use crate::claim::VerifyError;
use crate::exact::couette::PlaneCouette;
use crate::exact::film::Film;
use crate::exact::poiseuille::Channel;
use lahar::output::csv::Series;
use lahar::scene::{self, AnyScene, BodyForce, Boundary, Scene};
use std::path::Path;

/// What the plan calls the error, and the error of a finished run; none where there is no closed form here.
pub fn error(path: &Path, out: &Path) -> Result<Option<(&'static str, f64)>, VerifyError> {
    let fault = |detail: String| VerifyError::Numerics { what: "a scene", detail };
    let AnyScene::Flow(scene) = scene::load(path).map_err(|error| fault(error.to_string()))? else {
        return Ok(None);
    };
    let name = path.file_stem().and_then(|name| name.to_str()).unwrap_or_default();
    let (of, exact, scale) = match name {
        "channel_newtonian" | "channel_bingham" | "channel_herschel_bulkley" => {
            let exact = channel(&scene, force(&scene));
            ("largest speed", exact, exact)
        }
        "film_newtonian" => {
            let exact = film(&scene);
            ("largest speed", exact, exact)
        }
        "couette" => ("speed anywhere, of the wall's", couette(&scene), wall_speed(&scene)),
        "pool_at_rest" => ("speeds, of √(g × depth)", 0.0, (gravity(&scene) * level(&scene)).sqrt()),
        _ => return Ok(None),
    };
    let series = Series::read(&out.join("series.csv")).map_err(|error| fault(error.to_string()))?;
    let column = series.columns.iter().position(|column| column.name == "max_speed");
    let last = column.and_then(|column| series.rows.last()?.get(column).copied());
    let found = last.ok_or_else(|| fault(format!("{name}: no `max_speed` in the series")))?;
    Ok(Some((of, (found - exact) / scale)))
}

/// Force per volume along x, N/m³.
fn force(scene: &Scene) -> f64 {
    match scene.fluid.body_force {
        Some(BodyForce::Constant { force_n_per_m3 }) => force_n_per_m3[0],
        _ => 0.0,
    }
}

/// Of the upper wall, m/s.
fn wall_speed(scene: &Scene) -> f64 {
    match scene.domain.boundaries.y_max {
        Boundary::MovingWall { velocity_m_per_s } => velocity_m_per_s[0],
        _ => f64::NAN,
    }
}

/// m/s².
fn gravity(scene: &Scene) -> f64 {
    scene.gravity.map_or(f64::NAN, |gravity| gravity.magnitude_m_per_s2)
}

/// Height of the surface above the floor, m.
fn level(scene: &Scene) -> f64 {
    let fill = scene.fluid.initial.as_ref().and_then(|initial| initial.fill_level.as_ref());
    fill.map_or(f64::NAN, |fill| fill.height_m)
}

/// In the two cells beside the middle of an even number.
fn channel(scene: &Scene, force: f64) -> f64 {
    let (height, spacing) = (scene.domain.size_m[1], scene.domain.spacing_m);
    Channel { law: scene.fluid.rheology.law(), half_width: 0.5 * height, force }.velocity(0.5 * spacing)
}

/// In the highest cell: its middle lies below a surface that cuts it there.
fn film(scene: &Scene) -> f64 {
    let (law, density, thickness) = (scene.fluid.rheology.law(), scene.fluid.density_kg_per_m3, level(scene));
    let slope = scene.gravity.and_then(|gravity| gravity.slope_deg).unwrap_or(f64::NAN).to_radians();
    Film { law, thickness, density, gravity: gravity(scene), slope }.velocity(thickness)
}

/// In the cell beside the moving wall.
fn couette(scene: &Scene) -> f64 {
    let (gap, spacing) = (scene.domain.size_m[1], scene.domain.spacing_m);
    PlaneCouette { law: scene.fluid.rheology.law(), wall_speed: wall_speed(scene), gap }
        .velocity(gap - 0.5 * spacing)
}
