//! Golden records to Markdown.

use std::fmt::Write as _;

use super::format::{order, scientific, significant, table};
use super::{Chapter, figures, trace};
use crate::claim::{Kind, Metric};
use crate::exhibit::{Entry, ExhibitRecord};
use crate::ladder::symbol;
use crate::mutant::{Detection, MutantRecord};
use crate::record::{Record, Verdict};

const OPENING: &str = "\
# What the numbers are worth

This document is made from the files in `golden/` by `lahar report`; it is not edited by hand, and a \
test fails when it is out of date. It lists every claim that lahar makes about its own correctness.

A *claim* compares one measured quantity with a reference that is not lahar: a formula, a table, an \
experiment. It is evaluated on a *ladder* of rungs, usually resolutions. Its *tolerance* is derived before \
the measurement, from rounding, from the known error of the scheme, or from the uncertainty of the \
reference; the reason stands beside it. *Slack* is tolerance divided by error: a slack of 1.1 is a claim \
that just holds, a slack of 1000 a bound that could be sharper. The *order* is the slope of a least-squares \
line through error against parameter in logarithms, with its standard error. A *mutant* is a deliberate \
mistake, most of them misprints of the source papers; a named claim has to fail on it, which shows that \
the claim can fail at all.

Papers: **000** DEM-LBM model of debris flow, **001** LBM for geophysical plastic flows, **004** thesis on \
Herschel-Bulkley dam breaks over an erodible bed. Tags in brackets are the equations of lahar's own design.
";

/// Makes the report. Pure: the same chapters give the same bytes.
#[must_use]
pub fn render(chapters: &[Chapter]) -> String {
    let mut out = OPENING.to_owned();
    summary(&mut out, chapters);
    for (k, chapter) in chapters.iter().enumerate() {
        render_chapter(&mut out, k + 1, chapter);
    }
    validation(&mut out, chapters);
    mutants(&mut out, chapters);
    limits(&mut out, chapters);
    speeds(&mut out, chapters);
    trace::render(&mut out, chapters);
    while out.ends_with("\n\n") {
        out.pop();
    }
    out
}

fn summary(out: &mut String, chapters: &[Chapter]) {
    out.push_str("\n## Summary\n\n");
    let row = |title: String, records: &[&Record], caught: usize, mutants: usize| {
        let held = records.iter().filter(|r| r.passed()).count();
        let least = records.iter().map(|r| r.slack).reduce(f64::min).map_or("–".to_owned(), scientific);
        vec![title, format!("{held} of {}", records.len()), least, format!("{caught} of {mutants}")]
    };
    let mut rows = Vec::new();
    for (k, chapter) in chapters.iter().enumerate() {
        let caught = chapter.mutants.iter().filter(|m| m.caught).count();
        let records: Vec<&Record> = chapter.records.iter().collect();
        rows.push(row(format!("{}. {}", k + 1, chapter.title), &records, caught, chapter.mutants.len()));
    }
    let all: Vec<&Record> = chapters.iter().flat_map(|c| &c.records).collect();
    let every: Vec<&MutantRecord> = chapters.iter().flat_map(|c| &c.mutants).collect();
    rows.push(row("all".to_owned(), &all, every.iter().filter(|m| m.caught).count(), every.len()));
    table(out, &["chapter", "claims that hold", "least slack", "mutants caught"], &rows);
    let missing: Vec<&str> = chapters.iter().flat_map(|c| &c.missing).map(String::as_str).collect();
    if !missing.is_empty() {
        let _ = writeln!(out, "Declared but without a golden record yet: {}.\n", code_list(&missing));
    }
}

fn code_list(ids: &[&str]) -> String {
    ids.iter().map(|id| format!("`{id}`")).collect::<Vec<_>>().join(", ")
}

fn render_chapter(out: &mut String, number: usize, chapter: &Chapter) {
    let _ = write!(out, "## {number}. {}\n\n{}\n\n", chapter.title, chapter.intro.trim());
    let of = |kind: Kind| -> Vec<&Record> { chapter.records.iter().filter(|r| r.kind == kind).collect() };
    let verification = of(Kind::Verification);
    if !verification.is_empty() {
        claims(out, &verification);
    }
    let predicted = of(Kind::PredictedFailure);
    if !predicted.is_empty() {
        let _ = write!(
            out,
            "### Predicted failures\n\nTheory says in numbers how the scheme, or a variant of it, goes wrong \
             here. The claim is that it does so as predicted.\n\n"
        );
        claims(out, &predicted);
    }
    let records: Vec<&Record> = chapter.records.iter().collect();
    let plots = figures::convergence(&chapter.id, &records);
    if !plots.is_empty() {
        out.push_str("### Convergence\n\n");
    }
    for (name, plot) in plots {
        let _ = write!(out, "![{}](golden/figures/{name})\n\n", plot.title);
    }
    for (caption, record) in chapter.exhibits.iter().filter(|(_, r)| r.measured.is_none()) {
        exhibit(out, caption, record);
    }
    if chapter.records.is_empty() && chapter.exhibits.is_empty() {
        out.push_str("*No results yet.*\n\n");
    }
}

