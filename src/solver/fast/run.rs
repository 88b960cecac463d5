//! Arrays and steps of the fast backend.

use std::sync::Arc;
use std::time::Instant;

use rayon::prelude::*;

use super::block::{Block, Link, Origin, Place, Velocities, numbers_around, put};
use super::element::{Aligned, Element, index};
use super::instructions::{Chosen, Passes};
use super::layout::{Layout, NONE};
use super::links::{after, open_link, wall_link};
use super::rim::Rim;
use super::sources::Sources;
use super::stores;
use super::surface::state::Surface;
use super::task::{Outcome, Own, Task};
use crate::boundary::hand_over::HandOver;
use crate::coupling::Immersed;
use crate::free_surface::Kind;
use crate::lattice::Q;
use crate::lattice::moments::density_excess;
use crate::setup::{Setup, WallRule, YieldTreatment};
use crate::solver::initial;
use crate::solver::loads::recorded;
use crate::solver::physics::Physics;
use crate::solver::pool::{self, each, within};
use crate::solver::run::{Load, StartError, Stopped};

/// Populations above this many bytes do not fit the caches: stores then go past them.
const CACHED: u64 = 24 << 20;

/// A flow being stepped in blocks.
pub struct FastRun<P, E: Element = f64> {
    pub(super) setup: Setup,
    pub(super) physics: P,
    pub(super) chosen: Chosen,
    /// The passes over one block, in the precision of the run.
    pub(super) passes: Passes<P, E>,
    pub(super) layout: Layout,
    pub(super) sources: Vec<Sources>,
    pub(super) velocities: Velocities,
    pub(super) blocks: Vec<Block>,
    /// What moving solids made of stairs hand along their surfaces \[B1\].
    pub(super) hand_over: HandOver,
    /// Populations after the last collision; before the first one at step 0.
    pub(super) old: Vec<Aligned<E>>,
    /// Where the next collision puts its result.
    pub(super) new: Vec<Aligned<E>>,
    pub(super) rim: Vec<Vec<Rim>>,
    /// What comes back along cut links, by block.
    pub(super) cut_returned: Vec<Vec<f64>>,
    /// ρ − 1 before the last collision; only with the viscosity-independent wall.
    pub(super) density: Vec<Vec<f64>>,
    /// ω⁺ of the last collision; only for the lagged treatment.
    pub(super) lag: Vec<Vec<f64>>,
    pub(super) surface: Option<Surface>,
    /// Grains in the fluid; only absent while they look at the cells.
    pub(super) grains: Option<Box<Immersed>>,
    /// Loads on solids where no surface keeps them.
    pub(super) loads: Vec<Load>,
    /// No collision yet.
    pub(super) fresh: bool,
    pub(super) step: u64,
    /// Seconds spent so far in: collision, walls, surface, surfaces of grains, motion of grains.
    pub(super) seconds: [f64; 5],
    pub(super) fluid_cells: u64,
    pub(super) pool: Option<Arc<rayon::ThreadPool>>,
}

impl<P: Physics, E: Element> FastRun<P, E> {
    /// Allocates and initialises.
    ///
    /// # Errors
    /// The setup is inconsistent, or asks for what this backend does not have.
    pub(crate) fn start(
        setup: &Setup,
        physics: P,
        chosen: Chosen,
        passes: Passes<P, E>,
    ) -> Result<Self, StartError> {
        crate::solver::check::check(setup)?;
        let unsupported = |feature| StartError::Unsupported { backend: "fast", feature };
        if setup.stress_source {
            return Err(unsupported("the experimental source in the third moments"));
        }
        if !P::VARIES && physics.constant_omega().is_none() {
            return Err(unsupported("several Newtonian fluids in the pass made for one"));
        }
        let layout = Layout::new(setup.extents, E::PER_LINE);
        let mut run = Self {
            setup: setup.clone(),
            physics,
            chosen,
            passes,
            sources: Sources::all::<E>(&layout),
            layout,
            velocities: Velocities::default(),
            blocks: Vec::new(),
            hand_over: HandOver::new(setup),
            old: Vec::new(),
            new: Vec::new(),
            rim: Vec::new(),
            cut_returned: Vec::new(),
            density: Vec::new(),
            lag: Vec::new(),
            surface: None,
            grains: None,
            loads: Vec::new(),
            fresh: true,
            step: 0,
            seconds: [0.0; 5],
            fluid_cells: 0,
            pool: pool::start(setup.threads),
        };
        if setup.free_surface.is_some() || setup.grains.is_some() {
            run.start_surface()?;
        } else {
            for place in 0..run.layout.places() {
                run.add_block(place);
            }
            run.fill_in();
            run.loads = vec![Load::default(); recorded(setup)];
        }
        Ok(run)
    }

    /// Whether walls are corrected \[B3\].
    pub(super) fn corrected(&self) -> bool {
        self.setup.wall_rule == WallRule::ViscosityIndependent
    }

