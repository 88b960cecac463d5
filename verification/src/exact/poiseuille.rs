//! Steady plane channel flow of any law.

use super::flow_curve::FlowCurve;

/// Plane channel |y| ≤ h between resting walls, driven by a force per volume G along x.
///
/// The stress is σ = G|y| whatever the law, so with M_p(σ) = ∫₀^σ sᵖ γ̇(s) ds
/// u(y) = (M₀(Gh) − M₀(G|y|))/G and ∫₀^h u dy = M₁(Gh)/G². For σ0 + Kγ̇ⁿ this is the closed form
/// u = (G/K)^{1/n} \[(h−h₀)^N − (|y|−h₀)₊^N\]/N with h₀ = σ0/G, N = 1 + 1/n.
///
/// # Arguments
/// `law`: a [`lahar::rheology::Law`] or [`super::poiseuille_clamped::Trilinear`]; `half_width` h > 0
/// (length); `force` G (force per volume; its sign is the sign of the flow).
///
/// # Source
/// Bird, Armstrong & Hassager, *Dynamics of Polymeric Liquids* vol. 1, ch. 4; thesis 004 Eqs 4.4-4.17.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Channel<C> {
    /// The law.
    pub law: C,
    /// h.
    pub half_width: f64,
    /// G.
    pub force: f64,
}

impl<C: FlowCurve> Channel<C> {
    /// u(y), y measured from the mid-plane; 0 outside the channel.
    pub fn velocity(&self, y: f64) -> f64 {
        if self.force == 0.0 || y.abs() >= self.half_width {
            return 0.0;
        }
        (self.law.moment(0, self.wall_stress()) - self.law.moment(0, self.stress(y))) / self.force
    }

    /// Magnitude of the shear stress, G|y|.
    pub fn stress(&self, y: f64) -> f64 {
        self.force.abs() * y.abs()
    }

    /// σ at the wall, Gh.
    pub fn wall_stress(&self) -> f64 {
        self.stress(self.half_width)
    }

    /// Magnitude of the shear rate at y.
    pub fn shear_rate(&self, y: f64) -> f64 {
        self.law.rate(self.stress(y))
    }

    /// γ̇ at the wall.
    pub fn wall_shear_rate(&self) -> f64 {
        self.law.rate(self.wall_stress())
    }

    /// h₀ = min(σ0/G, h): half the thickness of the rigid core; h if nothing flows.
    pub fn plug_half_width(&self) -> f64 {
        let yield_stress = self.law.yield_stress();
        if yield_stress >= self.wall_stress() { self.half_width } else { yield_stress / self.force.abs() }
    }

    /// Largest velocity, u(0); that of the plug if there is one.
    pub fn plug_velocity(&self) -> f64 {
        self.velocity(0.0)
    }

    /// ∫ u dy over the full width 2h.
    pub fn flux(&self) -> f64 {
        if self.force == 0.0 {
            return 0.0;
        }
        2.0 * self.law.moment(1, self.wall_stress()) / (self.force * self.force.abs())
    }

    /// Flux over 2h.
    pub fn mean_velocity(&self) -> f64 {
        self.flux() / (2.0 * self.half_width)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::quadrature::tanh_sinh;
    use crate::reference_values::find;
    use lahar::rheology::Law;

    const HB: Law = Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n: 0.33 };

    fn channel(law: Law) -> Channel<Law> {
        Channel { law, half_width: 1.0, force: 1.0 }
    }

    fn close(computed: f64, reference: f64, tolerance: f64) {
        assert!((computed - reference).abs() <= tolerance * reference.abs(), "{computed} {reference}");
    }

    #[test]
    fn reference_newtonian() {
        let flow = channel(Law::Newtonian { mu: 0.2 });
        let top = find("poiseuille_newtonian_umax", &[]).unwrap();
        close(flow.plug_velocity(), top.number().unwrap(), top.tolerance());
        let mean = find("poiseuille_newtonian_umean", &[]).unwrap();
        close(flow.mean_velocity(), mean.number().unwrap(), mean.tolerance());
    }

