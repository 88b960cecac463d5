//! The structure of the sources: one way between the floors, no circle of files, sizes that can be read.
//!
//! The floors are those of the map in `src/lib.rs`. What a file imports is read from its text: every
//! `crate::…` and `super::…` outside comments, strings and unit tests.

mod sources;

use std::collections::{BTreeMap, BTreeSet};

use sources::{Source, circles, functions, product};

/// The product's modules from the ground up; a module imports from lower floors only.
const FLOORS: &[&[&str]] = &[
    &["fingerprint", "lane", "state", "units", "vector"],
    &["lattice"],
    &["collision", "geometry", "rheology"],
    &["dem", "stability"],
    &["setup"],
    &["boundary"],
    &["free_surface"],
    &["coupling"],
    &["solver"],
    &["output"],
    &["scene"],
    &["plan"],
    &["run"],
    &["bench"],
];

/// Circles of files that stay, each with its reason. Everything else is an error, and so is an entry
/// that is no longer needed.
const CIRCLES_THAT_STAY: &[(&[&str], &str)] = &[];

/// Longest file, lines.
const FILE: usize = 400;
/// Longest function, lines.
const FUNCTION: usize = 60;

fn floor(module: &str) -> Option<usize> {
    FLOORS.iter().position(|floor| floor.contains(&module))
}

/// Arrows that do not run down, in words.
fn arrows_up(sources: &[Source]) -> Vec<String> {
    let mut found = Vec::new();
    for source in sources {
        let Some(own) = source.module() else { continue };
        let Some(at) = floor(own) else {
            found.push(format!("{}: module `{own}` stands on no floor", source.path));
            continue;
        };
        for (line, target) in &source.imports {
            let Some(other) = target.first().filter(|other| *other != own) else { continue };
            match floor(other) {
                Some(below) if below < at => {}
                Some(_) => found.push(format!("{}:{line}: `{own}` imports `{other}`", source.path)),
                None => found.push(format!("{}:{line}: `{other}` stands on no floor", source.path)),
            }
        }
    }
    found.dedup();
    found
}

#[test]
fn modules_import_from_lower_floors_only() {
    let up = arrows_up(&product());
    assert!(up.is_empty(), "{} arrows do not run down:\n{}", up.len(), up.join("\n"));
}

#[test]
fn limit_an_arrow_up_is_found() {
    let text = "use crate::lattice::Q;\nfn f() { crate::scene::load(); }\n// use crate::plan::Plan;\n";
    let source = Source::parse("src/solver/run.rs", text);
    assert_eq!(arrows_up(&[source]), ["src/solver/run.rs:2: `solver` imports `scene`"]);
    let grouped =
        Source::parse("src/solver/run.rs", "use crate::{\n    lattice::Q,\n    plan::{Plan, law},\n};\n");
    assert_eq!(arrows_up(&[grouped]), ["src/solver/run.rs:1: `solver` imports `plan`"]);
    let unknown = Source::parse("src/attic/mod.rs", "");
    assert_eq!(arrows_up(&[unknown]), ["src/attic/mod.rs: module `attic` stands on no floor"]);
}

#[test]
fn files_import_each_other_in_no_circle() {
    let found: BTreeSet<Vec<String>> = circles(&product()).into_iter().collect();
    let known: BTreeMap<Vec<String>, &str> = CIRCLES_THAT_STAY
        .iter()
        .map(|(files, why)| (files.iter().map(|f| (*f).to_owned()).collect(), *why))
        .collect();
    let fresh: Vec<_> = found.iter().filter(|circle| !known.contains_key(*circle)).collect();
    assert!(fresh.is_empty(), "files that import each other in a circle:\n{fresh:#?}");
    let gone: Vec<_> = known.keys().filter(|circle| !found.contains(*circle)).collect();
    assert!(gone.is_empty(), "these circles are open now; take them off the list:\n{gone:#?}");
    assert!(known.values().all(|why| !why.is_empty()));
}

#[test]
fn limit_a_circle_of_files_is_found() {
    let a = Source::parse("src/dem/a.rs", "use super::b::B;\n");
    let b = Source::parse("src/dem/b.rs", "use crate::dem::c::C;\n");
    let c = Source::parse("src/dem/c.rs", "fn f(x: &super::A) {}\n");
    let door = Source::parse("src/dem/mod.rs", "mod a;\nmod b;\nmod c;\npub use a::A;\n");
    let names = ["src/dem/a.rs", "src/dem/b.rs", "src/dem/c.rs"].map(str::to_owned);
    assert_eq!(circles(&[a, b, c, door]), [names.to_vec()]);
}

#[test]
fn files_and_functions_have_a_size_that_can_be_read() {
    let mut long = Vec::new();
    for source in product().iter().chain(&sources::harness()) {
        let lines = source.text.lines().count();
        if lines > FILE {
            long.push(format!("{}: {lines} lines", source.path));
        }
        // A unit test may list its cases one below the other.
        let is_test = source.path.contains("/tests/") || source.path.ends_with("tests.rs");
        for (line, name, length) in functions(&source.text) {
            if length > FUNCTION && !is_test {
                long.push(format!("{}:{line}: fn {name} has {length} lines", source.path));
            }
        }
    }
    assert!(long.is_empty(), "files over {FILE} lines and functions over {FUNCTION}:\n{}", long.join("\n"));
}

#[test]
fn limit_a_long_function_is_found() {
    let body = "    let _ = '{';\n".repeat(70);
    let text = format!("impl X {{\n    fn long(&self) {{\n{body}    }}\n\n    fn short() {{}}\n}}\n");
    assert_eq!(functions(&text), [(2, "long".to_owned(), 72), (75, "short".to_owned(), 1)]);
}

/// The product does not know of the harness.
#[test]
fn nothing_in_the_product_names_the_harness() {
    let named: Vec<_> =
        product().into_iter().filter(|s| s.code.contains("lahar_verification")).map(|s| s.path).collect();
    assert!(named.is_empty(), "{named:?}");
}
