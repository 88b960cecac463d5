//! What estimates ask of a law: numbers of its flow curve σ(γ̇), in the system of units of its parameters.

/// The flow curve of a law, for estimates before a run: scales, time steps, dimensionless numbers.
///
/// A law gives three numbers; the others follow from them, and a law that has closed forms gives those instead.
pub(crate) trait FlowCurve {
    /// Stress that remains as the shear rate vanishes, or that a smooth law has in its place: the scale of the Bingham
    /// number.
    fn plastic_stress(&self) -> f64;

    /// Stress that grows with the shear rate ≥ 0, without the plastic stress.
    fn viscous_stress(&self, gamma_dot: f64) -> f64;

    /// σ/γ̇ in the limit of vanishing shear rate; may be infinite or 0.
    fn viscosity_at_rest(&self) -> f64;

    /// Whether the fluid is rigid below its plastic stress.
    fn has_plug(&self) -> bool {
        self.plastic_stress() > 0.0
    }

    /// The plastic viscosity, if it is the same at every shear rate.
    fn constant_plastic_viscosity(&self) -> Option<f64> {
        None
    }

    /// Viscosity without the plastic stress at a shear rate > 0.
    fn plastic_viscosity(&self, gamma_dot: f64) -> f64 {
        self.viscous_stress(gamma_dot) / gamma_dot
    }

    /// Apparent viscosity σ/γ̇ at a shear rate > 0.
    fn apparent_viscosity(&self, gamma_dot: f64) -> f64 {
        self.plastic_stress() / gamma_dot + self.plastic_viscosity(gamma_dot)
    }

    /// Shear rate at a stress, 0 up to the plastic stress: the root of the viscous stress.
    ///
    /// # Exactness
    /// Doubling, then 60 halvings: rounding of the law remains.
    fn shear_rate_at(&self, sigma: f64) -> f64 {
        let excess = sigma - self.plastic_stress();
        if excess.is_nan() || excess <= 0.0 {
            return 0.0;
        }
        let (mut low, mut high) = (0.0, f64::MIN_POSITIVE);
        while self.viscous_stress(high) < excess && high < f64::MAX / 4.0 {
            (low, high) = (high, 2.0 * high);
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.viscous_stress(middle) < excess { low = middle } else { high = middle }
        }
        high
    }

    /// Largest velocity of the steady flow between two walls: (1/f) ∫ γ̇ dσ over stresses from 0 to σ_w = f a.
    ///
    /// A round pipe of radius a is slower, by at least a half.
    ///
    /// # Arguments
    /// `force`: f per volume along the walls; `half_gap`: a.
    ///
    /// # Exactness
    /// By parts, (γ̇_w (σ_w − σ0) − ∫ viscous stress dγ̇)/f, with the midpoint rule in √γ̇: a relative error below 1e-3
    /// for flow indices from 0.1 to 5.
    fn channel_velocity(&self, force: f64, half_gap: f64) -> f64 {
        const NODES: u32 = 256;
        let wall_stress = force * half_gap;
        let excess = wall_stress - self.plastic_stress();
        if excess.is_nan() || excess <= 0.0 {
            return 0.0;
        }
        let at_wall = self.shear_rate_at(wall_stress);
        let node = |i: u32| {
            let s = (f64::from(i) + 0.5) / f64::from(NODES);
            // dγ̇ = 2 s γ̇_w ds.
            2.0 * s * self.viscous_stress(at_wall * s * s)
        };
        let mean = (0..NODES).map(node).sum::<f64>() / f64::from(NODES);
        at_wall * (excess - mean) / force
    }
}

/// σ = σ0 + K γ̇ⁿ; with σ0 = 0 a power law, with n = 1 a Bingham or Newtonian fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PowerCurve {
    /// Yield stress σ0 ≥ 0.
    pub sigma0: f64,
    /// Consistency K > 0.
    pub k: f64,
    /// Flow index n > 0.
    pub n: f64,
}

impl FlowCurve for PowerCurve {
    fn plastic_stress(&self) -> f64 {
        self.sigma0
    }

    /// K γ̇ⁿ.
    fn viscous_stress(&self, gamma_dot: f64) -> f64 {
        self.k * libm::pow(gamma_dot, self.n)
    }

    fn viscosity_at_rest(&self) -> f64 {
        if self.has_plug() || self.n < 1.0 {
            f64::INFINITY
        } else if self.n == 1.0 {
            self.k
        } else {
            0.0
        }
    }

    fn constant_plastic_viscosity(&self) -> Option<f64> {
        (self.n == 1.0).then_some(self.k)
    }

