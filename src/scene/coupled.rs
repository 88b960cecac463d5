//! Grains in a fluid: how the two act on each other.

use std::fmt;

use schemars::JsonSchema;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

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
    /// Equilibrium at the velocity of the grain's surface, without stress.
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
