//! What probes say about small flows with a free surface, against the ledger and against geometry.

use std::path::{Path, PathBuf};

use lahar::output::csv::Series;
use lahar::plan::{Plan, Planned};
use lahar::run::summary::SurfaceSummary;
use lahar::run::{self, Options, Summary};
use lahar::scene;
use lahar::solver::plain::Plain;

/// Runs a scene on one thread and returns its folder.
fn run(name: &str, text: &str) -> PathBuf {
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&out);
    let scene = scene::flow_from_json(text, &format!("{name}.json"), Path::new("."))
        .unwrap_or_else(|error| panic!("{error}"));
    let plan = Plan::with_memory(&scene, None).unwrap_or_else(|error| panic!("{error}"));
    let options = Options::new(out.clone(), &Plain);
    let planned = Planned::Flow(Box::new(scene), Box::new(plan));
    run::run(&planned, &options).unwrap_or_else(|error| panic!("{error}"));
    out
}

/// The ledger in the summary of a folder.
fn ledger(out: &Path) -> SurfaceSummary {
    let summary = Summary::read(&out.join("summary.json")).expect("a summary");
    summary.fluid().and_then(|fluid| fluid.free_surface.clone()).expect("a ledger")
}

struct Table(Series);

impl Table {
    fn read(path: PathBuf) -> Self {
        Self(Series::read(&path).unwrap_or_else(|error| panic!("{error}")))
    }

    fn column(&self, name: &str) -> Vec<f64> {
        let at = self.0.columns.iter().position(|column| column.name == name);
        let at = at.unwrap_or_else(|| panic!("no column {name}"));
        self.0.rows.iter().map(|row| row[at]).collect()
    }

    fn last(&self, name: &str) -> f64 {
        self.column(name).last().copied().unwrap_or(f64::NAN)
    }
}

fn dam_break(solids: &str, end: f64) -> String {
    format!(
        r#"{{
        "domain": {{
            "size_m": [0.4, 0.01, 0.15], "spacing_m": 0.01,
            "boundaries": {{ "x_min": "no_slip", "x_max": "open", "z_min": "no_slip", "z_max": "open" }}
        }},
        "gravity": {{ "magnitude_m_per_s2": 9.81, "direction": [0, 0, -1] }},
        "fluid": {{
            "density_kg_per_m3": 1000.0,
            "rheology": {{ "newtonian": {{ "viscosity_pa_s": 2.0 }} }},
            "initial": {{ "shapes": [{{ "shape": {{ "box": {{ "min_m": [0, -1, 0], "max_m": [0.1, 1, 0.1] }} }} }}] }}
        }},
        "solids": [{solids}],
        "numerics": {{ "wall_rule": "half_way" }},
        "stop": {{ "end_time_s": {end} }},
        "output": {{
            "series": {{ "count": 20 }},
            "fields": {{ "count": 2 }},
            "probes": [
                {{ "name": "front", "measure": {{ "front": {{ "along": "x", "threshold_m": 0.01 }} }} }},
                {{ "name": "part", "measure": {{ "window_velocity": {{ "min_m": [-1, -1, -1], "max_m": [1, 1, 1] }} }} }},
                {{ "name": "volume", "measure": "volume" }},
                {{ "name": "mass", "measure": "mass" }},
                {{ "name": "plug", "measure": "plug_fraction" }},
                {{ "name": "yielded", "measure": "yielded_fraction" }},
                {{ "name": "section", "measure": {{ "surface_profile": {{ "along": "x" }} }} }}{}
            ]
        }}
    }}"#,
        if solids.is_empty() {
            ""
        } else {
            r#", { "name": "load", "measure": { "force": { "solid": "wall" } } }"#
        }
    )
}

#[test]
fn probes_of_a_dam_break_agree_with_each_other() {
    let out = run("dam", &dam_break("", 0.2));
    let series = Table::read(out.join("series.csv"));
    // The gate stands on the edge of a cell: interpolated from 0.095 m to the empty column next to it.
    let fronts = series.column("front");
    assert!((fronts[0] - (0.095 + 0.01 * 0.09 / 0.1)).abs() < 1e-12, "{}", fronts[0]);
    assert!(fronts.windows(2).all(|pair| pair[1] >= pair[0] - 1e-6), "{fronts:?}");
    assert!(series.last("front") > 0.15, "{fronts:?}");
    let (volume, window) = (series.column("volume"), series.column("part_volume"));
    for (volume, window) in volume.iter().zip(&window) {
        // The window is the whole box; the two products are taken in another order.
        assert!((volume - window).abs() <= 4.0 * f64::EPSILON * volume, "{volume} {window}");
    }
    assert!((volume[0] - 1e-4).abs() < 1e-18);
    // A Newtonian fluid has no plug.
    assert_eq!(series.last("plug"), 0.0);
    assert_eq!(series.last("yielded"), 1.0);
    let section = Table::read(out.join("section_section_000002.csv"));
    let area: f64 = section.column("depth").iter().map(|depth| depth * 0.01).sum();
    // The same sum in another order: 40 roundings; the CSV keeps all digits.
    assert!((area * 0.01 - series.last("volume")).abs() < 1e-15, "{area}");
    for (surface, depth) in section.column("surface").iter().zip(section.column("depth")) {
        assert_eq!(*surface, depth, "the bed is at 0");
    }
    let ledger = ledger(&out);
    assert_eq!(ledger.outflow_kg, 0.0);
    assert!((ledger.mass_kg - series.last("mass")).abs() < 1e-15);
    // 1e3 cells and steps, a rounding each at worst.
    assert!(ledger.mass_residual.abs() < 1e6 * f64::EPSILON, "{}", ledger.mass_residual);
}

