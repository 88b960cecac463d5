//! Taylor-Green vortices in two and three dimensions and the Arnold-Beltrami-Childress flow.

use std::sync::Arc;

use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::exact::abc::Abc;
use crate::exact::discrete_modes::{Relaxation, Shear, shear_viscosity_ratio};
use crate::exact::taylor_green::{Plane, TaylorGreen2d, TaylorGreen3d};
use crate::reference_values::{Input, find};
use lahar::collision::CollisionChoice;
use lahar::lattice::CS2;
use lahar::rheology::Law;
use lahar::setup::{Face, FlowPoint, Setup};
use lahar::solver::run::Backend;

const TWO_PI: f64 = core::f64::consts::TAU;

pub fn centre(cell: [usize; 3]) -> [f64; 3] {
    cell.map(|i| i as f64 + 0.5)
}

pub fn flat(field: impl IntoIterator<Item = [f64; 3]>) -> Vec<f64> {
    field.into_iter().flatten().collect()
}

/// Starts a two-dimensional vortex in a box of `n` × `n` × 1 cells of its plane.
pub fn vortex_setup(flow: TaylorGreen2d, n: usize) -> Setup {
    let (a, b) = flow.plane.axes();
    let extents = std::array::from_fn(|axis| if axis == a || axis == b { n } else { 1 });
    let mut setup = Setup::periodic(extents, Law::Newtonian { mu: flow.nu });
    setup.initial = Some(Arc::new(move |cell| {
        let x = centre(cell);
        let [ka, kb] = flow.wave_numbers;
        let (alpha, beta) = (ka * x[a], kb * x[b]);
        let mut gradient = [[0.0; 3]; 3];
        gradient[a][a] = flow.amplitude * ka * libm::cos(alpha) * libm::cos(beta);
        gradient[a][b] = -flow.amplitude * kb * libm::sin(alpha) * libm::sin(beta);
        gradient[b][a] = flow.amplitude * ka / kb * ka * libm::sin(alpha) * libm::sin(beta);
        gradient[b][b] = -gradient[a][a];
        FlowPoint { density: 1.0 + flow.pressure(x, 0.0) / CS2, velocity: flow.velocity(x, 0.0), gradient }
    }));
    setup
}

fn measure_2d(backend: &dyn Backend, n: f64) -> Result<Sample, VerifyError> {
    let k = TWO_PI / n;
    let mut worst: Option<Sample> = None;
    for plane in [Plane::Xy, Plane::Yz, Plane::Zx] {
        let flow = TaylorGreen2d {
            plane,
            amplitude: 1.6 / n,
            wave_numbers: [k, k],
            nu: 0.05,
            density: 1.0,
            mean_flow: [0.0; 3],
        };
        let setup = vortex_setup(flow, n as usize);
        let mut run = backend.start(&setup)?;
        run.advance((core::f64::consts::LN_2 / flow.decay_rate()).round() as u64)?;
        let t = run.step() as f64;
        let exact = flat((0..setup.cells()).map(|cell| flow.velocity(centre(setup.coordinates(cell)), t)));
        let here = Sample::l2(n, &flat(run.fields().velocity), &exact);
        let better = worst.as_ref().is_some_and(|w| here.error <= w.error);
        worst = if better { worst } else { Some(here) };
    }
    worst.ok_or(VerifyError::Numerics { what: "Taylor-Green", detail: String::new() })
}

/// Two dimensions, in three planes.
pub const TAYLOR_GREEN_2D: Claim = Claim {
    id: "taylor-green-2d",
    title: "Two-dimensional Taylor-Green vortices in the three planes converge with order 2",
    tags: &["L3", "L6", "K3", "004 Eq 3.70"],
    measures: "relative L2 error of the velocity after the vortex has halved, U = 1.6/N, ν = 0.05, worst of three planes",
    reference: Reference { source: "Taylor & Green 1937, exact Navier-Stokes solution", uncertainty: 0.0 },
    metric: Metric::L2,
    ladder: Ladder {
        parameter: "N (cells per box)",
        short: &[16.0, 32.0, 64.0],
        full: &[16.0, 32.0, 64.0, 128.0],
    },
    order: Some(OrderBand { expected: 2.0, band: 0.1, at_least: false }),
    tolerance: Tolerance {
        value: 0.05,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "error of the scheme: at most k²/4 in the viscosity of each of the two wave components, k = 2π/16, times ln 2 of decay, and U² = 0.01",
    },
    kind: Kind::Verification,
    measure: measure_2d,
};

/// Reynolds number of the reference energies.
const REYNOLDS: f64 = 20.0;
/// Steps per unit of time 1/(kU) at 16 cells; grows with N², so that ν stays the same.
const STEPS_16: f64 = 20.0;

