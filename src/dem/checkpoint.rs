//! From a set-up to a run, and a run's state as plain data.

use super::build::build;
use super::contact::{History, Losses, Rolling};
use super::integrate::gear::Gear;
use super::simulation::{Dem, place};
use super::walls::pass::WallContact;
use super::{DemError, Orientation, Setup, V3};
use serde::{Deserialize, Serialize};

/// A vector as plain data.
pub type Plain = [f64; 3];

/// A touching pair: members, history (normal, root, spring, force, rolling spring, rolling torque).
pub(crate) type PlainPair = (u32, u32, [f64; 12]);

/// A wall contact.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlainWallContact {
    /// Member number.
    pub member: u32,
    /// Wall number.
    pub wall: u32,
    /// Face, edge or corner.
    pub feature: u32,
    /// Periodic image, m.
    pub image: Plain,
    /// From the wall to the member.
    pub normal: Plain,
    /// m.
    pub overlap: f64,
    /// As in [`PlainPair`].
    pub history: [f64; 12],
}

/// Gear's six values of one body.
pub(crate) type PlainGear = [Plain; 6];

/// The state of a run; together with its set-up it continues bit for bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Steps done.
    pub steps: u64,
    /// m, per body; likewise the next ones.
    pub position: Vec<[f64; 3]>,
    /// m/s.
    pub velocity: Vec<[f64; 3]>,
    /// rad/s.
    pub spin: Vec<[f64; 3]>,
    /// w, i, j, k.
    pub orientation: Vec<[f64; 4]>,
    /// kg m²/s.
    pub momentum: Vec<[f64; 3]>,
    /// N.
    pub force: Vec<[f64; 3]>,
    /// N m.
    pub torque: Vec<[f64; 3]>,
    /// External force and torque, if set.
    pub external: Option<(Vec<Plain>, Vec<Plain>)>,
    /// Gear's derivatives of positions and turns, if used.
    pub gear: Option<(Vec<PlainGear>, Vec<PlainGear>)>,
    /// Touching pairs of members with their histories.
    pub pairs: Vec<PlainPair>,
    /// Wall contacts.
    pub walls: Vec<PlainWallContact>,
    /// Books: rates and sums (normal, tangential, rolling, slip, rolling slip, driven), external work.
    pub books: ([f64; 6], [f64; 6], f64),
}

fn pack(v: &V3) -> [f64; 3] {
    [v.x, v.y, v.z]
}

fn pack_all(v: &[V3]) -> Vec<[f64; 3]> {
    v.iter().map(pack).collect()
}

fn unpack_all(v: &[[f64; 3]]) -> Vec<V3> {
    v.iter().map(|a| V3::from(*a)).collect()
}

fn pack_history(h: &History, rolling: &Rolling) -> [f64; 12] {
    let (n, s, r) = (h.normal, h.spring, rolling.roll);
    [n.x, n.y, n.z, h.root, s.x, s.y, s.z, h.force, r.x, r.y, r.z, rolling.torque]
}

fn unpack_history(a: &[f64; 12]) -> (History, Rolling) {
    let history = History {
        normal: V3::new(a[0], a[1], a[2]),
        root: a[3],
        spring: V3::new(a[4], a[5], a[6]),
        force: a[7],
    };
    (history, Rolling { roll: V3::new(a[8], a[9], a[10]), torque: a[11], moment: V3::zeros() })
}

fn pack_losses(l: &Losses) -> [f64; 6] {
    [l.normal, l.tangential, l.rolling, l.slip, l.roll_slip, l.driven]
}

fn unpack_losses(a: &[f64; 6]) -> Losses {
    Losses { normal: a[0], tangential: a[1], rolling: a[2], slip: a[3], roll_slip: a[4], driven: a[5] }
}

impl Checkpoint {
    /// One entry of everything per body.
    fn check_counts(&self, expected: usize) -> Result<(), DemError> {
        for (what, found) in [
            ("number of positions", self.position.len()),
            ("number of velocities", self.velocity.len()),
            ("number of spins", self.spin.len()),
            ("number of orientations", self.orientation.len()),
            ("number of angular momenta", self.momentum.len()),
            ("number of forces", self.force.len()),
            ("number of torques", self.torque.len()),
            (
                "number of external forces",
                self.external.as_ref().map_or(expected, |e| e.0.len().min(e.1.len())),
            ),
            ("number of Gear states", self.gear.as_ref().map_or(expected, |e| e.0.len().min(e.1.len()))),
        ] {
            if found != expected {
                return Err(DemError::Checkpoint { what, found, expected });
            }
        }
        Ok(())
    }
}

