//! Backends with one equation wrong, for mutants.

use lahar::collision::forcing_guo::{even_source, odd_source};
use lahar::collision::{Bgk, Collision, CollisionChoice};
use lahar::lane::Lane;
use lahar::lattice::Q;
use lahar::lattice::moments::{Moments, density_excess, moments, momentum, non_equilibrium, second};
use lahar::rheology::{Law, Prepared};
use lahar::setup::Setup;
use lahar::solver::physics::{Physics, Standard};
use lahar::solver::plain::PlainRun;
use lahar::solver::run::{Backend, Run, StartError};

/// A mistake in one equation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mistake {
    /// Q without ½(uF + Fu).
    NoForceInStress,
    /// u = Σ c f / ρ, without F/2.
    NoHalfForceInVelocity,
    /// The force source without 1 − ω/2.
    FullSource,
    /// τ = ½ + 3μ: the dynamic viscosity taken for the kinematic one.
    NoDensityInTau,
    /// τ = 3ν, without the ½ of the discrete step.
    NoHalfInTau,
    /// BGK whatever operator is asked for.
    AlwaysBgk,
    /// ω⁺ used for the odd populations and ω⁻ for the even ones.
    SwappedRates,
}

/// The plain backend with one mistake.
#[derive(Clone, Copy, Debug)]
pub struct Wrong(pub Mistake);

impl Backend for Wrong {
    fn name(&self) -> &'static str {
        "plain with a mistake"
    }

    fn start(&self, setup: &Setup) -> Result<Box<dyn Run>, StartError> {
        let base = Standard {
            laws: setup.fluids.iter().map(Law::prepare).collect(),
            treatment: setup.yielding,
            collision: setup.collision,
        };
        Ok(Box::new(PlainRun::start(setup, WrongPhysics { base, mistake: self.0 })?))
    }
}

#[derive(Clone)]
struct WrongPhysics {
    base: Standard<Prepared, CollisionChoice>,
    mistake: Mistake,
}

impl Physics for WrongPhysics {
    fn moments<L: Lane>(&self, h: &[L; Q], force: &[L; 3]) -> Moments<L> {
        let right = moments(h, force);
        match self.mistake {
            Mistake::NoForceInStress => {
                let q = non_equilibrium(&second(h), right.d_rho, right.rho, &right.u, &[L::zero(); 3]);
                Moments { q, ..right }
            }
            Mistake::NoHalfForceInVelocity => {
                let d_rho = density_excess(h);
                let rho = L::one() + d_rho;
                let u = momentum(h).map(|j| j / rho);
                Moments { u, q: non_equilibrium(&second(h), d_rho, rho, &u, force), ..right }
            }
            _ => right,
        }
    }

    fn constant_omega(&self) -> Option<f64> {
        let omega = self.base.constant_omega()?;
        Some(if self.mistake == Mistake::NoHalfInTau { 1.0 / (1.0 / omega - 0.5) } else { omega })
    }

    fn omega<L: Lane>(&self, fluid: u8, rho: L, q: L, previous: L) -> L {
        let rho = if self.mistake == Mistake::NoDensityInTau { L::one() } else { rho };
        self.base.omega(fluid, rho, q, previous)
    }

    fn odd_omega<L: Lane>(&self, omega: L) -> L {
        self.base.odd_omega(omega)
    }

    fn wanted_odd_excess<L: Lane>(&self, omega: L) -> L {
        self.base.wanted_odd_excess(omega)
    }

    fn collide<L: Lane>(&self, h: &[L; Q], m: &Moments<L>, omega: L) -> [L; Q] {
        match self.mistake {
            Mistake::AlwaysBgk => Bgk.collide(h, m, omega),
            Mistake::FullSource => {
                let post = self.base.collide(h, m, omega);
                let (even, odd) = (even_source(&m.u, &m.force), odd_source(&m.force));
                let half = L::splat(0.5) * omega;
                std::array::from_fn(|i| post[i] + half * (even[i] + odd[i]))
            }
            Mistake::SwappedRates => self.base.collide(h, m, self.odd_omega(omega)),
            _ => self.base.collide(h, m, omega),
        }
    }

    fn odd_departure<L: Lane>(&self, h: &[L; Q], m: &Moments<L>) -> [L; Q] {
        self.base.odd_departure(h, m)
    }

    fn wall_cubic(&self, i: usize, rho: f64, u_wall: &[f64; 3]) -> f64 {
        self.base.wall_cubic(i, rho, u_wall)
    }

    fn tangent_fluidity<L: Lane>(&self, fluid: u8, rho: L, omega: L, q: L) -> L {
        self.base.tangent_fluidity(fluid, rho, omega, q)
    }
}
