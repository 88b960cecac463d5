//! Tests of the copy, each on its own, and what they say of a mistake.

use std::collections::BTreeSet;
use std::os::unix::process::CommandExt as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// One test, as it went without a mistake.
#[derive(Clone, Debug)]
pub struct Test {
    pub program: PathBuf,
    pub place: PathBuf,
    pub name: String,
    pub took: Duration,
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
    let output = Command::new("cargo")
        .args(arguments)
        .current_dir(copy)
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

/// Runs every test once and sees what it reaches; those that fail in the copy are named and left out.
pub fn all(programs: &[(PathBuf, PathBuf)], scratch: &Path) -> Result<(Vec<Test>, Vec<String>), String> {
    let (mut tests, mut failed) = (Vec::new(), Vec::new());
    for (program, place) in programs {
        let output = command(program, place)
            .args(["--list", "--format", "terse"])
            .stdout(Stdio::piped())
            .output()
            .map_err(|error| error.to_string())?;
        for line in String::from_utf8_lossy(&output.stdout).lines() {
            let Some(name) = line.strip_suffix(": test") else { continue };
            let folder = scratch.join("reached");
            let _ = std::fs::remove_dir_all(&folder);
            std::fs::create_dir_all(&folder).map_err(|error| error.to_string())?;
            let mut command = command(program, place);
            command.args(["--exact", name]).env("LAHAR_REACHED", &folder);
            let start = Instant::now();
            let held = holds(command, Duration::from_secs(600));
            let took = start.elapsed();
            if !held {
                failed.push(format!("{} {name}", program.display()));
                continue;
            }
            let names = std::fs::read_dir(&folder).map_err(|error| error.to_string())?;
            let reached =
                names.flatten().filter_map(|entry| entry.file_name().to_str()?.parse().ok()).collect();
            let (program, place, name) = (program.clone(), place.clone(), name.to_owned());
            tests.push(Test { program, place, name, took, reached });
        }
    }
    tests.sort_by_key(|test| test.took);
    Ok((tests, failed))
}

/// The name of a test that fails with a mistake, or none.
pub fn killer(number: u32, tests: &[Test]) -> Option<String> {
    let reach: Vec<&Test> = tests.iter().filter(|test| test.reached.contains(&number)).collect();
    let mut at = 0;
    while at < reach.len() {
        // Tests of one program that follow each other and take up to three seconds run at once.
        let (mut end, mut sum) = (at, Duration::ZERO);
        while end < reach.len()
            && reach[end].program == reach[at].program
            && (end == at || sum < Duration::from_secs(3))
        {
            sum += reach[end].took;
            end += 1;
        }
        let mut command = command(&reach[at].program, &reach[at].place);
        command.arg("--exact").args(reach[at..end].iter().map(|test| &test.name));
        command.env("LAHAR_MUTANT", number.to_string());
        if !holds(command, Duration::from_secs(20) + 5 * sum) {
            let program = reach[at].program.file_name().and_then(|name| name.to_str()).unwrap_or_default();
            let group = program.rsplit_once('-').map_or(program, |(name, _)| name);
            let more = if end - at > 1 { format!(" and {} more", end - at - 1) } else { String::new() };
            return Some(format!("{group}: {}{more}", reach[at].name));
        }
        at = end;
    }
    None
}

/// Whether a program ends well in time. It and what it started are ended then.
fn holds(mut command: Command, limit: Duration) -> bool {
    command.process_group(0);
    let Ok(mut child) = command.spawn() else { return false };
    let start = Instant::now();
    loop {
        match child.try_wait() {
            Ok(Some(status)) => return status.success(),
            Ok(None) if start.elapsed() < limit => std::thread::sleep(Duration::from_millis(5)),
            _ => {
                let _ = Command::new("kill").args(["-KILL", "--", &format!("-{}", child.id())]).status();
                let _ = child.wait();
                return false;
            }
        }
    }
}
