//! One sphere in an unbounded Bingham fluid, no inertia: when it moves, and with which drag.
//!
//! Yield number Y = 2πR²σ_y/F with F the force on the sphere (for weight less buoyancy 3σ_y/(2RΔρg)); Bingham number
//! Bn = 2Rσ_y/(μV) with the plastic viscosity μ and the speed V. Drag is F/(6πμRV), so that Y = Bn/(6·drag).
//! The fluid sticks to the sphere and its yield criterion is that of von Mises.

use core::f64::consts::PI;

use super::super::ExactError;
use super::within;

/// Largest yield number at which a sphere moves.
///
/// # Source
/// Beris, Tsamopoulos, Armstrong & Brown 1985, J. Fluid Mech. 158, 219-244, doi 10.1017/S0022112085002622: 0.143
/// (checked against the abstract). Computed by finite elements; other computations give 0.142 to 0.1436 (from memory),
/// so take ±0.001. Experiments scatter far more, with slip and thixotropy.
pub const CRITICAL_YIELD: f64 = 0.143;

/// Uncertainty of [`CRITICAL_YIELD`].
pub const CRITICAL_YIELD_UNCERTAINTY: f64 = 0.001;

/// Largest Bingham number of [`drag_fit`].
pub const LARGEST_BINGHAM: f64 = 100.0;

/// Y = 2πR²σ_y/F.
///
/// # Arguments
/// `yield_stress` ≥ 0, `radius` > 0, `force` > 0; consistent units.
/// # Errors
/// `Argument` if force or radius is not positive or the yield stress is negative.
pub fn yield_number(yield_stress: f64, radius: f64, force: f64) -> Result<f64, ExactError> {
    within("yield_stress", yield_stress, 0.0, f64::MAX, "must not be negative")?;
    ExactError::positive("radius", radius)?;
    ExactError::positive("force", force)?;
    Ok(2.0 * PI * radius * radius * yield_stress / force)
}

/// Yield stress that just holds a sphere against its weight less buoyancy: 0.143 · (2/3) R |Δρ| g.
///
/// # Errors
/// `Argument` unless radius and gravity are positive.
pub fn holding_yield_stress(radius: f64, excess_density: f64, gravity: f64) -> Result<f64, ExactError> {
    ExactError::positive("radius", radius)?;
    ExactError::positive("gravity", gravity)?;
    Ok(CRITICAL_YIELD * 2.0 / 3.0 * radius * excess_density.abs() * gravity)
}

/// Drag over 6πμRV: 1 + 2.93 Bn^0.83.
///
/// # Arguments
/// `bingham`: 0 to 100. The fit was made up to larger Bn, but beyond about 200 it falls below
/// [`least_drag`], which no moving sphere can do.
/// # Exactness
/// No error is printed with the fit; its distance from the computed points is taken as 5 % (engineering judgement).
/// # Errors
/// `Argument` outside the range.
/// # Source
/// Blackery & Mitsoulis 1997, J. Non-Newtonian Fluid Mech. 70, 59-77 (coefficients from memory), computed with a
/// regularised law in a tube fifty times as wide, which bounds its use for Bn → 0 (Newtonian wall factor 1.04).
pub fn drag_fit(bingham: f64) -> Result<f64, ExactError> {
    within("bingham", bingham, 0.0, LARGEST_BINGHAM, "must lie between 0 and 100")?;
    Ok(1.0 + 2.93 * libm::pow(bingham, 0.83))
}

/// Lower bound on the drag of a moving sphere over 6πμRV: max(1, Bn/(6 · 0.143)).
///
/// A sphere moves only at Y below critical, and Y = Bn/(6·drag); dissipation is at least the Newtonian one.
/// The second bound is also the limit Bn → ∞ (plastic flow), reached with a boundary layer.
///
/// # Errors
/// `Argument` if Bn is negative.
pub fn least_drag(bingham: f64) -> Result<f64, ExactError> {
    within("bingham", bingham, 0.0, f64::MAX, "must not be negative")?;
    Ok((bingham / (6.0 * CRITICAL_YIELD)).max(1.0))
}

