//! Backends with one equation wrong: most are misprints of the papers.

use lahar::boundary::bounce_back::bounce_back;
use lahar::collision::{Collision, CollisionChoice};
use lahar::free_surface::Kind;
use lahar::lane::Lane;
use lahar::lattice::Q;
use lahar::lattice::W;
use lahar::lattice::equilibrium::dot;
use lahar::lattice::moments::{Moments, deviator, magnitude, momentum, non_equilibrium, second};
use lahar::rheology::{Law, Prepared};
use lahar::setup::Setup;
use lahar::solver::physics::{Physics, Standard};
use lahar::solver::plain::{PlainRun, SurfaceRun};
use lahar::solver::run::{Backend, Run, StartError};

/// The one thing that is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mistake {
    /// 000 Eq 10: moving walls with 2 w_i instead of 6 w_i.
    WallFactor,
    /// 000 Eq 13: shear rate from f instead of f − f_eq.
    EquilibriumKept,
    /// 004 Eq 3.3 applied to 3.27: half the shear rate.
    ShearRateHalved,
    /// All three papers: no force in the non-equilibrium tensor.
    NoForceInStress,
    /// 000 Eqs 4–5, 001 Eqs 3–4: velocity without half the force.
    NoForceInVelocity,
    /// 004 Eq 3.38: r × ω instead of ω × r.
    SpinReversed,
    /// \[B3\] with the apparent viscosity.
    ApparentViscosityAtWall,
    /// 000 Eq 12: masses for fills in the wetted share.
    ExchangeOfMasses,
    /// 004 Eq 3.31: half the difference of the fills.
    ExchangeOfDifferences,
    /// 004 Eq 3.32 at the node on the liquid side.
    ReconstructionAtNeighbour,
    /// 000 Eq 11, 004 Eq 3.30 without time level: populations before collision.
    ExchangeBeforeCollision,
    /// 000: excess without a rule.
    ExcessDropped,
}

/// The plain solver with one mistake.
#[derive(Clone, Copy, Debug)]
pub struct Mistaken(pub Mistake);

impl Backend for Mistaken {
    fn name(&self) -> &'static str {
        "plain, with a mistake"
    }

    fn start(&self, setup: &Setup) -> Result<Box<dyn Run>, StartError> {
        let mut setup = setup.clone();
        if self.0 == Mistake::SpinReversed {
            for motion in &mut setup.solid_motion {
                motion.spin = motion.spin.map(|w| -w);
            }
        }
        let right = Standard {
            laws: setup.fluids.iter().map(Law::prepare).collect(),
            treatment: setup.yielding,
            collision: setup.collision,
        };
        let wrong = Wrong { right, mistake: self.0 };
        if setup.free_surface.is_some() || setup.grains.is_some() {
            Ok(Box::new(SurfaceRun::start(&setup, wrong)?))
        } else {
            Ok(Box::new(PlainRun::start(&setup, wrong)?))
        }
    }
}

/// Right physics, laws and collision chosen at run time, with one method overridden.
#[derive(Clone, Debug)]
struct Wrong {
    right: Standard<Prepared, CollisionChoice>,
    mistake: Mistake,
}

impl Physics for Wrong {
    fn moments<L: Lane>(&self, h: &[L; Q], force: &[L; 3]) -> Moments<L> {
        let mut m = self.right.moments(h, force);
        match self.mistake {
            Mistake::NoForceInStress => {
                m.q = non_equilibrium(&second(h), m.d_rho, m.rho, &m.u, &[L::zero(); 3]);
            }
            Mistake::NoForceInVelocity => {
                m.u = momentum(h).map(|j| j / m.rho);
                m.q = non_equilibrium(&second(h), m.d_rho, m.rho, &m.u, force);
            }
            _ => {}
        }
        m
    }

