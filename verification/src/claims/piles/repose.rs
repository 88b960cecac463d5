//! Angle of repose against friction and against angularity.

use super::refused;
use super::slope::{Heap, settle};
use super::support::{Matter, R, mean};
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::output::plot::{Axis, Plot, Series};
use lahar::solver::run::Backend;

/// Depth of the slice, m.
const DEPTH: f64 = 6.0 * R * (1.0 + 1e-9);
/// Half width of the platform from which on three frictions and both clumps are run, mean radii.
const WIDE: f64 = 16.0;

const LADDER: Ladder =
    Ladder { parameter: "half width of the platform [mean radii]", short: &[12.0], full: &[12.0, WIDE] };

const TOLERANCE: Tolerance = Tolerance {
    value: 0.5,
    at: Rung::Every,
    basis: Basis::AfterSeeing,
    because: "the increase must be at least two of its own standard errors, 95 per cent",
};

/// Friction.
pub const FRICTION: Claim = Claim {
    id: "piles-repose-friction",
    title: "The angle of repose of spheres grows with friction",
    tags: &["D2", "000 Sec 2.1"],
    measures: "standard error over the least increase of the mean angle from one friction to the next: 0.1 and 0.6 on the \
               narrow platform, 0.1, 0.3 and 0.6 on the wide one",
    reference: Reference {
        source: "Zhou, Xu, Yu & Zulli 2001, doi:10.1103/PhysRevE.64.021301: the angle of repose of spheres increases with \
                 sliding friction (an ordering)",
        uncertainty: 0.0,
    },
    metric: Metric::Absolute,
    ladder: LADDER,
    order: None,
    tolerance: TOLERANCE,
    kind: Kind::Validation,
    measure: friction,
};

/// Angularity.
pub const CLUMPS: Claim = Claim {
    id: "piles-repose-clumps",
    title: "Tetrahedral clumps lie steeper than spheres of the same friction",
    tags: &["D2", "D4", "000 Sec 2.1"],
    measures: "standard error over the difference of the mean angles at friction 0.6: clumps with an edge of 2 member radii on the \
               narrow platform; the smaller of the differences for 1.2 and 2 on the wide one",
    reference: Reference {
        source: "Poeschel & Buchholtz 1993, Phys. Rev. Lett. 71, 3963 (arXiv hep-lat/9309006): the shape of grains made of spheres \
                 makes heaps steep; ballast clumps, doi:10.1155/2019/8095267: less spherical is steeper (an ordering)",
        uncertainty: 0.0,
    },
    metric: Metric::Absolute,
    ladder: LADDER,
    order: None,
    tolerance: TOLERANCE,
    kind: Kind::Validation,
    measure: clumps,
};

/// All angles.
pub const ANGLES: Exhibit = Exhibit {
    id: "piles-repose-angles",
    caption: "Angle of repose by friction and shape, with the standard error of the mean over the seeds: what stays on a rough \
              platform when a settled block may fall off its edges. Angle: of the triangle on the platform whose centre of mass \
              is as high as the heap's. Flanks: straight lines by least squares through the highest points in square cells two \
              mean radii wide, without the outermost cell and the two innermost ones, mean over both flanks of all seeds.",
    timed: false,
    run: angles,
};

/// Packings: five on wide platforms; on narrow ones three of spheres and, as they cost most, two of clumps.
fn seeds(matter: &Matter, half: f64) -> u64 {
    match (half < WIDE, matter.edge) {
        (false, _) => 5,
        (true, None) => 3,
        (true, Some(_)) => 2,
    }
}

struct Angle {
    mean: f64,
    error: f64,
    /// By least squares, with its standard error.
    flanks: (f64, f64),
    liveliest: f64,
    time: f64,
    grains: f64,
}

fn angle(matter: &Matter, half: f64) -> Result<Angle, VerifyError> {
    let heaps: Vec<Heap> = (0..seeds(matter, half))
        .map(|seed| settle(matter, half * R, DEPTH, seed))
        .collect::<Result<_, _>>()
        .map_err(refused)?;
    let (angle, error) = mean(&heaps.iter().map(|h| h.triangle).collect::<Vec<_>>());
    let flanks = mean(&heaps.iter().flat_map(|h| h.flanks).collect::<Vec<_>>());
    let liveliest = heaps.iter().map(|h| h.liveliest).fold(0.0, f64::max);
    let time = heaps.iter().map(|h| h.time).fold(0.0, f64::max);
    let grains = heaps.iter().map(|h| h.grains as f64).sum::<f64>() / heaps.len() as f64;
    Ok(Angle { mean: angle, error, flanks, liveliest, time, grains })
}

