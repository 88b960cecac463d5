//! The name that was probably meant.

/// The allowed name nearest to `found`, if any is near enough to be worth naming: few typing
/// errors, or one name begins with the other (`viscosity` for `viscosity_pa_s`).
#[must_use]
pub(crate) fn nearest<'a>(found: &str, allowed: &'a [String]) -> Option<&'a str> {
    let lower = found.to_lowercase();
    let by_distance = allowed.iter().map(|name| (distance(&lower, name), name)).min_by_key(|(d, _)| *d);
    match by_distance {
        Some((d, name)) if d <= 2 || d * 3 <= name.len() => Some(name),
        _ => allowed.iter().find(|name| begins(&lower, name)).map(String::as_str),
    }
}

/// Whether one of them is as good as the other: at most two typing errors, or one begins with the other.
#[must_use]
pub(super) fn is_typing_error(found: &str, name: &str) -> bool {
    let lower = found.to_lowercase();
    begins(&lower, name) || (lower.len() >= 4 && distance(&lower, name) <= 2)
}

fn begins(lower: &str, name: &str) -> bool {
    lower.len() >= 4 && (name.starts_with(lower) || lower.starts_with(name))
}

/// Edit distance with insertions, deletions, substitutions and swaps of neighbours.
fn distance(a: &str, b: &str) -> usize {
    let a: Vec<char> = a.chars().collect();
    let b: Vec<char> = b.chars().collect();
    let mut rows = vec![vec![0; b.len() + 1]; a.len() + 1];
    for (i, row) in rows.iter_mut().enumerate() {
        row[0] = i;
    }
    rows[0] = (0..=b.len()).collect();
    for i in 1..=a.len() {
        for j in 1..=b.len() {
            let substituted = rows[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut best = substituted.min(rows[i - 1][j] + 1).min(rows[i][j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                best = best.min(rows[i - 2][j - 2] + 1);
            }
            rows[i][j] = best;
        }
    }
    rows[a.len()][b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_distances() {
        assert_eq!(distance("spacing", "spacing"), 0);
        assert_eq!(distance("spacing", "sapcing"), 1);
        assert_eq!(distance("", "abc"), 3);
        assert_eq!(distance("kitten", "sitting"), 3);
    }

    #[test]
    fn nearest_by_typo_and_by_beginning() {
        let allowed = ["viscosity_pa_s", "spacing_m", "size_m"].map(str::to_owned);
        assert_eq!(nearest("spacng_m", &allowed), Some("spacing_m"));
        assert_eq!(nearest("viscosity", &allowed), Some("viscosity_pa_s"));
        assert_eq!(nearest("Spacing_m", &allowed), Some("spacing_m"));
        assert_eq!(nearest("temperature_k", &allowed), None);
    }
}
