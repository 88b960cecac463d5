//! `lahar bench`: what this machine's memory can do, and what share of it each flow of a fixed list gets.
//!
//! A cell update reads and writes 19 numbers of 8 bytes: 304 bytes, half of it in single precision. The best bandwidth of any kind over
//! this is the ceiling of a scheme that keeps two copies of its populations in memory; every speed is given as
//! a share of the ceiling measured in the same run at the same number of threads. Cases of a group are
//! timed in turns, slice by slice, and ratios are taken within a turn: whatever else the machine does hits
//! both sides.

pub(crate) mod bandwidth;
pub mod cases;
mod error;
mod flows;
pub mod grains;
mod machine;
mod measure;
mod scale;
mod statistics;
mod table;
mod yielded;

use serde::Serialize;

pub use error::BenchError;
pub use grains::GrainSpeed;
pub use machine::Machine;
pub use measure::{CaseSpeed, Ratio};
pub use statistics::Spread;

use crate::plan::available_memory;
use crate::solver::choose::Best;
use crate::solver::plain::Plain;
use crate::solver::run::Backend;
use bandwidth::{BYTES_PER_NUMBER, BYTES_PER_UPDATE, Speed};
use cases::GROUPS;
use machine::Memory;
pub use scale::Scale;

/// Every backend, the plain one first.
#[must_use]
pub fn backends() -> [&'static dyn Backend; 2] {
    [&Plain, &Best]
}

/// What to measure, and how long.
#[derive(Clone, Debug)]
pub struct Options {
    /// About ten times fewer cells and shorter slices.
    pub quick: bool,
    /// Largest number of threads, at least 1.
    pub threads: usize,
    /// Only the group or case of this name; `bandwidth` for the memory alone.
    pub only: Option<String>,
}

impl Options {
    fn scale(&self) -> Scale {
        if self.quick { Scale::Quick } else { Scale::Full }
    }

    /// Least length of a timed slice, s.
    const fn slice_seconds(&self) -> f64 {
        if self.quick { 0.02 } else { 0.1 }
    }

    /// Timed slices of each case.
    const fn rounds(&self) -> usize {
        if self.quick { 5 } else { 9 }
    }

    /// Cells of the largest box the plain backend is given: it is slow, and cost is linear.
    const fn plain_cells(&self) -> usize {
        if self.quick { 100_000 } else { 1_000_000 }
    }

    /// Bytes of each of the three arrays the bandwidth is measured on: one alone is well beyond the
    /// last-level cache.
    fn array_bytes(&self, machine: &Machine) -> u64 {
        let cache = machine.last_cache_bytes.unwrap_or(32 << 20);
        if self.quick { (4 * cache).max(128 << 20) } else { (8 * cache).max(256 << 20) }
    }

    /// 1, 2, 4, … and the largest.
    fn thread_counts(&self) -> Vec<usize> {
        let largest = self.threads.max(1);
        let powers = std::iter::successors(Some(1_usize), |n| n.checked_mul(2));
        let mut counts: Vec<usize> = powers.take_while(|&n| n < largest).collect();
        counts.push(largest);
        counts
    }
}

/// Everything that was measured.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// Where.
    pub machine: Machine,
    /// Whether sizes are a tenth of what names and descriptions say.
    pub quick: bool,
    /// Bytes of each of the three arrays of the bandwidth.
    pub array_bytes: u64,
    /// Bandwidth, by threads and kernel; the best of a measurement before and one after the cases.
    pub bandwidth: Vec<Speed>,
    /// Ceiling, by threads.
    pub ceilings: Vec<Ceiling>,
    /// Speeds of the cases.
    pub cases: Vec<CaseSpeed>,
    /// Speeds of dry grains.
    pub grains: Vec<GrainSpeed>,
    /// Ratios of them.
    pub ratios: Vec<Ratio>,
    /// What was left out, and why.
    pub left_out: Vec<LeftOut>,
}

/// Cases that were not measured.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LeftOut {
    /// Why.
    pub because: String,
    /// Which.
    pub cases: Vec<String>,
}

impl Report {
    fn leave_out(&mut self, case: &str, because: String) {
        match self.left_out.iter_mut().find(|note| note.because == because) {
            Some(note) => note.cases.push(case.to_owned()),
            None => self.left_out.push(LeftOut { because, cases: vec![case.to_owned()] }),
        }
    }
}

/// Best bandwidth of any kind, as cell updates.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Ceiling {
    /// Threads.
    pub threads: usize,
    /// 10⁹ bytes per second.
    pub gb_per_s: f64,
    /// Million updates of 304 bytes per second.
    pub mlups: f64,
}

/// Names that [`Options::only`] may have.
#[must_use]
pub(crate) fn names() -> Vec<String> {
    let groups = GROUPS.iter();
    let names =
        groups.flat_map(|group| std::iter::once(group.name).chain(group.cases.iter().map(|case| case.name)));
    std::iter::once("bandwidth").chain(names).chain(grains::names()).map(str::to_owned).collect()
}

