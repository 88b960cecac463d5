//! What a run leaves behind when it is asked to end, is killed, or cannot write.
#![cfg(unix)]

mod program;

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use lahar::output::csv::Series;
use lahar::run::{Ended, Summary};
use program::{folder, lahar};

/// A film that takes long enough to be disturbed, and ends by itself should a test fail.
const FILM: &str = r#"{
    "domain": { "size_m": [0.001, 0.001, 0.028], "spacing_m": 0.001, "boundaries": { "z_min": "no_slip", "z_max": "open" } },
    "gravity": { "magnitude_m_per_s2": 9.81, "slope_deg": 16 },
    "fluid": {
        "density_kg_per_m3": 1000.0,
        "rheology": { "newtonian": { "viscosity_pa_s": 1.0 } },
        "initial": { "fill_level": { "height_m": 0.0205 } }
    },
    "stop": { "end_time_s": 30.0 },
    "output": { "series": { "every_s": 0.0001 }, "probes": [
        { "name": "speed", "measure": "max_speed" },
        { "name": "profile", "measure": { "profile": { "along": "z" } } }
    ] }
}"#;

/// A grain that bounces as long.
const GRAIN: &str = r#"{
    "domain": { "size_m": [0.1, 0.1, 0.1], "boundaries": { "z_min": "no_slip", "z_max": "open" } },
    "gravity": { "magnitude_m_per_s2": 9.81, "direction": [0, 0, -1] },
    "grains": {
        "materials": [{ "name": "glass", "density_kg_per_m3": 2500.0, "young_modulus_pa": 1e7, "poisson_ratio": 0.25 }],
        "contact": { "law": { "tsuji": { "restitution": 0.9 } }, "friction": 0.4 },
        "sets": [{ "name": "ball", "place": { "list": [{ "position_m": [0.05, 0.05, 0.05], "radius_m": 0.01 }] } }]
    },
    "stop": { "end_time_s": 30.0 },
    "output": { "series": { "every_s": 0.001 } }
}"#;

/// A heavy grain in the film.
fn grain_in_film() -> String {
    let mut scene: serde_json::Value = serde_json::from_str(FILM).expect("JSON");
    let dry: serde_json::Value = serde_json::from_str(GRAIN).expect("JSON");
    scene["domain"]["size_m"] = serde_json::json!([0.012, 0.012, 0.028]);
    scene["grains"] = dry["grains"].clone();
    scene["grains"]["sets"][0]["place"]["list"][0] =
        serde_json::json!({ "position_m": [0.006, 0.006, 0.012], "radius_m": 0.004 });
    scene["output"]["series"]["every_s"] = 0.001.into();
    scene.to_string()
}

/// A scene in a folder of its own, and the folder of its results.
fn scene(name: &str, text: &str) -> (PathBuf, PathBuf) {
    let folder = folder("interrupted", name);
    let path = folder.join("scene_of_test.json");
    std::fs::write(&path, text).expect("a written scene");
    (path, folder.join("out"))
}

fn command(scene: &Path, out: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lahar"));
    command.arg("run").arg(scene).arg("--out").arg(out).args(["--threads", "1"]);
    command.stdout(Stdio::null()).stderr(Stdio::null());
    command
}

/// Starts a run and waits until its series has rows.
fn started(mut command: Command, out: &Path) -> Child {
    let mut child = command.spawn().expect("the command starts");
    wait_for("rows", || {
        assert_eq!(child.try_wait().expect("a state"), None, "it ended by itself");
        rows(out) > 3
    });
    child
}

fn wait_for(what: &str, mut found: impl FnMut() -> bool) {
    let start = Instant::now();
    while !found() {
        assert!(start.elapsed() < Duration::from_secs(60), "no {what} within a minute");
        std::thread::sleep(Duration::from_millis(5));
    }
}

fn rows(out: &Path) -> usize {
    Series::read(&out.join("series.csv")).map_or(0, |series| series.rows.len())
}

fn send(signal: &str, child: &Child) {
    let kill = Command::new("kill").args([&format!("-{signal}"), &child.id().to_string()]).status();
    assert!(kill.expect("kill starts").success());
}

fn summary(out: &Path) -> Summary {
    Summary::read(&out.join("summary.json")).expect("a summary")
}

fn run(command: &str) -> Output {
    Command::new("sh").args(["-c", command]).output().expect("a shell")
}

fn numbered(out: &Path, start: &str) -> usize {
    let entries = std::fs::read_dir(out).expect("a folder");
    entries
        .filter(|entry| entry.as_ref().expect("an entry").file_name().to_string_lossy().starts_with(start))
        .count()
}

