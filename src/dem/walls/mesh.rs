//! Triangle meshes: welded corners, nearest points, one contact per touched place.

use super::Near;
use super::mesh_tree::Tree;
use crate::dem::{DemError, V3};
use std::collections::HashMap;

/// Triangles with shared corners.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// Corners, m.
    pub vertices: Vec<V3>,
    /// Corner numbers of each triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Edge numbers of each triangle: edge k joins corners k and k + 1.
    edges: Vec<[u32; 3]>,
    edge_count: u32,
    tree: Tree,
}

/// Which part of a triangle is nearest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Region {
    Face,
    Edge(usize),
    Corner(usize),
}

/// A triangle in reach.
struct Candidate {
    triangle: u32,
    point: V3,
    distance2: f64,
    region: Region,
}

/// Points nearer to each other than this share of the reach are one place.
const SAME_PLACE: f64 = 1e-7;

impl Mesh {
    /// A mesh from corners and triangles; corners at exactly the same place become one.
    ///
    /// # Errors
    /// No triangle, a corner number out of range, a coordinate that is not finite, a triangle without area.
    pub fn new(corners: &[V3], faces: &[[u32; 3]]) -> Result<Self, DemError> {
        let fail = |what: String| Err(DemError::Mesh { what, line: None });
        if faces.is_empty() {
            return fail("no triangle found".into());
        }
        let mut welded: HashMap<[u64; 3], u32> = HashMap::new();
        let mut vertices = Vec::new();
        let mut number = Vec::with_capacity(corners.len());
        for (k, c) in corners.iter().enumerate() {
            if !c.iter().all(|x| x.is_finite()) {
                return fail(format!("corner {k} is not finite"));
            }
            // + 0.0 makes -0.0 and 0.0 the same key.
            let key = [(c.x + 0.0).to_bits(), (c.y + 0.0).to_bits(), (c.z + 0.0).to_bits()];
            number.push(*welded.entry(key).or_insert_with(|| {
                vertices.push(*c);
                vertices.len() as u32 - 1
            }));
        }
        let mut edge_numbers: HashMap<(u32, u32), u32> = HashMap::new();
        let (mut triangles, mut edges) = (Vec::new(), Vec::new());
        for (k, f) in faces.iter().enumerate() {
            if f.iter().any(|&v| v as usize >= corners.len()) {
                return fail(format!("triangle {k} names a corner that does not exist"));
            }
            let t = f.map(|v| number[v as usize]);
            let [a, b, c] = t.map(|v| vertices[v as usize]);
            let longest = (b - a).norm_squared().max((c - a).norm_squared()).max((c - b).norm_squared());
            if (b - a).cross(&(c - a)).norm() <= 1e-12 * longest {
                return fail(format!("triangle {k} has no area"));
            }
            let edge = |i: usize| (t[i].min(t[(i + 1) % 3]), t[i].max(t[(i + 1) % 3]));
            edges.push([0, 1, 2].map(|i| {
                let next = edge_numbers.len() as u32;
                *edge_numbers.entry(edge(i)).or_insert(next)
            }));
            triangles.push(t);
        }
        let boxes: Vec<(V3, V3)> = triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|v| vertices[v as usize]);
                (a.inf(&b).inf(&c), a.sup(&b).sup(&c))
            })
            .collect();
        let tree = Tree::new(&boxes);
        Ok(Self { vertices, triangles, edges, edge_count: edge_numbers.len() as u32, tree })
    }

    /// The mesh scaled about the origin, then shifted (m).
    ///
    /// # Errors
    /// As [`Mesh::new`]: a scale that makes corners infinite or areas vanish.
    pub(crate) fn moved(&self, scale: f64, shift: V3) -> Result<Self, DemError> {
        let corners: Vec<V3> = self.vertices.iter().map(|v| v * scale + shift).collect();
        Self::new(&corners, &self.triangles)
    }

    /// Triangles whose box is within `reach` of `x`, ascending.
    pub(crate) fn within(&self, x: &V3, reach: f64) -> Vec<u32> {
        let mut found = Vec::new();
        self.tree.within(x, reach, &mut found);
        found.sort_unstable();
        found
    }

    /// Smallest box around the mesh.
    pub(crate) fn bounds(&self) -> (V3, V3) {
        self.tree.bounds()
    }

    /// Collects one point per local minimum of the distance to `x` below `reach`.
    ///
    /// A face's own nearest point is a local minimum. A point on an edge or corner is one only if no triangle
    /// sharing that edge or corner comes nearer; triangles that agree on the point give one contact together.
    pub(crate) fn near(&self, x: &V3, reach: f64, triangles: Option<&[u32]>, out: &mut Vec<Near>) {
        let queried;
        let list = match triangles {
            Some(t) => t,
            None => {
                queried = self.within(x, reach);
                &queried
            }
        };
        let mut found: Vec<Candidate> = Vec::new();
        for &t in list {
            let [a, b, c] = self.triangles[t as usize].map(|v| self.vertices[v as usize]);
            let (point, region) = nearest(x, &a, &b, &c);
            let distance2 = (x - point).norm_squared();
            if distance2 < reach * reach {
                found.push(Candidate { triangle: t, point, distance2, region });
            }
        }
        found.sort_by(|p, q| p.distance2.total_cmp(&q.distance2).then(p.triangle.cmp(&q.triangle)));
        let same2 = SAME_PLACE * SAME_PLACE * reach * reach;
        let mut taken: Vec<V3> = Vec::new();
        for (k, f) in found.iter().enumerate() {
            if taken.iter().any(|p| (p - f.point).norm_squared() <= same2) {
                continue;
            }
            if k > 0 && !self.is_minimum(f, &found, same2) {
                continue;
            }
            let distance = f.distance2.sqrt();
            let normal = if distance > 0.0 { (x - f.point) / distance } else { self.normal(f.triangle) };
            out.push(Near { normal, distance, feature: self.feature(f) });
            taken.push(f.point);
        }
    }

    fn is_minimum(&self, f: &Candidate, all: &[Candidate], same2: f64) -> bool {
        let t = f.triangle as usize;
        let shares = |o: &Candidate| match f.region {
            Region::Face => false,
            Region::Edge(k) => self.edges[o.triangle as usize].contains(&self.edges[t][k]),
            Region::Corner(k) => self.triangles[o.triangle as usize].contains(&self.triangles[t][k]),
        };
        all.iter().all(|o| !shares(o) || (o.point - f.point).norm_squared() <= same2)
    }

    fn feature(&self, f: &Candidate) -> u32 {
        let t = f.triangle as usize;
        let faces = self.triangles.len() as u32;
        match f.region {
            Region::Face => f.triangle,
            Region::Edge(k) => faces + self.edges[t][k],
            Region::Corner(k) => faces + self.edge_count + self.triangles[t][k],
        }
    }

    fn normal(&self, triangle: u32) -> V3 {
        let [a, b, c] = self.triangles[triangle as usize].map(|v| self.vertices[v as usize]);
        (b - a).cross(&(c - a)).normalize()
    }
}

