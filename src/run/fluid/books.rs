//! A fluid at the end of a run, in numbers.

use crate::plan::Plan;
use crate::run::measure::fields::is_fluid;
use crate::run::summary::{CoupledPart, Extrema, FluidPart, SurfaceSummary};
use crate::solver::run::{Fields, Ledger, Run};

/// The fluid, and its grains if there are any; `mass_at_start`: mass excess at time 0, lattice units.
pub(super) fn part(
    plan: &Plan,
    run: &dyn Run,
    fields: &Fields,
    mass_at_start: f64,
    grains: Option<CoupledPart>,
) -> FluidPart {
    let fluid = |c: &usize| is_fluid(&plan.setup, fields, *c);
    let cells = 0..plan.setup.cells();
    let speed = |c: usize| {
        let [x, y, z] = plan.units.velocities_to_si(fields.velocity[c]);
        (x * x + y * y + z * z).sqrt()
    };
    let change = (run.totals().mass_excess - mass_at_start) / run.fluid_cells().max(1) as f64;
    let ledger = run.ledger();
    FluidPart {
        mass_residual: ledger.map_or(change, |ledger| ledger.mass_residual),
        density: Extrema::of(cells.clone().filter(fluid).map(|c| fields.density[c])),
        speed_m_per_s: Extrema::of(cells.filter(fluid).map(speed)),
        fingerprint: run.fingerprint(),
        free_surface: ledger.map(|ledger| surface_summary(plan, &ledger)),
        grains,
    }
}

fn surface_summary(plan: &Plan, ledger: &Ledger) -> SurfaceSummary {
    let units = &plan.units;
    let mass = units.rho0_kg_per_m3 * units.dx_m * units.dx_m * units.dx_m;
    let momentum = mass * units.velocity_unit();
    let vector = |v: [f64; 3]| v.map(|component| component * momentum);
    SurfaceSummary {
        initial_mass_kg: ledger.initial_mass * mass,
        mass_kg: ledger.mass * mass,
        outflow_kg: ledger.outflow * mass,
        from_walls_kg: ledger.from_walls * mass,
        parked_kg: ledger.parked * mass,
        voids_m3: ledger.voids * (units.dx_m * units.dx_m * units.dx_m),
        mass_residual: ledger.mass_residual,
        momentum_n_s: vector(ledger.momentum),
        from_force_n_s: vector(ledger.from_force),
        from_faces_n_s: vector(ledger.from_faces),
        from_solids_n_s: vector(ledger.from_solids),
        from_gas_n_s: vector(ledger.from_gas),
        from_grains_n_s: vector(ledger.from_grains),
        from_grains_kg: ledger.mass_from_grains * mass,
        from_conversions_n_s: vector(ledger.from_conversions),
        momentum_residual_n_s: ledger.momentum_residual * momentum,
        liquid_cells: ledger.liquid_cells,
        interface_cells: ledger.interface_cells,
        conversions: ledger.conversions,
    }
}
