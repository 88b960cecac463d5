//! Conversions of one step \[F4\] \[F6\]: the blocks of this backend for [`crate::free_surface::conversion`].

use std::collections::BTreeMap;

use super::record::InterfaceCell;
use crate::boundary::links::{Source, resolve};
use crate::free_surface::Kind;
use crate::free_surface::conversion::{Cells, convert, fill_of, touch, verdict};
use crate::free_surface::exchange::{GAS, LIQUID};
use crate::free_surface::marks::{Mark, Touches, mark};
use crate::lattice::Q;
use crate::lattice::moments::{density_excess, moments};
use crate::setup::YieldTreatment;
use crate::solver::fast::element::Element;
use crate::solver::fast::layout::NONE;
use crate::solver::fast::run::FastRun;
use crate::solver::physics::Physics;
use crate::solver::pool::each;

impl<P: Physics, E: Element> FastRun<P, E> {
    /// Marks, conversions, refill and excess of one step; then φ of every interface cell.
    pub(super) fn convert_cells(&mut self, force: &[f64; 3]) {
        let marks = self.marks();
        let Some(surface) = &mut self.surface else { return };
        if !marks.is_empty() || !surface.parked.is_empty() {
            let rules = surface.rules.clone();
            let mut parked = std::mem::take(&mut surface.parked);
            let step = self.step;
            let turnover = convert(self, &rules, &marks, &mut parked, (step, force));
            let Some(surface) = &mut self.surface else { return };
            surface.parked = parked;
            surface.books.from_conversions.merge(&turnover.momentum);
            surface.books.conversions += turnover.conversions;
            surface.books.outflow.add(turnover.outflow);
        }
        let Some(surface) = &mut self.surface else { return };
        let items: Vec<_> = surface.fill.iter_mut().zip(&surface.kinds).zip(&surface.interface).collect();
        each(self.pool.as_deref(), items, |((fill, kinds), list)| {
            for cell in list {
                let local = usize::from(cell.local);
                if kinds[local] == Kind::Interface {
                    fill[local] = fill_of(cell.mass, cell.rho);
                }
            }
        });
    }

    /// Interface cells that fill or empty, before reverting.
    fn marks(&self) -> BTreeMap<u32, Mark> {
        let Some(surface) = &self.surface else { return BTreeMap::new() };
        let rules = &surface.rules;
        let items: Vec<_> =
            surface.interface.iter().enumerate().filter(|(_, list)| !list.is_empty()).collect();
        let lists = each(self.pool.as_deref(), items, |(number, list): (usize, &Vec<InterfaceCell>)| {
            let mut marks = Vec::new();
            for cell in list {
                let number_in_box = || self.number_in_box(number, usize::from(cell.local));
                // Most cells touch liquid; only the others have to look further.
                let verdict = if cell.touches & touch::LIQUID != 0 {
                    let touches = Touches { gas: cell.touches & touch::GAS != 0, liquid: true, held: true };
                    mark(cell.mass, cell.rho, touches, rules.margin, rules.lonely_margin)
                } else {
                    verdict(self, rules, number_in_box(), cell.rho)
                };
                if verdict != Mark::Stay {
                    marks.push((number_in_box() as u32, verdict));
                }
            }
            marks
        });
        lists.into_iter().flatten().collect()
    }

    pub(super) fn number_in_box(&self, number: usize, local: usize) -> usize {
        self.setup.index(self.layout.cell(self.blocks[number].origin, local))
    }

    /// Block and place of a cell of the box, if it has a block.
    pub(in crate::solver::fast) fn find(&self, cell: usize) -> Option<(usize, usize)> {
        let (place, local) = self.layout.find(self.setup.coordinates(cell));
        let number = self.layout.block_at(place);
        (number != NONE).then_some((number as usize, local))
    }

    pub(in crate::solver::fast) fn record_of(&self, cell: usize) -> Option<&InterfaceCell> {
        let (number, local) = self.find(cell)?;
        self.surface.as_ref()?.record(number, local)
    }

    fn record_of_mut(&mut self, cell: usize) -> Option<&mut InterfaceCell> {
        let (number, local) = self.find(cell)?;
        let list = &mut self.surface.as_mut()?.interface[number];
        list.binary_search_by_key(&local, |cell| usize::from(cell.local)).ok().map(|k| &mut list[k])
    }

