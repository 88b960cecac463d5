//! A run of grains.

use super::bodies::{Bodies, Member};
use super::contact::pass::{self, Inputs, PairState};
use super::contact::{ContactEquations, Losses, StandardContact};
use super::integrate::gear::{self, Gear};
use super::integrate::{External, Integrator, Step, verlet};
use super::material::PairTable;
use super::neighbours::PairList;
use super::setup::{Period, Shape};
use super::walls::pass::{self as wall_pass, NearWall, Scenery};
use super::{DemError, Touching, V3};
use rayon::prelude::*;

/// Members per task at least.
const LEAST: usize = 512;

/// A run of grains: state, lists and books. Built by [`Dem::new`].
#[derive(Debug, Clone, PartialEq)]
pub struct Dem {
    pub(super) bodies: Bodies,
    pub(super) members: Vec<Member>,
    /// Member centres in the body frame, m.
    pub(super) offsets: Vec<V3>,
    pub(super) table: PairTable,
    pub(super) scenery: Scenery,
    pub(super) period: Period,
    pub(super) list: PairList,
    pub(super) pairs: PairState,
    pub(super) near: Vec<NearWall>,
    /// Entry of each member in `near`, or `u32::MAX`.
    pub(super) near_of: Vec<u32>,
    /// Member positions when the lists were made.
    pub(super) reference: Vec<V3>,
    pub(super) external: External,
    pub(super) gear: Option<gear::Derivatives>,
    pub(super) step_setting: Step,
    pub(super) integrator: Integrator,
    pub(super) skin: f64,
    pub(super) overlap_limit: f64,
    pub(super) steps: u64,
    pub(super) rates: Losses,
    pub(super) lost: Losses,
    pub(super) external_work: f64,
    pub(super) rebuilds: u64,
}

impl Dem {
    /// Advances by `n` steps.
    ///
    /// # Errors
    /// Too much overlap, a state that is not finite, a spin too fast for the step.
    pub fn step(&mut self, n: u64) -> Result<(), DemError> {
        self.step_with(StandardContact, n)
    }

    /// As [`Dem::step`], with other equations of contact; see [`Dem::with_equations`].
    ///
    /// # Errors
    /// Too much overlap, a state that is not finite, a spin too fast for the step.
    pub fn step_with(&mut self, equations: impl ContactEquations, n: u64) -> Result<(), DemError> {
        let mut steps = || (0..n).try_for_each(|_| self.one_step(equations));
        if rayon::current_thread_index().is_none() {
            // A caller outside the pool would be handed over to it, and back, at every pass of every step.
            return rayon::scope(|_| steps());
        }
        steps()
    }

    fn one_step(&mut self, equations: impl ContactEquations) -> Result<(), DemError> {
        self.steps += 1;
        let dt = self.step_setting.dt;
        let start_rate = self.outside_rate();
        let spun = match &mut self.gear {
            None => verlet::drift(&mut self.bodies, &self.external, &self.step_setting),
            Some(state) => gear::predict(&mut self.bodies, state, &self.step_setting),
        };
        if let Some(grain) = spun {
            let spin = self.bodies.spin[grain].norm();
            return Err(DemError::Spin {
                step: self.steps,
                time_s: self.time(),
                grain,
                spin_rad_s: spin,
                step_s: dt,
            });
        }
        self.scenery.set_time(self.time());
        if self.move_members() {
            self.renew_lists();
        }
        let before = self.rates;
        self.forces(equations, dt)?;
        self.rates = self.rates_now();
        for (sum, (a, b)) in [
            (&mut self.lost.normal, (before.normal, self.rates.normal)),
            (&mut self.lost.tangential, (before.tangential, self.rates.tangential)),
            (&mut self.lost.rolling, (before.rolling, self.rates.rolling)),
            (&mut self.lost.driven, (before.driven, self.rates.driven)),
        ] {
            *sum += 0.5 * dt * (a + b);
        }
        self.lost.slip += self.rates.slip;
        self.lost.roll_slip += self.rates.roll_slip;
        self.external_work += 0.5 * dt * (start_rate + self.outside_rate());
        Ok(())
    }

