//! Rest states of a fluid with a yield stress: on a slope, spread thin on horizontal ground, and
//! after the collapse of a tall column.

use super::ExactError;

/// f(r) = −r − ln(1 − r) = Σ_{j≥2} rʲ/j, r < 1.
fn log_excess(r: f64) -> f64 {
    if r.abs() > 0.1 { -r - libm::log1p(-r) } else { log_tail(r, 2) }
}

/// a(r) = f(r) − r²/2 = Σ_{j≥3} rʲ/j, r < 1.
fn log_excess_area(r: f64) -> f64 {
    if r.abs() > 0.1 { -r - 0.5 * r * r - libm::log1p(-r) } else { log_tail(r, 3) }
}

/// Σ_{j=first}^{20} rʲ/j; |r| ≤ 0.1, so that nothing of the rest is seen.
fn log_tail(r: f64, first: i32) -> f64 {
    (first..=20).rev().fold(0.0, |sum, j| sum * r + 1.0 / f64::from(j)) * (0..first).fold(1.0, |p, _| p * r)
}

/// Sheet of fluid at rest on a plane slope, at the point of yielding along its whole bed.
///
/// Downhill end, thinning towards x_f: x_f − x = −cot θ \[h + h_c ln(1 − h/h_c)\], h < h_c, where
/// h_c = σ0/(ρ g sin θ) is the uniform depth that just rests. Uphill end, yielding the other way:
/// x − x_r = cot θ \[h − h_c ln(1 + h/h_c)\]. Distances are measured along the bed from the edge
/// inwards, depths normal to it.
///
/// # Source
/// Liu & Mei 1989, J. Fluid Mech. 207, 505-529; the uphill end by the same balance
/// with the stress reversed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InclineRest {
    /// θ in radians, 0 < θ < π/2.
    pub slope: f64,
    /// h_c.
    pub critical_depth: f64,
}

/// Which edge of the sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// The front: depth below h_c.
    Downhill,
    /// The rear: any depth.
    Uphill,
}

impl InclineRest {
    /// For a fluid of yield stress σ0 and density ρ.
    ///
    /// # Errors
    /// `Argument` unless all are positive and θ < π/2.
    pub fn new(yield_stress: f64, density: f64, gravity: f64, slope: f64) -> Result<Self, ExactError> {
        for (what, value) in [
            ("yield_stress", yield_stress),
            ("density", density),
            ("gravity", gravity),
            ("slope", slope),
            ("pi/2 - slope", core::f64::consts::FRAC_PI_2 - slope),
        ] {
            ExactError::positive(what, value)?;
        }
        Ok(Self { slope, critical_depth: yield_stress / (density * gravity * libm::sin(slope)) })
    }

    fn cotangent(&self) -> f64 {
        1.0 / libm::tan(self.slope)
    }

    /// Distance from the edge at which the depth is h ≥ 0; infinite for h ≥ h_c downhill.
    pub fn distance(&self, edge: Edge, h: f64) -> f64 {
        let r = h / self.critical_depth;
        let scaled = match edge {
            Edge::Downhill if r >= 1.0 => f64::INFINITY,
            Edge::Downhill => log_excess(r),
            Edge::Uphill => log_excess(-r),
        };
        self.critical_depth * self.cotangent() * scaled
    }

