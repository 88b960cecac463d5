//! Ticks and number labels of axes.
//!
//! Logarithmic axes are drawn on log10 coordinates computed with `libm`, so that a figure has
//! the same bytes on every platform.

/// An axis prepared for drawing: coordinates run over `range`; ticks are coordinates with labels.
#[derive(Clone)]
pub(super) struct Scale {
    pub log: bool,
    pub range: [f64; 2],
    pub ticks: Vec<(f64, String)>,
}

impl Scale {
    /// Chooses range and ticks for the values shown along one axis.
    pub fn new(log: bool, values: impl Iterator<Item = f64>) -> Self {
        let mut coordinates: Vec<f64> = values.filter_map(|v| coordinate(log, v)).collect();
        coordinates.sort_by(f64::total_cmp);
        coordinates.dedup();
        let (low, high) = match (coordinates.first(), coordinates.last()) {
            (Some(&a), Some(&b)) => (a, b),
            _ => (0.0, 1.0),
        };
        let pad = if high > low { 0.04 * (high - low) } else { (0.1 * high.abs()).max(0.1) };
        let range = [low - pad, high + pad];
        let ticks = match rungs(log, &coordinates) {
            Some(ticks) => ticks,
            None if log => log_ticks(range),
            None => linear_ticks(range),
        };
        Self { log, range, ticks }
    }

    /// Where a value lies on this axis; `None` if it cannot be shown.
    pub(crate) fn place(&self, value: f64) -> Option<f64> {
        coordinate(self.log, value)
    }

    /// Label of the tick nearest to a coordinate.
    pub(crate) fn label(&self, at: f64) -> String {
        let nearest = self.ticks.iter().min_by(|a, b| (a.0 - at).abs().total_cmp(&(b.0 - at).abs()));
        nearest.map_or_else(String::new, |(_, label)| label.clone())
    }
}

fn coordinate(log: bool, value: f64) -> Option<f64> {
    let value = if !log {
        value
    } else if value > 0.0 {
        libm::log10(value)
    } else {
        return None;
    };
    value.is_finite().then_some(value)
}

/// On a logarithmic axis with few distinct, well separated values (a ladder), these are the ticks.
fn rungs(log: bool, sorted: &[f64]) -> Option<Vec<(f64, String)>> {
    let span = sorted.last()? - sorted.first()?;
    let few = log && (2..=8).contains(&sorted.len());
    let apart = sorted.windows(2).all(|w| w[1] - w[0] > 0.07 * span);
    (few && apart && span < 3.0).then(|| sorted.iter().map(|&c| (c, short(libm::pow(10.0, c)))).collect())
}

fn log_ticks([low, high]: [f64; 2]) -> Vec<(f64, String)> {
    let first = low.ceil() as i32;
    let last = high.floor() as i32;
    if last - first >= 1 {
        let stride = 1 + (last - first) / 8;
        let decades = (first..=last).filter(|k| k.rem_euclid(stride) == 0);
        return decades.map(|k| (f64::from(k), power_of_ten(k))).collect();
    }
    let mut ticks = Vec::new();
    for k in first - 2..=last + 1 {
        for digit in [1.0, 2.0, 3.0, 5.0, 7.0] {
            let c = f64::from(k) + libm::log10(digit);
            if (low..=high).contains(&c) {
                ticks.push((c, short(libm::pow(10.0, c))));
            }
        }
    }
    if ticks.len() >= 2 { ticks } else { [low, high].map(|c| (c, short(libm::pow(10.0, c)))).to_vec() }
}

