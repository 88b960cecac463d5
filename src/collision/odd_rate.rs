//! How the odd (antisymmetric) relaxation time follows the even one.

use serde::{Deserialize, Serialize};

use crate::lane::Lane;

/// Parameters of τ⁻(τ⁺) \[K2\] \[K3\] \[K5\].
///
/// With e = τ⁺ − ½: τ⁻ = ½ + max(Λ · min(1/e, e/e₀²), θ), e₀ = `lowered_below`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OddRate {
    /// Λ = (τ⁺ − ½)(τ⁻ − ½); 3/16 puts half-way walls exactly half-way.
    pub magic: f64,
    /// θ, least τ⁻ − ½.
    pub floor: f64,
    /// e₀: below this τ⁺ − ½ the product Λ is given up for stability \[K5\]; 0 keeps it always.
    pub lowered_below: f64,
}

impl Default for OddRate {
    fn default() -> Self {
        Self::STANDARD
    }
}

impl OddRate {
    /// The default parameters \[K3\] \[K5\].
    pub const STANDARD: Self = Self { magic: 3.0 / 16.0, floor: 0.05, lowered_below: 0.05 };

    /// For the central-moment operator among moving grains.
    ///
    /// Where τ⁻ is large, what the surface of a moving grain puts into the odd moments lives long and grows: a sphere
    /// of 3.3 cells moving at 0.08 cells per step makes the operator fail at τ⁺ ≤ 0.55 with [`Self::STANDARD`]. With
    /// e₀ = 0.15, so that τ⁻ − ½ ≤ 1.25, it is stable up to 0.15 cells per step at τ⁺ ≥ 0.505. The price is that
    /// walls lie at another place below τ⁺ = 0.65, as with one relaxation time.
    ///
    /// # Verified by
    /// Claim `fast-sphere-is-stable`.
    pub const AMONG_GRAINS: Self = Self { lowered_below: 0.15, ..Self::STANDARD };

    /// Λ fixed at all τ⁺, no floor: the textbook two-relaxation-time operator.
    #[must_use]
    pub const fn fixed(magic: f64) -> Self {
        Self { magic, floor: 0.0, lowered_below: 0.0 }
    }

    /// τ⁻ − ½ that Λ asks for, before the floor \[K5\].
    ///
    /// # Source
    /// docs/method.md \[K3\], \[K5\]; ½ + this is the τ_w of \[K6\].
    /// # Verified by
    /// Claim `poiseuille-newtonian-magic`; test `limit_unyielded_cell_takes_the_floor`.
    #[inline(always)]
    pub(crate) fn excess<L: Lane>(&self, omega: L) -> L {
        let e = L::one() / omega - L::splat(0.5);
        let wanted = L::splat(self.magic) / e;
        if self.lowered_below > 0.0 {
            let lowered = L::splat(self.magic / (self.lowered_below * self.lowered_below)) * e;
            L::smaller(wanted, lowered)
        } else {
            wanted
        }
    }

    /// ω⁻ = 1 / (½ + max(excess, θ)).
    ///
    /// # Source
    /// docs/method.md \[K2\], \[K3\].
    /// # Verified by
    /// Claim `poiseuille-newtonian-magic`.
    #[inline(always)]
    pub fn odd_omega<L: Lane>(&self, omega: L) -> L {
        let excess = L::larger(self.excess(omega), L::splat(self.floor));
        L::one() / (L::splat(0.5) + excess)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limit_unyielded_cell_takes_the_floor() {
        let odd = OddRate { magic: 3.0 / 16.0, floor: 0.05, lowered_below: 0.05 };
        assert_eq!(odd.odd_omega(0.0_f64), 1.0 / 0.55);
        assert_eq!(OddRate::fixed(0.1875).odd_omega(0.0_f64), 2.0);
    }

    #[test]
    fn exact_magic_product_above_the_threshold() {
        let odd = OddRate::default();
        for tau in [0.56, 0.8, 1.0, 2.0] {
            let tau_minus = 1.0 / odd.odd_omega(1.0 / tau);
            let product = (tau - 0.5) * (tau_minus - 0.5);
            // Five roundings of numbers of order one, divided by the smallest factor 0.06.
            assert!((product - 0.1875).abs() < 5.0 * f64::EPSILON / 0.06, "{tau}: {product}");
        }
    }
}
