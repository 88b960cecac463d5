//! Films just below and just above the critical thickness (H19), thesis fluid on 16°.

use super::support::{SLOPE, Sheet, flow};
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::exact::film::Film;
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::collision::{CollisionChoice, OddRate};
use lahar::output::plot::{Axis, Plot, Series};
use lahar::rheology::Law;
use lahar::setup::YieldTreatment;
use lahar::solver::run::{Backend, Run};
use lahar::units::Units;

const RHO: f64 = 997.45;
const G: f64 = 9.81;
const SIGMA0: f64 = 58.0;
const K: f64 = 35.0;
const N: f64 = 0.33;

/// The film in SI units.
fn film(share: f64) -> Film<Law> {
    let law = Law::HerschelBulkley { sigma0: SIGMA0, k: K, n: N };
    let critical = SIGMA0 / (RHO * G * libm::sin(SLOPE));
    Film { law, thickness: share * critical, density: RHO, gravity: G, slope: SLOPE }
}

/// The film on `cells` cells, Δt from 3 g H Δt²/Δx² = 0.02, and its units.
fn sheet(film: &Film<Law>, cells: f64) -> (Sheet, Units) {
    let dx = film.thickness / cells;
    let dt = dx * (0.02 / (3.0 * G * film.thickness)).sqrt();
    let units = Units::new(dx, dt, RHO);
    let law = Law::HerschelBulkley {
        sigma0: units.stress_to_lattice(SIGMA0),
        k: units.consistency_to_lattice(K, N),
        n: N,
    };
    (Sheet::new(law, cells, units.force_to_lattice(RHO * G)), units)
}

/// Surface velocity in m/s after `steps`.
fn surface(backend: &dyn Backend, sheet: &Sheet, units: &Units, steps: u64) -> Result<f64, VerifyError> {
    let mut run = backend.start(&sheet.setup())?;
    run.advance(steps)?;
    Ok(flow(run.as_ref()).velocity.last().map_or(f64::NAN, |u| units.velocity_to_si(*u)))
}

fn rest(backend: &dyn Backend, cells: f64) -> Result<Sample, VerifyError> {
    let film = film(0.98);
    let (sheet, units) = sheet(&film, cells);
    let u = surface(backend, &sheet, &units, (400.0 * cells * cells) as u64)?;
    let creep = film.force() * film.thickness * film.thickness / (2.0 * 150.0);
    Ok(Sample::absolute(cells, u / creep, 0.0).with("surface velocity [m/s]", u))
}

/// 0.98 h_c rests.
pub const REST: Claim = Claim {
    id: "film-below-critical-rests",
    title: "A film of 0.98 critical thicknesses rests",
    tags: &["Y3", "F3", "B3"],
    measures: "surface velocity after 400 H² steps, over what a clamp at 150 Pa s would leave, rho g sin h²/(2 mu_max)",
    reference: Reference { source: "h_c = sigma0/(rho g sin theta), REFERENCES §3", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "cells", short: &[8.0, 16.0], full: &[8.0, 16.0, 32.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-3,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "ringing decays as exp(−theta k² t/3), k = pi/(2H): to 1e-7 of its start in 400 H² steps",
    },
    kind: Kind::Verification,
    measure: rest,
};

fn creep(backend: &dyn Backend, mu_max: f64) -> Result<Sample, VerifyError> {
    let film = film(0.98);
    let (mut sheet, units) = sheet(&film, 16.0);
    let tau = |mu: f64| 0.5 + 3.0 * units.viscosity_to_lattice(mu);
    sheet.yielding = YieldTreatment::ImplicitClamped { tau_min: tau(mu_max / 1000.0), tau_max: tau(mu_max) };
    let u = surface(backend, &sheet, &units, 20_000)?;
    let exact = film.force() * film.thickness * film.thickness / (2.0 * mu_max);
    Ok(Sample::relative(mu_max, u, exact).with("creep in 60 s [mm]", 60.0e3 * u))
}

/// The creep that a clamp leaves.
pub const CREEP: Claim = Claim {
    id: "film-below-critical-creeps-with-a-clamp",
    title: "With a viscosity clamp the same film creeps at rho g sin(theta) h²/(2 mu_max): half for twice the clamp",
    tags: &["Y4", "Y5", "F3"],
    measures: "surface velocity of a film of 0.98 critical thicknesses on 16 cells",
    reference: Reference { source: "Newtonian film of viscosity mu_max", uncertainty: 0.0 },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "mu_max (Pa s)", short: &[150.0, 300.0], full: &[75.0, 150.0, 300.0, 600.0] },
    order: None,
    tolerance: Tolerance {
        value: 0.02,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "the density is larger by up to 3 g H cos(theta) = 1.9 % at the bed, and with it the viscosity",
    },
    kind: Kind::PredictedFailure,
    measure: creep,
};

