//! Which equation is checked by which claim, and which by none.

use std::fmt::Write as _;

use super::FOLDER;
use super::chapter::Chapter;
use super::page::{ended, file};
use super::papers::{Check, PAPERS, UNTAGGED};
use super::text::{anchor, code_list, item, paragraph};

/// Name of the page.
pub(super) const FILE: &str = "equations.md";

/// Equations of the method, `docs/method.md`.
const METHOD: [&str; 42] = [
    "L1", "L2", "L3", "L4", "L5", "L6", "L7", "Y1", "Y2", "Y3", "Y4", "Y5", "K1", "K2", "K3", "K4", "K5",
    "K6", "B1", "B2", "B3", "B4", "F1", "F2", "F3", "F4", "F5", "F6", "F7", "D1", "D2", "D3", "D4", "D5",
    "D6", "C1", "C2", "C3", "C4", "C5", "C6", "C7",
];

/// Names of the papers.
const NAMES: [&str; 3] = ["000", "001", "004"];

/// How the equations of a paper are covered.
#[derive(Default)]
struct Cover {
    tagged: Vec<(String, u32)>,
    untagged: Vec<(String, u32, &'static str)>,
    units: Vec<(String, u32, &'static str)>,
    not_applicable: Vec<(String, u32)>,
    untested: Vec<(String, u32)>,
}

impl Cover {
    fn of(paper: &str, chapters: &[Chapter]) -> Self {
        let mut cover = Self::default();
        for &(_, part, last) in PAPERS.iter().filter(|p| p.0 == paper) {
            for n in 1..=last {
                let place = (part.to_owned(), n);
                if is_tagged(&format!("{paper} Eq {part}{n}"), chapters) {
                    cover.tagged.push(place);
                    continue;
                }
                let found = UNTAGGED.iter().find(|u| u.0 == paper && u.1 == part && (u.2..=u.3).contains(&n));
                match found.map(|u| u.4) {
                    Some(Check::Claim(id)) => cover.untagged.push((place.0, n, id)),
                    Some(Check::UnitTest(file)) => cover.units.push((place.0, n, file)),
                    Some(Check::NotApplicable) => cover.not_applicable.push(place),
                    Some(Check::Untested) | None => cover.untested.push(place),
                }
            }
        }
        cover
    }

    fn counts(&self) -> [usize; 5] {
        let Self { tagged, untagged, units, not_applicable, untested } = self;
        [tagged.len(), untagged.len(), units.len(), not_applicable.len(), untested.len()]
    }
}

/// The page.
pub(super) fn render(chapters: &[Chapter]) -> String {
    let mut out = "# Equations and the claims that check them\n\n".to_owned();
    paragraph(
        &mut out,
        "Equations of the method, [docs/method.md](../../docs/method.md), and the claims that name them:",
    );
    for tag in METHOD.iter().filter(|t| is_tagged(t, chapters)) {
        item(&mut out, &format!("**{tag}**: {}", claims_of(tag, chapters)));
    }
    out.push('\n');
    let unnamed: Vec<&str> = METHOD.iter().copied().filter(|t| !is_tagged(t, chapters)).collect();
    if !unnamed.is_empty() {
        paragraph(&mut out, &format!("Named by no claim: {}.", unnamed.join(", ")));
    }
    NAMES.iter().for_each(|paper| render_paper(&mut out, paper, chapters));
    others(&mut out, chapters);
    ended(out)
}

fn render_paper(out: &mut String, paper: &str, chapters: &[Chapter]) {
    let cover = Cover::of(paper, chapters);
    let _ = write!(out, "## Paper {paper}\n\n");
    for (part, n) in &cover.tagged {
        item(out, &format!("**Eq {part}{n}**: {}", claims_of(&format!("{paper} Eq {part}{n}"), chapters)));
    }
    out.push('\n');
    if !cover.untagged.is_empty() {
        paragraph(out, "*Checked by a claim that does not name it*, one of them for each:");
        by_place(&cover.untagged).iter().for_each(|line| item(out, line));
        out.push('\n');
    }
    if !cover.units.is_empty() {
        paragraph(out, "*Tested by unit tests only*:");
        by_place(&cover.units).iter().for_each(|line| item(out, line));
        out.push('\n');
    }
    let lists = [
        ("Nothing to test (definitions, kinetic theory, steps of derivations)", &cover.not_applicable),
        ("Could be tested and is not", &cover.untested),
    ];
    for (words, numbers) in lists.iter().filter(|l| !l.1.is_empty()) {
        paragraph(out, &format!("*{words}*: {}.", ranges(numbers).join(", ")));
    }
}

/// Equations by where they are checked: ``3.1–3.4: `claim` ``.
fn by_place(checked: &[(String, u32, &'static str)]) -> Vec<String> {
    let mut places: Vec<&str> = Vec::new();
    for (.., place) in checked {
        if !places.contains(place) {
            places.push(place);
        }
    }
    let line = |place: &&str| {
        let of_place = checked.iter().filter(|c| c.2 == *place);
        let numbers: Vec<(String, u32)> = of_place.map(|(part, n, _)| (part.clone(), *n)).collect();
        format!("{}: `{place}`", ranges(&numbers).join(", "))
    };
    places.iter().map(line).collect()
}

/// Tables, figures, sections and misprints of the papers, hard cases.
fn others(out: &mut String, chapters: &[Chapter]) {
    let used = chapters.iter().flat_map(|c| &c.claims).flat_map(|c| &c.record.tags).map(String::as_str);
    let mut tags: Vec<&str> = used.filter(|t| !METHOD.contains(t) && !t.contains(" Eq ")).collect();
    tags.sort_by_key(|t| key(t));
    tags.dedup();
    if tags.is_empty() {
        return;
    }
    out.push_str("## Sections, misprints and hard cases\n\n");
    for tag in tags {
        item(out, &format!("**{tag}**: {}", claims_of(tag, chapters)));
    }
}

/// One row per paper for the index.
pub(super) fn counts(out: &mut String, chapters: &[Chapter]) {
    out.push_str("## Equations of the papers\n\n");
    let columns = [
        "paper",
        "checked",
        "by a claim that does not name it",
        "unit tests only",
        "nothing to test",
        "untested",
    ];
    let row = |paper: &&str| {
        let counts = Cover::of(paper, chapters).counts();
        std::iter::once((*paper).to_owned()).chain(counts.iter().map(usize::to_string)).collect()
    };
    let rows: Vec<Vec<String>> = NAMES.iter().map(row).collect();
    crate::format::table(out, &columns, &rows);
    paragraph(out, &format!("[Which claim checks which equation]({FOLDER}/{FILE})."));
}

fn is_tagged(tag: &str, chapters: &[Chapter]) -> bool {
    chapters.iter().flat_map(|c| &c.claims).any(|c| c.record.tags.iter().any(|t| t == tag))
}

/// The claims with a tag, by chapter.
fn claims_of(tag: &str, chapters: &[Chapter]) -> String {
    let of = |(k, chapter): (usize, &Chapter)| {
        let tagged = chapter.claims.iter().filter(|c| c.record.tags.iter().any(|t| t == tag));
        let ids: Vec<&str> = tagged.map(|c| c.record.claim.as_str()).collect();
        match ids.as_slice() {
            [] => None,
            [id] => Some(format!("[{id}]({}#{})", file(k, chapter), anchor(id))),
            ids => {
                Some(format!("[{}]({}): {}", chapter.title, file(k, chapter), code_list(ids.iter().copied())))
            }
        }
    };
    chapters.iter().enumerate().filter_map(of).collect::<Vec<_>>().join("; ")
}

/// Sorts `docs/errata.md 9` before `docs/errata.md 10`.
fn key(tag: &str) -> (String, u32) {
    let digits = tag.len() - tag.trim_end_matches(|c: char| c.is_ascii_digit()).len();
    let (words, number) = tag.split_at(tag.len() - digits);
    (words.to_owned(), number.parse().unwrap_or(0))
}

/// Consecutive numbers joined: `3.1–3.4`.
fn ranges(numbers: &[(String, u32)]) -> Vec<String> {
    let mut found: Vec<(&str, u32, u32)> = Vec::new();
    for (part, n) in numbers {
        match found.last_mut() {
            Some((p, _, end)) if p == part && *end + 1 == *n => *end = *n,
            _ => found.push((part, *n, *n)),
        }
    }
    let text =
        |(p, a, b): (&str, u32, u32)| if a == b { format!("{p}{a}") } else { format!("{p}{a}–{p}{b}") };
    found.into_iter().map(text).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::studies;

    #[test]
    fn ranges_and_sorting() {
        let numbers = [1, 2, 3, 7, 9, 10].map(|n| ("3.".to_owned(), n));
        assert_eq!(ranges(&numbers), ["3.1–3.3", "3.7", "3.9–3.10"]);
        assert!(key("ERRATA 9") < key("ERRATA 10"));
    }

    /// Every equation either is the tag of a claim or stands once in the table, and the table names
    /// claims that exist.
    #[test]
    fn every_equation_of_the_papers_is_accounted_for_once() {
        let claims: Vec<_> = studies().iter().flat_map(|s| s.claims).collect();
        for (paper, part, last) in PAPERS {
            for n in 1..=last {
                let tag = format!("{paper} Eq {part}{n}");
                let tagged = claims.iter().any(|c| c.tags.contains(&tag.as_str()));
                let listed =
                    UNTAGGED.iter().filter(|u| u.0 == paper && u.1 == part && (u.2..=u.3).contains(&n));
                assert_eq!(listed.count() + usize::from(tagged), 1, "{tag}");
            }
        }
        for (.., check) in UNTAGGED {
            if let Check::Claim(id) = check {
                assert!(claims.iter().any(|c| c.id == id), "{id}");
            }
        }
    }
}
