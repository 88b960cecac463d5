//! Newtonian dam breaks: inviscid (Ritter) and viscous currents on horizontal ground and on a slope
//! (Huppert).

use super::ExactError;
use super::thin_layer::Geometry;

/// Inviscid shallow-water dam break onto a dry horizontal bed: fluid of depth h0 fills x < 0, and
/// the dam at x = 0 vanishes at t = 0.
///
/// # Source
/// Ritter 1892, Z. Ver. Dtsch. Ing. 36, 947-954.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ritter {
    /// h0.
    pub depth: f64,
    /// g.
    pub gravity: f64,
}

impl Ritter {
    /// c0 = (g h0)^½, the speed at which the rarefaction eats into the reservoir.
    pub fn wave_speed(&self) -> f64 {
        (self.gravity * self.depth).sqrt()
    }

    /// x_f = 2 c0 t.
    pub fn front(&self, t: f64) -> f64 {
        2.0 * self.wave_speed() * t
    }

    /// h = (2 c0 − x/t)²/(9 g) for −c0 t < x < 2 c0 t; t > 0.
    pub fn height(&self, x: f64, t: f64) -> f64 {
        let c = self.wave_speed();
        let ratio = (x / t).clamp(-c, 2.0 * c);
        (2.0 * c - ratio) * (2.0 * c - ratio) / (9.0 * self.gravity)
    }

    /// u = ⅔ (x/t + c0) for −c0 t < x < 2 c0 t, 0 outside; t > 0.
    pub fn velocity(&self, x: f64, t: f64) -> f64 {
        let c = self.wave_speed();
        if x / t > 2.0 * c { 0.0 } else { (2.0 / 3.0) * (x / t + c).max(0.0) }
    }
}

/// Viscous gravity current of constant volume on horizontal ground, under an ambient of no density:
/// the similarity solution that every release tends to.
///
/// With y = x/x_N, h ∝ (1 − y²)^⅓. Planar: x_N = η (g A³/(3 ν))^{1/5} t^{1/5}, A the area on one side
/// of the plane of symmetry. Axisymmetric: r_N = η (g V³/(3 ν))^{1/8} t^{1/8}, V the whole volume.
///
/// # Source
/// Huppert 1982, J. Fluid Mech. 121, 43-58.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViscousCurrent {
    /// Planar or axisymmetric.
    pub geometry: Geometry,
    /// A (area on one side) or V.
    pub volume: f64,
    /// g.
    pub gravity: f64,
    /// ν, kinematic.
    pub viscosity: f64,
}

impl ViscousCurrent {
    /// η: \[(3/10)^⅓ ∫₀¹ (1 − y²)^⅓ dy\]^{−3/5} with ∫ = ½ B(½, 4/3), or (2¹⁰/(3⁴ π³))^{1/8}.
    pub fn prefactor(&self) -> f64 {
        const PI: f64 = core::f64::consts::PI;
        match self.geometry {
            Geometry::Planar => {
                let half_beta = 0.5 * PI.sqrt() * libm::tgamma(4.0 / 3.0) / libm::tgamma(11.0 / 6.0);
                libm::pow(libm::cbrt(0.3) * half_beta, -0.6)
            }
            Geometry::Axisymmetric => libm::pow(1024.0 / (81.0 * PI * PI * PI), 0.125),
        }
    }

    /// x_N or r_N at time t.
    pub fn front(&self, t: f64) -> f64 {
        let rate = self.gravity * self.volume * self.volume * self.volume / (3.0 * self.viscosity);
        self.prefactor() * libm::pow(rate * t, self.exponent())
    }

    /// The power of t the front grows with: 1/5 or 1/8.
    pub fn exponent(&self) -> f64 {
        match self.geometry {
            Geometry::Planar => 0.2,
            Geometry::Axisymmetric => 0.125,
        }
    }

