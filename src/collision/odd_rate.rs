//! How the odd (antisymmetric) relaxation time follows the even one.

use serde::{Deserialize, Serialize};

use crate::lane::Lane;

/// Parameters of τ⁻(τ⁺) \[K2\] \[K3\] \[K5\].
///
/// With e = τ⁺ − ½: τ⁻ = ½ + max(Λ · min(1/e, e/e₀²), θ), e₀ = `lowered_below`; with `calm`, where e > ½, θ min(1, |u|/u_c)
/// stands for θ.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OddRate {
    /// Λ = (τ⁺ − ½)(τ⁻ − ½); 3/16 puts half-way walls exactly half-way.
    pub magic: f64,
    /// θ, least τ⁻ − ½.
    pub floor: f64,
    /// e₀: below this τ⁺ − ½ the product Λ is given up for stability \[K5\]; 0 keeps it always.
    pub lowered_below: f64,
    /// u_c, cells per step: what is stiff and slower than this loses the floor in proportion to its speed; `None`: nothing does.
    #[serde(default)]
    pub calm: Option<f64>,
}

impl Default for OddRate {
    fn default() -> Self {
        Self::STANDARD
    }
}

impl OddRate {
    /// The default parameters \[K3\] \[K5\].
    pub const STANDARD: Self = Self { magic: 3.0 / 16.0, floor: 0.05, lowered_below: 0.05, calm: None };

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

    /// u_c = 20θF, twice the fastest creep, cells per step, of what rests under the force F \[K3\].
    ///
    /// Set after seeing: with the floor kept, layers of 8, 20 and 40 cells on a vertical wall creep at 0.24, 0.35 and 0.47 F where
    /// they are fastest (θ = 0.05); with u_c = 4θF the layer of 20 cells goes on at 0.02 F. Waves live longer the larger u_c is.
    #[must_use]
    pub const fn calm_speed(&self, force: f64) -> f64 {
        20.0 * self.floor * force
    }

    /// Λ fixed at all τ⁺, no floor: the textbook two-relaxation-time operator.
    #[must_use]
    pub const fn fixed(magic: f64) -> Self {
        Self { magic, floor: 0.0, lowered_below: 0.0, calm: None }
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

    /// ω⁻ = 1 / (½ + max(excess, θ(u²))).
    ///
    /// # Arguments
    /// `omega`: ω⁺. `square`: u² of the cell, cells² per step².
    /// # Source
    /// docs/method.md \[K2\], \[K3\].
    /// # Verified by
    /// Claims `poiseuille-newtonian-magic`, `rest-below-yield`.
    #[inline(always)]
    pub fn odd_omega<L: Lane>(&self, omega: L, square: L) -> L {
        let excess = L::larger(self.excess(omega), self.floor_at(omega, square));
        L::one() / (L::splat(0.5) + excess)
    }

    /// θ min(1, |u|/u_c) where τ⁺ > 1, θ elsewhere.
    ///
    /// The floor damps the waves of an unyielded solid; it also lets the stress diffuse, and strain that makes up for what a
    /// stress at rest loses by that is creep of up to 2θF per step, for ever. Creep slower than u_c can not sustain the floor
    /// that it needs ([`Self::calm_speed`]).
    ///
    /// # Source
    /// docs/method.md \[K3\], ours.
    /// # Verified by
    /// Claim `rest-below-yield`; test `exact_floor_of_calm_material`.
    #[inline(always)]
    fn floor_at<L: Lane>(&self, omega: L, square: L) -> L {
        let floor = L::splat(self.floor);
        match self.calm {
            Some(calm) if calm > 0.0 => {
                let share = L::smaller(L::splat(1.0 / calm) * square.sqrt(), L::one());
                L::select(omega.less(L::one()), floor * share, floor)
            }
            Some(_) | None => floor,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limit_unyielded_cell_takes_the_floor() {
        let odd = OddRate::STANDARD;
        assert_eq!(odd.odd_omega(0.0_f64, 0.0), 1.0 / 0.55);
        assert_eq!(OddRate::fixed(0.1875).odd_omega(0.0_f64, 0.0), 2.0);
    }

    #[test]
    fn exact_floor_of_calm_material() {
        let odd = OddRate { calm: Some(0.5), ..OddRate::STANDARD };
        // Rigid: at rest, at half of u_c, faster.
        assert_eq!(odd.odd_omega(0.0, 0.0), 2.0);
        assert_eq!(odd.odd_omega(0.0, 0.0625), 1.0 / (0.5 + 0.5 * 0.05));
        assert_eq!(odd.odd_omega(0.0, 1.0), 1.0 / 0.55);
        // Thin fluid keeps its floor.
        assert_eq!(odd.odd_omega(2.0, 0.0), 1.0 / 0.55);
    }

    #[test]
    fn exact_magic_product_above_the_threshold() {
        let odd = OddRate::default();
        for tau in [0.56, 0.8, 1.0, 2.0] {
            let tau_minus = 1.0 / odd.odd_omega(1.0 / tau, 0.0);
            let product = (tau - 0.5) * (tau_minus - 0.5);
            // Five roundings of numbers of order one, divided by the smallest factor 0.06.
            assert!((product - 0.1875).abs() < 5.0 * f64::EPSILON / 0.06, "{tau}: {product}");
        }
    }
}
