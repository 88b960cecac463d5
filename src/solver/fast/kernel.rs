//! The packed pass over one block: gather, collide, store.
//!
//! # Bytes per update
//! In f64 a cell costs 152 bytes read and 152 bytes written; stores past the cache do not read first what they
//! overwrite. In blocks of 8 × 8 × 8 cells a block also reads 156 lines of 64 bytes from the blocks beside it in
//! y and z: 19.5 bytes per cell more where these have left the cache by then, nothing where they have not. The
//! lines of the blocks before and behind it in x are read once for both. Hence 304 to 324 bytes: counted from
//! the layout, not measured at the memory, and without the entries of page tables.

use super::around::Around;
use super::block::Block;
use super::element::{Aligned, Element, MOST};
use super::registers::Registers;
use super::sources::{Sources, gather};
use super::stage::{Class, Stage};
use super::stores;
use super::task::{Outcome, Own, Task};
use crate::lane::Lane;
use crate::lattice::Q;
use crate::lattice::moments::Moments;
use crate::lattice::unroll::three;
use crate::solver::cell::runaway;
use crate::solver::physics::Physics;
use crate::solver::run::Stopped;

/// Packs between asking for a line of another block and using it: two microseconds, several times what memory
/// takes. Lines of the block itself are asked for a whole block earlier.
const FAR: usize = 16;

/// Collides every fluid cell of a block.
#[inline(always)]
pub(crate) fn pass<R: Registers, P: Physics>(
    task: &Task<P, R::Element>,
    own: &mut Own<R::Element>,
) -> Outcome {
    let mut outcome = Outcome::default();
    // Blocks that ran dry hold nothing.
    if task.old[own.number].is_empty() {
        return outcome;
    }
    let block = &task.blocks[own.number];
    let line = R::Element::PER_LINE;
    let around = task.around(own.number);
    let ahead = Ahead::new(task, own.number, &around);
    let straight = !task.sources.is_empty() && !task.fresh;
    let (mut stage, mut liquid) = (Stage::new(), [0.0; MOST]);
    // Where it is known when compiling that nothing is solved, what follows from ω⁺ is computed once per block.
    let solved = P::VARIES && task.physics.constant_omega().is_none();
    let rate = R::Pack::splat(task.physics.constant_omega().unwrap_or(0.0));
    for pack in 0..block.usable.len() {
        let local = pack * line;
        ahead.ask(pack);
        let class = Class::new(task, block, own.number, pack, line);
        if class.fluid == 0 {
            continue;
        }
        let ordinary = straight && class.ordinary;
        if !ordinary {
            let sources = task.sources.get(pack).filter(|_| straight);
            stage.fill::<R, P>(task, own, &around, sources, local);
            stage.mend(task, block, own, &class, local);
        }
        for part in (0..line).step_by(R::WIDTH) {
            let h = if ordinary {
                gather::<R>(&around, &task.sources[pack], part)
            } else {
                stage.load::<R>(part)
            };
            let force = force_of::<R, P>(task, &stage, &class, part);
            let m = task.physics.moments(&h, &force);
            let omega = if solved { omega::<R, P>(task, block, own, local + part, &m) } else { rate };
            guard::<R, P>(task, block, (local + part, class.fluid >> part), &m, omega, &mut outcome);
            keep::<R>(own, local + part, &m, omega);
            if !ordinary {
                stage.keep::<R>(&m, omega, part);
            } else if task.surface.is_some() {
                R::add_wide(m.d_rho, &mut liquid[part..]);
            }
            let post = task.physics.collide(&h, &m, omega);
            store::<R>(task.past_cache, own, &mut stage, &post, (pack, part));
        }
        if !ordinary {
            outcome.liquid_excess += stage.finish(block, own, &class, local);
        }
        if R::WIDTH != line {
            stage.write(task.past_cache, &mut own.new.get_mut()[pack * Q * line..][..Q * line]);
        }
    }
    outcome.liquid_excess = liquid.into_iter().fold(outcome.liquid_excess, |sum, x| sum + x);
    outcome
}

/// What is asked for long before it is used: lines of this block, of those after it, and of those around.
struct Ahead<'a, E> {
    packs: usize,
    /// The two blocks after this one.
    coming: [&'a [E]; 2],
    sources: &'a [Sources],
    around: &'a Around<'a, E>,
    /// Around the next block.
    around_next: Option<Around<'a, E>>,
}

impl<'a, E: Element> Ahead<'a, E> {
    #[inline(always)]
    fn new<P>(task: &Task<'a, P, E>, number: usize, around: &'a Around<'a, E>) -> Self {
        Self {
            packs: task.blocks[number].usable.len(),
            coming: [1, 2].map(|k| task.old.get(number + k).map_or(&[][..], Aligned::get)),
            sources: task.sources,
            around,
            around_next: task.around_next(number),
        }
    }

    /// Asks for what belongs to the pack [`FAR`] packs later: of this block, or beyond its end of the next.
    #[inline(always)]
    fn ask(&self, pack: usize) {
        let far = pack + FAR;
        if far < self.packs {
            prefetch_pack(self.coming[0], far);
        } else {
            prefetch_pack(self.coming[1], far - self.packs);
        }
        let later = match self.sources.get(far) {
            Some(later) => Some((self.around, later)),
            None => self.around_next.as_ref().zip(self.sources.get(far.wrapping_sub(self.packs))),
        };
        if let Some((around, sources)) = later {
            sources.prefetch_far(around);
        }
    }
}

