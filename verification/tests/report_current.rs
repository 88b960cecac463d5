//! The report and its figures are the ones the golden files give, and its pages can be read.

use std::path::Path;

use lahar_verification::report::{ReportOutcome, command};

/// Largest size of the index, bytes.
const INDEX: usize = 40_000;

/// Longest line of any page, letters.
const LINE: usize = 600;

/// Longest cell of any table, letters, the targets of links left out.
const CELL: usize = 200;

#[test]
fn regress_report_is_current() {
    let root = lahar_verification::golden::package_root();
    match command(&root, true).unwrap() {
        ReportOutcome::Current => {}
        outcome => panic!("{outcome:?}\nrun `cargo run --release --bin report` and look at what changed"),
    }
}

#[test]
fn pages_are_short_enough_to_read() {
    let root = lahar_verification::golden::package_root();
    let index = std::fs::read_to_string(root.join("REPORT.md")).unwrap();
    assert!(index.len() < INDEX, "REPORT.md has {} bytes", index.len());
    check("REPORT.md", &index);
    for entry in std::fs::read_dir(root.join("verification/report")).unwrap() {
        let path = entry.unwrap().path();
        check(&path.display().to_string(), &std::fs::read_to_string(&path).unwrap());
    }
}

/// Every link of every page leads to a file that exists, but those to `docs`, and every anchor to a heading.
#[test]
fn links_lead_somewhere() {
    let root = lahar_verification::golden::package_root();
    let mut pages = vec![root.join("REPORT.md")];
    pages.extend(std::fs::read_dir(root.join("verification/report")).unwrap().map(|e| e.unwrap().path()));
    for page in pages {
        let text = std::fs::read_to_string(&page).unwrap();
        let inline = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        let defined = text.lines().filter(|l| l.starts_with('[')).filter_map(|l| l.split_once("]: "));
        for target in inline.chain(defined.map(|(_, target)| target)) {
            let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
            if file.contains("docs/") || file.starts_with("http") {
                continue;
            }
            let path = if file.is_empty() { page.clone() } else { page.parent().unwrap().join(file) };
            assert!(path.exists(), "{}: {target}", page.display());
            assert!(anchor.is_empty() || has_heading(&path, anchor), "{}: {target}", page.display());
        }
    }
}

fn has_heading(path: &Path, anchor: &str) -> bool {
    let text = std::fs::read_to_string(path).unwrap();
    let headings = text.lines().filter(|l| l.starts_with('#')).map(|l| l.trim_start_matches(['#', ' ']));
    headings.into_iter().any(|h| lahar_verification::report::text::anchor(h) == anchor)
}

fn check(name: &str, text: &str) {
    for line in text.lines() {
        assert!(line.chars().count() <= LINE, "{name}: a line of {} letters: {line}", line.chars().count());
        if line.starts_with('|') {
            for cell in line.split(" | ") {
                let shown = cell.split("](").next().unwrap_or(cell);
                assert!(
                    shown.chars().count() <= CELL,
                    "{name}: a cell of {} letters: {cell}",
                    shown.chars().count()
                );
            }
        }
    }
}
