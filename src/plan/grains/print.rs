//! The table of `lahar plan` for a scene without fluid.

use std::fmt;

use super::GrainNumbers;
use crate::plan::cost::ON_WHAT;
use crate::plan::disk::total;
use crate::plan::expected;
use crate::plan::text::{human, passes, row, short, warnings};

pub(super) fn table(f: &mut fmt::Formatter<'_>, n: &GrainNumbers) -> fmt::Result {
    writeln!(f, "{}", n.title)?;
    grains(f, n)?;
    contacts(f, n)?;
    time(f, n)?;
    expected::section(f, &n.expected)?;
    passes(f, &n.passes)?;
    cost(f, n)?;
    warnings(f, &n.warnings)
}

fn grains(f: &mut fmt::Formatter<'_>, n: &GrainNumbers) -> fmt::Result {
    writeln!(f, "\nGrains")?;
    let kinds = match (n.clumps, n.driven) {
        (0, 0) => String::new(),
        (clumps, 0) => format!(", {clumps} of them clumps"),
        (0, driven) => format!(", {driven} of them driven"),
        (clumps, driven) => format!(", {clumps} of them clumps, {driven} driven"),
    };
    row(f, "grains", format_args!("{}{kinds}; {} spheres", n.grains, n.spheres))?;
    let (least, largest) = (short(n.least_radius_m), short(n.largest_radius_m));
    row(f, "radii", format_args!("{least} to {largest} m; spheres differ {} times", short(n.size_ratio)))?;
    row(f, "mass", format_args!("{} kg", short(n.mass_kg)))?;
    row(f, "volume", format_args!("{} of the box", short(n.solid_fraction)))?;
    row(f, "touching at time 0", format_args!("{} pairs", n.contacts))?;
    row(f, "walls", format_args!("{}, {} triangles", n.walls, n.triangles))
}

fn contacts(f: &mut fmt::Formatter<'_>, n: &GrainNumbers) -> fmt::Result {
    writeln!(f, "\nContacts")?;
    let given =
        if n.design_speed_given { "given" } else { "the fastest grain after falling through the box" };
    row(f, "design speed", format_args!("{} m/s: {given}", short(n.design_speed_m_per_s)))?;
    row(f, "shortest contact", format_args!("{} s: {}", short(n.contact_time_s), n.contact_pair))?;
    row(
        f,
        "restitution, largest and least",
        format_args!("{:.4}, {:.4}", n.restitution[0], n.restitution[1]),
    )?;
    row(f, "overlap of an impact", format_args!("{} of the radius", short(n.impact_overlap)))?;
    row(f, "overlap below a pile", format_args!("{} of the radius", short(n.static_overlap)))?;
    row(f, "run stops at", format_args!("{} of the radius", short(n.overlap_limit)))
}

fn time(f: &mut fmt::Formatter<'_>, n: &GrainNumbers) -> fmt::Result {
    writeln!(f, "\nTime")?;
    let rule = if n.time_step_given {
        "given"
    } else if n.time_step_s < n.damping_step_s {
        "chosen"
    } else {
        "chosen for the damping of contacts"
    };
    row(
        f,
        "time step",
        format_args!(
            "{} s, {rule}: {} steps in the shortest contact",
            short(n.time_step_s),
            short(n.steps_per_contact)
        ),
    )?;
    row(f, "steps", format_args!("{} to {} s", n.steps, short(n.end_time_s)))?;
    row(f, "integrator", format_args!("{}", n.integrator))
}

fn cost(f: &mut fmt::Formatter<'_>, n: &GrainNumbers) -> fmt::Result {
    writeln!(f, "\nCost")?;
    row(f, "memory", format_args!("{}, if grains are packed densely", human(n.bytes)))?;
    let (bytes, files) = total(&n.files);
    row(f, "files", format_args!("{files}, about {}, besides plots", human(bytes)))?;
    row(f, "sphere updates", format_args!("{}", short(n.sphere_updates)))?;
    row(f, "rough time", format_args!("{} s {ON_WHAT}", short(n.estimated_seconds)))
}
