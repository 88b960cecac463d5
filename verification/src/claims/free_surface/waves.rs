//! Small waves on viscous films: their speed on an incline, their decay on level ground.

use core::f64::consts::TAU;

use super::support::ledger;
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::exact::film_wave::FilmWave;
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Face, FreeSurface, Setup};
use lahar::solver::run::{Backend, Run};

/// Wave length over depth: kh = 0.79, where both formulas are far from their long-wave limits.
const LENGTH: f64 = 8.0;

/// τ = 3: with the pressure below, inertia alters the decay by some 2e-3.
const VISCOSITY: f64 = 5.0 / 6.0;

/// 3 F h in the direction of the bed: density at the bed, and what the decay owes to compression.
const PRESSURE: f64 = 0.0025;

/// Amplitude over depth. Quadratic terms shift phase and amplitude by its square.
const AMPLITUDE: f64 = 0.02;

/// A wave; `tangent`: of the slope.
fn wave(depth: f64, tangent: f64) -> FilmWave {
    let down = PRESSURE / (3.0 * depth);
    let length = (LENGTH * depth).round();
    FilmWave { depth, wave_number: TAU / length, viscosity: VISCOSITY, along: tangent * down, down }
}

fn setup(wave: &FilmWave) -> Setup {
    let cells = (TAU / wave.wave_number).round() as usize;
    let height = libm::ceil(wave.depth * (1.0 + AMPLITUDE)) as usize + 2;
    let mut setup = Setup::periodic([cells, 1, height], Law::Newtonian { mu: wave.viscosity });
    setup.faces[2] = [Face::NoSlip; 2];
    setup.force = BodyForce::Constant([wave.along, 0.0, -wave.down]);
    // Mean height over the cell, exact for the sine.
    let (k, shape) = (wave.wave_number, libm::sin(0.5 * wave.wave_number) / (0.5 * wave.wave_number));
    let surface = |i: usize| wave.depth * (1.0 + AMPLITUDE * shape * libm::cos(k * (i as f64 + 0.5)));
    let fill = (0..setup.cells()).map(|cell| {
        let [i, _, z] = setup.coordinates(cell);
        (surface(i) - z as f64).clamp(0.0, 1.0)
    });
    setup.free_surface = Some(FreeSurface::new(fill.collect()));
    setup
}

/// ∫ h e^(−ikx): amplitude and phase of the wave.
fn mode(run: &dyn Run, k: f64) -> (f64, f64) {
    let (mut re, mut im) = (0.0, 0.0);
    for (cell, fill) in run.fields().fill.iter().enumerate() {
        let x = run.setup().coordinates(cell)[0] as f64 + 0.5;
        re += fill * libm::cos(k * x);
        im += fill * libm::sin(k * x);
    }
    (libm::sqrt(re * re + im * im), libm::atan2(im, re))
}

/// Amplitudes, and phases without jumps, at equal times over `steps` after a tenth of it.
fn history(backend: &dyn Backend, wave: &FilmWave, steps: f64) -> Result<Watched, VerifyError> {
    const MARKS: u64 = 24;
    let interval = (steps / MARKS as f64).round() as u64;
    let mut run = backend.start(&setup(wave))?;
    run.advance(2 * interval)?;
    let mut points: Vec<[f64; 3]> = Vec::new();
    for mark in 0..MARKS {
        run.advance(interval)?;
        let (amplitude, mut phase) = mode(run.as_ref(), wave.wave_number);
        if let Some(&[_, last, _]) = points.last() {
            phase += TAU * ((last - phase) / TAU).round();
        }
        points.push([(mark * interval) as f64, phase, libm::log(amplitude)]);
    }
    let end = ledger(run.as_ref());
    Ok(Watched { points, conversions: end.conversions, residual: end.mass_residual })
}

struct Watched {
    /// Time, phase, ln of the amplitude.
    points: Vec<[f64; 3]>,
    conversions: u64,
    residual: f64,
}

