//! Gaps between grains, and between grains and walls, and what the fluid does in them \[C5\].

use super::scales::Scales;
use super::scenery::{at_rest, near, pivot};
use crate::dem::bodies::{Bodies, Member};
use crate::dem::neighbours::PairList;
use crate::dem::walls;
use crate::dem::{Dem, V3};
use crate::rheology::Law;
use crate::setup::Setup;
use crate::setup::suspension::lubrication::{STIFFEST, Tangential, tangential};
use crate::setup::suspension::{Lubrication, Suspension};
use crate::state::state;

/// How far a member may move before the list is made anew, cells.
const MARGIN: f64 = 0.25;

/// Largest share of a grain's mass, or moment of inertia, over the grains' step that all of its gaps together may
/// reach. A clump wedged in may have ten of them: two neighbours that both do damp each other at twice this rate, and
/// an explicit step grows beyond 2. `plan` counts one gap when it chooses sub-steps, so that the gaps of such a clump
/// are limited sooner than it says.
const STIFFEST_GRAIN: f64 = 0.75;

/// What meets in a gap.
struct Meeting {
    /// From the second to the first (from the wall to the member).
    normal: V3,
    /// Velocity of the first centre relative to the second (to the wall at the nearest point), cells per step.
    velocity: V3,
    /// Spins, per step.
    spins: [V3; 2],
    /// Radii, cells; the second infinite for a wall.
    radii: [f64; 2],
    /// h, cells.
    gap: f64,
    /// 1/(1/m₁ + 1/m₂), lattice units; infinite between driven grains and walls, which no step can throw off.
    mass: f64,
}

/// Force on the first, torques on both, lattice units.
type Push = (V3, V3, V3);

/// Friction of a gap, lattice units.
#[derive(Clone, Copy, Debug)]
struct Friction {
    /// Per velocity of approach.
    normal: f64,
    tangential: Tangential,
}

impl Friction {
    fn scaled(&self, share: f64) -> Self {
        let t = &self.tangential;
        let tangential = Tangential {
            force: share * t.force,
            first: share * t.first,
            second: share * t.second,
            spins: t.spins.map(|spin| share * spin),
        };
        Self { normal: share * self.normal, tangential }
    }
}

/// A gap that resists, with the grains beside it.
struct Acting {
    meeting: Meeting,
    friction: Friction,
    /// Grain and place of the member's centre relative to the grain's, m; the second `None` for a wall.
    sides: [Option<(usize, V3)>; 2],
    /// Which wall, if one.
    wall: Option<usize>,
}

/// Gaps of a run.
#[derive(Clone, Debug)]
pub(crate) struct Gaps {
    rules: Lubrication,
    law: Law,
    list: PairList,
    /// Places of the members when the list was made, m.
    seen: Vec<V3>,
    /// Positions in the list of pairs that are close now.
    pairs: Vec<usize>,
    /// Members close to walls.
    walls: Vec<(usize, usize)>,
    /// Sum over the sub-steps of a step of the forces on each wall, N, and of their torques about the point about which it
    /// turns, N m.
    on_walls: Vec<(V3, V3)>,
}

state!(Gaps: list seen pairs walls on_walls; but rules law);

impl Gaps {
    /// Nothing looked at yet.
    pub fn new(rules: Lubrication, setup: &Setup) -> Self {
        Self {
            rules,
            law: setup.law(0),
            list: PairList::default(),
            seen: Vec::new(),
            pairs: Vec::new(),
            walls: Vec::new(),
            on_walls: Vec::new(),
        }
    }

    /// Force of the gaps on wall `k` and its torque about the point about which it turns, sums over the grains' steps in the
    /// last step of the fluid, N and N m.
    pub(crate) fn on_wall(&self, k: usize) -> (V3, V3) {
        self.on_walls.get(k).copied().unwrap_or_default()
    }

    /// Forgets the list: grains have left.
    pub(crate) fn forget(&mut self) {
        self.seen.clear();
    }

