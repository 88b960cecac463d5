//! Start-up of yield-stress channel flow from rest against an independent one-dimensional solver.

use core::f64::consts::TAU;
use std::sync::OnceLock;

use super::support::{central, column, from_middle, no_reference};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::exact::ExactError;
use crate::exact::viscoplastic_1d::{Flow1d, LowerEnd, Profile, Scheme};
use lahar::rheology::Law;
use lahar::setup::{BodyForce, Setup, WallRule};
use lahar::solver::run::Backend;

/// How the force sets in. Times in h²/ν_p, forces in G.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// 1 from t = 0 on.
    Sudden,
    /// ½(1 − cos 4πt): 1 at t = ¼, 0 again at ½.
    Smooth,
}

impl Start {
    /// Times of the profiles. Under the sudden force the flow is nearly steady at the last; under the
    /// smooth one the walls yield at t = ⅛ and the force is back at ½ at the last.
    pub const fn times(self) -> [f64; 4] {
        match self {
            Self::Sudden => [0.0625, 0.125, 0.25, 0.5],
            Self::Smooth => [0.1875, 0.25, 0.3125, 0.375],
        }
    }

    /// What its claims measure: the velocity at these times, in words.
    const fn measures(self) -> &'static str {
        match self {
            Self::Sudden => "velocity over cells at t = 1/16, 1/8, 1/4, 1/2 h2/nu_p, relative L2",
            Self::Smooth => "velocity over cells at t = 3/16, 1/4, 5/16, 3/8 h2/nu_p, relative L2",
        }
    }

    /// A sudden start converges at first order only, as theory predicts.
    const fn kind(self) -> Kind {
        match self {
            Self::Sudden => Kind::PredictedFailure,
            Self::Smooth => Kind::Verification,
        }
    }

    fn force(self, t: f64) -> f64 {
        match self {
            Self::Sudden => 1.0,
            Self::Smooth => 0.5 * (1.0 - libm::cos(2.0 * TAU * t)),
        }
    }

    /// The force over time in lattice units, for a peak force `peak` and `unit` steps per h²/ν_p.
    fn body_force(self, peak: f64, unit: f64) -> BodyForce {
        match self {
            Self::Sudden => BodyForce::Constant([peak, 0.0, 0.0]),
            Self::Smooth => BodyForce::Oscillating {
                mean: [0.5 * peak, 0.0, 0.0],
                amplitude: [-0.5 * peak, 0.0, 0.0],
                frequency: 2.0 * TAU / unit,
                phase: 0.0,
            },
        }
    }
}

/// Yield stress over wall stress Gh: the final plug fills half the channel.
const PLUG: f64 = 0.5;

/// Flow index of the Herschel-Bulkley fluid, the thesis' value.
const INDEX: f64 = 0.33;

/// Re = U h/ν_p with U = Gh²/μ_p: the largest velocity is U/8, so Ma stays below 0.01 for τ ≤ 2.
const REYNOLDS: f64 = 1.0;

/// Which law flows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fluid {
    /// σ = ½ + γ̇ in units of Gh and G h/μ_p.
    Bingham,
    /// σ = ½ + k γ̇^0.33, with k so that the steady wall shear rate is that of the Bingham fluid.
    HerschelBulkley,
}

impl Fluid {
    /// The law with unit of stress `stress` and plastic viscosity at the wall `viscosity`.
    ///
    /// The steady wall shear rate is ½ stress/viscosity for both, so both have the same plastic τ
    /// there.
    pub fn law(self, stress: f64, viscosity: f64) -> Law {
        let sigma0 = PLUG * stress;
        match self {
            Self::Bingham => Law::Bingham { sigma0, mu: viscosity },
            Self::HerschelBulkley => {
                let wall_rate = (1.0 - PLUG) * stress / viscosity;
                let k = (1.0 - PLUG) * stress / libm::pow(wall_rate, INDEX);
                Law::HerschelBulkley { sigma0, k, n: INDEX }
            }
        }
    }

