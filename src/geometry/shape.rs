//! Boxes, cylinders, spheres, cones, extruded polygons, half-spaces, terrain, and combinations of them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::crossing::{Crossing, first_crossing};
use super::heightfield::Heightfield;
use super::polygon;
use crate::vector::{dot, norm, sub};

/// A coordinate axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Axis {
    /// The first.
    X,
    /// The second.
    Y,
    /// The third; up, unless a scene says otherwise.
    Z,
}

impl Axis {
    /// All three, in order.
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];

    /// 0, 1 or 2.
    #[must_use]
    pub(crate) fn index(self) -> usize {
        match self {
            Self::X => 0,
            Self::Y => 1,
            Self::Z => 2,
        }
    }

    /// The axis as a letter.
    #[must_use]
    pub(crate) fn letter(self) -> char {
        match self {
            Self::X => 'x',
            Self::Y => 'y',
            Self::Z => 'z',
        }
    }

    /// The two other axes, in alphabetical order.
    #[must_use]
    pub(crate) fn others(self) -> [usize; 2] {
        match self {
            Self::X => [1, 2],
            Self::Y => [0, 2],
            Self::Z => [0, 1],
        }
    }
}

/// A region of space, metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Shape {
    /// Box between two corners: min ≤ x < max on each axis.
    Box {
        /// Low corner, m.
        min_m: [f64; 3],
        /// High corner, m.
        max_m: [f64; 3],
    },
    /// Round cylinder; endless without `length_m`.
    Cylinder {
        /// A point on the axis, m; with `length_m` the start of the cylinder.
        point_m: [f64; 3],
        /// Direction of the axis, any length but zero.
        direction: [f64; 3],
        /// Radius, m.
        radius_m: f64,
        /// Length from `point_m` along `direction`, m.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        length_m: Option<f64>,
    },
    /// Ball.
    Sphere {
        /// Centre, m.
        centre_m: [f64; 3],
        /// Radius, m.
        radius_m: f64,
    },
    /// Polygon swept along an axis.
    Polygon {
        /// The axis it is swept along.
        axis: Axis,
        /// Corners in the two other coordinates, in alphabetical order (axis y: x and z), m.
        points_m: Vec<[f64; 2]>,
        /// Start along the axis, m; without it there is no start.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        from_m: Option<f64>,
        /// End along the axis, m; without it there is no end.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        to_m: Option<f64>,
    },
    /// Round cone between two discs; a tip where `top_radius_m` is 0.
    Cone {
        /// Centre of the base, m.
        base_m: [f64; 3],
        /// From base to top, any length but zero.
        direction: [f64; 3],
        /// Distance from base to top, m.
        height_m: f64,
        /// Radius of the base, m.
        base_radius_m: f64,
        /// Radius of the top, m.
        #[serde(default)]
        top_radius_m: f64,
    },
    /// Everything behind a plane.
    HalfSpace {
        /// A point of the plane, m.
        point_m: [f64; 3],
        /// Points out of the half-space, any length but zero.
        normal: [f64; 3],
    },
    /// Everything below a surface given by heights on a grid.
    Heightfield(Heightfield),
    /// What is in at least one of the shapes.
    Union(Vec<Shape>),
    /// What is in all of the shapes.
    Intersection(Vec<Shape>),
    /// What is in the first shape and in none of the others: a bed with a recess.
    Difference {
        /// The whole.
        from: Box<Shape>,
        /// What is taken away.
        minus: Vec<Shape>,
    },
}

/// Axis-aligned bounds; infinite where a shape has no end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Low corner, m.
    pub min: [f64; 3],
    /// High corner, m.
    pub max: [f64; 3],
}

impl Bounds {
    const EVERYWHERE: Self = Self { min: [f64::NEG_INFINITY; 3], max: [f64::INFINITY; 3] };
    const NOWHERE: Self = Self { min: [f64::INFINITY; 3], max: [f64::NEG_INFINITY; 3] };

    /// The smallest bounds around both.
    fn around(self, other: Self) -> Self {
        Self {
            min: std::array::from_fn(|a| if other.min[a] < self.min[a] { other.min[a] } else { self.min[a] }),
            max: std::array::from_fn(|a| if other.max[a] > self.max[a] { other.max[a] } else { self.max[a] }),
        }
    }

    /// What both have in common.
    fn within(self, other: Self) -> Self {
        Self {
            min: std::array::from_fn(|a| if other.min[a] > self.min[a] { other.min[a] } else { self.min[a] }),
            max: std::array::from_fn(|a| if other.max[a] < self.max[a] { other.max[a] } else { self.max[a] }),
        }
    }
}

