//! A slice of a cell field as a coloured picture (SVG), with solids and unyielded regions marked.

use std::fmt::Write as _;

use super::ticks::Scale;
use super::{OutputError, xml_escape};

/// A two-dimensional slice; arrays hold one entry per cell, the first axis fastest.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Picture {
    /// Heading.
    pub title: String,
    /// What the colours show.
    pub label: String,
    /// Its unit; empty if none.
    pub unit: String,
    /// Cells along the two axes.
    pub extents: [usize; 2],
    /// Cell size, in `length_unit`.
    pub spacing: f64,
    /// Unit of lengths: `m`.
    pub length_unit: String,
    /// Names of the two axes: `["x", "y"]`.
    pub axes: [String; 2],
    /// The field; entries that are not finite stay white.
    pub values: Vec<f64>,
    /// Solid cells (grey); empty if there is none.
    pub solid: Vec<bool>,
    /// Unyielded cells (outlined and lightened); empty if not known.
    pub unyielded: Vec<bool>,
}

/// Anchors of the viridis colour map, dark to light, which keeps its order without colour vision.
const MAP: [[f64; 3]; 9] = [
    [68.0, 1.0, 84.0],
    [71.0, 44.0, 122.0],
    [59.0, 81.0, 139.0],
    [44.0, 113.0, 142.0],
    [33.0, 144.0, 141.0],
    [39.0, 173.0, 129.0],
    [92.0, 200.0, 99.0],
    [170.0, 220.0, 50.0],
    [253.0, 231.0, 37.0],
];
const LEVELS: usize = 96;
const TEXT: &str = "font-family=\"sans-serif\" fill=\"#282828\"";
/// Largest width and height of the coloured field, pixels.
const ROOM: [f64; 2] = [520.0, 360.0];
const LEFT: f64 = 76.0;
const TOP: f64 = 44.0;

/// Draws the picture.
///
/// # Errors
/// [`OutputError::Length`] when an array does not fit the extents.
pub(crate) fn draw(picture: &Picture) -> Result<String, OutputError> {
    let cells = picture.extents[0] * picture.extents[1];
    let arrays = [
        ("values", picture.values.len(), false),
        ("solid", picture.solid.len(), true),
        ("unyielded", picture.unyielded.len(), true),
    ];
    for (what, found, may_be_empty) in arrays {
        if found != cells && !(may_be_empty && found == 0) {
            return Err(OutputError::Length { what: what.to_owned(), found, expected: cells });
        }
    }
    Ok(Canvas::new(picture).draw())
}

struct Canvas<'a> {
    picture: &'a Picture,
    /// Pixels per cell.
    cell: [f64; 2],
    least: f64,
    greatest: f64,
    out: String,
}

