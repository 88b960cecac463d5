//! What can be read from a run, and what can be set from outside.

use super::bodies::{Bodies, Member};
use super::contact::pass;
use super::contact::{History, Rolling, elastic_energy};
use super::energy::{Energies, Ledger};
use super::walls::pass::{NearWall, Scenery};
use super::{Dem, V3};

/// A contact between two bodies as output sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactView {
    /// Bodies, first and second.
    pub bodies: (usize, usize),
    /// Members, first and second.
    pub members: (usize, usize),
    /// Contact point, m.
    pub point: V3,
    /// From the second to the first.
    pub normal: V3,
    /// m.
    pub overlap: f64,
    /// On the first body, N.
    pub force: V3,
}

impl Dem {
    /// The bodies: positions, velocities, spins, orientations, contact forces.
    pub fn bodies(&self) -> &Bodies {
        &self.bodies
    }

    /// Member spheres with their present centres.
    pub fn members(&self) -> &[Member] {
        &self.members
    }

    /// Force (N) and torque (N m, about the centre, frame of the scene) on every body from outside; they act in
    /// every step until changed. Gravity is not part of them.
    pub(crate) fn external_mut(&mut self) -> (&mut [V3], &mut [V3]) {
        let n = self.bodies.len();
        let (f, t) = self.external.get_or_insert_with(|| (vec![V3::zeros(); n], vec![V3::zeros(); n]));
        (f, t)
    }

    /// Steps done.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Time, s (steps × step: no summing error).
    pub fn time(&self) -> f64 {
        self.steps as f64 * self.step_setting.dt
    }

    /// Time step, s.
    pub fn time_step(&self) -> f64 {
        self.step_setting.dt
    }

    /// How often the lists were made.
    pub fn list_renewals(&self) -> u64 {
        self.rebuilds
    }

    /// Pairs on the list and pairs that touch.
    pub fn pair_counts(&self) -> (usize, usize) {
        (self.list.pairs.len(), self.pairs.touching.iter().filter(|t| **t).count())
    }

    /// Contacts between bodies, in the order of the pair list.
    pub fn contacts(&self) -> impl Iterator<Item = ContactView> + '_ {
        self.list.pairs.iter().enumerate().filter(|(p, _)| self.pairs.touching[*p]).filter_map(
            |(p, &(ia, ib))| {
                let (a, b) = (&self.members[ia as usize], &self.members[ib as usize]);
                let shift = self.list.shift.get(p).copied().unwrap_or_default();
                let (g, arm, _) = pass::meet(a, b, &(a.position - b.position - shift))?;
                Some(ContactView {
                    bodies: (a.body as usize, b.body as usize),
                    members: (ia as usize, ib as usize),
                    point: a.position - g.normal * arm,
                    normal: g.normal,
                    overlap: g.overlap,
                    force: self.pairs.force[p].force,
                })
            },
        )
    }

    /// Pairs of members on the list, touching or not: (first, second, x_first − x_second with periods taken away).
    /// Complete up to a gap of skin × the sum of radii less what has been moved since; ask for a larger skin in the
    /// set-up where forces reach further (lubrication).
    pub fn neighbours(&self) -> impl Iterator<Item = (usize, usize, V3)> + '_ {
        self.list.pairs.iter().enumerate().map(|(p, &(a, b))| {
            let shift = self.list.shift.get(p).copied().unwrap_or_default();
            let d = self.members[a as usize].position - self.members[b as usize].position - shift;
            (a as usize, b as usize, d)
        })
    }

    /// Members near walls with their contacts, in the order of the members.
    pub fn wall_contacts(&self) -> &[NearWall] {
        &self.near
    }

    /// The walls and where they are.
    pub fn scenery(&self) -> &Scenery {
        &self.scenery
    }

    /// Force of all grains on wall `k` (N) and its torque about the wall's `about` point (N m).
    pub fn force_on_wall(&self, k: usize) -> (V3, V3) {
        let (mut force, mut torque) = (V3::zeros(), V3::zeros());
        let about = self.scenery.walls[k].motion.about + self.scenery.poses[k].shift;
        for n in &self.near {
            let x = self.members[n.member as usize].position;
            for c in n.contacts.iter().filter(|c| c.wall as usize == k) {
                force -= c.force;
                torque -= (x + c.image + c.arm - about).cross(&c.force);
            }
        }
        (force, torque)
    }

    /// Mass, momentum and angular momentum.
    pub fn ledger(&self) -> Ledger {
        let b = &self.bodies;
        let mut l = Ledger { mass: 0.0, momentum: V3::zeros(), angular_momentum: V3::zeros() };
        for i in (0..b.len()).filter(|&i| b.inverse_mass[i] > 0.0) {
            let p = b.velocity[i] * b.mass[i];
            l.mass += b.mass[i];
            l.momentum += p;
            l.angular_momentum += b.position[i].cross(&p) + b.angular_momentum(i);
        }
        l
    }

    /// Kinetic energy, translational and rotational, J.
    pub fn kinetic_energy(&self) -> f64 {
        (0..self.bodies.len())
            .map(|i| self.bodies.translational_energy(i) + self.bodies.rotational_energy(i))
            .sum()
    }

    /// The books of energy.
    pub fn energies(&self) -> Energies {
        let b = &self.bodies;
        let mut e = Energies {
            lost_normal: self.lost.normal,
            lost_friction: self.lost.tangential + self.lost.slip,
            lost_rolling: self.lost.rolling + self.lost.roll_slip,
            work_external: self.external_work,
            work_driven: self.lost.driven,
            ..Energies::default()
        };
        for i in (0..b.len()).filter(|&i| b.inverse_mass[i] > 0.0) {
            e.kinetic += b.translational_energy(i);
            e.rotational += b.rotational_energy(i);
            e.potential -= b.mass[i] * self.step_setting.gravity.dot(&b.position[i]);
        }
        let mut stored =
            |law: &super::material::PairLaw, g: &super::contact::Geometry, h: &History, r: &Rolling| {
                e.elastic_normal += elastic_energy(law, g);
                let stiffness = super::contact::normal_terms(law, g).tangential_stiffness;
                e.elastic_tangential += 0.5 * h.force * h.force / stiffness;
                e.elastic_rolling += 0.5 * r.torque * r.torque / (stiffness * g.radius * g.radius);
            };
        for (p, &(ia, ib)) in self.list.pairs.iter().enumerate() {
            let (a, b) = (&self.members[ia as usize], &self.members[ib as usize]);
            let shift = self.list.shift.get(p).copied().unwrap_or_default();
            if let (true, Some((g, _, _))) =
                (self.pairs.touching[p], pass::meet(a, b, &(a.position - b.position - shift)))
            {
                let rolling = self.pairs.rolling.get(p).copied().unwrap_or_default();
                stored(self.table.law(a.material, b.material), &g, &self.pairs.history[p], &rolling);
            }
        }
        for n in &self.near {
            let m = &self.members[n.member as usize];
            for c in &n.contacts {
                let wall = &self.scenery.walls[c.wall as usize];
                let mass = 1.0 / m.inverse_mass;
                let g =
                    super::contact::Geometry { normal: c.normal, overlap: c.overlap, radius: m.radius, mass };
                stored(self.table.law(m.material, wall.material as u32), &g, &c.history, &c.rolling);
            }
        }
        e
    }
}
