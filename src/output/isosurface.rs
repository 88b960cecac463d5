//! Triangles of the surface where a field on a grid of points takes a given value, by marching
//! tetrahedra: each cube of eight points is cut into six tetrahedra around its diagonal, in the same way
//! in every cube, so that the surface has no holes.

use crate::vector::{cross, dot, sub};
use std::collections::HashMap;

/// Values and vectors at the points of a grid; x fastest.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Grid {
    /// Coordinates of the planes of points along each axis, m; increasing.
    pub planes: [Vec<f64>; 3],
    /// The field.
    pub values: Vec<f64>,
    /// A vector carried to the surface.
    pub vectors: Vec<[f64; 3]>,
}

/// A surface of triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Corners, m.
    pub points: Vec<[f64; 3]>,
    /// The carried vector at each corner.
    pub vectors: Vec<[f64; 3]>,
    /// Corners of each triangle, counter-clockwise when seen from smaller values.
    pub triangles: Vec<[u32; 3]>,
}

/// The six tetrahedra of a cube; corner number = x + 2y + 4z. All share the diagonal 0–7.
const TETRAHEDRA: [[usize; 4]; 6] =
    [[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]];

/// The surface where the field equals `level`; larger values lie behind it.
#[must_use]
pub(crate) fn surface(grid: &Grid, level: f64) -> Mesh {
    let mut builder = Builder { grid, level, mesh: Mesh::default(), corners: HashMap::new() };
    let [nx, ny, nz] = [0, 1, 2].map(|a| grid.planes[a].len());
    for k in 1..nz {
        for j in 1..ny {
            for i in 1..nx {
                let corner =
                    |c: usize| (i - 1 + (c & 1)) + nx * ((j - 1 + (c >> 1 & 1)) + ny * (k - 1 + (c >> 2)));
                let cube: [usize; 8] = std::array::from_fn(corner);
                let inside = cube.iter().filter(|&&c| grid.values[c] > level).count();
                if inside != 0 && inside != 8 {
                    TETRAHEDRA.iter().for_each(|t| builder.tetrahedron(t.map(|c| cube[c])));
                }
            }
        }
    }
    builder.mesh
}

struct Builder<'a> {
    grid: &'a Grid,
    level: f64,
    mesh: Mesh,
    /// Corner of the mesh on each cut edge of the grid.
    corners: HashMap<(usize, usize), u32>,
}

impl Builder<'_> {
    fn tetrahedron(&mut self, points: [usize; 4]) {
        let is_inside = |p: &usize| self.grid.values[*p] > self.level;
        let (inside, outside): (Vec<usize>, Vec<usize>) = points.iter().partition(|p| is_inside(p));
        match (inside.as_slice(), outside.as_slice()) {
            (&[a], &[p, q, r]) => self.triangle([(a, p), (a, q), (a, r)]),
            (&[a, b, c], &[p]) => self.triangle([(a, p), (b, p), (c, p)]),
            (&[a, b], &[p, q]) => {
                self.triangle([(a, p), (a, q), (b, p)]);
                self.triangle([(b, p), (a, q), (b, q)]);
            }
            _ => {}
        }
    }

    /// A triangle on three cut edges (inside, outside), turned so that its normal points outside.
    fn triangle(&mut self, edges: [(usize, usize); 3]) {
        let corners = edges.map(|edge| self.corner(edge));
        let [a, b, c] = corners.map(|corner| self.mesh.points[corner as usize]);
        let normal = cross(sub(b, a), sub(c, a));
        let out: [f64; 3] = edges.iter().fold([0.0; 3], |sum, &(inside, outside)| {
            let step = sub(self.position(outside), self.position(inside));
            std::array::from_fn(|a| sum[a] + step[a])
        });
        let turned = dot(normal, out) < 0.0;
        self.mesh.triangles.push(if turned { [corners[0], corners[2], corners[1]] } else { corners });
    }

    /// The corner on a cut edge, made when first asked for.
    fn corner(&mut self, (inside, outside): (usize, usize)) -> u32 {
        let key = if inside < outside { (inside, outside) } else { (outside, inside) };
        if let Some(&corner) = self.corners.get(&key) {
            return corner;
        }
        let (high, low) = (self.grid.values[inside], self.grid.values[outside]);
        let t = (high - self.level) / (high - low);
        let between = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|i| a[i] + t * (b[i] - a[i]));
        let point = between(self.position(inside), self.position(outside));
        let vector = between(self.grid.vectors[inside], self.grid.vectors[outside]);
        let corner = self.mesh.points.len() as u32;
        self.mesh.points.push(point);
        self.mesh.vectors.push(vector);
        self.corners.insert(key, corner);
        corner
    }

    fn position(&self, point: usize) -> [f64; 3] {
        let [x, y, z] = &self.grid.planes;
        let (nx, ny) = (x.len(), y.len());
        [x[point % nx], y[point / nx % ny], z[point / (nx * ny)]]
    }
}

impl Mesh {
    /// Volume behind a closed mesh, m³.
    #[must_use]
    #[cfg(test)]
    fn volume(&self) -> f64 {
        let corner = |c: u32| self.points[c as usize];
        let six = self.triangles.iter().map(|&[a, b, c]| dot(corner(a), cross(corner(b), corner(c))));
        six.sum::<f64>() / 6.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ball(n: usize, radius: f64) -> Grid {
        let plane: Vec<f64> = (0..n).map(|i| i as f64 - 0.5 * (n - 1) as f64).collect();
        let mut values = Vec::new();
        for z in &plane {
            for y in &plane {
                for x in &plane {
                    values.push(radius - (x * x + y * y + z * z).sqrt());
                }
            }
        }
        let vectors = vec![[1.0, 2.0, 3.0]; values.len()];
        Grid { planes: [plane.clone(), plane.clone(), plane], values, vectors }
    }

    /// The chords of a sphere of radius R over edges of length up to √3 lose at most 3/(8R) in radius,
    /// three times that, relative to R, in volume; and never gain.
    #[test]
    fn volume_of_a_ball() {
        let radius = 8.3;
        let mesh = surface(&ball(20, radius), 0.0);
        let exact = 4.0 / 3.0 * std::f64::consts::PI * radius * radius * radius;
        let loss = 1.0 - mesh.volume() / exact;
        assert!(loss > 0.0 && loss < 3.0 * 3.0 / (8.0 * radius * radius), "{loss}");
        assert!(mesh.vectors.iter().all(|v| *v == [1.0, 2.0, 3.0]));
    }

    #[test]
    fn closed_mesh_uses_every_edge_once_in_each_direction() {
        let mesh = surface(&ball(12, 4.2), 0.0);
        let mut edges = HashMap::new();
        for &[a, b, c] in &mesh.triangles {
            for edge in [(a, b), (b, c), (c, a)] {
                *edges.entry(edge).or_insert(0) += 1;
            }
        }
        assert!(!edges.is_empty());
        for (&(a, b), &count) in &edges {
            assert_eq!((count, edges.get(&(b, a))), (1, Some(&1)));
        }
    }

    #[test]
    fn exact_plane_between_points() {
        let plane = vec![0.0, 1.0];
        let values = [1.0, 0.0].map(|v| [v; 4]).concat();
        let grid = Grid { planes: [plane.clone(), plane.clone(), plane], values, vectors: vec![[0.0; 3]; 8] };
        let mesh = surface(&grid, 0.75);
        assert!(mesh.points.iter().all(|p| p[2] == 0.25));
        assert!(!mesh.triangles.is_empty());
    }
}
