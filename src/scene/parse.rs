//! JSON text to a scene, and the parser's complaints to [`SceneError`].

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::error::Category;

use super::hint::{hint, hint_of_key};
use super::{SceneError, SceneProblem};

/// Parses without checking values.
pub(super) fn parse<S: DeserializeOwned>(text: &str, file: &str) -> Result<S, SceneError> {
    let object = |path: &str| {
        let problem = SceneProblem::WrongType {
            found: "an array".to_owned(),
            expected: "an object with keys".to_owned(),
        };
        SceneError::new(file, path, problem)
    };
    if text.trim_start().starts_with('[') {
        // serde would read the keys of a scene from an array, in order.
        return Err(object(""));
    }
    let mut reader = serde_json::Deserializer::from_str(text);
    let located = |path: String, problem| SceneError::new(file, path, problem);
    let scene: S = serde_path_to_error::deserialize(&mut reader).map_err(|error| {
        let path = error.path().to_string();
        let inner = error.into_inner();
        let value: serde_json::Value = serde_json::from_str(text).unwrap_or_default();
        if let Some(path) = keys_in_order::<S>(&value, &path) {
            return object(&path);
        }
        let said = message(&inner);
        match inner.classify() {
            Category::Data => located(tidy(&path), shape_problem(&said, &value, &path)),
            // serde_json calls a number in place of a choice a mistake of syntax.
            _ if said == "expected value" && value.is_object() => {
                located(tidy(&path), no_choice(&value, &path))
            }
            _ if said == "trailing characters" && value.is_object() => {
                located(tidy(&path), too_many::<S>(&value, &path))
            }
            _ => located(tidy(&path), syntax_problem(text, &inner)),
        }
    })?;
    reader.end().map_err(|error| located(String::new(), syntax_problem(text, &error)))?;
    Ok(scene)
}

/// The path of an array in place of an object, which serde reads as the keys in order, if an error lies in one.
fn keys_in_order<S: DeserializeOwned>(value: &serde_json::Value, path: &str) -> Option<String> {
    let ends: Vec<usize> = path.match_indices('[').map(|(end, _)| end).collect();
    ends.into_iter().map(|end| &path[..end]).find_map(|outer| {
        let array = at_path(value, outer)?.is_array();
        let complaint = complaint_about::<S>(value, outer, serde_json::json!({}))?;
        (array && complaint.starts_with("missing field")).then(|| outer.to_owned())
    })
}

/// What is said of the scene with another value at a path, if that is said of this value.
fn complaint_about<S: DeserializeOwned>(
    value: &serde_json::Value,
    path: &str,
    other: serde_json::Value,
) -> Option<String> {
    let mut changed = value.clone();
    *at_path_mut(&mut changed, path)? = other;
    let text = changed.to_string();
    let error =
        serde_path_to_error::deserialize::<_, S>(&mut serde_json::Deserializer::from_str(&text)).err()?;
    (tidy(&error.path().to_string()) == path).then(|| message(error.inner()))
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
fn too_many<S: DeserializeOwned>(value: &serde_json::Value, path: &str) -> SceneProblem {
    let (found, expected) = match at_path(value, path) {
        Some(serde_json::Value::Array(entries)) => {
            let found = format!("an array of {} entries", entries.len());
            (found, right_length::<S>(value, path).unwrap_or_else(|| "fewer".to_owned()))
        }
        Some(serde_json::Value::Object(keys)) => {
            (format!("an object with {} keys", keys.len()), ONE_CHOICE.to_owned())
        }
        _ => ("more than belongs here".to_owned(), "see `lahar schema`".to_owned()),
    };
    SceneProblem::WrongType { found, expected }
}

/// What is said about an array without entries in place of one with too many.
fn right_length<S: DeserializeOwned>(value: &serde_json::Value, path: &str) -> Option<String> {
    let complaint = complaint_about::<S>(value, &tidy(path), serde_json::json!([]))?;
    complaint.split_once(", expected ").map(|(_, expected)| in_plain_words(expected))
}

const ONE_CHOICE: &str = "one choice: text, or an object with one key";

/// Something else in place of a choice.
fn no_choice(value: &serde_json::Value, path: &str) -> SceneProblem {
    use serde_json::Value;
    let found = match at_path(value, path) {
        // Only the last of keys of one name is left in the value.
        Some(Value::Object(keys)) if keys.len() == 1 => {
            return SceneProblem::DuplicateKey { key: keys.keys().next().cloned().unwrap_or_default() };
        }
        Some(Value::Object(keys)) => format!("an object with {} keys", keys.len()),
        Some(Value::Array(_)) => "an array".to_owned(),
        Some(Value::Null) => "null".to_owned(),
        Some(other) => format!("`{other}`"),
        None => "a value of another type".to_owned(),
    };
    SceneProblem::WrongType { found, expected: ONE_CHOICE.to_owned() }
}

/// Keys and numbers of entries in a path as `a.b[2].c`.
fn parts(path: &str) -> impl Iterator<Item = &str> {
    path.split(['.', '[', ']']).filter(|part| !part.is_empty() && *part != "?")
}

/// The value at a path, as far as it is there.
fn at_path<'a>(value: &'a serde_json::Value, path: &str) -> Option<&'a serde_json::Value> {
    parts(path).try_fold(value, |value, part| match value {
        serde_json::Value::Array(entries) => entries.get(part.parse::<usize>().ok()?),
        other => other.get(part),
    })
}

