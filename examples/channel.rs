//! A Bingham fluid in a plane channel, in lattice units: computed and exact speed of the plug.
//!
//! `cargo run --release --example channel`

use lahar::{Backend, Fast, Law, Setup, SteadyRule, run_to_steady};

pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (cells, force, sigma0, mu) = (32, 1e-6, 8e-6, 0.1);
    let setup = Setup::channel(cells, Law::Bingham { sigma0, mu }, force);
    let mut run = Fast::default().start(&setup)?;
    run_to_steady(&mut *run, SteadyRule { tolerance: 1e-10, interval: 501, max_steps: 200_000 })?;
    let computed = run.fields().velocity[cells / 2][0];
    // The wall stress is force × half the height; the plug moves at (wall stress − σ0)²/(2 μ force).
    let excess = force * 0.5 * cells as f64 - sigma0;
    let exact = excess * excess / (2.0 * mu * force);
    let error = computed / exact - 1.0;
    println!("speed of the plug: {computed:.6e}, exact {exact:.6e}, {:+.3} %", 100.0 * error);
    // Walls are of second order: (2/32)² of the flow is 0.4 %.
    if error.abs() < 4e-3 { Ok(()) } else { Err("the plug has another speed".into()) }
}
