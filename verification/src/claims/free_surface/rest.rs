//! Bodies of mud that their yield stress holds.

use super::support::{ledger, speed};
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use lahar::collision::{CollisionChoice, OddRate};
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Face, FreeSurface, Setup};
use lahar::solver::run::{Backend, Run};

/// 3 f H of the body, by which it is denser at its foot: what `plan` aims for.
const COMPRESSION: f64 = 0.02;
/// Kinematic viscosity, plastic τ = 0.9.
const VISCOSITY: f64 = 0.4 / 3.0;
/// Steps over H² that stress and shape get to settle in: waves die out, and creep with them, over times as for diffusion.
const SETTLING: f64 = 200.0;
/// Steps over H² in which creep is measured.
const MEASURED: f64 = 100.0;

/// A body on a floor, of one size in cells.
struct Body {
    name: &'static str,
    /// Yield stress over F times the size.
    strength: f64,
    /// Angle of the force from the normal of the floor, degrees.
    slope_deg: f64,
    /// Size of the box over that of the body.
    room: [f64; 2],
    /// Whether a point is inside; lengths over the size.
    holds: fn(f64, f64) -> bool,
}

/// A block three times as long as high, half a circle, and a layer that hangs on a wall (x is the way down, z away from it).
const BODIES: [Body; 3] = [
    Body {
        name: "block",
        strength: 0.85,
        slope_deg: 20.0,
        room: [5.0, 1.5],
        holds: |x, z| (1.0..=4.0).contains(&x) && z <= 1.0,
    },
    Body {
        name: "dome",
        strength: 0.7,
        slope_deg: 11.0,
        room: [5.0, 1.5],
        holds: |x, z| (x - 2.5) * (x - 2.5) / 4.0 + z * z <= 1.0,
    },
    Body {
        name: "layer",
        strength: 1.3,
        slope_deg: 90.0,
        room: [6.0, 1.5],
        holds: |x, z| (1.0..=5.0).contains(&x) && z <= 1.0,
    },
];

fn setup(body: &Body, cells: f64) -> Setup {
    let extents = [(body.room[0] * cells).round() as usize, 1, (body.room[1] * cells).round() as usize];
    let force = COMPRESSION / (3.0 * cells);
    let law = Law::Bingham { sigma0: body.strength * force * cells, mu: VISCOSITY };
    let mut setup = Setup::periodic(extents, law);
    setup.faces = [[Face::Open; 2], [Face::Periodic; 2], [Face::NoSlip, Face::Open]];
    let slope = body.slope_deg.to_radians();
    setup.force = BodyForce::Constant([force * libm::sin(slope), 0.0, -force * libm::cos(slope)]);
    let fill = |cell: usize| {
        let [i, _, k] = setup.coordinates(cell);
        let part = |s: i32| (f64::from(s) + 0.5) / 16.0;
        let inside =
            |s: i32| (body.holds)((i as f64 + part(s / 16)) / cells, (k as f64 + part(s % 16)) / cells);
        f64::from((0..256).map(|s| i32::from(inside(s))).sum::<i32>()) / 256.0
    };
    let fills = (0..setup.cells()).map(fill).collect();
    setup.free_surface = Some(FreeSurface::new(fills));
    // As `plan` chooses it.
    let calm = Some(OddRate::STANDARD.calm_speed(force));
    setup.collision = CollisionChoice::CentralMoment(OddRate { calm, ..OddRate::STANDARD });
    setup
}

/// Mean position of the mass, cells.
fn centre(run: &dyn Run) -> [f64; 2] {
    let (fields, setup) = (run.fields(), run.setup());
    let (mut mass, mut sum) = (0.0, [0.0; 2]);
    for (cell, (fill, density)) in fields.fill.iter().zip(&fields.density).enumerate() {
        let [i, _, k] = setup.coordinates(cell);
        let own = fill * density;
        mass += own;
        sum = [sum[0] + own * (i as f64 + 0.5), sum[1] + own * (k as f64 + 0.5)];
    }
    sum.map(|s| s / mass)
}

/// How far the mass of a body moves after it has settled, cells, and the sample with what else is known.
fn creep(
    backend: &dyn Backend,
    body: &Body,
    cells: f64,
    sample: Sample,
) -> Result<(f64, Sample), VerifyError> {
    let mut run = backend.start(&setup(body, cells))?;
    run.advance((SETTLING * cells * cells) as u64)?;
    let (from, converted) = (centre(run.as_ref()), ledger(run.as_ref()).conversions);
    run.advance((MEASURED * cells * cells) as u64)?;
    let to = centre(run.as_ref());
    let moved = libm::hypot(to[0] - from[0], to[1] - from[1]);
    let conversions = ledger(run.as_ref()).conversions - converted;
    let sample = sample
        .with(&format!("creep of the {}", body.name), moved)
        .with(&format!("conversions of the {}", body.name), conversions as f64)
        .with(&format!("largest speed in the {} [cells per step]", body.name), speed(run.as_ref()));
    Ok((moved, sample))
}

/// Rest of bodies below their yield stress.
pub const REST: Claim = Claim {
    id: "rest-below-yield",
    title: "What a yield stress holds stays where it is",
    tags: &["K3", "Y3"],
    measures: "how far the mass of a block on 20°, half a circle on 11° and a layer on a vertical wall moves in 100 H² steps after \
               200 H² steps to settle in, cells; the largest of the three",
    reference: Reference {
        source: "equilibrium: a stress field below the yield stress holds each body (slip circles and ρ g h on the wall)",
        uncertainty: 0.0,
    },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "height (cells)", short: &[6.0], full: &[6.0, 10.0, 20.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-2,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "a hundredth of a cell is what a front may creep in a run; that it takes 200 H² steps until no more is left was \
                  seen: 0.012 and 0.12 cells at 10 and 20 cells after 6000 steps",
    },
    kind: Kind::Verification,
    measure: |backend, cells| {
        let mut sample = Sample::absolute(cells, 0.0, 0.0);
        let mut largest = 0.0_f64;
        for body in &BODIES {
            let (moved, with) = creep(backend, body, cells, sample)?;
            sample = with;
            largest = if moved <= largest { largest } else { moved };
        }
        Ok(Sample { extra: sample.extra, ..Sample::absolute(cells, largest, 0.0) })
    },
};
