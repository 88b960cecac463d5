//! What every check of a value needs: the file's name, and a located error.

use std::collections::HashSet;

use super::{SceneError, SceneProblem};
use crate::geometry::{Axis, Shape};

/// Longest name that becomes part of file names; beginnings, numbers and endings come to some 40 letters more, and encrypted file
/// systems allow 143.
const LONGEST_NAME: usize = 100;

/// Knows the file name and builds located errors.
pub(super) struct Checker<'a> {
    pub(super) file: &'a str,
}

impl Checker<'_> {
    pub(super) fn fail(&self, path: impl Into<String>, problem: SceneProblem) -> Result<(), SceneError> {
        Err(SceneError::new(self.file, path, problem))
    }

    pub(super) fn ensure(
        &self,
        ok: bool,
        path: &str,
        problem: impl FnOnce() -> SceneProblem,
    ) -> Result<(), SceneError> {
        if ok { Ok(()) } else { self.fail(path, problem()) }
    }

    /// `found` > 0.
    pub(super) fn positive(
        &self,
        path: &str,
        found: f64,
        unit: &'static str,
        because: &'static str,
        way_out: &'static str,
    ) -> Result<(), SceneError> {
        self.ensure(found > 0.0, path, || SceneProblem::NotPositive { found, unit, because, way_out })
    }

    /// `found` ≥ 0.
    pub(super) fn not_negative(
        &self,
        path: &str,
        found: f64,
        unit: &'static str,
        because: &'static str,
        way_out: &'static str,
    ) -> Result<(), SceneError> {
        self.ensure(found >= 0.0, path, || SceneProblem::Negative { found, unit, because, way_out })
    }

    /// At least one of something.
    pub(super) fn some(&self, path: &str, count: usize, what: &'static str) -> Result<(), SceneError> {
        self.ensure(count > 0, path, || SceneProblem::EmptyList { what })
    }

    /// A name that can be a column or part of a file name, and is not among `used`.
    pub(super) fn name(&self, path: &str, name: &str, used: &mut HashSet<String>) -> Result<(), SceneError> {
        let good =
            !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
        self.ensure(good, path, || SceneProblem::BadName { name: name.to_owned() })?;
        let fresh = used.insert(name.to_owned());
        self.ensure(fresh, path, || SceneProblem::DuplicateName { name: name.to_owned() })
    }

    /// A name as in [`Self::name`] that becomes part of file names, and is not too long for that.
    pub(super) fn file_name(
        &self,
        path: &str,
        name: &str,
        used: &mut HashSet<String>,
    ) -> Result<(), SceneError> {
        let length = name.len();
        self.ensure(length <= LONGEST_NAME, path, || SceneProblem::LongName { length, limit: LONGEST_NAME })?;
        self.name(path, name, used)
    }

    /// A shape with an inside that reaches into the box.
    pub(super) fn shape(
        &self,
        path: &str,
        shape: &Shape,
        size_m: [f64; 3],
        inverted: bool,
    ) -> Result<(), SceneError> {
        match shape {
            Shape::Box { min_m, max_m } => {
                for axis in Axis::ALL {
                    let (low, high) = (min_m[axis.index()], max_m[axis.index()]);
                    self.ensure(low < high, &format!("{path}.box"), || SceneProblem::EmptyInterval {
                        axis: axis.letter(),
                        low,
                        high,
                    })?;
                }
            }
            Shape::Cylinder { direction, radius_m, length_m, .. } => {
                let along = format!("{path}.cylinder.direction");
                self.direction(&along, *direction, "[1, 0, 0] for a cylinder along x")?;
                self.radius(&format!("{path}.cylinder.radius_m"), *radius_m)?;
                if let Some(length) = length_m {
                    let path = format!("{path}.cylinder.length_m");
                    self.positive(&path, *length, "m", EMPTY, "leave it out for an endless cylinder")?;
                }
            }
            Shape::Sphere { radius_m, .. } => self.radius(&format!("{path}.sphere.radius_m"), *radius_m)?,
            Shape::Polygon { axis, points_m, from_m, to_m } => {
                self.polygon(&format!("{path}.polygon.points_m"), shape, points_m)?;
                if let (Some(low), Some(high)) = (*from_m, *to_m) {
                    self.ensure(low < high, &format!("{path}.polygon"), || SceneProblem::EmptyInterval {
                        axis: axis.letter(),
                        low,
                        high,
                    })?;
                }
            }
            _ => {}
        }
        self.more_shapes(path, shape, size_m)?;
        if inverted { Ok(()) } else { self.reaches_box(path, shape, size_m) }
    }

    /// Corners around an area, whose edges do not cross.
    fn polygon(&self, path: &str, shape: &Shape, points: &[[f64; 2]]) -> Result<(), SceneError> {
        let (corners, area) = (points.len(), shape.polygon_area().unwrap_or(0.0));
        // Where edges cross, areas of both signs may cancel: the crossing is what to mend. On one line all is flat.
        let line = points.windows(3).all(|p| turn(p[0], p[1], p[2]) == 0.0);
        self.ensure(corners >= 3 && !line, path, || SceneProblem::FlatPolygon { corners, area })?;
        if let Some(crossing) = shape.crossing() {
            let corners = crossing.edges.map(|edge| edge + 1);
            return self.fail(path, SceneProblem::EdgesCross { corners, at: crossing.at });
        }
        self.ensure(area > 0.0, path, || SceneProblem::FlatPolygon { corners, area })
    }

    /// Rows of the same length, without marks of missing data.
    fn heights(&self, path: &str, rows: &[Vec<f64>]) -> Result<(), SceneError> {
        let first = rows.first().map_or(0, Vec::len);
        let other = rows.iter().map(Vec::len).find(|&n| n != first);
        self.ensure(first > 0 && other.is_none(), path, || SceneProblem::UnevenRows {
            rows: rows.len(),
            first,
            other: other.unwrap_or(0),
        })?;
        let places = rows
            .iter()
            .enumerate()
            .flat_map(|(j, row)| row.iter().enumerate().map(move |(i, &height)| (j, i, height)));
        let mut missing = places.filter(|(.., height)| is_no_data(*height));
        let Some((row, column, height)) = missing.next() else { return Ok(()) };
        let count = 1 + missing.count();
        self.fail(path, SceneProblem::NoData { row: row + 1, column: column + 1, height, count })
    }

    /// Cones, half-spaces, terrain and combinations.
    fn more_shapes(&self, path: &str, shape: &Shape, size_m: [f64; 3]) -> Result<(), SceneError> {
        let parts = |key: &str, parts: &[Shape], inverted| {
            let path = format!("{path}.{key}");
            self.ensure(!parts.is_empty(), &path, || SceneProblem::NoPart)?;
            let mut each = parts.iter().enumerate();
            each.try_for_each(|(i, part)| self.shape(&format!("{path}[{i}]"), part, size_m, inverted))
        };
        match shape {
            Shape::Cone { direction, height_m, base_radius_m, top_radius_m, .. } => {
                let path = format!("{path}.cone");
                self.direction(
                    &format!("{path}.direction"),
                    *direction,
                    "[0, 0, 1] for a cone that stands on z",
                )?;
                let way_out = "a height of at least one cell";
                self.positive(&format!("{path}.height_m"), *height_m, "m", EMPTY, way_out)?;
                let way_out = "0 for a tip";
                let because = "it is a radius";
                self.not_negative(&format!("{path}.base_radius_m"), *base_radius_m, "m", because, way_out)?;
                self.not_negative(&format!("{path}.top_radius_m"), *top_radius_m, "m", because, way_out)?;
                let greatest = base_radius_m + top_radius_m;
                self.radius(&format!("{path}.base_radius_m"), greatest)
            }
            Shape::HalfSpace { normal, .. } => {
                let path = format!("{path}.half_space.normal");
                self.direction(&path, *normal, "[0, 0, 1] for everything below a level")
            }
            Shape::Heightfield(field) => {
                let path = format!("{path}.heightfield");
                let way_out = "the distance between two heights";
                self.positive(
                    &format!("{path}.spacing_m"),
                    field.spacing_m,
                    "m",
                    "it is a distance",
                    way_out,
                )?;
                self.heights(&format!("{path}.heights_m"), field.heights_m())
            }
            Shape::Union(shapes) => parts("union", shapes, false),
            // Parts may reach beyond the box; what they have in common may not be outside.
            Shape::Intersection(shapes) => parts("intersection", shapes, true),
            Shape::Difference { from, minus } => {
                self.shape(&format!("{path}.difference.from"), from, size_m, false)?;
                parts("difference.minus", minus, true)
            }
            Shape::Box { .. } | Shape::Cylinder { .. } | Shape::Sphere { .. } | Shape::Polygon { .. } => {
                Ok(())
            }
        }
    }

    /// A vector with a direction.
    pub(super) fn direction(
        &self,
        path: &str,
        direction: [f64; 3],
        way_out: &'static str,
    ) -> Result<(), SceneError> {
        self.ensure(direction != [0.0; 3], path, || SceneProblem::ZeroVector { way_out })?;
        self.has_length(path, &direction)
    }

    /// A vector whose length neither overflows nor vanishes.
    pub(super) fn has_length(&self, path: &str, vector: &[f64]) -> Result<(), SceneError> {
        let square: f64 = vector.iter().map(|x| x * x).sum();
        let found = || SceneProblem::EndlessVector { found: vector.to_vec() };
        self.ensure(square.is_normal(), path, found)
    }

    fn radius(&self, path: &str, radius: f64) -> Result<(), SceneError> {
        self.positive(path, radius, "m", EMPTY, "a radius of at least one cell")
    }

    pub(super) fn reaches_box(&self, path: &str, shape: &Shape, size_m: [f64; 3]) -> Result<(), SceneError> {
        let bounds = shape.bounds();
        for axis in Axis::ALL {
            let a = axis.index();
            let (low, high, size) = (bounds.min[a], bounds.max[a], size_m[a]);
            self.ensure(low < size && high > 0.0, path, || SceneProblem::OutsideDomain {
                axis: axis.letter(),
                low,
                high,
                size,
            })?;
        }
        Ok(())
    }

    /// A point inside the box.
    pub(super) fn point(&self, path: &str, point: [f64; 3], size_m: [f64; 3]) -> Result<(), SceneError> {
        for axis in Axis::ALL {
            self.position(path, axis, point[axis.index()], size_m)?;
        }
        Ok(())
    }

    /// A coordinate inside the box.
    pub(super) fn position(
        &self,
        path: &str,
        axis: Axis,
        at: f64,
        size_m: [f64; 3],
    ) -> Result<(), SceneError> {
        let size = size_m[axis.index()];
        self.ensure((0.0..=size).contains(&at), path, || SceneProblem::OutsideDomain {
            axis: axis.letter(),
            low: at,
            high: at,
            size,
        })
    }
}

const EMPTY: &str = "else nothing is inside the shape";

/// Marks of missing data in rasters: those of ESRI, GDAL, SRTM and floating-point formats.
fn is_no_data(height: f64) -> bool {
    const MARKS: [f64; 6] = [-9999.0, -99999.0, -32768.0, -32767.0, 32767.0, 65535.0];
    MARKS.contains(&height) || height.abs() >= 1e10
}

/// Twice the area of a triangle, with sign.
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}
