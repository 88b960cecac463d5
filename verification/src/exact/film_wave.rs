//! Small waves on a viscous film.

/// A film of a Newtonian fluid on an incline, so viscous that inertia does not count, without surface tension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmWave {
    /// Depth h.
    pub depth: f64,
    /// Wave number k.
    pub wave_number: f64,
    /// Dynamic viscosity μ.
    pub viscosity: f64,
    /// Force per volume along the bed.
    pub along: f64,
    /// Force per volume into the bed.
    pub down: f64,
}

impl FilmWave {
    fn kh(&self) -> f64 {
        self.wave_number * self.depth
    }

    /// cosh² kh + (kh)².
    fn denominator(&self) -> f64 {
        let (kh, cosh) = (self.kh(), libm::cosh(self.kh()));
        cosh * cosh + kh * kh
    }

    /// Velocity of the undisturbed surface, F_x h²/2μ.
    pub fn surface_velocity(&self) -> f64 {
        0.5 * self.along * self.depth * self.depth / self.viscosity
    }

    /// Phase velocity u_s \[1 + 1/(cosh² kh + (kh)²)\]: of long waves 2 u_s.
    ///
    /// # Source
    /// Yih 1963, Phys. Fluids 6, 321 (the limit of small Reynolds number).
    pub fn phase_velocity(&self) -> f64 {
        self.surface_velocity() * (1.0 + 1.0 / self.denominator())
    }

    /// Decay rate (F_z/2μk) (sinh kh cosh kh − kh)/(cosh² kh + (kh)²): of long waves F_z k² h³/3μ.
    ///
    /// # Source
    /// Orchard 1962, Appl. Sci. Res. A 11, 451.
    pub fn decay_rate(&self) -> f64 {
        let kh = self.kh();
        let shape = libm::sinh(kh) * libm::cosh(kh) - kh;
        self.down / (2.0 * self.viscosity * self.wave_number) * shape / self.denominator()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limit_of_long_waves() {
        let wave = FilmWave { depth: 2.0, wave_number: 1e-3, viscosity: 0.5, along: 0.1, down: 0.3 };
        // Terms of (kh)² = 4e-6 are left out; a factor of 2 for their coefficients.
        assert!((wave.phase_velocity() / (2.0 * wave.surface_velocity()) - 1.0).abs() < 8e-6);
        let lubrication = 0.3 * 1e-6 * 8.0 / (3.0 * 0.5);
        assert!((wave.decay_rate() / lubrication - 1.0).abs() < 8e-6);
    }
}
