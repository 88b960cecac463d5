//! Running until nothing changes any more.
//!
//! One number per check is easily fooled. A cell that alternates from step to step looks still to checks an even number of
//! steps apart; a relaxation of memory M changes by less than a tolerance t per interval T while it still has t M/T to go.
//! Hence three questions at two checks in a row: how much changes, what is left of the change by its own decay, and
//! whether the momentum still grows by more than a share t of what the body force brings in; and in between a window of
//! looks at successive steps.

use super::run::{Fields, Run, Stopped};
use crate::state::state;

mod outcome;
#[cfg(test)]
mod tests;

pub use outcome::SteadyOutcome;

/// When a flow counts as steady.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteadyRule {
    /// Bound on the residual (largest change of velocity between checks, over the largest speed), on the change that is
    /// still to come, and on the difference between any two steps.
    pub tolerance: f64,
    /// Steps between checks.
    pub interval: u64,
    /// Steps after which the attempt ends.
    pub max_steps: u64,
}

/// Relative differences that rounding alone can keep up for ever: 16 digits less four, for speeds of 1e-4 on top of
/// pressures of 1.
const ROUNDING: f64 = 1e-12;

/// Longest memory of a flow that is looked for, intervals between checks.
const MEMORY: f64 = 1e5;

/// Successive steps of a window: cycles of 2, 3, 4, 6 and 12 steps close in each half of it.
const WINDOW: u64 = 24;

/// Looks at a flow until it is steady or its time is over. Knows nothing of the run: it is shown fields.
pub(crate) struct Watch {
    tolerance: f64,
    /// Steps between checks; number k is due at round(k · interval) after the first look.
    interval: f64,
    start: u64,
    last: u64,
    /// Step of the latest look.
    now: u64,
    count: u64,
    before: Option<Seen>,
    /// Change at the last check.
    change: Option<Change>,
    /// Whether the last check found nothing that changes.
    candidate: bool,
    window: Option<Window>,
    /// Whether only the diagnosis before the last step is left.
    ending: bool,
    found: SteadyOutcome,
}

/// What is remembered of a look.
#[derive(Default)]
struct Seen {
    step: u64,
    velocity: Vec<[f64; 3]>,
    momentum: [f64; 3],
}

/// Change from check to check, per step and over the largest speed then; single precision is enough for its direction.
#[derive(Default)]
struct Change {
    steps: f64,
    rate: Vec<[f32; 3]>,
}

/// Looks after a check, compared with it.
#[derive(Default)]
struct Window {
    /// Steps at which to look, the next one last.
    due: Vec<u64>,
    from: u64,
    /// Largest difference from the check, over the largest speed.
    swing: f64,
    /// Sum over the first half of the successive steps less that over the second.
    halves: Vec<[f64; 3]>,
}

state!(Watch: now count before change candidate window ending found; but tolerance interval start last);
state!(Seen: step velocity momentum);
state!(Change: steps rate);
state!(Window: due from swing halves);

impl Watch {
    /// A watch whose first look is at step `start`, and whose last is at step `last`; `interval`: steps between checks.
    pub fn new(tolerance: f64, interval: f64, start: u64, last: u64) -> Self {
        Self {
            tolerance,
            interval: if interval < 1.0 { 1.0 } else { interval },
            start,
            last,
            now: start,
            count: 1,
            before: None,
            change: None,
            candidate: false,
            window: None,
            ending: false,
            found: SteadyOutcome::unknown(tolerance),
        }
    }

    /// What is known now.
    pub const fn outcome(&self) -> SteadyOutcome {
        self.found
    }

    /// Step of the next look.
    pub fn next(&self) -> u64 {
        if self.before.is_none() {
            return self.start;
        }
        let look = self.window.as_ref().and_then(|window| window.due.last().copied());
        let check = if self.ending { self.last } else { self.check().min(self.diagnosis()) };
        look.unwrap_or(check).min(self.last)
    }

    /// Step of the next check; the cast saturates, which is never.
    fn check(&self) -> u64 {
        self.start.saturating_add((self.count as f64 * self.interval).round() as u64)
    }

    /// Step from which a run that is not steady is looked at once more, to say why.
    fn diagnosis(&self) -> u64 {
        let step = self.last.saturating_sub(WINDOW);
        if step > self.now { step } else { self.last }
    }

