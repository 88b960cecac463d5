//! The pass over all pairs.

use super::{Contact, ContactEquations, Geometry, History, Losses, Memory, Motion, Rolling, react};
use crate::dem::V3;
use crate::dem::bodies::Member;
use crate::dem::material::PairTable;
use crate::dem::neighbours::PairList;
use crate::state::state;
use rayon::prelude::*;

/// Pairs per block; the books are summed block by block.
pub(crate) const BLOCK: usize = 512;

/// Force of a pair, as little as the sums over partners need.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct PairForce {
    /// On the first member, N.
    pub force: V3,
    /// n × F_t, N: the torque of friction on either side is minus this times its arm.
    pub lever: V3,
    /// Half of the overlap, m: an arm is the member's radius less this.
    pub half_overlap: f64,
}

/// What pairs carry from step to step.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct PairState {
    /// One per pair of the list.
    pub history: Vec<History>,
    /// One per pair of the list, or none at all if nothing resists rolling.
    pub rolling: Vec<Rolling>,
    /// One per pair of the list; valid where `touching`.
    pub force: Vec<PairForce>,
    /// Whether the pair touches.
    pub touching: Vec<bool>,
    blocks: Vec<BlockSum>,
}

// Sums of blocks are made anew in every step.
state!(PairState: history rolling force touching; but blocks);
state!(PairForce: force lever half_overlap);

impl PairState {
    /// Torque of friction of pair `p` about the centre of the side with this radius, with its sign turned, N m.
    #[inline]
    pub(crate) fn torque(&self, p: usize, radius: f64) -> V3 {
        self.force[p].lever * (radius - self.force[p].half_overlap)
    }
}

/// Sums of one block.
#[derive(Debug, Clone, Copy, PartialEq)]
struct BlockSum {
    losses: Losses,
    too_deep: u32,
}

impl PairState {
    /// Empty state for `n` pairs, with or without rolling resistance.
    pub fn new(n: usize, rolling: bool) -> Self {
        Self {
            history: vec![History::default(); n],
            rolling: vec![Rolling::default(); if rolling { n } else { 0 }],
            force: vec![PairForce::default(); n],
            touching: vec![false; n],
            blocks: Vec::new(),
        }
    }
}

/// Geometry of two members whose centres are apart by `d` (second to first), with the lever arms; `None` if they
/// do not touch.
///
/// The contact point halves the overlap, so the arms add up to the distance and angular momentum is kept.
#[inline(always)]
pub(crate) fn meet(a: &Member, b: &Member, d: &V3) -> Option<(Geometry, f64, f64)> {
    let sum = a.radius + b.radius;
    let d2 = d.norm_squared();
    if d2 >= sum * sum || d2.is_nan() {
        return None;
    }
    let distance = d2.sqrt();
    let overlap = sum - distance;
    let inverse = a.inverse_mass + b.inverse_mass;
    if overlap <= 0.0 || inverse == 0.0 {
        return None;
    }
    // Coinciding centres have no direction; the overlap guard stops the run right after.
    let normal = if distance > 0.0 { d * (1.0 / distance) } else { V3::z() };
    let g = Geometry { normal, overlap, radius: a.radius * b.radius / sum, mass: 1.0 / inverse };
    Some((g, a.radius - 0.5 * overlap, b.radius - 0.5 * overlap))
}

/// A contact has opened: its springs are lost.
#[cold]
fn open(touching: &mut bool, history: &mut History, rolling: Option<&mut Rolling>, losses: &mut Losses) {
    *touching = false;
    losses.slip += history.released();
    *history = History::default();
    if let Some(r) = rolling {
        losses.roll_slip += r.released();
        *r = Rolling::default();
    }
}

/// What all pairs have in common in a step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Inputs<'a> {
    /// Constants of the pairs of materials.
    pub table: &'a PairTable,
    /// All members where they are now.
    pub members: &'a [Member],
    /// Time since the last step, s.
    pub dt: f64,
    /// Largest overlap as a share of the smaller radius.
    pub limit: f64,
}

