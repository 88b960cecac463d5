//! Two spheres approaching: what the lattice resolves and what lubrication adds.

use std::f64::consts::PI;

use crate::claim::{Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::claims::immersed::{UNITS, exact, grains, immersed, periodic, sphere};
use crate::claims::settling::TRT;
use crate::exact::suspension::two_spheres;
use lahar::coupling::{CouplingEquations, GrainWall, Lubrication, StandardCoupling, Suspension};
use lahar::dem::V3;
use lahar::rheology::Law;
use lahar::solver::run::Backend;
use std::sync::Arc;

/// Radius, cells.
const RADIUS: f64 = 4.0;
const MU: f64 = 0.5;
/// Speed of each, cells per step: a thousandth of the smallest gap in a run.
const SPEED: f64 = 1e-7;
/// So heavy that nothing slows them: free, for lubrication acts on free spheres.
const HEAVY: f64 = 1e8;

/// Places of the pair within a cell, and their weights.
///
/// The force is periodic in the place, even along each axis, and the same after x and y are swapped: the midpoints of
/// a grid of 4 × 4 × 8, of which these 12 are the different ones.
fn places() -> impl Iterator<Item = ([f64; 3], f64)> {
    let across = [([0.125, 0.125], 1.0), ([0.125, 0.375], 2.0), ([0.375, 0.375], 1.0)];
    let along = [0.0625, 0.1875, 0.3125, 0.4375];
    across.into_iter().flat_map(move |([x, y], weight)| along.map(|z| ([x, y, z], weight / 16.0)))
}

/// The place at which jumps are looked for: no symmetry.
const PLACE: [f64; 3] = [0.819, 0.671, 0.55];

/// Force between two spheres approaching along z at a gap (cells) over 6πμRU: of the lattice, and of lubrication; mean
/// over both. `place`: of the pair within a cell.
fn boxed(
    backend: &dyn Backend,
    (radius, extents): (f64, [usize; 3]),
    place: [f64; 3],
    gap: f64,
    rules: Option<Lubrication>,
    equations: impl CouplingEquations + Copy + 'static,
) -> Result<(f64, f64), VerifyError> {
    let reach = radius + 0.5 * gap;
    let [x, y, z] = extents.map(|n| (n / 2) as f64);
    let at = |side: f64| [x + place[0], y + place[1], z + place[2] + side * reach];
    let ball = |side: f64| sphere(radius, at(side)).moving(V3::new(0.0, 0.0, -side * SPEED));
    let suspension = Suspension {
        wall: GrainWall::CentralLinear,
        lubrication: rules,
        equations: Arc::new(equations),
        ..Suspension::new(grains(HEAVY, vec![ball(1.0), ball(-1.0)]), UNITS)
    };
    let mut setup = periodic(extents, suspension);
    setup.fluids = vec![Law::Newtonian { mu: MU }];
    setup.collision = TRT;
    let mut run = backend.start(&setup)?;
    // 4.4 R²/ν; the far field of the pair falls like a stresslet's.
    run.advance((8.75 * radius * radius) as u64)?;
    let scale = 6.0 * PI * MU * radius * SPEED;
    let (mut lattice, mut contact) = (0.0, 0.0);
    for _ in 0..20 {
        run.advance(1)?;
        let grains = immersed(run.as_ref())?;
        for (grain, side) in [(0, 1.0), (1, -1.0)] {
            lattice += side * grains.loads()[grain].total()[2] / (40.0 * scale);
            contact += side * grains.contact_loads()[grain][2] / (40.0 * scale);
        }
    }
    Ok((lattice, contact))
}

/// What is found at all places.
struct Found {
    /// Means.
    lattice: f64,
    lubrication: f64,
    /// Standard deviation of the sum from place to place.
    spread: f64,
}

/// Forces of one pair alone: the effect of its periodic images falls like that of a stresslet, with the volume of the
/// box, and is extrapolated away.
fn forces(
    backend: &dyn Backend,
    radius: f64,
    gap: f64,
    rules: Option<Lubrication>,
    equations: impl CouplingEquations + Copy + 'static,
) -> Result<Found, VerifyError> {
    let boxes =
        [[5.0, 5.0, 7.0], [6.5, 6.5, 9.0]].map(|edges: [f64; 3]| edges.map(|x| (x * radius) as usize));
    let [small, large] = boxes.map(|n: [usize; 3]| n.iter().product::<usize>() as f64);
    let mut sums = [0.0; 3];
    for (place, weight) in places() {
        let (near, _) = boxed(backend, (radius, boxes[0]), place, gap, rules, equations)?;
        let (far, contact) = boxed(backend, (radius, boxes[1]), place, gap, rules, equations)?;
        let lattice = (far * large - near * small) / (large - small);
        for (sum, x) in sums.iter_mut().zip([lattice, contact, (lattice + contact) * (lattice + contact)]) {
            *sum += weight * x;
        }
    }
    let [lattice, lubrication, square] = sums;
    let variance = square - (lattice + lubrication) * (lattice + lubrication);
    Ok(Found { lattice, lubrication, spread: variance.max(0.0).sqrt() })
}

/// Both together against the series. `equations`: of the coupling.
pub fn approach(
    backend: &dyn Backend,
    gap: f64,
    equations: impl CouplingEquations + Copy + 'static,
) -> Result<Sample, VerifyError> {
    let found = forces(backend, RADIUS, gap, Some(Lubrication::default()), equations)?;
    let sum = found.lattice + found.lubrication;
    Ok(Sample::relative(gap, sum, exact(two_spheres::approaching(gap / RADIUS))?)
        .with("of the lattice", found.lattice)
        .with("of lubrication", found.lubrication)
        .with("deviation from place to place", found.spread / sum))
}

/// H16.
pub const APPROACH: Claim = Claim {
    id: "lubrication-approach",
    title: "Two spheres approaching feel the force of the exact series at any gap",
    tags: &["C5", "000 Eq 15"],
    measures: "force over 6 pi mu R U, R = 4 cells, interpolated surface, lubrication below 0.74 cells, mean over 128 places within \
               a cell (12 different ones); two periodic boxes, extrapolated in 1/volume",
    reference: Reference { source: "Brenner 1961, exact series", uncertainty: 1e-12 },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "gap (cells)",
        short: &[0.4],
        full: &[0.01, 0.05, 0.1, 0.2, 0.4, 0.6, 0.66, 0.7, 0.73, 0.75, 0.8, 1.0, 1.5, 2.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 0.05,
        at: Rung::Every,
        because: "HARD_CASES H16; 0.25/R^2 = 0.02 of the surfaces, and the cut-off, fitted to hundredths of a cell at R = 4: 0.05 cells are \
                  R/2 0.05/0.74^2 = 0.2 of 5 to 7 near it",
    },
    kind: Kind::Verification,
    measure: |backend, gap| approach(backend, gap, StandardCoupling),
};

/// Rise of the force from one gap to the next smaller one, and no jump at the cut-off.
fn steady(backend: &dyn Backend, cutoff: f64) -> Result<Sample, VerifyError> {
    let rules = Some(Lubrication { cutoff, ..Lubrication::default() });
    let total = |gap: f64| {
        boxed(backend, (RADIUS, [20, 20, 28]), PLACE, gap, rules, StandardCoupling).map(|(a, b)| a + b)
    };
    let (above, below) = (total(cutoff * 1.001)?, total(cutoff * 0.999)?);
    Ok(Sample::absolute(cutoff, below / above - 1.0, 0.0))
}

/// No jump.
pub const NO_JUMP: Claim = Claim {
    id: "lubrication-without-jump",
    title: "The force does not jump where lubrication begins",
    tags: &["C5"],
    measures: "relative change of the total force from 1.001 to 0.999 of the cut-off",
    reference: Reference { source: "a continuous force", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "cut-off (cells)", short: &[0.74], full: &[0.5, 0.74, 1.0] },
    order: None,
    tolerance: Tolerance {
        value: 5e-3,
        at: Rung::Every,
        because: "the exact force changes by 0.2 % over this distance, and a link or two of a thousand may change hands",
    },
    kind: Kind::Verification,
    measure: steady,
};

/// Gap, the force of the lattice and of lubrication, the exact one, and the deviation of the sum from place to place:
/// for the exhibit.
pub fn table(backend: &dyn Backend, radius: f64, gaps: &[f64]) -> Result<Vec<[f64; 5]>, VerifyError> {
    gaps.iter()
        .map(|&gap| {
            let found = forces(backend, radius, gap, Some(Lubrication::default()), StandardCoupling)?;
            let reference = exact(two_spheres::approaching(gap / radius))?;
            Ok([gap, found.lattice, found.lubrication, reference, found.spread])
        })
        .collect()
}
