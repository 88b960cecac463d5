//! `study-sweep --count N` and `--case K`: rows beyond those of the report.

use std::fmt::Write as _;
use std::process::ExitCode;

use rayon::prelude::*;

use super::case::Case;
use super::judge::Judgement;
use super::row::Row;
use super::scenes;
use crate::claim::VerifyError;
use crate::golden::package_root;
use crate::study;
use lahar::output::atomic;
use lahar::plan::wall_error::Sweep;
use lahar::solver::run::Backend;

/// Heads of the rows that [`line`] writes.
pub const HEADS: &str = "case,place,detail,n,plug,cells,tau,speed,operator,sheared,push,error,half_way,apart,l2,flux,\
                         rest,fast,half_way_end,faults,announced";

/// One row, comma separated.
pub fn line(row: &Row, judgement: &Judgement) -> String {
    let case = &row.case;
    let mut text = format!(
        "{},{},{:.4},{:.5},{:.5},{:.4},{:.6},{:.5e},{},{:.4},{:.4e}",
        case.number,
        case.place.name(),
        case.place.detail(),
        case.n,
        case.plug,
        case.cells,
        case.tau,
        case.speed,
        case.operator.name(),
        row.sheared,
        row.push
    );
    let state = row.rest.state();
    for number in [
        row.error(),
        row.half_way_error(),
        row.apart(),
        state.map_or(f64::NAN, super::row::State::l2),
        state.map_or(f64::NAN, super::row::State::flux),
    ] {
        let _ = write!(text, ",{number:.4e}");
    }
    let faults: Vec<String> = judgement.faults.iter().map(ToString::to_string).collect();
    for words in [row.rest.words(), row.fast.words(), row.half_way.words(), faults.join("; ")] {
        let _ = write!(text, ",\"{}\"", words.replace('"', "'"));
    }
    let _ = write!(text, ",{}", judgement.announced);
    text
}

/// Runs cases, several at a time, and gives their rows in order.
///
/// # Errors
/// The first case that cannot be set up.
pub fn rows_of(backend: &dyn Backend, numbers: &[u64]) -> Result<Vec<Row>, VerifyError> {
    numbers.par_iter().with_max_len(1).map(|&k| Row::of(backend, Case::new(k))).collect()
}

/// Command line of the study: that of all studies, and cases beyond those of the report.
#[derive(clap::Parser, Debug, Clone)]
#[command(disable_version_flag = true)]
// The flattened options have the same name.
#[group(id = "SweepOptions")]
pub struct Options {
    /// As every study.
    #[command(flatten)]
    pub study: study::Options,
    /// Run this many cases, print the rows with faults, and write all of them to target/studies/sweep/rows.csv.
    #[arg(long, value_name = "N")]
    pub count: Option<u64>,
    /// First case of `--count`.
    #[arg(long, value_name = "K", default_value_t = 0)]
    pub from: u64,
    /// Only cases of `--count` in this place: channel, film, duct, pipe, annulus, Couette, cylinders.
    #[arg(long, value_name = "NAME")]
    pub place: Option<String>,
    /// Run one case and print everything about it.
    #[arg(long, value_name = "K")]
    pub case: Option<u64>,
    /// Run this many random scenes from `--from` on, print those outside of what their plans say, and write all of them to
    /// target/studies/sweep/scenes.csv.
    #[arg(long, value_name = "N")]
    pub scenes: Option<u64>,
    /// Run one random scene and print it with what became of it.
    #[arg(long, value_name = "K")]
    pub scene: Option<u64>,
}

/// The binary.
#[must_use]
pub fn main(backend: &dyn Backend) -> ExitCode {
    let options: Options = match study::parse() {
        Ok(options) => options,
        Err(code) => return code,
    };
    let extra = match options {
        Options { scene: Some(number), .. } => scenes::one(backend, number).map_err(Failure::from),
        Options { scenes: Some(count), from, .. } => random_scenes(backend, from, count),
        Options { case: Some(number), .. } => one(backend, number),
        Options { count: Some(count), from, ref place, .. } => many(backend, from, count, place.as_deref()),
        _ => return study::run(&super::STUDY, backend, &options.study),
    };
    match extra {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Runs scenes and keeps their rows.
fn random_scenes(backend: &dyn Backend, from: u64, count: u64) -> Result<(), Failure> {
    let text = scenes::many(backend, from, count)?;
    keep("scenes.csv", &text)
}

/// Writes a file of the study and says where.
fn keep(name: &str, text: &str) -> Result<(), Failure> {
    let root = package_root();
    let path = super::STUDY.folder(&root).join(name);
    atomic::write(&path, text.as_bytes())?;
    println!("All rows are in {}.", path.strip_prefix(&root).unwrap_or(&path).display());
    Ok(())
}

/// Prints a case.
fn one(backend: &dyn Backend, number: u64) -> Result<(), Failure> {
    let row = Row::of(backend, Case::new(number))?;
    println!("{}", row.case.line());
    println!("sheared layer {:.2} cells, push per step {:.2e} of the speed", row.sheared, row.push);
    println!(
        "error {:+.3e}, with half-way walls {:+.3e}, starts apart {:.1e}",
        row.error(),
        row.half_way_error(),
        row.apart()
    );
    for (start, end) in [("from rest", &row.rest), ("from 3 x", &row.fast), ("half-way", &row.half_way)] {
        println!("{start}: {}", end.words());
        let Some(state) = end.state() else { continue };
        println!("    L2 {:.3e}, discharge {:+.3e}", state.l2(), state.flux());
        for node in state.nodes.iter().take(64) {
            print!(" {:.5}({:.5})", node.computed, node.exact);
        }
        println!();
    }
    let judgement = Judgement::of(&row, &Sweep::built_in()?);
    for fault in judgement.faults {
        println!("FAULT{} {fault}", if judgement.announced { " (a plan warns)" } else { "" });
    }
    Ok(())
}

/// Runs cases and keeps their rows.
fn many(backend: &dyn Backend, from: u64, count: u64, place: Option<&str>) -> Result<(), Failure> {
    let asked = |k: &u64| place.is_none_or(|name| Case::new(*k).place.name() == name);
    let numbers: Vec<u64> = (from..from.saturating_add(count)).filter(asked).collect();
    let rows = rows_of(backend, &numbers)?;
    let sweep = Sweep::built_in()?;
    let mut text = format!("{HEADS}\n");
    let (mut faulty, mut silent) = (0, 0);
    for row in &rows {
        let judgement = Judgement::of(row, &sweep);
        let line = line(row, &judgement);
        if !judgement.faults.is_empty() {
            println!("{line}");
            faulty += 1;
            silent += u64::from(judgement.is_silent());
        }
        text.push_str(&line);
        text.push('\n');
    }
    println!("{} cases, {faulty} with faults, {silent} of them without a warning of the plan.", rows.len());
    keep("rows.csv", &text)
}

/// Why there are no rows.
#[derive(Debug, thiserror::Error)]
enum Failure {
    #[error(transparent)]
    Case(#[from] VerifyError),
    #[error("the table of the sweep: {0}")]
    Table(#[from] serde_json::Error),
    #[error(transparent)]
    Write(#[from] lahar::output::OutputError),
}
