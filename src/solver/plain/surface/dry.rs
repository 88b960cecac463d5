//! Voids \[F8\], and viscous momentum above the surface \[F9\].

use super::{Surface, SurfacePhysics};
use crate::boundary::links::{Links, Source};
use crate::free_surface::Kind;
use crate::free_surface::contact::{Contact, sent_back};
use crate::free_surface::conversion::touch;
use crate::free_surface::shares::{dry_share, dry_share_at_wall, even, taken_back, viscous};
use crate::free_surface::voids::give_up;
use crate::lattice::moments::density_excess;
use crate::lattice::{Q, opposite};
use crate::solver::cell::Cell;
use crate::solver::physics::Physics;
use crate::solver::plain::passes::chunks;
use crate::solver::plain::run::{CHUNK, PlainRun};
use crate::solver::pool::each;

/// Populations of this step.
#[derive(Clone, Copy)]
struct Streamed<'a> {
    links: &'a Links,
    after: &'a [Cell],
    arrived: &'a [Cell],
}

impl<P: Physics, S: SurfacePhysics> PlainRun<P, S> {
    /// What interface cells take back in the next collision; reads populations after collision and after streaming.
    pub(in crate::solver::plain) fn dry_pass(&mut self) {
        let Some(surface) = &mut self.surface else { return };
        let mut dry = std::mem::take(&mut surface.dry);
        let items = dry.chunks_mut(CHUNK).enumerate().collect();
        let Some(surface) = &self.surface else { return };
        let streamed = Streamed { links: &self.links, after: &self.post, arrived: &self.f };
        each(self.pool.as_deref(), items, |(k, chunk): (usize, &mut [[f64; 3]])| {
            for (j, dry) in chunk.iter_mut().enumerate() {
                let cell = k * CHUNK + j;
                *dry = match surface.kinds[cell] {
                    Kind::Interface => surface.dry_exchange(&streamed, cell),
                    Kind::Gas | Kind::Liquid | Kind::Solid => [0.0; 3],
                };
            }
        });
        if let Some(surface) = &mut self.surface {
            surface.dry = dry;
        }
    }

    /// Partly filled cells without gas neighbour give up density, after the books have read what came over the links.
    pub(in crate::solver::plain) fn close_voids(&mut self) {
        let Some(surface) = &self.surface else { return };
        let count = self.f.len().div_ceil(CHUNK);
        let items = chunks(&mut self.f, count).into_iter().enumerate().collect();
        each(self.pool.as_deref(), items, |(k, chunk): (usize, &mut [Cell])| {
            for (j, f) in chunk.iter_mut().enumerate() {
                let cell = k * CHUNK + j;
                if surface.kinds[cell] == Kind::Interface && surface.touches[cell] & touch::GAS == 0 {
                    let density = surface.equations.void_sink(surface.fill[cell], density_excess(f));
                    give_up(f, density);
                }
            }
        });
    }
}

impl<S: SurfacePhysics> Surface<S> {
    /// −Σ (1 − A) c v of an interface cell.
    #[inline(never)]
    fn dry_exchange(&self, streamed: &Streamed, cell: usize) -> [f64; 3] {
        let Streamed { links, after, arrived } = *streamed;
        let fill = self.fill[cell];
        let even_at = |at: usize, i: usize| even(i, density_excess(&after[at]), &self.velocity[at]);
        let mut contact = None;
        let mut parts = [0.0; Q];
        for i in 1..Q {
            let out = opposite(i);
            let here = even_at(cell, out);
            parts[i] = match links.source(cell, i) {
                Source::Open => continue,
                Source::Wall { .. } => {
                    let contact = contact.get_or_insert_with(|| self.contact_at(links, cell));
                    let brought = viscous(arrived[cell][i], after[cell][out], here, here);
                    self.equations.dry_share_at_wall(dry_share_at_wall(fill, out, &contact.along)) * brought
                }
                Source::Cell { cell: from, direction } => {
                    let (from, direction) = (from as usize, usize::from(direction));
                    if self.kinds[from] != Kind::Interface {
                        continue;
                    }
                    let there = even_at(from, direction);
                    let brought = viscous(arrived[cell][i], after[cell][out], there, here);
                    self.equations.dry_share(dry_share(fill, self.fill[from])) * brought
                }
            };
        }
        taken_back(&parts, &self.velocity[cell])
    }

    /// The surface at a cell beside walls; grains count as the cell itself.
    pub(in crate::solver::plain) fn contact_at(&self, links: &Links, cell: usize) -> Contact {
        let fill = self.fill[cell];
        Contact::new(
            fill,
            &std::array::from_fn(|i| match links.source(cell, opposite(i)) {
                Source::Cell { cell: there, .. } if self.kinds[there as usize] == Kind::Solid => Some(fill),
                Source::Cell { cell: there, .. } => Some(self.fill[there as usize]),
                Source::Wall { .. } | Source::Open => None,
            }),
        )
    }

    /// What comes back to an interface cell along −c_out from a wall that returns `wall`, and from the gas before it \[F10\].
    pub(in crate::solver::plain) fn meet_wall(
        &self,
        after: &[Cell],
        contact: &Contact,
        (cell, out): (usize, usize),
        wall: f64,
    ) -> f64 {
        let share = self.equations.meeting(contact.meeting(out));
        sent_back(wall, self.gas_link(after, cell, out), share)
    }
}