impl Watched {
    /// Slope of the least-squares line of a column over time.
    fn slope(&self, column: usize) -> f64 {
        let n = self.points.len() as f64;
        let mean = |c: usize| self.points.iter().map(|p| p[c]).sum::<f64>() / n;
        let (t, y) = (mean(0), mean(column));
        let up: f64 = self.points.iter().map(|p| (p[0] - t) * (p[column] - y)).sum();
        let square: f64 = self.points.iter().map(|p| (p[0] - t) * (p[0] - t)).sum();
        up / square
    }

    fn sample(&self, sample: Sample) -> Sample {
        sample.with("conversions", self.conversions as f64).with("mass residual", self.residual.abs())
    }
}

/// On 20 degrees, over half a wave length.
fn speed(backend: &dyn Backend, depth: f64) -> Result<Sample, VerifyError> {
    let wave = wave(depth, libm::tan(20.0 * core::f64::consts::PI / 180.0));
    let expected = wave.phase_velocity();
    let steps = 0.5 * TAU / (wave.wave_number * expected);
    let watched = history(backend, &wave, steps)?;
    let found = watched.slope(1) / wave.wave_number;
    let decay = -watched.slope(2) / wave.decay_rate();
    Ok(watched.sample(Sample::relative(depth, found, expected)).with("decay over the exact one", decay))
}

/// On level ground, until a fraction 1/e is left.
fn levelling(backend: &dyn Backend, depth: f64) -> Result<Sample, VerifyError> {
    let wave = wave(depth, 0.0);
    let expected = wave.decay_rate();
    let watched = history(backend, &wave, 1.0 / expected)?;
    Ok(watched.sample(Sample::relative(depth, -watched.slope(2), expected)))
}

const LADDER: Ladder = Ladder {
    parameter: "h (cells)",
    short: &[8.0, 8.25, 8.5, 8.75],
    full: &[5.5, 8.0, 8.25, 8.5, 8.75, 12.0, 12.5, 16.0, 16.25, 16.5, 16.75],
};

/// Speed of a wave.
pub const SPEED: Claim = Claim {
    id: "film-wave-speed",
    title: "A small wave on a viscous film runs at its speed, wherever the surface lies within a cell",
    tags: &["F1", "F2", "F3", "F9"],
    measures: "phase velocity of a wave of 8 depths and an amplitude of 0.02 depths on 20 degrees, relative",
    reference: Reference {
        source: "u_s [1 + 1/(cosh² kh + (kh)²)], Yih 1963, Phys. Fluids 6, 321",
        uncertainty: 2e-3,
    },
    metric: Metric::Relative,
    ladder: LADDER,
    order: None,
    tolerance: Tolerance {
        value: 0.02,
        at: Rung::Every,
        basis: Basis::Reference,
        because: "the aim for a film of 8 cells; a wave of 0.16 cells within one layer of cells and one that crosses a cell \
                  face see different exchange rules, and ran at −24 and +270 % with shares that are mean fills",
    },
    kind: Kind::Verification,
    measure: speed,
};

/// Decay of a wave.
pub const LEVELLING: Claim = Claim {
    id: "film-levelling",
    title: "A wavy viscous layer levels at its rate, wherever the surface lies within a cell",
    tags: &["F1", "F2", "F3", "F9"],
    measures: "decay rate of a wave of 8 depths and an amplitude of 0.02 depths on level ground, relative",
    reference: Reference {
        source: "(F/2μk) (sinh kh cosh kh − kh)/(cosh² kh + (kh)²), Orchard 1962, Appl. Sci. Res. A 11, 451",
        uncertainty: 4e-3,
    },
    metric: Metric::Relative,
    ladder: LADDER,
    order: None,
    tolerance: Tolerance {
        value: 0.05,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "the gas acts at the middle of the interface cell whatever its fill: half a cell of 8 times the part of the \
                  pressure that does not follow the fill; +2 to −4 % within a cell, half of it at 16 cells",
    },
    kind: Kind::Verification,
    measure: levelling,
};
