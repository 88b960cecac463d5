//! The warnings of a plan for a scene with fluid.

use super::figures::{Basis, SHALLOW};
use super::holding::holding;
use super::numbers::Numbers;
use super::time_step::{COMPRESSION_MAX, compression};
use super::wall_error::{ERROR_MAX, FEW_CELLS, PUSH_MAX, THIN_LAYER};
use super::warning::Warning;
use crate::rheology::Law;
use crate::scene::InitialPressure;
use crate::setup::{Precision, YieldTreatment};

/// Excess mass worth a warning: 0.4 % of the volume moves the front of a long thin flow by as much.
const LEAST_EXCESS: f64 = 4e-3;

/// Difference of the volume in the cells from that drawn that is worth a warning: it moves a front by as much.
const OTHER_VOLUME: f64 = 1e-2;

/// All of them, in the order in which they are printed.
pub(super) fn warnings(n: &Numbers, basis: &Basis) -> Vec<Warning> {
    let mut all = of_the_flow(n);
    all.extend(of_the_law(basis));
    all.extend(of_the_walls(n));
    all.extend(of_the_scheme(n, basis));
    all.extend(of_the_surface(n));
    all.extend(of_the_weight(basis));
    all.extend(of_the_step(basis));
    all
}

fn of_the_flow(n: &Numbers) -> Vec<Warning> {
    let tau = n.tau_plastic;
    holding([
        (n.mach > 0.174, Warning::Mach { mach: n.mach }),
        ((0.52..0.55).contains(&tau), Warning::TauSmall { tau, spacing_m: n.spacing_m }),
        // τ − ½ ∝ Δt/Δx², and Δt ∝ Δx at a given number of cells per step.
        (tau < 0.52, Warning::TauTiny { tau, spacing_needed_m: n.spacing_m * (tau - 0.5) / 0.02 }),
        (tau > 2.0, Warning::TauLarge { tau }),
        (n.gap_cells < FEW_CELLS && n.depth_cells.is_none(), Warning::FewCells { cells: n.gap_cells }),
        (n.stability_margin.is_some_and(|margin| margin < 2.0), Warning::NearlyUnstable),
    ])
}

/// A fluid without yield stress that thickens.
fn of_the_law(basis: &Basis) -> Option<Warning> {
    let index = |law: &Law| match *law {
        Law::PowerLaw { n, .. } if n > 1.0 => Some(n),
        Law::HerschelBulkley { n, sigma0: 0.0, .. } if n > 1.0 => Some(n),
        _ => None,
    };
    let indices = basis.facts.laws.iter().filter_map(index);
    let exact = basis.setup.yielding == YieldTreatment::Exact;
    indices.reduce(f64::max).filter(|_| exact).map(|flow_index| Warning::Thickens { flow_index })
}

fn of_the_walls(n: &Numbers) -> Vec<Warning> {
    let push = n.push_per_step.unwrap_or(0.0);
    let time_step_s = n.time_step_s * PUSH_MAX / push;
    let mut all = holding([(push > PUSH_MAX && push.is_finite(), Warning::Pushed { push, time_step_s })]);
    all.extend(n.wall_error.filter(|e| e.error > ERROR_MAX).map(|expected| Warning::WallError { expected }));
    let sheared = n.wall_error.map(|expected| expected.layer.sheared);
    all.extend(sheared.filter(|&cells| cells < THIN_LAYER).map(|cells| Warning::ThinLayer { cells }));
    all
}

fn of_the_scheme(n: &Numbers, basis: &Basis) -> Vec<Warning> {
    let slip = n.plug_slip_m_per_s;
    let slips = slip > 1e-3 * n.reference_velocity_m_per_s && slip.is_finite();
    let moves_on =
        basis.facts.any_plug() && basis.setup.yielding == YieldTreatment::Exact && !n.operator.stops_plugs();
    let residual_m_per_s = n.residual.filter(|left| left.oblique).map_or(0.0, |left| left.speed_m_per_s);
    let stays = residual_m_per_s > 1e-2 * n.reference_velocity_m_per_s;
    let rounds = basis.setup.precision != Precision::Double && n.rounding_floor > 1e-3;
    holding([
        (slips, Warning::PlugSlips { slip_m_per_s: slip }),
        (stays, Warning::StaysInMotion { speed_m_per_s: residual_m_per_s }),
        (moves_on, Warning::PlugMovesOn { operator: n.operator }),
        (rounds, Warning::Rounding { precision: n.precision, share: n.rounding_floor }),
        (n.reference_velocity_m_per_s == 0.0, Warning::NothingMoves),
    ])
}

fn of_the_surface(n: &Numbers) -> Vec<Warning> {
    let Some(depth) = n.depth_cells else { return Vec::new() };
    let at_rest = n.arrest_thickness_m.map_or(f64::INFINITY, |thickness| thickness / n.spacing_m);
    let (volume_m3, drawn_m3) = (n.volume_m3.unwrap_or(0.0), n.drawn_m3.unwrap_or(0.0));
    holding([
        (
            (volume_m3 - drawn_m3).abs() > OTHER_VOLUME * drawn_m3,
            Warning::OtherVolume { what: "fluid".to_owned(), volume_m3, drawn_m3 },
        ),
        (depth < SHALLOW, Warning::Shallow { cells: depth }),
        (at_rest < 4.0, Warning::ThinDeposit { cells: at_rest }),
    ])
}

/// By how much the fluid is heavier than drawn, where it will flow away.
fn of_the_weight(basis: &Basis) -> Option<Warning> {
    let pool = basis.pool.filter(|pool| !pool.level)?;
    let initial = basis.facts.scene.fluid.initial.as_ref();
    let hydrostatic = initial.is_some_and(|initial| initial.pressure == InitialPressure::Hydrostatic);
    let weight = basis.facts.forces.extremes[0][pool.up.index()].abs();
    let share = 1.5 * basis.units.force_to_lattice(weight) * basis.units.length_to_lattice(pool.depth);
    (hydrostatic && share > LEAST_EXCESS).then_some(Warning::Compressed { share })
}

/// A step with which the fluid is compressed by its weight \[F7\].
fn of_the_step(basis: &Basis) -> Option<Warning> {
    let [share, time_step_s] = compression(basis.facts, basis.pool.as_ref(), basis.units.dt_s);
    (share > COMPRESSION_MAX).then_some(Warning::CompressedByStep { share, time_step_s })
}