/// Nearest point of a triangle and the part it lies on (Ericson, Real-Time Collision Detection, 5.1.5).
fn nearest(p: &V3, a: &V3, b: &V3, c: &V3) -> (V3, Region) {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(&ap), ac.dot(&ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return (*a, Region::Corner(0));
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(&bp), ac.dot(&bp));
    if d3 >= 0.0 && d4 <= d3 {
        return (*b, Region::Corner(1));
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return (a + ab * (d1 / (d1 - d3)), Region::Edge(0));
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(&cp), ac.dot(&cp));
    if d6 >= 0.0 && d5 <= d6 {
        return (*c, Region::Corner(2));
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return (a + ac * (d2 / (d2 - d6)), Region::Edge(2));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        return (b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))), Region::Edge(1));
    }
    let scale = 1.0 / (va + vb + vc);
    (a + ab * (vb * scale) + ac * (vc * scale), Region::Face)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(n: u32, fold: f64) -> Mesh {
        // Unit squares cut in two, folded along x = n/2 by the given slope.
        let mut v = Vec::new();
        let mut t = Vec::new();
        for j in 0..=n {
            for i in 0..=n {
                let x = f64::from(i) - 0.5 * f64::from(n);
                v.push(V3::new(x, f64::from(j), fold * x.abs()));
            }
        }
        for j in 0..n {
            for i in 0..n {
                let a = j * (n + 1) + i;
                t.push([a, a + 1, a + n + 2]);
                t.push([a, a + n + 2, a + n + 1]);
            }
        }
        Mesh::new(&v, &t).unwrap()
    }

    fn count(m: &Mesh, x: V3, r: f64) -> Vec<Near> {
        let mut out = Vec::new();
        m.near(&x, r, None, &mut out);
        out
    }

    #[test]
    fn mesh_edge_gives_one_contact() {
        let flat = grid(8, 0.0);
        for (x, y) in [(0.0, 4.0), (0.5, 4.0), (0.5, 4.5), (0.3, 4.3), (1e-17, 4.2), (0.7, 4.2), (0.1, 0.1)] {
            // A sphere larger than the triangles, on a corner, on edges, on the diagonal, inside.
            for r in [0.3, 2.5] {
                let n = count(&flat, V3::new(x, y, 0.99 * r), r);
                assert_eq!(n.len(), 1, "{x} {y} {r}: {n:?}");
                assert!((n[0].normal - V3::z()).norm() < 1e-12);
                assert!((n[0].distance - 0.99 * r).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn mesh_folds() {
        // A ridge: on the crest one contact; a valley: two, one per flank.
        let ridge = grid(8, -1.0);
        let top = count(&ridge, V3::new(0.0, 4.0, 0.45), 0.5);
        assert_eq!(top.len(), 1);
        assert!((top[0].normal - V3::z()).norm() < 1e-12);
        assert_eq!(count(&ridge, V3::new(0.05, 4.3, 0.45), 0.5).len(), 1);
        let valley = grid(8, 1.0);
        let bottom = count(&valley, V3::new(0.0, 4.3, 0.69), 0.5);
        assert_eq!(bottom.len(), 2, "{bottom:?}");
        assert!((bottom[0].distance - 0.69 / 2f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn mesh_bad_input_is_refused() {
        let v = [V3::zeros(), V3::x(), V3::y()];
        assert!(matches!(Mesh::new(&v, &[]), Err(DemError::Mesh { .. })));
        assert!(matches!(Mesh::new(&v, &[[0, 1, 3]]), Err(DemError::Mesh { .. })));
        assert!(matches!(Mesh::new(&v, &[[0, 1, 1]]), Err(DemError::Mesh { .. })));
        let bad = [V3::new(f64::NAN, 0.0, 0.0), V3::x(), V3::y()];
        assert!(matches!(Mesh::new(&bad, &[[0, 1, 2]]), Err(DemError::Mesh { .. })));
    }
}
