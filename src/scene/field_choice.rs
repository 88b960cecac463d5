//! What of the fields goes into files.

use std::collections::HashSet;
use std::ops::Range;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::checker::Checker;
use super::{Scene, SceneError, SceneProblem};
use crate::geometry::Axis;

/// A field of a file for ParaView, under the name in the file without its unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum FieldName {
    /// Pressure, Pa.
    Pressure,
    /// Velocity, m/s.
    Velocity,
    /// Stress, Pa: six components.
    Stress,
    /// Shear rate, 1/s.
    ShearRate,
    /// Where the fluid has not yielded.
    Unyielded,
    /// Where it has; only with a free surface.
    Yielded,
    /// Share of the cell that holds fluid; only with a free surface.
    Fill,
    /// Air, surface, fluid or solid; only with a free surface.
    Kind,
    /// What grains cover; only with grains.
    Covered,
    /// What is solid; only with solids.
    Solid,
    /// Number of the fluid; only with layers.
    Fluid,
}

impl FieldName {
    /// All of them, in the order of the files.
    pub const ALL: [Self; 11] = [
        Self::Pressure,
        Self::Velocity,
        Self::Stress,
        Self::ShearRate,
        Self::Unyielded,
        Self::Fill,
        Self::Kind,
        Self::Yielded,
        Self::Covered,
        Self::Solid,
        Self::Fluid,
    ];

    /// Numbers in floating point per cell; 0 for a mark, which is one byte.
    #[must_use]
    pub(crate) const fn numbers(self) -> u64 {
        match self {
            Self::Pressure | Self::ShearRate | Self::Fill => 1,
            Self::Velocity => 3,
            Self::Stress => 6,
            Self::Unyielded | Self::Yielded | Self::Kind | Self::Covered | Self::Solid | Self::Fluid => 0,
        }
    }

    /// Whether files of a scene have it.
    #[must_use]
    pub(crate) fn is_in(self, scene: &Scene) -> bool {
        match self {
            Self::Pressure | Self::Velocity | Self::Stress | Self::ShearRate | Self::Unyielded => true,
            Self::Fill | Self::Kind | Self::Yielded => {
                scene.fluid.initial.is_some() || scene.grains.is_some()
            }
            Self::Covered => scene.grains.is_some(),
            Self::Solid => !scene.solids.is_empty(),
            Self::Fluid => !scene.layers.is_empty(),
        }
    }
}

/// A part of the box.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FieldRegion {
    /// Low corner, m; the cell that holds it belongs to the region.
    pub min_m: [f64; 3],
    /// High corner, m.
    pub max_m: [f64; 3],
}

/// Floating-point numbers of field files.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum FieldPrecision {
    /// 64 bits: what was computed.
    #[default]
    Double,
    /// 32 bits, about seven digits.
    Single,
}

impl FieldPrecision {
    /// Whether it is the default, which a scene need not say.
    pub(super) fn is_double(&self) -> bool {
        *self == Self::Double
    }
}

/// What of the fields of a scene goes into its files.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldChoice {
    /// The fields.
    pub names: HashSet<FieldName>,
    /// Cells along each axis.
    pub cells: [Range<usize>; 3],
    /// Numbers.
    pub precision: FieldPrecision,
}

impl FieldChoice {
    /// Of a scene that was checked.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let output = &scene.output;
        let dx = scene.domain.spacing_m;
        let cells = std::array::from_fn(|a| {
            let n = (scene.domain.size_m[a] / dx).round() as usize;
            output.field_region.map_or(0..n, |region| {
                // A billionth of a cell beyond a face is rounding of decimal places.
                let low = (region.min_m[a] / dx + 1e-9).floor().max(0.0) as usize;
                let high = (region.max_m[a] / dx - 1e-9).ceil().max(0.0) as usize;
                low.min(n - 1)..high.clamp(low.min(n - 1) + 1, n)
            })
        });
        let wanted = |name: &FieldName| output.field_names.as_ref().is_none_or(|names| names.contains(name));
        let names = FieldName::ALL.into_iter().filter(|name| wanted(name) && name.is_in(scene)).collect();
        Self { names, cells, precision: output.field_precision }
    }

    /// Bytes of one file's arrays.
    #[must_use]
    pub(crate) fn bytes(&self) -> u64 {
        let cells = self.cells.iter().map(|range| range.len() as u64).product::<u64>();
        let size = if self.precision == FieldPrecision::Single { 4 } else { 8 };
        let of = |name: &FieldName| if name.numbers() == 0 { 1 } else { size * name.numbers() };
        cells * self.names.iter().map(of).sum::<u64>()
    }
}

/// Fields that the scene has, once each; a region that is part of the box.
pub(super) fn check(at: &Checker, scene: &Scene) -> Result<(), SceneError> {
    if let Some(names) = &scene.output.field_names {
        at.some("output.field_names", names.len(), "a field, or leave the list out for all of them")?;
        for (i, name) in names.iter().enumerate() {
            at.ensure(name.is_in(scene), &format!("output.field_names[{i}]"), || SceneProblem::NoSuchField)?;
        }
    }
    let Some(region) = scene.output.field_region else { return Ok(()) };
    for axis in Axis::ALL {
        let a = axis.index();
        let (low, high, size) = (region.min_m[a], region.max_m[a], scene.domain.size_m[a]);
        let letter = axis.letter();
        at.ensure(low < high, "output.field_region", || SceneProblem::EmptyInterval {
            axis: letter,
            low,
            high,
        })?;
        at.ensure(low < size && high > 0.0, "output.field_region", || SceneProblem::OutsideDomain {
            axis: letter,
            low,
            high,
            size,
        })?;
    }
    Ok(())
}
