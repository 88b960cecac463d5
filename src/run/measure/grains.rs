//! What probes say about grains, with or without a fluid, in SI units.

use std::borrow::Cow;

use super::quantile::quantile;
use super::quantity::{Quantity, one, several, vector, vectors};
use crate::dem::V3;
use crate::geometry::Axis;
use crate::plan::grains::GrainPlan;
use crate::run::view::View;
use crate::scene::Target;
use crate::scene::series::CLASSES;

/// Share of the mass a pile leaves out at each end when the scene does not say.
const SHARE: f64 = 0.005;
/// Share of the mass beyond a front when the scene does not say.
const FRONT_SHARE: f64 = 0.02;

/// The grains at one time.
#[derive(Clone, Copy)]
pub(in crate::run) struct Grains<'a> {
    pub view: View<'a>,
    pub plan: &'a GrainPlan,
}

impl Grains<'_> {
    pub fn kinetic_energy(&self) -> Vec<Quantity> {
        one("J", self.view.dem.kinetic_energy())
    }

    pub(crate) fn max_speed(&self) -> Vec<Quantity> {
        one("m/s", self.view.max_speed())
    }

    pub(crate) fn mass(&self) -> Vec<Quantity> {
        let number = self.view.free().count() as f64;
        several([("mass", "kg", self.view.dem.ledger().mass), ("number", "-", number)])
    }

    pub(crate) fn contacts(&self) -> Vec<Quantity> {
        let dem = self.view.dem;
        let pairs = dem.pair_counts().1 as f64;
        let walls: usize = dem.wall_contacts().iter().map(|near| near.contacts.len()).sum();
        let free = self.view.free().count().max(1) as f64;
        let per_grain = (2.0 * pairs + walls as f64) / free;
        several([("pairs", "-", pairs), ("walls", "-", walls as f64), ("per_grain", "-", per_grain)])
    }

    pub fn energies(&self) -> Vec<Quantity> {
        let e = self.view.dem.energies();
        several([
            ("kinetic", "J", e.kinetic),
            ("rotational", "J", e.rotational),
            ("potential", "J", e.potential),
            ("elastic", "J", e.elastic_normal + e.elastic_tangential + e.elastic_rolling),
            ("lost_normal", "J", e.lost_normal),
            ("lost_friction", "J", e.lost_friction),
            ("lost_rolling", "J", e.lost_rolling),
            ("work_of_walls", "J", e.work_driven + e.work_external),
            ("left", "J", self.view.left.energy_j),
            ("unexplained", "J", self.view.unexplained()),
        ])
    }

    pub(crate) fn momentum(&self) -> Vec<Quantity> {
        vector("", "N s", self.view.dem.ledger().momentum.into())
    }

    /// The place of grain `number` of a set among those still there.
    pub(crate) fn find(&self, set: &str, number: u64) -> Option<usize> {
        let start = self.plan.sets.iter().find(|(name, _)| name == set).map_or(0, |(_, range)| range.start);
        let id = start as u64 + number;
        self.view.ids.iter().position(|&other| u64::from(other) == id)
    }

    /// Place, velocity and spin of one grain; NaN after it has left.
    pub(crate) fn grain(&self, set: &str, number: u64) -> Vec<Quantity> {
        let b = self.view.dem.bodies();
        let at = self.find(set, number);
        let of = |field: &[V3]| at.map_or([f64::NAN; 3], |i| field[i].into());
        vectors([
            ("", "m", of(&b.position)),
            ("velocity", "m/s", of(&b.velocity)),
            ("spin", "rad/s", of(&b.spin)),
        ])
    }

    /// Force and torque of the grains on what they push.
    pub(crate) fn force(&self, on: &Target) -> Vec<Quantity> {
        let of = &self.plan.walls;
        let walls: Vec<usize> = match on {
            Target::Face(key) => of.faces.iter().filter(|(k, _)| k == key).map(|(_, w)| *w).collect(),
            Target::Solid(name) => {
                of.solids.iter().filter(|(n, _)| n == name).flat_map(|(_, w)| w.clone()).collect()
            }
        };
        let sum = walls.into_iter().map(|wall| self.view.dem.force_on_wall(wall));
        let (force, torque) = sum.fold((V3::zeros(), V3::zeros()), |a, b| (a.0 + b.0, a.1 + b.1));
        vectors([("force", "N", force.into()), ("torque", "N m", torque.into())])
    }

    /// Place along an axis and mass of every free grain.
    fn places(&self, axis: Axis) -> Vec<(f64, f64)> {
        let b = self.view.dem.bodies();
        self.view.free().map(|i| (b.position[i][axis.index()], b.mass[i])).collect()
    }

    /// Ends and height of a pile.
    pub(crate) fn pile(&self, along: Axis, up: Option<Axis>, share: Option<f64>) -> Vec<Quantity> {
        let share = share.unwrap_or(SHARE);
        let (x, z) = (self.places(along), self.places(up.unwrap_or(Axis::Z)));
        several([
            ("low", "m", quantile(x.clone(), share)),
            ("high", "m", quantile(x, 1.0 - share)),
            ("height", "m", quantile(z, 1.0 - share)),
        ])
    }

    /// Mean velocity and mean speed of a set.
    pub(crate) fn set_speed(&self, set: &str) -> Vec<Quantity> {
        let b = self.view.dem.bodies();
        let range = self.plan.sets.iter().find(|(name, _)| name == set).map(|(_, range)| range.clone());
        let range = range.unwrap_or_default();
        let of: Vec<usize> = (0..b.len()).filter(|&i| range.contains(&(self.view.ids[i] as usize))).collect();
        let count = of.len().max(1) as f64;
        let mean = of.iter().fold(V3::zeros(), |sum, &i| sum + b.velocity[i]) / count;
        let speed = of.iter().map(|&i| b.velocity[i].norm()).sum::<f64>() / count;
        let mut row = vector("", "m/s", mean.into());
        row.extend(several([("speed", "m/s", speed)]));
        row
    }

    /// Mean height of each size class, smallest grains first.
    pub(crate) fn segregation(&self, up: Option<Axis>, classes: Option<u32>) -> Vec<Quantity> {
        let (b, up) = (self.view.dem.bodies(), up.unwrap_or(Axis::Z).index());
        let sized = self.view.free().map(|i| (b.radius[i], b.position[i][up])).collect();
        let means = class_means(sized, classes.unwrap_or(CLASSES) as usize);
        let column =
            |(class, value)| Quantity { part: Cow::Owned(format!("height_{}", class + 1)), unit: "m", value };
        means.into_iter().enumerate().map(column).collect()
    }

    /// The place beyond which lies a share of the mass.
    pub(crate) fn front(&self, along: Axis, share: Option<f64>) -> Vec<Quantity> {
        one("m", quantile(self.places(along), 1.0 - share.unwrap_or(FRONT_SHARE)))
    }
}

/// Mean of the second entries in classes of equal number, by the first entries; NaN for an empty class.
fn class_means(mut sized: Vec<(f64, f64)>, classes: usize) -> Vec<f64> {
    // Stable: grains of one size stay in their order.
    sized.sort_by(|a, b| a.0.total_cmp(&b.0));
    let n = sized.len();
    let mean = |class: usize| {
        let of = &sized[class * n / classes..(class + 1) * n / classes];
        if of.is_empty() { f64::NAN } else { of.iter().map(|g| g.1).sum::<f64>() / of.len() as f64 }
    };
    (0..classes).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_means_of_size_classes() {
        let sized = vec![(2.0, 10.0), (1.0, 1.0), (3.0, 5.0), (1.0, 3.0), (3.0, 7.0), (2.0, 20.0)];
        assert_eq!(class_means(sized.clone(), 3), [2.0, 15.0, 6.0]);
        assert!(class_means(vec![(1.0, 4.0)], 2)[0].is_nan());
    }
}
