//! The table of `lahar plan`.

use std::fmt::{self, Write};

use super::numbers::Numbers;

/// Writes the table.
pub(super) fn table(f: &mut fmt::Formatter<'_>, n: &Numbers) -> fmt::Result {
    writeln!(f, "{}", n.title)?;
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
    } else if n.gap_cells.is_finite() {
        row(f, "widest gap", format_args!("{} cells between walls", n.gap_cells))?;
    } else {
        row(f, "widest gap", format_args!("no walls"))?;
    }
    writeln!(f, "\nTime")?;
    row(f, "time step", format_args!("{} s", short(n.time_step_s)))?;
    row(f, "", format_args!("{}", n.time_step_rule.sentence()))?;
    row(f, "steps", format_args!("{} to {} s", n.steps, short(n.end_time_s)))?;
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
    writeln!(f, "\nScheme")?;
    row(f, "collision", format_args!("{}", n.operator))?;
    row(f, "plastic τ", format_args!("{:.4}", n.tau_plastic))?;
    row(f, "τ range", format_args!("{:.4} to {}", n.tau_min, tau(n.tau_max)))?;
    stability(f, n)?;
    slip(f, n)?;
    row(
        f,
        "populations",
        format_args!(
            "{}, {} bytes each; rounding: at most {} of the velocity",
            n.precision,
            n.population_bytes,
            short(n.rounding_floor)
        ),
    )?;
    if let Some(grains) = &n.grains {
        super::coupled::table(f, grains)?;
    }
    writeln!(f, "\nMemory")?;
    for item in &n.memory {
        row(f, item.what, format_args!("{} bytes per cell", short(item.bytes_per_cell)))?;
    }
    row(
        f,
        "total",
        format_args!("{} bytes per cell, {} MiB", short(n.bytes_per_cell), short(n.bytes as f64 / 1048576.0)),
    )?;
    passes(f, n)?;
    writeln!(f, "\nCost")?;
    row(f, "cell updates", format_args!("{}", short(n.cell_updates)))?;
    row(
        f,
        "rough time",
        format_args!(
            "{} s on one thread, assuming 10 million updates per second{}",
            short(n.estimated_seconds),
            if n.grains.is_some() { " and 2 million of spheres" } else { "" }
        ),
    )?;
    if !n.warnings.is_empty() {
        writeln!(f, "\nWarnings")?;
    }
    for warning in &n.warnings {
        writeln!(f, "  - {warning}")?;
    }
    Ok(())
}

/// A line of the table.
pub(super) fn row(f: &mut fmt::Formatter<'_>, name: &str, value: fmt::Arguments<'_>) -> fmt::Result {
    let padding = 38_usize.saturating_sub(name.chars().count());
    write!(f, "  {name}")?;
    for _ in 0..padding {
        f.write_char(' ')?;
    }
    writeln!(f, "{value}")
}

fn stability(f: &mut fmt::Formatter<'_>, n: &Numbers) -> fmt::Result {
    match (n.stable_speed, n.stability_margin) {
        (Some(limit), Some(margin)) => row(
            f,
            "stability",
            format_args!(
                "stable up to {limit:.4} cells per step: {} times the expected speed",
                short(margin)
            ),
        ),
        (Some(limit), None) => row(f, "stability", format_args!("stable up to {limit:.4} cells per step")),
        (None, _) => row(f, "stability", format_args!("not tabulated for this operator and τ")),
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

fn passes(f: &mut fmt::Formatter<'_>, n: &Numbers) -> fmt::Result {
    writeln!(f, "\nNeeded")?;
    for pass in n.passes.iter().filter(|pass| pass.needed) {
        row(f, pass.pass, format_args!("{}", pass.because))?;
    }
    writeln!(f, "\nNot needed, not paid for")?;
    for pass in n.passes.iter().filter(|pass| !pass.needed) {
        row(f, pass.pass, format_args!("{}", pass.because))?;
    }
    Ok(())
}

fn tau(tau: f64) -> String {
    if tau.is_finite() { format!("{tau:.4}") } else { "∞ (γ̇ = 0)".to_owned() }
}

/// Four significant digits; scientific outside 1e-3 … 1e6.
pub(super) fn short(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return if value == f64::INFINITY { "∞".to_owned() } else { format!("{value}") };
    }
    let magnitude = libm::floor(libm::log10(value.abs()));
    if (-3.0..6.0).contains(&magnitude) {
        let decimals = if magnitude < 3.0 { (3.0 - magnitude) as usize } else { 0 };
        let text = format!("{value:.decimals$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    } else {
        format!("{value:.3e}")
    }
}
