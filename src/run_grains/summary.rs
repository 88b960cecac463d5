//! `summary.json` of a run without fluid.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::{Ending, GrainsFinished, View};
use crate::dem::{Dem, Energies};
use crate::fingerprint::Hasher;
use crate::output::number;
use crate::output::summary::hash;
use crate::output::{OutputError, atomic};
use crate::scene::dry::DryScene;

/// The run at its end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GrainSummary {
    /// Name of the scene.
    pub scene: String,
    /// Hash of the scene's content.
    pub scene_hash: String,
    /// Version of lahar.
    pub version: String,
    /// Worker threads.
    pub threads: usize,
    /// Steps taken.
    pub steps: u64,
    /// Simulated time.
    #[serde(with = "number")]
    pub time_s: f64,
    /// `end_time`, `at_rest` or `empty`.
    pub ended: String,
    /// Wall-clock time of the stepping.
    #[serde(with = "number")]
    pub wall_seconds: f64,
    /// Million sphere updates per second.
    #[serde(with = "number")]
    pub million_updates_per_second: f64,
    /// Free grains in the box.
    pub grains: usize,
    /// Driven grains.
    pub driven: usize,
    /// Grains that left through open faces.
    pub left: u64,
    /// Their mass.
    #[serde(with = "number")]
    pub left_kg: f64,
    /// Mass of the free grains.
    #[serde(with = "number")]
    pub mass_kg: f64,
    /// Momentum of the free grains.
    pub momentum_n_s: [f64; 3],
    /// Largest speed of a free grain.
    #[serde(with = "number")]
    pub max_speed_m_per_s: f64,
    /// Touching pairs of grains.
    pub contacts: usize,
    /// Where the energy is and went, J.
    pub energies_j: Energies,
    /// What the energy balance changed by since time 0, over what was lost and the largest part of the energy.
    #[serde(with = "number")]
    pub energy_residual: f64,
    /// Lists of neighbours made.
    pub lists: u64,
    /// Hash of the final state.
    pub fingerprint: GrainFingerprint,
    /// Why a guard stopped the run, if one did.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stopped: Option<String>,
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

/// Fingerprint of a state.
#[must_use]
pub fn fingerprint(dem: &Dem) -> GrainFingerprint {
    let (b, mut hasher) = (dem.bodies(), Hasher::default());
    for i in 0..b.len() {
        let q = b.orientation[i].coords;
        let vectors = [b.position[i], b.velocity[i], b.spin[i]];
        for x in vectors.iter().flat_map(|v| v.iter()).chain(q.iter()) {
            hasher.number(*x);
        }
    }
    GrainFingerprint { step: dem.steps(), hash: hasher.finish(), kinetic_energy_j: dem.kinetic_energy() }
}

pub(super) fn summary(
    scene: &DryScene,
    grains: &View<'_>,
    finished: &GrainsFinished,
    threads: usize,
    stopped: Option<String>,
) -> GrainSummary {
    let dem = grains.dem;
    let (ledger, energies) = (dem.ledger(), dem.energies());
    let scale = [energies.lost(), energies.kinetic + energies.rotational, energies.potential.abs()];
    let scale = scale.into_iter().fold(0.0, f64::max);
    let unexplained = grains.unexplained();
    GrainSummary {
        scene: scene.file.clone(),
        scene_hash: hash(serde_json::to_string(scene).unwrap_or_default().as_bytes()),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        threads,
        steps: finished.steps,
        time_s: finished.time_s,
        ended: match (&stopped, finished.why) {
            (Some(_), _) => "stopped",
            (None, Ending::EndTime) => "end_time",
            (None, Ending::AtRest) => "at_rest",
            (None, Ending::Empty) => "empty",
        }
        .to_owned(),
        wall_seconds: finished.wall_seconds,
        million_updates_per_second: finished.million_updates_per_second,
        grains: grains.free().count(),
        driven: dem.bodies().driven.len(),
        left: grains.left.0,
        left_kg: grains.left.1,
        mass_kg: ledger.mass,
        momentum_n_s: ledger.momentum.into(),
        max_speed_m_per_s: grains.max_speed(),
        contacts: dem.pair_counts().1,
        energies_j: energies,
        energy_residual: if scale > 0.0 { unexplained / scale } else { unexplained },
        lists: dem.list_renewals(),
        fingerprint: fingerprint(dem),
        stopped,
    }
}

impl GrainSummary {
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
    /// I/O, or not a summary of this kind.
    pub fn read(path: &Path) -> Result<Self, OutputError> {
        let io = |source| OutputError::Io { path: path.to_path_buf(), doing: "read", source };
        let text = std::fs::read_to_string(path).map_err(io)?;
        serde_json::from_str(&text).map_err(|source| OutputError::Json { path: path.to_path_buf(), source })
    }
}
