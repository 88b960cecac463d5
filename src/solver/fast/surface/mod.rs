//! The free surface in blocks: interface cells have a record of their own, liquid cells none.
//!
//! A step is: collide all cells (the populations of interface cells come from their records), wall
//! corrections, stream and exchange mass in interface cells, marks and conversions. Liquid cells stream when
//! they are gathered for the next collision; the densities found there close the ledger of the step
//! before.

mod convert;
pub mod exchange;
mod inertia;
pub mod packed;
mod report;
mod start;

use std::collections::BTreeMap;

pub(super) use start::put;

use super::element::Element;
use super::kernel::Outcome;
use super::run::FastRun;
use crate::free_surface::Kind;
use crate::free_surface::force::interface_force;
use crate::lattice::Q;
use crate::setup::{FreeSurface, SurfaceForce};
use crate::solver::books::Books;
use crate::solver::physics::Physics;
use crate::solver::run::{Load, Runaway, Stopped};
use inertia::Inertia;

/// Steps between two searches for blocks that have run dry.
const STEPS_PER_SEARCH: u64 = 64;

/// A cell whose populations are kept: interface, or liquid since the last step.
#[derive(Clone, Debug)]
pub struct InterfaceCell {
    /// Place in the block.
    pub local: u16,
    /// What it touched while streaming, bits of [`crate::free_surface::conversion::touch`].
    pub touches: u8,
    /// Populations before the next collision.
    pub f: [f64; Q],
    /// Their density.
    pub rho: f64,
    /// u of the last collision.
    pub velocity: [f64; 3],
    /// m.
    pub mass: f64,
    /// Mean smoothed acceleration of the liquid neighbours; zero unless the surface force has inertia.
    pub acceleration: [f64; 3],
}

/// Lanes of a pack, a bit each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lanes {
    /// Liquid or interface.
    pub fluid: u16,
    /// Interface.
    pub interface: u16,
    /// With a record: interface, or liquid since the last step.
    pub kept: u16,
}

/// What the passes read of the surface.
#[derive(Clone, Copy)]
pub struct SurfaceView<'a> {
    /// By block and pack.
    pub lanes: &'a [Vec<Lanes>],
    /// φ of interface cells, by block and cell.
    fill: &'a [Vec<f64>],
    /// What walls and open faces send back to liquid cells, by block and irregular link.
    pub returned: &'a [Vec<f64>],
    rule: SurfaceForce,
}

impl SurfaceView<'_> {
    /// Body force of an interface cell \[F3\].
    #[inline]
    #[must_use]
    pub fn force_of(&self, number: usize, cell: &InterfaceCell, force: &[f64; 3]) -> [f64; 3] {
        let fill = self.fill[number][usize::from(cell.local)];
        interface_force(self.rule, force, fill, &cell.acceleration)
    }
}

/// The surface of a run.
pub struct Surface {
    /// The rules; without the initial fill.
    pub(super) rules: FreeSurface,
    /// By block and cell.
    pub(super) kinds: Vec<Vec<Kind>>,
    /// φ of interface cells, by block and cell; [`exchange::LIQUID`](crate::free_surface::exchange::LIQUID) in
    /// liquid, [`exchange::GAS`](crate::free_surface::exchange::GAS) elsewhere.
    pub(super) fill: Vec<Vec<f64>>,
    /// By block and pack.
    pub(super) lanes: Vec<Vec<Lanes>>,
    /// By block, in order of the cells.
    pub(super) interface: Vec<Vec<InterfaceCell>>,
    /// Excess mass without receiver, by cell of the box \[F6\].
    pub(super) parked: BTreeMap<u32, f64>,
    pub(super) books: Books,
    pub(super) loads: Vec<Load>,
    /// Liquid and interface cells.
    pub(super) counts: [u64; 2],
    /// Only for the surface force with inertia.
    pub(super) inertia: Option<Inertia>,
    /// Numbers of blocks that were given up.
    pub(super) free: Vec<usize>,
    /// What walls and open faces sent back to liquid cells in the last step, by block and irregular link.
    pub(super) returned: Vec<Vec<f64>>,
    /// `fill` where there is no block.
    pub(super) nothing: Vec<f64>,
    /// Cells that grains cover, by block.
    pub(super) covered: Vec<u32>,
    /// Whether a step waits for its ledger to be closed.
    pub(super) open: bool,
}

