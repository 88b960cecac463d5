//! What the probes of a scene become: columns of the time series and plots of them. Every name of a column or a plot is made
//! here.

use std::borrow::Cow;
use std::ops::Range;

use super::dry::DryScene;
use super::{Measure, Probe, Scene, Subject};

/// Size classes of a segregation when the scene does not say.
pub(crate) const CLASSES: u32 = 3;

/// One column of a probe.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ProbeColumn {
    /// What follows the name of the probe in the name of the column; nothing if it is the only one.
    pub part: Cow<'static, str>,
    /// Its unit, `-` if none.
    pub unit: &'static str,
}

impl ProbeColumn {
    /// Name of the column.
    pub(crate) fn name(&self, probe: &str) -> String {
        if self.part.is_empty() { probe.to_owned() } else { format!("{probe}_{}", self.part) }
    }
}

/// The probe of a run and what its words mean.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Listed {
    pub probe: Probe,
    pub subject: Subject,
    /// JSON path; `None` of one that the scene does not name.
    pub path: Option<String>,
    /// Whether the scene has grains.
    pub with_grains: bool,
}

/// Of a scene with fluid: largest speed and kinetic energy when nothing about the fluid has a column; and with grains what
/// [`of_grains`] says.
pub(crate) fn of_flow(scene: &Scene) -> Vec<Listed> {
    let with_grains = scene.grains.is_some();
    let mut fluid = listed(&scene.output.probes, "output.probes", Subject::Fluid, with_grains);
    if scene.output.probes.iter().all(|probe| probe.measure.is_file()) {
        for (name, measure) in [("max_speed", Measure::MaxSpeed), ("kinetic_energy", Measure::KineticEnergy)]
        {
            fluid.push(unnamed(name, measure, Subject::Fluid, with_grains));
        }
    }
    if with_grains {
        fluid.extend(or_books(&scene.output.grain_probes, "output.grain_probes"));
    }
    fluid
}

/// Of a scene without fluid: energies and contacts when it names none.
pub(crate) fn of_grains(scene: &DryScene) -> Vec<Listed> {
    or_books(&scene.output.probes, "output.probes")
}

/// Energies and contacts in place of nothing.
fn or_books(probes: &[Probe], path: &str) -> Vec<Listed> {
    if !probes.is_empty() {
        return listed(probes, path, Subject::Grains, true);
    }
    let books = [("energy", Measure::Energies), ("contacts", Measure::Contacts)];
    books.map(|(name, measure)| unnamed(name, measure, Subject::Grains, true)).to_vec()
}

fn listed(probes: &[Probe], path: &str, subject: Subject, with_grains: bool) -> Vec<Listed> {
    let one = |(i, probe): (usize, &Probe)| Listed {
        probe: probe.clone(),
        subject,
        path: Some(format!("{path}[{i}].name")),
        with_grains,
    };
    probes.iter().enumerate().map(one).collect()
}

fn unnamed(name: &str, measure: Measure, subject: Subject, with_grains: bool) -> Listed {
    Listed { probe: Probe { name: name.to_owned(), measure }, subject, path: None, with_grains }
}

impl Listed {
    /// Whether it is about grains, in a fluid or without.
    pub(crate) fn is_about_grains(&self) -> bool {
        self.probe.measure.is_about_grains(self.subject)
    }

    /// Its columns in the time series.
    pub(crate) fn columns(&self) -> Vec<ProbeColumn> {
        self.probe.measure.columns(self.subject, self.with_grains)
    }

    /// The plots of its columns: name without ending, and which of them. Of a load one for each of its parts, of grains one for
    /// neighbouring columns of one unit, else one for each column.
    pub(crate) fn plots(&self) -> Vec<(String, Range<usize>)> {
        let (name, columns) = (&self.probe.name, self.columns());
        if let Measure::Torque { .. } = self.probe.measure {
            return vec![(format!("torque_{name}"), 0..columns.len())];
        }
        if self.probe.measure.loaded_solid().is_some() {
            let parts = [
                ("force", 0..3),
                ("impulse", 3..6),
                ("wetted_area", 6..12),
                ("contact", 12..15),
                ("contact_impulse", 16..19),
            ];
            let there = parts.into_iter().filter(|(_, range)| range.end <= columns.len());
            return there.map(|(what, range)| (format!("{what}_{name}"), range)).collect();
        }
        if self.is_about_grains() {
            return by_unit(name, &columns);
        }
        columns
            .iter()
            .enumerate()
            .map(|(k, column)| (format!("series_{}", column.name(name)), k..k + 1))
            .collect()
    }

    /// The plot of what it writes into files of its own.
    pub(crate) fn file_plot(&self) -> Option<String> {
        let what = match self.probe.measure {
            Measure::Profile { .. } => "profile",
            Measure::SurfaceProfile { .. } => "section",
            Measure::DepthMap { .. } => "depth",
            _ => return None,
        };
        Some(format!("{what}_{}", self.probe.name))
    }
}

