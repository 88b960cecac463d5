//! One case of the sweep, drawn from its number alone.

use lahar::collision::{CollisionChoice, OddRate};
use lahar::rheology::Law;

/// Where the fluid flows. Lengths in units of the case's own ([`Case::length`]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// Between plane walls.
    Channel,
    /// Down an incline of so many degrees under a free surface.
    Film {
        /// Slope, degrees.
        slope: f64,
    },
    /// Through a rectangular duct.
    Duct {
        /// Height over width, 1 to 2.
        aspect: f64,
    },
    /// Through a round pipe.
    Pipe,
    /// Along the gap between coaxial cylinders.
    Annulus {
        /// Inner over outer radius.
        ratio: f64,
    },
    /// Between plane walls, one of which moves.
    Couette,
    /// Around a turning cylinder inside another at rest.
    Cylinders {
        /// Inner over outer radius.
        ratio: f64,
    },
}

impl Place {
    /// As it is called in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Channel => "channel",
            Self::Film { .. } => "film",
            Self::Duct { .. } => "duct",
            Self::Pipe => "pipe",
            Self::Annulus { .. } => "annulus",
            Self::Couette => "Couette",
            Self::Cylinders { .. } => "cylinders",
        }
    }

    /// Whether every wall is a plane between two layers of cells.
    pub const fn is_flat(self) -> bool {
        matches!(self, Self::Channel | Self::Film { .. } | Self::Duct { .. } | Self::Couette)
    }

    /// The number that goes with it, as printed; 0 if there is none.
    pub const fn detail(self) -> f64 {
        match self {
            Self::Film { slope } => slope,
            Self::Duct { aspect } => aspect,
            Self::Annulus { ratio } | Self::Cylinders { ratio } => ratio,
            Self::Channel | Self::Pipe | Self::Couette => 0.0,
        }
    }
}

/// How populations are relaxed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// The default.
    CentralMoment,
    /// Two relaxation times with the default odd one.
    Trt,
    /// One relaxation time.
    Bgk,
}

impl Operator {
    /// As it is called in scenes.
    pub const fn name(self) -> &'static str {
        match self {
            Self::CentralMoment => "central_moment",
            Self::Trt => "trt",
            Self::Bgk => "bgk",
        }
    }

    /// For a set-up.
    pub fn choice(self) -> CollisionChoice {
        match self {
            Self::CentralMoment => CollisionChoice::CentralMoment(OddRate::STANDARD),
            Self::Trt => CollisionChoice::Trt(OddRate::STANDARD),
            Self::Bgk => CollisionChoice::Bgk,
        }
    }
}

/// A steady flow between walls, in numbers without unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// The number it was drawn from.
    pub number: u64,
    /// Where it flows.
    pub place: Place,
    /// Flow index.
    pub n: f64,
    /// Yield stress over the wall stress.
    pub plug: f64,
    /// Cells: across channels, ducts and Couette flows, deep in films, of the (outer) radius elsewhere.
    pub cells: f64,
    /// τ of the plastic viscosity at the wall, (σ_w − σ0)/γ̇_w.
    pub tau: f64,
    /// Largest speed of the exact flow, cells per step.
    pub speed: f64,
    /// Operator.
    pub operator: Operator,
}

/// Cases below this number are small: the gate runs them.
pub const SMALL: u64 = 100;

/// SplitMix64 of a counter, mapped to \[0, 1): the same on every machine, no state.
pub struct Draw {
    number: u64,
    count: u64,
}

impl Draw {
    /// The draws of a number.
    pub const fn new(number: u64) -> Self {
        Self { number, count: 0 }
    }

