//! Every name that code, claims, report and documents cite leads somewhere.
//!
//! Checked: names under `# Source` and `# Verified by` of doc comments, tags like `[K3]`, numbers of errata, reference
//! sections and hard cases, equation numbers of the three papers, tags of golden records, and relative links and
//! paths in the documents. The functions here are pure; each has a test that a wrong name is found.

use std::collections::BTreeSet;
use std::fs;

mod judge;
mod markdown;
mod read;
mod repository;
mod wrong;

use judge::*;
use markdown::*;
use read::*;
use repository::*;

#[test]
fn names_in_doc_comments_resolve() {
    let root = root();
    let known = Known::of(&root);
    let code = texts(&root, &CODE, &["rs"]);
    assert!(known.studies.len() > 200 && known.functions.len() > 1000, "the repository was not found");
    assert!(
        code.iter().map(|(_, text)| section_names(text).len()).sum::<usize>() > 150,
        "doc comments were not found"
    );
    report(&code.iter().flat_map(|(name, text)| wrong_names(&known, name, text)).collect::<Broken>());
}

#[test]
fn tags_and_numbers_resolve() {
    let root = root();
    let known = Known::of(&root);
    let mut all = texts(&root, &CODE, &["rs"]);
    all.extend(texts(&root, &GOLDEN, &["json"]));
    all.extend(texts(&root, &DOCUMENTS, &["md"]));
    all.extend(texts(&root, &["CHANGELOG.md", "scenes"], &["md", "json"]));
    report(&all.iter().flat_map(|(name, text)| wrong_citations(&known, name, text)).collect::<Broken>());
}

#[test]
fn tags_of_records_resolve() {
    let root = root();
    let known = Known::of(&root);
    let records = texts(&root, &["golden/records"], &["json"]);
    assert!(records.iter().all(|(_, json)| !record_tags(json).is_empty()), "a record without tags");
    report(
        &records.iter().flat_map(|(name, json)| wrong_record_tags(&known, name, json)).collect::<Broken>(),
    );
}

#[test]
fn documents_define_everything_once() {
    let root = root();
    let document = |name: &str| fs::read_to_string(root.join("docs").join(name)).unwrap_or_default();
    let tags = method_headings(&document("method.md"));
    assert_eq!(tags.len(), tags.iter().collect::<BTreeSet<_>>().len(), "a tag has two headings: {tags:?}");
    let mut errata = erratum_rows(&document("errata.md"));
    errata.sort_unstable();
    let sections = numbered_headings(&document("references.md"), "## ");
    let cases = numbered_headings(&document("hard-cases.md"), "### H");
    for numbers in [errata, sections, cases] {
        assert!(!numbers.is_empty());
        assert_eq!(
            numbers,
            (1..=numbers.len() as u32).collect::<Vec<_>>(),
            "numbers run from 1 without gaps"
        );
    }
}

#[test]
fn links_and_names_in_documents_resolve() {
    let root = root();
    let known = Known::of(&root);
    let documents = texts(&root, &DOCUMENTS, &["md"]);
    assert!(documents.iter().any(|(name, _)| name == "docs/method.md"), "the documents were not found");
    let mut broken = Vec::new();
    for (name, text) in &documents {
        broken.extend(wrong_links(&root, name, text));
        if name.starts_with("docs") {
            broken.extend(wrong_paths(&root, name, text));
            broken.extend(wrong_studies(&known, name, text));
        }
    }
    report(&broken);
}
