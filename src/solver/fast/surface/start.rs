//! How a run with a free surface begins.

use super::record::{InterfaceCell, Lanes};
use super::state::Surface;
use crate::boundary::links::{Source, resolve};
use crate::coupling::Immersed;
use crate::free_surface::conversion::touch;
use crate::free_surface::exchange::{GAS, LIQUID};
use crate::free_surface::{Kind, classify, hydrostatic};
use crate::lattice::Q;
use crate::lattice::moments::density_excess;
use crate::setup::{FlowPoint, FreeSurface};
use crate::solver::fast::block::put;
use crate::solver::fast::element::{Element, index};
use crate::solver::fast::run::FastRun;
use crate::solver::initial::{self, REST};
use crate::solver::loads::recorded;
use crate::solver::physics::Physics;
use crate::solver::run::StartError;

impl<P: Physics, E: Element> FastRun<P, E> {
    /// Blocks, populations, masses and the ledger.
    ///
    /// # Errors
    /// The setup asks for what this backend does not have.
    pub(in crate::solver::fast) fn start_surface(&mut self) -> Result<(), StartError> {
        let unsupported = |feature| StartError::Unsupported { backend: "fast", feature };
        self.immerse_grains()?;
        let drawn = self.setup.free_surface.take();
        let with_gas = drawn.is_some();
        // Grains need the kinds of cells with or without gas.
        let mut rules = drawn.unwrap_or_else(|| FreeSurface::new(vec![1.0; self.setup.cells()]));
        if self.setup.fluids.len() > 1 {
            return Err(unsupported("several fluids below a free surface"));
        }
        // The initial fill is as large as the box; it is not kept.
        let fill = std::mem::replace(&mut rules.fill, std::sync::Arc::new([]));
        let setup = &self.setup;
        let kinds = classify(&fill, |cell| setup.is_solid(cell), |cell| neighbours(setup, cell));
        let own_fill = |cell: usize| match kinds[cell] {
            Kind::Liquid => 1.0,
            Kind::Interface => fill[cell],
            Kind::Gas | Kind::Solid => 0.0,
        };
        let drawn_force = setup.force.at(0);
        let excess = match setup.initial {
            Some(_) => Vec::new(),
            // Without a surface nothing says where the pressure is that of the gas.
            None if !with_gas => vec![0.0; kinds.len()],
            None => {
                let fill: Vec<f64> = (0..kinds.len()).map(own_fill).collect();
                hydrostatic::density_excess(setup.extents, setup.periodic_axes(), &kinds, &fill, &drawn_force)
            }
        };
        let mut wet = vec![false; self.layout.places()];
        for (cell, kind) in kinds.iter().enumerate() {
            if kind.is_fluid() {
                wet[self.layout.find(setup.coordinates(cell)).0] = true;
            }
        }
        let loads = recorded(setup);
        self.surface = Some(Surface::new(rules.clone(), loads, self.layout.block_cells()));
        if with_gas {
            self.setup.free_surface = Some(rules);
        }
        let force = self.body_force();
        for place in (0..wet.len()).filter(|&place| wet[place]) {
            if let Some(number) = self.add_surface_block(place) {
                self.fill_block(number, &kinds, &own_fill, &excess, &force);
            }
        }
        self.start_grains();
        self.open_books();
        Ok(())
    }

    /// Puts the grains in, if there are any.
    fn immerse_grains(&mut self) -> Result<(), StartError> {
        let Some(grains) = &self.setup.grains else { return Ok(()) };
        let immersed =
            Immersed::new(&self.setup, grains).map_err(|error| StartError::Grains(Box::new(error)))?;
        self.grains = Some(Box::new(immersed));
        Ok(())
    }

    /// Makes a block of gas and solid cells; returns its number.
    pub(in crate::solver::fast) fn add_surface_block(&mut self, place: usize) -> Option<usize> {
        let number = self.add_block(place)?;
        let cells = self.layout.block_cells();
        let kinds = (0..cells).map(|local| {
            let usable = self.blocks[number].is_usable(local);
            if usable { Kind::Gas } else { Kind::Solid }
        });
        let kinds = kinds.collect();
        let surface = self.surface.as_mut()?;
        put(&mut surface.kinds, number, kinds);
        put(&mut surface.fill, number, vec![GAS; cells]);
        put(&mut surface.lanes, number, vec![Lanes::default(); cells / E::PER_LINE]);
        put(&mut surface.interface, number, Vec::new());
        put(&mut surface.flow, number, Vec::new());
        if let Some(inertia) = &mut surface.inertia {
            inertia.add(number, cells);
        }
        put(&mut surface.returned, number, vec![0.0; self.blocks[number].links.len()]);
        put(&mut surface.covered, number, 0);
        Some(number)
    }

    fn fill_block(
        &mut self,
        number: usize,
        kinds: &[Kind],
        fill: &impl Fn(usize) -> f64,
        excess: &[f64],
        force: &[f64; 3],
    ) {
        let (setup, layout) = (&self.setup, &self.layout);
        let Some(surface) = &mut self.surface else { return };
        for local in 0..layout.block_cells() {
            if !self.blocks[number].is_usable(local) {
                continue;
            }
            let at = layout.cell(self.blocks[number].origin, local);
            let cell = setup.index(at);
            if let Some(omega) = self.lag[number].get_mut(local) {
                *omega = initial::starting_omega(setup, cell);
            }
            if !kinds[cell].is_fluid() {
                continue;
            }
            surface.kinds[number][local] = kinds[cell];
            surface.fill[number][local] = if kinds[cell] == Kind::Liquid { LIQUID } else { fill(cell) };
            let point = match &setup.initial {
                Some(flow) => flow(at),
                None => FlowPoint { density: 1.0 + excess[cell], ..REST },
            };
            let here = surface.force_at(number, local, force).unwrap_or(*force);
            let f = initial::start(&point, &setup.law(cell), &here);
            for (i, f) in f.iter().enumerate() {
                self.old[number].get_mut()[index::<E>(local, i)] = E::from_f64(*f);
            }
            surface.counts[usize::from(kinds[cell] == Kind::Interface)] += 1;
            if kinds[cell] == Kind::Interface {
                let rho = 1.0 + density_excess(&f);
                let mass = fill(cell) * rho;
                let velocity = point.velocity;
                let local = local as u16;
                surface.interface[number].push(InterfaceCell {
                    local,
                    touches: touch::GAS,
                    f,
                    rho,
                    velocity,
                    mass,
                    dry: [0.0; 3],
                    acceleration: [0.0; 3],
                });
            }
        }
        surface.list_lanes(number, E::PER_LINE);
    }
}

/// The cells that the links of a cell lead to.
fn neighbours(setup: &crate::setup::Setup, cell: usize) -> Vec<usize> {
    let at = setup.coordinates(cell);
    let through = |i| match resolve(setup, at, i).0 {
        Source::Cell { cell, .. } => Some(cell as usize),
        Source::Wall { .. } | Source::Open => None,
    };
    (1..Q).filter_map(through).collect()
}
