//! What plans were worth, by kind of scene.

use super::outcome::{End, Outcome, Verdict};
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::plan::expected::{Kind, Scenes};

/// First scene: beyond those of the table that plans ask and of the claim.
const FIRST: u64 = 10_000;
/// Scenes.
const COUNT: u64 = 4000;
/// The same for the short form.
const FEW: u64 = 40;
/// Worst ones that are listed.
const WORST: usize = 12;

/// Scenes of a kind.
#[derive(Clone, Copy, Default)]
struct Counts {
    drawn: f64,
    refused: f64,
    outside: f64,
    unknown: f64,
    within: f64,
    beyond: f64,
    silent: f64,
    worst: f64,
}

impl Counts {
    fn add(&mut self, verdict: Verdict) {
        self.drawn += 1.0;
        match verdict {
            Verdict::Refused => self.refused += 1.0,
            Verdict::Outside => self.outside += 1.0,
            Verdict::Unknown => self.unknown += 1.0,
            Verdict::Within(_) => self.within += 1.0,
            Verdict::Beyond { times, warned } => {
                self.beyond += 1.0;
                self.silent += f64::from(u8::from(!warned));
                self.worst = self.worst.max(times);
            }
        }
    }
}

/// The counts and the worst.
pub const COUNTS: Exhibit = Exhibit {
    id: "scene-sweep-counts",
    caption: "Scenes that neither the rows nor the claim have: how many plans were refused, said that nothing like the scene was \
              measured, or that scenes like it were stopped; and of those with an interval how many kept it.",
    timed: false,
    run: |backend, full| {
        let numbers: Vec<u64> = (FIRST..FIRST + if full { COUNT } else { FEW }).collect();
        let outcomes = Outcome::of_all(backend, &numbers)?;
        Ok(ExhibitData { tables: vec![by_kind(&outcomes), worst(&outcomes)], ..ExhibitData::default() })
    },
};

fn by_kind(outcomes: &[Outcome]) -> Table {
    let mut counts = Kind::ALL.map(|_| Counts::default());
    for outcome in outcomes {
        counts[outcome.drawn.kind as usize].add(outcome.verdict(Scenes::built_in()));
    }
    let columns = [
        "kind",
        "drawn",
        "refused",
        "not like any",
        "like stopped ones",
        "within",
        "beyond",
        "of these not warned of",
        "largest error over its interval",
    ];
    let mut table = Table::new("What became of random scenes", &columns);
    for (kind, n) in Kind::ALL.into_iter().zip(counts) {
        let numbers =
            [n.drawn, n.refused, n.outside, n.unknown, n.within, n.beyond, n.silent, n.worst].map(Into::into);
        table.push(std::iter::once(kind.name().into()).chain(numbers).collect());
    }
    table
}

fn worst(outcomes: &[Outcome]) -> Table {
    let mut beyond: Vec<(f64, &Outcome)> = outcomes
        .iter()
        .filter_map(|outcome| match outcome.verdict(Scenes::built_in()) {
            Verdict::Beyond { times, .. } => Some((times, outcome)),
            _ => None,
        })
        .collect();
    beyond.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut table = Table::new(
        "The worst of them (`study-sweep --scene K` runs one)",
        &["scene", "what decides", "errors", "error over its interval", "warnings"],
    );
    for (times, outcome) in beyond.into_iter().take(WORST) {
        let End::Ran { expected, errors, warnings, .. } = &outcome.end else { continue };
        let like = expected.like().map_or_else(String::new, |like| like.to_string());
        let percent = errors.iter().filter(|error| !error.is_nan());
        let errors = percent.map(|error| format!("{:.2} %", 100.0 * error)).collect::<Vec<_>>().join(", ");
        table.push(vec![
            (outcome.number as f64).into(),
            like.into(),
            errors.into(),
            times.into(),
            (warnings.len() as f64).into(),
        ]);
    }
    table
}
