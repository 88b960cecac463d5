//! The speed that counts for being at rest.

use super::fields::{fill, is_fluid, max_speed, weighted_speed};
use super::fluid::Fluid;
use super::quantile::quantile;
use crate::run::view::View;
use crate::scene::RestMeasure;
use crate::setup::Setup;
use crate::solver::run::Fields;

/// How fast something is, m/s; 0 of nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::run) struct Pace {
    /// By the measure that was asked for.
    pub speed: f64,
    /// Largest speed of any cell or grain, whatever its mass.
    pub largest: f64,
}

impl Pace {
    /// Of two things together: each must be slow.
    pub(crate) fn or(self, other: Self) -> Self {
        Self { speed: greater(self.speed, other.speed), largest: greater(self.largest, other.largest) }
    }
}

/// The greater of two, NaN if either is.
fn greater(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}

/// Of a fluid.
pub(in crate::run) fn of_fluid(fluid: &Fluid<'_>, measure: RestMeasure) -> Pace {
    let si = |speed| fluid.frame.units.velocity_to_si(speed);
    let speed = match measure {
        RestMeasure::MassPercentile { share } => si(percentile(fluid.run.setup(), fluid.fields, share)),
        RestMeasure::Rms => rms(fluid.kinetic_energy_j(), fluid.mass_kg()),
        RestMeasure::Largest => si(weighted_speed(fluid.fields)),
    };
    Pace { speed, largest: si(max_speed(fluid.fields)) }
}

/// Of free grains: translation of their centres of mass.
pub(in crate::run) fn of_grains(grains: &View<'_>, measure: RestMeasure) -> Pace {
    let b = grains.dem.bodies();
    let largest = grains.max_speed();
    let speed = match measure {
        RestMeasure::MassPercentile { share } => {
            share_slower(grains.free().map(|i| (b.velocity[i].norm(), b.mass[i])).collect(), share)
        }
        RestMeasure::Rms => {
            let energy = grains.free().map(|i| 0.5 * b.mass[i] * b.velocity[i].norm_squared()).sum();
            rms(energy, grains.free().map(|i| b.mass[i]).sum())
        }
        RestMeasure::Largest => largest,
    };
    Pace { speed, largest }
}

/// The least speed that more than a share of the mass does not exceed, lattice units; 0 without fluid.
fn percentile(setup: &Setup, fields: &Fields, share: f64) -> f64 {
    let cells = (0..setup.cells()).filter(|&c| is_fluid(setup, fields, c));
    let speed = |c: usize| {
        let [x, y, z] = fields.velocity[c];
        (x * x + y * y + z * z).sqrt()
    };
    share_slower(cells.map(|c| (speed(c), fill(fields, c) * fields.density[c])).collect(), share)
}

/// The same of parts that are given as speed and mass.
fn share_slower(parts: Vec<(f64, f64)>, share: f64) -> f64 {
    if parts.is_empty() { 0.0 } else { quantile(parts, share) }
}

/// Root mean square of the speed over the mass, √(2 E/m); 0 without mass.
fn rms(energy: f64, mass: f64) -> f64 {
    if mass > 0.0 { (2.0 * energy / mass).sqrt() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rheology::Law;

    /// Ninety-eight full cells that creep, a half-full one that flows, an almost empty one that flies, and air.
    fn pool_and_spray() -> (Setup, Fields) {
        let mut setup = Setup::periodic([101, 1, 1], Law::Newtonian { mu: 0.1 });
        setup.solids = vec![0; 101];
        let mut fields = Fields::empty(101);
        fields.fill = [vec![1.0; 98], vec![0.5, 0.01, 0.0]].concat();
        fields.kind = [vec![2; 98], vec![1, 1, 0]].concat();
        fields.velocity =
            [vec![[3e-6, 4e-6, 0.0]; 98], vec![[0.0, 0.01, 0.0], [0.0, 0.0, 0.1], [0.0; 3]]].concat();
        (setup, fields)
    }

    #[test]
    fn exact_percentiles_leave_out_what_is_of_little_mass() {
        let (setup, fields) = pool_and_spray();
        // Of 98.51 masses 0.01 fly and 0.51 are faster than the pool: 0.01 % and 0.52 %.
        assert_eq!(percentile(&setup, &fields, 0.99), 5e-6);
        assert_eq!(percentile(&setup, &fields, 0.995), 0.01);
        assert_eq!(percentile(&setup, &fields, 0.9999), 0.1);
        assert_eq!(max_speed(&fields), 0.1);
        // 0.5 · 0.01 against 0.01 · 0.1.
        assert_eq!(weighted_speed(&fields), 0.005);
        assert_eq!(share_slower(Vec::new(), 0.99), 0.0);
    }

    #[test]
    fn exact_root_mean_square_over_mass() {
        // 3 kg at rest and 1 kg at 4 m/s: √(16/4).
        assert_eq!(rms(8.0, 4.0), 2.0);
        assert_eq!(rms(0.0, 0.0), 0.0);
    }

    #[test]
    fn nan_does_not_pass_for_rest() {
        let slow = Pace { speed: 0.0, largest: 0.0 };
        let lost = Pace { speed: f64::NAN, largest: f64::NAN };
        assert!(slow.or(lost).speed.is_nan() && lost.or(slow).largest.is_nan());
        assert_eq!(slow.or(Pace { speed: 1.0, largest: 2.0 }), Pace { speed: 1.0, largest: 2.0 });
    }
}