    /// Makes the block at a place, unless it would hold no cell that can be fluid; returns its number.
    pub(super) fn add_block(&mut self, place: usize) -> Option<usize> {
        let block = Block::new(&self.setup, &self.layout, place, E::PER_LINE, &mut self.velocities);
        if block.usable.iter().all(|&lanes| lanes == 0) {
            return None;
        }
        let cells = self.layout.block_cells();
        let given_up = self.surface.as_mut().and_then(|surface| surface.free.pop());
        let number = given_up.unwrap_or(self.blocks.len());
        self.layout.set_block(place, number as u32);
        let open = block.rim.iter().any(|cell| cell.open);
        let rim = if self.corrected() || open { block.rim.len() } else { 0 };
        let walls = self.corrected() && super::memory::has_walls(&self.setup);
        put(&mut self.rim, number, vec![Rim::default(); rim]);
        put(&mut self.cut_returned, number, vec![0.0; block.cuts.links.len()]);
        put(&mut self.density, number, vec![0.0; if walls { cells } else { 0 }]);
        let lagged = matches!(self.setup.yielding, YieldTreatment::LaggedClamped { .. });
        put(&mut self.lag, number, vec![0.0; if lagged { cells } else { 0 }]);
        put(&mut self.old, number, Aligned::zeros(self.layout.block_len()));
        put(&mut self.new, number, Aligned::zeros(self.layout.block_len()));
        put(&mut self.blocks, number, block);
        Some(number)
    }

    /// Starting populations of every cell, block by block.
    fn fill_in(&mut self) {
        let force = self.setup.force.at(0);
        let (setup, layout) = (&self.setup, &self.layout);
        let work = |((block, old), lag): ((&Block, &mut Aligned<E>), &mut Vec<f64>)| {
            let mut count = 0;
            for local in 0..layout.block_cells() {
                if block.usable[local / E::PER_LINE] >> (local % E::PER_LINE) & 1 == 0 {
                    continue;
                }
                count += 1;
                let at = layout.cell(block.origin, local);
                let point = setup.initial.as_ref().map_or(initial::REST, |flow| flow(at));
                let cell = setup.index(at);
                let f = initial::start(&point, &setup.law(cell), &force);
                for (i, f) in f.iter().enumerate() {
                    old.get_mut()[index::<E>(local, i)] = E::from_f64(*f);
                }
                if let Some(omega) = lag.get_mut(local) {
                    *omega = initial::starting_omega(setup, cell);
                }
            }
            count
        };
        let blocks = &self.blocks;
        let (old, lag) = (&mut self.old, &mut self.lag);
        self.fluid_cells = match &self.pool {
            Some(pool) => pool.install(|| {
                blocks.par_iter().zip(old.par_iter_mut()).zip(lag.par_iter_mut()).map(work).sum()
            }),
            None => blocks.iter().zip(old.iter_mut()).zip(lag.iter_mut()).map(work).sum(),
        };
    }

