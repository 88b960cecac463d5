use super::read::{Element, elements, rgb, value};
use crate::output::plot::{Axis, Plot, Series};
use crate::output::svg::draw;
use crate::output::ticks::Scale;

/// Numbers along an axis of a plot: pixel and value; those along x stand below their marks, the others to the left.
fn numbers(svg: &str, axis: usize) -> Vec<[f64; 2]> {
    let anchor = ["middle", "end"][axis];
    let found = elements(svg, "text").into_iter().filter(|text| text.word("text-anchor") == Some(anchor));
    let found = found.filter(|text| text.text.starts_with(|c: char| c.is_ascii_digit() || c == '-'));
    found.map(|text| [text.place()[axis], value(text.text)]).collect()
}

/// What a pixel along an axis means, by the first and the last number there.
fn meaning(svg: &str, axis: usize, log: bool) -> impl Fn(f64) -> f64 {
    let numbers = numbers(svg, axis);
    let ([p0, v0], [p1, v1]) = (numbers[0], numbers[numbers.len() - 1]);
    let at = move |v: f64| if log { libm::log10(v) } else { v };
    let (v0, v1) = (at(v0), at(v1));
    move |pixel: f64| v0 + (pixel - p0) / (p1 - p0) * (v1 - v0)
}

/// Where points lie in pixels, read off the numbers of the axes.
fn lie_where_they_should(svg: &str, pixels: &[[f64; 2]], points: &[[f64; 2]], log: bool) {
    assert_eq!(pixels.len(), points.len());
    for axis in [0, 1] {
        let meaning = meaning(svg, axis, log);
        // Points and numbers lie on whole pixels: each may be half of one off, and the plot goes a little beyond the numbers.
        let pixel = (meaning(1.0) - meaning(0.0)).abs();
        for (found, expected) in pixels.iter().zip(points) {
            let expected = if log { libm::log10(expected[axis]) } else { expected[axis] };
            let found = meaning(found[axis]);
            assert!(
                (found - expected).abs() < 1.6 * pixel,
                "axis {axis}: {found} {expected}, {pixel} a pixel"
            );
        }
    }
}

/// Marks that are no part of the legend: all but the first.
fn marks(svg: &str) -> Vec<[f64; 2]> {
    elements(svg, "circle").iter().skip(1).map(|c| [c.number("cx"), c.number("cy")]).collect()
}

#[test]
fn exact_points_lie_where_the_numbers_say() {
    let points = vec![[2.0, 350.0], [0.0, 100.0], [7.0, 420.0], [10.0, 130.0]];
    let plot = |x, y, points| Plot::new("A title", x, y).with(Series::markers("a name", points));
    let svg = draw(&plot(Axis::linear("time", "s"), Axis::linear("load", "N"), points.clone())).unwrap();
    lie_where_they_should(&svg, &marks(&svg), &points, false);
    // Numbers grow to the right and upwards.
    for (axis, sign) in [(0, 1.0), (1, -1.0)] {
        let pairs = numbers(&svg, axis);
        assert!(pairs.len() >= 4, "{pairs:?}");
        let by_value = |a: &&[f64; 2], b: &&[f64; 2]| a[1].total_cmp(&b[1]);
        let (least, greatest) =
            (pairs.iter().min_by(by_value).unwrap(), pairs.iter().max_by(by_value).unwrap());
        assert!(sign * (greatest[0] - least[0]) > 100.0, "{pairs:?}");
    }
    let points = vec![[1.0, 3e-7], [10.0, 2e-3], [3e4, 0.5], [200.0, 1e-5]];
    let svg = draw(&plot(Axis::log("cells", ""), Axis::log("error", ""), points.clone())).unwrap();
    lie_where_they_should(&svg, &marks(&svg), &points, true);
}

/// The line in the colour of an entry of the legend is the series of that name.
#[test]
fn exact_legend_names_the_curves() {
    let curve = |k: usize| {
        (0..5).map(|i| [f64::from(i), f64::from((i * (k as i32 + 2)) % 5) + 10.0 * k as f64]).collect()
    };
    let names = ["first", "second", "third", "fourth"];
    let mut plot = Plot::new("A title", Axis::linear("x", "m"), Axis::linear("y", "m"));
    for (k, name) in names.iter().enumerate() {
        plot = plot.with(Series::line(*name, curve(k)));
    }
    let svg = draw(&plot).unwrap();
    let lines = elements(&svg, "polyline");
    let mut colours = Vec::new();
    for (k, name) in names.iter().enumerate() {
        let entry = elements(&svg, "text").into_iter().find(|text| text.text == *name).unwrap().place();
        // The sample of an entry is a level line that ends 8 pixels to the left of its name.
        let sample = |line: &Element<'_>| {
            let points = line.points();
            points.len() == 2
                && points
                    .iter()
                    .all(|p| (p[1] - entry[1]).abs() < 9.0 && (-40.0..0.0).contains(&(p[0] - entry[0])))
        };
        let samples: Vec<&str> =
            lines.iter().filter(|line| sample(line)).map(|line| line.word("stroke").unwrap()).collect();
        assert_eq!(samples.len(), 1, "{name}");
        let of_colour =
            |line: &&Element<'_>| line.word("stroke") == Some(samples[0]) && line.points().len() == 5;
        let drawn: Vec<&Element<'_>> = lines.iter().filter(of_colour).collect();
        assert_eq!(drawn.len(), 1, "{name}");
        lie_where_they_should(&svg, &drawn[0].points(), &curve(k), false);
        colours.push(samples[0]);
    }
    colours.sort_unstable();
    colours.dedup();
    assert_eq!(colours.len(), 4, "no colour twice: {colours:?}");
}