impl<'a> Canvas<'a> {
    fn new(picture: &'a Picture) -> Self {
        let [nx, ny] = picture.extents.map(|n| n.max(1) as f64);
        let even = (ROOM[0] / nx).min(ROOM[1] / ny);
        // A slice one cell thick is stretched so that it can be seen.
        let cell = [even.max(40.0 / nx), even.max(40.0 / ny)];
        let solid = |c: usize| picture.solid.get(c).is_some_and(|s| *s);
        let shown = picture.values.iter().enumerate().filter(|(c, v)| v.is_finite() && !solid(*c));
        let (least, greatest) = shown.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), (_, &v)| {
            (if v < a { v } else { a }, if v > b { v } else { b })
        });
        let (least, greatest) = if least <= greatest { (least, greatest) } else { (0.0, 0.0) };
        Self { picture, cell, least, greatest, out: String::new() }
    }

    fn size(&self) -> [f64; 2] {
        [0, 1].map(|a| self.cell[a] * self.picture.extents[a] as f64)
    }

    fn draw(mut self) -> String {
        let [w, h] = self.size();
        let (width, height) = ((LEFT + w + 130.0).max(360.0), TOP + h.max(160.0) + 56.0);
        let _ = write!(
            self.out,
            "<svg width=\"{width:.0}\" height=\"{height:.0}\" viewBox=\"0 0 {width:.0} {height:.0}\" \
             xmlns=\"http://www.w3.org/2000/svg\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
             <text x=\"{:.0}\" y=\"26\" text-anchor=\"middle\" font-size=\"16\" {TEXT}>{}</text>\n",
            width / 2.0,
            xml_escape(&self.picture.title)
        );
        self.field();
        self.plug();
        self.frame();
        self.colour_bar();
        self.out.push_str("</svg>\n");
        self.out
    }

    fn is(&self, mask: &[bool], i: usize, j: usize) -> bool {
        mask.get(i + self.picture.extents[0] * j).is_some_and(|m| *m)
    }

    /// Colour of a cell, or `None` where nothing is shown.
    fn paint(&self, i: usize, j: usize) -> Option<String> {
        if self.is(&self.picture.solid, i, j) {
            return Some("#9a9a9a".to_owned());
        }
        let value = self.picture.values[i + self.picture.extents[0] * j];
        let span = self.greatest - self.least;
        let t = if span > 0.0 { (value - self.least) / span } else { 0.5 };
        value.is_finite().then(|| colour(t))
    }

    /// Cells of equal colour in a row become one rectangle.
    fn field(&mut self) {
        self.out.push_str("<g shape-rendering=\"crispEdges\">\n");
        let [nx, ny] = self.picture.extents;
        for j in 0..ny {
            let row: Vec<Option<String>> = (0..nx).map(|i| self.paint(i, j)).collect();
            let mut i = 0;
            while i < nx {
                let end = (i..nx).find(|&e| row[e] != row[i]).unwrap_or(nx);
                if let Some(fill) = &row[i] {
                    self.rectangle([i, end], j, &format!("fill=\"{fill}\""));
                }
                i = end;
            }
        }
        self.out.push_str("</g>\n");
    }

    fn rectangle(&mut self, [i, end]: [usize; 2], j: usize, look: &str) {
        let [x, y] = self.corner(i, j + 1);
        let (w, h) = ((end - i) as f64 * self.cell[0], self.cell[1]);
        let _ =
            writeln!(self.out, "<rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{w:.2}\" height=\"{h:.2}\" {look}/>");
    }

    /// Pixel position of the low corner of cell (i, j); the second axis points up.
    fn corner(&self, i: usize, j: usize) -> [f64; 2] {
        [LEFT + i as f64 * self.cell[0], TOP + self.size()[1] - j as f64 * self.cell[1]]
    }

    /// Lightens unyielded cells and draws their outline.
    fn plug(&mut self) {
        let picture = self.picture;
        let plug = |c: &Self, i: usize, j: usize| {
            i < picture.extents[0]
                && j < picture.extents[1]
                && c.is(&picture.unyielded, i, j)
                && !c.is(&picture.solid, i, j)
        };
        let [nx, ny] = picture.extents;
        let mut path = String::new();
        for j in 0..ny {
            let mut i = 0;
            while i < nx {
                let inside = plug(self, i, j);
                let end = (i..nx).find(|&e| plug(self, e, j) != inside).unwrap_or(nx);
                if inside {
                    self.rectangle([i, end], j, "fill=\"#fff\" fill-opacity=\"0.3\"");
                }
                i = end;
            }
        }
        for j in 0..=ny {
            for i in 0..=nx {
                let here = plug(self, i, j);
                let [x, y] = self.corner(i, j);
                if i < nx && here != (j > 0 && plug(self, i, j - 1)) {
                    let _ = write!(path, "M{x:.2} {y:.2}h{:.2}", self.cell[0]);
                }
                if j < ny && here != (i > 0 && plug(self, i - 1, j)) {
                    let _ = write!(path, "M{x:.2} {y:.2}v{:.2}", -self.cell[1]);
                }
            }
        }
        if !path.is_empty() {
            for (colour, width) in [("#fff", 2.6), ("#000", 1.1)] {
                let _ = writeln!(
                    self.out,
                    "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\"/>"
                );
            }
        }
    }

    fn frame(&mut self) {
        let [w, h] = self.size();
        let _ = writeln!(
            self.out,
            "<rect x=\"{LEFT}\" y=\"{TOP}\" width=\"{w:.2}\" height=\"{h:.2}\" fill=\"none\" stroke=\"#282828\"/>"
        );
        for axis in [0, 1] {
            let length = self.picture.spacing * self.picture.extents[axis] as f64;
            let name = format!("{} [{}]", self.picture.axes[axis], self.picture.length_unit);
            let name = xml_escape(&name);
            for (at, label) in Scale::new(false, [0.0, length].into_iter()).ticks {
                let t = at / length;
                if !(-1e-9..=1.0 + 1e-9).contains(&t) || (self.size()[axis] < 100.0 && t > 1e-9 && t < 0.99) {
                    continue;
                }
                let (x, y, anchor) = if axis == 0 {
                    (LEFT + t * w, TOP + h + 17.0, "middle")
                } else {
                    (LEFT - 6.0, TOP + (1.0 - t) * h + 4.0, "end")
                };
                let _ = writeln!(
                    self.out,
                    "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" font-size=\"12\" {TEXT}>{label}</text>"
                );
            }
            let (x, y) = if axis == 0 { (LEFT + w / 2.0, TOP + h + 38.0) } else { (20.0, TOP + h / 2.0) };
            let turn =
                if axis == 1 { format!(" transform=\"rotate(-90 {x:.1} {y:.1})\"") } else { String::new() };
            let _ = writeln!(
                self.out,
                "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"middle\" font-size=\"13\" {TEXT}{turn}>{name}</text>"
            );
        }
    }

    fn colour_bar(&mut self) {
        let [w, h] = self.size();
        let (x, h) = (LEFT + w + 24.0, h.max(160.0));
        self.out.push_str("<g shape-rendering=\"crispEdges\">\n");
        for k in 0..LEVELS {
            let y = TOP + h * (1.0 - (k + 1) as f64 / LEVELS as f64);
            let fill = colour((k as f64 + 0.5) / LEVELS as f64);
            let step = h / LEVELS as f64;
            let _ = writeln!(
                self.out,
                "<rect x=\"{x:.1}\" y=\"{y:.2}\" width=\"16\" height=\"{step:.2}\" fill=\"{fill}\"/>"
            );
        }
        self.out.push_str("</g>\n");
        for k in 0..=4 {
            let t = f64::from(k) / 4.0;
            let value = super::ticks::short(self.least + t * (self.greatest - self.least));
            let _ = writeln!(
                self.out,
                "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"12\" {TEXT}>{value}</text>",
                x + 21.0,
                TOP + (1.0 - t) * h + 4.0
            );
        }
        let unit =
            if self.picture.unit.is_empty() { String::new() } else { format!(" [{}]", self.picture.unit) };
        let label = xml_escape(&format!("{}{unit}", self.picture.label));
        let _ = writeln!(
            self.out,
            "<text x=\"{x:.1}\" y=\"{:.1}\" font-size=\"13\" {TEXT}>{label}</text>",
            TOP + h + 22.0
        );
    }
}

