//! The flow at time 0, in lattice units, with its gradient and the pressure that balances it.

use std::f64::consts::TAU;
use std::sync::Arc;

use super::cells::Cells;
use super::facts::Facts;
use crate::free_surface::{Kind, hydrostatic};
use crate::scene::{BodyForce, InitialPressure, InitialVelocity};
use crate::setup::{FlowPoint, InitialFlow};
use crate::units::Units;

/// Velocity, gradient and pressure of one wave flow at a cell, lattice units.
struct Wave {
    velocity: [f64; 3],
    gradient: [[f64; 3]; 3],
    pressure: f64,
}

/// The initial flow of a scene, or `None` for rest at uniform pressure.
#[must_use]
pub(crate) fn initial_flow(
    facts: &Facts,
    units: &Units,
    cells: &Cells,
    force: &[f64; 3],
) -> Option<InitialFlow> {
    let scene = facts.scene;
    let extents = cells.extents;
    let flow = scene.fluid.initial_velocity;
    if let Some(initial) = &scene.fluid.initial {
        let weightless = initial.pressure == InitialPressure::Uniform;
        // At rest the solver itself starts with the pressure that balances the weight.
        let own = weightless || flow != InitialVelocity::AtRest;
        let force = if weightless { &[0.0; 3] } else { force };
        return own.then(|| flow_below_surface(flow, units, cells, facts.closed, force));
    }
    let push = pressure_gradient(facts, units);
    if flow == InitialVelocity::AtRest && push == [0.0; 3] {
        return None;
    }
    let units = *units;
    Some(Arc::new(move |cell| {
        let wave = wave(&flow, &units, extents, cell);
        let weight: f64 = (0..3).map(|a| push[a] * (cell[a] as f64 + 0.5 - 0.5 * extents[a] as f64)).sum();
        FlowPoint {
            density: 1.0 + 3.0 * (wave.pressure + weight),
            velocity: wave.velocity,
            gradient: wave.gradient,
        }
    }))
}

/// The flow with the pressure that balances the weight of fluid at rest.
fn flow_below_surface(
    flow: InitialVelocity,
    units: &Units,
    cells: &Cells,
    closed: [bool; 3],
    force: &[f64; 3],
) -> InitialFlow {
    let kind = |cell: usize| match cells.fill[cell] {
        _ if cells.solids.get(cell).is_some_and(|&s| s != 0) => Kind::Solid,
        fill if fill <= 0.0 => Kind::Gas,
        fill if fill < 1.0 => Kind::Interface,
        _ => Kind::Liquid,
    };
    let kinds: Vec<Kind> = (0..cells.fill.len()).map(kind).collect();
    let (extents, units) = (cells.extents, *units);
    let excess =
        hydrostatic::density_excess(extents, closed.map(|closed| !closed), &kinds, &cells.fill, force);
    Arc::new(move |cell| {
        let wave = wave(&flow, &units, extents, cell);
        let index = cell[0] + extents[0] * (cell[1] + extents[1] * cell[2]);
        FlowPoint { density: 1.0 + excess[index], velocity: wave.velocity, gradient: wave.gradient }
    })
}

/// Pressure gradient that holds the force at time 0 along walled axes: ∇p = f.
fn pressure_gradient(facts: &Facts, units: &Units) -> [f64; 3] {
    let force = match facts.forces.computed {
        BodyForce::Constant { force_n_per_m3 } => force_n_per_m3,
        BodyForce::Stepped { before_n_per_m3, after_n_per_m3, at_s } => {
            if at_s > 0.0 {
                before_n_per_m3
            } else {
                after_n_per_m3
            }
        }
        // The mean; the oscillation starts the compression waves that it would drive anyway.
        BodyForce::Oscillating { mean_n_per_m3, .. } => mean_n_per_m3,
    };
    std::array::from_fn(|a| if facts.closed[a] { units.force_to_lattice(force[a]) } else { 0.0 })
}

