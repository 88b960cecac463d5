//! The flows: set-ups, references, and what one run gives.

use std::sync::Arc;

use crate::claim::{Sample, VerifyError};
use crate::claims::film::support::{SLOPE, Sheet, flow};
use crate::claims::poiseuille::channel::{BINGHAM, Column, THESIS};
use crate::claims::poiseuille::clamped::lagged;
use crate::exact::film::Film;
use crate::exact::flow_curve::FlowCurve;
use crate::exact::taylor_green::{Plane, TaylorGreen2d};
use lahar::plan::work::{Case, Operator, Point, Walls};
use lahar::rheology::Law;
use lahar::setup::{FlowPoint, Setup, WallRule, YieldTreatment};
use lahar::solver::run::{Backend, Run};

use super::releases;
use super::steady::until_it_stays;
use super::trial::{Outcome, Trial, over, put};
use crate::claims::viscosity::vortices::{centre, flat, vortex_setup};

/// Lattice velocity of the channels: no error from compressibility.
pub(super) const SPEED: f64 = 1e-3;

impl Trial {
    /// τ of the plastic viscosity; for Herschel-Bulkley fluids that of the apparent one without yield
    /// stress at the largest shear rate.
    pub fn tau(&self) -> f64 {
        let nu = match self.case {
            // Steady: the channels' viscosity is the one of the law at half-width and wall stress 1.
            Case::ChannelNewtonian | Case::ChannelBingham => 0.2 * self.step,
            Case::ChannelHerschelBulkley => {
                let rate = THESIS.rate(1.0);
                0.5 / rate * self.step
            }
            Case::Vortex => VORTEX_NU * self.step,
            Case::FilmNewtonian | Case::FilmBingham | Case::FilmHerschelBulkley => {
                let sheet = self.sheet(self.n);
                let rate = sheet.exact().law.rate(sheet.exact().force() * sheet.depth);
                plastic(&sheet.law, rate)
            }
            Case::Slump => releases::heap(self.step).viscosity(self.n),
            Case::DamBreak => releases::block(self.n, self.step).viscosity,
        };
        0.5 + 3.0 * nu
    }

    /// The run as the table shows it.
    pub fn point(&self, outcome: Outcome) -> Point {
        let Self { case, scheme, n, step } = *self;
        let Outcome { error, steps, updates } = outcome;
        Point { case, scheme, n, step, tau: self.tau(), error, steps, updates }
    }

    /// Runs it, within a budget of cell updates.
    ///
    /// # Errors
    /// The backend refuses, a guard stops the run, or the budget does not suffice.
    pub fn run(&self, backend: &dyn Backend, budget: f64) -> Result<Outcome, VerifyError> {
        match self.case {
            Case::ChannelNewtonian | Case::ChannelBingham | Case::ChannelHerschelBulkley => {
                self.channel(backend, budget)
            }
            Case::Vortex => self.vortex(backend, budget),
            Case::FilmNewtonian | Case::FilmBingham | Case::FilmHerschelBulkley => self.film(backend, budget),
            Case::Slump => releases::slump(self, backend, budget),
            Case::DamBreak => releases::dam_break(self, backend, budget),
        }
    }

    /// A wide version of the flow, in full motion: what speeds are measured on.
    pub fn wide(&self) -> Result<Setup, VerifyError> {
        const ACROSS: usize = 16;
        let mut setup = match self.case {
            Case::ChannelNewtonian | Case::ChannelBingham | Case::ChannelHerschelBulkley => {
                let mut setup = self.column().developed()?;
                put_collision(&mut setup, self);
                setup
            }
            Case::Vortex => self.vortex_setup().1,
            Case::FilmNewtonian | Case::FilmBingham | Case::FilmHerschelBulkley => self.wide_film(ACROSS),
            Case::Slump => releases::slump_setup(self),
            Case::DamBreak => releases::wide_dam(self, ACROSS),
        };
        match self.case {
            Case::ChannelNewtonian | Case::ChannelBingham | Case::ChannelHerschelBulkley => {
                setup.extents = [2 * ACROSS, setup.extents[1], ACROSS];
            }
            Case::Vortex => setup.extents[2] = ACROSS,
            _ => {}
        }
        Ok(setup)
    }

