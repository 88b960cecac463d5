//! Pieces of messages about scenes.

use super::hint::Hint;

/// A number as it is written, with an exponent where that is shorter.
pub(super) fn number(x: f64) -> String {
    let short = x == 0.0 || !x.is_finite() || (1e-6..1e12).contains(&x.abs());
    if short { x.to_string() } else { format!("{x:e}") }
}

/// A number of cells that is not whole, with as many digits as it takes to see that.
pub(super) fn not_whole(x: f64) -> String {
    let digits = (4..12).find(|&digits| {
        let text = format!("{x:.digits$}");
        text.parse().is_ok_and(|shown: f64| shown.fract() != 0.0)
    });
    format!("{x:.*}", digits.unwrap_or(4)).trim_end_matches('0').trim_end_matches('.').to_owned()
}

pub(super) fn range(low: f64, high: f64) -> String {
    if high == f64::INFINITY {
        format!("at least {}", number(low))
    } else {
        format!("{} to {}", number(low), number(high))
    }
}

pub(super) fn with_space(unit: &str) -> String {
    if unit.is_empty() { String::new() } else { format!(" {unit}") }
}

pub(super) fn did_you_mean(nearest: Option<&String>) -> String {
    nearest.map_or_else(String::new, |name| format!("; did you mean `{name}`?"))
}

pub(super) fn rename_or_remove(hint: &Hint) -> String {
    match (&hint.name, hint.note.as_str()) {
        (Some(name), "") => format!("rename it to `{name}`"),
        (Some(name), note) => format!("rename it to `{name}`: {note}"),
        (None, "") => "remove it".to_owned(),
        (None, note) => note.to_owned(),
    }
}

pub(super) fn rename_or_add(nearest: Option<&String>) -> String {
    nearest.map_or_else(|| "name one of `solids`".to_owned(), |name| format!("write `{name}`"))
}

pub(super) fn rename_or_define(nearest: Option<&String>, kind: &str) -> String {
    nearest.map_or_else(|| format!("name a {kind} of the scene, or add it"), |name| format!("write `{name}`"))
}

pub(super) fn choose(hint: &Hint, allowed: &[String]) -> String {
    match (&hint.name, hint.note.as_str()) {
        (Some(name), "") => format!("write `{name}`"),
        (Some(name), note) => format!("write `{name}`: {note}"),
        (None, "") if allowed.len() == 1 => format!("write {}", list(allowed)),
        (None, "") => "write one of them".to_owned(),
        (None, note) => note.to_owned(),
    }
}

pub(super) fn list(names: &[String]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

pub(super) fn list_static(names: &[&str]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

pub(super) fn found_keys(names: &[&str]) -> String {
    if names.is_empty() { "none".to_owned() } else { list_static(names) }
}

/// Names, or what is said where there are none.
pub(super) fn list_or(names: &[String], none: &str) -> String {
    if names.is_empty() { none.to_owned() } else { list(names) }
}

/// A way out of a wrong type; `found` is as the parser says it, with the type first.
pub(super) fn right_type(found: &str) -> &'static str {
    if found.starts_with("string") {
        "write numbers without quotation marks; choices are written as in `lahar schema`"
    } else {
        "see `lahar schema` for what belongs here"
    }
}

/// Who has a name already.
pub(super) fn already(other: Option<&String>) -> String {
    match other {
        Some(other) => format!("which `{other}` makes too"),
        None => "which every series has".to_owned(),
    }
}
