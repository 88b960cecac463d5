//! The grains seen from the side.

use crate::geometry::Axis as Direction;
use crate::output::discs::{self, Disc, Discs};
use crate::output::{OutputError, atomic};
use crate::plan::grains::GrainPlan;
use crate::run::recorder::Recorder;
use crate::run::view::View;

/// Draws the grains as seen from the side.
pub(in crate::run) fn picture(
    recorder: &Recorder,
    plan: &GrainPlan,
    size_m: [f64; 3],
    grains: &View<'_>,
) -> Result<(), OutputError> {
    let text = discs::draw(&side_view(plan, size_m, grains));
    atomic::write(&recorder.folder().plot("grains.svg")?, text.as_bytes())
}

/// All spheres seen along the shortest axis of the box, but never from above.
fn side_view(plan: &GrainPlan, size: [f64; 3], grains: &View<'_>) -> Discs {
    let g = plan.setup.gravity;
    let up = Direction::ALL.into_iter().max_by(|a, b| g[a.index()].abs().total_cmp(&g[b.index()].abs()));
    let up = up.filter(|axis| g[axis.index()] != 0.0).unwrap_or(Direction::Z);
    let level = Direction::ALL.into_iter().filter(|axis| *axis != up);
    let depth = level.clone().min_by(|a, b| size[a.index()].total_cmp(&size[b.index()]));
    let depth = depth.unwrap_or(Direction::Y);
    let across = level.into_iter().find(|axis| *axis != depth).unwrap_or(Direction::X);
    let (d, a, u) = (depth.index(), across.index(), up.index());
    let fold = |x: f64, k: usize| match plan.setup.period.0[k] {
        Some(length) => x - (x / length).floor() * length,
        None => x,
    };
    let mut discs: Vec<(f64, Disc)> = grains
        .dem
        .members()
        .iter()
        .map(|m| {
            let x = m.position;
            let disc = Disc {
                centre: [fold(x[a], a), fold(x[u], u)],
                radius: m.radius,
                value: m.velocity.norm(),
                driven: m.inverse_mass == 0.0,
            };
            (fold(x[d], d), disc)
        })
        .collect();
    // Far ones first: with `across` to the right and `up` upwards, across × up points to the viewer.
    let towards_viewer = (u + 3 - a) % 3 == 1;
    discs.sort_by(|p, q| if towards_viewer { p.0.total_cmp(&q.0) } else { q.0.total_cmp(&p.0) });
    Discs {
        title: format!("{}: {:.4} s", plan.numbers.title, grains.time),
        label: "speed".to_owned(),
        unit: "m/s".to_owned(),
        axes: [across.letter().to_string(), up.letter().to_string()],
        size_m: [size[a], size[u]],
        discs: discs.into_iter().map(|(_, disc)| disc).collect(),
    }
}
