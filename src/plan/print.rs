//! The table of `lahar plan`.

use std::fmt;

use super::cost::ON_WHAT;
use super::disk::total;
use super::expected;
use super::numbers::Numbers;
use super::oblique::Residual;
use super::text::{human, passes, relaxation, row, short, warnings};

/// Writes the table.
pub(super) fn table(f: &mut fmt::Formatter<'_>, n: &Numbers) -> fmt::Result {
    writeln!(f, "{}", n.title)?;
    box_of_cells(f, n)?;
    time(f, n)?;
    flow(f, n)?;
    scheme(f, n)?;
    expected::section(f, &n.expected)?;
    if let Some(grains) = &n.grains {
        super::coupled::table(f, grains)?;
    }
    memory(f, n)?;
    files(f, n)?;
    passes(f, &n.passes)?;
    cost(f, n)?;
    warnings(f, &n.warnings)
}

fn box_of_cells(f: &mut fmt::Formatter<'_>, n: &Numbers) -> fmt::Result {
    let [nx, ny, nz] = n.extents;
    writeln!(f, "\nBox")?;
    let gas = n.gas_cells.map_or_else(String::new, |gas| format!(", {gas} air"));
    row(
        f,
        "cells",
        format_args!("{nx} × {ny} × {nz}: {} fluid, {} solid{gas}", n.fluid_cells, n.solid_cells),
    )?;
    row(f, "spacing", format_args!("{} m", short(n.spacing_m)))?;
    if let (Some(depth), Some(volume)) = (n.depth_cells, n.volume_m3) {
        let metres = short(depth * n.spacing_m);
        row(
            f,
            "fluid at time 0",
            format_args!("{} m³, {metres} m deep, {} cells", short(volume), short(depth)),
        )?;
        if let Some(drawn) = n.drawn_m3 {
            let percent = 100.0 * (volume / drawn - 1.0);
            // No −0.00.
            let percent = if percent.abs() < 5e-3 { 0.0 } else { percent };
            row(f, "drawn", format_args!("{} m³; the cells hold {percent:+.2} %", short(drawn)))?;
        }
    } else if n.gap_cells.is_finite() {
        row(f, "widest gap", format_args!("{} cells between walls", n.gap_cells))?;
    } else {
        row(f, "widest gap", format_args!("no walls"))?;
    }
    Ok(())
}

fn time(f: &mut fmt::Formatter<'_>, n: &Numbers) -> fmt::Result {
    writeln!(f, "\nTime")?;
    row(f, "time step", format_args!("{} s", short(n.time_step_s)))?;
    row(f, "", format_args!("{}", n.time_step_rule.sentence()))?;
    row(f, "steps", format_args!("{} to {} s", n.steps, short(n.end_time_s)))
}

fn flow(f: &mut fmt::Formatter<'_>, n: &Numbers) -> fmt::Result {
    writeln!(f, "\nFlow")?;
    row(
        f,
        "velocity scale",
        format_args!(
            "{} m/s, {} cells per step",
            short(n.reference_velocity_m_per_s),
            short(n.speed_lattice)
        ),
    )?;
    row(f, "length scale", format_args!("{} m", short(n.reference_length_m)))?;
    row(f, "Reynolds", format_args!("{}", short(n.reynolds)))?;
    row(f, "Bingham", format_args!("{}", short(n.bingham)))?;
    row(f, "Mach", format_args!("{}", short(n.mach)))?;
    if let Some(thickness) = n.arrest_thickness_m {
        let cells = short(thickness / n.spacing_m);
        row(
            f,
            "arrest thickness",
            format_args!("{} m, {cells} cells: σ0/(f along the bed)", short(thickness)),
        )?;
    }
    rest(f, n)
}

/// What does not come to rest.
fn rest(f: &mut fmt::Formatter<'_>, n: &Numbers) -> fmt::Result {
    let Some(Residual { speed_m_per_s: speed, oblique }) = n.residual else { return Ok(()) };
    let what = "motion left at rest";
    if speed == 0.0 {
        return row(
            f,
            what,
            format_args!("none but for single cells that creep: the yield stress holds it [F2]"),
        );
    }
    let place = if oblique {
        "where the surface is oblique to the grid [F2]"
    } else {
        "if the level is that of a face between cells [F4]"
    };
    row(f, what, format_args!("up to {} m/s {place}", short(speed)))
}