/// Damping of the ringing for films whose velocity is a millionth of what the sudden load sets off.
const FLOOR: f64 = 0.5;

/// u_s over the exact one for a film of `share` critical thicknesses, and its drift over the last tenth of
/// the 60 H² steps.
fn near_critical(backend: &dyn Backend, share: f64, cells: f64) -> Result<(f64, f64), VerifyError> {
    let film = film(share);
    let (sheet, units) = sheet(&film, cells);
    let mut setup = sheet.setup();
    setup.collision = CollisionChoice::CentralMoment(OddRate { floor: FLOOR, ..OddRate::default() });
    let mut run = backend.start(&setup)?;
    let steps = 60.0 * cells * cells;
    let surface = |run: &dyn Run| {
        flow(run).velocity.last().map_or(f64::NAN, |u| units.velocity_to_si(*u)) / film.surface_velocity()
    };
    run.advance((0.9 * steps) as u64)?;
    let before = surface(run.as_ref());
    run.advance(steps as u64 - run.step())?;
    let after = surface(run.as_ref());
    Ok((after, after / before - 1.0))
}

/// Cells over a film of `share` critical thicknesses whose sheared layer has `layer` cells.
fn cells_for(share: f64, layer: f64) -> f64 {
    (layer * share / (share - 1.0)).round()
}

fn flowing(backend: &dyn Backend, layer: f64) -> Result<Sample, VerifyError> {
    let cells = cells_for(1.1, layer);
    let (ratio, drift) = near_critical(backend, 1.1, cells)?;
    Ok(Sample::relative(layer, ratio, 1.0).with("cells over the depth", cells).with("drift", drift))
}

/// 1.1 h_c flows.
pub const FLOWS: Claim = Claim {
    id: "film-above-critical-flows",
    title: "A film of 1.1 critical thicknesses flows at its exact velocity once four cells lie in the sheared layer",
    tags: &["Y3", "F3", "B3"],
    measures: "surface velocity over the exact one, theta = 0.5",
    reference: Reference { source: "u_s = (rho g sin/K)^(1/n) Y^N/N, REFERENCES §3", uncertainty: 0.0 },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "sheared layer (cells)", short: &[2.0, 4.0], full: &[1.0, 2.0, 4.0, 8.0] },
    order: None,
    tolerance: Tolerance { value: 0.05, at: Rung::Last, basis: Basis::Reference, because: "HARD_CASES H19" },
    kind: Kind::Verification,
    measure: flowing,
};

/// Velocity against the resolution of the sheared layer.
pub const NEAR_CRITICAL: Exhibit = Exhibit {
    id: "film-near-critical",
    caption: "Surface velocity over the exact one for films just above the critical thickness, against the number of \
              cells in the sheared layer. u_s goes with the fourth power of that layer's thickness. At 1.02 critical \
              thicknesses it is 2 % of the depth: with 32 cells the whole shear lies below the first cell centre.",
    timed: false,
    run: near_critical_table,
};

fn near_critical_table(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let films: &[(f64, &[f64])] = if full {
        &[(1.02, &[0.5, 1.0, 2.0]), (1.1, &[1.0, 2.0, 4.0, 8.0]), (1.4, &[1.0, 2.0, 4.0, 8.0, 16.0])]
    } else {
        &[(1.02, &[0.5]), (1.1, &[1.0, 2.0, 4.0]), (1.4, &[1.0, 2.0, 4.0, 8.0])]
    };
    let mut table = Table::new(
        "Films just above the critical thickness",
        &[
            "h/h_c",
            "cells",
            "sheared layer (cells)",
            "exact u_s [m/s]",
            "u_s/exact",
            "drift in the last tenth",
        ],
    );
    let mut plot = Plot::new(
        "Films near the critical thickness",
        Axis::log("sheared layer", "cells"),
        Axis::log("error of the surface velocity", ""),
    );
    for (share, layers) in films {
        let mut points = Vec::new();
        for &layer in *layers {
            let cells = cells_for(*share, layer);
            let (ratio, drift) = near_critical(backend, *share, cells)?;
            let film = film(*share);
            let own = film.sheared_thickness() / film.thickness * cells;
            points.push([own, (ratio - 1.0).abs()]);
            table.push(vec![
                (*share).into(),
                (cells as usize).into(),
                own.into(),
                film.surface_velocity().into(),
                ratio.into(),
                drift.into(),
            ]);
        }
        plot = plot.with(Series::line_markers(format!("{share} critical thicknesses"), points));
    }
    Ok(ExhibitData { tables: vec![table], plots: vec![plot], notes: Vec::new() })
}
