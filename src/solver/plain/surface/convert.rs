//! Conversions between gas, interface and liquid, and where their excess mass goes \[F4\] \[F6\].

use std::collections::{BTreeMap, BTreeSet};

use super::SurfaceRun;
use super::passes::touch;
use crate::boundary::links::Source;
use crate::free_surface::marks::{Mark, Touches, mark};
use crate::free_surface::{Kind, normal};
use crate::lattice::equilibrium::{dot, equilibrium};
use crate::lattice::moments::{density_excess, moments, momentum};
use crate::lattice::{C, Q, opposite};
use crate::solver::physics::Physics;
use crate::solver::plain::cell::Cell;
use crate::solver::setup::{ExcessRule, Refill, SurfaceForce, YieldTreatment};

/// Steps between two moves of parked mass: 1/16 cell per step, within the speeds the scheme allows.
const STEPS_PER_MOVE: u64 = 16;

/// Mass to hand on, and how it is divided.
struct Donor {
    mass: f64,
    /// By direction from the donor to the receiver.
    weights: [f64; Q],
    total: f64,
}

/// −1 where a mirror plane has reversed component `a` between direction `i` at the receiver and `from`
/// at the source, else 1.
#[inline(always)]
pub fn mirrored(i: usize, from: usize, a: usize) -> f64 {
    if C[i][a] == C[from][a] { 1.0 } else { -1.0 }
}

impl<P: Physics> SurfaceRun<P> {
    /// Marks, conversions, refill and excess of one step; then φ of every interface cell.
    pub(super) fn convert(&mut self, force: &[f64; 3]) {
        let marks = self.marks();
        if !marks.is_empty() || !self.parked.is_empty() {
            let (filled, emptied) = surviving(&self.links, &marks);
            let wetted = self.wetted(&filled);
            let exposed = self.exposed(&emptied);
            let refilled: Vec<Cell> = wetted.iter().map(|&cell| self.refill(cell as usize)).collect();
            let excess = self.take_excess(&filled, &emptied);
            self.change_kinds(&filled, &emptied, &wetted, &exposed);
            for (&cell, populations) in wetted.iter().zip(&refilled) {
                self.start_interface(cell as usize, populations);
            }
            self.move_parked(force);
            self.hand_on(&excess);
            if !(filled.is_empty() && emptied.is_empty()) {
                self.list_special();
            }
        }
        for &cell in &self.special {
            let cell = cell as usize;
            if self.kinds[cell] == Kind::Interface {
                let fill = self.mass[cell] / (1.0 + density_excess(&self.f[cell]));
                self.fill[cell] = if fill > 1.0 {
                    1.0
                } else if fill > 0.0 {
                    fill
                } else {
                    0.0
                };
            }
        }
        if !self.acceleration.is_empty() {
            self.books.velocity_before.clone_from(&self.velocity);
        }
    }

    /// Interface cells that fill or empty, before reverting.
    fn marks(&self) -> BTreeMap<u32, Mark> {
        let mut marks = BTreeMap::new();
        for &at in &self.special {
            let cell = at as usize;
            if self.kinds[cell] != Kind::Interface {
                continue;
            }
            let bits = self.touches[cell];
            let touches = Touches {
                gas: bits & touch::GAS != 0,
                liquid: bits & touch::LIQUID != 0,
                held: self.is_held(cell),
            };
            let rho = 1.0 + density_excess(&self.f[cell]);
            let (margin, lonely) = (self.surface.margin, self.surface.lonely_margin);
            let verdict = mark(self.mass[cell], rho, touches, margin, lonely);
            if verdict != Mark::Stay {
                marks.insert(at, verdict);
            }
        }
        marks
    }

    /// Whether an interface cell touches a wall, or an interface cell other than itself that touches liquid
    /// or a wall. Where it touches liquid the answer is not needed and `true`.
    fn is_held(&self, cell: usize) -> bool {
        let firm = touch::LIQUID | touch::WALL;
        let through = |i| {
            self.links
                .neighbour_along(cell, i)
                .is_some_and(|n| n != cell && self.kinds[n] == Kind::Interface && self.touches[n] & firm != 0)
        };
        self.touches[cell] & firm != 0 || (1..Q).any(through)
    }

    /// Gas next to a filling cell: becomes interface.
    fn wetted(&self, filled: &BTreeSet<u32>) -> BTreeSet<u32> {
        self.around(filled, Kind::Gas)
    }

    /// Liquid next to an emptying cell: becomes interface.
    fn exposed(&self, emptied: &BTreeSet<u32>) -> BTreeSet<u32> {
        self.around(emptied, Kind::Liquid)
    }

