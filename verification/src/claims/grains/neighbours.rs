//! Completeness of the pair list.

use super::support::setup;
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use lahar::dem::packing::{Random, Region, Sizes, scatter};
use lahar::dem::{Dem, Grain, PairProperties, Period, V3};
use lahar::solver::run::Backend;
use std::collections::BTreeSet;

/// Spheres, and their share of the periodic box.
const COUNT: usize = 500;
const SHARE: f64 = 0.25;

/// No pair is missed.
pub const COMPLETE: Claim = Claim {
    id: "neighbours-complete",
    title: "The pair list misses nobody, whatever the sizes",
    tags: &["D6"],
    measures: "Pairs within reach of the skin that are not on a fresh list, or are on it twice, and pairs that touch but are not on the \
               list after 400 steps; 500 spheres of random sizes, a quarter of a periodic box",
    reference: Reference { source: "Distances of all pairs, nearest periodic images", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "R/r (largest over smallest)",
        short: &[1.0, 5.0, 20.0],
        full: &[1.0, 2.0, 5.0, 10.0, 20.0, 50.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 0.0,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "A list is complete or it is not",
    },
    kind: Kind::Verification,
    measure: complete,
};

fn complete(_: &dyn Backend, ratio: f64) -> Result<Sample, VerifyError> {
    let largest = 5e-3;
    let least = largest / ratio;
    // Mean cube of a radius spread uniformly.
    let cube = 0.25 * (largest + least) * (largest * largest + least * least);
    let edge = libm::cbrt(COUNT as f64 * 4.0 / 3.0 * std::f64::consts::PI * cube / SHARE);
    let sizes = if ratio > 1.0 { Sizes::Uniform { least, largest } } else { Sizes::One(largest) };
    let mut s = setup(7e6, PairProperties::default());
    let mut random = Random::new(3);
    let region = Region::Box { low: V3::zeros(), high: V3::repeat(edge) };
    s.grains = scatter(COUNT, &sizes, 1e-7, &region, 5)?
        .into_iter()
        .map(|p| Grain::sphere(p.radius, p.centre, 0).moving(V3::from_fn(|_, _| 0.3 * random.normal())))
        .collect();
    s.period = Period([Some(edge); 3]);
    s.design_speed_m_s = 2.0;
    let skin = s.skin;
    let mut d = Dem::new(&s)?;
    let start = missed(&d, edge, 1.0 + skin);
    d.step(400)?;
    let end = missed(&d, edge, 1.0);
    Ok(Sample::absolute(ratio, (start.0 + end.0) as f64, 0.0)
        .with("pairs within the skin at the start", start.1 as f64)
        .with("pairs that touch at the end", end.1 as f64)
        .with("lists made", d.list_renewals() as f64))
}

/// Pairs closer than `share` times the sum of radii that are not on the list, plus doubles, and how many are closer.
fn missed(d: &Dem, edge: f64, share: f64) -> (usize, usize) {
    let mut listed = BTreeSet::new();
    let mut doubles = 0;
    for (a, b, _) in d.neighbours() {
        doubles += usize::from(!listed.insert((a.min(b), a.max(b))));
    }
    let b = d.bodies();
    let fold = |x: f64| x - edge * (x / edge).round();
    let (mut missing, mut within) = (0, 0);
    for i in 0..b.len() {
        for j in i + 1..b.len() {
            let apart = (b.position[i] - b.position[j]).map(fold).norm();
            // A part in 1e12 for rounding at the rim.
            if apart < share * (b.radius[i] + b.radius[j]) * (1.0 - 1e-12) {
                within += 1;
                missing += usize::from(!listed.contains(&(i, j)));
            }
        }
    }
    (missing + doubles, within)
}
