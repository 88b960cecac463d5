//! `summary.json`: what a run was at its end, in numbers; from its start on, that it is under way. One shape for every kind of scene.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::load_summary::LoadSummary;
use super::rest::RestOutcome;
use crate::dem::Energies;
use crate::fingerprint::Fingerprint;
use crate::output::{OutputError, atomic, number};

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ended {
    /// At its end time.
    EndTime,
    /// Nothing changed any more.
    Steady,
    /// Everything had come to rest.
    AtRest,
    /// All grains had left through open faces, and there is no fluid.
    Empty,
    /// A guard stopped it.
    Stopped,
    /// Somebody asked it to end.
    Interrupted,
    /// A file could not be written.
    OutputFailed,
    /// It has not ended: it is under way, or was ended from outside.
    Running,
}

impl Ended {
    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::EndTime => "end time",
            Self::Steady => "steady",
            Self::AtRest => "at rest",
            Self::Empty => "all grains have left",
            Self::Stopped => "stopped",
            Self::Interrupted => "interrupted",
            Self::OutputFailed => "an output failed",
            Self::Running => "running",
        }
    }
}

/// The run at its end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Name of the scene.
    pub scene: String,
    /// [`hash`] of the scene's content: spaces and the order of keys do not count.
    pub scene_hash: String,
    /// Version of lahar.
    pub version: String,
    /// Backend that ran the fluid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub backend: Option<String>,
    /// Worker threads.
    pub threads: usize,
    /// Steps taken.
    pub steps: u64,
    /// Simulated time.
    #[serde(with = "number")]
    pub time_s: f64,
    /// How it ended.
    pub ended: Ended,
    /// Wall-clock time of the stepping.
    #[serde(with = "number")]
    pub wall_seconds: f64,
    /// Million updates per second: of fluid cells (MLUPS), without fluid of spheres.
    #[serde(with = "number")]
    pub million_updates_per_second: f64,
    /// What was moved.
    #[serde(flatten)]
    pub parts: Parts,
    /// What still changed at the end of a run that was to become steady and did not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub not_steady: Option<String>,
    /// What the checks for rest found; only with `stop.arrested`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rest: Option<RestOutcome>,
    /// Loads on solids and walls, one entry per `force` or `torque` probe.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub loads: Vec<LoadSummary>,
    /// Why a guard stopped the run, or which file could not be written.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stopped: Option<String>,
}

/// What a run moved. The part of the fluid, or of grains without one, stands at the top of the file; that of grains in a
/// fluid stands under `grains`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Parts {
    /// A fluid, and the grains in it if there are any.
    Fluid(Box<FluidPart>),
    /// Grains without fluid.
    Dry(Box<DryPart>),
}

/// The fluid at the end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FluidPart {
    /// Relative change of total mass since the start.
    #[serde(with = "number")]
    pub mass_residual: f64,
    /// Density relative to the reference density.
    pub density: Extrema,
    /// Speed.
    pub speed_m_per_s: Extrema,
    /// Hash and digest of the final state.
    pub fingerprint: Fingerprint,
    /// The ledger; only with a free surface or grains.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub free_surface: Option<SurfaceSummary>,
    /// The grains; only with grains.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grains: Option<CoupledPart>,
}

/// Grains without fluid at the end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DryPart {
    /// What is said of grains with or without a fluid.
    #[serde(flatten)]
    pub grains: GrainPart,
    /// What the energy balance changed by since time 0, over what was lost and the largest part of the energy.
    #[serde(with = "number")]
    pub energy_residual: f64,
    /// Lists of neighbours made.
    pub lists: u64,
    /// Hash of the final state.
    pub fingerprint: GrainFingerprint,
}

/// Grains in a fluid at the end, and what went between the two.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CoupledPart {
    /// What is said of grains with or without a fluid; the fluid's work is part of the external work.
    #[serde(flatten)]
    pub grains: GrainPart,
    /// What went between grains and fluid.
    #[serde(flatten)]
    pub coupling: CouplingPart,
    /// What the energy balance of the grains changed by since time 0, J.
    #[serde(with = "number")]
    pub unexplained_j: f64,
    /// Hash of the grains' final state.
    pub fingerprint: String,
}

