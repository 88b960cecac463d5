//! What a scene draws and the cells do not have: solids behind others; and odd densities.

use super::cells::{Cells, holds_cells};
use super::holding::holding;
use super::warning::Warning;
use crate::scene::Scene;

/// Share of the cells of a loaded solid that may belong to others without a warning.
const SHARED: f64 = 0.05;
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

/// Solids whose cells belong to others: the last one that holds the centre of a cell has it.
fn covered(scene: &Scene, cells: &Cells) -> Vec<Warning> {
    let loaded = |name: &str| {
        let mut probes = scene.output.all_probes();
        probes.any(|(probe, _)| probe.measure.loaded_solid() == Some(name))
    };
    let mut left = vec![0_u64; scene.solids.len() + 1];
    cells.solids.iter().for_each(|&s| left[usize::from(s)] += 1);
    let each = scene.solids.iter().enumerate().flat_map(|(i, solid)| {
        // A single solid has all of its cells.
        let drawn =
            if scene.solids.len() > 1 { holds_cells(&solid.shape, solid.invert, &scene.domain) } else { 0 };
        let share = 1.0 - left[i + 1] as f64 / drawn.max(1) as f64;
        let name = solid.name.clone();
        let hidden = drawn > 0 && left[i + 1] == 0;
        let shared = drawn > 0 && share > SHARED && loaded(&solid.name) && !hidden;
        holding([
            (hidden, Warning::SolidHidden { name: name.clone() }),
            (shared, Warning::SolidShared { name, share }),
        ])
    });
    each.collect()
}
