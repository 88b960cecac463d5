//! Materials and what happens where they touch.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A material.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GrainMaterial {
    /// Unique name.
    pub name: String,
    /// Density, kg/m³.
    pub density_kg_per_m3: f64,
    /// Young's modulus, Pa. Contacts last as its −2/5th power: with 1/1000 of the real value a run is 16 times
    /// shorter and overlaps are 16 times deeper.
    pub young_modulus_pa: f64,
    /// Poisson's ratio, above −1 and below 0.5.
    pub poisson_ratio: f64,
}

/// What happens where two materials touch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Contact {
    /// Normal force. It never attracts.
    pub law: ContactLaw,
    /// Coulomb's coefficient of friction, no unit.
    pub friction: f64,
    /// The torque that resists rolling and twisting is at most this, times the effective radius, times the normal force; no unit.
    #[serde(default)]
    pub rolling_friction: f64,
    /// Damping of the tangential spring as a share of the normal damping, no unit; 1 when not given.
    #[serde(default = "one")]
    pub tangential_damping: f64,
}

fn one() -> f64 {
    1.0
}

/// Normal force \[D1\].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ContactLaw {
    /// Hertz with visco-elastic damping: restitution falls with speed.
    ViscoElastic {
        /// Dissipative constant A, s.
        dissipative_time_s: f64,
    },
    /// Hertz with damping that makes restitution independent of speed.
    Tsuji {
        /// Restitution that collisions have, above 0, at most 1.
        restitution: f64,
    },
    /// Hertz with damping that makes restitution independent of speed, by the coefficient of the law.
    TsujiDamping {
        /// α ≥ 0.
        alpha: f64,
    },
    /// Linear spring and dashpot.
    Linear {
        /// Normal stiffness, N/m.
        stiffness_n_per_m: f64,
        /// Restitution that collisions have, above 0, at most 1.
        restitution: f64,
        /// Tangential over normal stiffness, no unit; 2/7 when not given.
        #[serde(default = "two_sevenths")]
        tangential_ratio: f64,
    },
}

/// With 2/7 the tangential motion of a sphere has the period of the normal one.
fn two_sevenths() -> f64 {
    2.0 / 7.0
}

/// The contact of one pair of materials.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PairContact {
    /// Names of the two materials, in any order; twice the same for contacts within a material.
    pub between: [String; 2],
    /// What happens there.
    pub contact: Contact,
}
