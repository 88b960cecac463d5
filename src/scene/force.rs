//! What acts on the fluid of a scene, SI: gravity, body force, and what of them the fluid is computed with.

use super::{BodyForce, Gravity, Scene};
use crate::geometry::Axis;
pub use crate::vector::norm;

/// Gravity's force per volume, N/m³: ρ0 g.
#[must_use]
pub(crate) fn gravity_force(gravity: &Gravity, density: f64) -> [f64; 3] {
    let weight = density * gravity.magnitude_m_per_s2;
    if let Some(direction) = gravity.direction {
        let norm = norm(direction);
        return direction.map(|d| weight * d / norm);
    }
    let slope = gravity.slope_deg.unwrap_or(0.0).to_radians();
    let mut force = [weight * libm::sin(slope), 0.0, 0.0];
    force[gravity.bed_normal.unwrap_or(Axis::Z).index()] = -weight * libm::cos(slope);
    force
}

/// Acceleration of gravity, m/s².
#[must_use]
pub(crate) fn gravity_vector(gravity: &Gravity) -> [f64; 3] {
    gravity_force(gravity, 1.0)
}

/// What acts on the fluid of a scene, N/m³, worked out once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Forces {
    /// Acceleration of gravity, m/s²; 0 without gravity.
    pub gravity: [f64; 3],
    /// Axes along which the pressure of the fluid at rest is left out ([`Scene::weightless_axes`]).
    pub weightless: [bool; 3],
    /// Axes along which a uniform pressure gradient carries the weight ([`Scene::balanced_axes`]).
    pub balanced: [bool; 3],
    /// Body force with gravity in it.
    pub total: BodyForce,
    /// Body force that the fluid is computed with: without its weight along `weightless` axes.
    pub computed: BodyForce,
    /// What of it drives a flow: not the weight that a uniform pressure gradient carries either.
    pub driving: BodyForce,
    /// Extremes of the total force ([`extreme_forces`]); the first is the one that levels and slopes follow.
    pub extremes: [[f64; 3]; 2],
    /// Extremes of the driving force.
    pub driving_extremes: [[f64; 3]; 2],
    /// The normal of the bed where gravity is given by `slope_deg`; else the axis of the strongest component of the total
    /// force, z before y before x; z without a force.
    pub up: Axis,
    /// Whether that component points to smaller coordinates; true without a force.
    pub down_is_low: bool,
}

impl Forces {
    /// Of a scene.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let (weightless, balanced) = (scene.weightless_axes(), scene.balanced_axes());
        let total = force_without_weight(scene, [false; 3]);
        let driving = force_without_weight(scene, std::array::from_fn(|a| weightless[a] || balanced[a]));
        let extremes = extreme_forces(&total);
        // A bed with a slope stays what it is however steep it is.
        let bed = scene.gravity.filter(|gravity| gravity.slope_deg.is_some());
        let bed = bed.map(|gravity| gravity.bed_normal.unwrap_or(Axis::Z));
        let (up, down_is_low) = match bed {
            Some(axis) => (axis, extremes.iter().all(|force| force[axis.index()] <= 0.0)),
            None => strongest(&extremes),
        };
        Self {
            gravity: scene.gravity.map_or([0.0; 3], |gravity| gravity_vector(&gravity)),
            weightless,
            balanced,
            total,
            computed: force_without_weight(scene, weightless),
            driving,
            extremes,
            driving_extremes: extreme_forces(&driving),
            up,
            down_is_low,
        }
    }

    /// [`Self::up`]; `None` without a force.
    #[must_use]
    pub(crate) fn up_axis(&self) -> Option<Axis> {
        self.extremes.iter().flatten().any(|f| *f != 0.0).then_some(self.up)
    }
}

impl Scene {
    /// The axis normal to beds and levels: that of `bed_normal`, else the one along which gravity and body force are strongest
    /// (z before y before x); `None` without a force.
    #[must_use]
    pub(crate) fn up_axis(&self) -> Option<Axis> {
        Forces::of(self).up_axis()
    }
}

fn force_without_weight(scene: &Scene, without: [bool; 3]) -> BodyForce {
    let weight =
        scene.gravity.map_or([0.0; 3], |gravity| gravity_force(&gravity, scene.fluid.density_kg_per_m3));
    let weight: [f64; 3] = std::array::from_fn(|a| if without[a] { 0.0 } else { weight[a] });
    let plus = |f: [f64; 3]| std::array::from_fn(|a| f[a] + weight[a]);
    match scene.fluid.body_force {
        None => BodyForce::Constant { force_n_per_m3: weight },
        Some(BodyForce::Constant { force_n_per_m3 }) => {
            BodyForce::Constant { force_n_per_m3: plus(force_n_per_m3) }
        }
        Some(BodyForce::Oscillating { mean_n_per_m3, amplitude_n_per_m3, frequency_hz, phase_rad }) => {
            let mean_n_per_m3 = plus(mean_n_per_m3);
            BodyForce::Oscillating { mean_n_per_m3, amplitude_n_per_m3, frequency_hz, phase_rad }
        }
        Some(BodyForce::Stepped { before_n_per_m3, after_n_per_m3, at_s }) => BodyForce::Stepped {
            before_n_per_m3: plus(before_n_per_m3),
            after_n_per_m3: plus(after_n_per_m3),
            at_s,
        },
    }
}

/// Forces whose magnitudes bound the body force at all times.
#[must_use]
pub(crate) fn extreme_forces(force: &BodyForce) -> [[f64; 3]; 2] {
    match *force {
        BodyForce::Constant { force_n_per_m3 } => [force_n_per_m3; 2],
        BodyForce::Oscillating { mean_n_per_m3: m, amplitude_n_per_m3: a, .. } => {
            [std::array::from_fn(|i| m[i] + a[i]), std::array::from_fn(|i| m[i] - a[i])]
        }
        BodyForce::Stepped { before_n_per_m3, after_n_per_m3, .. } => [before_n_per_m3, after_n_per_m3],
    }
}

/// The axis of the strongest force component and whether it points to smaller coordinates; z and true
/// without a force.
#[must_use]
pub(crate) fn up(scene: &Scene) -> (Axis, bool) {
    let forces = Forces::of(scene);
    (forces.up, forces.down_is_low)
}

fn strongest(extremes: &[[f64; 3]; 2]) -> (Axis, bool) {
    let mut strongest = (Axis::Z, -0.0_f64);
    for force in extremes {
        for axis in [Axis::Z, Axis::Y, Axis::X] {
            if force[axis.index()].abs() > strongest.1.abs() {
                strongest = (axis, force[axis.index()]);
            }
        }
    }
    (strongest.0, strongest.1 <= 0.0)
}
