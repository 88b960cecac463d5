//! Friction of gaps narrower than the lattice resolves \[C5\].

use std::f64::consts::PI;

/// Largest share of a pair's reduced mass over the grains' step that the friction of a gap may reach: an explicit
/// step overshoots beyond 2 and is accurate far below. Sub-steps are planned for it, and runs are held to it.
pub(crate) const STIFFEST: f64 = 0.5;

/// 6πμ (r₁r₂/(r₁+r₂))² (1/h − 1/h_c): normal friction of a gap, force per velocity of approach.
///
/// The lattice carries what the flow does at gaps above h_c; subtracting 1/h_c starts the correction from zero there.
///
/// # Arguments
/// `viscosity`: μ of the fluid in the gap. `reduced`: r₁r₂/(r₁+r₂), r against a plane. `gap`: h, `cutoff`: h_c, same
/// unit as the radii.
/// # Source
/// 000 Eq 15; docs/errata.md 35 (π is missing there; along the line of centres).
/// # Verified by
/// Claim `lubrication-approach`; mutant `lubrication-without-pi`.
#[must_use]
pub fn normal(viscosity: f64, reduced: f64, gap: f64, cutoff: f64) -> f64 {
    if gap >= cutoff {
        return 0.0;
    }
    6.0 * PI * viscosity * reduced * reduced * (1.0 / gap - 1.0 / cutoff)
}

/// Friction of a sheared gap between a sphere of radius `a` and one of radius `b` = β a: coefficients of
/// L = ln(h_c/h).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tangential {
    /// Force on either sphere per tangential velocity of the centres.
    pub force: f64,
    /// Torque on the first sphere per tangential velocity, and force per spin of the first.
    pub first: f64,
    /// Torque on the second sphere per tangential velocity, and force per spin of the second.
    pub second: f64,
    /// Torque on the first per its own spin, on the second per its own, and on one per the spin of the other.
    pub spins: [f64; 3],
}

/// Leading logarithms of the tangential resistance of two spheres.
///
/// # Arguments
/// `viscosity`: μ. `a`: radius of the first sphere. `b`: of the second; infinite for a plane. `gap`, `cutoff`: h, h_c.
/// # Exactness
/// A pair that turns as one body feels nothing (test `exact_rigid_pair`).
/// # Source
/// Jeffrey & Onishi 1984, J. Fluid Mech. 139, 261 (Y^A, Y^B, Y^C); for a plane Goldman, Cox & Brenner 1967.
/// # Verified by
/// Tests `exact_rigid_pair`, `reference_plane`.
#[must_use]
pub fn tangential(viscosity: f64, a: f64, b: f64, gap: f64, cutoff: f64) -> Tangential {
    if gap >= cutoff {
        return Tangential::default();
    }
    let log = libm::log(cutoff / gap);
    let scale = PI * viscosity * log;
    if b.is_infinite() {
        return Tangential {
            force: scale * a * (16.0 / 5.0),
            first: scale * a * a * (4.0 / 5.0),
            second: 0.0,
            spins: [scale * a * a * a * (16.0 / 5.0), 0.0, 0.0],
        };
    }
    let beta = b / a;
    let sum = 1.0 + beta;
    let square = sum * sum;
    Tangential {
        force: scale * a * (8.0 * beta * (2.0 + beta + 2.0 * beta * beta) / (5.0 * square * sum)),
        first: scale * a * a * (4.0 * beta * (4.0 + beta) / (5.0 * square)),
        second: scale * b * b * (4.0 * (4.0 * beta + 1.0) / (5.0 * square)),
        spins: [
            scale * a * a * a * (16.0 * beta / (5.0 * sum)),
            scale * b * b * b * (16.0 / (5.0 * sum)),
            scale * a * a * a * (4.0 * beta * beta / (5.0 * sum)),
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_rigid_pair() {
        // Two spheres that turn about any point as one body: x₁ − x₂ = (a + b) n.
        for (a, b) in [(1.0, 1.0), (2.0, 0.3), (0.7, 5.0)] {
            let t = tangential(0.3, a, b, 1e-3, 0.5);
            let speed = -(a + b); // of n × ω
            let force = -t.force * speed - t.first - t.second;
            let first = -(t.first * speed) - t.spins[0] - t.spins[2];
            let second = -(t.second * speed) - t.spins[1] - t.spins[2];
            for (sum, size) in [(force, t.first), (first, t.spins[0]), (second, t.spins[1])] {
                // A dozen roundings.
                assert!(sum.abs() < 1e-14 * size.max(1.0), "{sum} {size}");
            }
        }
    }

    #[test]
    fn reference_plane() {
        // Goldman, Cox & Brenner 1967: 6πμa (8/15), 8πμa² (1/10), 8πμa³ (2/5), each times ln(a/h).
        let t = tangential(1.0, 2.0, f64::INFINITY, 0.01, 1.0);
        let log = libm::log(100.0);
        assert!((t.force - 6.0 * PI * 2.0 * 8.0 / 15.0 * log).abs() < 1e-12);
        assert!((t.first - 8.0 * PI * 4.0 * 0.1 * log).abs() < 1e-12);
        assert!((t.spins[0] - 8.0 * PI * 8.0 * 0.4 * log).abs() < 1e-12);
        // A large sphere is nearly a plane; what is left falls like a/b.
        let large = tangential(1.0, 2.0, 2e5, 0.01, 1.0);
        assert!((large.force / t.force - 1.0).abs() < 1e-4 && (large.first / t.first - 1.0).abs() < 1e-4);
    }

    #[test]
    fn exact_normal_at_the_cutoff() {
        assert_eq!(normal(1.0, 1.0, 0.5, 0.5), 0.0);
        assert!((normal(1.0, 1.0, 0.1, 0.5) - 6.0 * PI * 8.0).abs() < 1e-12);
    }
}
