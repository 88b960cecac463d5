//! Speed of the discrete element method: grains stepped per second.

pub mod beds;

use std::time::Instant;

use serde::Serialize;

use super::cases::Quantity;
use super::error::BenchError;
use super::measure::Ratio;
use super::statistics::Spread;
use super::{Options, Report};
use crate::dem::{Dem, DemError, Integrator, Setup};

/// Name of the group of beds.
const GROUP: &str = "grains";
/// Name of the group of sizes.
const SIZES: &str = "grains-sizes";

/// A packing to be timed.
struct Bed {
    group: &'static str,
    name: &'static str,
    shows: &'static str,
    /// The set-up, a tenth as large if asked for.
    setup: fn(quick: bool) -> Result<Setup, DemError>,
    /// Steps before anything is timed: a packing is to be in motion, not to fall apart.
    warm_up: u64,
    /// Whether it is timed on more than one thread.
    threads: bool,
}

const BEDS: [Bed; 8] = [
    Bed {
        group: GROUP,
        name: "grains/spheres",
        shows: "10⁴ spheres, dense, under gravity",
        setup: |quick| beds::spheres(if quick { 1_000 } else { 10_000 }),
        warm_up: 300,
        threads: true,
    },
    Bed {
        group: GROUP,
        name: "grains/gear",
        shows: "the same, Gear instead of Verlet",
        setup: |quick| {
            let bed = beds::spheres(if quick { 1_000 } else { 10_000 })?;
            Ok(Setup { integrator: Integrator::Gear, ..bed })
        },
        warm_up: 300,
        threads: true,
    },
    Bed {
        group: GROUP,
        name: "grains/spheres-many",
        shows: "10⁵ spheres, dense, under gravity",
        setup: |quick| beds::spheres(if quick { 10_000 } else { 100_000 }),
        warm_up: 100,
        threads: true,
    },
    Bed {
        group: GROUP,
        name: "grains/clumps",
        shows: "10⁴ tetrahedral clumps, dense",
        setup: |quick| beds::clumps(if quick { 10 } else { 22 }),
        warm_up: 10,
        threads: true,
    },
    Bed {
        group: GROUP,
        name: "grains/mixture",
        shows: "10⁵ spheres, large ones among them 20 times as large, dense",
        setup: |quick| if quick { beds::mixed(10.0, 2) } else { beds::mixed(20.0, 2) },
        warm_up: 100,
        threads: true,
    },
    Bed {
        group: SIZES,
        name: "grains-sizes/1e4",
        shows: "periodic crystal, 11 thousand spheres",
        setup: |quick| beds::crystal(if quick { 6 } else { 14 }),
        warm_up: 5,
        threads: false,
    },
    Bed {
        group: SIZES,
        name: "grains-sizes/1e5",
        shows: "periodic crystal, 108 thousand spheres",
        setup: |quick| beds::crystal(if quick { 14 } else { 30 }),
        warm_up: 5,
        threads: false,
    },
    Bed {
        group: SIZES,
        name: "grains-sizes/1e6",
        shows: "periodic crystal, a million spheres",
        setup: |quick| beds::crystal(if quick { 30 } else { 63 }),
        warm_up: 5,
        threads: false,
    },
];

/// Case, base, and what is compared.
const COMPARE: [(&str, &str, &str, Quantity); 6] = [
    ("clumps of four over spheres", "grains/clumps", "grains/spheres", Quantity::TimePerUpdate),
    ("Gear over Verlet", "grains/gear", "grains/spheres", Quantity::TimePerUpdate),
    ("10⁵ spheres over 10⁴", "grains/spheres-many", "grains/spheres", Quantity::TimePerUpdate),
    ("radii 20 to 1 over equal ones", "grains/mixture", "grains/spheres-many", Quantity::TimePerUpdate),
    ("10⁵ over 10⁴", "grains-sizes/1e5", "grains-sizes/1e4", Quantity::TimePerUpdate),
    ("10⁶ over 10⁴", "grains-sizes/1e6", "grains-sizes/1e4", Quantity::TimePerUpdate),
];

/// Speed of one packing.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GrainSpeed {
    /// The case.
    pub name: &'static str,
    /// What it shows.
    pub shows: &'static str,
    /// Threads.
    pub threads: usize,
    /// Grains.
    pub grains: usize,
    /// Spheres they consist of.
    pub spheres: usize,
    /// Touching pairs per grain at the end.
    pub contacts_per_grain: f64,
    /// Listed pairs per grain at the end.
    pub listed_per_grain: f64,
    /// Steps timed in all slices together.
    pub steps: u64,
    /// Lists made in them.
    pub lists: u64,
    /// Million grains stepped per second, by slice.
    pub million_per_second: Spread,
    /// Nanoseconds per grain and step, median.
    pub ns_per_update: f64,
}

/// Names of the groups and cases.
pub(super) fn names() -> Vec<&'static str> {
    let mut names = vec![GROUP];
    names.extend(BEDS.iter().filter(|bed| bed.group == GROUP).map(|bed| bed.name));
    names.push(SIZES);
    names.extend(BEDS.iter().filter(|bed| bed.group == SIZES).map(|bed| bed.name));
    names
}

struct Subject {
    bed: &'static Bed,
    threads: usize,
    pool: rayon::ThreadPool,
    dem: Dem,
    steps: u64,
    lists: u64,
    /// Seconds of each slice.
    slices: Vec<f64>,
}

