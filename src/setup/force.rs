//! The body force of a run.

/// Body force per volume (lattice units); enters as a constant force, not ρg \[L5\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BodyForce {
    /// The same at all times.
    Constant([f64; 3]),
    /// `mean + amplitude · cos(frequency · t + phase)`, t in steps, frequency in radians per step.
    Oscillating {
        /// Mean force.
        mean: [f64; 3],
        /// Amplitude.
        amplitude: [f64; 3],
        /// Angular frequency, radians per step.
        frequency: f64,
        /// Phase at step 0, radians.
        phase: f64,
    },
    /// `before` until step `at`, `after` from that step on.
    Stepped {
        /// Until the step `at`.
        before: [f64; 3],
        /// From the step `at` on.
        after: [f64; 3],
        /// Step of the change.
        at: u64,
    },
}

impl BodyForce {
    /// Force per volume at a step, lattice units.
    #[must_use]
    pub fn at(&self, step: u64) -> [f64; 3] {
        match *self {
            Self::Constant(force) => force,
            Self::Oscillating { mean, amplitude, frequency, phase } => {
                let swing = libm::cos(frequency * step as f64 + phase);
                std::array::from_fn(|a| mean[a] + amplitude[a] * swing)
            }
            Self::Stepped { before, after, at } => {
                if step < at {
                    before
                } else {
                    after
                }
            }
        }
    }

    /// A bound on the size of the force at any step: the largest, but for oscillations whose amplitude is not along their mean.
    #[must_use]
    pub fn largest(&self) -> f64 {
        let size = |v: &[f64; 3]| ((v[0] * v[0] + v[1] * v[1]) + v[2] * v[2]).sqrt();
        match self {
            Self::Constant(force) => size(force),
            Self::Oscillating { mean, amplitude, .. } => size(mean) + size(amplitude),
            Self::Stepped { before, after, .. } => size(before).max(size(after)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limit_of_a_force_at_any_step() {
        let swings = BodyForce::Oscillating {
            mean: [3.0, 0.0, 4.0],
            amplitude: [0.0, 2.0, 0.0],
            frequency: 0.3,
            phase: 0.1,
        };
        let steps = BodyForce::Stepped { before: [1.0, 0.0, 0.0], after: [0.0, -2.0, 0.0], at: 5 };
        assert_eq!(
            [BodyForce::Constant([0.0, -3.0, 4.0]).largest(), steps.largest(), swings.largest()],
            [5.0, 2.0, 7.0]
        );
        for force in [swings, steps] {
            let size = |v: [f64; 3]| (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
            assert!((0..50).all(|step| size(force.at(step)) <= force.largest()));
        }
    }
}
