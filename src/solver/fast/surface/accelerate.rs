//! Accelerations of one step, for the surface force with inertia \[F3\].

use super::inertia::{Inertia, get, set};
use super::record::InterfaceCell;
use crate::free_surface::Kind;
use crate::free_surface::conversion::mirrored;
use crate::free_surface::force::smooth;
use crate::lattice::Q;
use crate::lattice::moments::density_excess;
use crate::solver::fast::block::{Block, Origin, numbers_around};
use crate::solver::fast::element::Element;
use crate::solver::fast::layout::NONE;
use crate::solver::fast::run::FastRun;
use crate::solver::physics::Physics;
use crate::solver::pool::each;

impl<P: Physics, E: Element> FastRun<P, E> {
    /// Smoothed acceleration of every fluid cell, from the velocities of this and the last collision.
    pub(super) fn accelerate(&mut self) {
        let Some(surface) = &mut self.surface else { return };
        let Some(inertia) = surface.inertia.as_mut().filter(|inertia| inertia.started) else { return };
        let Inertia { velocity, before, acceleration, .. } = inertia;
        let items: Vec<_> = acceleration.iter_mut().zip(velocity).zip(before).zip(&surface.kinds).collect();
        each(self.pool.as_deref(), items, |(((acceleration, velocity), before), kinds)| {
            for (local, kind) in kinds.iter().enumerate() {
                let to = if kind.is_fluid() {
                    let (now, then) = (get(velocity, local), get(before, local));
                    let change = std::array::from_fn(|a| now[a] - then[a]);
                    smooth(&get(acceleration, local), &change)
                } else {
                    [0.0; 3]
                };
                set(acceleration, local, &to);
            }
        });
    }

    /// After the conversions: what the next step takes as the collision before, and the acceleration around
    /// every interface cell.
    pub(super) fn spread_acceleration(&mut self) {
        let Some(surface) = &mut self.surface else { return };
        let Some(inertia) = &mut surface.inertia else { return };
        inertia.started = true;
        for (before, velocity) in inertia.before.iter_mut().zip(&inertia.velocity) {
            before.copy_from_slice(velocity);
        }
        let mut interface = std::mem::take(&mut surface.interface);
        let this = &*self;
        let items: Vec<_> = interface.iter_mut().enumerate().filter(|(_, list)| !list.is_empty()).collect();
        each(this.pool.as_deref(), items, |(number, list): (usize, &mut Vec<InterfaceCell>)| {
            let block = &this.blocks[number];
            let around = numbers_around(&this.layout, block.place);
            for cell in list {
                cell.acceleration = this.acceleration_around(block, &around, usize::from(cell.local));
            }
        });
        if let Some(surface) = &mut self.surface {
            surface.interface = interface;
        }
    }

    /// Mean smoothed acceleration of the liquid neighbours; zero without any.
    fn acceleration_around(&self, block: &Block, around: &[u32; 27], local: usize) -> [f64; 3] {
        let Some(surface) = &self.surface else { return [0.0; 3] };
        let Some(inertia) = &surface.inertia else { return [0.0; 3] };
        let mut parts = [[0.0; Q]; 3];
        let mut count = 0;
        let mut links = block.links_of_cell(local, E::PER_LINE).iter().peekable();
        for i in 1..Q {
            let (number, from, direction) = match links.next_if(|link| usize::from(link.direction) == i) {
                None => {
                    let (entry, from) = self.layout.upstream(local, i);
                    (around[entry], from, i)
                }
                Some(link) => match link.from {
                    Origin::Cell { cell, direction } => {
                        let number = self.layout.block_at(cell.block as usize);
                        (number, cell.local as usize, usize::from(direction))
                    }
                    Origin::Wall { .. } | Origin::Open => continue,
                },
            };
            if number == NONE || surface.kinds[number as usize][from] != Kind::Liquid {
                continue;
            }
            count += 1;
            let acceleration = inertia.acceleration_of(number as usize, from);
            for (a, part) in parts.iter_mut().enumerate() {
                part[i] = mirrored(i, direction, a) * acceleration[a];
            }
        }
        parts.map(|part| if count > 0 { density_excess(&part) / f64::from(count) } else { 0.0 })
    }
}
