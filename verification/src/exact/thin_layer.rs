//! Thin viscoplastic layer on a slope, on horizontal ground or spreading axisymmetrically, by
//! lubrication theory; finite volumes, implicit in time.
//!
//! Planar, x along the bed, z normal to it: ∂h/∂t + ∂q/∂x = 0. Axisymmetric on horizontal ground:
//! r ∂h/∂t + ∂(r q)/∂r = 0. Here z = h is the surface, z = b ≤ 0 the rigid base (b < 0 in a recess
//! filled with the fluid), D = h − b the depth and
//!
//! G = ρ g (sin θ − cos θ ∂h/∂x) the driving force per volume along the bed,
//!
//! q = sgn(G) ∫₀^D (D − z) γ̇(|G| (D − z)) dz = sgn(G)/G² ∫₀^{|G|D} s γ̇(s) ds,
//!
//! which for a Herschel-Bulkley law is the flux of 004 Eq 5.3 with the sign of 1 − S ∂h/∂x kept:
//! q = 0 wherever |G| D ≤ σ0. Any [`FlowCurve`] serves, ideal or clamped.
//!
//! Space: cell averages of D; at a face the depth is the mean of its two cells, but at most twice
//! that of the cell the fluid comes from, so a dry cell gives nothing; ∂h/∂x is the difference of
//! the two. Second order where h is smooth, first order at a front. Time: the two-stage stiffly
//! accurate SDIRK with γ = 1 − 1/√2 (order 2), each stage by Newton's method with a tridiagonal
//! matrix; the depths are then updated from the fluxes, so that volume changes by rounding alone.
//! The step follows the difference from the embedded first-order result.
//!
//! # Accuracy
//! Runs A, C, E and H of 004 Table 5.1 to 60 s, threshold 3 mm: fronts move by ≤ 1.1 mm from
//! Δx = 5 mm to 2.5 mm and, in an independent solver that agrees to 0.2 mm on equal grids, by
//! ≤ 0.4 mm from 2.5 mm to 1.25 mm; by ≤ 0.02 mm when `tolerance` falls from 1e-4 to 1e-6. Where
//! a bump of about the threshold's height lies ahead of the front (a clamped bed oozing from its lower
//! end), the front is ill-defined by up to the distance to it. What lubrication theory itself leaves
//! out (inertia, steep fronts, the rear wall, corners of the bed) is not in these numbers.
//!
//! # Source
//! 004 Eq 5.1-5.3 after Bates & Ancey 2017, J. Non-Newtonian Fluid Mech. 243, 64-78; the stress
//! balance is that of Liu & Mei 1989, J. Fluid Mech. 207, 505-529.

use super::ExactError;
use super::flow_curve::FlowCurve;
use stage::Stepper;

pub mod setting;
mod stage;
#[cfg(test)]
mod tests;

/// What the coordinate means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Geometry {
    /// x along the bed, everything uniform across; volumes are per width.
    Planar,
    /// r from the axis, on horizontal ground.
    Axisymmetric,
}

/// A layer on its bed. Both ends are walls (the lower one the axis if axisymmetric).
#[derive(Clone, Debug, PartialEq)]
pub struct ThinLayer<C> {
    /// The law (dynamic values), ideal or clamped.
    pub law: C,
    /// ρ.
    pub density: f64,
    /// g.
    pub gravity: f64,
    /// θ in radians, 0 ≤ θ < π/2, falling towards larger x; 0 if axisymmetric.
    pub slope: f64,
    /// What the coordinate means.
    pub geometry: Geometry,
    /// Δx; cell i spans \[i Δx, (i+1) Δx\].
    pub dx: f64,
    /// b, cell averages; its length is the number of cells.
    pub bed: Vec<f64>,
    /// Largest estimated volume misplaced in one time step, relative to the whole; 1e-4 is safe.
    pub tolerance: f64,
}

/// The layer at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    /// t.
    pub time: f64,
    /// Cell centres.
    pub x: Vec<f64>,
    /// Elevation of the surface, cell averages; equal to `b` where dry.
    pub h: Vec<f64>,
    /// Elevation of the rigid base, cell averages.
    pub b: Vec<f64>,
    /// Volume: per width if planar, 2π ∫ (h − b) r dr if axisymmetric.
    pub volume: f64,
}

/// Snapshots and what they cost.
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    /// One snapshot for every time asked for, in order.
    pub snapshots: Vec<Snapshot>,
    /// Time steps accepted.
    pub steps: usize,
    /// Time steps tried again with a smaller Δt.
    pub rejected: usize,
}

impl Snapshot {
    /// The largest x at which the elevation h falls through `threshold`, interpolated linearly between
    /// cell centres. `None` if h nowhere exceeds it or does so in the last cell.
    pub fn front(&self, threshold: f64) -> Option<f64> {
        last_crossing(&self.x, &self.h, threshold)
    }

    /// The largest x at which the depth h − b falls through `threshold`: where the wetted region ends, recesses
    /// included. `None` if it nowhere exceeds it or does so in the last cell.
    pub fn depth_front(&self, threshold: f64) -> Option<f64> {
        last_crossing(&self.x, &self.depth(), threshold)
    }

    /// h − b, cell averages.
    pub fn depth(&self) -> Vec<f64> {
        self.h.iter().zip(&self.b).map(|(h, b)| h - b).collect()
    }
}

