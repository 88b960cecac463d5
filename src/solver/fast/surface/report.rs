//! Sums and fields of a run with a free surface.

use super::inertia::Inertia;
use super::record::InterfaceCell;
use super::state::Surface;
use crate::fingerprint::Hasher;
use crate::free_surface::Kind;
use crate::free_surface::conversion::touch;
use crate::free_surface::ledger::{Sum, VectorSum};
use crate::lattice::moments::{Moments, density_excess, momentum};
use crate::solver::books::Contents;
use crate::solver::fast::element::Element;
use crate::solver::fast::run::FastRun;
use crate::solver::physics::Physics;
use crate::solver::run::{Fields, Ledger};

impl Surface {
    /// Fill and kind of every cell of the box.
    pub(crate) fn start_fields<P: Physics, E: Element>(&self, run: &FastRun<P, E>, fields: &mut Fields) {
        let cells = run.setup.cells();
        fields.fill = vec![0.0; cells];
        let kind = |cell: usize| if run.setup.is_solid(cell) { Kind::Solid } else { Kind::Gas } as u8;
        fields.kind = (0..cells).map(kind).collect();
        for (cell, number, local) in run.in_order() {
            fields.kind[cell] = self.kinds[number][local] as u8;
        }
        if let Some(grains) = &run.grains {
            for cell in (0..cells).filter(|&cell| grains.is_covered(cell)) {
                fields.kind[cell] = Kind::Solid as u8;
            }
        }
    }

    /// φ of a fluid cell of density `rho`, as it is.
    #[must_use]
    pub(crate) fn fill_of(&self, number: usize, local: usize, rho: f64) -> f64 {
        match self.kinds[number][local] {
            Kind::Liquid => 1.0,
            Kind::Interface | Kind::Gas | Kind::Solid => self.mass(number, local) / rho,
        }
    }

    fn mass(&self, number: usize, local: usize) -> f64 {
        match self.kinds[number][local] {
            Kind::Interface => self.record(number, local).map_or(0.0, |record| record.mass),
            Kind::Liquid | Kind::Gas | Kind::Solid => 0.0,
        }
    }

    /// What a cell takes back in the next collision; 0 unless it is interface.
    pub(crate) fn dry_at(&self, number: usize, local: usize) -> [f64; 3] {
        match self.kinds[number][local] {
            Kind::Interface => self.record(number, local).map_or([0.0; 3], |record| record.dry),
            Kind::Liquid | Kind::Gas | Kind::Solid => [0.0; 3],
        }
    }

    /// Mass of a fluid cell, as an excess over 1 in liquid, and whole.
    #[must_use]
    pub(crate) fn mass_of(&self, number: usize, local: usize, m: &Moments<f64>) -> (f64, f64) {
        match self.kinds[number][local] {
            Kind::Liquid => (m.d_rho, m.rho),
            Kind::Interface | Kind::Gas | Kind::Solid => (self.mass(number, local), self.mass(number, local)),
        }
    }

    /// Σ (1 − φ) over interface cells without gas neighbour.
    fn voids(&self) -> f64 {
        let mut sum = Sum::default();
        for (number, list) in self.interface.iter().enumerate() {
            for cell in list.iter().filter(|cell| cell.touches & touch::GAS == 0) {
                let local = usize::from(cell.local);
                if self.kinds[number][local] == Kind::Interface {
                    sum.add(1.0 - self.fill[number][local]);
                }
            }
        }
        sum.value()
    }

    /// Number, kind and mass of a cell.
    pub(crate) fn hash_cell(&self, hasher: &mut Hasher, cell: usize, number: usize, local: usize) {
        hasher.number(cell as f64);
        hasher.number(f64::from(self.kinds[number][local] as u8));
        hasher.number(self.mass(number, local));
    }

    /// Cells with fluid.
    #[must_use]
    pub(crate) fn fluid_cells(&self) -> u64 {
        self.counts[0] + self.counts[1]
    }

    /// Bytes held.
    #[must_use]
    pub(crate) fn bytes(&self) -> u64 {
        let kinds: usize = self.kinds.iter().map(Vec::len).sum();
        let fill: usize = self.fill.iter().map(|fill| size_of_val(fill.as_slice())).sum();
        let flow: usize = self.flow.iter().map(|flow| size_of_val(flow.as_slice())).sum();
        let lanes: usize = self.lanes.iter().map(|lanes| size_of_val(lanes.as_slice())).sum();
        let records: usize =
            self.interface.iter().map(|list| list.capacity() * size_of::<InterfaceCell>()).sum();
        let returned: usize = self.returned.iter().map(|links| size_of_val(links.as_slice())).sum();
        let inertia = self.inertia.as_ref().map_or(0, Inertia::bytes);
        (kinds + fill + flow + lanes + records + returned) as u64 + inertia
    }
}

impl<P: Physics, E: Element> FastRun<P, E> {
    pub(super) fn open_books(&mut self) {
        let (mass, momentum) = self.mass_and_momentum();
        if let Some(surface) = &mut self.surface {
            surface.books.initial_mass = mass;
            surface.books.mass = mass;
            surface.books.initial_momentum = momentum;
        }
    }

    /// Liquid ρ + interface m + parked, and Σ c f.
    fn mass_and_momentum(&self) -> (f64, [f64; 3]) {
        let (mut mass, mut total) = (Sum::default(), VectorSum::default());
        let Some(surface) = &self.surface else { return (0.0, [0.0; 3]) };
        for (number, kinds) in surface.kinds.iter().enumerate() {
            for (local, kind) in kinds.iter().enumerate().filter(|(_, kind)| kind.is_fluid()) {
                let f = self.arrived(number, local);
                if *kind == Kind::Liquid {
                    mass.add(1.0);
                    mass.add(density_excess(&f));
                } else {
                    mass.add(surface.mass(number, local));
                }
                total.add(&momentum(&f));
            }
        }
        for parked in surface.parked.values() {
            mass.add(*parked);
        }
        (mass.value(), total.value())
    }

    pub(in crate::solver::fast) fn make_ledger(&self) -> Option<Ledger> {
        let surface = self.surface.as_ref()?;
        let (mass, momentum) = self.mass_and_momentum();
        Some(surface.books.ledger(&Contents {
            mass,
            momentum,
            parked: surface.parked.values().sum(),
            voids: surface.voids(),
            cells: surface.counts,
        }))
    }
}
