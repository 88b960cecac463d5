//! Timing the cases of a group in turns.

use std::time::Instant;

use serde::Serialize;

use super::cases::{Case, Compare, Group, Quantity};
use super::error::BenchError;
use super::machine::Memory;
use super::statistics::Spread;
use super::yielded::{Yielded, yielded};
use super::{Options, Report, backends};
use crate::plan::memory::{human, predict};
use crate::solver::run::{Backend, Run, StartError};

/// Share of the available memory that is used.
const HEADROOM: f64 = 0.9;
/// Steps before anything is timed. Free surfaces need some to leave their initial shape.
const WARM_UP: u64 = 2;
/// Steps before anything is timed below a free surface.
const WARM_UP_SURFACE: u64 = 20;

/// Speed of one case on one backend.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CaseSpeed {
    /// The case.
    pub name: &'static str,
    /// What it shows.
    pub shows: &'static str,
    /// The backend.
    pub backend: &'static str,
    /// Threads.
    pub threads: usize,
    /// Cells of the box along x, y, z.
    pub extents: [usize; 3],
    /// Fluid cells at the end.
    pub fluid_cells: u64,
    /// Steps timed in all slices together.
    pub steps: u64,
    /// Million updates of fluid cells per second, by slice.
    pub mlups: Spread,
    /// Nanoseconds per update, median.
    pub ns_per_update: f64,
    /// Bytes of a stored population.
    pub bytes_per_number: u64,
    /// Median speed over the ceiling at this number of threads, for populations of this size.
    pub share_of_ceiling: f64,
    /// Bytes held per fluid cell.
    pub bytes_per_fluid_cell: f64,
    /// Bytes per fluid cell that the plan predicts.
    pub predicted_bytes_per_fluid_cell: f64,
    /// Share of yielded fluid; `None` where everything flows, and where another line of the case says it.
    pub yielded: Option<Yielded>,
    /// Passes and their share of the time, where the backend says.
    pub passes: Vec<(&'static str, f64)>,
}

/// A ratio, from slices of the same turn.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ratio {
    /// What over what.
    pub name: String,
    /// The group.
    pub group: &'static str,
    /// Of what.
    pub quantity: Quantity,
    /// The backend, or the two.
    pub backend: String,
    /// Threads, or the two numbers.
    pub threads: String,
    /// Median and extremes over the turns.
    pub ratio: Spread,
}

/// One slice.
#[derive(Clone, Copy)]
struct Slice {
    seconds: f64,
    steps: u64,
    /// Fluid cells times steps; the mean of before and after.
    updates: f64,
}

/// A case being timed.
struct Subject<'a> {
    case: &'a Case,
    backend: &'static dyn Backend,
    threads: usize,
    run: Box<dyn Run>,
    predicted: u64,
    /// Steps of a slice.
    steps: u64,
    slices: Vec<Slice>,
}

/// Times the wanted cases of a group. What does not fit into memory is left out with a note; the first such
/// case is returned as the error it is if nothing else was measured.
pub(super) fn group(
    options: &Options,
    group: &'static Group,
    wanted: &dyn Fn(&str) -> bool,
    memory: Memory,
    report: &mut Report,
) -> Result<Option<BenchError>, BenchError> {
    let mut shortage = None;
    let mut subjects = Vec::new();
    let mut free = memory.free().map(|bytes| (HEADROOM * bytes as f64) as u64);
    for case in group.cases.iter().filter(|case| wanted(case.name)) {
        start(options, group, case, &mut free, &mut subjects, &mut shortage, report)?;
    }
    for subject in &mut subjects {
        subject.warm_up(options)?;
    }
    for _ in 0..options.rounds() {
        for subject in &mut subjects {
            let slice = subject.slice(subject.steps)?;
            subject.slices.push(slice);
        }
    }
    for (number, subject) in subjects.iter().enumerate() {
        let first = !subjects[..number].iter().any(|other| other.case.name == subject.case.name);
        report.cases.push(subject.speed(first));
    }
    report.ratios.extend(ratios(group, &subjects));
    Ok(shortage)
}

/// Starts one case on every backend and number of threads it is meant for and that fits.
fn start<'a>(
    options: &Options,
    group: &Group,
    case: &'a Case,
    free: &mut Option<u64>,
    subjects: &mut Vec<Subject<'a>>,
    shortage: &mut Option<BenchError>,
    report: &mut Report,
) -> Result<(), BenchError> {
    let mut setup = (case.setup)(options.scale());
    for backend in backends() {
        if backend.name() == "plain" && setup.cells() > options.plain_cells() {
            let limit = options.plain_cells();
            report.leave_out(case.name, format!("plain is given at most {limit} cells here"));
            continue;
        }
        let predicted = predict(&setup, backend.layout()).run();
        for threads in options.thread_counts() {
            if !group.single_thread && threads < options.threads {
                continue;
            }
            if let Some(available) = free.filter(|&available| predicted > available) {
                let what = format!("{} on {} with {threads} threads", case.name, backend.name());
                let needed = human(predicted);
                let left = human(available);
                report.leave_out(&what, format!("memory: {needed} are needed and {left} are left"));
                shortage.get_or_insert(BenchError::OutOfMemory { what, needed: predicted, available });
                continue;
            }
            setup.threads = threads;
            match backend.start(&setup) {
                Ok(run) => {
                    *free = free.map(|free| free - predicted);
                    let slices = Vec::with_capacity(options.rounds());
                    subjects.push(Subject { case, backend, threads, run, predicted, steps: 1, slices });
                }
                Err(StartError::Unsupported { backend, feature }) => {
                    report.leave_out(case.name, format!("{backend} does not have {feature}"));
                }
                Err(source) => return Err(BenchError::Start { case: case.name.to_owned(), source }),
            }
        }
    }
    Ok(())
}

