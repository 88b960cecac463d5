//! The section of `lahar plan --target-error`.

use std::fmt;

use super::expected::Interval;
use super::swept::Swept;
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
            Answer::Swept(swept) => by_scenes(f, swept),
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
        Some(error) => format!("{} expected", percent(error)),
        None => "outside of the table".to_owned(),
    };
    row(f, "as written", format_args!("{} {}: {expected}", short(c.cells), c.cells_are))?;
    let a = &c.advice;
    let what = if c.reached { "recommended" } else { "not reached; most exact" };
    row(f, what, format_args!("{} {}: {}", short(a.cells), c.cells_are, spacing(a.spacing_m, a.size_m)))?;
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
    intervals(f, "error of scenes like it", &c.expected)?;
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

/// What random scenes say.
fn by_scenes(f: &mut fmt::Formatter<'_>, s: &Swept) -> fmt::Result {
    row(f, "table of work and precision", format_args!("{}", s.why))?;
    intervals(f, "as written", &s.as_written)?;
    let what = if s.reached { "recommended" } else { "not reached; finest tried" };
    row(f, what, format_args!("{}", spacing(s.spacing_m, s.size_m)))?;
    row(f, "time step", format_args!("{} s, as `plan` chooses it", short(s.time_step_s)))?;
    intervals(f, "error of scenes like it", &s.expected)?;
    row(f, "cell updates", format_args!("{}", short(s.cell_updates)))
}

/// With all digits: edges are whole multiples of it.
fn spacing(spacing_m: f64, size_m: [f64; 3]) -> String {
    let [x, y, z] = size_m.map(significant);
    format!("a spacing of {} m in a box of [{x}, {y}, {z}] m", significant(spacing_m))
}

fn intervals(f: &mut fmt::Formatter<'_>, name: &str, intervals: &[Interval]) -> fmt::Result {
    for (k, interval) in intervals.iter().enumerate() {
        let name = if k == 0 { name } else { "" };
        row(f, name, format_args!("{} {interval}", interval.of))?;
    }
    Ok(())
}

fn percent(share: f64) -> String {
    format!("{} %", short(100.0 * share))
}
