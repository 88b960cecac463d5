//! Search over wave vectors for the fastest growing wave, and over speeds for the largest stable one.

use std::collections::HashMap;
use std::f64::consts::PI;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::{GROWTH_TOLERANCE, Linearised, StabilityError, check_tau};
use crate::collision::Collision;

/// The directions of flow that the tables give; any other lies between them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// Along an axis.
    X,
    /// Along a face diagonal.
    Xy,
    /// Along a space diagonal.
    Xyz,
}

impl Direction {
    /// All three.
    pub const ALL: [Self; 3] = [Self::X, Self::Xy, Self::Xyz];

    /// Unit vector.
    #[must_use]
    pub fn unit(self) -> [f64; 3] {
        match self {
            Self::X => [1.0, 0.0, 0.0],
            Self::Xy => [0.5_f64.sqrt(), 0.5_f64.sqrt(), 0.0],
            Self::Xyz => [(1.0_f64 / 3.0).sqrt(); 3],
        }
    }

    /// Velocity of this direction and speed.
    #[must_use]
    pub fn velocity(self, speed: f64) -> [f64; 3] {
        self.unit().map(|e| speed * e)
    }

    /// Short name: x, xy, xyz.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Xy => "xy",
            Self::Xyz => "xyz",
        }
    }
}

/// How thoroughly wave vectors are searched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Search {
    /// Points per axis over the full circle, one grid after the other: a finer grid is only looked at
    /// when the one before shows no growing wave.
    pub grids: &'static [usize],
    /// How many of the best maxima of a grid are refined.
    pub starts: usize,
}

impl Search {
    /// For tables where the limit is smooth (τ⁺ ≥ 0.52): a second per entry.
    pub const SMOOTH: Self = Self { grids: &[16, 22], starts: 16 };
    /// For tables: a few seconds per entry.
    pub const THOROUGH: Self = Self { grids: &[16, 22, 34, 46], starts: 16 };
    /// For a single limit while a user waits: a fraction of a second per entry.
    pub const QUICK: Self = Self { grids: &[12, 18], starts: 12 };
}

/// Speed from which the search descends: the speed of sound.
pub const CEILING: f64 = 0.577;
/// Speeds below this are not told apart from zero.
const SLOWEST: f64 = 1e-9;
/// Growing waves followed down in one round.
const FOLLOWED: usize = 4;

/// A wave and how it grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// Wave vector, radians per cell.
    pub wave: [f64; 3],
    /// Spectral radius of M(k).
    pub radius: f64,
}

/// A speed above which at least one wave grows, and that wave.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Limit {
    /// Speed, lattice units.
    pub speed: f64,
    /// Wave vector, radians per cell; zero if none grows up to [`CEILING`].
    pub wave: [f64; 3],
}

/// The wave of largest spectral radius, by a coarse grid and refinement of its best maxima.
///
/// # Errors
/// Eigenvalues did not converge.
pub fn peak(linearised: &Linearised, search: &Search) -> Result<Peak, StabilityError> {
    let mut all = Vec::new();
    for &n in search.grids {
        all.extend(peaks(linearised, n, search.starts)?);
    }
    Ok(best(&all))
}

/// The refined maxima of a grid of `n` points per axis.
fn peaks(linearised: &Linearised, n: usize, starts: usize) -> Result<Vec<Peak>, StabilityError> {
    let group = stabiliser(linearised.velocity());
    let grid = coarse(linearised, &group, n)?;
    let starts = maxima(&grid, &group, n, starts);
    let width = 2.0 * PI / n as f64;
    starts.par_iter().map(|start| climb(linearised, *start, 0.4 * width)).collect()
}

fn best(peaks: &[Peak]) -> Peak {
    let mut best = Peak { wave: [0.0; 3], radius: 0.0 };
    for &peak in peaks {
        if peak.radius > best.radius {
            best = peak;
        }
    }
    best
}

/// One grid point with its radius and how often its mirror images occur.
struct GridPoint {
    index: [usize; 3],
    peak: Peak,
}

/// Spectral radius on the grid k = 2π n / N, one representative of each set of equivalent waves.
fn coarse(linearised: &Linearised, group: &[Symmetry], n: usize) -> Result<Vec<GridPoint>, StabilityError> {
    let points: Vec<[usize; 3]> = (0..n * n * n)
        .map(|p| [p % n, (p / n) % n, p / (n * n)])
        .filter(|&p| canonical(p, n, group) == p)
        .collect();
    points
        .par_iter()
        .map(|&index| {
            let wave = wave_of(index, n);
            Ok(GridPoint { index, peak: Peak { wave, radius: linearised.spectral_radius(wave)? } })
        })
        .collect()
}

