//! Free-surface runs of the plain backend: the arrays and the order of the passes \[F4\].
//!
//! A step is: wall slip, collide, stream with mass exchange, marks and conversions, ledger. Every pass
//! writes only its own cell and reads arrays that no other cell of the pass writes.

mod balance;
mod convert;
mod grains;
mod passes;
mod report;

use std::collections::BTreeMap;

use super::cell::Cell;
use super::run::starting_omega;
use crate::boundary::links::Links;
use crate::coupling::Immersed;
use crate::free_surface::{Kind, classify, hydrostatic};
use crate::lattice::Q;
use crate::lattice::moments::density_excess;
use crate::setup::{FlowPoint, FreeSurface, Setup, SurfaceForce, WallRule, YieldTreatment};
use crate::solver::books::Books;
use crate::solver::initial::{self, REST};
use crate::solver::physics::Physics;
use crate::solver::run::{Load, Run, StartError, Stopped};

/// A free-surface flow being stepped with one kind of physics.
pub struct SurfaceRun<P> {
    setup: Setup,
    surface: FreeSurface,
    physics: P,
    links: Links,
    /// Populations before collision, f − w; zero in gas and solids.
    f: Vec<Cell>,
    /// Populations after collision.
    post: Vec<Cell>,
    /// `f` of the step before streaming; only for physics that wants it.
    before: Vec<Cell>,
    kinds: Vec<Kind>,
    /// m of interface cells; 0 elsewhere.
    mass: Vec<f64>,
    /// φ: m/ρ limited to 0..1 in interface cells, 1 in liquid, 0 elsewhere.
    fill: Vec<f64>,
    /// u of the last collision.
    velocity: Vec<[f64; 3]>,
    /// Smoothed acceleration; only for the rule with inertia.
    acceleration: Vec<[f64; 3]>,
    /// u of the collision before; only for the rule with inertia.
    velocity_before: Vec<[f64; 3]>,
    /// What each interface cell touches, as bits of [`crate::free_surface::conversion::touch`].
    touches: Vec<u8>,
    /// ω⁺ of the previous step; only for the lagged treatment.
    previous_omega: Vec<f64>,
    /// Wall correction per boundary cell; only for the viscosity-independent wall.
    corrections: Vec<Cell>,
    /// Excess mass without receiver, by cell \[F6\].
    parked: BTreeMap<u32, f64>,
    /// Fluid cells that are interface or have a boundary record, in index order.
    special: Vec<u32>,
    books: Books,
    loads: Vec<Load>,
    /// Grains in the fluid; only absent while they look at the cells.
    grains: Option<Box<Immersed>>,
    step: u64,
    pool: Option<rayon::ThreadPool>,
}

impl<P: Physics> SurfaceRun<P> {
    /// Allocates and initialises. Without an initial flow the fluid starts at rest with the pressure that
    /// balances its weight ([`hydrostatic`]).
    ///
    /// # Errors
    /// The setup is inconsistent, has no free surface, or has several fluids.
    pub fn start(setup: &Setup, physics: P) -> Result<Self, StartError> {
        crate::solver::check::check(setup)?;
        let unsupported = |feature| StartError::Unsupported { backend: "plain", feature };
        let surface = match (&setup.free_surface, &setup.grains) {
            (Some(surface), _) => surface.clone(),
            (None, Some(_)) => FreeSurface::new(vec![1.0; setup.cells()]),
            (None, None) => return Err(unsupported("a surface run without a surface")),
        };
        if setup.fluids.len() > 1 {
            return Err(unsupported("several fluids below a free surface"));
        }
        let links = Links::new(setup);
        let cells = setup.cells();
        let kinds = classify(
            &surface.fill,
            |cell| setup.is_solid(cell),
            |cell| (1..Q).filter_map(|i| links.neighbour_along(cell, i)).collect::<Vec<_>>(),
        );
        let fill: Vec<f64> = (0..cells)
            .map(|cell| match kinds[cell] {
                Kind::Liquid => 1.0,
                Kind::Interface => surface.fill[cell],
                Kind::Gas | Kind::Solid => 0.0,
            })
            .collect();
        let force = setup.force.at(0);
        let grains = match &setup.grains {
            Some(grains) => Some(Box::new(
                Immersed::new(setup, grains).map_err(|error| StartError::Grains(Box::new(error)))?,
            )),
            None => None,
        };
        let excess = match setup.initial {
            Some(_) => Vec::new(),
            // Without a surface nothing says where the pressure is that of the gas.
            None if setup.free_surface.is_none() => vec![0.0; cells],
            None => hydrostatic::density_excess(setup.extents, &kinds, &fill, &force),
        };
        let pool = (setup.threads > 1 && cells > passes::CHUNK)
            .then(|| rayon::ThreadPoolBuilder::new().num_threads(setup.threads).build().ok())
            .flatten();
        let mut run = Self {
            setup: setup.clone(),
            physics,
            links,
            f: vec![[0.0; Q]; cells],
            post: vec![[0.0; Q]; cells],
            before: Vec::new(),
            kinds,
            mass: vec![0.0; cells],
            fill,
            velocity: vec![[0.0; 3]; cells],
            acceleration: Vec::new(),
            velocity_before: Vec::new(),
            touches: vec![0; cells],
            previous_omega: Vec::new(),
            corrections: Vec::new(),
            parked: BTreeMap::new(),
            special: Vec::new(),
            books: Books::default(),
            loads: Vec::new(),
            grains,
            step: 0,
            pool,
            surface,
        };
        let force = run.body_force();
        run.fill_in(&excess, &force);
        Ok(run)
    }