fn at_path_mut<'a>(value: &'a mut serde_json::Value, path: &str) -> Option<&'a mut serde_json::Value> {
    parts(path).try_fold(value, |value, part| match value {
        serde_json::Value::Array(entries) => entries.get_mut(part.parse::<usize>().ok()?),
        other => other.get_mut(part),
    })
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
    let way_out = super::json::mend(text, line, column);
    SceneProblem::Syntax { line, column, detail, way_out }
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
fn shape_problem(said: &str, value: &serde_json::Value, path: &str) -> SceneProblem {
    let quoted = quoted(said);
    if said.starts_with("unknown field") {
        let (key, allowed) = split_first(quoted);
        let path = tidy(path);
        let around = path.strip_suffix(&key).unwrap_or(&path).trim_end_matches('.');
        let dry = value.get("fluid").is_none() && value.get("grains").is_some();
        let hint = hint_of_key(&key, &allowed, around, dry);
        return SceneProblem::UnknownKey { key, hint, allowed };
    }
    if said.starts_with("unknown variant") {
        let (found, allowed) = split_first(quoted);
        let hint = hint(&found, &allowed);
        return SceneProblem::UnknownChoice { found, hint, allowed };
    }
    if said.starts_with("missing field") {
        return SceneProblem::MissingKey { key: split_first(quoted).0 };
    }
    if said.starts_with("duplicate field") {
        return SceneProblem::DuplicateKey { key: split_first(quoted).0 };
    }
    let (found, expected) = said.split_once(", expected ").unwrap_or((said, "see `lahar schema`"));
    let found = ["invalid type: ", "invalid value: ", "invalid "].iter().find_map(|p| found.strip_prefix(p));
    let found = in_json_words(found.unwrap_or(said.split(", expected ").next().unwrap_or(said)));
    SceneProblem::WrongType { found, expected: in_plain_words(expected) }
}

/// serde names its own types; a scene's author knows JSON.
fn in_json_words(found: &str) -> String {
    match found {
        "sequence" => "an array".to_owned(),
        "map" => "an object".to_owned(),
        "unit variant" => "a name alone".to_owned(),
        "newtype variant" | "struct variant" | "tuple variant" => "an object with that key".to_owned(),
        other => {
            if let Some(length) = other.strip_prefix("length ") {
                return format!("an array of {length} entries");
            }
            let types = ["floating point ", "integer ", "boolean "];
            types.iter().find_map(|kind| other.strip_prefix(kind)).unwrap_or(other).to_owned()
        }
    }
}

/// serde names Rust types; a scene's author knows JSON.
fn in_plain_words(expected: &str) -> String {
    match expected {
        "f64" => "a number".to_owned(),
        "u32" | "i32" | "u64" => "a whole number".to_owned(),
        other if other.starts_with("struct variant") || other.starts_with("struct ") => {
            "an object with keys".to_owned()
        }
        "a sequence" => "an array".to_owned(),
        "an array of length 2" => "a pair of numbers".to_owned(),
        "an array of length 3" => "an array of 3 numbers, along x, y and z".to_owned(),
        "an array of length 4" => "an array of 4 numbers, a quaternion (w, x, y, z)".to_owned(),
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
