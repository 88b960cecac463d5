//! Checks of the fluid, its layers, the solids and gravity.

use std::collections::HashSet;

use crate::geometry::Axis;
use crate::scene::checker::Checker;
use crate::scene::{
    BodyForce, Boundary, Domain, Gravity, InitialVelocity, KeyRule, Scene, SceneError, SceneProblem,
};
use crate::vector::norm;

/// Solids and layers are numbered in one byte, 0 being fluid (or the first fluid).
const MAX_ENTRIES: usize = 255;

pub(in crate::scene) fn check_gravity(at: &Checker, gravity: &Gravity) -> Result<(), SceneError> {
    let path = "gravity.magnitude_m_per_s2";
    let magnitude = gravity.magnitude_m_per_s2;
    at.not_negative(path, magnitude, "m/s²", "its direction is a key of its own", "turn `direction` round")?;
    match (gravity.direction, gravity.slope_deg) {
        (Some(direction), None) => {
            at.direction("gravity.direction", direction, "[0, 0, -1] for downward along z")?;
            at.ensure(gravity.bed_normal.is_none(), "gravity.bed_normal", || SceneProblem::UnusedKey {
                key: "bed_normal",
                because: "it belongs to `slope_deg`",
            })
        }
        (None, Some(slope)) => {
            at.ensure((-90.0..=90.0).contains(&slope), "gravity.slope_deg", || SceneProblem::OutOfRange {
                found: slope,
                unit: "degrees",
                low: -90.0,
                high: 90.0,
                because: "from vertical to vertical",
                way_out: "use `direction` for anything else",
            })?;
            at.ensure(gravity.bed_normal != Some(Axis::X), "gravity.bed_normal", || SceneProblem::UnusedKey {
                key: "bed_normal",
                because: "x is the downhill axis; the bed is normal to y or z",
            })
        }
        (direction, slope) => {
            let found = if direction.is_some() && slope.is_some() { OF.to_vec() } else { Vec::new() };
            let because = "both say where gravity points";
            at.fail("gravity", SceneProblem::KeyCount { found, of: OF, rule: KeyRule::ExactlyOne, because })
        }
    }
}

const OF: &[&str] = &["direction", "slope_deg"];

pub(super) fn check_fluid(at: &Checker, scene: &Scene) -> Result<(), SceneError> {
    let fluid = &scene.fluid;
    let density = fluid.density_kg_per_m3;
    at.positive("fluid.density_kg_per_m3", density, "kg/m³", "it is the mass unit", "1000 for water")?;
    fluid.rheology.check(at, "fluid.rheology")?;
    match fluid.body_force {
        // Without an amplitude nothing oscillates: a sweep over it may begin at 0.
        Some(BodyForce::Oscillating { amplitude_n_per_m3: [0.0, 0.0, 0.0], frequency_hz: 0.0, .. }) => {}
        Some(BodyForce::Oscillating { frequency_hz, .. }) => {
            let path = "fluid.body_force.oscillating.frequency_hz";
            at.positive(path, frequency_hz, "1/s", "it is a frequency", "use `constant` for a steady force")?;
        }
        Some(BodyForce::Stepped { at_s, .. }) => {
            let path = "fluid.body_force.stepped.at_s";
            at.not_negative(path, at_s, "s", "runs start at 0 s", "use `constant` with the force after")?;
            at.ensure(at_s <= scene.stop.end_time_s, path, || SceneProblem::BeyondEnd {
                found: at_s,
                end: scene.stop.end_time_s,
            })?;
        }
        Some(BodyForce::Constant { .. }) | None => {}
    }
    initial_velocity(at, &scene.domain, &fluid.initial_velocity)
}

pub(super) fn check_layers(at: &Checker, scene: &Scene) -> Result<(), SceneError> {
    let found = scene.layers.len();
    at.ensure(found < MAX_ENTRIES, "layers", || SceneProblem::TooMany { found, max: MAX_ENTRIES - 1 })?;
    let mut names = HashSet::new();
    for (i, layer) in scene.layers.iter().enumerate() {
        let path = format!("layers[{i}]");
        at.name(&format!("{path}.name"), &layer.name, &mut names)?;
        at.shape(&format!("{path}.shape"), &layer.shape, scene.domain.size_m, false)?;
        layer.rheology.check(at, &format!("{path}.rheology"))?;
    }
    Ok(())
}

