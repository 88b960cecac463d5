//! Accelerations for the surface force with inertia \[F3\]; nothing of this exists without that rule.

use crate::solver::fast::block::put;
use crate::state::state;

/// Three numbers per cell of a block: first those along x, then y, then z.
type Vectors = Vec<f64>;

/// Velocities of two collisions and the smoothed acceleration, by block.
#[derive(Clone, Debug, Default)]
pub(crate) struct Inertia {
    /// u of the last collision, and of cells that have become fluid since.
    pub velocity: Vec<Vectors>,
    /// u of the collision before.
    pub(super) before: Vec<Vectors>,
    pub(super) acceleration: Vec<Vectors>,
    /// Whether there has been a collision before the last one.
    pub(super) started: bool,
}

state!(Inertia: velocity before acceleration started);

/// The vector of a cell.
pub(super) fn get(vectors: &[f64], local: usize) -> [f64; 3] {
    let cells = vectors.len() / 3;
    std::array::from_fn(|a| vectors[a * cells + local])
}

/// Changes the vector of a cell.
pub(super) fn set(vectors: &mut [f64], local: usize, to: &[f64; 3]) {
    let cells = vectors.len() / 3;
    for (a, to) in to.iter().enumerate() {
        vectors[a * cells + local] = *to;
    }
}

impl Inertia {
    /// Makes room for a block.
    pub(crate) fn add(&mut self, number: usize, cells: usize) {
        for list in [&mut self.velocity, &mut self.before, &mut self.acceleration] {
            put(list, number, vec![0.0; 3 * cells]);
        }
    }

    /// Gives a block up.
    pub(crate) fn drop_block(&mut self, number: usize) {
        for list in [&mut self.velocity, &mut self.before, &mut self.acceleration] {
            list[number] = Vec::new();
        }
    }

    /// Gives all blocks up.
    pub(in crate::solver::fast) fn clear(&mut self) {
        for list in [&mut self.velocity, &mut self.before, &mut self.acceleration] {
            list.clear();
        }
    }

    /// A cell that has become fluid.
    pub(crate) fn wet(&mut self, number: usize, local: usize, velocity: &[f64; 3]) {
        set(&mut self.velocity[number], local, velocity);
        set(&mut self.acceleration[number], local, &[0.0; 3]);
    }

    /// A cell that a grain has given free: nothing is known of its past.
    pub(crate) fn uncover(&mut self, number: usize, local: usize, velocity: &[f64; 3]) {
        self.wet(number, local, velocity);
        set(&mut self.before[number], local, velocity);
    }

    /// Acceleration of a cell.
    #[must_use]
    pub(crate) fn acceleration_of(&self, number: usize, local: usize) -> [f64; 3] {
        get(&self.acceleration[number], local)
    }

    /// Bytes held.
    #[must_use]
    pub(crate) fn bytes(&self) -> u64 {
        let lists = [&self.velocity, &self.before, &self.acceleration];
        lists.iter().flat_map(|list| list.iter()).map(|v| size_of_val(v.as_slice()) as u64).sum()
    }
}
