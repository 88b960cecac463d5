//! Reads what sources and documents cite.

/// Text with the line breaks of comments and of continued strings taken out, so that a citation that is broken over
/// two lines is one again.
pub fn joined(text: &str) -> String {
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
pub fn number(text: &str) -> Option<(u32, &str)> {
    let end = text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    Some((text[..end].parse().ok()?, &text[end..]))
}

/// Names that follow `fn `.
pub fn functions(text: &str) -> Vec<String> {
    let name = |rest: &str| {
        let end = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(rest.len());
        rest[..end].to_owned()
    };
    text.split("fn ").skip(1).map(name).filter(|name| !name.is_empty()).collect()
}

/// Tags of `### [K3] Title`.
pub fn method_headings(text: &str) -> Vec<String> {
    let tag = |line: &str| Some(line.strip_prefix("### [")?.split_once(']')?.0.to_owned());
    text.lines().filter_map(tag).collect()
}

/// Numbers of `| <a id="erratum-3"></a>3 | …`.
pub fn erratum_rows(text: &str) -> Vec<u32> {
    let row = |line: &str| {
        let (anchor, rest) = number(line.strip_prefix("| <a id=\"erratum-")?)?;
        let (shown, _) = number(rest.strip_prefix("\"></a>")?)?;
        (anchor == shown).then_some(shown)
    };
    text.lines().filter_map(row).collect()
}

/// Numbers of headings like `## 3 Film` or `### H3 Creep`.
pub fn numbered_headings(text: &str, lead: &str) -> Vec<u32> {
    text.lines().filter_map(|line| Some(number(line.strip_prefix(lead)?)?.0)).collect()
}

/// Tags in square brackets, escaped as in doc comments or plain.
pub fn bracketed(text: &str) -> Vec<String> {
    let tag = |rest: &str| {
        let end = rest.find(|c: char| !c.is_ascii_alphanumeric())?;
        let (tag, after) = rest.split_at(end);
        (after.starts_with(']') || after.starts_with("\\]")).then_some(())?;
        is_tag(tag).then(|| tag.to_owned())
    };
    text.split('[').skip(1).filter_map(tag).collect()
}

/// `K3`: the letter of a chapter of the method and a number.
pub fn is_tag(word: &str) -> bool {
    let mut letters = word.chars();
    letters.next().is_some_and(|c| "LYKBFDC".contains(c))
        && word.len() > 1
        && letters.all(|c| c.is_ascii_digit())
}

/// Numbers cited after one of some keywords: `ERRATA 7, 8`, `ERRATA 7–10`, `errata.md 40 and 41`, `REFERENCES §3`,
/// `HARD_CASES H13`. `lead` stands before every number.
pub fn cited(text: &str, keywords: &[&str], lead: &str) -> Vec<u32> {
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
pub fn read_list(mut rest: &str, lead: &str, found: &mut Vec<u32>) {
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
pub fn wrong_equations(text: &str) -> Vec<String> {
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
pub fn quoted(text: &str) -> Vec<&str> {
    text.split('`').skip(1).step_by(2).collect()
}

/// Line and name of everything in backticks under `# Source` and `# Verified by` of doc comments.
pub fn section_names(text: &str) -> Vec<(usize, String)> {
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
pub fn table_rows(text: &str) -> Vec<(usize, String, Vec<String>)> {
    let row = |(k, line): (usize, &str)| {
        let tag = line.trim_start().strip_prefix("//! | ")?.split(' ').next()?;
        let names = quoted(line).into_iter().filter(|name| is_study(name)).map(str::to_owned).collect();
        is_tag(tag).then(|| (k + 1, tag.to_owned(), names))
    };
    text.lines().enumerate().filter_map(row).collect()
}

/// Written like a claim, a mutant or an exhibit: words of small letters joined by hyphens, or the start of one with a
/// star.
pub fn is_study(name: &str) -> bool {
    let plain = name.strip_suffix('*').unwrap_or(name);
    let letters = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || "-.".contains(c);
    plain.contains('-') && plain.starts_with(|c: char| c.is_ascii_lowercase()) && plain.chars().all(letters)
}

/// Strings of `"tags": [ … ]` in a golden record.
pub fn record_tags(json: &str) -> Vec<String> {
    let Some((_, rest)) = json.split_once("\"tags\":") else { return Vec::new() };
    let list = rest.split_once('[').and_then(|(_, rest)| rest.split_once(']')).map_or("", |(list, _)| list);
    list.split('"').skip(1).step_by(2).map(str::to_owned).collect()
}