/// The difference that is smallest in its own standard errors.
fn least(half: f64, pairs: &[(&str, &Angle, &str, &Angle)]) -> Sample {
    let mut worst = 0.0f64;
    for (_, low, _, high) in pairs {
        let error = (low.error * low.error + high.error * high.error).sqrt();
        let rise = high.mean - low.mean;
        worst = worst.max(if rise > 0.0 { error / rise } else { f64::INFINITY });
    }
    let mut s = Sample::absolute(half, worst, 0.0);
    for (a, low, b, high) in pairs {
        for (name, angle) in [(a, low), (b, high)] {
            s = s
                .with(&format!("{name}: angle [deg]"), angle.mean)
                .with(&format!("{name}: standard error [deg]"), angle.error)
                .with(&format!("{name}: flanks by least squares [deg]"), angle.flanks.0)
                .with(&format!("{name}: liveliest grain [m g R]"), angle.liveliest)
                .with(&format!("{name}: grains"), angle.grains);
        }
    }
    s
}

fn friction(_: &dyn Backend, half: f64) -> Result<Sample, VerifyError> {
    let at = |f| angle(&Matter::spheres(f), half);
    let (low, high) = (at(0.1)?, at(0.6)?);
    if half < WIDE {
        return Ok(least(half, &[("0.1", &low, "0.6", &high)]));
    }
    let middle = at(0.3)?;
    Ok(least(half, &[("0.1", &low, "0.3", &middle), ("0.3", &middle, "0.6", &high)]))
}

fn clumps(_: &dyn Backend, half: f64) -> Result<Sample, VerifyError> {
    let spheres = angle(&Matter::spheres(0.6), half)?;
    let open = angle(&Matter::clumps(0.6, 2.0), half)?;
    if half < WIDE {
        return Ok(least(half, &[("spheres", &spheres, "edge 2", &open)]));
    }
    let tight = angle(&Matter::clumps(0.6, 1.2), half)?;
    Ok(least(half, &[("spheres", &spheres, "edge 1.2", &tight), ("spheres", &spheres, "edge 2", &open)]))
}

fn angles(_: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let half = if full { WIDE } else { LADDER.short[0] };
    let frictions: &[f64] = if full { &[0.1, 0.3, 0.6] } else { &[0.1, 0.6] };
    let mut table = Table::new(
        format!("Angles of repose, half width of the platform {half} mean radii"),
        &[
            "shape",
            "friction",
            "packings",
            "angle [deg]",
            "standard error [deg]",
            "flanks [deg]",
            "standard error of the flanks [deg]",
            "grains left",
            "liveliest grain [m g R]",
            "longest time to rest [s]",
        ],
    );
    let mut plot =
        Plot::new("Angle of repose", Axis::linear("friction", ""), Axis::linear("angle", "degrees"));
    let clump = |edge: f64| move |f: f64| Matter::clumps(f, edge);
    let shapes: [(&str, &dyn Fn(f64) -> Matter); 3] = [
        ("spheres", &Matter::spheres),
        ("clumps, edge 1.2 r", &clump(1.2)),
        ("clumps, edge 2 r", &clump(2.0)),
    ];
    for (name, matter) in shapes.iter().filter(|s| full || s.0 != "clumps, edge 1.2 r") {
        let mut points = Vec::new();
        for &f in frictions.iter().filter(|&&f| full || *name == "spheres" || f == 0.6) {
            let a = angle(&matter(f), half)?;
            points.push([f, a.mean]);
            table.push(vec![
                (*name).into(),
                f.into(),
                seeds(&matter(f), half).into(),
                a.mean.into(),
                a.error.into(),
                a.flanks.0.into(),
                a.flanks.1.into(),
                a.grains.into(),
                a.liveliest.into(),
                a.time.into(),
            ]);
        }
        plot = plot.with(Series::line_markers(*name, points));
    }
    Ok(ExhibitData { tables: vec![table], plots: vec![plot], ..ExhibitData::default() })
}
