//! Bodies turning freely in simple shear u_x = γ̇ y, Stokes flow.

use core::f64::consts::PI;

use super::super::ExactError;

/// Spin of a sphere over the shear rate.
///
/// Fluid inertia lowers it: ½ − 0.1538 Re^{3/2} with Re = γ̇a²/ν (Lin, Peery & Schowalter 1970 as revised by Stone,
/// Lovalenti & Brady; from memory; 1e-3 at Re = 0.035).
pub const SPHERE_SPIN: f64 = 0.5;

/// Orbit of a body of revolution with effective aspect ratio r (along the axis over across).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JefferyOrbit {
    /// r > 0; a spheroid's own, or the effective one of another body of revolution (Bretherton).
    pub aspect_ratio: f64,
    /// γ̇ > 0.
    pub shear_rate: f64,
}

impl JefferyOrbit {
    /// Orbit of an effective aspect ratio in a shear rate.
    ///
    /// # Errors
    /// `Argument` unless both are positive.
    pub fn new(aspect_ratio: f64, shear_rate: f64) -> Result<Self, ExactError> {
        ExactError::positive("aspect_ratio", aspect_ratio)?;
        ExactError::positive("shear_rate", shear_rate)?;
        Ok(Self { aspect_ratio, shear_rate })
    }

    /// Time of a full turn (2π of φ), (2π/γ̇)(r + 1/r): the same in all orbits.
    ///
    /// # Source
    /// Jeffery 1922, Proc. R. Soc. Lond. A 102, 161-179, doi 10.1098/rspa.1922.0078; any body of revolution:
    /// Bretherton 1962, J. Fluid Mech. 14, 284-304, doi 10.1017/S002211206200124X.
    pub fn period(&self) -> f64 {
        2.0 * PI / self.shear_rate * (self.aspect_ratio + 1.0 / self.aspect_ratio)
    }

    /// dφ/dt = γ̇ (r² cos²φ + sin²φ)/(r² + 1), with φ the angle of the axis' projection on the plane of shear from the
    /// direction of the velocity *gradient* (y), positive towards the flow (x).
    pub fn rate(&self, phi: f64) -> f64 {
        let (r2, c, s) = (self.aspect_ratio * self.aspect_ratio, libm::cos(phi), libm::sin(phi));
        self.shear_rate * (r2 * c * c + s * s) / (r2 + 1.0)
    }

    /// φ(t), continuous, with φ(0) = `start`: tan φ = r tan(2πt/T + phase).
    pub fn phi(&self, t: f64, start: f64) -> f64 {
        let r = self.aspect_ratio;
        // The phase grows evenly; map φ to it and back, turn by turn.
        let phase = unwind(start, 1.0 / r) + 2.0 * PI * t / self.period();
        unwind(phase, r)
    }

    /// Angle θ of the axis from the vorticity (z) at φ: tan θ = C r/√(r² cos²φ + sin²φ); C = ∞ lies in the plane of
    /// shear, C = 0 along the vorticity.
    pub fn theta(&self, orbit_constant: f64, phi: f64) -> f64 {
        let (c, s) = (libm::cos(phi), libm::sin(phi));
        let r = self.aspect_ratio;
        libm::atan2(orbit_constant * r, (r * r * c * c + s * s).sqrt())
    }

    /// Effective aspect ratio of 1 or above from a measured period: T γ̇ = 2π(r + 1/r).
    ///
    /// # Errors
    /// `Argument` if the period is below that of a sphere, 4π/γ̇.
    pub fn from_period(period: f64, shear_rate: f64) -> Result<Self, ExactError> {
        ExactError::positive("shear_rate", shear_rate)?;
        let half = period * shear_rate / (4.0 * PI);
        super::within("period", half, 1.0, f64::MAX, "must be at least that of a sphere, 4 pi/rate")?;
        Self::new(half + ((half - 1.0) * (half + 1.0)).sqrt(), shear_rate)
    }
}

/// atan(factor tan x) on the branch of x.
fn unwind(x: f64, factor: f64) -> f64 {
    let turns = (x / PI).round();
    let rest = x - turns * PI;
    turns * PI + libm::atan2(factor * libm::sin(rest), libm::cos(rest))
}

/// Effective aspect ratio of two equal spheres joined at contact.
///
/// Not the geometric 2: the neck is filled by fluid that hardly moves. T γ̇ = 15.62.
///
/// # Source
/// Nir & Acrivos 1973, J. Fluid Mech. 59, 209-223, doi 10.1017/S0022112073001527 (the paper confirmed, the digits
/// 1.98 from memory; see [`chain`] for a value computed independently); Wakiya 1971, J. Phys. Soc. Japan 31, 1581.
pub const TOUCHING_PAIR: f64 = 1.98;

/// Largest number of spheres of [`chain`].
pub const LONGEST_CHAIN: usize = 5;

/// Spacings of the centres, in radii, of the columns of [`CHAINS`].
const SPACINGS: [f64; 4] = [1.25, 1.5, 1.75, 2.0];

