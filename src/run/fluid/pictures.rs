//! Plots and pictures of a fluid.

use super::files::Section;
use crate::free_surface::Kind;
use crate::geometry::Axis as Direction;
use crate::output::picture::{self, Picture};
use crate::output::plot::{Axis, Plot, Series as Curve};
use crate::output::{OutputError, atomic, svg};
use crate::run::measure::Probes;
use crate::run::measure::fields::{PROFILE_COLUMNS, is_fluid, profile, unyielded};
use crate::run::measure::fluid::{Frame, SECTION_COLUMNS};
use crate::run::recorder::Recorder;
use crate::scene::{Measure, Probe};
use crate::setup::{Face, Setup};
use crate::solver::run::Fields;

/// Most curves of a section at different times.
const CURVES: usize = 6;

/// What plots at the end are made of.
pub(super) struct Plots<'a> {
    pub recorder: &'a Recorder,
    pub title: &'a str,
    pub setup: &'a Setup,
    pub frame: &'a Frame,
    /// The fields at the end.
    pub fields: &'a Fields,
    pub sections: &'a [Section],
    pub has_grains: bool,
}

impl Plots<'_> {
    /// What probes write into files, speed and depth.
    ///
    /// # Errors
    /// I/O.
    pub(crate) fn draw(&self, probes: &Probes) -> Result<(), OutputError> {
        for listed in probes.iter() {
            if let Some(name) = listed.file_plot() {
                self.file(&listed.probe, &name)?;
            }
        }
        self.speed_picture()?;
        let [a, b] = self.frame.upright.across();
        let wide = self.setup.extents[a] > 1 && self.setup.extents[b] > 1;
        if wide && self.setup.free_surface.is_some() {
            self.depth_picture("depth", None)?;
        }
        Ok(())
    }

    /// A plot of what a probe writes into files.
    fn file(&self, probe: &Probe, file: &str) -> Result<(), OutputError> {
        match probe.measure {
            Measure::Profile { along } => self.profile_plot(&probe.name, file, along),
            Measure::SurfaceProfile { along, .. } => self.section_plot(&probe.name, file, along),
            Measure::DepthMap { above_m } => self.depth_picture(file, above_m),
            _ => Ok(()),
        }
    }

    fn profile_plot(&self, name: &str, file: &str, along: Direction) -> Result<(), OutputError> {
        debug_assert_eq!(PROFILE_COLUMNS[1].0, "velocity_x");
        let rows = profile(along, self.setup, self.fields, &self.frame.units);
        let x = Axis::linear(along.letter().to_string(), "m");
        let mut plot = Plot::new(format!("{}: {name}", self.title), x, Axis::linear("velocity", "m/s"));
        for (component, letter) in ["x", "y", "z"].iter().enumerate() {
            let points: Vec<[f64; 2]> = rows.iter().map(|row| [row[0], row[1 + component]]).collect();
            if points.iter().any(|point| point[1] != 0.0) || component == 0 {
                plot = plot.with(Curve::line(format!("velocity {letter}"), points));
            }
        }
        self.svg(&format!("{file}.svg"), &svg::draw(&plot)?)
    }

    /// Bed and surface of a section at up to six of the times written.
    fn section_plot(&self, name: &str, file: &str, along: Direction) -> Result<(), OutputError> {
        debug_assert_eq!((SECTION_COLUMNS[1].0, SECTION_COLUMNS[3].0), ("bed", "surface"));
        let shots: Vec<_> = self.sections.iter().filter(|section| section.probe == name).collect();
        let x = Axis::linear(along.letter().to_string(), "m");
        let height = Axis::linear("height", "m");
        let mut plot = Plot::new(format!("{}: {name}", self.title), x, height);
        if let Some(first) = shots.first() {
            let bed = first.rows.iter().map(|row| [row[0], row[1]]).collect();
            plot = plot.with(Curve::reference("bed", bed));
        }
        let last = shots.len().saturating_sub(1);
        let curves = CURVES.min(shots.len());
        let chosen = (0..curves).map(|c| if curves > 1 { c * last / (curves - 1) } else { last });
        for shot in chosen.map(|c| shots[c]) {
            // Where there is no fluid the curve lies on the bed.
            let points = shot.rows.iter().map(|row| [row[0], if row[2] > 0.0 { row[3] } else { row[1] }]);
            plot = plot.with(Curve::line(format!("{:.4} s", shot.time_s), points.collect()));
        }
        self.svg(&format!("{file}.svg"), &svg::draw(&plot)?)
    }

    /// The plane that shows most: the middle one normal to the shortest axis; with a free surface an
    /// upright one, and a mirror plane if there is one.
    fn plane(&self) -> (Direction, usize) {
        let n = self.setup.extents;
        let upright = |axis: &Direction| self.setup.free_surface.is_none() || *axis != self.frame.upright.up;
        let axes = Direction::ALL.into_iter().rev().filter(upright);
        let normal = axes.min_by_key(|axis| n[axis.index()]).unwrap_or(Direction::Z);
        let a = normal.index();
        let at = match self.setup.faces[a] {
            _ if self.setup.free_surface.is_none() => n[a] / 2,
            [Face::FreeSlip, _] => 0,
            [_, Face::FreeSlip] => n[a] - 1,
            _ => n[a] / 2,
        };
        (normal, at)
    }

    /// Speed in one plane; not for columns and single cells.
    fn speed_picture(&self) -> Result<(), OutputError> {
        let (extents, fields) = (self.setup.extents, self.fields);
        let (normal, at) = self.plane();
        let [a, b] = normal.others();
        if extents[a] < 2 || extents[b] < 2 {
            return Ok(());
        }
        let mut cells = Vec::with_capacity(extents[a] * extents[b]);
        for ib in 0..extents[b] {
            for ia in 0..extents[a] {
                let mut cell = [at; 3];
                (cell[a], cell[b]) = (ia, ib);
                cells.push(self.setup.index(cell));
            }
        }
        // Cells inside grains are solid at the moment.
        let solid = |c: usize| self.setup.is_solid(c) || fields.kind.get(c) == Some(&(Kind::Solid as u8));
        let speed = |c: &usize| {
            // Air stays white.
            if !solid(*c) && !is_fluid(self.setup, fields, *c) {
                return f64::NAN;
            }
            let [x, y, z] = self.frame.units.velocities_to_si(fields.velocity[*c]);
            (x * x + y * y + z * z).sqrt()
        };
        let plug = unyielded(self.setup, fields);
        let has_plug = plug.iter().any(|p| *p);
        let picture = Picture {
            title: self.title.to_owned(),
            label: "speed".to_owned(),
            unit: "m/s".to_owned(),
            extents: [extents[a], extents[b]],
            spacing: self.frame.units.dx_m,
            length_unit: "m".to_owned(),
            axes: [a, b].map(|axis| Direction::ALL[axis].letter().to_string()),
            values: cells.iter().map(speed).collect(),
            solid: if self.setup.solids.is_empty() && !self.has_grains {
                Vec::new()
            } else {
                cells.iter().map(|&c| solid(c)).collect()
            },
            unyielded: if has_plug { cells.iter().map(|&c| plug[c]).collect() } else { Vec::new() },
        };
        self.svg("speed.svg", &picture::draw(&picture)?)
    }

    /// Depth of all columns, seen from above.
    fn depth_picture(&self, name: &str, above_m: Option<f64>) -> Result<(), OutputError> {
        let [a, b] = self.frame.upright.across();
        let columns = self.frame.upright.columns(self.setup, self.fields, &self.frame.units, above_m);
        let depth = columns.iter().map(|column| if column.depth > 0.0 { column.depth } else { f64::NAN });
        let picture = Picture {
            title: self.title.to_owned(),
            label: "depth".to_owned(),
            unit: "m".to_owned(),
            extents: [a, b].map(|axis| self.setup.extents[axis]),
            spacing: self.frame.units.dx_m,
            length_unit: "m".to_owned(),
            axes: [a, b].map(|axis| Direction::ALL[axis].letter().to_string()),
            values: depth.collect(),
            solid: Vec::new(),
            unyielded: Vec::new(),
        };
        self.svg(&format!("{name}.svg"), &picture::draw(&picture)?)
    }

    fn svg(&self, name: &str, text: &str) -> Result<(), OutputError> {
        atomic::write(&self.recorder.folder().plot(name)?, text.as_bytes())
    }
}
