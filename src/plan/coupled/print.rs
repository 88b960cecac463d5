//! What the table of `lahar plan` says about grains in a fluid.

use std::fmt;

use super::{CoupledNumbers, SubStepsFrom};
use crate::geometry::Axis;
use crate::plan::text::{human, row, short};
use crate::rheology::bagnold::Regime;

pub(in crate::plan) fn table(f: &mut fmt::Formatter<'_>, n: &CoupledNumbers) -> fmt::Result {
    writeln!(f, "\nGrains")?;
    let some = |count: usize, what: &str| {
        if count > 0 { format!(", {count} of them {what}") } else { String::new() }
    };
    let kinds = format!("{}{}", some(n.clumps, "clumps"), some(n.driven, "driven"));
    row(f, "grains", format_args!("{}{kinds}; {} spheres, {} walls", n.grains, n.spheres, n.walls))?;
    let [least, largest] = n.radius_m.map(short);
    let [low, high] = n.radius_cells.map(short);
    row(f, "radii", format_args!("{least} to {largest} m: {low} to {high} cells"))?;
    row(f, "drag error to expect", format_args!("{:.1} % of the smallest", 100.0 * n.drag_error))?;
    row(f, "solid fraction", format_args!("{} of grains and fluid", short(n.solid_fraction)))?;
    if let Some([low, high]) = n.density_ratio {
        let ratio = if low == high { short(low) } else { format!("{} to {}", short(low), short(high)) };
        row(f, "density over the fluid's", format_args!("{ratio}"))?;
    }
    row(
        f,
        "speed in the fluid",
        format_args!(
            "{} m/s, {} cells per step; particle Reynolds number {}",
            short(n.speed_m_per_s),
            short(n.speed_lattice),
            short(n.particle_reynolds)
        ),
    )?;
    if n.held > 0.0 {
        let what = if n.held >= 1.0 { "held by the yield stress" } else { "not held by the yield stress" };
        row(f, "yield number over critical", format_args!("{}: {what}", short(n.held)))?;
    }
    gravity(f, n)?;
    rules(f, n)?;
    row(f, "added memory", format_args!("{}; about {} links", human(n.bytes), short(n.links)))?;
    row(f, "sphere updates", format_args!("{}", short(n.sphere_updates)))?;
    for note in &n.notes {
        row(f, "note", format_args!("{note}"))?;
    }
    classes(f, n)
}

/// Sub-steps and rules of the coupling.
fn rules(f: &mut fmt::Formatter<'_>, n: &CoupledNumbers) -> fmt::Result {
    let from = match n.sub_steps_from {
        SubStepsFrom::Given => "given",
        SubStepsFrom::Lubrication => "chosen for lubrication down to a gap of 0.1 cells",
        SubStepsFrom::Contacts => "chosen for contacts",
    };
    let steps = format!("{} of {} s, {from}", n.sub_steps, short(n.time_step_s));
    let label = "steps in a step of the fluid";
    if n.contact_time_s.is_finite() {
        let [resolved, contact] = [n.steps_per_contact, n.contact_time_s].map(short);
        let speed = short(n.design_speed_m_per_s);
        row(
            f,
            label,
            format_args!("{steps}: {resolved} in the shortest contact of {contact} s at {speed} m/s"),
        )?;
    } else {
        row(f, label, format_args!("{steps}: all grains are driven, no contact to resolve"))?;
    }
    row(f, "surface, freed cells", format_args!("{}, {}", n.wall, n.refill))?;
    match &n.lubrication {
        None => row(f, "lubrication", format_args!("off")),
        Some(rules) => row(
            f,
            "lubrication",
            format_args!(
                "below {} cells, gaps count down to {}{}; limited by the step below {} cells",
                short(rules.cutoff_cells),
                short(rules.smallest_gap_cells),
                if rules.tangential { "" } else { ", normal only" },
                short(rules.limited_gap_cells)
            ),
        ),
    }
}

fn gravity(f: &mut fmt::Formatter<'_>, n: &CoupledNumbers) -> fmt::Result {
    let axes = |marks: [bool; 3]| {
        let letters = Axis::ALL.iter().filter(|axis| marks[axis.index()]);
        letters.map(|axis| axis.letter().to_string()).collect::<Vec<_>>().join(", ")
    };
    if n.weightless.contains(&true) {
        let axes = axes(n.weightless);
        row(
            f,
            &format!("gravity along {axes}"),
            format_args!("as buoyancy; the pressure at rest is left out"),
        )?;
    }
    if n.balanced.contains(&true) {
        let axes = axes(n.balanced);
        row(f, &format!("gravity along {axes}"), format_args!("balanced by a uniform pressure gradient"))?;
    }
    Ok(())
}

fn classes(f: &mut fmt::Formatter<'_>, n: &CoupledNumbers) -> fmt::Result {
    writeln!(
        f,
        "\nSize classes at a shear rate of {} 1/s: thresholds 40 and 450",
        short(n.shear_rate_per_s)
    )?;
    if let Some(reason) = &n.no_bagnold {
        row(f, "no Bagnold numbers", format_args!("{reason}"))?;
    }
    for class in &n.classes {
        let [low, high] = class.radius_m.map(short);
        let name = if low == high { format!("{low} m") } else { format!("{low} to {high} m") };
        let number = class.bagnold.map_or_else(String::new, |ba| {
            let regime = match class.regime {
                Some(Regime::MacroViscous) => "macro-viscous",
                Some(Regime::Transitional) => "transitional",
                Some(Regime::GrainInertia) => "grain inertia",
                None => "",
            };
            format!("Ba {}, {regime}; ", short(ba))
        });
        row(
            f,
            &name,
            format_args!(
                "{} grains, {:.1} % of the volume; {number}{} cells",
                class.grains,
                100.0 * class.volume_share,
                short(class.radius_cells)
            ),
        )?;
        let [low, high] = class.cost_factor.map(short);
        row(
            f,
            "",
            format_args!(
                "4 cells at {} m: {low} to {high} times the cost; {}",
                short(class.spacing_for_4_cells_m),
                class.recommendation
            ),
        )?;
    }
    Ok(())
}
