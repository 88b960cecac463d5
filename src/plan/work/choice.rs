//! Which run to choose for an error, and which error to expect of a run.

use super::{Case, Operator, Point, Scheme, Speed, Walls, Work};

/// Costs that differ by less than this factor count as equal: timings scatter by as much.
const ALIKE: f64 = 1.25;

/// A run and its cost.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// The run.
    pub point: Point,
    /// Fastest backend and nanoseconds per update with it, where they were measured.
    pub speed: Option<(String, f64)>,
}

impl Choice {
    /// Predicted seconds, one thread.
    #[must_use]
    pub fn seconds(&self) -> Option<f64> {
        self.speed.as_ref().map(|(_, nanoseconds)| 1e-9 * nanoseconds * self.point.updates)
    }
}

/// What the table says about a target error.
#[derive(Clone, Debug, PartialEq)]
pub enum Advice {
    /// The cheapest run that reaches it; of runs that cost about the same, the one with the scheme
    /// that comes first: central moments before TRT before BGK, \[B3\] before half-way walls.
    Reached(Choice),
    /// No run does; the most exact one.
    Missed(Choice),
    /// No run of this case gave a result.
    Empty,
}

fn fastest(speeds: &[Speed], case: Case, scheme: Scheme) -> Option<(String, f64)> {
    let these = speeds.iter().filter(|s| s.case == case && s.scheme == scheme);
    let least = these.min_by(|a, b| a.nanoseconds.total_cmp(&b.nanoseconds))?;
    Some((least.backend.clone(), least.nanoseconds))
}

/// Position in the order of preference.
fn rank(scheme: Scheme) -> (usize, usize) {
    let operator = Operator::ALL.iter().position(|o| *o == scheme.operator);
    let walls = Walls::ALL.iter().position(|w| *w == scheme.walls);
    (operator.unwrap_or(usize::MAX), walls.unwrap_or(usize::MAX))
}

/// The cheapest way to an error; cost in seconds, or in updates where no speed was measured.
#[must_use]
pub fn recommend(work: &Work, case: Case, target: f64) -> Advice {
    let choice = |point: &Point| Choice { point: *point, speed: fastest(&work.speeds, case, point.scheme) };
    let points: Vec<Choice> = work.points.iter().filter(|p| p.case == case).map(choice).collect();
    let timed = points.iter().all(|c| c.speed.is_some());
    let cost = |c: &Choice| c.seconds().filter(|_| timed).unwrap_or(c.point.updates);
    let within: Vec<&Choice> = points.iter().filter(|c| c.point.error <= target).collect();
    let Some(least) = within.iter().map(|c| cost(c)).reduce(f64::min) else {
        let best = points.iter().min_by(|a, b| a.point.error.total_cmp(&b.point.error));
        return best.map_or(Advice::Empty, |best| Advice::Missed(best.clone()));
    };
    let alike = within.into_iter().filter(|c| cost(c) <= ALIKE * least);
    let order = |a: &&Choice, b: &&Choice| {
        rank(a.point.scheme).cmp(&rank(b.point.scheme)).then(cost(a).total_cmp(&cost(b)))
    };
    alike.min_by(order).map_or(Advice::Empty, |best| Advice::Reached(best.clone()))
}

/// Error to expect of a scheme with N cells: between the runs of the time step nearest to `tau` on
/// logarithmic axes, beyond them by the slope of the nearest two (at most second order); `None`
/// without two runs. The second value says whether it lies outside the runs.
#[must_use]
pub fn predicted(work: &Work, case: Case, scheme: Scheme, tau: f64, n: f64) -> Option<(f64, bool)> {
    let these: Vec<&Point> = work.points.iter().filter(|p| p.case == case && p.scheme == scheme).collect();
    let distance = |p: &Point| libm::log((p.tau - 0.5) / (tau - 0.5)).abs();
    // Films and heaps have a τ that changes with N: steps are compared at the N nearest by.
    let near = these.iter().min_by(|a, b| {
        let apart = |p: &Point| libm::log(p.n / n).abs();
        apart(a).total_cmp(&apart(b)).then(distance(a).total_cmp(&distance(b)))
    })?;
    let mut ladder: Vec<[f64; 2]> =
        these.iter().filter(|p| p.step == near.step && p.error > 0.0).map(|p| [p.n, p.error]).collect();
    ladder.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let last = ladder.len().checked_sub(2)?;
    let i = ladder.iter().rposition(|p| p[0] <= n).unwrap_or(0).min(last);
    let ([a, e], [b, f]) = (ladder[i], ladder[i + 1]);
    let outside = n < a || n > b;
    let slope = libm::log(e / f) / libm::log(b / a);
    let slope = if outside { slope.clamp(0.0, 2.0) } else { slope };
    let [at, error] = if n > b { ladder[i + 1] } else { ladder[i] };
    Some((error * libm::pow(n / at, -slope), outside))
}
