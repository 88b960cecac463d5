//! The state of a run, to be continued from.

use super::run::PlainRun;
use super::surface::SurfacePhysics;
use crate::solver::physics::Physics;
use crate::state::{State, StateError, Tape, part};

impl<P: Physics, S: SurfacePhysics> PlainRun<P, S> {
    /// Writes or reads the state.
    ///
    /// # Errors
    /// As [`State::state`].
    pub(super) fn pass_state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        // Velocities of walls follow from the step, and are set before anything reads them.
        let Self {
            f,
            post,
            previous_omega,
            corrections,
            cuts,
            surface,
            grains,
            loads,
            step,
            setup: _,
            physics: _,
            links: _,
            hand_over: _,
            pool: _,
        } = self;
        tape.same(f.len())?;
        f.state(tape)?;
        post.state(tape)?;
        previous_omega.state(tape)?;
        corrections.state(tape)?;
        cuts.state(tape)?;
        part(surface, tape)?;
        part(grains, tape)?;
        loads.state(tape)?;
        step.state(tape)
    }
}
