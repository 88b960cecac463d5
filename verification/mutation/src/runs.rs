//! Tests of the copy, each on its own, and what they say of a mistake.

use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::io::{BufRead as _, BufReader};
use std::os::unix::process::CommandExt as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// One test, as it went without a mistake.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Test {
    pub program: PathBuf,
    pub place: PathBuf,
    pub name: String,
    pub took: Duration,
    /// Its program takes the name of one test only, as that of the claims does.
    pub alone: bool,
    pub reached: BTreeSet<u32>,
}

/// Programs that read the sources or start cargo: they would judge the copy.
const LEFT_OUT: [&str; 10] = [
    "architecture",
    "dependencies",
    "examples",
    "golden_seals",
    "links",
    "report_current",
    "verify_machinery",
    "bench",
    "peak_memory",
    "fuzz",
];

/// Builds the tests and finds their programs.
pub fn programs(copy: &Path) -> Result<Vec<(PathBuf, PathBuf)>, String> {
    let arguments = ["test", "--no-run", "--message-format", "json"];
    let output = crate::tree::cargo(copy)
        .args(arguments)
        .stderr(Stdio::inherit())
        .output()
        .map_err(|error| error.to_string())?;
    if !output.status.success() {
        return Err("the tests of the copy do not compile".to_owned());
    }
    let mut found = Vec::new();
    for line in String::from_utf8_lossy(&output.stdout).lines() {
        let Ok(message) = serde_json::from_str::<serde_json::Value>(line) else { continue };
        let (Some(program), Some(manifest)) =
            (message["executable"].as_str(), message["manifest_path"].as_str())
        else {
            continue;
        };
        let name = message["target"]["name"].as_str().unwrap_or_default();
        if message["profile"]["test"] == true && !LEFT_OUT.contains(&name) {
            let place = Path::new(manifest).parent().unwrap_or(copy).to_owned();
            found.push((PathBuf::from(program), place));
        }
    }
    Ok(found)
}

fn command(program: &Path, place: &Path) -> Command {
    let mut command = Command::new(program);
    command.current_dir(place).env("INSTA_UPDATE", "no").env("INSTA_WORKSPACE_ROOT", place);
    command.env("RUST_MIN_STACK", "67108864").env("CARGO_MANIFEST_DIR", place).env("RUST_BACKTRACE", "0");
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command
}

/// A test by its program and name.
struct Named {
    program: PathBuf,
    place: PathBuf,
    name: String,
    alone: bool,
}

/// Runs every test once and sees what it reaches; those that fail in the copy are named and left out. The claims are run two at
/// a time: they write no files, so that they do not meet.
pub fn all(programs: &[(PathBuf, PathBuf)], scratch: &Path) -> Result<(Vec<Test>, Vec<String>), String> {
    let mut named = Vec::new();
    for (program, place) in programs {
        named.extend(listed(program, place)?);
    }
    let (claims, others): (Vec<Named>, Vec<Named>) = named.into_iter().partition(|test| test.alone);
    let (mut tests, mut failed) = (Vec::new(), Vec::new());
    for (tests_of, workers) in [(others, 1), (claims, 2)] {
        let left = Mutex::new(tests_of.into_iter());
        let found = Mutex::new(Vec::new());
        std::thread::scope(|scope| {
            for worker in 0..workers {
                let (left, found) = (&left, &found);
                let folder = scratch.join(format!("reached-{worker}"));
                scope.spawn(move || {
                    loop {
                        let Some(test) = left.lock().unwrap_or_else(PoisonError::into_inner).next() else {
                            return;
                        };
                        let outcome = once(test, &folder);
                        found.lock().unwrap_or_else(PoisonError::into_inner).push(outcome);
                    }
                });
            }
        });
        for outcome in found.into_inner().unwrap_or_else(PoisonError::into_inner) {
            match outcome? {
                Ok(test) => tests.push(test),
                Err(name) => failed.push(name),
            }
        }
    }
    tests.sort_by_key(|test| test.took);
    Ok((tests, failed))
}

