//! Gear's 6-value predictor–corrector (000 Sec 2.1).
//!
//! Fifth order only where the force is smooth and the start derivatives are exact; see the tables.

use super::{External, Integrator, LEAST, Step, TooFast, outside};
use crate::dem::bodies::Body;
use crate::dem::rotation::{spin_of, turn};
use crate::dem::{Bodies, Shape, V3};
use crate::state::{State, StateError, Tape};
use rayon::prelude::*;

/// Corrector coefficients of x₀ … x₅ for second-order equations; c₀ = 3/16 if forces depend on velocity.
pub const CORRECTOR: [f64; 6] = [3.0 / 16.0, 251.0 / 360.0, 1.0, 11.0 / 18.0, 1.0 / 6.0, 1.0 / 60.0];
/// c₀ if forces do not depend on velocity.
pub const CORRECTOR_0_CONSERVATIVE: f64 = 3.0 / 20.0;

/// Scaled derivatives x_k = (Δt^k/k!) d^k x/dt^k, k = 0 … 5.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Gear(pub [V3; 6]);

impl State for Gear {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        self.0.state(tape)
    }
}

impl Gear {
    /// From position, velocity and acceleration; higher derivatives zero.
    pub fn start(x: V3, v: V3, a: V3, dt: f64) -> Self {
        Self([x, v * dt, a * (0.5 * dt * dt), V3::zeros(), V3::zeros(), V3::zeros()])
    }

    /// Taylor series to the next time (Pascal's triangle).
    #[inline]
    pub fn predict(&mut self) {
        let x = &mut self.0;
        for from in 0..5 {
            for k in (from..5).rev() {
                let next = x[k + 1];
                x[k] += next;
            }
        }
    }

    /// Correction by the acceleration found at the predicted state.
    ///
    /// # Source
    /// Gear 1971; Allen & Tildesley, Computer Simulation of Liquids, appendix E; docs/method.md \[D3\], docs/errata.md 34.
    /// # Verified by
    /// `order_gear_smooth`.
    #[inline]
    pub fn correct(&mut self, acceleration: &V3, dt: f64, c0: f64) {
        let error = acceleration * (0.5 * dt * dt) - self.0[2];
        self.0[0] += error * c0;
        for k in 1..6 {
            self.0[k] += error * CORRECTOR[k];
        }
    }
}

/// Gear's values of all bodies: of places, and of spins (of clumps: angular momenta).
pub(crate) type Derivatives = (Vec<Gear>, Vec<Gear>);

/// Gear's predictor for positions and spins (of clumps: angular momenta; their attitude turns freely at the mean
/// momentum of the step, second order).
///
/// # Returns
/// The first body whose free rotation did not converge.
pub(crate) fn predict(b: &mut Bodies, state: &mut Derivatives, step: &Step) -> Option<usize> {
    let (places, turns) = state;
    (b.each(), places, turns)
        .into_par_iter()
        .enumerate()
        .with_min_len(LEAST)
        .filter_map(|(i, (body, place, angle))| predict_one(body, place, angle, step).is_err().then_some(i))
        .min()
}

#[inline(always)]
fn predict_one(body: Body, place: &mut Gear, angle: &mut Gear, step: &Step) -> Result<(), TooFast> {
    let Step { dt, turn_spheres, .. } = *step;
    let backwards = 1.0 / dt;
    if *body.inverse_mass == 0.0 {
        body.carry(step);
        return Ok(());
    }
    place.predict();
    *body.position = place.0[0];
    *body.velocity = place.0[1] * backwards;
    angle.predict();
    let rate = angle.0[1] * backwards;
    if *body.shape == Shape::Sphere {
        if turn_spheres {
            *body.orientation = turn(body.orientation, &((*body.spin + rate) * 0.5), dt);
        }
        *body.spin = rate;
        return Ok(());
    }
    let mean = (*body.momentum + rate) * 0.5;
    body.turn_clump(&mean, rate, dt)
}

