//! What stays on a platform when the rest of a block has fallen off its edges, and how steep it is.

use super::support::{Known, Matter, R, SETTLED, VOLUME, bed, free, gate, leave_out, liveliest};
use lahar::dem::{Dem, DemError};

/// Steps between looks.
const LOOK: u64 = 500;
/// Kinetic energy of the liveliest grain at rest, m g R.
const REST: f64 = 1e-5;
/// Longest wait, s.
const LONGEST: f64 = 4.0;
/// Kinetic energy of the liveliest grain of a block that has settled well enough to be let go, m g R.
const STILL: f64 = 1e-3;
/// Height of the settled block over half the width of the platform, above the tangent of any angle of repose here.
const HEIGHT: f64 = 1.3;
/// Grains this far below the platform are taken out, m.
const GONE: f64 = -4.0 * R;

/// A heap at rest on its platform.
#[derive(Clone, Debug)]
pub struct Heap {
    /// Angle of the left and of the right flank, degrees.
    pub flanks: [f64; 2],
    /// Angle of the triangle on the platform whose centre of mass is as high, degrees: tan θ = 3 z/half width.
    pub triangle: f64,
    /// Grains left.
    pub grains: usize,
    /// Kinetic energy of the liveliest grain, m g R; below 1e-5 unless the wait was too long.
    pub liveliest: f64,
    /// s.
    pub time: f64,
}

/// Heaps computed so far in this process; claims and exhibits ask for the same ones.
static KNOWN: Known<Heap> = Known::nothing();

/// Settles a block between smooth gates at the edges of a rough platform of half width `half` and depth `depth`
/// (m, periodic), then takes the gates away and waits for what stays.
///
/// # Errors
/// What the grains refuse.
pub fn settle(matter: &Matter, half: f64, depth: f64, seed: u64) -> Result<Heap, DemError> {
    KNOWN.get(&format!("{matter:?} {half} {depth} {seed}"), || open(matter, half, depth, seed))
}

fn open(matter: &Matter, half: f64, depth: f64, seed: u64) -> Result<Heap, DemError> {
    // The loose block falls farther the taller it is; clumps would overlap by 0.4 of their members' radius on a
    // platform of 16 mean radii if the stiffness did not grow faster than the height.
    let wide = half / (12.0 * R);
    let matter = matter.taller(wide * wide);
    let mut s = matter.slice(depth)?;
    let cell = matter.cell();
    let per_layer = (2.0 * half / cell).floor() * (depth / cell).floor();
    let layers = (HEIGHT * half * 2.0 * half * depth * SETTLED / (VOLUME * R * R * R) / per_layer).ceil();
    s.grains = matter.block(-half, half, depth, cell * layers * (1.0 + 1e-9), seed)?;
    s.grains.extend(bed(-half, half, depth));
    s.walls = vec![gate(-half, 1.0, "left gate"), gate(half, -1.0, "right gate")];
    let mut d = Dem::new(&s)?;
    while d.time() < 0.1 || (liveliest(&d) > STILL && d.time() < LONGEST) {
        d.step(LOOK)?;
    }
    leave_out(&mut d, |_, _| true, 0);
    let start = d.time();
    loop {
        d.step(LOOK)?;
        let stays = |d: &Dem, i: usize| !free(d, i) || d.bodies().position[i].z > GONE;
        if (0..d.bodies().len()).any(|i| !stays(&d, i)) {
            leave_out(&mut d, stays, 0);
        }
        let (most, time) = (liveliest(&d), d.time() - start);
        if (time > 0.2 && most < REST) || time > LONGEST {
            let grains = (0..d.bodies().len()).filter(|&i| free(&d, i)).count();
            let flanks = [-1.0, 1.0].map(|side| angle(&d, half, depth, side));
            return Ok(Heap { flanks, triangle: triangle(&d, half), grains, liveliest: most, time });
        }
    }
}

/// See [`Heap::triangle`]. All grains of the heap count, so it scatters less than the flanks of a small heap.
fn triangle(d: &Dem, half: f64) -> f64 {
    let b = d.bodies();
    let (mut mass, mut moment) = (0.0, 0.0);
    for i in (0..b.len()).filter(|&i| free(d, i)) {
        mass += b.mass[i];
        moment += b.mass[i] * b.position[i].z;
    }
    libm::atan(3.0 * moment / mass / half).to_degrees()
}

/// Angle of a flank, degrees: a straight line by least squares through the highest points of the grains in square
/// cells two mean radii wide, without the cells at the edge and the two nearest to the middle.
fn angle(d: &Dem, half: f64, depth: f64, side: f64) -> f64 {
    let rows = (depth / (2.0 * R)).round().max(1.0) as usize;
    let columns = (half / (2.0 * R)) as usize;
    let mut top = vec![0.0f64; rows * columns];
    for m in d.members().iter().filter(|m| m.inverse_mass > 0.0) {
        let x = (m.position.x * side / (2.0 * R)).floor();
        let y = (m.position.y / depth).rem_euclid(1.0) * rows as f64;
        if x >= 0.0 && (x as usize) < columns {
            let cell = &mut top[x as usize * rows + (y as usize).min(rows - 1)];
            *cell = cell.max(m.position.z + m.radius);
        }
    }
    let points = (2..columns - 1)
        .flat_map(|k| (0..rows).map(move |j| (k, j)))
        .map(|(k, j)| (k as f64, top[k * rows + j]));
    let (mut n, mut sx, mut sz, mut sxx, mut sxz) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (k, z) in points {
        let x = (k + 0.5) * 2.0 * R;
        n += 1.0;
        sx += x;
        sz += z;
        sxx += x * x;
        sxz += x * z;
    }
    libm::atan(-(n * sxz - sx * sz) / (n * sxx - sx * sx)).to_degrees()
}
