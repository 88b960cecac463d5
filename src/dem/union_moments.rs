//! Volume, centre and inertia of a union of spheres.
//!
//! Slices: at height z the union is a union of discs, whose area and moments follow exactly from the visible
//! arcs of its boundary (Green's theorem). Along z the slices are integrated piecewise between heights where
//! their topology can change (poles of spheres, extremes of circles common to two spheres, points common to
//! three), with Gauss–Legendre nodes after the substitution z = a + (b − a) t³(10 − 15 t + 6 t²), which turns
//! the half-integer powers at the ends of a piece into smooth functions. The error therefore falls faster than
//! any power of the number of nodes; `NODES` leaves round-off only.

use super::V3;
use super::sphere::Sphere;

/// Gauss–Legendre nodes per piece used by clumps.
pub(crate) const NODES: usize = 40;
/// Above this number of members, points common to three spheres are not used as ends of pieces.
const TRIPLES_UP_TO: usize = 40;
const TAU: f64 = 2.0 * std::f64::consts::PI;

/// Moments of a solid of density one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moments {
    /// Volume, m³.
    pub volume: f64,
    /// Centre of volume, m.
    pub centre: V3,
    /// ∫ x xᵀ dV about the centre: xx, yy, zz, xy, yz, zx, m⁵.
    pub second: [f64; 6],
}

/// Raw moments: 1, x, y, z, xx, yy, zz, xy, yz, zx.
type Raw = [f64; 10];

/// Moments of one sphere.
fn sphere_raw(s: &Sphere) -> Raw {
    let v = 4.0 / 3.0 * std::f64::consts::PI * s.radius * s.radius * s.radius;
    let own = v * s.radius * s.radius / 5.0;
    let c = s.centre;
    [
        v,
        v * c.x,
        v * c.y,
        v * c.z,
        v * c.x * c.x + own,
        v * c.y * c.y + own,
        v * c.z * c.z + own,
        v * c.x * c.y,
        v * c.y * c.z,
        v * c.z * c.x,
    ]
}

fn about_centre(m: &Raw) -> Moments {
    let v = m[0];
    let c = V3::new(m[1] / v, m[2] / v, m[3] / v);
    Moments {
        volume: v,
        centre: c,
        second: [
            m[4] - v * c.x * c.x,
            m[5] - v * c.y * c.y,
            m[6] - v * c.z * c.z,
            m[7] - v * c.x * c.y,
            m[8] - v * c.y * c.z,
            m[9] - v * c.z * c.x,
        ],
    }
}

/// Moments as if the spheres did not overlap: exact if they do not, wrong otherwise.
pub fn sum_of_spheres(spheres: &[Sphere]) -> Moments {
    let mut m = [0.0; 10];
    for s in spheres {
        add(&mut m, &sphere_raw(s), 1.0);
    }
    about_centre(&m)
}

/// Moments of the union, with `nodes` Gauss–Legendre nodes per piece.
///
/// # Source
/// Derived here; closed form of two spheres (cap integrals) in the tests.
/// # Verified by
/// `exact_two_spheres_overlapping`, `converges_three_spheres`.
pub fn union(spheres: &[Sphere], nodes: usize) -> Moments {
    let apart = |a: &Sphere, b: &Sphere| (a.centre - b.centre).norm() >= a.radius + b.radius;
    if (0..spheres.len()).all(|i| (0..i).all(|j| apart(&spheres[i], &spheres[j]))) {
        return sum_of_spheres(spheres);
    }
    let ends = heights(spheres);
    let (xs, ws) = gauss_legendre(nodes);
    let mut m = [0.0; 10];
    for piece in ends.windows(2) {
        let (a, length) = (piece[0], piece[1] - piece[0]);
        for (x, w) in xs.iter().zip(&ws) {
            let t = 0.5 * (x + 1.0);
            let z = a + length * (t * t * t * (10.0 - 15.0 * t + 6.0 * t * t));
            let dz = 0.5 * w * length * 30.0 * t * t * (1.0 - t) * (1.0 - t);
            let d = slice(spheres, z);
            let at = [d[0], d[1], d[2], z * d[0], d[3], d[4], z * z * d[0], d[5], z * d[2], z * d[1]];
            add(&mut m, &at, dz);
        }
    }
    about_centre(&m)
}

