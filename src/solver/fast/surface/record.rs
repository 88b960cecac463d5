//! What is kept of interface cells, and what passes read of it.

use crate::free_surface::Kind;
use crate::free_surface::force::interface_force;
use crate::lattice::Q;
use crate::setup::SurfaceForce;
use crate::state::state;

/// A cell whose populations are kept: interface, or liquid since the last step.
#[derive(Clone, Debug, Default)]
pub(crate) struct InterfaceCell {
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
    /// What it takes back in the next collision \[F9\].
    pub dry: [f64; 3],
    /// Mean smoothed acceleration of the liquid neighbours; zero unless the surface force has inertia.
    pub acceleration: [f64; 3],
}

state!(InterfaceCell: local touches f rho velocity mass dry acceleration);
state!(Lanes: fluid interface kept);

/// Lanes of a pack, a bit each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Lanes {
    /// Liquid or interface.
    pub fluid: u16,
    /// Interface.
    pub interface: u16,
    /// With a record: interface, or liquid since the last step.
    pub kept: u16,
}

/// What the passes read of the surface.
#[derive(Clone, Copy)]
pub(crate) struct SurfaceView<'a> {
    /// By block and cell.
    pub kinds: &'a [Vec<Kind>],
    /// By block and pack.
    pub lanes: &'a [Vec<Lanes>],
    /// φ of interface cells, by block and cell.
    pub fill: &'a [Vec<f64>],
    /// What walls and open faces send back to liquid cells, by block and irregular link.
    pub returned: &'a [Vec<f64>],
    /// How the body force acts in interface cells.
    pub rule: SurfaceForce,
}

impl SurfaceView<'_> {
    /// Body force of an interface cell \[F3\] \[F9\].
    #[inline]
    #[must_use]
    pub(crate) fn force_of(&self, number: usize, cell: &InterfaceCell, force: &[f64; 3]) -> [f64; 3] {
        let fill = self.fill[number][usize::from(cell.local)];
        let weight = interface_force(self.rule, force, fill, &cell.acceleration);
        std::array::from_fn(|a| weight[a] + cell.dry[a])
    }
}
