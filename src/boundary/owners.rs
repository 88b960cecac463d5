//! Whose load each component of what a bounced-back population brings is \[C7\].

use super::step::{Step, upstream};
use crate::lattice::C;
use crate::setup::{Face, Setup};

/// By axis, the numbers of the two solids that share alike what the population arriving along c_i brings
/// (0: a face of the box); twice the same number where it is one's alone.
///
/// The middle of a diagonal link lies on an edge of its cell. Where two walls meet there at an inner edge, the link
/// carries a sixth of the pressure on both, and each gets what is brought along its own normal. In a flat wall the edge
/// is shared by what lies beside the cell and what the link leads to. Past an outer edge all belongs to the latter.
///
/// # Arguments
/// `at`: a fluid cell; `body`: what the link leads to.
/// # Source
/// docs/method.md \[C7\], ours.
/// # Verified by
/// Claim `loads-at-joints`.
#[must_use]
pub(crate) fn owners(setup: &Setup, at: [usize; 3], i: usize, body: u8) -> [[u8; 2]; 3] {
    let beside: [Option<u8>; 3] = std::array::from_fn(|axis| wall_beside(setup, at, axis, C[i][axis]));
    let mut walls = beside.into_iter().flatten();
    match (walls.next(), walls.next()) {
        (Some(_), Some(_)) => beside.map(|wall| [wall.unwrap_or(body); 2]),
        (Some(wall), None) => [[wall, body]; 3],
        _ => [[body; 2]; 3],
    }
}

/// The wall right beside a cell, upstream of a velocity along an axis.
fn wall_beside(setup: &Setup, at: [usize; 3], axis: usize, velocity: i32) -> Option<u8> {
    if velocity == 0 {
        return None;
    }
    match upstream(setup, at, axis, velocity) {
        Step::Out(_, Face::NoSlip | Face::Moving(_)) => Some(0),
        Step::Out(..) => None,
        Step::To(x) => {
            let mut there = at;
            there[axis] = x;
            let cell = setup.index(there);
            setup.is_solid(cell).then(|| setup.solids[cell])
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::direction;
    use crate::rheology::Law;

    /// A box with walls below and at the left, whose lowest layer of cells is solid 1 and whose farthest column 2.
    fn corner() -> Setup {
        let mut setup = Setup::periodic([4, 3, 4], Law::Newtonian { mu: 0.1 });
        setup.faces = [[Face::NoSlip, Face::Periodic], [Face::Periodic; 2], [Face::NoSlip, Face::Open]];
        setup.solids = (0..setup.cells())
            .map(|cell| match setup.coordinates(cell) {
                [3, _, _] => 2,
                [_, _, 0] => 1,
                _ => 0,
            })
            .collect();
        setup
    }

    fn of(at: [usize; 3], c: [i32; 3], body: u8) -> [[u8; 2]; 3] {
        direction(c).map_or([[9; 2]; 3], |i| owners(&corner(), at, i, body))
    }

    #[test]
    fn exact_owners_at_inner_edges_flat_walls_and_outer_edges() {
        // Between the wall of the box at the left and the solid below; the link itself leaves the box.
        let [x, _, z] = of([0, 1, 1], [1, 0, 1], 0);
        assert_eq!([x, z], [[0, 0], [1, 1]]);
        // Between two solids.
        let [x, _, z] = of([2, 1, 1], [-1, 0, 1], 2);
        assert_eq!([x, z], [[2, 2], [1, 1]]);
        // On a flat floor friction is the floor's as well, and over a joint half of it.
        assert_eq!(of([1, 1, 1], [1, 0, 1], 1), [[1, 1]; 3]);
        assert_eq!(of([1, 1, 1], [0, -1, 1], 1), [[1, 1]; 3]);
        assert_eq!(of([1, 1, 1], [-1, 0, 1], 4), [[1, 4]; 3]);
        // Past an outer edge nothing lies along either axis: the solid that the link leads to.
        let mut setup = corner();
        setup.solids = vec![0; setup.cells()];
        let post = setup.index([1, 1, 1]);
        setup.solids[post] = 3;
        let i = direction([-1, 0, -1]).unwrap_or(0);
        assert_eq!(owners(&setup, [0, 1, 0], i, 3), [[3, 3]; 3]);
    }
}
