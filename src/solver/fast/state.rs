//! The state of a run, to be continued from.

use super::block::Velocities;
use super::element::{Aligned, Element};
use super::layout::NONE;
use super::run::FastRun;
use super::surface::state::Surface;
use crate::solver::physics::Physics;
use crate::state::{State, StateError, Tape, part};

impl<P: Physics, E: Element> FastRun<P, E> {
    /// Writes or reads the state. Blocks follow from the set-up, but for which there are and their numbers.
    ///
    /// # Errors
    /// As [`State::state`].
    pub(super) fn pass_state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let blocks = self.blocks.iter().zip(&self.old);
        let mut places: Vec<(usize, bool)> =
            blocks.map(|(block, own)| (block.place, !own.is_empty())).collect();
        places.state(tape)?;
        if tape.reads() {
            self.lay_out(&places)?;
        }
        let Self {
            old,
            new,
            rim,
            cut_returned,
            density,
            lag,
            surface,
            grains,
            loads,
            fresh,
            step,
            fluid_cells,
            // What follows from the set-up and the blocks, and where time went.
            setup: _,
            physics: _,
            chosen: _,
            passes: _,
            layout: _,
            sources: _,
            velocities: _,
            blocks: _,
            hand_over: _,
            seconds: _,
            pool: _,
        } = self;
        old.iter_mut().chain(new).try_for_each(|populations| numbers(populations, tape))?;
        rim.state(tape)?;
        cut_returned.state(tape)?;
        density.state(tape)?;
        lag.state(tape)?;
        part(surface, tape)?;
        part(grains, tape)?;
        loads.state(tape)?;
        fresh.state(tape)?;
        step.state(tape)?;
        fluid_cells.state(tape)?;
        if tape.reads() && self.step > 0 {
            // The links of the last step are streamed by the next collision, with the velocities walls had then.
            self.step -= 1;
            self.move_walls();
            self.step += 1;
        }
        Ok(())
    }

    /// Makes the blocks at these places, and gives up those that are not there any more.
    fn lay_out(&mut self, places: &[(usize, bool)]) -> Result<(), StateError> {
        for place in 0..self.layout.places() {
            self.layout.set_block(place, NONE);
        }
        self.velocities = Velocities::default();
        self.blocks.clear();
        self.old.clear();
        self.new.clear();
        self.rim.clear();
        for list in [&mut self.cut_returned, &mut self.density, &mut self.lag] {
            list.clear();
        }
        self.surface.iter_mut().for_each(Surface::clear);
        let other = StateError::Malformed("it is of another set-up");
        for &(place, there) in places {
            if place >= self.layout.places() {
                return Err(other);
            }
            // A place may have got another block since one was given up there.
            let before = self.layout.block_at(place);
            let made =
                if self.surface.is_some() { self.add_surface_block(place) } else { self.add_block(place) };
            let Some(number) = made else { return Err(other) };
            if !there {
                self.give_up(number);
                self.layout.set_block(place, before);
                if let Some(surface) = &mut self.surface {
                    surface.free.clear();
                }
            }
        }
        Ok(())
    }
}

/// The numbers of an array, exactly.
fn numbers<E: Element>(array: &mut Aligned<E>, tape: &mut Tape<'_>) -> Result<(), StateError> {
    tape.same(array.get().len())?;
    for number in array.get_mut() {
        let mut wide = number.to_f64();
        wide.state(tape)?;
        *number = E::from_f64(wide);
    }
    Ok(())
}
