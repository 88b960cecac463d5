//! The D3Q19 lattice \[L1\]: velocities, weights, and the sums over them.
//!
//! Populations are stored as h_i = f_i − w_i \[L7\], so that a fluid at rest at the reference
//! density is exact zero. Every sum over populations is grouped so that a mirror image of a state
//! gives the mirror image of the sum, bit for bit.

pub mod equilibrium;
pub mod moments;
pub(crate) mod unroll;

/// Number of velocities.
pub const Q: usize = 19;

/// Lattice velocities c_i: rest, six axis directions, twelve edge diagonals; `i` and
/// [`opposite`]`(i)` are neighbours in the list.
///
/// # Source
/// 004 Table 3.1.
pub const C: [[i32; 3]; Q] = [
    [0, 0, 0],
    [1, 0, 0],
    [-1, 0, 0],
    [0, 1, 0],
    [0, -1, 0],
    [0, 0, 1],
    [0, 0, -1],
    [1, 1, 0],
    [-1, -1, 0],
    [1, -1, 0],
    [-1, 1, 0],
    [1, 0, 1],
    [-1, 0, -1],
    [1, 0, -1],
    [-1, 0, 1],
    [0, 1, 1],
    [0, -1, -1],
    [0, 1, -1],
    [0, -1, 1],
];

/// Lattice weights w_i.
///
/// # Source
/// 004 Table 3.1.
pub const W: [f64; Q] = [
    1.0 / 3.0,
    1.0 / 18.0,
    1.0 / 18.0,
    1.0 / 18.0,
    1.0 / 18.0,
    1.0 / 18.0,
    1.0 / 18.0,
    1.0 / 36.0,
    1.0 / 36.0,
    1.0 / 36.0,
    1.0 / 36.0,
    1.0 / 36.0,
    1.0 / 36.0,
    1.0 / 36.0,
    1.0 / 36.0,
    1.0 / 36.0,
    1.0 / 36.0,
    1.0 / 36.0,
    1.0 / 36.0,
];

/// Squared speed of sound.
pub const CS2: f64 = 1.0 / 3.0;

/// Index of −c_i.
#[must_use]
pub const fn opposite(i: usize) -> usize {
    if i == 0 {
        0
    } else if i % 2 == 1 {
        i + 1
    } else {
        i - 1
    }
}

/// Index of the velocity `c`; components must be in −1..=1 and at most two of them non-zero.
#[must_use]
pub(crate) fn direction(c: [i32; 3]) -> Option<usize> {
    C.iter().position(|&v| v == c)
}

/// Order of the six entries of a symmetric tensor: xx, yy, zz, xy, xz, yz.
pub(crate) const SYMMETRIC: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]];

/// Entry of a symmetric tensor for the pair (a, b).
#[must_use]
pub(crate) const fn pair(a: usize, b: usize) -> usize {
    if a == b { a } else { a + b + 2 }
}