/// Grains at the end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GrainPart {
    /// Free grains in the box.
    #[serde(rename = "grains")]
    pub number: usize,
    /// Driven grains.
    pub driven: usize,
    /// Grains that left through open faces.
    pub left: u64,
    /// Their mass, kg.
    #[serde(with = "number")]
    pub left_kg: f64,
    /// Mass of the free grains, kg.
    #[serde(with = "number")]
    pub mass_kg: f64,
    /// Momentum of the free grains, N s.
    pub momentum_n_s: [f64; 3],
    /// Largest speed of a free grain.
    #[serde(with = "number")]
    pub max_speed_m_per_s: f64,
    /// Touching pairs of grains.
    pub contacts: usize,
    /// Where the energy is and went, J.
    pub energies_j: Energies,
}

/// Equal fingerprints: equal bits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GrainFingerprint {
    /// Steps taken.
    pub step: u64,
    /// FNV-1a (64 bit) over the raw bits of positions, velocities, spins and orientations, grain by grain.
    pub hash: String,
    /// Kinetic energy, J.
    #[serde(with = "number")]
    pub kinetic_energy_j: f64,
}

/// What went between grains and fluid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CouplingPart {
    /// Steps of the grains in a step of the fluid.
    pub sub_steps: u32,
    /// Cells covered at the end.
    pub covered_cells: u64,
    /// Cells with fluid that grains covered during the run.
    pub cells_covered: u64,
    /// Cells that grains gave free to fluid.
    pub cells_freed: u64,
    /// Mass that the fluid got from grains, kg: the sum of the next three with their signs.
    #[serde(with = "number")]
    pub mass_from_grains_kg: f64,
    /// Over links, kg.
    #[serde(with = "number")]
    pub mass_over_links_kg: f64,
    /// Taken by covering cells, kg.
    #[serde(with = "number")]
    pub mass_covered_kg: f64,
    /// Given back with freed cells, kg.
    #[serde(with = "number")]
    pub mass_freed_kg: f64,
    /// Momentum that the fluid got from grains, N s.
    pub from_grains_n_s: [f64; 3],
    /// Over links, N s.
    pub over_links_n_s: [f64; 3],
    /// Taken by covering cells, N s.
    pub covered_n_s: [f64; 3],
    /// Given back with freed cells, N s.
    pub freed_n_s: [f64; 3],
    /// Uniform pressure gradient that balances the weight, −∇P, Pa/m.
    pub gradient_pa_per_m: [f64; 3],
}

/// Where the mass and momentum of a flow with a free surface are, and where they came from and went.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SurfaceSummary {
    /// Mass at time 0, kg.
    #[serde(with = "number")]
    pub initial_mass_kg: f64,
    /// Mass at the end, kg.
    #[serde(with = "number")]
    pub mass_kg: f64,
    /// Mass that left through open faces, kg.
    #[serde(with = "number")]
    pub outflow_kg: f64,
    /// Mass that came in at walls, kg: rounding, part of `mass_residual`.
    #[serde(with = "number")]
    pub from_walls_kg: f64,
    /// Mass that has no cell at the moment, kg; part of `mass_kg`.
    #[serde(with = "number")]
    pub parked_kg: f64,
    /// Volume missing in partly filled cells without gas neighbour, m³.
    #[serde(default, with = "number")]
    pub voids_m3: f64,
    /// (mass + outflow − from grains − initial)/initial.
    #[serde(with = "number")]
    pub mass_residual: f64,
    /// Momentum at the end, N s.
    pub momentum_n_s: [f64; 3],
    /// Momentum brought in by gravity and body force, N s.
    pub from_force_n_s: [f64; 3],
    /// Momentum brought in by walls and mirror planes of the box, N s.
    pub from_faces_n_s: [f64; 3],
    /// Momentum brought in by solids, N s.
    pub from_solids_n_s: [f64; 3],
    /// Momentum brought in at the surface, N s.
    pub from_gas_n_s: [f64; 3],
    /// Momentum brought in by grains, N s.
    #[serde(default)]
    pub from_grains_n_s: [f64; 3],
    /// Mass that came from grains, kg.
    #[serde(default, with = "number")]
    pub from_grains_kg: f64,
    /// Momentum brought in by cells that became fluid, less what others took, N s.
    pub from_conversions_n_s: [f64; 3],
    /// Largest component of what the terms above leave unexplained, N s.
    #[serde(with = "number")]
    pub momentum_residual_n_s: f64,
    /// Full cells.
    pub liquid_cells: u64,
    /// Partly filled cells.
    pub interface_cells: u64,
    /// Cells that changed kind during the run.
    pub conversions: u64,
}

