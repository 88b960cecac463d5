//! JSON text to a scene, and the parser's complaints to [`SceneError`].

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::error::Category;

use super::meaning::hint;
use super::{SceneError, SceneProblem};

/// Parses without checking values.
pub(super) fn parse<S: DeserializeOwned>(text: &str, file: &str) -> Result<S, SceneError> {
    if text.trim_start().starts_with('[') {
        // serde would read the keys of a scene from an array, in order.
        let problem = SceneProblem::WrongType {
            found: "an array".to_owned(),
            expected: "an object with keys".to_owned(),
        };
        return Err(SceneError::new(file, "", problem));
    }
    let mut reader = serde_json::Deserializer::from_str(text);
    let located = |path: String, problem| SceneError::new(file, path, problem);
    let scene: S = serde_path_to_error::deserialize(&mut reader).map_err(|error| {
        let path = error.path().to_string();
        let inner = error.into_inner();
        match inner.classify() {
            Category::Data => located(tidy(&path), shape_problem(&message(&inner))),
            // serde_json calls a number in place of a choice a mistake of syntax.
            _ if message(&inner) == "expected value" && is_json(text) => {
                if let Some(problem) = several_choices(text, &path) {
                    return located(tidy(&path), problem);
                }
                let found = "a value of another type".to_owned();
                located(tidy(&path), SceneProblem::WrongType { found, expected: in_plain_words("enum ") })
            }
            _ if message(&inner) == "trailing characters" && is_json(text) => {
                located(tidy(&path), too_many(text, &path))
            }
            _ => located(tidy(&path), syntax_problem(text, &inner)),
        }
    })?;
    reader.end().map_err(|error| located(String::new(), syntax_problem(text, &error)))?;
    Ok(scene)
}

/// Whether a scene is about grains alone, by its keys: `grains` without `fluid`.
pub(super) fn is_dry(text: &str) -> bool {
    /// Only whether the keys are there.
    #[derive(serde::Deserialize)]
    struct Keys {
        fluid: Option<serde::de::IgnoredAny>,
        grains: Option<serde::de::IgnoredAny>,
    }
    text.trim_start().starts_with('{')
        && matches!(serde_json::from_str::<Keys>(text), Ok(Keys { fluid: None, grains: Some(_) }))
}

/// serde_json calls it trailing characters where an array or a choice ends later than it should.
fn too_many(text: &str, path: &str) -> SceneProblem {
    let value: serde_json::Value = serde_json::from_str(text).unwrap_or_default();
    match at_path(&value, path) {
        Some(serde_json::Value::Array(entries)) => SceneProblem::WrongType {
            found: format!("an array of {} entries", entries.len()),
            expected: "fewer: 3 for a vector, 4 for an orientation, 2 for a pair".to_owned(),
        },
        Some(serde_json::Value::Object(keys)) => SceneProblem::WrongType {
            found: format!("an object with {} keys", keys.len()),
            expected: "a choice, as text or as an object with one key".to_owned(),
        },
        _ => SceneProblem::WrongType {
            found: "more than belongs here".to_owned(),
            expected: "see `lahar schema`".to_owned(),
        },
    }
}

/// An object with several keys, or none, in place of a choice.
fn several_choices(text: &str, path: &str) -> Option<SceneProblem> {
    let value: serde_json::Value = serde_json::from_str(text).ok()?;
    let keys = at_path(&value, path)?.as_object()?.len();
    (keys != 1).then(|| SceneProblem::WrongType {
        found: format!("an object with {keys} keys"),
        expected: "one choice: text, or an object with one key".to_owned(),
    })
}

/// The value at a path as `a.b[2].c`, as far as it is there.
fn at_path<'a>(value: &'a serde_json::Value, path: &str) -> Option<&'a serde_json::Value> {
    let parts = path.split(['.', '[', ']']).filter(|part| !part.is_empty() && *part != "?");
    parts.into_iter().try_fold(value, |value, part| match value {
        serde_json::Value::Array(entries) => entries.get(part.parse::<usize>().ok()?),
        other => other.get(part),
    })
}

