//! Wrong operators that the claims of this study must catch.

use crate::mutant::{Mutant, Subject};
use lahar::collision::{Collision, CollisionChoice, OddRate, Trt};
use lahar::lane::Lane;
use lahar::lattice::Q;
use lahar::lattice::moments::Moments;
use lahar::rheology::Law;
use lahar::setup::Setup;
use lahar::solver::physics::Standard;
use lahar::solver::plain::{Plain, PlainRun};
use lahar::solver::run::{Backend, Run, StartError};

/// Two relaxation times with ω⁺ and ω⁻ exchanged in the collision.
#[derive(Clone, Copy, Debug)]
struct Swapped(OddRate);

impl Collision for Swapped {
    fn collide<L: Lane>(&self, h: &[L; Q], m: &Moments<L>, omega: L) -> [L; Q] {
        /// The odd rate of the swapped operator is the even rate of the right one: τ⁻ = τ⁺ of the
        /// mutant, hence Λ = (τ⁺ − ½)(τ⁻ − ½) is unchanged by the exchange.
        fn exchanged<L: Lane>(odd: OddRate, omega: L) -> L {
            odd.odd_omega(omega, L::zero())
        }
        Trt { odd: self.0 }.collide(h, m, exchanged(self.0, omega))
    }
    fn has_cubic_equilibrium(&self) -> bool {
        Trt { odd: self.0 }.has_cubic_equilibrium()
    }
    fn odd_departure<L: Lane>(&self, h: &[L; Q], m: &Moments<L>) -> [L; Q] {
        Trt { odd: self.0 }.odd_departure(h, m)
    }
    fn odd_omega<L: Lane>(&self, omega: L, _square: L) -> L {
        omega
    }
}

/// The plain backend with that operator wherever TRT is asked for.
struct SwappedBackend;

impl Backend for SwappedBackend {
    fn name(&self) -> &'static str {
        "plain with exchanged rates"
    }
    fn start(&self, setup: &Setup) -> Result<Box<dyn Run>, StartError> {
        match setup.collision {
            CollisionChoice::Trt(odd) => {
                let laws = setup.fluids.iter().map(Law::prepare).collect();
                let physics = Standard::new(laws, setup.yielding, Swapped(odd));
                Ok(Box::new(PlainRun::start(setup, physics)?))
            }
            CollisionChoice::Bgk | CollisionChoice::CentralMoment(_) | CollisionChoice::Regularised => {
                Plain.start(setup)
            }
        }
    }
}

/// Exchanged relaxation rates.
pub const SWAPPED_RATES: Mutant = Mutant {
    id: "swapped-relaxation-rates",
    erratum: "design rule [K2]",
    description: "even moments relaxed with the odd rate and odd moments with the even rate",
    caught_by: "neumann-trt-grows",
    rung: Some(700.0),
    subject: Subject::Backend(|| Box::new(SwappedBackend)),
};
