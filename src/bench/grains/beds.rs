//! The packings that grains are timed on.

use crate::dem::packing::{Lattice, Random, Region, lattice};
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

/// A dense bed of radii 20 to 1: large spheres on a touching simple cubic lattice, about `n` small ones on a touching
/// simple cubic lattice in the gaps, pressed a little and shaken, under gravity in a box.
pub(super) fn mixture(n: usize) -> Setup {
    const LARGE: f64 = 20.0;
    let mut s = soft();
    let (small, large) = (R / 5.0, LARGE * R / 5.0);
    let cells = ((n as f64 / 3000.0).round().max(1.0)) as usize;
    let high = V3::new(2.0 * large * cells as f64, 2.0 * large, 2.0 * large);
    let region = Region::Box { low: V3::zeros(), high };
    let mut random = Random::new(3);
    let mut shaken = |radius: f64, centre: V3| {
        Grain::sphere(radius, centre * 0.9995, 0).moving(V3::from_fn(|_, _| 0.01 * random.normal()))
    };
    let stones = lattice(Lattice::SimpleCubic, large, 2.0 * large, &region).unwrap_or_default();
    s.grains = stones.iter().map(|p| shaken(large, p.centre)).collect();
    let sand = lattice(Lattice::SimpleCubic, small, 2.0 * small, &region).unwrap_or_default();
    let free = |x: &V3| stones.iter().all(|p| (x - p.centre).norm() >= large + small);
    s.grains.extend(sand.iter().filter(|p| free(&p.centre)).map(|p| shaken(small, p.centre)));
    let surface = Surface::Box {
        centre: 0.5 * high,
        half: 0.5 * high,
        orientation: Orientation::identity(),
        side: Side::Inside,
    };
    s.walls = vec![Wall::fixed("box", surface, 0)];
    s.gravity = V3::z() * -9.81;
    s
}