    /// Copies the bodies' motion to their members; true if one has used up its half of the skin.
    fn move_members(&mut self) -> bool {
        let (b, skin) = (&self.bodies, self.skin);
        (&mut self.members, &self.offsets, &self.reference)
            .into_par_iter()
            .with_min_len(LEAST)
            .map(|(m, offset, reference)| {
                place(m, b, offset);
                // A pair has the skin share × (r_a + r_b): each side may use up its own radius' part. The
                // comparison is written so that a place that is not a number asks for new lists too.
                let free = skin * m.radius;
                let moved = (m.position - reference).norm_squared();
                moved.is_nan() || moved > free * free
            })
            .reduce(|| false, |a, b| a | b)
    }

    /// Makes pair and wall lists anew and carries the histories over.
    pub(super) fn renew_lists(&mut self) {
        let list = PairList::find(&self.members, self.period.0, self.skin);
        let mut pairs = PairState::new(list.pairs.len(), self.table.any_rolling);
        for (new, old) in list.matches(&self.list) {
            pairs.history[new] = self.pairs.history[old];
            if let Some(r) = pairs.rolling.get_mut(new) {
                *r = self.pairs.rolling[old];
            }
            pairs.force[new] = self.pairs.force[old];
            pairs.touching[new] = self.pairs.touching[old];
        }
        self.pairs = pairs;
        self.list = list;
        self.near = self.scenery.list(&self.members, &self.period.0, self.skin, &self.near);
        self.near_of.clear();
        self.near_of.resize(self.members.len(), u32::MAX);
        for (k, n) in self.near.iter().enumerate() {
            self.near_of[n.member as usize] = k as u32;
        }
        self.reference.clear();
        self.reference.extend(self.members.iter().map(|m| m.position));
        self.rebuilds += 1;
    }

    /// Forces at the present places, and the second half of the step; `dt = 0` only finds the forces.
    pub(super) fn forces(&mut self, equations: impl ContactEquations, dt: f64) -> Result<(), DemError> {
        let inputs = Inputs { table: &self.table, members: &self.members, dt, limit: self.overlap_limit };
        let (losses, deep) = pass::run(equations, &inputs, &self.list, &mut self.pairs);
        if let Some(p) = deep {
            return Err(self.too_deep(p));
        }
        let (wall_losses, deep) = wall_pass::run(equations, &inputs, &self.scenery, &mut self.near);
        if let Some(n) = deep {
            return Err(self.too_deep_in_wall(n));
        }
        self.rates = losses;
        self.rates.add(&wall_losses);
        match self.correct(dt) {
            None => Ok(()),
            Some(grain) => Err(DemError::NotFinite { step: self.steps, time_s: self.time(), grain }),
        }
    }

    /// The second half of the step with the forces just found.
    ///
    /// # Returns
    /// The first body whose state is not finite.
    fn correct(&mut self, dt: f64) -> Option<usize> {
        let first = std::mem::take(&mut self.bodies.first_member);
        let forces = Forces {
            first: &first,
            members: &self.members,
            list: &self.list,
            pairs: &self.pairs,
            near: &self.near,
            near_of: &self.near_of,
        };
        let found = |i: usize, x: &V3| forces.on_body(i, x);
        let lost = match &mut self.gear {
            Some(state) if dt > 0.0 => {
                let kind = self.integrator;
                gear::correct(&mut self.bodies, state, &self.external, &self.step_setting, kind, found)
            }
            _ => verlet::correct(&mut self.bodies, dt, found),
        };
        self.bodies.first_member = first;
        lost
    }

    /// The rates of this step with the share of driven bodies.
    pub(super) fn rates_now(&self) -> Losses {
        let mut r = self.rates;
        for &i in &self.bodies.driven {
            let i = i as usize;
            r.driven -= self.bodies.force[i].dot(&self.bodies.velocity[i])
                + self.bodies.torque[i].dot(&self.bodies.spin[i]);
        }
        r
    }

    fn outside_rate(&self) -> f64 {
        let b = &self.bodies;
        self.external.as_ref().map_or(0.0, |(f, t)| {
            (0..b.len())
                .filter(|&i| b.inverse_mass[i] > 0.0)
                .map(|i| f[i].dot(&b.velocity[i]) + t[i].dot(&b.spin[i]))
                .sum()
        })
    }

    pub(super) fn start_gear(&mut self) {
        if self.integrator == Integrator::Verlet {
            return;
        }
        let (b, s) = (&self.bodies, &self.step_setting);
        let place = |i: usize| {
            let a = b.force[i] * b.inverse_mass[i] + s.gravity;
            Gear::start(b.position[i], b.velocity[i], a, s.dt)
        };
        let turn = |i: usize| {
            if b.shape[i] == Shape::Sphere {
                Gear::start(V3::zeros(), b.spin[i], b.torque[i] * b.inverse_inertia[i].x, s.dt)
            } else {
                Gear::start(V3::zeros(), b.momentum[i], b.torque[i], s.dt)
            }
        };
        self.gear = Some(((0..b.len()).map(place).collect(), (0..b.len()).map(turn).collect()));
    }

