//! Bytes predicted from a set-up against the bytes its run holds.

use lahar::bench::backends;
use lahar::plan::memory::{Layout, boundary_cells, predict, predicted_bytes};
use lahar::rheology::Law;
use lahar::setup::{
    BodyForce, Face, FreeSurface, Precision, Setup, SolidMotion, SurfaceForce, WallRule, YieldTreatment,
};
use lahar::solver::choose::only_plain;
use lahar::solver::fast::Fast;
use lahar::solver::plain::Plain;
use lahar::solver::run::Backend;

const LAW: Law = Law::Bingham { sigma0: 1e-5, mu: 0.1 };

fn with_walls(extents: [usize; 3], rule: WallRule) -> Setup {
    let mut setup = Setup::periodic(extents, LAW);
    setup.faces = [[Face::NoSlip; 2], [Face::FreeSlip, Face::NoSlip], [Face::Periodic; 2]];
    setup.wall_rule = rule;
    setup
}

/// Cells near the centre of the box are solid.
fn with_block() -> Setup {
    let mut setup = with_walls([40, 32, 24], WallRule::ViscosityIndependent);
    let inside = |cell| {
        let at = setup.coordinates(cell);
        (0..3).all(|a| at[a] >= setup.extents[a] / 3 && at[a] < setup.extents[a] / 2)
    };
    setup.solids = (0..setup.cells()).map(|cell| u8::from(inside(cell))).collect();
    setup.solid_motion = vec![SolidMotion::default()];
    setup
}

/// With the surface of a solid that moves.
fn turning() -> Setup {
    let mut setup = with_block();
    setup.solid_motion[0].spin = [0.0, 0.0, 1e-4];
    setup
}

fn lagged() -> Setup {
    let mut setup = with_walls([32; 3], WallRule::HalfWay);
    setup.yielding = YieldTreatment::LaggedClamped { tau_min: 0.505, tau_max: 1.8 };
    setup
}

fn layers() -> Setup {
    let mut setup = Setup::periodic([32; 3], LAW);
    setup.fluids.push(Law::Newtonian { mu: 0.1 });
    setup.fluid_of_cell = (0..setup.cells()).map(|cell| u8::from(cell % 2 == 0)).collect();
    setup
}

/// A layer of 8 cells in a box of 32.
fn thin_layer(force: SurfaceForce) -> Setup {
    let mut setup = Setup::periodic([64, 48, 32], LAW);
    setup.faces[0] = [Face::NoSlip; 2];
    setup.faces[2] = [Face::NoSlip, Face::Open];
    setup.force = BodyForce::Constant([1e-6, 0.0, -1e-5]);
    let fill = (0..setup.cells()).map(|cell| if setup.coordinates(cell)[2] < 8 { 1.0 } else { 0.0 });
    setup.free_surface = Some(FreeSurface { force, ..FreeSurface::new(fill.collect()) });
    setup
}

fn setups() -> Vec<(&'static str, Setup)> {
    vec![
        ("periodic cube", Setup::periodic([48; 3], LAW)),
        ("column", Setup::channel(2000, LAW, 1e-6)),
        ("one cell thick", with_walls([300, 200, 1], WallRule::ViscosityIndependent)),
        ("walls", with_walls([48; 3], WallRule::ViscosityIndependent)),
        ("half-way walls", with_walls([48; 3], WallRule::HalfWay)),
        ("block", with_block()),
        ("turning block", turning()),
        ("lagged", lagged()),
        ("layers", layers()),
        ("thin layer", thin_layer(SurfaceForce::ByFill)),
        ("thin layer with inertia", thin_layer(SurfaceForce::ByFillAndInertia)),
    ]
}

/// The most that a run may hold above what was predicted, and below: blocks are counted at time 0, and
/// they appear and vanish as the fluid moves.
const MARGIN: f64 = 0.15;