/// Forces of all pairs; every pair writes to its own place, so threads cannot change a bit.
///
/// # Returns
/// The losses, and the first pair with more overlap than [`Inputs::limit`] × the smaller radius.
pub fn run<E: ContactEquations>(
    equations: E,
    inputs: &Inputs,
    list: &PairList,
    state: &mut PairState,
) -> (Losses, Option<usize>) {
    let n = list.pairs.len();
    state.blocks.clear();
    state.blocks.resize(n.div_ceil(BLOCK), BlockSum { losses: Losses::default(), too_deep: u32::MAX });
    // Without rolling resistance every block gets an empty slice of the rolling springs.
    let rolling: Vec<&mut [Rolling]> = match state.rolling.is_empty() {
        true => (0..state.blocks.len()).map(|_| Default::default()).collect(),
        false => state.rolling.chunks_mut(BLOCK).collect(),
    };
    (
        list.pairs.par_chunks(BLOCK),
        rolling,
        state.history.par_chunks_mut(BLOCK),
        state.force.par_chunks_mut(BLOCK),
        state.touching.par_chunks_mut(BLOCK),
        &mut state.blocks,
    )
        .into_par_iter()
        .enumerate()
        .for_each(|(block, (pairs, rolling, history, force, touching, sum))| {
            let first = block * BLOCK;
            let shift = list.shift.get(first..first + pairs.len()).unwrap_or_default();
            *sum = Block { pairs, shift, rolling, history, force, touching }.run(&equations, inputs, first);
        });
    let mut total = Losses::default();
    let mut deep = u32::MAX;
    for b in &state.blocks {
        total.add(&b.losses);
        deep = deep.min(b.too_deep);
    }
    (total, (deep != u32::MAX).then_some(deep as usize))
}

/// Some pairs that follow each other in the list, with what belongs to them.
struct Block<'a> {
    pairs: &'a [(u32, u32)],
    /// Empty without periodic axes.
    shift: &'a [V3],
    /// Empty without rolling resistance.
    rolling: &'a mut [Rolling],
    history: &'a mut [History],
    force: &'a mut [PairForce],
    touching: &'a mut [bool],
}

impl Block<'_> {
    /// Forces of the block; `first`: number of its first pair.
    #[inline(always)]
    fn run<E: ContactEquations>(mut self, equations: &E, inputs: &Inputs, first: usize) -> BlockSum {
        let mut sum = BlockSum { losses: Losses::default(), too_deep: u32::MAX };
        // First who touches, then the forces: the second loop has no branch that depends on distance.
        let mut close = [0u16; BLOCK];
        let count = self.close(inputs, &mut close, &mut sum.losses);
        for &k in &close[..count] {
            let k = usize::from(k);
            let (a, b) = self.pair(inputs, k);
            let Some((g, arm_a, arm_b)) = meet(a, b, &self.apart(inputs, k)) else {
                self.open(k, &mut sum.losses);
                continue;
            };
            if g.overlap > inputs.limit * a.radius.min(b.radius) {
                sum.too_deep = sum.too_deep.min((first + k) as u32);
            }
            self.touching[k] = true;
            let slip = equations.surface_velocity(&a.velocity, &a.spin, &(g.normal * -arm_a))
                - equations.surface_velocity(&b.velocity, &b.spin, &(g.normal * arm_b));
            let motion = Motion { slip, relative_spin: a.spin - b.spin, mean_spin: (a.spin + b.spin) * 0.5 };
            let law = inputs.table.law(a.material, b.material);
            let contact = Contact { law, geometry: g, motion, dt: inputs.dt };
            let mut none = Rolling::default();
            let rolling = self.rolling.get_mut(k).unwrap_or(&mut none);
            let memory =
                Memory { history: &mut self.history[k], rolling: &mut *rolling, losses: &mut sum.losses };
            let r = react(equations, &contact, memory);
            rolling.moment = r.rolling;
            self.force[k] = PairForce {
                force: g.normal * r.normal + r.tangential,
                lever: g.normal.cross(&r.tangential),
                half_overlap: 0.5 * g.overlap,
            };
        }
        sum
    }

    /// Which pairs may touch: their places in the block, and how many. Contacts that have opened are closed in the
    /// books.
    #[inline(always)]
    fn close(&mut self, inputs: &Inputs, close: &mut [u16; BLOCK], losses: &mut Losses) -> usize {
        let mut count = 0;
        for k in 0..self.pairs.len() {
            let (a, b) = self.pair(inputs, k);
            let reach = a.radius + b.radius;
            close[count] = k as u16;
            let near = self.apart(inputs, k).norm_squared() < reach * reach;
            count += usize::from(near);
            if !near {
                self.open(k, losses);
            }
        }
        count
    }

    #[inline(always)]
    fn pair<'s>(&self, inputs: &Inputs<'s>, k: usize) -> (&'s Member, &'s Member) {
        let (a, b) = self.pairs[k];
        (&inputs.members[a as usize], &inputs.members[b as usize])
    }

    /// Centre of the first less that of the second.
    #[inline(always)]
    fn apart(&self, inputs: &Inputs, k: usize) -> V3 {
        let (a, b) = self.pair(inputs, k);
        let d = a.position - b.position;
        if self.shift.is_empty() { d } else { d - self.shift[k] }
    }

    /// A pair that does not touch: closes its books if it did.
    #[inline(always)]
    fn open(&mut self, k: usize, losses: &mut Losses) {
        if self.touching[k] {
            open(&mut self.touching[k], &mut self.history[k], self.rolling.get_mut(k), losses);
        }
    }
}
