//! What a grain's surface returns to the fluid, and the force and torque that it takes from it \[C1\] \[C2\].

use super::L3;
use super::gather::{Gathered, Open, Pressed};
use super::host::Host;
use super::immersed::{Immersed, on_pool};
use super::load::{BodyLoad, Returned};
use super::predict::middle;
use crate::lattice::{C, W};
use crate::setup::suspension::GrainWall;
use crate::vector::{cross, norm};
use rayon::prelude::*;

/// Grains answered before what they return is put in place: it is still in the cache then.
const TURN: usize = 256;

/// What is needed while a grain answers, for one after the other.
#[derive(Default)]
struct Scratch {
    gathered: Gathered,
    volumes: Volumes,
}

impl Immersed {
    /// Returns populations from all surfaces and finds the forces on all grains; between collision and streaming.
    pub(crate) fn exchange(&mut self, host: &mut dyn Host) {
        let force = host.setup().force.at(host.step_number());
        let mut answers = std::mem::take(&mut self.answers);
        answers.resize_with(TURN.min(self.grains()), Returned::default);
        let pressed: Vec<Pressed> = {
            let (this, host) = (&*self, &*host);
            let work = || (0..this.grains()).into_par_iter().map(|grain| this.pressed(host, grain)).collect();
            on_pool(&this.alone, host.pool(), work)
        };
        for first in (0..self.grains()).step_by(TURN) {
            let many = TURN.min(self.grains() - first);
            let turn = &mut answers[..many];
            {
                let (this, host) = (&*self, &*host);
                on_pool(&this.alone, host.pool(), || {
                    turn.par_iter_mut().enumerate().for_each_init(
                        Scratch::default,
                        |scratch, (k, returned)| {
                            this.answer(host, first + k, (&pressed, &force), scratch, returned);
                        },
                    );
                });
            }
            for (k, own) in turn.iter().enumerate() {
                self.hand_over(host, first + k, own);
            }
        }
        self.answers = answers;
    }

    /// Puts what a grain returns in its places, and enters it in the books.
    fn hand_over(&mut self, host: &mut dyn Host, grain: usize, own: &Returned) {
        for &(place, value) in &own.values {
            host.put(place, value);
        }
        for &(cell, mass) in &own.gained {
            host.add_mass(cell as usize, mass);
        }
        host.book(own.mass, &own.momentum);
        self.books.enter_links(own);
        self.loads[grain] = own.load;
        self.owed[grain] -= own.excess;
        self.debt[grain] -= own.mass;
    }

    /// Velocity of the surface, populations returned, force and torque.
    fn answer(
        &self,
        host: &dyn Host,
        grain: usize,
        (pressed, force): (&[Pressed], &L3),
        scratch: &mut Scratch,
        returned: &mut Returned,
    ) {
        let Scratch { gathered: own, volumes } = scratch;
        self.gather(host, grain, own);
        let motion = self.motion(grain);
        let held = self.blocked_force(host, grain, pressed);
        let rest = self.rest_force(grain, own, force);
        let w = if self.is_driven(grain) {
            motion
        } else {
            let mut other: [f64; 6] = std::array::from_fn(|a| rest[a] + held[a]);
            let weight = self.weight(grain);
            for a in 0..3 {
                other[a] += weight[a];
            }
            let links: [f64; 6] = std::array::from_fn(|a| other[a] + self.loads[grain].links[a]);
            let contact = self.expected_contact(grain, &links);
            for a in 0..6 {
                other[a] += contact[a];
            }
            middle(&own.friction, self.mass(grain), &self.inertia(grain), &motion, &other)
        };
        returned.start();
        let settled = self.settlement(grain, &w);
        self.volumes(host, (own, pressed[grain].blocked), &w, settled, volumes);
        let mut links = [0.0; 6];
        for (open, moved) in own.open.iter().zip(&volumes.moved) {
            self.close(host, open, (volumes, moved), &mut links, returned);
        }
        returned.load = BodyLoad { links, held, rest, wet_links: own.open.len() as u32 };
    }

    /// One link with the velocity of the surface \[B1\], force and torque of the link \[C2\].
    ///
    /// The force is that of the momentum exchanged relative to the moving surface: what the surface gives to the
    /// fluid as mass keeps its own velocity and pushes nobody.
    ///
    /// # Source
    /// Wen, Zhang, Tu, Wang & Fang 2014, J. Comput. Phys. 266, 161 (Galilean invariant momentum exchange), with
    /// populations f − w: the pressure of the gas acts on all sides alike and drops out.
    fn close(
        &self,
        host: &dyn Host,
        open: &Open,
        (volumes, moved): (&Volumes, &Moved),
        links: &mut [f64; 6],
        returned: &mut Returned,
    ) {
        let out = usize::from(open.link.out);
        let Moved { ideal, u, moving } = *moved;
        let leak = if open.interface { 0.0 } else { W[out] * volumes.leak };
        let value = host.stored((open.base + open.share * moving) - leak);
        let place = host.place(open.link.covered as usize, usize::from(open.link.slot));
        returned.values.push((place, value));
        let (given, taken) = (open.leaving + value, open.leaving - value);
        let c = C[out].map(f64::from);
        let push: L3 = std::array::from_fn(|a| c[a] * given - u[a] * taken);
        let turn = cross(open.arm(), push);
        for a in 0..3 {
            links[a] += push[a];
            links[a + 3] += turn[a];
            returned.momentum[a] -= c[a] * given;
        }
        if open.interface {
            // Its mass is its own and follows the wet share.
            let gained = W[out] * volumes.surplus - open.wet * taken;
            returned.gained.push((open.link.cell, gained));
            returned.mass += gained;
        } else {
            returned.mass -= taken;
            returned.excess -= (taken + ideal) - W[out] * volumes.blocked;
        }
    }

