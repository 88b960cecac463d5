use super::*;

const CENTRAL: Scheme = Scheme { operator: Operator::CentralMoment, walls: Walls::Independent };
const TRT: Scheme = Scheme { operator: Operator::Trt, walls: Walls::Independent };

fn run(scheme: Scheme, n: f64, error: f64, updates: f64) -> Point {
    Point { case: Case::ChannelBingham, scheme, n, step: 1.0, tau: 1.1, error, steps: 10, updates }
}

fn work() -> Work {
    let points = vec![
        run(TRT, 8.0, 4e-2, 90.0),
        run(TRT, 16.0, 1e-2, 800.0),
        run(CENTRAL, 16.0, 8e-3, 900.0),
        run(CENTRAL, 32.0, 2e-3, 7000.0),
    ];
    let speed = |scheme, backend: &str, nanoseconds| Speed {
        case: Case::ChannelBingham,
        scheme,
        backend: backend.to_owned(),
        nanoseconds,
    };
    let speeds =
        vec![speed(CENTRAL, "plain", 300.0), speed(CENTRAL, "fast", 100.0), speed(TRT, "plain", 100.0)];
    Work { points, speeds, measured: None }
}

#[test]
fn cheapest_run_that_reaches_the_target_and_the_default_where_costs_are_alike() {
    let chosen = |target| match recommend(&work(), Case::ChannelBingham, target) {
        Advice::Reached(choice) => Some((choice.point.scheme, choice.point.n, choice.seconds())),
        _ => None,
    };
    // 900 updates against 800 at the same speed: alike, so the default scheme.
    assert_eq!(chosen(1e-2), Some((CENTRAL, 16.0, Some(1e-9 * 100.0 * 900.0))));
    assert_eq!(chosen(5e-2).map(|c| (c.0, c.1)), Some((TRT, 8.0)));
    let Advice::Missed(best) = recommend(&work(), Case::ChannelBingham, 1e-3) else { panic!("not reached") };
    assert_eq!(best.point.error, 2e-3);
    assert_eq!(recommend(&work(), Case::Slump, 1e-2), Advice::Empty);
}

#[test]
fn expected_error_between_and_beyond_the_runs() {
    let at = |n| predicted(&work(), Case::ChannelBingham, TRT, 1.1, n);
    // The two runs lie on error = 2.56/N², a straight line between them.
    let (error, outside) = at(12.0).unwrap_or((f64::NAN, true));
    assert!((error - 2.56 / 144.0).abs() < 1e-15 && !outside, "{error}");
    let (error, outside) = at(64.0).unwrap_or((f64::NAN, false));
    assert!((error - 2.56 / 4096.0).abs() < 1e-15 && outside, "{error}");
    assert_eq!(predicted(&work(), Case::Slump, TRT, 1.1, 8.0), None);
}

#[test]
fn tables_read_back_as_written() {
    let work = work();
    let mut points: Vec<(Point, Option<String>)> = work.points.iter().map(|p| (*p, None)).collect();
    points.push((work.points[0], Some("stopped".to_owned())));
    let record = |table| ExhibitRecord {
        exhibit: String::new(),
        full: false,
        measured: None,
        data: crate::output::table::ExhibitData { tables: vec![table], ..Default::default() },
    };
    let back = Work::of(&record(table_of_points(&points)), &record(table_of_speeds(&work.speeds)));
    assert_eq!(back, work);
}

/// Every case is in the golden files, with a speed for every scheme that has a result.
#[test]
fn built_in_table_is_complete() {
    let work = Work::built_in().unwrap_or_else(|error| panic!("{error}"));
    assert!(work.measured.is_some());
    for case in Case::ALL {
        assert!(work.points.iter().any(|p| p.case == case), "{}", case.name());
    }
    for point in &work.points {
        let timed = work.speeds.iter().any(|s| s.case == point.case && s.scheme == point.scheme);
        assert!(timed, "{} with {}", point.case.name(), point.scheme.name());
    }
}
