//! Mutants, those of a solver apart from those of a measurement.

use super::chapter::Tried;
use super::text::{anchor, escaped, item, paragraph, unstopped};
use crate::format::scientific;
use crate::mutant::Detection;

/// How many were caught, of how many.
#[must_use]
pub(super) fn count<'a>(mutants: impl Iterator<Item = &'a Tried>, in_solver: bool) -> (usize, usize) {
    let mutants: Vec<&Tried> = mutants.filter(|m| m.in_solver == in_solver).collect();
    (mutants.iter().filter(|m| m.record.caught).count(), mutants.len())
}

/// Appends the mutants of a chapter.
pub(super) fn render(out: &mut String, mutants: &[Tried]) {
    if mutants.is_empty() {
        return;
    }
    out.push_str("## Mutants\n\n");
    let kinds = [
        (true, "In a solver, on which the claim's own measurement runs:"),
        (
            false,
            "In the function that measures: a formula with the mistake, or a run of grains under a wrong rule. A wrong \
             formula shows that the claim can fail, not that the solver is watched:",
        ),
    ];
    for (in_solver, opening) in kinds {
        let of_kind: Vec<&Tried> = mutants.iter().filter(|m| m.in_solver == in_solver).collect();
        if of_kind.is_empty() {
            continue;
        }
        paragraph(out, opening);
        of_kind.iter().for_each(|m| item(out, &line(m)));
        out.push('\n');
    }
}

fn line(tried: &Tried) -> String {
    let m = &tried.record;
    let error = format!("error {} where {} is allowed", scientific(m.error), scientific(m.tolerance));
    let found = match m.detection {
        Detection::NoResult => "no result: a guard stopped the run, or it did not settle".to_owned(),
        Detection::Order => format!("{error}, but the order is off"),
        Detection::Error => error,
        Detection::Escaped => format!("**escapes**: {}", escaped(&m.how)),
    };
    let claim = format!("[{}](#{})", m.caught_by, anchor(&m.caught_by));
    format!("`{}`, {}: {}. Claim {claim}: {found}.", m.mutant, m.erratum, escaped(unstopped(&m.description)))
}
