//! Every name that code, claims, report and documents cite leads somewhere.
//!
//! Checked: names under `# Source` and `# Verified by` of doc comments, tags like `[K3]`, numbers of errata, reference
//! sections and hard cases, equation numbers of the three papers, tags of golden records, and relative links and
//! paths in the documents. The functions here are pure; each has a test that a wrong name is found.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// A citation that leads nowhere: where, and what.
type Broken = Vec<String>;

// ---------------------------------------------------------------------------------------------------------------
// The repository.

/// The directory with `golden`, this package's own or one above it.
fn root() -> PathBuf {
    let start = Path::new(env!("CARGO_MANIFEST_DIR"));
    start.ancestors().find(|path| path.join("golden").is_dir()).unwrap_or(start).to_path_buf()
}

/// All files below some places of the repository with one of some endings, sorted; places that do not exist are
/// passed over.
fn files(root: &Path, places: &[&str], endings: &[&str]) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut open: Vec<PathBuf> = places.iter().map(|place| root.join(place)).collect();
    while let Some(path) = open.pop() {
        if path.is_dir() {
            let entries = fs::read_dir(&path).into_iter().flatten().flatten().map(|entry| entry.path());
            open.extend(entries.filter(|entry| !entry.ends_with("target")));
        } else if path.extension().is_some_and(|e| endings.iter().any(|&ending| e == ending)) {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// Path and text of files, without this one, whose tests hold wrong names on purpose.
fn texts(root: &Path, places: &[&str], endings: &[&str]) -> Vec<(String, String)> {
    let named = |path: PathBuf| {
        let text = fs::read_to_string(&path).ok()?;
        Some((path.strip_prefix(root).unwrap_or(&path).display().to_string(), text))
    };
    let all = files(root, places, endings).into_iter().filter(|path| !path.ends_with("tests/links.rs"));
    all.filter_map(named).collect()
}

const CODE: [&str; 5] = ["src", "verification", "tests", "benches", "examples"];
const DOCUMENTS: [&str; 5] = ["README.md", "CONTRIBUTING.md", "docs", "REPORT.md", "verification/report"];
const GOLDEN: [&str; 4] = ["golden/records", "golden/mutants", "golden/exhibits", "golden/measured"];

/// What names can lead to.
#[derive(Default)]
struct Known {
    /// Claims, mutants, exhibits.
    studies: BTreeSet<String>,
    /// Functions and modules.
    functions: BTreeSet<String>,
    /// Headings of `docs/method.md`, rows of `docs/errata.md`, sections of `docs/references.md`, cases of
    /// `docs/hard-cases.md`.
    tags: BTreeSet<String>,
    errata: BTreeSet<u32>,
    sections: BTreeSet<u32>,
    cases: BTreeSet<u32>,
}

impl Known {
    fn of(root: &Path) -> Self {
        let golden = files(root, &GOLDEN, &["json"]);
        let stem = |path: &PathBuf| path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let document = |name: &str| fs::read_to_string(root.join("docs").join(name)).unwrap_or_default();
        let code = texts(root, &CODE, &["rs"]);
        let mut names: BTreeSet<String> = code.iter().flat_map(|(_, text)| functions(text)).collect();
        names.extend(code.iter().filter_map(|(name, _)| stem(&PathBuf::from(name))));
        Self {
            studies: golden.iter().filter_map(stem).collect(),
            functions: names,
            tags: method_headings(&document("method.md")).into_iter().collect(),
            errata: erratum_rows(&document("errata.md")).into_iter().collect(),
            sections: numbered_headings(&document("references.md"), "## ").into_iter().collect(),
            cases: numbered_headings(&document("hard-cases.md"), "### H").into_iter().collect(),
        }
    }

    /// Whether a name in backticks is a study or a function; a star at its end stands for any ending.
    fn has(&self, name: &str) -> bool {
        match name.strip_suffix('*') {
            Some(start) => self.studies.iter().chain(&self.functions).any(|known| known.starts_with(start)),
            None => self.studies.contains(name) || self.functions.contains(name),
        }
    }
}

// ---------------------------------------------------------------------------------------------------------------
// Reading.

/// Text with the line breaks of comments and of continued strings taken out, so that a citation that is broken over
/// two lines is one again.
fn joined(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for line in text.lines() {
        let line = line.trim_start();
        let line = ["///", "//!", "//"].iter().find_map(|lead| line.strip_prefix(lead)).unwrap_or(line);
        out.push_str(line.trim().trim_end_matches('\\'));
        out.push(' ');
    }
    out
}

/// Leading decimal number and what follows it.
fn number(text: &str) -> Option<(u32, &str)> {
    let end = text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    Some((text[..end].parse().ok()?, &text[end..]))
}

/// Names that follow `fn `.
fn functions(text: &str) -> Vec<String> {
    let name = |rest: &str| {
        let end = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(rest.len());
        rest[..end].to_owned()
    };
    text.split("fn ").skip(1).map(name).filter(|name| !name.is_empty()).collect()
}

/// Tags of `### [K3] Title`.
fn method_headings(text: &str) -> Vec<String> {
    let tag = |line: &str| Some(line.strip_prefix("### [")?.split_once(']')?.0.to_owned());
    text.lines().filter_map(tag).collect()
}

/// Numbers of `| <a id="erratum-3"></a>3 | …`.
fn erratum_rows(text: &str) -> Vec<u32> {
    let row = |line: &str| {
        let (anchor, rest) = number(line.strip_prefix("| <a id=\"erratum-")?)?;
        let (shown, _) = number(rest.strip_prefix("\"></a>")?)?;
        (anchor == shown).then_some(shown)
    };
    text.lines().filter_map(row).collect()
}

/// Numbers of headings like `## 3 Film` or `### H3 Creep`.
fn numbered_headings(text: &str, lead: &str) -> Vec<u32> {
    text.lines().filter_map(|line| Some(number(line.strip_prefix(lead)?)?.0)).collect()
}

/// Tags in square brackets, escaped as in doc comments or plain.
fn bracketed(text: &str) -> Vec<String> {
    let tag = |rest: &str| {
        let end = rest.find(|c: char| !c.is_ascii_alphanumeric())?;
        let (tag, after) = rest.split_at(end);
        (after.starts_with(']') || after.starts_with("\\]")).then_some(())?;
        is_tag(tag).then(|| tag.to_owned())
    };
    text.split('[').skip(1).filter_map(tag).collect()
}

/// `K3`: the letter of a chapter of the method and a number.
fn is_tag(word: &str) -> bool {
    let mut letters = word.chars();
    letters.next().is_some_and(|c| "LYKBFDC".contains(c))
        && word.len() > 1
        && letters.all(|c| c.is_ascii_digit())
}

/// Numbers cited after one of some keywords: `ERRATA 7, 8`, `ERRATA 7–10`, `errata.md 40 and 41`, `REFERENCES §3`,
/// `HARD_CASES H13`. `lead` stands before every number.
fn cited(text: &str, keywords: &[&str], lead: &str) -> Vec<u32> {
    let mut found = Vec::new();
    for keyword in keywords {
        for rest in text.split(keyword).skip(1) {
            let rest = rest.trim_start_matches([' ', ')', '§', '`']);
            read_list(rest, lead, &mut found);
        }
    }
    found
}

/// Reads `1, 2 (words), 3–5 and 6`; a number that begins with 0 is a paper's.
fn read_list(mut rest: &str, lead: &str, found: &mut Vec<u32>) {
    while let Some((first, after)) = rest.strip_prefix(lead).and_then(number) {
        if rest[lead.len()..].starts_with('0') {
            return;
        }
        found.push(first);
        rest = after.trim_start_matches(|c: char| c.is_ascii_lowercase());
        if let Some((last, after)) =
            rest.strip_prefix('–').and_then(|r| number(r.strip_prefix(lead).unwrap_or(r)))
        {
            found.extend(first + 1..=last);
            rest = after;
        }
        if let Some((_, after)) = rest.strip_prefix(" (").and_then(|words| words.split_once(')')) {
            rest = after;
        }
        let Some(next) = [", ", " and ", " to "].iter().find_map(|between| rest.strip_prefix(between)) else {
            return;
        };
        rest = next.trim_start_matches('§');
    }
}

/// Equation numbers of the papers that do not exist: `000 Eq 20`.
fn wrong_equations(text: &str) -> Vec<String> {
    let last = |paper: &str, chapter: &str| match (paper, chapter) {
        ("000", "") => 19,
        ("001", "") => 13,
        ("004", "2") | ("004", "5") => 4,
        ("004", "3") => 73,
        ("004", "4") => 18,
        _ => 0,
    };
    let mut wrong = Vec::new();
    for paper in ["000", "001", "004"] {
        for kind in [" Eq ", " Eqs "] {
            for rest in text.split(&format!("{paper}{kind}")).skip(1) {
                let Some((first, after)) = number(rest) else { continue };
                let second = after.strip_prefix('.').and_then(number);
                let (chapter, equation) = match second {
                    Some((equation, _)) if paper == "004" => (first.to_string(), equation),
                    _ => (String::new(), first),
                };
                if equation == 0 || equation > last(paper, &chapter) {
                    wrong.push(format!(
                        "{paper}{kind}{}",
                        rest.split([' ', ')', ',', ';', '"']).next().unwrap_or("")
                    ));
                }
            }
        }
    }
    wrong
}

/// Words in backticks.
fn quoted(text: &str) -> Vec<&str> {
    text.split('`').skip(1).step_by(2).collect()
}

/// Line and name of everything in backticks under `# Source` and `# Verified by` of doc comments.
fn section_names(text: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let mut inside = false;
    for (k, line) in text.lines().enumerate() {
        let line = line.trim_start();
        let Some(content) = line.strip_prefix("///").or_else(|| line.strip_prefix("//!")) else {
            inside = false;
            continue;
        };
        let content = content.trim();
        if let Some(title) = content.strip_prefix("# ") {
            inside = title == "Source" || title == "Verified by";
        } else if inside {
            found.extend(quoted(content).into_iter().map(|name| (k + 1, name.to_owned())));
        }
    }
    found
}

/// Line and name of the studies, and the tag, in rows of tables of doc comments: `//! | K3 | … | `claim` |`.
fn table_rows(text: &str) -> Vec<(usize, String, Vec<String>)> {
    let row = |(k, line): (usize, &str)| {
        let tag = line.trim_start().strip_prefix("//! | ")?.split(' ').next()?;
        let names = quoted(line).into_iter().filter(|name| is_study(name)).map(str::to_owned).collect();
        is_tag(tag).then(|| (k + 1, tag.to_owned(), names))
    };
    text.lines().enumerate().filter_map(row).collect()
}

/// Written like a claim, a mutant or an exhibit: words of small letters joined by hyphens, or the start of one with a
/// star.
fn is_study(name: &str) -> bool {
    let plain = name.strip_suffix('*').unwrap_or(name);
    let letters = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || "-.".contains(c);
    plain.contains('-') && plain.starts_with(|c: char| c.is_ascii_lowercase()) && plain.chars().all(letters)
}

/// Strings of `"tags": [ … ]` in a golden record.
fn record_tags(json: &str) -> Vec<String> {
    let Some((_, rest)) = json.split_once("\"tags\":") else { return Vec::new() };
    let list = rest.split_once('[').and_then(|(_, rest)| rest.split_once(']')).map_or("", |(list, _)| list);
    list.split('"').skip(1).step_by(2).map(str::to_owned).collect()
}

// ---------------------------------------------------------------------------------------------------------------
// Markdown.

/// Text without fenced blocks and without code in backticks.
fn prose(text: &str) -> String {
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
fn targets(text: &str) -> Vec<String> {
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
fn anchors(text: &str) -> BTreeSet<String> {
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
fn slug(title: &str) -> String {
    let keep = |c: char| c.is_alphanumeric() || c == '-' || c == '_' || c == ' ';
    title.to_lowercase().chars().filter(|&c| keep(c)).map(|c| if c == ' ' { '-' } else { c }).collect()
}

/// Relative links of a document that lead to no file or anchor.
fn wrong_links(root: &Path, name: &str, text: &str) -> Broken {
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
fn wrong_paths(root: &Path, name: &str, text: &str) -> Broken {
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

// ---------------------------------------------------------------------------------------------------------------
// Judging.

/// Tags and numbers that a text cites and no document defines.
fn wrong_citations(known: &Known, name: &str, text: &str) -> Broken {
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
fn wrong_names(known: &Known, name: &str, text: &str) -> Broken {
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
fn wrong_record_tags(known: &Known, name: &str, json: &str) -> Broken {
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
fn wrong_studies(known: &Known, name: &str, text: &str) -> Broken {
    let wrong = |word: &&str| is_study(word) && !word.contains('/') && !known.has(word);
    quoted(text).into_iter().filter(wrong).map(|word| format!("{name}: no study {word}")).collect()
}

fn report(broken: &[String]) {
    assert!(broken.is_empty(), "{} citations lead nowhere:\n{}", broken.len(), broken.join("\n"));
}

// ---------------------------------------------------------------------------------------------------------------
// The repository holds.

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

// ---------------------------------------------------------------------------------------------------------------
// And the checks can fail.

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
