//! Force and moment, and their mean over the time just gone.

use std::collections::VecDeque;

use crate::state::state;

/// Most parts that a window is kept in.
const PARTS: u64 = 256;

/// A force, N, and its moment about some point, N m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::run) struct Wrench {
    pub force: [f64; 3],
    pub moment: [f64; 3],
}

state!(Wrench: force moment);

impl Wrench {
    /// Both together.
    pub(super) fn plus(&self, other: &Self) -> Self {
        Self {
            force: std::array::from_fn(|a| self.force[a] + other.force[a]),
            moment: std::array::from_fn(|a| self.moment[a] + other.moment[a]),
        }
    }

    /// As many times as strong.
    pub(super) fn times(&self, factor: f64) -> Self {
        Self { force: self.force.map(|f| f * factor), moment: self.moment.map(|m| m * factor) }
    }
}

/// The mean over a window that moves on by a step, or by a 256th of itself where it is longer than that many steps.
#[derive(Clone, Debug)]
pub(super) struct MovingMean {
    /// Steps in a part.
    per_part: u64,
    /// Parts in a window.
    parts: usize,
    /// Sums over parts, oldest first.
    done: VecDeque<Wrench>,
    /// Sum over the part that is under way, and its steps so far.
    sum: Wrench,
    steps: u64,
}

state!(MovingMean: done sum steps; but per_part parts);

impl MovingMean {
    /// Over about so many steps, at least one.
    pub(super) fn over(steps: f64) -> Self {
        let steps = (steps.round() as u64).max(1);
        let per_part = steps.div_ceil(PARTS);
        let parts = ((steps as f64 / per_part as f64).round() as usize).max(1);
        Self { per_part, parts, done: VecDeque::new(), sum: Wrench::default(), steps: 0 }
    }

    /// Steps in the window.
    pub(super) fn steps(&self) -> u64 {
        self.per_part * self.parts as u64
    }

    /// Adds a step; the mean over the window that ends with it, if one does. Sums run from the oldest part on, so that no
    /// rounding stays when a part goes.
    pub(super) fn push(&mut self, step: &Wrench) -> Option<Wrench> {
        self.sum = self.sum.plus(step);
        self.steps += 1;
        if self.steps < self.per_part {
            return None;
        }
        if self.done.len() == self.parts {
            self.done.pop_front();
        }
        self.done.push_back(std::mem::take(&mut self.sum));
        self.steps = 0;
        let whole = self.done.len() == self.parts;
        let sum = || self.done.iter().fold(Wrench::default(), |sum, part| sum.plus(part));
        whole.then(|| sum().times(1.0 / self.steps() as f64))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(x: f64) -> Wrench {
        Wrench { force: [x, 0.0, 0.0], moment: [0.0, 2.0 * x, 0.0] }
    }

    #[test]
    fn exact_means_of_four_steps() {
        let mut mean = MovingMean::over(4.0);
        let found =
            [8.0, 0.0, 4.0, 0.0, 16.0].map(|x| mean.push(&step(x)).map(|w| (w.force[0], w.moment[1])));
        assert_eq!(found, [None, None, None, Some((3.0, 6.0)), Some((5.0, 10.0))]);
    }

    #[test]
    fn exact_lengths_of_windows() {
        assert_eq!([0.2, 1.4, 255.6, 256.0].map(|n| MovingMean::over(n).steps()), [1, 1, 256, 256]);
        // 1000 steps: 250 parts of 4.
        let mut mean = MovingMean::over(1000.0);
        assert_eq!((mean.steps(), mean.per_part), (1000, 4));
        let ends: Vec<usize> =
            (1..=1009).filter(|_| mean.push(&step(3.0)).is_some_and(|w| w == step(3.0))).collect();
        assert_eq!(ends, [1000, 1004, 1008]);
    }
}
