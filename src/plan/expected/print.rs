//! The section of `lahar plan` about errors.

use std::fmt;

use super::likeness::Likeness;
use super::lookup::{Expectation, Interval};
use crate::plan::text::{row, short};

impl fmt::Display for Likeness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.kind.name())?;
        for (k, ((name, _), x)) in self.kind.axes().iter().zip(self.at).enumerate() {
            let comma = if k > 0 { ", " } else { "" };
            write!(f, "{comma}{} {name}", short(x))?;
        }
        Ok(())
    }
}

impl fmt::Display for Interval {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_known() {
            write!(f, "{} to +{} %", percent(self.low), percent(self.high))
        } else {
            write!(f, "unknown: of the scenes like this one some were stopped by a guard, or none tells")
        }
    }
}

/// Two significant digits are enough for a range.
fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    if percent == 0.0 {
        return "0".to_owned();
    }
    let places = 1 - libm::floor(libm::log10(percent.abs())) as i32;
    let scale = libm::pow(10.0, f64::from(places));
    short((percent * scale).round() / scale)
}

/// The section.
///
/// # Errors
/// Those of the formatter.
pub(in crate::plan) fn section(f: &mut fmt::Formatter<'_>, expectation: &Expectation) -> fmt::Result {
    writeln!(f, "\nExpected error")?;
    match expectation {
        Expectation::Measured { like, rows, errors } => {
            for interval in errors {
                row(f, interval.of, format_args!("{interval}"))?;
            }
            row(
                f,
                "from",
                format_args!("twice the range of the {rows} random scenes most like it (`study-sweep`)"),
            )?;
            row(f, "", format_args!("{like}"))
        }
        Expectation::Outside { why, .. } => {
            row(f, "outside of what was measured", format_args!("{why}"))?;
            row(f, "way out", format_args!("run two spacings and compare"))
        }
    }
}
