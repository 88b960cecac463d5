//! The ledger of mass and momentum \[F5\] and the loads on solids \[C7\], for any backend.

use crate::boundary::hand_over::HandOver;
use crate::boundary::links::Source;
use crate::free_surface::ledger::{Sum, VectorSum};
use crate::lattice::C;
use crate::setup::Setup;
use crate::solver::loads::{LoadSums, Pull, book_pull, owned};
use crate::solver::run::{Ledger, Load};
use crate::state::state;

/// What a run holds now.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contents {
    /// Mass, with `parked`.
    pub mass: f64,
    /// Σ c f.
    pub momentum: [f64; 3],
    /// Mass without a cell.
    pub parked: f64,
    /// Volume missing below the surface, cells.
    pub voids: f64,
    /// Liquid and interface cells.
    pub cells: [u64; 2],
}

/// Everything that was brought in or taken out so far.
#[derive(Clone, Debug, Default)]
pub(crate) struct Books {
    /// Mass at step 0.
    pub initial_mass: f64,
    /// Mass at the end of the last step, less what came from outside.
    pub mass: f64,
    /// Σ c f at step 0.
    pub initial_momentum: [f64; 3],
    /// Mass that left through open faces.
    pub outflow: Sum,
    /// Mass that came in at walls.
    pub from_walls: Sum,
    /// Momentum by origin.
    pub from_force: VectorSum,
    /// Walls and mirror planes of the box.
    pub from_faces: VectorSum,
    /// Solids.
    pub from_solids: VectorSum,
    /// Gas links and open faces.
    pub from_gas: VectorSum,
    /// Cells that became fluid, less those that became gas.
    pub from_conversions: VectorSum,
    /// Mass from grains.
    pub mass_from_grains: Sum,
    /// Grains.
    pub from_grains: VectorSum,
    /// Cells that changed kind.
    pub conversions: u64,
}

/// Roundings per fluid cell and step that the ledger may collect, in units of the last place of 1.
///
/// A stored population f − w is off by at most half a unit of its own last place, and a collision in the
/// same precision adds up 19 of them twice (ρ, then the population at rest as what is left), each partial sum
/// rounded once: 19 + 2 · 19 half-units of numbers whose magnitudes sum to Σ|f − w| ≤ |ρ − 1| + 3|u|, about 1 at
/// the speed limit and far less elsewhere. That is 29 units. A wall adds five roundings to the populations that it
/// returns, at most half of them: 1.3 units. Streaming and the sums over cells are exact or
/// in f64. Roundings of neighbouring cells may agree (uniform flow), so the bound grows with the cells and
/// not with their root.
pub(crate) const ROUNDINGS: f64 = 32.0;

/// What one step brought in over links: entries of many cells, to be added to the [`Books`] in any order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Entries {
    /// Mass that left through open faces.
    pub outflow: Sum,
    /// Mass that came in at walls.
    pub from_walls: Sum,
    /// As in [`Books`].
    pub from_faces: VectorSum,
    /// As in [`Books`].
    pub from_solids: VectorSum,
    /// As in [`Books`].
    pub from_gas: VectorSum,
    /// Force, torque and wetted area by solid.
    pub loads: Vec<LoadSums>,
}

/// The two ends of a link at a cell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crossing {
    /// Arriving direction.
    pub i: usize,
    /// f_ī* that left.
    pub leaving: f64,
    /// f_i that arrived.
    pub arrived: f64,
    /// Share of the cell that is wet: 1 in liquid, φ in interface.
    pub share: f64,
    /// Whether the cell is liquid.
    pub liquid: bool,
    /// Cell.
    pub at: [usize; 3],
}

/// What the links of one cell brought in, added up in the order of the directions.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct CellEntries {
    outflow: f64,
    from_walls: f64,
    from_faces: [f64; 3],
    from_solids: [f64; 3],
    from_gas: [f64; 3],
    touched: bool,
}

impl CellEntries {
    /// Books one link. `gas`: whether the cell at the other end holds no fluid.
    #[inline]
    pub(crate) fn link(
        &mut self,
        setup: &Setup,
        crossing: &Crossing,
        source: &Source,
        gas: bool,
        entries: &mut Entries,
    ) {
        let Crossing { i, leaving, arrived, share, liquid, at } = *crossing;
        // Arrives with c_i f_i, left with −c_i f_ī.
        let brought = C[i].map(|c| f64::from(c) * (arrived + leaving));
        match *source {
            Source::Cell { direction, .. } => {
                if gas {
                    add(&mut self.from_gas, &brought);
                } else if usize::from(direction) != i {
                    // A mirror plane turns momentum round.
                    let turned = C[usize::from(direction)];
                    add(
                        &mut self.from_faces,
                        &std::array::from_fn(|a| f64::from(C[i][a] - turned[a]) * arrived),
                    );
                } else {
                    return;
                }
            }
            Source::Open => {
                add(&mut self.from_gas, &brought);
                self.outflow += share * (leaving - arrived);
            }
            Source::Wall { .. } => {
                if liquid {
                    self.from_walls += arrived - leaving;
                }
                let owners = source.owners(setup, at, i).unwrap_or_default();
                add(&mut self.from_faces, &owned(&brought, &owners, |owner| owner == 0));
                add(&mut self.from_solids, &owned(&brought, &owners, |owner| owner != 0));
                book_pull(&mut entries.loads, setup, at, owners, &Pull { i, brought, share });
            }
        }
        self.touched = true;
    }

