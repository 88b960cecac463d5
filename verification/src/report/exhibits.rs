//! Exhibits: captions, figures, tables.

use std::fmt::Write as _;

use super::text::{escaped, heading, paragraph};
use crate::exhibit::{Entry, ExhibitRecord};
use crate::figures;
use crate::format::{significant, table};

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
        let rows: Vec<Vec<String>> = t.rows.iter().map(|r| r.iter().map(entry).collect()).collect();
        table(out, &columns, &rows);
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