    /// Profiles at the start's times on `cells` intervals per half channel, in units h, h²/ν_p, Gh²/μ_p.
    fn solve(self, start: Start, cells: usize) -> Result<Vec<Profile>, ExactError> {
        let flow = Flow1d {
            law: self.law(1.0, 1.0),
            density: 1.0,
            length: 1.0,
            cells,
            lower: LowerEnd::Symmetry,
            wall_speed: 0.0,
            scheme: Scheme::Sdirk2,
        };
        flow.profiles(&flow.at_rest()?, &start.times(), 1e-6, 1e-3, &|t| start.force(t))
    }

    /// The reference, computed once per process.
    pub fn reference(self, start: Start) -> Result<&'static [Profile], VerifyError> {
        static STORE: [OnceLock<Result<Vec<Profile>, ExactError>>; 4] = [const { OnceLock::new() }; 4];
        let slot = 2 * usize::from(self == Self::Bingham) + usize::from(start == Start::Sudden);
        match STORE[slot].get_or_init(|| self.solve(start, REFERENCE_CELLS)) {
            Ok(profiles) => Ok(profiles),
            Err(error) => Err(no_reference(error.clone())),
        }
    }
}

/// Intervals per half channel of the reference; cell centres of N ≤ 512 are nodes of it.
const REFERENCE_CELLS: usize = 512;

/// Relative L2 uncertainty of the reference (test `uncertainty_of_the_reference`).
const UNCERTAINTY: f64 = 2e-5;

/// Velocities of all cells, one vector per time.
type Profiles = Vec<Vec<f64>>;

/// One start-up in lattice units.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    pub fluid: Fluid,
    pub start: Start,
    pub wall: WallRule,
    /// Cells across; N²/64 steps of the reference times must be whole numbers with τ.
    pub cells: usize,
    /// ½ + 3ν_p.
    pub tau: f64,
    /// θ, least τ⁻ − ½.
    pub floor: f64,
}

impl Case {
    fn nu(&self) -> f64 {
        (self.tau - 0.5) / 3.0
    }

    /// Half width.
    pub fn h(&self) -> f64 {
        0.5 * self.cells as f64
    }

    /// ν/(h c_s): time an elastic wave takes to cross h, over h²/ν. The same as Ma/Re.
    pub fn elasticity(&self) -> f64 {
        3.0_f64.sqrt() * self.nu() / self.h()
    }

    /// Unit of velocity, Gh²/μ_p.
    fn speed(&self) -> f64 {
        REYNOLDS * self.nu() / self.h()
    }

    /// Velocities at the start's times in the unit Gh²/μ_p, one vector per time, and the reference's.
    pub fn profiles(&self, backend: &dyn Backend) -> Result<(Profiles, Profiles), VerifyError> {
        let (nu, h, speed) = (self.nu(), self.h(), self.speed());
        let force = speed * nu / (h * h);
        let mut setup = Setup::channel(self.cells, self.fluid.law(force * h, nu), force);
        setup.wall_rule = self.wall;
        setup.collision = central(self.floor);
        setup.force = self.start.body_force(force, h * h / nu);
        let mut run = backend.start(&setup)?;
        let (mut computed, mut exact) = (Vec::new(), Vec::new());
        for profile in self.fluid.reference(self.start)? {
            let step = (profile.time * h * h / nu).round() as u64;
            run.advance(step - run.step())?;
            computed.push(column(run.as_ref()).iter().map(|u| u / speed).collect());
            exact
                .push((0..self.cells).map(|j| profile.velocity_at(from_middle(j, self.cells) / h)).collect());
        }
        Ok((computed, exact))
    }

    /// Error over all times and cells together.
    pub fn sample(&self, backend: &dyn Backend, parameter: f64) -> Result<Sample, VerifyError> {
        let (computed, exact) = self.profiles(backend)?;
        let mut sample = Sample::l2(parameter, &computed.concat(), &exact.concat());
        for (time, (u, v)) in self.start.times().iter().zip(computed.iter().zip(&exact)) {
            sample = sample.with(&format!("error at t = {time} h2/nu [-]"), Sample::l2(0.0, u, v).error);
        }
        Ok(sample)
    }
}

pub const B3: WallRule = WallRule::ViscosityIndependent;

fn in_cells(backend: &dyn Backend, fluid: Fluid, start: Start, n: f64) -> Result<Sample, VerifyError> {
    Case { fluid, start, wall: B3, cells: n as usize, tau: 0.8, floor: 0.05 }.sample(backend, n)
}

