//! What arrives along irregular links: from walls \[B1\] \[B3\] and open faces.

use super::block::Link;
use super::element::{Element, index};
use super::hand_over::raise;
use super::rim::Rim;
use super::task::Task;
pub(crate) use super::task::after;
use crate::free_surface::exchange::gas_link;
use crate::lane::Lane;
use crate::lattice::equilibrium::dot;
use crate::lattice::moments::density_excess;
use crate::lattice::{Q, W, opposite};
use crate::solver::physics::Physics;

/// ρ of a cell after the last collision, for [`wall_link`]; 1 where the wall rests and ρ is multiplied by zero.
#[inline]
pub(crate) fn density_at_wall<P, E: Element>(
    task: &Task<P, E>,
    number: usize,
    local: usize,
    velocity: &[f64; 3],
) -> f64 {
    if *velocity == [0.0; 3] { 1.0 } else { 1.0 + density_excess(&after(task, number, local)) }
}

/// What a wall sends back along a link \[B1\] \[B3\] \[B4\], as it is stored; `body` as in
/// [`Source::Wall`](crate::boundary::links::Source::Wall).
#[inline]
pub(crate) fn wall_link<P: Physics, E: Element>(
    task: &Task<P, E>,
    number: usize,
    rim: &[Rim],
    link: &Link,
    rho: f64,
    velocity: &[f64; 3],
    body: u8,
) -> f64 {
    if let Some(returned) = cut_returned(task, number, link) {
        return returned;
    }
    let out = opposite(usize::from(link.direction));
    let leaving = task.old[number].get()[index::<E>(usize::from(link.local), out)].to_f64();
    let correction = rim.get(usize::from(link.rim)).map(|kept| &kept.correction);
    let back = half_way_link(task, leaving, correction, out, rho, velocity);
    stored::<E>(match raise(task, number, usize::from(link.local), body) {
        None => back,
        Some(raise) => back + W[out] * raise,
    })
}

/// What comes back along a link of a cut cell \[B4\]; `None` along all others.
#[inline]
fn cut_returned<P, E: Element>(task: &Task<P, E>, number: usize, link: &Link) -> Option<f64> {
    let returned = task.cut_returned.get(number).filter(|list| !list.is_empty())?;
    let block = &task.blocks[number];
    let cell = block.rim.get(usize::from(link.rim))?.cut?;
    returned.get(block.cuts.position(cell, usize::from(link.direction))?).copied()
}

/// What a half-way link sends back.
#[inline]
pub(crate) fn half_way_link<P: Physics, E>(
    task: &Task<P, E>,
    leaving: f64,
    correction: Option<&[f64; Q]>,
    out: usize,
    rho: f64,
    velocity: &[f64; 3],
) -> f64 {
    let leaving = leaving - correction.map_or(0.0, |correction| correction[out]);
    task.physics.wall(leaving, out, rho, velocity)
}

/// What is left of a number when it is stored: the ledger books what the cell gets.
#[inline(always)]
pub(crate) fn stored<E: Element>(x: f64) -> f64 {
    E::from_f64(x).to_f64()
}

/// What an open face sends back, as it is stored: as gas where fluid leaves, as a wall at rest where it would
/// come in, over the whole face or over this link.
#[inline]
pub(crate) fn open_link<P: Physics, E: Element>(
    task: &Task<P, E>,
    number: usize,
    rim: &[Rim],
    link: &Link,
) -> f64 {
    let out = opposite(usize::from(link.direction));
    let leaving = task.old[number].get()[index::<E>(usize::from(link.local), out)].to_f64();
    let u = rim.get(usize::from(link.rim)).map_or([0.0; 3], |kept| kept.velocity);
    if dot(out, &u) > 0.0 { f64::smaller(stored::<E>(gas_link(leaving, out, &u)), leaving) } else { leaving }
}
