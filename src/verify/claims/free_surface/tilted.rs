//! A pool whose surface is oblique to the grid.

use super::support::{ledger, speed, tank};
use crate::output::plot::{Axis, Plot, Series};
use crate::rheology::Law;
use crate::solver::run::Backend;
use crate::solver::setup::{BodyForce, ExcessRule, Refill, Setup, SurfaceForce};
use crate::verify::claim::{Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::verify::exhibit::{Exhibit, ExhibitData, Table};

const SIZE: usize = 24;
const GRAVITY: f64 = 1e-5;

/// √(gH), H half the box.
fn wave_speed() -> f64 {
    (GRAVITY * SIZE as f64 / 2.0).sqrt()
}

/// A closed box half full under gravity tilted by `slope` degrees, the surface level in that gravity.
fn pool(slope: f64, law: Law) -> Setup {
    let n = SIZE;
    let angle = slope * core::f64::consts::PI / 180.0;
    let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
    let middle = n as f64 / 2.0;
    let height = |x: f64| middle - (x - middle) * sine / cosine;
    // Mean over eight sub-columns: second-order cell fills of a straight surface.
    let fill = move |[i, _, k]: [usize; 3]| {
        let part = |s: usize| {
            let x = i as f64 + (s as f64 + 0.5) / 8.0;
            (height(x) - k as f64).clamp(0.0, 1.0)
        };
        (0..8).map(part).sum::<f64>() / 8.0
    };
    let mut setup = tank([n, 1, n], law, GRAVITY, fill);
    // Downwards along (−sine, −cosine): the surface is lower where x is larger.
    setup.force = BodyForce::Constant([-GRAVITY * sine, 0.0, -GRAVITY * cosine]);
    setup
}

/// Viscous enough (τ = 1.1) that the sloshing of the start is gone after 1e4 steps.
const NEWTONIAN: Law = Law::Newtonian { mu: 0.2 };

fn spurious(backend: &dyn Backend, slope: f64) -> Result<Sample, VerifyError> {
    let mut run = backend.start(&pool(slope, NEWTONIAN))?;
    run.advance(10_000)?;
    let early = speed(run.as_ref()) / wave_speed();
    run.advance(5_000)?;
    let late = speed(run.as_ref()) / wave_speed();
    let end = ledger(run.as_ref());
    Ok(Sample::absolute(slope, late, 0.0)
        .with("after 1e4 steps", early)
        .with("conversions", end.conversions as f64)
        .with("mass residual", end.mass_residual.abs()))
}

/// Spurious velocity with the defaults.
pub const POOL: Claim = Claim {
    id: "pool-tilted",
    title: "A pool whose surface is oblique to the grid comes to rest",
    tags: &["F1", "F2", "F3"],
    measures: "largest speed after 1.5e4 steps over √(gH); Newtonian, τ = 1.1, 24 × 24 cells, default rules",
    reference: Reference { source: "hydrostatics", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "tilt of gravity (degrees)",
        short: &[5.0, 16.0],
        full: &[2.0, 5.0, 10.0, 16.0, 30.0, 45.0],
    },
    order: None,
    tolerance: Tolerance { value: 1e-2, at: Rung::Every, because: "to be measured" },
    kind: Kind::Verification,
    measure: spurious,
};

/// All options.
pub const OPTIONS: Exhibit = Exhibit {
    id: "pool-tilted-options",
    caption: "Largest speed over √(gH) in a pool whose gravity is tilted by 16 degrees to the grid, for every option.",
    timed: false,
    run: options,
};

fn options(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let forces = [
        ("full", SurfaceForce::Full),
        ("by fill", SurfaceForce::ByFill),
        ("by fill and inertia", SurfaceForce::ByFillAndInertia),
    ];
    let refills = [("equilibrium", Refill::Equilibrium), ("with stress", Refill::WithStress)];
    let excesses = [("even", ExcessRule::Even), ("along normal", ExcessRule::AlongNormal)];
    let fluids: &[(&str, Law)] = &[
        ("Newtonian, tau 1.1", NEWTONIAN),
        ("Newtonian, tau 0.56", Law::Newtonian { mu: 0.02 }),
        ("Bingham", Law::Bingham { sigma0: 2e-6, mu: 0.2 }),
    ];
    let marks: &[u64] = if full { &[1_000, 10_000, 20_000, 100_000] } else { &[1_000, 5_000, 10_000] };
    let mut columns = vec!["fluid", "force in interface cells", "refill", "excess"];
    let names: Vec<String> = marks.iter().map(|m| format!("{m} steps")).collect();
    columns.extend(names.iter().map(String::as_str));
    columns.push("conversions");
    let mut table = Table::new("Largest speed over √(gH)", &columns);
    let mut plot = Plot::new(
        "Spurious velocity in a tilted pool, Newtonian, tau 1.1",
        Axis::log("steps", ""),
        Axis::log("largest speed over √(gH)", ""),
    );
    for (fluid, law) in fluids {
        for (force_name, force) in forces {
            for (refill_name, refill) in refills {
                for (excess_name, excess) in excesses {
                    let plain = refill == Refill::Equilibrium && excess == ExcessRule::Even;
                    if *law != NEWTONIAN && !plain {
                        continue;
                    }
                    let mut setup = pool(16.0, *law);
                    if let Some(surface) = &mut setup.free_surface {
                        (surface.force, surface.refill, surface.excess) = (force, refill, excess);
                    }
                    let mut run = backend.start(&setup)?;
                    let mut row =
                        vec![(*fluid).into(), force_name.into(), refill_name.into(), excess_name.into()];
                    let mut points = Vec::new();
                    for &mark in marks {
                        let entry = match run.advance(mark - run.step()) {
                            Ok(()) => {
                                let u = speed(run.as_ref()) / wave_speed();
                                points.push([mark as f64, u]);
                                u.into()
                            }
                            Err(stopped) => format!("stopped at step {}", stopped.step).into(),
                        };
                        row.push(entry);
                    }
                    row.push(ledger(run.as_ref()).conversions.into());
                    table.push(row);
                    if plain && *law == NEWTONIAN {
                        plot = plot.with(Series::line_markers(force_name, points));
                    }
                }
            }
        }
    }
    Ok(ExhibitData { tables: vec![table], plots: vec![plot], notes: Vec::new() })
}
