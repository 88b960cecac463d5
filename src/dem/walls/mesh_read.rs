//! Reading STL (text and binary) and OBJ.

use super::Mesh;
use crate::dem::error::MeshIo;
use crate::dem::{DemError, V3};
use std::path::Path;
use std::sync::Arc;

fn fail<T>(what: impl Into<String>, line: Option<usize>) -> Result<T, DemError> {
    Err(DemError::Mesh { what: what.into(), line })
}

impl Mesh {
    /// Reads a mesh; the format follows from the ending `.stl` or `.obj`.
    ///
    /// # Errors
    /// The file cannot be read, has another ending, or its contents are not a mesh.
    pub fn read(path: &Path) -> Result<Self, DemError> {
        let io = |e: std::io::Error| DemError::MeshFile {
            path: path.display().to_string(),
            source: Arc::new(MeshIo { message: e.kind().to_string() }),
        };
        let ending = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
        match ending.as_deref() {
            Some("stl") => Self::from_stl(&std::fs::read(path).map_err(io)?),
            Some("obj") => Self::from_obj(&std::fs::read_to_string(path).map_err(io)?),
            _ => fail("only files ending in .stl and .obj are read", None),
        }
    }

    /// A mesh from the bytes of an STL file, text or binary.
    ///
    /// # Errors
    /// Truncated data, numbers that cannot be read, no triangle.
    pub(crate) fn from_stl(bytes: &[u8]) -> Result<Self, DemError> {
        let announced = bytes.get(80..84).and_then(|b| b.try_into().ok()).map(u32::from_le_bytes);
        let fits = announced.is_some_and(|n| bytes.len() as u64 == 84 + 50 * u64::from(n));
        if !fits && bytes.trim_ascii_start().starts_with(b"solid") {
            return match std::str::from_utf8(bytes) {
                Ok(text) => from_stl_text(text),
                Err(_) => fail("text STL is not valid UTF-8", None),
            };
        }
        let Some(n) = announced else {
            return fail(
                format!("binary STL of {} bytes is shorter than its 84-byte head", bytes.len()),
                None,
            );
        };
        if (bytes.len() as u64) < 84 + 50 * u64::from(n) {
            return fail(
                format!("binary STL announces {n} triangles but ends after {} bytes", bytes.len()),
                None,
            );
        }
        let mut corners = Vec::new();
        for facet in bytes[84..].chunks_exact(50).take(n as usize) {
            for c in facet[12..48].chunks_exact(12) {
                let at = |k: usize| f64::from(f32::from_le_bytes([c[k], c[k + 1], c[k + 2], c[k + 3]]));
                corners.push(V3::new(at(0), at(4), at(8)));
            }
        }
        soup(&corners)
    }

    /// A mesh from the text of an OBJ file: `v` and `f` lines; polygons are cut into fans; other lines are skipped.
    ///
    /// # Errors
    /// Numbers that cannot be read, corner numbers out of range, no triangle.
    pub(crate) fn from_obj(text: &str) -> Result<Self, DemError> {
        let (mut corners, mut faces): (Vec<V3>, Vec<[u32; 3]>) = (Vec::new(), Vec::new());
        for (k, line) in text.lines().enumerate() {
            let mut words = line.split_whitespace();
            match words.next() {
                Some("v") => corners.push(point(words, k + 1)?),
                Some("f") => {
                    let mut polygon = Vec::new();
                    for w in words {
                        let first = w.split('/').next().unwrap_or("");
                        let Ok(n) = first.parse::<i64>() else {
                            return fail(format!("`{w}` is not a corner number"), Some(k + 1));
                        };
                        let at = if n > 0 { n - 1 } else { corners.len() as i64 + n };
                        if n == 0 || at < 0 || at >= corners.len() as i64 {
                            return fail(format!("corner {n} is not defined so far"), Some(k + 1));
                        }
                        polygon.push(at as u32);
                    }
                    if polygon.len() < 3 {
                        return fail("a face needs at least three corners", Some(k + 1));
                    }
                    faces.extend((1..polygon.len() - 1).map(|i| [polygon[0], polygon[i], polygon[i + 1]]));
                }
                _ => {}
            }
        }
        Mesh::new(&corners, &faces)
    }
}