    /// Looks at the flow at `step`, which must be [`Self::next`]; `push`: body force times the volume it acts on. Says
    /// whether the flow is steady.
    pub fn look(&mut self, step: u64, fields: &Fields, push: f64) -> bool {
        self.now = step;
        self.found.steps = step - self.start;
        if self.before.is_none() {
            self.before = Some(Seen::at(step, fields));
            return false;
        }
        if self.window.is_some() {
            self.compare(step, fields);
            return false;
        }
        if self.ending {
            return false;
        }
        if step < self.check() {
            self.ending = true;
            self.open(step, fields);
            return false;
        }
        self.judge(step, fields, push)
    }

    /// One look of the window.
    fn compare(&mut self, step: u64, fields: &Fields) {
        let limit = self.limit();
        let (Some(window), Some(base)) = (&mut self.window, &self.before) else { return };
        window.look(step, &base.velocity, &fields.velocity);
        self.found.swing = Some(window.swing);
        if window.due.is_empty() {
            let drift = window.drift(&fields.velocity);
            // Of a steady change the halves differ by half the swing.
            self.found.alternates = window.swing > limit && drift < 0.1 * window.swing;
            self.window = None;
        }
    }

    /// Bound on what rounding may keep up.
    const fn limit(&self) -> f64 {
        self.tolerance.max(ROUNDING)
    }

    /// A check.
    fn judge(&mut self, step: u64, fields: &Fields, push: f64) -> bool {
        let now = Seen::at(step, fields);
        let Some(before) = self.before.take() else { return false };
        let speed = largest(&now.velocity);
        let unit = if speed > 0.0 { speed } else { 1.0 };
        let change = Change::between(&before, &now, unit);
        self.found.residual = residual(&before.velocity, &now.velocity);
        self.found.remaining = remaining(self.found.residual, self.change.as_ref(), &change);
        self.found.imbalance = imbalance(&before, &now, push, self.tolerance, fields);
        self.before = Some(now);
        self.change = Some(change);
        while self.check() <= step {
            self.count += 1;
        }
        let quiet = self.found.residual <= self.tolerance
            && self.found.remaining <= self.limit()
            && self.found.imbalance <= 1.0;
        let still = self.found.swing.is_some_and(|swing| swing <= self.limit());
        self.found.steady = quiet && self.candidate && still;
        self.candidate = quiet;
        if quiet && !self.found.steady {
            self.open(step, fields);
        }
        self.found.steady
    }

    /// Opens a window at `step`.
    fn open(&mut self, step: u64, fields: &Fields) {
        let mut due: Vec<u64> = (1..=WINDOW).map(|k| step + k).collect();
        // Half the interval, its half, and so on: a cycle of any number of steps that fits the interval shows at one of
        // them, for the odd part of the number of its turns is halved.
        let mut apart = (0.5 * self.interval) as u64;
        while apart > WINDOW && !self.ending {
            due.push(step + apart);
            apart /= 2;
        }
        due.sort_unstable_by(|a, b| b.cmp(a));
        due.retain(|&at| at <= self.last);
        let Some(&end) = due.first() else { return };
        while self.check() <= end {
            self.count += 1;
        }
        if self.ending {
            self.before = Some(Seen::at(step, fields));
        }
        self.found.swing = None;
        self.found.alternates = false;
        let halves = vec![[0.0; 3]; fields.velocity.len()];
        self.window = Some(Window { due, from: step, swing: 0.0, halves });
    }
}

impl Seen {
    fn at(step: u64, fields: &Fields) -> Self {
        let mut momentum = [0.0; 3];
        for (cell, u) in fields.velocity.iter().enumerate() {
            let mass = mass(fields, cell);
            for a in 0..3 {
                momentum[a] += mass * u[a];
            }
        }
        Self { step, velocity: fields.velocity.clone(), momentum }
    }
}

impl Window {
    fn look(&mut self, step: u64, base: &[[f64; 3]], now: &[[f64; 3]]) {
        self.due.pop();
        let difference = residual(base, now);
        // A NaN stays.
        self.swing = if difference <= self.swing { self.swing } else { difference };
        let apart = step - self.from;
        if apart > WINDOW {
            return;
        }
        let sign = if 2 * apart <= WINDOW { 1.0 } else { -1.0 };
        for (sum, u) in self.halves.iter_mut().zip(now) {
            for a in 0..3 {
                sum[a] += sign * u[a];
            }
        }
    }

    /// Largest difference between the means over the halves, over the largest speed.
    fn drift(&self, now: &[[f64; 3]]) -> f64 {
        let speed = largest(now);
        let difference = largest(&self.halves) / (0.5 * WINDOW as f64);
        if speed > 0.0 { difference / speed } else { difference }
    }
}