fn add(m: &mut Raw, other: &Raw, weight: f64) {
    for k in 0..10 {
        m[k] += weight * other[k];
    }
}

/// Heights at which the topology of the slices may change, ascending, within the union.
fn heights(spheres: &[Sphere]) -> Vec<f64> {
    let mut z: Vec<f64> =
        spheres.iter().flat_map(|s| [s.centre.z - s.radius, s.centre.z + s.radius]).collect();
    let (low, high) = z.iter().fold((f64::MAX, f64::MIN), |(l, h), &x| (l.min(x), h.max(x)));
    for i in 0..spheres.len() {
        for j in 0..i {
            let Some((centre, axis, rho)) = circle(&spheres[i], &spheres[j]) else { continue };
            let reach = rho * (1.0 - axis.z * axis.z).max(0.0).sqrt();
            z.extend([centre.z - reach, centre.z + reach]);
            if spheres.len() > TRIPLES_UP_TO {
                continue;
            }
            for k in 0..j {
                if let Some((c2, axis2, _)) = circle(&spheres[i], &spheres[k]) {
                    z.extend(common_points(&centre, &axis, rho, &c2, &axis2).into_iter().flatten());
                }
            }
        }
    }
    z.retain(|&x| x >= low && x <= high);
    z.sort_by(f64::total_cmp);
    let tiny = 1e-13 * (high - low);
    z.dedup_by(|b, a| *b - *a < tiny);
    z
}

/// Circle common to two spheres: centre, axis, radius.
fn circle(a: &Sphere, b: &Sphere) -> Option<(V3, V3, f64)> {
    let d = b.centre - a.centre;
    let length = d.norm();
    if length == 0.0 || length >= a.radius + b.radius || length <= (a.radius - b.radius).abs() {
        return None;
    }
    let axis = d / length;
    let along = (length * length + a.radius * a.radius - b.radius * b.radius) / (2.0 * length);
    Some((a.centre + axis * along, axis, (a.radius * a.radius - along * along).max(0.0).sqrt()))
}

/// Heights of the points where a circle (centre, axis, radius) meets the plane (point, normal).
fn common_points(centre: &V3, axis: &V3, rho: f64, point: &V3, normal: &V3) -> [Option<f64>; 2] {
    let line = axis.cross(normal);
    let size2 = line.norm_squared();
    if size2 < 1e-20 {
        return [None, None];
    }
    // Foot of the circle's centre on the line common to both planes.
    let foot = centre + line.cross(axis) * ((point - centre).dot(normal) / size2);
    let rest = rho * rho - (foot - centre).norm_squared();
    if rest < 0.0 {
        return [None, None];
    }
    let step = line.z * (rest / size2).sqrt();
    [Some(foot.z - step), Some(foot.z + step)]
}

/// Area, x, y, xx, yy, xy of the union of discs at height z.
fn slice(spheres: &[Sphere], z: f64) -> [f64; 6] {
    let discs: Vec<(f64, f64, f64)> = spheres
        .iter()
        .filter_map(|s| {
            let h = z - s.centre.z;
            let r2 = s.radius * s.radius - h * h;
            (r2 > 0.0).then(|| (s.centre.x, s.centre.y, r2.sqrt()))
        })
        .collect();
    let mut sum = [0.0; 6];
    let mut hidden: Vec<(f64, f64)> = Vec::new();
    for (i, d) in discs.iter().enumerate() {
        if !hidden_arcs(&discs, i, &mut hidden) {
            continue;
        }
        hidden.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut at = 0.0;
        for &(from, to) in &hidden {
            if from > at {
                arc(d, at, from, &mut sum);
            }
            at = if to > at { to } else { at };
        }
        if at < TAU {
            arc(d, at, TAU, &mut sum);
        }
    }
    sum
}