/// Effective aspect ratio of straight rigid chains of 2, 3, 4 and 5 equal spheres (rows) at four spacings (columns).
///
/// Computed for this table with rings of fundamental solutions inside the spheres, least squares on the wetted surface:
/// r² = (1 + B)/(1 − B), B the torque in a strain over that in a rotation at the same rate. Two resolutions differ by
/// less than 4e-5 relative; two touching spheres give the known 1.98 and the known torque 3.740 · 8πμa³.
const CHAINS: [[f64; 4]; 4] = [
    [1.60434, 1.72900, 1.85477, 1.98165],
    [2.16381, 2.39512, 2.62663, 2.85837],
    [2.69693, 3.02800, 3.35853, 3.68864],
    [3.21246, 3.63963, 4.06574, 4.49102],
];

/// Effective aspect ratio of a straight rigid chain of equal, touching or overlapping spheres.
///
/// # Arguments
/// `spheres`: 1 to 5; `spacing`: distance of neighbouring centres in radii, 1.25 to 2 (touching).
/// # Exactness
/// 5e-5 relative at the spacings 1.25, 1.5, 1.75 and 2; cubic interpolation between them, 2e-4 measured.
/// # Errors
/// `Argument` outside the ranges.
/// # Source
/// Computed; for the touching pair also [`TOUCHING_PAIR`].
pub fn chain(spheres: usize, spacing: f64) -> Result<f64, ExactError> {
    super::within("spheres", spheres as f64, 1.0, LONGEST_CHAIN as f64, "must be 1 to 5")?;
    super::within("spacing", spacing, SPACINGS[0], SPACINGS[3], "must lie between 1.25 and 2 radii")?;
    let Some(row) = spheres.checked_sub(2).and_then(|i| CHAINS.get(i)) else {
        return Ok(1.0);
    };
    // Lagrange's polynomial.
    let mut sum = 0.0;
    for (i, value) in row.iter().enumerate() {
        let mut weight = *value;
        for (j, other) in SPACINGS.iter().enumerate() {
            if i != j {
                weight *= (spacing - other) / (SPACINGS[i] - other);
            }
        }
        sum += weight;
    }
    Ok(sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_period_and_rate() {
        for r in [0.3, 1.0, 2.0, 7.0] {
            let orbit = JefferyOrbit::new(r, 1.7).unwrap();
            assert!((orbit.period() * 1.7 / (2.0 * PI) - r - 1.0 / r).abs() < 1e-14 * (r + 1.0 / r));
            let (start, h) = (0.4, 1e-5);
            for t in [0.0, 0.6, 2.9, 8.3] {
                let slope = (orbit.phi(t + h, start) - orbit.phi(t - h, start)) / (2.0 * h);
                // Central difference: h² times a third derivative below 1e3.
                assert!((slope - orbit.rate(orbit.phi(t, start))).abs() < 1e-6, "{r} {t}");
            }
            assert!((orbit.phi(0.0, start) - start).abs() < 1e-15);
            let turned = orbit.phi(orbit.period(), start) - start;
            assert!((turned - 2.0 * PI).abs() < 1e-13, "{r} {turned}");
        }
        assert!((JefferyOrbit::new(2.0, 1.0).unwrap().period() - 15.70796).abs() < 1e-5);
    }

    #[test]
    fn limit_sphere() {
        let sphere = JefferyOrbit::new(1.0, 0.8).unwrap();
        assert!((sphere.rate(1.234) - SPHERE_SPIN * 0.8).abs() < 1e-15);
        assert!((sphere.phi(5.0, 0.2) - 2.2).abs() < 1e-14);
        assert_eq!(chain(1, 1.5).unwrap(), 1.0);
    }

    #[test]
    fn orbits_close_out_of_the_plane() {
        let orbit = JefferyOrbit::new(3.0, 1.0).unwrap();
        // In the plane of shear, and along the vorticity.
        assert!((orbit.theta(f64::MAX, 0.7) - 0.5 * PI).abs() < 1e-15);
        assert_eq!(orbit.theta(0.0, 0.7), 0.0);
        // dθ/dt = γ̇ (r² − 1)/(4(r² + 1)) sin 2θ sin 2φ.
        let (phi, h) = (0.9, 1e-6);
        let slope = (orbit.theta(0.5, phi + h) - orbit.theta(0.5, phi - h)) / (2.0 * h) * orbit.rate(phi);
        let theta = orbit.theta(0.5, phi);
        let known = 0.2 * libm::sin(2.0 * theta) * libm::sin(2.0 * phi);
        assert!((slope - known).abs() < 1e-9, "{slope} {known}");
    }

    #[test]
    fn effective_aspect_ratios() {
        assert!((chain(2, 2.0).unwrap() / TOUCHING_PAIR - 1.0).abs() < 1e-3);
        // Values between the spacings, computed in the same way as the table.
        for (n, spacing, value) in BETWEEN {
            assert!((chain(n, spacing).unwrap() / value - 1.0).abs() < 2e-4, "{n} {spacing}");
        }
        let pair = JefferyOrbit::new(chain(2, 2.0).unwrap(), 2.0).unwrap();
        let back = JefferyOrbit::from_period(pair.period(), 2.0).unwrap();
        assert!((back.aspect_ratio - pair.aspect_ratio).abs() < 1e-14);
        assert!(JefferyOrbit::from_period(1.0, 1.0).is_err());
        assert!(chain(6, 2.0).is_err() && chain(2, 1.0).is_err() && chain(0, 2.0).is_err());
    }

    /// (spheres, spacing, effective aspect ratio).
    const BETWEEN: [(usize, f64, f64); 3] = [(2, 1.6, 1.779_176), (4, 1.9, 3.556_665), (5, 1.35, 3.383_466)];
}
