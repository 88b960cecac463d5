//! Which equation is checked by which claim; the unchecked ones are listed as well.

use std::fmt::Write as _;

use super::Chapter;
use super::format::table;

/// Equations of the design that this version implements.
const DESIGN: [&str; 34] = [
    "L1", "L2", "L3", "L4", "L5", "L6", "L7", "Y1", "Y2", "Y3", "Y4", "Y5", "K1", "K2", "K3", "K4", "K5",
    "K6", "B1", "B2", "B3", "D1", "D2", "D3", "D4", "D5", "D6", "C1", "C2", "C3", "C4", "C5", "C6", "C7",
];

/// Equations of the papers: paper, prefix of the number, last number.
const PAPERS: [(&str, &str, u32); 6] = [
    ("000", "", 19),
    ("001", "", 13),
    ("004", "2.", 4),
    ("004", "3.", 73),
    ("004", "4.", 18),
    ("004", "5.", 4),
];

pub(super) fn render(out: &mut String, chapters: &[Chapter]) {
    out.push_str("## Equations and the claims that check them\n\n");
    let mut tags: Vec<&str> = DESIGN.to_vec();
    let used = chapters.iter().flat_map(|c| &c.records).flat_map(|r| &r.tags).map(String::as_str);
    let mut others: Vec<&str> = used.filter(|t| !DESIGN.contains(t)).collect();
    others.sort_by_key(|t| key(t));
    others.dedup();
    tags.extend(others);
    let rows: Vec<Vec<String>> = tags
        .iter()
        .filter_map(|tag| {
            let claims = claims_of(tag, chapters);
            (!claims.is_empty()).then(|| vec![(*tag).to_owned(), claims.join(", ")])
        })
        .collect();
    if !rows.is_empty() {
        table(out, &["equation", "claims"], &rows);
    }
    let unchecked = |tags: &mut dyn Iterator<Item = String>| -> Vec<String> {
        tags.filter(|t| claims_of(t, chapters).is_empty()).collect()
    };
    out.push_str("Not checked by any claim of this version:\n\n");
    let design = unchecked(&mut DESIGN.iter().map(|&t| t.to_owned()));
    if !design.is_empty() {
        let _ = writeln!(out, "- design: {}", design.join(", "));
    }
    for paper in ["000", "001", "004"] {
        let ranges = PAPERS.iter().filter(|p| p.0 == paper).flat_map(|&(_, prefix, last)| {
            let checked = |n: u32| !claims_of(&format!("{paper} Eq {prefix}{n}"), chapters).is_empty();
            ranges(prefix, (1..=last).filter(|&n| !checked(n)))
        });
        let ranges: Vec<String> = ranges.collect();
        if !ranges.is_empty() {
            let _ = writeln!(out, "- {paper}: {}", ranges.join(", "));
        }
    }
    out.push_str(
        "\nMany equations of the papers describe grains in the fluid or experiments, which this version does not \
         have; others are definitions without a consequence of their own.\n",
    );
}

fn claims_of(tag: &str, chapters: &[Chapter]) -> Vec<String> {
    let records = chapters.iter().flat_map(|c| &c.records);
    records.filter(|r| r.tags.iter().any(|t| t == tag)).map(|r| format!("`{}`", r.claim)).collect()
}

/// Sorts `004 Eq 3.9` before `004 Eq 3.10`.
fn key(tag: &str) -> (String, Vec<u32>) {
    let (paper, number) = tag.split_once(" Eq ").unwrap_or((tag, ""));
    (paper.to_owned(), number.split('.').map(|n| n.parse().unwrap_or(0)).collect())
}

/// Consecutive numbers joined: `Eq 3.1–3.4`.
fn ranges(prefix: &str, numbers: impl Iterator<Item = u32>) -> Vec<String> {
    let mut found: Vec<(u32, u32)> = Vec::new();
    for n in numbers {
        match found.last_mut() {
            Some((_, end)) if *end + 1 == n => *end = n,
            _ => found.push((n, n)),
        }
    }
    let text = |(a, b): (u32, u32)| match b - a {
        0 => format!("Eq {prefix}{a}"),
        _ => format!("Eq {prefix}{a}–{prefix}{b}"),
    };
    found.into_iter().map(text).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_and_sorting() {
        assert_eq!(ranges("3.", [1, 2, 3, 7, 9, 10].into_iter()), ["Eq 3.1–3.3", "Eq 3.7", "Eq 3.9–3.10"]);
        assert!(key("004 Eq 3.9") < key("004 Eq 3.10"));
        assert!(key("000 Eq 14") < key("004 Eq 3.10"));
    }
}
