//! Forces of the fluid in gaps narrower than the lattice resolves \[C5\].

use super::config::{Lubrication, Mutant, Suspension};
use crate::dem::bodies::Member;
use crate::dem::neighbours::PairList;
use crate::dem::walls::{self, Near};
use crate::dem::{Dem, V3};
use crate::rheology::Law;
use crate::solver::setup::Setup;
use std::f64::consts::PI;

/// How far a member may move before the list is made anew, cells.
const MARGIN: f64 = 0.25;

/// Largest share of a pair's reduced mass over the grains' step that the friction of a gap may reach: an explicit
/// step overshoots beyond 2 and is accurate far below.
const STIFFEST: f64 = 0.5;

/// 6πμ (r₁r₂/(r₁+r₂))² (1/h − 1/h_c): normal friction of a gap, force per velocity of approach.
///
/// The lattice carries what the flow does at gaps above h_c; subtracting 1/h_c starts the correction from zero there.
///
/// # Arguments
/// `viscosity`: μ of the fluid in the gap. `reduced`: r₁r₂/(r₁+r₂), r against a plane. `gap`: h, `cutoff`: h_c, same
/// unit as the radii.
/// # Source
/// 000 Eq 15; ERRATA 35 (π is missing there; along the line of centres).
/// # Verified by
/// Claim `lubrication-approach`; mutant `lubrication-without-pi`.
#[must_use]
pub fn normal(viscosity: f64, reduced: f64, gap: f64, cutoff: f64) -> f64 {
    if gap >= cutoff {
        return 0.0;
    }
    6.0 * PI * viscosity * reduced * reduced * (1.0 / gap - 1.0 / cutoff)
}

/// Friction of a sheared gap between a sphere of radius `a` and one of radius `b` = β a: coefficients of
/// L = ln(h_c/h).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tangential {
    /// Force on either sphere per tangential velocity of the centres.
    pub force: f64,
    /// Torque on the first sphere per tangential velocity, and force per spin of the first.
    pub first: f64,
    /// The same of the second.
    pub second: f64,
    /// Torque on the first per its own spin, on the second per its own, and on one per the spin of the other.
    pub spins: [f64; 3],
}

/// Leading logarithms of the tangential resistance of two spheres.
///
/// # Arguments
/// `viscosity`: μ. `a`: radius of the first sphere. `b`: of the second; infinite for a plane. `gap`, `cutoff`: h, h_c.
/// # Exactness
/// A pair that turns as one body feels nothing (test `exact_rigid_pair`).
/// # Source
/// Jeffrey & Onishi 1984, J. Fluid Mech. 139, 261 (Y^A, Y^B, Y^C); for a plane Goldman, Cox & Brenner 1967.
/// # Verified by
/// Tests `exact_rigid_pair`, `reference_plane`.
#[must_use]
pub fn tangential(viscosity: f64, a: f64, b: f64, gap: f64, cutoff: f64) -> Tangential {
    if gap >= cutoff {
        return Tangential::default();
    }
    let log = libm::log(cutoff / gap);
    let scale = PI * viscosity * log;
    if b.is_infinite() {
        return Tangential {
            force: scale * a * (16.0 / 5.0),
            first: scale * a * a * (4.0 / 5.0),
            second: 0.0,
            spins: [scale * a * a * a * (16.0 / 5.0), 0.0, 0.0],
        };
    }
    let beta = b / a;
    let sum = 1.0 + beta;
    let square = sum * sum;
    Tangential {
        force: scale * a * (8.0 * beta * (2.0 + beta + 2.0 * beta * beta) / (5.0 * square * sum)),
        first: scale * a * a * (4.0 * beta * (4.0 + beta) / (5.0 * square)),
        second: scale * b * b * (4.0 * (4.0 * beta + 1.0) / (5.0 * square)),
        spins: [
            scale * a * a * a * (16.0 * beta / (5.0 * sum)),
            scale * b * b * b * (16.0 / (5.0 * sum)),
            scale * a * a * a * (4.0 * beta * beta / (5.0 * sum)),
        ],
    }
}

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
    /// 1/(1/m₁ + 1/m₂), lattice units.
    mass: f64,
}

/// Force on the first, torques on both, lattice units.
type Push = (V3, V3, V3);