/// Δt ∝ τ − ½ on a fixed, fine grid.
fn in_time(backend: &dyn Backend, fluid: Fluid, start: Start, inverse: f64) -> Result<Sample, VerifyError> {
    let tau = 0.5 + 3.0 / inverse;
    let case = Case { fluid, start, wall: B3, cells: 128, tau, floor: 0.05 };
    Ok(case.sample(backend, inverse)?.with("tau [-]", tau).with("nu/(h c_s) [-]", case.elasticity()))
}

const fn claim(
    id: &'static str,
    title: &'static str,
    ladder: Ladder,
    order: Option<OrderBand>,
    start: Start,
    tolerance: Tolerance,
    measure: fn(&dyn Backend, f64) -> Result<Sample, VerifyError>,
) -> Claim {
    Claim {
        id,
        title,
        tags: &["Y1", "Y2", "Y3", "L4", "L5", "K3", "B3"],
        measures: start.measures(),
        reference: Reference {
            source: "one-dimensional viscoplastic solver (implicit, not regularised), 512 intervals per half width",
            uncertainty: UNCERTAINTY,
        },
        metric: Metric::L2,
        ladder,
        order,
        tolerance,
        kind: start.kind(),
        measure,
    }
}

const CELLS: Ladder = Ladder {
    parameter: "N (cells across)",
    short: &[16.0, 32.0, 64.0],
    full: &[8.0, 16.0, 32.0, 64.0, 128.0],
};
const TIME: Ladder = Ladder {
    parameter: "1/nu (steps per cell and unit of viscosity)",
    short: &[1.0, 2.0, 4.0],
    // Still shorter steps only meet the error of the grid.
    full: &[1.0, 2.0, 4.0],
};
/// Second order with the 1/n = 3 kink of the profile at the edge of the plug still felt on these grids.
const NEARLY_SECOND: Option<OrderBand> = Some(OrderBand { expected: 2.0, band: 0.3, at_least: false });
const SUDDEN_BOUND: &str = "8 nu/(h c_s) at the last rung of the short ladder: an elastic wave carries the speed \
                            F h/(rho c_s), and the plug ends at F h^2/(8 mu)";
const SMOOTH_BOUND: &str = "50 (nu/(h c_s))^2 plus the steady error 5e-4 (64/N)^2: the elastic part of the shear rate, \
                            (dsigma/dt)/(rho c_s^2), is at most 4 pi (nu/(h c_s))^2 of the flow at the peak of the \
                            force, and four times as much soon after the walls yield";
const SMOOTH_BOUND_HB: &str = "100 (nu/(h c_s))^2 plus the steady error 2.6e-3 (64/N)^2: as for the Bingham fluid, with \
                               half the shear rate outside the wall region";
/// First order in the end; on these grids the second-order error of the steady flow is still seen.
const FIRST: Option<OrderBand> = Some(OrderBand { expected: 1.2, band: 0.3, at_least: false });
const SECOND: Option<OrderBand> = Some(OrderBand { expected: 2.0, band: 0.2, at_least: false });

