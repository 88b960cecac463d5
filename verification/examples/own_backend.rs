//! A solver of one's own, put through three claims: one relaxation time, periodic boxes, two arrays.
//!
//! `cargo run --release -p lahar-verification --example own_backend`

use std::error::Error;

use lahar::fingerprint::{Fingerprint, Hasher};
use lahar::lattice::moments::moments;
use lahar::lattice::{C, Q, W};
use lahar::solver::initial;
use lahar::{Backend, Face, Fields, Law, Run, Setup, StartError, Stopped, Totals};
use lahar_verification::Selection;

/// Pushes what it has collided to the neighbours, as textbooks write it.
struct Textbook;

struct Flow {
    setup: Setup,
    tau: f64,
    step: u64,
    /// f − w: what is left of the digits of f itself would be the error of a faint wave.
    h: Vec<[f64; Q]>,
}

impl Backend for Textbook {
    fn name(&self) -> &'static str {
        "textbook"
    }

    fn start(&self, setup: &Setup) -> Result<Box<dyn Run>, StartError> {
        let unsupported = |feature| Err(StartError::Unsupported { backend: "textbook", feature });
        let [Law::Newtonian { mu }] = setup.fluids[..] else {
            return unsupported("laws other than Newton's");
        };
        if setup.faces != [[Face::Periodic; 2]; 3] || !setup.solids.is_empty() {
            return unsupported("walls");
        }
        let start = |cell: usize| {
            let point = setup.initial.as_ref().map_or(initial::REST, |flow| flow(setup.coordinates(cell)));
            initial::start(&point, &setup.law(cell), &setup.force.at(0))
        };
        let h = (0..setup.cells()).map(start).collect();
        Ok(Box::new(Flow { setup: setup.clone(), tau: 0.5 + 3.0 * mu, step: 0, h }))
    }
}

impl Flow {
    /// f_i(x + c_i, t + 1) = f_i − (f_i − f_i^eq)/τ, without force.
    fn collide_and_push(&mut self) {
        let mut next = self.h.clone();
        for (cell, h) in self.h.iter().enumerate() {
            let excess: f64 = h.iter().sum();
            let rho = 1.0 + excess;
            let u: [f64; 3] =
                std::array::from_fn(|a| (0..Q).map(|i| h[i] * f64::from(C[i][a])).sum::<f64>() / rho);
            let uu: f64 = u.iter().map(|u| u * u).sum();
            for i in 0..Q {
                let cu: f64 = (0..3).map(|a| f64::from(C[i][a]) * u[a]).sum();
                let equilibrium = W[i] * (excess + rho * (3.0 * cu + 4.5 * cu * cu - 1.5 * uu));
                next[self.neighbour(cell, i)][i] = h[i] - (h[i] - equilibrium) / self.tau;
            }
        }
        self.h = next;
        self.step += 1;
    }

    fn neighbour(&self, cell: usize, i: usize) -> usize {
        let (x, n) = (self.setup.coordinates(cell), self.setup.extents);
        let along = |a: usize| (x[a] as i64 + i64::from(C[i][a])).rem_euclid(n[a] as i64) as usize;
        self.setup.index([along(0), along(1), along(2)])
    }
}

impl Run for Flow {
    fn advance(&mut self, steps: u64) -> Result<(), Stopped> {
        (0..steps).for_each(|_| self.collide_and_push());
        Ok(())
    }

    fn step(&self) -> u64 {
        self.step
    }

    fn setup(&self) -> &Setup {
        &self.setup
    }

    fn fields(&self) -> Fields {
        let mut fields = Fields::empty(self.h.len());
        for cell in 0..self.h.len() {
            fields.record(cell, &moments(&self.populations(cell), &[0.0; 3]), 1.0 / self.tau);
        }
        fields
    }

    fn populations(&self, cell: usize) -> [f64; Q] {
        self.h[cell]
    }

    fn totals(&self) -> Totals {
        let mut totals = Totals { mass_excess: 0.0, momentum: [0.0; 3], kinetic_energy: 0.0 };
        for cell in 0..self.h.len() {
            let m = moments(&self.populations(cell), &[0.0; 3]);
            totals.mass_excess += m.d_rho;
            totals.kinetic_energy += 0.5 * m.rho * m.u.iter().map(|u| u * u).sum::<f64>();
            (0..3).for_each(|a| totals.momentum[a] += m.rho * m.u[a]);
        }
        totals
    }

    fn fingerprint(&self) -> Fingerprint {
        let mut hasher = Hasher::default();
        (0..self.h.len()).for_each(|cell| hasher.cell(&self.populations(cell)));
        let Totals { mass_excess, momentum, .. } = self.totals();
        let speed = |u: &[f64; 3]| u.iter().map(|u| u * u).sum::<f64>().sqrt();
        let max_speed = self.fields().velocity.iter().map(speed).fold(0.0, f64::max);
        Fingerprint { step: self.step, hash: hasher.finish(), mass_excess, momentum, max_speed }
    }

    fn fluid_cells(&self) -> u64 {
        self.h.len() as u64
    }

    fn leave(&mut self, _keep: &[bool]) {}

    fn allocated_bytes(&self) -> u64 {
        size_of_val(&self.h[..]) as u64
    }
}

pub fn main() -> Result<(), Box<dyn Error>> {
    let claims = Selection::ids(["shear-wave-axis-bgk", "shear-wave-diagonal-bgk", "shear-wave-order-bgk"])?;
    for record in lahar_verification::run(&Textbook, &claims) {
        let worst = record.samples.iter().map(|sample| sample.error).fold(0.0, f64::max);
        println!(
            "{:24} {:?}, largest error {worst:.2e}, allowed {:.1e}",
            record.claim, record.verdict, record.tolerance.value
        );
        if !record.passed() {
            return Err(format!("`{}` does not hold", record.claim).into());
        }
    }
    Ok(())
}
