//! Velocity Verlet: drift before the forces, correction after them.

use super::{External, LEAST, Step, TooFast, outside};
use crate::dem::bodies::Body;
use crate::dem::rotation::{spin_of, turn};
use crate::dem::{Bodies, Shape, V3};
use rayon::prelude::*;

/// First half of velocity Verlet, v½ = v + ½ a Δt, x += v½ Δt, and the velocity predicted for the force
/// evaluation, v + a Δt (second order with forces that depend on velocity).
///
/// Clumps carry L instead of ω: L½ = L + ½ M Δt turns the body freely over Δt.
///
/// # Returns
/// The first body whose free rotation did not converge.
/// # Source
/// docs/method.md \[D3\], \[D4\]; Swope et al. 1982, doi:10.1063/1.442716.
/// # Verified by
/// `order_verlet_smooth`, `conserves_clump_free`, `exact_flip_period`.
pub(crate) fn drift(b: &mut Bodies, external: &External, step: &Step) -> Option<usize> {
    b.each()
        .enumerate()
        .with_min_len(LEAST)
        .filter_map(|(i, body)| drift_one(body, outside(external, i), step).is_err().then_some(i))
        .min()
}

#[inline(always)]
fn drift_one(body: Body, (force, torque): (V3, V3), step: &Step) -> Result<(), TooFast> {
    let Step { dt, gravity, turn_spheres } = *step;
    if *body.inverse_mass == 0.0 {
        body.carry(step);
        return Ok(());
    }
    let kick = ((*body.force + force) * *body.inverse_mass + gravity) * dt;
    *body.position += (*body.velocity + kick * 0.5) * dt;
    *body.velocity += kick;
    let torque = *body.torque + torque;
    if *body.shape == Shape::Sphere {
        let kick = torque * (body.inverse_inertia.x * dt);
        if turn_spheres {
            *body.orientation = turn(body.orientation, &(*body.spin + kick * 0.5), dt);
        }
        *body.spin += kick;
        return Ok(());
    }
    let kick = torque * dt;
    let (mean, then) = (*body.momentum + kick * 0.5, *body.momentum + kick);
    body.turn_clump(&mean, then, dt)
}

/// Second half of velocity Verlet: v += ½ (a′ − a) Δt; `found(i, x)` gives the new contact force and torque of
/// body i with its centre at x.
///
/// # Returns
/// The first body whose state is not finite.
/// # Source
/// docs/method.md \[D3\], \[D4\]; Swope et al. 1982, doi:10.1063/1.442716.
/// # Verified by
/// `order_verlet_smooth`, `conserves_clump_free`, `exact_flip_period`.
pub(crate) fn correct<F>(b: &mut Bodies, dt: f64, found: F) -> Option<usize>
where
    F: Fn(usize, &V3) -> (V3, V3) + Sync,
{
    b.each()
        .enumerate()
        .with_min_len(LEAST)
        .filter_map(|(i, body)| {
            let found = found(i, body.position);
            (!correct_one(body, found, dt)).then_some(i)
        })
        .min()
}

#[inline(always)]
fn correct_one(body: Body, (force, torque): (V3, V3), dt: f64) -> bool {
    if *body.inverse_mass > 0.0 {
        *body.velocity += (force - *body.force) * (0.5 * dt * *body.inverse_mass);
        let kick = (torque - *body.torque) * (0.5 * dt);
        if *body.shape == Shape::Sphere {
            *body.spin += kick * body.inverse_inertia.x;
        } else {
            *body.momentum += kick;
            *body.spin = spin_of(body.orientation, body.inverse_inertia, body.momentum);
        }
    }
    body.settle(force, torque)
}
