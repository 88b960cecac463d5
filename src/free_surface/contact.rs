//! What walls send back to partly filled cells that meet them face on \[F10\].

use super::normal::outward_beside_walls;
use crate::lattice::{C, Q, direction};

/// The surface of an interface cell beside walls.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contact {
    fill: f64,
    /// Whether a wall lies along −x, +x, −y, …
    walls: [[bool; 2]; 3],
    /// Normal with walls mirrored \[F1\].
    pub along: [f64; 3],
    /// Normal with its components towards walls.
    facing: [f64; 3],
}

impl Contact {
    /// # Arguments
    /// `fill`: φ of the cell. `around[i]`: φ at x + c_i, `None` where there is no cell.
    #[must_use]
    pub(crate) fn new(fill: f64, around: &[Option<f64>; Q]) -> Self {
        let beside = std::array::from_fn(|a| {
            [-1, 1].map(|sign| {
                let mut axis = [0; 3];
                axis[a] = sign;
                direction(axis).and_then(|i| around[i])
            })
        });
        let along = outward_beside_walls(fill, around);
        let walls = beside.map(|sides: [Option<f64>; 2]| sides.map(|side| side.is_none()));
        Self { fill, walls, along, facing: facing(fill, &along, &beside) }
    }

    /// w: how much of what leaves along a link to a wall meets it; the rest meets gas that is left before the wall.
    ///
    /// w = 1 − (1 − φ) max(0, 2 n̂·ŵ − 1), ŵ along those components of c that lead into a wall by themselves. Beyond 60° the
    /// surface ends at the wall and the cell is wet over the height of its fill, as pools and films are.
    ///
    /// # Arguments
    /// `out`: direction towards the wall.
    /// # Source
    /// docs/method.md \[F10\], ours.
    /// # Verified by
    /// Test `exact_share_that_meets_a_wall`; claim `impact-impulse`.
    #[must_use]
    pub(crate) fn meeting(&self, out: usize) -> f64 {
        let n = &self.facing;
        let square = (n[0] * n[0] + n[1] * n[1]) + n[2] * n[2];
        let (mut towards, mut axes) = (0.0, 0.0);
        for (a, &c) in C[out].iter().enumerate() {
            if c != 0 && self.walls[a][usize::from(c > 0)] {
                towards += f64::from(c) * n[a];
                axes += 1.0;
            }
        }
        // Square roots of what is not positive would be NaN.
        if towards <= 0.0 {
            return 1.0;
        }
        let cosine = towards / (square * axes).sqrt();
        1.0 - (1.0 - self.fill) * (2.0 * cosine - 1.0).max(0.0)
    }
}

/// Where one side of the cell is a wall, the component towards it is what the fill falls by from the other side.
///
/// `along`: the normal with walls mirrored, which has none. `beside`: φ by axis and side.
fn facing(fill: f64, along: &[f64; 3], beside: &[[Option<f64>; 2]; 3]) -> [f64; 3] {
    std::array::from_fn(|a| match beside[a] {
        [Some(inner), None] => (inner - fill).max(0.0),
        [None, Some(inner)] => -(inner - fill).max(0.0),
        [None, None] | [Some(_), Some(_)] => along[a],
    })
}

/// w f_wall + (1 − w) f_gas.
///
/// # Arguments
/// `wall`, `gas`: what each sends back. `share`: w ([`Contact::meeting`]).
/// # Source
/// docs/method.md \[F10\], ours.
/// # Verified by
/// As [`Contact::meeting`].
#[inline(always)]
#[must_use]
pub(crate) fn sent_back(wall: f64, gas: f64, share: f64) -> f64 {
    share * wall + (1.0 - share) * gas
}

#[cfg(test)]
mod tests {
    use super::*;

    fn link(c: [i32; 3]) -> usize {
        direction(c).unwrap_or(0)
    }

    #[test]
    fn exact_share_that_meets_a_wall() {
        // Liquid at −x, a wall at +x: the front has come over a quarter of the cell.
        let around = std::array::from_fn(|i| match C[i][0] {
            1 => None,
            0 => Some(0.25),
            _ => Some(1.0),
        });
        let front = Contact::new(0.25, &around);
        assert_eq!(front.meeting(link([1, 0, 0])), 0.25);
        assert_eq!(front.meeting(link([1, 0, 1])), 0.25);
        assert_eq!(front.meeting(link([0, 0, 1])), 1.0);
        // A level surface beside the same wall.
        let around = std::array::from_fn(|i| match (C[i][0], C[i][2]) {
            (1, _) => None,
            (_, 1) => Some(0.0),
            (_, 0) => Some(0.25),
            _ => Some(1.0),
        });
        let level = Contact::new(0.25, &around);
        assert_eq!(level.meeting(link([1, 0, 0])), 1.0);
        // A film on a floor, and a slit with walls on both sides.
        let around = std::array::from_fn(|i| match C[i][2] {
            -1 => None,
            0 => Some(0.25),
            _ => Some(0.0),
        });
        assert_eq!(Contact::new(0.25, &around).meeting(link([0, 0, -1])), 1.0);
        let around = std::array::from_fn(|i| if C[i][2] == 0 { Some(0.25) } else { None });
        assert_eq!(Contact::new(0.25, &around).meeting(link([0, 0, -1])), 1.0);
    }

    #[test]
    fn level_surfaces_meet_all_walls() {
        // As the normal: any set of solids around a level surface, each seventh of 2¹⁸.
        let level = |c: [i32; 3]| [1.0, 0.25, 0.0][(c[2] + 1) as usize];
        for solids in (0..1_u32 << 18).step_by(7) {
            let around = std::array::from_fn(|i| (i == 0 || solids >> (i - 1) & 1 == 0).then(|| level(C[i])));
            let contact = Contact::new(0.25, &around);
            let roof = around[link([0, 0, 1])].is_none();
            for out in (1..Q).filter(|&out| around[out].is_none() && !(roof && C[out][2] > 0)) {
                assert_eq!(contact.meeting(out), 1.0, "{solids:b} {out}");
            }
        }
    }
}