/// Gear's corrector; `found(i, x)` gives the new contact force and torque of body i with its centre at x.
///
/// # Returns
/// The first body whose state is not finite.
pub(crate) fn correct<F>(
    b: &mut Bodies,
    state: &mut Derivatives,
    external: &External,
    step: &Step,
    kind: Integrator,
    found: F,
) -> Option<usize>
where
    F: Fn(usize, &V3) -> (V3, V3) + Sync,
{
    let c0 = if kind == Integrator::GearConservative { CORRECTOR_0_CONSERVATIVE } else { CORRECTOR[0] };
    let (places, turns) = state;
    (b.each(), places, turns)
        .into_par_iter()
        .enumerate()
        .with_min_len(LEAST)
        .filter_map(|(i, (mut body, place, angle))| {
            let (force, torque) = found(i, body.position);
            if *body.inverse_mass > 0.0 {
                let (fe, te) = outside(external, i);
                correct_one(&mut body, (place, angle), (force + fe, torque + te), c0, step);
            }
            (!body.settle(force, torque)).then_some(i)
        })
        .min()
}

#[inline(always)]
fn correct_one(
    body: &mut Body,
    (place, angle): (&mut Gear, &mut Gear),
    (force, torque): (V3, V3),
    c0: f64,
    step: &Step,
) {
    let Step { dt, gravity, .. } = *step;
    let backwards = 1.0 / dt;
    place.correct(&(force * *body.inverse_mass + gravity), dt, c0);
    *body.position = place.0[0];
    *body.velocity = place.0[1] * backwards;
    if *body.shape == Shape::Sphere {
        angle.correct(&(torque * body.inverse_inertia.x), dt, c0);
        *body.spin = angle.0[1] * backwards;
    } else {
        angle.correct(&torque, dt, c0);
        *body.momentum = angle.0[1] * backwards;
        *body.spin = spin_of(body.orientation, body.inverse_inertia, body.momentum);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Error of a harmonic oscillator x = cos(t + 1) after time 8 with n steps.
    fn harmonic(n: u32, c0: f64, exact_start: bool) -> f64 {
        let dt = 8.0 / f64::from(n);
        let (c, s) = (libm::cos(1.0), libm::sin(1.0));
        let mut g = Gear::start(V3::x() * c, V3::x() * -s, V3::x() * -c, dt);
        if exact_start {
            let scale = dt * dt * dt / 6.0;
            g.0[3] = V3::x() * (s * scale);
            g.0[4] = V3::x() * (c * scale * dt / 4.0);
            g.0[5] = V3::x() * (-s * scale * dt * dt / 20.0);
        }
        for _ in 0..n {
            g.predict();
            let a = -g.0[0];
            g.correct(&a, dt, c0);
        }
        let (x, v) = (g.0[0].x - libm::cos(9.0), g.0[1].x / dt + libm::sin(9.0));
        (x * x + v * v).sqrt()
    }

    /// docs/references.md §10: 5.2–5.4 with exact start derivatives, 2.0 with zero ones (both c₀ = 3/20). With c₀ = 3/16,
    /// meant for forces that depend on velocity, the order is 5.
    #[test]
    fn order_gear_smooth() {
        let order = |c0, exact| libm::log2(harmonic(400, c0, exact) / harmonic(800, c0, exact));
        let smooth = order(CORRECTOR_0_CONSERVATIVE, true);
        assert!((4.8..=6.0).contains(&smooth), "{smooth}");
        let damped = order(CORRECTOR[0], true);
        assert!((4.8..=6.0).contains(&damped), "{damped}");
        let zero = order(CORRECTOR_0_CONSERVATIVE, false);
        assert!((1.9..=2.1).contains(&zero), "{zero}");
    }

    /// The predictor alone is exact for a polynomial of degree five.
    #[test]
    fn exact_predictor_on_quintic() {
        let mut g = Gear([V3::x(); 6]);
        g.predict();
        let binomials = [6.0, 15.0, 20.0, 15.0, 6.0, 1.0];
        for k in 0..6 {
            assert_eq!(g.0[k].x, binomials[k]);
        }
    }
}
