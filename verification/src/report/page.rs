//! One chapter of the report, a file of its own.

use std::fmt::Write as _;

use super::chapter::{Chapter, Entry};
use super::text::{anchor, code_list, escaped, item, paragraph, paragraphs, unstopped};
use super::{claim, exhibits, mutants};
use crate::claim::Kind;
use crate::format::{scientific, table};

/// Name of a chapter's file: `03-poiseuille.md`.
pub(super) fn file(k: usize, chapter: &Chapter) -> String {
    format!("{:02}-{}.md", k + 1, chapter.id)
}

/// The page of the chapter at place `k`.
pub(super) fn render(k: usize, chapter: &Chapter) -> String {
    let mut out = format!("# {}. {}\n\n", k + 1, chapter.title);
    paragraph(
        &mut out,
        "Made from `golden/` by `cargo run --release --bin report`; [REPORT.md](../../REPORT.md) says how to read it.",
    );
    paragraphs(&mut out, &chapter.intro);
    overview(&mut out, chapter);
    let kinds = [
        (Kind::Verification, "Verification", ""),
        (
            Kind::PredictedFailure,
            "Predicted failures",
            "Theory says in numbers how the scheme, or a variant of it, goes wrong here. The claim is that it does so \
             as predicted.",
        ),
        (Kind::Validation, "Validation", "Comparison with experiments."),
    ];
    for (kind, heading, opening) in kinds {
        let claims = chapter.of(kind);
        if claims.is_empty() {
            continue;
        }
        let _ = write!(out, "## {heading}\n\n");
        if !opening.is_empty() {
            paragraph(&mut out, opening);
        }
        claims.iter().for_each(|c| claim::render(&mut out, chapter, c));
    }
    let shown: Vec<_> = chapter.exhibits.iter().filter(|(_, r)| r.measured.is_none()).collect();
    if !shown.is_empty() {
        out.push_str("## Exhibits\n\n");
    }
    shown.iter().for_each(|(caption, record)| exhibits::render(&mut out, caption, record));
    mutants::render(&mut out, &chapter.mutants);
    limits(&mut out, chapter);
    exhibits::speeds(&mut out, &chapter.exhibits);
    ended(out)
}

/// One row per claim.
fn overview(out: &mut String, chapter: &Chapter) {
    if !chapter.missing.is_empty() {
        let missing = code_list(chapter.missing.iter().map(String::as_str));
        paragraph(out, &format!("Declared but without a golden record yet: {missing}."));
    }
    if chapter.claims.is_empty() {
        paragraph(out, "*No results yet.*");
        return;
    }
    let columns = ["claim", "error", "tolerance", "which is", "last run", "verdict"];
    let rows: Vec<Vec<String>> = chapter.claims.iter().map(row).collect();
    table(out, &columns, &rows);
}

/// The error shown is the one closest to its tolerance.
fn row(entry: &Entry) -> Vec<String> {
    let record = &entry.record;
    let tolerance = record.tolerance.value;
    let error = if record.slack.is_infinite() { 0.0 } else { tolerance / record.slack };
    let run = entry.evaluation.as_ref();
    let run = run.map(|e| format!("{}, {}", claim::depth(e), claim::revision(e)));
    vec![
        format!("[{}](#{})", escaped(unstopped(&record.title)), anchor(&record.claim)),
        scientific(error),
        scientific(tolerance),
        claim::basis(entry.basis).to_owned(),
        run.unwrap_or_else(|| "unknown".to_owned()),
        if record.passed() { "holds" } else { "**fails**" }.to_owned(),
    ]
}

fn limits(out: &mut String, chapter: &Chapter) {
    if chapter.limits.is_empty() {
        return;
    }
    out.push_str("## Known limits\n\n");
    chapter.limits.iter().for_each(|limit| item(out, limit));
    out.push('\n');
}

/// The text with one line end at its end.
pub(super) fn ended(text: String) -> String {
    format!("{}\n", text.trim_end())
}
