//! When something is due, in steps.

use crate::scene::{Cadence, Scene};
use crate::units::Units;

/// Rows of the time series when the scene does not say.
const DEFAULT_ROWS: u32 = 100;

/// Steps of a time, at least one; saturates.
pub(crate) fn steps_until(time_s: f64, units: &Units) -> u64 {
    (units.time_to_lattice(time_s).round() as u64).max(1)
}

/// The recurring events of a run and its end.
pub(super) struct Schedule {
    pub end: u64,
    pub fields: Ticker,
    pub grains: Ticker,
    pub series: Ticker,
    pub steady: Ticker,
    pub arrested: Ticker,
}

impl Schedule {
    pub fn new(scene: &Scene, units: &Units, end: u64) -> Self {
        let ticker = |cadence: Cadence| Ticker::new(cadence, units, end);
        let steady = scene.stop.steady.map(|steady| Cadence::EverySeconds(steady.check_every_s));
        let arrested = scene.stop.arrested.map(|rule| Cadence::EverySeconds(rule.check_every_s));
        Self {
            end,
            arrested: arrested.map_or(Ticker::never(), ticker),
            fields: scene.output.fields.map_or(Ticker::never(), ticker),
            grains: scene.output.grains.map_or(Ticker::never(), ticker),
            series: ticker(scene.output.series.unwrap_or(Cadence::Count(DEFAULT_ROWS))),
            steady: steady.map_or(Ticker::never(), ticker),
        }
    }

    /// The next step after `now` at which anything is due.
    pub fn next(&self, now: u64) -> u64 {
        let checks = self.steady.next().min(self.arrested.next());
        let files = self.fields.next().min(self.grains.next());
        let next = files.min(self.series.next()).min(checks);
        next.clamp(now + 1, self.end.max(now + 1))
    }
}

/// A recurring event: number k is due at step round(k · interval).
pub(crate) struct Ticker {
    /// Steps between events, not rounded; infinite for never.
    interval: f64,
    count: u64,
}

impl Ticker {
    pub(crate) fn new(cadence: Cadence, units: &Units, end: u64) -> Self {
        let interval = match cadence {
            Cadence::EverySeconds(every) => units.time_to_lattice(every),
            Cadence::Count(count) => end as f64 / f64::from(count.max(1)),
        };
        Self { interval: if interval < 1.0 { 1.0 } else { interval }, count: 1 }
    }

    pub(crate) fn never() -> Self {
        Self { interval: f64::INFINITY, count: 1 }
    }

    /// Step of the next event.
    pub(crate) fn next(&self) -> u64 {
        // The cast saturates, which is never.
        (self.count as f64 * self.interval).round() as u64
    }

    /// Whether the event is due at `step`; moves on to the next one if so.
    pub fn take_if_due(&mut self, step: u64) -> bool {
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
}