    /// Depth at a distance from the edge; 0 beyond it. Bisection to the last bit, as h(x) has no
    /// closed form.
    pub fn depth(&self, edge: Edge, distance: f64) -> f64 {
        if distance <= 0.0 {
            return 0.0;
        }
        let mut high = match edge {
            Edge::Downhill => self.critical_depth,
            // r − ln(1 + r) ≥ r − 1 − r/2 and f ≥ r²/4 for r ≤ 1 bound r by 2 (f + 1).
            Edge::Uphill => 2.0 * (distance / self.cotangent() + self.critical_depth),
        };
        let mut low = 0.0;
        for _ in 0..1100 {
            let middle = 0.5 * (low + high);
            if middle == low || middle == high {
                break;
            }
            if self.distance(edge, middle) < distance {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }

    /// Area (volume per width) between the edge and the place where the depth is h.
    ///
    /// ∫₀^h h′ (dx/dh′) dh′ = cot θ h_c² \[−r − r²/2 − ln(1 − r)\], r = h/h_c; uphill its negative at −r.
    pub fn area(&self, edge: Edge, h: f64) -> f64 {
        let r = h / self.critical_depth;
        let scaled = match edge {
            Edge::Downhill if r >= 1.0 => f64::INFINITY,
            Edge::Downhill => log_excess_area(r),
            Edge::Uphill => -log_excess_area(-r),
        };
        self.critical_depth * self.critical_depth * self.cotangent() * scaled
    }
}

/// Deposit on horizontal ground that stopped spreading, h ≪ R: ρ g h |∂h/∂r| = σ0 everywhere.
///
/// # Source
/// Roussel & Coussot 2005, J. Rheol. 49, 705-718; planar: the same balance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpreadRest {
    /// 2 σ0/(ρ g).
    length: f64,
    /// Radius, or half-width.
    edge: f64,
}

impl SpreadRest {
    /// Round deposit of volume V: R = (225 ρ g V²/(128 π² σ0))^{1/5}.
    ///
    /// # Errors
    /// `Argument` unless all are positive.
    pub fn round(yield_stress: f64, density: f64, gravity: f64, volume: f64) -> Result<Self, ExactError> {
        let length = Self::length(yield_stress, density, gravity)?;
        ExactError::positive("volume", volume)?;
        // V = 2π ∫₀^R (ℓ (R − r))^½ r dr = (8π/15) ℓ^½ R^{5/2}.
        let ratio = 15.0 * volume / (8.0 * core::f64::consts::PI * length.sqrt());
        Ok(Self { length, edge: libm::pow(ratio, 0.4) })
    }

    /// Planar deposit with area A (volume per width) on one side of its middle:
    /// L = (9 A² ρ g/(8 σ0))^⅓.
    ///
    /// # Errors
    /// `Argument` unless all are positive.
    pub fn planar(yield_stress: f64, density: f64, gravity: f64, area: f64) -> Result<Self, ExactError> {
        let length = Self::length(yield_stress, density, gravity)?;
        ExactError::positive("area", area)?;
        // A = ∫₀^L (ℓ (L − x))^½ dx = ⅔ ℓ^½ L^{3/2}.
        Ok(Self { length, edge: libm::cbrt(2.25 * area * area / length) })
    }

    fn length(yield_stress: f64, density: f64, gravity: f64) -> Result<f64, ExactError> {
        ExactError::positive("yield_stress", yield_stress)?;
        ExactError::positive("density", density)?;
        ExactError::positive("gravity", gravity)?;
        Ok(2.0 * yield_stress / (density * gravity))
    }

    /// R or L.
    pub fn edge(&self) -> f64 {
        self.edge
    }

    /// h = (2 σ0 (R − |r|)/(ρ g))^½, 0 beyond the edge.
    pub fn height(&self, r: f64) -> f64 {
        (self.length * (self.edge - r.abs()).max(0.0)).sqrt()
    }
}

/// When a column yields under the weight above.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Criterion {
    /// Largest shear stress: uniaxial stress 2 σ0 (Murata, Pashias, Clayton).
    Tresca,
    /// Second invariant: uniaxial stress √3 σ0 (Roussel & Coussot), the law of this code.
    VonMises,
}

impl Criterion {
    /// Uniaxial yield stress over σ0.
    pub fn factor(self) -> f64 {
        match self {
            Self::Tresca => 2.0,
            Self::VonMises => 1.732_050_807_568_877_2,
        }
    }
}

