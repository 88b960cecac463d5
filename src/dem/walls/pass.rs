//! The pass over members that are near a wall.

use super::{Near, Pose, Surface, Wall, near, surface_velocity};
use crate::dem::V3;
use crate::dem::bodies::Member;
use crate::dem::contact::pass::Inputs;
use crate::dem::contact::{
    Contact, ContactEquations, Geometry, History, Losses, Memory, Motion, Rolling, react,
};
use crate::dem::neighbours::cells::fold;
use crate::state::state;
use rayon::prelude::*;

/// A contact that changes from one face to the next keeps its spring if the normals agree at least this well.
const INHERIT: f64 = 0.9;

/// A wall that a member may touch before it has moved half a skin.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Candidate {
    /// Wall number.
    pub wall: u32,
    /// What to add to the member's position to get into the wall's periodic image, m.
    pub image: V3,
    /// Triangles in reach of a mesh at rest.
    pub triangles: Option<Vec<u32>>,
}

/// A contact with a wall.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct WallContact {
    /// Wall number.
    pub wall: u32,
    /// Face, edge or corner of the wall.
    pub feature: u32,
    /// Periodic image, m.
    pub image: V3,
    /// From the wall to the member.
    pub normal: V3,
    /// m.
    pub overlap: f64,
    /// Contact point relative to the member's centre, m.
    pub arm: V3,
    /// On the member, N.
    pub force: V3,
    /// Of the tangential spring.
    pub history: History,
    /// Of the rolling spring.
    pub rolling: Rolling,
}

/// A member near walls.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct NearWall {
    /// Member number.
    pub member: u32,
    /// Walls to look at.
    pub candidates: Vec<Candidate>,
    /// What it touches.
    pub contacts: Vec<WallContact>,
    /// Sum of the contact forces, N.
    pub force: V3,
    /// Sum of the contact torques about the member's centre, N m.
    pub torque: V3,
    losses: Losses,
    too_deep: bool,
}

/// Walls with where they are now.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scenery {
    /// The walls.
    pub walls: Vec<Wall>,
    /// Poses at the present time.
    pub poses: Vec<Pose>,
    /// Walls whose surface is not where it was at the start.
    pub shifts: Vec<bool>,
}

state!(Candidate: wall image triangles);
state!(WallContact: wall feature image normal overlap arm force history rolling);
state!(NearWall: member candidates contacts force torque losses too_deep);
state!(Scenery: poses; but walls shifts);

impl Scenery {
    /// Leaves out the walls from number `walls` on.
    pub(in crate::dem) fn truncate(&mut self, walls: usize) {
        self.walls.truncate(walls);
        self.poses.truncate(walls);
        self.shifts.truncate(walls);
    }

    /// Walls at time zero.
    pub fn new(walls: Vec<Wall>) -> Self {
        let shifts = walls.iter().map(Wall::shifts).collect();
        Self { poses: vec![Pose::default(); walls.len()], shifts, walls }
    }

    /// Puts the walls where they are at `time` (a function of time alone: no drift, nothing to store).
    pub(crate) fn set_time(&mut self, time: f64) {
        for k in 0..self.walls.len() {
            let m = &self.walls[k].motion;
            let axis_angle = m.spin * time;
            let angle = axis_angle.norm();
            let turn = if angle > 0.0 {
                let half = libm::sin(0.5 * angle) / angle;
                super::Orientation::new_normalize(nalgebra::Quaternion::from_parts(
                    libm::cos(0.5 * angle),
                    axis_angle * half,
                ))
            } else {
                super::Orientation::identity()
            };
            self.poses[k] = Pose { shift: m.velocity * time, turn };
        }
    }

