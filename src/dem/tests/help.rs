//! Common set-ups.

use crate::dem::*;

pub(crate) fn glass() -> Material {
    Material { name: "glass".into(), density_kg_m3: 2650.0, young_pa: 70e9, poisson: 0.22 }
}

/// Softer than glass by 1e4: contacts last 40 times longer.
pub(crate) fn soft() -> Material {
    Material { name: "soft".into(), density_kg_m3: 2650.0, young_pa: 7e6, poisson: 0.22 }
}

/// Softer than glass by 100.
pub(crate) fn firm() -> Material {
    Material { name: "firm".into(), young_pa: 7e8, ..soft() }
}

pub(crate) fn elastic() -> PairProperties {
    PairProperties {
        normal: NormalLaw::ViscoElastic { time_s: 0.0 },
        friction: 0.0,
        rolling_friction: 0.0,
        tangential_damping: 0.0,
    }
}

pub(crate) fn setup(material: Material, pair: PairProperties) -> Setup {
    Setup::new(Materials::single(material, pair))
}

pub(crate) fn floor() -> Wall {
    Wall::fixed("floor", Surface::Plane { point: V3::zeros(), normal: V3::z() }, 0)
}

/// Two equal spheres flying at each other along x with relative speed `v`, just touching.
pub(crate) fn head_on(mut s: Setup, radius: f64, v: f64) -> Setup {
    let x = V3::x() * radius;
    s.grains = vec![
        Grain::sphere(radius, -x, 0).moving(V3::x() * (0.5 * v)),
        Grain::sphere(radius, x, 0).moving(V3::x() * (-0.5 * v)),
    ];
    s.design_speed_m_s = v;
    s
}

/// Runs until the pair is apart again; returns restitution, duration and largest overlap.
pub(crate) fn bounce(s: &Setup) -> (f64, f64, f64) {
    let mut d = Dem::new(s).unwrap();
    let v0 = (d.bodies().velocity[0] - d.bodies().velocity[1]).norm();
    let mut deepest = 0.0f64;
    loop {
        d.step(1).unwrap();
        match d.contacts().next() {
            Some(c) => deepest = deepest.max(c.overlap),
            None => break,
        }
    }
    ((d.bodies().velocity[1] - d.bodies().velocity[0]).x / v0, d.time(), deepest)
}

/// Contact mechanics with one statement wrong, or none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Trial {
    Right,
    SpringNotRotated,
    NoCoulombCap,
    ReversedProduct,
}

impl ContactEquations for Trial {
    fn rotate_spring(&self, s: &V3, n0: &V3, n: &V3, twist: f64) -> V3 {
        match self {
            Self::SpringNotRotated => *s,
            _ => StandardContact.rotate_spring(s, n0, n, twist),
        }
    }

    fn friction_cap(&self, friction: f64, normal_force: f64) -> f64 {
        match self {
            Self::NoCoulombCap => f64::MAX,
            _ => StandardContact.friction_cap(friction, normal_force),
        }
    }

    fn surface_velocity(&self, v: &V3, omega: &V3, r: &V3) -> V3 {
        match self {
            Self::ReversedProduct => v + r.cross(omega),
            _ => StandardContact.surface_velocity(v, omega, r),
        }
    }
}
