//! The packings that grains are timed on.

use crate::dem::packing::{Lattice, Random, Region, Sizes, lattice, scatter};
use crate::dem::{
    Clump, Grain, Material, Materials, Orientation, PairProperties, Period, Setup, Side, Surface, V3, Wall,
};

/// Radius of a grain, m.
const R: f64 = 5e-3;
/// Edge of the tetrahedral clumps over the radius of their spheres.
const EDGE: f64 = 1.5;

fn soft() -> Setup {
    let material = Material { name: "grain".to_owned(), density_kg_m3: 2650.0, young_pa: 7e7, poisson: 0.22 };
    let mut setup = Setup::new(Materials::single(material, PairProperties::default()));
    // Packings are pressed a little, so that all neighbours touch.
    setup.start_overlap = 0.02;
    setup
}

/// A dense bed of spheres under gravity in a box: a face-centred lattice pressed a little and shaken.
pub(super) fn spheres(n: usize) -> Setup {
    let mut s = soft();
    let side = 2.0 * R * libm::cbrt(n as f64 / 2f64.sqrt()) * 1.02;
    let region = Region::Box { low: V3::zeros(), high: V3::repeat(side) };
    let mut random = Random::new(1);
    s.grains = lattice(Lattice::FaceCentred, R, 2.0 * R, &region)
        .unwrap_or_default()
        .into_iter()
        .map(|p| Grain::sphere(R, p.centre * 0.9995, 0).moving(V3::from_fn(|_, _| 0.05 * random.normal())))
        .collect();
    boxed(s, side, 0.0)
}

/// A dense bed of tetrahedral clumps: all turned alike, each touching six neighbours with four pairs of spheres.
pub(super) fn clumps(n: usize) -> Setup {
    let mut s = soft();
    s.clumps = Clump::tetrahedron(1.0, EDGE).into_iter().collect();
    let Some(clump) = s.clumps.first() else { return s };
    let (member, frame) = (R / clump.equivalent_radius(), clump.frame);
    let a = EDGE / 8f64.sqrt();
    let pitch = member * (2.0 * a + 2.0 * (1.0 - a * a).sqrt());
    let side = pitch * (libm::cbrt(n as f64) + 0.5);
    let region = Region::Box { low: V3::zeros(), high: V3::repeat(side) };
    let mut random = Random::new(1);
    s.grains = lattice(Lattice::SimpleCubic, 0.5 * pitch, pitch, &region)
        .unwrap_or_default()
        .into_iter()
        .map(|p| {
            let noise = V3::from_fn(|_, _| 0.002 * random.normal());
            Grain::clump(0, R, p.centre * 0.999, frame, 0).moving(noise)
        })
        .collect();
    // The spheres of a clump reach beyond half the pitch.
    boxed(s, side, 0.2 * R)
}

fn boxed(mut s: Setup, side: f64, margin: f64) -> Setup {
    let centre = V3::repeat(0.5 * side);
    let half = V3::repeat(0.5 * side + margin);
    let surface = Surface::Box { centre, half, orientation: Orientation::identity(), side: Side::Inside };
    s.walls = vec![Wall::fixed("box", surface, 0)];
    s.gravity = V3::z() * -9.81;
    s
}

/// The same work per grain at every number: a periodic face-centred lattice of `k`³ cells, pressed a little.
pub(super) fn crystal(k: u32) -> Setup {
    let mut s = soft();
    let cell = 2f64.sqrt() * 2.0 * R;
    let region = Region::Box { low: V3::zeros(), high: V3::repeat((f64::from(k) - 0.25) * cell + 2.0 * R) };
    let mut random = Random::new(1);
    s.grains = lattice(Lattice::FaceCentred, R, 2.0 * R, &region)
        .unwrap_or_default()
        .into_iter()
        .map(|p| Grain::sphere(R, p.centre * 0.999, 0).moving(V3::from_fn(|_, _| 0.02 * random.normal())))
        .collect();
    s.period = Period([Some(f64::from(k) * cell * 0.999); 3]);
    s
}

/// Grains whose radii differ 20 times, log-normal, shaken in a box: a quarter of the volume.
pub(super) fn mixture(n: usize) -> Setup {
    let mut s = soft();
    let sizes = Sizes::LogNormal { median: 1.5e-3, deviation: 1.0, least: 1e-3, largest: 20e-3 };
    let mut random = Random::new(3);
    let radii: Vec<f64> = (0..n).map(|_| sizes.draw(&mut random)).collect();
    let volume: f64 = radii.iter().map(|r| 4.0 / 3.0 * std::f64::consts::PI * r * r * r).sum();
    let side = libm::cbrt(volume / 0.25).max(0.06);
    let region = Region::Box { low: V3::zeros(), high: V3::repeat(side) };
    s.grains = scatter(n, &sizes, 0.0, &region, 3)
        .unwrap_or_default()
        .into_iter()
        .map(|p| Grain::sphere(p.radius, p.centre, 0).moving(V3::from_fn(|_, _| 0.2 * random.normal())))
        .collect();
    boxed(s, side, 0.0)
}
