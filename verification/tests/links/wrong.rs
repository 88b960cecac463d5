//! The checks can fail: each finds a wrong name.

use super::judge::*;
use super::markdown::*;
use super::read::*;
use super::repository::*;

fn known() -> Known {
    Known {
        studies: ["galilean-twin", "thesis-run-a"].map(str::to_owned).into(),
        functions: ["exact_share"].map(str::to_owned).into(),
        tags: ["K3", "B1"].map(str::to_owned).into(),
        errata: (1..=20).collect(),
        sections: (1..=5).collect(),
        cases: (1..=9).collect(),
    }
}

#[test]
fn a_wrong_name_under_verified_by_is_found() {
    let doc = |names: &str| {
        format!("/// Sum.\n/// # Source\n/// Derived.\n/// # Verified by\n/// {names}\nfn sum() {{}}\n")
    };
    let wrong = |names: &str| wrong_names(&known(), "a.rs", &doc(names));
    assert!(wrong("Claims `galilean-twin`, `thesis-run-*`; test `exact_share`.").is_empty());
    assert_eq!(
        wrong("Claim `galilean-twins`."),
        ["a.rs:5: no claim, mutant, exhibit or function galilean-twins"]
    );
    assert_eq!(wrong("Test `exact_shares`.").len(), 1);
    assert_eq!(wrong("Claims `thesis-walk-*`.").len(), 1);
    // Outside these sections backticks mean anything.
    assert!(wrong_names(&known(), "a.rs", "/// # Returns\n/// `nothing-known`\n").is_empty());
}

#[test]
fn a_wrong_row_of_the_map_is_found() {
    assert!(wrong_names(&known(), "lib.rs", "//! | K3 | moments | `a.rs` | `galilean-twin` |").is_empty());
    assert_eq!(wrong_names(&known(), "lib.rs", "//! | K9 | moments | `a.rs` | `galilean-twin` |").len(), 1);
    assert_eq!(wrong_names(&known(), "lib.rs", "//! | K3 | moments | `a.rs` | `galilean-two` |").len(), 1);
}

#[test]
fn a_wrong_tag_is_found() {
    let wrong = |text: &str| wrong_citations(&known(), "a.rs", text);
    assert!(wrong("Design \\[K3\\], \\[B1\\] and docs/method.md [K3]; `&[f64]` is no tag").is_empty());
    assert_eq!(wrong("Design \\[K4\\]"), ["a.rs: no tag [K4] in docs/method.md"]);
    assert_eq!(wrong("docs/method.md [B4]").len(), 1);
    assert_eq!(
        wrong_record_tags(&known(), "r", r#"{"tags": ["K3", "K7", "H4", "H12", "004 Eq 3.3"], "x": []}"#)
            .len(),
        2
    );
}

#[test]
fn wrong_numbers_are_found() {
    let wrong = |text: &str| wrong_citations(&known(), "a", text);
    assert!(wrong("ERRATA 7, 8 (000 Eq 2), 20; ERRATA 2, 004 Eq 3.37; docs/errata.md 14").is_empty());
    assert_eq!(wrong("ERRATA 19–21"), ["a: no 21 in docs/errata.md"]);
    assert_eq!(wrong("ERRATA 5 (force), 31 (equilibrium)"), ["a: no 31 in docs/errata.md"]);
    assert_eq!(wrong("/// ERRATA\n/// 42"), ["a: no 42 in docs/errata.md"]);
    assert!(wrong("REFERENCES 2, HARD_CASES H4; REFERENCES §3; docs/references.md §5").is_empty());
    assert_eq!(wrong("docs/references.md §6"), ["a: no 6 in docs/references.md"]);
    assert!(wrong("HARD_CASES H3a, hard cases H8 and H9, docs/hard-cases.md H1").is_empty());
    assert_eq!(wrong("hard case H10"), ["a: no H10 in docs/hard-cases.md"]);
    assert_eq!(wrong("docs/hard-cases.md H11").len(), 1);
}

#[test]
fn a_wrong_equation_of_a_paper_is_found() {
    assert!(wrong_equations("000 Eq 19, 001 Eqs 9–10, 004 Eq 3.73, 004 Eqs 3.68b and 5.4").is_empty());
    assert_eq!(wrong_equations("000 Eq 20"), ["000 Eq 20"]);
    assert_eq!(wrong_equations("(004 Eq 3.74)"), ["004 Eq 3.74"]);
    assert_eq!(wrong_equations("004 Eq 6.1").len(), 1);
}

#[test]
fn a_wrong_link_is_found() {
    let root = root();
    let wrong = |text: &str| wrong_links(&root, "docs/x.md", text);
    assert!(
        wrong("[a](method.md) [b](https://nowhere.example) `[c](no.md)` [d](method.md#k3-central-moments)")
            .is_empty()
    );
    assert_eq!(wrong("[a](no-such-file.md)"), ["docs/x.md: no file no-such-file.md"]);
    assert_eq!(wrong("[a](method.md#no-such-heading)"), ["docs/x.md: no anchor method.md#no-such-heading"]);
    assert_eq!(wrong("[a](../no.md)").len(), 1);
    assert_eq!(wrong_paths(&root, "x", "`golden/records` `golden/no-such`"), ["x: no path golden/no-such"]);
    assert_eq!(
        wrong_studies(&known(), "x", "`galilean-twin` `no-such-claim` `wall_rule`"),
        ["x: no study no-such-claim"]
    );
}

#[test]
fn headings_become_anchors() {
    assert_eq!(slug("[K3] Central moments"), "k3-central-moments");
    assert_eq!(slug("Density, dynamic & kinematic"), "density-dynamic--kinematic");
    let known = anchors("# A\n```\n# B\n```\n## A\n<a id=\"erratum-3\"></a>");
    assert_eq!(known, ["a", "a-1", "erratum-3"].map(str::to_owned).into());
}
