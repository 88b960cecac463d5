//! The files of a run.

use std::path::{Path, PathBuf};

use super::error::RunError;
use super::grains::GrainPart;
use super::mesh::free_surface;
use super::probes::{PROFILE_COLUMNS, SECTION_COLUMNS, Sampler, columns, is_fluid, profile, unyielded};
use crate::output::csv::Series;
use crate::output::pvd::Collection;
use crate::output::summary::{Extrema, Summary, SurfaceSummary, hash};
use crate::output::{OutputError, vti, vtp};
use crate::plan::Plan;
use crate::scene::{Measure, Probe, Scene};
use crate::setup::Setup;
use crate::solver::run::{Fields, Ledger, Run};

/// Knows the folder and what has been written.
pub(super) struct Writer<'a> {
    folder: PathBuf,
    pub(super) title: String,
    pub(super) sampler: Sampler,
    pub(super) setup: &'a Setup,
    pub(super) probes: Vec<Probe>,
    pub(super) series: Series,
    pub(super) sections: Vec<Section>,
    collection: Collection,
    surfaces: Collection,
    written: usize,
    pub(super) grains: Option<GrainPart<'a>>,
}

/// A section at one time, kept for the plot at the end.
pub(super) struct Section {
    pub probe: String,
    pub time_s: f64,
    pub rows: Vec<[f64; 7]>,
}

impl<'a> Writer<'a> {
    pub fn new(scene: &Scene, plan: &'a Plan, folder: &Path) -> Result<Self, RunError> {
        for path in [folder.to_path_buf(), folder.join("plots")] {
            std::fs::create_dir_all(&path).map_err(|source| RunError::Folder { path, source })?;
        }
        let mut probes = scene.output.probes.clone();
        let with_grains = plan.grains.is_some();
        if !probes.iter().any(|probe| !columns(probe, with_grains).is_empty()) {
            let probe = |name: &str, measure| Probe { name: name.to_owned(), measure };
            probes.push(probe("max_speed", Measure::MaxSpeed));
            probes.push(probe("kinetic_energy", Measure::KineticEnergy));
        }
        let mut named: Vec<_> = probes.iter().flat_map(|probe| columns(probe, with_grains)).collect();
        let first = 1 + named.len();
        let grains = plan.grains.as_ref().map(|coupled| {
            named.extend(GrainPart::columns(coupled));
            GrainPart::new(coupled, plan.units, folder, first)
        });
        let mut header = vec![("time", "s")];
        header.extend(named.iter().map(|(name, unit)| (name.as_str(), *unit)));
        Ok(Self {
            folder: folder.to_path_buf(),
            title: plan.numbers.title.clone(),
            sampler: Sampler::new(scene, plan.units),
            setup: &plan.setup,
            series: Series::new(&header),
            probes,
            sections: Vec::new(),
            collection: Collection::default(),
            surfaces: Collection::default(),
            written: 0,
            grains,
        })
    }

