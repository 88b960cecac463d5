//! Fields as VTK ImageData (`.vti`): cell data, appended raw little-endian.

use std::fmt::Write as _;
use std::io::{self, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::{OutputError, atomic, xml_escape};

/// One picture of the box: borrowed arrays with one entry per cell, x fastest.
pub struct Image<'a> {
    extents: [usize; 3],
    origin_m: [f64; 3],
    spacing_m: f64,
    time_s: Option<f64>,
    arrays: Vec<Array<'a>>,
    /// Cells along each axis that are written.
    window: [Range<usize>; 3],
    single: bool,
}

struct Array<'a> {
    name: String,
    values: Values<'a>,
}

enum Values<'a> {
    Scalar(&'a [f64]),
    Vector(&'a [[f64; 3]]),
    Tensor(&'a [[f64; 6]]),
    Mask(&'a [u8]),
}

impl Values<'_> {
    fn len(&self) -> usize {
        match self {
            Self::Scalar(v) => v.len(),
            Self::Vector(v) => v.len(),
            Self::Tensor(v) => v.len(),
            Self::Mask(v) => v.len(),
        }
    }

    fn kind(&self, single: bool) -> &'static str {
        match self {
            Self::Mask(_) => "UInt8",
            _ if single => "Float32",
            _ => "Float64",
        }
    }

    /// Component count and the names VTK shows for them.
    fn components(&self) -> &'static [&'static str] {
        match self {
            Self::Scalar(_) | Self::Mask(_) => &[""],
            Self::Vector(_) => &["X", "Y", "Z"],
            Self::Tensor(_) => &["XX", "YY", "ZZ", "XY", "YZ", "XZ"],
        }
    }

    /// Bytes of so many cells in the file.
    fn bytes(&self, cells: usize, single: bool) -> u64 {
        let size = match self {
            Self::Mask(_) => 1,
            _ if single => 4,
            _ => 8,
        };
        (cells * self.components().len() * size) as u64
    }

    /// One row of cells.
    fn send(&self, row: Range<usize>, single: bool, out: &mut dyn Write) -> io::Result<()> {
        let mut number = |x: &f64| {
            // What is beyond the range of 32 bits becomes infinite.
            if single { out.write_all(&(*x as f32).to_le_bytes()) } else { out.write_all(&x.to_le_bytes()) }
        };
        match self {
            Self::Scalar(v) => v[row].iter().try_for_each(number),
            Self::Vector(v) => v[row].iter().flatten().try_for_each(number),
            Self::Tensor(v) => v[row].iter().try_for_each(|t| {
                // VTK orders symmetric tensors xx yy zz xy yz xz.
                [t[0], t[1], t[2], t[3], t[5], t[4]].iter().try_for_each(&mut number)
            }),
            Self::Mask(v) => out.write_all(&v[row]),
        }
    }
}

impl<'a> Image<'a> {
    /// A box of `extents` cubic cells whose low corner is at `origin_m`.
    #[must_use]
    pub fn new(extents: [usize; 3], origin_m: [f64; 3], spacing_m: f64) -> Self {
        let window = extents.map(|n| 0..n);
        Self { extents, origin_m, spacing_m, time_s: None, arrays: Vec::new(), window, single: false }
    }

    /// Only these cells along each axis, which the box has.
    #[must_use]
    pub fn window(mut self, cells: [Range<usize>; 3]) -> Self {
        self.window = cells;
        self
    }

    /// Numbers of 32 bits.
    #[must_use]
    pub fn single(mut self, single: bool) -> Self {
        self.single = single;
        self
    }

    /// Stores the time as the field `TimeValue`, which ParaView understands.
    #[must_use]
    pub fn time(mut self, time_s: f64) -> Self {
        self.time_s = Some(time_s);
        self
    }

    /// Adds one number per cell.
    #[must_use]
    pub fn scalar(self, name: &str, values: &'a [f64]) -> Self {
        self.array(name, Values::Scalar(values))
    }

    /// Adds one vector per cell.
    #[must_use]
    pub fn vector(self, name: &str, values: &'a [[f64; 3]]) -> Self {
        self.array(name, Values::Vector(values))
    }

