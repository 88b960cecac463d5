//! What a run keeps besides populations where cells have kinds: below a free surface, or with grains.
//!
//! Mass is exchanged between collision and streaming; marks, conversions and the ledger follow \[F4\]
//! \[F5\]. Every pass writes only its own cell and reads arrays that no other cell of the pass writes.

mod balance;
pub(super) mod cells;
mod convert;
mod dry;
mod equations;
mod exchange;
mod force;

use std::collections::BTreeMap;

use crate::boundary::links::{CellKind, Links};
use crate::free_surface::conversion::touch;
use crate::free_surface::{Kind, classify, hydrostatic};
use crate::lattice::Q;
use crate::lattice::moments::density_excess;
use crate::setup::{FreeSurface, Setup, SurfaceForce};
use crate::solver::books::Books;
use crate::solver::cell::Cell;
use crate::solver::loads::recorded;
use crate::solver::run::{Load, StartError};
use crate::state::state;
pub use equations::{Collided, Design, SurfaceLink, SurfacePhysics};

/// Kinds of cells, their masses and books.
pub(super) struct Surface<S> {
    pub(super) rules: FreeSurface,
    equations: S,
    pub(super) kinds: Vec<Kind>,
    /// m of interface cells; 0 elsewhere.
    pub(super) mass: Vec<f64>,
    /// φ: m/ρ limited to 0..1 in interface cells, 1 in liquid, 0 elsewhere.
    fill: Vec<f64>,
    /// u of the last collision.
    pub(super) velocity: Vec<[f64; 3]>,
    /// Smoothed acceleration; only for the rule with inertia.
    pub(super) acceleration: Vec<[f64; 3]>,
    /// u of the collision before; only for the rule with inertia, and empty before its first one.
    velocity_before: Vec<[f64; 3]>,
    /// What interface cells take back in the next collision \[F9\]; 0 elsewhere.
    pub(super) dry: Vec<[f64; 3]>,
    /// What each interface cell touches, as bits of [`crate::free_surface::conversion::touch`].
    touches: Vec<u8>,
    /// Excess mass without receiver, by cell \[F6\].
    pub(super) parked: BTreeMap<u32, f64>,
    /// Fluid cells that are interface or have a boundary record, in index order.
    special: Vec<u32>,
    pub(super) books: Books,
    pub(super) loads: Vec<Load>,
}

state!(Surface<S>:
    kinds mass fill velocity acceleration velocity_before dry touches parked special books loads; but rules equations
);

impl<S: SurfacePhysics> Surface<S> {
    /// Kinds and fill as drawn; `None` where fluid fills every cell that is not solid and no grains come.
    ///
    /// # Errors
    /// The setup has several fluids.
    pub(super) fn new(setup: &Setup, links: &Links, equations: S) -> Result<Option<Self>, StartError> {
        let rules = match (&setup.free_surface, &setup.grains) {
            (Some(surface), _) => surface.clone(),
            (None, Some(_)) => FreeSurface::new(vec![1.0; setup.cells()]),
            (None, None) => return Ok(None),
        };
        if setup.fluids.len() > 1 {
            let feature = "several fluids below a free surface";
            return Err(StartError::Unsupported { backend: "plain", feature });
        }
        let cells = setup.cells();
        let kinds = classify(
            &rules.fill,
            |cell| setup.is_solid(cell),
            |cell| (1..Q).filter_map(|i| links.neighbour_along(cell, i)).collect::<Vec<_>>(),
        );
        let fill = (0..cells)
            .map(|cell| match kinds[cell] {
                Kind::Liquid => 1.0,
                Kind::Interface => rules.fill[cell],
                Kind::Gas | Kind::Solid => 0.0,
            })
            .collect();
        let inertia = rules.force == SurfaceForce::ByFillAndInertia;
        Ok(Some(Self {
            rules,
            equations,
            kinds,
            mass: vec![0.0; cells],
            fill,
            velocity: vec![[0.0; 3]; cells],
            acceleration: vec![[0.0; 3]; if inertia { cells } else { 0 }],
            velocity_before: Vec::new(),
            dry: vec![[0.0; 3]; cells],
            // Nobody has looked yet; what touches no gas is a void.
            touches: vec![touch::GAS; cells],
            parked: BTreeMap::new(),
            special: Vec::new(),
            books: Books::default(),
            loads: vec![Load::default(); recorded(setup)],
        }))
    }

    /// ρ − 1 of every cell of a fluid at rest below its surface; empty where nothing says where the pressure is
    /// that of the gas.
    pub(super) fn excess_at_rest(&self, setup: &Setup) -> Vec<f64> {
        if setup.initial.is_some() || setup.free_surface.is_none() {
            return Vec::new();
        }
        let periodic = setup.periodic_axes();
        hydrostatic::density_excess(setup.extents, periodic, &self.kinds, &self.fill, &setup.force.at(0))
    }

    /// Velocity and mass of a fluid cell with these populations.
    pub(super) fn start_cell(&mut self, cell: usize, f: &Cell, velocity: &[f64; 3]) {
        self.velocity[cell] = *velocity;
        if self.kinds[cell] == Kind::Interface {
            self.mass[cell] = self.fill[cell] * (1.0 + density_excess(f));
        }
    }

    /// Looks for the cells whose links have to be booked or that may convert.
    pub(super) fn list_special(&mut self, links: &Links) {
        let boundary =
            |cell: usize| !matches!(links.kind(cell), CellKind::Bulk) && self.kinds[cell].is_fluid();
        self.special = (0..self.kinds.len())
            .filter(|&cell| self.kinds[cell] == Kind::Interface || boundary(cell))
            .map(|cell| cell as u32)
            .collect();
    }

    /// Mass of a fluid cell, as an excess over 1 in liquid, and whole.
    pub(super) fn mass_of(&self, cell: usize, d_rho: f64, rho: f64) -> (f64, f64) {
        if self.kinds[cell] == Kind::Liquid { (d_rho, rho) } else { (self.mass[cell], self.mass[cell]) }
    }

    /// φ of a fluid cell of density `rho`, as it is.
    pub(super) fn fill_of(&self, cell: usize, rho: f64) -> f64 {
        if self.kinds[cell] == Kind::Liquid { 1.0 } else { self.mass[cell] / rho }
    }

    /// Cells with fluid.
    pub(super) fn fluid_count(&self) -> u64 {
        self.kinds.iter().filter(|kind| kind.is_fluid()).count() as u64
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> u64 {
        let vectors =
            (self.velocity.len() + self.acceleration.len() + self.velocity_before.len() + self.dry.len())
                * size_of::<[f64; 3]>();
        let numbers = (self.mass.len() + self.fill.len() + self.rules.fill.len()) * size_of::<f64>();
        let marks = self.kinds.len() + self.touches.len();
        (vectors + numbers + marks) as u64
    }
}
