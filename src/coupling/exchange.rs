//! What a grain's surface returns to the fluid, and the force and torque that it takes from it \[C1\] \[C2\].

use super::L3;
use super::config::{GrainWall, Mutant, VolumeRule};
use super::coverage::NOBODY;
use super::host::Host;
use super::immersed::{BodyLoad, Immersed};
use super::link::{Ball, Link, cross, cut};
use super::predict::{Friction, middle};
use super::pressure::{Fit, Samples};
use crate::boundary::bounce_back::surface_velocity;
use crate::boundary::links::Source;
use crate::free_surface::Kind;
use crate::lattice::moments::density_excess;
use crate::lattice::{C, W};
use rayon::prelude::*;

/// A link whose outer cell holds fluid.
#[derive(Clone, Copy, Debug)]
struct Open {
    link: Link,
    /// From the centre of the grain to where the link meets its surface.
    arm: L3,
    /// From the centre of the grain to the middle of the link.
    middle: L3,
    /// f_out* that leaves.
    leaving: f64,
    /// What comes back from a surface at rest.
    base: f64,
    /// Share of 6 w ρ c·u_w that a moving surface adds.
    share: f64,
    /// ρ of the cell.
    rho: f64,
    /// φ of the cell, 1 in liquid; then, at the surface, the wet share of the link.
    wet: f64,
    /// Whether the cell is interface, with a mass of its own.
    interface: bool,
}

/// A link whose outer cell is gas.
#[derive(Clone, Copy, Debug)]
struct Dry {
    /// Its middle, from the centre of the grain.
    middle: L3,
    out: u8,
    covered: u32,
}

/// What the links of one grain say before its velocity is known.
#[derive(Clone, Debug, Default)]
pub(super) struct Gathered {
    open: Vec<Open>,
    friction: Friction,
    /// Around the grain; only where a part of its surface is blocked.
    fit: Option<Fit>,
    /// Links to gas.
    dry: Vec<Dry>,
    blocked: bool,
}

impl Gathered {
    /// Wet share of every link of a grain at the surface, half of the fill at either end: as between interface cells
    /// \[F1\]. The fill of a covered cell is the mean of those around it that are not covered.
    fn share_out(&mut self, cells: &[u32]) {
        let place = |covered: u32| cells.binary_search(&covered).unwrap_or(0);
        let mut sums = vec![(0.0, 0.0); cells.len()];
        for open in &self.open {
            let w = W[usize::from(open.link.out)];
            let sum = &mut sums[place(open.link.covered)];
            (sum.0, sum.1) = (sum.0 + w * open.wet, sum.1 + w);
        }
        for dry in &self.dry {
            sums[place(dry.covered)].1 += W[usize::from(dry.out)];
        }
        for open in &mut self.open {
            let (wet, all) = sums[place(open.link.covered)];
            open.wet = 0.5 * (open.wet + wet / all);
        }
    }
}

/// What goes to the cells and to the books.
#[derive(Clone, Debug, Default)]
pub(super) struct Returned {
    /// (covered cell, direction, value).
    pub values: Vec<(u32, u8, f64)>,
    /// (interface cell, mass that it gets).
    pub gained: Vec<(u32, f64)>,
    pub load: BodyLoad,
    /// Mass that came into the fluid over links.
    pub mass: f64,
    /// Of this into liquid, less the volume that the surface displaces there at the reference density.
    pub excess: f64,
    /// Momentum that came into the fluid over links.
    pub momentum: L3,
}

impl Immersed {
    /// Returns populations from all surfaces and finds the forces on all grains; between collision and streaming.
    pub fn exchange(&mut self, host: &mut dyn Host) {
        let force = host.setup().force.at(host.step_number());
        let returned = {
            let (this, host) = (&*self, &*host);
            let work = || {
                let all = 0..this.grains();
                let gathered: Vec<Gathered> =
                    all.clone().into_par_iter().map(|grain| this.gather(host, grain)).collect();
                all.into_par_iter()
                    .map(|grain| this.answer(host, grain, &gathered, &force))
                    .collect::<Vec<Returned>>()
            };
            match host.pool() {
                Some(pool) => pool.install(work),
                None => work(),
            }
        };
        for (grain, own) in returned.into_iter().enumerate() {
            for &(cell, i, value) in &own.values {
                host.put(cell as usize, usize::from(i), value);
            }
            for &(cell, mass) in &own.gained {
                host.gain(cell as usize, mass);
            }
            host.book(own.mass, &own.momentum);
            self.books.enter_links(&own);
            self.loads[grain] = own.load;
            self.owed[grain] -= own.excess;
            self.debt[grain] -= own.mass;
        }
    }