fn point<'a>(mut words: impl Iterator<Item = &'a str>, line: usize) -> Result<V3, DemError> {
    let mut p = V3::zeros();
    for k in 0..3 {
        let Some(w) = words.next() else {
            return fail("a corner needs three coordinates", Some(line));
        };
        match w.parse() {
            Ok(x) => p[k] = x,
            Err(_) => return fail(format!("`{w}` is not a number"), Some(line)),
        }
    }
    Ok(p)
}

fn from_stl_text(text: &str) -> Result<Mesh, DemError> {
    let mut corners = Vec::new();
    for (k, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("vertex") => corners.push(point(words, k + 1)?),
            Some("endfacet") if !corners.len().is_multiple_of(3) => {
                return fail("a facet needs exactly three corners", Some(k + 1));
            }
            _ => {}
        }
    }
    soup(&corners)
}

/// A mesh from consecutive triples of corners; triangles without area, common in STL files, are left out.
fn soup(corners: &[V3]) -> Result<Mesh, DemError> {
    if !corners.len().is_multiple_of(3) {
        return fail("the number of corners is not a multiple of three", None);
    }
    let faces: Vec<[u32; 3]> = (0..corners.len() as u32 / 3)
        .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
        .filter(|t| {
            let [a, b, c] = t.map(|v| corners[v as usize]);
            let longest = (b - a).norm_squared().max((c - a).norm_squared()).max((c - b).norm_squared());
            // A NaN must pass on to the check of coordinates.
            let area = (b - a).cross(&(c - a)).norm();
            area > 1e-12 * longest || area.is_nan()
        })
        .collect();
    Mesh::new(corners, &faces)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n\
                        endfacet\nfacet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid s\n";

    #[test]
    fn mesh_formats_agree() {
        let text = Mesh::from_stl(TEXT.as_bytes()).unwrap();
        let obj = "# square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1/1 2/2 4/3\nf -3 -2 -1\n";
        let obj = Mesh::from_obj(obj).unwrap();
        let mut binary = b"solid but binary".to_vec();
        binary.resize(80, 0);
        binary.extend(2u32.to_le_bytes());
        for t in [[[0f32, 0., 0.], [1., 0., 0.], [0., 1., 0.]], [[1., 0., 0.], [1., 1., 0.], [0., 1., 0.]]] {
            binary.extend([0u8; 12]);
            t.iter().flatten().for_each(|x| binary.extend(x.to_le_bytes()));
            binary.extend([0u8; 2]);
        }
        let bin = Mesh::from_stl(&binary).unwrap();
        for m in [&text, &obj, &bin] {
            assert_eq!((m.vertices.len(), m.triangles.len()), (4, 2));
            assert_eq!(m.bounds(), (V3::zeros(), V3::new(1.0, 1.0, 0.0)));
        }
        // Cut short.
        assert!(matches!(Mesh::from_stl(&binary[..150]), Err(DemError::Mesh { .. })));
        assert!(matches!(Mesh::from_stl(&binary[..50]), Err(DemError::Mesh { .. })));
    }

    #[test]
    fn mesh_errors_name_the_line() {
        let line = |r: Result<Mesh, DemError>| match r {
            Err(DemError::Mesh { line, .. }) => line,
            other => panic!("{other:?}"),
        };
        assert_eq!(line(Mesh::from_stl(TEXT.replace("1 1 0", "1 x 0").as_bytes())), Some(12));
        assert_eq!(line(Mesh::from_obj("v 0 0 0\nv 1 0\n")), Some(2));
        assert_eq!(line(Mesh::from_obj("v 0 0 0\nf 1 2 3\n")), Some(2));
        assert_eq!(line(Mesh::from_obj("")), None);
        assert!(matches!(Mesh::read(Path::new("/nowhere/a.stl")), Err(DemError::MeshFile { .. })));
        assert!(matches!(Mesh::read(Path::new("a.ply")), Err(DemError::Mesh { .. })));
    }
}
