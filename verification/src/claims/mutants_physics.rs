//! Backends with one equation wrong: most are misprints of the papers.

use std::sync::Arc;

use lahar::boundary::bounce_back::bounce_back;
use lahar::boundary::links::Links;
use lahar::boundary::wall_law::WallStress;
use lahar::boundary::wall_slip::newtonian_slip;
use lahar::collision::forcing_guo::{even_source, odd_source};
use lahar::collision::{Bgk, Collision, CollisionChoice};
use lahar::free_surface::Kind;
use lahar::free_surface::conversion::excess::excess;
use lahar::free_surface::exchange::{self, link_mass};
use lahar::lane::Lane;
use lahar::lattice::equilibrium::dot;
use lahar::lattice::moments::{
    Moments, density_excess, deviator, magnitude, momentum, non_equilibrium, second,
};
use lahar::lattice::{Q, W, opposite};
use lahar::rheology::{Law, Prepared, Rheology};
use lahar::setup::Setup;
use lahar::solver::physics::{Physics, Standard};
use lahar::solver::plain::{Collided, Design, PlainRun, SurfaceLink, SurfacePhysics};
use lahar::solver::run::{Backend, Run, StartError};

use super::unguarded::Unguarded;

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
    /// \[B3\] as it was until the law by stress: the slip follows the cell's own stress, explicitly.
    ExplicitWallSlip,
    /// \[B3\] without the work of a moving wall.
    IdleWall,
    /// \[B3\] with F − ∇p for the stress gradient of a Newtonian fluid.
    PressureDrivenSlip,
    /// 000 Eq 12: masses for fills in the wetted share.
    ExchangeOfMasses,
    /// 004 Eq 3.31: half the difference of the fills.
    ExchangeOfDifferences,
    /// 004 Eq 3.32 at the node on the liquid side.
    ReconstructionAtNeighbour,
    /// 000 Eq 11, 004 Eq 3.30 without time level: populations before collision.
    ExchangeBeforeCollision,
    /// 000 Eq 12 as corrected: the mean of the fills, with no regard to links to gas and liquid.
    ExchangeOfMeanFills,
    /// \[F9\] left out.
    LateralStressInFull,
    /// \[F8\] left out.
    VoidsKept,
    /// \[F10\] left out.
    WallsMetAtOnce,
    /// The floor of τ⁻ at rest, too \[K3\].
    FloorAtRest,
    /// 000: excess without a rule.
    ExcessDropped,
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
        let laws: Vec<Prepared> = setup.fluids.iter().map(Law::prepare).collect();
        if self.0 == Mistake::FloorAtRest
            && let CollisionChoice::CentralMoment(odd) = &mut setup.collision
        {
            odd.calm = None;
        }
        let right = Standard::new(laws, setup.yielding, setup.collision);
        let physics = Wrong { right, mistake: self.0 };
        // A wrong surface need not keep its mass: the claim that must catch it measures by how much.
        let links = Arc::new(Links::new(&setup));
        let surface = WrongSurface { mistake: self.0, links };
        Ok(Box::new(Unguarded(PlainRun::start_with(&setup, physics, surface)?)))
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
        let omega = self.right.constant_omega()?;
        Some(if self.mistake == Mistake::NoHalfInTau { 1.0 / (1.0 / omega - 0.5) } else { omega })
    }

    fn omega<L: Lane>(&self, fluid: u8, rho: L, q: L, previous: L) -> L {
        let rho = if self.mistake == Mistake::NoDensityInTau { L::one() } else { rho };
        self.right.omega(fluid, rho, q, previous)
    }

    fn odd_omega<L: Lane>(&self, omega: L, square: L) -> L {
        self.right.odd_omega(omega, square)
    }

    fn odd_departure<L: Lane>(&self, h: &[L; Q], m: &Moments<L>) -> [L; Q] {
        self.right.odd_departure(h, m)
    }

    fn wanted_odd_excess<L: Lane>(&self, omega: L) -> L {
        self.right.wanted_odd_excess(omega)
    }

    fn collide<L: Lane>(&self, h: &[L; Q], m: &Moments<L>, omega: L) -> [L; Q] {
        match self.mistake {
            Mistake::AlwaysBgk => Bgk.collide(h, m, omega),
            Mistake::FullSource => {
                let post = self.right.collide(h, m, omega);
                let (even, odd) = (even_source(&m.u, &m.force), odd_source(&m.force));
                let half = L::splat(0.5) * omega;
                std::array::from_fn(|i| post[i] + half * (even[i] + odd[i]))
            }
            Mistake::SwappedRates => self.right.collide(h, m, self.odd_omega(omega, m.square())),
            _ => self.right.collide(h, m, omega),
        }
    }

    fn wall<L: Lane>(&self, out: L, i: usize, rho: L, u_wall: &[L; 3]) -> L {
        if self.mistake == Mistake::WallFactor {
            out - L::splat(2.0 * W[i]) * (rho * dot(i, u_wall))
        } else {
            bounce_back(out, i, rho, u_wall)
        }
    }

    fn carries_work(&self) -> bool {
        self.mistake != Mistake::IdleWall && self.right.carries_work()
    }

    fn wall_cubic(&self, i: usize, rho: f64, u_wall: &[f64; 3]) -> f64 {
        // The misprinted term is all that a moving wall adds.
        if self.mistake == Mistake::WallFactor { 0.0 } else { self.right.wall_cubic(i, rho, u_wall) }
    }

    fn slip<L: Lane>(&self, fluid: u8, wall: &WallStress<L>) -> L {
        // 1/(ρν) = 3ω/(ρ(1 − ω/2)).
        let apparent = L::splat(3.0) * wall.omega / (wall.rho * (L::one() - L::splat(0.5) * wall.omega));
        match self.mistake {
            Mistake::ApparentViscosityAtWall => newtonian_slip(wall, apparent),
            Mistake::ExplicitWallSlip => {
                let gamma_dot = L::splat(3.0) * wall.magnitude * wall.omega / wall.rho;
                let flowing = L::zero().less(gamma_dot);
                let safe = L::select(flowing, gamma_dot, L::one());
                let law = &self.right.laws[usize::from(fluid)];
                let tangent = L::select(flowing, L::one() / law.tangent_viscosity(safe), L::zero());
                wall.force * (L::splat(0.125) * tangent - wall.local / wall.rho)
            }
            Mistake::PressureDrivenSlip => {
                let slip = wall.force * (L::splat(0.125) * apparent - wall.local / wall.rho);
                L::smaller(slip, L::splat(3.0) * wall.traction / wall.rho)
            }
            _ => self.right.slip(fluid, wall),
        }
    }
}