/// Body force of one part of a pack.
#[inline(always)]
fn force_of<R: Registers, P: Physics>(
    task: &Task<P, R::Element>,
    stage: &Stage<R::Element>,
    class: &Class,
    part: usize,
) -> [R::Pack; 3] {
    if class.interface != 0 {
        return stage.load_force::<R>(part);
    }
    three(
        #[inline(always)]
        |a| R::Pack::splat(task.force[a]),
    )
}

/// Writes down what a block keeps of every cell: ω⁺, ρ − 1 and u, where it is asked for.
#[inline(always)]
fn keep<R: Registers>(own: &mut Own<R::Element>, local: usize, m: &Moments<R::Pack>, omega: R::Pack) {
    if !own.lag.is_empty() {
        R::store_wide(omega, &mut own.lag[local..]);
    }
    if !own.density.is_empty() {
        R::store_wide(m.d_rho, &mut own.density[local..]);
    }
    if !own.velocity.is_empty() {
        let cells = own.velocity.len() / 3;
        for a in 0..3 {
            R::store_wide(m.u[a], &mut own.velocity[a * cells + local..]);
        }
    }
}

/// Stores one part of a pack where it fills whole lines, else puts it on the stage.
#[inline(always)]
fn store<R: Registers>(
    past_cache: bool,
    own: &mut Own<R::Element>,
    stage: &mut Stage<R::Element>,
    post: &[R::Pack; Q],
    (pack, part): (usize, usize),
) {
    let line = R::Element::PER_LINE;
    if R::WIDTH != line {
        return stage.store::<R>(post, part);
    }
    let to = &mut own.new.get_mut()[pack * Q * line..][..Q * line];
    if past_cache {
        for i in 0..Q {
            R::store_past_cache(post[i], &mut to[i * line..]);
        }
    } else {
        for i in 0..Q {
            R::store(post[i], &mut to[i * line..]);
        }
    }
}

/// Asks for the lines of a pack of a block to come.
#[inline(always)]
fn prefetch_pack<E: Element>(block: &[E], pack: usize) {
    for i in 0..Q {
        stores::prefetch_far(block, (pack * Q + i) * E::PER_LINE);
    }
}

/// ω⁺ of a pack: one law after the other where it holds several fluids.
#[inline(always)]
fn omega<R: Registers, P: Physics>(
    task: &Task<P, R::Element>,
    block: &Block,
    own: &Own<R::Element>,
    local: usize,
    m: &Moments<R::Pack>,
) -> R::Pack {
    let q = task.physics.stress_magnitude(m);
    let previous = if own.lag.is_empty() { R::Pack::zero() } else { R::load_wide(&own.lag[local..]) };
    let numbers = block.fluid.get(local..local + R::WIDTH).unwrap_or(&[0]);
    let mut omega = R::Pack::zero();
    let mut numbered = [0.0; MOST];
    for (number, n) in numbered.iter_mut().zip(numbers) {
        *number = f64::from(*n);
    }
    let lanes = R::load_wide(&numbered);
    for (k, &fluid) in numbers.iter().enumerate() {
        if numbers[..k].contains(&fluid) {
            continue;
        }
        let own_law = task.physics.omega(fluid, m.rho, q, previous);
        // Fluids are taken in the order of the lanes; a lane keeps the value of its own.
        let fluid = R::Pack::splat(f64::from(fluid));
        let here = <R::Pack as Lane>::and(fluid.less_equal(lanes), lanes.less_equal(fluid));
        omega = if numbers.len() == 1 { own_law } else { <R::Pack as Lane>::select(here, own_law, omega) };
    }
    omega
}

/// Looks for the first fluid cell of a pack that fails the guard; `lanes`: the fluid ones.
#[inline(always)]
fn guard<R: Registers, P: Physics>(
    task: &Task<P, R::Element>,
    block: &Block,
    (local, lanes): (usize, u16),
    m: &Moments<R::Pack>,
    omega: R::Pack,
    outcome: &mut Outcome,
) {
    let limit = task.setup.speed_limit;
    let speed2 = (m.u[0] * m.u[0] + m.u[1] * m.u[1]) + m.u[2] * m.u[2];
    let slow = speed2.less_equal(R::Pack::splat(limit * limit));
    let good = <R::Pack as Lane>::and(slow, R::Pack::zero().less(m.rho));
    if <R::Pack as Lane>::any(<R::Pack as Lane>::not(good)) {
        let mut suspects = [[0.0; MOST]; 5];
        for (row, lane) in suspects.iter_mut().zip([m.rho, omega, m.u[0], m.u[1], m.u[2]]) {
            R::store_wide(lane, row);
        }
        report(task, block, (local, R::WIDTH, lanes), &suspects, outcome);
    }
}

/// Writes down the first cell that fails; `suspects`: ρ, ω⁺ and u by lane.
#[inline(never)]
fn report<P: Physics, E>(
    task: &Task<P, E>,
    block: &Block,
    (local, width, lanes): (usize, usize, u16),
    suspects: &[[f64; MOST]; 5],
    outcome: &mut Outcome,
) {
    for lane in (0..width).filter(|lane| lanes >> lane & 1 != 0) {
        let [rho, omega, x, y, z] = suspects.map(|row| row[lane]);
        let m = Moments { d_rho: rho - 1.0, rho, u: [x, y, z], force: [0.0; 3], q: [0.0; 6] };
        let Some(what) = runaway(&m, task.setup.speed_limit) else { continue };
        let at = task.layout.cell(block.origin, local + lane);
        let cell = task.setup.index(at);
        if outcome.failed.is_none_or(|(first, _)| cell < first) {
            outcome.failed = Some((cell, Stopped { step: task.step, cell: at, what, tau: 1.0 / omega }));
        }
    }
}
