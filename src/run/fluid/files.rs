//! Files of a fluid: fields, surfaces, profiles, sections and maps.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::mesh::free_surface;
use crate::output::csv::Series;
use crate::output::pvd::Collection;
use crate::output::{OutputError, vti, vtp};
use crate::run::folder::Folder;
use crate::run::measure::fields::{PROFILE_COLUMNS, is_fluid, profile, unyielded};
use crate::run::measure::fluid::{Frame, SECTION_COLUMNS};
use crate::scene::{FieldChoice, FieldName, FieldPrecision, Measure, Probe};
use crate::setup::Setup;
use crate::solver::run::Fields;
use crate::state::{State, StateError, Tape, state};

/// Knows what has been written.
pub(super) struct Files<'a> {
    folder: Arc<Folder>,
    setup: &'a Setup,
    pub sections: Vec<Section>,
    collection: Collection,
    surfaces: Collection,
    written: usize,
    choice: FieldChoice,
}

/// A section at one time, kept for the plot at the end.
#[derive(Default)]
pub(super) struct Section {
    pub probe: String,
    pub time_s: f64,
    pub rows: Vec<[f64; 7]>,
}

state!(Section: probe time_s rows);

impl State for Files<'_> {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let Self { sections, collection, surfaces, written, folder: _, setup: _, choice: _ } = self;
        sections.state(tape)?;
        collection.state(tape)?;
        surfaces.state(tape)?;
        written.state(tape)
    }
}

/// A fluid at one time.
#[derive(Clone, Copy)]
pub(super) struct Shot<'a> {
    pub time_s: f64,
    pub fields: &'a Fields,
    pub frame: &'a Frame,
    /// Whether grains cover each cell; `None` without grains.
    pub covered: Option<&'a [u8]>,
}

impl<'a> Files<'a> {
    pub fn new(setup: &'a Setup, choice: FieldChoice, folder: Arc<Folder>) -> Self {
        Self {
            folder,
            setup,
            sections: Vec::new(),
            collection: Collection::default(),
            surfaces: Collection::default(),
            written: 0,
            choice,
        }
    }

    fn path(&self, name: &str) -> Result<PathBuf, OutputError> {
        self.folder.file(name)
    }