    /// Populations, masses and the optional arrays.
    fn fill_in(&mut self, excess: &[f64], force: &[f64; 3]) {
        let cells = self.setup.cells();
        if self.surface.force == SurfaceForce::ByFillAndInertia {
            self.acceleration = vec![[0.0; 3]; cells];
        }
        if matches!(self.setup.yielding, YieldTreatment::LaggedClamped { .. }) {
            self.previous_omega = (0..cells).map(|cell| starting_omega(&self.setup, cell)).collect();
        }
        if self.setup.wall_rule == WallRule::ViscosityIndependent {
            self.corrections = vec![[0.0; Q]; self.links.boundary().len()];
        }
        if self.setup.loads {
            self.loads = vec![Load::default(); self.setup.solid_motion.len()];
        }
        for cell in 0..cells {
            if !self.kinds[cell].is_fluid() {
                continue;
            }
            let point = match &self.setup.initial {
                Some(flow) => flow(self.setup.coordinates(cell)),
                None => FlowPoint { density: 1.0 + excess[cell], ..REST },
            };
            let here = self.force_at(cell, force);
            self.f[cell] = initial::start(&point, &self.setup.law(cell), &here);
            self.velocity[cell] = point.velocity;
            if self.kinds[cell] == Kind::Interface {
                self.mass[cell] = self.fill[cell] * (1.0 + density_excess(&self.f[cell]));
            }
        }
        self.start_grains();
        self.list_special();
        self.open_books();
    }

    fn list_special(&mut self) {
        let boundary = |cell: usize| {
            !matches!(self.links.kind(cell), crate::boundary::links::CellKind::Bulk)
                && self.kinds[cell].is_fluid()
        };
        self.special = (0..self.kinds.len())
            .filter(|&cell| self.kinds[cell] == Kind::Interface || boundary(cell))
            .map(|cell| cell as u32)
            .collect();
    }

    /// One time step.
    fn advance_one(&mut self) -> Result<(), Stopped> {
        let force = self.body_force();
        self.wall_pass(&force);
        self.collide_pass(&force)?;
        if self.physics.wants_before() {
            self.before.clone_from(&self.f);
        }
        self.exchange_with_grains();
        self.stream_pass();
        self.book_links();
        self.convert(&force);
        self.move_grains()?;
        self.step += 1;
        self.close_books()
    }
}

impl<P: Physics> SurfaceRun<P> {
    pub(super) fn run(&mut self, steps: u64) -> Result<(), Stopped> {
        for _ in 0..steps {
            self.advance_one()?;
        }
        Ok(())
    }
}

/// A boxed run, for the backend.
pub(super) fn boxed<P: Physics>(setup: &Setup, physics: P) -> Result<Box<dyn Run>, StartError> {
    Ok(Box::new(SurfaceRun::start(setup, physics)?))
}