/// References are dark, in pieces along their line, and leave the first colour to the first curve.
#[test]
fn exact_references_are_dashed_and_take_no_colour() {
    let level = |y: f64| vec![[0.0, y], [10.0, y]];
    let axes = || Plot::new("A title", Axis::linear("x", "m"), Axis::linear("y", "m"));
    let with = axes().with(Series::reference("theory", level(2.0))).with(Series::line("run", level(5.0)));
    let without = axes().with(Series::line("run", level(5.0)));
    // The curve goes from end to end of its axis.
    let long = |svg: &str| {
        let lines = elements(svg, "polyline").into_iter();
        let found =
            lines.filter(|line| line.points().iter().any(|p| (p[0] - line.points()[0][0]).abs() > 300.0));
        found
            .map(|line| line.word("stroke").unwrap().to_owned())
            .filter(|stroke| *stroke != "#DEDEDE")
            .collect::<Vec<_>>()
    };
    let (with, without) = (draw(&with).unwrap(), draw(&without).unwrap());
    let coloured = |svg: &str| {
        let bright = |stroke: &String| rgb(stroke).iter().any(|part| *part > 100.0);
        long(svg).into_iter().filter(bright).collect::<Vec<_>>()
    };
    assert_eq!(coloured(&with), coloured(&without));
    assert_eq!(coloured(&with).len(), 1);
    // Pieces of the reference: short, dark, at its height.
    let height = meaning(&with, 1, false);
    let pixel = (height(1.0) - height(0.0)).abs();
    let at_its_height =
        |line: &Element<'_>| line.points().iter().all(|p| (height(p[1]) - 2.0).abs() < 1.6 * pixel);
    let dark = |line: &Element<'_>| {
        line.word("stroke").is_some_and(|stroke| rgb(stroke).iter().all(|part| *part < 100.0))
    };
    let pieces: Vec<Element<'_>> =
        elements(&with, "polyline").into_iter().filter(|line| dark(line) && at_its_height(line)).collect();
    assert!(pieces.len() > 20, "{}", pieces.len());
}

/// Numbers of an axis lie on it, are evenly spaced, and say where they are; the axis holds all values.
#[test]
fn exact_ticks_say_where_they_are() {
    let cases: [(bool, [f64; 2]); 12] = [
        (false, [0.0, 1.0]),
        (false, [-3.0, 7.0]),
        (false, [0.012, 0.019]),
        (false, [-1e-7, 2e-6]),
        (false, [0.0, 3.7e6]),
        (false, [98.0, 1203.0]),
        (false, [-5.0, -4.0]),
        (true, [1e-5, 1.0]),
        (true, [2.0, 9.0]),
        (true, [1e-30, 1e30]),
        (true, [0.7, 30.0]),
        (true, [1.0, 1.01]),
    ];
    for (log, ends) in cases {
        let coordinate = |v: f64| if log { libm::log10(v) } else { v };
        // Enough values that they are not taken for the ticks themselves.
        let values = (0..=20).map(|k| ends[0] + (ends[1] - ends[0]) * f64::from(k) / 20.0);
        let scale = Scale::new(log, values);
        let [low, high] = scale.range;
        assert!(low < coordinate(ends[0]) && coordinate(ends[1]) < high, "{ends:?}: {low} to {high}");
        assert!((2..=14).contains(&scale.ticks.len()), "{ends:?}: {:?}", scale.ticks);
        for (at, label) in &scale.ticks {
            assert!((low..=high).contains(at), "{ends:?}: {label}");
            let said = coordinate(value(label));
            // Four digits, of the value or, on a logarithmic axis, of what it is the logarithm of.
            let allowed = if log { 5e-4 / std::f64::consts::LN_10 } else { 5e-4 * at.abs() };
            assert!((said - at).abs() <= allowed + 1e-12 * (high - low), "{ends:?}: {label} at {at}");
        }
        let steps: Vec<f64> = scale.ticks.windows(2).map(|pair| pair[1].0 - pair[0].0).collect();
        assert!(steps.iter().all(|step| *step > 0.0), "{ends:?}: {steps:?}");
        if !log {
            let even = steps.iter().all(|step| (step - steps[0]).abs() < 1e-9 * (high - low));
            assert!(even && steps[0] < 0.4 * (high - low), "{ends:?}: {steps:?}");
        }
    }
}
