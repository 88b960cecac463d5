//! Unyielded blocks carried obliquely through the grid: exhibits.

use core::f64::consts::TAU;
use std::sync::Arc;

use super::support::central;
use crate::claim::VerifyError;
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::rheology::Law;
use lahar::setup::{BodyForce, FlowPoint, Setup, SolidMotion, WallRule};
use lahar::solver::run::{Backend, Fields};

const DIRECTIONS: [(&str, [f64; 3]); 4] = [
    ("(1,0,0)", [1.0, 0.0, 0.0]),
    ("(1,1,0)", [1.0, 1.0, 0.0]),
    ("(1,1,1)", [1.0, 1.0, 1.0]),
    ("(1,0.5,0.25)", [1.0, 0.5, 0.25]),
];

fn unit(direction: [f64; 3]) -> [f64; 3] {
    let length = (direction.iter().map(|d| d * d).sum::<f64>()).sqrt();
    direction.map(|d| d / length)
}

/// A decaying three-dimensional shear flow in a yield-stress fluid that is carried along.
pub const ARREST: Exhibit = Exhibit {
    id: "arrest-of-a-carried-block",
    caption: "A three-dimensional shear flow (ABC) in a periodic box of Bingham fluid decays and arrests while \
              the whole is carried along at U: what moves relative to the mean afterwards, over the first amplitude.",
    timed: false,
    run: arrest,
};

/// Root mean square of u − U.
fn agitation(fields: &Fields, mean: [f64; 3]) -> f64 {
    let square = |u: &[f64; 3]| (0..3).map(|a| (u[a] - mean[a]) * (u[a] - mean[a])).sum::<f64>();
    (fields.velocity.iter().map(square).sum::<f64>() / fields.velocity.len() as f64).sqrt()
}

fn carried(backend: &dyn Backend, mean: [f64; 3], floor: f64) -> Result<[f64; 3], VerifyError> {
    let (n, amplitude, nu) = (12, 5e-3, 0.05);
    let k = TAU / 12.0;
    // As large as the viscous stress at the start: Bingham number 1.
    let sigma0 = nu * amplitude * k;
    let mut setup = Setup::periodic([n; 3], Law::Bingham { sigma0, mu: nu });
    setup.collision = central(floor);
    setup.initial = Some(Arc::new(move |at| {
        let [x, y, z] = at.map(|i| k * (i as f64 + 0.5));
        let a = amplitude / 3.0_f64.sqrt();
        let (sx, cx) = (libm::sin(x), libm::cos(x));
        let (sy, cy) = (libm::sin(y), libm::cos(y));
        let (sz, cz) = (libm::sin(z), libm::cos(z));
        let u = [a * (sz + cy), a * (sx + cz), a * (sy + cx)];
        let g = a * k;
        FlowPoint {
            density: 1.0,
            velocity: std::array::from_fn(|i| mean[i] + u[i]),
            gradient: [[0.0, -g * sy, g * cz], [g * cx, 0.0, -g * sz], [-g * sx, g * cy, 0.0]],
        }
    }));
    let mut run = backend.start(&setup)?;
    let mut seen = [0.0; 3];
    for (slot, steps) in seen.iter_mut().zip([100, 900, 1000]) {
        run.advance(steps)?;
        *slot = agitation(&run.fields(), mean) / amplitude;
    }
    Ok(seen)
}

fn arrest(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let mut table = Table::new(
        "Root mean square of u - U over the first amplitude (12^3 cells, Bingham number 1)",
        &["direction", "U", "theta", "after 100 steps", "after 1000", "after 2000"],
    );
    let mut row = |name: &str, direction: [f64; 3], speed: f64, floor: f64| -> Result<(), VerifyError> {
        let seen = carried(backend, unit(direction).map(|d| d * speed), floor)?;
        let numbers = [speed, floor, seen[0], seen[1], seen[2]];
        table.push(std::iter::once(name.into()).chain(numbers.map(Into::into)).collect());
        Ok(())
    };
    row("-", [1.0, 0.0, 0.0], 0.0, 0.05)?;
    if full {
        for (name, direction) in DIRECTIONS {
            for speed in [0.02, 0.05, 0.1] {
                row(name, direction, speed, 0.05)?;
            }
        }
        for floor in [0.1, 0.2, 0.5] {
            row("(1,0,0)", [1.0, 0.0, 0.0], 0.1, floor)?;
        }
    } else {
        row("(1,1,1)", [1.0; 3], 0.05, 0.05)?;
    }
    Ok(ExhibitData { tables: vec![table], ..ExhibitData::default() })
}

/// Plug flow between staircase walls along the lattice diagonal.
pub const STAIRCASE: Exhibit = Exhibit {
    id: "plug-between-staircase-walls",
    caption: "Plug flow in a channel along (1,1,0) whose walls are staircases of solid cells: velocity spread \
              inside the middle half of the plug, for flow in the plane, along z, and along (1,1,1).",
    timed: false,
    run: staircase,
};

/// Spread of u over the middle of the plug, over the largest speed; and that speed.
fn between_stairs(backend: &dyn Backend, direction: [f64; 3], speed: f64) -> Result<[f64; 2], VerifyError> {
    let (wide, solid) = (16_usize, 3_usize);
    let m = wide + solid;
    let nu = 0.1;
    // Distance between the walls, across the channel; the plug takes half of it.
    let h = 0.5 * wide as f64 / 2.0_f64.sqrt();
    let force = 8.0 * nu * speed / (h * h);
    let along = unit(direction);
    let mut setup = Setup::periodic([m, m, 1], Law::Bingham { sigma0: 0.5 * force * h, mu: nu });
    setup.wall_rule = WallRule::ViscosityIndependent;
    setup.solid_motion = vec![SolidMotion::default()];
    setup.solids = (0..m * m).map(|cell| u8::from((cell % m + m - cell / m) % m >= wide)).collect();
    setup.force = BodyForce::Constant(along.map(|d| d * force));
    let mut run = backend.start(&setup)?;
    run.advance((4.0 * h / speed + 3.0 * h * h / nu) as u64)?;
    let fields = run.fields();
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    for cell in 0..m * m {
        let offset = ((cell % m + m - cell / m) % m) as f64 + 0.5 - 0.5 * wide as f64;
        if !setup.is_solid(cell) && offset.abs() < 0.125 * wide as f64 {
            let u = fields.velocity[cell];
            let speed = (u[0] * along[0] + u[1] * along[1]) + u[2] * along[2];
            least = least.min(speed);
            most = most.max(speed);
        }
    }
    Ok([(most - least) / most, most])
}

fn staircase(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let speeds: &[f64] = if full { &[0.005, 0.01, 0.02, 0.04] } else { &[0.02] };
    let mut table = Table::new(
        "Plug between staircase walls along (1,1,0), 11.3 cells apart",
        &["flow along", "U wanted", "largest u", "spread / u", "Ma2/Re"],
    );
    for (name, direction) in
        [("(1,1,0)", [1.0, 1.0, 0.0]), ("(0,0,1)", [0.0, 0.0, 1.0]), ("(1,1,1)", [1.0; 3])]
    {
        for &speed in speeds {
            let [spread, most] = between_stairs(backend, direction, speed)?;
            let reynolds = most * 5.657 / 0.1;
            let row = [speed, most, spread, 3.0 * most * most / reynolds];
            table.push(std::iter::once(name.into()).chain(row.map(Into::into)).collect());
        }
    }
    Ok(ExhibitData { tables: vec![table], ..ExhibitData::default() })
}