/// Times the wanted packings, group by group and turn by turn.
pub(super) fn measure(
    options: &Options,
    report: &mut Report,
    say: &mut dyn FnMut(&str),
) -> Result<(), BenchError> {
    static ALL: &[Bed] = &BEDS;
    for group in [GROUP, SIZES] {
        let only = options.only.as_deref();
        let wanted = |bed: &&Bed| bed.group == group && only.is_none_or(|o| o == group || o == bed.name);
        if !ALL.iter().any(|bed| wanted(&bed)) {
            continue;
        }
        say(&format!("{group}: dry grains, {}", if group == GROUP { "by shape" } else { "by number" }));
        let mut subjects = Vec::new();
        for bed in ALL.iter().filter(wanted) {
            let counts = options.thread_counts();
            for threads in counts.into_iter().filter(|&n| bed.threads || n == 1) {
                subjects.push(Subject::start(options, bed, threads)?);
            }
        }
        for _ in 0..options.rounds() {
            for subject in &mut subjects {
                let seconds = subject.slice(subject.steps)?;
                subject.slices.push(seconds);
            }
        }
        report.grains.extend(subjects.iter().map(Subject::speed));
        ratios(group, &subjects, report);
    }
    Ok(())
}

impl Subject {
    fn start(options: &Options, bed: &'static Bed, threads: usize) -> Result<Self, BenchError> {
        let failed = |source| BenchError::Grains { case: bed.name.to_owned(), source: Box::new(source) };
        let setup = (bed.setup)(options.quick).map_err(failed)?;
        let pool =
            rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(BenchError::Threads)?;
        let dem = pool.install(|| Dem::new(&setup)).map_err(failed)?;
        let mut subject = Self { bed, threads, pool, dem, steps: 1, lists: 0, slices: Vec::new() };
        subject.slice(bed.warm_up)?;
        // Several steps: threads that sleep are slow for the first of them.
        let each = subject.slice(8)? / 8.0;
        subject.steps = (options.slice_seconds() / each).ceil().max(1.0) as u64;
        subject.lists = subject.dem.list_renewals();
        Ok(subject)
    }

    fn slice(&mut self, steps: u64) -> Result<f64, BenchError> {
        let clock = Instant::now();
        let dem = &mut self.dem;
        let result = self.pool.install(|| dem.step(steps));
        result.map_err(|source| BenchError::Grains {
            case: self.bed.name.to_owned(),
            source: Box::new(source),
        })?;
        Ok(clock.elapsed().as_secs_f64().max(1e-9))
    }

    /// Grain updates of a slice.
    fn updates(&self) -> f64 {
        self.dem.bodies().len() as f64 * self.steps as f64
    }

    fn speed(&self) -> GrainSpeed {
        let rates: Vec<f64> = self.slices.iter().map(|seconds| 1e-6 * self.updates() / seconds).collect();
        let rate = Spread::of(&rates);
        let (listed, touching) = self.dem.pair_counts();
        let grains = self.dem.bodies().len();
        let each = |count: usize| count as f64 / grains.max(1) as f64;
        GrainSpeed {
            name: self.bed.name,
            shows: self.bed.shows,
            threads: self.threads,
            grains,
            spheres: self.dem.members().len(),
            contacts_per_grain: each(touching),
            listed_per_grain: each(listed),
            steps: self.steps * self.slices.len() as u64,
            lists: self.dem.list_renewals() - self.lists,
            million_per_second: rate,
            ns_per_update: 1e3 / rate.median,
        }
    }
}

/// The named ratios, and more threads over one.
fn ratios(group: &'static str, subjects: &[Subject], report: &mut Report) {
    let mut add = |name: String, a: &Subject, b: &Subject, quantity: Quantity, threads: String| {
        let rate = |s: &Subject, seconds: f64| s.updates() / seconds;
        let quotients: Vec<f64> = (a.slices.iter().zip(&b.slices))
            .map(|(&x, &y)| match quantity {
                Quantity::Rate => rate(a, x) / rate(b, y),
                _ => rate(b, y) / rate(a, x),
            })
            .collect();
        let backend = "grains".to_owned();
        report.ratios.push(Ratio { name, group, quantity, backend, threads, ratio: Spread::of(&quotients) });
    };
    for (name, of, to, quantity) in COMPARE {
        for a in subjects.iter().filter(|a| a.bed.name == of) {
            if let Some(b) = subjects.iter().find(|b| b.bed.name == to && b.threads == a.threads) {
                add(name.to_owned(), a, b, quantity, a.threads.to_string());
            }
        }
    }
    for a in subjects.iter().filter(|a| a.threads > 1) {
        if let Some(b) = subjects.iter().find(|b| b.bed.name == a.bed.name && b.threads == 1) {
            let name = format!("{}: {} threads / 1", a.bed.name, a.threads);
            add(name, a, b, Quantity::Rate, format!("{} / 1", a.threads));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every packing stands, and has the number of grains its name says (a tenth of it when quick).
    #[test]
    fn every_bed_starts() {
        for bed in &BEDS {
            let setup = (bed.setup)(true).unwrap_or_else(|error| panic!("{}: {error}", bed.name));
            assert!(setup.grains.len() >= 800, "{}: {}", bed.name, setup.grains.len());
            let mut dem = Dem::new(&setup).unwrap_or_else(|error| panic!("{}: {error}", bed.name));
            dem.step(20).unwrap_or_else(|error| panic!("{}: {error}", bed.name));
        }
        for (_, of, to, _) in COMPARE {
            assert!(names().contains(&of) && names().contains(&to));
        }
    }
}
