//! A run of grains.

use super::bodies::{Bodies, Member};
use super::contact::pass::{self, PairState};
use super::contact::{Losses, Mutant, NoCap, Physics, ReversedProduct, SpringNotRotated, Standard};
use super::integrate::Integrator;
use super::integrate::gear::Gear;
use super::integrate::verlet::{self, External, Step};
use super::material::PairTable;
use super::neighbours::PairList;
use super::setup::Period;
use super::walls::pass::{self as wall_pass, NearWall, Scenery};
use super::{DemError, Setup, Touching, V3};
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
    pub(super) gear: Option<(Vec<Gear>, Vec<Gear>)>,
    pub(super) step_setting: Step,
    pub(super) integrator: Integrator,
    pub(super) skin: f64,
    pub(super) overlap_limit: f64,
    pub(super) mutant: Mutant,
    pub(super) steps: u64,
    pub(super) rates: Losses,
    pub(super) lost: Losses,
    pub(super) external_work: f64,
    pub(super) rebuilds: u64,
}

impl Dem {
    /// Checks a set-up and finds the forces at the start.
    ///
    /// # Errors
    /// Everything [`DemError`] lists as bad input.
    pub fn new(setup: &Setup) -> Result<Self, DemError> {
        let mut dem = super::build::build(setup)?;
        dem.renew_lists();
        dem.check_start(setup)?;
        dem.forces(0.0)?;
        dem.rates = dem.rates_now();
        dem.start_gear();
        Ok(dem)
    }

    /// Advances by `n` steps.
    ///
    /// # Errors
    /// Too much overlap, a state that is not finite, a spin too fast for the step.
    pub fn step(&mut self, n: u64) -> Result<(), DemError> {
        if rayon::current_thread_index().is_none() {
            // A caller outside the pool would be handed over to it, and back, at every pass of every step.
            return rayon::scope(|_| self.steps_here(n));
        }
        self.steps_here(n)
    }

    fn steps_here(&mut self, n: u64) -> Result<(), DemError> {
        for _ in 0..n {
            self.one_step()?;
        }
        Ok(())
    }

    fn one_step(&mut self) -> Result<(), DemError> {
        self.steps += 1;
        let dt = self.step_setting.dt;
        let start_rate = self.outside_rate();
        let spun = match &mut self.gear {
            None => verlet::drift(&mut self.bodies, &self.external, &self.step_setting),
            Some(state) => verlet::predict(&mut self.bodies, state, &self.step_setting),
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
        self.forces(dt)?;
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
    fn forces(&mut self, dt: f64) -> Result<(), DemError> {
        match self.mutant {
            Mutant::None => self.forces_with(Standard, dt),
            Mutant::SpringNotRotated => self.forces_with(SpringNotRotated, dt),
            Mutant::NoCoulombCap => self.forces_with(NoCap, dt),
            Mutant::ReversedProduct => self.forces_with(ReversedProduct, dt),
        }
    }

    fn forces_with<P: Physics>(&mut self, physics: P, dt: f64) -> Result<(), DemError> {
        let limit = self.overlap_limit;
        let (losses, deep) =
            pass::run(physics, &self.table, &self.members, &self.list, &mut self.pairs, dt, limit);
        if let Some(p) = deep {
            return Err(self.too_deep(p));
        }
        let (wall_losses, deep) =
            wall_pass::run(physics, &self.table, &self.members, &self.scenery, &mut self.near, dt, limit);
        if let Some(n) = deep {
            return Err(self.too_deep_in_wall(n));
        }
        self.rates = losses;
        self.rates.add(&wall_losses);
        let (members, list, pairs, near, near_of) =
            (&self.members, &self.list, &self.pairs, &self.near, &self.near_of);
        let first = std::mem::take(&mut self.bodies.first_member);
        let found = |i: usize, x: &V3| gather(i, x, &first, members, list, pairs, near, near_of);
        let lost = match &mut self.gear {
            Some(state) if dt > 0.0 => verlet::correct_gear(
                &mut self.bodies,
                state,
                &self.external,
                &self.step_setting,
                self.integrator,
                found,
            ),
            _ => verlet::correct(&mut self.bodies, dt, found),
        };
        self.bodies.first_member = first;
        match lost {
            None => Ok(()),
            Some(grain) => Err(DemError::NotFinite { step: self.steps, time_s: self.time(), grain }),
        }
    }

    /// The rates of this step with the share of driven bodies.
    fn rates_now(&self) -> Losses {
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
            if b.shape[i] == super::bodies::SPHERE {
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
    if b.shape[i] == super::bodies::SPHERE {
        m.position = b.position[i];
        m.velocity = b.velocity[i];
    } else {
        let arm = b.orientation[i] * offset;
        m.position = b.position[i] + arm;
        m.velocity = b.velocity[i] + m.spin.cross(&arm);
    }
}

/// Contact force and torque on body `i`: members in order, and for each member its partners in order, then walls.
#[allow(clippy::too_many_arguments)]
#[inline]
fn gather(
    i: usize,
    centre: &V3,
    first: &[u32],
    members: &[Member],
    list: &PairList,
    pairs: &PairState,
    near: &[NearWall],
    near_of: &[u32],
) -> (V3, V3) {
    let (mut force, mut torque) = (V3::zeros(), V3::zeros());
    let (from, to) = (first[i] as usize, first[i + 1] as usize);
    for k in from..to {
        let (mut f, mut t) = (V3::zeros(), V3::zeros());
        let radius = members[k].radius;
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
        if near_of[k] != u32::MAX {
            let n = &near[near_of[k] as usize];
            f += n.force;
            t += n.torque;
        }
        force += f;
        torque += if to - from == 1 { t } else { t + (members[k].position - centre).cross(&f) };
    }
    (force, torque)
}
