//! What an error costs: the table that the study `work-precision` measures and `lahar plan
//! --target-error` quotes.
//!
//! A [`Point`] says which error a scheme reached at a resolution and time step, and how many cell
//! updates that took: the same bits on every machine. A [`Speed`] says how long an update takes with
//! a scheme and backend on one dated machine. Seconds are the product of both.

use crate::output::table::{Entry, ExhibitRecord, Measured, Table};

mod choice;

pub use choice::{Advice, Choice, predicted, recommend};

/// A flow with a reference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Case {
    /// Newtonian flow between plane walls.
    ChannelNewtonian,
    /// Bingham flow between plane walls.
    ChannelBingham,
    /// Herschel-Bulkley flow between plane walls.
    ChannelHerschelBulkley,
    /// Vortices that decay in a periodic box.
    Vortex,
    /// Newtonian film on an incline.
    FilmNewtonian,
    /// Bingham film on an incline.
    FilmBingham,
    /// Herschel-Bulkley film on an incline.
    FilmHerschelBulkley,
    /// A round heap of Bingham fluid.
    Slump,
    /// A Newtonian block that spreads on a floor.
    DamBreak,
}

impl Case {
    /// All of them, in the order of the report.
    pub const ALL: [Self; 9] = [
        Self::ChannelNewtonian,
        Self::ChannelBingham,
        Self::ChannelHerschelBulkley,
        Self::Vortex,
        Self::FilmNewtonian,
        Self::FilmBingham,
        Self::FilmHerschelBulkley,
        Self::Slump,
        Self::DamBreak,
    ];

    /// As it is called in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::ChannelNewtonian => "channel, Newtonian",
            Self::ChannelBingham => "channel, Bingham",
            Self::ChannelHerschelBulkley => "channel, Herschel-Bulkley n = 0.33",
            Self::Vortex => "Taylor-Green vortices, Newtonian",
            Self::FilmNewtonian => "film, Newtonian",
            Self::FilmBingham => "film, Bingham",
            Self::FilmHerschelBulkley => "film, Herschel-Bulkley n = 0.33",
            Self::Slump => "slump of a heap, Bingham",
            Self::DamBreak => "dam break, Newtonian",
        }
    }

    /// What the error is, and against what.
    #[must_use]
    pub const fn error(self) -> &'static str {
        match self {
            Self::ChannelNewtonian | Self::ChannelBingham | Self::ChannelHerschelBulkley => {
                "relative L2 error of the steady velocity against the exact profile"
            }
            Self::Vortex => {
                "relative L2 error of the velocity after it has halved against the exact solution"
            }
            Self::FilmNewtonian | Self::FilmBingham | Self::FilmHerschelBulkley => {
                "relative error of the steady discharge against the exact one, worse of two fill levels"
            }
            Self::Slump => {
                "share of the volume that lies elsewhere than in lahar's own finest run: there is no exact solution"
            }
            Self::DamBreak => {
                "relative error of the front against lubrication theory, whose own error is a few per cent"
            }
        }
    }

    /// What the reference itself is known to: errors below it say nothing.
    #[must_use]
    pub(crate) const fn reference_error(self) -> f64 {
        match self {
            // (h/L)² at the start, the tolerance of claim `dam-break-viscous-planar`.
            Self::DamBreak => 0.0625,
            _ => 0.0,
        }
    }

    /// What N counts.
    #[must_use]
    pub const fn length(self) -> &'static str {
        match self {
            Self::ChannelNewtonian | Self::ChannelBingham | Self::ChannelHerschelBulkley => {
                "cells between the walls"
            }
            Self::Vortex => "cells per wave",
            Self::FilmNewtonian | Self::FilmBingham | Self::FilmHerschelBulkley => "cells of depth",
            Self::Slump | Self::DamBreak => "cells of initial depth",
        }
    }

    fn of(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|case| case.name() == name)
    }
}

/// How populations are relaxed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// Central moments, exact yield: the default.
    CentralMoment,
    /// Two relaxation times, exact yield.
    Trt,
    /// One relaxation time (Newtonian only: its plugs slip without bound).
    Bgk,
    /// The papers' scheme: BGK, τ of the previous step, clamped.
    LaggedClamp,
}

impl Operator {
    /// Preferred first.
    pub const ALL: [Self; 4] = [Self::CentralMoment, Self::Trt, Self::Bgk, Self::LaggedClamp];

    /// As it is called in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::CentralMoment => "central moments",
            Self::Trt => "TRT",
            Self::Bgk => "BGK",
            Self::LaggedClamp => "BGK, lagged clamp",
        }
    }
}

/// How walls are treated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Walls {
    /// The flow has none.
    None,
    /// Viscosity-independent \[B3\].
    Independent,
    /// Half-way bounce-back \[B1\].
    HalfWay,
}

impl Walls {
    /// Preferred first.
    pub const ALL: [Self; 3] = [Self::None, Self::Independent, Self::HalfWay];

    /// As they are called in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Independent => "[B3]",
            Self::HalfWay => "half-way",
        }
    }
}

/// What is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scheme {
    /// Collision and yield treatment.
    pub operator: Operator,
    /// Wall rule.
    pub walls: Walls,
}

impl Scheme {
    /// In words.
    #[must_use]
    pub fn name(self) -> String {
        match self.walls {
            Walls::None => self.operator.name().to_owned(),
            walls => format!("{}, {} walls", self.operator.name(), walls.name()),
        }
    }