/// Column, cone or frustum of height H that collapses under its weight, H ≫ R or free to slide at its
/// base: every horizontal slice stays horizontal and widens until its weight per area has fallen to
/// the uniaxial yield stress s = c σ0 (c = 2 or √3).
///
/// A slice at depth z below the top carries ρ g V(z)/A(z). Above the depth z0 where this reaches s
/// nothing yields. A slice below thins by A s/(ρ g V), so the yielded part ends up
/// ∫ (s/ρg) dV/V = (s/ρg) ln(V(H)/V(z0)) high. For a cylinder and Tresca: the slump over H is
/// 1 − 2τ′\[1 − ln(2τ′)\], τ′ = σ0/(ρ g H).
///
/// # Source
/// Murata 1984, Mater. Struct. 17, 117-129; Schowalter & Christensen 1998, J. Rheol. 42, 865-870
/// (cone); Pashias et al. 1996, J. Rheol. 40, 1179-1189 (cylinder); Clayton, Grice & Boger 2003, Int.
/// J. Miner. Process. 70, 3-21; Roussel & Coussot 2005, J. Rheol. 49, 705-718 (√3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TallColumn {
    /// H.
    pub height: f64,
    /// Radius at the top, ≥ 0.
    pub radius_top: f64,
    /// Radius at the base.
    pub radius_base: f64,
    /// σ0.
    pub yield_stress: f64,
    /// ρ.
    pub density: f64,
    /// g.
    pub gravity: f64,
    /// Yield criterion.
    pub criterion: Criterion,
}

/// What is left of a column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Collapsed {
    /// z0: the part on top that never yields; all of it if the column stands.
    pub unyielded: f64,
    /// Final height.
    pub height: f64,
    /// H minus the final height.
    pub slump: f64,
    /// Final radius of the base.
    pub base_radius: f64,
}

impl TallColumn {
    fn radius(&self, z: f64) -> f64 {
        self.radius_top + (self.radius_base - self.radius_top) * z / self.height
    }

    /// V(z)/π of the frustum above depth z.
    fn volume_over_pi(&self, z: f64) -> f64 {
        let r = self.radius(z);
        z * (self.radius_top * self.radius_top + self.radius_top * r + r * r) / 3.0
    }

    /// Weight over area at depth z below the top.
    pub fn stress(&self, z: f64) -> f64 {
        let r = self.radius(z);
        // At the tip of a cone both vanish; V/A → z/3.
        let depth = if r == 0.0 { 0.0 } else { self.volume_over_pi(z) / (r * r) };
        self.density * self.gravity * depth
    }

    /// The final state.
    ///
    /// # Errors
    /// `Argument` unless H, the base radius, ρ, g and σ0 are positive and the top radius is not
    /// negative.
    pub fn collapse(&self) -> Result<Collapsed, ExactError> {
        for (what, value) in [
            ("height", self.height),
            ("radius_base", self.radius_base),
            ("yield_stress", self.yield_stress),
            ("density", self.density),
            ("gravity", self.gravity),
        ] {
            ExactError::positive(what, value)?;
        }
        if !(self.radius_top >= 0.0 && self.radius_top.is_finite()) {
            return Err(ExactError::Argument {
                what: "radius_top",
                value: self.radius_top,
                allowed: "must be finite and not negative",
            });
        }
        let strength = self.criterion.factor() * self.yield_stress;
        if self.stress(self.height) <= strength {
            let standing = self.height;
            return Ok(Collapsed {
                unyielded: standing,
                height: standing,
                slump: 0.0,
                base_radius: self.radius_base,
            });
        }
        let unyielded = self.depth_of_stress(strength);
        let total = self.volume_over_pi(self.height);
        let pressure_length = strength / (self.density * self.gravity);
        let height = unyielded + pressure_length * libm::log(total / self.volume_over_pi(unyielded));
        Ok(Collapsed {
            unyielded,
            height,
            slump: self.height - height,
            base_radius: (total / pressure_length).sqrt(),
        })
    }

    /// The stress grows with z for every frustum: bisection.
    fn depth_of_stress(&self, stress: f64) -> f64 {
        let (mut low, mut high) = (0.0, self.height);
        for _ in 0..1100 {
            let middle = 0.5 * (low + high);
            if middle == low || middle == high {
                break;
            }
            if self.stress(middle) < stress {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }
}

#[cfg(test)]
mod tests;