/// The surface of the method with one equation overridden.
#[derive(Clone)]
struct WrongSurface {
    mistake: Mistake,
    links: Arc<Links>,
}

impl SurfacePhysics for WrongSurface {
    fn gained(&self, cells: &Collided, link: &SurfaceLink) -> f64 {
        let SurfaceLink { cell, i, from, direction } = *link;
        let (arriving, leaving) = (cells.after[from][direction], cells.after[cell][opposite(i)]);
        let between = cells.kinds[from] == Kind::Interface;
        let share = match self.mistake {
            // m of a cell before this step's exchange is its fill times its density.
            Mistake::ExchangeOfMasses if between => {
                let mass = |cell: usize| cells.fill[cell] * (1.0 + density_excess(&cells.after[cell]));
                0.5 * (mass(cell) + mass(from))
            }
            Mistake::ExchangeOfMeanFills if between => 0.5 * (cells.fill[from] + cells.fill[cell]),
            Mistake::ExchangeOfDifferences if between => 0.5 * (cells.fill[from] - cells.fill[cell]),
            Mistake::ExchangeBeforeCollision => {
                let share = exchange::wetted_share(cells.kinds[from], cells.fill[cell], cells.fill[from]);
                return link_mass(share, cells.before[from][direction], cells.before[cell][opposite(i)]);
            }
            _ => return Design.gained(cells, link),
        };
        link_mass(share, arriving, leaving)
    }

    fn gas_link(&self, after: &[[f64; Q]], cell: usize, out: usize, u: &[f64; 3]) -> f64 {
        let behind = match self.mistake {
            Mistake::ReconstructionAtNeighbour => self.links.neighbour_along(cell, out).unwrap_or(cell),
            _ => cell,
        };
        Design.gas_link(after, behind, out, u)
    }

    fn void_sink(&self, fill: f64, d_rho: f64) -> f64 {
        if self.mistake == Mistake::VoidsKept { 0.0 } else { Design.void_sink(fill, d_rho) }
    }

    fn dry_share(&self, share: f64) -> f64 {
        if self.mistake == Mistake::LateralStressInFull { 0.0 } else { share }
    }

    fn dry_share_at_wall(&self, share: f64) -> f64 {
        self.dry_share(share)
    }

    fn meeting(&self, share: f64) -> f64 {
        if self.mistake == Mistake::WallsMetAtOnce { 1.0 } else { share }
    }

    fn excess(&self, mass: f64, full: f64) -> f64 {
        if self.mistake == Mistake::ExcessDropped { 0.0 } else { excess(mass, full) }
    }
}
