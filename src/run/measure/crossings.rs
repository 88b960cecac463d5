//! Grains that cross a plane.

use crate::dem::V3;
use crate::geometry::Axis;
use crate::run::view::View;
use crate::state::state;

/// A plane, and what has crossed it since it was first looked at.
#[derive(Clone, Debug)]
pub(super) struct Crossings {
    normal: Axis,
    at_m: f64,
    /// Mass, kg, towards larger coordinates less back.
    pub mass_kg: f64,
    /// Number, likewise.
    pub number: f64,
    /// The side each grain was on, by its number at time 0; nothing before the first look.
    sides: Vec<i64>,
}

state!(Crossings: mass_kg number sides; but normal at_m);

impl Crossings {
    pub fn new(normal: Axis, at_m: f64) -> Self {
        Self { normal, at_m, mass_kg: 0.0, number: 0.0, sides: Vec::new() }
    }

    /// How many planes of a periodic row lie below a place; 0 or 1 on an axis that is not periodic.
    fn side(&self, x: V3, grains: &View<'_>) -> i64 {
        let k = self.normal.index();
        match grains.setup.period.0[k] {
            Some(length) => ((x[k] - self.at_m) / length).floor() as i64 + 1,
            None => i64::from(x[k] >= self.at_m),
        }
    }

    /// Adds the free grains that have changed sides since the last look. The first look must be at time 0, when all
    /// grains are there.
    pub(crate) fn look(&mut self, grains: &View<'_>) {
        let b = grains.dem.bodies();
        if self.sides.is_empty() {
            self.sides = b.position.iter().map(|x| self.side(*x, grains)).collect();
        }
        for i in grains.free() {
            let (id, now) = (grains.ids[i] as usize, self.side(b.position[i], grains));
            let moved = (now - self.sides[id]) as f64;
            self.sides[id] = now;
            self.mass_kg += moved * b.mass[i];
            self.number += moved;
        }
    }
}
