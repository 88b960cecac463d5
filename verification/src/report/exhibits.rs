//! Exhibits: captions, figures, tables.

use std::fmt::Write as _;

use super::text::{escaped, heading, paragraph};
use crate::exhibit::{Entry, ExhibitRecord};
use crate::figures;
use crate::format::{significant, table};

/// Most rows of a table that are printed; longer ones are for programs.
const LONG: usize = 100;
/// Rows that stand for a longer table.
const FIRST: usize = 10;

/// Appends an exhibit.
pub(super) fn render(out: &mut String, caption: &str, record: &ExhibitRecord) {
    let _ = write!(out, "### {}\n\n", heading(&record.exhibit));
    paragraph(out, caption);
    for (name, plot) in figures::of_exhibit(record) {
        let _ = write!(out, "![{}](../../golden/figures/{name})\n\n", plot.title);
    }
    for t in &record.data.tables {
        paragraph(out, &format!("**{}**", escaped(&t.title)));
        let columns: Vec<String> = t.columns.iter().map(|c| escaped(c)).collect();
        let columns: Vec<&str> = columns.iter().map(String::as_str).collect();
        let shown = if t.rows.len() > LONG { FIRST } else { t.rows.len() };
        let rows: Vec<Vec<String>> = t.rows[..shown].iter().map(|r| r.iter().map(entry).collect()).collect();
        table(out, &columns, &rows);
        if shown < t.rows.len() {
            let (more, name) = (t.rows.len() - shown, &record.exhibit);
            let file = format!("[{name}.json](../../golden/exhibits/{name}.json)");
            paragraph(out, &format!("{more} more rows are in {file}."));
        }
    }
    for note in &record.data.notes {
        paragraph(out, note);
    }
}

fn entry(entry: &Entry) -> String {
    match entry {
        Entry::Text(text) => escaped(text),
        Entry::Number(x) => significant(*x, 4),
    }
}

/// The exhibits with wall-clock times: nothing compares them with anything.
pub(super) fn speeds(out: &mut String, exhibits: &[(String, ExhibitRecord)]) {
    let timed = exhibits.iter().filter_map(|(caption, r)| Some((caption, r, r.measured.as_ref()?)));
    for (k, (caption, record, measured)) in timed.enumerate() {
        if k == 0 {
            out.push_str("## Measured speeds\n\n");
            paragraph(out, "These numbers depend on the machine and are not compared with anything.");
        }
        render(out, caption, record);
        let size = if record.full { "" } else { " Short form." };
        paragraph(out, &format!("*Measured {} on {}.{size}*", measured.date, measured.machine));
    }
}