    fn law(&self) -> Law {
        match self.case {
            Case::ChannelBingham => BINGHAM,
            Case::ChannelHerschelBulkley => THESIS,
            _ => Law::Newtonian { mu: 0.2 },
        }
    }

    fn column(&self) -> Column {
        let (n, law) = (self.n as usize, self.law());
        let wall = match self.scheme.walls {
            Walls::HalfWay => WallRule::HalfWay,
            Walls::Independent | Walls::None => WallRule::ViscosityIndependent,
        };
        if self.scheme.operator == Operator::LaggedClamp {
            lagged(n, &law, 1.5, self.step, SPEED)
        } else {
            Column { wall, ..Column::unit(n, &law, self.step, SPEED) }
        }
    }

    /// From rest to the steady profile.
    fn channel(&self, backend: &dyn Backend, budget: f64) -> Result<Outcome, VerifyError> {
        let column = self.column();
        let ideal = Column { yielding: YieldTreatment::Exact, ..column };
        let reference = ideal.reference()?;
        let mut setup = column.setup();
        put_collision(&mut setup, self);
        let error = |run: &dyn Run| {
            let u: Vec<f64> = run.fields().velocity.iter().map(|u| u[0]).collect();
            Sample::l2(0.0, &u, &reference).error
        };
        until_it_stays(backend, &setup, ideal.relaxation_steps()?, budget, &error)
    }

    /// The vortices and their set-up.
    pub(super) fn vortex_setup(&self) -> (TaylorGreen2d, Setup) {
        let k = core::f64::consts::TAU / self.n;
        let flow = TaylorGreen2d {
            plane: Plane::Xy,
            amplitude: 1.6 / self.n * self.step,
            wave_numbers: [k, k],
            nu: VORTEX_NU * self.step,
            density: 1.0,
            mean_flow: [0.0; 3],
        };
        let mut setup = vortex_setup(flow, self.n as usize);
        put(self.scheme, flow.nu, &mut setup);
        (flow, setup)
    }

    fn vortex(&self, backend: &dyn Backend, budget: f64) -> Result<Outcome, VerifyError> {
        let (flow, setup) = self.vortex_setup();
        let steps = (core::f64::consts::LN_2 / flow.decay_rate()).round() as u64;
        let updates = steps as f64 * setup.cells() as f64;
        if updates > budget {
            return Err(over(steps));
        }
        let mut run = backend.start(&setup)?;
        run.advance(steps)?;
        let t = steps as f64;
        let exact = flat((0..setup.cells()).map(|cell| flow.velocity(centre(setup.coordinates(cell)), t)));
        let error = Sample::l2(0.0, &flat(run.fields().velocity), &exact).error;
        Ok(Outcome { error, steps, updates })
    }

    /// A film of this many cells, at the time step of this trial.
    pub(super) fn sheet(&self, depth: f64) -> Sheet {
        const DRIVE: f64 = 0.04;
        let gravity = DRIVE / (depth * depth * depth) * self.step * self.step;
        let load = gravity * libm::sin(SLOPE) * depth;
        let sigma0 = 0.3 * load;
        let mu = 0.1 * self.step;
        let law = match self.case {
            Case::FilmBingham => Law::Bingham { sigma0, mu },
            Case::FilmHerschelBulkley => {
                let rate = DRIVE / (depth * depth) * self.step;
                Law::HerschelBulkley { sigma0, k: 0.5 * load / libm::pow(rate, 0.33), n: 0.33 }
            }
            _ => Law::Newtonian { mu },
        };
        Sheet::new(law, depth, gravity)
    }

    /// Its set-up.
    pub(super) fn film_setup(&self, sheet: &Sheet) -> Setup {
        let mut setup = sheet.setup();
        put(self.scheme, 0.1 * self.step, &mut setup);
        setup
    }

