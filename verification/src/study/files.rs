//! Writes the results of a study as JSON and SVG.

use std::path::Path;

use super::{Results, Study};
use crate::figures;
use crate::golden::{GoldenError, write as write_json};
use crate::record::Record;
use lahar::output::{atomic, svg};

/// Writes `records/`, `exhibits/`, `mutants/` and `figures/` into a folder.
pub(super) fn write(study: &Study, results: &Results, folder: &Path) -> Result<(), GoldenError> {
    for (claim, record) in &results.records {
        write_json(&folder.join("records").join(format!("{}.json", claim.id)), record)?;
    }
    for (mutant, record) in &results.mutants {
        write_json(&folder.join("mutants").join(format!("{}.json", mutant.id)), record)?;
    }
    let records: Vec<&Record> = results.records.iter().map(|(_, r)| r).collect();
    let mut plots = figures::convergence(study.id, &records);
    for (exhibit, record) in &results.exhibits {
        if let Ok(record) = record {
            write_json(&folder.join("exhibits").join(format!("{}.json", exhibit.id)), record)?;
            plots.extend(figures::of_exhibit(record));
        }
    }
    for (name, plot) in plots {
        atomic::write(&folder.join("figures").join(name), svg::draw(&plot)?.as_bytes())?;
    }
    Ok(())
}