    fn around(&self, centres: &BTreeSet<u32>, kind: Kind) -> BTreeSet<u32> {
        let neighbours =
            |&cell: &u32| (1..Q).filter_map(move |i| self.links.neighbour_along(cell as usize, i));
        centres.iter().flat_map(neighbours).filter(|&n| self.kinds[n] == kind).map(|n| n as u32).collect()
    }

    /// Populations of a new interface cell, from the mean of its fluid neighbours before conversion.
    fn refill(&self, cell: usize) -> Cell {
        let mut rho = [0.0; Q];
        let mut u = [[0.0; Q]; 3];
        let mut parts = [[0.0; Q]; Q];
        let mut count = 0;
        for i in 1..Q {
            let Source::Cell { cell: from, direction } = self.links.source(cell, i) else { continue };
            let (from, direction) = (from as usize, usize::from(direction));
            if !self.kinds[from].is_fluid() {
                continue;
            }
            count += 1;
            let m = moments(&self.f[from], &[0.0; 3]);
            rho[i] = m.d_rho;
            for a in 0..3 {
                u[a][i] = mirrored(i, direction, a) * m.u[a];
            }
            if self.surface.refill == Refill::WithStress {
                let rest = equilibrium(m.d_rho, m.rho, &m.u);
                for (d, part) in parts.iter_mut().enumerate() {
                    let d_from = reflected(d, i, direction);
                    part[i] = self.f[from][d_from] - rest[d_from];
                }
            }
        }
        let mean = |parts: &[f64; Q]| density_excess(parts) / f64::from(count.max(1));
        let d_rho = mean(&rho);
        let u = [mean(&u[0]), mean(&u[1]), mean(&u[2])];
        let rest = equilibrium(d_rho, 1.0 + d_rho, &u);
        match self.surface.refill {
            Refill::Equilibrium => rest,
            Refill::WithStress => std::array::from_fn(|d| rest[d] + mean(&parts[d])),
        }
    }

    /// Excess of converting cells joined with what is parked, by cell.
    fn take_excess(&mut self, filled: &BTreeSet<u32>, emptied: &BTreeSet<u32>) -> Vec<(u32, [f64; 3])> {
        let mut outward = Vec::new();
        for &cell in filled.iter().chain(emptied) {
            let at = cell as usize;
            let fills = filled.contains(&cell);
            let full = if fills { 1.0 + density_excess(&self.f[at]) } else { 0.0 };
            let excess = self.physics.excess(self.mass[at] - full);
            *self.parked.entry(cell).or_insert(0.0) += excess;
            if self.surface.excess == ExcessRule::AlongNormal {
                let n = self.surface_normal(at);
                // What a full cell has too much goes towards the gas, what an empty one had left back.
                outward.push((cell, if fills { n } else { n.map(|x| -x) }));
            }
        }
        outward
    }

    fn surface_normal(&self, cell: usize) -> [f64; 3] {
        let fill = std::array::from_fn(|i| {
            let towards = self.links.neighbour_along(cell, opposite(i));
            self.fill[towards.unwrap_or(cell)]
        });
        normal::outward(&fill)
    }

    fn change_kinds(
        &mut self,
        filled: &BTreeSet<u32>,
        emptied: &BTreeSet<u32>,
        wetted: &BTreeSet<u32>,
        exposed: &BTreeSet<u32>,
    ) {
        for &cell in filled {
            let cell = cell as usize;
            self.kinds[cell] = Kind::Liquid;
            (self.mass[cell], self.fill[cell]) = (0.0, 1.0);
        }
        for &cell in emptied {
            let cell = cell as usize;
            self.books.from_conversions.add(&momentum(&self.f[cell]).map(|p| -p));
            self.kinds[cell] = Kind::Gas;
            self.f[cell] = [0.0; Q];
            (self.mass[cell], self.fill[cell]) = (0.0, 0.0);
            self.velocity[cell] = [0.0; 3];
        }
        for &cell in exposed {
            let cell = cell as usize;
            self.kinds[cell] = Kind::Interface;
            self.mass[cell] = 1.0 + density_excess(&self.f[cell]);
        }
        self.books.conversions += (filled.len() + emptied.len() + wetted.len() + exposed.len()) as u64;
    }

