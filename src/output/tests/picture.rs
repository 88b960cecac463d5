use super::read::{Area, Element, elements, painted, rgb, value};
use crate::output::picture::{Picture, draw};

/// Five colours of viridis, evenly spaced, as its authors publish them.
pub(super) const VIRIDIS: [&str; 5] = ["#440154", "#3b528b", "#21908c", "#5dc863", "#fde725"];

/// Equal but for the rounding of a value into 96 colours: the map changes by 54 of 255 in an eighth of its length at most,
/// thus by 54 · 8/95 from one colour to the next.
pub(super) fn looks_like(found: &str, expected: &str) -> bool {
    apart(found, expected) <= 5.0
}

/// Largest difference of two colours in red, green or blue.
pub(super) fn apart(a: &str, b: &str) -> f64 {
    rgb(a).iter().zip(rgb(b)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn picture(extents: [usize; 2], values: Vec<f64>) -> Picture {
    Picture {
        title: "A title".to_owned(),
        label: "speed".to_owned(),
        unit: "m/s".to_owned(),
        extents,
        spacing: 0.5,
        length_unit: "m".to_owned(),
        axes: ["x".to_owned(), "z".to_owned()],
        values,
        solid: Vec::new(),
        unyielded: Vec::new(),
    }
}

/// Share of width or height at the middle of a cell.
fn middle(cell: usize, cells: usize) -> f64 {
    (cell as f64 + 0.5) / cells as f64
}

/// The first row lies below, the first column on the left; solid cells are grey, and their values do not count; what is no
/// number stays white.
#[test]
fn exact_colours_lie_where_their_cells_do() {
    let values = vec![0.0, 1.0, 2.0, 3.0, 4.0, 4.0, 900.0, f64::NAN, 1.0, 1.0];
    let solid: Vec<bool> = (0..10).map(|c| c == 6).collect();
    let svg = draw(&Picture { solid, ..picture([5, 2], values.clone()) }).unwrap();
    for (c, value) in values.iter().enumerate() {
        let found = painted(&svg, [middle(c % 5, 5), middle(c / 5, 2)]);
        match c {
            6 => assert_eq!(found, Some("#9a9a9a")),
            7 => assert_eq!(found, None),
            _ => {
                let found = found.unwrap_or_else(|| panic!("cell {c} is white"));
                assert!(looks_like(found, VIRIDIS[*value as usize]), "cell {c}: {found}");
            }
        }
    }
    // Cells are square.
    let [w, h] = Area::frame(&svg).size;
    assert!((w / h - 2.5).abs() < 1e-3, "{w} {h}");
}

#[test]
fn limit_of_one_value_and_of_none() {
    let labels = |svg: &str| bar_labels(svg).iter().map(|label| label.text.to_owned()).collect::<Vec<_>>();
    let one = draw(&picture([2, 2], vec![7.0; 4])).unwrap();
    for at in [[0.1, 0.1], [0.9, 0.1], [0.1, 0.9], [0.9, 0.9]] {
        assert!(painted(&one, at).is_some_and(|found| looks_like(found, VIRIDIS[2])), "{at:?}");
    }
    assert_eq!(labels(&one), ["7"; 5]);
    let none = draw(&picture([2, 2], vec![f64::NAN; 4])).unwrap();
    assert_eq!((painted(&none, [0.5, 0.5]), labels(&none)), (None, vec!["0".to_owned(); 5]));
}

/// Labels beside the bar of colours.
fn bar_labels(svg: &str) -> Vec<Element<'_>> {
    let small = |text: &Element<'_>| text.word("font-size") == Some("12");
    elements(svg, "text")
        .into_iter()
        .filter(|text| small(text) && text.word("text-anchor").is_none())
        .collect()
}

/// Read off the bar, the colour of a cell is its value.
#[test]
fn exact_values_read_off_the_bar() {
    let values: Vec<f64> = (0..40).map(|c| -3.0 + 0.25 * f64::from(c)).collect();
    let svg = draw(&picture([10, 4], values.clone())).unwrap();
    let labels = bar_labels(&svg);
    let known: Vec<[f64; 2]> = labels.iter().map(|label| [label.number("y"), value(label.text)]).collect();
    let ([y0, low], [y1, high]) = (known[0], known[known.len() - 1]);
    assert_eq!((low, high), (values[0], values[39]));
    let read = |y: f64| low + (y - y0) / (y1 - y0) * (high - low);
    // Places are written to a tenth of a pixel, of 160 and more.
    for [y, label] in &known {
        assert!((read(*y) - label).abs() < 0.002 * (high - low), "{label} at {y}");
    }
    let bar: Vec<Element<'_>> =
        elements(&svg, "rect").into_iter().filter(|r| r.word("width") == Some("16")).collect();
    for (c, value) in values.iter().enumerate() {
        let fill = painted(&svg, [middle(c % 10, 10), middle(c / 10, 4)]);
        let step = bar.iter().find(|step| step.word("fill") == fill).unwrap();
        // Labels stand 4 pixels below what they mark, so that their middle is there.
        let found = read(step.number("y") + 0.5 * step.number("height") + 4.0);
        // A value and the middle of its colour are half a colour of 96 apart at most; the other half is for tenths of pixels.
        assert!((found - value).abs() < (high - low) / 96.0, "cell {c}: {found} {value}");
    }
}

/// A label along an axis stands where it says, and the name of an axis at its own side.
#[test]
fn exact_numbers_along_the_axes() {
    let svg = draw(&picture([12, 6], vec![0.0; 72])).unwrap();
    let frame = Area::frame(&svg);
    let lengths = [6.0, 3.0];
    // Below numbers along x, to the left those along z, whose middle lies 4 pixels above their foot.
    for (axis, anchor) in [(0, "middle"), (1, "end")] {
        let of_axis = |text: &Element<'_>| {
            text.word("font-size") == Some("12") && text.word("text-anchor") == Some(anchor)
        };
        let numbers: Vec<Element<'_>> = elements(&svg, "text").into_iter().filter(of_axis).collect();
        assert!(numbers.len() >= 3, "{numbers:?}");
        for end in [0.0, lengths[axis]] {
            assert!(numbers.iter().any(|number| value(number.text) == end), "{end}: {numbers:?}");
        }
        for number in &numbers {
            let [x, y] = number.place();
            let share = frame.shares([x, y - 4.0]);
            // Written to a tenth of a pixel.
            assert!(
                (share[axis] - value(number.text) / lengths[axis]).abs() < 0.06 / frame.size[axis],
                "{number:?}"
            );
            assert!(share[1 - axis] < 0.0, "{number:?}");
        }
    }
    let name = |text: &str| {
        let found = elements(&svg, "text").into_iter().find(|element| element.text == text);
        frame.shares(found.unwrap_or_else(|| panic!("no {text}")).place())
    };
    let (x, z) = (name("x [m]"), name("z [m]"));
    assert!((x[0] - 0.5).abs() < 0.01 && x[1] < 0.0, "{x:?}");
    assert!((z[1] - 0.5).abs() < 0.01 && z[0] < 0.0, "{z:?}");
}

