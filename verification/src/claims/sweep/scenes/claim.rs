//! The claim about what plans expect.

use super::outcome::{FAR, Outcome, Verdict};
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use lahar::plan::expected::Scenes;
use lahar::solver::run::Backend;

/// Scenes of a rung.
const EACH: u64 = 50;
const RUNGS: &[f64] = &[0.0, 50.0];
const MANY: &[f64] = &[0.0, 50.0, 100.0, 150.0, 200.0, 250.0, 300.0, 350.0];

/// Random scenes.
pub const SCENES: Claim = Claim {
    id: "scene-sweep",
    title: "Random scenes are as far off as their plans say",
    tags: &["B3", "F4", "Y3", "K2", "K3", "D1", "D2"],
    measures: "scenes among fifty whose error lies outside of the interval that the plan gives, counted from the second on; a scene \
               beyond three times the interval, or outside of it without a warning, counts as ten. Films with a free surface, \
               channels, moving and oscillating walls, layers, pools at rest, collisions, sliding and rolling grains; the rows that \
               the plan asks come from other scenes",
    reference: Reference { source: "exact solutions of each scene (docs/references.md)", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "first scene", short: RUNGS, full: MANY },
    order: None,
    tolerance: Tolerance {
        value: 0.5,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "one of fifty is what an interval for 99 of 100 lets through now and then",
    },
    kind: Kind::Verification,
    measure: |backend, first| count(backend, first),
};

fn count(backend: &dyn Backend, first: f64) -> Result<Sample, VerifyError> {
    let from = first as u64;
    let numbers: Vec<u64> = (from..from + EACH).collect();
    let scenes = Scenes::built_in();
    let (mut beyond, mut grave, mut refused, mut outside, mut unknown, mut worst) =
        (0_u32, 0_u32, 0_u32, 0_u32, 0_u32, 0.0_f64);
    for outcome in Outcome::of_all(backend, &numbers)? {
        match outcome.verdict(scenes) {
            Verdict::Refused => refused += 1,
            Verdict::Outside => outside += 1,
            Verdict::Unknown => unknown += 1,
            Verdict::Within(times) => worst = worst.max(times),
            Verdict::Beyond { times, warned } => {
                beyond += 1;
                grave += u32::from(times > FAR || !warned);
                worst = worst.max(times);
            }
        }
    }
    let count = f64::from(beyond.saturating_sub(1) + 10 * grave);
    Ok(Sample::absolute(first, count, 0.0)
        .with("outside of the interval", f64::from(beyond))
        .with("of these without a warning or far outside", f64::from(grave))
        .with("largest error over its interval", worst)
        .with("refused", f64::from(refused))
        .with("like no measured scene", f64::from(outside))
        .with("like scenes that were stopped", f64::from(unknown)))
}