    /// Members that may touch a wall before they move half a skin; keeps the contacts of `old`.
    pub(crate) fn list(
        &self,
        members: &[Member],
        period: &[Option<f64>; 3],
        skin: f64,
        old: &[NearWall],
    ) -> Vec<NearWall> {
        if self.walls.is_empty() {
            return Vec::new();
        }
        let blank = |member: usize, candidates| NearWall {
            member: member as u32,
            candidates,
            contacts: match old.binary_search_by_key(&(member as u32), |o| o.member) {
                Ok(k) => old[k].contacts.clone(),
                Err(_) => Vec::new(),
            },
            force: V3::zeros(),
            torque: V3::zeros(),
            losses: Losses::default(),
            too_deep: false,
        };
        members
            .par_iter()
            .enumerate()
            .with_min_len(256)
            .filter_map(|(i, m)| {
                let candidates = self.candidates(m, period, skin);
                (!candidates.is_empty()).then(|| blank(i, candidates))
            })
            .collect()
    }

    fn candidates(&self, m: &Member, period: &[Option<f64>; 3], skin: f64) -> Vec<Candidate> {
        let reach = m.radius * (1.0 + skin);
        let (folded, _) = fold(&m.position, period);
        let home = folded - m.position;
        let mut out = Vec::new();
        let mut found = Vec::new();
        for (k, wall) in self.walls.iter().enumerate() {
            let bounded =
                !matches!(wall.surface, Surface::Plane { .. } | Surface::Cylinder { half_length: None, .. });
            for image in images(period, bounded) {
                let image = home + image;
                let mut triangles = None;
                if !self.shifts[k] {
                    let x = m.position + image;
                    if let Surface::Mesh(mesh) = &wall.surface {
                        let list = mesh.within(&x, reach);
                        if list.is_empty() {
                            continue;
                        }
                        triangles = Some(list);
                    }
                    found.clear();
                    near(wall, &self.poses[k], false, &x, reach, triangles.as_deref(), &mut found);
                    if found.is_empty() {
                        continue;
                    }
                }
                out.push(Candidate { wall: k as u32, image, triangles });
            }
        }
        out
    }
}

/// Periodic images a wall is looked for in.
fn images(period: &[Option<f64>; 3], bounded: bool) -> Vec<V3> {
    let mut out = vec![V3::zeros()];
    for k in 0..3 {
        if let (Some(l), true) = (period[k], bounded) {
            for i in 0..out.len() {
                for s in [-l, l] {
                    let mut v = out[i];
                    v[k] += s;
                    out.push(v);
                }
            }
        }
    }
    out
}

/// Forces of all wall contacts.
///
/// # Returns
/// The losses, and the first member with more overlap than [`Inputs::limit`] × its radius.
pub fn run<E: ContactEquations>(
    equations: E,
    inputs: &Inputs,
    scenery: &Scenery,
    near_walls: &mut [NearWall],
) -> (Losses, Option<usize>) {
    near_walls.par_iter_mut().with_min_len(64).for_each(|n| one(&equations, inputs, scenery, n));
    let mut total = Losses::default();
    let mut deep = None;
    for (k, n) in near_walls.iter().enumerate() {
        total.add(&n.losses);
        if n.too_deep && deep.is_none() {
            deep = Some(k);
        }
    }
    (total, deep)
}

