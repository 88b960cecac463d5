use super::picture::{VIRIDIS, apart, looks_like};
use super::read::{Area, Element, elements, value};
use crate::output::discs::{Disc, Discs, draw};

fn discs(discs: Vec<Disc>) -> Discs {
    Discs {
        title: "A title".to_owned(),
        label: "speed".to_owned(),
        unit: "m/s".to_owned(),
        axes: ["x".to_owned(), "z".to_owned()],
        size_m: [2.0, 1.0],
        discs,
    }
}

fn disc(centre: [f64; 2], radius: f64, value: f64) -> Disc {
    Disc { centre, radius, value, driven: false }
}

/// Circles lie in the frame as spheres in what it shows, from `low` on and `extent` wide, m.
fn lie_where_they_are(svg: &str, all: &[Disc], low: [f64; 2], extent: [f64; 2]) {
    let (frame, circles) = (Area::frame(svg), elements(svg, "circle"));
    assert_eq!(circles.len(), all.len());
    for (circle, disc) in circles.iter().zip(all) {
        let share = frame.shares([circle.number("cx"), circle.number("cy")]);
        for k in 0..2 {
            let radius = circle.number("r") / frame.size[k];
            // Written to a hundredth of a pixel, the frame to a tenth, of 400 and more.
            assert!((share[k] - (disc.centre[k] - low[k]) / extent[k]).abs() < 5e-4, "{disc:?}: {share:?}");
            assert!((radius - disc.radius / extent[k]).abs() < 5e-4, "{disc:?}: {radius}");
        }
    }
}

/// Values count from 0, and not those of driven grains, which are grey.
#[test]
fn exact_places_and_colours_of_discs() {
    let wall = Disc { driven: true, ..disc([1.0, 0.5], 0.3, 9.0) };
    let all = vec![
        disc([0.5, 0.25], 0.1, 0.0),
        disc([1.5, 0.75], 0.2, 4.0),
        wall,
        disc([0.25, 0.8], 0.15, 2.0),
        disc([1.25, 0.2], 0.05, 1.0),
    ];
    let svg = draw(&discs(all.clone()));
    lie_where_they_are(&svg, &all, [0.0; 2], [2.0, 1.0]);
    let fills: Vec<&str> =
        elements(&svg, "circle").iter().map(|circle| circle.word("fill").unwrap()).collect();
    assert_eq!(fills[2], "#bebebe");
    for (disc, fill) in all.iter().zip(&fills).filter(|(disc, _)| !disc.driven) {
        assert!(looks_like(fill, VIRIDIS[disc.value as usize]), "{disc:?}: {fill}");
    }
    bar_says(&svg, 4.0);
}

/// What lies outside the box is shown, but for driven grains; the numbers at the corners say so.
#[test]
fn exact_extent_with_discs_outside() {
    let all = vec![disc([-0.5, 0.5], 0.25, 1.0), disc([1.0, 1.5], 0.5, 1.0)];
    let far = Disc { driven: true, ..disc([9.0, 9.0], 1.0, 1.0) };
    let svg = draw(&discs([all.clone(), vec![far]].concat()));
    let (low, high) = ([-0.75, 0.0], [2.0, 2.0]);
    let extent = [high[0] - low[0], high[1] - low[1]];
    lie_where_they_are(&svg, &[all, vec![far]].concat(), low, extent);
    let frame = Area::frame(&svg);
    let corner = |text: &str| {
        let found: Vec<[f64; 2]> = elements(&svg, "text")
            .iter()
            .filter(|element| element.text == text && element.word("text-anchor").is_some())
            .map(|element| frame.shares(element.place()))
            .collect();
        found
    };
    // Below the left end, and below the right end or beside the upper one.
    let left = corner("-0.75");
    assert!(left.len() == 1 && left[0][0].abs() < 1e-3 && left[0][1] < 0.0, "{left:?}");
    let ends = corner("2");
    assert!(ends.len() == 2, "{ends:?}");
    assert!((ends[0][0] - 1.0).abs() < 1e-3 && ends[0][1] < 0.0, "{ends:?}");
    assert!(ends[1][0] < 0.0 && ends[1][1] > 0.9, "{ends:?}");
    let bottom = corner("0");
    assert!(bottom.len() == 1 && bottom[0][0] < 0.0 && bottom[0][1].abs() < 0.1, "{bottom:?}");
}

/// All at rest: the darkest colour, and no scale of its own.
#[test]
fn limit_of_discs_at_rest() {
    let svg = draw(&discs(vec![disc([0.5, 0.5], 0.1, 0.0)]));
    assert_eq!(elements(&svg, "circle")[0].word("fill"), Some(VIRIDIS[0]));
    bar_says(&svg, 0.0);
}

/// The bar of colours: dark at 0 below, bright at the greatest value above.
fn bar_says(svg: &str, greatest: f64) {
    let bar: Vec<Element<'_>> =
        elements(svg, "rect").into_iter().filter(|r| r.word("width") == Some("16")).collect();
    let by_height = |a: &&Element<'_>, b: &&Element<'_>| a.number("y").total_cmp(&b.number("y"));
    let (top, foot) = (bar.iter().min_by(by_height).unwrap(), bar.iter().max_by(by_height).unwrap());
    // The middle of a step of 40 is an 80th from the end: of 54 · 8 at most, with the rounding into 96 colours 10 of 255.
    assert!(apart(foot.word("fill").unwrap(), VIRIDIS[0]) <= 10.0, "{foot:?}");
    assert!(apart(top.word("fill").unwrap(), VIRIDIS[4]) <= 10.0, "{top:?}");
    let labels: Vec<Element<'_>> = elements(svg, "text")
        .into_iter()
        .filter(|text| text.word("font-size") == Some("12") && text.word("text-anchor").is_none())
        .collect();
    let near = |label: &Element<'_>, step: &Element<'_>| (label.number("y") - step.number("y")).abs() < 8.0;
    assert_eq!(labels.len(), 2);
    assert!(near(&labels[0], top) && value(labels[0].text) == greatest, "{labels:?}");
    assert!(near(&labels[1], foot) && value(labels[1].text) == 0.0, "{labels:?}");
}