impl Dem {
    /// The state as plain data.
    pub fn checkpoint(&self) -> Checkpoint {
        let b = &self.bodies;
        let gear = |g: &Vec<Gear>| g.iter().map(|g| g.0.map(|v| pack(&v))).collect::<Vec<_>>();
        let quaternion = |q: &Orientation| [q.w, q.i, q.j, q.k];
        Checkpoint {
            steps: self.steps,
            position: pack_all(&b.position),
            velocity: pack_all(&b.velocity),
            spin: pack_all(&b.spin),
            orientation: b.orientation.iter().map(quaternion).collect(),
            momentum: pack_all(&b.momentum),
            force: pack_all(&b.force),
            torque: pack_all(&b.torque),
            external: self.external.as_ref().map(|(f, t)| (pack_all(f), pack_all(t))),
            gear: self.gear.as_ref().map(|(x, w)| (gear(x), gear(w))),
            pairs: (0..self.list.pairs.len())
                .filter(|&p| self.pairs.touching[p])
                .map(|p| {
                    (
                        self.list.pairs[p].0,
                        self.list.pairs[p].1,
                        pack_history(
                            &self.pairs.history[p],
                            &self.pairs.rolling.get(p).copied().unwrap_or_default(),
                        ),
                    )
                })
                .collect(),
            walls: self
                .near
                .iter()
                .flat_map(|n| n.contacts.iter().map(move |c| (n.member, c)))
                .map(|(member, c)| PlainWallContact {
                    member,
                    wall: c.wall,
                    feature: c.feature,
                    image: pack(&c.image),
                    normal: pack(&c.normal),
                    overlap: c.overlap,
                    history: pack_history(&c.history, &c.rolling),
                })
                .collect(),
            books: (pack_losses(&self.rates), pack_losses(&self.lost), self.external_work),
        }
    }

    /// Continues a run from its set-up and a checkpoint, bit for bit. Forces of single contacts (views, forces on
    /// walls) are known again after the first step.
    ///
    /// # Errors
    /// The checks of [`Dem::new`] except for the start overlap; a checkpoint of another number of grains, or
    /// with contacts that the set-up cannot have.
    pub fn resume(setup: &Setup, c: &Checkpoint) -> Result<Self, DemError> {
        let mut dem = build(setup)?;
        c.check_counts(dem.bodies.len())?;
        dem.bodies_from(c);
        dem.external = c.external.as_ref().map(|(f, t)| (unpack_all(f), unpack_all(t)));
        let gear = |g: &Vec<PlainGear>| g.iter().map(|g| Gear(g.map(V3::from))).collect::<Vec<_>>();
        dem.gear = c.gear.as_ref().map(|(x, w)| (gear(x), gear(w)));
        dem.steps = c.steps;
        dem.rates = unpack_losses(&c.books.0);
        dem.lost = unpack_losses(&c.books.1);
        dem.external_work = c.books.2;
        dem.scenery.set_time(dem.time());
        for (m, offset) in dem.members.iter_mut().zip(&dem.offsets) {
            place(m, &dem.bodies, offset);
        }
        dem.renew_lists();
        dem.pairs_from(c)?;
        dem.wall_contacts_from(c)?;
        Ok(dem)
    }

    fn bodies_from(&mut self, c: &Checkpoint) {
        let b = &mut self.bodies;
        b.position = unpack_all(&c.position);
        b.velocity = unpack_all(&c.velocity);
        b.spin = unpack_all(&c.spin);
        // The stored bits are unit quaternions already; normalising again could change them.
        b.orientation = c
            .orientation
            .iter()
            .map(|q| Orientation::new_unchecked(nalgebra::Quaternion::new(q[0], q[1], q[2], q[3])))
            .collect();
        b.momentum = unpack_all(&c.momentum);
        b.force = unpack_all(&c.force);
        b.torque = unpack_all(&c.torque);
    }

    fn pairs_from(&mut self, c: &Checkpoint) -> Result<(), DemError> {
        for (a, b, h) in &c.pairs {
            let Some(p) = self.list.position(*a, *b) else {
                return Err(DemError::Checkpoint {
                    what: "a touching pair's member",
                    found: *b as usize,
                    expected: *a as usize,
                });
            };
            let (history, rolling) = unpack_history(h);
            self.pairs.history[p] = history;
            if let Some(r) = self.pairs.rolling.get_mut(p) {
                *r = rolling;
            }
            self.pairs.touching[p] = true;
        }
        Ok(())
    }

    fn wall_contacts_from(&mut self, c: &Checkpoint) -> Result<(), DemError> {
        let expected = self.bodies.len();
        for PlainWallContact { member, wall, feature, image, normal, overlap, history } in &c.walls {
            let entry = self.near_of.get(*member as usize).copied().unwrap_or(u32::MAX);
            let Some(n) = self.near.get_mut(entry as usize) else {
                return Err(DemError::Checkpoint {
                    what: "a wall contact's member",
                    found: *member as usize,
                    expected,
                });
            };
            let (history, rolling) = unpack_history(history);
            n.contacts.push(WallContact {
                wall: *wall,
                feature: *feature,
                image: V3::from(*image),
                normal: V3::from(*normal),
                overlap: *overlap,
                arm: V3::zeros(),
                force: V3::zeros(),
                history,
                rolling,
            });
        }
        Ok(())
    }
}
