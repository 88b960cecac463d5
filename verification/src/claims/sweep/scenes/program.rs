//! `study-sweep --scenes N` and `--scene K`.

use std::fmt::Write as _;

use super::outcome::{End, Outcome, Verdict};
use crate::claim::VerifyError;
use lahar::plan::expected::Scenes;
use lahar::solver::run::Backend;

/// Heads of the rows of [`many`].
const HEADS: &str = "case,kind,first,second,third,fourth,error,second_error,verdict,times,how,warnings";

fn line(outcome: &Outcome, scenes: &Scenes) -> String {
    let mut text = format!("{},{}", outcome.number, outcome.drawn.kind.name());
    let End::Ran { expected, warnings, errors, failed } = &outcome.end else {
        let End::Refused(why) = &outcome.end else { return text };
        let _ = write!(text, ",,,,,,,refused,,\"{}\",", why.replace('"', "'"));
        return text;
    };
    for x in expected.like().map_or([f64::NAN; 4], |like| like.at).iter().chain(errors) {
        let _ = write!(text, ",{x:.4e}");
    }
    let (verdict, times) = match outcome.verdict(scenes) {
        Verdict::Refused => ("refused", f64::NAN),
        Verdict::Outside => ("outside", f64::NAN),
        Verdict::Unknown => ("unknown", f64::NAN),
        Verdict::Within(times) => ("within", times),
        Verdict::Beyond { times, warned: true } => ("beyond, warned", times),
        Verdict::Beyond { times, warned: false } => ("beyond", times),
    };
    let how = failed.as_deref().unwrap_or("").replace('"', "'");
    let words = warnings.join("; ").replace('"', "'");
    let _ = write!(text, ",\"{verdict}\",{times:.3},\"{how}\",\"{words}\"");
    text
}

/// Rows of scenes, and counts.
///
/// # Errors
/// As [`Outcome::of`].
pub fn many(backend: &dyn Backend, from: u64, count: u64) -> Result<String, VerifyError> {
    let numbers: Vec<u64> = (from..from.saturating_add(count)).collect();
    let scenes = Scenes::built_in();
    let mut text = format!("{HEADS}\n");
    let (mut ran, mut within, mut refused, mut outside, mut unknown) = (0, 0, 0, 0, 0);
    for outcome in Outcome::of_all(backend, &numbers)? {
        let line = line(&outcome, scenes);
        match outcome.verdict(scenes) {
            Verdict::Refused => refused += 1,
            Verdict::Outside => outside += 1,
            Verdict::Unknown => unknown += 1,
            Verdict::Within(_) => (ran, within) = (ran + 1, within + 1),
            Verdict::Beyond { .. } => {
                ran += 1;
                println!("{line}");
            }
        }
        text.push_str(&line);
        text.push('\n');
    }
    println!(
        "{count} scenes: {refused} refused, {outside} like no measured one, {unknown} like some that were stopped; of {ran} with \
         an interval {within} within it."
    );
    Ok(text)
}

/// Prints a scene and what became of it.
///
/// # Errors
/// As [`Outcome::of`].
pub fn one(backend: &dyn Backend, number: u64) -> Result<(), VerifyError> {
    let outcome = Outcome::of(backend, number)?;
    println!("{:#}", outcome.drawn.scene);
    if let End::Ran { expected, .. } = &outcome.end {
        println!("{expected:?}");
    }
    println!("{}", line(&outcome, Scenes::built_in()));
    Ok(())
}
