//! Grains in a fluid: how the two act on each other, and the same scene seen by the grains alone.

use std::fmt;

use schemars::JsonSchema;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::dry::{DryDomain, DryScene, GrainOutput, GrainSolid, GrainStop};
use super::{Boundary, Scene};

/// How grains and fluid act on each other; only together with `fluid`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Coupling {
    /// How the surface of a grain returns the fluid's populations.
    #[serde(default)]
    pub wall: GrainWallChoice,
    /// What a cell that a grain gives free starts from.
    #[serde(default)]
    pub refill: GrainRefillChoice,
    /// Forces in gaps that the cells do not resolve, or `"off"`.
    #[serde(default)]
    pub lubrication: LubricationChoice,
    /// Steps of the grains in one step of the fluid; when not given, as many as contacts and lubrication need.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sub_steps: Option<u32>,
    /// Along periodic axes, in a box without air: whether a uniform pressure gradient carries the weight of fluid and
    /// grains together, as the floor of a far larger closed vessel does. When not given: yes where gravity has a
    /// `direction`, no with `slope_deg`, which means a flow downhill.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub balanced: Option<bool>,
}

/// How the surface of a grain returns the fluid's populations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum GrainWallChoice {
    /// Half-way between fluid and covered cells, a staircase.
    #[default]
    HalfWay,
    /// At the true place of the surface, by central linear interpolation: quieter forces, twice the work per link.
    CentralLinear,
}

/// What a cell that a grain gives free starts from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum GrainRefillChoice {
    /// Equilibrium at the velocity of the grain's surface, with the mean stress of the fluid neighbours.
    #[default]
    WithStress,
    /// The same without stress.
    Equilibrium,
    /// Equilibrium at the mean velocity of the fluid neighbours.
    Neighbours,
}

/// Lubrication: rules, or the word `"off"`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum LubricationChoice {
    /// With these rules.
    On(LubricationRules),
    /// None.
    Off(OffWord),
}

/// The word `"off"`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OffWord {
    /// None.
    Off,
}

/// Rules of lubrication.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LubricationRules {
    /// Gap below which it acts, cells; 0.74 when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cutoff_cells: Option<f64>,
    /// Smallest gap that counts, cells: roughness; a thousandth when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub smallest_gap_cells: Option<f64>,
    /// Whether sliding and turning are resisted too; yes when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tangential: Option<bool>,
}

impl Default for LubricationChoice {
    fn default() -> Self {
        Self::On(LubricationRules::default())
    }
}

impl<'de> Deserialize<'de> for LubricationChoice {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Choice;
        impl<'de> Visitor<'de> for Choice {
            type Value = LubricationChoice;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("\"off\" or an object with keys")
            }

            fn visit_str<E: Error>(self, word: &str) -> Result<Self::Value, E> {
                if word == "off" {
                    Ok(LubricationChoice::Off(OffWord::Off))
                } else {
                    Err(E::unknown_variant(word, &["off"]))
                }
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
                LubricationRules::deserialize(MapAccessDeserializer::new(map)).map(LubricationChoice::On)
            }
        }
        deserializer.deserialize_any(Choice)
    }
}

impl Scene {
    /// The scene as its grains see it; `None` without grains.
    #[must_use]
    pub fn as_dry(&self) -> Option<DryScene> {
        let mut grains = self.grains.clone()?;
        grains.coupling = None;
        let solid = |solid: &super::Solid| GrainSolid {
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
    pub fn coupling(&self) -> Coupling {
        self.grains.as_ref().and_then(|grains| grains.coupling).unwrap_or_default()
    }

    /// Axes along which a uniform pressure gradient carries the weight.
    #[must_use]
    pub fn balanced_axes(&self) -> [bool; 3] {
        let (Some(gravity), Some(_), None) = (self.gravity, &self.grains, &self.fluid.initial) else {
            return [false; 3];
        };
        if !self.coupling().balanced.unwrap_or(gravity.direction.is_some()) {
            return [false; 3];
        }
        let pull = crate::scene::force::gravity_vector(&gravity);
        let faces = self.domain.boundaries.by_axis();
        std::array::from_fn(|a| faces[a][0] == Boundary::Periodic && pull[a] != 0.0)
    }

    /// Axes along which the pressure of the fluid at rest is left out of the computed one, and its weight with it:
    /// those with walls, in a box without air that holds grains.
    #[must_use]
    pub fn weightless_axes(&self) -> [bool; 3] {
        if self.grains.is_none() || self.fluid.initial.is_some() {
            return [false; 3];
        }
        self.domain.boundaries.by_axis().map(|faces| faces[0] != Boundary::Periodic)
    }
}
