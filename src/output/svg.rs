//! Draws a [`Plot`] as SVG.
//!
//! Colours are those of Okabe and Ito (distinguishable with colour-blindness); curves differ in
//! mark or dash as well.

use plotters::coord::Shift;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::OutputError;
use super::plot::{Plot, Series, Style};
use super::ticks::Scale;

/// Width and height of every figure, in pixels.
pub(crate) const SIZE: (u32, u32) = (720, 480);

const PALETTE: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(40, 40, 40),
];
const INK: RGBColor = RGBColor(40, 40, 40);
const GRID: RGBColor = RGBColor(222, 222, 222);
const ROW: i32 = 18;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Axes = Cartesian2d<Scale, Scale>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Axes>;

/// How one curve looks.
#[derive(Clone, Copy)]
struct Look {
    colour: RGBColor,
    index: usize,
    style: Style,
}

/// Draws a plot, 720×480. Points that are not finite, and on logarithmic axes points that are
/// not positive, are left out.
///
/// # Errors
/// [`OutputError::Draw`] when the drawing library refuses.
pub fn draw(plot: &Plot) -> Result<String, OutputError> {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        compose(&root, plot)
            .map_err(|e| OutputError::Draw { title: plot.title.clone(), detail: e.to_string() })?;
    }
    Ok(text)
}

fn compose(root: &Area, plot: &Plot) -> Result<(), Box<dyn std::error::Error>> {
    root.fill(&WHITE)?;
    let columns = if plot.series.iter().all(|s| s.name.chars().count() <= 46) { 2 } else { 1 };
    let rows = plot.series.len().div_ceil(columns) as i32;
    let (header, body) = root.split_vertically(34 + ROW * rows);
    let looks = looks(&plot.series);
    let title = ("sans-serif", 20).into_font().color(&INK).pos(Pos::new(HPos::Center, VPos::Top));
    header.draw(&Text::new(plot.title.clone(), (SIZE.0 as i32 / 2, 8), title))?;
    for (k, (series, look)) in plot.series.iter().zip(&looks).enumerate() {
        let (column, row) = ((k % columns) as i32, (k / columns) as i32);
        legend_entry(&header, (84 + 312 * column, 40 + ROW * row), &series.name, *look)?;
    }
    let x = Scale::new(plot.x.log, plot.series.iter().flat_map(|s| &s.points).map(|p| p[0]));
    let y = Scale::new(plot.y.log, plot.series.iter().flat_map(|s| &s.points).map(|p| p[1]));
    // The space of a short label, or of the longest one and the axis' name.
    let longest = y.ticks.iter().map(|(_, label)| label.chars().count()).max().unwrap_or(0);
    let mut chart = ChartBuilder::on(&body)
        .margin_right(24)
        .margin_top(6)
        .margin_left(6)
        .x_label_area_size(46)
        .y_label_area_size((26 + 9 * longest as u32).max(74))
        .build_cartesian_2d(x.clone(), y.clone())?;
    chart
        .configure_mesh()
        .x_desc(plot.x.caption())
        .y_desc(plot.y.caption())
        .label_style(("sans-serif", 15).into_font().color(&INK))
        .axis_desc_style(("sans-serif", 16).into_font().color(&INK))
        .axis_style(INK)
        .bold_line_style(GRID)
        .light_line_style(TRANSPARENT)
        .draw()?;
    for (series, look) in plot.series.iter().zip(looks) {
        let place = |p: &[f64; 2]| Some((x.place(p[0])?, y.place(p[1])?));
        let points: Vec<(f64, f64)> = series.points.iter().filter_map(place).collect();
        curve(&mut chart, &points, look)?;
    }
    root.present()?;
    Ok(())
}

impl Ranged for Scale {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, at: &f64, (low, high): (i32, i32)) -> i32 {
        let part = (at - self.range[0]) / (self.range[1] - self.range[0]);
        low + (part * f64::from(high - low)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        self.ticks.iter().map(|t| t.0).collect()
    }

    fn range(&self) -> std::ops::Range<f64> {
        self.range[0]..self.range[1]
    }
}

impl ValueFormatter<f64> for Scale {
    fn format_ext(&self, at: &f64) -> String {
        self.label(*at)
    }
}

/// References are dark and dashed and do not use up colours.
fn looks(series: &[Series]) -> Vec<Look> {
    let (mut coloured, mut dashed) = (0, 0);
    let look = |s: &Series| {
        let reference = s.style == Style::Reference;
        let count = if reference { &mut dashed } else { &mut coloured };
        let index = *count;
        *count += 1;
        let colour = if reference { INK } else { PALETTE[index % PALETTE.len()] };
        Look { colour, index, style: s.style }
    };
    series.iter().map(look).collect()
}

