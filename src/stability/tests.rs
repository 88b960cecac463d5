use super::table::{Column, OPERATORS, Row, TAUS};
use super::*;
use crate::collision::OddRate;
use crate::lattice::{C, Q};

#[test]
fn conserves_mass_and_momentum_linearly() {
    for (name, operator) in OPERATORS {
        let linearised = Linearised::about(&operator, 0.6, [0.05, -0.03, 0.08]);
        for (j, c) in C.iter().enumerate() {
            let sum = |weight: &dyn Fn(usize) -> f64| {
                (0..Q).map(|i| weight(i) * linearised.jacobian()[i][j]).sum::<f64>()
            };
            let mut pairs = vec![(sum(&|_| 1.0), 1.0)];
            pairs.extend((0..3).map(|a| (sum(&|i| f64::from(C[i][a])), f64::from(c[a]))));
            for (sum, expected) in pairs {
                // About 200 operations on numbers of order one.
                assert!((sum - expected).abs() < 200.0 * f64::EPSILON, "{name}: {sum} {expected}");
            }
        }
    }
}

#[test]
fn symmetric_waves_grow_alike() -> Result<(), StabilityError> {
    // The search looks at one wave of each set of mirror images only.
    for (name, operator) in OPERATORS {
        let linearised = Linearised::about(&operator, 0.52, Direction::Xy.velocity(0.1));
        let radius = |k| linearised.spectral_radius(k);
        let first = radius([0.7, -1.9, 2.3])?;
        for image in [[-1.9, 0.7, 2.3], [0.7, -1.9, -2.3], [-0.7, 1.9, -2.3], [1.9, -0.7, 2.3]] {
            // A simple eigenvalue of a matrix of order one, condition below 1e3.
            assert!((radius(image)? - first).abs() < 1e-12, "{name}");
        }
    }
    Ok(())
}

#[test]
fn wrong_tau_is_refused() {
    for tau in [0.5, 0.2, f64::NAN] {
        assert!(matches!(max_stable_speed(&CollisionChoice::Bgk, tau), Err(StabilityError::Tau { .. })));
    }
}

#[test]
#[ignore = "writes src/stability/table.json; takes some minutes for each operator that is not in it"]
fn writes_the_stability_table() -> Result<(), Box<dyn std::error::Error>> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/stability/table.json");
    let mut columns = Vec::new();
    for (name, collision) in OPERATORS {
        if let Some(kept) = table::table().iter().find(|column| column.collision == collision) {
            columns.push(kept.clone());
            continue;
        }
        let mut rows = Vec::new();
        for tau in TAUS {
            let search = if tau < 0.52 { Search::THOROUGH } else { Search::SMOOTH };
            rows.push(Row::compute(&collision, tau, &search)?);
            eprintln!("{name} {tau}: {:?}", rows.last().map(|row: &Row| row.limits.map(|l| l.speed)));
        }
        columns.push(Column { collision, rows });
        std::fs::write(path, serde_json::to_string_pretty(&columns)? + "\n")?;
    }
    Ok(())
}

#[test]
fn regress_table_entries_found_again() -> Result<(), StabilityError> {
    for (operator, tau) in [(0, 0.6), (1, 0.51), (3, 0.55), (4, 1.0), (6, 0.55)] {
        let (name, collision) = OPERATORS[operator];
        let kept = table::interpolated(&collision, tau).unwrap_or(f64::NAN);
        let found = Row::compute(&collision, tau, &Search::QUICK)?.least();
        // A coarser search finds higher bounds; both converge to 1e-5 where the limit is smooth.
        assert!((found / kept - 1.0).abs() < 0.01, "{name} {tau}: {found} {kept}");
    }
    Ok(())
}

#[test]
fn reference_same_operator_same_limits() {
    // Above τ⁺ = ½ + 0.15 the two have one rate of odd moments.
    let limits = |odd| {
        table::table()
            .iter()
            .filter(move |column| column.collision == CollisionChoice::CentralMoment(odd))
            .flat_map(|column| column.rows.iter().filter(|row| row.tau >= 0.65).map(Row::least))
            .collect::<Vec<f64>>()
    };
    let (all, among_grains) = (limits(OddRate::STANDARD), limits(OddRate::AMONG_GRAINS));
    assert_eq!((all.len(), among_grains.len()), (12, 12));
    // A search converges to 1e-5.
    let apart = all.iter().zip(&among_grains).any(|(a, b)| (a / b - 1.0).abs() > 1e-5);
    assert!(!apart, "{all:?} {among_grains:?}");
}

#[test]
fn limit_between_rows_lies_between_them() {
    let at = |tau| max_stable_speed(&CollisionChoice::Bgk, tau).map_or(f64::NAN, |l| l.speed);
    assert!(at(0.52) < at(0.53) && at(0.53) < at(0.535));
    assert!(at(0.500_25) < at(0.5005));
    assert_eq!(at(f64::INFINITY), at(100.0));
    let rigid = max_stable_speed(&CollisionChoice::default(), f64::INFINITY);
    assert_eq!(rigid, Ok(StabilityLimit { speed: 0.0, exact: false }));
}