    /// First look at the links of a grain.
    fn gather(&self, host: &dyn Host, grain: usize) -> Gathered {
        let cover = self.coverage.of(grain);
        let mut found = Gathered { open: Vec::with_capacity(cover.links.len()), ..Gathered::default() };
        let balls = self.balls(grain);
        let centre = self.centre(grain);
        found.blocked = !cover.blocked.is_empty();
        let mut samples = Samples::default();
        let mut own: Option<(u32, f64, L3, f64)> = None;
        for link in &cover.links {
            let cell = link.cell as usize;
            let kind = host.kind(cell);
            if !kind.is_fluid() {
                if kind == Kind::Gas {
                    let r = self.shape.apart(&self.shape.centre(cell), &centre);
                    let middle = half_way(&r, usize::from(link.out));
                    found.dry.push(Dry { middle, out: link.out, covered: link.covered });
                }
                found.blocked |= kind == Kind::Solid && self.coverage.owner(cell) != NOBODY;
                continue;
            }
            // Links are in order of their cell: what belongs to the cell is found once.
            let (rho, r, wet) = match own {
                Some((known, rho, r, wet)) if known == link.cell => (rho, r, wet),
                _ => {
                    let rho = 1.0 + density_excess(&host.after(cell));
                    let r = self.shape.apart(&self.shape.centre(cell), &centre);
                    let wet = if kind == Kind::Liquid { 1.0 } else { host.fill(cell) };
                    samples.add(&r, rho - 1.0);
                    own = Some((link.cell, rho, r, wet));
                    (rho, r, wet)
                }
            };
            let open = self.look(host, link, &balls, (rho, r, wet));
            found.open.push(open);
        }
        if !found.dry.is_empty() || found.open.iter().any(|open| open.interface) {
            found.share_out(&cover.cells);
        }
        for open in &found.open {
            let out = usize::from(open.link.out);
            let c = C[out].map(f64::from);
            let turn = cross(&open.arm, &c);
            let v = [c[0], c[1], c[2], turn[0], turn[1], turn[2]];
            found.friction.add(&v, open.leaving + open.base, 6.0 * W[out] * open.rho * open.share);
        }
        if found.blocked {
            found.fit = samples.fit();
        }
        found
    }

    /// One link with the surface at rest.
    fn look(&self, host: &dyn Host, link: &Link, balls: &[Ball], (rho, r, wet): (f64, L3, f64)) -> Open {
        let out = usize::from(link.out);
        let leaving = host.after_one(link.cell as usize, out);
        let c = C[out].map(f64::from);
        let middle = half_way(&r, out);
        let interface = host.kind(link.cell as usize) == Kind::Interface;
        let half = Open {
            link: *link,
            arm: middle,
            middle,
            leaving,
            base: leaving,
            share: 1.0,
            rho,
            wet,
            interface,
        };
        if self.config.wall == GrainWall::HalfWay {
            return half;
        }
        // The cell behind, straight along the link.
        let behind = match self.shape.source(host.setup(), link.cell as usize, out) {
            Source::Cell { cell, direction } if usize::from(direction) == out => cell as usize,
            _ => return half,
        };
        if !host.kind(behind).is_fluid() {
            return half;
        }
        let here = self.shape.centre(link.cell as usize);
        let q = cut(balls.iter().map(|ball| (self.shape.apart(&here, &ball.centre), ball.radius)), out);
        let kappa = (1.0 - 2.0 * q) / (1.0 + 2.0 * q);
        let (from_behind, returning) =
            (host.after_one(behind, out), host.after_one(link.cell as usize, usize::from(link.slot)));
        Open {
            arm: std::array::from_fn(|a| r[a] + q * c[a]),
            base: leaving + kappa * (from_behind - returning),
            share: 2.0 / (1.0 + 2.0 * q),
            ..half
        }
    }

