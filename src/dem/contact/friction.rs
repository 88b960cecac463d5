//! Tangential spring with a cap, used for Coulomb friction and for rolling resistance \[D2\].

use super::V3;

/// A spring that gives way at a cap.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Slider {
    /// Elongation, advanced by half a step; already turned into the present contact plane.
    pub spring: V3,
    /// Magnitude of the spring force at the last step; after the call, at this step.
    pub force: f64,
    /// Factor ≤ 1 by which loading shortened the spring in this step (the force was kept, the stiffness rose).
    pub keep: f64,
    /// Energy in the spring, J; set by the call.
    pub energy: f64,
}

/// One step of an elastic–plastic spring with a dashpot in parallel.
///
/// Trapezoidal elongation ξ = ξ̂ + ½ v Δt. Below the cap it sticks: F = −k ξ − η v, shortened to the cap if the
/// dashpot lifts it above. At the cap it slips: ξ is cut to cap/k and F = −cap ξ/|ξ|.
///
/// # Returns
/// The force, the rate of loss while sticking (W), and the work of slip in this step (J), both ≥ 0.
/// # Source
/// docs/method.md \[D2\]; Cundall & Strack 1979; Luding 2008, doi:10.1007/s10035-008-0099-x.
/// # Verified by
/// `exact_sliding_to_rolling`, `exact_incline_threshold`, `balance_of_energy`.
#[inline(always)]
pub(crate) fn slide(
    s: &mut Slider,
    v: &V3,
    stiffness: f64,
    damping: f64,
    cap: f64,
    dt: f64,
) -> (V3, f64, f64) {
    let half = v * (0.5 * dt);
    let trial = s.spring + half;
    let length = trial.norm();
    let pull = stiffness * length;
    if pull > cap {
        let share = cap / pull;
        let kept = trial * share;
        // The slip happened along the step, during which the spring was shortened by `keep`: half of that on
        // average. Without this the books close to first order only.
        let slip = length * (1.0 - share) * (2.0 / (1.0 + s.keep));
        let work = 0.5 * (s.force + cap) * slip;
        s.spring = kept + half;
        s.force = cap;
        s.energy = 0.5 * cap * (share * length);
        (kept * -stiffness, 0.0, work)
    } else {
        let spring = trial * -stiffness;
        let mut force = spring - v * damping;
        let size2 = force.norm_squared();
        if size2 > cap * cap {
            force *= cap / size2.sqrt();
        }
        let rate = (spring - force).dot(v);
        s.spring = trial + half;
        s.force = pull;
        s.energy = 0.5 * pull * length;
        (force, rate, 0.0)
    }
}
