//! What a scene draws and the cells do not have: solids behind others; and odd densities.

use super::cells::{Cells, holds_cells};
use super::holding::holding;
use super::warning::Warning;
use crate::geometry::Body;
use crate::scene::{Scene, Solid};

/// Share of the cells of a loaded solid that may belong to others without a warning.
const SHARED: f64 = 0.05;
/// Part of its volume by which a loaded solid may differ from what is drawn without a warning: that of its lift.
const OTHER_VOLUME: f64 = 0.02;
/// Densities between these, kg/m³, are those of liquids, snow, wood, rock and metals; numbers in g/cm³ are below.
const DENSITIES: [f64; 2] = [10.0, 25_000.0];

/// All of them.
pub(super) fn warnings(scene: &Scene, cells: &Cells) -> Vec<Warning> {
    let mut all = covered(scene, cells);
    all.extend(odd_density("the fluid", scene.fluid.density_kg_per_m3));
    all
}

/// A density that is likely to be in other units.
pub(super) fn odd_density(name: &str, density_kg_per_m3: f64) -> Option<Warning> {
    let [low, high] = DENSITIES;
    let odd = !(low..=high).contains(&density_kg_per_m3);
    odd.then(|| Warning::OddDensity { name: name.to_owned(), density_kg_per_m3 })
}

/// A loaded solid of another volume than drawn.
fn other_volume(solid: &Solid, cells: u64, extents: [usize; 3], dx: f64) -> Option<Warning> {
    let body = Body { shape: &solid.shape, invert: solid.invert };
    let drawn_m3 = body.volume(extents, dx)?;
    let volume_m3 = cells as f64 * dx * dx * dx;
    let what = format!("`{}`, whose lift is that of the cells,", solid.name);
    let off = (volume_m3 - drawn_m3).abs() > OTHER_VOLUME * drawn_m3;
    off.then_some(Warning::OtherVolume { what, volume_m3, drawn_m3 })
}

/// Solids whose cells belong to others: the last one that holds the centre of a cell has it.
fn covered(scene: &Scene, cells: &Cells) -> Vec<Warning> {
    let loaded = |name: &str| {
        let mut probes = scene.output.all_probes();
        probes.any(|(probe, _)| probe.measure.loaded_solid() == Some(name))
    };
    let dx = scene.domain.spacing_m;
    let mut left = vec![0_u64; scene.solids.len() + 1];
    cells.solids.iter().for_each(|&s| left[usize::from(s)] += 1);
    let each = scene.solids.iter().enumerate().flat_map(|(i, solid)| {
        let drawn = holds_cells(&solid.shape, solid.invert, &scene.domain);
        let share = 1.0 - left[i + 1] as f64 / drawn.max(1) as f64;
        let name = solid.name.clone();
        let hidden = drawn > 0 && left[i + 1] == 0;
        let shared = drawn > 0 && share > SHARED && loaded(&solid.name) && !hidden;
        holding([
            (hidden, Warning::SolidHidden { name: name.clone() }),
            (shared, Warning::SolidShared { name, share }),
        ])
        .into_iter()
        .chain(loaded(&solid.name).then(|| other_volume(solid, drawn, cells.extents, dx)).flatten())
    });
    each.collect()
}
