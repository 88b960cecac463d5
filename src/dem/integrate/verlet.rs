//! The passes over bodies: drift before the forces, correction after them.

use super::Integrator;
use super::gear::{CORRECTOR, CORRECTOR_0_CONSERVATIVE, Gear};
use crate::dem::bodies::SPHERE;
use crate::dem::rotation::{rotate_free, spin_of, turn};
use crate::dem::{Bodies, Orientation, V3};
use rayon::prelude::*;

/// Bodies per task at least.
const LEAST: usize = 512;

/// Force and torque set from outside, one pair per body, or none at all.
pub type External = Option<(Vec<V3>, Vec<V3>)>;

/// Constants of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// s.
    pub dt: f64,
    /// m/s².
    pub gravity: V3,
    /// Whether single spheres turn their orientation.
    pub turn_spheres: bool,
}

#[inline]
fn outside(external: &External, i: usize) -> (V3, V3) {
    external.as_ref().map_or((V3::zeros(), V3::zeros()), |(f, t)| (f[i], t[i]))
}

/// First half of velocity Verlet, v½ = v + ½ a Δt, x += v½ Δt, and the velocity predicted for the force
/// evaluation, v + a Δt (second order with forces that depend on velocity).
///
/// Clumps carry L instead of ω: L½ = L + ½ M Δt turns the body freely over Δt.
///
/// # Returns
/// The first body whose free rotation did not converge.
/// # Source
/// DESIGN \[D3\], \[D4\]; Swope et al. 1982, doi:10.1063/1.442716.
/// # Verified by
/// `order_verlet_smooth`, `conserves_clump_free`, `exact_flip_period`.
pub fn drift(b: &mut Bodies, external: &External, step: &Step) -> Option<usize> {
    let Step { dt, gravity, turn_spheres } = *step;
    (
        &mut b.position,
        &mut b.velocity,
        &mut b.spin,
        &mut b.orientation,
        &mut b.momentum,
        &b.force,
        &b.torque,
        &b.inverse_mass,
        &b.inverse_inertia,
        &b.shape,
    )
        .into_par_iter()
        .enumerate()
        .with_min_len(LEAST)
        .map(|(i, (x, v, w, q, l, f, t, im, ii, shape))| {
            if *im == 0.0 {
                carry(x, q, v, w, *shape != SPHERE || turn_spheres, dt);
                return usize::MAX;
            }
            let (fe, te) = outside(external, i);
            let kick = ((f + fe) * *im + gravity) * dt;
            *x += (*v + kick * 0.5) * dt;
            *v += kick;
            let torque = t + te;
            if *shape == SPHERE {
                let kick = torque * (ii.x * dt);
                if turn_spheres {
                    *q = turn(q, &(*w + kick * 0.5), dt);
                }
                *w += kick;
                return usize::MAX;
            }
            let kick = torque * dt;
            let Some(turned) = rotate_free(q, &(*l + kick * 0.5), ii, dt) else {
                return i;
            };
            *q = turned;
            *l += kick;
            *w = spin_of(q, ii, l);
            usize::MAX
        })
        .min()
        .filter(|&i| i != usize::MAX)
}

/// Second half of velocity Verlet: v += ½ (a′ − a) Δt; `found(i)` gives the new contact force and torque.
///
/// # Returns
/// The first body whose state is not finite.
/// # Source
/// See [`drift`].
/// # Verified by
/// See [`drift`].
pub fn correct<F>(b: &mut Bodies, dt: f64, found: F) -> Option<usize>
where
    F: Fn(usize, &V3) -> (V3, V3) + Sync,
{
    (
        &b.position,
        &mut b.velocity,
        &mut b.spin,
        &b.orientation,
        &mut b.momentum,
        &mut b.force,
        &mut b.torque,
        &b.inverse_mass,
        &b.inverse_inertia,
        &b.shape,
    )
        .into_par_iter()
        .enumerate()
        .with_min_len(LEAST)
        .map(|(i, (x, v, w, q, l, f, t, im, ii, shape))| {
            let (force, torque) = found(i, x);
            if *im > 0.0 {
                *v += (force - *f) * (0.5 * dt * *im);
                let kick = (torque - *t) * (0.5 * dt);
                if *shape == SPHERE {
                    *w += kick * ii.x;
                } else {
                    *l += kick;
                    *w = spin_of(q, ii, l);
                }
            }
            *f = force;
            *t = torque;
            let sum = x.x + x.y + x.z + v.x + v.y + v.z + w.x + w.y + w.z;
            if sum.is_finite() { usize::MAX } else { i }
        })
        .min()
        .filter(|&i| i != usize::MAX)
}