/// Drag over 6πμRV by the equivalent Reynolds number of Ansley & Smith, 1 + (7π/24) Bn.
///
/// An estimate from plasticity theory, not a solution: between 0.4 and 0.8 of [`drag_fit`] for 1 ≤ Bn ≤ 100, below even
/// [`least_drag`] at large Bn. For comparison only.
///
/// # Errors
/// `Argument` if Bn is negative.
/// # Source
/// Ansley & Smith 1967, AIChE J. 13, 1193-1196, doi 10.1002/aic.690130629 (from memory).
pub fn ansley_smith(bingham: f64) -> Result<f64, ExactError> {
    within("bingham", bingham, 0.0, f64::MAX, "must not be negative")?;
    Ok(1.0 + 7.0 * PI / 24.0 * bingham)
}

/// Speed at which [`drag_fit`] balances a force: `None` at or above the critical yield number.
///
/// # Arguments
/// `mu`: plastic viscosity; `yield_stress` ≥ 0; `radius`; `force` > 0; consistent units.
/// # Errors
/// `Argument` for bad arguments, and where the fit's range ends below the critical number (0.124 < Y < 0.143).
pub fn terminal_speed(
    mu: f64,
    yield_stress: f64,
    radius: f64,
    force: f64,
) -> Result<Option<f64>, ExactError> {
    ExactError::positive("mu", mu)?;
    let target = yield_number(yield_stress, radius, force)?;
    if target >= CRITICAL_YIELD {
        return Ok(None);
    }
    if target == 0.0 {
        return Ok(Some(force / (6.0 * PI * mu * radius)));
    }
    // Y(Bn) = Bn/(6 drag) grows with Bn: bisection.
    let at = |bn: f64| drag_fit(bn).map(|drag| bn / (6.0 * drag));
    within("yield number", target, 0.0, at(LARGEST_BINGHAM)?, "beyond the range of the drag fit (Bn = 100)")?;
    let (mut low, mut high) = (0.0, LARGEST_BINGHAM);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if at(middle)? < target { low = middle } else { high = middle }
    }
    Ok(Some(2.0 * radius * yield_stress / (mu * high)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limit_newtonian_and_plastic() {
        assert_eq!(drag_fit(0.0).unwrap(), 1.0);
        for i in 0..=100 {
            let bn = f64::from(i);
            assert!(drag_fit(bn).unwrap() >= least_drag(bn).unwrap(), "{bn}");
        }
        // The fit crosses the bound near 226: its range must end before.
        let beyond = 1.0 + 2.93 * libm::pow(300.0, 0.83);
        assert!(beyond < least_drag(300.0).unwrap());
        for bn in [1.0, 10.0, 100.0] {
            let ratio = ansley_smith(bn).unwrap() / drag_fit(bn).unwrap();
            assert!((0.4..0.8).contains(&ratio), "{bn} {ratio}");
        }
    }

    #[test]
    fn terminal_speed_balances_the_force() {
        let (mu, stress, radius, force) = (0.4, 2.0, 0.3, 40.0);
        let speed = terminal_speed(mu, stress, radius, force).unwrap().unwrap();
        let bn = 2.0 * radius * stress / (mu * speed);
        let balance = 6.0 * PI * mu * radius * speed * drag_fit(bn).unwrap() / force;
        assert!((balance - 1.0).abs() < 1e-12, "{balance}");
        assert_eq!(terminal_speed(mu, 0.0, radius, 6.0 * PI * mu * radius).unwrap(), Some(1.0));
        // At the holding stress Y is critical: weight (4/3)πR³Δρg.
        let hold = holding_yield_stress(radius, -1500.0, 9.81).unwrap();
        let weight = 4.0 / 3.0 * PI * radius * radius * radius * 1500.0 * 9.81;
        assert!((yield_number(hold, radius, weight).unwrap() - CRITICAL_YIELD).abs() < 1e-15);
        assert_eq!(terminal_speed(mu, 1.001 * hold, radius, weight).unwrap(), None);
        assert!(terminal_speed(mu, 0.95 * hold, radius, weight).is_err());
        // σ_y/(Δρ g d) ≥ 0.0477, the same statement.
        assert!((hold / (1500.0 * 9.81 * 2.0 * radius) - 0.0477).abs() < 5e-5);
    }
}