/// Mass of a cell; solid and gas cells do not move.
fn mass(fields: &Fields, cell: usize) -> f64 {
    fields.density[cell] * fields.fill.get(cell).copied().unwrap_or(1.0)
}

/// Largest component.
fn largest(velocity: &[[f64; 3]]) -> f64 {
    velocity.iter().flatten().fold(0.0, |most: f64, u| most.max(u.abs()))
}

/// Largest change between two velocity fields over the largest speed of the second; zero when both rest.
#[must_use]
pub(crate) fn residual(before: &[[f64; 3]], after: &[[f64; 3]]) -> f64 {
    let mut change = 0.0_f64;
    let mut speed = 0.0_f64;
    for (u, v) in before.iter().zip(after) {
        for a in 0..3 {
            change = change.max((v[a] - u[a]).abs());
            speed = speed.max(v[a].abs());
        }
    }
    if speed > 0.0 { change / speed } else { change }
}

impl Change {
    /// In units of `unit`.
    fn between(before: &Seen, now: &Seen, unit: f64) -> Self {
        let steps = (now.step - before.step) as f64;
        let scale = 1.0 / (unit * steps);
        let rate = |(u, v): (&[f64; 3], &[f64; 3])| std::array::from_fn(|a| ((v[a] - u[a]) * scale) as f32);
        Self { steps, rate: before.velocity.iter().zip(&now.velocity).map(rate).collect() }
    }
}

/// What is still to come of a change d that goes on as it did: d r/(1 − r), r the decay over as many steps as d took. It
/// follows from the part of the last rate of change along the one before it, Σδ·δ′/Σδ′·δ′, whose middles lie half of both
/// spans apart. What alternates or is noise has r ≤ 0 and adds nothing; what does not decay goes on for [`MEMORY`] spans.
fn remaining(residual: f64, before: Option<&Change>, now: &Change) -> f64 {
    if residual == 0.0 {
        return 0.0;
    }
    let Some(before) = before else { return f64::INFINITY };
    let (mut along, mut square) = (0.0, 0.0);
    for (d, e) in now.rate.iter().zip(&before.rate) {
        for a in 0..3 {
            along += f64::from(d[a]) * f64::from(e[a]);
            square += f64::from(e[a]) * f64::from(e[a]);
        }
    }
    let decay = along / square;
    if decay <= 0.0 {
        return 0.0;
    }
    let ratio = libm::pow(decay, 2.0 * now.steps / (now.steps + before.steps));
    let spans = if ratio < 1.0 { ratio / (1.0 - ratio) } else { MEMORY };
    residual * spans.min(MEMORY)
}

/// Rate of change of the momentum over the share `tolerance` of the body force; 0 without a force, or where the change is
/// rounding: a flow that gains momentum at the rate r f is brought to its speed u by f in u/f, and in that time r f adds r u.
fn imbalance(before: &Seen, now: &Seen, push: f64, tolerance: f64, fields: &Fields) -> f64 {
    if push == 0.0 {
        return 0.0;
    }
    let norm = |v: [f64; 3]| libm::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    let gained = norm(std::array::from_fn(|a| now.momentum[a] - before.momentum[a]));
    let all =
        fields.velocity.iter().enumerate().fold(0.0, |sum, (cell, u)| sum + mass(fields, cell) * norm(*u));
    if gained <= ROUNDING * all {
        return 0.0;
    }
    gained / (tolerance * push * (now.step - before.step) as f64)
}

/// Body force times the volume of fluid it acts on, lattice units.
pub(crate) fn push(run: &dyn Run) -> f64 {
    let force = run.setup().force.at(run.step());
    libm::sqrt(force.iter().fold(0.0, |sum, f| sum + f * f)) * run.fluid_cells() as f64
}

/// Advances until the flow is steady or the steps are used up.
///
/// Steady: at two checks in a row the residual and the change that is still to come (by the decay from check to check) are
/// within the tolerance, the momentum changes by no more than that share of the body force, and no look at one of the 24
/// steps after the first of them, nor halves of the interval later, differs from it by more than the tolerance.
///
/// # Errors
/// A guard stopped the run.
pub fn run_to_steady(run: &mut dyn Run, rule: SteadyRule) -> Result<SteadyOutcome, Stopped> {
    let start = run.step();
    let last = start.saturating_add(rule.max_steps);
    let mut watch = Watch::new(rule.tolerance, rule.interval as f64, start, last);
    loop {
        let due = watch.next();
        run.advance(due - run.step())?;
        let steady = watch.look(due, &run.fields(), push(run));
        if steady || due >= last {
            return Ok(watch.outcome());
        }
    }
}