    /// Velocity of the surface, populations returned, force and torque.
    fn answer(&self, host: &dyn Host, grain: usize, all: &[Gathered], force: &L3) -> Returned {
        let own = &all[grain];
        let motion = self.motion(grain);
        let held = self.blocked_force(host, grain, all);
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
        let mut returned = Returned { values: Vec::with_capacity(own.open.len()), ..Returned::default() };
        let mut links = [0.0; 6];
        let mut volumes = self.volumes(host, own, &w);
        volumes.surplus += self.settlement(grain, &w) * volumes.per_interface;
        for (open, ideal) in own.open.iter().zip(&volumes.ideal) {
            self.close(host, open, &w, (&volumes, *ideal), &mut links, &mut returned);
        }
        returned.load = BodyLoad { links, held, rest, wet_links: own.open.len() as u32 };
        returned
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
        w: &[f64; 6],
        (volumes, ideal): (&Volumes, f64),
        links: &mut [f64; 6],
        returned: &mut Returned,
    ) {
        let out = usize::from(open.link.out);
        let (u, moving) = self.moving(host, (&open.arm, out), open.rho, w);
        let leak = if open.interface { 0.0 } else { W[out] * volumes.leak };
        let value = host.stored((open.base + open.share * moving) - leak);
        returned.values.push((open.link.covered, open.link.slot, value));
        let (given, taken) = (open.leaving + value, open.leaving - value);
        let c = C[out].map(f64::from);
        let push: L3 = std::array::from_fn(|a| c[a] * given - u[a] * taken);
        let turn = cross(&open.arm, &push);
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
        let spin = match self.config.mutant {
            Mutant::ReversedProduct => [-w[3], -w[4], -w[5]],
            _ => [w[3], w[4], w[5]],
        };
        let u = surface_velocity([w[0], w[1], w[2]], spin, *arm);
        (u, host.moving_wall(out, rho, &u))
    }

    /// What the surface of a grain displaces, and what of it cannot go where it should.
    ///
    /// Interpolated links return more or less mass than half-way links. What the surface pushes away where a wall or
    /// another grain leaves no cell has to come out beside: over a closed staircase the volumes pushed and pulled
    /// cancel, so that those of all links but the blocked ones tell what is missing. And a link to a liquid cell
    /// returns all of its mass even where the other end is only partly wet: the interface cells around take the rest
    /// back, or a body that sinks through the surface would push half a layer of cells too much.
    fn volumes(&self, host: &dyn Host, own: &Gathered, w: &[f64; 6]) -> Volumes {
        let mut volumes = Volumes { ideal: Vec::with_capacity(own.open.len()), ..Volumes::default() };
        let (mut liquid, mut interface, mut excess, mut all, mut surplus) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for link in &own.open {
            let out = usize::from(link.link.out);
            let (_, straight) = self.moving(host, (&link.middle, out), link.rho, w);
            let ideal = straight / link.rho;
            volumes.ideal.push(ideal);
            all += ideal;
            if link.interface {
                interface += W[out];
                continue;
            }
            liquid += W[out];
            surplus += (1.0 - link.wet) * ideal;
            if self.config.wall != GrainWall::HalfWay {
                let (_, moving) = self.moving(host, (&link.arm, out), link.rho, w);
                excess += ((link.base - link.leaving) + link.share * moving) - straight;
            }
        }
        if own.blocked {
            for dry in &own.dry {
                all += self.moving(host, (&dry.middle, usize::from(dry.out)), 1.0, w).1;
            }
        } else {
            all = 0.0;
        }
        if liquid > 0.0 {
            volumes.leak = (excess + all) / liquid;
            volumes.blocked = all / liquid;
        }
        if interface > 0.0 {
            volumes.per_interface = 1.0 / interface;
            volumes.surplus = -surplus * volumes.per_interface;
        }
        volumes
    }

