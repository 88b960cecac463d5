//! Packs that are not ordinary: their populations are put together one by one before they are collided.

use super::around::Around;
use super::block::{Block, Origin};
use super::element::{Element, MOST, index};
use super::layout::Layout;
use super::links::{density_at_wall, open_link, wall_link};
use super::registers::Registers;
use super::sources::{self, Sources};
use super::stores;
use super::surface::record::Lanes;
use super::task::{Own, Task};
use crate::lattice::Q;
use crate::lattice::moments::Moments;
use crate::lattice::unroll::{directions, three};
use crate::solver::physics::Physics;

/// What the cells of a pack are.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Class {
    /// Bit per lane: fluid.
    pub fluid: u16,
    /// Bit per lane: interface.
    pub interface: u16,
    /// Bit per lane: has a record of its own.
    pub kept: u16,
    /// All lanes are fluid, none is interface, all links are the grid's.
    pub ordinary: bool,
}

impl Class {
    /// Of a pack of a block.
    #[inline(always)]
    pub fn new<P, E>(task: &Task<P, E>, block: &Block, number: usize, pack: usize, line: usize) -> Self {
        let Lanes { fluid, interface, kept } = match &task.surface {
            None => Lanes { fluid: block.usable[pack], ..Lanes::default() },
            Some(surface) => surface.lanes[number][pack],
        };
        let all = u16::MAX >> (16 - line);
        let links = block.first_link[pack] != block.first_link[pack + 1];
        Self { fluid, interface, kept, ordinary: fluid == all && kept == 0 && !links }
    }
}

/// Columns of one pack.
///
/// Aligned so that the function it lives in aligns its stack: registers that are put aside there would
/// otherwise lie across two lines, each.
#[repr(align(64))]
pub(crate) struct Stage<E> {
    /// Populations before collision, then after.
    populations: [[E; MOST]; Q],
    /// Body force; filled where the pack has interface cells.
    force: [[f64; MOST]; 3],
    /// u, ω⁺ and ρ − 1 of this collision.
    velocity: [[f64; MOST]; 3],
    omega: [f64; MOST],
    d_rho: [f64; MOST],
}

impl<E: Element> Stage<E> {
    /// Zeros.
    #[must_use]
    pub fn new() -> Self {
        Self {
            populations: [[E::default(); MOST]; Q],
            force: [[0.0; MOST]; 3],
            velocity: [[0.0; MOST]; 3],
            omega: [0.0; MOST],
            d_rho: [0.0; MOST],
        }
    }

    /// Gathers a pack that starts at `local`; `sources`: those of the pack, where they are tabulated.
    #[inline(always)]
    pub(crate) fn fill<R: Registers<Element = E>, P: Physics>(
        &mut self,
        task: &Task<P, E>,
        own: &Own<E>,
        around: &Around<E>,
        sources: Option<&Sources>,
        local: usize,
    ) {
        let Some(sources) = sources else { return self.gather(task, own, around, local) };
        for part in (0..E::PER_LINE).step_by(R::WIDTH) {
            let h = sources::gather::<R>(around, sources, part);
            self.store::<R>(&h, part);
        }
    }

    /// Gathers a pack that starts at `local` where rows do not run along x, or before the first collision.
    #[inline(never)]
    fn gather<P: Physics>(&mut self, task: &Task<P, E>, own: &Own<E>, around: &Around<E>, local: usize) {
        let line = E::PER_LINE;
        let own_old = task.old[own.number].get();
        for (i, column) in self.populations.iter_mut().enumerate() {
            if task.fresh {
                column[..line].copy_from_slice(&own_old[index::<E>(local, i)..][..line]);
            } else {
                gather_row(task.layout, around, i, local, &mut column[..line]);
            }
        }
    }

