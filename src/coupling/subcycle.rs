//! The grains' own steps inside a step of the fluid \[C4\].

use super::host::Host;
use super::immersed::{Immersed, on_pool};
use crate::dem::V3;
use crate::setup::guard::{Runaway, Stopped};
use crate::vector::norm_squared;

impl Immersed {
    /// Moves the grains by the forces of this step, then covers and frees cells; after streaming and the free
    /// surface.
    ///
    /// # Errors
    /// The grains could not go on ([`Immersed::failure`]), or one is faster than the fluid may be.
    pub(crate) fn advance(&mut self, host: &mut dyn Host) -> Result<(), Stopped> {
        let before: Vec<([f64; 6], V3)> = (0..self.grains()).map(|grain| self.momenta_of(grain)).collect();
        let alone = std::mem::take(&mut self.alone);
        let moved = on_pool(&alone, host.pool(), || self.sub_steps());
        self.alone = alone;
        if let Err(error) = moved {
            let grain = match &error {
                crate::dem::DemError::Overlap { pair, .. } => pair.grain(),
                crate::dem::DemError::NotFinite { grain, .. } | crate::dem::DemError::Spin { grain, .. } => {
                    *grain
                }
                _ => 0,
            };
            self.failure = Some(error);
            return Err(self.stopped(host, grain, Runaway::Grains { grain: grain as u32 }));
        }
        for (grain, before) in before.iter().enumerate() {
            if !self.is_driven(grain) {
                self.contact[grain] = self.unexplained(grain, before);
            }
        }
        let limit = host.setup().speed_limit;
        for grain in 0..self.grains() {
            let w = self.motion(grain);
            let speed2 = norm_squared([w[0], w[1], w[2]]);
            if speed2.is_nan() || speed2 > limit * limit {
                let what = Runaway::GrainTooFast { grain: grain as u32, speed: speed2.sqrt(), limit };
                return Err(self.stopped(host, grain, what));
            }
        }
        self.follow(host);
        let force = host.setup().force.at(host.step_number() + 1);
        self.balance(host.fluid_count(), &force);
        Ok(())
    }

    fn stopped(&self, host: &dyn Host, grain: usize, what: Runaway) -> Stopped {
        let centre = self.centre(grain);
        let cell = std::array::from_fn(|a| {
            let n = self.shape.extents[a] as i64;
            let at = if centre[a].is_finite() { centre[a].floor() as i64 } else { 0 };
            (if self.shape.periodic[a] { at.rem_euclid(n) } else { at.clamp(0, n - 1) }) as usize
        });
        Stopped { step: host.step_number(), cell, what, tau: f64::NAN }
    }

    /// Force and torque of the fluid as the grains feel it, N and N m.
    fn external(&self, grain: usize) -> (V3, V3) {
        let units = &self.config.units;
        let force = units.force_unit() * units.dx_m * units.dx_m * units.dx_m;
        let load = self.loads[grain].total();
        let part = |from: usize, scale: f64| {
            V3::new(load[from] * scale, load[from + 1] * scale, load[from + 2] * scale)
        };
        (part(0, force), part(3, force * units.dx_m))
    }

    fn sub_steps(&mut self) -> Result<(), crate::dem::DemError> {
        let loads: Vec<(V3, V3)> = (0..self.grains()).map(|grain| self.external(grain)).collect();
        let close = match &mut self.gaps {
            Some(gaps) => gaps.look(&self.dem, &self.config),
            None => false,
        };
        let driven = self.dem.bodies().driven.clone();
        for grain in &driven {
            self.contact[*grain as usize] = [0.0; 6];
        }
        if !close && driven.is_empty() {
            let (forces, torques) = self.dem.external_mut();
            for (grain, (force, torque)) in loads.iter().enumerate() {
                (forces[grain], torques[grain]) = (*force, *torque);
            }
            return self.dem.step(u64::from(self.config.sub_steps.max(1)));
        }
        for _ in 0..self.config.sub_steps.max(1) {
            let mut now = loads.clone();
            if let (Some(gaps), true) = (&mut self.gaps, close) {
                let wet = |grain: usize| self.loads[grain].wet_links > 0;
                gaps.push(&self.dem, &self.config, &wet, &mut now);
            }
            let (forces, torques) = self.dem.external_mut();
            for (grain, (force, torque)) in now.iter().enumerate() {
                (forces[grain], torques[grain]) = (*force, *torque);
            }
            self.dem.step(1)?;
            for grain in &driven {
                self.sum_driven(*grain as usize, &loads, &now);
            }
        }
        Ok(())
    }

    /// Adds the share of one step of the grains to the mean force and torque of contacts and lubrication on a driven grain,
    /// which its motion does not show; `fluid`, `all`: forces without and with lubrication, by grain.
    fn sum_driven(&mut self, grain: usize, fluid: &[(V3, V3)], all: &[(V3, V3)]) {
        let bodies = self.dem.bodies();
        let force = all[grain].0 - fluid[grain].0 + bodies.force[grain];
        let torque = all[grain].1 - fluid[grain].1 + bodies.torque[grain];
        let units = &self.config.units;
        let newton = units.force_unit() * units.dx_m * units.dx_m * units.dx_m;
        let steps = f64::from(self.config.sub_steps.max(1));
        let parts = [force / (newton * steps), torque / (newton * units.dx_m * steps)];
        for (sum, part) in self.contact[grain].iter_mut().zip(parts.iter().flat_map(|v| v.iter())) {
            *sum += part;
        }
    }

    /// (m U, J ω) of a grain, lattice units; the second entry is the angular momentum as the grains have it.
    fn momenta_of(&self, grain: usize) -> ([f64; 6], V3) {
        let w = self.motion(grain);
        (w, self.dem.bodies().angular_momentum(grain))
    }

    /// Mean force and torque that the forces of the fluid and the weight do not explain: contacts and lubrication.
    fn unexplained(&self, grain: usize, (before, turning): &([f64; 6], V3)) -> [f64; 6] {
        let units = &self.config.units;
        let (now, mass) = (self.motion(grain), self.mass(grain));
        let load = self.loads[grain].total();
        let weight = self.weight(grain);
        let change = self.dem.bodies().angular_momentum(grain) - turning;
        // kg m²/s in a step to lattice torque.
        let scale = units.dt_s
            / (units.rho0_kg_per_m3 * units.dx_m * units.dx_m * units.dx_m * units.dx_m * units.dx_m);
        std::array::from_fn(|a| {
            if a < 3 {
                mass * (now[a] - before[a]) - load[a] - weight[a]
            } else {
                change[a - 3] * scale - load[a]
            }
        })
    }
}
