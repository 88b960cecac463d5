//! What the coupling needs from a backend.

use crate::free_surface::Kind;
use crate::free_surface::conversion::Cells;
use crate::lattice::Q;
use crate::setup::Setup;

/// A cell that a grain has given free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Uncovered {
    /// Gas, interface or liquid.
    pub kind: Kind,
    /// Populations before the next collision, f − w; zero in gas.
    pub populations: [f64; Q],
    /// m of an interface cell.
    pub mass: f64,
}

/// Where a backend keeps one population.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Place {
    /// Block, or cell.
    pub block: u32,
    /// Place in it.
    pub index: u32,
}

/// The cells of a run with grains, besides what conversions need of them; covered cells are solid.
pub(crate) trait Host: Cells + Sync {
    /// The set-up.
    fn setup(&self) -> &Setup;
    /// What a wall moving with `u` adds to a half-way link along c_i from a cell of density `rho` \[B1\], with the
    /// cubic part of the equilibrium.
    fn moving_wall(&self, i: usize, rho: f64, u: &[f64; 3]) -> f64;
    /// Steps taken so far.
    fn step_number(&self) -> u64;
    /// Populations after the last collision; the cell is fluid or was at that collision.
    fn after(&self, cell: usize) -> [f64; Q];
    /// A number as a population is kept.
    fn stored(&self, value: f64) -> f64;
    /// Population `i` after the last collision, if the cell holds fluid.
    fn fluid_one(&self, cell: usize, i: usize) -> Option<f64>;
    /// Where population `i` of a covered cell is kept, until cells are covered or uncovered again.
    fn place(&self, cell: usize, i: usize) -> Place;
    /// Puts there what streaming will take out of the covered cell.
    fn put(&mut self, place: Place, value: f64);
    /// Fluid or gas becomes solid.
    fn cover(&mut self, cell: usize);
    /// A covered cell becomes something else.
    fn uncover(&mut self, cell: usize, to: &Uncovered);
    /// Takes the excess mass parked in a cell.
    fn take_parked(&mut self, cell: usize) -> f64;
    /// Books mass and momentum that came into the fluid from grains.
    fn book(&mut self, mass: f64, momentum: &[f64; 3]);
    /// Liquid and interface cells.
    fn fluid_count(&self) -> u64;
    /// The backend's threads.
    fn pool(&self) -> Option<&rayon::ThreadPool>;
}
