//! Cells whose wall links are exactly those of one face of the lattice \[B3\].

use crate::lane::Lane;
use crate::lattice::{C, Q, direction, pair};

/// A flat wall beside a cell: one of the six faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FlatWall {
    /// Axis of its normal.
    axis: u8,
    /// Whether it lies at the high side.
    high: bool,
    /// The link straight into it.
    normal: u8,
    /// For each axis along it the oblique links into it, that of the positive sense first.
    oblique: [[u8; 2]; 2],
}

impl FlatWall {
    /// From the directions that lead into walls, one bit each; `None` at edges, corners, steps and between two walls.
    #[must_use]
    pub fn of(walls: u32) -> Option<Self> {
        let first = (1..=6).find(|&i| links(C[i]) == walls)?;
        let axis = C[first].iter().position(|&c| c != 0)?;
        let [a, b] = others(axis);
        let towards = |along: usize| {
            let link = |sign: i32| {
                let mut c = C[first];
                c[along] = sign;
                direction(c).unwrap_or(0) as u8
            };
            [link(1), link(-1)]
        };
        let normal = first as u8;
        Some(Self { axis: axis as u8, high: C[first][axis] > 0, normal, oblique: [towards(a), towards(b)] })
    }

    /// The two axes along the wall.
    #[inline(always)]
    fn along(self) -> [usize; 2] {
        others(usize::from(self.axis))
    }

    /// Whether a vector is rather along the wall than across it.
    pub(crate) fn runs_along(self, v: &[f64; 3]) -> bool {
        let across = v[usize::from(self.axis)];
        2.0 * across * across < v.iter().map(|v| v * v).sum::<f64>()
    }

    /// The components of a vector along the wall.
    #[inline(always)]
    pub fn tangential<L: Lane>(self, v: &[L; 3]) -> [L; 2] {
        let [a, b] = self.along();
        [v[a], v[b]]
    }

    /// The vector with these components along the wall and none across it.
    #[inline(always)]
    pub fn vector<L: Lane>(self, v: &[L; 2]) -> [L; 3] {
        let mut out = [L::zero(); 3];
        let [a, b] = self.along();
        out[a] = v[0];
        out[b] = v[1];
        out
    }

    /// Part along the wall of a symmetric tensor times the normal that points into the wall.
    #[inline(always)]
    pub fn traction<L: Lane>(self, q: &[L; 6]) -> [L; 2] {
        let [a, b] = self.along();
        let axis = usize::from(self.axis);
        let (qa, qb) = (q[pair(axis, a)], q[pair(axis, b)]);
        if self.high { [qa, qb] } else { [-qa, -qb] }
    }

    /// Adds to what the wall takes from the populations that leave: Δ_a of each of both oblique links along the axis a, and
    /// −2 (Δ_1 + Δ_2) of the link straight into it. No mass and no momentum is exchanged; Σ c_a² changes by 2 Δ_a.
    #[inline(always)]
    pub fn add_third<L: Lane>(self, taken: &mut [L; Q], delta: &[L; 2]) {
        for (pair, delta) in self.oblique.iter().zip(delta) {
            for &i in pair {
                taken[usize::from(i)] = taken[usize::from(i)] + *delta;
            }
        }
        let normal = usize::from(self.normal);
        taken[normal] = taken[normal] - L::splat(2.0) * (delta[0] + delta[1]);
    }

    /// Σ c_i x_i over the wall's links, the part along it.
    ///
    /// # Exactness
    /// Two links count on either axis, so that mirrored numbers give mirrored sums.
    #[inline(always)]
    pub fn first_moment<L: Lane>(self, x: &[L; Q]) -> [L; 2] {
        let [[a, minus_a], [b, minus_b]] = self.oblique.map(|pair| pair.map(usize::from));
        [x[a] - x[minus_a], x[b] - x[minus_b]]
    }
}

/// Bits of the five directions that have the part `towards` along its axis.
fn links(towards: [i32; 3]) -> u32 {
    let along = |i: usize| C[i][0] * towards[0] + C[i][1] * towards[1] + C[i][2] * towards[2];
    (1..Q).filter(|&i| along(i) == 1).fold(0, |links, i| links | 1 << i)
}

/// The two other axes.
#[inline(always)]
fn others(axis: usize) -> [usize; 2] {
    match axis {
        0 => [1, 2],
        1 => [0, 2],
        _ => [0, 1],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_links_of_each_face() {
        for face in 1..=6 {
            let walls = links(C[face]);
            assert_eq!(walls.count_ones(), 5);
            let wall = FlatWall::of(walls).map(|wall| (C[face][usize::from(wall.axis)], wall.high));
            assert!(matches!(wall, Some((1, true) | (-1, false))), "{wall:?}");
            // One link more, or one less: an edge, or a step.
            for i in 1..Q {
                assert_eq!(FlatWall::of(walls ^ 1 << i), None);
            }
        }
        assert_eq!(FlatWall::of(0), None);
        assert_eq!(FlatWall::of(links(C[1]) | links(C[2])), None);
    }

    /// No mass, no momentum, and 2 Δ_a of Σ c_a² along each axis a of the wall, at every face.
    #[test]
    fn exact_moments_of_what_is_added_to_third_moments() {
        let delta = [0.5, -0.125];
        for face in 1..=6 {
            let Some(wall) = FlatWall::of(links(C[face])) else { panic!("a face") };
            let mut taken = [0.0; Q];
            wall.add_third(&mut taken, &delta);
            let sum =
                |f: &dyn Fn([i32; 3]) -> i32| -> f64 { (0..Q).map(|i| f64::from(f(C[i])) * taken[i]).sum() };
            assert_eq!(sum(&|_| 1), 0.0);
            let along = wall.along();
            for a in 0..3 {
                assert_eq!(sum(&|c| c[a]), 0.0, "momentum along {a} at face {face}");
                let squares = along.iter().position(|&b| b == a).map_or(0.0, |k| 2.0 * delta[k]);
                assert_eq!(sum(&|c| c[a] * c[a]), squares, "squares along {a} at face {face}");
            }
            // Only links into the wall.
            assert!((0..Q).all(|i| taken[i] == 0.0 || links(C[face]) >> i & 1 == 1));
        }
    }

    #[test]
    fn exact_moment_is_the_sum_over_the_links() {
        let x: [f64; Q] = std::array::from_fn(|i| libm::sin(1.0 + i as f64));
        for face in 1..=6 {
            let walls = links(C[face]);
            let mut sum = [0.0; 3];
            for i in (1..Q).filter(|&i| walls >> i & 1 != 0) {
                for a in 0..3 {
                    sum[a] += f64::from(C[i][a]) * x[i];
                }
            }
            let pairs = FlatWall::of(walls).map(|wall| (wall.first_moment(&x), wall.tangential(&sum)));
            let (found, wanted) = pairs.unwrap_or_default();
            assert_ne!(found, [0.0; 2]);
            for a in 0..2 {
                assert!((found[a] - wanted[a]).abs() < 1e-15);
            }
        }
    }
}
