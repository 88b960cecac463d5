//! Where the mass goes that a conversion leaves over \[F4\] \[F6\].

use std::collections::{BTreeMap, BTreeSet};

use super::cells::Cells;
use crate::boundary::links::Source;
use crate::free_surface::{Kind, normal};
use crate::lattice::equilibrium::dot;
use crate::lattice::moments::density_excess;
use crate::lattice::{Q, opposite};
use crate::setup::{ExcessRule, FreeSurface};

/// Steps between two moves of parked mass: 1/16 cell per step, within the speeds the scheme allows.
pub(super) const STEPS_PER_MOVE: u64 = 16;

/// Mass to hand on, and how it is divided.
struct Donor {
    mass: f64,
    /// By direction from the donor to the receiver.
    weights: [f64; Q],
    total: f64,
}

/// Excess of converting cells joined with what is parked, by cell.
pub(super) fn take_excess(
    cells: &impl Cells,
    rules: &FreeSurface,
    parked: &mut BTreeMap<u32, f64>,
    filled: &BTreeSet<u32>,
    emptied: &BTreeSet<u32>,
) -> Vec<(u32, [f64; 3])> {
    let mut outward = Vec::new();
    for &cell in filled.iter().chain(emptied) {
        let at = cell as usize;
        let fills = filled.contains(&cell);
        let full = if fills { 1.0 + density_excess(&cells.populations(at)) } else { 0.0 };
        let excess = cells.excess(cells.mass(at), full);
        *parked.entry(cell).or_insert(0.0) += excess;
        if rules.excess == ExcessRule::AlongNormal {
            let n = surface_normal(cells, at);
            // What a full cell has too much goes towards the gas, what an empty one had left back.
            outward.push((cell, if fills { n } else { n.map(|x| -x) }));
        }
    }
    outward
}

fn surface_normal(cells: &impl Cells, cell: usize) -> [f64; 3] {
    let fill = std::array::from_fn(|i| {
        let towards = cells.neighbour_along(cell, opposite(i));
        cells.fill(towards.unwrap_or(cell))
    });
    normal::outward(&fill)
}

/// Divides parked mass among interface neighbours; what has none stays parked.
pub(super) fn hand_on(cells: &mut impl Cells, all: &mut BTreeMap<u32, f64>, outward: &[(u32, [f64; 3])]) {
    let parked = std::mem::take(all);
    let mut donors = BTreeMap::new();
    let mut receivers = BTreeSet::new();
    for (&cell, &mass) in &parked {
        let along = outward.iter().find(|(at, _)| *at == cell).map(|(_, n)| n);
        let found = donor(cells, cell as usize, mass, along);
        if found.total > 0.0 {
            for d in 1..Q {
                if found.weights[d] > 0.0
                    && let Some(n) = cells.neighbour_along(cell as usize, opposite(d))
                {
                    receivers.insert(n as u32);
                }
            }
            donors.insert(cell, found);
        } else if mass != 0.0 {
            all.insert(cell, mass);
        }
    }
    for cell in receivers {
        let cell = cell as usize;
        let mut gained = [0.0; Q];
        for (i, gain) in gained.iter_mut().enumerate().skip(1) {
            if let Source::Cell { cell: from, direction } = cells.source(cell, i)
                && let Some(donor) = donors.get(&from)
            {
                *gain = donor.mass * donor.weights[usize::from(direction)] / donor.total;
            }
        }
        cells.add_mass(cell, density_excess(&gained));
    }
}

fn donor(cells: &impl Cells, cell: usize, mass: f64, along: Option<&[f64; 3]>) -> Donor {
    let receives = |d: usize| {
        let n = cells.neighbour_along(cell, opposite(d));
        d > 0 && n.is_some_and(|n| cells.kind(n) == Kind::Interface)
    };
    let even: [f64; Q] = std::array::from_fn(|d| if receives(d) { 1.0 } else { 0.0 });
    if let Some(n) = along {
        let weights: [f64; Q] = std::array::from_fn(|d| {
            let forward = dot(d, n);
            if forward > 0.0 { even[d] * forward } else { 0.0 }
        });
        let total = density_excess(&weights);
        if total > 0.0 {
            return Donor { mass, weights, total };
        }
    }
    Donor { mass, weights: even, total: density_excess(&even) }
}

/// Parked mass without receiver falls through gas along the body force, rises through liquid against
/// it, one cell every [`STEPS_PER_MOVE`] steps; it stays where there is no force, at walls, and where
/// it has met interface.
pub(super) fn move_parked(
    cells: &impl Cells,
    all: &mut BTreeMap<u32, f64>,
    step: u64,
    force: &[f64; 3],
) -> f64 {
    let mut outflow = 0.0;
    if !step.is_multiple_of(STEPS_PER_MOVE) || *force == [0.0; 3] {
        return outflow;
    }
    let mut axis = 2;
    for a in [1, 0] {
        if force[a].abs() > force[axis].abs() {
            axis = a;
        }
    }
    for (cell, mass) in std::mem::take(all) {
        let at = cell as usize;
        let along = (force[axis] > 0.0) == (cells.kind(at) == Kind::Gas);
        let mut to = at;
        // What a grain has covered waits beside it.
        let waits = cells.kind(at) == Kind::Solid;
        if !waits && !(1..Q).any(|i| touches_interface(cells, at, i)) {
            let mut c = [0; 3];
            c[axis] = if along { -1 } else { 1 };
            let from = crate::lattice::direction(c).unwrap_or(0);
            match cells.source(at, from) {
                Source::Cell { cell: n, .. } if cells.kind(n as usize) == cells.kind(at) => {
                    to = n as usize;
                }
                Source::Open if cells.kind(at) == Kind::Gas => {
                    outflow += mass;
                    continue;
                }
                _ => {}
            }
        }
        *all.entry(to as u32).or_insert(0.0) += mass;
    }
    outflow
}

fn touches_interface(cells: &impl Cells, cell: usize, i: usize) -> bool {
    cells.neighbour_along(cell, i).is_some_and(|n| cells.kind(n) == Kind::Interface)
}
