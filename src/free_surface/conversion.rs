//! Conversions between gas, interface and liquid, and where their excess mass goes \[F4\] \[F6\], for any
//! backend.

use std::collections::{BTreeMap, BTreeSet};

use crate::boundary::links::Source;
use crate::free_surface::hold::Span;
use crate::free_surface::ledger::VectorSum;
use crate::free_surface::marks::{Mark, Touches, mark};
use crate::free_surface::{Kind, normal};
use crate::lattice::equilibrium::{dot, equilibrium};
use crate::lattice::moments::{density_excess, moments, momentum};
use crate::lattice::{C, Q, opposite};
use crate::setup::{ExcessRule, FreeSurface, Refill};

/// Populations of one cell, f − w.
type Cell = [f64; Q];

/// Steps between two moves of parked mass: 1/16 cell per step, within the speeds the scheme allows.
const STEPS_PER_MOVE: u64 = 16;

/// Bits of [`Cells::touches`].
pub mod touch {
    /// A gas neighbour.
    pub const GAS: u8 = 1;
    /// A liquid neighbour.
    pub const LIQUID: u8 = 2;
    /// A wall or solid.
    pub const WALL: u8 = 4;
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
    /// What becomes of the mass that a conversion leaves over.
    fn excess(&self, mass: f64) -> f64;

    /// The cell that population `i` comes from; `None` at walls, solids and open faces.
    fn neighbour_along(&self, cell: usize, i: usize) -> Option<usize> {
        match self.source(cell, i) {
            Source::Cell { cell, .. } => Some(cell as usize),
            Source::Wall { .. } | Source::Open => None,
        }
    }
}

/// Mass to hand on, and how it is divided.
struct Donor {
    mass: f64,
    /// By direction from the donor to the receiver.
    weights: [f64; Q],
    total: f64,
}

/// What conversions did to the ledger.
#[derive(Clone, Copy, Debug, Default)]
pub struct Turnover {
    /// Momentum of cells that became fluid less that of cells that became gas.
    pub momentum: VectorSum,
    /// Cells that changed kind.
    pub conversions: u64,
    /// Parked mass that left through an open face.
    pub outflow: f64,
}

/// Verdict on an interface cell \[F4\].
pub fn verdict(cells: &impl Cells, rules: &FreeSurface, cell: usize, rho: f64) -> Mark {
    let bits = cells.touches(cell);
    let touches = Touches {
        gas: bits & touch::GAS != 0,
        liquid: bits & touch::LIQUID != 0,
        held: is_held(cells, cell, bits, rho),
    };
    mark(cells.mass(cell), rho, touches, rules.margin, rules.lonely_margin)
}

/// Whether an interface cell touches a wall, or an interface cell other than itself that touches liquid or a wall; and
/// its links hold it: beside them it is no faster than parked mass falls. Where it touches liquid the answer is not
/// needed and `true`.
fn is_held(cells: &impl Cells, cell: usize, bits: u8, rho: f64) -> bool {
    if bits & touch::LIQUID != 0 {
        return true;
    }
    let firm = touch::LIQUID | touch::WALL;
    let through = |i| {
        cells
            .neighbour_along(cell, i)
            .is_some_and(|n| n != cell && cells.kind(n) == Kind::Interface && cells.touches(n) & firm != 0)
    };
    if bits & touch::WALL == 0 && !(1..Q).any(through) {
        return false;
    }
    let u = momentum(&cells.populations(cell)).map(|p| p / rho);
    // Slow cells, nearly all, need no look at their links.
    let speed2 = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
    let limit = 1.0 / STEPS_PER_MOVE as f64;
    // What is not a number is left to the guard.
    let escapes = speed2 > limit * limit && span(cells, cell).beside(&u) > limit;
    !escapes
}

/// What the links of a cell to walls, solids and fluid span; a mirror plane holds along its normal.
fn span(cells: &impl Cells, cell: usize) -> Span {
    let mut span = Span::default();
    for i in 1..Q {
        match cells.source(cell, i) {
            Source::Wall { .. } => span.add(C[i]),
            Source::Cell { cell: n, direction } => {
                let n = n as usize;
                let turned: [i32; 3] = std::array::from_fn(|a| C[i][a] - C[usize::from(direction)][a]);
                if n == cell {
                    span.add(turned);
                } else if cells.kind(n) != Kind::Gas {
                    span.add(C[i]);
                    span.add(turned);
                }
            }
            Source::Open => {}
        }
        if span.is_full() {
            break;
        }
    }
    span
}

/// φ of an interface cell from its mass: m/ρ limited to 0..1.
#[must_use]
pub fn fill_of(mass: f64, rho: f64) -> f64 {
    let fill = mass / rho;
    if fill > 1.0 {
        1.0
    } else if fill > 0.0 {
        fill
    } else {
        0.0
    }
}