/// Set-up of the three-dimensional vortex with `n` cells per wave; steps per unit of time; amplitude.
///
/// The mirror planes x, y, z = 0 and π of the vortex become free-slip faces, so one eighth of the box
/// is run. ν = U/(k Re) = 0.0162 at every `n`.
pub fn taylor_green_3d(n: usize) -> (Setup, u64, f64) {
    let refinement = n as f64 / 16.0;
    let steps = (STEPS_16 * refinement * refinement).round();
    let k = TWO_PI / n as f64;
    let amplitude = 1.0 / (k * steps);
    let flow = TaylorGreen3d { amplitude, wave_number: k, density: 1.0 };
    let mut setup = Setup::periodic([n / 2; 3], Law::Newtonian { mu: amplitude / (k * REYNOLDS) });
    setup.faces = [[Face::FreeSlip; 2]; 3];
    setup.initial = Some(Arc::new(move |cell| {
        let x = centre(cell);
        let (s, c) = (x.map(|x| libm::sin(k * x)), x.map(|x| libm::cos(k * x)));
        let size = amplitude * k;
        FlowPoint {
            density: 1.0 + flow.pressure(x) / CS2,
            velocity: flow.velocity(x),
            gradient: [
                [size * c[0] * c[1] * c[2], -size * s[0] * s[1] * c[2], -size * s[0] * c[1] * s[2]],
                [size * s[0] * s[1] * c[2], -size * c[0] * c[1] * c[2], size * c[0] * s[1] * s[2]],
                [0.0; 3],
            ],
        }
    }));
    (setup, steps as u64, amplitude)
}

/// Mean of |u|²/2 in units of U² at times 1 to 5.
pub fn energies(backend: &dyn Backend, n: usize) -> Result<[f64; 5], VerifyError> {
    let (setup, steps, amplitude) = taylor_green_3d(n);
    let mut run = backend.start(&setup)?;
    let mut energies = [0.0; 5];
    for energy in &mut energies {
        run.advance(steps)?;
        let velocity = run.fields().velocity;
        let sum: f64 = velocity.iter().map(|u| (u[0] * u[0] + u[1] * u[1]) + u[2] * u[2]).sum();
        *energy = 0.5 * sum / (velocity.len() as f64 * amplitude * amplitude);
    }
    Ok(energies)
}

/// The reference energy at a time.
pub fn reference_energy(time: usize) -> Result<f64, VerifyError> {
    let inputs = [("Re", Input::Number(REYNOLDS)), ("t", Input::Number(time as f64))];
    Ok(find("tgv3d_E_Z", &inputs)?.field("E")?)
}

fn measure_3d(backend: &dyn Backend, n: f64) -> Result<Sample, VerifyError> {
    let energies = energies(backend, n as usize)?;
    let mut worst: Option<Sample> = None;
    for (index, energy) in energies.into_iter().enumerate() {
        let here = Sample::relative(n, energy, reference_energy(index + 1)?);
        let better = worst.as_ref().is_some_and(|w| here.error <= w.error);
        worst = if better { worst } else { Some(here) };
    }
    let worst = worst.ok_or(VerifyError::Numerics { what: "Taylor-Green", detail: String::new() })?;
    let named = energies.into_iter().enumerate();
    Ok(named.fold(worst, |sample, (index, energy)| sample.with(&format!("E({}) [U^2]", index + 1), energy)))
}

/// Three dimensions.
pub const TAYLOR_GREEN_3D: Claim = Claim {
    id: "taylor-green-3d",
    title: "The energies of the three-dimensional Taylor-Green vortex at Re = 20 converge with order 2",
    tags: &["L3", "L6", "K3", "B2"],
    measures: "mean |u|²/2 over U² at t k U = 1 … 5, the worst of the five; one eighth of the box between mirror planes",
    reference: Reference {
        source: "reference values tgv3d_E_Z: spectral solution 48³, which 32³ confirms to 3e-8",
        uncertainty: 3e-8,
    },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "N (cells per wave)",
        short: &[24.0, 32.0, 48.0],
        full: &[24.0, 32.0, 48.0, 64.0],
    },
    order: Some(OrderBand { expected: 2.0, band: 0.2, at_least: false }),
    tolerance: Tolerance {
        value: 0.05,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "error of the scheme at N = 24: k²/4 = 0.017 in the viscosity times a decay of the energy by e^-1.8, and 3U² = 0.022",
    },
    kind: Kind::Verification,
    measure: measure_3d,
};

fn measure_abc(backend: &dyn Backend, n: f64) -> Result<Sample, VerifyError> {
    let amplitudes = [1.0, 0.8, 0.6].map(|a| 0.6 / n * a);
    let flow = Abc { amplitudes, wave_number: TWO_PI / n, nu: 0.05, density: 1.0 };
    let mut setup = Setup::periodic([n as usize; 3], Law::Newtonian { mu: flow.nu });
    setup.initial = Some(Arc::new(move |cell| {
        let x = centre(cell);
        FlowPoint {
            density: 1.0 + flow.pressure(x, 0.0) / CS2,
            velocity: flow.velocity(x, 0.0),
            gradient: flow.gradient(x, 0.0),
        }
    }));
    let mut run = backend.start(&setup)?;
    run.advance((2.0 / flow.decay_rate()).round() as u64)?;
    let t = run.step() as f64;
    let velocity = flat(run.fields().velocity);
    let exact = flat((0..setup.cells()).map(|cell| flow.velocity(centre(setup.coordinates(cell)), t)));
    let along: f64 = velocity.iter().zip(&exact).map(|(u, v)| u * v).sum();
    let size: f64 = exact.iter().map(|v| v * v).sum();
    let shape: Vec<f64> = exact.iter().map(|v| v * along / size).collect();
    Ok(Sample::l2(n, &velocity, &exact)
        .with("amplitude / exact [-]", along / size)
        .with("shape error [-]", Sample::l2(n, &velocity, &shape).error))
}

