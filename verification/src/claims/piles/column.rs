//! Column of spheres that settles between smooth walls and collapses when one of them is taken away.

use super::support::{G, Known, Matter, R, SETTLED, VOLUME, bed, free, gate, leave_out, liveliest};
use lahar::dem::neighbours::PairList;
use lahar::dem::{Dem, DemError};

/// Steps between looks.
const LOOK: u64 = 500;
/// Kinetic energy of the liveliest grain of a column at rest, m g R.
const STILL: f64 = 1e-3;
/// Kinetic energy of the liveliest connected grain of a deposit at rest, m g R.
const REST: f64 = 1e-4;
/// Longest waits, s.
const LONGEST: [f64; 2] = [1.5, 3.0];
/// Gap over which grains of a deposit count as connected, as a share of the sum of their radii.
const GAP: f64 = 0.125;

/// A deposit.
#[derive(Clone, Debug)]
pub struct Deposit {
    /// Grains.
    pub grains: usize,
    /// Height of the column over its width.
    pub aspect: f64,
    /// (L − L₀)/L₀ by the farthest grain connected to the deposit.
    pub runout: f64,
    /// (L − L₀)/L₀ by the place where the mean thickness falls through one radius.
    pub thin: f64,
    /// Height of the deposit over the column's width.
    pub height: f64,
    /// Grains that flew off.
    pub lost: usize,
    /// Kinetic energy of the liveliest grain of the deposit, m g R.
    pub liveliest: f64,
    /// s, from the release.
    pub time: f64,
    /// Thickness profile: (x/L₀, h/L₀).
    pub profile: Vec<[f64; 2]>,
}

/// Thickness by columns one mean diameter wide: the mean over the depth of the highest points.
fn profile(d: &Dem, depth: f64) -> Vec<f64> {
    let rows = (depth / (2.0 * R)).round().max(1.0) as usize;
    let far =
        (0..d.bodies().len()).filter(|&i| free(d, i)).map(|i| d.bodies().position[i].x).fold(0.0, f64::max);
    let columns = (far / (2.0 * R)) as usize + 2;
    let mut top = vec![0.0f64; rows * columns];
    for m in d.members().iter().filter(|m| m.inverse_mass > 0.0) {
        let x = (m.position.x / (2.0 * R)).max(0.0) as usize;
        let y = (m.position.y / depth).rem_euclid(1.0) * rows as f64;
        let cell = &mut top[x * rows + (y as usize).min(rows - 1)];
        *cell = cell.max(m.position.z + m.radius);
    }
    top.chunks(rows).map(|c| c.iter().sum::<f64>() / rows as f64).collect()
}

/// Grains connected to the one nearest to the inner corner over gaps of at most [`GAP`], the bed left out.
fn connected(d: &Dem, depth: f64) -> Vec<bool> {
    let n = d.bodies().len();
    let mut links: Vec<Vec<usize>> = vec![Vec::new(); n];
    for (a, b) in PairList::find(d.members(), [None, Some(depth), None], GAP).pairs {
        let (a, b) = (d.members()[a as usize].body as usize, d.members()[b as usize].body as usize);
        if free(d, a) && free(d, b) {
            links[a].push(b);
            links[b].push(a);
        }
    }
    let from_corner = |i: usize| {
        let x = d.bodies().position[i];
        x.x * x.x + x.z * x.z
    };
    let start = (0..n).filter(|&i| free(d, i)).min_by(|&a, &b| from_corner(a).total_cmp(&from_corner(b)));
    let mut reached = vec![false; n];
    let mut stack: Vec<usize> = start.into_iter().collect();
    while let Some(i) = stack.pop() {
        if !reached[i] {
            reached[i] = true;
            stack.extend(links[i].iter().filter(|&&j| !reached[j]));
        }
    }
    reached
}

/// Deposits computed so far in this process; claims and exhibits ask for the same ones.
static KNOWN: Known<Deposit> = Known::nothing();