/// Neighbouring columns of one unit share a plot. Vectors go by their name without the component.
fn by_unit(name: &str, columns: &[ProbeColumn]) -> Vec<(String, Range<usize>)> {
    let (mut plots, mut from) = (Vec::new(), 0);
    while from < columns.len() {
        let same = columns[from..].iter().take_while(|column| column.unit == columns[from].unit).count();
        let first = columns[from].name(name);
        let file = match first.strip_suffix("_x") {
            _ if same == columns.len() => name,
            Some(vector) if same > 1 => vector,
            _ => &first,
        };
        plots.push((format!("series_{file}"), from..from + same));
        from += same;
    }
    plots
}

impl Measure {
    /// Its columns; `subject` as in [`Self::needs`].
    fn columns(&self, subject: Subject, with_grains: bool) -> Vec<ProbeColumn> {
        match self {
            Self::Profile { .. } | Self::SurfaceProfile { .. } | Self::DepthMap { .. } => Vec::new(),
            Self::KineticEnergy => one("J"),
            Self::MaxSpeed => one("m/s"),
            Self::Mass => match subject {
                Subject::Fluid => one("kg"),
                Subject::Grains => several(&[("mass", "kg"), ("number", "-")]),
            },
            Self::PlugFraction | Self::YieldedFraction => one("-"),
            Self::FlowRate { .. } => one("m^3/s"),
            Self::Volume => one("m^3"),
            Self::Front { .. } | Self::GrainFront { .. } | Self::Submergence { .. } => one("m"),
            Self::PointVelocity { .. } => vectors(&[("", "m/s")]),
            Self::WindowVelocity { .. } => joined(vectors(&[("", "m/s")]), several(&[("volume", "m^3")])),
            Self::Momentum => vectors(&[("", "N s")]),
            Self::Torque { .. } => vectors(&[("", "N m")]),
            Self::SetSpeed { .. } => joined(vectors(&[("", "m/s")]), several(&[("speed", "m/s")])),
            Self::Force { on: Some(_), .. } => vectors(&[("force", "N"), ("torque", "N m")]),
            Self::Force { on: None, .. } => load(with_grains),
            Self::FluidForce { .. } => vectors(&[("force", "N"), ("contact", "N"), ("torque", "N m")]),
            Self::Grain { .. } => vectors(&[("", "m"), ("velocity", "m/s"), ("spin", "rad/s")]),
            Self::Contacts => several(&[("pairs", "-"), ("walls", "-"), ("per_grain", "-")]),
            Self::Flux { .. } => several(&[("mass", "kg"), ("number", "-")]),
            Self::Pile { .. } => several(&[("low", "m"), ("high", "m"), ("height", "m")]),
            Self::Segregation { classes, .. } => {
                let column =
                    |class| ProbeColumn { part: Cow::Owned(format!("height_{}", class + 1)), unit: "m" };
                (0..classes.unwrap_or(CLASSES)).map(column).collect()
            }
            Self::Ledger => several(&[
                ("mass", "kg"),
                ("mass_residual", "-"),
                ("outflow", "kg"),
                ("parked", "kg"),
                ("voids", "m^3"),
                ("momentum_residual", "N s"),
                ("conversions", "-"),
            ]),
            Self::Energies => several(&[
                ("kinetic", "J"),
                ("rotational", "J"),
                ("potential", "J"),
                ("elastic", "J"),
                ("lost_normal", "J"),
                ("lost_friction", "J"),
                ("lost_rolling", "J"),
                ("work_of_walls", "J"),
                ("left", "J"),
                ("unexplained", "J"),
            ]),
        }
    }
}

/// Of a force on a solid in a fluid.
fn load(with_grains: bool) -> Vec<ProbeColumn> {
    let mut columns = vectors(&[("", "N"), ("impulse", "N s")]);
    for side in ["x_low", "x_high", "y_low", "y_high", "z_low", "z_high"] {
        columns.push(ProbeColumn { part: Cow::Owned(format!("area_{side}")), unit: "m^2" });
    }
    if with_grains {
        columns.extend(vectors(&[("contact", "N")]));
        columns.extend(several(&[("contact_peak", "N")]));
        columns.extend(vectors(&[("contact_impulse", "N s")]));
    }
    columns
}

fn one(unit: &'static str) -> Vec<ProbeColumn> {
    several(&[("", unit)])
}

fn several(parts: &[(&'static str, &'static str)]) -> Vec<ProbeColumn> {
    parts.iter().map(|&(part, unit)| ProbeColumn { part: Cow::Borrowed(part), unit }).collect()
}

fn vectors(parts: &[(&str, &'static str)]) -> Vec<ProbeColumn> {
    let mut columns = Vec::new();
    for &(prefix, unit) in parts {
        for axis in ["x", "y", "z"] {
            let part =
                if prefix.is_empty() { Cow::Borrowed(axis) } else { Cow::Owned(format!("{prefix}_{axis}")) };
            columns.push(ProbeColumn { part, unit });
        }
    }
    columns
}

fn joined(mut first: Vec<ProbeColumn>, second: Vec<ProbeColumn>) -> Vec<ProbeColumn> {
    first.extend(second);
    first
}
