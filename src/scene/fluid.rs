//! What the fluid is, what drives it, and how it starts.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Rheology;
use crate::geometry::{Axis, Shape};

/// The fluid that fills the box (except for `layers` and `solids`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fluid {
    /// Density, kg/m³.
    pub density_kg_per_m3: f64,
    /// Constitutive law.
    pub rheology: Rheology,
    /// Force per volume besides gravity.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body_force: Option<BodyForce>,
    /// Velocity at time 0.
    #[serde(default)]
    pub initial_velocity: InitialVelocity,
    /// Where the fluid is at time 0; the rest of the box is air, and the surface between them is free.
    /// Without it fluid fills the whole box.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub initial: Option<InitialFluid>,
}

/// Where the fluid is at time 0: below the level or inside one of the shapes, and not inside a solid.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InitialFluid {
    /// Everything below a level.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fill_level: Option<FillLevel>,
    /// Everything inside any of these.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub shapes: Vec<FluidShape>,
    /// Pressure at time 0.
    #[serde(default)]
    pub pressure: InitialPressure,
}

/// Pressure at time 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum InitialPressure {
    /// That of the fluid at rest below its surface. The fluid is compressed by its own weight and therefore
    /// heavier than what was drawn, by half of 3fHΔt²/(ρΔx²).
    #[default]
    Hydrostatic,
    /// That of the fluid at rest below a surface that is lowered until the mass is what was drawn, a level surface as a whole
    /// and any other column by column. For fluid that flows out of its reservoir: the thin flow it becomes then has the right volume, whatever the time step.
    Settled,
    /// That of the air: for fluid that falls freely from the start.
    Uniform,
}

/// Fluid up to a level.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FillLevel {
    /// Position of the surface on the axis, m; fluid is on the side towards which gravity pulls.
    pub height_m: f64,
    /// The axis normal to the surface; the one along which gravity is strongest when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axis: Option<Axis>,
}

/// A part of the fluid at time 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FluidShape {
    /// Name, for messages.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Where it is.
    pub shape: Shape,
}

/// Force per volume, the same in all cells.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum BodyForce {
    /// The same at all times.
    Constant {
        /// Force, N/m³.
        force_n_per_m3: [f64; 3],
    },
    /// mean + amplitude cos(2π frequency t + phase).
    Oscillating {
        /// Mean force, N/m³.
        #[serde(default)]
        mean_n_per_m3: [f64; 3],
        /// Amplitude, N/m³.
        amplitude_n_per_m3: [f64; 3],
        /// Frequency, 1/s.
        frequency_hz: f64,
        /// Phase, radians.
        #[serde(default)]
        phase_rad: f64,
    },
    /// One force until a time, another from then on.
    Stepped {
        /// Force before, N/m³.
        before_n_per_m3: [f64; 3],
        /// Force after, N/m³.
        after_n_per_m3: [f64; 3],
        /// When it changes, s.
        at_s: f64,
    },
}

/// Gravity; acts as the constant force ρ0 g.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Gravity {
    /// Magnitude, m/s².
    pub magnitude_m_per_s2: f64,
    /// Direction, any length but zero. Give this or `slope_deg`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direction: Option<[f64; 3]>,
    /// Slope of the bed, degrees: downhill is +x. Give this or `direction`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slope_deg: Option<f64>,
    /// The axis normal to the bed, used with `slope_deg`; z when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bed_normal: Option<Axis>,
}

