//! Rigid clumps of spheres \[D4\].

use super::rotation::principal;
use super::sphere::Sphere;
use super::union_moments::{Moments, NODES, union};
use super::{DemError, Orientation, V3};
use nalgebra::{Matrix3, Rotation3};

/// Whether members can make up a clump.
fn check(name: &str, spheres: &[Sphere]) -> Result<(), DemError> {
    if spheres.is_empty() {
        return Err(DemError::EmptyClump { name: name.into() });
    }
    for (member, s) in spheres.iter().enumerate() {
        if !(s.radius > 0.0 && s.radius.is_finite()) {
            return Err(DemError::MemberRadius { name: name.into(), member, radius: s.radius });
        }
        if !s.centre.iter().all(|x| x.is_finite()) {
            return Err(DemError::MemberCentre { name: name.into(), member });
        }
    }
    Ok(())
}

/// A rigid clump in its own frame: origin at the centre of mass, axes along the principal axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Clump {
    /// Name used in messages.
    pub name: String,
    /// Members in the body frame.
    pub members: Vec<Sphere>,
    /// Volume of the union, m³.
    pub volume: f64,
    /// Principal moments of inertia of the union for density one, ascending, m⁵.
    pub inertia: V3,
    /// Centre of the union in the frame the members were given in, m.
    pub centre: V3,
    /// Turns body-frame vectors into the frame the members were given in.
    pub frame: Orientation,
    /// Largest distance of a point of the clump from its centre, m.
    pub reach: f64,
}

impl Clump {
    /// A clump from spheres in any frame, of the same density everywhere in their union.
    ///
    /// # Errors
    /// No member, a radius that is not above zero, a centre that is not finite.
    pub fn new(name: &str, spheres: &[Sphere]) -> Result<Self, DemError> {
        check(name, spheres)?;
        Self::with_moments(name, spheres, &union(spheres, NODES))
    }

    /// A clump whose volume, centre and moments of inertia are known otherwise.
    ///
    /// # Arguments
    /// `moments`: of density one, in the frame of the spheres.
    /// # Errors
    /// No member, a radius that is not above zero, a centre that is not finite.
    pub fn with_moments(name: &str, spheres: &[Sphere], moments: &Moments) -> Result<Self, DemError> {
        check(name, spheres)?;
        let (inertia, axes) = principal(&inertia_tensor(moments));
        let frame = Orientation::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
        let members: Vec<Sphere> = spheres
            .iter()
            .map(|s| Sphere {
                centre: frame.inverse_transform_vector(&(s.centre - moments.centre)),
                radius: s.radius,
            })
            .collect();
        let reach = members.iter().map(|s| s.centre.norm() + s.radius).fold(0.0, f64::max);
        Ok(Self {
            name: name.into(),
            members,
            volume: moments.volume,
            inertia,
            centre: moments.centre,
            frame,
            reach,
        })
    }

    /// Four equal spheres at the corners of a regular tetrahedron (000 Fig 1b).
    ///
    /// # Arguments
    /// * `radius` — of the members, m; `edge` — distance of their centres, m (2 × radius: they touch).
    /// # Errors
    /// No member, a radius that is not above zero, a centre that is not finite.
    pub fn tetrahedron(radius: f64, edge: f64) -> Result<Self, DemError> {
        let a = edge / 8f64.sqrt();
        let corner = |x: f64, y: f64, z: f64| Sphere { centre: V3::new(x * a, y * a, z * a), radius };
        Self::new(
            "tetrahedron",
            &[
                corner(1.0, 1.0, 1.0),
                corner(1.0, -1.0, -1.0),
                corner(-1.0, 1.0, -1.0),
                corner(-1.0, -1.0, 1.0),
            ],
        )
    }

    /// The clump scaled so that its volume is that of a sphere of radius `radius`.
    ///
    /// # Errors
    /// A radius that is not above zero.
    pub(crate) fn with_equivalent_radius(&self, radius: f64) -> Result<Self, DemError> {
        if !(radius > 0.0 && radius.is_finite()) {
            let name = self.name.clone();
            return Err(DemError::ClumpValue { name, what: "equivalent radius", found: radius });
        }
        let s = radius / self.equivalent_radius();
        let mut out = self.clone();
        for m in &mut out.members {
            m.centre *= s;
            m.radius *= s;
        }
        out.volume *= s * s * s;
        out.inertia *= s * s * s * s * s;
        out.centre *= s;
        out.reach *= s;
        Ok(out)
    }

    /// Radius of the sphere of the same volume, m.
    pub fn equivalent_radius(&self) -> f64 {
        libm::cbrt(0.75 * self.volume / std::f64::consts::PI)
    }
}

/// Inertia from second moments: I = tr(M) 1 − M.
fn inertia_tensor(m: &Moments) -> Matrix3<f64> {
    let [xx, yy, zz, xy, yz, zx] = m.second;
    Matrix3::new(yy + zz, -xy, -zx, -xy, zz + xx, -yz, -zx, -yz, xx + yy)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four touching spheres: I = 4 (2/5 m r² ) + 4 m (2/3) d², d² = 3/8 edge², isotropic.
    #[test]
    fn exact_touching_tetrahedron() {
        let c = Clump::tetrahedron(1.0, 2.0).unwrap();
        let m = 4.0 / 3.0 * std::f64::consts::PI;
        let exact = 4.0 * m * (0.4 + 2.0 / 3.0 * 1.5);
        assert!((c.volume / (4.0 * m) - 1.0).abs() < 1e-14);
        for k in 0..3 {
            assert!((c.inertia[k] / exact - 1.0).abs() < 1e-13);
        }
    }

    #[test]
    fn bad_members_are_refused() {
        assert!(matches!(Clump::new("c", &[]), Err(DemError::EmptyClump { .. })));
        let zero = Sphere { centre: V3::zeros(), radius: 0.0 };
        assert!(matches!(Clump::new("c", &[zero]), Err(DemError::MemberRadius { member: 0, .. })));
        let lost = Sphere { centre: V3::new(f64::NAN, 0.0, 0.0), radius: 1.0 };
        assert!(matches!(Clump::new("c", &[lost]), Err(DemError::MemberCentre { .. })));
    }

    /// An overlapping clump turned in space has the same principal moments, and its frame leads back.
    #[test]
    fn exact_principal_frame() {
        let spheres = [(0.0, 0.0, 0.0, 1.0), (1.2, 0.3, 0.1, 0.7), (0.1, 1.0, -0.2, 0.5)]
            .map(|(x, y, z, radius)| Sphere { centre: V3::new(x, y, z), radius });
        let c = Clump::new("c", &spheres).unwrap();
        for (m, s) in c.members.iter().zip(&spheres) {
            assert!((c.frame * m.centre + c.centre - s.centre).norm() < 1e-13);
        }
        let again = Clump::new("again", &c.members).unwrap();
        assert!(again.centre.norm() < 1e-11);
        assert!((again.inertia - c.inertia).norm() < 1e-10);
    }
}
