//! Populations that start a flow with given density, velocity and velocity gradient.

use crate::lattice::moments::{THIRD, populations};
use crate::lattice::{Q, SYMMETRIC, pair};
use crate::rheology::Law;
use crate::setup::{FlowPoint, Setup, YieldTreatment};

/// Rest at the reference density: where nothing else is asked for.
pub const REST: FlowPoint = FlowPoint { density: 1.0, velocity: [0.0; 3], gradient: [[0.0; 3]; 3] };

/// Strain-rate tensor ½(∇u + ∇uᵀ): xx, yy, zz, xy, xz, yz.
#[must_use]
pub(crate) fn strain_rate(gradient: &[[f64; 3]; 3]) -> [f64; 6] {
    SYMMETRIC.map(|[a, b]| 0.5 * (gradient[a][b] + gradient[b][a]))
}

/// γ̇ = √(2 S:S) \[Y2\].
#[must_use]
pub(crate) fn shear_rate(s: &[f64; 6]) -> f64 {
    let diagonal = (s[0] * s[0] + s[1] * s[1]) + s[2] * s[2];
    let mixed = (s[3] * s[3] + s[4] * s[4]) + s[5] * s[5];
    (2.0 * (diagonal + 2.0 * mixed)).sqrt()
}

/// Relaxation time ½ + 3σ(γ̇)/(ργ̇) at a shear rate; 1 at rest, where it does not matter because Q = 0.
#[must_use]
pub(crate) fn tau_at(law: &Law, rho: f64, gamma_dot: f64) -> f64 {
    match law.constant_tau() {
        Some(tau) => tau,
        None if gamma_dot > 0.0 => 0.5 + 3.0 * law.viscosity(gamma_dot) / rho,
        None => 1.0,
    }
}

/// Pre-collision populations h = f − w of one cell.
///
/// Second moments carry Q = −(2/3) ρ τ S, so that the stress is right from the first step; third and
/// fourth moments are those the second ones induce \[K3\].
///
/// # Arguments
/// `point`: the flow at the cell centre, lattice units. `law`: the fluid there. `force`: body force
/// at step 0.
/// # Source
/// docs/method.md \[Y2\], \[L4\], \[K3\].
/// # Verified by
/// Claims `taylor-green-3d`, `shear-wave-axis-bgk`; test `exact_moments_of_a_started_cell`.
#[must_use]
pub fn start(point: &FlowPoint, law: &Law, force: &[f64; 3]) -> [f64; Q] {
    let FlowPoint { density: rho, velocity: u, gradient } = point;
    let d_rho = rho - 1.0;
    let s = strain_rate(gradient);
    let tau = tau_at(law, *rho, shear_rate(&s));
    let q = s.map(|s| -(2.0 / 3.0) * rho * tau * s);
    let m1: [f64; 3] = std::array::from_fn(|a| rho * u[a] - 0.5 * force[a]);
    let m2: [f64; 6] = std::array::from_fn(|k| {
        let [a, b] = SYMMETRIC[k];
        let pressure = if a == b { d_rho / 3.0 } else { 0.0 };
        pressure + rho * u[a] * u[b] + q[k] - 0.5 * (u[a] * force[b] + u[b] * force[a])
    });
    let m3: [f64; 6] = std::array::from_fn(|k| {
        let [a, b] = THIRD[k];
        let equilibrium = rho * u[a] * u[a] * u[b];
        let induced = 2.0 * u[a] * q[pair(a, b)] + u[b] * q[a];
        let forced = 2.0 * u[a] * u[b] * force[a] + u[a] * u[a] * force[b];
        equilibrium + induced - 0.5 * forced + m1[b] / 3.0
    });
    let m4 = [(0, 1), (0, 2), (1, 2)].map(|(a, b)| {
        let induced = u[a] * u[a] * q[b] + u[b] * u[b] * q[a] + 4.0 * u[a] * u[b] * q[pair(a, b)];
        let isotropic = (m2[a] + m2[b] - 2.0 * d_rho / 3.0) / 3.0 + d_rho / 9.0;
        rho * u[a] * u[a] * u[b] * u[b] + induced + isotropic
    });
    populations(d_rho, &m1, &m2, &m3, &m4)
}

/// ω⁺ of a cell that the lagged treatment starts from: the law at the initial shear rate, clamped; 0 for the others.
#[must_use]
pub(crate) fn starting_omega(setup: &Setup, cell: usize) -> f64 {
    let YieldTreatment::LaggedClamped { tau_min, tau_max } = setup.yielding else { return 0.0 };
    let point = setup.initial.as_ref().map_or(REST, |flow| flow(setup.coordinates(cell)));
    let gamma_dot = shear_rate(&strain_rate(&point.gradient));
    let tau = if gamma_dot > 0.0 { tau_at(&setup.law(cell), point.density, gamma_dot) } else { tau_max };
    1.0 / tau.clamp(tau_min, tau_max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::moments::moments;

    #[test]
    fn exact_moments_of_a_started_cell() {
        let point = FlowPoint {
            density: 1.01,
            velocity: [0.03, -0.02, 0.05],
            gradient: [[1e-3, 2e-3, -3e-3], [4e-3, -2e-3, 1e-3], [5e-4, 6e-4, 1e-3]],
        };
        let force = [1e-4, -2e-4, 3e-5];
        let h = start(&point, &Law::Newtonian { mu: 0.1 }, &force);
        let m = moments(&h, &force);
        // A few dozen roundings of numbers below 0.1.
        let rounding = 50.0 * f64::EPSILON * 0.1;
        assert!((m.rho - point.density).abs() < 10.0 * f64::EPSILON);
        for a in 0..3 {
            assert!((m.u[a] - point.velocity[a]).abs() < rounding);
        }
        let s = strain_rate(&point.gradient);
        for k in 0..6 {
            assert!((m.q[k] + 2.0 / 3.0 * 1.01 * 0.8 * s[k]).abs() < rounding, "{k}");
        }
    }
}