fn one<E: ContactEquations>(equations: &E, inputs: &Inputs, scenery: &Scenery, n: &mut NearWall) {
    let m = &inputs.members[n.member as usize];
    n.force = V3::zeros();
    n.torque = V3::zeros();
    n.losses = Losses::default();
    n.too_deep = false;
    if m.inverse_mass == 0.0 {
        n.contacts.clear();
        return;
    }
    let touches = touches(m, scenery, &n.candidates);
    if touches.is_empty() && n.contacts.is_empty() {
        return;
    }
    let old = std::mem::take(&mut n.contacts);
    let (histories, used) = carry(&touches, &old);
    for (o, _) in old.iter().zip(&used).filter(|(_, used)| !**used) {
        n.losses.slip += o.history.released();
        n.losses.roll_slip += o.rolling.released();
    }
    for ((c, t), (mut history, mut rolling)) in touches.iter().zip(histories) {
        let wall = &scenery.walls[c.wall as usize];
        let overlap = m.radius - t.distance;
        if overlap > inputs.limit * m.radius {
            n.too_deep = true;
        }
        let arm = t.normal * -t.distance;
        let of_wall = surface_velocity(wall, &scenery.poses[c.wall as usize], &(m.position + c.image + arm));
        let motion = Motion {
            slip: equations.surface_velocity(&m.velocity, &m.spin, &arm) - of_wall,
            relative_spin: m.spin - wall.motion.spin,
            mean_spin: (m.spin + wall.motion.spin) * 0.5,
        };
        let g = Geometry { normal: t.normal, overlap, radius: m.radius, mass: 1.0 / m.inverse_mass };
        let law = inputs.table.law(m.material, wall.material as u32);
        let contact = Contact { law, geometry: g, motion, dt: inputs.dt };
        let memory = Memory { history: &mut history, rolling: &mut rolling, losses: &mut n.losses };
        let r = react(equations, &contact, memory);
        let force = g.normal * r.normal + r.tangential;
        n.losses.driven += force.dot(&of_wall) + r.rolling.dot(&wall.motion.spin);
        n.force += force;
        n.torque += arm.cross(&r.tangential) + r.rolling;
        n.contacts.push(WallContact {
            wall: c.wall,
            feature: t.feature,
            image: c.image,
            normal: t.normal,
            overlap,
            arm,
            force,
            history,
            rolling,
        });
    }
}

/// The points of all candidate walls that the member reaches.
///
/// Where two periodic images of one wall meet there is no edge: a point of one image that lies in the tangent plane
/// of a nearer point of another is left out.
fn touches<'a>(m: &Member, scenery: &Scenery, candidates: &'a [Candidate]) -> Vec<(&'a Candidate, Near)> {
    let mut out: Vec<(&Candidate, Near)> = Vec::new();
    let mut found = Vec::new();
    for c in candidates {
        found.clear();
        let k = c.wall as usize;
        let x = m.position + c.image;
        near(
            &scenery.walls[k],
            &scenery.poses[k],
            scenery.shifts[k],
            &x,
            m.radius,
            c.triangles.as_deref(),
            &mut found,
        );
        out.extend(found.iter().map(|t| (c, *t)));
    }
    let seam = |i: usize| {
        let (c, t) = &out[i];
        out.iter().enumerate().any(|(j, (o, p))| {
            let nearer = p.distance < t.distance || (p.distance == t.distance && j < i);
            let apart = (t.normal * t.distance - p.normal * p.distance).dot(&p.normal);
            nearer && o.wall == c.wall && o.image != c.image && apart.abs() <= 1e-6 * m.radius
        })
    };
    if out.len() > 1 {
        let keep: Vec<bool> = (0..out.len()).map(|i| !seam(i)).collect();
        let mut k = 0;
        out.retain(|_| {
            k += 1;
            keep[k - 1]
        });
    }
    out
}

/// Histories for the new contacts: by wall and feature, else from a vanished neighbour of the same wall with
/// nearly the same normal (a grain rolling over the edge between two triangles keeps its spring). Also says which
/// of the old contacts live on.
fn carry(touches: &[(&Candidate, Near)], old: &[WallContact]) -> (Vec<(History, Rolling)>, Vec<bool>) {
    let mut used = vec![false; old.len()];
    let mut out: Vec<Option<(History, Rolling)>> = touches
        .iter()
        .map(|(c, t)| {
            let k =
                old.iter().position(|o| o.wall == c.wall && o.feature == t.feature && o.image == c.image)?;
            used[k] = true;
            Some((old[k].history, old[k].rolling))
        })
        .collect();
    for (h, (c, t)) in out.iter_mut().zip(touches) {
        if h.is_some() {
            continue;
        }
        let k = (0..old.len())
            .find(|&k| !used[k] && old[k].wall == c.wall && old[k].normal.dot(&t.normal) > INHERIT);
        if let Some(k) = k {
            used[k] = true;
            *h = Some((old[k].history, old[k].rolling));
        }
    }
    (out.into_iter().map(Option::unwrap_or_default).collect(), used)
}

#[cfg(test)]
mod tests;
