//! A sphere that slides and rolls under Coulomb friction.
//!
//! In the discrete element method friction acts at the arm r − δ from the centre, and the formulas hold exactly
//! with that arm; at full r they are the limit of rigid bodies. `q` is arm²/(I/m) = (5/2)(arm/r)², 5/2 when rigid.

/// q for an arm given as a share of the radius.
pub fn arm_ratio(arm_over_radius: f64) -> f64 {
    2.5 * arm_over_radius * arm_over_radius
}

/// A sphere thrown without spin: final speed over the first, q/(1 + q); 5/7 when rigid.
pub fn rolling_speed(q: f64) -> f64 {
    q / (1.0 + q)
}

/// Time at which it rolls, v₀/(μ g (1 + q)), s; 2 v₀/(7 μ g) when rigid.
pub fn rolling_time(q: f64, v0: f64, mu: f64, g: f64) -> f64 {
    v0 / (mu * g * (1.0 + q))
}

/// Distance until then, v₀ t − ½ μ g t², m; 12 v₀²/(49 μ g) when rigid.
pub fn rolling_distance(q: f64, v0: f64, mu: f64, g: f64) -> f64 {
    let t = rolling_time(q, v0, mu, g);
    v0 * t - 0.5 * mu * g * t * t
}

/// Tangent of the slope beyond which a sphere slips, μ (1 + q); 3.5 μ when rigid.
pub fn slip_slope(q: f64, mu: f64) -> f64 {
    mu * (1.0 + q)
}

/// Acceleration (m/s²) down a slope of angle `theta` (rad): q/(1 + q) g sin θ rolling, g (sin θ − μ cos θ) slipping.
pub fn incline_acceleration(q: f64, mu: f64, g: f64, theta: f64) -> f64 {
    let (sin, cos) = (libm::sin(theta), libm::cos(theta));
    if sin <= slip_slope(q, mu) * cos { rolling_speed(q) * g * sin } else { g * (sin - mu * cos) }
}

/// Deceleration (m/s²) of a sphere that rolls on a level floor against the torque μ_r r m g:
/// μ_r g (r/arm) q/(1 + q); (5/7) μ_r g when rigid.
pub fn rolling_deceleration(q: f64, arm_over_radius: f64, rolling_friction: f64, g: f64) -> f64 {
    rolling_friction * g / arm_over_radius * rolling_speed(q)
}

/// Rate at which a sphere's path circles on a turntable, over the table's: 1/(1 + q); 2/7 when rigid.
///
/// # Source
/// Weltner 1979, Am. J. Phys. 47, 984.
pub fn turntable_rate(q: f64) -> f64 {
    1.0 / (1.0 + q)
}

/// Period (s) of a rigid sphere that rolls without slip in a trough, its centre at `l` from the trough's axis, let
/// go at `angle` (rad) from the lowest place: 4 √(7 l/(5 g)) K(sin² ½θ).
pub fn rolling_pendulum(l: f64, g: f64, angle: f64) -> f64 {
    let k = libm::sin(0.5 * angle);
    4.0 * (1.4 * l / g).sqrt() * super::top::elliptic_k(k * k)
}

/// Oblique impact of a rigid sphere without spin on a plane, slipping to the end: tangential speed and surface
/// speed of rotation afterwards, v_t − μ(1 + e) v_n and (5/2) μ (1 + e) v_n.
///
/// # Returns
/// `None` if the sphere would stick before the end, v_t < (7/2) μ (1 + e) v_n.
pub fn oblique_slip(normal: f64, tangential: f64, restitution: f64, mu: f64) -> Option<(f64, f64)> {
    let impulse = mu * (1.0 + restitution) * normal;
    (tangential >= 3.5 * impulse).then_some((tangential - impulse, 2.5 * impulse))
}

/// Oblique impact that sticks throughout on undamped linear springs, tangential over normal stiffness `ratio`:
/// tangential speed and surface speed of rotation afterwards, for a tangential speed `v` before.
///
/// The contact point feels the mass 2m/7, so its velocity turns by the phase π √(7 ratio/2) while the normal
/// spring goes through half a period; of a change of u at the contact point 2/7 belongs to the centre and 5/7 to
/// the rotation.
pub fn oblique_stick(v: f64, ratio: f64) -> (f64, f64) {
    let after = v * libm::cos(core::f64::consts::PI * (3.5 * ratio).sqrt());
    let change = v - after;
    (v - 2.0 / 7.0 * change, 5.0 / 7.0 * change)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference_values::find;

    #[test]
    fn reference_rigid_limits() {
        let entry = find("sliding_to_rolling", &[]).unwrap();
        for (key, value) in [
            ("v_final_over_v0", rolling_speed(2.5)),
            ("t_roll", rolling_time(2.5, 1.0, 0.3, 9.81)),
            ("x_roll", rolling_distance(2.5, 1.0, 0.3, 9.81)),
        ] {
            assert!((value / entry.field(key).unwrap() - 1.0).abs() < entry.tolerance(), "{key} {value}");
        }
        let entry = find("incline_roll", &[]).unwrap();
        let at = |deg: f64| incline_acceleration(2.5, 0.3, 9.81, deg.to_radians());
        for (key, value) in [
            ("theta_crit_deg", libm::atan(slip_slope(2.5, 0.3)).to_degrees()),
            ("a_roll_30", at(30.0)),
            ("a_slip_60", at(60.0)),
        ] {
            assert!((value / entry.field(key).unwrap() - 1.0).abs() < entry.tolerance(), "{key} {value}");
        }
    }

    /// Angular momentum about the contact point, v − (2/5) r ω in these signs, is the same before and after.
    #[test]
    fn conserves_angular_momentum_of_impacts() {
        for (v, w) in [oblique_slip(1.0, 3.0, 0.8, 0.1).unwrap(), oblique_stick(3.0, 0.2)] {
            assert!((v + 0.4 * w - 3.0).abs() < 1e-15);
        }
        assert_eq!(oblique_slip(1.0, 0.1, 0.8, 0.1), None);
        // Half a period of the tangential spring turns the contact point's velocity over.
        let (v, w) = oblique_stick(1.0, 2.0 / 7.0);
        assert!((v - w + 1.0).abs() < 1e-15);
    }
}
