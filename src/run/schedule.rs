//! When something is due, in steps.

use crate::scene::dry::DryScene;
use crate::scene::{Arrested, Cadence, Scene};
use crate::state::state;
use crate::units::Units;

/// Rows of the time series when the scene does not say.
const DEFAULT_ROWS: u32 = 100;

/// Steps of a time, at least one; saturates.
pub(super) fn steps_until(time_s: f64, units: &Units) -> u64 {
    (units.time_to_lattice(time_s).round() as u64).max(1)
}

/// What a scene says about when things are due.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cadences {
    /// Rows of the time series.
    pub series: Option<Cadence>,
    /// Files: fields, or grains where there is no fluid.
    pub files: Option<Cadence>,
    /// Files of grains in a fluid; with the others when not given.
    pub grains: Option<Cadence>,
    /// When a run counts as at rest.
    pub arrested: Option<Arrested>,
}

/// Time between the rows of a series, s; `end`: end time of the scene, s.
pub(super) fn between_rows(series: Option<Cadence>, end: f64) -> f64 {
    match series.unwrap_or(Cadence::Count(DEFAULT_ROWS)) {
        Cadence::EverySeconds(every) => every,
        Cadence::Count(count) => end / f64::from(count.max(1)),
    }
}

impl Cadences {
    /// Of a scene with fluid.
    pub(crate) fn of_flow(scene: &Scene) -> Self {
        let (output, stop) = (&scene.output, &scene.stop);
        Self { series: output.series, files: output.fields, grains: output.grains, arrested: stop.arrested }
    }

    /// Of a scene without fluid.
    pub(crate) fn of_grains(scene: &DryScene) -> Self {
        let output = &scene.output;
        Self { series: output.series, files: output.grains, arrested: scene.stop.arrested, ..Self::default() }
    }
}

/// The recurring events of a run and its end.
pub(super) struct Schedule {
    /// Last step.
    pub end: u64,
    pub series: Ticker,
    pub files: Ticker,
    pub grains: Ticker,
    pub arrested: Ticker,
    /// Whether grains have no cadence of their own.
    grains_with_files: bool,
}

state!(Schedule: series files grains arrested; but end grains_with_files);

/// Files that are due.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct FilesDue {
    /// Fields, or grains where there is no fluid.
    pub files: bool,
    /// Grains in a fluid.
    pub grains: bool,
}

impl Schedule {
    /// `units` give the seconds of a step, `end` is the last step.
    pub fn new(cadences: &Cadences, units: &Units, end: u64) -> Self {
        let ticker = |cadence: Option<Cadence>| match cadence {
            Some(cadence) => Ticker::new(cadence, units, end),
            None => Ticker::never(),
        };
        let every = |seconds: Option<f64>| ticker(seconds.map(Cadence::EverySeconds));
        Self {
            end,
            series: ticker(Some(cadences.series.unwrap_or(Cadence::Count(DEFAULT_ROWS)))),
            files: ticker(cadences.files),
            grains: ticker(cadences.grains),
            arrested: every(cadences.arrested.map(|rule| rule.check_every_s)),
            grains_with_files: cadences.grains.is_none(),
        }
    }

    /// The next step after `now` at which anything is due.
    pub(crate) fn next(&self, now: u64) -> u64 {
        let files = self.files.next().min(self.grains.next());
        let next = files.min(self.series.next()).min(self.arrested.next());
        next.clamp(now + 1, self.end.max(now + 1))
    }

    /// The files due at `step`; `last`: all are.
    pub(crate) fn take_files(&mut self, step: u64, last: bool) -> FilesDue {
        let files = self.files.take_if_due(step) || last;
        let grains = self.grains.take_if_due(step) || last || (files && self.grains_with_files);
        FilesDue { files, grains }
    }
}

/// A recurring event: number k is due at step round(k · interval).
pub(super) struct Ticker {
    /// Steps between events, not rounded; infinite for never.
    interval: f64,
    count: u64,
}

state!(Ticker: count; but interval);

impl Ticker {
    fn new(cadence: Cadence, units: &Units, end: u64) -> Self {
        let interval = match cadence {
            Cadence::EverySeconds(every) => units.time_to_lattice(every),
            Cadence::Count(count) => end as f64 / f64::from(count.max(1)),
        };
        Self { interval: if interval < 1.0 { 1.0 } else { interval }, count: 1 }
    }

    fn never() -> Self {
        Self { interval: f64::INFINITY, count: 1 }
    }

    /// Step of the next event.
    fn next(&self) -> u64 {
        // The cast saturates, which is never.
        (self.count as f64 * self.interval).round() as u64
    }

    /// Whether the event is due at `step`; moves on to the next one if so.
    pub(crate) fn take_if_due(&mut self, step: u64) -> bool {
        let due = self.next() == step;
        if due {
            self.advance_past(step);
        }
        due
    }

    /// Moves on to the first event after `step`.
    fn advance_past(&mut self, step: u64) {
        while self.next() <= step {
            self.count += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_events_do_not_drift() {
        let units = Units::new(1.0, 0.3, 1.0);
        let mut ticker = Ticker::new(Cadence::EverySeconds(1.0), &units, 100);
        let mut steps = Vec::new();
        for _ in 0..4 {
            steps.push(ticker.next());
            ticker.advance_past(ticker.next());
        }
        // Thirds of 10: 3.33, 6.67, 10, 13.33.
        assert_eq!(steps, [3, 7, 10, 13]);
    }

    #[test]
    fn exact_count_ends_at_the_end() {
        let units = Units::new(1.0, 1.0, 1.0);
        let mut ticker = Ticker::new(Cadence::Count(3), &units, 100);
        ticker.advance_past(99);
        assert_eq!(ticker.next(), 100);
    }

    /// Grains of a fluid are written with its fields unless they have a cadence of their own.
    #[test]
    fn exact_files_due() {
        let units = Units::new(1.0, 1.0, 1.0);
        let due = |grains: Option<Cadence>| {
            let cadences = Cadences { files: Some(Cadence::Count(2)), grains, ..Cadences::default() };
            let mut schedule = Schedule::new(&cadences, &units, 100);
            [20, 50].map(|step| schedule.take_files(step, false))
        };
        let files = |files, grains| FilesDue { files, grains };
        assert_eq!(due(None), [files(false, false), files(true, true)]);
        assert_eq!(due(Some(Cadence::EverySeconds(20.0))), [files(false, true), files(true, false)]);
    }
}
