//! Random packings without overlap.

use super::{Random, Region, Sizes, order_by_place};
use crate::dem::{DemError, Sphere, V3};
use std::collections::HashMap;

/// Attempts for one sphere before the packing is called full.
const ATTEMPTS: u32 = 20_000;

/// `count` spheres at random places inside `region`, none overlapping, the largest placed first.
///
/// Random sequential addition: equal spheres reach about 0.3 of the volume easily and jam near 0.38.
///
/// # Arguments
/// * `gap` — smallest distance of surfaces, m.
/// # Errors
/// Bad region or sizes; no room.
pub fn scatter(
    count: usize,
    sizes: &Sizes,
    gap: f64,
    region: &Region,
    seed: u64,
) -> Result<Vec<Sphere>, DemError> {
    region.check()?;
    sizes.check()?;
    if !(gap >= 0.0 && gap.is_finite()) {
        return Err(DemError::Packing { what: "gap (m)", found: gap, allowed: "0 or more" });
    }
    let mut random = Random::new(seed);
    let mut radii: Vec<f64> = (0..count).map(|_| sizes.draw(&mut random)).collect();
    radii.sort_by(|a, b| b.total_cmp(a));
    let mut placed = Placed::new(gap);
    let (low, high) = region.bounds();
    for &radius in &radii {
        let fits = (high - low).min() >= 2.0 * radius;
        let place = (0..ATTEMPTS)
            .filter(|_| fits)
            .map(|_| region.point(&mut random, radius))
            .find(|x| region.holds(x, radius) && placed.free(x, radius));
        let Some(centre) = place else {
            return Err(DemError::PackingFull {
                placed: placed.spheres.len(),
                wanted: count,
                attempts: ATTEMPTS,
            });
        };
        placed.add(Sphere { centre, radius });
    }
    let mut out = placed.spheres;
    let cell = 2.0 * out.first().map_or(1.0, |s| s.radius) + gap;
    order_by_place(&mut out, cell);
    Ok(out)
}

/// Numbers of spheres by cell; looked up, never iterated over.
type Grid = HashMap<[i64; 3], Vec<u32>>;

/// Placed spheres in cells, one grid per octave of size.
struct Placed {
    spheres: Vec<Sphere>,
    gap: f64,
    /// (largest radius, cells) per octave, descending.
    grids: Vec<(f64, Grid)>,
}

impl Placed {
    fn new(gap: f64) -> Self {
        Self { spheres: Vec::new(), gap, grids: Vec::new() }
    }

    fn edge(&self, largest: f64) -> f64 {
        2.0 * largest + self.gap
    }

    fn add(&mut self, s: Sphere) {
        // Radii come in descending order, so a new octave is always the last.
        if self.grids.last().is_none_or(|g| s.radius <= 0.5 * g.0) {
            self.grids.push((s.radius, Grid::new()));
        }
        let largest = self.grids.last().map_or(s.radius, |g| g.0);
        let edge = self.edge(largest);
        let key = [0, 1, 2].map(|k| (s.centre[k] / edge).floor() as i64);
        if let Some(g) = self.grids.last_mut() {
            g.1.entry(key).or_default().push(self.spheres.len() as u32);
        }
        self.spheres.push(s);
    }

    fn free(&self, x: &V3, radius: f64) -> bool {
        self.grids.iter().all(|(largest, cells)| {
            let edge = self.edge(*largest);
            let reach = radius + largest + self.gap;
            let low = [0, 1, 2].map(|k| ((x[k] - reach) / edge).floor() as i64);
            let high = [0, 1, 2].map(|k| ((x[k] + reach) / edge).floor() as i64);
            for k in low[2]..=high[2] {
                for j in low[1]..=high[1] {
                    for i in low[0]..=high[0] {
                        for &o in cells.get(&[i, j, k]).map_or(&[][..], Vec::as_slice) {
                            let s = &self.spheres[o as usize];
                            let least = radius + s.radius + self.gap;
                            if (x - s.centre).norm_squared() < least * least {
                                return false;
                            }
                        }
                    }
                }
            }
            true
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::packing::{Lattice, lattice};

    #[test]
    fn no_overlap_and_inside_for_every_region() {
        let regions = [
            Region::Box { low: V3::zeros(), high: V3::new(10.0, 8.0, 12.0) },
            Region::Sphere { centre: V3::x(), radius: 6.0 },
            Region::Cylinder { base: V3::zeros(), axis: V3::new(1.0, 1.0, 0.0), radius: 5.0, height: 9.0 },
        ];
        let sizes = [
            Sizes::Uniform { least: 0.2, largest: 0.8 },
            Sizes::LogNormal { median: 0.3, deviation: 0.5, least: 0.05, largest: 1.0 },
            Sizes::Sieve(vec![(0.1, 0.0), (0.5, 0.4), (2.0, 1.0)]),
        ];
        for (region, sizes) in regions.iter().zip(&sizes) {
            let s = scatter(300, sizes, 0.01, region, 5).unwrap();
            assert_eq!(s, scatter(300, sizes, 0.01, region, 5).unwrap());
            for i in 0..s.len() {
                assert!(region.holds(&s[i].centre, s[i].radius));
                for j in 0..i {
                    assert!((s[i].centre - s[j].centre).norm() >= s[i].radius + s[j].radius + 0.01 - 1e-12);
                }
            }
        }
    }

    #[test]
    fn full_packing_is_an_error() {
        let region = Region::Box { low: V3::zeros(), high: V3::repeat(3.0) };
        assert!(matches!(
            scatter(100, &Sizes::One(0.5), 0.0, &region, 1),
            Err(DemError::PackingFull { wanted: 100, .. })
        ));
        assert!(scatter(1, &Sizes::One(2.0), 0.0, &region, 1).is_err());
    }

    /// Numbers of spheres in a cube of n cells and the densest packing's volume share.
    #[test]
    fn exact_lattice_counts() {
        let region = Region::Box { low: V3::zeros(), high: V3::repeat(10.0) };
        assert_eq!(lattice(Lattice::SimpleCubic, 0.5, 1.0, &region).unwrap().len(), 1000);
        let s = lattice(Lattice::FaceCentred, 0.1, 0.2, &region).unwrap();
        let share = s.len() as f64 * 4.0 / 3.0 * std::f64::consts::PI * 1e-3 / region.volume();
        // π/√18 = 0.7405 less the loss at six faces of a box 50 diameters wide.
        assert!(share > 0.70 && share < 0.741, "{share}");
        assert!(lattice(Lattice::SimpleCubic, 0.5, 0.9, &region).is_err());
    }
}
