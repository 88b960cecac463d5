//! Plots and pictures of runs: what they show lies where the tables of the same run, or the scene, have it.

mod program;
#[path = "../src/output/tests/read.rs"]
mod read;

use std::path::{Path, PathBuf};

use lahar::output::csv::Series;
use lahar::run::Summary;
use program::{column, folder, lahar};
use read::{Area, Element, elements, painted, rgb, value};
use serde_json::{Value, json};

/// Runs a scene and returns the folder of its results.
fn run(name: &str, scene: &Value) -> PathBuf {
    let out = folder("pictures", name);
    let path = out.join("scene.json");
    std::fs::write(&path, scene.to_string()).expect("a written scene");
    let output =
        lahar(&["run", path.to_str().expect("a path"), "--quiet", "--out", out.to_str().expect("a path")]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    out
}

fn svg(out: &Path, name: &str) -> String {
    std::fs::read_to_string(out.join("plots").join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn table(out: &Path, name: &str) -> Series {
    Series::read(&out.join(name)).unwrap_or_else(|error| panic!("{error}"))
}

/// Whether a text of a picture says this and nothing else.
fn says(svg: &str, text: &str) -> bool {
    elements(svg, "text").iter().any(|element| element.text == text)
}

/// What a pixel along an axis of a plot means, and how much a pixel is: by the first and the last number there.
fn axis(svg: &str, axis: usize) -> impl Fn(f64) -> f64 {
    let anchor = ["middle", "end"][axis];
    let number = |text: &Element<'_>| {
        text.word("text-anchor") == Some(anchor)
            && text.text.starts_with(|c: char| c.is_ascii_digit() || c == '-')
    };
    let numbers: Vec<[f64; 2]> = elements(svg, "text")
        .iter()
        .filter(|text| number(text))
        .map(|text| [text.place()[axis], value(text.text)])
        .collect();
    let ([p0, v0], [p1, v1]) = (numbers[0], numbers[numbers.len() - 1]);
    move |pixel| v0 + (pixel - p0) / (p1 - p0) * (v1 - v0)
}

/// The line of the plot in the colour of the entry `name` of its legend shows `points`.
fn shows(svg: &str, name: &str, points: &[[f64; 2]]) {
    let entry = elements(svg, "text").into_iter().find(|text| text.text == name);
    let [x, y] = entry.unwrap_or_else(|| panic!("no {name}")).place();
    let lines = elements(svg, "polyline");
    let sample = |line: &&Element<'_>| {
        let ends = line.points();
        ends.iter().all(|p| (p[1] - y).abs() < 9.0 && (-40.0..0.0).contains(&(p[0] - x)))
    };
    let colour =
        lines.iter().find(sample).and_then(|line| line.word("stroke")).expect("a sample of the line");
    let long = |line: &&Element<'_>| line.word("stroke") == Some(colour) && !sample(line);
    let drawn: Vec<[f64; 2]> = lines.iter().filter(long).flat_map(|line| line.points()).collect();
    assert_eq!(drawn.len(), points.len(), "{name}");
    for k in [0, 1] {
        let axis = axis(svg, k);
        // Points and numbers lie on whole pixels: each may be half of one off, and the plot goes a little beyond the numbers.
        let pixel = (axis(1.0) - axis(0.0)).abs();
        for (found, expected) in drawn.iter().zip(points) {
            let found = axis(found[k]);
            assert!((found - expected[k]).abs() < 1.6 * pixel, "{name}, axis {k}: {found} {}", expected[k]);
        }
    }
}

fn pairs(table: &Series, x: &str, y: &str) -> Vec<[f64; 2]> {
    column(table, x).into_iter().zip(column(table, y)).map(|(x, y)| [x, y]).collect()
}

/// 4 × 6 × 8 cells between a floor and a lid that moves, with a block on the floor: 2 cells wide from y = 0 on and 3 high.
#[test]
fn exact_picture_and_plots_of_a_flow_past_a_block() {
    let out = run(
        "block",
        &json!({
            "title": "A block",
            "domain": {"size_m": [0.04, 0.06, 0.08], "spacing_m": 0.01, "boundaries": {
                "z_min": "no_slip", "z_max": {"moving_wall": {"velocity_m_per_s": [0.01, 0, 0]}}}},
            "fluid": {"density_kg_per_m3": 1000, "rheology": {"newtonian": {"viscosity_pa_s": 1}}},
            "solids": [{"name": "block", "shape": {"box": {"min_m": [-1, -1, -1], "max_m": [1, 0.02, 0.03]}}}],
            "stop": {"end_time_s": 0.5},
            "output": {"fields": {"count": 1}, "series": {"count": 10}, "probes": [
                {"name": "fastest", "measure": "max_speed"},
                {"name": "plug", "measure": "plug_fraction"},
                {"name": "upwards", "measure": {"profile": {"along": "z"}}}]}
        }),
    );
    let picture = svg(&out, "speed.svg");
    // Across the shortest edge, along x.
    assert!(says(&picture, "y [m]") && says(&picture, "z [m]") && says(&picture, "speed [m/s]"));
    let at = |j: usize, k: usize| {
        painted(&picture, [(j as f64 + 0.5) / 6.0, (k as f64 + 0.5) / 8.0]).expect("a colour")
    };
    for (j, k) in (0..6).flat_map(|j| (0..8).map(move |k| (j, k))) {
        assert_eq!(at(j, k) == "#9a9a9a", j < 2 && k < 3, "{j} {k}");
    }
    // The lid drags the upper cells most: brighter from cell to cell, in the middle between two blocks.
    let brightness = |k: usize| rgb(at(3, k)).iter().sum::<f64>();
    assert!((1..8).all(|k| brightness(k) > brightness(k - 1)));
    // Four digits.
    let fastest = Summary::read(&out.join("summary.json"))
        .expect("a summary")
        .fluid()
        .expect("a fluid")
        .speed_m_per_s
        .greatest;
    let top = elements(&picture, "text")
        .into_iter()
        .filter(|text| text.word("text-anchor").is_none())
        .min_by(|a, b| a.number("y").total_cmp(&b.number("y")))
        .expect("numbers beside the bar");
    assert!((value(top.text) / fastest - 1.0).abs() < 5e-4, "{top:?} {fastest}");

    let profile = table(&out, "profile_upwards_000001.csv");
    shows(&svg(&out, "profile_upwards.svg"), "velocity x", &pairs(&profile, "position", "velocity_x"));
    let series = table(&out, "series.csv");
    let plot = svg(&out, "series_fastest.svg");
    shows(&plot, &series.columns[1].name, &pairs(&series, "time", "fastest"));
    assert!(says(&plot, "time [s]"));
    // A column that is zero throughout is drawn where it stands alone.
    shows(&svg(&out, "series_plug.svg"), "plug", &pairs(&series, "time", "plug"));
}

/// A block of fluid 3 cells long in the farther half of a box, for a step: what is wet is painted, and the section has its shape.
#[test]
fn exact_pictures_of_a_block_of_fluid() {
    let out = run(
        "fluid",
        &json!({
            "domain": {"size_m": [0.08, 0.04, 0.05], "spacing_m": 0.01, "boundaries": {
                "x_min": "no_slip", "x_max": "open", "z_min": "no_slip", "z_max": "open"}},
            "gravity": {"magnitude_m_per_s2": 9.81, "direction": [0, 0, -1]},
            "fluid": {"density_kg_per_m3": 1000, "rheology": {"newtonian": {"viscosity_pa_s": 10}},
                "initial": {"shapes": [{"shape": {"box": {"min_m": [0, 0.02, 0], "max_m": [0.03, 1, 0.02]}}}]}},
            "stop": {"end_time_s": 1e-5},
            "output": {"fields": {"count": 1}, "probes": [
                {"name": "long", "measure": {"surface_profile": {"along": "x", "at_m": 0.035}}},
                {"name": "map", "measure": {"depth_map": {}}}]}
        }),
    );
    let cells = |svg: &str, [nx, ny]: [usize; 2]| {
        let all = (0..nx).flat_map(move |i| (0..ny).map(move |j| [i, j]));
        let middle = |[i, j]: [usize; 2]| [(i as f64 + 0.5) / nx as f64, (j as f64 + 0.5) / ny as f64];
        all.filter(|cell| painted(svg, middle(*cell)).is_some()).collect::<Vec<_>>()
    };
    let wet = |high: std::ops::Range<usize>| {
        (0..3).flat_map(|i| high.clone().map(move |j| [i, j])).collect::<Vec<_>>()
    };
    for name in ["depth.svg", "depth_map.svg"] {
        let depth = svg(&out, name);
        assert!(says(&depth, "x [m]") && says(&depth, "y [m]") && says(&depth, "depth [m]"), "{name}");
        assert_eq!(cells(&depth, [8, 4]), wet(2..4), "{name}");
    }
    // The plane through the middle, at the first cells of the fluid.
    let speed = svg(&out, "speed.svg");
    assert!(says(&speed, "x [m]") && says(&speed, "z [m]"));
    assert_eq!(cells(&speed, [8, 5]), wet(0..2));
    let section = table(&out, "section_long_000000.csv");
    let heights: Vec<[f64; 2]> =
        column(&section, "position").into_iter().map(|x| [x, if x < 0.03 { 0.02 } else { 0.0 }]).collect();
    assert_eq!(heights.len(), 8);
    let plot = svg(&out, "section_long.svg");
    shows(&plot, "0.0000 s", &heights);
    assert!(says(&plot, "bed") && says(&plot, "height [m]"));
}

/// Three spheres that fly on their own, seen along the shortest level edge; the third leaves through one end of the box and comes
/// in through the other. Near ones hide far ones.
#[test]
fn exact_picture_of_spheres() {
    let sphere = |position: [f64; 3], radius: f64, velocity: [f64; 3]| json!({"position_m": position, "radius_m": radius, "velocity_m_per_s": velocity});
    let out = run(
        "spheres",
        &json!({
            "domain": {"size_m": [0.1, 0.2, 0.05]},
            "gravity": {"magnitude_m_per_s2": 2, "direction": [0, -1, 0]},
            "grains": {
                "materials": [{"name": "m", "density_kg_per_m3": 2500, "young_modulus_pa": 1e6, "poisson_ratio": 0.3}],
                "contact": {"law": {"tsuji": {"restitution": 0.5}}, "friction": 0.4},
                "sets": [{"name": "s", "place": {"list": [
                    sphere([0.03, 0.05, 0.01], 0.008, [0.0, 0.02, 0.0]),
                    sphere([0.035, 0.06, 0.04], 0.006, [0.0, 0.52, 0.0]),
                    sphere([0.095, 0.15, 0.02], 0.004, [1.0, 0.02, 0.0])]}}]},
            "stop": {"end_time_s": 0.01}
        }),
    );
    // Beside others a column that is zero throughout is left out: nothing touches, so nothing is lost.
    let energy = svg(&out, "series_energy.svg");
    assert!(says(&energy, "energy_kinetic") && says(&energy, "energy_potential"));
    assert!(!says(&energy, "energy_lost_normal") && !says(&energy, "energy_elastic"));
    let picture = svg(&out, "grains.svg");
    assert!(says(&picture, "x [m]") && says(&picture, "y [m]") && says(&picture, "speed [m/s]"));
    let (frame, circles) = (Area::frame(&picture), elements(&picture, "circle"));
    // After 0.01 s at 2 m/s²: 1e-4 m lower and 0.02 m/s slower along y. Far ones first: z, x × y, points to the viewer.
    let expected =
        [([0.03, 0.0501], 0.008, 0.0), ([0.005, 0.1501], 0.004, 1.0), ([0.035, 0.0651], 0.006, 0.5)];
    assert_eq!(circles.len(), 3);
    for (circle, ([x, y], radius, speed)) in circles.iter().zip(expected) {
        let [across, up] = frame.shares([circle.number("cx"), circle.number("cy")]);
        // Pixels in tenths and hundredths, of 300 and more.
        assert!((across - x / 0.1).abs() < 5e-4 && (up - y / 0.2).abs() < 5e-4, "{across} {up}");
        assert!((circle.number("r") / frame.size[1] - radius / 0.2).abs() < 5e-4);
        let fill = rgb(circle.word("fill").expect("a colour"));
        // Ends and middle of viridis; a colour of 96 is up to 5 of 255 from the next one.
        let map = rgb(["#440154", "#21908c", "#fde725"][(2.0 * speed) as usize]);
        assert!(fill.iter().zip(map).all(|(a, b)| (a - b).abs() <= 5.0), "{speed}: {fill:?}");
    }
}
