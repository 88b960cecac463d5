//! The ledger of mass and momentum \[F5\] and the loads on solids \[C7\].

use super::cells::Wet;
use super::{Surface, SurfacePhysics};
use crate::boundary::links::Source;
use crate::free_surface::Kind;
use crate::free_surface::conversion::touch;
use crate::free_surface::ledger::{Sum, VectorSum};
use crate::lattice::moments::{density_excess, momentum};
use crate::lattice::{Q, opposite};
use crate::solver::balance::{Carrying, LinkEnd};
use crate::solver::books::{CellEntries, Contents, Crossing, Entries};
use crate::solver::cell::Cell;
use crate::solver::loads::arm;
use crate::solver::physics::Physics;
use crate::solver::plain::run::PlainRun;
use crate::solver::run::{Ledger, Runaway, Stopped};

impl<P: Physics, S: SurfacePhysics> PlainRun<P, S> {
    pub(in crate::solver::plain) fn open_books(&mut self) {
        let Some(surface) = &mut self.surface else { return };
        surface.list_special(&self.links);
        surface.books.initial_mass = surface.total_mass(&self.f);
        surface.books.mass = surface.books.initial_mass;
        surface.books.initial_momentum = surface.total_momentum(&self.f);
    }

    /// Books what came in over the links of this step; reads populations after collision and after streaming.
    pub(in crate::solver::plain) fn book_links(&mut self) {
        let force = self.body_force();
        if let Some((cells, _)) = self.wet() {
            let entries = cells.link_entries(&force);
            cells.surface.books.enter(&entries, &mut cells.surface.loads);
        }
    }

    /// Closes the mass of this step.
    ///
    /// # Errors
    /// It does not close within rounding; the cell named is the interface cell with the largest |m| off
    /// its fill. The step is complete all the same.
    pub(in crate::solver::plain) fn close_books(&mut self) -> Result<(), Stopped> {
        let Some(surface) = &mut self.surface else { return Ok(()) };
        let (mass, cells) = (surface.total_mass(&self.f), surface.fluid_count());
        let Some((residual, bound)) = surface.books.close(mass, cells, self.setup.precision.rounding())
        else {
            return Ok(());
        };
        let cell = self.setup.coordinates(surface.worst_cell());
        Err(Stopped { step: self.step, cell, what: Runaway::Ledger { residual, bound }, tau: f64::NAN })
    }
}

impl<P: Physics, S: SurfacePhysics> Wet<'_, P, S> {
    fn link_entries(&self, force: &[f64; 3]) -> Entries {
        let surface = &*self.surface;
        let mut entries = Entries::new(surface.loads.len());
        for &cell in &surface.special {
            let cell = cell as usize;
            let liquid = surface.kinds[cell] == Kind::Liquid;
            let at = self.setup.coordinates(cell);
            let mut own = CellEntries::default();
            for i in 1..Q {
                let source = self.links.source(cell, i);
                let gas = match source {
                    Source::Cell { cell: from, .. } => match surface.kinds[from as usize] {
                        // Links to grains are booked where they are returned.
                        Kind::Solid => continue,
                        Kind::Gas => true,
                        Kind::Interface | Kind::Liquid => false,
                    },
                    Source::Wall { .. } | Source::Open => false,
                };
                let crossing = Crossing {
                    i,
                    leaving: self.post[cell][opposite(i)],
                    arrived: self.f[cell][i],
                    share: if liquid { 1.0 } else { surface.fill[cell] },
                    liquid,
                    at,
                };
                own.link(self.setup, &crossing, &source, gas, &mut entries);
            }
            own.close(&mut entries);
            if !liquid {
                entries.from_walls.add(-surface.handed(self.hand_over, cell));
                if !entries.loads.is_empty() {
                    self.carry(cell, force, &mut entries);
                }
            }
        }
        entries
    }

    /// Loads of an interface cell by balance \[C7\].
    fn carry(&self, cell: usize, force: &[f64; 3], entries: &mut Entries) {
        let surface = &*self.surface;
        let ends = std::array::from_fn(|i| match self.links.source(cell, i) {
            Source::Wall { body, .. } => LinkEnd::Wall(body),
            Source::Open => LinkEnd::Open,
            Source::Cell { cell: from, .. } => {
                LinkEnd::Cell(surface.kinds[from as usize], surface.fill[from as usize])
            }
        });
        let carrying = Carrying {
            fill: [surface.fill[cell], surface.mass[cell] / (1.0 + density_excess(&self.f[cell]))],
            after: &self.post[cell],
            arrived: &self.f[cell],
            force: surface.force_at(self.links, cell, force),
            weight: *force,
            ends,
        };
        let at = self.setup.coordinates(cell);
        carrying.enter(entries, |i, body| arm(self.setup, at, i, body));
    }
}

impl<S: SurfacePhysics> Surface<S> {
    /// Liquid ρ + interface m + parked.
    fn total_mass(&self, f: &[Cell]) -> f64 {
        let mut sum = Sum::default();
        for cell in 0..self.kinds.len() {
            match self.kinds[cell] {
                Kind::Liquid => {
                    sum.add(1.0);
                    sum.add(density_excess(&f[cell]));
                }
                Kind::Interface => sum.add(self.mass[cell]),
                Kind::Gas | Kind::Solid => {}
            }
        }
        for mass in self.parked.values() {
            sum.add(*mass);
        }
        sum.value()
    }

    /// Σ c f over fluid cells.
    fn total_momentum(&self, f: &[Cell]) -> [f64; 3] {
        let mut sum = VectorSum::default();
        for cell in (0..self.kinds.len()).filter(|&cell| self.kinds[cell].is_fluid()) {
            sum.add(&momentum(&f[cell]));
        }
        sum.value()
    }

    /// The interface cell with the largest |m| off its fill; the first cell without any.
    fn worst_cell(&self) -> usize {
        let off = |cell: usize| {
            let off = (self.mass[cell] - self.fill[cell]).abs();
            if off.is_nan() { f64::INFINITY } else { off }
        };
        let special = self.special.iter().map(|&cell| cell as usize);
        special.max_by(|&a, &b| off(a).total_cmp(&off(b))).unwrap_or(0)
    }

    /// The ledger now; `f`: populations.
    pub(in crate::solver::plain) fn ledger(&self, f: &[Cell]) -> Ledger {
        let count = |kind: Kind| self.kinds.iter().filter(|&&k| k == kind).count() as u64;
        let cells = [count(Kind::Liquid), count(Kind::Interface)];
        self.books.ledger(&Contents {
            mass: self.total_mass(f),
            momentum: self.total_momentum(f),
            parked: self.parked.values().sum(),
            voids: self.voids(),
            cells,
        })
    }

    /// Σ (1 − φ) over interface cells without gas neighbour.
    fn voids(&self) -> f64 {
        let mut sum = Sum::default();
        for &cell in &self.special {
            let cell = cell as usize;
            if self.kinds[cell] == Kind::Interface && self.touches[cell] & touch::GAS == 0 {
                sum.add(1.0 - self.fill[cell]);
            }
        }
        sum.value()
    }
}