fn linear_ticks([low, high]: [f64; 2]) -> Vec<(f64, String)> {
    let raw = (high - low) / 6.0;
    let decade = libm::pow(10.0, libm::floor(libm::log10(raw)));
    let step = [1.0, 2.0, 5.0, 10.0].map(|m| m * decade).into_iter().find(|s| *s >= raw);
    let step = step.unwrap_or(10.0 * decade);
    let first = (low / step).ceil() as i64;
    let last = (high / step).floor() as i64;
    let digits = (-libm::floor(libm::log10(step) + 1e-9)).clamp(0.0, 12.0) as usize;
    let most = high.abs().max(low.abs());
    // Four digits that `short` has must tell neighbours apart.
    let wide = (most >= 1e5 || step < 1e-4) && most / step < 1e4;
    let tick = |k: i64| {
        let value = k as f64 * step;
        (value, if wide { short(value) } else { format!("{value:.digits$}") })
    };
    (first..=last).map(tick).collect()
}

/// Four significant digits, plain near 1, `a×10ᵇ` elsewhere.
pub(super) fn short(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    let text = format!("{x:.3e}");
    let Some((mantissa, exponent)) = text.split_once('e') else { return text };
    let power: i32 = exponent.parse().unwrap_or(0);
    if (-3..5).contains(&power) {
        let fixed = format!("{x:.*}", (3 - power).max(0) as usize);
        return if fixed.contains('.') { trimmed(&fixed).to_owned() } else { fixed };
    }
    match trimmed(mantissa) {
        "1" => power_of_ten(power),
        digits => format!("{digits}×{}", power_of_ten(power)),
    }
}

fn trimmed(digits: &str) -> &str {
    if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { digits }
}

fn power_of_ten(k: i32) -> String {
    let superscript = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        d => char::from_u32('⁰' as u32 + d as u32 - '0' as u32).unwrap_or(d),
    };
    if k == 0 {
        "1".to_owned()
    } else {
        format!("10{}", k.to_string().chars().map(superscript).collect::<String>())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_numbers() {
        let cases =
            [(0.0, "0"), (1.0, "1"), (128.0, "128"), (0.55, "0.55"), (1e-5, "10⁻⁵"), (2.5e-12, "2.5×10⁻¹²")];
        for (x, text) in cases {
            assert_eq!(short(x), text);
        }
    }

    #[test]
    fn a_ladder_is_its_own_ticks_and_decades_are_labelled() {
        let labels = |s: &Scale| s.ticks.iter().map(|t| t.1.clone()).collect::<Vec<_>>();
        assert_eq!(
            labels(&Scale::new(true, [16.0, 32.0, 64.0, 128.0].into_iter())),
            ["16", "32", "64", "128"]
        );
        let wide = Scale::new(true, (0..40).map(|k| libm::pow(10.0, -0.1 * f64::from(k))));
        assert_eq!(
            labels(&wide),
            ["10⁻⁴", "10⁻³", "10⁻²", "10⁻¹", "1"][if wide.range[0] <= -4.0 { 0 } else { 1 }..]
        );
        assert_eq!(
            labels(&Scale::new(false, [0.0, 1.0].into_iter())),
            ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]
        );
    }

    #[test]
    fn less_than_a_decade_is_labelled_by_digits() {
        let labels = |range| log_ticks(range).into_iter().map(|tick| tick.1).collect::<Vec<_>>();
        assert_eq!(labels([0.35, 0.9]), ["3", "5", "7"]);
        // 10^−1.2 to 10^−0.9: 0.063 to 0.126.
        assert_eq!(labels([-1.2, -0.9]), ["0.07", "0.1"]);
        for (c, label) in log_ticks([0.35, 0.9]) {
            let value: f64 = label.parse().unwrap_or(f64::NAN);
            assert!((c - libm::log10(value)).abs() < 1e-15, "{c} {label}");
        }
    }

    #[test]
    fn unusable_values_leave_a_usable_axis() {
        for log in [false, true] {
            let scale =
                Scale::new(log, [f64::NAN, f64::INFINITY, -0.0].into_iter().filter(|v| log || *v != 0.0));
            assert!(scale.range[0] < scale.range[1] && !scale.ticks.is_empty());
        }
    }
}
