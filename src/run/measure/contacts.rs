//! Forces of contacts and of the gaps before them on the solids in a fluid, gathered step by step.

use super::quantity::{Quantity, several, vector};
use crate::coupling::Immersed;
use crate::dem::V3;
use crate::plan::grains::Walls;
use crate::state::{State, StateError, Tape, fixed, state};

/// Force on a solid since the last row, and since time 0.
#[derive(Clone, Copy, Debug, Default)]
struct OnSolid {
    /// Sum over steps, N.
    sum: V3,
    steps: u64,
    /// Largest, N.
    peak: f64,
    /// N s.
    impulse: V3,
}

/// Forces on all solids.
pub(in crate::run) struct Contacts<'a> {
    walls: &'a Walls,
    on: Vec<OnSolid>,
}

state!(OnSolid: sum steps peak impulse);

impl State for Contacts<'_> {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let Self { on, walls: _ } = self;
        fixed(on, tape)
    }
}

impl<'a> Contacts<'a> {
    pub fn new(walls: &'a Walls) -> Self {
        Self { walls, on: vec![OnSolid::default(); walls.solids.len()] }
    }

    /// Adds the forces of a step of `dt_s` seconds.
    pub(crate) fn sample(&mut self, grains: &Immersed, dt_s: f64) {
        for (of, (_, walls)) in self.on.iter_mut().zip(&self.walls.solids) {
            let on = |wall: usize| grains.dem().force_on_wall(wall).0 + grains.lubrication_on_wall(wall);
            let force = walls.iter().fold(V3::zeros(), |sum, &wall| sum + on(wall));
            of.sum += force;
            of.steps += 1;
            of.peak = of.peak.max(force.norm());
            of.impulse += force * dt_s;
        }
    }

    /// Means and largest values start anew.
    pub(crate) fn restart(&mut self) {
        for of in &mut self.on {
            *of = OnSolid { impulse: of.impulse, ..OnSolid::default() };
        }
    }

    /// Mean and largest force since the last row, impulse since time 0.
    pub(crate) fn on(&self, solid: &str) -> Vec<Quantity> {
        let at = self.walls.solids.iter().position(|(name, _)| name == solid);
        let of = at.and_then(|k| self.on.get(k)).copied().unwrap_or_default();
        let mean = of.sum / of.steps.max(1) as f64;
        let mut row = vector("contact", "N", mean.into());
        row.extend(several([("contact_peak", "N", of.peak)]));
        row.extend(vector("contact_impulse", "N s", of.impulse.into()));
        row
    }
}
