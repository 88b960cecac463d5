//! What a run writes about the grains in its fluid.

use std::path::Path;

use super::columns::Upright;
use crate::coupling::Immersed;
use crate::dem::{Setup as GrainSetup, V3, keep_marked};
use crate::output::OutputError;
use crate::output::csv::Series;
use crate::output::summary::CoupledSummary;
use crate::plan::coupled::Coupled;
use crate::run_grains::pictures::series_plots;
use crate::run_grains::probes::{Sampler, columns, probes};
use crate::run_grains::writer::{Files, groups};
use crate::run_grains::{View, fingerprint, leave};
use crate::scene::dry::GrainMeasure;
use crate::setup::{Face, Setup};
use crate::solver::run::{Fields, Run};
use crate::units::Units;

/// Force of contacts and lubrication on a solid since the last row, and since time 0.
#[derive(Clone, Copy, Debug, Default)]
struct Contacts {
    /// Sum over steps, N.
    sum: V3,
    steps: u64,
    /// Largest, N.
    peak: f64,
    /// N s.
    impulse: V3,
}

/// Columns of the contact part of a `force` probe: mean and largest force since the last row, impulse since time 0.
pub(super) const CONTACT_COLUMNS: [(&str, &str); 7] = [
    ("contact_x", "N"),
    ("contact_y", "N"),
    ("contact_z", "N"),
    ("contact_peak", "N"),
    ("contact_impulse_x", "N s"),
    ("contact_impulse_y", "N s"),
    ("contact_impulse_z", "N s"),
];

/// Files, probes and books of the grains of a run.
pub(super) struct GrainPart<'a> {
    coupled: &'a Coupled,
    units: Units,
    files: Files<'a>,
    sampler: Option<Sampler>,
    /// The set-up of the grains still there.
    setup: GrainSetup,
    /// Number at time 0 of each grain still there.
    ids: Vec<u32>,
    /// Number, mass (kg) and energy (J) of the grains that have left.
    left: (u64, f64, f64),
    /// Energy balance at time 0, J.
    start: f64,
    /// Of every solid.
    contacts: Vec<Contacts>,
    /// Column of the series at which the grains' own begin.
    first: usize,
}

impl<'a> GrainPart<'a> {
    /// `first`: column of the series at which the grains' own begin.
    pub fn new(coupled: &'a Coupled, units: Units, folder: &Path, first: usize) -> Self {
        let count = coupled.grains.setup.grains.len() as u32;
        Self {
            coupled,
            units,
            files: Files::new(&coupled.scene, &coupled.grains, folder),
            sampler: None,
            setup: coupled.grains.setup.clone(),
            ids: (0..count).collect(),
            left: (0, 0.0, 0.0),
            start: 0.0,
            contacts: vec![Contacts::default(); coupled.grains.walls.solids.len()],
            first,
        }
    }

    /// Names and units of the grains' columns.
    pub fn columns(coupled: &Coupled) -> Vec<(String, &'static str)> {
        probes(&coupled.scene).iter().flat_map(columns).collect()
    }

    fn view<'b>(&'b self, grains: &'b Immersed, time: f64) -> View<'b> {
        View {
            dem: grains.dem(),
            setup: &self.setup,
            ids: &self.ids,
            left: self.left,
            start: self.start,
            time,
        }
    }

    /// Takes the state at time 0.
    pub fn begin(&mut self, run: &dyn Run) {
        let Some(grains) = run.grains() else { return };
        self.start = grains.dem().energies().balance();
        let sampler = Sampler::new(&self.coupled.scene, &self.coupled.grains, &self.view(grains, 0.0));
        self.sampler = Some(sampler);
    }

    /// Whether grains can leave.
    pub fn has_open_faces(&self) -> bool {
        self.coupled.grains.open.iter().flatten().any(|open| *open)
    }

