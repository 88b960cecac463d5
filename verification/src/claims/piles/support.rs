//! What the piles share: the grains, loose blocks of them, a rough bed, and runs that leave grains behind.

use lahar::dem::packing::{Lattice, Random, Region, lattice};
use lahar::dem::{
    Clump, Dem, DemError, Grain, Material, Materials, NormalLaw, PairProperties, Period, Setup, Surface, V3,
    Wall,
};
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// Mean radius of the grains, m.
pub const R: f64 = 5e-3;
/// m/s².
pub const G: f64 = 9.81;
/// kg/m³.
pub const DENSITY: f64 = 2650.0;
/// Material number of the grains and of the bed.
const GRAIN: usize = 0;
/// Material number of walls without friction.
pub const SMOOTH: usize = 1;

/// Share of the volume that a settled block fills, about.
pub const SETTLED: f64 = 0.58;
/// Mean volume of a grain, R³: 4π/3 times the mean cube of radii uniform within 20 %.
pub const VOLUME: f64 = 4.0 / 3.0 * std::f64::consts::PI * 1.04;

/// What a pile is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matter {
    /// Edge of the tetrahedral clump in radii of its members; `None`: single spheres.
    pub edge: Option<f64>,
    /// Coulomb's coefficient.
    pub friction: f64,
    /// Rolling friction coefficient.
    pub rolling: f64,
    /// Young's modulus, Pa. Weight against stiffness is ρ g R/E.
    pub young: f64,
    /// Steps in the shortest contact at the design speed.
    pub steps: f64,
    /// Largest speed expected, m/s.
    pub speed: f64,
}

impl Matter {
    /// Spheres, 1 MPa: ρ g R/E = 1.3e-4, 1 % overlap under ten layers.
    pub fn spheres(friction: f64) -> Self {
        Self { edge: None, friction, rolling: 0.0, young: 1e6, steps: 25.0, speed: 1.0 }
    }

    /// Clumps of four members whose centres are `edge` member radii apart, of the volume of a
    /// sphere of the mean radius. With as few steps per contact as for spheres they never come to rest: the dashpots of
    /// all contacts of a clump add up.
    pub fn clumps(friction: f64, edge: f64) -> Self {
        Self { edge: Some(edge), steps: 40.0, ..Self::spheres(friction) }
    }

    /// For a pile `taller` times as tall: the stiffness that keeps ρ g H/E, and the speed of the longer fall. Not softer.
    pub fn taller(&self, taller: f64) -> Self {
        let taller = taller.max(1.0);
        Self { young: self.young * taller, speed: self.speed * taller.sqrt(), ..*self }
    }

    /// A slice of this depth (m), periodic in y, with gravity along −z and no grains yet.
    ///
    /// Restitution 0.3 and the dashpot in the tangential direction are the only damping.
    ///
    /// # Errors
    /// A clump that cannot be made.
    pub fn slice(&self, depth: f64) -> Result<Setup, DemError> {
        let pair = PairProperties {
            normal: NormalLaw::Tsuji { restitution: 0.3 },
            friction: self.friction,
            rolling_friction: self.rolling,
            tangential_damping: 1.0,
        };
        let named = |name: &str| Material {
            name: name.into(),
            density_kg_m3: DENSITY,
            young_pa: self.young,
            poisson: 0.22,
        };
        let mut s = Setup::new(Materials {
            list: vec![named("grain"), named("smooth wall")],
            default_pair: pair,
            pairs: vec![(GRAIN, SMOOTH, PairProperties { friction: 0.0, ..pair })],
        });
        if let Some(edge) = self.edge {
            s.clumps.push(Clump::tetrahedron(1.0, edge)?);
        }
        s.period = Period([None, Some(depth), None]);
        s.gravity = V3::z() * -G;
        s.design_speed_m_s = self.speed;
        s.steps_per_contact = self.steps;
        s.overlap_limit = 0.4;
        Ok(s)
    }

    /// Edge of the cell of one grain in a loose block, m: no grain reaches out of it however it is turned.
    pub fn cell(&self) -> f64 {
        2.0 * R * if self.edge.is_some() { 1.42 } else { 1.21 }
    }

    /// A loose cubic arrangement from x = `low` to `high`, over the slice's `depth` and up to `height`, with small
    /// random velocities; spheres of radii within 20 %, so that no crystal forms, clumps of one size, turned at
    /// random.
    ///
    /// # Errors
    /// A block that holds no grain.
    pub fn block(
        &self,
        low: f64,
        high: f64,
        depth: f64,
        height: f64,
        seed: u64,
    ) -> Result<Vec<Grain>, DemError> {
        let mut random = Random::new(seed);
        let region = Region::Box { low: V3::new(low, 0.0, 0.0), high: V3::new(high, depth, height) };
        let cell = self.cell();
        let places = lattice(Lattice::SimpleCubic, 0.5 * cell, cell, &region)?;
        Ok(places
            .into_iter()
            .map(|p| {
                let v = V3::from_fn(|_, _| 0.05 * random.normal());
                let grain = match self.edge {
                    None => Grain::sphere(R * (0.8 + 0.4 * random.unit()), p.centre, GRAIN),
                    Some(_) => Grain::clump(0, R, p.centre, random.orientation(), GRAIN),
                };
                grain.moving(v)
            })
            .collect())
    }
}