impl Shape {
    /// Whether a point (m) is inside.
    #[must_use]
    pub(crate) fn contains(&self, p: [f64; 3]) -> bool {
        match self {
            Self::Box { min_m, max_m } => (0..3).all(|a| min_m[a] <= p[a] && p[a] < max_m[a]),
            Self::Cylinder { point_m, direction, radius_m, length_m } => {
                let r = sub(p, *point_m);
                let along = dot(r, *direction) / norm(*direction);
                let within = length_m.is_none_or(|length| 0.0 <= along && along < length);
                within && dot(r, r) - along * along < radius_m * radius_m
            }
            Self::Sphere { centre_m, radius_m } => {
                let r = sub(p, *centre_m);
                dot(r, r) < radius_m * radius_m
            }
            Self::Polygon { axis, points_m, from_m, to_m } => {
                let [a, b] = axis.others();
                let h = p[axis.index()];
                from_m.is_none_or(|from| from <= h)
                    && to_m.is_none_or(|to| h < to)
                    && polygon::contains(points_m, [p[a], p[b]])
            }
            Self::Cone { .. } | Self::HalfSpace { .. } => self.depth(p) > 0.0,
            // Not by its depth, which asks for the steepest place of all the terrain.
            Self::Heightfield(field) => p[2] < field.height(p[0], p[1]),
            Self::Union(parts) => parts.iter().any(|part| part.contains(p)),
            Self::Intersection(parts) => parts.iter().all(|part| part.contains(p)),
            Self::Difference { from, minus } => {
                from.contains(p) && !minus.iter().any(|part| part.contains(p))
            }
        }
    }

    /// Smallest axis-aligned box around the shape (for an oblique finite cylinder: around its
    /// two end discs' enclosing balls).
    #[must_use]
    pub(crate) fn bounds(&self) -> Bounds {
        match self {
            Self::Box { min_m, max_m } => Bounds { min: *min_m, max: *max_m },
            Self::Sphere { centre_m, radius_m } => {
                Bounds { min: centre_m.map(|c| c - radius_m), max: centre_m.map(|c| c + radius_m) }
            }
            Self::Cylinder { point_m, direction, radius_m, length_m } => {
                cylinder_bounds(*point_m, *direction, *radius_m, *length_m)
            }
            Self::Polygon { axis, points_m, from_m, to_m } => {
                let mut bounds = Bounds { min: [f64::INFINITY; 3], max: [f64::NEG_INFINITY; 3] };
                let [a, b] = axis.others();
                for point in points_m {
                    for (axis, value) in [(a, point[0]), (b, point[1])] {
                        bounds.min[axis] = if value < bounds.min[axis] { value } else { bounds.min[axis] };
                        bounds.max[axis] = if value > bounds.max[axis] { value } else { bounds.max[axis] };
                    }
                }
                bounds.min[axis.index()] = from_m.unwrap_or(f64::NEG_INFINITY);
                bounds.max[axis.index()] = to_m.unwrap_or(f64::INFINITY);
                bounds
            }
            Self::Cone { base_m, direction, height_m, base_radius_m, top_radius_m } => {
                let radius = if top_radius_m > base_radius_m { top_radius_m } else { base_radius_m };
                cylinder_bounds(*base_m, *direction, *radius, Some(*height_m))
            }
            Self::HalfSpace { point_m, normal } => half_space_bounds(*point_m, *normal),
            Self::Heightfield(field) => {
                let mut bounds = Bounds::EVERYWHERE;
                bounds.max[2] = field.range()[1];
                bounds
            }
            Self::Union(parts) => parts.iter().map(Self::bounds).fold(Bounds::NOWHERE, Bounds::around),
            Self::Intersection(parts) => {
                parts.iter().map(Self::bounds).fold(Bounds::EVERYWHERE, Bounds::within)
            }
            Self::Difference { from, .. } => from.bounds(),
        }
    }

    /// Centre of the shape, where it has one: the default centre of rotation. Axes without an
    /// end give 0, which is as good as any other point of that axis.
    #[must_use]
    pub fn centre(&self) -> [f64; 3] {
        if let Self::Cylinder { point_m, .. } = self {
            return *point_m;
        }
        let Bounds { min, max } = self.bounds();
        std::array::from_fn(|a| {
            let middle = 0.5 * (min[a] + max[a]);
            if middle.is_finite() { middle } else { 0.0 }
        })
    }

