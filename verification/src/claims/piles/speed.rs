//! Speed: a timed exhibit.

use super::refused;
use crate::claim::VerifyError;
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::bench::grains::beds::{clumps, crystal, mixed};
use lahar::dem::neighbours::PairList;
use lahar::dem::{Dem, DemError, Integrator, Setup};
use lahar::solver::run::Backend;
use std::time::Instant;

/// Particle-steps.
pub const SPEED: Exhibit = Exhibit {
    id: "grains-speed",
    caption: "Speed of dense beds in which every sphere touches twelve others (six contacts per sphere) and every clump has \
              about eleven contacts. The machine was shared: CPU times are those of the process, ratios those of runs that took \
              turns.",
    timed: true,
    run: speed,
};

/// Times that settings take turns.
const ROUNDS: u32 = 4;

/// CPU seconds of this process, all threads (Linux; 0 elsewhere).
fn cpu() -> f64 {
    let text = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields: Vec<&str> = text.rsplit(')').next().unwrap_or("").split_whitespace().collect();
    let at = |k: usize| fields.get(k).and_then(|f| f.parse::<f64>().ok()).unwrap_or(0.0);
    (at(11) + at(12)) / 100.0
}

/// A run, the pool it uses, and the wall and CPU seconds spent on it.
struct Runner {
    dem: Dem,
    pool: rayon::ThreadPool,
    steps: u64,
    wall: f64,
    cpu: f64,
    done: u64,
}

impl Runner {
    fn new(setup: &Setup, threads: usize, particle_steps: f64) -> Result<Self, VerifyError> {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .map_err(|e| VerifyError::Numerics { what: "a pool of threads", detail: e.to_string() })?;
        let steps = (particle_steps / setup.grains.len() as f64).ceil().max(2.0) as u64;
        let mut dem = pool.install(|| Dem::new(setup)).map_err(refused)?;
        pool.install(|| dem.step(steps.div_ceil(8))).map_err(refused)?;
        Ok(Self { dem, pool, steps, wall: 0.0, cpu: 0.0, done: 0 })
    }

    fn turn(&mut self) -> Result<(), DemError> {
        let (t, c) = (Instant::now(), cpu());
        self.pool.install(|| self.dem.step(self.steps))?;
        self.wall += t.elapsed().as_secs_f64();
        self.cpu += cpu() - c;
        self.done += self.steps * self.dem.bodies().len() as u64;
        Ok(())
    }

    /// Nanoseconds per particle-step: wall, CPU.
    fn cost(&self) -> (f64, f64) {
        let each = 1e9 / self.done as f64;
        (self.wall * each, self.cpu * each)
    }
}

fn taking_turns(runs: &mut [Runner]) -> Result<(), VerifyError> {
    for _ in 0..ROUNDS {
        for r in runs.iter_mut() {
            r.turn().map_err(refused)?;
        }
    }
    Ok(())
}

fn speed(_: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let work = if full { 2e6 } else { 2e5 };
    Ok(ExhibitData {
        tables: vec![threads(full, work)?, sizes(full, work)?, integrators(work)?, ratios(full, work)?],
        ..ExhibitData::default()
    })
}

fn threads(full: bool, work: f64) -> Result<Table, VerifyError> {
    let mut table = Table::new(
        "Particle-steps per second",
        &[
            "bed",
            "bodies",
            "threads",
            "1e6 particle-steps/s (wall)",
            "CPU time [ns per particle-step]",
            "wall time, 1 thread over this",
        ],
    );
    let mut beds: Vec<(&str, Setup)> = vec![("spheres", crystal(14).map_err(refused)?)];
    if full {
        beds.push(("spheres", crystal(29).map_err(refused)?));
        beds.push(("tetrahedral clumps", clumps(22).map_err(refused)?));
    }
    for (name, setup) in beds {
        let mut runs = vec![Runner::new(&setup, 1, work)?, Runner::new(&setup, 2, work)?];
        taking_turns(&mut runs)?;
        let one = runs[0].cost().0;
        for (r, threads) in runs.iter().zip([1usize, 2]) {
            let (wall, cpu) = r.cost();
            table.push(vec![
                name.into(),
                r.dem.bodies().len().into(),
                threads.into(),
                (1e3 / wall).into(),
                cpu.into(),
                (one / wall).into(),
            ]);
        }
    }
    Ok(table)
}

