//! Fluid at time 0 beside, around and below solids: from scene files, against Archimedes, areas and the law of rest.

mod program;

use lahar::plan::Plan;
use lahar::scene::{self, Scene};
use lahar::setup::Setup;
use program::{column, root, series};

fn plan(file: &str, change: impl Fn(&mut Scene)) -> Plan {
    let mut scene = scene::load_flow(&root().join(file)).unwrap_or_else(|error| panic!("{error}"));
    change(&mut scene);
    Plan::with_memory(&scene, None).unwrap_or_else(|error| panic!("{error}"))
}

/// Heights of the surface, cells, of the columns along z that hold fluid; every cell with fluid above it is full.
fn levels(setup: &Setup) -> Vec<f64> {
    let [nx, ny, nz] = setup.extents;
    let fill = &setup.free_surface.as_ref().expect("a surface").fill;
    let mut levels = Vec::new();
    for column in 0..nx * ny {
        let cell = |k: usize| column + nx * ny * k;
        let Some(top) = (0..nz).rev().find(|&k| fill[cell(k)] > 0.0) else { continue };
        for k in (0..top).filter(|&k| !setup.is_solid(cell(k))) {
            assert_eq!(fill[cell(k)], 1.0, "{:?} below {top}", setup.coordinates(cell(k)));
        }
        levels.push(top as f64 + fill[cell(top)]);
    }
    levels
}

/// Fastest speed that is rounding: of pressures, 1e-16 of a density, at the lattice's speed of sound, here 10 m/s, times
/// a few for sums and waves that meet.
const AT_REST: f64 = 10.0 * 1e-16 * 10.0;

/// Archimedes' lift ρgV = 1.1772 N, from the first step on. Below the block pressure began at zero: 1.83 N at first, then
/// 0.91 N, and fluid at 4.7e-2 m/s.
#[test]
fn lift_of_a_submerged_block() {
    let series = series("tests/in_place/block_under_water.json");
    let wanted = 1000.0 * 9.81 * (0.12 * 0.01 * 0.10);
    // The first row is that before the first step, when nothing has pushed yet.
    for lift in &column(&series, "lift_z")[1..] {
        // Forces on 24 cells, each the difference of numbers 50 times larger.
        assert!((lift / wanted - 1.0).abs() < 24.0 * 50.0 * f64::EPSILON, "{lift} {wanted}");
    }
    assert!(column(&series, "fastest").iter().all(|&u| u < AT_REST));
}

/// One level over a culvert, a ledge, a bell, a pipe and a slanted slab; the start made it flow at 7.8e-2 m/s.
#[test]
fn rest_below_solids() {
    let speeds = column(&series("tests/in_place/culvert.json"), "fastest");
    assert!(speeds.iter().all(|&u| u < AT_REST), "{speeds:?}");
}

/// A reservoir drawn to the walls of a lying half-pipe, in four sizes of cells: full below a level surface, and its volume
/// that of a circular segment.
#[test]
fn level_reservoir_in_a_trough() {
    let (r, deep, long): (f64, f64, f64) = (0.1, 0.0737, 0.01);
    let area = r * r * libm::acos((r - deep) / r) - (r - deep) * (deep * (2.0 * r - deep)).sqrt();
    for spacing_m in [0.01, 0.005, 0.0025, 0.00125] {
        let plan = plan("tests/in_place/trough.json", |scene| scene.domain.spacing_m = spacing_m);
        let levels = levels(&plan.setup);
        let wanted = (0.01 + deep) / spacing_m;
        // Coordinates of up to 70 cells.
        assert!(levels.iter().all(|level| (level - wanted).abs() < 70.0 * 1e-14), "{wanted} {levels:?}");
        let [volume, drawn] = [plan.numbers.volume_m3, plan.numbers.drawn_m3].map(|v| v.expect("a volume"));
        let exact = area * long;
        // Beside a wall a cell is open or not as a whole: off by up to half a cell at random, 0.29 as a standard deviation,
        // the same on both sides, in each of those along the arc of 0.26 m: 0.41 √n together, and two and a half times
        // that. A sixteenth of a row where points tell what is drawn.
        let along = 0.26 / spacing_m;
        let cell = spacing_m * spacing_m * long;
        assert!((volume - exact).abs() < along.sqrt() * cell, "{spacing_m} {volume} {exact}");
        assert!((drawn - exact).abs() < along.sqrt() / 16.0 * cell, "{spacing_m} {drawn} {exact}");
        assert!(spacing_m > 0.005 || (volume / exact - 1.0).abs() < 0.01, "{spacing_m} {volume} {exact}");
        let warns = plan.numbers.warnings.iter().any(|w| w.to_string().contains("are drawn"));
        assert_eq!(warns, (volume / drawn - 1.0).abs() > 0.01, "{volume} {drawn}");
    }
}

/// The reservoir of the mudflow, in an inclined trough: 1584 cells beside its walls began half empty at 0.25 m. It is settled.
#[test]
fn level_reservoir_of_the_mudflow() {
    let plan = plan("scenes/show/mudflow_channel.json", |scene| {
        scene.domain.spacing_m = 0.5;
        // More viscous at the coarser spacing.
        scene.fluid.density_kg_per_m3 = 500.0;
    });
    let levels = levels(&plan.setup);
    let first = levels[0];
    assert!(levels.iter().all(|level| (level - first).abs() < 1e-12), "{levels:?}");
    let volume = plan.numbers.volume_m3.expect("a volume");
    // Chosen so, in the scene: the circle cut by the level, integrated along the trough, is 250 m³.
    assert!((volume / 250.0 - 1.0).abs() < 0.01, "{volume}");
}

/// Mud in a trough is at rest from the start.
#[test]
fn rest_in_a_trough() {
    let speeds = column(&series("tests/in_place/trough.json"), "fastest");
    assert!(speeds.iter().all(|&u| u < AT_REST), "{speeds:?}");
}
