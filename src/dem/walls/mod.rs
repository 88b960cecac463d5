//! Scenery that grains touch and that grains do not move \[D5\]: planes, boxes, cylinders, spheres, meshes,
//! each at rest or moving in a given way.

pub(crate) mod mesh;
pub(crate) mod mesh_read;
pub(crate) mod mesh_tree;
pub(crate) mod pass;
pub(crate) mod shapes;

use super::{DemError, Orientation, V3};
use crate::state::state;
pub use mesh::Mesh;

/// Which side of a closed surface the grains are on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Grains inside: a container.
    Inside,
    /// Grains outside: an obstacle.
    Outside,
}

/// The shape of a wall.
#[derive(Debug, Clone, PartialEq)]
pub enum Surface {
    /// The half-space behind `point`; grains are where `normal` points to.
    Plane {
        /// A point of the plane, m.
        point: V3,
        /// Unit normal towards the grains.
        normal: V3,
    },
    /// A cylinder about `axis` through `point`; endless without `half_length`, else a capped body centred at
    /// `point` (for grains outside only).
    Cylinder {
        /// A point of the axis; the centre of a capped body, m.
        point: V3,
        /// Unit vector along the axis.
        axis: V3,
        /// Radius, m.
        radius: f64,
        /// Half the length, m; `None`: endless.
        half_length: Option<f64>,
        /// Where the grains are.
        side: Side,
    },
    /// A box with half edges `half` along the axes of `orientation`.
    Box {
        /// Centre, m.
        centre: V3,
        /// Half edges, m.
        half: V3,
        /// Of its axes.
        orientation: Orientation,
        /// Where the grains are.
        side: Side,
    },
    /// A sphere.
    Sphere {
        /// Centre, m.
        centre: V3,
        /// Radius, m.
        radius: f64,
        /// Where the grains are.
        side: Side,
    },
    /// Triangles, touched from either side.
    Mesh(Mesh),
}

/// Rigid motion of a wall: its points move with velocity + spin × (x − about); `about` moves along.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallMotion {
    /// m/s.
    pub velocity: V3,
    /// rad/s.
    pub spin: V3,
    /// Point of the axis of rotation at the start, m.
    pub about: V3,
}

impl WallMotion {
    /// At rest.
    pub(crate) fn none() -> Self {
        Self { velocity: V3::zeros(), spin: V3::zeros(), about: V3::zeros() }
    }
}

/// One piece of scenery.
#[derive(Debug, Clone, PartialEq)]
pub struct Wall {
    /// Name used in messages and probes.
    pub name: String,
    /// Shape at the start.
    pub surface: Surface,
    /// Index of its material.
    pub material: usize,
    /// How it moves.
    pub motion: WallMotion,
}

impl Wall {
    /// A wall at rest.
    pub fn fixed(name: &str, surface: Surface, material: usize) -> Self {
        Self { name: name.into(), surface, material, motion: WallMotion::none() }
    }

    /// Checks the numbers and makes directions unit vectors.
    ///
    /// # Errors
    /// Numbers that are not finite, zero directions, sizes that are not above zero.
    pub(crate) fn checked(mut self) -> Result<Self, DemError> {
        let name = self.name.clone();
        let fail = |what| Err(DemError::Wall { wall: name.clone(), what });
        let finite = |v: &V3| v.iter().all(|x| x.is_finite());
        let above = |x: f64| x > 0.0 && x.is_finite();
        let m = &self.motion;
        if !(finite(&m.velocity) && finite(&m.spin) && finite(&m.about)) {
            return fail("its motion is not finite");
        }
        match &mut self.surface {
            Surface::Plane { point, normal } => {
                if !(finite(point) && finite(normal) && normal.norm() > 0.0) {
                    return fail("a plane needs a finite point and a normal that is not zero");
                }
                normal.normalize_mut();
            }
            Surface::Cylinder { point, axis, radius, half_length, side } => {
                if !(finite(point) && finite(axis) && axis.norm() > 0.0 && above(*radius)) {
                    return fail(
                        "a cylinder needs a finite point, an axis that is not zero, a radius above zero",
                    );
                }
                if half_length.is_some_and(|h| !above(h)) {
                    return fail("the half length of a cylinder must be above zero");
                }
                if half_length.is_some() && *side == Side::Inside {
                    return fail("a cylinder around grains is endless; close it with planes");
                }
                axis.normalize_mut();
            }
            Surface::Box { centre, half, .. } => {
                if !(finite(centre) && half.iter().all(|&h| above(h))) {
                    return fail("a box needs a finite centre and half edges above zero");
                }
            }
            Surface::Sphere { centre, radius, .. } => {
                if !(finite(centre) && above(*radius)) {
                    return fail("a sphere needs a finite centre and a radius above zero");
                }
            }
            Surface::Mesh(_) => {}
        }
        Ok(self)
    }

    /// Whether the motion changes where the surface is (a drum turning about its axis does not).
    pub(crate) fn shifts(&self) -> bool {
        let m = &self.motion;
        let (still, straight) = (m.velocity == V3::zeros(), m.spin == V3::zeros());
        if still && straight {
            return false;
        }
        let along = |v: &V3, a: &V3| v.cross(a).norm() <= 1e-12 * v.norm();
        match &self.surface {
            Surface::Plane { normal, .. } => m.velocity.dot(normal) != 0.0 || !along(&m.spin, normal),
            Surface::Cylinder { point, axis, half_length: None, .. } => {
                let off = (m.about - point).cross(axis).norm();
                !(along(&m.velocity, axis) && (straight || (along(&m.spin, axis) && off <= 1e-12)))
            }
            Surface::Sphere { centre, .. } => !(still && (m.about - centre).norm() <= 1e-12),
            _ => true,
        }
    }
}

/// Where a moving wall is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// How far `about` has moved, m.
    pub shift: V3,
    /// Rotation about it since the start.
    pub turn: Orientation,
}

state!(Pose: shift turn);

impl Default for Pose {
    fn default() -> Self {
        Self { shift: V3::zeros(), turn: Orientation::identity() }
    }
}

/// A point of a wall near a member.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Near {
    /// From the wall to the member's centre, unit length.
    pub normal: V3,
    /// Distance of the member's centre from the wall along `normal`, m; negative behind it.
    pub distance: f64,
    /// Which face, edge or corner.
    pub feature: u32,
}

/// Collects the points of `wall` nearer to `x` than `reach`; `triangles` restricts a mesh.
pub(crate) fn near(
    wall: &Wall,
    pose: &Pose,
    moved: bool,
    x: &V3,
    reach: f64,
    triangles: Option<&[u32]>,
    out: &mut Vec<Near>,
) {
    if !moved {
        return shapes::near(&wall.surface, x, reach, triangles, out);
    }
    let about = wall.motion.about;
    let start = out.len();
    let local = about + pose.turn.inverse_transform_vector(&(x - about - pose.shift));
    shapes::near(&wall.surface, &local, reach, triangles, out);
    for n in &mut out[start..] {
        n.normal = pose.turn * n.normal;
    }
}

/// Velocity of the wall's material at point `x`.
#[inline]
pub(crate) fn surface_velocity(wall: &Wall, pose: &Pose, x: &V3) -> V3 {
    let m = &wall.motion;
    m.velocity + m.spin.cross(&(x - m.about - pose.shift))
}
