//! The state of a run with its lists, to be continued from: unlike a [`super::checkpoint::Checkpoint`] it keeps when lists were
//! made, and what views and books say between steps.

use super::simulation::Dem;
use crate::state::{State, StateError, Tape, fixed};

impl State for Dem {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let Self {
            bodies,
            members,
            scenery,
            list,
            pairs,
            near,
            near_of,
            reference,
            external,
            gear,
            steps,
            rates,
            lost,
            external_work,
            rebuilds,
            offsets: _,
            table: _,
            period: _,
            step_setting: _,
            integrator: _,
            skin: _,
            overlap_limit: _,
        } = self;
        tape.same(bodies.len())?;
        bodies.state(tape)?;
        fixed(members, tape)?;
        scenery.state(tape)?;
        list.state(tape)?;
        pairs.state(tape)?;
        near.state(tape)?;
        near_of.state(tape)?;
        reference.state(tape)?;
        external.state(tape)?;
        gear.state(tape)?;
        steps.state(tape)?;
        rates.state(tape)?;
        lost.state(tape)?;
        external_work.state(tape)?;
        rebuilds.state(tape)
    }
}
