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

/// A relaxation time: three significant digits of what it has above ½, at least four decimals.
pub(super) fn relaxation(tau: f64) -> String {
    let above = (tau - 0.5).abs();
    if above == 0.0 || !above.is_finite() {
        return format!("{tau}");
    }
    let decimals = (2.0 - libm::floor(libm::log10(above))).clamp(4.0, 15.0) as usize;
    format!("{tau:.decimals$}")
}

/// All digits that a number needs, scientific where plain notation would be longer than fifteen places.
pub(super) fn significant(value: f64) -> String {
    let plain = format!("{value}");
    if plain.len() <= 15 { plain } else { format!("{value:e}") }
}

/// The number with so many significant digits that is nearest from above; 0 and what is not finite as they are.
pub(super) fn rounded_up(value: f64, digits: i32) -> f64 {
    rounded(value, digits, f64::ceil)
}

/// The same from below.
pub(super) fn rounded_down(value: f64, digits: i32) -> f64 {
    rounded(value, digits, f64::floor)
}

fn rounded(value: f64, digits: i32, whole: fn(f64) -> f64) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let places = digits - 1 - libm::floor(libm::log10(value.abs())) as i32;
    // Through decimal text, so that no binary rounding shows in what is printed.
    let scale = |power: i32| libm::pow(10.0, f64::from(power));
    // A share of 1e-12 beyond a whole number is rounding.
    let near = value * scale(places);
    let units = if (near - near.round()).abs() < 1e-12 * near.abs() { near.round() } else { whole(near) };
    format!("{units}e{}", -places).parse().unwrap_or(value)
}

/// A number of bytes for people.
#[must_use]
pub(crate) fn human(bytes: u64) -> String {
    let units = [("TiB", 1_u64 << 40), ("GiB", 1 << 30), ("MiB", 1 << 20), ("KiB", 1 << 10)];
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
        assert_eq!(human(5 << 39), "2.50 TiB");
    }

    #[test]
    fn exact_digits() {
        assert_eq!([rounded_up(0.123_41, 3), rounded_down(0.123_41, 3)], [0.124, 0.123]);
        assert_eq!([rounded_up(2.0, 3), rounded_down(2.0, 3)], [2.0; 2]);
        assert_eq!([rounded_up(1.2341e-200, 2), rounded_down(6.789e17, 2)], [1.3e-200, 6.7e17]);
        assert_eq!([significant(0.25), significant(1.0 / 3.0)], ["0.25", "3.333333333333333e-1"]);
        assert_eq!([relaxation(0.5010701), relaxation(0.85), relaxation(0.5)], ["0.50107", "0.8500", "0.5"]);
    }
}
