//! What gaps between grains are measured in.

use crate::units::Units;

/// SI to lattice units.
pub(super) struct Scales {
    pub length: f64,
    pub speed: f64,
    pub spin: f64,
    /// Of 1/m.
    pub inverse_mass: f64,
}

impl Scales {
    pub(super) fn of(units: &Units) -> Self {
        Self {
            length: 1.0 / units.dx_m,
            speed: 1.0 / units.velocity_unit(),
            spin: units.dt_s,
            inverse_mass: units.rho0_kg_per_m3 * units.dx_m * units.dx_m * units.dx_m,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_scales() {
        let scales = Scales::of(&Units::new(0.5, 0.25, 1000.0));
        // 1 m is two cells, 1 m/s half a cell per step, 1/s a quarter per step, and 125 kg the mass of a cell.
        assert_eq!((scales.length, scales.speed, scales.spin), (2.0, 0.5, 0.25));
        assert_eq!(scales.inverse_mass / 125.0, 1.0);
    }
}
