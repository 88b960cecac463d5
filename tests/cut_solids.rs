//! Solids at their true place: rest and mass.

use std::sync::Arc;

use lahar::boundary::cut::cut_cells;
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Face, FlowPoint, FreeSurface, Setup, SolidMotion};
use lahar::solver::fast::Fast;
use lahar::solver::plain::Plain;
use lahar::solver::run::{Backend, StartError};

const WATER: Law = Law::Newtonian { mu: 0.05 };

fn square(x: f64) -> f64 {
    x * x
}

/// Paints a solid and cuts the links it meets.
fn put(setup: &mut Setup, is_inside: impl Fn([f64; 3]) -> bool + Sync, body: u8) {
    let centre = |cell: usize, setup: &Setup| setup.coordinates(cell).map(|x| x as f64 + 0.5);
    let solids = (0..setup.cells()).map(|cell| if is_inside(centre(cell, setup)) { body } else { 0 });
    setup.solids = solids.collect();
    setup.solid_motion.resize(usize::from(body), SolidMotion::default());
    setup.cuts = cut_cells(setup, is_inside).into();
    assert!(!setup.cuts.is_empty());
}

/// A box on a bed that is tilted about two axes, with a round boulder in it.
fn tilted_box() -> Setup {
    let mut setup = Setup::periodic([20, 12, 20], WATER);
    setup.faces = [[Face::NoSlip; 2]; 3];
    setup.force = BodyForce::Constant([0.0, 0.0, -1e-4]);
    put(
        &mut setup,
        |[x, y, z]| {
            let boulder = square(x - 9.3) + square(y - 6.2) + square(z - 6.1) < 3.4 * 3.4;
            boulder || z < 2.3 + 0.17 * x + 0.11 * y
        },
        1,
    );
    setup.initial = Some(Arc::new(|[_, _, k]| FlowPoint {
        density: 1.0 - 3.0 * 1e-4 * (k as f64 + 0.5 - 10.0),
        velocity: [0.0; 3],
        gradient: [[0.0; 3]; 3],
    }));
    setup
}

/// Still fluid stays still: its links bring nothing in, whatever their cuts.
#[test]
fn tilted_box_keeps_mass_and_rest() {
    let setup = tilted_box();
    for backend in [&Plain as &dyn Backend, &Fast::default()] {
        let mut run = backend.start(&setup).unwrap_or_else(|error| panic!("{error}"));
        let before = run.totals().mass_excess;
        run.advance(3001).unwrap_or_else(|stopped| panic!("{stopped}"));
        let gained = run.totals().mass_excess - before;
        // About 2000 cells, a rounding of 1e-16 each and per step in a random direction.
        assert!(gained.abs() < 1e-11, "{gained}");
        let fastest = run.fields().velocity.iter().flatten().fold(0.0_f64, |most, u| most.max(u.abs()));
        // Rounding of the hydrostatic start, 1e-16 in a density, which sloshes on.
        assert!(fastest < 1e-12, "{fastest}");
    }
}

/// A pool over the tilted bed and the boulder: mass is kept to rounding, and what moves is far below the free fall.
#[test]
fn pool_over_a_tilted_bed_keeps_mass_and_rest() {
    let mut setup = tilted_box();
    let fill = (0..setup.cells()).map(|cell| match setup.coordinates(cell)[2] {
        _ if setup.is_solid(cell) => 0.0,
        k if k < 14 => 1.0,
        14 => 0.3,
        _ => 0.0,
    });
    setup.free_surface = Some(FreeSurface::new(fill.collect()));
    setup.initial = None;
    let free_fall = (1e-4 * 14.3_f64).sqrt();
    for backend in [&Plain as &dyn Backend, &Fast::default()] {
        let mut run = backend.start(&setup).unwrap_or_else(|error| panic!("{error}"));
        run.advance(3001).unwrap_or_else(|stopped| panic!("{stopped}"));
        let ledger = run.ledger().unwrap_or_else(|| panic!("no ledger"));
        assert!(ledger.mass_residual.abs() < 1e-13, "{}", ledger.mass_residual);
        let fields = run.fields();
        let fastest = fields.velocity.iter().flatten().fold(0.0_f64, |most, u| most.max(u.abs()));
        // Set after seeing 2e-6 of 0.038: where the surface meets the boulder, links in place bring in and take out.
        assert!(fastest < 2e-4 * free_fall, "{fastest}");
    }
}

/// A force drives fluid past a cylinder over an uneven bed: mass is kept.
#[test]
fn driven_flow_keeps_mass() {
    let mut setup = Setup::periodic([26, 26, 1], WATER);
    let bed = |[x, y, _]: [f64; 3]| y < 3.2 + libm::sin(std::f64::consts::TAU * x / 26.0);
    put(&mut setup, move |p| bed(p) || square(p[0] - 13.2) + square(p[1] - 15.9) < 30.0, 1);
    setup.force = BodyForce::Constant([1e-5, 0.0, 0.0]);
    for backend in [&Plain as &dyn Backend, &Fast::default()] {
        let mut run = backend.start(&setup).unwrap_or_else(|error| panic!("{error}"));
        run.advance(2001).unwrap_or_else(|stopped| panic!("{stopped}"));
        let excess = run.totals().mass_excess;
        // About 500 cells: per step the rounding of a sum, 1e-16 in a random direction.
        assert!(excess.abs() < 1e-11, "{excess}");
        assert!(run.totals().kinetic_energy > 1e-4, "nothing flows");
    }
}

/// Solids that move are stairs.
#[test]
fn limit_no_cut_links_on_moving_solids() {
    let mut setup = tilted_box();
    setup.solid_motion = vec![SolidMotion { spin: [0.0, 0.0, 1e-3], ..SolidMotion::default() }];
    for backend in [&Plain as &dyn Backend, &Fast::default()] {
        assert!(matches!(backend.start(&setup), Err(StartError::CutsInMotion)));
    }
}