    /// The bodies of a pair, their overlap, m, and its share of the smaller radius.
    pub(super) fn overlap_of(&self, p: usize) -> (Touching, f64, f64) {
        let (ia, ib) = self.list.pairs[p];
        let (a, b) = (&self.members[ia as usize], &self.members[ib as usize]);
        let shift = self.list.shift.get(p).copied().unwrap_or_default();
        let overlap = a.radius + b.radius - (a.position - b.position - shift).norm();
        let pair = Touching::Grains(a.body as usize, b.body as usize);
        (pair, overlap, overlap / a.radius.min(b.radius))
    }

    fn too_deep(&self, p: usize) -> DemError {
        let (pair, overlap_m, share) = self.overlap_of(p);
        DemError::Overlap {
            step: self.steps,
            time_s: self.time(),
            pair,
            overlap_m,
            share,
            limit: self.overlap_limit,
        }
    }

    fn too_deep_in_wall(&self, n: usize) -> DemError {
        let near = &self.near[n];
        let m = &self.members[near.member as usize];
        let deepest = near.contacts.iter().max_by(|a, b| a.overlap.total_cmp(&b.overlap));
        let (wall, overlap_m) = deepest
            .map_or((String::new(), 0.0), |c| (self.scenery.walls[c.wall as usize].name.clone(), c.overlap));
        DemError::Overlap {
            step: self.steps,
            time_s: self.time(),
            pair: Touching::Wall { grain: m.body as usize, wall },
            overlap_m,
            share: overlap_m / m.radius,
            limit: self.overlap_limit,
        }
    }
}

/// Puts a member where its body has it.
#[inline]
pub(super) fn place(m: &mut Member, b: &Bodies, offset: &V3) {
    let i = m.body as usize;
    m.spin = b.spin[i];
    if b.shape[i] == Shape::Sphere {
        m.position = b.position[i];
        m.velocity = b.velocity[i];
    } else {
        let arm = b.orientation[i] * offset;
        m.position = b.position[i] + arm;
        m.velocity = b.velocity[i] + m.spin.cross(&arm);
    }
}

/// The forces that the passes over pairs and walls have found.
struct Forces<'a> {
    /// First member of each body, and the number of all members at the end.
    first: &'a [u32],
    members: &'a [Member],
    list: &'a PairList,
    pairs: &'a PairState,
    near: &'a [NearWall],
    near_of: &'a [u32],
}

impl Forces<'_> {
    /// Contact force and torque on body `i`: members in order, and for each member its partners in order, then walls.
    #[inline]
    fn on_body(&self, i: usize, centre: &V3) -> (V3, V3) {
        let (mut force, mut torque) = (V3::zeros(), V3::zeros());
        let (from, to) = (self.first[i] as usize, self.first[i + 1] as usize);
        for k in from..to {
            let (f, t) = self.on_member(k);
            force += f;
            torque += if to - from == 1 { t } else { t + (self.members[k].position - centre).cross(&f) };
        }
        (force, torque)
    }

    /// Contact force on a member, and torque about its own centre.
    #[inline]
    fn on_member(&self, k: usize) -> (V3, V3) {
        let Self { list, pairs, .. } = self;
        let (mut f, mut t) = (V3::zeros(), V3::zeros());
        let radius = self.members[k].radius;
        for &p in &list.back[list.back_row[k] as usize..list.back_row[k + 1] as usize] {
            if pairs.touching[p as usize] {
                f -= pairs.force[p as usize].force;
                t -= pairs.torque(p as usize, radius);
                if let Some(r) = pairs.rolling.get(p as usize) {
                    t -= r.moment;
                }
            }
        }
        for p in list.row[k] as usize..list.row[k + 1] as usize {
            if pairs.touching[p] {
                f += pairs.force[p].force;
                t -= pairs.torque(p, radius);
                if let Some(r) = pairs.rolling.get(p) {
                    t += r.moment;
                }
            }
        }
        if self.near_of[k] != u32::MAX {
            let n = &self.near[self.near_of[k] as usize];
            f += n.force;
            t += n.torque;
        }
        (f, t)
    }
}
