//! Steady film on an incline.

use super::flow_curve::FlowCurve;
use super::poiseuille::Channel;

/// Uniform film of thickness H on a plane inclined by θ, free of shear at its surface: half a
/// channel turned over, with G = ρ g sin θ.
///
/// # Source
/// Liu & Mei 1989, J. Fluid Mech. 207, 505-529, for Bingham; Huang & Garcia 1998, J. Fluid Mech.
/// 374, 305-333, for Herschel-Bulkley.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Film<C> {
    /// The law (dynamic values).
    pub law: C,
    /// H.
    pub thickness: f64,
    /// ρ.
    pub density: f64,
    /// g.
    pub gravity: f64,
    /// θ in radians, 0 < θ ≤ π/2.
    pub slope: f64,
}

impl<C: FlowCurve + Clone> Film<C> {
    fn channel(&self) -> Channel<C> {
        Channel { law: self.law.clone(), half_width: self.thickness, force: self.force() }
    }

    /// ρ g sin θ.
    pub fn force(&self) -> f64 {
        self.density * self.gravity * libm::sin(self.slope)
    }

    /// u(z), z measured from the bed along its normal.
    pub fn velocity(&self, z: f64) -> f64 {
        self.channel().velocity(self.thickness - z)
    }

    /// u at the surface.
    pub fn surface_velocity(&self) -> f64 {
        self.velocity(self.thickness)
    }

    /// ∫₀^H u dz.
    pub fn flux(&self) -> f64 {
        0.5 * self.channel().flux()
    }

    /// h_c = σ0/(ρ g sin θ): a thinner film rests.
    pub fn critical_thickness(&self) -> f64 {
        self.law.yield_stress() / self.force()
    }

    /// Thickness of the sheared layer, max(H − h_c, 0).
    pub fn sheared_thickness(&self) -> f64 {
        let sheared = self.thickness - self.critical_thickness();
        if sheared > 0.0 { sheared } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::poiseuille_clamped::Trilinear;
    use crate::reference_values::find;
    use lahar::rheology::Law;

    const DEGREE: f64 = core::f64::consts::PI / 180.0;
    const THESIS: Law = Law::HerschelBulkley { sigma0: 58.0, k: 35.0, n: 0.33 };

    fn close(computed: f64, reference: f64, tolerance: f64) {
        assert!((computed - reference).abs() <= tolerance * reference.abs(), "{computed} {reference}");
    }

    #[test]
    fn reference_films() {
        for (name, law) in [
            ("film_HB_thesis_fluid_theta16_H30mm", THESIS),
            ("film_HB_thesis_fluid_theta24_H30mm", THESIS),
            ("film_Newtonian", Law::Newtonian { mu: 10.0 }),
        ] {
            let entry = find(name, &[]).unwrap();
            let film = Film {
                law,
                thickness: entry.input("H").unwrap(),
                density: entry.input("rho").unwrap(),
                gravity: 9.81,
                slope: entry.input("theta").unwrap() * DEGREE,
            };
            for (computed, field) in [
                (film.surface_velocity(), "us"),
                (film.flux(), "q"),
                (film.critical_thickness(), "hc"),
                (film.sheared_thickness(), "Y"),
                (film.flux() / film.thickness, "ubar"),
            ] {
                close(computed, entry.field(field).unwrap(), entry.tolerance());
            }
        }
    }

    #[test]
    fn reference_creep_of_a_clamped_bed() {
        let law = Trilinear::new(THESIS, 0.15, 150.0).unwrap();
        let bed = |thickness| Film {
            law: law.clone(),
            thickness,
            density: 997.45,
            gravity: 9.81,
            slope: 16.0 * DEGREE,
        };
        let entry = find("film_creep_clamped_bed6mm_theta16", &[]).unwrap();
        close(bed(0.006).surface_velocity(), entry.field("us").unwrap(), entry.tolerance());
        let ideal =
            Film { law: THESIS, thickness: 1.0, density: 997.45, gravity: 9.81, slope: 16.0 * DEGREE };
        let entry = find("film_creep_clamped_hc_theta16", &[]).unwrap();
        let creep = bed(ideal.critical_thickness()).surface_velocity();
        close(creep, entry.field("us").unwrap(), entry.tolerance());
    }
}
