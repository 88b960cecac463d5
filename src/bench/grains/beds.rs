//! Dense beds to measure speeds on: for `lahar bench` and for the exhibit `grains-speed`.

use crate::dem::packing::{Lattice, Random, Region, lattice};
use crate::dem::{
    Clump, DemError, Grain, Material, Materials, Orientation, PairProperties, Period, Setup, Side, Surface,
    V3, Wall,
};

/// Radius of the grains, m.
const R: f64 = 5e-3;
/// Centres are this much nearer than touching.
const PRESSED: f64 = 0.999;

fn empty() -> Setup {
    let material = Material { name: "grain".into(), density_kg_m3: 2650.0, young_pa: 7e7, poisson: 0.22 };
    let mut s = Setup::new(Materials::single(material, PairProperties::default()));
    s.start_overlap = 0.02;
    s
}

fn shaken(grain: Grain, random: &mut Random, speed: f64) -> Grain {
    grain.moving(V3::from_fn(|_, _| speed * random.normal()))
}

/// A periodic face-centred lattice `k` cells wide, every sphere pressed against twelve others and shaken.
///
/// # Errors
/// None for k ≥ 1.
pub fn crystal(k: u32) -> Result<Setup, DemError> {
    let cell = 2f64.sqrt() * 2.0 * R;
    let region = Region::Box { low: V3::zeros(), high: V3::repeat((f64::from(k) - 0.25) * cell + 2.0 * R) };
    let mut s = empty();
    let mut random = Random::new(1);
    s.grains = lattice(Lattice::FaceCentred, R, 2.0 * R, &region)?
        .into_iter()
        .map(|p| shaken(Grain::sphere(R, p.centre * PRESSED, 0), &mut random, 0.02))
        .collect();
    s.period = Period([Some(f64::from(k) * cell * PRESSED); 3]);
    Ok(s)
}

/// About `n` spheres under gravity in a box: a face-centred lattice pressed a little and shaken, which settles.
///
/// # Errors
/// None for n ≥ 1.
pub(crate) fn spheres(n: usize) -> Result<Setup, DemError> {
    let side = 2.0 * R * libm::cbrt(n as f64 / 2f64.sqrt()) * 1.02;
    let region = Region::Box { low: V3::zeros(), high: V3::repeat(side) };
    let mut s = empty();
    let mut random = Random::new(1);
    s.grains = lattice(Lattice::FaceCentred, R, 2.0 * R, &region)?
        .into_iter()
        .map(|p| shaken(Grain::sphere(R, p.centre * 0.9995, 0), &mut random, 0.05))
        .collect();
    Ok(boxed(s, side, 0.0))
}

/// In a box from 0 to `side`, wider by `margin` on all sides (m), under gravity.
fn boxed(mut s: Setup, side: f64, margin: f64) -> Setup {
    let (centre, half) = (V3::repeat(0.5 * side), V3::repeat(0.5 * side + margin));
    let surface = Surface::Box { centre, half, orientation: Orientation::identity(), side: Side::Inside };
    s.walls = vec![Wall::fixed("box", surface, 0)];
    s.gravity = V3::z() * -9.81;
    s
}

/// A box of k³ tetrahedral clumps of edge 1.5 r in one orientation, each touching its six neighbours with four pairs
/// of members, under gravity.
///
/// # Errors
/// None for k ≥ 1.
pub fn clumps(k: u32) -> Result<Setup, DemError> {
    let mut s = empty();
    let clump = Clump::tetrahedron(1.0, 1.5)?;
    let member = R / clump.equivalent_radius();
    let a = 1.5 / 8f64.sqrt();
    let pitch = member * (2.0 * a + 2.0 * (1.0 - a * a).sqrt());
    let side = pitch * (f64::from(k) + 0.5);
    let region = Region::Box { low: V3::zeros(), high: V3::repeat(side) };
    let mut random = Random::new(1);
    let upright = clump.frame;
    s.grains = lattice(Lattice::SimpleCubic, 0.5 * pitch, pitch, &region)?
        .into_iter()
        .map(|p| shaken(Grain::clump(0, R, p.centre * PRESSED, upright, 0), &mut random, 0.002))
        .collect();
    s.clumps.push(clump);
    // A clump's members reach beyond half the pitch at the outermost corners.
    Ok(boxed(s, side, 0.2 * R))
}

/// Large spheres, `ratio` times as large as the small ones, on a periodic cubic lattice of k × 2 × 2 cells; what is
/// left is filled with a face-centred lattice of small ones, every one pressed against its neighbours.
///
/// # Errors
/// None for k ≥ 2.
pub fn mixed(ratio: f64, k: u32) -> Result<Setup, DemError> {
    let cell = 2f64.sqrt() * 2.0 * R;
    // Whole cells of the small lattice, a little wider than a large sphere.
    let edge = (2.3 * ratio * R / cell).ceil() * cell;
    let lengths = [f64::from(k), 2.0, 2.0].map(|n| n * edge);
    let mut s = empty();
    let centres: Vec<V3> = (0..4 * k)
        .map(|i| [i / 4, i / 2 % 2, i % 2].map(|n| (f64::from(n) + 0.5) * edge * PRESSED))
        .map(V3::from)
        .collect();
    let high = V3::from(lengths.map(|l| l - 0.25 * cell + 2.0 * R));
    let region = Region::Box { low: V3::zeros(), high };
    let mut random = Random::new(1);
    s.grains = centres.iter().map(|&c| Grain::sphere(ratio * R, c, 0)).collect();
    // A sphere of the lattice also counts against the images of the large ones beyond the faces.
    let apart = |x: &V3, c: &V3| {
        V3::from_fn(|a, _| {
            let (d, l) = (x[a] - c[a], lengths[a] * PRESSED);
            d - l * (d / l).round()
        })
        .norm()
    };
    for p in lattice(Lattice::FaceCentred, R, 2.0 * R, &region)? {
        let x = p.centre * PRESSED;
        if centres.iter().all(|c| apart(&x, c) > (1.0 + ratio) * R * PRESSED) {
            s.grains.push(shaken(Grain::sphere(R, x, 0), &mut random, 0.02));
        }
    }
    s.period = Period(lengths.map(|l| Some(l * PRESSED)));
    Ok(s)
}
