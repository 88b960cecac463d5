//! Sums over many grains: energy, momentum, bits.

use super::support::{RADIUS, setup};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use lahar::dem::packing::{Lattice, Random, Region, Sizes, lattice, scatter};
use lahar::dem::{
    Clump, ContactEquations, Dem, Grain, Integrator, NormalLaw, PairProperties, Period, Setup,
    StandardContact, V3,
};
use lahar::solver::run::Backend;

/// Edge of the periodic box, m.
const EDGE: f64 = 0.1;

/// 150 spheres and tetrahedral clumps of radii 3 to 8 mm, flying and spinning at random in a periodic box.
fn cloud(pair: PairProperties, steps_per_contact: f64) -> Result<Setup, VerifyError> {
    let mut s = setup(7e6, pair);
    let region = Region::Box { low: V3::zeros(), high: V3::repeat(EDGE) };
    let mut random = Random::new(11);
    s.clumps = vec![Clump::tetrahedron(1.0, 1.6)?];
    let sizes = Sizes::Uniform { least: 3e-3, largest: 8e-3 };
    for (i, p) in scatter(150, &sizes, 1e-5, &region, 4)?.into_iter().enumerate() {
        let v = V3::from_fn(|_, _| 0.3 * random.normal());
        let w = V3::from_fn(|_, _| 50.0 * random.normal());
        // A clump reaches beyond its equivalent radius: shrunk into the sphere it replaces.
        let g = if i % 3 == 0 {
            Grain::clump(0, 0.6 * p.radius, p.centre, random.orientation(), 0)
        } else {
            Grain::sphere(p.radius, p.centre, 0)
        };
        s.grains.push(g.moving(v).spinning(w));
    }
    s.period = Period([Some(EDGE); 3]);
    s.design_speed_m_s = 2.0;
    s.steps_per_contact = steps_per_contact;
    Ok(s)
}

fn all_on() -> PairProperties {
    PairProperties {
        normal: NormalLaw::Tsuji { restitution: 0.7 },
        friction: 0.4,
        rolling_friction: 0.05,
        tangential_damping: 0.5,
    }
}

/// What is missing in the books after eighty contact times, over the energy at the start.
pub(super) fn books(
    steps: f64,
    integrator: Integrator,
    equations: impl ContactEquations,
) -> Result<Sample, VerifyError> {
    let mut s = cloud(all_on(), steps)?;
    s.integrator = integrator;
    let mut d = Dem::with_equations(&s, equations)?;
    let start = d.energies().balance();
    d.step_with(equations, (80.0 * steps) as u64)?;
    let e = d.energies();
    Ok(Sample::relative(steps, e.balance(), start)
        .with("lost to normal damping", e.lost_normal / start)
        .with("lost to friction", e.lost_friction / start)
        .with("lost to rolling", e.lost_rolling / start))
}

/// Energy.
pub const ENERGY: Claim = Claim {
    id: "energy-books",
    title: "Kinetic, elastic and dissipated energy add up, with all dissipation switched on",
    tags: &["D1", "D2", "D3", "D4", "004 Eq 3.38", "ERRATA 18"],
    measures: "What is missing in the books of 150 spheres and clumps in a periodic box after 80 contact times, over the energy at \
               the start; a quarter of it has been dissipated",
    reference: Reference { source: "Zero: conservation of energy", uncertainty: 0.0 },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "N (steps per contact)",
        short: &[25.0, 50.0, 100.0],
        full: &[25.0, 50.0, 100.0, 200.0, 400.0],
    },
    order: Some(OrderBand { expected: 2.0, band: 0.2, at_least: true }),
    tolerance: Tolerance {
        value: 3.2e-6,
        at: Rung::At(100.0),
        basis: Basis::AfterSeeing,
        because: "Second order: 0.031/N^2, the constant of the coarsest rung, gives 3.1e-6 at N = 100",
    },
    kind: Kind::Verification,
    measure: |_, steps| {
        let gear = books(steps, Integrator::Gear, StandardContact)?.error;
        Ok(books(steps, Integrator::Verlet, StandardContact)?.with("Gear", gear))
    },
};

