//! Accelerations for the surface force with inertia \[F3\]; nothing of this exists without that rule.

use super::super::block::{Block, Origin, numbers_around};
use super::super::element::Element;
use super::super::layout::NONE;
use super::super::run::FastRun;
use super::InterfaceCell;
use crate::free_surface::Kind;
use crate::free_surface::conversion::mirrored;
use crate::free_surface::force::smooth;
use crate::lattice::Q;
use crate::lattice::moments::density_excess;
use crate::solver::physics::Physics;
use crate::solver::pool::each;

/// Three numbers per cell of a block: first those along x, then y, then z.
type Vectors = Vec<f64>;

/// Velocities of two collisions and the smoothed acceleration, by block.
#[derive(Clone, Debug, Default)]
pub struct Inertia {
    /// u of the last collision, and of cells that have become fluid since.
    pub velocity: Vec<Vectors>,
    /// u of the collision before.
    before: Vec<Vectors>,
    acceleration: Vec<Vectors>,
    /// Whether there has been a collision before the last one.
    started: bool,
}

/// The vector of a cell.
fn get(vectors: &[f64], local: usize) -> [f64; 3] {
    let cells = vectors.len() / 3;
    std::array::from_fn(|a| vectors[a * cells + local])
}

fn set(vectors: &mut [f64], local: usize, to: &[f64; 3]) {
    let cells = vectors.len() / 3;
    for (a, to) in to.iter().enumerate() {
        vectors[a * cells + local] = *to;
    }
}

impl Inertia {
    /// Makes room for a block.
    pub fn add(&mut self, number: usize, cells: usize) {
        for list in [&mut self.velocity, &mut self.before, &mut self.acceleration] {
            super::put(list, number, vec![0.0; 3 * cells]);
        }
    }

    /// Gives a block up.
    pub fn drop_block(&mut self, number: usize) {
        for list in [&mut self.velocity, &mut self.before, &mut self.acceleration] {
            list[number] = Vec::new();
        }
    }

    /// A cell that has become fluid.
    pub fn wet(&mut self, number: usize, local: usize, velocity: &[f64; 3]) {
        set(&mut self.velocity[number], local, velocity);
        set(&mut self.acceleration[number], local, &[0.0; 3]);
    }

    /// A cell that a grain has given free: nothing is known of its past.
    pub fn uncover(&mut self, number: usize, local: usize, velocity: &[f64; 3]) {
        self.wet(number, local, velocity);
        set(&mut self.before[number], local, velocity);
    }

    /// Acceleration of a cell.
    #[must_use]
    pub fn acceleration_of(&self, number: usize, local: usize) -> [f64; 3] {
        get(&self.acceleration[number], local)
    }

    /// Bytes held.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        let lists = [&self.velocity, &self.before, &self.acceleration];
        lists.iter().flat_map(|list| list.iter()).map(|v| size_of_val(v.as_slice()) as u64).sum()
    }
}

impl<P: Physics, E: Element> FastRun<P, E> {
    /// Smoothed acceleration of every fluid cell, from the velocities of this and the last collision.
    pub(super) fn accelerate(&mut self) {
        let Some(surface) = &mut self.surface else { return };
        let Some(inertia) = surface.inertia.as_mut().filter(|inertia| inertia.started) else { return };
        let Inertia { velocity, before, acceleration, .. } = inertia;
        let items: Vec<_> = acceleration.iter_mut().zip(velocity).zip(before).zip(&surface.kinds).collect();
        each(self.pool.as_ref(), items, |(((acceleration, velocity), before), kinds)| {
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
        each(this.pool.as_ref(), items, |(number, list): (usize, &mut Vec<InterfaceCell>)| {
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
