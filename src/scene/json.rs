//! What is commonly wrong with text that is not JSON.

/// A way out, by the letters around the place where the parser stopped.
#[must_use]
pub(super) fn mend(text: &str, line: usize, column: usize) -> &'static str {
    if text.trim().is_empty() {
        return "write a scene into the file: it is empty";
    }
    let row = text.lines().nth(line.saturating_sub(1)).unwrap_or("");
    // Columns count bytes, from 1; the parser stops at the letter that it does not like, or the one after.
    let bytes = row.as_bytes();
    let at = column.saturating_sub(1);
    let byte = |i: usize| bytes.get(i).copied().unwrap_or(b' ');
    let (before, here, next) = (byte(at.wrapping_sub(1)), byte(at), byte(at + 1));
    let is_number = |c: u8| c.is_ascii_digit();
    match here {
        b'/' | b'#' => "remove the comment; text for people goes into `title` and `description`",
        b'\'' => "write names and text in double quotation marks",
        b'+' => "write numbers without a plus sign",
        b'.' if is_number(next) => "write a digit before the point: 0.5, not .5",
        b'x' | b'X' | b'_' if is_number(before) => "write numbers in decimal digits alone: 1000",
        c if is_number(c) && is_number(before) && before == b'0' => "write numbers without leading zeros",
        _ if before == b'.' && !is_number(here) => "write a digit after the point: 1.0, not 1.",
        c if c >= 0x80 || before >= 0x80 => {
            "replace the letter there, which looks like another: JSON has plain double quotation marks, digits and spaces"
        }
        b'}' | b']' => "remove the comma before the bracket",
        c if is_number(c) => {
            "write the name of the key before it; numbers have a decimal point, and no commas within"
        }
        c if c.is_ascii_alphabetic() => "write names and text in double quotation marks",
        _ => "mend the text there; JSON has no comments and no comma after a last entry",
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::flow_from_json;

    #[test]
    fn the_way_out_is_about_the_mistake() {
        let cases = [
            ("{// box\n}", "comment"),
            ("{# box\n}", "comment"),
            ("{'a': 1}", "double quotation"),
            ("{a: 1}", "double quotation"),
            ("{\"a\": +1}", "plus sign"),
            ("{\"a\": .5}", "before the point"),
            ("{\"a\": 1.}", "after the point"),
            ("{\"a\": 0x10}", "decimal digits"),
            ("{\"a\": 1_000}", "decimal digits"),
            ("{\"a\": 01}", "leading zeros"),
            ("{\"a\": 1,000}", "no commas within"),
            ("{“a”: 1}", "looks like another"),
            ("{\"a\":\u{a0}1}", "looks like another"),
            ("{\"a\": 1,}", "remove the comma"),
            ("  \n", "empty"),
        ];
        for (text, part) in cases {
            let text = text.replace("\"a\"", "\"stop\": {\"end_time_s\"");
            let error = flow_from_json(&text, "s.json", std::path::Path::new(".")).expect_err(&text);
            assert!(error.to_string().contains(part), "{text}: {error}");
        }
    }
}