    /// From rest to the steady discharge, with the surface at a quarter and at three quarters of a cell.
    fn film(&self, backend: &dyn Backend, budget: f64) -> Result<Outcome, VerifyError> {
        let mut worst = Outcome { error: 0.0, steps: 0, updates: 0.0 };
        for level in [0.25, 0.75] {
            let sheet = self.sheet(self.n + level);
            let film = sheet.exact();
            let flux = film.flux();
            let error = |run: &dyn Run| (flow(run).flux() / flux - 1.0).abs();
            // (2H/π)²/ν with the tangent viscosity at the bed.
            let across = 2.0 * sheet.depth / core::f64::consts::PI;
            let memory = across * across * film.law.rate_slope(film.force() * sheet.depth);
            let here = until_it_stays(backend, &self.film_setup(&sheet), memory, budget, &error)?;
            worst = Outcome {
                error: if here.error <= worst.error { worst.error } else { here.error },
                steps: worst.steps.max(here.steps),
                updates: worst.updates + 0.5 * here.updates,
            };
        }
        Ok(worst)
    }

    fn wide_film(&self, across: usize) -> Setup {
        let sheet = self.sheet(self.n + 0.5);
        let mut setup = self.film_setup(&sheet);
        let film: Film<Law> = sheet.exact();
        let layers = setup.extents[2];
        let fill: Vec<f64> = (0..layers).map(|k| (sheet.depth - k as f64).clamp(0.0, 1.0)).collect();
        setup.extents = [2 * across, 2 * across, layers];
        let wide = (0..setup.cells()).map(|cell| fill[setup.coordinates(cell)[2]]).collect::<Vec<f64>>();
        if let Some(surface) = &mut setup.free_surface {
            surface.fill = wide.into();
        }
        setup.initial = Some(Arc::new(move |[_, _, k]| {
            let z = k as f64 + 0.5;
            let mut gradient = [[0.0; 3]; 3];
            gradient[0][2] = film.law.rate(film.force() * (film.thickness - z).max(0.0));
            FlowPoint { density: 1.0, velocity: [film.velocity(z), 0.0, 0.0], gradient }
        }));
        setup
    }
}

/// ν of the vortices at the standard time step.
const VORTEX_NU: f64 = 0.05;

/// Viscosity without the yield stress at a shear rate.
fn plastic(law: &Law, rate: f64) -> f64 {
    match *law {
        Law::HerschelBulkley { k, n, .. } => k * libm::pow(rate, n - 1.0),
        Law::Newtonian { mu } | Law::Bingham { mu, .. } => mu,
        Law::PowerLaw { k, n } | Law::Papanastasiou { k, n, .. } => k * libm::pow(rate, n - 1.0),
    }
}

/// The collision of a trial; wall rule and yield treatment are already those of its column.
fn put_collision(setup: &mut Setup, trial: &Trial) {
    let (yielding, wall) = (setup.yielding, setup.wall_rule);
    put(trial.scheme, 1.0, setup);
    (setup.yielding, setup.wall_rule) = (yielding, wall);
}

#[cfg(test)]
mod tests {
    use super::*;
    use lahar::plan::work::Scheme;
    use lahar::solver::plain::Plain;

    /// With τ of the previous step lost, every cell would keep the clamp's viscosity, 133 times the plastic
    /// one, and the discharge would be 2 % of the ideal one.
    #[test]
    fn papers_scheme_yields_below_a_free_surface() {
        let scheme = Scheme { operator: Operator::LaggedClamp, walls: Walls::HalfWay };
        let trial = Trial { case: Case::FilmBingham, scheme, n: 4.0, step: 0.05 };
        let outcome = trial.run(&Plain, 1e7).unwrap_or_else(|error| panic!("{error}"));
        // The slip of BGK walls and of the clamped plug adds some per cent.
        assert!(outcome.error < 0.2, "{outcome:?}");
    }
}
