//! Collision operators.

pub(crate) mod bgk;
pub(crate) mod central_moment;
pub mod forcing_guo;
pub(crate) mod odd_rate;
pub(crate) mod regularised;
pub(crate) mod trt;

use serde::{Deserialize, Serialize};

use crate::lane::Lane;
use crate::lattice::Q;
use crate::lattice::moments::Moments;

pub use bgk::Bgk;
pub(crate) use central_moment::CentralMoment;
pub use odd_rate::OddRate;
pub(crate) use regularised::Regularised;
pub use trt::Trt;

/// One collision: pre-collision populations to post-collision populations, force included.
pub trait Collision: Copy + Send + Sync + 'static {
    /// Post-collision h* = f* − w.
    ///
    /// # Arguments
    /// `h`: populations f − w before collision. `m`: their moments, with the body force.
    /// `omega`: even relaxation rate ω⁺ in \[0, 2).
    fn collide<L: Lane>(&self, h: &[L; Q], m: &Moments<L>, omega: L) -> [L; Q];

    /// The odd relaxation rate ω⁻ that goes with `omega` in a cell of the squared velocity `square`.
    fn odd_omega<L: Lane>(&self, omega: L, square: L) -> L;

    /// Odd non-equilibrium of the pre-collision populations, with half the force: what relaxes with
    /// ω⁻. Its mass and momentum are zero.
    fn odd_departure<L: Lane>(&self, h: &[L; Q], m: &Moments<L>) -> [L; Q];

    /// Whether the equilibrium has the third moments of \[K3\].
    fn has_cubic_equilibrium(&self) -> bool;

    /// τ⁻ − ½ before any floor: what Λ asks for \[K6\].
    #[inline(always)]
    fn wanted_odd_excess<L: Lane>(&self, omega: L) -> L {
        L::one() / self.odd_omega(omega, L::zero()) - L::splat(0.5)
    }
}

/// The collision operator of a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CollisionChoice {
    /// \[K1\].
    Bgk,
    /// \[K2\].
    Trt(OddRate),
    /// \[K3\].
    CentralMoment(OddRate),
    /// \[K4\].
    Regularised,
}

impl Default for CollisionChoice {
    /// The central-moment operator: the only one that un-yields a moving plug \[K3\].
    fn default() -> Self {
        Self::CentralMoment(OddRate::default())
    }
}

macro_rules! for_each_collision {
    ($choice:expr, $name:ident => $body:expr) => {
        match *$choice {
            CollisionChoice::Bgk => {
                let $name = Bgk;
                $body
            }
            CollisionChoice::Trt(odd) => {
                let $name = Trt { odd };
                $body
            }
            CollisionChoice::CentralMoment(odd) => {
                let $name = CentralMoment { odd };
                $body
            }
            CollisionChoice::Regularised => {
                let $name = Regularised;
                $body
            }
        }
    };
}

/// Any operator, chosen per call: for analysis and for rarely used combinations.
impl Collision for CollisionChoice {
    #[inline(always)]
    fn collide<L: Lane>(&self, h: &[L; Q], m: &Moments<L>, omega: L) -> [L; Q] {
        for_each_collision!(self, operator => operator.collide(h, m, omega))
    }
    #[inline(always)]
    fn odd_omega<L: Lane>(&self, omega: L, square: L) -> L {
        for_each_collision!(self, operator => operator.odd_omega(omega, square))
    }
    fn has_cubic_equilibrium(&self) -> bool {
        for_each_collision!(self, operator => operator.has_cubic_equilibrium())
    }
    #[inline(always)]
    fn odd_departure<L: Lane>(&self, h: &[L; Q], m: &Moments<L>) -> [L; Q] {
        for_each_collision!(self, operator => operator.odd_departure(h, m))
    }
    #[inline(always)]
    fn wanted_odd_excess<L: Lane>(&self, omega: L) -> L {
        for_each_collision!(self, operator => operator.wanted_odd_excess(omega))
    }
}
