//! What the time series of a run without fluid holds.

use super::View;
use crate::dem::V3;
use crate::geometry::Axis;
use crate::plan::grains::GrainPlan;
use crate::scene::dry::{DryScene, GrainMeasure, GrainProbe, Target};

/// Share of the mass a pile leaves out at each end when the scene does not say.
const SHARE: f64 = 0.005;
/// The same beyond a front.
const FRONT_SHARE: f64 = 0.02;
/// Size classes when the scene does not say.
const CLASSES: u32 = 3;

/// Columns of a probe: name and unit.
pub(crate) fn columns(probe: &GrainProbe) -> Vec<(String, &'static str)> {
    let name = &probe.name;
    let many = |parts: &[(&str, &'static str)]| {
        parts.iter().map(|(part, unit)| (format!("{name}_{part}"), *unit)).collect::<Vec<_>>()
    };
    match &probe.measure {
        GrainMeasure::KineticEnergy => vec![(name.clone(), "J")],
        GrainMeasure::MaxSpeed => vec![(name.clone(), "m/s")],
        GrainMeasure::Mass => many(&[("mass", "kg"), ("number", "-")]),
        GrainMeasure::Contacts => many(&[("pairs", "-"), ("walls", "-"), ("per_grain", "-")]),
        GrainMeasure::Energies => many(&[
            ("kinetic", "J"),
            ("rotational", "J"),
            ("potential", "J"),
            ("elastic", "J"),
            ("lost_normal", "J"),
            ("lost_friction", "J"),
            ("lost_rolling", "J"),
            ("work_of_walls", "J"),
            ("left", "J"),
            ("unexplained", "J"),
        ]),
        GrainMeasure::Momentum => many(&[("x", "N s"), ("y", "N s"), ("z", "N s")]),
        GrainMeasure::Grain { .. } => many(&[
            ("x", "m"),
            ("y", "m"),
            ("z", "m"),
            ("velocity_x", "m/s"),
            ("velocity_y", "m/s"),
            ("velocity_z", "m/s"),
            ("spin_x", "rad/s"),
            ("spin_y", "rad/s"),
            ("spin_z", "rad/s"),
        ]),
        GrainMeasure::Flux { .. } => many(&[("mass", "kg"), ("number", "-")]),
        GrainMeasure::Force { .. } => many(&[
            ("force_x", "N"),
            ("force_y", "N"),
            ("force_z", "N"),
            ("torque_x", "N m"),
            ("torque_y", "N m"),
            ("torque_z", "N m"),
        ]),
        GrainMeasure::Pile { .. } => many(&[("low", "m"), ("high", "m"), ("height", "m")]),
        GrainMeasure::SetSpeed { .. } => many(&[("x", "m/s"), ("y", "m/s"), ("z", "m/s"), ("speed", "m/s")]),
        GrainMeasure::Segregation { classes, .. } => {
            (1..=classes.unwrap_or(CLASSES)).map(|class| (format!("{name}_height_{class}"), "m")).collect()
        }
        GrainMeasure::GrainFront { .. } | GrainMeasure::Submergence { .. } => vec![(name.clone(), "m")],
        GrainMeasure::FluidForce { .. } => many(&[
            ("force_x", "N"),
            ("force_y", "N"),
            ("force_z", "N"),
            ("contact_x", "N"),
            ("contact_y", "N"),
            ("contact_z", "N"),
            ("torque_x", "N m"),
            ("torque_y", "N m"),
            ("torque_z", "N m"),
        ]),
    }
}

/// What probes need besides the state.
pub(crate) struct Sampler {
    probes: Vec<GrainProbe>,
    /// First grain of each set.
    sets: Vec<(String, std::ops::Range<usize>)>,
    faces: Vec<(&'static str, usize)>,
    solids: Vec<(String, Vec<usize>)>,
    period: [Option<f64>; 3],
    /// Mass and number that have crossed, per probe; and the side each grain was on, by its number at time 0.
    crossed: Vec<(f64, f64)>,
    sides: Vec<Vec<i64>>,
}

impl Sampler {
    pub fn new(scene: &DryScene, plan: &GrainPlan, grains: &View<'_>) -> Self {
        let probes = probes(scene);
        let mut sampler = Self {
            sets: plan.sets.clone(),
            faces: plan.walls.faces.clone(),
            solids: plan.walls.solids.clone(),
            period: plan.setup.period.0,
            crossed: vec![(0.0, 0.0); probes.len()],
            sides: vec![Vec::new(); probes.len()],
            probes,
        };
        for k in 0..sampler.probes.len() {
            if let GrainMeasure::Flux { normal, at_m } = sampler.probes[k].measure {
                let b = grains.dem.bodies();
                sampler.sides[k] = (0..b.len()).map(|i| sampler.side(b.position[i], normal, at_m)).collect();
            }
        }
        sampler
    }

    /// How many planes of a periodic row lie below a place; 0 or 1 on an axis that is not periodic.
    fn side(&self, x: V3, normal: Axis, at: f64) -> i64 {
        let k = normal.index();
        match self.period[k] {
            Some(length) => ((x[k] - at) / length).floor() as i64 + 1,
            None => i64::from(x[k] >= at),
        }
    }

    /// The values of all probes; `around` measures what the fluid around one grain does.
    pub fn values(
        &mut self,
        grains: &View<'_>,
        around: &dyn Fn(&GrainMeasure, usize) -> Vec<f64>,
    ) -> Vec<f64> {
        let mut row = Vec::new();
        for k in 0..self.probes.len() {
            let measure = self.probes[k].measure.clone();
            if let GrainMeasure::Flux { normal, at_m } = measure {
                self.count(k, normal, at_m, grains);
                row.extend([self.crossed[k].0, self.crossed[k].1]);
            } else {
                row.extend(self.measure(&measure, grains, around));
            }
        }
        row
    }

    fn count(&mut self, probe: usize, normal: Axis, at: f64, grains: &View<'_>) {
        let b = grains.dem.bodies();
        for i in grains.free() {
            let (id, now) = (grains.ids[i] as usize, self.side(b.position[i], normal, at));
            let moved = (now - self.sides[probe][id]) as f64;
            self.sides[probe][id] = now;
            self.crossed[probe].0 += moved * b.mass[i];
            self.crossed[probe].1 += moved;
        }
    }

    /// The place of grain `number` of a set among those still there.
    fn find(&self, set: &str, number: u64, grains: &View<'_>) -> Option<usize> {
        let start = self.sets.iter().find(|(name, _)| name == set).map_or(0, |(_, range)| range.start);
        let id = start as u64 + number;
        grains.ids.iter().position(|&other| u64::from(other) == id)
    }

    fn measure(
        &self,
        measure: &GrainMeasure,
        grains: &View<'_>,
        around: &dyn Fn(&GrainMeasure, usize) -> Vec<f64>,
    ) -> Vec<f64> {
        let (dem, b) = (grains.dem, grains.dem.bodies());
        match measure {
            GrainMeasure::KineticEnergy => vec![dem.kinetic_energy()],
            GrainMeasure::MaxSpeed => vec![grains.max_speed()],
            GrainMeasure::Mass => vec![dem.ledger().mass, grains.free().count() as f64],
            GrainMeasure::Contacts => {
                let pairs = dem.pair_counts().1 as f64;
                let walls: usize = dem.wall_contacts().iter().map(|near| near.contacts.len()).sum();
                let free = grains.free().count().max(1) as f64;
                vec![pairs, walls as f64, (2.0 * pairs + walls as f64) / free]
            }
            GrainMeasure::Energies => {
                let e = dem.energies();
                let elastic = e.elastic_normal + e.elastic_tangential + e.elastic_rolling;
                let work = e.work_driven + e.work_external;
                let stored = [e.kinetic, e.rotational, e.potential, elastic];
                let lost = [e.lost_normal, e.lost_friction, e.lost_rolling];
                let rest = [work, grains.left.2, grains.unexplained()];
                stored.into_iter().chain(lost).chain(rest).collect()
            }
            GrainMeasure::Momentum => dem.ledger().momentum.iter().copied().collect(),
            GrainMeasure::Grain { set, number } => {
                // A grain that has left has no place.
                let Some(i) = self.find(set, *number, grains) else { return vec![f64::NAN; 9] };
                let vectors = [b.position[i], b.velocity[i], b.spin[i]];
                vectors.iter().flat_map(|v| v.iter().copied()).collect()
            }
            GrainMeasure::Force { on } => {
                let walls: Vec<usize> = match on {
                    Target::Face(key) => {
                        self.faces.iter().filter(|(k, _)| k == key).map(|(_, w)| *w).collect()
                    }
                    Target::Solid(name) => {
                        self.solids.iter().filter(|(n, _)| n == name).flat_map(|(_, w)| w.clone()).collect()
                    }
                };
                let sum = walls.into_iter().map(|wall| dem.force_on_wall(wall));
                let (force, torque) = sum.fold((V3::zeros(), V3::zeros()), |a, b| (a.0 + b.0, a.1 + b.1));
                force.iter().chain(torque.iter()).copied().collect()
            }
            GrainMeasure::Pile { along, up, share } => {
                let share = share.unwrap_or(SHARE);
                let places =
                    |axis: Axis| grains.free().map(|i| (b.position[i][axis.index()], b.mass[i])).collect();
                let (x, z): (Vec<_>, Vec<_>) = (places(*along), places(up.unwrap_or(Axis::Z)));
                vec![quantile(x.clone(), share), quantile(x, 1.0 - share), quantile(z, 1.0 - share)]
            }
            GrainMeasure::SetSpeed { set } => {
                let range = self.sets.iter().find(|(name, _)| name == set).map(|(_, range)| range.clone());
                let range = range.unwrap_or_default();
                let of: Vec<usize> =
                    (0..b.len()).filter(|&i| range.contains(&(grains.ids[i] as usize))).collect();
                let count = of.len().max(1) as f64;
                let mean = of.iter().fold(V3::zeros(), |sum, &i| sum + b.velocity[i]) / count;
                let speed = of.iter().map(|&i| b.velocity[i].norm()).sum::<f64>() / count;
                vec![mean.x, mean.y, mean.z, speed]
            }
            GrainMeasure::Segregation { up, classes } => {
                let up = up.unwrap_or(Axis::Z).index();
                let sized = grains.free().map(|i| (b.radius[i], b.position[i][up])).collect();
                class_means(sized, classes.unwrap_or(CLASSES) as usize)
            }
            GrainMeasure::GrainFront { along, share } => {
                let places = grains.free().map(|i| (b.position[i][along.index()], b.mass[i])).collect();
                vec![quantile(places, 1.0 - share.unwrap_or(FRONT_SHARE))]
            }
            GrainMeasure::FluidForce { set, number } => {
                self.find(set, *number, grains).map_or_else(|| vec![f64::NAN; 9], |i| around(measure, i))
            }
            GrainMeasure::Submergence { set, number } => {
                self.find(set, *number, grains).map_or_else(|| vec![f64::NAN], |i| around(measure, i))
            }
            GrainMeasure::Flux { .. } => Vec::new(),
        }
    }
}

/// The probes of a scene; energies and contacts when it names none.
pub(crate) fn probes(scene: &DryScene) -> Vec<GrainProbe> {
    if !scene.output.probes.is_empty() {
        return scene.output.probes.clone();
    }
    let probe = |name: &str, measure| GrainProbe { name: name.to_owned(), measure };
    vec![probe("energy", GrainMeasure::Energies), probe("contacts", GrainMeasure::Contacts)]
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

/// The place below which lies a share of the mass; NaN without any.
fn quantile(mut places: Vec<(f64, f64)>, share: f64) -> f64 {
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    let total: f64 = places.iter().map(|p| p.1).sum();
    let mut below = 0.0;
    for (x, mass) in &places {
        below += mass;
        if below > share * total {
            return *x;
        }
    }
    places.last().map_or(f64::NAN, |p| p.0)
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

    #[test]
    fn exact_quantiles_by_mass() {
        let places = vec![(3.0, 1.0), (1.0, 2.0), (2.0, 1.0)];
        assert_eq!(quantile(places.clone(), 0.0), 1.0);
        assert_eq!(quantile(places.clone(), 0.5), 2.0);
        assert_eq!(quantile(places.clone(), 0.75), 3.0);
        assert_eq!(quantile(places, 1.0), 3.0);
        assert!(quantile(Vec::new(), 0.5).is_nan());
    }
}