fn wave(flow: &InitialVelocity, units: &Units, extents: [usize; 3], cell: [usize; 3]) -> Wave {
    let k = |a: usize, count: f64| TAU * count / extents[a] as f64;
    let x: [f64; 3] = cell.map(|i| i as f64 + 0.5);
    let speed = |m_per_s: f64| units.velocity_to_lattice(m_per_s);
    match *flow {
        InitialVelocity::AtRest => uniform([0.0; 3]),
        InitialVelocity::Uniform { velocity_m_per_s } => uniform(velocity_m_per_s.map(speed)),
        InitialVelocity::ShearWave { amplitude_m_per_s, wave_counts, mean_m_per_s } => {
            let k = std::array::from_fn(|a| k(a, f64::from(wave_counts[a])));
            shear_wave(amplitude_m_per_s.map(speed), k, mean_m_per_s.map(speed), x)
        }
        InitialVelocity::TaylorGreen { amplitude_m_per_s, normal, wave_counts, mean_m_per_s } => {
            let [a, b] = normal.others();
            let (ka, kb) = (k(a, f64::from(wave_counts[0])), k(b, f64::from(wave_counts[1])));
            taylor_green(speed(amplitude_m_per_s), [a, b], [ka, kb], mean_m_per_s.map(speed), x)
        }
        InitialVelocity::TaylorGreen3d { amplitude_m_per_s, wave_counts } => {
            taylor_green_3d(speed(amplitude_m_per_s), k(0, f64::from(wave_counts[0])), x)
        }
        InitialVelocity::Abc { amplitudes_m_per_s, wave_counts } => {
            abc(amplitudes_m_per_s.map(speed), k(0, f64::from(wave_counts[0])), x)
        }
    }
}

fn uniform(velocity: [f64; 3]) -> Wave {
    Wave { velocity, gradient: [[0.0; 3]; 3], pressure: 0.0 }
}

/// u = U + A sin(k·x); A ⟂ k, so the flow is an exact solution and pressure is uniform.
fn shear_wave(amplitude: [f64; 3], k: [f64; 3], mean: [f64; 3], x: [f64; 3]) -> Wave {
    let phase = k[0] * x[0] + k[1] * x[1] + k[2] * x[2];
    let (sin, cos) = (libm::sin(phase), libm::cos(phase));
    Wave {
        velocity: std::array::from_fn(|a| mean[a] + amplitude[a] * sin),
        gradient: std::array::from_fn(|a| std::array::from_fn(|b| amplitude[a] * k[b] * cos)),
        pressure: 0.0,
    }
}

/// u_a = A cos(k_a a) sin(k_b b), u_b = −A (k_a/k_b) sin(k_a a) cos(k_b b),
/// p = −¼A² (cos 2k_a a + (k_a/k_b)² cos 2k_b b).
fn taylor_green(amplitude: f64, [a, b]: [usize; 2], [ka, kb]: [f64; 2], mean: [f64; 3], x: [f64; 3]) -> Wave {
    let (sa, ca) = (libm::sin(ka * x[a]), libm::cos(ka * x[a]));
    let (sb, cb) = (libm::sin(kb * x[b]), libm::cos(kb * x[b]));
    let ratio = ka / kb;
    let mut wave = uniform(mean);
    wave.velocity[a] += amplitude * ca * sb;
    wave.velocity[b] -= amplitude * ratio * sa * cb;
    wave.gradient[a][a] = -amplitude * ka * sa * sb;
    wave.gradient[a][b] = amplitude * kb * ca * cb;
    wave.gradient[b][a] = -amplitude * ratio * ka * ca * cb;
    wave.gradient[b][b] = amplitude * ka * sa * sb;
    // cos 2θ = cos² − sin².
    let (c2a, c2b) = (ca * ca - sa * sa, cb * cb - sb * sb);
    wave.pressure = -0.25 * amplitude * amplitude * (c2a + ratio * ratio * c2b);
    wave
}

