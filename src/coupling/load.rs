//! What acts on a grain, and what its surface returns to the fluid \[C2\].

use super::L3;
use super::host::Place;
use crate::state::state;

/// Force and torque on one grain in the last step, lattice units: (F, T).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyLoad {
    /// Over links to fluid cells \[C2\].
    pub links: [f64; 6],
    /// Of fluid too thin for a cell, between the grain and walls or other grains.
    pub held: [f64; 6],
    /// Pressure gradients besides the computed pressure.
    pub rest: [f64; 6],
    /// Links to fluid cells.
    pub wet_links: u32,
}

state!(BodyLoad: links held rest wet_links);

impl BodyLoad {
    /// All of it: what the fluid does to the grain, without lubrication.
    #[must_use]
    pub fn total(&self) -> [f64; 6] {
        std::array::from_fn(|a| self.links[a] + self.held[a] + self.rest[a])
    }
}

/// What goes to the cells and to the books.
#[derive(Clone, Debug, Default)]
pub(super) struct Returned {
    /// Populations of covered cells.
    pub values: Vec<(Place, f64)>,
    /// (interface cell, mass that it gets).
    pub gained: Vec<(u32, f64)>,
    pub load: BodyLoad,
    /// Mass that came into the fluid over links.
    pub mass: f64,
    /// Of this into liquid, less the volume that the surface displaces there at the reference density.
    pub excess: f64,
    /// Momentum that came into the fluid over links.
    pub momentum: L3,
}

impl Returned {
    /// Empty, with the room it has.
    pub(crate) fn start(&mut self) {
        let (mut values, mut gained) = (std::mem::take(&mut self.values), std::mem::take(&mut self.gained));
        values.clear();
        gained.clear();
        *self = Self { values, gained, ..Self::default() };
    }
}