    /// Mass that a grain hands back to the interface around it in this step: what the staircase of its waterline has
    /// taken too much or given too much, over one cell of travel.
    fn settlement(&self, grain: usize, w: &[f64; 6]) -> f64 {
        let travel = (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]).sqrt();
        self.debt[grain] * travel
    }

    /// Force and torque of the fluid that is pressed between a grain and a wall or another grain, too thin for a cell:
    /// the pressure around the grain, continued. Between two grains the mean of the two, so that what one feels
    /// the other feels too.
    fn blocked_force(&self, host: &dyn Host, grain: usize, all: &[Gathered]) -> [f64; 6] {
        let mut sum = [0.0; 6];
        let own = &all[grain];
        if !own.blocked {
            return sum;
        }
        let cover = self.coverage.of(grain);
        let centre = self.centre(grain);
        // Below a free surface air comes in where the pressure would fall below that of the gas.
        let with_gas = self.with_gas;
        let mut press = |inward: usize, r: &L3, excess: f64| {
            let excess = if with_gas && excess < 0.0 { 0.0 } else { excess };
            let c = C[inward].map(f64::from);
            let push = c.map(|c| c * (2.0 * W[inward] * excess));
            let turn = cross(r, &push);
            for a in 0..3 {
                sum[a] += push[a];
                sum[a + 3] += turn[a];
            }
        };
        if let Some(fit) = own.fit {
            for blocked in &cover.blocked {
                let inward = usize::from(blocked.inward);
                let r = self.shape.apart(&self.shape.centre(blocked.covered as usize), &centre);
                let r: L3 = std::array::from_fn(|a| r[a] - 0.5 * f64::from(C[inward][a]));
                press(inward, &r, fit.at(&r));
            }
        }
        for link in &cover.links {
            let cell = link.cell as usize;
            let other = self.coverage.owner(cell);
            if other == NOBODY || host.kind(cell) != Kind::Solid {
                continue;
            }
            let inward = usize::from(link.out);
            let middle: L3 = {
                let at = self.shape.centre(cell);
                std::array::from_fn(|a| at[a] + 0.5 * f64::from(C[inward][a]))
            };
            let r = self.shape.apart(&middle, &centre);
            let r_other = self.shape.apart(&middle, &self.centre(other as usize));
            let excess = match (own.fit, all[other as usize].fit) {
                (Some(a), Some(b)) => 0.5 * (a.at(&r) + b.at(&r_other)),
                (Some(a), None) => a.at(&r),
                (None, Some(b)) => b.at(&r_other),
                (None, None) => continue,
            };
            press(inward, &r, excess);
        }
        sum
    }

    /// Pressure gradients that the lattice does not carry, and the fluid between a grain's volume and its cells.
    fn rest_force(&self, grain: usize, own: &Gathered, force: &L3) -> [f64; 6] {
        let volume = self.volume(grain);
        let mut sum = [0.0; 6];
        for a in 0..3 {
            sum[a] = volume * (self.config.pressure_gradient[a] + self.gradient[a]);
        }
        if self.config.volume == VolumeRule::Corrected {
            let axis = strongest(force);
            let wet = own.open.len() as f64;
            let all = wet + own.dry.len() as f64;
            if !self.shape.periodic[axis] && all > 0.0 {
                let missing = volume - self.coverage.of(grain).cells.len() as f64;
                sum[axis] -= missing * force[axis] * (wet / all);
            }
        }
        sum
    }

    /// What contacts will do in this step: what they did in the last, but no more than what they have to hold.
    fn expected_contact(&self, grain: usize, others: &[f64; 6]) -> [f64; 6] {
        let last = &self.contact[grain];
        let norm = |v: &[f64]| (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
        let mut expected = [0.0; 6];
        for part in [0..3, 3..6] {
            let (was, held) = (norm(&last[part.clone()]), norm(&others[part.clone()]));
            let scale = if was > held && was > 0.0 { held / was } else { 1.0 };
            for a in part {
                expected[a] = last[a] * scale;
            }
        }
        expected
    }
}

/// Middle of a link that leaves the cell at `r` along c_out.
#[inline]
fn half_way(r: &L3, out: usize) -> L3 {
    std::array::from_fn(|a| r[a] + 0.5 * f64::from(C[out][a]))
}

/// See [`Immersed::volumes`].
#[derive(Clone, Debug, Default)]
struct Volumes {
    /// What each link returns beyond what leaves, at the reference density.
    ideal: Vec<f64>,
    /// What links to liquid return too much, per unit of weight.
    leak: f64,
    /// The part of it that makes up for blocked links.
    blocked: f64,
    /// What links to interface get besides, per unit of weight.
    surplus: f64,
    /// 1 over the weight of links to interface; 0 without any.
    per_interface: f64,
}

/// Axis of the largest component; the later of equals.
fn strongest(force: &L3) -> usize {
    let mut axis = 2;
    for a in [1, 0] {
        if force[a].abs() > force[axis].abs() {
            axis = a;
        }
    }
    axis
}