/// Moves a driven body on with the velocity and spin it was told to keep.
#[inline(always)]
fn carry(x: &mut V3, q: &mut Orientation, v: &V3, w: &V3, turns: bool, dt: f64) {
    *x += *v * dt;
    if turns {
        *q = turn(q, w, dt);
    }
}

/// Gear's predictor for positions and spins (of clumps: angular momenta; their attitude turns freely at the mean
/// momentum of the step, second order).
///
/// # Returns
/// The first body whose free rotation did not converge.
pub fn predict(b: &mut Bodies, state: &mut (Vec<Gear>, Vec<Gear>), step: &Step) -> Option<usize> {
    let Step { dt, turn_spheres, .. } = *step;
    let (places, turns) = state;
    let backwards = 1.0 / dt;
    (
        &mut b.position,
        &mut b.velocity,
        &mut b.spin,
        &mut b.orientation,
        &mut b.momentum,
        &b.inverse_mass,
        &b.inverse_inertia,
        &b.shape,
        places,
        turns,
    )
        .into_par_iter()
        .enumerate()
        .with_min_len(LEAST)
        .map(|(i, (x, v, w, q, l, im, ii, shape, place, angle))| {
            if *im == 0.0 {
                carry(x, q, v, w, *shape != SPHERE || turn_spheres, dt);
                return usize::MAX;
            }
            place.predict();
            *x = place.0[0];
            *v = place.0[1] * backwards;
            angle.predict();
            let rate = angle.0[1] * backwards;
            if *shape == SPHERE {
                if turn_spheres {
                    *q = turn(q, &((*w + rate) * 0.5), dt);
                }
                *w = rate;
                return usize::MAX;
            }
            let Some(turned) = rotate_free(q, &((*l + rate) * 0.5), ii, dt) else {
                return i;
            };
            *q = turned;
            *l = rate;
            *w = spin_of(q, ii, l);
            usize::MAX
        })
        .min()
        .filter(|&i| i != usize::MAX)
}

/// Gear's corrector; `found(i)` gives the new contact force and torque.
///
/// # Returns
/// The first body whose state is not finite.
pub fn correct_gear<F>(
    b: &mut Bodies,
    state: &mut (Vec<Gear>, Vec<Gear>),
    external: &External,
    step: &Step,
    kind: Integrator,
    found: F,
) -> Option<usize>
where
    F: Fn(usize, &V3) -> (V3, V3) + Sync,
{
    let Step { dt, gravity, .. } = *step;
    let (places, turns) = state;
    let c0 = if kind == Integrator::GearConservative { CORRECTOR_0_CONSERVATIVE } else { CORRECTOR[0] };
    let backwards = 1.0 / dt;
    (
        &mut b.position,
        &mut b.velocity,
        &mut b.spin,
        &b.orientation,
        &mut b.momentum,
        &mut b.force,
        &mut b.torque,
        &b.inverse_mass,
        &b.inverse_inertia,
        &b.shape,
        places,
        turns,
    )
        .into_par_iter()
        .enumerate()
        .with_min_len(LEAST)
        .map(|(i, (x, v, w, q, l, f, t, im, ii, shape, place, angle))| {
            let (force, torque) = found(i, x);
            let (fe, te) = outside(external, i);
            if *im > 0.0 {
                place.correct(&((force + fe) * *im + gravity), dt, c0);
                *x = place.0[0];
                *v = place.0[1] * backwards;
                let torque = torque + te;
                if *shape == SPHERE {
                    angle.correct(&(torque * ii.x), dt, c0);
                    *w = angle.0[1] * backwards;
                } else {
                    angle.correct(&torque, dt, c0);
                    *l = angle.0[1] * backwards;
                    *w = spin_of(q, ii, l);
                }
            }
            *f = force;
            *t = torque;
            let sum = x.x + x.y + x.z + v.x + v.y + v.z + w.x + w.y + w.z;
            if sum.is_finite() { usize::MAX } else { i }
        })
        .min()
        .filter(|&i| i != usize::MAX)
}