    fn start_interface(&mut self, cell: usize, populations: &Cell) {
        self.kinds[cell] = Kind::Interface;
        self.f[cell] = *populations;
        self.mass[cell] = 0.0;
        let m = moments(populations, &[0.0; 3]);
        self.velocity[cell] = m.u;
        self.books.from_conversions.add(&momentum(populations));
        if let YieldTreatment::LaggedClamped { tau_max, .. } = self.setup.yielding {
            self.previous_omega[cell] = 1.0 / tau_max;
        }
        if self.surface.force == SurfaceForce::ByFillAndInertia {
            self.acceleration[cell] = [0.0; 3];
        }
    }

    /// Divides parked mass among interface neighbours; what has none stays parked.
    fn hand_on(&mut self, outward: &[(u32, [f64; 3])]) {
        let parked = std::mem::take(&mut self.parked);
        let mut donors = BTreeMap::new();
        let mut receivers = BTreeSet::new();
        for (&cell, &mass) in &parked {
            let along = outward.iter().find(|(at, _)| *at == cell).map(|(_, n)| n);
            let donor = self.donor(cell as usize, mass, along);
            if donor.total > 0.0 {
                for d in 1..Q {
                    if donor.weights[d] > 0.0
                        && let Some(n) = self.links.neighbour_along(cell as usize, opposite(d))
                    {
                        receivers.insert(n as u32);
                    }
                }
                donors.insert(cell, donor);
            } else if mass != 0.0 {
                self.parked.insert(cell, mass);
            }
        }
        for cell in receivers {
            let cell = cell as usize;
            let mut gained = [0.0; Q];
            for (i, gain) in gained.iter_mut().enumerate().skip(1) {
                if let Source::Cell { cell: from, direction } = self.links.source(cell, i)
                    && let Some(donor) = donors.get(&from)
                {
                    *gain = donor.mass * donor.weights[usize::from(direction)] / donor.total;
                }
            }
            self.mass[cell] += density_excess(&gained);
        }
    }

    fn donor(&self, cell: usize, mass: f64, along: Option<&[f64; 3]>) -> Donor {
        let receives = |d: usize| {
            let n = self.links.neighbour_along(cell, opposite(d));
            d > 0 && n.is_some_and(|n| self.kinds[n] == Kind::Interface)
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
    fn move_parked(&mut self, force: &[f64; 3]) {
        if !self.step.is_multiple_of(STEPS_PER_MOVE) || *force == [0.0; 3] {
            return;
        }
        let mut axis = 2;
        for a in [1, 0] {
            if force[a].abs() > force[axis].abs() {
                axis = a;
            }
        }
        let parked = std::mem::take(&mut self.parked);
        for (cell, mass) in parked {
            let at = cell as usize;
            let along = (force[axis] > 0.0) == (self.kinds[at] == Kind::Gas);
            let mut to = at;
            if !(1..Q).any(|i| self.touches_interface(at, i)) {
                let mut c = [0; 3];
                c[axis] = if along { -1 } else { 1 };
                let from = crate::lattice::direction(c).unwrap_or(0);
                match self.links.source(at, from) {
                    Source::Cell { cell: n, .. } if self.kinds[n as usize] == self.kinds[at] => {
                        to = n as usize;
                    }
                    Source::Open if self.kinds[at] == Kind::Gas => {
                        self.books.outflow.add(mass);
                        continue;
                    }
                    _ => {}
                }
            }
            *self.parked.entry(to as u32).or_insert(0.0) += mass;
        }
    }

    fn touches_interface(&self, cell: usize, i: usize) -> bool {
        self.links.neighbour_along(cell, i).is_some_and(|n| self.kinds[n] == Kind::Interface)
    }
}

/// Direction at the source that direction `d` at the receiver becomes through the mirror planes between
/// direction `i` and `from`.
fn reflected(d: usize, i: usize, from: usize) -> usize {
    let c = std::array::from_fn(|a| if C[i][a] == C[from][a] { C[d][a] } else { -C[d][a] });
    crate::lattice::direction(c).unwrap_or(d)
}

/// Cells that fill, and those that empty without a filling neighbour.
fn surviving(
    links: &crate::boundary::links::Links,
    marks: &BTreeMap<u32, Mark>,
) -> (BTreeSet<u32>, BTreeSet<u32>) {
    let fills = |cell: u32| marks.get(&cell) == Some(&Mark::Fill);
    let filled = marks.keys().copied().filter(|&cell| fills(cell)).collect();
    let reverts =
        |cell: u32| (1..Q).any(|i| links.neighbour_along(cell as usize, i).is_some_and(|n| fills(n as u32)));
    let emptied = marks.keys().copied().filter(|&cell| !fills(cell) && !reverts(cell)).collect();
    (filled, emptied)
}