/// The table of claims, and the rungs of each below it.
fn claims(out: &mut String, records: &[&Record]) {
    let columns = ["claim", "measured, against", "error", "order", "tolerance and why", "slack", "verdict"];
    let rows: Vec<Vec<String>> = records.iter().map(|r| claim_row(r)).collect();
    table(out, &columns, &rows);
    for record in records {
        if let Verdict::Fail { reasons } = &record.verdict {
            let _ = write!(out, "**`{}` does not hold:** {}.\n\n", record.claim, reasons.join("; "));
        }
    }
    out.push_str("<details><summary>Rung by rung</summary>\n\n");
    for record in records {
        rungs(out, record);
    }
    out.push_str("</details>\n\n");
}

fn claim_row(record: &Record) -> Vec<String> {
    let largest = record.samples.iter().max_by(|a, b| a.error.total_cmp(&b.error));
    let last = record.samples.last();
    let at = |s: &crate::claim::Sample| {
        format!("{} at {} = {}", scientific(s.error), symbol(&record.parameter), s.parameter)
    };
    let error = match (largest, last) {
        (Some(a), Some(b)) if record.samples.len() > 1 && a.parameter.to_bits() != b.parameter.to_bits() => {
            format!("{}; largest {}", at(b), at(a))
        }
        (_, Some(b)) => at(b),
        _ => "–".to_owned(),
    };
    let order = match &record.order {
        Some(o) if o.at_least => {
            format!("{} (at least {})", order(record), significant(o.expected - o.band, 3))
        }
        Some(o) => format!("{} (expected {} ± {})", order(record), o.expected, o.band),
        None => "–".to_owned(),
    };
    let uncertainty = if record.reference_uncertainty > 0.0 {
        format!(" (known to {} relative)", scientific(record.reference_uncertainty))
    } else {
        String::new()
    };
    let tolerance = &record.tolerance;
    vec![
        format!("{}<br>`{}` [{}]", record.title, record.claim, record.tags.join(", ")),
        format!("{}; against {}{uncertainty}. {}", record.measures, record.reference, metric(record.metric)),
        error,
        order,
        format!("{} at {}: {}", scientific(tolerance.value), tolerance.applies_to, tolerance.because),
        scientific(record.slack),
        if record.passed() { "holds" } else { "**fails**" }.to_owned(),
    ]
}

fn metric(metric: Metric) -> &'static str {
    match metric {
        Metric::L2 => "Relative L2 norm.",
        Metric::LInf => "Relative largest difference.",
        Metric::Relative => "Relative difference.",
        Metric::Absolute => "Absolute difference.",
    }
}

fn rungs(out: &mut String, record: &Record) {
    let _ = write!(out, "`{}`\n\n", record.claim);
    let mut extras: Vec<&str> =
        record.samples.iter().flat_map(|s| s.extra.keys()).map(String::as_str).collect();
    extras.sort_unstable();
    extras.dedup();
    let mut columns = vec![record.parameter.as_str(), "computed", "reference", "error"];
    columns.extend(&extras);
    let row = |s: &crate::claim::Sample| {
        let mut row = vec![s.parameter.to_string(), significant(s.computed, 8), significant(s.reference, 8)];
        row.push(scientific(s.error));
        row.extend(extras.iter().map(|&e| s.extra.get(e).map_or(String::new(), |&x| significant(x, 4))));
        row
    };
    let rows: Vec<Vec<String>> = record.samples.iter().map(row).collect();
    table(out, &columns, &rows);
    let Some(order) = &record.order else { return };
    let pairs: Vec<String> = order.fitted.pairwise.iter().map(|p| format!("{p:.3}")).collect();
    let _ = write!(out, "Order between neighbouring rungs: {}.", pairs.join(", "));
    if let Some(r) = order.richardson {
        let index = scientific(r.grid_convergence_index);
        let _ = write!(out, " Extrapolated: {}; grid convergence index {index}.", significant(r.value, 8));
    }
    out.push_str("\n\n");
}

