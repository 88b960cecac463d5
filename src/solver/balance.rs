//! Loads that partly filled cells put on solids, by balance of what their mass carries \[C7\].

use super::books::Entries;
use super::loads::Pull;
use crate::free_surface::Kind;
use crate::free_surface::exchange::wetted_share;
use crate::lattice::moments::momentum;
use crate::lattice::{C, Q, opposite};

/// The directions along the axes.
const AXES: std::ops::RangeInclusive<usize> = 1..=6;

/// What lies at the other end of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum LinkEnd {
    /// Cell of this kind and fill; cells covered by grains give what they return in full.
    Cell(Kind, f64),
    /// Wall or solid of this number.
    Wall(u8),
    /// Open face.
    Open,
}

/// An interface cell beside solids during one step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Carrying<'a> {
    /// φ at the start of the step and at its end.
    pub fill: [f64; 2],
    /// Populations after collision.
    pub after: &'a [f64; Q],
    /// Populations after streaming.
    pub arrived: &'a [f64; Q],
    /// Force that acted in the collision.
    pub force: [f64; 3],
    /// Body force of the bulk.
    pub weight: [f64; 3],
    /// By arriving direction.
    pub ends: [LinkEnd; Q],
}

impl Carrying<'_> {
    /// Adds to the load of every solid what its links, which know nothing of fill, say too little along its normal.
    ///
    /// # Arguments
    /// `arm(i, body)`: middle of a link less the centre of the solid.
    pub(crate) fn enter(&self, entries: &mut Entries, arm: impl Fn(usize, u8) -> [f64; 3]) {
        let off = self.unaccounted();
        for first in AXES {
            let LinkEnd::Wall(body) = self.ends[first] else { continue };
            let same = |i: &usize| self.ends[*i] == LinkEnd::Wall(body);
            let Some(load) = usize::from(body).checked_sub(1).and_then(|k| entries.loads.get_mut(k)) else {
                continue;
            };
            if (1..first).any(|i| same(&i)) {
                continue;
            }
            let (mut normal, mut at, mut count) = ([0.0; 3], [0.0; 3], 0.0);
            for i in AXES.filter(same) {
                let from_centre = arm(i, body);
                for a in 0..3 {
                    normal[a] += f64::from(C[i][a]);
                    at[a] += from_centre[a];
                }
                count += 1.0;
            }
            let square = (normal[0] * normal[0] + normal[1] * normal[1]) + normal[2] * normal[2];
            if square > 0.0 {
                let along = ((off[0] * normal[0] + off[1] * normal[1]) + off[2] * normal[2]) / square;
                let brought = normal.map(|n| along * n);
                let arm = at.map(|x| x / count);
                load.add(&Pull { i: first, brought, share: 0.0 }, arm);
            }
        }
    }

    /// Momentum that walls gave to the mass of the cell, less what their links brought:
    /// (φ′j′ − φj) − Σ A c_i (f_i + f_ī*) − φF − Σ_walls c_i (f_i + f_ī*).
    ///
    /// # Source
    /// docs/method.md \[C7\], ours.
    /// # Verified by
    /// Claim `impact-impulse`.
    fn unaccounted(&self) -> [f64; 3] {
        let both: [f64; Q] = std::array::from_fn(|i| match self.ends[i] {
            _ if i == 0 => 0.0,
            LinkEnd::Cell(Kind::Solid, _) | LinkEnd::Wall(_) => self.arrived[i] + self.after[opposite(i)],
            LinkEnd::Cell(kind, fill) => {
                wetted_share(kind, self.fill[0], fill) * (self.arrived[i] + self.after[opposite(i)])
            }
            LinkEnd::Open => self.fill[0] * (self.arrived[i] + self.after[opposite(i)]),
        });
        let (brought, after, arrived) = (momentum(&both), momentum(self.after), momentum(self.arrived));
        std::array::from_fn(|a| {
            let before = after[a] - self.force[a];
            let gained = self.fill[1] * arrived[a] - self.fill[0] * before;
            (gained - brought[a]) - self.fill[0] * self.weight[a]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::direction;
    use crate::solver::run::Load;

    /// Load along x that a cell puts on a solid at +x; all other links lead to `beside`.
    fn load_of(after: &[f64; Q], arrived: &[f64; Q], fill: [f64; 2], beside: LinkEnd) -> f64 {
        let ends = std::array::from_fn(|i| if C[i][0] < 0 { LinkEnd::Wall(1) } else { beside });
        let carrying = Carrying { fill, after, arrived, force: [0.0; 3], weight: [0.0; 3], ends };
        let mut entries = Entries::new(1);
        for i in (1..Q).filter(|&i| C[i][0] < 0) {
            let both = arrived[i] + after[opposite(i)];
            let brought = C[i].map(|c| f64::from(c) * both);
            entries.loads[0].add(&Pull { i, brought, share: 0.0 }, [0.0; 3]);
        }
        carrying.enter(&mut entries, |_, _| [0.0; 3]);
        let mut load = Load::default();
        entries.loads[0].enter(&mut load);
        load.force[0]
    }

    #[test]
    fn exact_load_of_a_drop_that_stops() {
        // In gas, at j = 1/4 along x before the wall and at rest after it: φ j, whatever its links say.
        let mut after = [0.0; Q];
        if let Some(i) = direction([1, 0, 0]) {
            after[i] = 0.25;
        }
        let gas = LinkEnd::Cell(Kind::Gas, 0.0);
        assert_eq!(load_of(&after, &[0.0; Q], [0.5, 0.5], gas), 0.125);
        // It goes on as before: nothing.
        assert_eq!(load_of(&after, &after, [0.5, 0.5], gas), 0.0);
    }

    #[test]
    fn exact_load_of_pressure_through_a_partly_filled_cell() {
        // Liquid beside it presses with δρ/3: each link brings twice w δρ, and the wall gets it in full.
        let f: [f64; Q] = std::array::from_fn(|i| crate::lattice::W[i] * 0.375);
        let load = load_of(&f, &f, [0.25, 0.25], LinkEnd::Cell(Kind::Liquid, 1.0));
        // Thirty roundings of numbers below 1/8.
        assert!((load - 0.125).abs() < 1e-15, "{load}");
    }
}