/// Lets a column `across` mean diameters wide and about `aspect` times as high collapse along x; x = 0 is a smooth
/// wall (a plane of symmetry), the slice is four diameters deep and periodic.
///
/// # Errors
/// What the grains refuse.
pub fn collapse(matter: &Matter, across: f64, aspect: f64, seed: u64) -> Result<Deposit, DemError> {
    KNOWN.get(&format!("{matter:?} {across} {aspect} {seed}"), || fall(matter, across, aspect, seed))
}

/// What is known of a deposit before its shape is taken.
struct Seen {
    grains: usize,
    height: f64,
    width: f64,
    depth: f64,
    lively: f64,
    time: f64,
}

/// The deposit made of the grains that are `part` of it.
fn deposit(d: &Dem, part: &[bool], seen: &Seen) -> Deposit {
    let b = d.bodies();
    let Seen { grains, height, width, depth, lively, time } = *seen;
    let front = (0..b.len()).filter(|&i| part[i]).map(|i| b.position[i].x + b.radius[i]).fold(0.0, f64::max);
    let shape = profile(d, depth);
    let thin = shape.iter().position(|&h| h < R).unwrap_or(shape.len()) as f64 * 2.0 * R;
    Deposit {
        grains,
        aspect: height / width,
        runout: front / width - 1.0,
        thin: thin / width - 1.0,
        height: shape[0] / width,
        lost: grains - part.iter().filter(|p| **p).count(),
        liveliest: lively,
        time,
        profile: shape
            .iter()
            .enumerate()
            .map(|(k, h)| [(k as f64 + 0.5) * 2.0 * R / width, h / width])
            .collect(),
    }
}

fn fall(matter: &Matter, across: f64, aspect: f64, seed: u64) -> Result<Deposit, DemError> {
    let (width, depth) = (2.0 * R * across, 8.0 * R * (1.0 + 1e-9));
    let matter = matter.taller(across * aspect / 10.0);
    let mut s = matter.slice(depth)?;
    // As many layers as give the wanted height when the grains have settled to 0.58 of the volume (their mean cube
    // is 1.04 R³).
    let cell = matter.cell();
    let columns = (width / cell).floor();
    let per_layer = columns * (depth / cell).floor();
    let layers =
        (aspect * width * width * depth * SETTLED / (VOLUME * R * R * R) / per_layer).round().max(1.0);
    s.grains = matter.block(0.0, width, depth, cell * layers * (1.0 + 1e-9), seed)?;
    let reach = width * (2.0 + 3.0 * aspect);
    s.grains.extend(bed(0.0, reach, depth));
    s.walls = vec![gate(0.0, 1.0, "back"), gate(width, -1.0, "gate")];
    let mut d = Dem::new(&s)?;
    while d.time() < LONGEST[0] && !(d.time() > 0.1 && liveliest(&d) < STILL) {
        d.step(LOOK)?;
    }
    let full = profile(&d, depth);
    let inside = across as usize;
    let height = full[..inside].iter().sum::<f64>() / inside as f64;
    let grains = (0..d.bodies().len()).filter(|&i| free(&d, i)).count();
    leave_out(&mut d, |_, _| true, 1);
    let start = d.time();
    loop {
        d.step(LOOK)?;
        // Single grains bounce and roll ahead of the deposit; those that leave the bed are taken out.
        let stays = |d: &Dem, i: usize| !free(d, i) || d.bodies().position[i].z > -4.0 * R;
        if (0..d.bodies().len()).any(|i| !stays(&d, i)) {
            leave_out(&mut d, stays, 1);
        }
        let time = d.time() - start;
        if time < 0.2 {
            continue;
        }
        let part = connected(&d, depth);
        let b = d.bodies();
        let lively = (0..b.len())
            .filter(|&i| part[i])
            .map(|i| (b.translational_energy(i) + b.rotational_energy(i)) / (b.mass[i] * G * R))
            .fold(0.0, f64::max);
        if lively < REST || time > LONGEST[1] {
            let seen = Seen { grains, height, width, depth, lively, time };
            return Ok(deposit(&d, &part, &seen));
        }
    }
}