fn sizes(full: bool, work: f64) -> Result<Table, VerifyError> {
    let mut table = Table::new(
        "Cost per sphere against their number, one thread",
        &["bodies", "CPU time [ns per particle-step]", "relative to the first"],
    );
    let cells: &[u32] = if full { &[14, 29, 63] } else { &[14, 20] };
    let mut runs = cells
        .iter()
        .map(|&k| Runner::new(&crystal(k).map_err(refused)?, 1, work.max(if k > 60 { 4e6 } else { 0.0 })))
        .collect::<Result<Vec<_>, VerifyError>>()?;
    taking_turns(&mut runs)?;
    let first = runs[0].cost().1;
    for r in &runs {
        let cpu = r.cost().1;
        table.push(vec![r.dem.bodies().len().into(), cpu.into(), (cpu / first).into()]);
    }
    Ok(table)
}

fn integrators(work: f64) -> Result<Table, VerifyError> {
    let mut table = Table::new(
        "Cost of the integrators, one thread",
        &["integrator", "CPU time [ns per particle-step]", "relative to Verlet"],
    );
    let kinds = [Integrator::Verlet, Integrator::Gear];
    let bed = crystal(14).map_err(refused)?;
    let mut runs = kinds
        .iter()
        .map(|&integrator| Runner::new(&Setup { integrator, ..bed.clone() }, 1, work))
        .collect::<Result<Vec<_>, VerifyError>>()?;
    taking_turns(&mut runs)?;
    let first = runs[0].cost().1;
    for (r, kind) in runs.iter().zip(kinds) {
        let cpu = r.cost().1;
        table.push(vec![format!("{kind:?}").into(), cpu.into(), (cpu / first).into()]);
    }
    Ok(table)
}

fn ratios(full: bool, work: f64) -> Result<Table, VerifyError> {
    let mut table = Table::new(
        "Dense beds with large spheres in them, one thread",
        &[
            "largest over smallest radius",
            "bodies",
            "contacts per body",
            "step, CPU time [ns per particle-step]",
            "making the list, CPU time [ns per particle]",
        ],
    );
    // Sizes of one kind of about as many bodies beside those of mixed sizes.
    let plain: &[u32] = if full { &[14, 26] } else { &[14] };
    let beds: &[(f64, u32)] = if full { &[(5.0, 18), (10.0, 2), (20.0, 2)] } else { &[(10.0, 2)] };
    let mut setups = Vec::new();
    for &k in plain {
        setups.push((1.0, crystal(k).map_err(refused)?));
    }
    for &(ratio, k) in beds {
        setups.push((ratio, mixed(ratio, k).map_err(refused)?));
    }
    let mut runs =
        setups.iter().map(|(_, s)| Runner::new(s, 1, work)).collect::<Result<Vec<_>, VerifyError>>()?;
    taking_turns(&mut runs)?;
    for (r, (ratio, s)) in runs.iter().zip(&setups) {
        let n = r.dem.bodies().len();
        let rounds = (work / 4.0 / n as f64).ceil() as u32;
        let start = cpu();
        let mut pairs = 0;
        r.pool.install(|| {
            for _ in 0..rounds {
                pairs += PairList::find(r.dem.members(), s.period.0, s.skin).pairs.len();
            }
        });
        let list = (cpu() - start) * 1e9 / (f64::from(rounds) * n as f64);
        let contacts = r.dem.pair_counts().1.min(pairs) as f64 / n as f64;
        table.push(vec![(*ratio).into(), n.into(), contacts.into(), r.cost().1.into(), list.into()]);
    }
    Ok(table)
}