#[test]
fn a_signal_ends_every_kind_of_run_with_all_its_files() {
    let coupled = grain_in_film();
    for (name, text, signal, code, last, plot) in [
        ("film", FILM, "INT", 130, "fields_000001.vti", "series_speed.svg"),
        ("grain", GRAIN, "TERM", 143, "grains_000001.vtp", "grains.svg"),
        ("both", coupled.as_str(), "HUP", 129, "grains_000001.vtp", "speed.svg"),
    ] {
        let (path, out) = scene(name, text);
        let mut child = started(command(&path, &out), &out);
        assert_eq!(summary(&out).ended, Ended::Running, "{name}");
        send(signal, &child);
        assert_eq!(child.wait().expect("an end").code(), Some(code), "{name}");
        let summary = summary(&out);
        assert_eq!((summary.ended, &summary.stopped), (Ended::Interrupted, &None), "{name}");
        assert!(out.join(last).is_file() && out.join("plots").join(plot).is_file(), "{name}");
        let series = Series::read(&out.join("series.csv")).expect("a series");
        let end = series.rows.last().expect("a row")[0];
        assert_eq!(end, summary.time_s, "{name}: the last row is of the end");
        assert!(series.rows.windows(2).all(|rows| rows[0][0] < rows[1][0]), "{name}: no row twice");
    }
}

#[test]
fn a_signal_before_the_first_step_writes_nothing_twice() {
    let (path, out) = scene("at_once", FILM);
    let scene = lahar::scene::load(&path).expect("a scene");
    let planned = lahar::Planned::new(scene, lahar::plan::Layout::EveryCell).expect("a plan");
    let flag = std::sync::atomic::AtomicBool::new(true);
    let options = lahar::run::Options {
        interrupt: Some(&flag),
        ..lahar::run::Options::new(out.clone(), &lahar::Plain)
    };
    let finished = lahar::run::run(&planned, &options).expect("a run");
    assert_eq!((finished.ended, finished.steps), (Ended::Interrupted, 0));
    assert_eq!((rows(&out), numbered(&out, "fields_")), (1, 1));
}

#[test]
fn a_second_signal_ends_at_once() {
    // With a step of the driver that takes longer than the test waits between the two.
    let (path, out) = scene("twice", FILM);
    let child = started(command(&path, &out), &out);
    // Stopped, it takes note of both when it goes on.
    for signal in ["STOP", "INT", "TERM", "CONT"] {
        send(signal, &child);
    }
    let output = child.wait_with_output().expect("an end");
    let code = output.status.code().expect("a code");
    // Whichever is delivered first, the second one ends.
    assert!([130, 143].contains(&code), "{code}");
    assert_eq!(summary(&out).ended, Ended::Running);
}

#[test]
fn a_signal_that_is_ignored_stays_ignored() {
    let (path, out) = scene("nohup", FILM);
    let run = command(&path, &out);
    let mut nohup = Command::new("nohup");
    nohup.arg(run.get_program()).args(run.get_args()).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = started(nohup, &out);
    send("HUP", &child);
    let before = rows(&out);
    wait_for("rows after the signal", || rows(&out) > before);
    send("TERM", &child);
    assert_eq!(child.wait().expect("an end").code(), Some(143));
}

/// The same signal, to a run that a shell started to ignore it and to one that it did not. Where the system does not say what is
/// ignored, as elsewhere than on Linux, nothing is.
#[cfg(target_os = "linux")]
#[test]
fn a_hangup_ends_a_run_unless_it_was_ignored_from_the_start() {
    for (name, trap, code, ended) in [
        ("hangup_ignored", "trap '' HUP; ", 0, Ended::EndTime),
        ("hangup_heard", "", 129, Ended::Interrupted),
        ("other_ignored", "trap '' INT TERM; ", 129, Ended::Interrupted),
    ] {
        let (path, out) = scene(name, FILM);
        let run = command(&path, &out);
        let mut shell = Command::new("sh");
        // The shell becomes the program, so that its number is that of the run.
        shell.arg("-c").arg(format!("{trap}exec \"$0\" \"$@\"")).arg(run.get_program()).args(run.get_args());
        shell.args(["--until", "2"]).stdout(Stdio::null()).stderr(Stdio::null());
        let mut child = started(shell, &out);
        // Stopped, it cannot reach its end before the signal comes.
        send("STOP", &child);
        assert_eq!(summary(&out).ended, Ended::Running, "{name}");
        send("HUP", &child);
        send("CONT", &child);
        assert_eq!(child.wait().expect("an end").code(), Some(code), "{name}");
        let summary = summary(&out);
        assert_eq!((summary.ended, &summary.stopped), (ended, &None), "{name}");
        // An end asked for is not the end of 2 s, which a last step may miss by rounding.
        assert_eq!(summary.time_s > 1.999, ended == Ended::EndTime, "{name}: {} s", summary.time_s);
    }
}