/// u = A sin kx cos ky cos kz, v = −A cos kx sin ky cos kz,
/// p = A²/16 (cos 2kx + cos 2ky)(cos 2kz + 2).
fn taylor_green_3d(amplitude: f64, k: f64, x: [f64; 3]) -> Wave {
    let s = x.map(|x| libm::sin(k * x));
    let c = x.map(|x| libm::cos(k * x));
    let double: [f64; 3] = std::array::from_fn(|a| c[a] * c[a] - s[a] * s[a]);
    let scale = amplitude * k;
    Wave {
        velocity: [amplitude * s[0] * c[1] * c[2], -amplitude * c[0] * s[1] * c[2], 0.0],
        gradient: [
            [scale * c[0] * c[1] * c[2], -scale * s[0] * s[1] * c[2], -scale * s[0] * c[1] * s[2]],
            [scale * s[0] * s[1] * c[2], -scale * c[0] * c[1] * c[2], scale * c[0] * s[1] * s[2]],
            [0.0; 3],
        ],
        pressure: amplitude * amplitude / 16.0 * (double[0] + double[1]) * (double[2] + 2.0),
    }
}

/// u = A sin kz + C cos ky, v = B sin kx + A cos kz, w = C sin ky + B cos kx; vorticity is k u, so
/// pressure is the Bernoulli one, p = ½(A² + B² + C² − u²).
fn abc([a, b, c]: [f64; 3], k: f64, x: [f64; 3]) -> Wave {
    let sin = x.map(|x| libm::sin(k * x));
    let cos = x.map(|x| libm::cos(k * x));
    let velocity = [a * sin[2] + c * cos[1], b * sin[0] + a * cos[2], c * sin[1] + b * cos[0]];
    let square = velocity[0] * velocity[0] + velocity[1] * velocity[1] + velocity[2] * velocity[2];
    Wave {
        velocity,
        gradient: [
            [0.0, -c * k * sin[1], a * k * cos[2]],
            [b * k * cos[0], 0.0, -a * k * sin[2]],
            [-b * k * sin[0], c * k * cos[1], 0.0],
        ],
        pressure: 0.5 * (a * a + b * b + c * c - square),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Central differences of the velocity against the gradient; h² k³/6 with h = 1e-3, k < 1 and
    /// amplitudes < 1 is below 2e-7, rounding 1e-16/1e-3 below that.
    fn check_gradient(flow: impl Fn([f64; 3]) -> Wave) {
        let (x, h) = ([1.3, 2.7, 0.4], 1e-3);
        let middle = flow(x);
        let mut divergence = 0.0;
        for b in 0..3 {
            let at = |s: f64| {
                let mut y = x;
                y[b] += s * h;
                flow(y).velocity
            };
            let (plus, minus) = (at(1.0), at(-1.0));
            for a in 0..3 {
                let difference = (plus[a] - minus[a]) / (2.0 * h);
                assert!((difference - middle.gradient[a][b]).abs() < 2e-7, "d u_{a} / d x_{b}");
            }
            divergence += middle.gradient[b][b];
        }
        assert!(divergence.abs() < 1e-15, "sum of three terms below 1, one rounding each");
    }

    #[test]
    fn exact_gradients_of_all_flows() {
        check_gradient(|x| shear_wave([0.3, 0.0, 0.0], [0.0, 0.4, 0.3], [0.1, 0.2, 0.3], x));
        check_gradient(|x| taylor_green(0.3, [0, 2], [0.5, 0.8], [0.0, 0.1, 0.0], x));
        check_gradient(|x| taylor_green_3d(0.3, 0.5, x));
        check_gradient(|x| abc([0.3, 0.2, 0.1], 0.5, x));
    }

    /// ∇p = −(u·∇)u for flows that are steady without viscosity; same step and bound as above.
    fn check_pressure(flow: impl Fn([f64; 3]) -> Wave) {
        let (x, h) = ([1.3, 2.7, 0.4], 1e-3);
        let here = flow(x);
        for b in 0..3 {
            let at = |s: f64| {
                let mut y = x;
                y[b] += s * h;
                flow(y).pressure
            };
            let slope = (at(1.0) - at(-1.0)) / (2.0 * h);
            let advection: f64 = (0..3).map(|a| here.velocity[a] * here.gradient[b][a]).sum();
            assert!((slope + advection).abs() < 2e-7, "axis {b}: {slope} {advection}");
        }
    }

    #[test]
    fn exact_pressure_balances_advection() {
        check_pressure(|x| taylor_green(0.3, [0, 2], [0.5, 0.8], [0.0; 3], x));
        check_pressure(|x| abc([0.3, 0.2, 0.1], 0.5, x));
    }
}