/// A layer of fixed spheres of the mean radius side by side below z = 0, from x = `low` to `high` (single spheres
/// would roll away for ever on a plane).
pub fn bed(low: f64, high: f64, depth: f64) -> Vec<Grain> {
    let rows = (depth / (2.0 * R)).floor().max(1.0);
    let spacing = depth / rows;
    let columns = ((high - low) / spacing).round();
    let mut out = Vec::new();
    for j in 0..rows as usize {
        for i in 0..columns as usize {
            let at = V3::new(low + (i as f64 + 0.5) * spacing, (j as f64 + 0.5) * spacing, -R);
            out.push(Grain { driven: true, ..Grain::sphere(R, at, GRAIN) });
        }
    }
    out
}

/// A smooth upright wall at `x` with the grains on the side that `towards` (±1) points to.
pub fn gate(x: f64, towards: f64, name: &str) -> Wall {
    Wall::fixed(name, Surface::Plane { point: V3::x() * x, normal: V3::x() * towards }, SMOOTH)
}

/// Whether body `i` moves freely.
pub fn free(d: &Dem, i: usize) -> bool {
    d.bodies().inverse_mass[i] > 0.0
}

/// Leaves out the grains that `keep` refuses and the walls from number `walls` on.
pub fn leave_out(d: &mut Dem, keep: impl Fn(&Dem, usize) -> bool, walls: usize) {
    let kept: Vec<bool> = (0..d.bodies().len()).map(|i| keep(d, i)).collect();
    d.retain(&kept, walls);
}

/// Largest kinetic energy of a free grain in units of m g R.
pub fn liveliest(d: &Dem) -> f64 {
    let b = d.bodies();
    (0..b.len())
        .filter(|&i| free(d, i))
        .map(|i| (b.translational_energy(i) + b.rotational_energy(i)) / (b.mass[i] * G * R))
        .fold(0.0, f64::max)
}

/// Mean of a sample and the standard error of the mean.
pub fn mean(sample: &[f64]) -> (f64, f64) {
    let n = sample.len() as f64;
    let mean = sample.iter().sum::<f64>() / n;
    let squares = sample.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>();
    (mean, (squares / (n - 1.0) / n).sqrt())
}

/// Results of runs by their settings, so that a process computes each only once.
pub struct Known<T>(Mutex<BTreeMap<String, T>>);

impl<T: Clone> Known<T> {
    /// Nothing known yet.
    pub const fn nothing() -> Self {
        Self(Mutex::new(BTreeMap::new()))
    }

    /// What is known under `key`, or what `run` finds.
    ///
    /// # Errors
    /// Those of `run`.
    pub fn get(&self, key: &str, run: impl FnOnce() -> Result<T, DemError>) -> Result<T, DemError> {
        // The lock is not held during the run: threads that ask at the same time find the same twice.
        let known = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = known().get(key) {
            return Ok(found.clone());
        }
        let found = run()?;
        known().insert(key.to_owned(), found.clone());
        Ok(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pile() -> (Setup, Dem) {
        let matter = Matter::clumps(0.5, 1.5);
        let side = 3.0 * matter.cell() * (1.0 + 1e-9);
        let mut s = matter.slice(side).unwrap();
        s.grains = matter.block(0.0, side, side, side, 1).unwrap();
        s.grains.extend(bed(-side, 2.0 * side, side));
        s.walls = vec![gate(0.0, 1.0, "left"), gate(side, -1.0, "right")];
        let mut d = Dem::new(&s).unwrap();
        d.step(1500).unwrap();
        assert!(d.pair_counts().1 > 20, "the clumps have met");
        (s, d)
    }

    /// Leaving out nothing changes no bit; leaving out grains that touch nothing changes no bit of the others.
    #[test]
    fn parity_of_leaving_out() {
        let (_, mut d) = pile();
        let (mut same, mut fewer) = (d.clone(), d.clone());
        leave_out(&mut same, |_, _| true, 2);
        // The outermost spheres of the bed.
        leave_out(&mut fewer, |d, i| d.bodies().position[i].x > -0.01, 2);
        // What is known of contacts stays known.
        assert_eq!(same.energies().elastic_normal, d.energies().elastic_normal);
        assert_eq!(same.force_on_wall(0), d.force_on_wall(0));
        let gone = d.bodies().len() - fewer.bodies().len();
        assert!(gone > 0);
        d.step(300).unwrap();
        same.step(300).unwrap();
        fewer.step(300).unwrap();
        assert_eq!(d.bodies().position, same.bodies().position);
        let free = |d: &Dem| -> Vec<V3> {
            (0..d.bodies().len()).filter(|&i| free(d, i)).map(|i| d.bodies().position[i]).collect()
        };
        assert_eq!(free(&d), free(&fewer));
    }

    /// Without its gate a block spreads.
    #[test]
    fn walls_are_left_out() {
        let (_, d) = pile();
        let widest = |d: &Dem| {
            (0..d.bodies().len())
                .filter(|&i| free(d, i))
                .map(|i| d.bodies().position[i].x)
                .fold(f64::MIN, f64::max)
        };
        let before = widest(&d);
        let mut open = d.clone();
        leave_out(&mut open, |_, _| true, 1);
        assert_eq!(open.scenery().walls.len(), 1);
        open.step(2000).unwrap();
        assert!(widest(&open) > before + R);
    }

    #[test]
    fn mean_and_its_error() {
        let (m, e) = mean(&[1.0, 2.0, 3.0, 6.0]);
        assert_eq!(m, 3.0);
        assert!((e - (14.0f64 / 12.0).sqrt()).abs() < 1e-15);
    }

    #[test]
    fn known_results_are_not_computed_again() {
        let known = Known::nothing();
        assert_eq!(known.get("a", || Ok(1)).unwrap(), 1);
        assert_eq!(known.get("a", || Ok(2)).unwrap(), 1);
        assert_eq!(known.get("b", || Ok(2)).unwrap(), 2);
    }
}