#[test]
fn rows_of_a_killed_run_are_on_the_disk() {
    let (path, out) = scene("killed", FILM);
    let mut child = started(command(&path, &out), &out);
    send("KILL", &child);
    child.wait().expect("an end");
    let series = Series::read(&out.join("series.csv")).expect("whole rows");
    assert!(series.rows.len() > 3 && series.rows[3][0] > 0.0, "{:?}", series.rows.last());
    assert_eq!(summary(&out).ended, Ended::Running);
    // The next run takes the folder over.
    let output =
        lahar(&["run", &path.to_string_lossy(), "--out", &out.to_string_lossy(), "--until", "0.0001"]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!((summary(&out).ended, rows(&out)), (Ended::EndTime, 2));
}

#[test]
fn a_reader_that_leaves_ends_nothing() {
    let (path, out) = scene("pipe", FILM);
    let mut child =
        command(&path, &out).args(["--until", "0.01"]).stderr(Stdio::piped()).spawn().expect("it starts");
    let mut line = String::new();
    let mut reader = BufReader::new(child.stderr.take().expect("a pipe"));
    reader.read_line(&mut line).expect("a line");
    drop(reader);
    assert!(!line.is_empty());
    assert_eq!(child.wait().expect("an end").code(), Some(0));
    assert_eq!(summary(&out).ended, Ended::EndTime);
}

#[test]
fn closed_and_full_outputs_never_abort() {
    let (path, out) = scene("outputs", FILM);
    let (program, path, out) = (env!("CARGO_BIN_EXE_lahar"), path.display(), out.display());
    let run_it = format!("{program} run {path} --out {out} --until 0.001");
    let full = Path::new("/dev/full").exists();
    for (command, code) in [
        (format!("{run_it} 2>&-"), 0),
        (format!("{run_it} >&- 2>&-"), 0),
        (format!("{run_it} 2>/dev/full"), 0),
        (format!("{program} run missing.json 2>&-"), 4),
        (format!("{program} run missing.json 2>/dev/full"), 4),
        (format!("{program} plan {path} >/dev/full"), 4),
        (format!("{program} plan {path} >/dev/full 2>&1"), 4),
        (format!("{program} schema >/dev/full 2>/dev/full"), 4),
        (format!("{program} --nonsense 2>/dev/full"), 2),
    ] {
        if full || !command.contains("/dev/full") {
            let output = run(&command);
            assert_eq!(
                output.status.code(),
                Some(code),
                "{command}: {}",
                String::from_utf8_lossy(&output.stderr)
            );
        }
    }
    // The exit code of the first of two commands; `true` reads nothing.
    for command in
        [format!("{program} plan {path}"), format!("{program} schema"), format!("{program} run --help")]
    {
        let output = run(&format!("( {command}; echo $? >&2 ) | true"));
        assert_eq!(String::from_utf8_lossy(&output.stderr), "0\n", "{command}");
    }
}

/// A file larger than the process may write stands for a disk that is full.
#[test]
fn what_fits_is_written_when_a_file_does_not() {
    let (path, out) = scene("full", &FILM.replace("0.028]", "0.08]"));
    let (program, path) = (env!("CARGO_BIN_EXE_lahar"), path.display());
    // Blocks of 512 bytes: fields of 80 cells take more than 8 kB, plan and summary less.
    let output =
        run(&format!("ulimit -f 16; exec {program} run {path} --out {} --until 0.001", out.display()));
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(4), "{message}");
    assert!(message.contains("error: cannot write ") && message.contains("fields_000000.vti"), "{message}");
    let summary = summary(&out);
    assert_eq!(summary.ended, Ended::OutputFailed);
    assert!(summary.stopped.is_some_and(|why| why.contains("fields_000000.vti")));
    assert_eq!(rows(&out), 1);
}

#[test]
fn a_guard_leaves_the_last_fields_row_and_plots() {
    // Accelerated without walls from 0.5 m/s: it must pass the limit of 0.4 cells per step.
    let (path, out) = scene(
        "guard",
        r#"{
        "domain": { "size_m": [0.01, 0.08, 0.01], "spacing_m": 0.01 },
        "fluid": {
            "density_kg_per_m3": 1000.0,
            "rheology": { "newtonian": { "viscosity_pa_s": 5.0 } },
            "body_force": { "constant": { "force_n_per_m3": [1000.0, 0.0, 0.0] } }
        },
        "numerics": { "time_step_s": 0.002, "reference_velocity_m_per_s": 0.5 },
        "stop": { "end_time_s": 5.0 }
    }"#,
    );
    let output = lahar(&["run", &path.to_string_lossy(), "--out", &out.to_string_lossy(), "--quiet"]);
    assert_eq!(output.status.code(), Some(3));
    let (summary, series) = (summary(&out), Series::read(&out.join("series.csv")).expect("a series"));
    assert_eq!(summary.ended, Ended::Stopped);
    assert_eq!(series.rows.last().expect("a row")[0], summary.time_s);
    assert_eq!(numbered(&out, "fields_"), 2);
    assert!(out.join("plots/series_max_speed.svg").is_file());
}
