//! A case on the lattice.

use std::sync::Arc;

use super::case::{Case, Place};
use super::flow::Flow;
use crate::claim::VerifyError;
use crate::claims::poiseuille::channel::Scale;
use lahar::boundary::cut::cut_cells;
use lahar::setup::{BodyForce, Face, FlowPoint, FreeSurface, Setup, SolidMotion, WallRule};
use lahar::solver::run::Fields;

/// A case, its exact flow, and what turns the one into numbers of the lattice.
pub struct Grid {
    /// The case.
    pub case: Case,
    /// Its exact flow.
    pub flow: Arc<Flow>,
    scale: Scale,
    extents: [usize; 3],
}

impl Grid {
    /// Of a case.
    ///
    /// # Errors
    /// As [`Flow::of`].
    pub fn of(case: Case) -> Result<Self, VerifyError> {
        let flow = Flow::of(&case)?;
        // Stress and shear rate at the wall are 1, so the plastic viscosity there is 1 − plug.
        let viscosity = (case.tau - 0.5) / 3.0 / (1.0 - case.plug);
        let rate = case.speed / (flow.fastest * case.length());
        let across = case.cells as usize;
        let round = 2 * libm::ceil(case.cells) as usize + 2;
        let extents = match case.place {
            Place::Channel | Place::Couette => [1, across, 1],
            Place::Film { .. } => [1, 1, libm::ceil(case.cells) as usize + 2],
            Place::Duct { aspect } => [1, across, libm::round(aspect * case.cells) as usize],
            Place::Pipe | Place::Annulus { .. } => [1, round, round],
            Place::Cylinders { .. } => [round, round, 1],
        };
        Ok(Self {
            case,
            flow: Arc::new(flow),
            scale: Scale { n: 0, rate, stress: viscosity * rate },
            extents,
        })
    }

    /// Body force, lattice units.
    pub fn force(&self) -> f64 {
        self.flow.force * self.scale.stress / self.case.length()
    }

    /// Steps of the slowest relaxation, (2L/π)²/ν with the least tangent viscosity, n times the plastic one at the wall.
    pub fn relaxation(&self) -> f64 {
        let across = 2.0 * self.case.length() / core::f64::consts::PI;
        across * across * 3.0 / ((self.case.tau - 0.5) * self.case.n.min(1.0))
    }

    /// Speed of the exact flow at the centre of a cell, cells per step.
    fn exact(&self, at: [f64; 2]) -> f64 {
        self.flow.speed(at.map(|x| x / self.case.length())) * self.scale.rate * self.case.length()
    }

    /// Where a cell is in the cross-section, cells: from the middle; of films from the surface, as in half a channel.
    fn place(&self, [i, j, k]: [usize; 3]) -> [f64; 2] {
        let from = |axis: usize, index: usize| index as f64 + 0.5 - 0.5 * self.extents[axis] as f64;
        match self.case.place {
            Place::Channel | Place::Couette => [from(1, j), 0.0],
            Place::Film { .. } => [self.case.cells - (k as f64 + 0.5), 0.0],
            Place::Cylinders { .. } => [from(0, i), from(1, j)],
            _ => [from(1, j), from(2, k)],
        }
    }

    /// The set-up, from `start` times the exact flow.
    pub fn setup(&self, wall: WallRule, start: f64) -> Setup {
        let mut setup = Setup::periodic(self.extents, self.scale.law(&self.case.law()));
        setup.wall_rule = wall;
        setup.collision = self.case.operator.choice();
        setup.force = BodyForce::Constant([self.force(), 0.0, 0.0]);
        match self.case.place {
            Place::Channel => setup.faces[1] = [Face::NoSlip; 2],
            Place::Duct { .. } => (setup.faces[1], setup.faces[2]) = ([Face::NoSlip; 2], [Face::NoSlip; 2]),
            Place::Couette => {
                setup.faces[1] = [Face::NoSlip, Face::Moving([self.case.speed, 0.0, 0.0])];
            }
            Place::Film { slope } => self.incline(&mut setup, slope),
            Place::Pipe | Place::Annulus { .. } | Place::Cylinders { .. } => self.solids(&mut setup, wall),
        }
        self.start(&mut setup, start);
        setup
    }

    fn incline(&self, setup: &mut Setup, slope: f64) {
        setup.faces[2] = [Face::NoSlip; 2];
        let across = self.force() / libm::tan(slope.to_radians());
        setup.force = BodyForce::Constant([self.force(), 0.0, -across]);
        let fill = (0..setup.cells()).map(|k| (self.case.cells - k as f64).clamp(0.0, 1.0)).collect();
        setup.free_surface = Some(FreeSurface::new(fill));
    }

