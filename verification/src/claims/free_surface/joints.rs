//! Loads of a fluid at rest on solids that meet each other and the walls of the box.

use super::loads::with_solids;
use super::support::{level, speed, tank};
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use lahar::lattice::{C, Q};
use lahar::rheology::Law;
use lahar::setup::Setup;
use lahar::solver::run::Backend;

const GRAVITY: f64 = 1e-5;
/// Height of the surface, cells.
const HEIGHT: f64 = 10.0;

/// Solids in a box with walls all around.
struct Arrangement {
    name: &'static str,
    /// Number of the solid in a cell, 0 for none.
    solid: fn([usize; 3]) -> u8,
    /// Whether fluid is let in.
    wet: fn([usize; 3]) -> bool,
}

fn everywhere(_: [usize; 3]) -> bool {
    true
}

const ARRANGEMENTS: [Arrangement; 8] = [
    Arrangement { name: "raised floor", solid: |[_, _, k]| u8::from(k < 2), wet: everywhere },
    Arrangement {
        name: "two slabs",
        solid: |[i, _, k]| if k > 1 { 0 } else { 1 + u8::from(i > 6) },
        wet: everywhere,
    },
    Arrangement { name: "dry behind a plate", solid: |[i, ..]| u8::from(i == 7), wet: |[i, ..]| i < 7 },
    Arrangement {
        name: "roof under a wall",
        solid: |[i, _, k]| match (i, k) {
            (7.., 4..=5) => 1,
            (7.., 6..) => 2,
            _ => 0,
        },
        wet: everywhere,
    },
    Arrangement {
        name: "block on a step in a corner",
        solid: |[i, j, k]| match (i, j, k) {
            (.., 0..=1) => 1,
            (0..=3, 0..=2, 2..=5) => 2,
            _ => 0,
        },
        wet: everywhere,
    },
    Arrangement {
        name: "barrier that does not reach the floor",
        solid: |[i, _, k]| u8::from((5..8).contains(&i) && k > 3),
        wet: everywhere,
    },
    Arrangement {
        name: "stairs of three",
        solid: |[i, _, k]| match (i, k) {
            (0..=2, 0..=5) => 3,
            (0..=5, 0..=3) => 2,
            (0..=8, 0..=1) => 1,
            _ => 0,
        },
        wet: everywhere,
    },
    Arrangement {
        name: "beams on a post",
        solid: |[i, j, k]| match (i, j, k) {
            (5..=6, 2..=3, 0..=3) => 1,
            (3..=8, 1..=4, 4..=5) => 2,
            (5..=6, 2..=3, 6..=7) => 3,
            _ => 0,
        },
        wet: everywhere,
    },
];

fn setup(arrangement: &Arrangement) -> Setup {
    let fluid = |at: [usize; 3]| if (arrangement.wet)(at) { level(HEIGHT, at[2]) } else { 0.0 };
    with_solids(tank([12, 6, 13], Law::Newtonian { mu: 0.3 }, GRAVITY, fluid), arrangement.solid)
}

/// Σ p A n over the faces of a solid that fluid touches, p = ρ g (H − z) in the middle of a face.
fn hydrostatic(setup: &Setup, arrangement: &Arrangement, solid: u8) -> [f64; 3] {
    let mut force = [0.0; 3];
    for cell in (0..setup.cells()).filter(|&cell| setup.solids[cell] == solid) {
        let at = setup.coordinates(cell);
        for c in (1..Q).map(|i| C[i]).filter(|c| c.iter().map(|c| c * c).sum::<i32>() == 1) {
            let there = std::array::from_fn(|a| at[a].wrapping_add_signed(c[a] as isize));
            let inside = (0..3).all(|a| there[a] < setup.extents[a]);
            if !inside || setup.is_solid(setup.index(there)) || !(arrangement.wet)(there) {
                continue;
            }
            let depth = HEIGHT - (at[2] as f64 + 0.5 + 0.5 * f64::from(c[2]));
            for a in 0..3 {
                force[a] -= f64::from(c[a]) * GRAVITY * depth.max(0.0);
            }
        }
    }
    force
}

fn measure(backend: &dyn Backend, number: f64) -> Result<Sample, VerifyError> {
    let arrangement = &ARRANGEMENTS[(number as usize - 1).min(ARRANGEMENTS.len() - 1)];
    let setup = setup(arrangement);
    let mut run = backend.start(&setup)?;
    run.advance(4000)?;
    let (mut largest, mut off) = (0.0_f64, 0.0_f64);
    let mut loads = Vec::new();
    for (k, load) in run.loads().iter().enumerate() {
        let exact = hydrostatic(&setup, arrangement, k as u8 + 1);
        for a in 0..3 {
            largest = largest.max(exact[a].abs());
            let error = (load.force[a] - exact[a]).abs();
            off = if error <= off { off } else { error };
        }
        loads.push((k + 1, load.force[2], exact[2]));
    }
    let mut sample = Sample::relative(number, largest + off, largest);
    for (k, found, exact) in loads {
        sample = sample
            .with(&format!("{}: vertical load on solid {k} [rho g Δx³]", arrangement.name), found / GRAVITY)
            .with(&format!("{}: exact on solid {k} [rho g Δx³]", arrangement.name), exact / GRAVITY);
    }
    Ok(sample.with("largest speed", speed(run.as_ref())))
}

/// Hydrostatic loads at joints.
pub const JOINTS: Claim = Claim {
    id: "loads-at-joints",
    title: "Solids that meet each other and the box bear ∫ p dA at rest",
    tags: &["C7"],
    measures: "loads by momentum exchange on raised floors, slabs, plates, roofs, blocks in corners, stairs and beams; the largest \
               difference of a component over the largest component of the arrangement",
    reference: Reference {
        source: "hydrostatics: sum of rho g (H − z) over the wet faces",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "arrangement",
        short: &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0],
        full: &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 1e-11,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "the force per volume does not depend on density, so linear pressure is the discrete rest as well, and edges and joints \
                  add nothing: left are roundings of 1.1e-16 in 18 links and 4000 steps, 8e-12 if all agree",
    },
    kind: Kind::Verification,
    measure,
};
