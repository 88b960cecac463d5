//! Shapes, sizes and places of grains at time 0.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::geometry::Shape;

/// A rigid clump of spheres, which may overlap: mass, centre and inertia are those of the union \[D4\].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ClumpShape {
    /// Unique name.
    pub name: String,
    /// Its spheres. Only the form counts: each grain scales it to its own radius.
    pub members: ClumpMembers,
}

/// The spheres of a clump.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ClumpMembers {
    /// Four equal spheres at the corners of a regular tetrahedron (000 Fig 1b).
    Tetrahedron {
        /// Distance of the centres over the radius of the spheres, no unit; at 2 they touch.
        edge_over_radius: f64,
    },
    /// Any spheres.
    Spheres(Vec<ClumpMember>),
}

/// A sphere of a clump.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ClumpMember {
    /// Centre, m.
    pub centre_m: [f64; 3],
    /// Radius, m.
    pub radius_m: f64,
}

/// Grains of one shape and material.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GrainSet {
    /// Unique name.
    pub name: String,
    /// Material; the first one when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// Name of the clump; spheres when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub clump: Option<String>,
    /// How clumps are turned.
    #[serde(default)]
    pub orientation: Orientations,
    /// Where they are.
    pub place: Placement,
    /// Velocity of all, m/s.
    #[serde(default)]
    pub velocity_m_per_s: [f64; 3],
    /// Standard deviation of a random velocity on top, per component, m/s.
    #[serde(default)]
    pub random_speed_m_per_s: f64,
    /// Angular velocity of all, rad/s.
    #[serde(default)]
    pub spin_rad_per_s: [f64; 3],
    /// They keep their velocity and spin whatever pushes them: a rough bed, a stirrer.
    #[serde(default)]
    pub driven: bool,
}

/// How clumps are turned at time 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Orientations {
    /// Each one differently, evenly distributed; seeded by the place.
    #[default]
    Random,
    /// As the clump is drawn.
    AsDrawn,
}

/// Places of grains.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Placement {
    /// One by one.
    List(Vec<GrainAt>),
    /// As many as fit wholly into a region, on a lattice.
    Lattice {
        /// Kind of lattice.
        kind: LatticeKind,
        /// Box, sphere or cylinder with a length.
        region: Shape,
        /// Radius; of clumps, that of the sphere of the same volume, m.
        radius_m: f64,
        /// Distance of nearest neighbours, m; as close as possible when not given.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        spacing_m: Option<f64>,
        /// Seed of random velocities and orientations.
        #[serde(default)]
        seed: u64,
    },
    /// At random places, without overlap; clumps keep the room of the sphere around them. About a third of the
    /// region can be filled in this way.
    Random {
        /// Box, sphere or cylinder with a length.
        region: Shape,
        /// How many. Give this or `solid_fraction`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        count: Option<u64>,
        /// Volume of the grains over that of the region, no unit. Give this or `count`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        solid_fraction: Option<f64>,
        /// Radii; of clumps, those of the spheres of the same volume.
        sizes: SizeChoice,
        /// Least distance between surfaces, m.
        #[serde(default)]
        gap_m: f64,
        /// Seed: the same one gives the same packing on every machine.
        #[serde(default)]
        seed: u64,
    },
    /// From a table beside the scene, with columns `x [m]`, `y [m]`, `z [m]`, `radius [m]` and, if wanted,
    /// `velocity_x [m/s]`, …, `spin_x [rad/s]`, …, `orientation_w [-]`, `_x`, `_y`, `_z`: what a run writes as
    /// `grains_final_*.csv`.
    Csv {
        /// Its name, relative to the folder of the scene.
        file: String,
    },
}

/// One grain.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GrainAt {
    /// Centre of mass, m.
    pub position_m: [f64; 3],
    /// Radius; of a clump, that of the sphere of the same volume, m.
    pub radius_m: f64,
    /// Velocity on top of that of the set, m/s.
    #[serde(default)]
    pub velocity_m_per_s: [f64; 3],
    /// Angular velocity on top of that of the set, rad/s.
    #[serde(default)]
    pub spin_rad_per_s: [f64; 3],
    /// Quaternion (w, x, y, z) that turns the clump as drawn; any length but zero. As drawn when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub orientation: Option<[f64; 4]>,
}

/// Kind of lattice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum LatticeKind {
    /// 0.52 of the volume when touching.
    SimpleCubic,
    /// 0.68.
    BodyCentred,
    /// 0.74, the densest.
    FaceCentred,
}

/// Distribution of radii.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum SizeChoice {
    /// All equal.
    Equal {
        /// m.
        radius_m: f64,
    },
    /// Evenly distributed by number.
    Uniform {
        /// Least radius, m.
        least_radius_m: f64,
        /// Largest radius, m.
        largest_radius_m: f64,
    },
    /// Log-normal by number; radii outside the bounds are drawn again.
    LogNormal {
        /// Median radius, m.
        median_radius_m: f64,
        /// Standard deviation of ln r, no unit.
        deviation: f64,
        /// Least radius, m.
        least_radius_m: f64,
        /// Largest radius, m.
        largest_radius_m: f64,
    },
    /// By a sieve curve, evenly distributed in ln d between two sieves.
    Sieve {
        /// [diameter in m, share of the mass that passes], ascending, from share 0 to share 1.
        passing: Vec<[f64; 2]>,
    },
}