    /// Evenly spread from 0 to 1.
    pub fn unit(&mut self) -> f64 {
        let golden = 0x9E37_79B9_7F4A_7C15_u64;
        let mut z = (self.number << 8).wrapping_add(self.count).wrapping_add(1).wrapping_mul(golden);
        self.count += 1;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Evenly spread between two numbers.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Evenly spread logarithm.
    pub fn ratio(&mut self, low: f64, high: f64) -> f64 {
        low * libm::pow(high / low, self.unit())
    }

    fn place(&mut self) -> Place {
        let (kind, detail) = (self.unit(), self.unit());
        if kind < 0.35 {
            Place::Channel
        } else if kind < 0.5 {
            Place::Film { slope: if detail < 0.5 { 12.0 } else { 20.0 } }
        } else if kind < 0.65 {
            Place::Duct { aspect: 1.0 + libm::floor(3.0 * detail) * 0.5 }
        } else if kind < 0.75 {
            Place::Pipe
        } else if kind < 0.83 {
            Place::Annulus { ratio: 0.3 + 0.3 * detail }
        } else if kind < 0.9 {
            Place::Couette
        } else {
            Place::Cylinders { ratio: 0.3 + 0.3 * detail }
        }
    }

    /// Flow index and plug of a law: of every five, one Newtonian, one power law, one Bingham, two Herschel-Bulkley.
    fn law(&mut self) -> [f64; 2] {
        let (kind, n, plug) = (self.unit(), self.ratio(0.1, 1.5), self.between(0.0, 0.95));
        if kind < 0.2 {
            [1.0, 0.0]
        } else if kind < 0.4 {
            [n, 0.0]
        } else if kind < 0.6 {
            [1.0, plug]
        } else {
            [n, plug]
        }
    }
}

/// Least τ − ½ that a number of cell updates allows: three runs of some twelve relaxations, cells²·1.2/((τ − ½) n) each.
fn affordable(place: Place, cells: f64, n: f64, updates: f64) -> f64 {
    let all = match place {
        Place::Channel | Place::Couette | Place::Film { .. } => cells,
        Place::Duct { aspect } => aspect * cells * cells,
        Place::Pipe | Place::Annulus { .. } | Place::Cylinders { .. } => 4.0 * cells * cells,
    };
    let across = if matches!(place, Place::Channel | Place::Couette | Place::Duct { .. }) {
        0.5 * cells
    } else {
        cells
    };
    36.0 * 1.2 * across * across * all / (n.min(1.0) * updates)
}

/// Cell updates of a small case: a second at most.
const UPDATES: f64 = 4e6;
/// Cell updates of the others.
const MANY_UPDATES: f64 = 4e7;

impl Case {
    /// The case of a number.
    pub fn new(number: u64) -> Self {
        let mut draw = Draw::new(number);
        let small = number < SMALL;
        let place = draw.place();
        let [n, plug] = draw.law();
        let n = if small { n.max(0.2) } else { n };
        // Small cases keep to what a second computes: steps grow as cells²/(τ − ½).
        let flat = !matches!(place, Place::Duct { .. }) && place.is_flat();
        let (fewest, most) = match (flat, small) {
            (true, true) => (4.0, 16.0),
            (true, false) => (4.0, 64.0),
            (false, true) => (6.0, 10.0),
            (false, false) => (6.0, 16.0),
        };
        let least = if small && !flat { 0.03 } else { 0.01 };
        let cells = libm::floor(draw.ratio(fewest, most + 1.0));
        let excess = draw.ratio(least, 1.5);
        let speed = draw.ratio(1e-3, 0.03);
        let kind = draw.unit();
        let operator = if kind < 0.65 {
            Operator::CentralMoment
        } else if kind < 0.95 || plug > 0.0 {
            // One relaxation time lets plugs slip without bound: the plan says so.
            Operator::Trt
        } else {
            Operator::Bgk
        };
        let cells = match place {
            // A film of any fill, pipes and cylinders that cut the grid anywhere.
            Place::Film { .. } | Place::Pipe | Place::Annulus { .. } | Place::Cylinders { .. } => {
                cells + draw.unit()
            }
            _ => cells,
        };
        let least = affordable(place, cells, n, if small { UPDATES } else { MANY_UPDATES });
        // Only the small ones take a larger step than any scene should.
        let tau = 0.5 + excess.max(if small { least } else { least.min(1.5) });
        Self { number, place, n, plug, cells, tau, speed, operator }
    }

    /// The law in units in which stress and shear rate at the wall are 1.
    pub fn law(&self) -> Law {
        let (sigma0, k, n) = (self.plug, 1.0 - self.plug, self.n);
        match (sigma0 > 0.0, n == 1.0) {
            (false, true) => Law::Newtonian { mu: k },
            (false, false) => Law::PowerLaw { k, n },
            (true, true) => Law::Bingham { sigma0, mu: k },
            (true, false) => Law::HerschelBulkley { sigma0, k, n },
        }
    }

    /// Whether the viscosity is constant.
    pub fn is_newtonian(&self) -> bool {
        self.plug == 0.0 && self.n == 1.0
    }

    /// Cells of the unit of length: half of what lies between plane walls, the depth of a film, the (outer) radius.
    pub fn length(&self) -> f64 {
        match self.place {
            Place::Channel | Place::Duct { .. } | Place::Couette => 0.5 * self.cells,
            _ => self.cells,
        }
    }

    /// Everything, to be printed.
    pub fn line(&self) -> String {
        format!(
            "case {}: {} ({:.4}), n = {:.4}, plug = {:.4}, cells = {:.3}, tau = {:.4}, speed = {:.3e}, {}",
            self.number,
            self.place.name(),
            self.place.detail(),
            self.n,
            self.plug,
            self.cells,
            self.tau,
            self.speed,
            self.operator.name()
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A number is a case for ever: rows of the table can be run again one by one.
    #[test]
    fn exact_cases_do_not_change() {
        let first = Case::new(0);
        assert_eq!(first, Case::new(0));
        for number in 0..2000 {
            let case = Case::new(number);
            assert!((0.1..=1.5).contains(&case.n) && (0.0..0.95).contains(&case.plug), "{}", case.line());
            assert!((4.0..66.0).contains(&case.cells) && case.tau >= 0.51, "{}", case.line());
            // Only the small ones take a larger step where the flow is slow.
            assert!(number < SMALL || case.tau <= 2.0, "{}", case.line());
        }
    }

    /// Every place and every kind of law comes up among the small ones.
    #[test]
    fn exact_small_cases_cover_all() {
        let cases: Vec<Case> = (0..SMALL).map(Case::new).collect();
        for name in ["channel", "film", "duct", "pipe", "annulus", "Couette", "cylinders"] {
            assert!(cases.iter().filter(|case| case.place.name() == name).count() >= 3, "{name}");
        }
        for law in ["Newtonian", "PowerLaw", "Bingham", "HerschelBulkley"] {
            let named = |case: &&Case| format!("{:?}", case.law()).starts_with(law);
            assert!(cases.iter().filter(named).count() >= 10, "{law}");
        }
    }
}