/// Momentum.
pub const MOMENTUM: Claim = Claim {
    id: "periodic-momentum",
    title: "A periodic box keeps its momentum to rounding",
    tags: &["D6"],
    measures: "Change of the sum of m v over the sum of m |v|, 150 spheres and clumps colliding with friction",
    reference: Reference { source: "Zero: action and reaction", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "n (steps)", short: &[4000.0], full: &[4000.0, 40_000.0] },
    order: None,
    tolerance: Tolerance {
        value: 5e-15,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "Every pair's force is added and subtracted as the same number; each grain's velocity is rounded by 1e-16 in each of \
                  4e4 steps, at random: 1e-16 sqrt(4e4/150) = 1.6e-15; three times that",
    },
    kind: Kind::Verification,
    measure: |_, steps| {
        let mut d = Dem::new(&cloud(PairProperties::default(), 50.0)?)?;
        let before = d.ledger().momentum;
        d.step(steps as u64)?;
        let b = d.bodies();
        let size: f64 = (0..b.len()).map(|i| b.mass[i] * b.velocity[i].norm()).sum();
        Ok(Sample::absolute(steps, (d.ledger().momentum - before).norm() / size, 0.0))
    },
};

/// A dense layer of more than two thousand spheres thrown about over a wall: every pass is split among threads.
fn crowd() -> Result<Setup, VerifyError> {
    let mut s = setup(7e8, PairProperties::default());
    let mut random = Random::new(8);
    let region = Region::Box { low: V3::zeros(), high: V3::repeat(0.13) };
    s.grains = lattice(Lattice::FaceCentred, RADIUS, 2.01 * RADIUS, &region)?
        .into_iter()
        .map(|p| Grain::sphere(RADIUS, p.centre, 0).moving(V3::from_fn(|_, _| 0.5 * random.normal())))
        .collect();
    s.period = Period([Some(0.15), None, Some(0.15)]);
    s.walls = vec![super::support::plane("side", V3::zeros(), V3::y())];
    s.gravity = V3::y() * -9.81;
    s.design_speed_m_s = 3.0;
    Ok(s)
}

/// Bits.
pub const THREADS: Claim = Claim {
    id: "same-bits-on-threads",
    title: "A run has the same bits on any number of threads",
    tags: &["D6", "HARD_CASES H18"],
    measures: "Bodies whose position, velocity, spin or force differs in any bit from the run on one thread; more than 2000 spheres, \
               150 steps",
    reference: Reference { source: "The same run on one thread", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "threads", short: &[2.0], full: &[2.0, 3.0, 8.0] },
    order: None,
    tolerance: Tolerance {
        value: 0.0,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "Forces are summed in the order of the partners' numbers: exact",
    },
    kind: Kind::Verification,
    measure: threads,
};

fn threads(_: &dyn Backend, count: f64) -> Result<Sample, VerifyError> {
    let s = crowd()?;
    let on = |n: usize| -> Result<Dem, VerifyError> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build();
        let pool = pool.map_err(|e| VerifyError::Numerics { what: "thread pool", detail: e.to_string() })?;
        pool.install(|| {
            let mut d = Dem::new(&s)?;
            d.step(150)?;
            Ok(d)
        })
    };
    let (one, many) = (on(1)?, on(count as usize)?);
    let (a, b) = (one.bodies(), many.bodies());
    let differs = |i: usize| {
        let state =
            |x: &lahar::dem::Bodies| [x.position[i], x.velocity[i], x.spin[i], x.force[i], x.torque[i]];
        let bits = |x: &lahar::dem::Bodies| state(x).map(|v| [v.x, v.y, v.z].map(f64::to_bits));
        bits(a) != bits(b)
    };
    let different = (0..a.len()).filter(|&i| differs(i)).count();
    Ok(Sample::absolute(count, different as f64, 0.0)
        .with("bodies", a.len() as f64)
        .with("touching pairs at the end", one.pair_counts().1 as f64))
}