/// Bingham, sudden start, refinement at fixed τ.
pub const BINGHAM_SUDDEN_CELLS: Claim = claim(
    "start-up-sudden-bingham-cells",
    "A force switched on at once: Bingham channel flow converges at first order only, for elastic waves run through the plug.",
    CELLS,
    FIRST,
    Start::Sudden,
    Tolerance { value: 0.043, at: Rung::Last, basis: Basis::Derived, because: SUDDEN_BOUND },
    |backend, x| in_cells(backend, Fluid::Bingham, Start::Sudden, x),
);
/// Bingham, sudden start, order in Δt.
pub const BINGHAM_SUDDEN_TIME: Claim = claim(
    "start-up-sudden-bingham-time-order",
    "A force switched on at once: the error of Bingham channel flow is of first order in the time step.",
    TIME,
    FIRST,
    Start::Sudden,
    Tolerance { value: 0.054, at: Rung::Last, basis: Basis::Derived, because: SUDDEN_BOUND },
    |backend, x| in_time(backend, Fluid::Bingham, Start::Sudden, x),
);
/// Herschel-Bulkley, sudden start, refinement at fixed τ.
pub const HERSCHEL_BULKLEY_SUDDEN_CELLS: Claim = claim(
    "start-up-sudden-herschel-bulkley-cells",
    "A force switched on at once: Herschel-Bulkley channel flow converges at first order only, for elastic waves run through the plug.",
    CELLS,
    FIRST,
    Start::Sudden,
    Tolerance { value: 0.043, at: Rung::Last, basis: Basis::Derived, because: SUDDEN_BOUND },
    |backend, x| in_cells(backend, Fluid::HerschelBulkley, Start::Sudden, x),
);
/// Herschel-Bulkley, sudden start, order in Δt.
pub const HERSCHEL_BULKLEY_SUDDEN_TIME: Claim = claim(
    "start-up-sudden-herschel-bulkley-time-order",
    "A force switched on at once: the error of Herschel-Bulkley channel flow is of first order in the time step.",
    TIME,
    FIRST,
    Start::Sudden,
    Tolerance { value: 0.054, at: Rung::Last, basis: Basis::Derived, because: SUDDEN_BOUND },
    |backend, x| in_time(backend, Fluid::HerschelBulkley, Start::Sudden, x),
);
/// Bingham, smooth start, refinement at fixed τ.
pub const BINGHAM_SMOOTH_CELLS: Claim = claim(
    "start-up-smooth-bingham-cells",
    "A force that sets in smoothly: Bingham channel flow converges at second order at fixed tau.",
    CELLS,
    SECOND,
    Start::Smooth,
    Tolerance { value: 2.5e-3, at: Rung::Last, basis: Basis::AfterSeeing, because: SMOOTH_BOUND },
    |backend, x| in_cells(backend, Fluid::Bingham, Start::Smooth, x),
);
/// Bingham, smooth start, order in Δt.
pub const BINGHAM_SMOOTH_TIME: Claim = claim(
    "start-up-smooth-bingham-time-order",
    "A force that sets in smoothly: the error of Bingham channel flow is of second order in the time step.",
    TIME,
    SECOND,
    Start::Smooth,
    Tolerance { value: 2.5e-3, at: Rung::Last, basis: Basis::AfterSeeing, because: SMOOTH_BOUND },
    |backend, x| in_time(backend, Fluid::Bingham, Start::Smooth, x),
);
/// Herschel-Bulkley, smooth start, refinement at fixed τ.
pub const HERSCHEL_BULKLEY_SMOOTH_CELLS: Claim = claim(
    "start-up-smooth-herschel-bulkley-cells",
    "A force that sets in smoothly: Herschel-Bulkley channel flow converges at second order at fixed tau.",
    CELLS,
    NEARLY_SECOND,
    Start::Smooth,
    Tolerance { value: 5.6e-3, at: Rung::Last, basis: Basis::AfterSeeing, because: SMOOTH_BOUND_HB },
    |backend, x| in_cells(backend, Fluid::HerschelBulkley, Start::Smooth, x),
);
/// Herschel-Bulkley, smooth start, order in Δt.
pub const HERSCHEL_BULKLEY_SMOOTH_TIME: Claim = claim(
    "start-up-smooth-herschel-bulkley-time-order",
    "A force that sets in smoothly: the error of Herschel-Bulkley channel flow is of second order in the time step.",
    TIME,
    NEARLY_SECOND,
    Start::Smooth,
    Tolerance { value: 4.6e-3, at: Rung::Last, basis: Basis::AfterSeeing, because: SMOOTH_BOUND_HB },
    |backend, x| in_time(backend, Fluid::HerschelBulkley, Start::Smooth, x),
);
#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uncertainty_of_the_reference() {
        for fluid in [Fluid::Bingham, Fluid::HerschelBulkley] {
            for start in [Start::Sudden, Start::Smooth] {
                let (coarse, fine) = (fluid.solve(start, 256).unwrap(), fluid.solve(start, 512).unwrap());
                let u: Vec<f64> = coarse.iter().flat_map(|p| p.velocity.iter().copied()).collect();
                let v: Vec<f64> = fine.iter().flat_map(|p| p.velocity.iter().copied().step_by(2)).collect();
                let difference = Sample::l2(0.0, &u, &v).error;
                // Second order: a third of the difference is the error of the finer one.
                assert!(difference / 3.0 < UNCERTAINTY, "{fluid:?} {start:?} {difference}");
            }
        }
    }
}
