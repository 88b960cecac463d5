//! What became of a case.

use super::case::{Case, Place};
use super::lattice::{Grid, Node};
use crate::claim::VerifyError;
use lahar::setup::WallRule;
use lahar::solver::run::{Backend, Fields};
use lahar::solver::steady::{SteadyOutcome, SteadyRule, run_to_steady};

/// Change still to come at which a run between plane walls is taken for steady, of the largest speed: a hundredth of what is
/// judged.
const STEADY: f64 = 1e-4;

/// The same between curved walls. A sudden start leaves momentum of alternating sign, Σ(−1)^(x+t) j_x, which
/// bounce-back keeps for ever, up to 5e-3 of the speed.
const STEADY_ALONG_CURVES: f64 = 5e-3;

/// Difference between the two starts that is one state, in tolerances at which runs end.
const ONE_STATE: f64 = 10.0;

/// Relaxations within which a run has to become steady; from rest to 1e-4 takes ten.
const RELAXATIONS: f64 = 40.0;

/// How a run of a case ended.
#[derive(Clone, Debug)]
pub enum End {
    /// In a steady state.
    Steady(State),
    /// Never.
    Unsteady(SteadyOutcome, State),
    /// A guard stopped it at this step.
    BlewUp(u64),
}

/// The flow at the end of a run.
#[derive(Clone, Debug)]
pub struct State {
    /// Steps it took.
    pub steps: u64,
    /// Cell by cell.
    pub nodes: Vec<Node>,
}

impl State {
    /// Largest speed less the exact one at the same centres, in units of the largest.
    pub fn peak(&self) -> f64 {
        let most = |of: fn(&Node) -> f64| self.nodes.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
        most(|node| node.computed) - most(|node| node.exact)
    }

    /// Root of the mean square difference, in units of the largest speed.
    pub fn mean(&self) -> f64 {
        let sum = self
            .nodes
            .iter()
            .fold(0.0, |sum, node| sum + (node.computed - node.exact) * (node.computed - node.exact));
        (sum / self.nodes.len() as f64).sqrt()
    }

    /// Root of the mean square difference over that of the exact speed.
    pub fn l2(&self) -> f64 {
        let sum = |of: fn(&Node) -> f64| self.nodes.iter().map(of).fold(0.0, |sum, x| sum + x * x);
        (sum(|node| node.computed - node.exact) / sum(|node| node.exact)).sqrt()
    }

    /// Discharge over the exact one, summed over the same cells, less 1.
    pub fn flux(&self) -> f64 {
        let sum = |of: fn(&Node) -> f64| self.nodes.iter().map(of).sum::<f64>();
        sum(|node| node.computed) / sum(|node| node.exact) - 1.0
    }

    /// Largest difference of speed from another state, in units of the largest.
    pub fn apart(&self, other: &Self) -> f64 {
        if self.nodes.len() != other.nodes.len() {
            return f64::INFINITY;
        }
        let pairs = self.nodes.iter().zip(&other.nodes);
        pairs.fold(0.0, |most: f64, (a, b)| most.max((a.computed - b.computed).abs()))
    }
}

impl End {
    /// The state, if there is one.
    pub const fn state(&self) -> Option<&State> {
        match self {
            Self::Steady(state) | Self::Unsteady(_, state) => Some(state),
            Self::BlewUp(_) => None,
        }
    }

    /// In a word or two.
    pub fn words(&self) -> String {
        match self {
            Self::Steady(state) => format!("steady after {}", state.steps),
            Self::Unsteady(found, _) => found.to_string(),
            Self::BlewUp(step) => format!("stopped at step {step}"),
        }
    }
}

/// What became of a case.
pub struct Row {
    /// The case.
    pub case: Case,
    /// Thickness of its thinnest sheared layer, cells.
    pub sheared: f64,
    /// Body force over the largest speed: share of it that a step adds.
    pub push: f64,
    /// Whether the exact flow is known.
    pub known: bool,
    /// From rest.
    pub rest: End,
    /// From three times the exact flow.
    pub fast: End,
    /// With half-way walls, from the exact flow.
    pub half_way: End,
}

impl Row {
    /// Runs a case three times.
    ///
    /// # Errors
    /// The backend refuses, or there is no exact flow.
    pub fn of(backend: &dyn Backend, case: Case) -> Result<Self, VerifyError> {
        let grid = Grid::of(case)?;
        let length = case.length();
        Ok(Self {
            case,
            sheared: grid.flow.sheared * length,
            push: grid.force() / case.speed,
            known: grid.flow.known,
            rest: run(backend, &grid, WallRule::ViscosityIndependent, 0.0)?,
            fast: run(backend, &grid, WallRule::ViscosityIndependent, 3.0)?,
            half_way: run(backend, &grid, WallRule::HalfWay, 1.0)?,
        })
    }

    /// Error of the largest speed; where that is the wall's the root mean square error. The worse of both starts.
    pub fn error(&self) -> f64 {
        let of = |end: &End| end.state().map_or(f64::INFINITY, |state| self.measure(state));
        let (a, b) = (of(&self.rest), of(&self.fast));
        if a.abs() >= b.abs() { a } else { b }
    }

    /// The same with half-way walls.
    pub fn half_way_error(&self) -> f64 {
        self.half_way.state().map_or(f64::INFINITY, |state| self.measure(state))
    }

    fn measure(&self, state: &State) -> f64 {
        match self.case.place {
            _ if !self.known => 0.0,
            Place::Couette | Place::Cylinders { .. } => state.mean(),
            _ => state.peak(),
        }
    }

    /// Difference between the two starts that is one state.
    pub fn one_state(&self) -> f64 {
        ONE_STATE * tolerance(&self.case)
    }

    /// Whether both starts end in one steady state.
    pub fn is_one_state(&self) -> bool {
        let steady = |end: &End| matches!(end, End::Steady(_));
        steady(&self.rest) && steady(&self.fast) && self.apart() <= self.one_state()
    }

    /// Largest difference of speed between the two starts.
    pub fn apart(&self) -> f64 {
        match (self.rest.state(), self.fast.state()) {
            (Some(rest), Some(fast)) => rest.apart(fast),
            _ => f64::INFINITY,
        }
    }
}

const fn tolerance(case: &Case) -> f64 {
    if case.place.is_flat() { STEADY } else { STEADY_ALONG_CURVES }
}

fn run(backend: &dyn Backend, grid: &Grid, wall: WallRule, start: f64) -> Result<End, VerifyError> {
    let setup = grid.setup(wall, start);
    let mut run = backend.start(&setup)?;
    let relaxation = grid.relaxation();
    let interval = (0.2 * relaxation).ceil().max(20.0) as u64;
    let max_steps = (RELAXATIONS * relaxation) as u64 + 40 * interval;
    let rule = SteadyRule { tolerance: tolerance(&grid.case), interval, max_steps };
    let state = |fields: &Fields, steps: u64| State { steps, nodes: grid.compare(&setup, fields) };
    Ok(match run_to_steady(run.as_mut(), rule) {
        Ok(outcome) if outcome.steady => End::Steady(state(&run.fields(), outcome.steps)),
        Ok(outcome) => End::Unsteady(outcome, state(&run.fields(), outcome.steps)),
        Err(stopped) => End::BlewUp(stopped.step),
    })
}
