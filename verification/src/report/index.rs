//! `REPORT.md`: how to read the report, what it holds, where it is.

use std::fmt::Write as _;

use super::chapter::{Chapter, Entry, Tried};
use super::text::{beginning, code_list, escaped, first_sentence, item, paragraph, unstopped};
use super::{FOLDER, equations, ladders, mutants, page};
use crate::claim::{Basis, Kind};
use crate::format::{scientific, table};
use crate::ladder::Depth;

const OPENING: &str = "\
This report lists every claim that lahar makes about its own correctness, and how far each can be trusted. It is \
made from the files in `golden/` by `cargo run --release --bin report`; a test fails when it is out of date. This \
page is the index; the chapters are in [verification/report](verification/report).";

const READING: [&str; 6] = [
    "A *claim* compares one measured quantity with a reference that is not lahar: a formula, a table, an experiment. \
     *Verification* is comparison with mathematics, *validation* with experiments; a *predicted failure* is an error \
     of the method that theory gives in numbers.",
    "It is evaluated on a *ladder* of rungs, usually resolutions. `cargo test` evaluates a short one, the study \
     programs with `--full` all of it.",
    "Its *tolerance* bounds the error. `D`, *derived*: from rounding, from the known error of the scheme, or from what \
     a theory leaves out. `R`, *of the reference*: its digits, its scatter, or the bound that a hard case asked for. \
     `S`, *set after seeing*: a constant was read off runs of lahar, or has no derivation; such a claim shows that \
     the error stays where it was found, not that it is as small as theory wants it.",
    "*Slack* is tolerance divided by error: 1.1 is a claim that just holds, 1000 a bound that could be sharper. The \
     *order* is the slope of a least-squares line through error against parameter in logarithms.",
    "A *mutant* is a deliberate mistake, most of them misprints of the source papers \
     ([docs/errata.md](docs/errata.md)), on which a named claim has to fail. A mutant of a solver shows that the \
     claim watches the solver; one of a measurement may show only that the claim can fail.",
    "Tags such as [K3] are equations of the method, [docs/method.md](docs/method.md); H1 to H20 are hard cases, \
     [docs/hard-cases.md](docs/hard-cases.md); formulas and tables to compare with are in \
     [docs/references.md](docs/references.md). 000, 001 and 004 are the source papers.",
];

/// Letters shown of a limit.
const LIMIT: usize = 150;

/// Makes the index.
pub(super) fn render(chapters: &[Chapter]) -> String {
    let mut out = "# What the numbers are worth\n\n".to_owned();
    paragraph(&mut out, OPENING);
    out.push_str("## How to read it\n\n");
    READING.iter().for_each(|text| item(&mut out, text));
    state(&mut out, chapters);
    summary(&mut out, chapters);
    claims(&mut out, chapters);
    validation(&mut out, chapters);
    limits(&mut out, chapters);
    equations::counts(&mut out, chapters);
    for (k, chapter) in chapters.iter().enumerate() {
        let _ = writeln!(out, "[{}]: {FOLDER}/{}", k + 1, page::file(k, chapter));
    }
    page::ended(out)
}

/// A chapter by number and title; where the link leads stands at the end of the page.
fn link(k: usize, chapter: &Chapter) -> String {
    format!("[{0}. {1}][{0}]", k + 1, chapter.title)
}

/// The only dated block: revisions, dates and machine of the numbers.
fn state(out: &mut String, chapters: &[Chapter]) {
    out.push_str("\n## State of the numbers\n\n");
    let entries: Vec<&Entry> = chapters.iter().flat_map(|c| &c.claims).collect();
    let runs: Vec<_> = entries.iter().filter_map(|c| c.evaluation.as_ref()).collect();
    let days = |pick: fn(Vec<&str>) -> Option<&str>| pick(runs.iter().map(|e| e.date.as_str()).collect());
    if let (Some(first), Some(last)) = (days(|d| d.into_iter().min()), days(|d| d.into_iter().max())) {
        let full = runs.iter().filter(|e| e.depth == Depth::Full).count();
        let text = format!(
            "Recorded between {first} and {last}. {full} claims were last evaluated on their full ladder, {} on the short \
             one; the chapters name the revision of each.",
            runs.len() - full
        );
        item(out, &text);
    }
    let timed = chapters.iter().flat_map(|c| &c.exhibits).filter_map(|(_, r)| r.measured.as_ref());
    let timed = distinct(timed.map(|m| m.machine.as_str()));
    let known = distinct(runs.iter().filter_map(|e| e.machine.as_deref()));
    if !timed.is_empty() || !known.is_empty() {
        let or_unknown =
            |list: Vec<&str>| if list.is_empty() { "unknown".to_owned() } else { list.join("; ") };
        let text = format!(
            "Machine of the claims: {}; of measured speeds: {}.",
            or_unknown(known),
            or_unknown(timed)
        );
        item(out, &text);
    }
    let open: Vec<usize> = chapters.iter().map(|c| ladders::incomplete(c).len()).collect();
    let rungs: usize = entries.iter().map(|c| c.open_rungs().len()).sum();
    let text = format!(
        "{} claims have {rungs} declared rungs that were never evaluated: [the list]({FOLDER}/{}).",
        open.iter().sum::<usize>(),
        ladders::FILE
    );
    item(out, &text);
    let all: usize = entries.iter().map(|c| c.record.samples.len()).sum();
    let unwatched: usize = entries.iter().map(|c| c.unwatched()).sum();
    let text = format!(
        "{unwatched} of {all} golden rungs are on no short ladder, and no test computes the exhibits: these numbers are as \
         good as the last run of their study. A seal on every file turns red where a digit is changed by hand; `verify --full` \
         evaluates all of them anew."
    );
    item(out, &text);
    out.push('\n');
}

