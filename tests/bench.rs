//! `lahar bench`: what it prints, and what it refuses.

use std::path::Path;
use std::process::{Command, Output};

use lahar::bench::BenchError;
use lahar::bench::Scale;
use lahar::bench::cases::GROUPS;
use lahar::solver::choose::Best;
use lahar::solver::run::Backend;

fn bench(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lahar"));
    command.arg("bench").args(arguments).output().expect("the command starts")
}

fn snapshot(name: &str, text: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/snapshots"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(name, text));
}

#[test]
fn unknown_name_is_bad_input_and_lists_the_names() {
    let output = bench(&["--only", "bulk/water"]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(output.stdout, b"");
    snapshot("bench_unknown_name", &String::from_utf8_lossy(&output.stderr));
    assert_eq!(bench(&["--threads", "0"]).status.code(), Some(2));
}

#[test]
fn too_little_memory_says_how_much_and_a_way_out() {
    let error = BenchError::OutOfMemory {
        what: "bulk/newtonian on plain with 2 threads".to_owned(),
        needed: 2_180_000_000,
        available: 1_500_000_000,
    };
    snapshot("bench_out_of_memory", &error.to_string());
}

#[test]
fn help_of_the_command() {
    let output = bench(&["--help"]);
    assert_eq!(output.status.code(), Some(0));
    snapshot("help_bench", &String::from_utf8_lossy(&output.stdout));
}

#[test]
fn report_as_json_has_bandwidth_ceiling_and_cases() {
    let output = bench(&["--quick", "--json", "--threads", "2", "--only", "dam-break-small"]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let list = |key: &str| report[key].as_array().unwrap_or_else(|| panic!("no list `{key}`")).clone();
    // Seven kernels on one and on two threads.
    assert_eq!(list("bandwidth").len(), 14);
    assert_eq!(list("ceilings").len(), 2);
    let cases = list("cases");
    assert!(cases.len() >= 4, "two fluids on one and two threads: {}", cases.len());
    for case in &cases {
        let number = |key: &str| case[key].as_f64().unwrap_or_else(|| panic!("no number `{key}`: {case}"));
        assert!(case["mlups"]["low"].as_f64() > Some(0.0) && number("steps") >= 5.0, "{case}");
        assert!(number("share_of_ceiling") > 0.0, "{case}");
        let ratio = number("bytes_per_fluid_cell") / number("predicted_bytes_per_fluid_cell");
        // What the issue allows: 15 % above the prediction.
        assert!(ratio <= 1.15, "{case}");
    }
    let names: Vec<String> = list("ratios").iter().map(|ratio| ratio["name"].to_string()).collect();
    assert!(names.iter().any(|name| name.contains("herschel-bulkley / newtonian")), "{names:?}");
    assert!(names.iter().any(|name| name.contains("2 threads / 1")), "{names:?}");
}

/// Every case of at most 10⁵ cells starts and runs; what is meant to be mostly yielded is.
#[test]
fn cases_run_and_those_meant_to_yield_do() {
    for group in &GROUPS {
        for case in group.cases {
            let setup = (case.setup)(Scale::Quick);
            if setup.cells() > 100_000 {
                continue;
            }
            let mut run = Best.start(&setup).unwrap_or_else(|error| panic!("{}: {error}", case.name));
            // A dam needs some steps before all of it moves; the vortices move from the start.
            let steps = if setup.free_surface.is_some() { 30 } else { 4 };
            run.advance(steps).unwrap_or_else(|stopped| panic!("{}: {stopped:?}", case.name));
            let fields = run.fields();
            let fluid: Vec<usize> =
                (0..setup.cells()).filter(|&cell| fields.is_fluid(cell, setup.is_solid(cell))).collect();
            let flowing = fluid.iter().filter(|&&cell| fields.omega[cell] > 0.0).count();
            let share = flowing as f64 / fluid.len() as f64;
            if case.name.ends_with("unyielded") {
                assert_eq!(flowing, 0, "{}", case.name);
            } else {
                assert!(share > 0.8, "{}: {share}", case.name);
            }
        }
    }
}