/// ABC flow.
pub const ABC_FLOW: Claim = Claim {
    id: "abc-flow",
    title: "The Arnold-Beltrami-Childress flow keeps its shape and decays as exp(−νk²t), with order 2",
    tags: &["L3", "L6", "K3"],
    measures: "relative L2 error of the velocity after a decay by e⁻², U = 0.6/N, ν = 0.05",
    reference: Reference {
        source: "exact three-dimensional Navier-Stokes solution with pressure (Dombre et al. 1986)",
        uncertainty: 0.0,
    },
    metric: Metric::L2,
    ladder: Ladder {
        parameter: "N (cells per box)",
        short: &[12.0, 16.0, 24.0],
        full: &[12.0, 16.0, 24.0, 32.0],
    },
    order: Some(OrderBand { expected: 2.0, band: 0.2, at_least: false }),
    tolerance: Tolerance {
        value: 0.07,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "error of the scheme: at most k²/4 at the coarsest box, k = 2π/12",
    },
    kind: Kind::Verification,
    measure: measure_abc,
};

const ADVECTED_N: usize = 32;
const ADVECTED_STEPS: u64 = 200;

/// Decay rate of a small vortex carried by a flow along the first axis of its plane, over that of the
/// Navier-Stokes equations.
fn advected_ratio(backend: &dyn Backend, plane: Plane, speed: f64, tau: f64) -> Result<f64, VerifyError> {
    let (a, b) = plane.axes();
    let k = TWO_PI / ADVECTED_N as f64;
    let mut mean_flow = [0.0; 3];
    mean_flow[a] = speed;
    let flow = TaylorGreen2d {
        plane,
        amplitude: 1e-3,
        wave_numbers: [k, k],
        nu: Relaxation::bgk(tau).viscosity(),
        density: 1.0,
        mean_flow,
    };
    let mut setup = vortex_setup(flow, ADVECTED_N);
    setup.collision = CollisionChoice::Bgk;
    let mut run = backend.start(&setup)?;
    let mut sizes = [0.0; 2];
    for size in &mut sizes {
        // The first stretch lets the kinetic modes die: 0.25¹⁰⁰ at τ = 0.8.
        run.advance(ADVECTED_STEPS / 2)?;
        for sign in [1.0, -1.0] {
            let mut sum = (0.0, 0.0);
            for (cell, u) in run.fields().velocity.iter().enumerate() {
                let x = centre(setup.coordinates(cell));
                let phase = k * (x[a] + sign * x[b]);
                sum.0 += u[b] * libm::cos(phase);
                sum.1 += u[b] * libm::sin(phase);
            }
            *size += sum.0 * sum.0 + sum.1 * sum.1;
        }
    }
    let rate = -0.5 * libm::log(sizes[1] / sizes[0]) / (ADVECTED_STEPS / 2) as f64;
    Ok(rate / flow.decay_rate())
}

fn measure_advected(backend: &dyn Backend, speed: f64) -> Result<Sample, VerifyError> {
    let tau = 0.8;
    let at_rest =
        shear_viscosity_ratio(Shear::DiagonalInPlane, Relaxation::bgk(tau), ADVECTED_N as f64, 0.0)?;
    let mut worst: Option<Sample> = None;
    for plane in [Plane::Xy, Plane::Yz, Plane::Zx] {
        let here = Sample::relative(speed, advected_ratio(backend, plane, speed, tau)?, at_rest);
        let better = worst.as_ref().is_some_and(|w| here.error <= w.error);
        worst = if better { worst } else { Some(here) };
    }
    worst.ok_or(VerifyError::Numerics { what: "Taylor-Green", detail: String::new() })
}

/// docs/hard-cases.md H10.
pub const ADVECTED: Claim = Claim {
    id: "advected-taylor-green",
    title: "BGK's error in the decay of an advected Taylor-Green vortex grows as U² (H10)",
    tags: &["L2", "L3", "K1"],
    measures: "decay rate of a vortex of 32 cells in a mean flow U along an axis of its plane over that at rest, τ = 0.8, worst of three planes",
    reference: Reference {
        source: "decay at rest of the linearised scheme (verify::exact::discrete_modes); the defect is of order U² (Qian & Orszag 1993)",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "U (mean flow)",
        short: &[0.029, 0.058, 0.115, 0.173],
        full: &[0.029, 0.058, 0.087, 0.115, 0.144, 0.173],
    },
    order: Some(OrderBand { expected: -2.0, band: 0.2, at_least: false }),
    tolerance: Tolerance {
        value: 0.09,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "the theory's defect 3U² of a wave along the flow bounds that of an oblique wave: 0.0898 at U = 0.173",
    },
    kind: Kind::PredictedFailure,
    measure: measure_advected,
};
