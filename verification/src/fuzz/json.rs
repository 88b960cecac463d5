//! Mutants of JSON that stay JSON: what gets past the parser and reaches the checks and the plan.
//!
//! proptest makes values from nothing and has no corpus; engines that grow one (libFuzzer, AFL, bolero with either) want a compiler
//! that instruments. A tree of JSON and a list of awkward values need neither.

use std::collections::BTreeMap;

use serde_json::{Map, Value, json};

use super::random::Random;

/// Numbers at the ends of what can be written, and those at which formulas change.
const NUMBERS: &[f64] = &[
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    2.0,
    3.0,
    1e-300,
    5e-324,
    1e300,
    -1e300,
    f64::MAX,
    1e16,
    1e9,
    1e-9,
    1e-16,
    0.1,
    45.0,
    90.0,
    180.0,
    360.0,
    -9999.0,
    4_294_967_296.0,
    9_007_199_254_740_993.0,
    0.999_999_999_999,
    1.000_000_000_001,
];

/// What a number is multiplied by.
const FACTORS: &[f64] = &[-1.0, 0.1, 0.5, 0.9, 0.999_999, 1.000_001, 1.1, 2.0, 10.0, 1e-3, 1e3, 1e-6, 1e6];

/// Values by the key under which they stand in any seed, entries of an array by that of the array and `[]`: what may be grafted
/// where the key stands in another one.
#[derive(Debug, Default)]
pub struct Donors(BTreeMap<String, Vec<Value>>);

impl Donors {
    /// Adds everything in a seed.
    pub fn add(&mut self, value: &Value) {
        self.add_at("", value);
    }

    fn add_at(&mut self, key: &str, value: &Value) {
        self.0.entry(key.to_owned()).or_default().push(value.clone());
        match value {
            Value::Object(map) => map.iter().for_each(|(key, inner)| self.add_at(key, inner)),
            Value::Array(entries) => entries.iter().for_each(|entry| self.add_at(&of_entries(key), entry)),
            _ => {}
        }
    }

    fn graft(&self, key: &str, random: &mut Random) -> Option<Value> {
        random.pick(self.0.get(key)?).cloned()
    }

    /// A key with its value that stands in an object under the same key, seldom in any.
    fn pair(&self, key: &str, random: &mut Random) -> Option<(String, Value)> {
        let keys: Vec<&String> = self.0.keys().collect();
        let key = if random.once_in(8) { random.pick(&keys)?.as_str() } else { key };
        let Value::Object(map) = self.graft(key, random)? else { return None };
        let pairs: Vec<(String, Value)> = map.into_iter().collect();
        random.pick(&pairs).cloned()
    }
}

fn of_entries(key: &str) -> String {
    format!("{key}[]")
}

/// Changes one place, rarely up to five.
pub fn mutate(value: &mut Value, donors: &Donors, random: &mut Random) {
    once(value, donors, random);
    for _ in 0..4 {
        if random.once_in(4) {
            once(value, donors, random);
        }
    }
}

fn once(value: &mut Value, donors: &Donors, random: &mut Random) {
    // Every second time a number: those are what plans and runs are made of.
    let wanted: fn(&Value) -> bool = if random.once_in(2) { |_| true } else { Value::is_number };
    let mut left = random.below(count(value, wanted));
    visit(value, "", wanted, &mut left, &mut |value, key| change(value, key, donors, random));
}

/// Values of a kind in a tree.
fn count(value: &Value, wanted: fn(&Value) -> bool) -> usize {
    let inside: usize = match value {
        Value::Object(map) => map.values().map(|inner| count(inner, wanted)).sum(),
        Value::Array(entries) => entries.iter().map(|inner| count(inner, wanted)).sum(),
        _ => 0,
    };
    usize::from(wanted(value)) + inside
}

