//! A flow and its time step.

use std::sync::Arc;

use super::cut_cells::Cuts;
use super::surface::cells::Wet;
use super::surface::{Design, Surface, SurfacePhysics};
use crate::boundary::hand_over::HandOver;
use crate::boundary::links::{CellKind, Links};
use crate::coupling::Immersed;
use crate::lattice::Q;
use crate::setup::course::Factors;
use crate::setup::{FlowPoint, Setup, WallRule, YieldTreatment};
use crate::solver::cell::{self, Cell};
use crate::solver::initial::{self, REST, starting_omega};
use crate::solver::loads::recorded;
use crate::solver::physics::Physics;
use crate::solver::pool::{self, within};
use crate::solver::run::{Load, StartError, Stopped};

/// Cells per chunk of work: enough to hide the hand-over, few enough to balance.
pub(super) const CHUNK: usize = 4096;

/// A flow being stepped with one kind of physics; below a free surface, with one kind of physics of that.
pub struct PlainRun<P, S = Design> {
    pub(super) setup: Setup,
    pub(super) physics: P,
    pub(super) links: Links,
    /// What moving solids made of stairs hand along their surfaces \[B1\].
    pub(super) hand_over: HandOver,
    /// Populations before collision, f − w; zero where there is no fluid.
    pub(super) f: Vec<Cell>,
    /// Populations after collision.
    pub(super) post: Vec<Cell>,
    /// ω⁺ of the previous step; only for the lagged treatment.
    pub(super) previous_omega: Vec<f64>,
    /// Wall correction per boundary cell; only for the viscosity-independent wall.
    pub(super) corrections: Vec<Cell>,
    /// Links that surfaces cut elsewhere than half-way.
    pub(super) cuts: Cuts,
    /// Kinds of cells and all that follows; `None` where fluid fills every cell that is not solid.
    pub(super) surface: Option<Surface<S>>,
    /// Grains in the fluid, which need the kinds of cells with or without gas.
    pub(super) grains: Option<Box<Immersed>>,
    /// Loads on solids where no surface keeps them.
    pub(super) loads: Vec<Load>,
    pub(super) step: u64,
    pub(super) pool: Option<Arc<rayon::ThreadPool>>,
}

impl<P: Physics> PlainRun<P> {
    /// Allocates and initialises. Below a free surface and without an initial flow the fluid starts at rest with
    /// the pressure that balances its weight ([`crate::free_surface::hydrostatic`]).
    ///
    /// # Errors
    /// The setup is inconsistent (`crate::solver::check::check`), or has several fluids below a free surface.
    pub fn start(setup: &Setup, physics: P) -> Result<Self, StartError> {
        Self::start_with(setup, physics, Design)
    }
}

impl<P: Physics, S: SurfacePhysics> PlainRun<P, S> {
    /// As [`PlainRun::start`], with other equations for the free surface than those of docs/method.md.
    ///
    /// # Errors
    /// As [`PlainRun::start`].
    pub fn start_with(setup: &Setup, physics: P, equations: S) -> Result<Self, StartError> {
        crate::solver::check::check(setup)?;
        let links = Links::new(setup);
        let cells = setup.cells();
        let surface = Surface::new(setup, &links, equations)?;
        let grains = match &setup.grains {
            None => None,
            Some(grains) => Some(Box::new(
                Immersed::new(setup, grains).map_err(|error| StartError::Grains(Box::new(error)))?,
            )),
        };
        let lagged = matches!(setup.yielding, YieldTreatment::LaggedClamped { .. });
        let corrections = match setup.wall_rule {
            WallRule::HalfWay => 0,
            WallRule::ViscosityIndependent => links.boundary().len(),
        };
        let mut run = Self {
            setup: setup.clone(),
            physics,
            cuts: Cuts::new(setup, &links),
            links,
            hand_over: HandOver::new(setup),
            f: vec![[0.0; Q]; cells],
            post: vec![[0.0; Q]; cells],
            previous_omega: if lagged {
                (0..cells).map(|cell| starting_omega(setup, cell)).collect()
            } else {
                Vec::new()
            },
            corrections: vec![[0.0; Q]; corrections],
            loads: vec![Load::default(); if surface.is_none() { recorded(setup) } else { 0 }],
            surface,
            grains,
            step: 0,
            pool: pool::start(if cells > CHUNK { setup.threads } else { 1 }),
        };
        run.fill_in();
        run.start_grains();
        run.open_books();
        Ok(run)
    }

