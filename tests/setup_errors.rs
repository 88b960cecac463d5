//! Set-ups that cannot be run are refused before anything is allocated.

use lahar::rheology::Law;
use lahar::setup::{BodyForce, Course, Face, FlowPoint, Precision, Setup, SolidMotion};
use lahar::solver::choose::Best;
use lahar::solver::plain::Plain;
use lahar::solver::run::{Backend, Runaway, StartError};

const LAW: Law = Law::Newtonian { mu: 0.1 };

fn refusal(change: impl FnOnce(&mut Setup)) -> StartError {
    let mut setup = Setup::periodic([4, 3, 2], LAW);
    change(&mut setup);
    match Plain.start(&setup) {
        Ok(_) => panic!("accepted"),
        Err(error) => error,
    }
}

#[test]
fn wrong_lengths() {
    assert_eq!(
        refusal(|s| s.solids = vec![0; 23]),
        StartError::Length { field: "solids", found: 23, expected: 24 }
    );
    assert_eq!(
        refusal(|s| s.fluid_of_cell = vec![0; 25]),
        StartError::Length { field: "fluid_of_cell", found: 25, expected: 24 }
    );
}

#[test]
fn entries_outside_their_table() {
    assert_eq!(
        refusal(|s| {
            s.solids = vec![0; 24];
            s.solids[5] = 2;
            s.solid_motion = vec![SolidMotion::default()];
        }),
        StartError::UnknownEntry { table: "solid_motion", cell: 5, found: 2, len: 2 }
    );
    assert_eq!(
        refusal(|s| {
            s.fluid_of_cell = vec![0; 24];
            s.fluid_of_cell[23] = 1;
        }),
        StartError::UnknownEntry { table: "fluids", cell: 23, found: 1, len: 1 }
    );
}

#[test]
fn half_periodic_axes() {
    for (axis, name) in ['x', 'y', 'z'].into_iter().enumerate() {
        for side in 0..2 {
            let error = refusal(|s| s.faces[axis][side] = Face::NoSlip);
            assert_eq!(error, StartError::HalfPeriodic { axis: name });
        }
    }
}

#[test]
fn faces_that_leave_their_plane() {
    for (axis, name) in ['x', 'y', 'z'].into_iter().enumerate() {
        let mut velocity = [0.01; 3];
        let leaves = |velocity| refusal(|s| s.faces[axis] = [Face::NoSlip, Face::Moving(velocity)]);
        assert_eq!(leaves(velocity), StartError::FaceLeaves { axis: name, found: 0.01 });
        velocity[axis] = 0.0;
        let mut setup = Setup::periodic([4, 3, 2], LAW);
        setup.faces[axis] = [Face::NoSlip, Face::Moving(velocity)];
        assert!(Plain.start(&setup).is_ok());
    }
}

#[test]
fn courses_that_say_nothing() {
    let table = |points: Vec<[f64; 2]>| Course::Table(points.into());
    let swing = |frequency| Course::Oscillating { mean: 0.0, amplitude: 1.0, frequency, phase: 0.0 };
    for course in [table(vec![]), table(vec![[2.0, 0.0], [2.0, 1.0]]), swing(f64::NAN), swing(f64::INFINITY)]
    {
        let of_face = refusal(|s| s.courses.faces[1][0] = course.clone());
        assert_eq!(of_face, StartError::Course);
        assert_eq!(refusal(|s| s.courses.solids = vec![course.clone()]), StartError::Course);
    }
}

#[test]
fn nothing_to_compute() {
    for axis in 0..3 {
        assert_eq!(refusal(|s| s.extents[axis] = 0), StartError::NoFluid);
    }
    assert_eq!(refusal(|s| s.fluids.clear()), StartError::NoFluid);
    let solid = refusal(|s| {
        s.solids = vec![1; 24];
        s.solid_motion = vec![SolidMotion::default()];
    });
    assert_eq!(solid, StartError::NoFluid);
}

#[test]
fn too_many_cells() {
    assert!(matches!(
        refusal(|s| s.extents = [2000; 3]),
        StartError::TooManyCells { cells: 8_000_000_000, .. }
    ));
    // A product that overflows 64 bits.
    assert!(matches!(refusal(|s| s.extents = [usize::MAX; 3]), StartError::TooManyCells { .. }));
}

/// Single precision is in the fast backend only, and nothing is run in another precision than asked for.
#[test]
fn single_precision_is_refused_where_it_is_missing() {
    for precision in [Precision::Single, Precision::SingleStorage] {
        let error = refusal(|s| s.precision = precision);
        let message = "backend `plain` does not have populations in single precision";
        assert_eq!(error.to_string(), message);
        let mut setup = Setup::periodic([4, 3, 2], LAW);
        setup.precision = precision;
        assert!(Best.start(&setup).is_ok());
        setup.stress_source = true;
        let message = format!(
            "no backend has both {} precision and the experimental source in the third moments: choose double \
             precision",
            precision.name()
        );
        assert_eq!(Best.start(&setup).err().map(|e| e.to_string()), Some(message));
    }
}

#[test]
fn messages_name_what_and_where() {
    let message = refusal(|s| s.solids = vec![0; 23]).to_string();
    assert_eq!(message, "`solids` has 23 entries, but the box has 24 cells");
    let message = refusal(|s| s.faces[2][0] = Face::FreeSlip).to_string();
    assert_eq!(message, "axis z: one face is periodic and the other is not");
}

/// The guard names the first cell in index order and the step, whatever the number of threads.
#[test]
fn runaway_is_stopped_with_step_and_cell() {
    for threads in [1, 3] {
        let mut setup = Setup::periodic([20, 20, 20], LAW);
        setup.threads = threads;
        setup.speed_limit = 0.1;
        setup.initial = Some(std::sync::Arc::new(|cell| FlowPoint {
            density: 1.0,
            velocity: [if cell == [3, 2, 1] || cell == [9, 15, 18] { 0.2 } else { 0.0 }, 0.0, 0.0],
            gradient: [[0.0; 3]; 3],
        }));
        let mut run = Plain.start(&setup).expect("a consistent set-up");
        let stopped = run.advance(5).expect_err("too fast");
        assert_eq!((stopped.step, stopped.cell), (0, [3, 2, 1]));
        assert!(matches!(stopped.what, Runaway::TooFast { limit: 0.1, .. }), "{stopped:?}");
        // The populations are those of the step named.
        assert_eq!(run.step(), 0);
    }
}

#[test]
fn not_a_number_is_stopped() {
    let mut setup = Setup::periodic([3, 3, 3], LAW);
    setup.force = BodyForce::Constant([f64::NAN, 0.0, 0.0]);
    let mut run = Plain.start(&setup).expect("a force is not looked at before the first step");
    assert_eq!(run.advance(1).expect_err("not finite").what, Runaway::NotFinite);
    let mut setup = Setup::periodic([3, 3, 3], LAW);
    setup.initial = Some(std::sync::Arc::new(|_| FlowPoint {
        density: -1.0,
        velocity: [0.0; 3],
        gradient: [[0.0; 3]; 3],
    }));
    let mut run = Plain.start(&setup).expect("a density is not looked at before the first step");
    assert!(
        matches!(run.advance(1).expect_err("no density").what, Runaway::NoDensity { density } if density < 0.0)
    );
}
