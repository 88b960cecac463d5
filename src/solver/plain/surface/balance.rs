//! The ledger of mass and momentum \[F5\] and the loads on solids \[C7\].

use super::SurfaceRun;
use crate::boundary::links::Source;
use crate::free_surface::Kind;
use crate::free_surface::ledger::{Sum, VectorSum};
use crate::lattice::moments::{density_excess, momentum};
use crate::lattice::{C, Q, opposite};
use crate::solver::physics::Physics;
use crate::solver::run::{Ledger, Load, Runaway, Stopped};

/// Everything that was brought in or taken out so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Books {
    pub initial_mass: f64,
    /// Mass at the end of the last step.
    pub mass: f64,
    pub initial_momentum: [f64; 3],
    pub outflow: Sum,
    pub from_walls: Sum,
    pub from_force: VectorSum,
    pub from_faces: VectorSum,
    pub from_solids: VectorSum,
    pub from_gas: VectorSum,
    pub from_conversions: VectorSum,
    pub conversions: u64,
    /// u of the collision before; only for the force rule with inertia.
    pub velocity_before: Vec<[f64; 3]>,
}

/// Roundings per fluid cell and step that the ledger may collect: collision and streaming each lose at
/// most a few units in the last place of numbers well below 1.
const ROUNDINGS: f64 = 32.0;

impl<P: Physics> SurfaceRun<P> {
    pub(super) fn open_books(&mut self) {
        self.books.initial_mass = self.total_mass();
        self.books.mass = self.books.initial_mass;
        self.books.initial_momentum = self.total_momentum();
    }

    /// Liquid ρ + interface m + parked, compensated, in index order.
    pub(super) fn total_mass(&self) -> f64 {
        let mut sum = Sum::default();
        let mut liquid = 0_u64;
        for cell in 0..self.kinds.len() {
            match self.kinds[cell] {
                Kind::Liquid => {
                    liquid += 1;
                    sum.add(density_excess(&self.f[cell]));
                }
                Kind::Interface => sum.add(self.mass[cell]),
                Kind::Gas | Kind::Solid => {}
            }
        }
        for mass in self.parked.values() {
            sum.add(*mass);
        }
        sum.add(liquid as f64);
        sum.value()
    }

    /// Σ c f over fluid cells.
    pub(super) fn total_momentum(&self) -> [f64; 3] {
        let mut sum = VectorSum::default();
        for cell in (0..self.kinds.len()).filter(|&cell| self.kinds[cell].is_fluid()) {
            sum.add(&momentum(&self.f[cell]));
        }
        sum.value()
    }

    /// What came in over the links of this step; reads populations after collision and after streaming.
    pub(super) fn book_links(&mut self) {
        for load in &mut self.loads {
            (load.force, load.wetted) = ([0.0; 3], [[0.0; 2]; 3]);
        }
        for k in 0..self.special.len() {
            let cell = self.special[k] as usize;
            for i in 1..Q {
                self.book_link(cell, i);
            }
        }
        for load in &mut self.loads {
            for a in 0..3 {
                load.impulse[a] += load.force[a];
            }
        }
    }

    #[inline]
    fn book_link(&mut self, cell: usize, i: usize) {
        let out = opposite(i);
        let (leaving, arrived) = (self.post[cell][out], self.f[cell][i]);
        // Arrives with c_i f_i, left with −c_i f_ī.
        let brought = C[i].map(|c| f64::from(c) * (arrived + leaving));
        match self.links.source(cell, i) {
            Source::Cell { cell: from, direction } => {
                if !self.kinds[from as usize].is_fluid() {
                    self.books.from_gas.add(&brought);
                } else if usize::from(direction) != i {
                    // A mirror plane turns momentum round.
                    let turned = C[usize::from(direction)];
                    let change = std::array::from_fn(|a| f64::from(C[i][a] - turned[a]) * arrived);
                    self.books.from_faces.add(&change);
                }
            }
            Source::Open => {
                self.books.from_gas.add(&brought);
                self.books.outflow.add(self.share(cell) * (leaving - arrived));
            }
            Source::Wall { body, .. } => {
                if self.kinds[cell] == Kind::Liquid {
                    self.books.from_walls.add(arrived - leaving);
                }
                if body == 0 {
                    self.books.from_faces.add(&brought);
                    return;
                }
                self.books.from_solids.add(&brought);
                let share = self.share(cell);
                if let Some(load) = self.loads.get_mut(usize::from(body) - 1) {
                    add_load(load, &brought, i, share);
                }
            }
        }
    }