    /// h(x, t) = h(0, t) (1 − (x/x_N)²)^⅓, 0 beyond the front.
    ///
    /// g h³/(3 ν) in the middle follows from the speed of the front:
    /// h(0,t)³ = (9/2) ν x_N ẋ_N/g with ẋ_N = m x_N/t.
    pub fn height(&self, x: f64, t: f64) -> f64 {
        let front = self.front(t);
        let y = x / front;
        if y.abs() >= 1.0 {
            return 0.0;
        }
        let middle = 4.5 * self.viscosity * self.exponent() * front * front / (self.gravity * t);
        libm::cbrt(middle * (1.0 - y * y))
    }
}

/// Viscous current of constant area A (per width) running down a slope, long after its release:
/// h = (ν x/(g sin θ t))^½ behind the front x_N = (9 A² g sin θ t/(4 ν))^⅓.
///
/// # Source
/// Huppert 1982, Nature 300, 427-429.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlopeCurrent {
    /// A.
    pub area: f64,
    /// g.
    pub gravity: f64,
    /// θ in radians, 0 < θ < π/2.
    pub slope: f64,
    /// ν, kinematic.
    pub viscosity: f64,
}

impl SlopeCurrent {
    /// x_N at time t.
    pub fn front(&self, t: f64) -> f64 {
        let down = self.gravity * libm::sin(self.slope);
        libm::cbrt(9.0 * self.area * self.area * down * t / (4.0 * self.viscosity))
    }

    /// h(x, t), 0 outside 0 ≤ x ≤ x_N.
    pub fn height(&self, x: f64, t: f64) -> f64 {
        if x < 0.0 || x > self.front(t) {
            return 0.0;
        }
        (self.viscosity * x / (self.gravity * libm::sin(self.slope) * t)).sqrt()
    }
}

