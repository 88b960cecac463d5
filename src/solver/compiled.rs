//! Which laws and operators get a loop of their own. The bits are the same either way, the speed is not.

use super::physics::{Physics, Standard};
use crate::collision::Collision;
use crate::rheology::{Bingham, HerschelBulkley, Law, Newtonian, Rheology};
use crate::setup::Setup;

/// What is compiled anew for every kind of physics.
pub trait Compiled {
    /// What comes of it.
    type Result;

    /// Runs it.
    fn with<P: Physics>(self, physics: P) -> Self::Result;
}

/// In the unit tests of this crate all share one loop: the bits are the same, and the others would be compiled a second time for
/// them alone, for minutes.
const SHARED_ONLY: bool = cfg!(test);

/// A loop of its own for each of the laws that most scenes have, with this operator; the others, and several
/// fluids, share one.
pub(crate) fn with_own_loop<C: Collision, W: Compiled>(setup: &Setup, collision: C, work: W) -> W::Result {
    let &[law] = setup.fluids.as_slice() else { return with_shared_loop(setup, work) };
    if SHARED_ONLY {
        return with_shared_loop(setup, work);
    }
    match law {
        Law::Newtonian { mu } => work.with(standard(setup, Newtonian { mu }, collision)),
        Law::Bingham { sigma0, mu } => work.with(standard(setup, Bingham { sigma0, mu }, collision)),
        Law::HerschelBulkley { sigma0, k, n } => {
            work.with(standard(setup, HerschelBulkley::new(sigma0, k, n), collision))
        }
        Law::PowerLaw { .. } | Law::Papanastasiou { .. } => with_shared_loop(setup, work),
    }
}

/// A loop of its own for the Newtonian law only.
pub(crate) fn with_newtonian_loop<C: Collision, W: Compiled>(
    setup: &Setup,
    collision: C,
    work: W,
) -> W::Result {
    if SHARED_ONLY {
        return with_shared_loop(setup, work);
    }
    match *setup.fluids.as_slice() {
        [Law::Newtonian { mu }] => work.with(standard(setup, Newtonian { mu }, collision)),
        [] | [_] | [_, _, ..] => with_shared_loop(setup, work),
    }
}

/// The loop that chooses law and operator per cell.
pub(crate) fn with_shared_loop<W: Compiled>(setup: &Setup, work: W) -> W::Result {
    let laws = setup.fluids.iter().map(Law::prepare).collect();
    work.with(Standard::new(laws, setup.yielding, setup.collision))
}

fn standard<R: Rheology, C: Collision>(setup: &Setup, law: R, collision: C) -> Standard<R, C> {
    Standard::new(vec![law], setup.yielding, collision)
}