    /// Puts right what the grid of blocks does not know: walls, irregular links, interface cells, idle lanes.
    #[inline(never)]
    pub(crate) fn mend<P: Physics>(
        &mut self,
        task: &Task<P, E>,
        block: &Block,
        own: &mut Own<E>,
        class: &Class,
        local: usize,
    ) {
        let line = E::PER_LINE;
        if !task.fresh {
            self.fill_links(task, block, own, class, local);
        }
        if class.kept != 0 {
            self.fill_interface(task, own, class, local);
        }
        let idle = !class.fluid;
        for lane in (0..line).filter(|lane| idle >> lane & 1 != 0) {
            for column in &mut self.populations {
                column[lane] = E::default();
            }
        }
        self.save_rim(block, own, class, local);
    }

    /// Irregular links of liquid cells; those of interface cells were taken when mass was exchanged.
    fn fill_links<P: Physics>(
        &mut self,
        task: &Task<P, E>,
        block: &Block,
        own: &Own<E>,
        class: &Class,
        local: usize,
    ) {
        let pack = local / E::PER_LINE;
        // With a surface the links have been booked, and their values kept.
        let returned = task.surface.as_ref().map(|surface| &surface.returned[own.number]);
        for (link, place) in block.links_of(pack).iter().zip(block.first_link[pack] as usize..) {
            let at = usize::from(link.local);
            let lane = at - local;
            if (class.fluid & !class.kept) >> lane & 1 == 0 {
                continue;
            }
            let value = match link.from {
                Origin::Cell { cell, direction } => {
                    let number = task.layout.block_at(cell.block as usize);
                    task.old[number as usize].get()[index::<E>(cell.local as usize, usize::from(direction))]
                }
                Origin::Wall { .. } | Origin::Open if returned.is_some() => {
                    E::from_f64(returned.map_or(0.0, |values| values[place]))
                }
                Origin::Wall { velocity, body, .. } => {
                    let u = &task.velocities[velocity as usize];
                    let rho = density_at_wall(task, own.number, at, u);
                    E::from_f64(wall_link(task, own.number, own.rim, link, rho, u, body))
                }
                Origin::Open => E::from_f64(open_link(task, own.number, own.rim, link)),
            };
            self.populations[usize::from(link.direction)][lane] = value;
        }
    }

    fn fill_interface<P: Physics>(&mut self, task: &Task<P, E>, own: &Own<E>, class: &Class, local: usize) {
        let Some(surface) = &task.surface else { return };
        self.force = task.force.map(|f| [f; MOST]);
        let start = own.interface.partition_point(|cell| usize::from(cell.local) < local);
        for cell in &own.interface[start..] {
            let Some(lane) = Some(usize::from(cell.local) - local).filter(|&lane| lane < E::PER_LINE) else {
                break;
            };
            for (column, f) in self.populations.iter_mut().zip(&cell.f) {
                column[lane] = E::from_f64(*f);
            }
            if class.interface >> lane & 1 != 0 {
                let force = surface.force_of(own.number, cell, &task.force);
                for a in 0..3 {
                    self.force[a][lane] = force[a];
                }
            }
        }
    }

    /// Keeps what the walls need to know of this collision.
    fn save_rim(&self, block: &Block, own: &mut Own<E>, class: &Class, local: usize) {
        if own.rim.is_empty() {
            return;
        }
        let start = block.rim.partition_point(|cell| usize::from(cell.local) < local);
        for (cell, kept) in block.rim[start..].iter().zip(&mut own.rim[start..]) {
            let Some(lane) = Some(usize::from(cell.local) - local).filter(|&lane| lane < E::PER_LINE) else {
                break;
            };
            if class.fluid >> lane & 1 != 0 {
                for (f, column) in kept.f.iter_mut().zip(&self.populations) {
                    *f = column[lane].to_f64();
                }
            }
        }
    }

    /// Populations of one part of the pack.
    #[inline(always)]
    pub fn load<R: Registers<Element = E>>(&self, part: usize) -> [R::Pack; Q] {
        directions(
            #[inline(always)]
            |i| R::load(&self.populations[i][part..]),
        )
    }