fn scheme(f: &mut fmt::Formatter<'_>, n: &Numbers) -> fmt::Result {
    writeln!(f, "\nScheme")?;
    row(f, "collision", format_args!("{}", n.operator))?;
    row(f, "plastic τ", format_args!("{}", relaxation(n.tau_plastic)))?;
    row(f, "τ range", format_args!("{} to {}", relaxation(n.tau_min), tau(n.tau_max)))?;
    stability(f, n)?;
    slip(f, n)?;
    if let Some(expected) = &n.wall_error {
        row(f, "error of walls", format_args!("{expected}"))?;
    }
    row(
        f,
        "populations",
        format_args!(
            "{}, {} bytes each; rounding: at most {} of the velocity",
            n.precision,
            n.population_bytes,
            short(n.rounding_floor)
        ),
    )
}

fn memory(f: &mut fmt::Formatter<'_>, n: &Numbers) -> fmt::Result {
    writeln!(f, "\nMemory")?;
    for item in &n.memory {
        row(f, item.what, format_args!("{} bytes per cell", short(item.bytes_per_cell)))?;
    }
    let mib = |bytes: u64| short(bytes as f64 / 1048576.0);
    row(f, "total", format_args!("{} bytes per cell, {} MiB", short(n.bytes_per_cell), mib(n.bytes)))?;
    if let Some(most) = n.bytes_at_most {
        row(f, "at most", format_args!("{} MiB, once the fluid has reached every open cell", mib(most)))?;
    }
    Ok(())
}

fn files(f: &mut fmt::Formatter<'_>, n: &Numbers) -> fmt::Result {
    writeln!(f, "\nFiles")?;
    for files in &n.files {
        let plural = if files.files == 1 { "" } else { "s" };
        row(f, files.what, format_args!("{} file{plural}, about {}", files.files, human(files.bytes)))?;
    }
    let (bytes, count) = total(&n.files);
    row(f, "total", format_args!("{count} files, about {}, besides plots", human(bytes)))
}

fn cost(f: &mut fmt::Formatter<'_>, n: &Numbers) -> fmt::Result {
    writeln!(f, "\nCost")?;
    row(f, "cell updates", format_args!("{}", short(n.cell_updates)))?;
    let passed = &n.passed;
    row(
        f,
        "a step passes",
        format_args!(
            "{} cells with fluid: {} at the surface, {} at walls, {} at cut links",
            short(passed.fluid_cells),
            short(passed.interface_cells),
            short(passed.wall_cells),
            short(passed.cut_cells)
        ),
    )?;
    row(f, "rough time", format_args!("{} s {ON_WHAT}", short(n.estimated_seconds)))
}

fn stability(f: &mut fmt::Formatter<'_>, n: &Numbers) -> fmt::Result {
    match (n.stable_speed, n.stability_margin) {
        (Some(limit), Some(margin)) => row(
            f,
            "stability",
            format_args!(
                "stable up to {} cells per step: {} times the expected speed",
                short(limit),
                short(margin)
            ),
        ),
        (Some(limit), None) => {
            row(f, "stability", format_args!("stable up to {} cells per step", short(limit)))
        }
        (None, _) => {
            row(f, "stability", format_args!("none by linear theory at τ = ½, the viscosity at rest"))
        }
    }
}

fn slip(f: &mut fmt::Formatter<'_>, n: &Numbers) -> fmt::Result {
    if n.plug_slip_m_per_s.is_infinite() {
        return row(f, "slip of a plug held by walls", format_args!("unbounded: one relaxation rate"));
    }
    if n.plug_slip_m_per_s == 0.0 {
        return row(f, "slip of a plug held by walls", format_args!("none"));
    }
    row(
        f,
        "slip of a plug held by walls",
        format_args!("{} m/s, {} m over the run", short(n.plug_slip_m_per_s), short(n.plug_slip_m)),
    )
}

fn tau(tau: f64) -> String {
    if tau.is_finite() { relaxation(tau) } else { "∞ (γ̇ = 0)".to_owned() }
}
