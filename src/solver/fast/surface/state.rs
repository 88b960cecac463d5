//! The surface of a run in blocks.

use std::collections::BTreeMap;

use super::flow::Flow;
use super::inertia::Inertia;
use super::record::{InterfaceCell, Lanes, SurfaceView};
use crate::free_surface::Kind;
use crate::free_surface::exchange::GAS;
use crate::free_surface::force::interface_force;
use crate::setup::{FreeSurface, SurfaceForce};
use crate::solver::books::Books;
use crate::solver::run::Load;
use crate::state::{State, StateError, Tape, part};

/// The surface of a run.
pub struct Surface {
    /// The rules; without the initial fill.
    pub(in crate::solver::fast) rules: FreeSurface,
    /// By block and cell.
    pub(in crate::solver::fast) kinds: Vec<Vec<Kind>>,
    /// φ of interface cells, by block and cell; [`LIQUID`](crate::free_surface::exchange::LIQUID) in
    /// liquid, [`GAS`](crate::free_surface::exchange::GAS) elsewhere.
    pub(in crate::solver::fast) fill: Vec<Vec<f64>>,
    /// Density and velocity of interface cells, by block.
    pub(in crate::solver::fast) flow: Vec<Flow>,
    /// By block and pack.
    pub(in crate::solver::fast) lanes: Vec<Vec<Lanes>>,
    /// By block, in order of the cells.
    pub(in crate::solver::fast) interface: Vec<Vec<InterfaceCell>>,
    /// Excess mass without receiver, by cell of the box \[F6\].
    pub(in crate::solver::fast) parked: BTreeMap<u32, f64>,
    pub(in crate::solver::fast) books: Books,
    pub(in crate::solver::fast) loads: Vec<Load>,
    /// Liquid and interface cells.
    pub(in crate::solver::fast) counts: [u64; 2],
    /// Only for the surface force with inertia.
    pub(in crate::solver::fast) inertia: Option<Inertia>,
    /// Numbers of blocks that were given up.
    pub(in crate::solver::fast) free: Vec<usize>,
    /// What walls and open faces sent back to liquid cells in the last step, by block and irregular link.
    pub(in crate::solver::fast) returned: Vec<Vec<f64>>,
    /// `fill` where there is no block.
    pub(in crate::solver::fast) nothing: Vec<f64>,
    /// Cells that grains cover, by block.
    pub(in crate::solver::fast) covered: Vec<u32>,
    /// Whether a step waits for its ledger to be closed.
    pub(in crate::solver::fast) open: bool,
}

impl Surface {
    /// Of a run without blocks yet; `loads`: solids whose loads are recorded, `block_cells`: cells per block.
    #[must_use]
    pub fn new(rules: FreeSurface, loads: usize, block_cells: usize) -> Self {
        Self {
            kinds: Vec::new(),
            fill: Vec::new(),
            flow: Vec::new(),
            lanes: Vec::new(),
            interface: Vec::new(),
            parked: BTreeMap::new(),
            books: Books::default(),
            loads: vec![Load::default(); loads],
            counts: [0; 2],
            inertia: (rules.force == SurfaceForce::ByFillAndInertia).then(Inertia::default),
            free: Vec::new(),
            returned: Vec::new(),
            nothing: vec![GAS; block_cells],
            covered: Vec::new(),
            open: false,
            rules,
        }
    }

    /// Gives all blocks up.
    pub(in crate::solver::fast) fn clear(&mut self) {
        for list in [&mut self.fill, &mut self.flow, &mut self.returned] {
            list.clear();
        }
        self.kinds.clear();
        self.lanes.clear();
        self.interface.clear();
        self.covered.clear();
        self.free.clear();
        if let Some(inertia) = &mut self.inertia {
            inertia.clear();
        }
    }

    /// What the passes read.
    #[must_use]
    pub(crate) fn view(&self) -> SurfaceView<'_> {
        SurfaceView {
            kinds: &self.kinds,
            lanes: &self.lanes,
            fill: &self.fill,
            returned: &self.returned,
            rule: self.rules.force,
        }
    }

    /// Body force of a cell \[F3\] \[F9\]; `None` where it holds no fluid.
    #[must_use]
    pub(crate) fn force_at(&self, number: usize, local: usize, force: &[f64; 3]) -> Option<[f64; 3]> {
        match self.kinds[number][local] {
            Kind::Interface => {
                // Without a record at the very start, where nothing has been accelerated yet.
                let record = self.record(number, local);
                let (acceleration, dry) =
                    record.map_or(([0.0; 3], [0.0; 3]), |cell| (cell.acceleration, cell.dry));
                let weight =
                    interface_force(self.rules.force, force, self.fill[number][local], &acceleration);
                Some(std::array::from_fn(|a| weight[a] + dry[a]))
            }
            Kind::Liquid => Some(*force),
            Kind::Gas | Kind::Solid => None,
        }
    }

    /// Record of a cell.
    #[must_use]
    pub(crate) fn record(&self, number: usize, local: usize) -> Option<&InterfaceCell> {
        let list = &self.interface[number];
        list.binary_search_by_key(&local, |cell| usize::from(cell.local)).ok().map(|k| &list[k])
    }

    /// Kinds of a block into bits; `line`: cells per pack.
    pub(super) fn list_lanes(&mut self, number: usize, line: usize) {
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

    /// Kind of one cell, or whether it has a record, into bits: one of them has changed.
    pub(super) fn list_lane(&mut self, number: usize, local: usize, line: usize) {
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

impl State for Surface {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let Self {
            kinds,
            fill,
            flow,
            lanes,
            interface,
            parked,
            books,
            loads,
            counts,
            inertia,
            free,
            returned,
            covered,
            open,
            rules: _,
            nothing: _,
        } = self;
        kinds.state(tape)?;
        fill.state(tape)?;
        flow.state(tape)?;
        lanes.state(tape)?;
        interface.state(tape)?;
        parked.state(tape)?;
        books.state(tape)?;
        loads.state(tape)?;
        counts.state(tape)?;
        part(inertia, tape)?;
        free.state(tape)?;
        returned.state(tape)?;
        covered.state(tape)?;
        open.state(tape)
    }
}
