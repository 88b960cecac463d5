//! Where in a scene a key has its place, by the schema.

use std::fmt;

use serde_json::Value;

/// Depth at which shapes of shapes are left.
const DEEPEST: usize = 12;

/// An object of a scene: keys from the top, those of a list with `[]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Place(Vec<String>);

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_empty() { f.write_str("the scene itself") } else { write!(f, "`{}`", self.0.join(".")) }
    }
}

/// Objects that have the key, those nearest to `path`; `dry`: of scenes without fluid.
pub(super) fn places_of(key: &str, path: &str, dry: bool) -> Vec<Place> {
    let schema =
        if dry { schemars::schema_for!(super::dry::DryScene) } else { schemars::schema_for!(super::Scene) };
    let mut walk = Walk { root: schema.as_value(), key, found: Vec::new() };
    walk.through(schema.as_value(), &mut Vec::new(), &mut Vec::new());
    let here: Vec<&str> = path.split('.').filter(|part| !part.is_empty()).collect();
    let shared = |place: &Vec<String>| {
        let pairs = place.iter().zip(&here);
        pairs.take_while(|(key, here)| bare(key) == bare(here)).count()
    };
    // Near: as much of the path in common as there is, then as few steps from there as there are.
    let rank = |place: &Vec<String>| (usize::MAX - shared(place), place.len());
    // Entries of a list that the path is not about are no place for it.
    walk.found.retain(|place| shared(place) > 0 || place.iter().all(|key| !key.ends_with("[]")));
    let Some(best) = walk.found.iter().map(rank).min() else { return Vec::new() };
    let mut places: Vec<Place> = Vec::new();
    for mut place in walk.found.into_iter().filter(|place| rank(place) == best) {
        let common = shared(&place);
        place.iter_mut().zip(&here).take(common).for_each(|(key, here)| (*here).clone_into(key));
        if !places.iter().any(|other| other.0 == place) {
            places.push(Place(place));
        }
    }
    places
}

/// A part of a path without the number of an entry.
fn bare(part: &str) -> &str {
    part.split('[').next().unwrap_or(part)
}

/// A walk over a schema.
struct Walk<'a> {
    root: &'a Value,
    key: &'a str,
    found: Vec<Vec<String>>,
}

impl<'a> Walk<'a> {
    fn through(&mut self, schema: &'a Value, at: &mut Vec<String>, names: &mut Vec<&'a str>) {
        if at.len() > DEEPEST {
            return;
        }
        if let Some(name) = schema.get("$ref").and_then(Value::as_str) {
            // Shapes hold shapes: once is enough.
            if names.contains(&name) {
                return;
            }
            if let Some(target) = self.root.pointer(name.trim_start_matches('#')) {
                names.push(name);
                self.through(target, at, names);
                names.pop();
            }
        }
        for list in ["anyOf", "oneOf", "allOf"] {
            for part in schema.get(list).and_then(Value::as_array).into_iter().flatten() {
                self.through(part, at, names);
            }
        }
        if let Some(items) = schema.get("items") {
            if let Some(last) = at.last_mut() {
                last.push_str("[]");
            }
            self.through(items, at, names);
            if let Some(last) = at.last_mut() {
                last.truncate(last.len() - 2);
            }
        }
        for (key, value) in schema.get("properties").and_then(Value::as_object).into_iter().flatten() {
            if key == self.key {
                self.found.push(at.clone());
            }
            at.push(key.clone());
            self.through(value, at, names);
            at.pop();
        }
    }
}
