//! The equations of one cell as a set.
//!
//! [`Standard`] is the physics of docs/method.md: every method forwards to the function that holds the
//! equation. Who wants to see a claim fail wraps it and overrides one method; the hot loop is compiled for
//! each, and the right one pays nothing for it. The equations of the free surface are in
//! [`crate::free_surface`].

use crate::boundary::wall_law::WallStress;
use crate::boundary::{bounce_back, wall_law, wall_slip};
use crate::collision::Collision;
use crate::lane::Lane;
use crate::lattice::Q;
use crate::lattice::moments::{self, Moments};
use crate::rheology::relaxation::SlowBranch;
use crate::rheology::{Rheology, relaxation};
use crate::setup::YieldTreatment;

/// One cell's equations.
pub trait Physics: Clone + Send + Sync + 'static {
    /// ρ, u, Q from populations and force \[L4\] \[Y1\].
    #[inline(always)]
    fn moments<L: Lane>(&self, h: &[L; Q], force: &[L; 3]) -> Moments<L> {
        moments::moments(h, force)
    }

    /// q = √(½ dev Q : dev Q) \[Y1\].
    #[inline(always)]
    fn stress_magnitude<L: Lane>(&self, m: &Moments<L>) -> L {
        moments::magnitude(&moments::deviator(&m.q))
    }

    /// Whether ω⁺ can differ from cell to cell: `false` if this type of physics has [`Self::constant_omega`], with
    /// one fluid at least.
    const VARIES: bool = true;

    /// Whether ω⁺ is the same everywhere and always, so that no stress magnitude is computed.
    fn constant_omega(&self) -> Option<f64>;

    /// ω⁺ of a cell holding fluid number `fluid` \[Y3\] \[Y4\].
    fn omega<L: Lane>(&self, fluid: u8, rho: L, q: L, previous: L) -> L;

    /// ω⁻ that goes with ω⁺ in a cell of the squared velocity `square` \[K2\] \[K3\].
    fn odd_omega<L: Lane>(&self, omega: L, square: L) -> L;

    /// τ⁻ − ½ that Λ asks for before the floor \[K6\]; the one in force without a floor.
    fn wanted_odd_excess<L: Lane>(&self, omega: L) -> L;

    /// Post-collision populations \[K1\]–\[K4\].
    fn collide<L: Lane>(&self, h: &[L; Q], m: &Moments<L>, omega: L) -> [L; Q];

    /// Half-way bounce-back \[B1\].
    #[inline(always)]
    fn wall<L: Lane>(&self, out: L, i: usize, rho: L, u_wall: &[L; 3]) -> L {
        bounce_back::bounce_back(out, i, rho, u_wall)
    }

    /// What the third-order part of the equilibrium adds to a wall that moves with the fluid, so that uniform flow
    /// passes it unchanged: −(f_i^eq − f_ī^eq) beyond second order.
    fn wall_cubic(&self, i: usize, rho: f64, u_wall: &[f64; 3]) -> f64;

    /// Whether third moments rest in the frame of the fluid \[K3\], so that those of a shear flow carry u σ, the work of the stress.
    fn carries_work(&self) -> bool;

    /// Odd non-equilibrium that relaxes with ω⁻ \[B3\].
    fn odd_departure<L: Lane>(&self, h: &[L; Q], m: &Moments<L>) -> [L; Q];

    /// Slip of a flat wall along the traction \[B3\].
    fn slip<L: Lane>(&self, fluid: u8, wall: &WallStress<L>) -> L;
}

/// The physics of docs/method.md, for one law type and one collision type.
#[derive(Clone, Debug)]
pub struct Standard<R, C> {
    /// The laws, by fluid number.
    pub laws: Vec<R>,
    /// How τ follows from the law.
    pub treatment: YieldTreatment,
    /// The collision operator.
    pub collision: C,
    /// Where the treatment makes the laws Newtonian.
    slow: Vec<Option<SlowBranch>>,
}

impl<R: Rheology, C: Collision> Standard<R, C> {
    /// From the laws, by fluid number.
    #[must_use]
    pub fn new(laws: Vec<R>, treatment: YieldTreatment, collision: C) -> Self {
        let slow = laws.iter().map(|law| SlowBranch::of(law, treatment)).collect();
        Self { laws, treatment, collision, slow }
    }
}

impl<R: Rheology, C: Collision> Physics for Standard<R, C> {
    const VARIES: bool = R::VARIES;

    fn constant_omega(&self) -> Option<f64> {
        match self.laws.as_slice() {
            [law] => law.constant_tau().map(|tau| 1.0 / tau),
            _ => None,
        }
    }

    #[inline(always)]
    fn omega<L: Lane>(&self, fluid: u8, rho: L, q: L, previous: L) -> L {
        relaxation::omega(&self.laws[usize::from(fluid)], self.treatment, rho, q, previous)
    }

    #[inline(always)]
    fn slip<L: Lane>(&self, fluid: u8, wall: &WallStress<L>) -> L {
        let law = &self.laws[usize::from(fluid)];
        if let Some(tau) = law.constant_tau() {
            return wall_slip::newtonian_slip(wall, L::splat(3.0 / (tau - 0.5)) / wall.rho);
        }
        let slow = self.slow[usize::from(fluid)].as_ref();
        let fluid = wall_law::Fluid::new(
            law.thickens(),
            #[inline(always)]
            |sigma| relaxation::flow(law, self.treatment, slow, wall.omega, sigma),
            #[inline(always)]
            |omega, square| L::one() / self.collision.odd_omega(omega, square) - L::splat(0.5),
        );
        wall_law::slip(wall, &fluid)
    }

    #[inline(always)]
    fn odd_omega<L: Lane>(&self, omega: L, square: L) -> L {
        self.collision.odd_omega(omega, square)
    }

    #[inline(always)]
    fn odd_departure<L: Lane>(&self, h: &[L; Q], m: &Moments<L>) -> [L; Q] {
        self.collision.odd_departure(h, m)
    }

    #[inline(always)]
    fn wanted_odd_excess<L: Lane>(&self, omega: L) -> L {
        self.collision.wanted_odd_excess(omega)
    }

    #[inline(always)]
    fn carries_work(&self) -> bool {
        self.collision.has_cubic_equilibrium()
    }

    fn wall_cubic(&self, i: usize, rho: f64, u_wall: &[f64; 3]) -> f64 {
        if self.collision.has_cubic_equilibrium() { bounce_back::cubic(i, rho, u_wall) } else { 0.0 }
    }

    #[inline(always)]
    fn collide<L: Lane>(&self, h: &[L; Q], m: &Moments<L>, omega: L) -> [L; Q] {
        self.collision.collide(h, m, omega)
    }
}
