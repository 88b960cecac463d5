//! The files of a run.

use std::path::{Path, PathBuf};

use super::error::RunError;
use super::probes::{PROFILE_COLUMNS, columns, profile, unyielded, values};
use crate::geometry::Axis as Direction;
use crate::output::csv::Series;
use crate::output::picture::{self, Picture};
use crate::output::plot::{Axis, Plot, Series as Curve};
use crate::output::pvd::Collection;
use crate::output::summary::{Extrema, Summary, hash};
use crate::output::{OutputError, atomic, svg, vti};
use crate::plan::Plan;
use crate::scene::{Measure, Probe, Scene};
use crate::solver::run::{Fields, Run};
use crate::solver::setup::Setup;
use crate::units::Units;

/// Knows the folder and what has been written.
pub(super) struct Writer<'a> {
    folder: PathBuf,
    title: String,
    units: Units,
    setup: &'a Setup,
    probes: Vec<Probe>,
    series: Series,
    collection: Collection,
    written: usize,
}

impl<'a> Writer<'a> {
    pub fn new(scene: &Scene, plan: &'a Plan, folder: &Path) -> Result<Self, RunError> {
        for path in [folder.to_path_buf(), folder.join("plots")] {
            std::fs::create_dir_all(&path).map_err(|source| RunError::Folder { path, source })?;
        }
        let mut probes = scene.output.probes.clone();
        if !probes.iter().any(|probe| !columns(probe).is_empty()) {
            let probe = |name: &str, measure| Probe { name: name.to_owned(), measure };
            probes.push(probe("max_speed", Measure::MaxSpeed));
            probes.push(probe("kinetic_energy", Measure::KineticEnergy));
        }
        let named: Vec<_> = probes.iter().flat_map(columns).collect();
        let mut header = vec![("time", "s")];
        header.extend(named.iter().map(|(name, unit)| (name.as_str(), *unit)));
        Ok(Self {
            folder: folder.to_path_buf(),
            title: plan.numbers.title.clone(),
            units: plan.units,
            setup: &plan.setup,
            series: Series::new(&header),
            probes,
            collection: Collection::default(),
            written: 0,
        })
    }

    /// A file of the folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Adds a row to the time series.
    pub fn row(&mut self, run: &dyn Run, fields: &Fields) -> Result<(), RunError> {
        let mut row = vec![self.units.time_to_si(run.step() as f64)];
        for probe in &self.probes {
            row.extend(values(&probe.measure, run, fields, &self.units));
        }
        self.series.push(&row).map_err(RunError::Output)
    }

    /// Writes one set of fields and profiles, and the series so far.
    pub fn fields(&mut self, run: &dyn Run, fields: &Fields) -> Result<(), RunError> {
        let time = self.units.time_to_si(run.step() as f64);
        let name = format!("fields_{:06}.vti", self.written);
        self.image(&name, time, fields).map_err(RunError::Output)?;
        self.collection.push(time, &name);
        self.collection.write(&self.path("run.pvd")).map_err(RunError::Output)?;
        for (name, along) in self.profiles() {
            let mut table = Series::new(&PROFILE_COLUMNS);
            for row in profile(along, self.setup, fields, &self.units) {
                table.push(&row).map_err(RunError::Output)?;
            }
            let file = format!("profile_{name}_{:06}.csv", self.written);
            table.write(&self.path(&file)).map_err(RunError::Output)?;
        }
        self.written += 1;
        self.finish_series()
    }

    fn profiles(&self) -> Vec<(String, Direction)> {
        let along = |probe: &Probe| match probe.measure {
            Measure::Profile { along } => Some((probe.name.clone(), along)),
            _ => None,
        };
        self.probes.iter().filter_map(along).collect()
    }

    fn image(&self, name: &str, time: f64, fields: &Fields) -> Result<(), OutputError> {
        let units = &self.units;
        let pressure: Vec<f64> = fields.density.iter().map(|&rho| units.pressure_of_density(rho)).collect();
        let velocity: Vec<[f64; 3]> = fields.velocity.iter().map(|&u| units.velocities_to_si(u)).collect();
        let stress: Vec<[f64; 6]> =
            fields.stress.iter().map(|s| s.map(|component| units.stress_to_si(component))).collect();
        let rate: Vec<f64> = fields.shear_rate.iter().map(|&rate| units.rate_to_si(rate)).collect();
        let plug: Vec<u8> = unyielded(self.setup, fields).into_iter().map(u8::from).collect();
        let solid: Vec<u8> = self.setup.solids.iter().map(|&s| u8::from(s != 0)).collect();
        let mut image = vti::Image::new(self.setup.extents, [0.0; 3], units.dx_m)
            .time(time)
            .scalar("pressure_pa", &pressure)
            .vector("velocity_m_per_s", &velocity)
            .tensor("stress_pa", &stress)
            .scalar("shear_rate_per_s", &rate)
            .mask("unyielded", &plug);
        if !solid.is_empty() {
            image = image.mask("solid", &solid);
        }
        if !self.setup.fluid_of_cell.is_empty() {
            image = image.mask("fluid", &self.setup.fluid_of_cell);
        }
        image.write(&self.path(name))
    }