/// The tests of a program.
fn listed(program: &Path, place: &Path) -> Result<Vec<Named>, String> {
    let output = command(program, place)
        .args(["--list", "--format", "terse"])
        .stdout(Stdio::piped())
        .output()
        .map_err(|error| error.to_string())?;
    let text = String::from_utf8_lossy(&output.stdout);
    let names: Vec<&str> = text.lines().filter_map(|line| line.strip_suffix(": test")).collect();
    let two = command(program, place).args(["--list", "--exact"]).args(names.iter().take(2)).status();
    let alone = !two.map_err(|error| error.to_string())?.success();
    let (program, place) = (program.to_owned(), place.to_owned());
    let named = |name: &&str| Named {
        program: program.clone(),
        place: place.clone(),
        name: (*name).to_owned(),
        alone,
    };
    Ok(names.iter().map(named).collect())
}

/// A test without a mistake, or its name if it fails. `folder`: where the copy says what is reached.
fn once(test: Named, folder: &Path) -> Result<Result<Test, String>, String> {
    let Named { program, place, name, alone } = test;
    let _ = std::fs::remove_dir_all(folder);
    std::fs::create_dir_all(folder).map_err(|error| error.to_string())?;
    let mut command = command(&program, &place);
    command.args(["--exact", &name]).env("LAHAR_REACHED", folder);
    let start = Instant::now();
    let held = ended(command, Duration::from_secs(600))?;
    let took = start.elapsed();
    if !matches!(held, Ended::Well) {
        return Ok(Err(format!("{} {name}", program.display())));
    }
    let names = std::fs::read_dir(folder).map_err(|error| error.to_string())?;
    let reached = names.flatten().filter_map(|entry| entry.file_name().to_str()?.parse().ok()).collect();
    Ok(Ok(Test { program, place, name, took, alone, reached }))
}

/// The test that notices a mistake, or how many of those that reach it were left out. `most`: of the tests' time; once they
/// would take longer together, the rest is left out.
///
/// # Errors
/// A program that does not run tests at all.
pub fn killer(number: u32, tests: &[Test], most: Duration) -> Result<Result<String, usize>, String> {
    let mut spent = Duration::ZERO;
    let batches = batches(number, tests);
    for (k, batch) in batches.iter().enumerate() {
        let first = &batch[0];
        let sum = total(batch);
        spent += sum;
        if spent > most {
            return Ok(Err(batches[k..].iter().map(Vec::len).sum()));
        }
        let mut command = command(&first.program, &first.place);
        command.env("LAHAR_MUTANT", number.to_string());
        command.arg("--exact").args(batch.iter().map(|test| &test.name));
        let program = first.program.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        let group = program.rsplit_once('-').map_or(program, |(name, _)| name);
        // A start of a program takes less than a second, and a busy machine less than five times as long.
        match ended(command, Duration::from_secs(30) + 5 * sum)? {
            Ended::Well => {}
            Ended::Failed(name) => return Ok(Ok(format!("{group}: {name}"))),
            Ended::Late => return Ok(Ok(format!("{group}, which did not end"))),
        }
    }
    Ok(Err(0))
}

/// The tests that reach a mistake, the quickest first: those of one program that follow each other and take up to three
/// seconds at once, where the program takes several names.
fn batches(number: u32, tests: &[Test]) -> Vec<Vec<&Test>> {
    let mut batches: Vec<Vec<&Test>> = Vec::new();
    for test in tests.iter().filter(|test| test.reached.contains(&number)) {
        match batches.last_mut() {
            Some(batch)
                if batch[0].program == test.program
                    && !test.alone
                    && total(batch) < Duration::from_secs(3) =>
            {
                batch.push(test);
            }
            _ => batches.push(vec![test]),
        }
    }
    batches
}

fn total(batch: &[&Test]) -> Duration {
    batch.iter().map(|test| test.took).sum()
}

/// How a program of tests ended.
enum Ended {
    Well,
    /// The first test that failed, or the exit status of a program that crashed.
    Failed(String),
    Late,
}

