//! A line plot as data; [`super::svg`] draws it.

use serde::{Deserialize, Serialize};

use crate::output::number;

/// A line plot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plot {
    /// Heading.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// The curves, in the order of the legend.
    pub series: Vec<Series>,
}

/// One axis.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Axis {
    /// What it shows.
    pub label: String,
    /// In which unit; empty if none.
    pub unit: String,
    /// Logarithmic.
    pub log: bool,
}

/// One curve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// Entry of the legend.
    pub name: String,
    /// Points (x, y).
    #[serde(with = "number::points")]
    pub points: Vec<[f64; 2]>,
    /// How it is drawn.
    pub style: Style,
}

/// How a curve is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Style {
    /// Solid line.
    Line,
    /// Dashed dark line: a reference, a theory, a slope.
    Reference,
    /// One mark per point.
    Markers,
    /// Marks joined by a line.
    LineMarkers,
}

impl Plot {
    /// A plot without curves.
    #[must_use]
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self { title: title.into(), x, y, series: Vec::new() }
    }

    /// Adds a curve.
    #[must_use]
    pub fn with(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }
}

impl Axis {
    /// A linear axis.
    #[must_use]
    pub fn linear(label: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { label: label.into(), unit: unit.into(), log: false }
    }

    /// A logarithmic axis; points that are not positive are left out.
    #[must_use]
    pub fn log(label: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { label: label.into(), unit: unit.into(), log: true }
    }

    /// Label with unit.
    #[must_use]
    pub(crate) fn caption(&self) -> String {
        if self.unit.is_empty() { self.label.clone() } else { format!("{} [{}]", self.label, self.unit) }
    }
}

impl Series {
    fn new(name: impl Into<String>, points: Vec<[f64; 2]>, style: Style) -> Self {
        Self { name: name.into(), points, style }
    }

    /// A solid line.
    #[must_use]
    pub fn line(name: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self::new(name, points, Style::Line)
    }

    /// A dashed line.
    #[must_use]
    pub fn reference(name: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self::new(name, points, Style::Reference)
    }

    /// Marks only.
    #[must_use]
    pub fn markers(name: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self::new(name, points, Style::Markers)
    }

    /// Marks joined by a line.
    #[must_use]
    pub fn line_markers(name: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self::new(name, points, Style::LineMarkers)
    }
}
