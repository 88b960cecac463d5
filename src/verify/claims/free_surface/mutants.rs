//! Backends with one equation of the free surface wrong: misprints of the papers.

use crate::collision::{Collision, CollisionChoice};
use crate::free_surface::Kind;
use crate::lane::Lane;
use crate::lattice::Q;
use crate::lattice::moments::Moments;
use crate::rheology::Law;
use crate::solver::physics::{Physics, Standard};
use crate::solver::plain::{PlainRun, SurfaceRun};
use crate::solver::run::{Backend, Run, StartError};
use crate::solver::setup::Setup;
use crate::verify::mutant::{Mutant, Subject};

/// The one thing that is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mistake {
    /// 000 Eq 12: masses for fills.
    Masses,
    /// 004 Eq 3.31: half the difference of the fills.
    Differences,
    /// 004 Eq 3.32 at the node on the liquid side.
    Neighbour,
    /// 000 Eq 11, 004 Eq 3.30 without time level: populations before collision.
    BeforeCollision,
    /// 000: excess without a rule.
    ExcessDropped,
}

/// The plain solver with one mistake.
struct Mistaken(Mistake);

impl Backend for Mistaken {
    fn name(&self) -> &'static str {
        "plain, with a mistake at the surface"
    }

    fn start(&self, setup: &Setup) -> Result<Box<dyn Run>, StartError> {
        let right =
            Standard { laws: setup.fluids.clone(), treatment: setup.yielding, collision: setup.collision };
        let wrong = Wrong { right, mistake: self.0 };
        match setup.free_surface {
            Some(_) => Ok(Box::new(SurfaceRun::start(setup, wrong)?)),
            None => Ok(Box::new(PlainRun::start(setup, wrong)?)),
        }
    }
}

/// Right physics with one method overridden.
#[derive(Clone, Debug)]
struct Wrong {
    right: Standard<Law, CollisionChoice>,
    mistake: Mistake,
}

impl Physics for Wrong {
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

    fn tangent_fluidity<L: Lane>(&self, fluid: u8, rho: L, omega: L, q: L) -> L {
        self.right.tangent_fluidity(fluid, rho, omega, q)
    }

    fn wetted_share(&self, neighbour: Kind, fill: f64, neighbour_fill: f64, masses: [f64; 2]) -> f64 {
        match (neighbour, self.mistake) {
            (Kind::Interface, Mistake::Masses) => 0.5 * (masses[0] + masses[1]),
            (Kind::Interface, Mistake::Differences) => 0.5 * (neighbour_fill - fill),
            _ => self.right.wetted_share(neighbour, fill, neighbour_fill, masses),
        }
    }

    fn link_mass(&self, share: f64, arriving: f64, leaving: f64, before: [f64; 2]) -> f64 {
        match self.mistake {
            Mistake::BeforeCollision => share * (before[0] - before[1]),
            _ => self.right.link_mass(share, arriving, leaving, before),
        }
    }

    fn gas_link(&self, leaving: f64, i: usize, u: &[f64; 3], behind: f64) -> f64 {
        let reflected = if self.mistake == Mistake::Neighbour { behind } else { leaving };
        self.right.gas_link(reflected, i, u, behind)
    }

    fn wants_before(&self) -> bool {
        self.mistake == Mistake::BeforeCollision
    }

    fn is_mutant(&self) -> bool {
        true
    }

    fn excess(&self, e: f64) -> f64 {
        if self.mistake == Mistake::ExcessDropped { 0.0 } else { e }
    }
}

/// Wetted share from masses.
pub const MASSES: Mutant = Mutant {
    id: "exchange-of-masses",
    erratum: "ERRATA 20 (000 Eq 12)",
    description: "The wetted share of a link is the mean of the two masses instead of the mean of the two fills.",
    caught_by: "surface-pattern-carried",
    rung: None,
    subject: Subject::Backend(|| Box::new(Mistaken(Mistake::Masses))),
};

/// Wetted share with a minus.
pub const DIFFERENCES: Mutant = Mutant {
    id: "exchange-of-differences",
    erratum: "ERRATA 21 (004 Eq 3.31)",
    description: "The wetted share of a link is half the difference of the two fills: both cells gain the same mass.",
    caught_by: "dam-break-mass",
    rung: Some(500.0),
    subject: Subject::Backend(|| Box::new(Mistaken(Mistake::Differences))),
};

/// Reconstruction from the wrong node.
pub const NEIGHBOUR: Mutant = Mutant {
    id: "reconstruction-at-the-neighbour",
    erratum: "ERRATA 16 (004 Eq 3.32)",
    description: "The missing populations are reconstructed from the cell on the liquid side.",
    caught_by: "pool-at-rest",
    rung: Some(0.5),
    subject: Subject::Backend(|| Box::new(Mistaken(Mistake::Neighbour))),
};

/// Exchange of other populations than those that stream.
pub const BEFORE_COLLISION: Mutant = Mutant {
    id: "exchange-before-collision",
    erratum: "ERRATA 17 (000 Eq 11, 004 Eq 3.30)",
    description: "Mass is exchanged with the populations before collision, other ones than those that stream.",
    caught_by: "dam-break-mass",
    rung: Some(500.0),
    subject: Subject::Backend(|| Box::new(Mistaken(Mistake::BeforeCollision))),
};

/// Excess forgotten.
pub const EXCESS_DROPPED: Mutant = Mutant {
    id: "excess-dropped",
    erratum: "ERRATA 25 (000 text)",
    description: "The mass that a conversion leaves over is dropped.",
    caught_by: "dam-break-mass",
    rung: Some(500.0),
    subject: Subject::Backend(|| Box::new(Mistaken(Mistake::ExcessDropped))),
};
