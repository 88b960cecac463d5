//! Solids that move must stay where they are: they turn about their own axis or slide along themselves.

use crate::setup::{Face, Setup, SolidMotion};
use crate::vector::{norm, surface_velocity};

/// Path along which a point of the surface is followed, cells: less is within the stairs of a round solid, more finds
/// nothing new, since a solid that leaves its place leaves it at once.
const PATH: f64 = 3.0;
/// Parts of the path; each is straight, which at a radius of one cell is off by less than a tenth of a cell.
const PARTS: usize = 12;

/// Where a moving solid would leave its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Leaving {
    /// Position of the solid in the set-up.
    pub solid: usize,
    /// A place, in cells, that its motion would carry out of it.
    pub at: [f64; 3],
}

/// The first solid whose motion carries a cell of its surface to where, within a cell, nothing is solid.
///
/// Cells of a solid never move \[B1\]: a motion that changes its place would push fluid through its surface.
#[must_use]
pub(super) fn first_leaving(setup: &Setup) -> Option<Leaving> {
    setup.solid_motion.iter().enumerate().find_map(|(solid, motion)| {
        let number = u8::try_from(solid + 1).ok().filter(|_| motion.moves())?;
        let of_solid = (0..setup.cells()).filter(|&cell| setup.solids.get(cell) == Some(&number));
        let centres =
            of_solid.map(|cell| setup.coordinates(cell)).filter(|&at| touches_another(setup, at, number));
        let mut centres = centres.map(|at| at.map(|x| x as f64 + 0.5));
        centres.find(|&at| leaves(setup, motion, at)).map(|at| Leaving { solid, at })
    })
}

/// Whether the path of a point, ahead or back, ends or passes more than a cell from any solid: into another one it may go.
fn leaves(setup: &Setup, motion: &SolidMotion, start: [f64; 3]) -> bool {
    let velocity = |at: [f64; 3]| {
        let arm = std::array::from_fn(|a| at[a] - motion.centre[a]);
        surface_velocity(motion.velocity, motion.spin, arm)
    };
    let speed = norm(velocity(start));
    let turning = norm(motion.spin);
    if speed == 0.0 {
        return false;
    }
    // At most one radian, for points near the axis.
    let time = (PATH / speed).min(if turning > 0.0 { 1.0 / turning } else { f64::INFINITY });
    let along = |at: [f64; 3], u: [f64; 3], time: f64| std::array::from_fn(|a| at[a] + time * u[a]);
    [time, -time].into_iter().any(|time| {
        let part = time / PARTS as f64;
        let mut at: [f64; 3] = start;
        (0..PARTS).any(|_| {
            let middle = along(at, velocity(at), 0.5 * part);
            at = along(at, velocity(middle), part);
            !is_near_solid(setup, at)
        })
    })
}

/// Whether the cell of a point or one beside it is solid; points beyond a face count as solid.
fn is_near_solid(setup: &Setup, point: [f64; 3]) -> bool {
    let cell = point.map(|x| x.floor() as i64);
    around(setup, cell).any(|near| near.is_none_or(|near| setup.is_solid(near)))
}

/// Whether a cell beside this one belongs to something else.
fn touches_another(setup: &Setup, at: [usize; 3], number: u8) -> bool {
    around(setup, at.map(|x| x as i64)).flatten().any(|near| setup.solids[near] != number)
}

/// The 27 cells about one, through periodic faces; `None` beyond others.
fn around(setup: &Setup, [i, j, k]: [i64; 3]) -> impl Iterator<Item = Option<usize>> + '_ {
    (0..27_i64).map(move |n| {
        let mut at = [i + n % 3 - 1, j + n / 3 % 3 - 1, k + n / 9 - 1];
        for axis in 0..3 {
            let extent = setup.extents[axis] as i64;
            if setup.faces[axis][0] == Face::Periodic {
                at[axis] = at[axis].rem_euclid(extent);
            } else if !(0..extent).contains(&at[axis]) {
                return None;
            }
        }
        Some(setup.index(at.map(|x| x as usize)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rheology::Law;

    /// A box of 24 × 24 × 4 cells whose cells are solid where `inside` says so of their centre.
    fn with(inside: impl Fn([f64; 3]) -> bool, motion: SolidMotion) -> Setup {
        let mut setup = Setup::periodic([24, 24, 4], Law::Newtonian { mu: 0.1 });
        let solid = |cell| inside(setup.coordinates(cell).map(|x| x as f64 + 0.5));
        setup.solids = (0..setup.cells()).map(|cell| u8::from(solid(cell))).collect();
        setup.solid_motion = vec![motion];
        setup
    }

    fn radius([x, y, _]: [f64; 3]) -> f64 {
        libm::hypot(x - 12.0, y - 12.0)
    }

    const TURNING: SolidMotion =
        SolidMotion { velocity: [0.0; 3], spin: [0.0, 0.0, 1e-3], centre: [12.0, 12.0, 0.0] };

    #[test]
    fn round_solids_turn_in_their_place() {
        for r in [1.3, 2.0, 4.5, 9.2] {
            assert_eq!(first_leaving(&with(|at| radius(at) < r, TURNING)), None, "{r}");
            assert_eq!(first_leaving(&with(|at| radius(at) > r, TURNING)), None, "{r}");
        }
        let slope = |[x, y, _]: [f64; 3]| y < 8.0 + 0.0 * x;
        let sliding = SolidMotion { velocity: [1e-3, 0.0, 0.0], ..SolidMotion::default() };
        assert_eq!(first_leaving(&with(slope, sliding)), None);
    }

    #[test]
    fn what_would_leave_is_found() {
        let bar = |[x, y, _]: [f64; 3]| (x - 12.0).abs() < 8.0 && (y - 12.0).abs() < 2.0;
        assert!(first_leaving(&with(bar, TURNING)).is_some());
        let lifted = SolidMotion { velocity: [0.0, 1e-3, 0.0], ..SolidMotion::default() };
        let found = first_leaving(&with(bar, lifted)).expect("a bar across its motion");
        assert_eq!(found.solid, 0);
        let off_axis = SolidMotion { centre: [6.0, 12.0, 0.0], ..TURNING };
        assert!(first_leaving(&with(|at| radius(at) < 6.0, off_axis)).is_some());
    }

    #[test]
    fn limit_solids_at_rest_and_points_beyond_faces() {
        let bar = |[x, y, _]: [f64; 3]| (x - 12.0).abs() < 8.0 && (y - 12.0).abs() < 2.0;
        assert_eq!(first_leaving(&with(bar, SolidMotion::default())), None);
        // A belt from wall to wall.
        let sliding = SolidMotion { velocity: [1e-3, 0.0, 0.0], ..SolidMotion::default() };
        let mut belt = with(|[_, y, _]| y < 3.0, sliding);
        belt.faces[0] = [Face::NoSlip; 2];
        assert_eq!(first_leaving(&belt), None);
    }
}
