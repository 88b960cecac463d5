//! What single precision costs in accuracy.
//!
//! # Where rounding takes over
//! A population f − w of a slow flow is as large as its share of the momentum, w·3 c·u, so that storing it
//! moves the momentum of a cell by at most ε Σ|c||f − w| = ε u per step, ε = 2⁻²⁴ = 6e-8. Such a step is a
//! spurious body force; if it never changed sign, a channel of N cells and viscosity ν would answer with
//! ε u N²/(8ν), as it answers a force with F N²/(8ν). That is the floor below: a bound, because roundings of
//! neighbouring cells and steps rarely agree. Arithmetic in f32 rounds on the way as well
//! ([`Precision::roundings`]).

use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::claims::film::support::flow;
use crate::claims::poiseuille::channel::{BINGHAM, Column, THESIS};
use crate::claims::viscosity::vortices::flat;
use crate::exact::flow_curve::FlowCurve;
use crate::exhibit::{Entry, Exhibit, ExhibitData, Table};
use lahar::plan::work::{Case, Operator, Scheme, Walls};
use lahar::rheology::Law;
use lahar::setup::{Face, Precision, Setup};
use lahar::solver::fast::Fast;
use lahar::solver::run::{Backend, Run, StartError};

use super::flows::SPEED;
use super::trial::Trial;

/// The shorter precisions.
const SHORTER: [Precision; 2] = [Precision::SingleStorage, Precision::Single];

/// A backend that is asked for another precision than the set-up's.
struct In<'a> {
    precision: Precision,
    backend: &'a dyn Backend,
}

impl<'a> In<'a> {
    /// The plain backend has double precision only; the fast one is the same in all else.
    fn new(precision: Precision, backend: &'a dyn Backend) -> Self {
        static FAST: Fast = Fast { instructions: None };
        let plain = backend.name() == "plain" && precision != Precision::Double;
        Self { precision, backend: if plain { &FAST } else { backend } }
    }
}

impl Backend for In<'_> {
    fn name(&self) -> &'static str {
        self.backend.name()
    }
    fn start(&self, setup: &Setup) -> Result<Box<dyn Run>, StartError> {
        self.backend.start(&Setup { precision: self.precision, ..setup.clone() })
    }
}

/// The default scheme.
fn trial(case: Case, n: f64) -> Trial {
    let walls = if case == Case::Vortex { Walls::None } else { Walls::Independent };
    Trial { case, scheme: Scheme { operator: Operator::CentralMoment, walls }, n, step: 1.0 }
}

/// N²/8 over the least tangent viscosity.
fn amplification(column: &Column) -> Result<f64, VerifyError> {
    let exact = column.exact()?;
    Ok((column.n * column.n) as f64 / 8.0 * exact.law.rate_slope(exact.wall_stress()))
}

/// u across a channel, five relaxation times after it was started from the exact profile.
fn channel(backend: &dyn Backend, column: &Column) -> Result<Vec<f64>, VerifyError> {
    let mut run = backend.start(&column.developed()?)?;
    run.advance((5.0 * column.relaxation_steps()?).ceil() as u64)?;
    Ok(run.fields().velocity.iter().map(|u| u[0]).collect())
}

/// The worse of the two precisions, each over its floor, and both differences.
fn worse(parameter: f64, parts: [(Precision, f64, f64); 2]) -> Sample {
    let mut worst = Sample::absolute(parameter, 0.0, 0.0);
    for (_, difference, floor) in parts {
        // A NaN must not be passed over, whichever comes first.
        if worst.error.is_nan() || difference / floor <= worst.error {
            continue;
        }
        worst = Sample { error: difference / floor, ..Sample::absolute(parameter, difference, floor) };
    }
    for (precision, difference, floor) in parts {
        let name = precision.name();
        worst = worst.with(&format!("difference, {name}"), difference).with(&format!("floor, {name}"), floor);
    }
    worst
}

fn newtonian(backend: &dyn Backend, n: f64) -> Result<Sample, VerifyError> {
    let column = Column::unit(n as usize, &Law::Newtonian { mu: 0.2 }, 1.0, SPEED);
    let (exact, factor) = (column.reference()?, amplification(&column)?);
    let mut parts =
        SHORTER.map(|precision| (precision, 0.0, precision.roundings() * precision.rounding() * factor));
    for (precision, error, _) in &mut parts {
        *error = Sample::l2(n, &channel(&In::new(*precision, backend), &column)?, &exact).error;
    }
    let double = channel(&In::new(Precision::Double, backend), &column)?;
    Ok(worse(n, parts).with("error, double", Sample::l2(n, &double, &exact).error))
}

const FLOOR: Reference = Reference {
    source: "one rounding of each stored population per step (2⁻²⁴), thirteen where the arithmetic is in f32 too, taken \
             as a body force that never changes sign: 2⁻²⁴ N²/(8ν) of the velocity",
    uncertainty: 0.0,
};

