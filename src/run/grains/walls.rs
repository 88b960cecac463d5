//! Walls as triangles, to be looked at beside the grains.

use std::path::Path;

use crate::dem::walls::{Pose, Side, Surface, Wall};
use crate::dem::{Dem, V3};
use crate::output::OutputError;
use crate::output::vtp::{Cells, PolyData};

/// Sides of a cylinder, and of the equator of a sphere.
const ROUND: u32 = 64;

/// Triangles with the number of their wall.
#[derive(Default)]
struct Triangles {
    points: Vec<[f64; 3]>,
    corners: Vec<[u32; 3]>,
    wall: Vec<[f64; 1]>,
}

impl Triangles {
    /// Adds a grid of points, `columns` in each row, as two triangles per cell.
    fn grid(&mut self, points: Vec<V3>, columns: u32) {
        let first = self.points.len() as u32;
        let rows = points.len() as u32 / columns;
        self.points.extend(points.iter().map(|&p| <[f64; 3]>::from(p)));
        for j in 0..rows.saturating_sub(1) {
            for i in 0..columns - 1 {
                let k = first + j * columns + i;
                self.corners.push([k, k + 1, k + columns]);
                self.corners.push([k + 1, k + columns + 1, k + columns]);
            }
        }
    }
}

/// Whether there is anything to show: faces of the box are not shown.
pub(super) fn any(walls: &[Wall], faces: usize) -> bool {
    walls.len() > faces
}

/// Writes the walls beyond the first `faces`, where they are now. What has no end is shown to one box length.
///
/// # Errors
/// I/O.
pub(super) fn write(path: &Path, dem: &Dem, faces: usize, size_m: [f64; 3]) -> Result<(), OutputError> {
    let scenery = dem.scenery();
    let mut all = Triangles::default();
    let reach = V3::from(size_m).norm();
    for (k, (wall, pose)) in scenery.walls.iter().zip(&scenery.poses).enumerate().skip(faces) {
        let start = all.points.len();
        surface(&wall.surface, reach, &mut all);
        for point in &mut all.points[start..] {
            *point = moved(wall, pose, V3::from(*point)).into();
        }
        all.wall.resize(all.corners.len(), [k as f64]);
    }
    PolyData::new(&all.points, Cells::Triangles(&all.corners), dem.time())
        .at_cells("wall", &all.wall)
        .write(path)
}

/// Where a point of a wall has gone.
fn moved(wall: &Wall, pose: &Pose, x: V3) -> V3 {
    let about = wall.motion.about;
    about + pose.shift + pose.turn * (x - about)
}

/// Two unit vectors that are normal to `axis` and to each other.
fn across(axis: &V3) -> (V3, V3) {
    let k = (0..3).min_by(|&a, &b| axis[a].abs().total_cmp(&axis[b].abs())).unwrap_or(0);
    let u = axis.cross(&V3::ith(k, 1.0)).normalize();
    (u, axis.cross(&u))
}

fn surface(surface: &Surface, reach: f64, out: &mut Triangles) {
    let turn = |k: u32, of: u32| 2.0 * std::f64::consts::PI * f64::from(k) / f64::from(of);
    match surface {
        Surface::Plane { point, normal } => {
            let (u, v) = across(normal);
            let corner = |a: f64, b: f64| point + (u * a + v * b) * reach;
            let points = vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0)];
            out.grid(points, 2);
        }
        Surface::Cylinder { point, axis, radius, half_length, side } => {
            let (u, v) = across(axis);
            let half = half_length.unwrap_or(reach);
            let ring = |along: f64, r: f64| -> Vec<V3> {
                let at = |k: u32| u * libm::cos(turn(k, ROUND)) + v * libm::sin(turn(k, ROUND));
                (0..=ROUND).map(|k| point + axis * along + at(k) * r).collect()
            };
            let (low, high) = (ring(-half, *radius), ring(half, *radius));
            let rows = if half_length.is_some() && *side == Side::Outside {
                [ring(-half, 0.0), low, high, ring(half, 0.0)].concat()
            } else {
                [low, high].concat()
            };
            out.grid(rows, ROUND + 1);
        }
        Surface::Box { centre, half, orientation, .. } => {
            for axis in 0..3 {
                for side in [-1.0, 1.0] {
                    let corner = |a: f64, b: f64| {
                        let mut x = V3::zeros();
                        (x[axis], x[(axis + 1) % 3], x[(axis + 2) % 3]) = (side, a, b);
                        centre + orientation * x.component_mul(half)
                    };
                    let points =
                        vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0)];
                    out.grid(points, 2);
                }
            }
        }
        Surface::Sphere { centre, radius, .. } => {
            let rows = ROUND / 2;
            let point = |j: u32, i: u32| {
                let (a, b) = (0.5 * turn(j, rows), turn(i, ROUND));
                let s = libm::sin(a);
                centre + V3::new(s * libm::cos(b), s * libm::sin(b), libm::cos(a)) * *radius
            };
            let points = (0..=rows).flat_map(|j| (0..=ROUND).map(move |i| (j, i)));
            out.grid(points.map(|(j, i)| point(j, i)).collect(), ROUND + 1);
        }
        Surface::Mesh(mesh) => {
            let first = out.points.len() as u32;
            out.points.extend(mesh.vertices.iter().map(|&p| <[f64; 3]>::from(p)));
            out.corners.extend(mesh.triangles.iter().map(|t| t.map(|corner| corner + first)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::Orientation;

    /// Area of a closed box, and of a sphere and a cylinder up to the error of their polygons, (2π/64)²/6.
    #[test]
    fn exact_area_of_what_is_shown() {
        let area = |s: &Surface| {
            let mut t = Triangles::default();
            surface(s, 1.0, &mut t);
            let point = |c: u32| V3::from(t.points[c as usize]);
            let of =
                |c: &[u32; 3]| 0.5 * (point(c[1]) - point(c[0])).cross(&(point(c[2]) - point(c[0]))).norm();
            t.corners.iter().map(of).sum::<f64>()
        };
        let half = V3::new(1.0, 2.0, 3.0);
        let orientation = Orientation::identity();
        let cube = Surface::Box { centre: V3::zeros(), half, orientation, side: Side::Outside };
        assert!((area(&cube) - 88.0).abs() < 1e-12);
        let pi = std::f64::consts::PI;
        let polygon = (2.0 * pi / 64.0) * (2.0 * pi / 64.0) / 6.0;
        let ball = Surface::Sphere { centre: V3::zeros(), radius: 1.0, side: Side::Outside };
        assert!((area(&ball) / (4.0 * pi) - 1.0).abs() < 3.0 * polygon);
        let can = Surface::Cylinder {
            point: V3::zeros(),
            axis: V3::z(),
            radius: 1.0,
            half_length: Some(1.0),
            side: Side::Outside,
        };
        assert!((area(&can) / (6.0 * pi) - 1.0).abs() < polygon);
    }
}
