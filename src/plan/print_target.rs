//! The section of `lahar plan --target-error`.

use std::fmt;

use super::target::{Answer, Covered, Quote};
use super::text::{row, short, significant};

impl fmt::Display for Quote {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "\nTarget error {}", percent(self.target_error))?;
        match &self.answer {
            Answer::NotCovered(why) => {
                row(f, "no recommendation", format_args!("{why}"))?;
                row(
                    f,
                    "way out",
                    format_args!("run two spacings and compare, or see REPORT.md, Work and precision"),
                )
            }
            Answer::Covered(covered) => section(f, covered),
        }
    }
}

fn section(f: &mut fmt::Formatter<'_>, c: &Covered) -> fmt::Result {
    row(f, "nearest flow of the table", format_args!("{}", c.nearest))?;
    for difference in &c.differences {
        row(f, "", format_args!("but {difference}"))?;
    }
    row(f, "error", format_args!("{}", c.error_is))?;
    let expected = match c.error_as_written {
        Some(error) if c.extrapolated => format!("{} expected, extrapolated", percent(error)),
        Some(error) => format!("{} expected", percent(error)),
        None => "this scheme is not in the table".to_owned(),
    };
    row(f, "as written", format_args!("{} {}: {expected}", short(c.cells), c.cells_are))?;
    let a = &c.advice;
    let what = if c.reached { "recommended" } else { "not reached; most exact" };
    // All digits: edges are whole multiples of it.
    let spacing = significant(a.spacing_m);
    row(f, what, format_args!("{} {}: a spacing of {spacing} m", short(a.cells), c.cells_are))?;
    let walls = a.wall_rule.map_or_else(String::new, |rule| format!(", `{rule}` walls"));
    row(f, "scheme", format_args!("`{}`{walls}", a.operator))?;
    let step = a.time_step_s.map_or_else(
        || "the law has no viscosity to derive it from".to_owned(),
        |dt| {
            format!(
                "{} s: plastic τ at most {}, speed and compression as above",
                short(dt),
                short(a.relaxation_time)
            )
        },
    );
    row(f, "time step", format_args!("{step}"))?;
    row(f, "error in the table", format_args!("{}", percent(a.error)))?;
    if let Some(updates) = a.cell_updates {
        row(f, "cell updates", format_args!("{}", short(updates)))?;
    }
    if let (Some(hours), Some(backend), Some(ns)) = (a.hours, &a.backend, a.nanoseconds_per_update) {
        let (date, machine) = (a.measured.as_deref().unwrap_or("–"), a.machine.as_deref().unwrap_or("–"));
        row(
            f,
            "expected time",
            format_args!(
                "{} hours on one thread, `{backend}` backend: {} ns per update on {date}, {machine}",
                short(hours),
                short(ns)
            ),
        )?;
    }
    Ok(())
}

fn percent(share: f64) -> String {
    format!("{} %", short(100.0 * share))
}