/// Where the scheme is exact, all of the error is rounding.
pub const CHANNEL: Claim = Claim {
    id: "single-precision-channel",
    title: "Single precision leaves a Newtonian channel within 2⁻²⁴ N²/(8ν) per rounding of the exact parabola",
    tags: &["L7", "B3"],
    measures: "relative L2 error of the velocity after five relaxation times, over its floor, the worse of f32 stored \
               and f32 throughout; ν = 0.2, u = 10⁻³ (in double precision the scheme is exact)",
    reference: FLOOR,
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "N (cells across)",
        short: &[16.0, 32.0, 64.0],
        full: &[16.0, 32.0, 64.0, 128.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 1.0,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "the floor is a bound: no more roundings than are counted, and none that helps another more than if all \
                  had one sign",
    },
    kind: Kind::Verification,
    measure: newtonian,
};

/// What a backend makes of a flow.
type Flow = Box<dyn Fn(&dyn Backend) -> Result<Vec<f64>, VerifyError>>;

/// How far a run in single precision is from one in double precision.
fn flows(backend: &dyn Backend, number: f64) -> Result<Sample, VerifyError> {
    let case = [Case::ChannelBingham, Case::ChannelHerschelBulkley, Case::Vortex, Case::FilmBingham]
        [(number as usize).min(3)];
    let (run, factor): (Flow, f64) = match case {
        Case::Vortex => {
            let n = 32.0;
            let (flow, setup) = trial(case, n).vortex_setup();
            let steps = (core::f64::consts::LN_2 / flow.decay_rate()).round() as u64;
            let run = move |backend: &dyn Backend| {
                let mut run = backend.start(&setup)?;
                run.advance(steps)?;
                Ok(flat(run.fields().velocity))
            };
            // A force acts for as many steps as it takes the flow to halve, on a flow that halves.
            (Box::new(run), 2.0 * steps as f64)
        }
        Case::FilmBingham => {
            let trial = trial(case, 16.0);
            let sheet = trial.sheet(16.5);
            let film = sheet.exact();
            let slope = film.law.rate_slope(film.force() * sheet.depth);
            let (setup, depth) = (trial.film_setup(&sheet), sheet.depth);
            let across = 2.0 * depth / core::f64::consts::PI;
            let steps = (6.0 * across * across * slope).ceil() as u64;
            let run = move |backend: &dyn Backend| {
                let mut run = backend.start(&setup)?;
                run.advance(steps)?;
                Ok(vec![flow(run.as_ref()).flux()])
            };
            // Half a channel of twice the depth.
            (Box::new(run), 0.5 * depth * depth * slope)
        }
        _ => {
            let law = if case == Case::ChannelBingham { BINGHAM } else { THESIS };
            let column = Column::unit(32, &law, 1.0, SPEED);
            let factor = amplification(&column)?;
            (Box::new(move |backend: &dyn Backend| channel(backend, &column)), factor)
        }
    };
    let double = run(&In::new(Precision::Double, backend))?;
    let mut parts =
        SHORTER.map(|precision| (precision, 0.0, precision.roundings() * precision.rounding() * factor));
    for (precision, difference, _) in &mut parts {
        *difference = Sample::l2(number, &run(&In::new(*precision, backend))?, &double).error;
    }
    Ok(worse(number, parts))
}

/// Where the scheme has an error of its own, rounding adds no more than that.
pub const FLOWS: Claim = Claim {
    id: "single-precision-flows",
    title: "In yield-stress channels, vortices and a film single precision changes no more than its roundings can",
    tags: &["L7", "Y3", "F1"],
    measures: "relative L2 difference from double precision over its floor, the worse of f32 stored and f32 throughout: \
               velocities of a Bingham (0) and a Herschel-Bulkley (1) channel of 32 cells and of vortices of 32 cells (2), \
               discharge of a Bingham film of 16.5 cells (3)",
    reference: FLOOR,
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "flow (its number)",
        short: &[0.0, 1.0, 2.0, 3.0],
        full: &[0.0, 1.0, 2.0, 3.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 1.0,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "the floor with the least tangent viscosity, at the wall; for the vortices the sum over the steps it takes \
                  them to halve, relative to what is left; for the film with H²/2 in place of N²/8",
    },
    kind: Kind::Verification,
    measure: flows,
};

/// Steps of the cavity.
const CAVITY_STEPS: u64 = 10_000;
/// Speed of its lid.
const LID: f64 = 0.05;

/// A closed box of n × n cells under a lid that slides.
fn cavity(n: usize) -> Setup {
    let mut setup = Setup::periodic([n, n, 1], Law::Newtonian { mu: 0.05 });
    setup.faces[0] = [Face::NoSlip; 2];
    setup.faces[1] = [Face::NoSlip, Face::Moving([LID, 0.0, 0.0])];
    setup
}

