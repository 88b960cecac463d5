//! Nearest points of the simple shapes.

use super::{Near, Side, Surface};
use crate::dem::V3;

/// Collects the points of `surface` nearer to `x` than `reach`.
///
/// A box around grains gives one point per face in reach; every convex obstacle gives exactly one point, so a
/// grain on an edge or a corner has one contact.
/// # Source
/// docs/method.md \[D5\].
/// # Verified by
/// `wall_shapes_nearest_points`, `mesh_edge_gives_one_contact`.
pub(crate) fn near(surface: &Surface, x: &V3, reach: f64, triangles: Option<&[u32]>, out: &mut Vec<Near>) {
    let (normal, distance) = match surface {
        Surface::Plane { point, normal } => (*normal, (x - point).dot(normal)),
        Surface::Cylinder { point, axis, radius, half_length, side } => {
            let (along, rho, out_of_axis) = cylindrical(&(x - point), axis);
            match (side, half_length) {
                (Side::Inside, _) => (-out_of_axis, radius - rho),
                (Side::Outside, None) => (out_of_axis, rho - radius),
                (Side::Outside, Some(h)) => {
                    let cap = axis * along.signum();
                    out_of_disc((cap, along.abs() - h), (out_of_axis, rho - radius))
                }
            }
        }
        Surface::Sphere { centre, radius, side } => {
            let d = x - centre;
            let rho = d.norm();
            let n = if rho > 0.0 { d / rho } else { V3::z() };
            match side {
                Side::Inside => (-n, radius - rho),
                Side::Outside => (n, rho - radius),
            }
        }
        Surface::Box { centre, half, orientation, side } => {
            let l = orientation.inverse_transform_vector(&(x - centre));
            if *side == Side::Inside {
                return out.extend(
                    faces(&l, half)
                        .filter(|near| near.distance < reach)
                        .map(|near| Near { normal: orientation * near.normal, ..near }),
                );
            }
            let (normal, distance) = out_of_box(&l, half);
            (orientation * normal, distance)
        }
        Surface::Mesh(mesh) => return mesh.near(x, reach, triangles, out),
    };
    if distance < reach {
        out.push(Near { normal, distance, feature: 0 });
    }
}

/// Place along an axis, distance from it, and the unit vector away from it.
fn cylindrical(d: &V3, axis: &V3) -> (f64, f64, V3) {
    let along = d.dot(axis);
    let radial = d - axis * along;
    let rho = radial.norm();
    (along, rho, if rho > 0.0 { radial / rho } else { any_normal(axis) })
}

/// Normal and distance of a cylinder with ends; `cap`, `side`: their normals and the distances beyond them.
fn out_of_disc((cap, beyond): (V3, f64), (side, side_gap): (V3, f64)) -> (V3, f64) {
    if beyond <= 0.0 && side_gap >= beyond {
        (side, side_gap)
    } else if side_gap <= 0.0 {
        (cap, beyond)
    } else {
        let v = cap * beyond + side * side_gap;
        let size = v.norm();
        (v / size, size)
    }
}

/// The faces of a box around `l`, box frame.
fn faces<'a>(l: &'a V3, half: &'a V3) -> impl Iterator<Item = Near> + 'a {
    (0..3).flat_map(move |k| {
        [(0, 1.0), (1, -1.0)].map(|(f, sign)| {
            let mut normal = V3::zeros();
            normal[k] = -sign;
            Near { normal, distance: half[k] - sign * l[k], feature: 2 * k as u32 + f }
        })
    })
}

/// Normal and distance of a box seen from outside, box frame.
fn out_of_box(l: &V3, half: &V3) -> (V3, f64) {
    let beyond = l.abs() - half;
    let outside = beyond.map(|b| if b > 0.0 { b } else { 0.0 });
    let size = outside.norm();
    if size > 0.0 {
        return (outside.component_mul(&l.map(f64::signum)) / size, size);
    }
    let k = beyond.imax();
    let mut n = V3::zeros();
    n[k] = l[k].signum();
    (n, beyond[k])
}

/// Some unit vector at right angles to `axis`.
fn any_normal(axis: &V3) -> V3 {
    let other = if axis.x.abs() < 0.6 { V3::x() } else { V3::y() };
    axis.cross(&other).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::Orientation;

    #[test]
    fn wall_shapes_nearest_points() {
        let one = |s: &Surface, x: V3| {
            let mut out = Vec::new();
            near(s, &x, 10.0, None, &mut out);
            out
        };
        let cap = Surface::Cylinder {
            point: V3::zeros(),
            axis: V3::z(),
            radius: 1.0,
            half_length: Some(2.0),
            side: Side::Outside,
        };
        let rim = one(&cap, V3::new(4.0, 0.0, 6.0));
        assert_eq!(rim.len(), 1);
        assert!((rim[0].distance - 5.0).abs() < 1e-15);
        assert!((rim[0].normal - V3::new(0.6, 0.0, 0.8)).norm() < 1e-15);
        assert!((one(&cap, V3::new(0.2, 0.0, 3.0))[0].distance - 1.0).abs() < 1e-15);
        assert!((one(&cap, V3::new(0.0, 1.5, 1.9))[0].distance - 0.5).abs() < 1e-15);
        assert!((one(&cap, V3::new(0.0, 0.9, 1.0))[0].distance + 0.1).abs() < 1e-15);
        let turned = Orientation::new_normalize(nalgebra::Quaternion::new(1.0, 0.0, 0.0, 1.0));
        let cube = Surface::Box {
            centre: V3::zeros(),
            half: V3::new(1.0, 2.0, 3.0),
            orientation: turned,
            side: Side::Outside,
        };
        // A quarter turn about z: the long half edge lies along x.
        let corner = one(&cube, V3::new(3.0, 2.0, 4.0));
        assert_eq!(corner.len(), 1);
        assert!((corner[0].distance - 3f64.sqrt()).abs() < 1e-14);
        assert!((one(&cube, V3::new(1.9, 0.0, 0.0))[0].distance + 0.1).abs() < 1e-14);
        let room = Surface::Box {
            centre: V3::zeros(),
            half: V3::new(1.0, 1.0, 1.0),
            orientation: Orientation::identity(),
            side: Side::Inside,
        };
        let mut out = Vec::new();
        near(&room, &V3::new(0.9, -0.9, 0.0), 0.2, None, &mut out);
        assert_eq!(out.len(), 2);
    }
}
