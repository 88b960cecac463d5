//! Prose of the report: Markdown with lines of even length.

/// Columns at which prose is wrapped; a renderer joins the lines again.
const WIDTH: usize = 110;

/// Appends a paragraph, wrapped, and an empty line.
pub fn paragraph(out: &mut String, text: &str) {
    wrap(out, text, "");
    out.push('\n');
}

/// Appends an item of a list, wrapped.
pub fn item(out: &mut String, text: &str) {
    out.push_str("- ");
    wrap(out, text, "  ");
}

/// Appends paragraphs that are separated by empty lines, each wrapped.
pub fn paragraphs(out: &mut String, text: &str) {
    for part in text.split("\n\n").filter(|p| !p.trim().is_empty()) {
        paragraph(out, part);
    }
}

fn wrap(out: &mut String, text: &str, indent: &str) {
    let mut width = indent.chars().count();
    for (k, word) in text.split_whitespace().enumerate() {
        let length = word.chars().count();
        if k > 0 && width + 1 + length > WIDTH && !starts_a_block(word) {
            out.push('\n');
            out.push_str(indent);
            width = indent.chars().count();
        } else if k > 0 {
            out.push(' ');
            width += 1;
        }
        out.push_str(word);
        width += length;
    }
    out.push('\n');
}

/// A line that began with this word would be read as a list, a heading, a quotation or a rule.
fn starts_a_block(word: &str) -> bool {
    let marks = word.chars().all(|c| "-+*=_~".contains(c));
    let numbered = word.strip_suffix(['.', ')']).is_some_and(|n| n.chars().all(|c| c.is_ascii_digit()));
    marks || numbered || word.starts_with(['#', '>', '|'])
}

/// Words of a declaration as Markdown: what would be read as markup is escaped, except in `code`.
#[must_use]
pub fn escaped(text: &str) -> String {
    let mut code = false;
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        code ^= letter == '`';
        if !code && "<*~$".contains(letter) {
            out.push('\\');
        }
        out.push(letter);
    }
    out
}

/// A sentence without its full stop, for where one is added.
#[must_use]
pub fn unstopped(text: &str) -> &str {
    text.trim().trim_end_matches('.')
}

/// The first sentence of a text, with its full stop.
#[must_use]
pub fn first_sentence(text: &str) -> &str {
    let ends = text.match_indices(". ").map(|(k, _)| k + 1);
    // A capital letter follows the end of a sentence, but not `e.g. ` or `Re. `.
    let mut ends =
        ends.filter(|&k| text[k..].trim_start().starts_with(|c: char| c.is_uppercase() || c == '`'));
    ends.next().map_or(text, |k| &text[..k])
}

/// The beginning of a text, of at most so many letters, cut between words.
#[must_use]
pub fn beginning(text: &str, letters: usize) -> String {
    if text.chars().count() <= letters {
        return text.to_owned();
    }
    let cut: String = text.chars().take(letters).collect();
    let words = cut.rsplit_once(' ').map_or(cut.as_str(), |(words, _)| words);
    // A piece of code is not left open.
    let closed = if words.matches('`').count() % 2 == 1 {
        words.rsplit_once('`').map_or("", |(w, _)| w)
    } else {
        words
    };
    format!("{} …", closed.trim_end())
}

/// `speed-against-error` becomes `Speed against error`.
#[must_use]
pub fn heading(id: &str) -> String {
    let words = id.replace('-', " ");
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |c| c.to_uppercase().chain(letters).collect())
}

/// The anchor that Markdown gives a heading: lower case, blanks to dashes, without punctuation.
#[must_use]
pub fn anchor(heading: &str) -> String {
    let kept = heading.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect::<String>().to_lowercase()
}

/// Ids as code, separated by commas.
#[must_use]
pub fn code_list<'a>(ids: impl IntoIterator<Item = &'a str>) -> String {
    ids.into_iter().map(|id| format!("`{id}`")).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_wrapped_line_starts_a_block() {
        let mut out = String::new();
        let text = format!("{} - 4. # end", "word ".repeat(21));
        item(&mut out, &text);
        let lines: Vec<&str> = out.lines().collect();
        assert_eq!(lines[1], "  end");
        assert!(lines[0].ends_with("word - 4. #"), "{out}");
    }

    #[test]
    fn markup_is_escaped_outside_of_code() {
        assert_eq!(escaped("a ~ b `x*y` |u| < 1*2"), "a \\~ b `x*y` |u| \\< 1\\*2");
    }

    #[test]
    fn sentences_and_anchors() {
        assert_eq!(first_sentence("At Re = 0.1 it is 5 %. Then more."), "At Re = 0.1 it is 5 %.");
        assert_eq!(first_sentence("only one"), "only one");
        assert_eq!(beginning("one two three", 9), "one two …");
        assert_eq!(beginning("one `two three`", 10), "one …");
        assert_eq!(anchor("poiseuille-clamped-0.6"), "poiseuille-clamped-06");
        assert_eq!(anchor("Known limits"), "known-limits");
    }
}