    /// Area of a polygon's cross-section; `None` for other shapes.
    #[must_use]
    pub(crate) fn polygon_area(&self) -> Option<f64> {
        match self {
            Self::Polygon { points_m, .. } => Some(polygon::signed_area(points_m).abs()),
            _ => None,
        }
    }
}

impl Shape {
    /// Where a polygon's edges cross or touch; `None` for simple polygons and other shapes.
    #[must_use]
    pub(crate) fn crossing(&self) -> Option<Crossing> {
        match self {
            Self::Polygon { points_m, .. } => first_crossing(points_m),
            _ => None,
        }
    }
}

/// Bounded only when the normal lies along an axis.
fn half_space_bounds(point: [f64; 3], normal: [f64; 3]) -> Bounds {
    let mut bounds = Bounds::EVERYWHERE;
    let mut along = (0..3).filter(|&a| normal[a] != 0.0);
    if let (Some(a), None) = (along.next(), along.next()) {
        if normal[a] > 0.0 {
            bounds.max[a] = point[a];
        } else {
            bounds.min[a] = point[a];
        }
    }
    bounds
}

fn cylinder_bounds(point: [f64; 3], direction: [f64; 3], radius: f64, length: Option<f64>) -> Bounds {
    let norm = norm(direction);
    let unit = direction.map(|d| d / norm);
    let Some(length) = length else {
        // Without an end, only the axes normal to the direction are bounded.
        let side = |a: usize, s: f64| if unit[a] == 0.0 { point[a] + s * radius } else { s * f64::INFINITY };
        return Bounds {
            min: std::array::from_fn(|a| side(a, -1.0)),
            max: std::array::from_fn(|a| side(a, 1.0)),
        };
    };
    let half_width: [f64; 3] = std::array::from_fn(|a| radius * (1.0 - unit[a] * unit[a]).abs().sqrt());
    let end: [f64; 3] = std::array::from_fn(|a| point[a] + length * unit[a]);
    Bounds {
        min: std::array::from_fn(|a| (if end[a] < point[a] { end[a] } else { point[a] }) - half_width[a]),
        max: std::array::from_fn(|a| (if end[a] > point[a] { end[a] } else { point[a] }) + half_width[a]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cylinder(length_m: Option<f64>) -> Shape {
        Shape::Cylinder { point_m: [0.0, 1.0, 0.0], direction: [2.0, 0.0, 0.0], radius_m: 0.5, length_m }
    }

    #[test]
    fn exact_box_is_closed_below_and_open_above() {
        let shape = Shape::Box { min_m: [0.0; 3], max_m: [1.0; 3] };
        assert!(shape.contains([0.0; 3]));
        assert!(!shape.contains([1.0, 0.5, 0.5]));
    }

    #[test]
    fn exact_cylinder_with_and_without_end() {
        assert!(cylinder(None).contains([-100.0, 1.4, 0.0]));
        assert!(!cylinder(None).contains([0.0, 1.4, 0.4]));
        assert!(cylinder(Some(3.0)).contains([2.9, 1.0, 0.0]));
        assert!(!cylinder(Some(3.0)).contains([3.1, 1.0, 0.0]));
        assert!(!cylinder(Some(3.0)).contains([-0.1, 1.0, 0.0]));
    }

    #[test]
    fn exact_bounds() {
        let ball = Shape::Sphere { centre_m: [1.0, 2.0, 3.0], radius_m: 0.5 };
        assert_eq!(ball.bounds(), Bounds { min: [0.5, 1.5, 2.5], max: [1.5, 2.5, 3.5] });
        assert_eq!(cylinder(Some(3.0)).bounds(), Bounds { min: [0.0, 0.5, -0.5], max: [3.0, 1.5, 0.5] });
        assert_eq!(cylinder(None).bounds().max[0], f64::INFINITY);
        assert_eq!(cylinder(None).bounds().min[2], -0.5);
    }

    #[test]
    fn exact_polygon_coordinates_are_alphabetical() {
        let wedge = Shape::Polygon {
            axis: Axis::Y,
            points_m: vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0]],
            from_m: Some(0.0),
            to_m: None,
        };
        assert!(wedge.contains([1.9, 5.0, 0.1]));
        assert!(!wedge.contains([0.1, 5.0, 0.9]));
        assert!(!wedge.contains([1.9, -1.0, 0.1]));
        assert_eq!(wedge.polygon_area(), Some(1.0));
        assert_eq!(wedge.centre(), [1.0, 0.0, 0.5]);
    }
}