    /// Adds one symmetric tensor per cell, given as xx yy zz xy xz yz; the file holds VTK's
    /// order, xx yy zz xy yz xz, with the components named.
    #[must_use]
    pub fn tensor(self, name: &str, values: &'a [[f64; 6]]) -> Self {
        self.array(name, Values::Tensor(values))
    }

    /// Adds one small integer per cell.
    #[must_use]
    pub fn mask(self, name: &str, values: &'a [u8]) -> Self {
        self.array(name, Values::Mask(values))
    }

    fn array(mut self, name: &str, values: Values<'a>) -> Self {
        self.arrays.push(Array { name: name.to_owned(), values });
        self
    }

    /// The file as bytes.
    ///
    /// # Errors
    /// [`OutputError::Length`] when an array does not have one entry per cell.
    pub fn to_bytes(&self) -> Result<Vec<u8>, OutputError> {
        self.check()?;
        let mut out = Vec::new();
        // A vector takes everything.
        let failed = |source| OutputError::Io { path: PathBuf::new(), doing: "collect", source };
        self.send(&mut out).map_err(failed)?;
        Ok(out)
    }

    fn check(&self) -> Result<(), OutputError> {
        let expected = self.extents.iter().product();
        match self.arrays.iter().find(|array| array.values.len() != expected) {
            Some(Array { name, values }) => {
                Err(OutputError::Length { what: name.clone(), found: values.len(), expected })
            }
            None => Ok(()),
        }
    }

    /// Sends the file array by array, so that no copy of it is held.
    fn send(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut declarations = String::new();
        let mut offset = 0;
        let cells = self.window.iter().map(Range::len).product();
        for Array { name, values } in &self.arrays {
            declare(&mut declarations, name, values, self.single, offset);
            offset += 8 + values.bytes(cells, self.single);
        }
        out.write_all(self.head(&declarations).as_bytes())?;
        for Array { values, .. } in &self.arrays {
            out.write_all(&values.bytes(cells, self.single).to_le_bytes())?;
            self.rows().try_for_each(|row| values.send(row, self.single, out))?;
        }
        out.write_all(b"\n</AppendedData>\n</VTKFile>\n")
    }

    /// The rows of cells along x that are written, as ranges of the arrays.
    fn rows(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        let ([nx, ny, _], [x, y, z]) = (self.extents, &self.window);
        z.clone().flat_map(move |k| {
            y.clone().map(move |j| {
                let start = nx * (j + ny * k);
                start + x.start..start + x.end
            })
        })
    }

    fn head(&self, declarations: &str) -> String {
        let [nx, ny, nz] = [0, 1, 2].map(|a| self.window[a].len());
        let h = self.spacing_m;
        let [x, y, z] = [0, 1, 2].map(|a| self.origin_m[a] + self.window[a].start as f64 * h);
        let time = self.time_s.map_or_else(String::new, |t| {
            format!(
                "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" \
                 format=\"ascii\">{t}</DataArray>\n</FieldData>\n"
            )
        });
        format!(
            "<?xml version=\"1.0\"?>\n\
             <VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
             <ImageData WholeExtent=\"0 {nx} 0 {ny} 0 {nz}\" Origin=\"{x} {y} {z}\" Spacing=\"{h} {h} {h}\">\n\
             {time}<Piece Extent=\"0 {nx} 0 {ny} 0 {nz}\">\n<PointData>\n</PointData>\n<CellData>\n\
             {declarations}</CellData>\n</Piece>\n</ImageData>\n<AppendedData encoding=\"raw\">\n_"
        )
    }

    /// Writes the file.
    ///
    /// # Errors
    /// As [`Self::to_bytes`], and I/O.
    pub fn write(&self, path: &Path) -> Result<(), OutputError> {
        self.check()?;
        atomic::write_with(path, |file| self.send(file))
    }
}

fn declare(out: &mut String, name: &str, values: &Values, single: bool, offset: u64) {
    let components = values.components();
    let name = xml_escape(name);
    let _ = write!(
        out,
        "<DataArray type=\"{}\" Name=\"{name}\" NumberOfComponents=\"{}\"",
        values.kind(single),
        components.len()
    );
    for (c, label) in components.iter().enumerate().filter(|(_, label)| !label.is_empty()) {
        let _ = write!(out, " ComponentName{c}=\"{label}\"");
    }
    let _ = writeln!(out, " format=\"appended\" offset=\"{offset}\"/>");
}
