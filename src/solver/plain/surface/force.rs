//! Body force of interface cells \[F3\] \[F9\].

use super::{Surface, SurfacePhysics};
use crate::boundary::links::{Links, Source};
use crate::free_surface::Kind;
use crate::free_surface::conversion::mirrored;
use crate::free_surface::force::{interface_force, smooth};
use crate::lattice::Q;
use crate::lattice::moments::density_excess;
use crate::setup::SurfaceForce;

impl<S: SurfacePhysics> Surface<S> {
    /// Force of a cell; `force`: that of this step.
    #[inline]
    pub(in crate::solver::plain) fn force_at(
        &self,
        links: &Links,
        cell: usize,
        force: &[f64; 3],
    ) -> [f64; 3] {
        if self.kinds[cell] != Kind::Interface {
            return *force;
        }
        let acceleration = match self.rules.force {
            SurfaceForce::ByFillAndInertia => self.acceleration_around(links, cell),
            SurfaceForce::Full | SurfaceForce::ByFill => [0.0; 3],
        };
        let weight = interface_force(self.rules.force, force, self.fill[cell], &acceleration);
        std::array::from_fn(|a| weight[a] + self.dry[cell][a])
    }

    /// Mean smoothed acceleration of the liquid neighbours; zero without any.
    fn acceleration_around(&self, links: &Links, cell: usize) -> [f64; 3] {
        let mut parts = [[0.0; Q]; 3];
        let mut count = 0;
        for i in 1..Q {
            let Source::Cell { cell: from, direction } = links.source(cell, i) else { continue };
            let from = from as usize;
            if self.kinds[from] == Kind::Liquid {
                count += 1;
                for (a, part) in parts.iter_mut().enumerate() {
                    part[i] = mirrored(i, usize::from(direction), a) * self.acceleration[from][a];
                }
            }
        }
        parts.map(|part| if count > 0 { density_excess(&part) / f64::from(count) } else { 0.0 })
    }

    /// Smoothed acceleration of every fluid cell, from the velocities of this and the last collision.
    pub(in crate::solver::plain) fn accelerate(&mut self) {
        if self.acceleration.is_empty() || self.velocity_before.is_empty() {
            return;
        }
        for (cell, acceleration) in self.acceleration.iter_mut().enumerate() {
            *acceleration = if self.kinds[cell].is_fluid() {
                let (now, before) = (&self.velocity[cell], &self.velocity_before[cell]);
                smooth(acceleration, &std::array::from_fn(|a| now[a] - before[a]))
            } else {
                [0.0; 3]
            };
        }
    }

    /// What the next step takes as the collision before.
    pub(super) fn remember_velocity(&mut self) {
        if !self.acceleration.is_empty() {
            self.velocity_before.clone_from(&self.velocity);
        }
    }
}