    /// Hands the sums of the cell over.
    #[inline]
    pub(crate) fn close(&self, entries: &mut Entries) {
        if !self.touched {
            return;
        }
        entries.outflow.add(self.outflow);
        entries.from_walls.add(self.from_walls);
        // Most cells touch one kind of neighbour; zeros change no sum.
        let vectors = [
            (&self.from_faces, &mut entries.from_faces),
            (&self.from_solids, &mut entries.from_solids),
            (&self.from_gas, &mut entries.from_gas),
        ];
        for (own, sum) in vectors {
            if *own != [0.0; 3] {
                sum.add(own);
            }
        }
    }
}

/// Σ A q: mass that an interface cell hands to its neighbours along the surfaces of moving solids \[B1\].
///
/// # Arguments
/// `share`: A of the link to a cell \[F1\].
/// # Exactness
/// The sum does not depend on the order of its terms; A q is what the neighbour adds with the other sign.
pub(crate) fn mass_handed(hand_over: &HandOver, cell: usize, share: impl Fn(usize) -> f64) -> f64 {
    let mut sum = Sum::default();
    for record in hand_over.of(cell) {
        for edge in hand_over.edges(record) {
            sum.add(share(edge.cell as usize) * hand_over.flux(record, edge));
        }
    }
    sum.value()
}

#[inline(always)]
fn add(sum: &mut [f64; 3], term: &[f64; 3]) {
    for a in 0..3 {
        sum[a] += term[a];
    }
}

impl Entries {
    /// None yet, for this number of recorded solids.
    #[must_use]
    pub fn new(solids: usize) -> Self {
        Self { loads: vec![Default::default(); solids], ..Self::default() }
    }

    /// Adds the entries of other cells.
    pub(crate) fn merge(&mut self, other: &Self) {
        self.outflow.merge(&other.outflow);
        self.from_walls.merge(&other.from_walls);
        self.from_faces.merge(&other.from_faces);
        self.from_solids.merge(&other.from_solids);
        self.from_gas.merge(&other.from_gas);
        for (own, other) in self.loads.iter_mut().zip(&other.loads) {
            own.merge(other);
        }
    }
}

impl Books {
    /// Books the entries of a step and brings the loads up to date.
    pub(crate) fn enter(&mut self, entries: &Entries, loads: &mut [Load]) {
        self.outflow.merge(&entries.outflow);
        self.from_walls.merge(&entries.from_walls);
        self.from_faces.merge(&entries.from_faces);
        self.from_solids.merge(&entries.from_solids);
        self.from_gas.merge(&entries.from_gas);
        for (load, sums) in loads.iter_mut().zip(&entries.loads) {
            sums.enter(load);
        }
    }

    /// Mass gained or lost since the last closing, and the bound of rounding; `None` if within it.
    /// `rounding`: largest relative error of a stored population.
    pub(crate) fn close(&mut self, mass: f64, fluid_cells: u64, rounding: f64) -> Option<(f64, f64)> {
        let external = self.mass_from_grains.value() - self.outflow.value();
        let before = self.mass;
        self.mass = mass - external;
        let residual = (mass - external - before).abs();
        // Populations are off in their own precision, the masses of interface cells and all sums in f64.
        let bound = ROUNDINGS * (2.0 * rounding * fluid_cells as f64 + f64::EPSILON * self.initial_mass);
        if residual <= bound { None } else { Some((residual / self.initial_mass, bound)) }
    }

    /// The ledger from the sums now.
    #[must_use]
    pub fn ledger(&self, now: &Contents) -> Ledger {
        let Contents { mass, momentum, parked, voids, cells } = *now;
        let (outflow, from_walls) = (self.outflow.value(), self.from_walls.value());
        let mass_from_grains = self.mass_from_grains.value();
        let parts = [
            self.from_force,
            self.from_faces,
            self.from_solids,
            self.from_gas,
            self.from_conversions,
            self.from_grains,
        ]
        .map(|sum| sum.value());
        let mut worst = 0.0_f64;
        for a in 0..3 {
            let mut sum = Sum::default();
            sum.add(momentum[a] - self.initial_momentum[a]);
            for part in &parts {
                sum.add(-part[a]);
            }
            worst = if sum.value().abs() > worst { sum.value().abs() } else { worst };
        }
        Ledger {
            initial_mass: self.initial_mass,
            mass,
            parked,
            voids,
            outflow,
            from_walls,
            mass_residual: (((mass - self.initial_mass) + outflow) - mass_from_grains) / self.initial_mass,
            momentum,
            from_force: parts[0],
            from_faces: parts[1],
            from_solids: parts[2],
            from_gas: parts[3],
            from_conversions: parts[4],
            mass_from_grains,
            from_grains: parts[5],
            momentum_residual: worst,
            liquid_cells: cells[0],
            interface_cells: cells[1],
            conversions: self.conversions,
        }
    }
}

state!(Books:
    initial_mass mass initial_momentum outflow from_walls from_force from_faces from_solids from_gas from_conversions
    mass_from_grains from_grains conversions
);