    /// Takes out the free grains that are wholly beyond an open face.
    pub fn take_out(&mut self, run: &mut dyn Run) {
        let dem = run.grains().map(Immersed::dem);
        let found = dem.and_then(|dem| {
            let stays = leave::leaving(dem, &self.setup, &self.coupled.scene, &self.coupled.grains)?;
            Some((leave::count(dem, &stays), dem.energies().balance(), stays))
        });
        let Some(((number, mass), before, stays)) = found else { return };
        run.leave(&stays);
        keep_marked(&mut self.setup.grains, &stays);
        keep_marked(&mut self.ids, &stays);
        let after = run.grains().map_or(0.0, |grains| grains.dem().energies().balance());
        self.left = (self.left.0 + number, self.left.1 + mass, self.left.2 + (before - after));
    }

    /// Number at time 0 of a grain.
    pub fn number(&self, grain: u32) -> u32 {
        self.ids.get(grain as usize).copied().unwrap_or(grain)
    }

    /// Adds up the forces of contacts and of the gaps before them in a step.
    pub fn sample(&mut self, run: &dyn Run) {
        let Some(grains) = run.grains() else { return };
        for (of, (_, walls)) in self.contacts.iter_mut().zip(&self.coupled.grains.walls.solids) {
            let on = |wall: usize| grains.dem().force_on_wall(wall).0 + grains.lubrication_on_wall(wall);
            let force = walls.iter().fold(V3::zeros(), |sum, &wall| sum + on(wall));
            of.sum += force;
            of.steps += 1;
            of.peak = of.peak.max(force.norm());
            of.impulse += force * self.units.dt_s;
        }
    }

    /// The contact part of a `force` probe.
    pub fn contact_values(&self, solid: &str) -> [f64; 7] {
        let solids = &self.coupled.grains.walls.solids;
        let of = solids.iter().position(|(name, _)| name == solid).and_then(|k| self.contacts.get(k));
        let of = of.copied().unwrap_or_default();
        let mean = of.sum / of.steps.max(1) as f64;
        [mean.x, mean.y, mean.z, of.peak, of.impulse.x, of.impulse.y, of.impulse.z]
    }

    /// Values of the grains' columns; means of contacts start anew.
    pub fn values(&mut self, run: &dyn Run, fields: &Fields, upright: Upright, time: f64) -> Vec<f64> {
        for of in &mut self.contacts {
            *of = Contacts { impulse: of.impulse, ..Contacts::default() };
        }
        let (Some(grains), Some(mut sampler)) = (run.grains(), self.sampler.take()) else {
            return Vec::new();
        };
        let units = self.units;
        let force = units.force_unit() * units.dx_m * units.dx_m * units.dx_m;
        let around = |measure: &GrainMeasure, grain: usize| match measure {
            GrainMeasure::FluidForce { .. } => {
                let load =
                    grains.loads().get(grain).map(crate::coupling::BodyLoad::total).unwrap_or_default();
                let contact = grains.contact_loads().get(grain).copied().unwrap_or_default();
                let mut row: Vec<f64> = load[..3].iter().chain(&contact[..3]).map(|f| f * force).collect();
                row.extend(load[3..].iter().map(|t| t * force * units.dx_m));
                row
            }
            GrainMeasure::Submergence { .. } => {
                vec![depth(run.setup(), fields, &units, upright, grains, grain)]
            }
            _ => Vec::new(),
        };
        let row = sampler.values(&self.view(grains, time), &around);
        self.sampler = Some(sampler);
        row
    }

    /// Writes grains, contacts and walls.
    pub fn snapshot(&mut self, run: &dyn Run, time: f64) -> Result<(), OutputError> {
        let Some(grains) = run.grains() else { return Ok(()) };
        // The files are borrowed apart from what the view borrows.
        let view = View {
            dem: grains.dem(),
            setup: &self.setup,
            ids: &self.ids,
            left: self.left,
            start: self.start,
            time,
        };
        self.files.snapshot(&view)
    }

