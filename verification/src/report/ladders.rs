//! Which rungs of which claims have been evaluated.

use std::fmt::Write as _;

use super::chapter::{Chapter, Entry};
use super::claim;
use super::page::{ended, file};
use super::text::{anchor, item, paragraph};
use crate::ladder::symbol;

/// Name of the page.
pub(super) const FILE: &str = "ladders.md";

/// Claims of whose full ladder some rungs were never evaluated.
pub(super) fn incomplete(chapter: &Chapter) -> Vec<&Entry> {
    chapter.claims.iter().filter(|c| !c.open_rungs().is_empty()).collect()
}

/// The page.
pub(super) fn render(chapters: &[Chapter]) -> String {
    let mut out = "# Ladders that were never run to their end\n\n".to_owned();
    paragraph(
        &mut out,
        "`cargo test` evaluates the short ladder of every claim, `cargo run --release --bin study-… -- --full` the full \
         one. These claims declare rungs that have no golden number.",
    );
    for (k, chapter) in chapters.iter().enumerate() {
        let claims = incomplete(chapter);
        if claims.is_empty() {
            continue;
        }
        let _ = write!(out, "## {}. {}\n\n", k + 1, chapter.title);
        claims.iter().for_each(|entry| item(&mut out, &line(k, chapter, entry)));
        out.push('\n');
    }
    ended(out)
}

fn line(k: usize, chapter: &Chapter, entry: &Entry) -> String {
    let id = &entry.record.claim;
    let rungs: Vec<String> = entry.open_rungs().iter().map(f64::to_string).collect();
    let run = entry.evaluation.as_ref();
    let run = run.map_or("unknown".to_owned(), |e| format!("{}, {}", claim::depth(e), claim::revision(e)));
    let symbol = symbol(&entry.record.parameter);
    format!("[{id}]({}#{}): {symbol} = {}; last run {run}", file(k, chapter), anchor(id), rungs.join(", "))
}
