//! A claim as a short section of its chapter.

use std::fmt::Write as _;

use super::chapter::{Chapter, Entry, Tried};
use super::text::{code_list, escaped, item, paragraph, unstopped};
use crate::claim::{Basis, Metric};
use crate::figures;
use crate::format::{order, scientific, significant, table};
use crate::golden::Evaluation;
use crate::ladder::{Depth, symbol};
use crate::record::{OrderRecord, Record, Verdict};

/// Appends the section of a claim: sentence, what is measured against what, bound, outcome, rungs, figure.
pub(super) fn render(out: &mut String, chapter: &Chapter, entry: &Entry) {
    let record = &entry.record;
    let _ = write!(out, "### {}\n\n", record.claim);
    let tags = record.tags.iter().map(|t| tag(t)).collect::<Vec<_>>().join(", ");
    paragraph(out, &format!("**{}.** ({tags})", escaped(unstopped(&record.title))));
    item(out, &format!("*Measured*: {}. {}.", escaped(unstopped(&record.measures)), metric(record.metric)));
    item(out, &format!("*Reference*: {}{}.", escaped(unstopped(&record.reference)), known_to(record)));
    item(out, &tolerance(entry));
    item(out, &outcome(record));
    let caught: Vec<&Tried> = chapter.mutants.iter().filter(|m| m.record.caught_by == record.claim).collect();
    if !caught.is_empty() {
        item(out, &format!("*Mutants that have to fail it*: {}.", mutants(&caught)));
    }
    item(out, &last_run(entry));
    out.push('\n');
    rungs(out, record);
    figure(out, chapter, record);
}

/// A tag as a link: equations of the method by their short name, papers and misprints to their pages.
fn tag(tag: &str) -> String {
    if tag.starts_with("ERRATA") {
        return format!("[{tag}](../../docs/errata.md)");
    }
    if tag.starts_with("HARD_CASES") || (tag.starts_with('H') && tag[1..].parse::<u32>().is_ok()) {
        return format!("[{tag}](../../docs/hard-cases.md)");
    }
    if tag.contains(' ') {
        format!("[{tag}](equations.md)")
    } else {
        format!("[{tag}](../../docs/method.md)")
    }
}

fn metric(metric: Metric) -> &'static str {
    match metric {
        Metric::L2 => "Relative L2 norm",
        Metric::LInf => "Relative largest difference",
        Metric::Relative => "Relative difference",
        Metric::Absolute => "Absolute difference",
    }
}

fn known_to(record: &Record) -> String {
    if record.reference_uncertainty > 0.0 {
        format!(" (known to {} relative)", scientific(record.reference_uncertainty))
    } else {
        String::new()
    }
}

/// What a tolerance stands on, in words.
pub(super) fn basis(basis: Basis) -> &'static str {
    match basis {
        Basis::Derived => "derived",
        Basis::Reference => "of the reference",
        Basis::AfterSeeing => "set after seeing",
    }
}

fn tolerance(entry: &Entry) -> String {
    let tolerance = &entry.record.tolerance;
    let because = escaped(unstopped(&tolerance.because));
    let value = scientific(tolerance.value);
    format!("*Tolerance*: {value} at {}, **{}**: {because}.", tolerance.applies_to, basis(entry.basis))
}

/// Verdict, slack and order.
fn outcome(record: &Record) -> String {
    let verdict = match &record.verdict {
        Verdict::Pass => format!("holds, slack {}", scientific(record.slack)),
        Verdict::Fail { reasons } => format!("**does not hold**: {}", escaped(&reasons.join("; "))),
    };
    let order = record.order.as_ref().map_or_else(String::new, |o| format!("; {}", expected(record, o)));
    format!("*Outcome*: {verdict}{order}.")
}

fn expected(record: &Record, o: &OrderRecord) -> String {
    let wanted = if o.at_least {
        format!("at least {}", significant(o.expected - o.band, 3))
    } else {
        format!("{} ± {}", o.expected, o.band)
    };
    let pairs: Vec<String> = o.fitted.pairwise.iter().map(|p| format!("{p:.2}")).collect();
    let limit = o.richardson.map_or_else(String::new, |r| {
        let index = scientific(r.grid_convergence_index);
        format!("; extrapolated {} with grid convergence index {index}", significant(r.value, 8))
    });
    let pairs = pairs.join(", ");
    format!("order {} where {wanted} is expected, {pairs} from rung to rung{limit}", order(record))
}

fn mutants(caught: &[&Tried]) -> String {
    let name = |m: &&Tried| {
        let place = if m.in_solver { "solver" } else { "measurement" };
        let word = if m.record.caught { "" } else { ", **escapes**" };
        format!("`{}` ({place}{word})", m.record.mutant)
    };
    caught.iter().map(name).collect::<Vec<_>>().join(", ")
}

fn last_run(entry: &Entry) -> String {
    let open = entry.open_rungs();
    let rungs = if open.is_empty() {
        String::new()
    } else {
        let rungs: Vec<String> = open.iter().map(f64::to_string).collect();
        format!(" Never evaluated: {} = {}.", symbol(&entry.record.parameter), rungs.join(", "))
    };
    let Some(e) = &entry.evaluation else { return format!("*Last evaluated*: unknown.{rungs}") };
    format!("*Last evaluated*: {} ladder, revision {}, {}.{rungs}", depth(e), revision(e), e.date)
}

/// `short` or `full`.
pub(super) fn depth(evaluation: &Evaluation) -> &'static str {
    match evaluation.depth {
        Depth::Short => "short",
        Depth::Full => "full",
    }
}

/// The revision, or that it is unknown.
pub(super) fn revision(evaluation: &Evaluation) -> &str {
    evaluation.revision.as_deref().unwrap_or("unknown")
}

/// The ladder; further numbers of a rung are in the golden record.
fn rungs(out: &mut String, record: &Record) {
    let columns =
        [escaped(&record.parameter), "computed".to_owned(), "reference".to_owned(), "error".to_owned()];
    let row = |s: &crate::claim::Sample| {
        let wide = |x| significant(x, 8);
        vec![s.parameter.to_string(), wide(s.computed), wide(s.reference), scientific(s.error)]
    };
    let rows: Vec<Vec<String>> = record.samples.iter().map(row).collect();
    table(out, &columns.each_ref().map(String::as_str), &rows);
}

/// The figure with the errors of this claim, under the first of its claims; the others refer to it.
fn figure(out: &mut String, chapter: &Chapter, record: &Record) {
    let records = chapter.records();
    let shown = figures::convergence(&chapter.id, &records).into_iter().find_map(|(name, plot)| {
        let first = plot.series.first()?.name.clone();
        plot.series.iter().any(|s| s.name == record.claim).then_some((name, first, plot.title))
    });
    match shown {
        Some((name, first, title)) if first == record.claim => {
            let _ = write!(out, "![{title}](../../golden/figures/{name})\n\n");
        }
        Some((name, first, _)) => {
            let text = format!(
                "Its curve is in the figure under {}, [{name}](../../golden/figures/{name}).",
                code_list([first.as_str()])
            );
            paragraph(out, &text);
        }
        None => {}
    }
}
