//! Forces on a grain besides those of its links \[C2\] \[C6\].

use super::L3;
use super::coverage::NOBODY;
use super::gather::{Gathered, Pressed};
use super::host::Host;
use super::immersed::Immersed;
use crate::free_surface::Kind;
use crate::free_surface::hydrostatic::axis_of;
use crate::lattice::{C, W};
use crate::vector::{cross, norm};

impl Immersed {
    /// Force and torque of the fluid that is pressed between a grain and a wall or another grain, too thin for a cell:
    /// the pressure around the grain, continued. Between two grains the mean of the two, so that what one feels
    /// the other feels too.
    pub(super) fn blocked_force(&self, host: &dyn Host, grain: usize, all: &[Pressed]) -> [f64; 6] {
        let mut sum = [0.0; 6];
        let own = &all[grain];
        if !own.blocked {
            return sum;
        }
        let cover = self.coverage.of(grain);
        let centre = self.centre(grain);
        // Below a free surface air comes in where the pressure would fall below that of the gas.
        let with_gas = self.with_gas;
        let mut press = |inward: usize, r: &L3, excess: f64| {
            let excess = if with_gas && excess < 0.0 { 0.0 } else { excess };
            let c = C[inward].map(f64::from);
            let push = c.map(|c| c * (2.0 * W[inward] * excess));
            let turn = cross(*r, push);
            for a in 0..3 {
                sum[a] += push[a];
                sum[a + 3] += turn[a];
            }
        };
        if let Some(fit) = own.fit {
            for blocked in &cover.blocked {
                let inward = usize::from(blocked.inward);
                let r = self.shape.apart(&self.shape.centre(blocked.covered as usize), &centre);
                let r: L3 = std::array::from_fn(|a| r[a] - 0.5 * f64::from(C[inward][a]));
                press(inward, &r, fit.at(&r));
            }
        }
        for link in &cover.links {
            let cell = link.cell as usize;
            let other = self.coverage.owner(cell);
            if other == NOBODY || host.kind(cell) != Kind::Solid {
                continue;
            }
            let inward = usize::from(link.out);
            let middle: L3 = {
                let at = self.shape.centre(cell);
                std::array::from_fn(|a| at[a] + 0.5 * f64::from(C[inward][a]))
            };
            let r = self.shape.apart(&middle, &centre);
            let r_other = self.shape.apart(&middle, &self.centre(other as usize));
            let excess = match (own.fit, all[other as usize].fit) {
                (Some(a), Some(b)) => 0.5 * (a.at(&r) + b.at(&r_other)),
                (Some(a), None) => a.at(&r),
                (None, Some(b)) => b.at(&r_other),
                (None, None) => continue,
            };
            press(inward, &r, excess);
        }
        sum
    }

    /// Pressure gradients that the lattice does not carry, and the fluid between a grain's volume and its cells.
    pub(super) fn rest_force(&self, grain: usize, own: &Gathered, force: &L3) -> [f64; 6] {
        let volume = self.volume(grain);
        let mut sum = [0.0; 6];
        for a in 0..3 {
            sum[a] = volume * (self.config.pressure_gradient[a] + self.gradient[a]);
        }
        // The weight of the fluid that fits between the grain's volume and its cells, in proportion to the wet part
        // of the surface.
        let axis = axis_of(force);
        let wet = own.open.len() as f64;
        let all = wet + own.dry.len() as f64;
        if !self.shape.periodic[axis] && all > 0.0 {
            let missing = volume - self.coverage.of(grain).cells.len() as f64;
            sum[axis] -= missing * force[axis] * (wet / all);
        }
        sum
    }

    /// What contacts will do in this step: what they did in the last, but no more than what they have to hold.
    pub(super) fn expected_contact(&self, grain: usize, others: &[f64; 6]) -> [f64; 6] {
        let last = &self.contact[grain];
        let norm = |v: &[f64]| norm([v[0], v[1], v[2]]);
        let mut expected = [0.0; 6];
        for part in [0..3, 3..6] {
            let (was, held) = (norm(&last[part.clone()]), norm(&others[part.clone()]));
            let scale = if was > held && was > 0.0 { held / was } else { 1.0 };
            for a in part {
                expected[a] = last[a] * scale;
            }
        }
        expected
    }
}
