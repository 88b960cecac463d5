//! Where, when and on what machine something was computed.

use std::path::PathBuf;

use crate::exhibit::Measured;

/// The nearest folder with golden files: from the package Cargo is running, else from the current
/// directory, upwards; where there is none, that package or directory itself.
#[must_use]
pub fn package_root() -> PathBuf {
    let start = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    let start = start.or_else(|| std::env::current_dir().ok()).unwrap_or_else(|| PathBuf::from("."));
    start.ancestors().find(|folder| folder.join("golden").is_dir()).unwrap_or(&start).to_path_buf()
}

/// Today's date (UTC), `2026-11-22`.
#[must_use]
pub fn today() -> String {
    let since = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    civil(since.map_or(0, |d| d.as_secs() / 86_400))
}

/// Calendar date of a day counted from 1970-01-01 (Gregorian).
fn civil(day: u64) -> String {
    // Years are counted from March, so that the leap day ends a year; 719 468 days from 0000-03-01.
    let shifted = day + 719_468;
    let (era, in_era) = (shifted / 146_097, shifted % 146_097);
    let year_of_era = (in_era - in_era / 1_460 + in_era / 36_524 - in_era / 146_096) / 365;
    let in_year = in_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month = (5 * in_year + 2) / 153;
    let date = in_year - (153 * month + 2) / 5 + 1;
    let (month, carry) = if month < 10 { (month + 3, 0) } else { (month - 9, 1) };
    format!("{:04}-{month:02}-{date:02}", era * 400 + year_of_era + carry)
}

/// Date, processor and core count of this machine.
#[must_use]
pub fn circumstances() -> Measured {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model =
        info.lines().find_map(|l| l.strip_prefix("model name")?.split_once(':').map(|(_, m)| m.trim()));
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let model = model.unwrap_or(std::env::consts::ARCH);
    Measured { date: today(), machine: format!("{model}, {cores} logical cores") }
}

/// The revision of the working copy, short; `None` where there is no git.
#[must_use]
pub fn revision() -> Option<String> {
    let git = std::process::Command::new("git").args(["rev-parse", "--short", "HEAD"]).output();
    let text = git.ok().filter(|o| o.status.success()).and_then(|o| String::from_utf8(o.stdout).ok())?;
    Some(text.trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_calendar() {
        // `date -u -d @N` of the GNU core utilities.
        for (day, date) in
            [(0, "1970-01-01"), (11_016, "2000-02-29"), (19_782, "2024-02-29"), (20_779, "2026-11-22")]
        {
            assert_eq!(civil(day), date);
        }
    }
}
