//! Volume and moments of the union of two spheres, and of spheres that do not overlap.

use core::f64::consts::PI;

/// Moments of a body of density one that is symmetric about the line of two centres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axial {
    /// m³.
    pub volume: f64,
    /// Centre of volume from the first sphere's centre towards the second's, m.
    pub centre: f64,
    /// Moment of inertia about the line of centres, m⁵.
    pub about_axis: f64,
    /// Moment of inertia about any line across it through the centre of volume, m⁵.
    pub across: f64,
}

/// Union of two spheres with radii `a`, `b` whose centres are `distance` apart.
///
/// Overlapping spheres meet in the plane x = (d² + a² − b²)/(2d); what is left of each is a sphere without a cap,
/// integrated slice by slice: ∫ π ρ² dx, ∫ ½ π ρ⁴ dx, with ρ² = r² − x².
///
/// # Arguments
/// All above zero, in one unit; |a − b| < distance (neither sphere inside the other).
pub fn union(a: f64, b: f64, distance: f64) -> Axial {
    let d = distance;
    let (cut_a, cut_b) = if d >= a + b {
        (a, b)
    } else {
        let plane = (d * d + a * a - b * b) / (2.0 * d);
        (plane, d - plane)
    };
    let (p, q) = (truncated(a, cut_a), truncated(b, cut_b));
    // The second sphere's axis points back to the first.
    let volume = p.volume + q.volume;
    let first = p.first + d * q.volume - q.first;
    let second = p.second + d * d * q.volume - 2.0 * d * q.first + q.second;
    let centre = first / volume;
    let about_axis = p.axial + q.axial;
    Axial { volume, centre, about_axis, across: 0.5 * about_axis + second - volume * centre * centre }
}

/// Integrals over the part of a sphere with x ≤ `cut`, x from its centre.
struct Part {
    volume: f64,
    first: f64,
    second: f64,
    axial: f64,
}

fn truncated(r: f64, cut: f64) -> Part {
    let power = |n: i32| {
        // ∫ xⁿ dx from −r to cut
        let pow = |x: f64| (0..=n).fold(1.0, |p, _| p * x);
        (pow(cut) - pow(-r)) / f64::from(n + 1)
    };
    let r2 = r * r;
    Part {
        volume: PI * (r2 * power(0) - power(2)),
        first: PI * (r2 * power(1) - power(3)),
        second: PI * (r2 * power(2) - power(4)),
        axial: 0.5 * PI * (r2 * r2 * power(0) - 2.0 * r2 * power(2) + power(4)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Apart: two spheres by the parallel-axis theorem. Overlapping: the lens 5π/12 of unit spheres at distance 1.
    #[test]
    fn exact_known_cases() {
        let m = |r: f64| 4.0 / 3.0 * PI * r * r * r;
        let u = union(1.0, 0.5, 2.0);
        let (p, q) = (m(1.0), m(0.5));
        assert!((u.volume / (p + q) - 1.0).abs() < 1e-15);
        assert!((u.centre / (2.0 * q / (p + q)) - 1.0).abs() < 1e-14);
        let own = 0.4 * (p + 0.25 * q);
        assert!((u.about_axis / own - 1.0).abs() < 1e-14);
        assert!((u.across / (own + 4.0 * p * q / (p + q)) - 1.0).abs() < 1e-14);
        assert!((union(1.0, 1.0, 1.0).volume / (PI * (8.0 / 3.0 - 5.0 / 12.0)) - 1.0).abs() < 1e-15);
    }

    /// Almost on top of each other: one sphere.
    #[test]
    fn limit_one_sphere() {
        let u = union(1.0, 1.0, 1e-9);
        let m = 4.0 / 3.0 * PI;
        assert!((u.volume / m - 1.0).abs() < 1e-8 && (u.across / (0.4 * m) - 1.0).abs() < 1e-8);
        assert!((u.about_axis / (0.4 * m) - 1.0).abs() < 1e-8);
    }
}
