//! The table a study prints.

use std::fmt::Write as _;

use super::{Results, Study};
use crate::format::{order, scientific};
use crate::record::{Record, Verdict};

/// The table of claims, then what failed and why, then exhibits and mutants.
pub(super) fn render(study: &Study, results: &Results) -> String {
    let mut out = format!("{}\n\n", study.title);
    if !results.records.is_empty() {
        let head = ["claim", "rungs", "errors", "order", "tolerance", "slack", "verdict"];
        let mut rows = vec![head.map(str::to_owned).to_vec()];
        rows.extend(results.records.iter().map(|(_, r)| row(r)));
        out.push_str(&aligned(&rows));
    }
    for (_, record) in &results.records {
        if let Verdict::Fail { reasons } = &record.verdict {
            for reason in reasons {
                let _ = writeln!(out, "FAIL {}: {reason}", record.claim);
            }
        }
    }
    for (exhibit, record) in &results.exhibits {
        let _ = match record {
            Ok(_) => writeln!(out, "exhibit {}", exhibit.id),
            Err(error) => writeln!(out, "FAIL exhibit {}: {error}", exhibit.id),
        };
    }
    for (mutant, record) in &results.mutants {
        let word = if record.caught { "caught" } else { "ESCAPED" };
        let _ = writeln!(out, "mutant {} {word} by {}: {}", mutant.id, mutant.caught_by, record.how);
    }
    let held = results.records.iter().filter(|(_, r)| r.passed()).count();
    let caught = results.mutants.iter().filter(|(_, m)| m.caught).count();
    let _ = writeln!(
        out,
        "\n{held} of {} claims hold, {caught} of {} mutants caught.",
        results.records.len(),
        results.mutants.len()
    );
    out
}

fn row(record: &Record) -> Vec<String> {
    let symbol = crate::ladder::symbol(&record.parameter);
    let rungs: Vec<String> = record.samples.iter().map(|s| s.parameter.to_string()).collect();
    let errors: Vec<String> = record.samples.iter().map(|s| scientific(s.error)).collect();
    vec![
        record.claim.clone(),
        format!("{symbol} = {}", rungs.join(" ")),
        errors.join(" "),
        order(record),
        scientific(record.tolerance.value),
        scientific(record.slack),
        if record.passed() { "pass" } else { "FAIL" }.to_owned(),
    ]
}

/// Columns padded to equal width, two blanks apart.
fn aligned(rows: &[Vec<String>]) -> String {
    let columns = rows.first().map_or(0, Vec::len);
    let width = |c: usize| rows.iter().map(|r| r[c].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut out = String::new();
    for row in rows {
        let cells = row.iter().zip(&widths).map(|(cell, &w)| format!("{cell:w$}"));
        out.push_str(cells.collect::<Vec<_>>().join("  ").trim_end());
        out.push('\n');
    }
    out
}