/// Colour of a share from 0 to 1.
pub(super) fn colour(t: f64) -> String {
    let level = (t.clamp(0.0, 1.0) * LEVELS as f64).floor().min(LEVELS as f64 - 1.0);
    let at = level / (LEVELS as f64 - 1.0) * (MAP.len() - 1) as f64;
    let k = (at.floor() as usize).min(MAP.len() - 2);
    let part = at - k as f64;
    let [r, g, b] = [0, 1, 2].map(|c| (MAP[k][c] + part * (MAP[k + 1][c] - MAP[k][c])).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Picture {
        let [nx, ny] = [96, 40];
        let at = |c: usize| [(c % nx) as f64 + 0.5, (c / nx) as f64 + 0.5];
        let inside = |c: usize| {
            let [x, y] = at(c);
            (x - 30.0) * (x - 30.0) + (y - 20.0) * (y - 20.0) < 64.0
        };
        Picture {
            title: "Speed past a cylinder".to_owned(),
            label: "|u|".to_owned(),
            unit: "m/s".to_owned(),
            extents: [nx, ny],
            spacing: 0.01,
            length_unit: "m".to_owned(),
            axes: ["x".to_owned(), "y".to_owned()],
            values: (0..nx * ny).map(|c| 1e-3 * at(c)[1] * (40.0 - at(c)[1])).collect(),
            solid: (0..nx * ny).map(inside).collect(),
            unyielded: (0..nx * ny).map(|c| (at(c)[1] - 20.0).abs() < 6.0).collect(),
        }
    }

    #[test]
    fn shows_solids_plug_and_range() {
        let svg = draw(&sample()).unwrap();
        assert!(svg.contains("#9a9a9a") && svg.contains("<path") && svg.contains("|u| [m/s]"));
        // Row centres next to the middle: 1e-3 · 19.5 · 20.5 = 0.39975.
        assert!(svg.contains(&format!(">{}<", super::super::ticks::short(0.39975))));
    }

    #[test]
    fn wrong_lengths_are_refused() {
        let mut picture = sample();
        picture.solid.pop();
        assert!(matches!(draw(&picture), Err(OutputError::Length { .. })));
    }
}
