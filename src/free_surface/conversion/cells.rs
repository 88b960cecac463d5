//! What conversions need to know of a run, and may do to its cells.

use super::Cell;
use crate::boundary::links::Source;
use crate::free_surface::Kind;

/// Bits of [`Cells::touches`].
pub mod touch {
    /// A gas neighbour.
    pub(crate) const GAS: u8 = 1;
    /// A liquid neighbour.
    pub(crate) const LIQUID: u8 = 2;
    /// A wall or solid.
    pub(crate) const WALL: u8 = 4;
}

/// The cells of a run, by number in the box, between streaming and the next collision.
pub trait Cells {
    /// Source of population `i` of a cell that is not solid.
    fn source(&self, cell: usize, i: usize) -> Source;
    /// Kind of a cell.
    fn kind(&self, cell: usize) -> Kind;
    /// φ before this step's exchange.
    fn fill(&self, cell: usize) -> f64;
    /// m of an interface cell.
    fn mass(&self, cell: usize) -> f64;
    /// What an interface cell touched while streaming, bits of [`touch`].
    fn touches(&self, cell: usize) -> u8;
    /// Populations of a fluid cell.
    fn populations(&self, cell: usize) -> Cell;
    /// Interface becomes liquid.
    fn fill_up(&mut self, cell: usize);
    /// Interface becomes gas.
    fn empty(&mut self, cell: usize);
    /// Liquid becomes interface with this mass.
    fn expose(&mut self, cell: usize, mass: f64);
    /// Gas becomes interface without mass, with these populations.
    fn wet(&mut self, cell: usize, populations: &Cell);
    /// Adds to m of an interface cell.
    fn add_mass(&mut self, cell: usize, mass: f64);
    /// Mass that a conversion leaves over, see [`excess()`](super::excess::excess).
    fn excess(&self, mass: f64, full: f64) -> f64 {
        super::excess::excess(mass, full)
    }
    /// The cell that population `i` comes from; `None` at walls, solids and open faces.
    fn neighbour_along(&self, cell: usize, i: usize) -> Option<usize> {
        match self.source(cell, i) {
            Source::Cell { cell, .. } => Some(cell as usize),
            Source::Wall { .. } | Source::Open => None,
        }
    }
}
