//! What a run tells about itself: fields, sums and hash, in the order of the box whatever its arrays are.

use super::cell::State;
use super::run::{Fields, Run, Totals};
use crate::fingerprint::{Fingerprint, Hasher};
use crate::lattice::Q;
use crate::lattice::moments::{Moments, moments};

/// A run whose fluid cells can be visited in the order of the box.
pub(crate) trait Observed: Run {
    /// Where the run keeps a fluid cell.
    type At: Copy;

    /// All fluid cells, by increasing number in the box.
    fn in_order(&self) -> impl Iterator<Item = Self::At>;
    /// Number of a cell in the box.
    fn number(&self, at: Self::At) -> usize;
    /// Populations before the next collision, f − w.
    fn arrived(&self, at: Self::At) -> [f64; Q];
    /// Body force of this step, with the pressure gradient that balances the weight of grains.
    fn body_force(&self) -> [f64; 3];
    /// Body force of a cell \[F3\]; `force`: that of this step.
    fn force_on(&self, at: Self::At, force: &[f64; 3]) -> [f64; 3];
    /// Moments and ω⁺ of a cell whose body force is `force`.
    fn state(&self, at: Self::At, force: &[f64; 3]) -> State;
    /// Mass of a cell: as an excess over 1 where it is full, and whole.
    fn mass_of(&self, at: Self::At, m: &Moments<f64>) -> (f64, f64);
    /// Fields of a box in which no fluid has been recorded yet.
    fn blank_fields(&self) -> Fields;
    /// Fill of a cell of density `rho`, as it is; only asked for below a free surface.
    fn fill_of(&self, at: Self::At, rho: f64) -> f64;
    /// Number, kind and mass of a cell into the hash; nothing without a free surface.
    fn hash_surface(&self, at: Self::At, hasher: &mut Hasher);
    /// Mass that waits for a receiver into the hash.
    fn hash_parked(&self, hasher: &mut Hasher);
    /// What a cell remembers besides its populations into the hash: acceleration, then ω⁺.
    fn hash_memory(&self, at: Self::At, hasher: &mut Hasher);
}

/// Macroscopic fields at the current step.
pub(crate) fn fields(run: &impl Observed) -> Fields {
    let mut fields = run.blank_fields();
    let force = run.body_force();
    for at in run.in_order() {
        let cell = run.number(at);
        let state = run.state(at, &run.force_on(at, &force));
        fields.record(cell, &state.m, state.omega);
        if let Some(fill) = fields.fill.get_mut(cell) {
            *fill = run.fill_of(at, state.m.rho);
        }
    }
    fields
}

/// Sums over the fluid, weighted with its mass: Σ(mass) less the number of full cells, Σ m u, Σ ½ m u².
pub(crate) fn totals(run: &impl Observed) -> Totals {
    let force = run.body_force();
    let mut totals = Totals { mass_excess: 0.0, momentum: [0.0; 3], kinetic_energy: 0.0 };
    for at in run.in_order() {
        let m = moments(&run.arrived(at), &run.force_on(at, &force));
        let (excess, mass) = run.mass_of(at, &m);
        totals.mass_excess += excess;
        totals.kinetic_energy += 0.5 * mass * squared(&m.u);
        for a in 0..3 {
            totals.momentum[a] += mass * m.u[a];
        }
    }
    totals
}

/// Hash and digest of the complete state.
pub fn fingerprint(run: &impl Observed) -> Fingerprint {
    let force = run.body_force();
    let mut hasher = Hasher::default();
    let mut max_speed2 = 0.0_f64;
    for at in run.in_order() {
        let f = run.arrived(at);
        hasher.cell(&f);
        run.hash_surface(at, &mut hasher);
        max_speed2 = max_speed2.max(squared(&moments(&f, &run.force_on(at, &force)).u));
    }
    run.hash_parked(&mut hasher);
    for at in run.in_order() {
        run.hash_memory(at, &mut hasher);
    }
    if let Some(grains) = run.grains() {
        grains.add_to_hash(&mut hasher);
    }
    let totals = totals(run);
    Fingerprint {
        step: run.step(),
        hash: hasher.finish(),
        mass_excess: totals.mass_excess,
        momentum: totals.momentum,
        max_speed: max_speed2.sqrt(),
    }
}

/// u·u.
fn squared(u: &[f64; 3]) -> f64 {
    (u[0] * u[0] + u[1] * u[1]) + u[2] * u[2]
}
