//! Triangle meshes as VTK PolyData (`.vtp`): appended raw little-endian.

use std::path::Path;

use super::isosurface::Mesh;
use super::{OutputError, atomic, xml_escape};

/// The file as bytes: points, triangles, and the carried vector under `name` as point data.
#[must_use]
pub fn to_bytes(mesh: &Mesh, name: &str, time_s: f64) -> Vec<u8> {
    let mut data = Vec::new();
    let mut block = |bytes: Vec<u8>| {
        let offset = data.len();
        data.extend((bytes.len() as u64).to_le_bytes());
        data.extend(bytes);
        offset
    };
    let floats = |v: &[[f64; 3]]| v.iter().flatten().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
    let vectors = block(floats(&mesh.vectors));
    let points = block(floats(&mesh.points));
    let corners = mesh.triangles.iter().flatten();
    let connectivity = block(corners.flat_map(|&c| i64::from(c).to_le_bytes()).collect());
    let ends = 1..=mesh.triangles.len() as i64;
    let offsets = block(ends.flat_map(|t| (3 * t).to_le_bytes()).collect());
    let name = xml_escape(name);
    let (n, t) = (mesh.points.len(), mesh.triangles.len());
    let array = |kind: &str, name: &str, components: usize, offset: usize| {
        format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" \
             format=\"appended\" offset=\"{offset}\"/>\n"
        )
    };
    let mut out = format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
         <PolyData>\n<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" \
         format=\"ascii\">{time_s}</DataArray>\n</FieldData>\n\
         <Piece NumberOfPoints=\"{n}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" \
         NumberOfPolys=\"{t}\">\n\
         <PointData Vectors=\"{name}\">\n{}</PointData>\n<CellData>\n</CellData>\n<Points>\n{}</Points>\n\
         <Polys>\n{}{}</Polys>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_",
        array("Float64", &name, 3, vectors),
        array("Float64", "Points", 3, points),
        array("Int64", "connectivity", 1, connectivity),
        array("Int64", "offsets", 1, offsets),
    )
    .into_bytes();
    out.extend(data);
    out.extend_from_slice(b"\n</AppendedData>\n</VTKFile>\n");
    out
}

/// Writes a mesh.
///
/// # Errors
/// I/O.
pub fn write(path: &Path, mesh: &Mesh, name: &str, time_s: f64) -> Result<(), OutputError> {
    atomic::write(path, &to_bytes(mesh, name, time_s))
}