    pub(super) fn task(&self, force: [f64; 3]) -> Task<'_, P, E> {
        Task {
            setup: &self.setup,
            physics: &self.physics,
            layout: &self.layout,
            sources: &self.sources,
            blocks: &self.blocks,
            old: &self.old,
            fresh: self.fresh,
            force,
            step: self.step,
            velocities: &self.velocities.list,
            hand_over: &self.hand_over,
            cut_returned: &self.cut_returned,
            past_cache: self.population_bytes() > CACHED,
            surface: self.surface.as_ref().map(Surface::view),
        }
    }

    fn population_bytes(&self) -> u64 {
        self.old.iter().chain(&self.new).map(Aligned::bytes).sum()
    }

    /// One time step.
    fn advance_one(&mut self) -> Result<(), Stopped> {
        let force = self.body_force();
        let mut watch = Instant::now();
        let mut lap = |seconds: &mut f64| {
            let now = Instant::now();
            *seconds += now.duration_since(std::mem::replace(&mut watch, now)).as_secs_f64();
        };
        let outcomes = self.collide_pass(force);
        self.close_last_step(&outcomes)?;
        let failed = outcomes.iter().filter_map(|outcome| outcome.failed).min_by_key(|&(cell, _)| cell);
        if let Some((_, stopped)) = failed {
            return Err(stopped);
        }
        lap(&mut self.seconds[0]);
        self.move_walls();
        self.wall_pass(&force);
        lap(&mut self.seconds[1]);
        std::mem::swap(&mut self.old, &mut self.new);
        self.fresh = false;
        self.cut_pass();
        lap(&mut self.seconds[1]);
        self.exchange_with_grains();
        lap(&mut self.seconds[3]);
        self.book_loads();
        lap(&mut self.seconds[1]);
        self.surface_pass(&force);
        lap(&mut self.seconds[2]);
        self.move_grains()?;
        lap(&mut self.seconds[4]);
        self.step += 1;
        Ok(())
    }

    fn collide_pass(&mut self, force: [f64; 3]) -> Vec<Outcome> {
        let mut new = std::mem::take(&mut self.new);
        let mut rim = std::mem::take(&mut self.rim);
        let mut density = std::mem::take(&mut self.density);
        let mut lag = std::mem::take(&mut self.lag);
        let mut interface = self.surface.as_mut().map_or_else(Vec::new, |s| std::mem::take(&mut s.interface));
        interface.resize_with(new.len(), Vec::new);
        let inertia = self.surface.as_mut().and_then(|s| s.inertia.as_mut());
        let mut velocity = inertia.map_or_else(Vec::new, |inertia| std::mem::take(&mut inertia.velocity));
        velocity.resize_with(new.len(), Vec::new);
        let task = self.task(force);
        let own: Vec<_> = new
            .iter_mut()
            .zip(&mut rim)
            .zip(&mut density)
            .zip(&mut lag)
            .zip(&mut velocity)
            .zip(&mut interface)
            .enumerate()
            .map(|(number, (((((new, rim), density), lag), velocity), interface))| Own {
                number,
                new,
                rim,
                density,
                lag,
                velocity,
                interface,
            })
            .collect();
        let (chosen, collide) = (self.chosen, self.passes.collide);
        let outcomes = each(self.pool.as_deref(), own, |mut own| {
            let outcome = collide(chosen, &task, &mut own);
            stores::fence();
            outcome
        });
        (self.new, self.rim, self.density, self.lag) = (new, rim, density, lag);
        if let Some(surface) = &mut self.surface {
            surface.interface = interface;
            if let Some(inertia) = &mut surface.inertia {
                inertia.velocity = velocity;
            }
        }
        outcomes
    }

    /// Body force of a cell; `None` where it holds no fluid.
    pub(super) fn force_of(&self, number: usize, local: usize, force: &[f64; 3]) -> Option<[f64; 3]> {
        match &self.surface {
            None => Some(*force),
            Some(surface) => surface.force_at(number, local, force),
        }
    }

    /// Whether a cell is no interface cell.
    pub(super) fn is_full(&self, number: usize, local: usize) -> bool {
        self.surface.as_ref().is_none_or(|surface| surface.kinds[number][local] != Kind::Interface)
    }

    /// Whether a cell holds fluid.
    pub(super) fn is_fluid(&self, place: Place) -> bool {
        let Some(surface) = &self.surface else { return true };
        match self.layout.block_at(place.block as usize) {
            NONE => false,
            number => surface.kinds[number as usize][place.local as usize].is_fluid(),
        }
    }

    /// Populations of a fluid cell before the next collision: what a plain solver stores.
    pub(super) fn arrived(&self, number: usize, local: usize) -> [f64; Q] {
        let task = self.task([0.0; 3]);
        let own = after(&task, number, local);
        if self.fresh {
            return own;
        }
        if let Some(cell) = self.surface.as_ref().and_then(|s| s.record(number, local)) {
            return cell.f;
        }
        let block = &self.blocks[number];
        let mut links = block.links_of_cell(local, E::PER_LINE).iter().peekable();
        // Most cells have all their neighbours in their own block.
        let mut around = None;
        let mut f = own;
        for i in 1..Q {
            let Some(link) = links.next_if(|link| usize::from(link.direction) == i) else {
                let (entry, from) = self.layout.upstream(local, i);
                let there = match entry {
                    13 => number,
                    _ => around.get_or_insert_with(|| numbers_around(&self.layout, block.place))[entry]
                        as usize,
                };
                f[i] = self.old[there].get()[index::<E>(from, i)].to_f64();
                continue;
            };
            f[i] = match link.from {
                Origin::Cell { cell, direction } => {
                    let number = self.layout.block_at(cell.block as usize) as usize;
                    self.old[number].get()[index::<E>(cell.local as usize, usize::from(direction))].to_f64()
                }
                // With a surface the kinds of cells may have changed since.
                Origin::Wall { .. } if self.surface.is_some() => self.returned(number, local, i),
                Origin::Wall { velocity, body, .. } => {
                    let u = &self.velocities.list[velocity as usize];
                    let rho = 1.0 + density_excess(&own);
                    wall_link(&task, number, &self.rim[number], link, rho, u, body)
                }
                Origin::Open => open_link(&task, number, &self.rim[number], link),
            };
        }
        f
    }

    /// What a wall sent back to a liquid cell in the last step with a surface.
    fn returned(&self, number: usize, local: usize, i: usize) -> f64 {
        let links = &self.blocks[number].links;
        let key = |link: &Link| (usize::from(link.local), usize::from(link.direction));
        let place = links.binary_search_by_key(&(local, i), key);
        let returned = self.surface.as_ref().map(|surface| &surface.returned[number]);
        place.ok().zip(returned).map_or(0.0, |(place, returned)| returned[place])
    }

    pub(super) fn run(&mut self, steps: u64) -> Result<(), Stopped> {
        let pool = self.pool.clone();
        within(pool.as_deref(), || (0..steps).try_for_each(|_| self.advance_one()))
    }
}