    /// Changes the kind of a cell; `record`: what is kept of it from now on.
    pub(in crate::solver::fast) fn change(
        &mut self,
        cell: usize,
        kind: Kind,
        fill: Option<f64>,
        record: Option<InterfaceCell>,
    ) {
        let Some((number, local)) = self.find(cell) else { return };
        let Some(surface) = &mut self.surface else { return };
        for (of, step) in [(surface.kinds[number][local], u64::MAX), (kind, 1)] {
            match of {
                Kind::Liquid => surface.counts[0] = surface.counts[0].wrapping_add(step),
                Kind::Interface => surface.counts[1] = surface.counts[1].wrapping_add(step),
                Kind::Gas | Kind::Solid => {}
            }
        }
        surface.kinds[number][local] = kind;
        if let Some(fill) = fill {
            surface.fill[number][local] = fill;
        }
        let list = &mut surface.interface[number];
        let place = list.binary_search_by_key(&local, |cell| usize::from(cell.local));
        match (place, record) {
            (Ok(k), Some(record)) => list[k] = record,
            (Err(k), Some(record)) => list.insert(k, record),
            (Ok(k), None) if !kind.is_fluid() => {
                list.remove(k);
            }
            (Ok(_) | Err(_), None) => {}
        }
        surface.list_lane(number, local, E::PER_LINE);
    }
}

impl<P: Physics, E: Element> Cells for FastRun<P, E> {
    fn source(&self, cell: usize, i: usize) -> Source {
        resolve(&self.setup, self.setup.coordinates(cell), i).0
    }
    fn kind(&self, cell: usize) -> Kind {
        match (self.find(cell), &self.surface) {
            (Some((number, local)), Some(surface)) => surface.kinds[number][local],
            _ if self.setup.is_solid(cell) => Kind::Solid,
            _ => Kind::Gas,
        }
    }
    fn fill(&self, cell: usize) -> f64 {
        match (self.find(cell), &self.surface) {
            (Some((number, local)), Some(surface)) => {
                // Cells that have just become interface still hold what they were.
                surface.fill[number][local].clamp(0.0, 1.0)
            }
            _ => 0.0,
        }
    }
    fn mass(&self, cell: usize) -> f64 {
        self.record_of(cell).map_or(0.0, |record| record.mass)
    }
    fn touches(&self, cell: usize) -> u8 {
        self.record_of(cell).map_or(0, |record| record.touches)
    }
    fn populations(&self, cell: usize) -> [f64; Q] {
        self.find(cell).map_or([0.0; Q], |(number, local)| self.arrived(number, local))
    }
    fn fill_up(&mut self, cell: usize) {
        // Its record stays for one collision: what came from the gas is nowhere else.
        self.change(cell, Kind::Liquid, Some(LIQUID), None);
    }
    fn empty(&mut self, cell: usize) {
        self.change(cell, Kind::Gas, Some(GAS), None);
    }
    fn expose(&mut self, cell: usize, mass: f64) {
        let f = self.populations(cell);
        let local = self.find(cell).map_or(0, |(_, local)| local as u16);
        let rho = 1.0 + density_excess(&f);
        let record = InterfaceCell {
            local,
            touches: touch::GAS,
            f,
            rho,
            velocity: [0.0; 3],
            mass,
            dry: [0.0; 3],
            acceleration: [0.0; 3],
        };
        self.change(cell, Kind::Interface, None, Some(record));
    }
    fn wet(&mut self, cell: usize, populations: &[f64; Q]) {
        let (place, local) = self.layout.find(self.setup.coordinates(cell));
        if self.layout.block_at(place) == NONE {
            self.add_surface_block(place);
        }
        let f = *populations;
        let velocity = moments(&f, &[0.0; 3]).u;
        let rho = 1.0 + density_excess(&f);
        let record = InterfaceCell {
            local: local as u16,
            touches: touch::GAS,
            f,
            rho,
            velocity,
            mass: 0.0,
            dry: [0.0; 3],
            acceleration: [0.0; 3],
        };
        self.change(cell, Kind::Interface, None, Some(record));
        if let Some((number, local)) = self.find(cell)
            && let Some(inertia) = self.surface.as_mut().and_then(|surface| surface.inertia.as_mut())
        {
            inertia.wet(number, local, &velocity);
        }
        if let (YieldTreatment::LaggedClamped { tau_max, .. }, Some((number, local))) =
            (self.setup.yielding, self.find(cell))
        {
            self.lag[number][local] = 1.0 / tau_max;
        }
    }
    fn add_mass(&mut self, cell: usize, mass: f64) {
        if let Some(record) = self.record_of_mut(cell) {
            record.mass += mass;
        }
    }
}
