//! The pass over all pairs.

use super::{Geometry, History, Losses, Motion, Physics, Rolling, react};
use crate::dem::V3;
use crate::dem::bodies::Member;
use crate::dem::material::PairTable;
use crate::dem::neighbours::PairList;
use rayon::prelude::*;

/// Pairs per block; the books are summed block by block.
pub const BLOCK: usize = 512;

/// Force of a pair, as little as the sums over partners need.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PairForce {
    /// On the first member, N.
    pub force: V3,
    /// n × F_t, N: the torque of friction on either side is minus this times its arm.
    pub lever: V3,
    /// Half of the overlap, m: an arm is the member's radius less this.
    pub half_overlap: f64,
}

/// What pairs carry from step to step.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PairState {
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

impl PairState {
    /// Torque of friction of pair `p` about the centre of the side with this radius, with its sign turned, N m.
    #[inline]
    pub fn torque(&self, p: usize, radius: f64) -> V3 {
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
pub fn meet(a: &Member, b: &Member, d: &V3) -> Option<(Geometry, f64, f64)> {
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

/// Forces of all pairs; every pair writes to its own place, so threads cannot change a bit.
///
/// # Returns
/// The losses, and the first pair with more overlap than `limit` × the smaller radius.
pub fn run<P: Physics>(
    physics: P,
    table: &PairTable,
    members: &[Member],
    list: &PairList,
    state: &mut PairState,
    dt: f64,
    limit: f64,
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
            let mut losses = Losses::default();
            let apart = |k: usize| {
                let (a, b) = pairs[k];
                let d = members[a as usize].position - members[b as usize].position;
                if list.shift.is_empty() { d } else { d - list.shift[block * BLOCK + k] }
            };
            // First who touches, then the forces: the second loop has no branch that depends on distance.
            let mut close = [0u16; BLOCK];
            let mut count = 0;
            for k in 0..pairs.len() {
                let reach = members[pairs[k].0 as usize].radius + members[pairs[k].1 as usize].radius;
                close[count] = k as u16;
                let near = apart(k).norm_squared() < reach * reach;
                count += usize::from(near);
                if touching[k] && !near {
                    open(&mut touching[k], &mut history[k], rolling.get_mut(k), &mut losses);
                }
            }
            for &k in &close[..count] {
                let k = usize::from(k);
                let (ia, ib) = pairs[k];
                let (a, b) = (&members[ia as usize], &members[ib as usize]);
                let Some((g, arm_a, arm_b)) = meet(a, b, &apart(k)) else {
                    if touching[k] {
                        open(&mut touching[k], &mut history[k], rolling.get_mut(k), &mut losses);
                    }
                    continue;
                };
                if g.overlap > limit * a.radius.min(b.radius) {
                    sum.too_deep = sum.too_deep.min((block * BLOCK + k) as u32);
                }
                touching[k] = true;
                let slip = physics.surface_velocity(&a.velocity, &a.spin, &(g.normal * -arm_a))
                    - physics.surface_velocity(&b.velocity, &b.spin, &(g.normal * arm_b));
                let motion =
                    Motion { slip, relative_spin: a.spin - b.spin, mean_spin: (a.spin + b.spin) * 0.5 };
                let law = table.law(a.material, b.material);
                let mut none = Rolling::default();
                let roll = rolling.get_mut(k).unwrap_or(&mut none);
                let r = react(&physics, law, &g, &motion, dt, &mut history[k], roll, &mut losses);
                force[k] = PairForce {
                    force: g.normal * r.normal + r.tangential,
                    lever: g.normal.cross(&r.tangential),
                    half_overlap: 0.5 * g.overlap,
                };
                roll.moment = r.rolling;
            }
            sum.losses = losses;
        });
    let mut total = Losses::default();
    let mut deep = u32::MAX;
    for b in &state.blocks {
        total.add(&b.losses);
        deep = deep.min(b.too_deep);
    }
    (total, (deep != u32::MAX).then_some(deep as usize))
}