    /// Populations of every fluid cell, and what the surface keeps of it.
    fn fill_in(&mut self) {
        let force = self.body_force();
        let at_rest = self.surface.as_ref().map_or_else(Vec::new, |s| s.excess_at_rest(&self.setup));
        for cell in 0..self.f.len() {
            if !self.is_fluid(cell) {
                continue;
            }
            let point = match &self.setup.initial {
                Some(flow) => flow(self.setup.coordinates(cell)),
                None => FlowPoint { density: 1.0 + at_rest.get(cell).copied().unwrap_or(0.0), ..REST },
            };
            let here = self.force_at(cell, &force);
            self.f[cell] = initial::start(&point, &self.setup.law(cell), &here);
            if let Some(surface) = &mut self.surface {
                surface.start_cell(cell, &self.f[cell], &point.velocity);
            }
        }
    }

    /// One time step; the passes that know a surface or grains do nothing without.
    fn advance_one(&mut self) -> Result<(), Stopped> {
        let force = self.body_force();
        self.move_walls();
        self.wall_pass(&force);
        self.collide_pass(&force)?;
        self.cut_pass();
        self.exchange_with_grains();
        self.exchange_mass();
        self.stream_pass();
        self.book_links();
        self.book_loads();
        self.dry_pass();
        self.close_voids();
        self.convert(&force);
        self.move_grains()?;
        self.step += 1;
        self.close_books()
    }

    /// Gives walls and solids the velocities of this step, where they change in time.
    fn move_walls(&mut self) {
        if self.setup.courses.vary() {
            let factors = Factors::at(&self.setup, self.step);
            self.links.move_walls(&self.setup, &factors);
            self.hand_over.move_solids(&factors);
        }
    }

    pub(super) fn run(&mut self, steps: u64) -> Result<(), Stopped> {
        let pool = self.pool.clone();
        within(pool.as_deref(), || (0..steps).try_for_each(|_| self.advance_one()))
    }

    /// Whether a cell holds fluid now.
    #[inline(always)]
    pub(super) fn is_fluid(&self, cell: usize) -> bool {
        match &self.surface {
            None => self.links.kind(cell) != CellKind::Solid,
            Some(surface) => surface.kinds[cell].is_fluid(),
        }
    }

    /// Body force of a cell \[F3\]; `force`: that of this step.
    #[inline(always)]
    pub(super) fn force_at(&self, cell: usize, force: &[f64; 3]) -> [f64; 3] {
        match &self.surface {
            None => *force,
            Some(surface) => surface.force_at(&self.links, cell, force),
        }
    }

    /// Number of the fluid in a cell.
    #[inline(always)]
    pub(super) fn fluid(&self, cell: usize) -> u8 {
        self.setup.fluid_of_cell.get(cell).copied().unwrap_or(0)
    }

    /// Moments and ω⁺ of a cell before collision.
    #[inline(never)]
    pub(super) fn state(&self, cell: usize, force: &[f64; 3]) -> cell::State {
        let previous = self.previous_omega.get(cell).copied().unwrap_or(0.0);
        cell::state(&self.physics, &self.f[cell], force, self.fluid(cell), previous)
    }

    /// The cells and the grains in them; `None` where cells have no kinds.
    pub(super) fn wet(&mut self) -> Option<(Wet<'_, P, S>, Option<&mut Immersed>)> {
        let wet = Wet {
            setup: &self.setup,
            physics: &self.physics,
            links: &self.links,
            hand_over: &self.hand_over,
            f: &mut self.f,
            post: &mut self.post,
            previous_omega: &mut self.previous_omega,
            surface: self.surface.as_mut()?,
            step: self.step,
            pool: self.pool.as_deref(),
        };
        Some((wet, self.grains.as_deref_mut()))
    }
}