    /// A file of the folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    fn time(&self, run: &dyn Run) -> f64 {
        self.sampler.units.time_to_si(run.step() as f64)
    }

    /// Adds a row to the time series.
    pub fn row(&mut self, run: &dyn Run, fields: &Fields) -> Result<(), RunError> {
        let mut row = vec![self.time(run)];
        for probe in &self.probes {
            row.extend(self.sampler.values(&probe.measure, run, fields));
            if let (Measure::Force { solid }, Some(grains)) = (&probe.measure, &self.grains) {
                row.extend(grains.contact_values(solid));
            }
        }
        let (time, upright) = (self.time(run), self.sampler.upright);
        if let Some(grains) = &mut self.grains {
            row.extend(grains.values(run, fields, upright, time));
        }
        self.series.push(&row).map_err(RunError::Output)
    }

    /// Writes one set of fields, surfaces, profiles and maps, and the series so far.
    pub fn fields(&mut self, run: &dyn Run, fields: &Fields) -> Result<(), RunError> {
        let time = self.time(run);
        let covered = run.grains().map(|grains| {
            (0..self.setup.cells()).map(|cell| u8::from(grains.is_covered(cell))).collect::<Vec<u8>>()
        });
        self.snapshot(time, fields, covered.as_deref()).map_err(RunError::Output)?;
        self.written += 1;
        self.finish_series()
    }

    /// Writes the grains.
    pub fn grains(&mut self, run: &dyn Run) -> Result<(), RunError> {
        let time = self.time(run);
        match &mut self.grains {
            Some(grains) => grains.snapshot(run, time).map_err(RunError::Output),
            None => Ok(()),
        }
    }

    /// Whether forces of contacts have to be looked at in every step.
    pub fn every_step(&self) -> bool {
        self.grains.is_some() && self.probes.iter().any(|p| matches!(p.measure, Measure::Force { .. }))
    }

    fn snapshot(&mut self, time: f64, fields: &Fields, covered: Option<&[u8]>) -> Result<(), OutputError> {
        let name = format!("fields_{:06}.vti", self.written);
        self.image(&name, time, fields, covered)?;
        self.collection.push(time, &name);
        self.collection.write(&self.path("run.pvd"))?;
        if self.setup.free_surface.is_some() {
            let name = format!("surface_{:06}.vtp", self.written);
            let mesh = free_surface(self.setup, fields, &self.sampler.units);
            vtp::write(&self.path(&name), &mesh, "velocity_m_per_s", time)?;
            self.surfaces.push(time, &name);
            self.surfaces.write(&self.path("surface.pvd"))?;
        }
        for probe in &self.probes {
            let name = &probe.name;
            let file = |kind: &str, end: &str| self.path(&format!("{kind}_{name}_{:06}.{end}", self.written));
            match probe.measure {
                Measure::Profile { along } => {
                    let rows = profile(along, self.setup, fields, &self.sampler.units);
                    table(&file("profile", "csv"), &PROFILE_COLUMNS, &rows)?;
                }
                Measure::SurfaceProfile { along, at_m, above_m } => {
                    let rows = self.sampler.section(along, at_m, above_m, self.setup, fields);
                    table(&file("section", "csv"), &SECTION_COLUMNS, &rows)?;
                    self.sections.push(Section { probe: name.clone(), time_s: time, rows });
                }
                Measure::DepthMap { above_m } => {
                    self.map(&file("depth", "vti"), time, fields, above_m)?;
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn image(
        &self,
        name: &str,
        time: f64,
        fields: &Fields,
        covered: Option<&[u8]>,
    ) -> Result<(), OutputError> {
        let units = &self.sampler.units;
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
            .time(time)
            .scalar("pressure_pa", &pressure)
            .vector("velocity_m_per_s", &velocity)
            .tensor("stress_pa", &stress)
            .scalar("shear_rate_per_s", &rate)
            .mask("unyielded", &plug);
        if !fields.kind.is_empty() {
            image = image.scalar("fill", &fields.fill).mask("kind", &fields.kind).mask("yielded", &yielded);
        }
        if let Some(covered) = covered {
            image = image.mask("covered", covered);
        }
        if !solid.is_empty() {
            image = image.mask("solid", &solid);
        }
        if !self.setup.fluid_of_cell.is_empty() {
            image = image.mask("fluid", &self.setup.fluid_of_cell);
        }
        image.write(&self.path(name))
    }

    /// Bed, depth and surface of all columns as an image of one layer.
    fn map(&self, path: &Path, time: f64, fields: &Fields, above_m: Option<f64>) -> Result<(), OutputError> {
        let upright = self.sampler.upright;
        let units = &self.sampler.units;
        let columns = upright.columns(self.setup, fields, units, above_m);
        let depth: Vec<f64> = columns.iter().map(|column| column.depth).collect();
        let bed: Vec<f64> = columns.iter().map(|column| column.bed).collect();
        let surface: Vec<f64> = columns.iter().map(|column| upright.surface(column, above_m)).collect();
        let mut extents = self.setup.extents;
        extents[upright.up.index()] = 1;
        vti::Image::new(extents, [0.0; 3], units.dx_m)
            .time(time)
            .scalar("depth_m", &depth)
            .scalar("bed_m", &bed)
            .scalar("surface_m", &surface)
            .write(path)
    }

    /// Writes the series so far.
    pub fn finish_series(&self) -> Result<(), RunError> {
        self.series.write(&self.path("series.csv")).map_err(RunError::Output)
    }
}

fn table<const N: usize>(path: &Path, header: &[(&str, &str)], rows: &[[f64; N]]) -> Result<(), OutputError> {
    let mut table = Series::new(header);
    for row in rows {
        table.push(row)?;
    }
    table.write(path)
}

/// The summary of a run; the caller fills in what only it knows.
pub(super) fn summary(scene: &Scene, plan: &Plan, run: &dyn Run, fields: &Fields) -> Summary {
    let fluid = |c: &usize| is_fluid(&plan.setup, fields, *c);
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
        free_surface: run.ledger().map(|ledger| surface_summary(plan, &ledger)),
        grains: None,
        stopped: None,
    }
}

fn surface_summary(plan: &Plan, ledger: &Ledger) -> SurfaceSummary {
    let units = &plan.units;
    let mass = units.rho0_kg_per_m3 * units.dx_m * units.dx_m * units.dx_m;
    let momentum = mass * units.velocity_unit();
    let vector = |v: [f64; 3]| v.map(|component| component * momentum);
    SurfaceSummary {
        initial_mass_kg: ledger.initial_mass * mass,
        mass_kg: ledger.mass * mass,
        outflow_kg: ledger.outflow * mass,
        from_walls_kg: ledger.from_walls * mass,
        parked_kg: ledger.parked * mass,
        mass_residual: ledger.mass_residual,
        momentum_n_s: vector(ledger.momentum),
        from_force_n_s: vector(ledger.from_force),
        from_faces_n_s: vector(ledger.from_faces),
        from_solids_n_s: vector(ledger.from_solids),
        from_gas_n_s: vector(ledger.from_gas),
        from_grains_n_s: vector(ledger.from_grains),
        from_grains_kg: ledger.mass_from_grains * mass,
        from_conversions_n_s: vector(ledger.from_conversions),
        momentum_residual_n_s: ledger.momentum_residual * momentum,
        liquid_cells: ledger.liquid_cells,
        interface_cells: ledger.interface_cells,
        conversions: ledger.conversions,
    }
}