/// Measures. `say` is told what is going on, one line at a time.
///
/// # Errors
/// An unknown name, too little memory for anything that was asked for, no threads, or a backend that
/// refuses or stops one of the flows.
pub fn run(options: &Options, say: &mut dyn FnMut(&str)) -> Result<Report, BenchError> {
    if let Some(only) = &options.only
        && !names().contains(only)
    {
        return Err(BenchError::UnknownName { found: only.clone(), names: names() });
    }
    let machine = Machine::this();
    // Grains are not judged by the bandwidth.
    let only_grains = options.only.as_deref().is_some_and(|only| grains::names().contains(&only));
    let array_bytes = options.array_bytes(&machine);
    let mut report = Report {
        quick: options.quick,
        array_bytes,
        bandwidth: Vec::new(),
        ceilings: Vec::new(),
        cases: Vec::new(),
        grains: Vec::new(),
        ratios: Vec::new(),
        left_out: Vec::new(),
        machine,
    };
    if only_grains {
        grains::measure(options, &mut report, say)?;
        return Ok(report);
    }
    measure_bandwidth(options, &mut report, say)?;
    let memory = Memory::now();
    let mut shortage = None;
    for group in &GROUPS {
        let wanted =
            |name: &str| options.only.as_deref().is_none_or(|only| only == group.name || only == name);
        if group.cases.iter().any(|case| wanted(case.name)) {
            say(&format!("{}: {}", group.name, group.about));
            shortage = shortage.or(measure::group(options, group, &wanted, memory, &mut report)?);
        }
    }
    grains::measure(options, &mut report, say)?;
    if report.cases.is_empty() {
        return shortage.map_or(Ok(report), Err);
    }
    // Clouds and laptops change their speed within minutes: the ceiling is the best of two moments.
    measure_bandwidth(options, &mut report, say)?;
    for case in &mut report.cases {
        let ceiling = report.ceilings.iter().find(|ceiling| ceiling.threads == case.threads);
        let numbers = case.bytes_per_number as f64 / BYTES_PER_NUMBER;
        case.share_of_ceiling =
            ceiling.map_or(f64::NAN, |ceiling| case.mlups.median * numbers / ceiling.mlups);
    }
    Ok(report)
}

/// Measures the bandwidth and keeps the better of this and what was measured before.
fn measure_bandwidth(
    options: &Options,
    report: &mut Report,
    say: &mut dyn FnMut(&str),
) -> Result<(), BenchError> {
    say("bandwidth: read, copy, triad, in place");
    let needed = 3 * report.array_bytes;
    if let Some(available) = available_memory().filter(|&available| needed > available) {
        return Err(BenchError::OutOfMemory {
            what: "measuring the bandwidth".to_owned(),
            needed,
            available,
        });
    }
    let counts = options.thread_counts();
    let mut speeds = Vec::new();
    for &threads in &counts {
        speeds.extend(bandwidth::measure(report.array_bytes, threads, options.rounds())?);
    }
    for (speed, before) in speeds.iter_mut().zip(&report.bandwidth) {
        speed.best_gb_per_s = speed.best_gb_per_s.max(before.best_gb_per_s);
        speed.median_gb_per_s = speed.median_gb_per_s.max(before.median_gb_per_s);
    }
    report.ceilings = counts.iter().map(|&threads| ceiling(&speeds, threads)).collect();
    report.bandwidth = speeds;
    Ok(())
}

fn ceiling(speeds: &[Speed], threads: usize) -> Ceiling {
    let of_threads = speeds.iter().filter(|speed| speed.threads == threads);
    let gb_per_s = of_threads.map(|speed| speed.best_gb_per_s).fold(0.0, f64::max);
    Ceiling { threads, gb_per_s, mlups: 1e3 * gb_per_s / BYTES_PER_UPDATE }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_thread_counts() {
        let counts = |threads| Options { quick: true, threads, only: None }.thread_counts();
        assert_eq!(counts(1), [1]);
        assert_eq!(counts(2), [1, 2]);
        assert_eq!(counts(6), [1, 2, 4, 6]);
        assert_eq!(counts(8), [1, 2, 4, 8]);
    }

    #[test]
    fn names_are_unique_and_comparisons_name_cases_of_their_group() {
        let mut all = names();
        all.sort();
        let count = all.len();
        all.dedup();
        assert_eq!(all.len(), count);
        for group in &GROUPS {
            let has = |name| group.cases.iter().any(|case| case.name == name);
            assert!(group.compare.iter().all(|compare| has(compare.of) && has(compare.to)), "{}", group.name);
            assert!(group.cases.iter().all(|case| case.name.starts_with(&format!("{}/", group.name))));
        }
    }

    #[test]
    fn unknown_name_is_refused_with_all_names() {
        let options = Options { quick: true, threads: 1, only: Some("bulk/water".to_owned()) };
        let error = run(&options, &mut |_| {}).unwrap_err();
        assert!(matches!(error, BenchError::UnknownName { .. }));
        let message = error.to_string();
        assert!(message.contains("bulk/water") && message.contains("dam-break/newtonian-roomy"), "{message}");
    }
}
