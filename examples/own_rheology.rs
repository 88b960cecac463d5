//! A rheology of one's own: Casson's law, √σ = √σ0 + √(μ γ̇), in a plane channel against its exact profile.
//!
//! `cargo run --release --example own_rheology`

use lahar::{Lane, Plain, Rheology, Setup, SteadyRule, run_to_steady};

/// Casson fluid: yield stress σ0 and limit viscosity μ, lattice units.
#[derive(Clone)]
struct Casson {
    sigma0: f64,
    mu: f64,
}

impl Rheology for Casson {
    /// σ = (√σ0 + √(μ γ̇))².
    fn stress<L: Lane>(&self, gamma_dot: L) -> L {
        let root = L::splat(self.sigma0.sqrt()) + (L::splat(self.mu) * gamma_dot).sqrt();
        root * root
    }

    /// q = σ(γ̇) + ργ̇/6 is quadratic in √γ̇: (μ + ρ/6) γ̇ + 2 √(σ0 μ) √γ̇ = q − σ0.
    fn shear_rate<L: Lane>(&self, rho: L, q: L) -> L {
        let excess = q - L::splat(self.sigma0);
        let (a, b) =
            (L::splat(self.mu) + rho * L::splat(1.0 / 6.0), L::splat((self.sigma0 * self.mu).sqrt()));
        let root = ((b * b + a * excess).sqrt() - b) / a;
        L::select(L::zero().less(excess), root * root, L::zero())
    }

    /// dσ/dγ̇ = μ + √(σ0 μ/γ̇).
    fn tangent_viscosity<L: Lane>(&self, gamma_dot: L) -> L {
        L::splat(self.mu) + (L::splat(self.sigma0 * self.mu) / gamma_dot).sqrt()
    }
}

/// Speed in the middle of a channel of half-width h: ∫ (√(Gy) − √σ0)²/μ dy from the yield surface to the wall.
fn exact(law: &Casson, force: f64, h: f64) -> f64 {
    let y0 = law.sigma0 / force;
    let squares = 0.5 * force * (h * h - y0 * y0);
    let roots = 4.0 / 3.0 * (law.sigma0 * force).sqrt() * (h * h.sqrt() - y0 * y0.sqrt());
    (squares - roots + law.sigma0 * (h - y0)) / law.mu
}

pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut errors: Vec<f64> = Vec::new();
    let (law, force) = (Casson { sigma0: 4e-6, mu: 0.1 }, 1e-6);
    for cells in [16, 32, 64] {
        let setup = Setup::channel(cells, lahar::Law::Newtonian { mu: law.mu }, force);
        let mut run = Plain.start_with(&setup, law.clone())?;
        run_to_steady(&mut *run, SteadyRule { tolerance: 1e-9, interval: 501, max_steps: 400_000 })?;
        let (u, wanted) = (run.fields().velocity[cells / 2][0], exact(&law, force, 0.5 * cells as f64));
        errors.push((u / wanted - 1.0).abs());
        println!("{cells} cells: {u:.6e}, exact {wanted:.6e}, {:+.3} %", 100.0 * (u / wanted - 1.0));
    }
    // Second order: twice the cells, a quarter of the error; a third leaves room for the coarsest grid.
    let falls = errors.is_sorted_by(|coarse, fine| 3.0 * fine < *coarse);
    if falls { Ok(()) } else { Err("it does not converge at second order".into()) }
}