/// Range of a field over the fluid cells.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Extrema {
    /// Least value.
    #[serde(with = "number")]
    pub least: f64,
    /// Greatest value.
    #[serde(with = "number")]
    pub greatest: f64,
}

impl Extrema {
    /// Range of the values; (∞, −∞) if there is none. NaN spreads, so that it shows.
    #[must_use]
    pub fn of(values: impl Iterator<Item = f64>) -> Self {
        let none = Self { least: f64::INFINITY, greatest: f64::NEG_INFINITY };
        values.fold(none, |e, v| Self {
            least: if e.least <= v || e.least.is_nan() { e.least } else { v },
            greatest: if e.greatest >= v || e.greatest.is_nan() { e.greatest } else { v },
        })
    }
}

impl Summary {
    /// The part of the fluid, if there is one.
    #[must_use]
    pub fn fluid(&self) -> Option<&FluidPart> {
        match &self.parts {
            Parts::Fluid(fluid) => Some(fluid),
            Parts::Dry(_) => None,
        }
    }

    /// What is said of grains with or without a fluid, if there are any.
    #[must_use]
    pub fn grains(&self) -> Option<&GrainPart> {
        match &self.parts {
            Parts::Fluid(fluid) => fluid.grains.as_ref().map(|coupled| &coupled.grains),
            Parts::Dry(dry) => Some(&dry.grains),
        }
    }

    /// What went between grains and fluid, if there are both.
    #[must_use]
    pub fn coupling(&self) -> Option<&CouplingPart> {
        self.fluid()?.grains.as_ref().map(|coupled| &coupled.coupling)
    }

    /// The part of grains without fluid, if there is none.
    #[must_use]
    pub fn dry(&self) -> Option<&DryPart> {
        match &self.parts {
            Parts::Fluid(_) => None,
            Parts::Dry(dry) => Some(dry),
        }
    }

    /// Writes the summary as indented JSON.
    ///
    /// # Errors
    /// I/O.
    pub fn write(&self, path: &Path) -> Result<(), OutputError> {
        let json = |source| OutputError::Json { path: path.to_path_buf(), source };
        let mut text = serde_json::to_string_pretty(self).map_err(json)?;
        text.push('\n');
        atomic::write(path, text.as_bytes())
    }

    /// Reads a summary.
    ///
    /// # Errors
    /// I/O, or not a summary.
    pub fn read(path: &Path) -> Result<Self, OutputError> {
        let text = std::fs::read_to_string(path).map_err(|source| OutputError::Io {
            path: path.to_path_buf(),
            doing: "read",
            source,
        })?;
        serde_json::from_str(&text).map_err(|source| OutputError::Json { path: path.to_path_buf(), source })
    }
}

/// Hash of a scene's content: spaces and the order of keys in its file do not count.
pub(super) fn hash_of(scene: &impl Serialize) -> String {
    hash(serde_json::to_string(scene).unwrap_or_default().as_bytes())
}

/// FNV-1a (64 bit) of some bytes, 16 hex digits.
#[must_use]
pub fn hash(bytes: &[u8]) -> String {
    let fnv = |h: u64, &b: &u8| (h ^ u64::from(b)).wrapping_mul(0x0000_0100_0000_01b3);
    format!("{:016x}", bytes.iter().fold(0xcbf2_9ce4_8422_2325, fnv))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hash_is_the_published_fnv1a() {
        // Test vectors of the FNV reference code (draft-eastlake-fnv, appendix C).
        assert_eq!(hash(b""), "cbf29ce484222325");
        assert_eq!(hash(b"a"), "af63dc4c8601ec8c");
        assert_eq!(hash(b"foobar"), "85944171f73967e8");
    }

    #[test]
    fn extrema_show_nan() {
        let e = Extrema::of([1.0, -2.0, 3.0].into_iter());
        assert_eq!((e.least, e.greatest), (-2.0, 3.0));
        assert!(Extrema::of([1.0, f64::NAN, 3.0].into_iter()).greatest.is_nan());
    }
}