fn wave_of(index: [usize; 3], n: usize) -> [f64; 3] {
    index.map(|i| {
        let centred = if 2 * i > n { i as f64 - n as f64 } else { i as f64 };
        2.0 * PI * centred / n as f64
    })
}

/// A signed permutation of the axes: `(from[a], negative[a])`.
type Symmetry = [(usize, bool); 3];

/// The symmetries of the cube that leave the velocity as it is, up to its sign: reversing both k and
/// the complex conjugate of M changes no modulus, and k → −k is exactly that, so each symmetry also
/// counts with k reversed.
fn stabiliser(u: [f64; 3]) -> Vec<Symmetry> {
    let mut group = Vec::new();
    for order in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
        for signs in 0..8_u8 {
            let g: Symmetry = std::array::from_fn(|a| (order[a], signs >> a & 1 == 1));
            let image: [f64; 3] = std::array::from_fn(|a| if g[a].1 { -u[g[a].0] } else { u[g[a].0] });
            if image == u {
                group.push(g);
                group.push(g.map(|(from, negative)| (from, !negative)));
            }
        }
    }
    group
}

/// The representative of a grid point: the largest of its images.
fn canonical(p: [usize; 3], n: usize, group: &[Symmetry]) -> [usize; 3] {
    group
        .iter()
        .map(|g| {
            std::array::from_fn(|a| {
                let i = p[g[a].0];
                if g[a].1 { (n - i) % n } else { i }
            })
        })
        .fold(p, |best, image: [usize; 3]| best.max(image))
}

/// The best local maxima of the grid values, over the 26 neighbours, best first; ties in index order.
fn maxima(grid: &[GridPoint], group: &[Symmetry], n: usize, starts: usize) -> Vec<Peak> {
    let radius: HashMap<[usize; 3], f64> = grid.iter().map(|p| (p.index, p.peak.radius)).collect();
    let is_maximum = |point: &&GridPoint| {
        (0..27).filter(|&d| d != 13).all(|d| {
            let step = [d % 3, (d / 3) % 3, d / 9];
            let beside = std::array::from_fn(|a| (point.index[a] + n + step[a] - 1) % n);
            radius.get(&canonical(beside, n, group)).is_none_or(|&r| r <= point.peak.radius)
        })
    };
    let mut all: Vec<Peak> = grid.iter().filter(is_maximum).map(|p| p.peak).collect();
    all.sort_by(|a, b| b.radius.total_cmp(&a.radius));
    all.truncate(starts);
    all
}

/// Nelder-Mead ascent of the spectral radius from a start, until the simplex is small.
fn climb(linearised: &Linearised, start: Peak, width: f64) -> Result<Peak, StabilityError> {
    let at = |wave: [f64; 3]| Ok(Peak { wave, radius: linearised.spectral_radius(wave)? });
    let mut simplex = [start; 4];
    for a in 0..3 {
        let mut wave = start.wave;
        // Unequal and oblique edges, so that no simplex lies in a mirror plane.
        wave[a] += width;
        wave[(a + 1) % 3] += 0.3 * width;
        simplex[a + 1] = at(wave)?;
    }
    for _ in 0..120 {
        simplex.sort_by(|p, q| q.radius.total_cmp(&p.radius));
        let size = (0..3).map(|a| (simplex[3].wave[a] - simplex[0].wave[a]).abs()).fold(0.0, f64::max);
        if size < 1e-4 {
            break;
        }
        let worst = simplex[3];
        let centre: [f64; 3] =
            std::array::from_fn(|a| (simplex[0].wave[a] + simplex[1].wave[a] + simplex[2].wave[a]) / 3.0);
        let along = |t: f64| std::array::from_fn(|a| centre[a] + t * (worst.wave[a] - centre[a]));
        let reflected = at(along(-1.0))?;
        if reflected.radius > simplex[0].radius {
            let further = at(along(-2.0))?;
            simplex[3] = if further.radius > reflected.radius { further } else { reflected };
        } else if reflected.radius > simplex[2].radius {
            simplex[3] = reflected;
        } else {
            let inner = if reflected.radius > worst.radius { at(along(-0.5))? } else { at(along(0.5))? };
            if inner.radius > worst.radius.max(reflected.radius) {
                simplex[3] = inner;
            } else {
                for k in 1..4 {
                    let wave = std::array::from_fn(|a| 0.5 * (simplex[k].wave[a] + simplex[0].wave[a]));
                    simplex[k] = at(wave)?;
                }
            }
        }
    }
    Ok(best(&simplex))
}