pub(super) fn check_solids(at: &Checker, scene: &Scene) -> Result<(), SceneError> {
    let found = scene.solids.len();
    at.ensure(found <= MAX_ENTRIES, "solids", || SceneProblem::TooMany { found, max: MAX_ENTRIES })?;
    let mut names = HashSet::new();
    for (i, solid) in scene.solids.iter().enumerate() {
        let path = format!("solids[{i}]");
        at.name(&format!("{path}.name"), &solid.name, &mut names)?;
        at.shape(&format!("{path}.shape"), &solid.shape, scene.domain.size_m, solid.invert)?;
    }
    Ok(())
}

fn initial_velocity(at: &Checker, domain: &Domain, flow: &InitialVelocity) -> Result<(), SceneError> {
    match *flow {
        InitialVelocity::AtRest | InitialVelocity::Uniform { .. } => Ok(()),
        InitialVelocity::ShearWave { amplitude_m_per_s, wave_counts, .. } => {
            let path = "fluid.initial_velocity.shear_wave";
            waves(at, &format!("{path}.wave_counts"), domain, wave_counts.map(i64::from))?;
            let k: [f64; 3] = std::array::from_fn(|a| f64::from(wave_counts[a]) / domain.size_m[a]);
            let dot = (0..3).map(|a| k[a] * amplitude_m_per_s[a]).sum::<f64>();
            let size = norm(k) * norm(amplitude_m_per_s);
            let found = if size > 0.0 { dot / size } else { 0.0 };
            // Rounding of the three products; anything larger is a wave with divergence.
            at.ensure(found.abs() <= 1e-12, &format!("{path}.amplitude_m_per_s"), || {
                SceneProblem::NotTransverse { found }
            })
        }
        InitialVelocity::TaylorGreen { normal, wave_counts, .. } => {
            let path = "fluid.initial_velocity.taylor_green.wave_counts";
            let [a, b] = normal.others();
            let mut counts = [0; 3];
            (counts[a], counts[b]) = (i64::from(wave_counts[0]), i64::from(wave_counts[1]));
            at.ensure(!wave_counts.contains(&0), path, || SceneProblem::NoWave)?;
            waves(at, path, domain, counts)
        }
        InitialVelocity::TaylorGreen3d { wave_counts, .. } => {
            equal_waves(at, "fluid.initial_velocity.taylor_green_3d.wave_counts", domain, wave_counts)
        }
        InitialVelocity::Abc { wave_counts, .. } => {
            equal_waves(at, "fluid.initial_velocity.abc.wave_counts", domain, wave_counts)
        }
    }
}

fn waves(at: &Checker, path: &str, domain: &Domain, counts: [i64; 3]) -> Result<(), SceneError> {
    at.ensure(counts != [0; 3], path, || SceneProblem::NoWave)?;
    for (axis, faces) in Axis::ALL.into_iter().zip(domain.boundaries.by_axis()) {
        let count = counts[axis.index()];
        at.ensure(count == 0 || faces[0] == Boundary::Periodic, path, || SceneProblem::WaveAcrossWall {
            axis: axis.letter(),
            count,
        })?;
    }
    Ok(())
}

fn equal_waves(at: &Checker, path: &str, domain: &Domain, counts: [u32; 3]) -> Result<(), SceneError> {
    at.ensure(!counts.contains(&0), path, || SceneProblem::NoWave)?;
    waves(at, path, domain, counts.map(i64::from))?;
    let lengths: [f64; 3] = std::array::from_fn(|a| domain.size_m[a] / f64::from(counts[a]));
    // Equal up to the rounding of decimal edge lengths.
    let equal = lengths.iter().all(|l| (l / lengths[0] - 1.0).abs() < 1e-12);
    at.ensure(equal, path, || SceneProblem::UnequalWaves { lengths })
}
