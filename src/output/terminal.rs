//! Lines for people, which nobody has to read: a closed pipe or a full device is no reason to end a run.

use std::io::{self, Write};

/// Prints a line to standard error; what cannot be printed is dropped.
pub fn say(line: &str) {
    // One write, so that lines of several processes do not mix; there is nobody left to tell of a failure.
    let _ = io::stderr().write_all(format!("{line}\n").as_bytes());
}

/// Prints text to standard output.
///
/// # Errors
/// Nobody reads, or the device is full.
pub fn print(text: &str) -> io::Result<()> {
    let mut out = io::stdout();
    out.write_all(text.as_bytes())?;
    out.flush()
}