    /// Finds what is close now; whether anything is.
    pub(crate) fn look(&mut self, dem: &Dem, config: &Suspension) -> bool {
        let members = dem.members();
        let dx = config.units.dx_m;
        let margin = MARGIN * dx;
        let stale = self.seen.len() != members.len()
            || members.iter().zip(&self.seen).any(|(m, seen)| {
                let moved = (m.position - seen).norm_squared();
                moved.is_nan() || moved > margin * margin
            });
        if stale {
            let reach = 0.5 * self.rules.cutoff * dx + 2.0 * margin;
            // Lists leave out pairs that cannot push each other apart; here all that move do.
            let grown: Vec<Member> = members
                .iter()
                .map(|m| {
                    let inverse_mass = if at_rest(m) { 0.0 } else { 1.0 };
                    Member { radius: m.radius + reach, inverse_mass, ..*m }
                })
                .collect();
            self.list = PairList::find(&grown, config.dem.period.0, 0.0);
            self.seen = members.iter().map(|m| m.position).collect();
        }
        // Within one step nothing moves a whole margin.
        let limit = self.rules.cutoff * dx + margin;
        self.pairs.clear();
        for p in 0..self.list.pairs.len() {
            let (a, b) = self.list.pairs[p];
            let (a, b) = (&members[a as usize], &members[b as usize]);
            let reach = a.radius + b.radius + limit;
            if self.apart(p, a, b).norm_squared() < reach * reach {
                self.pairs.push(p);
            }
        }
        self.walls.clear();
        let scenery = dem.scenery();
        self.on_walls.clear();
        self.on_walls.resize(scenery.walls.len(), (V3::zeros(), V3::zeros()));
        let mut found = Vec::new();
        for (k, m) in members.iter().enumerate() {
            for wall in 0..scenery.walls.len() {
                let motion = &scenery.walls[wall].motion;
                if at_rest(m) && motion.velocity == V3::zeros() && motion.spin == V3::zeros() {
                    continue;
                }
                found.clear();
                near(dem, wall, m, limit, &mut found);
                if !found.is_empty() {
                    self.walls.push((k, wall));
                }
            }
        }
        !(self.pairs.is_empty() && self.walls.is_empty())
    }

    fn apart(&self, p: usize, a: &Member, b: &Member) -> V3 {
        let shift = self.list.shift.get(p).copied().unwrap_or_default();
        a.position - b.position - shift
    }

    /// Adds lubrication to force (N) and torque (N m) of every grain; `wet(grain)`: whether fluid touches it.
    pub fn push(
        &mut self,
        dem: &Dem,
        config: &Suspension,
        wet: &impl Fn(usize) -> bool,
        loads: &mut [(V3, V3)],
    ) {
        let units = &config.units;
        let force = units.force_unit() * units.dx_m * units.dx_m * units.dx_m;
        let mut acting = self.between_grains(dem, config, wet);
        self.beside_walls(dem, config, wet, &mut acting);
        let shares = shares(dem.bodies(), config, &acting);
        for Acting { meeting, friction, sides, wall } in &acting {
            let share = |side: &Option<(usize, V3)>| side.map_or(1.0, |(body, _)| shares[body]);
            let share = share(&sides[0]).min(share(&sides[1]));
            let friction = if share < 1.0 { friction.scaled(share) } else { *friction };
            let (f, first, second) = self.act(meeting, &friction);
            let f = f * force;
            let (first, second) = (first * (force * units.dx_m), second * (force * units.dx_m));
            for (side, f, t) in [(sides[0], f, first), (sides[1], -f, second)] {
                let Some((body, arm)) = side else { continue };
                loads[body].0 += f;
                // A member of a clump is off the centre of its grain; periodic images are taken away with it.
                loads[body].1 += t + arm.cross(&f);
            }
            if let (Some((sum, torques)), Some((body, arm))) =
                (wall.and_then(|wall| self.on_walls.get_mut(wall)), sides[0])
            {
                *sum -= f;
                // What the sphere gets about its centre, and what its force there makes about the wall's point.
                let of_wall = wall.map_or_else(V3::zeros, |wall| pivot(dem, wall));
                *torques -= first + (dem.bodies().position[body] + arm - of_wall).cross(&f);
            }
        }
    }

    fn between_grains(
        &mut self,
        dem: &Dem,
        config: &Suspension,
        wet: &impl Fn(usize) -> bool,
    ) -> Vec<Acting> {
        let scales = Scales::of(&config.units);
        let members = dem.members();
        let centres = &dem.bodies().position;
        let mut acting = Vec::new();
        for at in 0..self.pairs.len() {
            let p = self.pairs[at];
            let (ia, ib) = self.list.pairs[p];
            let (a, b) = (&members[ia as usize], &members[ib as usize]);
            let d = self.apart(p, a, b);
            let distance = d.norm();
            let inverse = (a.inverse_mass + b.inverse_mass) * scales.inverse_mass;
            let gap = (distance - a.radius - b.radius) * scales.length;
            let dry = !(wet(a.body as usize) && wet(b.body as usize));
            if gap >= self.rules.cutoff || distance == 0.0 || dry {
                continue;
            }
            let meeting = Meeting {
                normal: d / distance,
                velocity: (a.velocity - b.velocity) * scales.speed,
                spins: [a.spin * scales.spin, b.spin * scales.spin],
                radii: [a.radius * scales.length, b.radius * scales.length],
                gap,
                mass: 1.0 / inverse,
            };
            let friction = self.friction(&meeting, config);
            let side = |m: &Member| Some((m.body as usize, m.position - centres[m.body as usize]));
            acting.push(Acting { meeting, friction, sides: [side(a), side(b)], wall: None });
        }
        acting
    }