fn is_json(text: &str) -> bool {
    serde_json::from_str::<serde::de::IgnoredAny>(text).is_ok()
}

/// The root is an empty path; a trailing `?` marks a place that the parser never reached.
fn tidy(path: &str) -> String {
    let path = path.trim_end_matches('?').trim_end_matches('.');
    path.to_owned()
}

/// The message without serde_json's position, which the JSON path replaces.
fn message(error: &serde_json::Error) -> String {
    let text = error.to_string();
    match text.rfind(" at line ") {
        Some(end) => text[..end].to_owned(),
        None => text,
    }
}

fn syntax_problem(text: &str, error: &serde_json::Error) -> SceneProblem {
    let (line, column) = (error.line(), error.column());
    let detail = message(error);
    if detail == "number out of range" {
        return SceneProblem::NumberTooLarge { line, column };
    }
    if let Some(token) = not_a_number_at(text, line, column) {
        return SceneProblem::NotANumber { line, column, token };
    }
    SceneProblem::Syntax { line, column, detail }
}

/// `NaN` or an infinity at, or just before, a position of the text.
fn not_a_number_at(text: &str, line: usize, column: usize) -> Option<&'static str> {
    let found = text.lines().nth(line.checked_sub(1)?)?;
    // The parser stops at most one sign and one letter into the word.
    let starts = column.saturating_sub(3)..=column;
    let begins = |token: &&str| {
        starts.clone().any(|start| found.get(start..).is_some_and(|rest| rest.starts_with(*token)))
    };
    ["-Infinity", "Infinity", "NaN", "nan", "inf"].into_iter().find(begins)
}

/// Reads serde's fixed sentences.
fn shape_problem(message: &str) -> SceneProblem {
    let quoted = quoted(message);
    if message.starts_with("unknown field") {
        let (key, allowed) = split_first(quoted);
        let hint = hint(&key, &allowed);
        return SceneProblem::UnknownKey { key, hint, allowed };
    }
    if message.starts_with("unknown variant") {
        let (found, allowed) = split_first(quoted);
        let hint = hint(&found, &allowed);
        return SceneProblem::UnknownChoice { found, hint, allowed };
    }
    if message.starts_with("missing field") {
        return SceneProblem::MissingKey { key: split_first(quoted).0 };
    }
    if message.starts_with("duplicate field") {
        return SceneProblem::DuplicateKey { key: split_first(quoted).0 };
    }
    let (found, expected) = message.split_once(", expected ").unwrap_or((message, "see `lahar schema`"));
    let found = found
        .strip_prefix("invalid type: ")
        .or_else(|| found.strip_prefix("invalid value: "))
        .or_else(|| found.strip_prefix("invalid "))
        .unwrap_or(found);
    SceneProblem::WrongType { found: found.to_owned(), expected: in_plain_words(expected) }
}

/// serde names Rust types; a scene's author knows JSON.
fn in_plain_words(expected: &str) -> String {
    match expected {
        "f64" => "a number".to_owned(),
        "u32" | "i32" | "u64" => "a whole number".to_owned(),
        other if other.starts_with("struct variant") || other.starts_with("struct ") => {
            "an object with keys".to_owned()
        }
        other if other.starts_with("enum ") => "a choice, as text or as an object with one key".to_owned(),
        other => other.to_owned(),
    }
}

/// The words between back-ticks.
fn quoted(message: &str) -> Vec<String> {
    message.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

fn split_first(mut words: Vec<String>) -> (String, Vec<String>) {
    if words.is_empty() {
        return (String::new(), words);
    }
    let first = words.remove(0);
    (first, words)
}

/// A file holds finite numbers only, and so does what would be read back from one.
pub(super) fn finite<S: Serialize + DeserializeOwned>(scene: &S, file: &str) -> Result<(), SceneError> {
    // A scene holds nothing that JSON cannot; a number that is not finite becomes `null`.
    let text = serde_json::to_string(scene).unwrap_or_default();
    parse::<S>(&text, file).map(|_| ())
}