#[test]
fn predicted_bytes_are_those_allocated() {
    for backend in backends() {
        for (name, setup) in setups() {
            let mut run = backend.start(&setup).unwrap_or_else(|error| panic!("{name}: {error}"));
            // Some arrays appear in the first step.
            run.advance(2).unwrap_or_else(|stopped| panic!("{name}: {stopped:?}"));
            let predicted = predict(&setup, backend.layout()).run() as f64;
            let ratio = run.allocated_bytes() as f64 / predicted;
            // Below a surface the blocks that the fluid touches count too; it has not moved there yet.
            let least = if setup.free_surface.is_some() { 0.5 } else { 1.0 - MARGIN };
            assert!((least..=1.0 + MARGIN).contains(&ratio), "{name} on {}: {ratio}", backend.name());
        }
    }
}

/// Half the bytes of the populations in single precision, and lines of sixteen cells.
#[test]
fn predicted_bytes_in_single_precision_are_those_allocated() {
    for (name, setup) in setups() {
        let double = predict(&setup, Layout::Blocks).run() as f64;
        let setup = Setup { precision: Precision::Single, ..setup };
        if only_plain(&setup).is_some() {
            continue;
        }
        let mut run = Fast::default().start(&setup).unwrap_or_else(|error| panic!("{name}: {error}"));
        run.advance(2).unwrap_or_else(|stopped| panic!("{name}: {stopped:?}"));
        let predicted = predict(&setup, Layout::Blocks).run() as f64;
        let ratio = run.allocated_bytes() as f64 / predicted;
        let least = if setup.free_surface.is_some() { 0.5 } else { 1.0 - MARGIN };
        assert!((least..=1.0 + MARGIN).contains(&ratio), "{name}: {ratio}");
        if setup.extents == [48; 3] && setup.faces[0][0] == Face::Periodic {
            // A cube without walls holds next to nothing but populations.
            assert!((0.5..0.52).contains(&(predicted / double)), "{name}: {}", predicted / double);
        }
    }
}

/// The plain backend has no layout to guess: the same arrays are counted in both places.
#[test]
fn exact_bytes_of_the_plain_backend() {
    for (name, setup) in setups() {
        let mut run = Plain.start(&setup).unwrap_or_else(|error| panic!("{name}: {error}"));
        run.advance(2).unwrap_or_else(|stopped| panic!("{name}: {stopped:?}"));
        assert_eq!(predicted_bytes(&setup).run(), run.allocated_bytes(), "{name}");
    }
}

#[test]
fn exact_number_of_boundary_cells() {
    let mut setup = Setup::periodic([10, 8, 6], LAW);
    assert_eq!(boundary_cells(&setup), 0);
    setup.faces[1] = [Face::NoSlip, Face::FreeSlip];
    assert_eq!(boundary_cells(&setup), 2 * 60);
    // One solid cell away from the walls: its 18 neighbours besides, itself not.
    setup.solids = vec![0; setup.cells()];
    let centre = setup.index([5, 4, 3]);
    setup.solids[centre] = 1;
    assert_eq!(boundary_cells(&setup), 2 * 60 + 18);
    // One cell between two walls is one boundary cell.
    assert_eq!(boundary_cells(&Setup::channel(1, LAW, 0.0)), 1);
}

/// The blocks of a thin layer cost what the fluid costs, whatever the height of the box.
#[test]
fn blocks_follow_the_fluid() {
    let bytes = |height: usize| {
        let mut setup = Setup::periodic([64, 64, height], LAW);
        setup.faces[2] = [Face::NoSlip, Face::Open];
        let fill = (0..setup.cells()).map(|cell| if setup.coordinates(cell)[2] < 12 { 1.0 } else { 0.0 });
        setup.free_surface = Some(FreeSurface::new(fill.collect()));
        predict(&setup, Layout::Blocks).populations
    };
    // The table of blocks is as large as the box: 4 bytes for 512 cells.
    let table = 4 * (64 * 64 * (320 - 32)) / 512;
    assert_eq!(bytes(320), bytes(32) + table);
}