fn last_crossing(x: &[f64], f: &[f64], threshold: f64) -> Option<f64> {
    let i = f.iter().rposition(|&f| f > threshold)?;
    let (next_x, next_f) = (x.get(i + 1)?, f.get(i + 1)?);
    Some(x[i] + (next_x - x[i]) * (f[i] - threshold) / (f[i] - next_f))
}

/// A flux and its derivatives with respect to depth and driving force.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flux {
    /// q.
    pub q: f64,
    /// ∂q/∂D.
    pub by_depth: f64,
    /// ∂q/∂G.
    pub by_force: f64,
}

/// q(D, G) = sgn(G)/G² ∫₀^{|G|D} s γ̇(s) ds, the flux of a layer of depth D free of stress at its
/// surface under the force per volume G.
///
/// With σ = |G| D: ∂q/∂D = sgn(G) D γ̇(σ), ∂q/∂G = (D² γ̇(σ) − 2|q|)/|G|.
pub fn flux<C: FlowCurve>(law: &C, depth: f64, force: f64) -> Flux {
    let size = force.abs();
    let stress = size * depth;
    if depth <= 0.0 || stress <= law.yield_stress() || stress == 0.0 {
        return Flux::default();
    }
    let rate = law.rate(stress);
    let q = law.moment(1, stress) / size / size;
    Flux {
        q: q.copysign(force),
        by_depth: (depth * rate).copysign(force),
        by_force: (depth * depth * rate - 2.0 * q) / size,
    }
}

impl<C: FlowCurve> ThinLayer<C> {
    /// The layer at the given times, started from rest with the surface h (cell averages).
    ///
    /// # Errors
    /// `Argument` for densities, gravities, Δx or tolerances that are not positive, a slope outside
    /// \[0, π/2\), a slope in axisymmetric geometry, beds and surfaces of different or no length, a
    /// surface below the bed, or times that do not increase from 0; `NotConverged` if the time step
    /// shrinks to nothing; `EndReached` when fluid arrives at a far end that was dry.
    pub fn run(&self, surface: &[f64], times: &[f64]) -> Result<History, ExactError> {
        self.check(surface, times)?;
        let mut depth: Vec<f64> = surface.iter().zip(&self.bed).map(|(h, b)| h - b).collect();
        let mut stepper = Stepper::new(self, &depth, times.last().copied().unwrap_or(0.0));
        let mut snapshots = Vec::with_capacity(times.len());
        for &time in times {
            stepper.advance(&mut depth, time)?;
            snapshots.push(self.snapshot(time, &depth));
        }
        Ok(History { snapshots, steps: stepper.steps, rejected: stepper.rejected })
    }

    /// Centres of the cells.
    pub fn centres(&self) -> Vec<f64> {
        (0..self.bed.len()).map(|i| (i as f64 + 0.5) * self.dx).collect()
    }

    fn snapshot(&self, time: f64, depth: &[f64]) -> Snapshot {
        let weight = match self.geometry {
            Geometry::Planar => 1.0,
            Geometry::Axisymmetric => 2.0 * core::f64::consts::PI,
        };
        let volume: f64 = depth.iter().enumerate().map(|(i, d)| d * self.cell(i)).sum();
        Snapshot {
            time,
            x: self.centres(),
            h: depth.iter().zip(&self.bed).map(|(d, b)| d + b).collect(),
            b: self.bed.clone(),
            volume: weight * volume,
        }
    }

    /// Size of cell i: Δx, or r Δr (per radian).
    fn cell(&self, i: usize) -> f64 {
        match self.geometry {
            Geometry::Planar => self.dx,
            Geometry::Axisymmetric => (i as f64 + 0.5) * self.dx * self.dx,
        }
    }

    /// Size of the face between cells i−1 and i: 1, or r.
    fn face(&self, i: usize) -> f64 {
        match self.geometry {
            Geometry::Planar => 1.0,
            Geometry::Axisymmetric => i as f64 * self.dx,
        }
    }

    fn check(&self, surface: &[f64], times: &[f64]) -> Result<(), ExactError> {
        let argument = |what, value, allowed| Err(ExactError::Argument { what, value, allowed });
        ExactError::positive("density", self.density)?;
        ExactError::positive("gravity", self.gravity)?;
        ExactError::positive("dx", self.dx)?;
        ExactError::positive("tolerance", self.tolerance)?;
        if !(0.0..core::f64::consts::FRAC_PI_2).contains(&self.slope) {
            return argument("slope", self.slope, "must be at least 0 and less than pi/2");
        }
        if self.geometry == Geometry::Axisymmetric && self.slope != 0.0 {
            return argument("slope", self.slope, "must be 0 in axisymmetric geometry");
        }
        if self.bed.len() < 2 || self.bed.len() != surface.len() {
            return argument(
                "cells",
                surface.len() as f64,
                "bed and surface need the same length, at least 2",
            );
        }
        if let Some((h, _)) = surface.iter().zip(&self.bed).find(|(h, b)| !(*h >= *b && h.is_finite())) {
            return argument("surface", *h, "must be finite and nowhere below the bed");
        }
        let mut last = 0.0;
        for &time in times {
            if !(time >= last && time.is_finite()) {
                return argument("time", time, "times must be finite and must not decrease from 0");
            }
            last = time;
        }
        Ok(())
    }
}