#[test]
fn load_on_a_wall_is_what_the_ledger_says_solids_took_less_what_no_mass_carries() {
    let wall =
        r#"{ "name": "wall", "shape": { "box": { "min_m": [0.15, -1, 0], "max_m": [0.18, 1, 0.05] } } }"#;
    let out = run("dam_wall", &dam_break(wall, 0.25));
    let series = Table::read(out.join("series.csv"));
    let ledger = ledger(&out);
    for (axis, name) in ["x", "y", "z"].iter().enumerate() {
        let impulse = series.last(&format!("load_impulse_{name}"));
        let taken = -ledger.from_solids_n_s[axis];
        // Sums of some 1e5 terms, each rounded. Along the wall links say it all; normal to its faces the ledger has the momentum
        // of full cells, and the load that of their mass: less by up to the share of surface cells among those at the wall, a
        // cell on its face and one above each column of five (set after seeing 12 %).
        let allowed = match *name {
            "y" => 1e-10 * ledger.from_force_n_s[2].abs(),
            _ => 0.2 * ledger.from_solids_n_s[0].abs(),
        };
        assert!((impulse - taken).abs() < allowed, "{name}: {impulse} {taken}");
    }
    assert!(series.last("load_impulse_x") > 0.0, "the surge pushes downstream");
    assert_eq!(series.column("load_x")[0], 0.0, "dry at time 0");
    // Five cells of one square centimetre face the surge.
    let area = series.last("load_area_x_low");
    assert!(area > 1e-4 && area <= 5e-4 + 1e-18, "{area}");
    let forces = std::fs::read_to_string(out.join("plots/force_load.svg")).expect("a plot");
    assert!(forces.contains("load_x"));
}

#[test]
fn outflow_is_booked() {
    let end = 0.6;
    let short = dam_break("", end).replace("[0.4, 0.01, 0.15]", "[0.14, 0.01, 0.15]");
    let out = run("dam_outflow", &short);
    let ledger = ledger(&out);
    assert!(ledger.outflow_kg > 0.01 * ledger.initial_mass_kg, "{}", ledger.outflow_kg);
    let sum = ledger.mass_kg + ledger.outflow_kg;
    // As the mass residual of the dam break.
    assert!((sum / ledger.initial_mass_kg - 1.0).abs() < 1e6 * f64::EPSILON, "{sum}");
}

#[test]
fn erodible_bed_does_not_count_as_flow() {
    let text = include_str!("../scenes/show/dam_break_erodible_bed.json")
        .replace("\"end_time_s\": 60.0", "\"end_time_s\": 0.001")
        .replace("{ \"every_s\": 6.0 }", "{ \"count\": 1 }")
        .replace("{ \"every_s\": 0.1 }", "{ \"count\": 1 }");
    let out = run("erodible", &text);
    let front = Table::read(out.join("series.csv")).column("front")[0];
    // The gate: the recess beyond it is full, but not above the bed.
    assert!((front - 0.3).abs() < 0.003, "{front}");
    let section = Table::read(out.join("section_profile_000000.csv"));
    let recess = |x: f64| (0.7..1.0).contains(&x);
    for ((x, bed), depth) in
        section.column("position").iter().zip(section.column("bed")).zip(section.column("depth"))
    {
        if *x > 0.3 {
            let (b, d) = if recess(*x) { (0.0, 0.006) } else { (0.006, 0.0) };
            // The bed of 6 mm settles by half of 3fHΔt²/(ρΔx²) of its own depth, 0.02 · 6/143 at most.
            let settled = 0.5 * 0.02 * (6.0 / 143.0) * d;
            assert!((bed - b).abs() < 1e-12, "{x}: {bed}");
            assert!(depth <= d + 1e-12 && depth >= d - settled - 1e-12, "{x}: {depth}");
        }
    }
}