    fn stress_magnitude<L: Lane>(&self, m: &Moments<L>) -> L {
        match self.mistake {
            Mistake::EquilibriumKept => {
                let third = L::splat(1.0 / 3.0) * m.rho;
                let [x, y, z] = m.u;
                let flow = [x * x, y * y, z * z, x * y, x * z, y * z];
                let kept: [L; 6] = std::array::from_fn(|k| {
                    let pressure = if k < 3 { third } else { L::zero() };
                    m.q[k] + (m.rho * flow[k] + pressure)
                });
                magnitude(&kept)
            }
            // γ̇/2 satisfies the local relation with half the stress.
            Mistake::ShearRateHalved => L::splat(0.5) * magnitude(&deviator(&m.q)),
            _ => self.right.stress_magnitude(m),
        }
    }

    fn constant_omega(&self) -> Option<f64> {
        self.right.constant_omega()
    }

    fn omega<L: Lane>(&self, fluid: u8, rho: L, q: L, previous: L) -> L {
        self.right.omega(fluid, rho, q, previous)
    }

    fn odd_omega<L: Lane>(&self, omega: L) -> L {
        self.right.odd_omega(omega)
    }

    fn odd_departure<L: Lane>(&self, h: &[L; Q], m: &Moments<L>) -> [L; Q] {
        self.right.odd_departure(h, m)
    }

    fn wanted_odd_excess<L: Lane>(&self, omega: L) -> L {
        self.right.wanted_odd_excess(omega)
    }

    fn collide<L: Lane>(&self, h: &[L; Q], m: &Moments<L>, omega: L) -> [L; Q] {
        self.right.collision.collide(h, m, omega)
    }

    fn wall<L: Lane>(&self, out: L, i: usize, rho: L, u_wall: &[L; 3]) -> L {
        if self.mistake == Mistake::WallFactor {
            out - L::splat(2.0 * W[i]) * (rho * dot(i, u_wall))
        } else {
            bounce_back(out, i, rho, u_wall)
        }
    }

    fn tangent_fluidity<L: Lane>(&self, fluid: u8, rho: L, omega: L, q: L) -> L {
        if self.mistake == Mistake::ApparentViscosityAtWall {
            // 1/(ρν) = 3ω/(ρ(1 − ω/2)).
            L::splat(3.0) * omega / (rho * (L::one() - L::splat(0.5) * omega))
        } else {
            self.right.tangent_fluidity(fluid, rho, omega, q)
        }
    }

    fn wetted_share(
        &self,
        neighbour: Kind,
        fill: f64,
        neighbour_fill: f64,
        masses: impl Fn() -> [f64; 2],
    ) -> f64 {
        match (neighbour, self.mistake) {
            (Kind::Interface, Mistake::ExchangeOfMasses) => {
                let [own, other] = masses();
                0.5 * (own + other)
            }
            (Kind::Interface, Mistake::ExchangeOfDifferences) => 0.5 * (neighbour_fill - fill),
            _ => self.right.wetted_share(neighbour, fill, neighbour_fill, masses),
        }
    }

    fn link_mass<L: Lane>(&self, share: L, arriving: L, leaving: L, before: impl Fn() -> [L; 2]) -> L {
        if self.mistake == Mistake::ExchangeBeforeCollision {
            let [arriving, leaving] = before();
            share * (arriving - leaving)
        } else {
            self.right.link_mass(share, arriving, leaving, before)
        }
    }

    fn gas_link<L: Lane>(&self, leaving: L, i: usize, u: &[L; 3], behind: impl Fn() -> L) -> L {
        let wrong = self.mistake == Mistake::ReconstructionAtNeighbour;
        self.right.gas_link(if wrong { behind() } else { leaving }, i, u, &behind)
    }

    fn wants_before(&self) -> bool {
        self.mistake == Mistake::ExchangeBeforeCollision
    }

    fn is_mutant(&self) -> bool {
        true
    }

    fn excess(&self, e: f64) -> f64 {
        if self.mistake == Mistake::ExcessDropped { 0.0 } else { e }
    }
}
