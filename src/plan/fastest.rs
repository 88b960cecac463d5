//! The largest speed that forces, walls, fall and grains can give to a fluid: more is the solver's.

use super::facts::Facts;
use super::scale::GivenSpeeds;
use crate::scene::force::gravity_vector;
use crate::units::Units;

/// How many times that speed is let pass: jets and splashes gather energy from around them.
const FACTOR: f64 = 5.0;

/// Cells per step below which no speed stops a run: waves of sound and errors of surfaces are of that size.
const LEAST: f64 = 0.05;

/// Speed beyond which a run is stopped, cells per step; `limit`: that for every flow.
///
/// Energy per mass: a pressure or a fall over the length L of the box gives ½u² = aL to what it accelerates by a, once; along
/// a periodic axis it goes on for the time T of the run, aT. Walls give their speed to what they drag along. Solids and grains
/// push fluid out of their way: out of a gap of one cell, U N/2 for N cells across.
///
/// # Arguments
/// `given`: speeds at the start and of walls, m/s.
/// # Source
/// Bernoulli along a streamline; continuity.
#[must_use]
pub(super) fn limit(facts: &Facts, units: &Units, given: &GivenSpeeds, limit: f64) -> f64 {
    let (scene, rho) = (facts.scene, facts.scene.fluid.density_kg_per_m3);
    let weight = scene.gravity.as_ref().map_or([0.0; 3], gravity_vector);
    let expected = scene.numerics.reference_velocity_m_per_s.unwrap_or(0.0);
    let mut speed = (given.fluid + given.faces).max(expected);
    for a in 0..3 {
        let forced = facts.forces.extremes.iter().map(|f| (f[a] / rho).abs()).fold(0.0, f64::max);
        let by = forced.max(weight[a].abs());
        speed += (2.0 * by * scene.domain.size_m[a]).sqrt();
        if !facts.closed[a] {
            speed += by * scene.stop.end_time_s;
        }
    }
    let across = scene.domain.size_m.into_iter().fold(0.0, f64::max) / units.dx_m;
    if scene.grains.is_some() || given.bodies > 0.0 {
        // Grains have the speed of what falls or flows, besides what they were given.
        speed += 0.5 * across * (given.bodies + if scene.grains.is_some() { speed } else { 0.0 });
    }
    let found = FACTOR * units.velocity_to_lattice(speed);
    // NaN and infinity leave the limit as it is.
    if found < limit { found.max(LEAST) } else { limit }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::flow_from_json;

    fn limit_of(more: &str, dt: f64) -> f64 {
        let text = format!(
            r#"{{ "domain": {{ "size_m": [0.5, 0.2, 0.2], "spacing_m": 0.01, "boundaries": {{ "x_min": "no_slip",
            "x_max": "no_slip", "z_min": "no_slip", "z_max": "no_slip" }} }},
            "fluid": {{ "density_kg_per_m3": 1000, "rheology": {{ "newtonian": {{ "viscosity_pa_s": 1 }} }} }},
            {more} "stop": {{ "end_time_s": 0.1 }} }}"#
        );
        let scene = flow_from_json(&text, "limit.json", std::path::Path::new(".")).unwrap();
        let given = GivenSpeeds { fluid: 0.25, faces: 0.25, bodies: 0.0 };
        limit(&Facts::of(&scene), &Units::new(0.01, dt, 1000.0), &given, 0.4)
    }

    #[test]
    fn exact_limits() {
        let gravity =
            |axis: &str| format!(r#""gravity": {{ "magnitude_m_per_s2": 10, "direction": [{axis}] }},"#);
        // 5 (0.5 + √(2 · 10 · 0.2)) m/s = 12.5 m/s; along y, which is periodic, 10 · 0.1 m/s more.
        assert!((limit_of(&gravity("0, 0, -1"), 1e-4) - 0.125).abs() < 1e-12);
        assert!((limit_of(&gravity("0, -1, 0"), 1e-4) - 0.175).abs() < 1e-12);
        // Never above the limit of every flow, nor below what waves have.
        assert_eq!(limit_of(&gravity("0, 0, -1"), 1e-3), 0.4);
        assert_eq!(limit_of(&gravity("0, 0, -1"), 1e-6), LEAST);
        assert_eq!(limit_of("", 1e-6), LEAST);
    }
}
