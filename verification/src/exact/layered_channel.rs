//! Channel with layers of different laws, driven by a force and a moving wall together.

use super::ExactError;
use super::flow_curve::FlowCurve;

/// Layers between a resting wall (y = 0) and a wall moving at U, under a force per volume G.
///
/// The stress is σ(y) = σ_w − Gy in every layer; σ_w is the root of ∫ R(σ_w − Gy) dy = U, where
/// R(σ) = sgn(σ) γ̇(|σ|). With M₀ = ∫₀^σ γ̇ ds the integral over a layer is a difference of M₀(|σ|)/G.
/// With G = 0 use [`super::couette::LayeredCouette`].
#[derive(Clone, Debug, PartialEq)]
pub struct LayeredChannel<C> {
    layers: Vec<(C, f64)>,
    force: f64,
    lower_wall_stress: f64,
}

impl<C: FlowCurve> LayeredChannel<C> {
    /// Solves for the stress at the lower wall.
    ///
    /// # Arguments
    /// `layers`: law and thickness of each layer, from the resting wall up; `force` G ≠ 0;
    /// `wall_speed` U.
    ///
    /// # Errors
    /// `Argument` if there is no layer, a thickness is not positive, G is 0 or a number is not finite.
    pub fn new(layers: Vec<(C, f64)>, force: f64, wall_speed: f64) -> Result<Self, ExactError> {
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
        ExactError::positive("|force|", force.abs())?;
        if !wall_speed.is_finite() {
            return Err(ExactError::Argument {
                what: "wall_speed",
                value: wall_speed,
                allowed: "must be finite",
            });
        }
        let mut flow = Self { layers, force, lower_wall_stress: 0.0 };
        let height = flow.height();
        // Where both walls push the same way by more than any layer's need, U is overshot.
        let need = |(law, thickness): &(C, f64)| law.stress(wall_speed.abs() / thickness);
        let reach = flow.layers.iter().map(need).fold(0.0, |m: f64, s| if s > m { s } else { m });
        let (mut low, mut high) = (-reach - force.abs() * height, reach + force.abs() * height);
        for _ in 0..2000 {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            flow.lower_wall_stress = middle;
            if flow.velocity(height) < wall_speed {
                low = middle;
            } else {
                high = middle;
            }
        }
        flow.lower_wall_stress = high;
        Ok(flow)
    }

    fn height(&self) -> f64 {
        self.layers.iter().map(|(_, thickness)| thickness).sum()
    }

    /// σ(y), with the sign of du/dy.
    pub fn stress(&self, y: f64) -> f64 {
        self.lower_wall_stress - self.force * y
    }

    /// u(y).
    pub fn velocity(&self, y: f64) -> f64 {
        let (mut u, mut below) = (0.0, 0.0);
        for (law, thickness) in &self.layers {
            let top = y.clamp(below, below + thickness);
            let (from, to) = (self.stress(below).abs(), self.stress(top).abs());
            u += (law.moment(0, from) - law.moment(0, to)) / self.force;
            below += thickness;
        }
        u
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::poiseuille::Channel;
    use lahar::rheology::Law;

    #[test]
    fn exact_two_newtonian_layers() {
        let (mu1, mu2, force) = (0.02, 1.3, 0.7);
        let layers = vec![(Law::Newtonian { mu: mu1 }, 1.0), (Law::Newtonian { mu: mu2 }, 1.0)];
        let flow = LayeredChannel::new(layers, force, 0.0).unwrap();
        // Equal layers of thickness a = 1: interface velocity G a²/(μ1 + μ2) (Bird, Stewart &
        // Lightfoot, Transport Phenomena, §2.5). Rounding, amplified by μ2/μ1.
        assert!((flow.velocity(1.0) / (force / (mu1 + mu2)) - 1.0).abs() < 1e-12);
        assert!(flow.velocity(2.0).abs() < 1e-12);
    }

    #[test]
    fn limit_one_law_is_the_plane_channel() {
        let law = Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n: 0.33 };
        let flow = LayeredChannel::new(vec![(law, 0.7), (law, 1.3)], 1.0, 0.0).unwrap();
        let channel = Channel { law, half_width: 1.0, force: 1.0 };
        for y in [0.1, 0.6, 1.0, 1.4, 1.9] {
            // Rounding of σ_w through γ̇, a few 1e-15 times 1/n.
            assert!((flow.velocity(y) - channel.velocity(y - 1.0)).abs() < 1e-13, "{y}");
        }
    }

    #[test]
    fn limit_weak_force_is_couette() {
        let layers = vec![(Law::Newtonian { mu: 0.5 }, 1.0), (Law::Bingham { sigma0: 0.2, mu: 0.3 }, 1.0)];
        let couette = crate::exact::couette::LayeredCouette::new(layers.clone(), 2.0).unwrap();
        let flow = LayeredChannel::new(layers, 1e-6, 2.0).unwrap();
        // The force changes velocities by G h²/μ ~ 1e-5.
        assert!((flow.velocity(1.0) - couette.velocity(1.0)).abs() < 2e-5);
        assert!((flow.velocity(2.0) - 2.0).abs() < 1e-8);
    }

    #[test]
    fn refuses_bad_layers() {
        assert!(LayeredChannel::<Law>::new(Vec::new(), 1.0, 0.0).is_err());
        assert!(LayeredChannel::new(vec![(Law::Newtonian { mu: 1.0 }, 1.0)], 0.0, 0.0).is_err());
    }
}
