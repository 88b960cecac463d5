//! Common set-ups.

use crate::claim::VerifyError;
use lahar::dem::{
    Dem, DemError, Grain, Material, Materials, NormalLaw, PairProperties, Setup, Side, Sphere, Surface, V3,
    Wall,
};

/// m/s².
pub(super) const G: f64 = 9.81;
/// Poisson's ratio of every material here.
pub(super) const POISSON: f64 = 0.22;
/// Density of every material here unless stated, kg/m³.
pub(super) const DENSITY: f64 = 2650.0;
/// Radius of every grain here unless stated, m.
pub(super) const RADIUS: f64 = 5e-3;

/// A material of glass's density and Poisson's ratio.
pub(super) fn material(young_pa: f64) -> Material {
    Material { name: "grain".into(), density_kg_m3: DENSITY, young_pa, poisson: POISSON }
}

/// Nothing dissipates.
pub(super) fn elastic() -> PairProperties {
    PairProperties {
        normal: NormalLaw::ViscoElastic { time_s: 0.0 },
        friction: 0.0,
        rolling_friction: 0.0,
        tangential_damping: 0.0,
    }
}

/// Only the normal law dissipates.
pub(super) fn smooth(normal: NormalLaw) -> PairProperties {
    PairProperties { normal, ..elastic() }
}

/// One material, no grains.
pub(super) fn setup(young_pa: f64, pair: PairProperties) -> Setup {
    Setup::new(Materials::single(material(young_pa), pair))
}

/// A plane through the origin, grains above.
pub(super) fn floor() -> Wall {
    Wall::fixed("floor", Surface::Plane { point: V3::zeros(), normal: V3::z() }, 0)
}

/// Mass of a sphere, kg.
pub(super) fn mass(radius: f64) -> f64 {
    DENSITY * 4.0 / 3.0 * std::f64::consts::PI * radius * radius * radius
}

/// Overlap at which a plane carries a sphere, m: m g = k δ^{3/2}.
pub(super) fn resting_overlap(young: f64, radius: f64, weight: f64) -> f64 {
    let stiffness = crate::exact::grains::collision::hertz_stiffness(young, POISSON, (radius, f64::INFINITY));
    libm::pow(weight / stiffness, 2.0 / 3.0)
}

/// Puts one sphere at its equilibrium overlap on the floor.
///
/// # Returns
/// The arm of friction over the radius, 1 − δ/r.
pub(super) fn rest_on_floor(s: &mut Setup, young: f64, gravity: V3) -> f64 {
    let overlap = resting_overlap(young, RADIUS, -mass(RADIUS) * gravity.z);
    s.gravity = gravity;
    s.walls = vec![floor()];
    s.start_overlap = 0.02;
    s.grains = vec![Grain::sphere(RADIUS, V3::z() * (RADIUS - overlap), 0)];
    1.0 - overlap / RADIUS
}

/// Two spheres approaching along x with relative speed `v` across a gap.
pub(super) fn head_on(mut s: Setup, radii: (f64, f64), v: f64, gap: f64) -> Setup {
    s.grains = vec![
        Grain::sphere(radii.0, V3::x() * -(radii.0 + 0.5 * gap), 0).moving(V3::x() * (0.5 * v)),
        Grain::sphere(radii.1, V3::x() * (radii.1 + 0.5 * gap), 0).moving(V3::x() * (-0.5 * v)),
    ];
    s.design_speed_m_s = v;
    s
}

/// A collision.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounce {
    /// Speed of separation over that of approach.
    pub restitution: f64,
    /// Time of contact, s.
    pub time: f64,
    /// Largest overlap, m.
    pub overlap: f64,
    /// Largest normal force, N.
    pub force: f64,
    /// Least normal force while the overlap was above zero, N.
    pub least_force: f64,
    /// Steps in contact without force: the cut-off at work.
    pub forceless_steps: u32,
}

/// Runs two spheres that touch at the start until they are apart.
///
/// Largest values are those of the parabola through the three samples at the top.
pub(super) fn bounce(s: &Setup) -> Result<Bounce, VerifyError> {
    /// A contact lasts `steps_per_contact` steps, a damped one a few times that.
    const LONGEST: f64 = 50.0;
    let mut d = Dem::new(s)?;
    let before = (d.bodies().velocity[0] - d.bodies().velocity[1]).norm();
    let (mut overlaps, mut forces) = (vec![0.0], vec![0.0]);
    let mut forceless_steps = 0;
    while (d.steps() as f64) < LONGEST * s.steps_per_contact {
        d.step(1)?;
        let Some(c) = d.contacts().next() else {
            let b = d.bodies();
            // Back to the moment of zero overlap, at constant speed.
            let (apart, speed) = ((b.position[1] - b.position[0]).x, (b.velocity[1] - b.velocity[0]).x);
            return Ok(Bounce {
                restitution: speed / before,
                time: d.time() - (apart - b.radius[0] - b.radius[1]) / speed,
                overlap: top(&overlaps),
                force: top(&forces),
                least_force: forces[1..].iter().copied().fold(f64::INFINITY, f64::min),
                forceless_steps,
            });
        };
        let force = c.force.dot(&c.normal);
        forceless_steps += u32::from(force == 0.0);
        overlaps.push(c.overlap);
        forces.push(force);
    }
    Err(VerifyError::Numerics { what: "collision", detail: "still in contact".into() })
}

/// Top of the parabola through the largest sample and its neighbours.
fn top(y: &[f64]) -> f64 {
    let k = (0..y.len()).max_by(|&i, &j| y[i].total_cmp(&y[j])).unwrap_or(0);
    if k == 0 || k + 1 >= y.len() {
        return y[k];
    }
    let (slope, bend) = (0.5 * (y[k + 1] - y[k - 1]), y[k + 1] - 2.0 * y[k] + y[k - 1]);
    if bend < 0.0 { y[k] - 0.5 * slope * slope / bend } else { y[k] }
}

/// A plane wall through `point`.
pub(super) fn plane(name: &str, point: V3, normal: V3) -> Wall {
    Wall::fixed(name, Surface::Plane { point, normal }, 0)
}

/// A wall of triangles, or of one of the closed shapes.
pub(super) fn wall(name: &str, surface: Surface) -> Wall {
    Wall::fixed(name, surface, 0)
}

/// The inside of an endless cylinder along y.
pub(super) fn trough(radius: f64) -> Surface {
    Surface::Cylinder {
        point: V3::z() * radius,
        axis: V3::y(),
        radius,
        half_length: None,
        side: Side::Inside,
    }
}

/// Three spheres of different sizes, no two principal moments alike.
pub(super) fn odd_clump() -> Result<lahar::dem::Clump, VerifyError> {
    let s = |x: f64, y: f64, z: f64, radius: f64| Sphere { centre: V3::new(x, y, z), radius };
    let spheres = [s(0.0, 0.0, 0.0, 1.0), s(1.2, 0.3, 0.1, 0.8), s(0.1, 1.3, -0.2, 0.6)];
    Ok(lahar::dem::Clump::new("odd", &spheres)?)
}

/// The largest of some errors; a NaN among them is the result.
pub(super) fn worst(errors: &[f64]) -> f64 {
    errors.iter().fold(0.0, |m: f64, &e| if e.abs() <= m { m } else { e.abs() })
}

/// Steps until a time is reached, s.
///
/// # Errors
/// What the grains refuse.
pub fn run_until(d: &mut Dem, time: f64) -> Result<(), DemError> {
    while d.time() < time {
        d.step(1)?;
    }
    Ok(())
}
