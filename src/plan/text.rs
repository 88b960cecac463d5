//! What the tables of `lahar plan` are made of.

use std::fmt::{self, Write};

use super::needs::Need;

/// A line of a table.
pub(super) fn row(f: &mut fmt::Formatter<'_>, name: &str, value: fmt::Arguments<'_>) -> fmt::Result {
    let padding = 38_usize.saturating_sub(name.chars().count());
    write!(f, "  {name}")?;
    for _ in 0..padding {
        f.write_char(' ')?;
    }
    writeln!(f, "{value}")
}

/// The sections of passes: those a run has, and those it does not pay for.
pub(super) fn passes(f: &mut fmt::Formatter<'_>, passes: &[Need]) -> fmt::Result {
    for (heading, needed) in [("Needed", true), ("Not needed, not paid for", false)] {
        writeln!(f, "\n{heading}")?;
        for pass in passes.iter().filter(|pass| pass.needed == needed) {
            row(f, pass.pass, format_args!("{}", pass.because))?;
        }
    }
    Ok(())
}

/// The section of warnings; nothing without any.
pub(super) fn warnings(f: &mut fmt::Formatter<'_>, warnings: &[impl fmt::Display]) -> fmt::Result {
    if !warnings.is_empty() {
        writeln!(f, "\nWarnings")?;
    }
    warnings.iter().try_for_each(|warning| writeln!(f, "  - {warning}"))
}

/// Four significant digits; scientific outside 1e-3 … 1e6.
pub(super) fn short(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return if value == f64::INFINITY { "∞".to_owned() } else { format!("{value}") };
    }
    let magnitude = libm::floor(libm::log10(value.abs()));
    if (-3.0..6.0).contains(&magnitude) {
        let decimals = if magnitude < 3.0 { (3.0 - magnitude) as usize } else { 0 };
        let text = format!("{value:.decimals$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    } else {
        format!("{value:.3e}")
    }
}

/// A number of bytes for people.
#[must_use]
pub(crate) fn human(bytes: u64) -> String {
    let units = [("GiB", 1_u64 << 30), ("MiB", 1 << 20), ("KiB", 1 << 10)];
    match units.into_iter().find(|&(_, unit)| bytes >= unit) {
        Some((name, unit)) => format!("{:.2} {name}", bytes as f64 / unit as f64),
        None => format!("{bytes} bytes"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_units_of_bytes() {
        assert_eq!(human(1000), "1000 bytes");
        assert_eq!(human(3 << 19), "1.50 MiB");
        assert_eq!(human(5 << 30), "5.00 GiB");
    }
}