    /// Writes the series so far.
    pub fn finish_series(&self) -> Result<(), RunError> {
        self.series.write(&self.path("series.csv")).map_err(RunError::Output)
    }

    /// Series and plots at the end.
    pub fn finish(&self, fields: &Fields) -> Result<(), RunError> {
        self.finish_series()?;
        self.plots(fields).map_err(RunError::Output)
    }

    fn plots(&self, fields: &Fields) -> Result<(), OutputError> {
        for (column, about) in self.series.columns.iter().enumerate().skip(1) {
            let points = self.series.rows.iter().map(|row| [row[0], row[column]]).collect();
            let unit = if about.unit == "-" { "" } else { about.unit.as_str() };
            let plot = Plot::new(&self.title, Axis::linear("time", "s"), Axis::linear(&about.name, unit))
                .with(Curve::line(&about.name, points));
            self.svg(&format!("series_{}.svg", about.name), &svg::draw(&plot)?)?;
        }
        for (name, along) in self.profiles() {
            self.profile_plot(&name, along, fields)?;
        }
        self.speed_picture(fields)
    }

    fn profile_plot(&self, name: &str, along: Direction, fields: &Fields) -> Result<(), OutputError> {
        let rows = profile(along, self.setup, fields, &self.units);
        let x = Axis::linear(along.letter().to_string(), "m");
        let mut plot = Plot::new(format!("{}: {name}", self.title), x, Axis::linear("velocity", "m/s"));
        for (component, letter) in ["x", "y", "z"].iter().enumerate() {
            let points: Vec<[f64; 2]> = rows.iter().map(|row| [row[0], row[1 + component]]).collect();
            if points.iter().any(|point| point[1] != 0.0) || component == 0 {
                plot = plot.with(Curve::line(format!("velocity {letter}"), points));
            }
        }
        self.svg(&format!("profile_{name}.svg"), &svg::draw(&plot)?)
    }

    /// Speed in the middle plane normal to the shortest axis; not for columns and single cells.
    fn speed_picture(&self, fields: &Fields) -> Result<(), OutputError> {
        let extents = self.setup.extents;
        let normal = Direction::ALL.into_iter().rev().min_by_key(|axis| extents[axis.index()]);
        let normal = normal.unwrap_or(Direction::Z);
        let [a, b] = normal.others();
        if extents[a] < 2 || extents[b] < 2 {
            return Ok(());
        }
        let mut cells = Vec::with_capacity(extents[a] * extents[b]);
        for ib in 0..extents[b] {
            for ia in 0..extents[a] {
                let mut cell = [extents[normal.index()] / 2; 3];
                (cell[a], cell[b]) = (ia, ib);
                cells.push(self.setup.index(cell));
            }
        }
        let speed = |c: &usize| {
            let [x, y, z] = self.units.velocities_to_si(fields.velocity[*c]);
            (x * x + y * y + z * z).sqrt()
        };
        let plug = unyielded(self.setup, fields);
        let has_plug = plug.iter().any(|p| *p);
        let picture = Picture {
            title: self.title.clone(),
            label: "speed".to_owned(),
            unit: "m/s".to_owned(),
            extents: [extents[a], extents[b]],
            spacing: self.units.dx_m,
            length_unit: "m".to_owned(),
            axes: [a, b].map(|axis| Direction::ALL[axis].letter().to_string()),
            values: cells.iter().map(speed).collect(),
            solid: if self.setup.solids.is_empty() {
                Vec::new()
            } else {
                cells.iter().map(|&c| self.setup.is_solid(c)).collect()
            },
            unyielded: if has_plug { cells.iter().map(|&c| plug[c]).collect() } else { Vec::new() },
        };
        self.svg("speed.svg", &picture::draw(&picture)?)
    }

    fn svg(&self, name: &str, text: &str) -> Result<(), OutputError> {
        atomic::write(&self.folder.join("plots").join(name), text.as_bytes())
    }
}

/// The summary of a run; the caller fills in what only it knows.
pub(super) fn summary(scene: &Scene, plan: &Plan, run: &dyn Run, fields: &Fields) -> Summary {
    let fluid = |c: &usize| !plan.setup.is_solid(*c);
    let cells = 0..plan.setup.cells();
    let speed = |c: usize| {
        let [x, y, z] = plan.units.velocities_to_si(fields.velocity[c]);
        (x * x + y * y + z * z).sqrt()
    };
    Summary {
        scene: scene.file.clone(),
        // Of the scene's content: spaces and the order of keys do not count.
        scene_hash: hash(serde_json::to_string(scene).unwrap_or_default().as_bytes()),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        backend: String::new(),
        threads: 0,
        steps: run.step(),
        time_s: plan.units.time_to_si(run.step() as f64),
        wall_seconds: 0.0,
        million_updates_per_second: 0.0,
        mass_residual: 0.0,
        density: Extrema::of(cells.clone().filter(fluid).map(|c| fields.density[c])),
        speed_m_per_s: Extrema::of(cells.filter(fluid).map(speed)),
        fingerprint: run.fingerprint(),
        stopped: None,
    }
}