    /// Velocity of the surface at a link, and what it adds to a half-way link \[B1\].
    fn moving(&self, host: &dyn Host, (arm, out): (&L3, usize), rho: f64, w: &[f64; 6]) -> (L3, f64) {
        let u = self.config.equations.surface_velocity([w[0], w[1], w[2]], [w[3], w[4], w[5]], *arm);
        (u, host.moving_wall(out, rho, &u))
    }

    /// What the surface of a grain displaces, and what of it cannot go where it should.
    ///
    /// Interpolated links return more or less mass than half-way links. What the surface pushes away where a wall or
    /// another grain leaves no cell has to come out beside: over a closed staircase the volumes pushed and pulled
    /// cancel, so that those of all links but the blocked ones tell what is missing. And a link to a liquid cell
    /// returns all of its mass even where the other end is only partly wet: the interface cells around take the rest
    /// back, or a body that sinks through the surface would push half a layer of cells too much.
    ///
    /// A grain that is wedged in may have one open link for fifty blocked ones. No link takes more than the fastest
    /// part of the surface displaces there, or it would be a jet; what is left stays in the grain's debt.
    fn volumes(
        &self,
        host: &dyn Host,
        (own, obstructed): (&Gathered, bool),
        w: &[f64; 6],
        settled: f64,
        volumes: &mut Volumes,
    ) {
        volumes.moved.clear();
        (volumes.leak, volumes.blocked, volumes.surplus) = (0.0, 0.0, 0.0);
        let (mut liquid, mut interface, mut excess, mut all, mut surplus) = (0.0, 0.0, 0.0, 0.0, 0.0);
        let mut fastest = 0.0_f64;
        for link in &own.open {
            let out = usize::from(link.link.out);
            let (u_middle, straight) = self.moving(host, (&link.middle(), out), link.rho, w);
            let ideal = straight / link.rho;
            let (u, moving) = match self.config.wall {
                GrainWall::HalfWay => (u_middle, straight),
                GrainWall::CentralLinear => self.moving(host, (&link.arm(), out), link.rho, w),
            };
            volumes.moved.push(Moved { ideal, u, moving });
            all += ideal;
            fastest = fastest.max(ideal.abs() / W[out]);
            if link.interface {
                interface += W[out];
                continue;
            }
            liquid += W[out];
            surplus += (1.0 - link.wet) * ideal;
            if self.config.wall != GrainWall::HalfWay {
                excess += ((link.base - link.leaving) + link.share * moving) - straight;
            }
        }
        if obstructed {
            for dry in &own.dry {
                all += self.moving(host, (&dry.middle, usize::from(dry.out)), 1.0, w).1;
            }
        } else {
            all = 0.0;
        }
        if liquid > 0.0 {
            volumes.blocked = (all / liquid).clamp(-fastest, fastest);
            volumes.leak = excess / liquid + volumes.blocked;
        }
        if interface > 0.0 {
            volumes.surplus = ((settled - surplus) / interface).clamp(-fastest, fastest);
        }
    }

    /// Mass that a grain hands back to the interface around it in this step: what the staircase of its waterline has
    /// taken too much or given too much, over one cell of travel.
    fn settlement(&self, grain: usize, w: &[f64; 6]) -> f64 {
        let travel = norm([w[0], w[1], w[2]]);
        self.debt[grain] * travel
    }
}

/// What the surface of a grain displaces, and what of it cannot go where it should; see [`Immersed::volumes`].
#[derive(Clone, Debug, Default)]
struct Volumes {
    /// Of each link.
    moved: Vec<Moved>,
    /// What links to liquid return too much, per unit of weight.
    leak: f64,
    /// The part of it that makes up for blocked links.
    blocked: f64,
    /// What links to interface get besides, per unit of weight.
    surplus: f64,
}

/// What the motion of the surface does at a link.
#[derive(Clone, Copy, Debug)]
struct Moved {
    /// What a half-way link returns beyond what leaves, at the reference density.
    ideal: f64,
    /// Velocity of the surface where the link meets it.
    u: L3,
    /// What it adds to a half-way link \[B1\].
    moving: f64,
}