/// Conversions, refill and excess of one step. `marks`: interface cells that fill or empty, before
/// reverting. `parked`: excess without receiver, by cell.
pub fn convert(
    cells: &mut impl Cells,
    rules: &FreeSurface,
    marks: &BTreeMap<u32, Mark>,
    parked: &mut BTreeMap<u32, f64>,
    (step, force): (u64, &[f64; 3]),
) -> Turnover {
    let mut turnover = Turnover::default();
    let (filled, emptied) = surviving(cells, marks);
    // Gas next to a filling cell, liquid next to an emptying one: both become interface.
    let wetted = around(cells, &filled, Kind::Gas);
    let exposed = around(cells, &emptied, Kind::Liquid);
    let refilled: Vec<Cell> = wetted.iter().map(|&cell| refill(cells, rules, cell as usize)).collect();
    let excess = take_excess(cells, rules, parked, &filled, &emptied);
    for &cell in &filled {
        cells.fill_up(cell as usize);
    }
    for &cell in &emptied {
        turnover.momentum.add(&momentum(&cells.populations(cell as usize)).map(|p| -p));
        cells.empty(cell as usize);
    }
    for &cell in &exposed {
        let mass = 1.0 + density_excess(&cells.populations(cell as usize));
        cells.expose(cell as usize, mass);
    }
    turnover.conversions = (filled.len() + emptied.len() + wetted.len() + exposed.len()) as u64;
    for (&cell, populations) in wetted.iter().zip(&refilled) {
        cells.wet(cell as usize, populations);
        turnover.momentum.add(&momentum(populations));
    }
    turnover.outflow = move_parked(cells, parked, step, force);
    hand_on(cells, parked, &excess);
    turnover
}

fn around(cells: &impl Cells, centres: &BTreeSet<u32>, kind: Kind) -> BTreeSet<u32> {
    let neighbours = |&cell: &u32| (1..Q).filter_map(move |i| cells.neighbour_along(cell as usize, i));
    centres.iter().flat_map(neighbours).filter(|&n| cells.kind(n) == kind).map(|n| n as u32).collect()
}

/// −1 where a mirror plane has reversed component `a` between direction `i` at the receiver and `from`
/// at the source, else 1.
#[inline(always)]
#[must_use]
pub fn mirrored(i: usize, from: usize, a: usize) -> f64 {
    if C[i][a] == C[from][a] { 1.0 } else { -1.0 }
}

/// Means over the fluid neighbours of a cell.
#[derive(Clone, Copy, Debug)]
pub struct Neighbourhood {
    /// ρ − 1.
    pub d_rho: f64,
    /// u without force.
    pub u: [f64; 3],
    /// Populations beyond equilibrium.
    pub beyond: [f64; Q],
}

/// Means over the fluid neighbours of a cell, seen through mirror planes; `None` without any. `stress`: with
/// [`Neighbourhood::beyond`], else zero.
pub fn neighbourhood<C: Cells + ?Sized>(cells: &C, cell: usize, stress: bool) -> Option<Neighbourhood> {
    let mut rho = [0.0; Q];
    let mut u = [[0.0; Q]; 3];
    let mut parts = [[0.0; Q]; Q];
    let mut count = 0;
    for i in 1..Q {
        let Source::Cell { cell: from, direction } = cells.source(cell, i) else { continue };
        let (from, direction) = (from as usize, usize::from(direction));
        if !cells.kind(from).is_fluid() {
            continue;
        }
        count += 1;
        let f = cells.populations(from);
        let m = moments(&f, &[0.0; 3]);
        rho[i] = m.d_rho;
        for a in 0..3 {
            u[a][i] = mirrored(i, direction, a) * m.u[a];
        }
        if stress {
            let rest = equilibrium(m.d_rho, m.rho, &m.u);
            for (d, part) in parts.iter_mut().enumerate() {
                let d_from = reflected(d, i, direction);
                part[i] = f[d_from] - rest[d_from];
            }
        }
    }
    let mean = |parts: &[f64; Q]| density_excess(parts) / f64::from(count);
    (count > 0).then(|| Neighbourhood {
        d_rho: mean(&rho),
        u: [mean(&u[0]), mean(&u[1]), mean(&u[2])],
        beyond: std::array::from_fn(|d| mean(&parts[d])),
    })
}

/// Populations of a new interface cell, from the mean of its fluid neighbours before conversion.
fn refill(cells: &impl Cells, rules: &FreeSurface, cell: usize) -> Cell {
    let stress = rules.refill == Refill::WithStress;
    let Some(around) = neighbourhood(cells, cell, stress) else { return [0.0; Q] };
    let rest = equilibrium(around.d_rho, 1.0 + around.d_rho, &around.u);
    match rules.refill {
        Refill::Equilibrium => rest,
        Refill::WithStress => std::array::from_fn(|d| rest[d] + around.beyond[d]),
    }
}

/// Excess of converting cells joined with what is parked, by cell.
fn take_excess(
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
        let excess = cells.excess(cells.mass(at) - full);
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
fn hand_on(cells: &mut impl Cells, all: &mut BTreeMap<u32, f64>, outward: &[(u32, [f64; 3])]) {
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
fn move_parked(cells: &impl Cells, all: &mut BTreeMap<u32, f64>, step: u64, force: &[f64; 3]) -> f64 {
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

/// Direction at the source that direction `d` at the receiver becomes through the mirror planes between
/// direction `i` and `from`.
fn reflected(d: usize, i: usize, from: usize) -> usize {
    let c = std::array::from_fn(|a| if C[i][a] == C[from][a] { C[d][a] } else { -C[d][a] });
    crate::lattice::direction(c).unwrap_or(d)
}

/// Cells that fill, and those that empty without a filling neighbour.
fn surviving(cells: &impl Cells, marks: &BTreeMap<u32, Mark>) -> (BTreeSet<u32>, BTreeSet<u32>) {
    let fills = |cell: u32| marks.get(&cell) == Some(&Mark::Fill);
    let filled = marks.keys().copied().filter(|&cell| fills(cell)).collect();
    let reverts =
        |cell: u32| (1..Q).any(|i| cells.neighbour_along(cell as usize, i).is_some_and(|n| fills(n as u32)));
    let emptied = marks.keys().copied().filter(|&cell| !fills(cell) && !reverts(cell)).collect();
    (filled, emptied)
}