/// Runs a program of tests until it ends, a test fails or time is up; then it and what it started are ended.
fn ended(mut command: Command, limit: Duration) -> Result<Ended, String> {
    command.process_group(0).stdout(Stdio::piped());
    let mut child = command.spawn().map_err(|error| error.to_string())?;
    let (send, failed) = std::sync::mpsc::channel();
    let lines = BufReader::new(child.stdout.take().ok_or("no output")?).lines();
    let reader = std::thread::spawn(move || {
        for line in lines.map_while(Result::ok) {
            if let Some(name) = line.strip_prefix("test ").and_then(|line| line.split_once(" ... FAILED")) {
                let _ = send.send(name.0.trim().to_owned());
            }
        }
    });
    let start = Instant::now();
    let found = loop {
        if let Ok(name) = failed.try_recv() {
            break Ended::Failed(name);
        }
        match child.try_wait().map_err(|error| error.to_string())? {
            Some(status) if status.success() => return Ok(Ended::Well),
            // Test programs end with 101 when tests fail: this one did not understand its arguments.
            Some(status) if status.code() == Some(2) => return Err(format!("{command:?}: {status}")),
            Some(status) => {
                let _ = reader.join();
                break Ended::Failed(failed.try_recv().unwrap_or_else(|_| status.to_string()));
            }
            None if start.elapsed() > limit => break Ended::Late,
            None => std::thread::sleep(Duration::from_millis(5)),
        }
    };
    let _ = Command::new("kill")
        .args(["-KILL", "--", &format!("-{}", child.id())])
        .stderr(Stdio::null())
        .status();
    let _ = child.wait();
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shell(text: &str) -> Result<Ended, String> {
        let mut command = Command::new("sh");
        command.args(["-c", text]).stderr(Stdio::null());
        ended(command, Duration::from_millis(500))
    }

    #[test]
    fn ends_of_programs() {
        assert!(matches!(shell("echo test a ... ok"), Ok(Ended::Well)));
        // The rest of the tests is not waited for.
        assert!(
            matches!(shell("echo 'test b::c ... FAILED'; sleep 60"), Ok(Ended::Failed(name)) if name == "b::c")
        );
        assert!(matches!(shell("exit 101"), Ok(Ended::Failed(_))));
        assert!(matches!(shell("sleep 60"), Ok(Ended::Late)));
        assert!(shell("exit 2").is_err(), "arguments that are not understood say nothing of a mistake");
    }

    #[test]
    fn what_takes_too_long_is_left_out_and_counted() {
        let test = |program: &str, ms: u64| Test {
            program: program.into(),
            place: PathBuf::from("."),
            name: "a".into(),
            took: Duration::from_millis(ms),
            alone: true,
            reached: BTreeSet::from([7]),
        };
        let tests = [test("true", 2), test("false", 4)];
        let killed = |ms: u64| killer(7, &tests, Duration::from_millis(ms)).unwrap();
        assert_eq!(killed(1), Err(2));
        assert_eq!(killed(5), Err(1));
        assert!(killed(6).is_ok_and(|by| by.starts_with("false: ")));
        assert_eq!(killer(8, &tests, Duration::from_millis(1)).unwrap(), Err(0));
    }

    #[test]
    fn quick_tests_go_together_where_a_program_takes_several_names() {
        let test = |program: &str, ms: u64, alone: bool| Test {
            program: program.into(),
            place: PathBuf::new(),
            name: ms.to_string(),
            took: Duration::from_millis(ms),
            alone,
            reached: BTreeSet::from([7]),
        };
        let tests = [
            test("w", 1, true),
            test("a", 2, false),
            test("a", 3, false),
            test("b", 4, false),
            test("w", 5, true),
        ];
        let names = |batches: Vec<Vec<&Test>>| -> Vec<Vec<String>> {
            batches.iter().map(|batch| batch.iter().map(|test| test.name.clone()).collect()).collect()
        };
        assert_eq!(names(batches(7, &tests)), [vec!["1"], vec!["2", "3"], vec!["4"], vec!["5"]]);
        assert!(batches(8, &tests).is_empty());
    }
}
