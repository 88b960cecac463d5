//! The box, its cells and its six faces.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::motion::Motions;
use crate::geometry::Axis;

/// The box that is filled with cells.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Domain {
    /// Edge lengths along x, y, z, m; whole multiples of `spacing_m`. An axis along which nothing
    /// changes is periodic and one cell long: it then costs one cell.
    pub size_m: [f64; 3],
    /// Cell size, m.
    pub spacing_m: f64,
    /// What happens at the six faces.
    #[serde(default)]
    pub boundaries: Boundaries,
    /// How moving walls of the box move in time; steadily when not given.
    #[serde(default, skip_serializing_if = "Motions::is_empty")]
    pub motion: Motions,
}

/// One boundary condition per face; a face that is not named is periodic.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Boundaries {
    /// Face x = 0.
    #[serde(default)]
    pub x_min: Boundary,
    /// Face x = size.
    #[serde(default)]
    pub x_max: Boundary,
    /// Face y = 0.
    #[serde(default)]
    pub y_min: Boundary,
    /// Face y = size.
    #[serde(default)]
    pub y_max: Boundary,
    /// Face z = 0.
    #[serde(default)]
    pub z_min: Boundary,
    /// Face z = size.
    #[serde(default)]
    pub z_max: Boundary,
}

impl Boundaries {
    /// `[axis][low, high]`.
    #[must_use]
    pub(crate) fn by_axis(&self) -> [[Boundary; 2]; 3] {
        [[self.x_min, self.x_max], [self.y_min, self.y_max], [self.z_min, self.z_max]]
    }

    /// One face.
    #[must_use]
    pub(crate) const fn at(&mut self, axis: Axis, end: End) -> &mut Boundary {
        match (axis, end) {
            (Axis::X, End::Min) => &mut self.x_min,
            (Axis::X, End::Max) => &mut self.x_max,
            (Axis::Y, End::Min) => &mut self.y_min,
            (Axis::Y, End::Max) => &mut self.y_max,
            (Axis::Z, End::Min) => &mut self.z_min,
            (Axis::Z, End::Max) => &mut self.z_max,
        }
    }
}

/// An end of an axis of the box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// At coordinate 0.
    Min,
    /// At the size of the box.
    Max,
}

/// What happens at one face.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Boundary {
    /// What leaves here enters at the opposite face, which must be periodic too.
    #[default]
    Periodic,
    /// Wall at rest.
    NoSlip,
    /// Wall that slides in its own plane.
    MovingWall {
        /// Wall velocity, m/s; the component normal to the face must be 0.
        velocity_m_per_s: [f64; 3],
    },
    /// Mirror plane: no normal flow, no shear stress.
    FreeSlip,
    /// Open to the air: fluid that arrives leaves the box and is booked, nothing comes in. Only with a
    /// free surface.
    Open,
}
