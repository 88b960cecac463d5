//! Mass exchange of interface cells \[F1\], and what gas and open faces send back \[F2\].

use super::{Collided, Surface, SurfaceLink, SurfacePhysics};
use crate::boundary::hand_over::HandOver;
use crate::boundary::links::{Links, Source};
use crate::free_surface::Kind;
use crate::free_surface::conversion::touch;
use crate::free_surface::exchange::{carried_among, gas_link, wetted_share};
use crate::lane::Lane;
use crate::lattice::equilibrium::dot;
use crate::lattice::moments::density_excess;
use crate::lattice::{Q, opposite};
use crate::solver::books::mass_handed;
use crate::solver::cell::Cell;
use crate::solver::physics::Physics;
use crate::solver::plain::passes::chunks;
use crate::solver::plain::run::{CHUNK, PlainRun};
use crate::solver::pool::each;

/// What the exchange writes of the cells from `start` on.
struct ExchangeChunk<'a> {
    start: usize,
    mass: &'a mut [f64],
    touches: &'a mut [u8],
}

impl<P: Physics, S: SurfacePhysics> PlainRun<P, S> {
    /// Moves mass over the links of interface cells, before anything streams.
    pub(in crate::solver::plain) fn exchange_mass(&mut self) {
        let carried = self.carried_shares();
        let Some(surface) = &mut self.surface else { return };
        let mut mass = std::mem::take(&mut surface.mass);
        let mut touches = std::mem::take(&mut surface.touches);
        let count = mass.len().div_ceil(CHUNK);
        let items = chunks(&mut mass, count)
            .into_iter()
            .zip(chunks(&mut touches, count))
            .enumerate()
            .map(|(k, (mass, touches))| ExchangeChunk { start: k * CHUNK, mass, touches })
            .collect();
        let Some(surface) = &self.surface else { return };
        each(self.pool.as_deref(), items, |chunk: ExchangeChunk| {
            for (k, mass) in chunk.mass.iter_mut().enumerate() {
                if surface.kinds[chunk.start + k] == Kind::Interface {
                    let (gained, touches) = self.exchange_cell(surface, &carried, chunk.start + k);
                    *mass += gained;
                    chunk.touches[k] = touches;
                }
            }
        });
        if let Some(surface) = &mut self.surface {
            (surface.mass, surface.touches) = (mass, touches);
        }
    }

    /// c of every interface cell, φ of the others.
    fn carried_shares(&self) -> Vec<f64> {
        let Some(surface) = &self.surface else { return Vec::new() };
        let mut carried = surface.fill.clone();
        let items = carried.chunks_mut(CHUNK).enumerate().collect();
        each(self.pool.as_deref(), items, |(k, chunk): (usize, &mut [f64])| {
            for (j, carried) in chunk.iter_mut().enumerate() {
                if surface.kinds[k * CHUNK + j] == Kind::Interface {
                    *carried = surface.carried_share(&self.links, k * CHUNK + j);
                }
            }
        });
        carried
    }

    /// Δm and neighbours of an interface cell.
    #[inline(never)]
    fn exchange_cell(&self, surface: &Surface<S>, carried: &[f64], cell: usize) -> (f64, u8) {
        let collided = Collided {
            before: &self.f,
            after: &self.post,
            kinds: &surface.kinds,
            fill: &surface.fill,
            carried,
        };
        let at = self.setup.coordinates(cell);
        let mut gained = [0.0; Q];
        let mut touches = 0;
        for i in 1..Q {
            match self.links.source_at(cell, at, i) {
                Source::Wall { .. } => touches |= touch::WALL,
                Source::Open => {
                    let leaving = self.post[cell][opposite(i)];
                    gained[i] = surface.fill[cell] * (self.open_link(cell, i) - leaving);
                }
                Source::Cell { cell: from, direction } => {
                    let from = from as usize;
                    match surface.kinds[from] {
                        // Covered by a grain.
                        Kind::Solid => touches |= touch::WALL,
                        Kind::Gas => touches |= touch::GAS,
                        kind @ (Kind::Liquid | Kind::Interface) => {
                            if kind == Kind::Liquid {
                                touches |= touch::LIQUID;
                            }
                            let link = SurfaceLink { cell, i, from, direction: usize::from(direction) };
                            gained[i] = surface.equations.gained(&collided, &link);
                        }
                    }
                }
            }
        }
        (density_excess(&gained) - surface.handed(&self.hand_over, cell), touches)
    }

    /// What an open face sends back in direction `i`: as gas where fluid leaves, as a wall at rest where
    /// it would come in, over the whole face or over this link. Open faces come with a surface only.
    #[inline]
    pub(in crate::solver::plain) fn open_link(&self, cell: usize, i: usize) -> f64 {
        let out = opposite(i);
        let leaving = self.post[cell][out];
        match &self.surface {
            Some(surface) if dot(out, &surface.velocity[cell]) > 0.0 => {
                f64::smaller(gas_link(leaving, out, &surface.velocity[cell]), leaving)
            }
            Some(_) | None => leaving,
        }
    }
}

impl<S: SurfacePhysics> Surface<S> {
    /// c of an interface cell.
    fn carried_share(&self, links: &Links, cell: usize) -> f64 {
        carried_among(self.fill[cell], &self.contact_at(links, cell).along, |i| match links.source(cell, i) {
            Source::Cell { cell: from, .. } => Some(self.kinds[from as usize]),
            Source::Wall { .. } | Source::Open => None,
        })
    }

    /// Whether the population that would come `from` a cell is sent back by gas: only interface touches gas.
    #[inline]
    pub(in crate::solver::plain) fn is_gas_link(&self, cell: usize, from: usize) -> bool {
        self.kinds[cell] == Kind::Interface && self.kinds[from] == Kind::Gas
    }

    /// Mass that an interface cell hands along the surfaces of moving solids \[B1\].
    pub(super) fn handed(&self, hand_over: &HandOver, cell: usize) -> f64 {
        if hand_over.is_empty() {
            return 0.0;
        }
        let share = |there: usize| wetted_share(self.kinds[there], self.fill[cell], self.fill[there]);
        mass_handed(hand_over, cell, share)
    }

    /// What the gas sends back to a cell along −c_out; `after`: populations after collision.
    #[inline]
    pub(in crate::solver::plain) fn gas_link(&self, after: &[Cell], cell: usize, out: usize) -> f64 {
        self.equations.gas_link(after, cell, out, &self.velocity[cell])
    }
}