    fn beside_walls(
        &mut self,
        dem: &Dem,
        config: &Suspension,
        wet: &impl Fn(usize) -> bool,
        acting: &mut Vec<Acting>,
    ) {
        let (units, scales) = (&config.units, Scales::of(&config.units));
        let members = dem.members();
        let centres = &dem.bodies().position;
        let mut found = Vec::new();
        for at in 0..self.walls.len() {
            let (k, wall) = self.walls[at];
            let m = &members[k];
            if !wet(m.body as usize) {
                continue;
            }
            found.clear();
            near(dem, wall, m, self.rules.cutoff * units.dx_m, &mut found);
            for place in &found {
                let point = m.position - place.normal * place.distance;
                let (own, pose) = (&dem.scenery().walls[wall], &dem.scenery().poses[wall]);
                let meeting = Meeting {
                    normal: place.normal,
                    velocity: (m.velocity - walls::surface_velocity(own, pose, &point)) * scales.speed,
                    spins: [m.spin * scales.spin, V3::zeros()],
                    radii: [m.radius * scales.length, f64::INFINITY],
                    gap: (place.distance - m.radius) * scales.length,
                    mass: 1.0 / (m.inverse_mass * scales.inverse_mass),
                };
                if meeting.gap >= self.rules.cutoff {
                    continue;
                }
                let friction = self.friction(&meeting, config);
                let body = m.body as usize;
                acting.push(Acting {
                    meeting,
                    friction,
                    sides: [Some((body, m.position - centres[body])), None],
                    wall: Some(wall),
                });
            }
        }
    }

    /// Friction of a gap by itself, as far as an explicit step of the grains can take it.
    fn friction(&mut self, meeting: &Meeting, config: &Suspension) -> Friction {
        let Meeting { normal: n, velocity, radii, gap, mass, .. } = meeting;
        let [a, b] = *radii;
        let h = gap.max(self.rules.smallest_gap);
        let cutoff = self.rules.cutoff;
        let reduced = if b.is_infinite() { a } else { a * b / (a + b) };
        let approach = n.dot(velocity);
        let across = velocity - n * approach;
        let viscosity = self.viscosity(reduced, h, approach.abs(), across.norm());
        let mut friction = config.equations.lubrication(viscosity, reduced, h, cutoff);
        let most = STIFFEST * mass * f64::from(config.sub_steps.max(1));
        let share = if friction > most { most / friction } else { 1.0 };
        if share < 1.0 {
            friction = most;
        }
        let tangential = if self.rules.tangential {
            tangential(viscosity * share, a, b, h, cutoff)
        } else {
            Tangential::default()
        };
        Friction { normal: friction, tangential }
    }

    /// Force on the first and torques on both.
    fn act(&self, meeting: &Meeting, friction: &Friction) -> Push {
        let Meeting { normal: n, velocity, spins, .. } = meeting;
        let approach = n.dot(velocity);
        let mut push = (n * (-friction.normal * approach), V3::zeros(), V3::zeros());
        if self.rules.tangential {
            let t = &friction.tangential;
            let across = velocity - n * approach;
            let cross = n.cross(&across);
            let bend = |spin: &V3| n.cross(spin);
            let part = |spin: &V3| spin - n * n.dot(spin);
            push.0 += across * -t.force - bend(&spins[0]) * t.first - bend(&spins[1]) * t.second;
            push.1 += cross * t.first - part(&spins[0]) * t.spins[0] - part(&spins[1]) * t.spins[2];
            push.2 += cross * t.second - part(&spins[1]) * t.spins[1] - part(&spins[0]) * t.spins[2];
        }
        push
    }

    /// Apparent viscosity in a gap, at the shear rate of its squeeze or shear flow, U √R/h^{3/2} or U/h.
    ///
    /// # Source
    /// Reynolds' flow in a gap h + r²/(2R): the rate is largest near r = √(Rh).
    fn viscosity(&self, reduced: f64, h: f64, approach: f64, across: f64) -> f64 {
        if let Law::Newtonian { mu } = self.law {
            return mu;
        }
        let squeeze = approach * reduced.sqrt() / (h * h.sqrt());
        let rate = squeeze.max(across / h);
        // Below this rate only the limit of the time step matters.
        self.law.viscosity(rate.max(1e-12))
    }
}

/// Share of their friction that the gaps of each grain may have, all together: of translation and of rotation about
/// the axis of least inertia, the more of both.
fn shares(bodies: &Bodies, config: &Suspension, acting: &[Acting]) -> Vec<f64> {
    let units = &config.units;
    let mass = units.rho0_kg_per_m3 * units.dx_m * units.dx_m * units.dx_m;
    let area = units.dx_m * units.dx_m;
    let mut rates = vec![0.0; bodies.len()];
    for Acting { friction, sides, .. } in acting {
        let t = &friction.tangential;
        let push = friction.normal + t.force;
        for (side, own) in sides.iter().zip([t.spins[0], t.spins[1]]) {
            let Some((body, arm)) = *side else { continue };
            let turn = own + push * (arm.norm_squared() / area);
            let inertia = bodies.inverse_inertia[body].max() * (mass * area);
            rates[body] += push * (bodies.inverse_mass[body] * mass) + turn * inertia;
        }
    }
    let most = STIFFEST_GRAIN * f64::from(config.sub_steps.max(1));
    rates.into_iter().map(|rate| if rate > most { most / rate } else { 1.0 }).collect()
}