/// Arcs of disc `i` inside other discs, within \[0, 2π\]; false if all of it is hidden.
fn hidden_arcs(discs: &[(f64, f64, f64)], i: usize, out: &mut Vec<(f64, f64)>) -> bool {
    out.clear();
    let (x, y, r) = discs[i];
    for (j, &(xj, yj, rj)) in discs.iter().enumerate() {
        if j == i {
            continue;
        }
        let (dx, dy) = (xj - x, yj - y);
        let d = (dx * dx + dy * dy).sqrt();
        // Of equal discs only the first counts.
        if d + r < rj || (d + r <= rj && (d > 0.0 || r < rj || j < i)) {
            return false;
        }
        if d >= r + rj || d + rj <= r {
            continue;
        }
        let half = libm::acos(((d * d + r * r - rj * rj) / (2.0 * d * r)).clamp(-1.0, 1.0));
        let mid = libm::atan2(dy, dx);
        let mut from = mid - half;
        if from < 0.0 {
            from += TAU;
        }
        let to = from + 2.0 * half;
        if to > TAU {
            out.push((from, TAU));
            out.push((0.0, to - TAU));
        } else {
            out.push((from, to));
        }
    }
    true
}

/// Adds the boundary integrals of an arc from angle `a` to `b`, counter-clockwise.
fn arc(disc: &(f64, f64, f64), a: f64, b: f64, sum: &mut [f64; 6]) {
    let (x, y, r) = *disc;
    let t = b - a;
    let (s1, c1) = (libm::sin(a), libm::cos(a));
    let (s2, c2) = (libm::sin(b), libm::cos(b));
    // Integrals over the arc of cos, sin, cos², sin², cos sin, cos³, sin³, cos⁴, sin⁴, cos²sin, cos sin², …
    let ic = s2 - s1;
    let is = c1 - c2;
    let ics = 0.5 * (s2 * s2 - s1 * s1);
    let icc = 0.5 * (t + s2 * c2 - s1 * c1);
    let iss = t - icc;
    let cube = |p: f64| p * p * p;
    let ic2s = (cube(c1) - cube(c2)) / 3.0;
    let is2c = (cube(s2) - cube(s1)) / 3.0;
    let ic3 = ic - is2c;
    let is3 = is - ic2s;
    let ic4 = 0.25 * (cube(c2) * s2 - cube(c1) * s1) + 0.75 * icc;
    let ic2s2 = icc - ic4;
    let is4 = iss - ic2s2;
    let ic3s = 0.25 * (cube(c1) * c1 - cube(c2) * c2);
    let (r2, r3) = (r * r, r * r * r);
    // 1/2 ∮ x dy − y dx
    sum[0] += 0.5 * (r2 * t + r * (x * ic + y * is));
    // 1/2 ∮ x² dy
    sum[1] += 0.5 * r * (x * x * ic + 2.0 * x * r * icc + r2 * ic3);
    // −1/2 ∮ y² dx
    sum[2] += 0.5 * r * (y * y * is + 2.0 * y * r * iss + r2 * is3);
    // 1/3 ∮ x³ dy
    sum[3] += r / 3.0 * (x * x * x * ic + 3.0 * x * x * r * icc + 3.0 * x * r2 * ic3 + r3 * ic4);
    // −1/3 ∮ y³ dx
    sum[4] += r / 3.0 * (y * y * y * is + 3.0 * y * y * r * iss + 3.0 * y * r2 * is3 + r3 * is4);
    // 1/2 ∮ x² y dy
    sum[5] += 0.5
        * r
        * (x * x * y * ic
            + r * (2.0 * x * y * icc + x * x * ics)
            + r2 * (y * ic3 + 2.0 * x * ic2s)
            + r3 * ic3s);
}

