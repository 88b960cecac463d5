//! Mud on a slope of 20°, a scene made in Rust in SI units: computed and exact speed of its surface.
//!
//! `cargo run --release --example scene`

use lahar::scene::{Boundaries, Boundary, Domain, End, FillLevel, Fluid, Gravity, Motions, Rheology};
use lahar::{Axis, Backend, Fast, Plan, Scene};

pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (density, sigma0, mu, depth, slope) = (1500.0, 40.0, 50.0, 0.1, 20.0_f64);
    let mud = Rheology::Bingham { yield_stress_pa: sigma0, plastic_viscosity_pa_s: mu };
    let domain = Domain {
        size_m: [0.005, 0.005, 0.15],
        spacing_m: 0.005,
        boundaries: Boundaries::default(),
        motion: Motions::default(),
    };
    let scene = Scene::builder(domain, Fluid::new(density, mud), 1.5)
        .title("mud on a slope")
        .face(Axis::Z, End::Min, Boundary::NoSlip)
        .face(Axis::Z, End::Max, Boundary::Open)
        .gravity(Gravity::on_slope(9.81, slope))
        .filled_to(FillLevel { height_m: depth, axis: None })
        .build()?;
    let plan = Plan::new(&scene)?;
    for warning in &plan.numbers.warnings {
        println!("warning: {warning}");
    }
    let mut run = Fast::default().start(&plan.setup)?;
    run.advance(plan.steps)?;
    // The last full cell below the surface is part of the plug.
    let cell = (depth / plan.units.dx_m).round() as usize - 1;
    let computed = plan.units.velocity_to_si(run.fields().velocity[cell][0]);
    // (f h − σ0)²/(2 μ f) with the weight f along the slope.
    let force = density * 9.81 * libm::sin(slope.to_radians());
    let excess = force * depth - sigma0;
    let exact = excess * excess / (2.0 * mu * force);
    let error = 100.0 * (computed / exact - 1.0);
    println!("speed of the surface: {computed:.4} m/s, exact {exact:.4} m/s, {error:+.2} %");
    // What is left of the start after 1.5 s, e^(−π²νt/4h²) of the flow, is below 1e-5; the rest is the scheme's.
    if error.abs() < 1.0 { Ok(()) } else { Err("the sheet has another speed".into()) }
}
