//! A scene with grains in a fluid, seen by the grains alone, and what becomes of the weight of both.

use super::dry::{DryDomain, DryScene, GrainOutput, GrainSolid, GrainStop};
use super::force::gravity_vector;
use super::{Boundary, Coupling, Scene};

impl Scene {
    /// The scene as its grains see it; `None` without grains.
    #[must_use]
    pub(crate) fn as_dry(&self) -> Option<DryScene> {
        let mut grains = self.grains.clone()?;
        grains.coupling = None;
        let solid = |solid: &super::fluid::Solid| GrainSolid {
            name: solid.name.clone(),
            shape: Some(solid.shape.clone()),
            mesh: None,
            invert: solid.invert,
            material: solid.material.clone(),
            velocity_m_per_s: solid.velocity_m_per_s,
            spin_rad_per_s: solid.spin_rad_per_s,
            centre_m: solid.centre_m,
        };
        Some(DryScene {
            schema: None,
            title: self.title.clone(),
            description: None,
            domain: DryDomain {
                size_m: self.domain.size_m,
                boundaries: self.domain.boundaries.clone(),
                spacing_m: None,
            },
            gravity: self.gravity,
            grains,
            solids: self.solids.iter().map(solid).collect(),
            stop: GrainStop { end_time_s: self.stop.end_time_s, arrested: None },
            output: GrainOutput {
                grains: self.output.grains,
                series: self.output.series,
                probes: self.output.grain_probes.clone(),
            },
            file: self.file.clone(),
            folder: self.folder.clone(),
        })
    }

    /// The rules of the coupling, defaults if none are given.
    #[must_use]
    pub(crate) fn coupling(&self) -> Coupling {
        self.grains.as_ref().and_then(|grains| grains.coupling).unwrap_or_default()
    }

    /// Axes along which a uniform pressure gradient carries the weight.
    #[must_use]
    pub(crate) fn balanced_axes(&self) -> [bool; 3] {
        let (Some(gravity), Some(_), None) = (self.gravity, &self.grains, &self.fluid.initial) else {
            return [false; 3];
        };
        if !self.coupling().balanced.unwrap_or(gravity.direction.is_some()) {
            return [false; 3];
        }
        let pull = gravity_vector(&gravity);
        let faces = self.domain.boundaries.by_axis();
        std::array::from_fn(|a| faces[a][0] == Boundary::Periodic && pull[a] != 0.0)
    }

    /// Axes along which the pressure of the fluid at rest is left out of the computed one, and its weight with it:
    /// those with walls, in a box without air that holds grains.
    #[must_use]
    pub(crate) fn weightless_axes(&self) -> [bool; 3] {
        if self.grains.is_none() || self.fluid.initial.is_some() {
            return [false; 3];
        }
        self.domain.boundaries.by_axis().map(|faces| faces[0] != Boundary::Periodic)
    }
}