/// Cell averages of a profile by five-point Gauss-Legendre quadrature in every cell \[i Δx, (i+1) Δx\],
/// scaled so that the total with the cells' sizes is exact: the start of a numerical run.
///
/// # Errors
/// `Argument` unless Δx and the total are positive, or if the profile vanishes in all cells.
pub fn cell_averages(
    profile: impl Fn(f64) -> f64,
    geometry: Geometry,
    dx: f64,
    cells: usize,
    total: f64,
) -> Result<Vec<f64>, ExactError> {
    /// Nodes on \[−1, 1\] and weights.
    const GAUSS: [(f64, f64); 5] = [
        (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
        (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
        (0.0, 0.568_888_888_888_888_9),
        (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
        (0.906_179_845_938_664, 0.236_926_885_056_189_1),
    ];
    ExactError::positive("dx", dx)?;
    ExactError::positive("total", total)?;
    let weight = |x: f64| match geometry {
        Geometry::Planar => 1.0,
        Geometry::Axisymmetric => 2.0 * core::f64::consts::PI * x,
    };
    let mut averages = Vec::with_capacity(cells);
    let mut sum = 0.0;
    for i in 0..cells {
        let centre = (i as f64 + 0.5) * dx;
        let point = |node: f64| centre + 0.5 * dx * node;
        let content: f64 =
            GAUSS.iter().map(|&(x, w)| 0.5 * w * dx * weight(point(x)) * profile(point(x))).sum();
        sum += content;
        averages.push(content / (weight(centre) * dx));
    }
    ExactError::positive("content", sum)?;
    Ok(averages.iter().map(|a| a * total / sum).collect())
}

#[cfg(test)]
mod tests {
    use super::super::quadrature::tanh_sinh;
    use super::*;
    use crate::reference_values::find;

    #[test]
    fn reference_ritter() {
        let entry = find("ritter", &[]).unwrap();
        let dam = Ritter { depth: entry.input("h0").unwrap(), gravity: 9.81 };
        let t = entry.input("t").unwrap();
        for (computed, field) in
            [(dam.front(t), "xf_1s"), (dam.height(0.0, t), "h_dam"), (dam.velocity(0.0, t), "u_dam")]
        {
            let reference = entry.field(field).unwrap();
            assert!((computed / reference - 1.0).abs() < entry.tolerance(), "{field} {computed}");
        }
    }

    #[test]
    fn conserves_volume_and_momentum_in_ritters_rarefaction() {
        let dam = Ritter { depth: 0.3, gravity: 9.81 };
        let (t, c) = (0.7, dam.wave_speed());
        let (back, front) = (-c * t, dam.front(t));
        let volume = tanh_sinh(back, front, |x| dam.height(x, t));
        let momentum = tanh_sinh(back, front, |x| dam.height(x, t) * dam.velocity(x, t));
        // The reservoir loses c0 t h0; the pressure ½ g h0² behind it acts for t. Quadrature: 2e-13.
        assert!((volume / (c * t * 0.3) - 1.0).abs() < 1e-12);
        assert!((momentum / (0.5 * 9.81 * 0.09 * t) - 1.0).abs() < 1e-12);
        assert_eq!((dam.height(-9.0, t), dam.velocity(-9.0, t)), (dam.height(back, t), 0.0));
        assert_eq!((dam.height(9.0, t), dam.velocity(9.0, t)), (0.0, 0.0));
    }

    fn current(geometry: Geometry) -> ViscousCurrent {
        ViscousCurrent { geometry, volume: 2e-3, gravity: 9.81, viscosity: 0.01 }
    }

    #[test]
    fn reference_prefactors() {
        let entry = find("huppert_axisym_etaN", &[]).unwrap();
        let axisymmetric = current(Geometry::Axisymmetric).prefactor();
        let error = axisymmetric / entry.number().unwrap() - 1.0;
        assert!(error.abs() < entry.tolerance(), "{axisymmetric}");
        // Huppert 1982 (J. Fluid Mech.) prints 1.411, three decimals.
        assert!((current(Geometry::Planar).prefactor() - 1.411).abs() < 6e-4);
    }

    #[test]
    fn profile_holds_the_volume_and_moves_with_its_front() {
        let planar = current(Geometry::Planar);
        let round = current(Geometry::Axisymmetric);
        for t in [0.3, 40.0] {
            let area = tanh_sinh(0.0, planar.front(t), |x| planar.height(x, t));
            let volume =
                2.0 * core::f64::consts::PI * tanh_sinh(0.0, round.front(t), |r| r * round.height(r, t));
            // (1 − y²)^⅓ formed from y near 1 loses half the digits of a tiny share of the integral.
            assert!((area / 2e-3 - 1.0).abs() < 1e-10, "{area}");
            assert!((volume / 2e-3 - 1.0).abs() < 1e-10, "{volume}");
            // The speed −g h² h_x/(3ν) of the fluid equals ẋ = m x/t everywhere in a similarity flow.
            for c in [planar, round] {
                let x = 0.6 * c.front(t);
                let step = 1e-4 * x;
                let slope = (c.height(x + step, t) - c.height(x - step, t)) / (2.0 * step);
                let speed = -c.gravity * c.height(x, t) * c.height(x, t) * slope / (3.0 * c.viscosity);
                // Truncation of the difference: (1e-4)² times a third derivative of order 10.
                assert!((speed / (c.exponent() * x / t) - 1.0).abs() < 1e-6, "{speed}");
            }
        }
    }

    #[test]
    fn slope_current_holds_its_area() {
        let current = SlopeCurrent { area: 0.03, gravity: 9.81, slope: 0.28, viscosity: 0.035 };
        let area = tanh_sinh(0.0, current.front(5.0), |x| current.height(x, 5.0));
        // Quadrature: 2e-13.
        assert!((area / 0.03 - 1.0).abs() < 1e-12);
        assert_eq!((current.height(-0.1, 1.0), current.height(99.0, 1.0)), (0.0, 0.0));
    }

    #[test]
    fn averages_are_scaled_to_the_total() {
        let round = current(Geometry::Axisymmetric);
        let dx = round.front(1.0) / 40.0;
        let averages = cell_averages(|r| round.height(r, 1.0), round.geometry, dx, 50, 2e-3).unwrap();
        let sum: f64 = averages.iter().enumerate().map(|(i, h)| (i as f64 + 0.5) * dx * dx * h).sum();
        // Rounding of 50 terms.
        assert!((2.0 * core::f64::consts::PI * sum / 2e-3 - 1.0).abs() < 1e-14);
        assert!(cell_averages(|_| 0.0, Geometry::Planar, 0.1, 5, 1.0).is_err());
    }
}