/// |Σ(ρ − 1)| over the cells after ten thousand steps.
fn drift(backend: &dyn Backend, setup: &Setup) -> Result<f64, VerifyError> {
    let mut run = backend.start(setup)?;
    run.advance(CAVITY_STEPS)?;
    Ok(run.totals().mass_excess.abs() / setup.cells() as f64)
}

fn mass(backend: &dyn Backend, n: f64) -> Result<Sample, VerifyError> {
    let setup = cavity(n as usize);
    let wandering = LID * (CAVITY_STEPS as f64 / setup.cells() as f64).sqrt();
    let mut parts = SHORTER
        .map(|precision| (precision, 0.0, precision.roundings().sqrt() * precision.rounding() * wandering));
    for (precision, difference, _) in &mut parts {
        *difference = drift(&In::new(*precision, backend), &setup)?;
    }
    let double = drift(&In::new(Precision::Double, backend), &setup)?;
    Ok(worse(n, parts).with("drift, double", double))
}

/// Mass of a closed box.
pub const MASS: Claim = Claim {
    id: "single-precision-mass",
    title: "In ten thousand steps in single precision the mass of a closed cavity wanders by less than 2·10⁻⁸ of itself",
    tags: &["L7", "F5"],
    measures: "|Σ(ρ − 1)| per cell after 10⁴ steps over its floor, the worse of f32 stored and f32 throughout; lid speed 0.05",
    reference: Reference {
        source: "a random walk of one rounding of each stored population per cell and step, 2⁻²⁴ of Σ|f − w| ≤ u, thirteen \
                 where the arithmetic is in f32 too: the root of steps times roundings over cells",
        uncertainty: 0.0,
    },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "N (cells across)", short: &[16.0, 24.0], full: &[16.0, 24.0, 48.0] },
    order: None,
    tolerance: Tolerance {
        value: 1.0,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "a rounding has a standard deviation of 1/√3 of its largest value and most cells are slower than a quarter of \
                  the lid: seven standard deviations. Roundings of one sign would give √(steps × cells) = 1600 and more \
                  times as much; in a flow that has become steady the same populations come back and nothing drifts",
    },
    kind: Kind::Verification,
    measure: mass,
};

/// Errors in three precisions.
pub const ERRORS: Exhibit = Exhibit {
    id: "single-precision-errors",
    caption: "Error against the exact solution with populations in f64, stored in f32, and in f32 throughout, with the \
              default scheme and standard time step, and the floor of rounding per rounding, 2⁻²⁴ N²/(8ν) (channels), \
              2⁻²⁴ H²/(2ν) (films): single precision serves as long as the error wanted lies above it.",
    timed: false,
    run: errors,
};

fn errors(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let columns =
        ["flow", "N", "error, double", "error, single_storage", "error, single", "floor per rounding"];
    let mut table = Table::new("Error by precision", &columns);
    let cases: [(Case, &[f64]); 6] = [
        (Case::ChannelNewtonian, &[16.0, 32.0, 64.0, 128.0]),
        (Case::ChannelBingham, &[16.0, 32.0, 64.0, 128.0]),
        (Case::ChannelHerschelBulkley, &[16.0, 32.0, 64.0]),
        (Case::Vortex, &[16.0, 32.0, 64.0, 128.0]),
        (Case::FilmNewtonian, &[8.0, 16.0, 32.0]),
        (Case::FilmBingham, &[8.0, 16.0, 32.0]),
    ];
    for (case, sizes) in cases {
        let sizes = if full { sizes } else { &sizes[..2] };
        for &n in sizes {
            let trial = trial(case, n);
            let mut row: Vec<Entry> = vec![case.name().into(), n.into()];
            for precision in [Precision::Double, Precision::SingleStorage, Precision::Single] {
                match trial.run(&In::new(precision, backend), 1e9) {
                    Ok(outcome) => row.push(outcome.error.into()),
                    Err(error) => row.push(error.to_string().into()),
                }
            }
            let nu = (trial.tau() - 0.5) / 3.0;
            let factor = match case {
                Case::FilmNewtonian | Case::FilmBingham => 0.5 * n * n / nu,
                Case::Vortex => {
                    2.0 * core::f64::consts::LN_2 * n * n
                        / (2.0 * core::f64::consts::TAU * core::f64::consts::TAU * nu)
                }
                _ => 0.125 * n * n / nu,
            };
            row.push((Precision::Single.rounding() * factor).into());
            table.push(row);
        }
    }
    let mut data = ExhibitData::default();
    data.tables.push(table);
    data.notes.push(
        "In `single` up to thirteen numbers as large as the momentum are rounded per step; they rarely agree in sign, and \
         errors stay well below the floor. Runs end when their error stays within a tenth of what it becomes, which alone \
         makes errors differ by up to a tenth."
            .to_owned(),
    );
    Ok(data)
}