    /// K γ̇ⁿ⁻¹.
    fn plastic_viscosity(&self, gamma_dot: f64) -> f64 {
        if self.n == 1.0 { self.k } else { self.k * libm::pow(gamma_dot, self.n - 1.0) }
    }

    /// ((σ − σ0)/K)^(1/n).
    fn shear_rate_at(&self, sigma: f64) -> f64 {
        if sigma <= self.sigma0 { 0.0 } else { libm::pow((sigma - self.sigma0) / self.k, 1.0 / self.n) }
    }

    /// n/(n+1) K^(−1/n) (σ_w − σ0)^(1+1/n) / f.
    fn channel_velocity(&self, force: f64, half_gap: f64) -> f64 {
        let wall_stress = force * half_gap;
        if wall_stress <= self.sigma0 {
            return 0.0;
        }
        self.n / (self.n + 1.0) * self.shear_rate_at(wall_stress) * (wall_stress - self.sigma0) / force
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rheology::Law;

    const HB: PowerCurve = PowerCurve { sigma0: 2.0, k: 3.0, n: 0.5 };

    #[test]
    fn exact_shear_rate_inverts_the_law() {
        // σ = 2 + 3·√4 = 8.
        assert_eq!(HB.shear_rate_at(8.0), 4.0);
        assert_eq!(HB.shear_rate_at(2.0), 0.0);
        assert_eq!(HB.apparent_viscosity(4.0), 2.0);
    }

    #[test]
    fn exact_channel_velocity_is_f_a2_over_2_mu_for_newtonian() {
        let water = Law::Newtonian { mu: 0.5 }.curve();
        assert_eq!(water.channel_velocity(2.0, 0.5), 0.5);
        assert_eq!(HB.channel_velocity(4.0, 0.5), 0.0);
    }

    #[test]
    fn exact_viscosity_at_rest() {
        let law = |sigma0, n| PowerCurve { sigma0, n, ..HB };
        assert_eq!(HB.viscosity_at_rest(), f64::INFINITY);
        for n in [0.5, 1.0, 2.0] {
            assert_eq!(law(2.0, n).viscosity_at_rest(), f64::INFINITY);
        }
        assert_eq!([0.5, 1.0, 2.0].map(|n| law(0.0, n).viscosity_at_rest()), [f64::INFINITY, 3.0, 0.0]);
    }

    /// A law that gives no closed form.
    struct Bare(PowerCurve);

    impl FlowCurve for Bare {
        fn plastic_stress(&self) -> f64 {
            self.0.plastic_stress()
        }
        fn viscous_stress(&self, gamma_dot: f64) -> f64 {
            self.0.viscous_stress(gamma_dot)
        }
        fn viscosity_at_rest(&self) -> f64 {
            self.0.viscosity_at_rest()
        }
    }

    #[test]
    fn limit_of_a_law_without_closed_forms() {
        for n in [0.1, 0.33, 0.5, 1.0, 2.0, 5.0] {
            let exact = PowerCurve { n, ..HB };
            let bare = Bare(exact);
            for sigma in [2.5, 8.0, 40.0] {
                // 60 halvings of an octave, and the rounding of a power with an exponent of up to 10.
                let (found, rate) = (bare.shear_rate_at(sigma), exact.shear_rate_at(sigma));
                assert!((found / rate - 1.0).abs() < 1e-13, "{n} {sigma}: {found} {rate}");
                for gap in [1.0, 0.5] {
                    let force = sigma / gap;
                    let (found, speed) =
                        (bare.channel_velocity(force, gap), exact.channel_velocity(force, gap));
                    assert!((found / speed - 1.0).abs() < 1e-3, "{n} {sigma} {gap}: {found} {speed}");
                }
            }
            assert_eq!(bare.constant_plastic_viscosity(), None);
            // One power and one division against one power.
            let (found, mu) = (bare.plastic_viscosity(4.0), exact.plastic_viscosity(4.0));
            assert!((found / mu - 1.0).abs() < 1e-14, "{n}: {found} {mu}");
            assert!((bare.apparent_viscosity(4.0) - (mu + 0.5)).abs() < 1e-14 * (mu + 0.5), "{n}");
            assert_eq!((bare.shear_rate_at(f64::NAN), bare.channel_velocity(f64::NAN, 1.0)), (0.0, 0.0));
            assert_eq!((bare.shear_rate_at(1.0), bare.channel_velocity(1.0, 1.0)), (0.0, 0.0));
        }
    }
}
