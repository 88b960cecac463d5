//! The converter: known values, consistency between quantities, and round trips.

use lahar::units::Units;
use proptest::prelude::*;

/// Each way is at most six roundings of half a unit in the last place and one `pow` (below one
/// unit, libm); there and back stays below twice their sum.
const ROUND_TRIP: f64 = 16.0 * f64::EPSILON;

#[test]
fn exact_powers_of_two() {
    let units = Units::new(0.5, 0.25, 1024.0);
    assert_eq!(units.velocity_to_lattice(4.0), 2.0);
    assert_eq!(units.force_to_lattice(8192.0), 1.0);
    assert_eq!(units.stress_to_lattice(4096.0), 1.0);
    assert_eq!(units.viscosity_to_lattice(1024.0), 1.0);
    assert_eq!(units.consistency_to_lattice(1024.0, 1.0), units.viscosity_to_lattice(1024.0));
    assert_eq!(units.consistency_to_lattice(4096.0, 0.0), units.stress_to_lattice(4096.0));
    assert_eq!(units.rate_to_lattice(8.0), 2.0);
    assert_eq!(units.time_to_lattice(1.0), 4.0);
    assert_eq!(units.tau_of_viscosity(1024.0 / 6.0), 1.0);
    assert_eq!(units.pressure_of_density(1.75), 1024.0);
    assert_eq!(units.cell_centre_m([0, 1, 2]), [0.25, 0.75, 1.25]);
}

fn magnitude() -> impl Strategy<Value = f64> {
    (-6.0..6.0_f64).prop_map(libm::exp10)
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= ROUND_TRIP * b.abs()
}

proptest! {
    #[test]
    fn round_trips(dx in magnitude(), dt in magnitude(), rho in magnitude(), x in magnitude(), n in 0.05..5.0_f64) {
        let units = Units::new(dx, dt, rho);
        prop_assert!(close(units.velocity_to_si(units.velocity_to_lattice(x)), x));
        prop_assert!(close(units.force_to_si(units.force_to_lattice(x)), x));
        prop_assert!(close(units.stress_to_si(units.stress_to_lattice(x)), x));
        prop_assert!(close(units.viscosity_to_si(units.viscosity_to_lattice(x)), x));
        prop_assert!(close(units.consistency_to_si(units.consistency_to_lattice(x, n), n), x));
        prop_assert!(close(units.rate_to_si(units.rate_to_lattice(x)), x));
        prop_assert!(close(units.time_to_si(units.time_to_lattice(x)), x));
        prop_assert!(close(units.length_to_si(units.length_to_lattice(x)), x));
    }

    /// σ = K γ̇ⁿ holds in both systems at once.
    #[test]
    fn laws_commute_with_conversion(
        dx in magnitude(), dt in magnitude(), rho in magnitude(), k in magnitude(), rate in magnitude(), n in 0.05..5.0_f64,
    ) {
        let units = Units::new(dx, dt, rho);
        let si = units.stress_to_lattice(k * libm::pow(rate, n));
        let lattice = units.consistency_to_lattice(k, n) * libm::pow(units.rate_to_lattice(rate), n);
        // The rounding of a base is multiplied by n ≤ 5.
        prop_assert!((si - lattice).abs() <= 5.0 * ROUND_TRIP * si.abs(), "{si} {lattice}");
    }

    /// ρ0 u² is a stress, stress over length a force density, stress over rate a viscosity.
    #[test]
    fn units_are_consistent(dx in magnitude(), dt in magnitude(), rho in magnitude()) {
        let units = Units::new(dx, dt, rho);
        let u = units.velocity_unit();
        prop_assert!(close(units.stress_unit(), rho * u * u));
        prop_assert!(close(units.force_unit(), units.stress_unit() / dx));
        prop_assert!(close(units.viscosity_unit(), units.stress_unit() * dt));
    }
}