    fn share(&self, cell: usize) -> f64 {
        if self.kinds[cell] == Kind::Liquid { 1.0 } else { self.fill[cell] }
    }

    /// Closes the mass of this step.
    ///
    /// # Errors
    /// It does not close within rounding; the cell named is the interface cell with the largest |m| off
    /// its fill.
    pub(super) fn close_books(&mut self) -> Result<(), Stopped> {
        let mass = self.total_mass();
        let external = self.books.from_walls.value() - self.books.outflow.value();
        let before = self.books.mass;
        self.books.mass = mass - external;
        let residual = (mass - external - before).abs();
        let cells = self.fluid_count();
        let bound = ROUNDINGS * f64::EPSILON * (cells as f64 + self.books.initial_mass);
        if residual <= bound || self.physics.is_mutant() {
            return Ok(());
        }
        let off = |cell: usize| {
            let off = (self.mass[cell] - self.fill[cell]).abs();
            if off.is_nan() { f64::INFINITY } else { off }
        };
        let worst = self.special.iter().map(|&cell| cell as usize).max_by(|&a, &b| off(a).total_cmp(&off(b)));
        let what = Runaway::Ledger { residual: residual / self.books.initial_mass, bound };
        let cell = self.setup.coordinates(worst.unwrap_or(0));
        Err(Stopped { step: self.step, cell, what, tau: f64::NAN })
    }

    pub(super) fn fluid_count(&self) -> u64 {
        self.kinds.iter().filter(|kind| kind.is_fluid()).count() as u64
    }

    pub(super) fn make_ledger(&self) -> Ledger {
        let books = &self.books;
        let (mass, momentum) = (self.total_mass(), self.total_momentum());
        let (outflow, from_walls) = (books.outflow.value(), books.from_walls.value());
        let parts =
            [books.from_force, books.from_faces, books.from_solids, books.from_gas, books.from_conversions]
                .map(|sum| sum.value());
        let mut worst = 0.0_f64;
        for a in 0..3 {
            let mut sum = Sum::default();
            sum.add(momentum[a] - books.initial_momentum[a]);
            for part in &parts {
                sum.add(-part[a]);
            }
            worst = if sum.value().abs() > worst { sum.value().abs() } else { worst };
        }
        let count = |kind: Kind| self.kinds.iter().filter(|&&k| k == kind).count() as u64;
        Ledger {
            initial_mass: books.initial_mass,
            mass,
            parked: self.parked.values().sum(),
            outflow,
            from_walls,
            mass_residual: (((mass - books.initial_mass) + outflow) - from_walls) / books.initial_mass,
            momentum,
            from_force: parts[0],
            from_faces: parts[1],
            from_solids: parts[2],
            from_gas: parts[3],
            from_conversions: parts[4],
            momentum_residual: worst,
            liquid_cells: count(Kind::Liquid),
            interface_cells: count(Kind::Interface),
            conversions: books.conversions,
        }
    }
}

/// Adds one link to a load: the solid gets what the fluid loses.
fn add_load(load: &mut Load, brought: &[f64; 3], i: usize, share: f64) {
    for a in 0..3 {
        load.force[a] -= brought[a];
    }
    // The wall lies along −c_i; axis links are the cell faces.
    if let Some(axis) = (0..3).find(|&a| C[i] == unit(a, 1) || C[i] == unit(a, -1)) {
        let side = usize::from(C[i][axis] > 0);
        load.wetted[axis][side] += share;
    }
}

fn unit(axis: usize, sign: i32) -> [i32; 3] {
    let mut c = [0; 3];
    c[axis] = sign;
    c
}