fn exhibit(out: &mut String, caption: &str, record: &ExhibitRecord) {
    let _ = write!(out, "### {}\n\n", heading(&record.exhibit));
    let _ = write!(out, "{caption}\n\n");
    for (name, plot) in figures::of_exhibit(record) {
        let _ = write!(out, "![{}](golden/figures/{name})\n\n", plot.title);
    }
    for t in &record.data.tables {
        let _ = write!(out, "**{}**\n\n", t.title);
        let columns: Vec<&str> = t.columns.iter().map(String::as_str).collect();
        let entry = |e: &Entry| match e {
            Entry::Text(text) => text.clone(),
            Entry::Number(x) => significant(*x, 4),
        };
        let rows: Vec<Vec<String>> = t.rows.iter().map(|r| r.iter().map(entry).collect()).collect();
        table(out, &columns, &rows);
    }
    for note in &record.data.notes {
        let _ = write!(out, "{note}\n\n");
    }
}

/// `speed-against-error` becomes `Speed against error`.
fn heading(id: &str) -> String {
    let words = id.replace('-', " ");
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |c| c.to_uppercase().chain(letters).collect())
}

fn validation(out: &mut String, chapters: &[Chapter]) {
    let records: Vec<&Record> =
        chapters.iter().flat_map(|c| &c.records).filter(|r| r.kind == Kind::Validation).collect();
    out.push_str(
        "## Validation\n\nComparison with experiments, kept apart from comparison with mathematics.\n\n",
    );
    if records.is_empty() {
        out.push_str("*None in this version: it has no free surface and no grains yet.*\n\n");
    } else {
        claims(out, &records);
    }
}

fn mutants(out: &mut String, chapters: &[Chapter]) {
    let all: Vec<&MutantRecord> = chapters.iter().flat_map(|c| &c.mutants).collect();
    out.push_str("## Mutants\n\n");
    if all.is_empty() {
        out.push_str("*None yet.*\n\n");
        return;
    }
    let caught = all.iter().filter(|m| m.caught).count();
    let unmeasured = all.iter().filter(|m| m.detection == Detection::NoResult).count();
    let rate = 100.0 * caught as f64 / all.len() as f64;
    let _ = write!(
        out,
        "Detection rate: **{caught} of {} ({rate:.0} %)**. Each row is one deliberate mistake, the claim that \
         has to fail on it, and what that claim measured. Where that is \"no result\", a guard stopped the run \
         or it did not settle, while the honest run does settle ({unmeasured} of the detections).\n\n",
        all.len()
    );
    let row = |m: &&MutantRecord| {
        let source = format!("{}<br>`{}`", m.erratum, m.mutant);
        let error = format!("{} against a tolerance of {}", scientific(m.error), scientific(m.tolerance));
        let against = match m.detection {
            Detection::NoResult => "no result".to_owned(),
            Detection::Order => format!("{error}; the order is off"),
            Detection::Error | Detection::Escaped => error,
        };
        let word = if m.caught { "caught" } else { "**escaped**" };
        vec![source, m.description.clone(), format!("`{}`", m.caught_by), against, word.to_owned()]
    };
    let rows: Vec<Vec<String>> = all.iter().map(row).collect();
    table(out, &["source", "mistake", "claim", "error", "outcome"], &rows);
    for m in all.iter().filter(|m| !m.caught) {
        let _ = write!(out, "`{}` escaped: {}.\n\n", m.mutant, m.how);
    }
}

fn limits(out: &mut String, chapters: &[Chapter]) {
    let limits: Vec<&String> = chapters.iter().flat_map(|c| &c.limits).collect();
    out.push_str("## Known limits\n\n");
    for limit in &limits {
        let _ = writeln!(out, "- {limit}");
    }
    out.push_str(if limits.is_empty() { "*None recorded yet.*\n\n" } else { "\n" });
}

/// The only part of the report that holds wall-clock times.
fn speeds(out: &mut String, chapters: &[Chapter]) {
    let timed = chapters.iter().flat_map(|c| &c.exhibits);
    let timed = timed.filter_map(|(caption, record)| Some((caption, record, record.measured.as_ref()?)));
    for (k, (caption, record, measured)) in timed.enumerate() {
        if k == 0 {
            out.push_str(
                "## Measured speeds\n\nThese numbers depend on the machine and are not compared with anything.\n\n",
            );
        }
        exhibit(out, caption, record);
        let size = if record.full { "" } else { " Short form." };
        let _ = write!(out, "*Measured {} on {}.{size}*\n\n", measured.date, measured.machine);
    }
}
