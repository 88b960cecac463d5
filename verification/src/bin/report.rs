//! Makes `REPORT.md` and its figures from the golden records, or says whether they are current.

use std::process::ExitCode;

use clap::Parser;
use lahar_verification::golden::package_root;
use lahar_verification::report::{ReportOutcome, command};

/// Makes REPORT.md and its figures from the golden records.
#[derive(Parser)]
#[command(
    name = "report",
    after_help = "Exit codes: 0 done or up to date, 1 out of date, 4 input or output failed."
)]
struct Options {
    /// Only say whether they are up to date.
    #[arg(long)]
    check: bool,
}

fn main() -> ExitCode {
    let options = Options::parse();
    match command(&package_root(), options.check) {
        Ok(ReportOutcome::Current) => say("the report is up to date"),
        Ok(ReportOutcome::Written { files }) => say(&format!("{files} files written")),
        Ok(ReportOutcome::Stale { files }) => {
            let names: Vec<String> = files.iter().map(|file| file.display().to_string()).collect();
            eprintln!(
                "error: the report is not up to date: {}\n  way out: run `cargo run --release --bin report`",
                names.join(", ")
            );
            ExitCode::from(1)
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(4)
        }
    }
}

/// Prints without panicking when nobody reads.
fn say(line: &str) -> ExitCode {
    use std::io::Write;
    match writeln!(std::io::stdout(), "{line}") {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => ExitCode::from(4),
        _ => ExitCode::SUCCESS,
    }
}
