//! Points, lines and triangles as VTK PolyData (`.vtp`): appended raw little-endian.

use std::fmt::Write as _;
use std::path::Path;

use super::isosurface::Mesh;
use super::{OutputError, atomic, xml_escape};

/// What joins the points.
#[derive(Clone, Copy, Debug)]
pub enum Cells<'a> {
    /// Every point by itself.
    Points,
    /// Lines between two points.
    Lines(&'a [[u32; 2]]),
    /// Triangles of three points.
    Triangles(&'a [[u32; 3]]),
}

/// Numbers of an array, all components of one point or cell side by side.
#[derive(Clone, Debug)]
enum Values {
    Floats(Vec<f64>),
    Integers(Vec<i64>),
}

#[derive(Clone, Debug)]
struct Array {
    name: String,
    components: usize,
    values: Values,
}

/// A PolyData file in the making.
#[derive(Clone, Debug)]
pub struct PolyData<'a> {
    time_s: f64,
    points: &'a [[f64; 3]],
    cells: Cells<'a>,
    point_data: Vec<Array>,
    cell_data: Vec<Array>,
}

impl<'a> PolyData<'a> {
    /// Points (m) at a time, s.
    #[must_use]
    pub fn new(points: &'a [[f64; 3]], cells: Cells<'a>, time_s: f64) -> Self {
        Self { time_s, points, cells, point_data: Vec::new(), cell_data: Vec::new() }
    }

    /// An array with `N` components per point.
    #[must_use]
    pub fn at_points<const N: usize>(mut self, name: &str, values: &[[f64; N]]) -> Self {
        self.point_data.push(floats(name, values));
        self
    }

    /// Whole numbers, one per point.
    #[must_use]
    pub fn count_at_points(mut self, name: &str, values: impl Iterator<Item = i64>) -> Self {
        let values = Values::Integers(values.collect());
        self.point_data.push(Array { name: name.to_owned(), components: 1, values });
        self
    }

    /// An array with `N` components per line or triangle.
    #[must_use]
    pub fn at_cells<const N: usize>(mut self, name: &str, values: &[[f64; N]]) -> Self {
        self.cell_data.push(floats(name, values));
        self
    }

    /// The file as bytes.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut data = Vec::new();
        let declared = |arrays: &[Array], data: &mut Vec<u8>| {
            arrays.iter().fold(String::new(), |mut text, array| {
                let _ = write!(text, "{}", declare(array, data));
                text
            })
        };
        let point_data = declared(&self.point_data, &mut data);
        let cell_data = declared(&self.cell_data, &mut data);
        let points = declare(&floats("Points", self.points), &mut data);
        let corners = |flat: Vec<i64>, each: usize, data: &mut Vec<u8>| {
            let count = flat.len() / each;
            let whole = |name: &str, values| Array { name: name.to_owned(), components: 1, values };
            let connectivity = declare(&whole("connectivity", Values::Integers(flat)), data);
            let ends = (1..=count).map(|k| (k * each) as i64).collect();
            format!("{connectivity}{}", declare(&whole("offsets", Values::Integers(ends)), data))
        };
        let (kind, count, joined) = match self.cells {
            Cells::Points => {
                let n = self.points.len();
                ("Verts", n, corners((0..n as i64).collect(), 1, &mut data))
            }
            Cells::Lines(l) => {
                ("Lines", l.len(), corners(l.iter().flatten().map(|&c| c.into()).collect(), 2, &mut data))
            }
            Cells::Triangles(t) => {
                ("Polys", t.len(), corners(t.iter().flatten().map(|&c| c.into()).collect(), 3, &mut data))
            }
        };
        let number = |of: &str| if of == kind { count } else { 0 };
        let vectors = |arrays: &[Array]| {
            let first = arrays.iter().find(|array| array.components == 3);
            first.map_or_else(String::new, |array| format!(" Vectors=\"{}\"", xml_escape(&array.name)))
        };
        let mut out = format!(
            "<?xml version=\"1.0\"?>\n\
             <VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
             <PolyData>\n<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" \
             format=\"ascii\">{}</DataArray>\n</FieldData>\n\
             <Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" \
             NumberOfPolys=\"{}\">\n\
             <PointData{}>\n{point_data}</PointData>\n<CellData{}>\n{cell_data}</CellData>\n\
             <Points>\n{points}</Points>\n<{kind}>\n{joined}</{kind}>\n</Piece>\n</PolyData>\n\
             <AppendedData encoding=\"raw\">\n_",
            self.time_s,
            self.points.len(),
            number("Verts"),
            number("Lines"),
            number("Polys"),
            vectors(&self.point_data),
            vectors(&self.cell_data),
        )
        .into_bytes();
        out.extend(data);
        out.extend_from_slice(b"\n</AppendedData>\n</VTKFile>\n");
        out
    }

    /// Writes the file.
    ///
    /// # Errors
    /// I/O, or an array that does not have one entry per point, line or triangle.
    pub fn write(&self, path: &Path) -> Result<(), OutputError> {
        let cells = match self.cells {
            Cells::Points => self.points.len(),
            Cells::Lines(l) => l.len(),
            Cells::Triangles(t) => t.len(),
        };
        for (arrays, expected) in [(&self.point_data, self.points.len()), (&self.cell_data, cells)] {
            for array in arrays {
                let found = array.len();
                if found != expected {
                    return Err(OutputError::Length { what: array.name.clone(), found, expected });
                }
            }
        }
        atomic::write(path, &self.to_bytes())
    }
}

impl Array {
    fn len(&self) -> usize {
        match &self.values {
            Values::Floats(v) => v.len() / self.components,
            Values::Integers(v) => v.len(),
        }
    }
}

fn floats<const N: usize>(name: &str, values: &[[f64; N]]) -> Array {
    let values = Values::Floats(values.iter().flatten().copied().collect());
    Array { name: name.to_owned(), components: N, values }
}

/// Appends an array to the data and gives its declaration.
fn declare(array: &Array, data: &mut Vec<u8>) -> String {
    let offset = data.len();
    let (kind, bytes): (_, Vec<u8>) = match &array.values {
        Values::Floats(v) => ("Float64", v.iter().flat_map(|x| x.to_le_bytes()).collect()),
        Values::Integers(v) => ("Int64", v.iter().flat_map(|x| x.to_le_bytes()).collect()),
    };
    data.extend((bytes.len() as u64).to_le_bytes());
    data.extend(bytes);
    format!(
        "<DataArray type=\"{kind}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{offset}\"/>\n",
        xml_escape(&array.name),
        array.components
    )
}

/// Writes a mesh with the vector it carries under `name`.
///
/// # Errors
/// I/O.
pub fn write(path: &Path, mesh: &Mesh, name: &str, time_s: f64) -> Result<(), OutputError> {
    of_mesh(mesh, name, time_s).write(path)
}

/// The file of a mesh with the vector it carries under `name`.
#[must_use]
pub(crate) fn of_mesh<'a>(mesh: &'a Mesh, name: &str, time_s: f64) -> PolyData<'a> {
    PolyData::new(&mesh.points, Cells::Triangles(&mesh.triangles), time_s).at_points(name, &mesh.vectors)
}