fn distinct<'a>(words: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    words.collect::<std::collections::BTreeSet<_>>().into_iter().collect()
}

fn summary(out: &mut String, chapters: &[Chapter]) {
    out.push_str("## Summary\n\n");
    let mut rows: Vec<Vec<String>> = Vec::new();
    for (k, chapter) in chapters.iter().enumerate() {
        let title = link(k, chapter);
        rows.push(row(
            title,
            &chapter.claims.iter().collect::<Vec<_>>(),
            &chapter.mutants.iter().collect::<Vec<_>>(),
        ));
    }
    let claims: Vec<&Entry> = chapters.iter().flat_map(|c| &c.claims).collect();
    let tried: Vec<&Tried> = chapters.iter().flat_map(|c| &c.mutants).collect();
    rows.push(row("all".to_owned(), &claims, &tried));
    let columns = [
        "chapter",
        "claims that hold",
        "least slack",
        "D / R / S",
        "mutants of the solver",
        "of the measurement",
    ];
    table(out, &columns, &rows);
    let missing: Vec<&str> = chapters.iter().flat_map(|c| &c.missing).map(String::as_str).collect();
    if !missing.is_empty() {
        paragraph(out, &format!("Declared but without a golden record yet: {}.", code_list(missing)));
    }
}

fn row(title: String, claims: &[&Entry], tried: &[&Tried]) -> Vec<String> {
    let held = claims.iter().filter(|c| c.record.passed()).count();
    let least = claims.iter().map(|c| c.record.slack).reduce(f64::min).map_or("–".to_owned(), scientific);
    let of = |basis: Basis| claims.iter().filter(|c| c.basis == basis).count();
    let bases = [Basis::Derived, Basis::Reference, Basis::AfterSeeing].map(|b| of(b).to_string());
    let caught = |in_solver| match mutants::count(tried.iter().copied(), in_solver) {
        (_, 0) => "–".to_owned(),
        (caught, all) => format!("{caught} of {all} caught"),
    };
    vec![title, format!("{held} of {}", claims.len()), least, bases.join(" / "), caught(true), caught(false)]
}

/// One line per claim that is compared with mathematics.
fn claims(out: &mut String, chapters: &[Chapter]) {
    out.push_str("## Verification\n\n");
    paragraph(
        out,
        "`D`, `R`, `S`: what the tolerance stands on. `s`, `f`: last evaluated on the short or the full ladder. `p`: a \
         predicted failure.",
    );
    for (k, chapter) in chapters.iter().enumerate() {
        let mut claims = chapter.of(Kind::Verification);
        claims.extend(chapter.of(Kind::PredictedFailure));
        if claims.is_empty() {
            continue;
        }
        let _ = write!(out, "**{}**\n\n", link(k, chapter));
        claims.iter().for_each(|c| line(out, c));
        out.push('\n');
    }
}

fn line(out: &mut String, entry: &Entry) {
    let basis = match entry.basis {
        Basis::Derived => "D",
        Basis::Reference => "R",
        Basis::AfterSeeing => "S",
    };
    let run = entry.evaluation.as_ref().map_or("?", |e| match e.depth {
        Depth::Short => "s",
        Depth::Full => "f",
    });
    let predicted = if entry.record.kind == Kind::PredictedFailure { "p" } else { "" };
    let fails = if entry.record.passed() { "" } else { " **fails**" };
    let title = escaped(unstopped(&entry.record.title));
    let _ = writeln!(out, "- {title} `{basis}{run}{predicted}`{fails}");
}

fn validation(out: &mut String, chapters: &[Chapter]) {
    out.push_str("## Validation\n\n");
    paragraph(out, "Comparison with experiments, kept apart from comparison with mathematics.");
    for (k, chapter) in chapters.iter().enumerate() {
        for entry in chapter.of(Kind::Validation) {
            line(out, entry);
            let _ = writeln!(out, "  (chapter {})", link(k, chapter));
        }
    }
    if chapters.iter().all(|c| c.of(Kind::Validation).is_empty()) {
        out.push_str("*None.*\n");
    }
    out.push('\n');
}

/// The beginning of every limit, under the chapter that has the whole of it.
fn limits(out: &mut String, chapters: &[Chapter]) {
    out.push_str("## Known limits by topic\n\n");
    paragraph(out, "The beginning of each; the chapters have the rest.");
    for (k, chapter) in chapters.iter().enumerate().filter(|(_, c)| !c.limits.is_empty()) {
        let _ = write!(out, "**{}**\n\n", link(k, chapter));
        chapter.limits.iter().for_each(|limit| item(out, &beginning(first_sentence(limit), LIMIT)));
        out.push('\n');
    }
}
