//! A file in which each of its mistakes can be chosen at run time.

use crate::points::Point;
use std::ops::Range;

/// A mistake with its number.
pub type Numbered<'a> = (u32, &'a Point);

/// The text with all of `points`, each behind a question to `crate::mutated::on`. Where one lies within another, the
/// outer mistake has the inner code as it was.
pub fn with_all(text: &str, points: &[Numbered]) -> String {
    let mut points = points.to_vec();
    points.sort_by_key(|(number, point)| (point.range.start, std::cmp::Reverse(point.range.end), *number));
    render(text, 0..text.len(), &points)
}

fn render(text: &str, within: Range<usize>, mut points: &[Numbered]) -> String {
    let (mut out, mut at) = (String::new(), within.start);
    while let Some((_, first)) = points.first() {
        let range = first.range.clone();
        let same = points.iter().take_while(|(_, point)| point.range == range).count();
        let (group, rest) = points.split_at(same);
        let inner = rest.iter().take_while(|(_, point)| point.range.end <= range.end).count();
        out.push_str(&text[at..range.start]);
        if first.returns {
            for (number, point) in group {
                out.push_str(&marked(
                    *number,
                    &format!("if crate::mutated::on({number}) {{ return {}; }}", point.instead),
                ));
            }
            points = rest;
        } else {
            let (children, rest) = rest.split_at(inner);
            let mut code = format!("{{ {} }}", render(text, range.clone(), children));
            for (number, point) in group.iter().rev() {
                code = format!("if crate::mutated::on({number}) {{ {} }} else {code}", point.instead);
            }
            for (number, _) in group {
                code = marked(*number, &code);
            }
            out.push_str(&format!("({code})"));
            points = rest;
        }
        at = range.end;
    }
    out.push_str(&text[at..within.end]);
    out
}

fn marked(number: u32, code: &str) -> String {
    format!("/*<{number}*/{code}/*>{number}*/")
}

/// The mistakes whose code a byte of the rewritten text belongs to: those of the innermost place.
pub fn at(rewritten: &str, byte: usize) -> Vec<u32> {
    let mut open: Vec<(usize, u32)> = Vec::new();
    for (place, _) in rewritten.match_indices("/*").take_while(|(place, _)| *place <= byte) {
        let mark = &rewritten[place + 2..];
        let number = |mark: &str| mark[1..].split("*/").next().and_then(|number| number.parse().ok());
        match (mark.as_bytes().first(), number(mark)) {
            (Some(b'<'), Some(number)) => open.push((place, number)),
            (Some(b'>'), Some(number)) => open.retain(|(_, other)| *other != number),
            _ => {}
        }
    }
    // Mistakes of one place open with nothing but each other between them.
    let mut found = Vec::new();
    while let Some((place, number)) = open.pop() {
        found.push(number);
        let touches = open.last().is_some_and(|(other, n)| other + format!("/*<{n}*/").len() == place);
        if !touches {
            break;
        }
    }
    found
}

/// The module that knows which of `count` mistakes is chosen: the number in LAHAR_MUTANT, or none; with LAHAR_REACHED, a
/// folder, none, and an empty file for each that was asked for.
pub fn chooser(count: usize) -> String {
    format!(
        r#"//! Which mistake is chosen.
use std::sync::atomic::{{AtomicBool, AtomicU32, Ordering}};

const UNKNOWN: u32 = u32::MAX;
const COVER: u32 = u32::MAX - 1;
const NONE: u32 = u32::MAX - 2;
static CHOSEN: AtomicU32 = AtomicU32::new(UNKNOWN);
static REACHED: [AtomicBool; {count}] = [const {{ AtomicBool::new(false) }}; {count}];

/// Whether it is this one.
#[inline(always)]
pub fn on(number: u32) -> bool {{
    let chosen = CHOSEN.load(Ordering::Relaxed);
    chosen == number || (chosen >= COVER && ask(chosen, number))
}}

#[cold]
#[inline(never)]
fn ask(mut chosen: u32, number: u32) -> bool {{
    if chosen == UNKNOWN {{
        chosen = match std::env::var("LAHAR_MUTANT") {{
            Ok(text) => text.parse().expect("a number"),
            Err(_) if std::env::var_os("LAHAR_REACHED").is_some() => COVER,
            Err(_) => NONE,
        }};
        CHOSEN.store(chosen, Ordering::Relaxed);
    }}
    if chosen == COVER && !REACHED[number as usize].swap(true, Ordering::Relaxed) {{
        let folder = std::env::var_os("LAHAR_REACHED").expect("a folder");
        let _ = std::fs::File::create(std::path::Path::new(&folder).join(number.to_string()));
    }}
    chosen == number
}}
"#
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nested_mistakes_and_their_places() {
        let text = "fn f(a: f64) -> f64 { a * (a + 1.0) }";
        let points = crate::points::of(text).expect("Rust");
        let all: Vec<Numbered> = points.iter().enumerate().map(|(k, point)| (k as u32, point)).collect();
        let found = with_all(text, &all);
        syn::parse_file(&found).expect("Rust again");
        for (number, point) in &all {
            assert_eq!(found.matches(&format!("on({number})")).count(), 1, "{point:?}");
            let place = found.find(&format!("on({number})")).expect("a place");
            assert_eq!(at(&found, place), [*number]);
        }
        assert!(found.contains("on(2) { (a) / ((a + 1.0)) } else"), "{found}");
        assert_eq!(at(&found, 3), [0_u32; 0]);
    }
}