/// Velocity at time 0. Waves have whole numbers of periods in the box, so that they are exactly
/// periodic; pressure starts in balance with them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum InitialVelocity {
    /// No flow.
    #[default]
    AtRest,
    /// The same everywhere.
    Uniform {
        /// Velocity, m/s.
        velocity_m_per_s: [f64; 3],
    },
    /// mean + amplitude sin(k·x), amplitude normal to k.
    ShearWave {
        /// Amplitude vector, m/s.
        amplitude_m_per_s: [f64; 3],
        /// Whole periods in the box along x, y, z.
        wave_counts: [i32; 3],
        /// Uniform flow on top, m/s.
        #[serde(default)]
        mean_m_per_s: [f64; 3],
    },
    /// Vortices in a plane: u_a = A cos(k_a a) sin(k_b b), u_b = −A (k_a/k_b) sin(k_a a) cos(k_b b).
    TaylorGreen {
        /// Amplitude A, m/s.
        amplitude_m_per_s: f64,
        /// The axis normal to the plane; a and b are the two others in alphabetical order.
        normal: Axis,
        /// Whole periods in the box along a and b.
        wave_counts: [u32; 2],
        /// Uniform flow on top, m/s.
        #[serde(default)]
        mean_m_per_s: [f64; 3],
    },
    /// u = A sin kx cos ky cos kz, v = −A cos kx sin ky cos kz, w = 0; equal wave lengths.
    #[serde(rename = "taylor_green_3d")]
    TaylorGreen3d {
        /// Amplitude A, m/s.
        amplitude_m_per_s: f64,
        /// Whole periods in the box along x, y, z.
        wave_counts: [u32; 3],
    },
    /// u = A sin kz + C cos ky, v = B sin kx + A cos kz, w = C sin ky + B cos kx; equal wave lengths.
    Abc {
        /// A, B, C, m/s.
        amplitudes_m_per_s: [f64; 3],
        /// Whole periods in the box along x, y, z.
        wave_counts: [u32; 3],
    },
}

/// A part of the box that holds another fluid of the same density. Later layers win.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Layer {
    /// Unique name.
    pub name: String,
    /// Where it is.
    pub shape: Shape,
    /// Its constitutive law.
    pub rheology: Rheology,
}

/// A fixed solid. A cell is solid if its centre is inside.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Solid {
    /// Unique name.
    pub name: String,
    /// Where it is.
    pub shape: Shape,
    /// The solid is everything outside the shape: a pipe is the outside of a cylinder.
    #[serde(default)]
    pub invert: bool,
    /// Velocity of its surface, m/s (the cells stay where they are).
    #[serde(default)]
    pub velocity_m_per_s: [f64; 3],
    /// Angular velocity of its surface, rad/s.
    #[serde(default)]
    pub spin_rad_per_s: [f64; 3],
    /// How velocity and spin change in time; steady when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<super::motion::Motion>,
    /// Centre of rotation, m; the centre of the shape when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub centre_m: Option<[f64; 3]>,
    /// Material that grains touch, one of `grains.materials`; the first one when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
}

impl Fluid {
    /// A fluid at rest that fills the box.
    ///
    /// # Arguments
    /// `density_kg_per_m3`, kg/m³; `rheology`: its law.
    #[must_use]
    pub fn new(density_kg_per_m3: f64, rheology: Rheology) -> Self {
        let initial_velocity = InitialVelocity::AtRest;
        Self { density_kg_per_m3, rheology, body_force: None, initial_velocity, initial: None }
    }
}

impl Gravity {
    /// Against z.
    ///
    /// # Arguments
    /// `magnitude_m_per_s2`, m/s² ≥ 0.
    #[must_use]
    pub const fn down(magnitude_m_per_s2: f64) -> Self {
        let direction = Some([0.0, 0.0, -1.0]);
        Self { magnitude_m_per_s2, direction, slope_deg: None, bed_normal: None }
    }

    /// On a bed normal to z that falls towards +x.
    ///
    /// # Arguments
    /// `magnitude_m_per_s2`, m/s² ≥ 0; `slope_deg`: slope of the bed, degrees.
    #[must_use]
    pub const fn on_slope(magnitude_m_per_s2: f64, slope_deg: f64) -> Self {
        Self { magnitude_m_per_s2, direction: None, slope_deg: Some(slope_deg), bed_normal: Some(Axis::Z) }
    }
}

impl Solid {
    /// A solid at rest inside a shape.
    #[must_use]
    pub fn new(name: &str, shape: Shape) -> Self {
        Self {
            name: name.to_owned(),
            shape,
            invert: false,
            velocity_m_per_s: [0.0; 3],
            spin_rad_per_s: [0.0; 3],
            motion: None,
            centre_m: None,
            material: None,
        }
    }

    /// A solid at rest everywhere outside a shape: a pipe around a cylinder.
    #[must_use]
    pub fn outside(name: &str, shape: Shape) -> Self {
        Self { invert: true, ..Self::new(name, shape) }
    }
}
