//! Reads Rust sources as far as the tests of the structure need: imports, circles, lengths of functions.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// A source file.
pub struct Source {
    /// Path from the root of the repository.
    pub path: String,
    /// As it stands.
    pub text: String,
    /// Without comments, strings and unit tests; same line numbers.
    pub code: String,
    /// Line and path from the crate's root of everything it names by `crate::` or `super::`.
    pub imports: Vec<(usize, Vec<String>)>,
    /// Module path of the file.
    place: Vec<String>,
}

impl Source {
    /// Reads a text as the file `path` (from the repository's root, below `src/`).
    pub fn parse(path: &str, text: &str) -> Self {
        let inner = path.split_once("src/").map_or(path, |(_, inner)| inner);
        let mut place: Vec<String> = inner.trim_end_matches(".rs").split('/').map(str::to_owned).collect();
        if place.last().is_some_and(|last| last == "mod" || last == "lib" || last == "main") {
            place.pop();
        }
        let code = without_tests(&blank(text));
        let imports = imports(&code, &place);
        Self { path: path.to_owned(), text: text.to_owned(), code, imports, place }
    }

    /// Its top-level module; `None` for the roots of crates.
    pub fn module(&self) -> Option<&str> {
        self.place.first().map(String::as_str)
    }

    fn is_door(&self) -> bool {
        self.path.ends_with("/mod.rs") || self.path.ends_with("/lib.rs")
    }
}

/// All files of the product.
pub fn product() -> Vec<Source> {
    below("src")
}

/// All files of the harness.
pub fn harness() -> Vec<Source> {
    below("verification/src")
}

fn below(folder: &str) -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = Vec::new();
    let mut folders = vec![root.join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder of sources") {
            let path: PathBuf = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "rs") {
                let name = path.strip_prefix(root).expect("below the root").to_string_lossy().into_owned();
                found.push(Source::parse(&name, &std::fs::read_to_string(&path).expect("text")));
            }
        }
    }
    found.sort_by(|a, b| a.path.cmp(&b.path));
    assert!(!found.is_empty(), "{folder} holds no source");
    found
}

/// The text with comments, strings and character literals blanked; line ends stay.
pub fn blank(text: &str) -> String {
    let chars: Vec<char> = text.chars().collect();
    let mut out = String::with_capacity(text.len());
    let mut k = 0;
    let keep_line_ends = |out: &mut String, c: char| out.push(if c == '\n' { '\n' } else { ' ' });
    while k < chars.len() {
        let end = match (chars[k], chars.get(k + 1)) {
            ('/', Some('/')) => until(&chars, k, |c, _| c == '\n'),
            ('/', Some('*')) => after(&chars, k + 2, "*/"),
            ('r', Some('"' | '#')) if !k.checked_sub(1).is_some_and(|b| chars[b].is_alphanumeric()) => {
                raw(&chars, k)
            }
            ('"', _) => quoted(&chars, k, '"'),
            // A lifetime is no literal: 'a not followed by a quote.
            ('\'', Some('\\')) => quoted(&chars, k, '\''),
            ('\'', Some(_)) if chars.get(k + 2) == Some(&'\'') => k + 3,
            _ => k,
        };
        if end == k {
            out.push(chars[k]);
            k += 1;
        } else {
            chars[k..end.min(chars.len())].iter().for_each(|&c| keep_line_ends(&mut out, c));
            k = end;
        }
    }
    out
}

fn until(chars: &[char], from: usize, stop: impl Fn(char, usize) -> bool) -> usize {
    (from..chars.len()).find(|&k| stop(chars[k], k)).unwrap_or(chars.len())
}

fn after(chars: &[char], from: usize, end: &str) -> usize {
    let end: Vec<char> = end.chars().collect();
    until(chars, from, |_, k| chars[k..].starts_with(&end)) + end.len()
}

fn quoted(chars: &[char], from: usize, quote: char) -> usize {
    let mut k = from + 1;
    while k < chars.len() && chars[k] != quote {
        k += if chars[k] == '\\' { 2 } else { 1 };
    }
    k + 1
}

/// End of a raw string that starts at `from`, or `from` if none does.
fn raw(chars: &[char], from: usize) -> usize {
    let hashes = chars[from + 1..].iter().take_while(|&&c| c == '#').count();
    if chars.get(from + 1 + hashes) != Some(&'"') {
        return from;
    }
    after(chars, from + 2 + hashes, &format!("\"{}", "#".repeat(hashes)))
}

/// Blanks `#[cfg(test)] mod … { … }`: unit tests may look at everything.
fn without_tests(code: &str) -> String {
    let mut out = code.to_owned();
    while let Some(start) = out.find("#[cfg(test)]") {
        let open = out[start..].find(['{', ';']).map_or(out.len() - 1, |k| start + k);
        let end = if out.as_bytes()[open] == b'{' { closing(&out, open) } else { open };
        let blanked: String = out[start..=end].chars().map(|c| if c == '\n' { '\n' } else { ' ' }).collect();
        out.replace_range(start..=end, &blanked);
    }
    out
}

/// Position of the brace that closes the one at `open`, in blanked code.
fn closing(code: &str, open: usize) -> usize {
    let mut depth = 0_usize;
    for (k, c) in code[open..].char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 1 => return open + k,
            '}' => depth -= 1,
            _ => {}
        }
    }
    code.len() - 1
}