    #[test]
    fn reference_bingham_and_herschel_bulkley() {
        for (name, law) in [
            ("poiseuille_bingham", Law::Bingham { sigma0: 0.5, mu: 0.2 }),
            ("poiseuille_HB_thesis", HB),
            (
                "poiseuille_HB_thesis_if_eq3.3_applied_to_eq3.27",
                Law::HerschelBulkley { sigma0: 1.0, k: 0.31821459350196746, n: 0.33 },
            ),
        ] {
            let entry = find(name, &[]).unwrap();
            let flow = channel(law);
            for (computed, key) in [
                (flow.plug_velocity(), "u_plug"),
                (0.5 * flow.flux(), "q_half"),
                (flow.mean_velocity(), "u_mean"),
                (flow.plug_half_width(), "h0"),
                (flow.wall_shear_rate(), "gdot_wall"),
            ] {
                close(computed, entry.field(key).unwrap(), entry.tolerance());
            }
        }
    }

    #[test]
    fn reference_profile_of_the_thesis() {
        let entry = find("poiseuille_HB_thesis_profile", &[]).unwrap();
        for (y, u) in entry.input_list("y").unwrap().iter().zip(entry.list().unwrap()) {
            close(channel(HB).velocity(*y), u, entry.tolerance());
            assert_eq!(channel(HB).velocity(*y), channel(HB).velocity(-*y));
        }
    }

    #[test]
    fn ode_residual_for_every_law() {
        for law in [
            HB,
            Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n: 0.1 },
            Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n: 2.0 },
            Law::PowerLaw { k: 0.3, n: 0.6 },
            Law::Papanastasiou { sigma0: 0.5, k: 0.2, n: 0.33, m: 50.0 },
        ] {
            let flow = channel(law);
            for y in [0.6, 0.75, 0.9] {
                let h = 1e-4;
                let slope = (flow.velocity(y + h) - flow.velocity(y - h)) / (2.0 * h);
                // −du/dy = γ̇(Gy) up to h² γ̇″/6 of the central difference.
                let step_error = h * h * (1.0 / 0.1) * (1.0 / 0.1) / (6.0 * 0.01);
                close(-slope, law.rate(y), step_error);
            }
        }
    }

    #[test]
    fn flux_is_the_integral_of_the_velocity() {
        for law in [HB, Law::Papanastasiou { sigma0: 0.5, k: 0.2, n: 0.33, m: 50.0 }] {
            let flow = channel(law);
            let half = tanh_sinh(0.0, 0.5, |y| flow.velocity(y)) + tanh_sinh(0.5, 1.0, |y| flow.velocity(y));
            // Two integrations of 1e-13 each with a margin for the knee of the regularised law.
            close(0.5 * flow.flux(), half, 1e-11);
        }
    }

    #[test]
    fn limit_papanastasiou_tends_to_herschel_bulkley() {
        let ideal = channel(HB).plug_velocity();
        let error = |m: f64| {
            let law = Law::Papanastasiou { sigma0: 0.5, k: 0.2, n: 0.33, m };
            (channel(law).plug_velocity() - ideal).abs()
        };
        // ∫ over the knee σ0 ψ(mγ̇)/m ~ σ0/m: the difference falls as 1/m.
        assert!(error(1e6) < 2.0 * 0.5 / 1e6, "{}", error(1e6));
        assert!(error(1e5) > 5.0 * error(1e6));
    }

    #[test]
    fn limit_unyielded_reversed_and_unforced() {
        let rigid = channel(Law::Bingham { sigma0: 1.0, mu: 0.2 });
        assert_eq!((rigid.velocity(0.3), rigid.flux(), rigid.plug_half_width()), (0.0, 0.0, 1.0));
        let back = Channel { force: -1.0, ..channel(HB) };
        assert_eq!((back.velocity(0.3), back.flux()), (-channel(HB).velocity(0.3), -channel(HB).flux()));
        let still = Channel { force: 0.0, ..channel(HB) };
        assert_eq!((still.velocity(0.3), still.flux(), still.plug_half_width()), (0.0, 0.0, 1.0));
    }
}
