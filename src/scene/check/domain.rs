//! Checks of the box.

use crate::geometry::Axis;
use crate::scene::checker::Checker;
use crate::scene::{Boundaries, Boundary, Domain, FACE_KEYS, SceneError, SceneProblem};

/// Largest number of cells: cell indices are 32-bit, the last one is kept free.
const MAX_CELLS: u64 = u32::MAX as u64;

/// How far from a whole number of cells an edge may be, in cells: decimal edge lengths and
/// spacings are not exact in binary, and their quotient is off by up to 2 units in the last place
/// of a number that may be 10⁹.
const WHOLE: f64 = 1e-6;

pub(super) fn check(at: &Checker, domain: &Domain) -> Result<(), SceneError> {
    let spacing = domain.spacing_m;
    at.positive("domain.spacing_m", spacing, "m", "it is the size of a cell", "e.g. a channel height / 64")?;
    let mut total = 1.0;
    for axis in Axis::ALL {
        let a = axis.index();
        let size = domain.size_m[a];
        let path = format!("domain.size_m[{a}]");
        at.positive(
            &path,
            size,
            "m",
            "it is an edge of the box",
            "one `spacing_m` along an axis without change",
        )?;
        let cells = size / spacing;
        let whole = cells.round();
        at.ensure(whole >= 1.0, &path, || SceneProblem::NoCell { size, spacing })?;
        total *= whole;
        at.ensure(total <= MAX_CELLS as f64, "domain", || SceneProblem::TooManyCells {
            cells: domain.size_m.iter().map(|size| (size / spacing).ceil()).product(),
            max: MAX_CELLS,
        })?;
        at.ensure((cells - whole).abs() <= WHOLE, &path, || SceneProblem::NotMultiple {
            size,
            spacing,
            cells,
            nearest: round_to(whole * spacing, 1e12),
        })?;
    }
    boundaries(at, &domain.boundaries)
}

/// Both faces of an axis are periodic or none is; walls slide in their plane.
pub(in crate::scene) fn boundaries(at: &Checker, boundaries: &Boundaries) -> Result<(), SceneError> {
    for (axis, faces) in Axis::ALL.into_iter().zip(boundaries.by_axis()) {
        let keys = FACE_KEYS[axis.index()];
        let periodic = faces.map(|face| face == Boundary::Periodic);
        if periodic[0] != periodic[1] {
            let (open, other) = if periodic[0] { (keys[0], keys[1]) } else { (keys[1], keys[0]) };
            let problem = SceneProblem::HalfPeriodic { axis: axis.letter(), periodic: open, other };
            at.fail(format!("domain.boundaries.{open}"), problem)?;
        }
        for (face, key) in faces.iter().zip(keys) {
            if let Boundary::MovingWall { velocity_m_per_s } = face {
                let found = velocity_m_per_s[axis.index()];
                let path = format!("domain.boundaries.{key}.moving_wall.velocity_m_per_s");
                at.ensure(found == 0.0, &path, || SceneProblem::WallNormalVelocity {
                    found,
                    axis: axis.letter(),
                })?;
            }
        }
    }
    Ok(())
}

/// Rounds for printing.
fn round_to(value: f64, digits: f64) -> f64 {
    let scaled = value * digits;
    if scaled.abs() < 1e15 { scaled.round() / digits } else { value }
}