impl Surface {
    /// What the passes read.
    #[must_use]
    pub fn view(&self) -> SurfaceView<'_> {
        SurfaceView { lanes: &self.lanes, fill: &self.fill, returned: &self.returned, rule: self.rules.force }
    }

    /// Body force of a cell \[F3\]; `None` where it holds no fluid.
    #[must_use]
    pub fn force_at(&self, number: usize, local: usize, force: &[f64; 3]) -> Option<[f64; 3]> {
        match self.kinds[number][local] {
            Kind::Interface => {
                // Without a record at the very start, where nothing has been accelerated yet.
                let record = self.inertia.as_ref().and_then(|_| self.record(number, local));
                let acceleration = record.map_or([0.0; 3], |cell| cell.acceleration);
                Some(interface_force(self.rules.force, force, self.fill[number][local], &acceleration))
            }
            Kind::Liquid => Some(*force),
            Kind::Gas | Kind::Solid => None,
        }
    }

    /// Record of a cell.
    #[must_use]
    pub fn record(&self, number: usize, local: usize) -> Option<&InterfaceCell> {
        let list = &self.interface[number];
        list.binary_search_by_key(&local, |cell| usize::from(cell.local)).ok().map(|k| &list[k])
    }

    /// Kinds of a block into bits; `line`: cells per pack.
    fn list_lanes(&mut self, number: usize, line: usize) {
        let mut lanes = vec![Lanes::default(); self.kinds[number].len() / line];
        for (local, kind) in self.kinds[number].iter().enumerate() {
            let lane = &mut lanes[local / line];
            lane.fluid |= u16::from(kind.is_fluid()) << (local % line);
            lane.interface |= u16::from(*kind == Kind::Interface) << (local % line);
        }
        for cell in &self.interface[number] {
            lanes[usize::from(cell.local) / line].kept |= 1 << (usize::from(cell.local) % line);
        }
        self.lanes[number] = lanes;
    }

    /// The same for one cell whose kind or record has changed.
    fn list_lane(&mut self, number: usize, local: usize, line: usize) {
        let kept = self.record(number, local).is_some();
        let kind = self.kinds[number][local];
        let Some(lane) = self.lanes[number].get_mut(local / line) else { return };
        let bit = 1 << (local % line);
        let set = |bits: &mut u16, on: bool| *bits = if on { *bits | bit } else { *bits & !bit };
        set(&mut lane.fluid, kind.is_fluid());
        set(&mut lane.interface, kind == Kind::Interface);
        set(&mut lane.kept, kept);
    }
}

impl<P: Physics, E: Element> FastRun<P, E> {
    /// Streaming, mass exchange and conversions of the step whose collision is done.
    pub(super) fn surface_pass(&mut self, force: &[f64; 3]) {
        if self.surface.is_none() {
            return;
        }
        self.drop_settled();
        self.exchange(force);
        self.accelerate();
        self.convert_cells(force);
        self.spread_acceleration();
        if self.step.is_multiple_of(STEPS_PER_SEARCH) {
            self.drop_dry_blocks();
        }
        if let Some(surface) = &mut self.surface {
            surface.open = true;
        }
    }

    /// Records of cells that are liquid by now have done their work.
    fn drop_settled(&mut self) {
        let Some(surface) = &mut self.surface else { return };
        for number in 0..surface.interface.len() {
            let (list, kinds) = (&mut surface.interface[number], &surface.kinds[number]);
            let before = list.len();
            list.retain(|cell| kinds[usize::from(cell.local)] == Kind::Interface);
            if list.len() != before {
                surface.list_lanes(number, E::PER_LINE);
            }
        }
    }

    /// Gives up blocks without fluid.
    fn drop_dry_blocks(&mut self) {
        let Some(surface) = &mut self.surface else { return };
        for number in 0..self.blocks.len() {
            let dry =
                surface.lanes[number].iter().all(|lane| lane.fluid == 0) && surface.covered[number] == 0;
            if dry && !self.old[number].is_empty() {
                self.layout.set_block(self.blocks[number].place, super::layout::NONE);
                self.old[number] = Default::default();
                self.new[number] = Default::default();
                for list in [&mut self.density, &mut self.lag, &mut surface.fill, &mut surface.returned] {
                    list[number] = Vec::new();
                }
                self.rim[number] = Vec::new();
                if let Some(inertia) = &mut surface.inertia {
                    inertia.drop_block(number);
                }
                surface.kinds[number] = Vec::new();
                surface.lanes[number] = Vec::new();
                self.blocks[number].clear();
                surface.free.push(number);
            }
        }
    }

    /// Closes the mass of the last step with the densities that this collision found.
    ///
    /// # Errors
    /// It does not close within rounding; the cell named is the interface cell with the largest |m| off
    /// its fill.
    pub(super) fn close_last_step(&mut self, outcomes: &[Outcome]) -> Result<(), Stopped> {
        let Some(surface) = &mut self.surface else { return Ok(()) };
        if !std::mem::take(&mut surface.open) {
            return Ok(());
        }
        let mut mass: f64 = outcomes.iter().map(|outcome| outcome.liquid_excess).sum();
        let mut worst = (0, 0, -1.0);
        for (number, list) in surface.interface.iter().enumerate() {
            let mut sum = 0.0;
            for cell in list {
                let local = usize::from(cell.local);
                if surface.kinds[number][local] == Kind::Interface {
                    sum += cell.mass;
                    let off = (cell.mass - surface.fill[number][local]).abs();
                    if off.is_nan() || off > worst.2 {
                        worst = (number, local, if off.is_nan() { f64::INFINITY } else { off });
                    }
                }
            }
            mass += sum;
        }
        mass += surface.counts[0] as f64;
        mass += surface.parked.values().sum::<f64>();
        let cells = surface.counts[0] + surface.counts[1];
        let rounding = self.setup.precision.rounding();
        let Some((residual, bound)) = surface.books.close(mass, cells, rounding) else { return Ok(()) };
        let cell = self.layout.cell(self.blocks[worst.0].origin, worst.1);
        Err(Stopped { step: self.step, cell, what: Runaway::Ledger { residual, bound }, tau: f64::NAN })
    }
}