    fn of(operator: &str, walls: &str) -> Option<Self> {
        Some(Self {
            operator: Operator::ALL.into_iter().find(|o| o.name() == operator)?,
            walls: Walls::ALL.into_iter().find(|w| w.name() == walls)?,
        })
    }
}

/// One run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Flow.
    pub case: Case,
    /// Scheme.
    pub scheme: Scheme,
    /// N, see [`Case::length`].
    pub n: f64,
    /// Time step over Δx², in units of the case's standard one.
    pub step: f64,
    /// τ of the plastic viscosity.
    pub tau: f64,
    /// Error reached.
    pub error: f64,
    /// Time steps it took.
    pub steps: u64,
    /// Updates of cells it took.
    pub updates: f64,
}

/// How fast a scheme runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Speed {
    /// Flow.
    pub case: Case,
    /// Scheme.
    pub scheme: Scheme,
    /// Backend.
    pub backend: String,
    /// Nanoseconds per update of a cell, one thread.
    pub nanoseconds: f64,
}

/// Points and speeds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Work {
    /// All runs that gave a result.
    pub points: Vec<Point>,
    /// All speeds measured.
    pub speeds: Vec<Speed>,
    /// When and where.
    pub measured: Option<Measured>,
}

/// Title of the table of points.
const POINTS: &str = "Error and work";
/// Title of the table of speeds.
const SPEEDS: &str = "Nanoseconds per update of a cell, one thread";
const POINT_COLUMNS: [&str; 9] =
    ["flow", "collision", "walls", "N", "Δt/Δx² [standard]", "plastic τ", "error", "steps", "cell updates"];

/// The points as a table; a run without result has the reason in place of its error.
#[must_use]
pub fn table_of_points(points: &[(Point, Option<String>)]) -> Table {
    let mut table = Table::new(POINTS, &POINT_COLUMNS);
    for (point, failed) in points {
        let mut row: Vec<Entry> = vec![
            point.case.name().into(),
            point.scheme.operator.name().into(),
            point.scheme.walls.name().into(),
            point.n.into(),
            point.step.into(),
            point.tau.into(),
        ];
        match failed {
            Some(why) => row.push(why.clone().into()),
            None => row.extend([point.error.into(), (point.steps as f64).into(), point.updates.into()]),
        }
        table.push(row);
    }
    table
}

/// The speeds as a table.
#[must_use]
pub fn table_of_speeds(speeds: &[Speed]) -> Table {
    let mut table = Table::new(SPEEDS, &["flow", "collision", "walls", "backend", "ns per update"]);
    for speed in speeds {
        table.push(vec![
            speed.case.name().into(),
            speed.scheme.operator.name().into(),
            speed.scheme.walls.name().into(),
            speed.backend.clone().into(),
            speed.nanoseconds.into(),
        ]);
    }
    table
}

fn text(entry: Option<&Entry>) -> Option<&str> {
    match entry? {
        Entry::Text(text) => Some(text),
        Entry::Number(_) => None,
    }
}

fn number(entry: Option<&Entry>) -> Option<f64> {
    match entry? {
        Entry::Number(number) => Some(*number),
        Entry::Text(_) => None,
    }
}

fn heading(row: &[Entry]) -> Option<(Case, Scheme)> {
    Some((Case::of(text(row.first())?)?, Scheme::of(text(row.get(1))?, text(row.get(2))?)?))
}

/// Reads a row of [`table_of_points`]; `None` for a run without result.
fn point(row: &[Entry]) -> Option<Point> {
    let (case, scheme) = heading(row)?;
    let at = |column| number(row.get(column));
    Some(Point {
        case,
        scheme,
        n: at(3)?,
        step: at(4)?,
        tau: at(5)?,
        error: at(6)?,
        steps: at(7)? as u64,
        updates: at(8)?,
    })
}

fn speed(row: &[Entry]) -> Option<Speed> {
    let (case, scheme) = heading(row)?;
    let backend = text(row.get(3))?.to_owned();
    Some(Speed { case, scheme, backend, nanoseconds: number(row.get(4))? })
}

fn rows<'a>(record: &'a ExhibitRecord, title: &'a str) -> impl Iterator<Item = &'a Vec<Entry>> {
    record.data.tables.iter().filter(move |table| table.title == title).flat_map(|table| &table.rows)
}

impl Work {
    /// From the two exhibits of the study.
    #[must_use]
    pub fn of(points: &ExhibitRecord, speeds: &ExhibitRecord) -> Self {
        Self {
            points: rows(points, POINTS).filter_map(|row| point(row)).collect(),
            speeds: rows(speeds, SPEEDS).filter_map(|row| speed(row)).collect(),
            measured: speeds.measured.clone(),
        }
    }

    /// The table this build of lahar carries: the golden files of the study.
    ///
    /// # Errors
    /// The golden files were not what the study writes when lahar was built.
    pub(crate) fn built_in() -> Result<Self, serde_json::Error> {
        let points =
            serde_json::from_str(include_str!("../../../golden/exhibits/work-precision-points.json"))?;
        let speeds =
            serde_json::from_str(include_str!("../../../golden/measured/work-precision-times.json"))?;
        Ok(Self::of(&points, &speeds))
    }
}

#[cfg(test)]
mod tests;