    /// Tables a scene can start from, and pictures.
    pub fn finish(&self, run: &dyn Run, time: f64, series: &Series, title: &str) -> Result<(), OutputError> {
        let Some(grains) = run.grains() else { return Ok(()) };
        let view = self.view(grains, time);
        self.files.tables(&view)?;
        let plots = self.files.folder().join("plots");
        series_plots(&plots, title, series, &groups(&self.coupled.scene), self.first)?;
        self.files.picture(&view)
    }

    /// Largest speed of a free grain, m/s.
    pub fn max_speed(&self, run: &dyn Run) -> f64 {
        run.grains().map_or(0.0, |grains| self.view(grains, 0.0).max_speed())
    }

    /// The books.
    pub fn summary(&self, run: &dyn Run) -> Option<CoupledSummary> {
        let grains = run.grains()?;
        let units = &self.units;
        let view = self.view(grains, units.time_to_si(run.step() as f64));
        let mass = units.rho0_kg_per_m3 * units.dx_m * units.dx_m * units.dx_m;
        let momentum = mass * units.velocity_unit();
        let vector = |v: [f64; 3]| v.map(|x| x * momentum);
        let books = grains.books();
        let ledger = run.ledger().unwrap_or_default();
        let [links, covered, freed] = books.masses().map(|m| m * mass);
        let [link_momentum, covered_momentum, freed_momentum] = books.momenta().map(vector);
        let own = grains.dem().ledger();
        Some(CoupledSummary {
            grains: view.free().count(),
            left: self.left.0,
            left_kg: self.left.1,
            driven: grains.dem().bodies().driven.len(),
            sub_steps: grains.config().sub_steps,
            mass_kg: own.mass,
            momentum_n_s: own.momentum.into(),
            max_speed_m_per_s: view.max_speed(),
            contacts: grains.dem().pair_counts().1,
            covered_cells: grains.covered_cells(None),
            cells_covered: books.covered,
            cells_freed: books.freed,
            mass_from_grains_kg: ledger.mass_from_grains * mass,
            mass_over_links_kg: links,
            mass_covered_kg: covered,
            mass_freed_kg: freed,
            from_grains_n_s: vector(ledger.from_grains),
            over_links_n_s: link_momentum,
            covered_n_s: covered_momentum,
            freed_n_s: freed_momentum,
            gradient_pa_per_m: grains.gradient().map(|g| units.force_to_si(g)),
            energies_j: grains.dem().energies(),
            unexplained_j: view.unexplained(),
            fingerprint: fingerprint(grains.dem()).hash,
        })
    }
}

/// Depth of a grain's centre below the mean surface of the columns around it, m.
fn depth(
    setup: &Setup,
    fields: &Fields,
    units: &Units,
    upright: Upright,
    grains: &Immersed,
    grain: usize,
) -> f64 {
    let centre = grains.centre(grain);
    let bodies = grains.dem().bodies();
    let radius = bodies.radius.get(grain).map_or(0.0, |r| units.length_to_lattice(*r));
    let [a, b] = upright.across();
    let n = setup.extents;
    let off = |k: usize, axis: usize| {
        let d = k as f64 + 0.5 - centre[axis];
        let length = n[axis] as f64;
        if setup.faces[axis][0] == Face::Periodic { d - length * (d / length).round() } else { d }
    };
    let (mut sum, mut count) = (0.0, 0.0);
    for ib in 0..n[b] {
        for ia in 0..n[a] {
            let (da, db) = (off(ia, a), off(ib, b));
            let distance = (da * da + db * db).sqrt();
            // A ring beyond the grain, two cells wide.
            if distance < radius + 1.0 || distance > radius + 3.0 {
                continue;
            }
            let mut cell = [0; 3];
            (cell[a], cell[b]) = (ia, ib);
            let column = upright.column(setup, fields, units, None, cell);
            if column.depth > 0.0 {
                sum += upright.surface(&column, None);
                count += 1.0;
            }
        }
    }
    if count == 0.0 {
        return f64::NAN;
    }
    let height = units.length_to_si(centre[upright.up.index()]);
    if upright.down_is_low { sum / count - height } else { height - sum / count }
}