/// Every path that starts with `crate::`, `super::` or `self::`, groups written out.
fn imports(code: &str, place: &[String]) -> Vec<(usize, Vec<String>)> {
    let mut found = Vec::new();
    for start in ["crate::", "super::", "self::"] {
        for (at, _) in code.match_indices(start) {
            let before = code[..at].chars().next_back().unwrap_or(' ');
            if before.is_alphanumeric()
                || before == '_'
                || code[..at].ends_with("super::")
                || code[..at].ends_with("self::")
            {
                continue;
            }
            let line = code[..at].matches('\n').count() + 1;
            let mut rest = &code[at..];
            let mut base = if start == "crate::" { Vec::new() } else { place.to_vec() };
            loop {
                if let Some(next) = rest.strip_prefix("super::") {
                    base.pop();
                    rest = next;
                } else if let Some(next) =
                    rest.strip_prefix("crate::").or_else(|| rest.strip_prefix("self::"))
                {
                    rest = next;
                } else {
                    break;
                }
            }
            tree(rest, &base, line, &mut found);
        }
    }
    found.sort();
    found
}

/// Reads `a::{b, c::d}` into the paths base::a::b and base::a::c::d.
fn tree(text: &str, base: &[String], line: usize, found: &mut Vec<(usize, Vec<String>)>) {
    let text = text.trim_start();
    if let Some(group) = text.strip_prefix('{') {
        let (mut depth, mut from) = (0_usize, 0);
        for (k, c) in group.char_indices() {
            match c {
                '{' => depth += 1,
                '}' if depth == 0 => return tree(&group[from..k], base, line, found),
                '}' => depth -= 1,
                ',' if depth == 0 => {
                    tree(&group[from..k], base, line, found);
                    from = k + 1;
                }
                _ => {}
            }
        }
        return;
    }
    let name: String = text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
    if name.is_empty() {
        return;
    }
    let mut path = base.to_vec();
    let rest = &text[name.len()..];
    if name != "self" {
        path.push(name);
    }
    match rest.strip_prefix("::") {
        Some(next) if next.starts_with(|c: char| c.is_alphanumeric() || c == '_' || c == '{') => {
            tree(next, &path, line, found);
        }
        _ => found.push((line, path)),
    }
}

/// Names that a door hands out from the files behind it: name → module path.
fn handed_out(door: &Source) -> BTreeMap<String, Vec<String>> {
    let mut names = BTreeMap::new();
    for statement in door.code.split(';') {
        let Some((_, path)) =
            statement.split_once("pub use ").or_else(|| statement.split_once("pub(crate) use "))
        else {
            continue;
        };
        let mut found = Vec::new();
        tree(path.trim_start_matches("self::"), &door.place, 0, &mut found);
        for (_, path) in found {
            if let Some(name) = path.last() {
                names.insert(name.clone(), path[..path.len() - 1].to_vec());
            }
        }
    }
    names
}

/// Circles of files that import each other, by path; doors (`mod.rs`) belong to nobody: they may name
/// what is behind them, and the files behind them may use what they declare.
pub fn circles(sources: &[Source]) -> Vec<Vec<String>> {
    let files: BTreeMap<&[String], &Source> = sources.iter().map(|s| (s.place.as_slice(), s)).collect();
    let doors: BTreeMap<&[String], BTreeMap<String, Vec<String>>> =
        sources.iter().filter(|s| s.is_door()).map(|s| (s.place.as_slice(), handed_out(s))).collect();
    let file_of = |path: &[String]| -> Option<&str> {
        let mut path = path.to_vec();
        // Through at most a few doors to the file that declares the name.
        for _ in 0..8 {
            let length = (0..=path.len()).rev().find(|&n| files.contains_key(&path[..n]))?;
            let file = files[&path[..length]];
            let name = path.get(length);
            match (doors.get(&path[..length]), name) {
                (Some(names), Some(name)) if names.contains_key(name) => {
                    let mut next = names[name].clone();
                    next.push(name.clone());
                    if next == path {
                        return None;
                    }
                    path = next;
                }
                _ if file.is_door() => return None,
                _ => return Some(&file.path),
            }
        }
        None
    };
    let mut arrows: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for source in sources.iter().filter(|s| !s.is_door()) {
        let targets = source.imports.iter().filter_map(|(_, path)| file_of(path));
        arrows.insert(&source.path, targets.filter(|t| *t != source.path).collect());
    }
    let reach = |from: &str| -> BTreeSet<&str> {
        let (mut seen, mut open) = (BTreeSet::new(), vec![from]);
        while let Some(file) = open.pop() {
            for &next in arrows.get(file).into_iter().flatten() {
                if seen.insert(next) {
                    open.push(next);
                }
            }
        }
        seen
    };
    let reached: BTreeMap<&str, BTreeSet<&str>> = arrows.keys().map(|&file| (file, reach(file))).collect();
    let mut found = BTreeSet::new();
    for (&file, ahead) in &reached {
        if ahead.contains(file) {
            let circle: Vec<String> = ahead
                .iter()
                .filter(|&&other| reached.get(other).is_some_and(|back| back.contains(file)))
                .map(|&other| other.to_owned())
                .collect();
            found.insert(circle);
        }
    }
    found.into_iter().collect()
}

/// Line, name and number of lines of every function, unit tests left out.
pub fn functions(text: &str) -> Vec<(usize, String, usize)> {
    let code = without_tests(&blank(text));
    let mut found = Vec::new();
    for (at, _) in code.match_indices("fn ") {
        if code[..at].chars().next_back().is_some_and(|c| c.is_alphanumeric() || c == '_') {
            continue;
        }
        let name: String = code[at + 3..].chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
        let Some(open) = code[at..].find(['{', ';']).map(|k| at + k) else { continue };
        if name.is_empty() || code.as_bytes()[open] == b';' {
            continue;
        }
        let line = |at: usize| code[..at].matches('\n').count() + 1;
        found.push((line(at), name, line(closing(&code, open)) - line(at) + 1));
    }
    found
}
