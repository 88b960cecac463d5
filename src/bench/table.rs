//! The report as aligned text.

use std::fmt;

use super::cases::Quantity;
use super::grains::GrainSpeed;
use super::measure::{CaseSpeed, Ratio};
use super::{Report, Spread};
use crate::plan::memory::human;

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let machine = &self.machine;
        let cores = if machine.cores == 1 { "core" } else { "cores" };
        write!(f, "{}, {} {cores}", machine.processor, machine.cores)?;
        if let Some(cache) = machine.last_cache_bytes {
            write!(f, ", {} of last-level cache", human(cache))?;
        }
        if let Some(available) = machine.available_bytes {
            write!(f, ", {} of memory available", human(available))?;
        }
        writeln!(f)?;
        if self.quick {
            writeln!(f, "--quick: cases of about a tenth of their cells, short slices, smaller arrays")?;
        }
        if !self.bandwidth.is_empty() {
            bandwidth(f, self)?;
        }
        if !self.cases.is_empty() {
            cases(f, &self.cases)?;
        }
        if !self.grains.is_empty() {
            grains(f, &self.grains)?;
        }
        if !self.ratios.is_empty() {
            ratios(f, &self.ratios)?;
        }
        if !self.left_out.is_empty() {
            writeln!(f, "\nLeft out")?;
        }
        self.left_out.iter().try_for_each(|note| writeln!(f, "  {}: {}", note.because, note.cases.join(", ")))
    }
}

/// Rows of equally many cells; the first `left` columns are aligned to the left, the others to the right.
fn aligned(f: &mut fmt::Formatter<'_>, rows: &[Vec<String>], left: usize) -> fmt::Result {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let length = |text: &String| text.chars().count();
    let widths: Vec<usize> = (0..columns)
        .map(|c| rows.iter().filter_map(|row| row.get(c)).map(length).max().unwrap_or(0))
        .collect();
    for row in rows {
        let mut line = String::new();
        for (c, (text, &width)) in row.iter().zip(&widths).enumerate() {
            line += &if c < left { format!("  {text:<width$}") } else { format!("  {text:>width$}") };
        }
        writeln!(f, "{}", line.trim_end())?;
    }
    Ok(())
}

fn strings(cells: &[&str]) -> Vec<String> {
    cells.iter().map(|&cell| cell.to_owned()).collect()
}

fn bandwidth(f: &mut fmt::Formatter<'_>, report: &Report) -> fmt::Result {
    let size = human(report.array_bytes);
    writeln!(f, "\nBandwidth, GB/s, best and median, three arrays of {size}")?;
    let mut head = strings(&["kernel"]);
    let mut rows = Vec::new();
    for ceiling in &report.ceilings {
        head.extend([threads(ceiling.threads), "median".to_owned()]);
    }
    rows.push(head);
    for kernel in super::bandwidth::Kernel::ALL {
        let mut row = vec![kernel.name().to_owned()];
        for speed in report.bandwidth.iter().filter(|speed| speed.kernel == kernel) {
            row.extend([format!("{:.2}", speed.best_gb_per_s), format!("{:.2}", speed.median_gb_per_s)]);
        }
        rows.push(row);
    }
    let mut ceilings = strings(&["ceiling at 304 bytes, MLUPS"]);
    for ceiling in &report.ceilings {
        ceilings.extend([format!("{:.1}", ceiling.mlups), String::new()]);
    }
    rows.push(ceilings);
    aligned(f, &rows, 1)
}

fn threads(count: usize) -> String {
    if count == 1 { "1 thread".to_owned() } else { format!("{count} threads") }
}

fn cases(f: &mut fmt::Formatter<'_>, cases: &[CaseSpeed]) -> fmt::Result {
    writeln!(f, "\nCases: fluid cells, million updates per second (median and range), share of the ceiling")?;
    let head = [
        "case", "backend", "threads", "box", "fluid", "MLUPS", "range", "ns", "ceiling", "B/cell", "plan",
        "yielded",
    ];
    let mut rows = vec![strings(&head)];
    for case in cases {
        let [nx, ny, nz] = case.extents;
        let yielded = case.yielded.map_or_else(String::new, |y| {
            format!("{:.1} %{}", 100.0 * y.share, if y.of_twin { " (48³)" } else { "" })
        });
        rows.push(vec![
            case.name.to_owned(),
            case.backend.to_owned(),
            case.threads.to_string(),
            format!("{nx}×{ny}×{nz}"),
            case.fluid_cells.to_string(),
            format!("{:.2}", case.mlups.median),
            range(&case.mlups),
            format!("{:.1}", case.ns_per_update),
            format!("{:.1} %", 100.0 * case.share_of_ceiling),
            format!("{:.0}", case.bytes_per_fluid_cell),
            format!("{:.0}", case.predicted_bytes_per_fluid_cell),
            yielded,
        ]);
    }
    aligned(f, &rows, 2)?;
    for case in cases.iter().filter(|case| !case.passes.is_empty()) {
        let passes: Vec<String> =
            case.passes.iter().map(|(name, share)| format!("{name} {:.0} %", 100.0 * share)).collect();
        writeln!(f, "  {} on {} × {}: {}", case.name, case.backend, case.threads, passes.join(", "))?;
    }
    Ok(())
}

fn grains(f: &mut fmt::Formatter<'_>, grains: &[GrainSpeed]) -> fmt::Result {
    writeln!(f, "\nDry grains: million grains stepped per second (median and range)")?;
    let head = [
        "case", "threads", "grains", "spheres", "M/s", "range", "ns", "touching", "listed", "steps", "lists",
    ];
    let mut rows = vec![strings(&head)];
    for case in grains {
        rows.push(vec![
            case.name.to_owned(),
            case.threads.to_string(),
            case.grains.to_string(),
            case.spheres.to_string(),
            format!("{:.3}", case.million_per_second.median),
            range(&case.million_per_second),
            format!("{:.0}", case.ns_per_update),
            format!("{:.2}", case.contacts_per_grain),
            format!("{:.2}", case.listed_per_grain),
            case.steps.to_string(),
            case.lists.to_string(),
        ]);
    }
    aligned(f, &rows, 1)
}

fn range(spread: &Spread) -> String {
    format!("{:.2}–{:.2}", spread.low, spread.high)
}

fn ratios(f: &mut fmt::Formatter<'_>, ratios: &[Ratio]) -> fmt::Result {
    writeln!(f, "\nRatios, from slices of the same turn: median and range")?;
    let mut rows = vec![strings(&["ratio", "group", "of", "backend", "threads", "median", "range"])];
    for ratio in ratios {
        let of = match ratio.quantity {
            Quantity::Rate => "updates per second",
            Quantity::TimePerUpdate => "time per update",
            Quantity::TimePerStep => "time per step",
            Quantity::Bytes => "bytes",
        };
        rows.push(vec![
            ratio.name.clone(),
            ratio.group.to_owned(),
            of.to_owned(),
            ratio.backend.clone(),
            ratio.threads.clone(),
            format!("{:.3}", ratio.ratio.median),
            format!("{:.3}–{:.3}", ratio.ratio.low, ratio.ratio.high),
        ]);
    }
    aligned(f, &rows, 4)
}
