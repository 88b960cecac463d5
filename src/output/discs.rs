//! Spheres seen from one side: discs coloured by a value.

use std::fmt::Write as _;

use super::picture::colour;
use super::ticks::short;
use super::xml_escape;

/// A sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Disc {
    /// Centre, m.
    pub centre: [f64; 2],
    /// Radius, m.
    pub radius: f64,
    /// What its colour shows.
    pub value: f64,
    /// Drawn grey.
    pub driven: bool,
}

/// Spheres in the order they are drawn: later ones hide earlier ones.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Discs {
    /// Heading.
    pub title: String,
    /// Of the value.
    pub label: String,
    /// Of the value.
    pub unit: String,
    /// Across and up.
    pub axes: [String; 2],
    /// The box, m; the picture grows if discs lie outside.
    pub size_m: [f64; 2],
    /// What is drawn.
    pub discs: Vec<Disc>,
}

/// Pixels for the box at most.
const ROOM: [f64; 2] = [880.0, 620.0];
const LEFT: f64 = 76.0;
const TOP: f64 = 48.0;
/// Discs smaller than this have no outline, pixels.
const OUTLINE: f64 = 2.5;
const TEXT: &str = "font-family=\"sans-serif\" fill=\"#282828\"";

/// Draws the discs, both axes to the same scale.
#[must_use]
pub(crate) fn draw(picture: &Discs) -> String {
    let (mut low, mut high) = ([0.0_f64; 2], picture.size_m);
    let shown = || picture.discs.iter().filter(|d| d.centre.iter().all(|x| x.is_finite()));
    for disc in shown().filter(|d| !d.driven) {
        for k in 0..2 {
            low[k] = low[k].min(disc.centre[k] - disc.radius);
            high[k] = high[k].max(disc.centre[k] + disc.radius);
        }
    }
    let extent = [high[0] - low[0], high[1] - low[1]];
    let scale = (ROOM[0] / extent[0]).min(ROOM[1] / extent[1]);
    let [w, h] = extent.map(|e| e * scale);
    let (width, height) = ((LEFT + w + 130.0).max(420.0), TOP + h.max(170.0) + 56.0);
    let greatest = shown().filter(|d| !d.driven).map(|d| d.value).fold(0.0, f64::max);
    let mut out = format!(
        "<svg width=\"{width:.0}\" height=\"{height:.0}\" viewBox=\"0 0 {width:.0} {height:.0}\" \
         xmlns=\"http://www.w3.org/2000/svg\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
         <text x=\"{:.0}\" y=\"26\" text-anchor=\"middle\" font-size=\"16\" {TEXT}>{}</text>\n\
         <clipPath id=\"box\"><rect x=\"{LEFT}\" y=\"{TOP}\" width=\"{w:.1}\" height=\"{h:.1}\"/></clipPath>\n\
         <g clip-path=\"url(#box)\">\n",
        width / 2.0,
        xml_escape(&picture.title)
    );
    for d in shown() {
        let [x, y] = [LEFT + (d.centre[0] - low[0]) * scale, TOP + (high[1] - d.centre[1]) * scale];
        let r = d.radius * scale;
        let share = if greatest > 0.0 { d.value / greatest } else { 0.0 };
        let fill = if d.driven { "#bebebe".to_owned() } else { colour(share) };
        let line = if r >= OUTLINE { " stroke=\"#282828\" stroke-width=\"0.5\"" } else { "" };
        let _ = writeln!(
            out,
            "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{:.2}\" fill=\"{fill}\"{line}/>",
            r.max(0.4)
        );
    }
    let _ = writeln!(
        out,
        "</g>\n<rect x=\"{LEFT}\" y=\"{TOP}\" width=\"{w:.1}\" height=\"{h:.1}\" fill=\"none\" stroke=\"#282828\"/>"
    );
    numbers(&mut out, picture, [low, high], [w, h]);
    colour_bar(&mut out, picture, LEFT + w + 24.0, greatest);
    out.push_str("</svg>\n");
    out
}

/// Ends of both axes and their names.
fn numbers(out: &mut String, picture: &Discs, [low, high]: [[f64; 2]; 2], [w, h]: [f64; 2]) {
    let mut text = |x: f64, y: f64, anchor: &str, words: &str| {
        let words = xml_escape(words);
        let _ = writeln!(
            out,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" font-size=\"12\" {TEXT}>{words}</text>"
        );
    };
    text(LEFT, TOP + h + 18.0, "start", &short(low[0]));
    text(LEFT + w, TOP + h + 18.0, "end", &short(high[0]));
    text(LEFT - 6.0, TOP + h, "end", &short(low[1]));
    text(LEFT - 6.0, TOP + 10.0, "end", &short(high[1]));
    text(LEFT + w / 2.0, TOP + h + 36.0, "middle", &format!("{} [m]", picture.axes[0]));
    text(LEFT - 6.0, TOP + h / 2.0, "end", &format!("{} [m]", picture.axes[1]));
}

/// The colours and what they mean.
fn colour_bar(out: &mut String, picture: &Discs, x: f64, greatest: f64) {
    const STEPS: u32 = 40;
    for k in 0..STEPS {
        let y = TOP + 24.0 + 3.0 * f64::from(STEPS - 1 - k);
        let fill = colour((f64::from(k) + 0.5) / f64::from(STEPS));
        let _ = writeln!(out, "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"16\" height=\"3\" fill=\"{fill}\"/>");
    }
    let label = xml_escape(&format!("{} [{}]", picture.label, picture.unit));
    let _ =
        writeln!(out, "<text x=\"{x:.1}\" y=\"{:.1}\" font-size=\"13\" {TEXT}>{label}</text>", TOP + 12.0);
    for (value, y) in [(greatest, TOP + 30.0), (0.0, TOP + 144.0)] {
        let _ = writeln!(
            out,
            "<text x=\"{:.1}\" y=\"{y:.1}\" font-size=\"12\" {TEXT}>{}</text>",
            x + 21.0,
            short(value)
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shows_every_disc_and_grows_for_those_outside() {
        let disc = |x: f64, driven| Disc { centre: [x, 0.5], radius: 0.25, value: x, driven };
        let mut picture = Discs {
            title: "a < b".to_owned(),
            label: "speed".to_owned(),
            unit: "m/s".to_owned(),
            axes: ["x".to_owned(), "z".to_owned()],
            size_m: [2.0, 1.0],
            discs: vec![disc(0.5, false), disc(1.5, true)],
        };
        let svg = draw(&picture);
        assert_eq!(svg.matches("<circle").count(), 2);
        assert!(svg.contains("a &lt; b") && svg.contains("#bebebe"));
        picture.discs.push(disc(3.0, false));
        picture.discs.push(disc(f64::NAN, false));
        let svg = draw(&picture);
        assert_eq!(svg.matches("<circle").count(), 3);
        assert!(svg.contains(">3.25<"), "{svg}");
    }
}
