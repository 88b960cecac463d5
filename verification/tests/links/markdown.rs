//! Reads Markdown: prose, links, anchors.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use super::judge::Broken;
use super::read::*;

/// Text without fenced blocks and without code in backticks.
pub fn prose(text: &str) -> String {
    let mut out = String::new();
    let mut fenced = false;
    for line in text.lines() {
        if line.trim_start().starts_with("```") {
            fenced = !fenced;
        } else if !fenced {
            let outside: Vec<&str> = line.split('`').step_by(2).collect();
            out.push_str(&outside.join(" "));
        }
        out.push('\n');
    }
    out
}

/// Targets of `[text](target)` and `![text](target)`; parentheses inside a target may be balanced.
pub fn targets(text: &str) -> Vec<String> {
    let target = |rest: &str| {
        let mut depth = 0;
        for (k, c) in rest.char_indices() {
            match c {
                '(' => depth += 1,
                ')' if depth == 0 => return Some(rest[..k].split(' ').next().unwrap_or("").to_owned()),
                ')' => depth -= 1,
                '\n' => return None,
                _ => {}
            }
        }
        None
    };
    prose(text).split("](").skip(1).filter_map(target).collect()
}

/// Anchors of a document: headings as GitHub names them, and `<a id="…">`.
pub fn anchors(text: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut seen: BTreeMap<String, u32> = BTreeMap::new();
    let mut fenced = false;
    for line in text.lines() {
        if line.trim_start().starts_with("```") {
            fenced = !fenced;
        }
        let title = line.trim_start_matches('#');
        if !fenced && title.len() < line.len() && title.starts_with(' ') {
            let slug = slug(title.trim());
            let count = seen.entry(slug.clone()).or_insert(0);
            found.insert(if *count == 0 { slug } else { format!("{slug}-{count}") });
            *count += 1;
        }
    }
    let id = |rest: &str| Some(rest.split_once('"')?.0.to_owned());
    found.extend(text.split("<a id=\"").skip(1).filter_map(id));
    found
}

/// A heading as GitHub turns it into an anchor.
pub fn slug(title: &str) -> String {
    let keep = |c: char| c.is_alphanumeric() || c == '-' || c == '_' || c == ' ';
    title.to_lowercase().chars().filter(|&c| keep(c)).map(|c| if c == ' ' { '-' } else { c }).collect()
}

/// Relative links of a document that lead to no file or anchor.
pub fn wrong_links(root: &Path, name: &str, text: &str) -> Broken {
    let here = root.join(name);
    let mut broken = Vec::new();
    for target in targets(text) {
        if target.contains("://") || target.starts_with("mailto:") {
            continue;
        }
        let (path, anchor) = target.split_once('#').unwrap_or((&target, ""));
        let file = if path.is_empty() { here.clone() } else { here.with_file_name("").join(path) };
        if !file.exists() {
            broken.push(format!("{name}: no file {target}"));
        } else if !anchor.is_empty() && file.extension().is_some_and(|e| e == "md") {
            let known = anchors(&fs::read_to_string(&file).unwrap_or_default());
            if !known.contains(anchor) {
                broken.push(format!("{name}: no anchor {target}"));
            }
        }
    }
    broken
}

/// Paths in backticks that are not in the repository: `src/units.rs`.
pub fn wrong_paths(root: &Path, name: &str, text: &str) -> Broken {
    let starts = ["src/", "tests/", "docs/", "golden/", "scenes/", "verification/", "examples/", "benches/"];
    let is_path = |word: &&str| {
        starts.iter().any(|start| word.starts_with(start)) && !word.contains([' ', '*', '<', '{'])
    };
    let missing = |word: &&str| !root.join(word).exists() && !root.join("verification").join(word).exists();
    // A path that the program writes, or a pattern, has no file.
    quoted(text)
        .into_iter()
        .filter(is_path)
        .filter(missing)
        .map(|word| format!("{name}: no path {word}"))
        .collect()
}