/// Gaps of a run.
#[derive(Clone, Debug)]
pub struct Gaps {
    rules: Lubrication,
    law: Law,
    list: PairList,
    /// Places of the members when the list was made, m.
    seen: Vec<V3>,
    /// Positions in the list of pairs that are close now.
    pairs: Vec<usize>,
    /// Members close to walls.
    walls: Vec<(usize, usize)>,
    /// Gaps whose friction was limited, so far.
    limited: u64,
}

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
            limited: 0,
        }
    }

    /// How often the friction of a gap was limited to what the time step allows.
    pub fn limited(&self) -> u64 {
        self.limited
    }

    /// Forgets the list: grains have left.
    pub fn forget(&mut self) {
        self.seen.clear();
    }

    /// Finds what is close now; whether anything is.
    pub fn look(&mut self, dem: &Dem, config: &Suspension) -> bool {
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
            let grown: Vec<Member> =
                members.iter().map(|m| Member { radius: m.radius + reach, ..*m }).collect();
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
        let mut found = Vec::new();
        for (k, m) in members.iter().enumerate().filter(|(_, m)| m.inverse_mass > 0.0) {
            for wall in 0..scenery.walls.len() {
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
        let (length, speed, rate) = (1.0 / units.dx_m, 1.0 / units.velocity_unit(), units.dt_s);
        let inverse_mass = units.rho0_kg_per_m3 * units.dx_m * units.dx_m * units.dx_m;
        let force = units.force_unit() * units.dx_m * units.dx_m * units.dx_m;
        let members = dem.members();
        let centres = &dem.bodies().position;
        for at in 0..self.pairs.len() {
            let p = self.pairs[at];
            let (ia, ib) = self.list.pairs[p];
            let (a, b) = (&members[ia as usize], &members[ib as usize]);
            let d = self.apart(p, a, b);
            let distance = d.norm();
            let inverse = (a.inverse_mass + b.inverse_mass) * inverse_mass;
            let gap = (distance - a.radius - b.radius) * length;
            let dry = !(wet(a.body as usize) && wet(b.body as usize));
            if gap >= self.rules.cutoff || distance == 0.0 || inverse == 0.0 || dry {
                continue;
            }
            let meeting = Meeting {
                normal: d / distance,
                velocity: (a.velocity - b.velocity) * speed,
                spins: [a.spin * rate, b.spin * rate],
                radii: [a.radius * length, b.radius * length],
                gap,
                mass: 1.0 / inverse,
            };
            let (f, first, second) = self.act(&meeting, config);
            let f = f * force;
            let (first, second) = (first * (force * units.dx_m), second * (force * units.dx_m));
            for (member, f, t) in [(a, f, first), (b, -f, second)] {
                let body = member.body as usize;
                loads[body].0 += f;
                // A member of a clump is off the centre of its grain; periodic images are taken away with it.
                loads[body].1 += t + (member.position - centres[body]).cross(&f);
            }
        }
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
                    velocity: (m.velocity - walls::surface_velocity(own, pose, &point)) * speed,
                    spins: [m.spin * rate, V3::zeros()],
                    radii: [m.radius * length, f64::INFINITY],
                    gap: (place.distance - m.radius) * length,
                    mass: 1.0 / (m.inverse_mass * inverse_mass),
                };
                if meeting.gap >= self.rules.cutoff {
                    continue;
                }
                let (f, t, _) = self.act(&meeting, config);
                let (f, t) = (f * force, t * (force * units.dx_m));
                let body = m.body as usize;
                loads[body].0 += f;
                loads[body].1 += t + (m.position - centres[body]).cross(&f);
            }
        }
    }

    /// Force on the first and torques on both.
    fn act(&mut self, meeting: &Meeting, config: &Suspension) -> Push {
        let Meeting { normal: n, velocity, spins, radii, gap, mass } = meeting;
        let [a, b] = *radii;
        let h = gap.max(self.rules.smallest_gap);
        let cutoff = self.rules.cutoff;
        let reduced = if b.is_infinite() { a } else { a * b / (a + b) };
        let approach = n.dot(velocity);
        let across = velocity - n * approach;
        let viscosity = self.viscosity(reduced, h, approach.abs(), across.norm());
        let pi_share = if config.mutant == Mutant::LubricationWithoutPi { 1.0 / PI } else { 1.0 };
        let mut friction = normal(viscosity, reduced, h, cutoff) * pi_share;
        let steps = f64::from(config.sub_steps.max(1));
        // What an explicit step of the grains can take.
        let most = STIFFEST * mass * steps;
        let share = if friction > most { most / friction } else { 1.0 };
        if share < 1.0 {
            self.limited += 1;
            friction = most;
        }
        let mut push = (n * (-friction * approach), V3::zeros(), V3::zeros());
        if self.rules.tangential {
            let t = tangential(viscosity * share, a, b, h, cutoff);
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

/// Points of a wall near a member, nearer to its surface than `reach` (m).
fn near(dem: &Dem, wall: usize, m: &Member, reach: f64, found: &mut Vec<Near>) {
    let scenery = dem.scenery();
    walls::near(
        &scenery.walls[wall],
        &scenery.poses[wall],
        scenery.shifts[wall],
        &m.position,
        m.radius + reach,
        None,
        found,
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_rigid_pair() {
        // Two spheres that turn about any point as one body: x₁ − x₂ = (a + b) n.
        for (a, b) in [(1.0, 1.0), (2.0, 0.3), (0.7, 5.0)] {
            let t = tangential(0.3, a, b, 1e-3, 0.5);
            let speed = -(a + b); // of n × ω
            let force = -t.force * speed - t.first - t.second;
            let first = -(t.first * speed) - t.spins[0] - t.spins[2];
            let second = -(t.second * speed) - t.spins[1] - t.spins[2];
            for (sum, size) in [(force, t.first), (first, t.spins[0]), (second, t.spins[1])] {
                // A dozen roundings.
                assert!(sum.abs() < 1e-14 * size.max(1.0), "{sum} {size}");
            }
        }
    }

    #[test]
    fn reference_plane() {
        // Goldman, Cox & Brenner 1967: 6πμa (8/15), 8πμa² (1/10), 8πμa³ (2/5), each times ln(a/h).
        let t = tangential(1.0, 2.0, f64::INFINITY, 0.01, 1.0);
        let log = libm::log(100.0);
        assert!((t.force - 6.0 * PI * 2.0 * 8.0 / 15.0 * log).abs() < 1e-12);
        assert!((t.first - 8.0 * PI * 4.0 * 0.1 * log).abs() < 1e-12);
        assert!((t.spins[0] - 8.0 * PI * 8.0 * 0.4 * log).abs() < 1e-12);
        // A large sphere is nearly a plane; what is left falls like a/b.
        let large = tangential(1.0, 2.0, 2e5, 0.01, 1.0);
        assert!((large.force / t.force - 1.0).abs() < 1e-4 && (large.first / t.first - 1.0).abs() < 1e-4);
    }

    #[test]
    fn exact_normal_at_the_cutoff() {
        assert_eq!(normal(1.0, 1.0, 0.5, 0.5), 0.0);
        assert!((normal(1.0, 1.0, 0.1, 0.5) - 6.0 * PI * 8.0).abs() < 1e-12);
    }
}
