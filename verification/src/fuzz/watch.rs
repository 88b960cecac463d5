//! Workers, and the watch over them: a mutant that ends its worker or holds it up is a fault, and the next worker goes on behind it.

use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use super::tally::Outcome;

/// A mutant may take this long, with nothing optimised and a machine that has other things to do.
pub const LIMIT: Duration = Duration::from_secs(20);

/// What a worker says of a mutant before it begins.
pub fn begin(number: u64) -> std::io::Result<()> {
    said(&format!("begin {number}"))
}

/// What it says afterwards.
pub fn end(outcome: &Outcome) -> std::io::Result<()> {
    said(&format!("end {outcome}"))
}

fn said(line: &str) -> std::io::Result<()> {
    let mut out = std::io::stdout().lock();
    writeln!(out, "{line}")?;
    out.flush()
}

/// Gives the mutants `from..to` to workers that `command` starts for a range, and reports each with the seconds it took.
///
/// # Errors
/// A worker that does not start, or ends without having begun.
pub fn over(
    from: u64,
    to: u64,
    limit: Duration,
    command: impl Fn(u64, u64) -> Command,
    mut report: impl FnMut(u64, Outcome, f64),
) -> std::io::Result<()> {
    let mut next = from;
    while next < to {
        let mut worker = Worker::start(command(next, to))?;
        let before = next;
        while let Some((number, outcome, seconds)) = worker.next(limit) {
            report(number, outcome, seconds);
            next = number + 1;
        }
        if next == before {
            return Err(std::io::Error::other(format!("a worker did nothing: {}", worker.last_words())));
        }
    }
    Ok(())
}

struct Worker {
    child: Child,
    lines: Receiver<String>,
    errors: Receiver<String>,
}

impl Worker {
    fn start(mut command: Command) -> std::io::Result<Self> {
        let piped = command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = piped.spawn()?;
        let (send, lines) = channel();
        if let Some(out) = child.stdout.take() {
            std::thread::spawn(move || {
                BufReader::new(out).lines().map_while(Result::ok).all(|line| send.send(line).is_ok())
            });
        }
        let (send, errors) = channel();
        if let Some(mut err) = child.stderr.take() {
            std::thread::spawn(move || {
                let mut bytes = Vec::new();
                let _ = err.read_to_end(&mut bytes);
                send.send(String::from_utf8_lossy(&bytes).into_owned())
            });
        }
        Ok(Self { child, lines, errors })
    }

    /// The next mutant; `None` when the worker has ended between two of them.
    fn next(&mut self, limit: Duration) -> Option<(u64, Outcome, f64)> {
        let number = self.lines.recv().ok()?.strip_prefix("begin ")?.parse().ok()?;
        let start = Instant::now();
        let outcome = match self.lines.recv_timeout(limit) {
            Ok(line) => line.strip_prefix("end ").and_then(|text| text.parse().ok()),
            Err(RecvTimeoutError::Timeout) => {
                let _ = self.child.kill();
                Some(Outcome::Fault(format!("no end within {} s", limit.as_secs())))
            }
            Err(RecvTimeoutError::Disconnected) => None,
        };
        let outcome = outcome.unwrap_or_else(|| Outcome::Fault(self.last_words()));
        Some((number, outcome, start.elapsed().as_secs_f64()))
    }

    /// How it ended, and the first of what it said about it.
    fn last_words(&mut self) -> String {
        let status = self.child.wait().map_or_else(|error| error.to_string(), |status| status.to_string());
        let said = self.errors.recv_timeout(Duration::from_secs(1)).unwrap_or_default();
        let first: Vec<&str> = said.lines().filter(|line| !line.trim().is_empty()).take(3).collect();
        format!("{status}: {}", first.join(" "))
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    /// A worker that is a shell script, with its first number.
    fn faults(script: &str, to: u64) -> Vec<(u64, String)> {
        let mut found = Vec::new();
        let command = |from, _| {
            let mut shell = Command::new("sh");
            shell.args(["-c", &format!("k={from}; {script}")]);
            shell
        };
        let report = |number, outcome: Outcome, _| {
            if let Outcome::Fault(what) = outcome {
                found.push((number, what));
            }
        };
        over(3, to, Duration::from_millis(300), command, report).unwrap();
        found
    }

    #[test]
    fn a_worker_that_dies_or_hangs_is_at_fault_and_the_next_goes_on() {
        let all = "while [ $k -lt 6 ]; do echo begin $k; ";
        assert_eq!(faults(&format!("{all} echo end ran; k=$((k+1)); done"), 6), []);
        let dies = faults(
            &format!("{all} [ $k = 4 ] && {{ echo words >&2; exit 101; }}; echo end ran; k=$((k+1)); done"),
            6,
        );
        assert_eq!(dies.len(), 1, "{dies:?}");
        assert!(dies[0].0 == 4 && dies[0].1.contains("101") && dies[0].1.contains("words"), "{dies:?}");
        let killed = faults(&format!("{all} [ $k = 5 ] && kill -ABRT $$; echo end ran; k=$((k+1)); done"), 6);
        assert!(killed.len() == 1 && killed[0].0 == 5 && killed[0].1.contains("signal"), "{killed:?}");
        let hangs = faults(&format!("{all} [ $k = 3 ] && exec sleep 30; echo end ran; k=$((k+1)); done"), 6);
        assert!(hangs.len() == 1 && hangs[0].0 == 3 && hangs[0].1.contains("no end"), "{hangs:?}");
    }

    #[test]
    fn limit_a_worker_that_does_nothing_is_an_error() {
        let nothing = |_, _| Command::new("true");
        assert!(over(0, 1, LIMIT, nothing, |_, _, _| {}).is_err());
    }
}