impl Subject<'_> {
    /// Lets the flow leave its initial state, and chooses the length of a slice.
    fn warm_up(&mut self, options: &Options) -> Result<(), BenchError> {
        let surface = self.run.setup().free_surface.is_some();
        self.slice(if surface { WARM_UP_SURFACE } else { WARM_UP })?;
        let slice = self.slice(1)?;
        let steps = (options.slice_seconds() / slice.seconds).ceil();
        // Even numbers: a backend may alternate between two kinds of steps.
        self.steps = if steps <= 1.0 { 1 } else { 2 * (0.5 * steps).ceil() as u64 };
        Ok(())
    }

    fn slice(&mut self, steps: u64) -> Result<Slice, BenchError> {
        let before = self.run.fluid_cells();
        let clock = Instant::now();
        self.run
            .advance(steps)
            .map_err(|stopped| BenchError::Stopped { case: self.case.name.to_owned(), step: stopped.step })?;
        let seconds = clock.elapsed().as_secs_f64().max(1e-9);
        let updates = 0.5 * (before + self.run.fluid_cells()) as f64 * steps as f64;
        Ok(Slice { seconds, steps, updates })
    }

    fn speed(&self, first: bool) -> CaseSpeed {
        let mlups: Vec<f64> = self.slices.iter().map(|slice| 1e-6 * slice.updates / slice.seconds).collect();
        let mlups = Spread::of(&mlups);
        let fluid_cells = self.run.fluid_cells();
        let per_cell = |bytes: u64| bytes as f64 / fluid_cells.max(1) as f64;
        let passes = self.run.pass_seconds();
        let total: f64 = passes.iter().map(|(_, seconds)| seconds).sum();
        CaseSpeed {
            name: self.case.name,
            shows: self.case.shows,
            backend: self.backend.name(),
            threads: self.threads,
            extents: self.run.setup().extents,
            fluid_cells,
            steps: self.slices.iter().map(|slice| slice.steps).sum(),
            mlups,
            ns_per_update: 1e3 / mlups.median,
            bytes_per_number: self.run.setup().precision.bytes(),
            // Known once the bandwidth has been measured for the second time.
            share_of_ceiling: f64::NAN,
            bytes_per_fluid_cell: per_cell(self.run.allocated_bytes()),
            predicted_bytes_per_fluid_cell: per_cell(self.predicted),
            yielded: if first { yielded(self.case, self.run.as_ref()) } else { None },
            passes: passes.into_iter().map(|(name, seconds)| (name, seconds / total)).collect(),
        }
    }

    /// One number per turn.
    fn quantities(&self, quantity: Quantity) -> Vec<f64> {
        let of = |slice: &Slice| match quantity {
            Quantity::Rate => slice.updates / slice.seconds,
            Quantity::TimePerUpdate => slice.seconds / slice.updates,
            Quantity::TimePerStep => slice.seconds / slice.steps as f64,
            Quantity::Bytes => self.run.allocated_bytes() as f64,
        };
        self.slices.iter().map(of).collect()
    }
}

/// Turn by turn.
fn divide(a: &Subject, b: &Subject, quantity: Quantity) -> Spread {
    let quotients = a.quantities(quantity).into_iter().zip(b.quantities(quantity)).map(|(a, b)| a / b);
    Spread::of(&quotients.collect::<Vec<f64>>())
}

/// The ratios the group names, by backend and threads; then more threads over one, and backends over plain.
fn ratios(group: &'static Group, subjects: &[Subject]) -> Vec<Ratio> {
    let mut ratios = Vec::new();
    for compare in group.compare {
        named(group, compare, subjects, &mut ratios);
    }
    for a in subjects {
        for b in subjects.iter().filter(|b| b.case.name == a.case.name) {
            let (name, backend, threads) = if a.backend.name() == b.backend.name() {
                if b.threads != 1 || a.threads == 1 {
                    continue;
                }
                let name = format!("{}: {} threads / 1", a.case.name, a.threads);
                (name, a.backend.name().to_owned(), format!("{} / 1", a.threads))
            } else {
                if b.backend.name() != "plain" || a.threads != b.threads {
                    continue;
                }
                let both = format!("{} / {}", a.backend.name(), b.backend.name());
                (format!("{}: {both}", a.case.name), both, a.threads.to_string())
            };
            let (group, quantity) = (group.name, Quantity::Rate);
            ratios.push(Ratio { name, group, quantity, backend, threads, ratio: divide(a, b, quantity) });
        }
    }
    ratios
}

fn named(group: &'static Group, compare: &Compare, subjects: &[Subject], ratios: &mut Vec<Ratio>) {
    for a in subjects.iter().filter(|a| a.case.name == compare.of) {
        let same = |b: &&Subject| {
            b.case.name == compare.to && b.backend.name() == a.backend.name() && b.threads == a.threads
        };
        if let Some(b) = subjects.iter().find(same) {
            ratios.push(Ratio {
                name: compare.name.to_owned(),
                group: group.name,
                quantity: compare.quantity,
                backend: a.backend.name().to_owned(),
                threads: a.threads.to_string(),
                ratio: divide(a, b, compare.quantity),
            });
        }
    }
}