/// Two cells side by side and one in each of two corners of the picture, which they touch at corners: 6 + 4 + 4 edges. What is
/// solid is no plug.
#[test]
fn exact_outline_of_a_plug() {
    let [nx, ny] = [4, 3];
    let is_plug = |i: usize, j: usize| [(0, 0), (1, 1), (2, 1), (3, 2)].contains(&(i, j));
    let cells = || (0..nx * ny).map(|c| (c % nx, c / nx));
    let solid = cells().map(|cell| cell == (3, 0)).collect();
    let unyielded = cells().map(|(i, j)| is_plug(i, j) || (i, j) == (3, 0)).collect();
    let svg = draw(&Picture { solid, unyielded, ..picture([nx, ny], vec![1.0; nx * ny]) }).unwrap();
    let frame = Area::frame(&svg);
    let light: Vec<Area> =
        elements(&svg, "rect").iter().filter(|r| r.word("fill-opacity").is_some()).map(Area::of).collect();
    for (i, j) in cells() {
        let at = frame.pixel([middle(i, nx), middle(j, ny)]);
        assert_eq!(light.iter().any(|area| area.holds(at)), is_plug(i, j), "{i} {j}");
    }
    let paths = elements(&svg, "path");
    assert_eq!(paths.len(), 2, "black on white");
    for path in paths {
        let edges: Vec<&str> = path.word("d").unwrap().split('M').skip(1).collect();
        assert_eq!(edges.len(), 14, "{edges:?}");
        for edge in edges {
            let numbers: Vec<f64> =
                edge.split([' ', 'h', 'v']).map(|number| number.parse().unwrap()).collect();
            let level = edge.contains('h');
            let [x, y] = [numbers[0], numbers[1]];
            let half = 0.5 * numbers[2];
            let middle = frame.shares(if level { [x + half, y] } else { [x, y + half] });
            // The cells on both sides of the middle of the edge; beyond the picture there is none.
            let side = |sign: f64| {
                let [i, j] = [
                    middle[0] * nx as f64 + if level { 0.0 } else { sign },
                    middle[1] * ny as f64 + if level { sign } else { 0.0 },
                ];
                i >= 0.0 && j >= 0.0 && is_plug(i as usize, j as usize)
            };
            assert!(side(0.5) != side(-0.5), "{edge}");
        }
    }
}