/// Calls `act` at the place numbered `left`, counted as [`count`] does.
fn visit(
    value: &mut Value,
    key: &str,
    wanted: fn(&Value) -> bool,
    left: &mut usize,
    act: &mut dyn FnMut(&mut Value, &str),
) -> bool {
    if wanted(value) {
        if *left == 0 {
            act(value, key);
            return true;
        }
        *left -= 1;
    }
    match value {
        Value::Object(map) => map.iter_mut().any(|(key, inner)| visit(inner, key, wanted, left, act)),
        Value::Array(entries) => {
            entries.iter_mut().any(|inner| visit(inner, &of_entries(key), wanted, left, act))
        }
        _ => false,
    }
}

fn change(value: &mut Value, key: &str, donors: &Donors, random: &mut Random) {
    match random.below(12) {
        0 => *value = other(random),
        1..4 => {
            if let Some(graft) = donors.graft(key, random) {
                *value = graft;
            }
        }
        _ => match value {
            Value::Number(n) => *value = number(n.as_f64().unwrap_or(0.0), random),
            Value::Object(map) => object(map, key, donors, random),
            Value::Array(entries) => array(entries, random),
            Value::String(text) => string(text, random),
            Value::Bool(flag) => *flag = !*flag,
            Value::Null => *value = other(random),
        },
    }
}

/// A value of any type.
fn other(random: &mut Random) -> Value {
    match random.below(7) {
        0 => Value::Null,
        1 => json!(true),
        2 => json!("text"),
        3 => json!([]),
        4 => json!({}),
        5 => json!([1, 2, 3, 4]),
        _ => number(1.0, random),
    }
}

fn number(x: f64, random: &mut Random) -> Value {
    let y = match random.below(8) {
        0 => random.pick(NUMBERS).copied().unwrap_or(x),
        1 => x + 1.0,
        2 => x * random.pick(FACTORS).copied().unwrap_or(1.0),
        // Not far from what it was: most of these are planned.
        _ => x * (0.8 + 0.4 * (random.below(1 << 20) as f64 / f64::from(1 << 20))),
    };
    // Keys that want whole numbers get some.
    if y.fract() == 0.0 && y.abs() < 9e15 && random.once_in(2) { json!(y as i64) } else { json!(y) }
}

fn object(map: &mut Map<String, Value>, at: &str, donors: &Donors, random: &mut Random) {
    let keys: Vec<String> = map.keys().cloned().collect();
    match (random.below(4), random.pick(&keys)) {
        (0, Some(key)) => drop(map.remove(key)),
        (1, Some(key)) => {
            if let Some(inner) = map.remove(key) {
                map.insert(misspelt(key, random), inner);
            }
        }
        _ => {
            if let Some((key, inner)) = donors.pair(at, random) {
                map.insert(key, inner);
            }
        }
    }
}

fn misspelt(key: &str, random: &mut Random) -> String {
    let mut letters: Vec<char> = key.chars().collect();
    match random.below(letters.len() + 1) {
        at if at < letters.len() => drop(letters.remove(at)),
        _ => letters.push('é'),
    }
    letters.into_iter().collect()
}

fn array(entries: &mut Vec<Value>, random: &mut Random) {
    let (from, to) = (random.below(entries.len()), random.below(entries.len()));
    match random.below(6) {
        0 => entries.clear(),
        1 if !entries.is_empty() => drop(entries.remove(from)),
        2 if !entries.is_empty() => entries.swap(from, to),
        3 if !entries.is_empty() => entries[to] = entries[from].clone(),
        4 if !entries.is_empty() => {
            let many = [1, 2, 3, 30, 300][random.below(5)];
            entries.extend(vec![entries[from].clone(); many]);
        }
        _ => entries.push(other(random)),
    }
}

fn string(text: &mut String, random: &mut Random) {
    match random.below(6) {
        0 => text.clear(),
        1 => *text = text.repeat(1 + random.below(200)),
        2 => text.push_str("/../é\u{0}\n\"<&"),
        3 => *text = misspelt(text, random),
        _ => *text = ["x_min", "z_max", "y", "no_slip", "open", "periodic"][random.below(6)].to_owned(),
    }
}