fn curve(chart: &mut Chart, points: &[(f64, f64)], look: Look) -> Result<(), Box<dyn std::error::Error>> {
    let Look { colour, index, style } = look;
    match style {
        Style::Reference => {
            let (on, off) = dash(index);
            let dashed = DashedLineSeries::new(points.iter().copied(), on, off, colour.stroke_width(2));
            chart.draw_series(dashed)?;
        }
        Style::Line | Style::LineMarkers => {
            chart.draw_series(LineSeries::new(points.iter().copied(), colour.stroke_width(2)))?;
        }
        Style::Markers => {}
    }
    if matches!(style, Style::Markers | Style::LineMarkers) {
        match index % 4 {
            0 => drop(chart.draw_series(points.iter().map(|p| Circle::new(*p, 4, colour.filled())))?),
            1 => drop(chart.draw_series(points.iter().map(|p| TriangleMarker::new(*p, 5, colour.filled())))?),
            2 => drop(chart.draw_series(points.iter().map(|p| Cross::new(*p, 4, colour.stroke_width(2))))?),
            _ => drop(chart.draw_series(points.iter().map(|p| Circle::new(*p, 4, colour.stroke_width(2))))?),
        }
    }
    Ok(())
}

fn dash(index: usize) -> (i32, i32) {
    [(8, 5), (3, 4), (14, 5)][index % 3]
}

fn legend_entry(
    header: &Area,
    (x, y): (i32, i32),
    name: &str,
    look: Look,
) -> Result<(), Box<dyn std::error::Error>> {
    let Look { colour, index, style } = look;
    let line = |a: i32, b: i32| PathElement::new(vec![(x + a, y), (x + b, y)], colour.stroke_width(2));
    match style {
        Style::Reference => {
            let (on, off) = dash(index);
            let starts = (0..28).step_by((on + off) as usize);
            for a in starts {
                header.draw(&line(a, (a + on).min(28)))?;
            }
        }
        Style::Line | Style::LineMarkers => header.draw(&line(0, 28))?,
        Style::Markers => {}
    }
    if matches!(style, Style::Markers | Style::LineMarkers) {
        let centre = (x + 14, y);
        match index % 4 {
            0 => header.draw(&Circle::new(centre, 4, colour.filled()))?,
            1 => header.draw(&TriangleMarker::new(centre, 5, colour.filled()))?,
            2 => header.draw(&Cross::new(centre, 4, colour.stroke_width(2)))?,
            _ => header.draw(&Circle::new(centre, 4, colour.stroke_width(2)))?,
        }
    }
    let text = ("sans-serif", 15).into_font().color(&INK).pos(Pos::new(HPos::Left, VPos::Center));
    header.draw(&Text::new(name.to_owned(), (x + 36, y), text))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::plot::Axis;
    use super::*;

    fn sample() -> Plot {
        let ladder = [16.0, 32.0, 64.0, 128.0];
        let errors = |scale: f64, p: f64| ladder.map(|n| [n, scale * libm::pow(n, -p)]).to_vec();
        Plot::new("Bingham channel: error <L2>", Axis::log("N", "cells"), Axis::log("relative error", "-"))
            .with(Series::line_markers("exact yield", errors(2.0, 2.0)))
            .with(Series::line_markers("papers' scheme", errors(0.5, 1.1)))
            .with(Series::markers("implicit & clamped", errors(0.05, 1.0)))
            .with(Series::reference("slope −2", errors(1.0, 2.0)))
    }

    #[test]
    fn every_curve_is_named_and_text_is_escaped() {
        let svg = draw(&sample()).unwrap();
        for text in ["exact yield", "implicit &amp; clamped", "slope −2", "&lt;L2&gt;", "N [cells]", "10⁻³"]
        {
            assert!(svg.contains(text), "{text} is missing");
        }
        assert!(svg.trim_end().ends_with("</svg>"));
        assert_eq!(svg, draw(&sample()).unwrap());
    }

    #[test]
    fn unusable_points_are_left_out() {
        let axes = || (Axis::log("N", "-"), Axis::log("e", "-"));
        let (x, y) = axes();
        let bad = vec![[1.0, f64::NAN], [2.0, 0.0], [3.0, -1.0], [f64::INFINITY, 1.0]];
        let svg = draw(&Plot::new("none", x, y).with(Series::markers("nothing", bad))).unwrap();
        // One circle remains: the legend's.
        assert_eq!(svg.matches("<circle").count(), 1);
    }
}
