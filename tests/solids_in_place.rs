//! Scenes with solids, from file to series: where their surfaces lie, formulas in SI units, and what once went wrong
//! beside surfaces in their place.

mod program;

use lahar::plan::Plan;
use lahar::scene;
use program::{column, root, series};

fn last(values: &[f64]) -> f64 {
    values.last().copied().unwrap_or(f64::NAN)
}

/// How many cells the surfaces of a scene's solids cut.
fn cuts(file: &str, change: &dyn Fn(&mut scene::Scene)) -> usize {
    let mut scene = scene::load_flow(&root().join(file)).unwrap_or_else(|error| panic!("{error}"));
    change(&mut scene);
    Plan::new(&scene).unwrap_or_else(|error| panic!("{error}")).setup.cuts.len()
}

#[test]
fn solids_lie_in_place_unless_they_move_or_stairs_are_asked_for() {
    let pipe = "scenes/verify/pipe_newtonian.json";
    assert!(cuts(pipe, &|_| {}) > 50);
    assert_eq!(cuts(pipe, &|scene| scene.numerics.solid_surface = Some(scene::SolidSurface::HalfWay)), 0);
    assert_eq!(cuts("scenes/verify/couette_cylinders.json", &|_| {}), 0);
    // Below a free surface, and among grains.
    assert!(cuts("tests/in_place/dam_on_cell_centres.json", &|_| {}) > 100);
    assert!(cuts("tests/in_place/grain_above_a_boulder.json", &|_| {}) > 100);
}

/// πfR⁴/(8μ) in m³/s; on 16 cells links in place leave 0.98/R² of the velocity, stairs 0.64 % of the discharge.
#[test]
fn exact_discharge_of_a_pipe() {
    let found = last(&column(&series("scenes/verify/pipe_newtonian.json"), "flow_rate"));
    let squared = 0.05 * 0.05;
    let wanted = std::f64::consts::PI * 16.0 * squared * squared / 8.0;
    assert!((found / wanted - 1.0).abs() < 0.98 / 256.0, "{found} {wanted}");
}

/// 4πμΩ R₁²R₂²/(R₂² − R₁²) times the thickness in N m, on cylinders of stairs: each wall up to a third of a cell from its
/// place, of 12.5 and 25 cells, in a torque that goes as R₁^2.7 and R₂^−0.7.
#[test]
fn exact_torque_on_cylinders() {
    let series = series("tests/in_place/torque.json");
    let [inner, outer] = ["inner_z", "outer_z"].map(|name| last(&column(&series, name)));
    let (r1, r2) = (0.025 * 0.025, 0.05 * 0.05);
    let wanted = 4.0 * std::f64::consts::PI * 2.0 * r1 * r2 / (r2 - r1) * 0.002;
    for torque in [-inner, outer] {
        assert!((torque / wanted - 1.0).abs() < (2.7 / 12.5 + 0.7 / 25.0) / 3.0, "{torque} {wanted}");
    }
}

/// Links of cells whose centres lie on the surface were extrapolations: mud that had come to rest went on at 2e-2 m/s.
#[test]
fn mud_comes_to_rest_on_cell_centres() {
    let speeds = column(&series("tests/in_place/dam_on_cell_centres.json"), "fastest");
    // It falls at √(2gH) = 6e-2 m/s at most, and over stairs ended at 1.4e-5 m/s; set after seeing 8.8e-5.
    assert!(speeds.iter().all(|&u| u < 0.06) && last(&speeds) < 1e-4, "{speeds:?}");
}

/// With a law by stress at cut links mud in narrow corners began to move, from rounding by e every 30 steps.
#[test]
fn mud_rests_between_cliffs() {
    let speeds = column(&series("tests/in_place/mud_at_rest_in_cliffs.json"), "fastest");
    // Rounding, 1e-16, of √(gH) = 0.04 m/s, for as long as it sloshes.
    assert!(speeds.iter().all(|&u| u < 1e-16), "{speeds:?}");
}

/// Links in place faced those of the grain over one cell: jets of 5e-2 m/s, where over stairs it is 1.3e-3 at most.
#[test]
fn grain_sinks_on_a_boulder_without_jets() {
    let speeds = column(&series("tests/in_place/grain_above_a_boulder.json"), "fastest");
    // Stokes' settling of the largest grain, 2R²Δρg/(9μ) = 2.7e-3 m/s.
    assert!(speeds.iter().all(|&u| u < 2.7e-3), "{speeds:?}");
}