/// Nodes and weights of Gauss–Legendre quadrature on \[−1, 1\].
fn gauss_legendre(n: usize) -> (Vec<f64>, Vec<f64>) {
    let mut xs = vec![0.0; n];
    let mut ws = vec![0.0; n];
    for i in 0..n {
        let mut x = libm::cos(std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5));
        let mut slope = 1.0;
        for _ in 0..100 {
            let (mut p0, mut p1) = (1.0, x);
            for k in 2..=n {
                let k = k as f64;
                (p0, p1) = (p1, ((2.0 * k - 1.0) * x * p1 - (k - 1.0) * p0) / k);
            }
            slope = n as f64 * (x * p1 - p0) / (x * x - 1.0);
            let step = p1 / slope;
            x -= step;
            if step.abs() < 1e-15 {
                break;
            }
        }
        xs[i] = x;
        ws[i] = 2.0 / ((1.0 - x * x) * slope * slope);
    }
    (xs, ws)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sphere(x: f64, y: f64, z: f64, radius: f64) -> Sphere {
        Sphere { centre: V3::new(x, y, z), radius }
    }

    /// Volume and moments of two equal spheres, radius 1, centres at ±d on the axis, by cap integrals:
    /// half of the body is ∫ π(1 − (s − d)²) ds over s in [0, d + 1].
    fn two(d: f64) -> (f64, f64, f64) {
        let p = std::f64::consts::PI;
        let int = |n: i32| {
            // ∫_{-d}^{1} (1 − w²)(w + d)^n dw by binomials, n = 0, 2; ∫ (1 − w²)² for the transverse moment.
            let m = |k: f64| (1.0 - (libm::pow(-d, k))) / k;
            match n {
                0 => m(1.0) - m(3.0),
                2 => (m(3.0) - m(5.0)) + 2.0 * d * (m(2.0) - m(4.0)) + d * d * (m(1.0) - m(3.0)),
                _ => m(1.0) - 2.0 * m(3.0) + m(5.0),
            }
        };
        (2.0 * p * int(0), 2.0 * p * int(2), 2.0 * p * 0.25 * int(-1))
    }

    #[test]
    fn exact_two_spheres_overlapping() {
        for d in [0.2, 0.5, 0.9] {
            let (v, along, across) = two(d);
            for axis in [V3::x(), V3::z(), V3::new(1.0, 2.0, -0.5).normalize()] {
                let list: Vec<Sphere> =
                    [-d, d].iter().map(|s| Sphere { centre: axis * *s, radius: 1.0 }).collect();
                let m = union(&list, NODES);
                let s = m.second;
                let matrix = nalgebra::Matrix3::new(s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]);
                let got = axis.dot(&(matrix * axis));
                // Round-off of about 100 nodes summed.
                assert!((m.volume / v - 1.0).abs() < 1e-12, "{} {v}", m.volume);
                assert!((got / along - 1.0).abs() < 1e-12, "{got} {along}");
                assert!(((matrix.trace() - got) / (2.0 * across) - 1.0).abs() < 1e-12);
                assert!(m.centre.norm() < 1e-12);
            }
        }
    }

    #[test]
    fn exact_when_apart_or_nested() {
        let apart = [sphere(0.0, 0.0, 0.0, 1.0), sphere(3.0, 0.0, 0.0, 2.0)];
        assert_eq!(union(&apart, NODES), sum_of_spheres(&apart));
        let nested = [sphere(0.1, 0.2, 0.0, 1.0), sphere(0.3, 0.2, 0.1, 0.3), sphere(0.1, 0.2, 0.0, 1.0)];
        let one = sum_of_spheres(&nested[..1]);
        let all = union(&nested, NODES);
        assert!((all.volume / one.volume - 1.0).abs() < 1e-13);
        for k in 0..6 {
            assert!((all.second[k] - one.second[k]).abs() < 1e-13);
        }
    }

    /// Three spheres with a common region: rotating the body must not change the invariants, and the error
    /// falls quickly with the number of nodes.
    #[test]
    fn converges_three_spheres() {
        let body = [sphere(0.0, 0.0, 0.0, 1.0), sphere(0.9, 0.1, 0.2, 0.8), sphere(0.3, 0.8, -0.1, 0.7)];
        let best = union(&body, 160).volume;
        let error = |n| (union(&body, n).volume / best - 1.0).abs();
        println!("{:?}", [10, 20, 30, 40, 60, 80].map(|n| (n, error(n))));
        assert!(error(10) > error(20) && error(20) > error(40) && error(40) < 1e-11);
        let q = nalgebra::UnitQuaternion::new_normalize(nalgebra::Quaternion::new(0.3, 0.5, -0.2, 0.8));
        let turned: Vec<Sphere> =
            body.iter().map(|s| Sphere { centre: q * s.centre, radius: s.radius }).collect();
        let (a, b) = (union(&body, NODES), union(&turned, NODES));
        assert!((a.volume / b.volume - 1.0).abs() < 1e-11);
        assert!((q * a.centre - b.centre).norm() < 1e-11);
        let trace = |m: &Moments| m.second[0] + m.second[1] + m.second[2];
        assert!((trace(&a) / trace(&b) - 1.0).abs() < 1e-11);
    }
}
