//! Checks of the places and sizes of grains.

use super::{GrainSet, Placement, SizeChoice};
use crate::geometry::Shape;
use crate::scene::checker::Checker;
use crate::scene::{KeyRule, SceneError, SceneProblem};

/// Checks where a set is, and how large its grains are.
pub(super) fn placement(
    at: &Checker,
    path: &str,
    set: &GrainSet,
    size_m: [f64; 3],
) -> Result<(), SceneError> {
    let radius = |path: &str, r: f64| at.positive(path, r, "m", "it is a radius", "a radius > 0");
    match &set.place {
        Placement::List(list) => {
            at.some(&format!("{path}.list"), list.len(), "a grain")?;
            for (k, grain) in list.iter().enumerate() {
                let path = |key: &str| format!("{path}.list[{k}].{key}");
                radius(&path("radius_m"), grain.radius_m)?;
                let turned = grain.orientation.is_none_or(|q| q != [0.0; 4]);
                at.ensure(turned, &path("orientation"), || SceneProblem::ZeroQuaternion)?;
                if let Some(q) = grain.orientation {
                    at.has_length(&path("orientation"), &q)?;
                }
            }
            Ok(())
        }
        Placement::Lattice { region, radius_m, spacing_m, .. } => {
            let path = format!("{path}.lattice");
            self::region(at, &format!("{path}.region"), region, size_m)?;
            radius(&format!("{path}.radius_m"), *radius_m)?;
            let (found, low) = (spacing_m.unwrap_or(f64::INFINITY), 2.0 * radius_m);
            at.ensure(found >= low, &format!("{path}.spacing_m"), || SceneProblem::OutOfRange {
                found,
                unit: "m",
                low,
                high: f64::INFINITY,
                because: "the diameter; nearer neighbours overlap",
                way_out: "leave it out for grains that touch",
            })
        }
        Placement::Random { region, count, solid_fraction, sizes, gap_m, .. } => {
            let path = format!("{path}.random");
            self::region(at, &format!("{path}.region"), region, size_m)?;
            amount(at, &path, *count, *solid_fraction)?;
            self::sizes(at, &format!("{path}.sizes"), sizes)?;
            at.not_negative(&format!("{path}.gap_m"), *gap_m, "m", "it is a distance", "0 for none")
        }
        Placement::Csv { .. } => Ok(()),
    }
}

const OF: &[&str] = &["count", "solid_fraction"];

/// How many grains a random packing has.
fn amount(at: &Checker, path: &str, count: Option<u64>, share: Option<f64>) -> Result<(), SceneError> {
    match (count, share) {
        (Some(count), None) => at.ensure(count > 0, &format!("{path}.count"), || {
            let (found, unit, because) = (0.0, "", "else the set is empty");
            SceneProblem::NotPositive { found, unit, because, way_out: "remove the set" }
        }),
        (None, Some(found)) => {
            let (low, high) = (0.0, 0.5);
            let path = format!("{path}.solid_fraction");
            at.ensure(found > low && found <= high, &path, || SceneProblem::OutOfRange {
                found,
                unit: "",
                low,
                high,
                because: "0 excluded; random addition of equal spheres jams near 0.38, of mixtures above",
                way_out: "let a thinner packing settle, or use a lattice",
            })
        }
        (count, share) => {
            let found = if count.is_some() && share.is_some() { OF.to_vec() } else { Vec::new() };
            let (rule, because) = (KeyRule::ExactlyOne, "both say how many grains there are");
            at.fail(path, SceneProblem::KeyCount { found, of: OF, rule, because })
        }
    }
}

fn region(at: &Checker, path: &str, region: &Shape, size_m: [f64; 3]) -> Result<(), SceneError> {
    at.shape(path, region, size_m, false)?;
    let fits = matches!(
        region,
        Shape::Box { .. } | Shape::Sphere { .. } | Shape::Cylinder { length_m: Some(_), .. }
    );
    at.ensure(fits, path, || SceneProblem::ShapeNotForGrains {
        what: "filled with grains",
        allowed: "`box`, `sphere`, `cylinder` with `length_m`",
        way_out: "several sets in such shapes",
    })
}

fn sizes(at: &Checker, path: &str, sizes: &SizeChoice) -> Result<(), SceneError> {
    let least = |path: &str, r: f64| at.positive(path, r, "m", "it is a radius", "a radius > 0");
    let ordered = |path: &str, low: f64, high: f64| {
        at.ensure(low <= high, path, || SceneProblem::LimitsSwapped { low, high, unit: "m" })
    };
    match sizes {
        SizeChoice::Equal { radius_m } => least(&format!("{path}.equal.radius_m"), *radius_m),
        SizeChoice::Uniform { least_radius_m, largest_radius_m } => {
            let path = format!("{path}.uniform");
            least(&format!("{path}.least_radius_m"), *least_radius_m)?;
            ordered(&path, *least_radius_m, *largest_radius_m)
        }
        SizeChoice::LogNormal { median_radius_m, deviation, least_radius_m, largest_radius_m } => {
            let path = format!("{path}.log_normal");
            least(&format!("{path}.least_radius_m"), *least_radius_m)?;
            ordered(&path, *least_radius_m, *median_radius_m)?;
            ordered(&path, *median_radius_m, *largest_radius_m)?;
            let because = "it is a standard deviation";
            at.not_negative(&format!("{path}.deviation"), *deviation, "", because, "0.3")
        }
        SizeChoice::Sieve { passing } => {
            let rises = passing.windows(2).all(|w| w[0][0] < w[1][0] && w[0][1] <= w[1][1]);
            let ends =
                (passing.first().map(|p| p[1]), passing.last().map(|p| p[1])) == (Some(0.0), Some(1.0));
            let good = rises && ends && passing.iter().all(|p| p[0] > 0.0);
            at.ensure(good, &format!("{path}.sieve.passing"), || SceneProblem::BadSieveCurve)
        }
    }
}