    /// Body force of one part of the pack.
    #[inline(always)]
    pub(crate) fn load_force<R: Registers<Element = E>>(&self, part: usize) -> [R::Pack; 3] {
        three(
            #[inline(always)]
            |a| R::load_wide(&self.force[a][part..]),
        )
    }

    /// Puts the populations of one part of the pack here.
    #[inline(always)]
    pub(crate) fn store<R: Registers<Element = E>>(&mut self, populations: &[R::Pack; Q], part: usize) {
        for i in 0..Q {
            R::store(populations[i], &mut self.populations[i][part..]);
        }
    }

    /// Writes the populations line by line; `to`: the numbers of the pack.
    #[inline(always)]
    pub fn write(&self, past_cache: bool, to: &mut [E]) {
        let line = E::PER_LINE;
        for i in 0..Q {
            let to = &mut to[i * line..][..line];
            if past_cache {
                stores::line_past_cache(to, &self.populations[i][..line]);
            } else {
                to.copy_from_slice(&self.populations[i][..line]);
            }
        }
    }

    /// Keeps u, ω⁺ and ρ of one part of the pack.
    #[inline(always)]
    pub(crate) fn keep<R: Registers<Element = E>>(
        &mut self,
        m: &Moments<R::Pack>,
        omega: R::Pack,
        part: usize,
    ) {
        for a in 0..3 {
            R::store_wide(m.u[a], &mut self.velocity[a][part..]);
        }
        R::store_wide(omega, &mut self.omega[part..]);
        R::store_wide(m.d_rho, &mut self.d_rho[part..]);
    }

    /// Hands u and ω⁺ to the cells that need them after the pass; returns Σ(ρ − 1) over liquid cells.
    pub fn finish(&self, block: &Block, own: &mut Own<E>, class: &Class, local: usize) -> f64 {
        let line = E::PER_LINE;
        let inside = |at: u16| Some(usize::from(at) - local).filter(|&lane| lane < line);
        let u = |lane: usize| self.velocity.map(|row| row[lane]);
        if !own.rim.is_empty() {
            let start = block.rim.partition_point(|cell| usize::from(cell.local) < local);
            for (cell, kept) in block.rim[start..].iter().zip(&mut own.rim[start..]) {
                let Some(lane) = inside(cell.local) else { break };
                (kept.velocity, kept.omega) = (u(lane), self.omega[lane]);
            }
        }
        if class.kept != 0 {
            let start = own.interface.partition_point(|cell| usize::from(cell.local) < local);
            for cell in &mut own.interface[start..] {
                let Some(lane) = inside(cell.local) else { break };
                cell.velocity = u(lane);
            }
        }
        let liquid = class.fluid & !class.interface;
        (0..line).filter(|lane| liquid >> lane & 1 != 0).map(|lane| self.d_rho[lane]).sum()
    }
}

impl<E: Element> Default for Stage<E> {
    fn default() -> Self {
        Self::new()
    }
}

/// One direction of a pack from the grid of blocks.
#[inline]
fn gather_row<E: Element>(layout: &Layout, around: &Around<E>, i: usize, local: usize, to: &mut [E]) {
    let (line, row) = (to.len(), layout.block[0]);
    let x = local & (row - 1);
    // The row without the shift along it, then the one end that lies in the next pack or block.
    let (entry, first) = layout.upstream_row(local, i);
    let at = |entry: usize, cell: usize| around.all()[entry][index::<E>(cell, i)];
    let own = &around.all()[entry][index::<E>(first + x, i)..][..line];
    match layout.velocity[i][0] {
        1 => {
            to[0] = if x == 0 { at(entry - 1, first + row - 1) } else { at(entry, first + x - 1) };
            to[1..].copy_from_slice(&own[..line - 1]);
        }
        -1 => {
            to[..line - 1].copy_from_slice(&own[1..]);
            to[line - 1] = if x + line == row { at(entry + 1, first) } else { at(entry, first + x + line) };
        }
        _ => to.copy_from_slice(own),
    }
}
