//! Judges: which citations lead nowhere.

use std::collections::BTreeSet;

use super::read::*;
use super::repository::Known;

/// Citations that lead nowhere: where, and what.
pub type Broken = Vec<String>;

/// Tags and numbers that a text cites and no document defines.
pub fn wrong_citations(known: &Known, name: &str, text: &str) -> Broken {
    let text = joined(text);
    let mut broken = Vec::new();
    let tags = bracketed(&text).into_iter().filter(|tag| !known.tags.contains(tag));
    broken.extend(tags.map(|tag| format!("{name}: no tag [{tag}] in docs/method.md")));
    let lists: [(&[&str], &str, &BTreeSet<u32>, &str); 3] = [
        (&["ERRATA", "ERRATUM", "errata.md"], "", &known.errata, "docs/errata.md"),
        (&["REFERENCES", "references.md"], "", &known.sections, "docs/references.md"),
        (
            &["HARD_CASES", "hard case", "Hard case", "hard cases", "hard-cases.md"],
            "H",
            &known.cases,
            "docs/hard-cases.md",
        ),
    ];
    for (keywords, lead, defined, document) in lists {
        let wrong = cited(&text, keywords, lead).into_iter().filter(|n| !defined.contains(n));
        broken.extend(wrong.map(|n| format!("{name}: no {lead}{n} in {document}")));
    }
    broken.extend(wrong_equations(&text).into_iter().map(|equation| format!("{name}: no {equation}")));
    broken
}

/// Names in doc comments that are neither study nor function.
pub fn wrong_names(known: &Known, name: &str, text: &str) -> Broken {
    let mut broken = Vec::new();
    for (line, word) in section_names(text) {
        let word = word.trim_matches(['[', ']']).rsplit("::").next().unwrap_or("").trim_end_matches("()");
        // Formulas and files are no names.
        let is_name =
            word.chars().all(|c| c.is_ascii_alphanumeric() || "_-*.".contains(c)) && !word.ends_with(".json");
        let is_type = word.starts_with(|c: char| c.is_ascii_uppercase());
        if is_name && !is_type && !word.contains(".rs") && !known.has(word) {
            broken.push(format!("{name}:{line}: no claim, mutant, exhibit or function {word}"));
        }
    }
    for (line, tag, names) in table_rows(text) {
        if !known.tags.contains(&tag) {
            broken.push(format!("{name}:{line}: no tag {tag} in docs/method.md"));
        }
        broken.extend(names.iter().filter(|n| !known.has(n)).map(|n| format!("{name}:{line}: no study {n}")));
    }
    broken
}

/// Tags of a record that no document defines.
pub fn wrong_record_tags(known: &Known, name: &str, json: &str) -> Broken {
    let wrong = |tag: &String| {
        let case = tag.strip_prefix('H').and_then(number).filter(|(_, rest)| rest.is_empty());
        match case {
            Some((case, _)) => !known.cases.contains(&case),
            None => is_tag(tag) && !known.tags.contains(tag),
        }
    };
    record_tags(json).into_iter().filter(wrong).map(|tag| format!("{name}: no tag {tag}")).collect()
}

/// Studies named in a document that do not exist.
pub fn wrong_studies(known: &Known, name: &str, text: &str) -> Broken {
    let wrong = |word: &&str| is_study(word) && !word.contains('/') && !known.has(word);
    quoted(text).into_iter().filter(wrong).map(|word| format!("{name}: no study {word}")).collect()
}

pub fn report(broken: &[String]) {
    assert!(broken.is_empty(), "{} citations lead nowhere:\n{}", broken.len(), broken.join("\n"));
}