    /// Fields, the surface, and what probes write into files.
    ///
    /// # Errors
    /// I/O.
    pub(crate) fn snapshot<'b>(
        &mut self,
        shot: &Shot<'_>,
        probes: impl Iterator<Item = &'b Probe>,
    ) -> Result<(), OutputError> {
        let name = format!("fields_{:06}.vti", self.written);
        self.image(&name, shot)?;
        self.collection.push(shot.time_s, &name);
        self.collection.write(&self.path("run.pvd")?)?;
        if self.setup.free_surface.is_some() {
            let name = format!("surface_{:06}.vtp", self.written);
            let mesh = free_surface(self.setup, shot.fields, &shot.frame.units);
            vtp::write(&self.path(&name)?, &mesh, "velocity_m_per_s", shot.time_s)?;
            self.surfaces.push(shot.time_s, &name);
            self.surfaces.write(&self.path("surface.pvd")?)?;
        }
        for probe in probes {
            self.probe(probe, shot)?;
        }
        self.written += 1;
        Ok(())
    }

    /// What a probe writes into a file of its own, if it does.
    fn probe(&mut self, probe: &Probe, shot: &Shot<'_>) -> Result<(), OutputError> {
        let (name, frame, fields) = (&probe.name, shot.frame, shot.fields);
        let file = |kind: &str, end: &str| self.path(&format!("{kind}_{name}_{:06}.{end}", self.written));
        match probe.measure {
            Measure::Profile { along } => {
                let rows = profile(along, self.setup, fields, &frame.units);
                table(&file("profile", "csv")?, &PROFILE_COLUMNS, &rows)
            }
            Measure::SurfaceProfile { along, at_m, above_m } => {
                let rows = frame.section(along, at_m, above_m, self.setup, fields);
                table(&file("section", "csv")?, &SECTION_COLUMNS, &rows)?;
                self.sections.push(Section { probe: name.clone(), time_s: shot.time_s, rows });
                Ok(())
            }
            Measure::DepthMap { above_m } => self.map(&file("depth", "vti")?, shot, above_m),
            _ => Ok(()),
        }
    }

    fn image(&self, name: &str, shot: &Shot<'_>) -> Result<(), OutputError> {
        let (units, fields) = (&shot.frame.units, shot.fields);
        let fluid: Vec<bool> = (0..self.setup.cells()).map(|c| is_fluid(self.setup, fields, c)).collect();
        let pressure: Vec<f64> = (fields.density.iter().zip(&fluid))
            .map(|(&rho, &fluid)| if fluid { units.pressure_of_density(rho) } else { 0.0 })
            .collect();
        let velocity: Vec<[f64; 3]> = fields.velocity.iter().map(|&u| units.velocities_to_si(u)).collect();
        let stress: Vec<[f64; 6]> =
            fields.stress.iter().map(|s| s.map(|component| units.stress_to_si(component))).collect();
        let rate: Vec<f64> = fields.shear_rate.iter().map(|&rate| units.rate_to_si(rate)).collect();
        let plug = unyielded(self.setup, fields);
        let yielded: Vec<u8> = plug.iter().zip(&fluid).map(|(&p, &f)| u8::from(f && !p)).collect();
        let plug: Vec<u8> = plug.into_iter().map(u8::from).collect();
        let solid: Vec<u8> = self.setup.solids.iter().map(|&s| u8::from(s != 0)).collect();
        let mut image = vti::Image::new(self.setup.extents, [0.0; 3], units.dx_m)
            .time(shot.time_s)
            .window(self.choice.cells.clone())
            .single(self.choice.precision == FieldPrecision::Single);
        for field in FieldName::ALL.into_iter().filter(|field| self.choice.names.contains(field)) {
            image = match field {
                FieldName::Pressure => image.scalar("pressure_pa", &pressure),
                FieldName::Velocity => image.vector("velocity_m_per_s", &velocity),
                FieldName::Stress => image.tensor("stress_pa", &stress),
                FieldName::ShearRate => image.scalar("shear_rate_per_s", &rate),
                FieldName::Unyielded => image.mask("unyielded", &plug),
                FieldName::Fill | FieldName::Kind | FieldName::Yielded if fields.kind.is_empty() => image,
                FieldName::Fill => image.scalar("fill", &fields.fill),
                FieldName::Kind => image.mask("kind", &fields.kind),
                FieldName::Yielded => image.mask("yielded", &yielded),
                FieldName::Covered => {
                    shot.covered.into_iter().fold(image, |image, c| image.mask("covered", c))
                }
                FieldName::Solid => image.mask("solid", &solid),
                FieldName::Fluid => image.mask("fluid", &self.setup.fluid_of_cell),
            };
        }
        image.write(&self.path(name)?)
    }

    /// Bed, depth and surface of all columns as an image of one layer.
    fn map(&self, path: &Path, shot: &Shot<'_>, above_m: Option<f64>) -> Result<(), OutputError> {
        let (upright, units) = (shot.frame.upright, &shot.frame.units);
        let columns = upright.columns(self.setup, shot.fields, units, above_m);
        let depth: Vec<f64> = columns.iter().map(|column| column.depth).collect();
        let bed: Vec<f64> = columns.iter().map(|column| column.bed).collect();
        let surface: Vec<f64> = columns.iter().map(|column| upright.surface(column, above_m)).collect();
        let mut extents = self.setup.extents;
        extents[upright.up.index()] = 1;
        vti::Image::new(extents, [0.0; 3], units.dx_m)
            .time(shot.time_s)
            .scalar("depth_m", &depth)
            .scalar("bed_m", &bed)
            .scalar("surface_m", &surface)
            .write(path)
    }
}

fn table<const N: usize>(path: &Path, header: &[(&str, &str)], rows: &[[f64; N]]) -> Result<(), OutputError> {
    let mut table = Series::new(header);
    for row in rows {
        table.push(row)?;
    }
    table.write(path)
}
