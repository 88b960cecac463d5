//! Numbers as a reader wants them.

use crate::record::Record;

/// Three significant digits: plain between 0.01 and 1000, `1.23e-5` elsewhere.
#[must_use]
pub fn scientific(x: f64) -> String {
    significant(x, 3)
}

/// A given number of significant digits (at least 1): plain between 0.01 and 1000, `1.23e-5` elsewhere.
#[must_use]
pub fn significant(x: f64, digits: usize) -> String {
    if x.is_nan() {
        return "n/a".to_owned();
    }
    if x.is_infinite() {
        return if x > 0.0 { "∞" } else { "−∞" }.to_owned();
    }
    if x == 0.0 {
        return "0".to_owned();
    }
    let text = format!("{x:.*e}", digits.max(1) - 1);
    let Some((mantissa, exponent)) = text.split_once('e') else { return text };
    let power: i32 = exponent.parse().unwrap_or(0);
    if !(-2..3).contains(&power) {
        return format!("{}e{exponent}", trimmed(mantissa));
    }
    let decimals = (digits as i32 - 1 - power).max(0) as usize;
    trimmed(&format!("{x:.decimals$}")).to_owned()
}

fn trimmed(number: &str) -> &str {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}

/// Observed order with its standard error, or a dash.
#[must_use]
pub fn order(record: &Record) -> String {
    let Some(order) = &record.order else { return "–".to_owned() };
    match order.fitted.standard_error {
        // Below this the scatter is rounding and differs between processors.
        Some(s) if s < 5e-4 => format!("{:.3} ± <0.001", order.fitted.order),
        Some(s) => format!("{:.3} ± {s:.3}", order.fitted.order),
        None => format!("{:.3}", order.fitted.order),
    }
}

/// Text made safe for a cell of a Markdown table.
#[must_use]
pub fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace('\n', " ")
}

/// Appends a Markdown table.
pub fn table(out: &mut String, columns: &[&str], rows: &[Vec<String>]) {
    let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    out.push_str(&line(columns.iter().map(|c| cell(c)).collect()));
    out.push_str(&line(columns.iter().map(|_| "---".to_owned()).collect()));
    for row in rows {
        out.push_str(&line(row.iter().map(|c| cell(c)).collect()));
    }
    out.push('\n');
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_significant_digits() {
        let cases = [
            (0.0, "0"),
            (1.0, "1"),
            (64.0, "64"),
            (0.051_234, "0.0512"),
            (123.456, "123"),
            (1234.5, "1.23e3"),
            (1.0e-12, "1e-12"),
            (-2.345e-5, "-2.35e-5"),
            (f64::INFINITY, "∞"),
            (f64::NAN, "n/a"),
        ];
        for (x, text) in cases {
            assert_eq!(scientific(x), text);
        }
    }

    #[test]
    fn bars_do_not_break_tables() {
        let mut out = String::new();
        table(&mut out, &["|u|"], &[vec!["a\nb".to_owned()]]);
        assert_eq!(out, "| \\|u\\| |\n| --- |\n| a b |\n\n");
    }
}
