//! Run-out of collapsing columns against experiments.

use super::column::{Deposit, collapse};
use super::refused;
use super::support::{Matter, mean};
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::output::plot::{Axis, Plot, Series};
use lahar::solver::run::Backend;

/// Friction of the spheres.
const FRICTION: f64 = 0.5;
/// Mean diameters across a column.
const ACROSS: f64 = 10.0;
/// Seeds per column.
const SEEDS: u64 = 3;

/// Run-out.
pub const RUN_OUT: Claim = Claim {
    id: "piles-run-out",
    title: "Columns of spheres run out between two experiments up to a = 1, and 16 % beyond the farther one at a = 4",
    tags: &["D1", "D2", "D5", "000 Sec 2.1"],
    measures: "(L - L0)/L0 of a column with a plane of symmetry, 10 diameters wide and 4 deep (periodic), mean of three packings; \
               L by the farthest grain connected to the deposit",
    reference: Reference {
        source: "middle of two experiments in channels: Lajeunesse, Monnier & Homsy 2005, doi:10.1063/1.2087687: the lesser of 1.2 a \
                 and 1.9 a^(2/3); Lube, Huppert, Sparks & Freundt 2005, doi:10.1103/PhysRevE.72.041301: the lesser of 1.6 a and \
                 2.2 a^(2/3). Prefactors as commonly quoted, not compared with the papers' text",
        uncertainty: 0.14,
    },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "nominal height over width a", short: &[0.5], full: &[0.5, 1.0, 2.0, 4.0] },
    order: None,
    tolerance: Tolerance {
        value: 0.35,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "the experiments differ by 14 per cent to either side of their middle; the two definitions of the front differ by \
                  15 to 20 per cent in columns 10 diameters wide. Balmforth & Kerswell 2005, doi:10.1017/S0022112005005537, find the \
                  prefactor to depend on the material",
    },
    kind: Kind::Validation,
    measure: run_out,
};

/// All columns.
pub const COLUMNS: Exhibit = Exhibit {
    id: "piles-run-out-columns",
    caption: "Run-out against height over width: spheres without and with rolling resistance, 10 and 20 diameters across, beside \
              what two experiments found. Thickness: where the deposit becomes thinner than a radius.",
    timed: false,
    run: columns,
};

/// Lajeunesse et al. and Lube et al.
fn experiments(a: f64) -> [f64; 2] {
    let power = libm::cbrt(a * a);
    [(1.2 * a).min(1.9 * power), (1.6 * a).min(2.2 * power)]
}

struct Columns {
    aspect: f64,
    runout: (f64, f64),
    thin: f64,
    height: f64,
    first: Deposit,
    lost: f64,
    liveliest: f64,
}

fn several(matter: &Matter, across: f64, aspect: f64, seeds: u64) -> Result<Columns, VerifyError> {
    let all: Vec<Deposit> = (0..seeds)
        .map(|seed| collapse(matter, across, aspect, seed))
        .collect::<Result<_, _>>()
        .map_err(refused)?;
    let each = |f: fn(&Deposit) -> f64| mean(&all.iter().map(f).collect::<Vec<_>>());
    Ok(Columns {
        aspect: each(|d| d.aspect).0,
        runout: each(|d| d.runout),
        thin: each(|d| d.thin).0,
        height: each(|d| d.height).0,
        lost: each(|d| d.lost as f64).0,
        liveliest: all.iter().map(|d| d.liveliest).fold(0.0, f64::max),
        first: all[0].clone(),
    })
}

fn run_out(_: &dyn Backend, aspect: f64) -> Result<Sample, VerifyError> {
    let c = several(&Matter::spheres(FRICTION), ACROSS, aspect, SEEDS)?;
    let [low, high] = experiments(c.aspect);
    Ok(Sample::relative(aspect, c.runout.0, 0.5 * (low + high))
        .with("height over width a as settled", c.aspect)
        .with("standard error of the run-out", c.runout.1)
        .with("Lajeunesse et al.", low)
        .with("Lube et al.", high)
        .with("run-out by thickness", c.thin)
        .with("height of the deposit over L0", c.height)
        .with("grains", c.first.grains as f64)
        .with("single grains beyond the deposit", c.lost)
        .with("liveliest grain of the deposit [m g R]", c.liveliest)
        .with("time of rest [s]", c.first.time))
}

/// Run-out against slenderness in one of the two experiments.
fn experiment(k: usize, highest: f64) -> Vec<[f64; 2]> {
    let point = |i| {
        let a = highest * f64::from(i) / 40.0;
        [a, experiments(a)[k]]
    };
    (0..=40).map(point).collect()
}

fn columns(_: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let spheres = Matter::spheres(FRICTION);
    let rolling = Matter { rolling: 0.1, ..spheres };
    let tall: &[f64] = if full { RUN_OUT.ladder.full } else { RUN_OUT.ladder.short };
    let mut sets: Vec<(&str, Matter, f64, &[f64], u64)> = vec![("spheres", spheres, ACROSS, tall, SEEDS)];
    if full {
        sets.push(("spheres, rolling friction 0.1", rolling, ACROSS, &[0.5, 1.0, 2.0], SEEDS));
        sets.push(("spheres, 20 across", spheres, 20.0, &[0.5, 1.0], 2));
    }
    let mut table = Table::new(
        "Columns",
        &[
            "matter",
            "diameters across",
            "a",
            "run-out",
            "standard error",
            "run-out by thickness",
            "Lajeunesse et al.",
            "Lube et al.",
            "height of the deposit over L0",
        ],
    );
    let mut plot = Plot::new("Run-out of columns", Axis::linear("a", ""), Axis::linear("(L - L0)/L0", ""));
    let mut shapes = Plot::new("Deposits", Axis::linear("x / L0", ""), Axis::linear("h / L0", ""));
    for (name, matter, across, aspects, seeds) in sets {
        let mut points = Vec::new();
        for &aspect in aspects {
            let c = several(&matter, across, aspect, seeds)?;
            let [low, high] = experiments(c.aspect);
            points.push([c.aspect, c.runout.0]);
            table.push(vec![
                name.into(),
                across.into(),
                c.aspect.into(),
                c.runout.0.into(),
                c.runout.1.into(),
                c.thin.into(),
                low.into(),
                high.into(),
                c.height.into(),
            ]);
            if name == "spheres" {
                shapes = shapes.with(Series::line(format!("a = {:.2}", c.first.aspect), c.first.profile));
            }
        }
        plot = plot.with(Series::markers(name, points));
    }
    let highest = tall[tall.len() - 1];
    plot = plot
        .with(Series::reference("Lajeunesse et al. 2005", experiment(0, highest)))
        .with(Series::reference("Lube et al. 2005", experiment(1, highest)));
    Ok(ExhibitData { tables: vec![table], plots: vec![plot, shapes], ..ExhibitData::default() })
}
