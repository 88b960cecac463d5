//! Plane Couette flow of any law, one or several layers.

use super::ExactError;
use super::flow_curve::FlowCurve;

/// Uniform fluid between a wall at rest (y = 0) and a wall moving at U (y = H). The shear is uniform,
/// γ̇ = U/H, even with a yield stress: σ = σ(U/H).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneCouette<C> {
    /// The law.
    pub law: C,
    /// U.
    pub wall_speed: f64,
    /// H > 0.
    pub gap: f64,
}

impl<C: FlowCurve> PlaneCouette<C> {
    /// u(y) = U y/H.
    pub fn velocity(&self, y: f64) -> f64 {
        self.wall_speed * (y / self.gap)
    }

    /// |U|/H.
    pub fn shear_rate(&self) -> f64 {
        self.wall_speed.abs() / self.gap
    }

    /// Magnitude of the shear stress; 0 for walls at rest.
    pub fn stress(&self) -> f64 {
        if self.wall_speed == 0.0 { 0.0 } else { self.law.stress(self.shear_rate()) }
    }
}

/// Couette flow driven by a given shear stress at the upper wall, which moves with the fluid.
/// Below the yield stress the fluid is rigid and rests with the lower wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StressDrivenCouette<C> {
    /// The law.
    pub law: C,
    /// Shear stress on the upper wall; its sign is the sign of the flow.
    pub stress: f64,
}

impl<C: FlowCurve> StressDrivenCouette<C> {
    /// u(y) = γ̇(σ) y.
    pub fn velocity(&self, y: f64) -> f64 {
        let rate = self.law.rate(self.stress.abs());
        if self.stress < 0.0 { -rate * y } else { rate * y }
    }
}

/// Layers of different laws between a wall at rest (y = 0) and a wall moving at U. All carry the
/// same stress σ, the root of Σ H_j γ̇_j(σ) = |U|.
#[derive(Clone, Debug, PartialEq)]
pub struct LayeredCouette<C> {
    layers: Vec<(C, f64)>,
    stress: f64,
    sign: f64,
}

impl<C: FlowCurve> LayeredCouette<C> {
    /// Solves for the common stress.
    ///
    /// # Arguments
    /// `layers`: law and thickness of each layer, from the resting wall up; `wall_speed` U.
    ///
    /// # Errors
    /// `Argument` if there is no layer or a thickness is not positive, or U is not finite.
    pub fn new(layers: Vec<(C, f64)>, wall_speed: f64) -> Result<Self, ExactError> {
        if layers.is_empty() {
            return Err(ExactError::Argument {
                what: "layers",
                value: 0.0,
                allowed: "at least one is needed",
            });
        }
        for (_, thickness) in &layers {
            ExactError::positive("thickness", *thickness)?;
        }
        if !wall_speed.is_finite() {
            return Err(ExactError::Argument {
                what: "wall_speed",
                value: wall_speed,
                allowed: "must be finite",
            });
        }
        let stress = if wall_speed == 0.0 { 0.0 } else { shared_stress(&layers, wall_speed.abs()) };
        Ok(Self { layers, stress, sign: if wall_speed < 0.0 { -1.0 } else { 1.0 } })
    }

    /// The stress all layers carry.
    pub fn stress(&self) -> f64 {
        self.stress
    }

    /// u(y).
    pub fn velocity(&self, y: f64) -> f64 {
        let (mut u, mut below) = (0.0, 0.0);
        for (law, thickness) in &self.layers {
            let inside = (y - below).clamp(0.0, *thickness);
            u += law.rate(self.stress) * inside;
            below += thickness;
        }
        self.sign * u
    }
}

/// Bisection to the last bit: the sum of the layers' speeds does not fall with σ. The stress at
/// which one layer alone would take up all of U is enough; the sum of U needs at least the yield
/// stress of the weakest layer.
fn shared_stress<C: FlowCurve>(layers: &[(C, f64)], speed: f64) -> f64 {
    let alone = layers.iter().map(|(law, thickness)| law.stress(speed / thickness));
    let mut high = alone.fold(f64::INFINITY, f64::min);
    let mut low = layers.iter().map(|(law, _)| law.yield_stress()).fold(f64::INFINITY, f64::min);
    for _ in 0..2000 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        let total: f64 = layers.iter().map(|(law, thickness)| thickness * law.rate(middle)).sum();
        if total < speed {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference_values::find;
    use lahar::rheology::Law;

    #[test]
    fn reference_stresses() {
        for (name, law) in [
            ("couette_bingham_stress", Law::Bingham { sigma0: 0.5, mu: 0.2 }),
            ("couette_HB_stress", Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n: 0.33 }),
        ] {
            let entry = find(name, &[]).unwrap();
            let stress = PlaneCouette { law, wall_speed: 1.0, gap: 2.0 }.stress();
            assert!((stress / entry.number().unwrap() - 1.0).abs() < entry.tolerance(), "{stress}");
        }
    }

    #[test]
    fn exact_two_viscosities() {
        let (mu1, mu2) = (0.001, 1.3);
        let layers = vec![(Law::Newtonian { mu: mu1 }, 0.5), (Law::Newtonian { mu: mu2 }, 0.5)];
        let flow = LayeredCouette::new(layers, 0.01).unwrap();
        // Equal halves: interface velocity U μ2/(μ1 + μ2), rounding only.
        assert!((flow.velocity(0.5) / (0.01 * mu2 / (mu1 + mu2)) - 1.0).abs() < 1e-14);
        assert!((flow.velocity(1.0) / 0.01 - 1.0).abs() < 1e-14);
        assert_eq!(flow.velocity(0.0), 0.0);
    }

    #[test]
    fn layers_of_any_laws_share_the_stress_and_add_up() {
        for wall_speed in [1e-6, 0.3, 50.0, -0.3] {
            let layers = vec![
                (Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n: 0.1 }, 0.4),
                (Law::PowerLaw { k: 0.1, n: 2.0 }, 0.3),
                (Law::Papanastasiou { sigma0: 0.2, k: 0.1, n: 0.5, m: 100.0 }, 0.3),
            ];
            let flow = LayeredCouette::new(layers, wall_speed).unwrap();
            // The steepest γ̇(σ) ~ x^10 multiplies the last bit of σ by about σ/(σ−σ0)/n.
            assert!((flow.velocity(1.0) / wall_speed - 1.0).abs() < 1e-10, "{}", flow.velocity(1.0));
        }
    }

    #[test]
    fn limit_a_strong_layer_rides_as_a_rigid_body() {
        let layers = vec![(Law::Newtonian { mu: 1.0 }, 1.0), (Law::Bingham { sigma0: 5.0, mu: 0.1 }, 1.0)];
        let flow = LayeredCouette::new(layers, 2.0).unwrap();
        assert_eq!(flow.velocity(1.0), flow.velocity(2.0));
        let rest = StressDrivenCouette { law: Law::Bingham { sigma0: 5.0, mu: 0.1 }, stress: -4.9 };
        assert_eq!(rest.velocity(1.0), 0.0);
        let moving = StressDrivenCouette { stress: -5.1, ..rest };
        // (5.1 − 5)/0.1 = 1; the difference costs 5.1/0.1 ulp.
        assert!((moving.velocity(2.0) + 2.0).abs() < 1e-13);
        let still = PlaneCouette { law: Law::Bingham { sigma0: 5.0, mu: 0.1 }, wall_speed: 0.0, gap: 1.0 };
        assert_eq!(still.stress(), 0.0);
        assert!(LayeredCouette::<Law>::new(Vec::new(), 1.0).is_err());
    }
}