    /// Solid 1 is the inner cylinder, solid 2 what lies outside: in their place as in scenes where they rest, with
    /// half-way walls and around turning ones on stairs.
    fn solids(&self, setup: &mut Setup, wall: WallRule) {
        let inner = match self.case.place {
            Place::Annulus { ratio } | Place::Cylinders { ratio } => ratio * self.case.cells,
            _ => 0.0,
        };
        let outer = self.case.cells;
        let turning = matches!(self.case.place, Place::Cylinders { .. });
        let spin = if turning { self.case.speed / inner } else { 0.0 };
        let centre = self.extents.map(|n| 0.5 * n as f64);
        let turns = SolidMotion { spin: [0.0, 0.0, spin], centre, ..SolidMotion::default() };
        setup.solid_motion = vec![turns, SolidMotion::default()];
        let axes = if turning { [0, 1] } else { [1, 2] };
        let radius = |point: [f64; 3]| {
            let [y, z] = axes.map(|a: usize| point[a] - centre[a]);
            libm::sqrt(y * y + z * z)
        };
        let kind = |cell: usize| match radius(setup.coordinates(cell).map(|x| x as f64 + 0.5)) {
            r if r < inner => 1,
            r if r > outer => 2,
            _ => 0,
        };
        setup.solids = (0..setup.cells()).map(kind).collect();
        if wall == WallRule::ViscosityIndependent && setup.can_be_cut() {
            setup.cuts = cut_cells(setup, |point| !(inner..=outer).contains(&radius(point))).into();
        }
    }

    /// Starts from `times` the exact flow, gradients by differences over a cell; films with the pressure of their weight, so
    /// that every start has the same mass.
    fn start(&self, setup: &mut Setup, times: f64) {
        let grid = Self { flow: Arc::clone(&self.flow), ..*self };
        let weight = match (self.case.place, setup.force) {
            (Place::Film { .. }, BodyForce::Constant([.., down])) => -3.0 * down,
            _ => 0.0,
        };
        setup.initial = Some(Arc::new(move |cell| {
            let [y, z] = grid.place(cell);
            let velocity = |at: [f64; 2]| grid.direction(at).map(|d| times * d * grid.exact(at));
            let [vy, vz] = [[0.5, 0.0], [0.0, 0.5]].map(|h: [f64; 2]| {
                let (more, less) = (velocity([y + h[0], z + h[1]]), velocity([y - h[0], z - h[1]]));
                [more[0] - less[0], more[1] - less[1], more[2] - less[2]]
            });
            // Which axes the two numbers of the cross-section run along.
            let (axes, sign) = match grid.case.place {
                Place::Film { .. } => ([2, 0], -1.0),
                Place::Cylinders { .. } => ([0, 1], 1.0),
                _ => ([1, 2], 1.0),
            };
            let mut gradient = [[0.0; 3]; 3];
            for a in 0..3 {
                gradient[a][axes[0]] += sign * vy[a];
                gradient[a][axes[1]] += vz[a];
            }
            let depth = y.max(0.0);
            FlowPoint { density: 1.0 + weight * depth, velocity: velocity([y, z]), gradient }
        }));
    }

    /// Unit vector of the flow.
    fn direction(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        let r = libm::sqrt(x * x + y * y);
        match self.case.place {
            Place::Cylinders { .. } if r > 0.0 => [-y / r, x / r, 0.0],
            Place::Cylinders { .. } => [0.0; 3],
            _ => [1.0, 0.0, 0.0],
        }
    }

    /// Speeds along the exact flow, computed and exact, in units of its largest; with the fill of each cell.
    pub fn compare(&self, setup: &Setup, fields: &Fields) -> Vec<Node> {
        let unit = self.case.speed;
        let fluid = |&cell: &usize| fields.is_fluid(cell, setup.is_solid(cell));
        // The surface cell holds what the parabola says at its centre, which lies outside the fluid or not.
        let liquid = |&cell: &usize| fields.kind.get(cell).is_none_or(|&kind| kind == 2);
        let node = |cell: usize| {
            let at = self.place(setup.coordinates(cell));
            let (d, u) = (self.direction(at), fields.velocity[cell]);
            let along = d[0] * u[0] + d[1] * u[1] + d[2] * u[2];
            Node { computed: along / unit, exact: self.exact(at) / unit }
        };
        (0..setup.cells()).filter(fluid).filter(liquid).map(node).collect()
    }
}

/// One cell.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// Speed that came out.
    pub computed: f64,
    /// Speed that should have.
    pub exact: f64,
}