/// Largest speed along `direction` at which no wave grows.
///
/// Descends from above the sound limit: at each speed the growing waves are found and refined, then
/// each is followed down to the speed at which it stops growing; repeated from the lowest such speed
/// until no wave grows there.
///
/// # Arguments
/// `tau`: τ⁺ > ½.
/// # Returns
/// The speed and the wave that grows above it; zero and a wave that grows at rest, if there is one. It is an upper bound: a wave that no grid came near
/// may grow at lower speed. Below τ⁺ = 0.51 the growing waves fill thin shells and the search
/// scatters by about ±10 %.
/// # Errors
/// τ⁺ is not above ½, or eigenvalues did not converge.
/// # Source
/// docs/method.md \[K5\].
/// # Verified by
/// Claim `neumann-table`.
pub fn max_stable_speed_along<O: Collision>(
    collision: &O,
    tau: f64,
    direction: Direction,
    search: &Search,
) -> Result<Limit, StabilityError> {
    check_tau(tau)?;
    let mut limit = Limit { speed: CEILING, wave: [0.0; 3] };
    let rest = Linearised::about(collision, tau, [0.0; 3]);
    if let Some(&n) = search.grids.first() {
        let peak = best(&peaks(&rest, n, search.starts)?);
        if peak.radius > 1.0 + GROWTH_TOLERANCE {
            return Ok(Limit { speed: 0.0, wave: peak.wave });
        }
    }
    let mut level = 0;
    while let Some(&n) = search.grids.get(level).filter(|_| limit.speed > SLOWEST) {
        let linearised = Linearised::about(collision, tau, direction.velocity(limit.speed));
        let growing = growing(&linearised, n, search.starts)?;
        let ends: Result<Vec<Limit>, _> = growing
            .par_iter()
            .map(|peak| follow(collision, tau, direction, Limit { speed: limit.speed, wave: peak.wave }, n))
            .collect();
        let before = limit.speed;
        for end in ends? {
            if end.speed < limit.speed {
                limit = end;
            }
        }
        // Nothing, or nothing worth another look: the next grid.
        if limit.speed > (1.0 - 1e-6) * before {
            level += 1;
        }
    }
    Ok(limit)
}

/// The distinct growing waves found at one speed, fastest first, a few of them.
fn growing(linearised: &Linearised, n: usize, starts: usize) -> Result<Vec<Peak>, StabilityError> {
    let mut peaks = peaks(linearised, n, starts)?;
    peaks.retain(|p| p.radius > 1.0 + GROWTH_TOLERANCE);
    peaks.sort_by(|a, b| b.radius.total_cmp(&a.radius));
    let mut distinct: Vec<Peak> = Vec::new();
    for peak in peaks {
        let near = |p: &Peak| (0..3).all(|a| (p.wave[a] - peak.wave[a]).abs() < 0.02);
        if distinct.len() < FOLLOWED && !distinct.iter().any(near) {
            distinct.push(peak);
        }
    }
    Ok(distinct)
}

/// The speed below which a growing wave, moved along with the maximum, no longer grows.
fn follow<O: Collision>(
    collision: &O,
    tau: f64,
    direction: Direction,
    from: Limit,
    n: usize,
) -> Result<Limit, StabilityError> {
    let Limit { mut speed, mut wave } = from;
    let rest = Linearised::about(collision, tau, [0.0; 3]);
    let mut width = 0.1 * 2.0 * PI / n as f64;
    for _ in 0..12 {
        if rest.spectral_radius(wave)? > 1.0 + GROWTH_TOLERANCE {
            return Ok(Limit { speed: 0.0, wave });
        }
        let (mut low, mut high) = (0.0, speed);
        while high - low > 1e-7 * high && high > SLOWEST {
            let middle = 0.5 * (low + high);
            let radius =
                Linearised::about(collision, tau, direction.velocity(middle)).spectral_radius(wave)?;
            if radius > 1.0 + GROWTH_TOLERANCE { high = middle } else { low = middle }
        }
        let moved = speed - high;
        speed = high;
        if moved < 1e-5 * speed {
            break;
        }
        let linearised = Linearised::about(collision, tau, direction.velocity(speed));
        let radius = linearised.spectral_radius(wave)?;
        wave = climb(&linearised, Peak { wave, radius }, width)?.wave;
        width = (0.5 * width).max(0.005);
    }
    Ok(Limit { speed, wave })
}
