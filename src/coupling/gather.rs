//! The links of a grain before its velocity is known \[C1\].

use super::L3;
use super::coverage::NOBODY;
use super::host::Host;
use super::immersed::Immersed;
use super::link::{Ball, Link, cut};
use super::predict::Friction;
use super::pressure::{Fit, Samples};
use crate::free_surface::Kind;
use crate::lattice::moments::density_excess;
use crate::lattice::{C, Q, W};
use crate::setup::suspension::GrainWall;
use crate::vector::cross;

/// A link whose outer cell holds fluid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Open {
    pub link: Link,
    /// From the centre of the grain to the cell.
    pub cell: L3,
    /// Where the link meets the surface, as a share of its length.
    pub q: f64,
    /// f_out* that leaves.
    pub leaving: f64,
    /// What comes back from a surface at rest.
    pub base: f64,
    /// Share of 6 w ρ c·u_w that a moving surface adds.
    pub share: f64,
    /// ρ of the cell.
    pub rho: f64,
    /// φ of the cell, 1 in liquid; then, at the surface, the wet share of the link.
    pub wet: f64,
    /// Whether the cell is interface, with a mass of its own.
    pub interface: bool,
}

impl Open {
    /// From the centre of the grain to where the link meets its surface.
    #[inline]
    pub(crate) fn arm(&self) -> L3 {
        along(&self.cell, usize::from(self.link.out), self.q)
    }

    /// From the centre of the grain to the middle of the link.
    #[inline]
    pub(crate) fn middle(&self) -> L3 {
        along(&self.cell, usize::from(self.link.out), 0.5)
    }
}

/// A link whose outer cell is gas.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dry {
    /// Its middle, from the centre of the grain.
    pub middle: L3,
    pub out: u8,
    pub covered: u32,
}

/// What the links of one grain say before its velocity is known; filled anew for every grain.
#[derive(Clone, Debug, Default)]
pub(super) struct Gathered {
    pub open: Vec<Open>,
    pub friction: Friction,
    /// Links to gas.
    pub dry: Vec<Dry>,
    balls: Vec<Ball>,
    /// From the centre of each ball to the cell that is looked at, and its radius.
    around: Vec<(L3, f64)>,
}

/// The pressure around a grain of which a part of the surface is blocked by a wall or another grain.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pressed {
    pub blocked: bool,
    /// `None` without fluid around, and where nothing is blocked.
    pub fit: Option<Fit>,
}

/// A fluid cell beside a grain.
struct Beside {
    /// From the centre of the grain.
    r: L3,
    rho: f64,
    /// φ of the cell, 1 in liquid.
    wet: f64,
    interface: bool,
    /// Populations after collision.
    f: [f64; Q],
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

impl Immersed {
    /// Pressure around a grain, if a part of its surface is blocked.
    pub(super) fn pressed(&self, host: &dyn Host, grain: usize) -> Pressed {
        let cover = self.coverage.of(grain);
        let covered = |link: &Link| self.coverage.owner(link.cell as usize) != NOBODY;
        if cover.blocked.is_empty() && !cover.links.iter().any(covered) {
            return Pressed::default();
        }
        let centre = self.centre(grain);
        let mut samples = Samples::default();
        for links in cover.links.chunk_by(|a, b| a.cell == b.cell) {
            let cell = links[0].cell as usize;
            if host.kind(cell).is_fluid() {
                let r = self.shape.apart(&self.shape.centre(cell), &centre);
                // As in a density: the sum is rounded with the one.
                let rho = 1.0 + density_excess(&host.after(cell));
                samples.add(&r, rho - 1.0);
            }
        }
        Pressed { blocked: true, fit: samples.fit() }
    }

    /// First look at the links of a grain.
    pub(super) fn gather(&self, host: &dyn Host, grain: usize, found: &mut Gathered) {
        found.open.clear();
        found.dry.clear();
        found.balls.clear();
        found.balls.extend(self.members(grain));
        let interpolated = self.config.wall == GrainWall::CentralLinear;
        let cover = self.coverage.of(grain);
        let centre = self.centre(grain);
        let mut at_surface = false;
        // Links are in order of their cell.
        for links in cover.links.chunk_by(|a, b| a.cell == b.cell) {
            let cell = links[0].cell as usize;
            let kind = host.kind(cell);
            if kind == Kind::Solid {
                continue;
            }
            let r = self.shape.apart(&self.shape.centre(cell), &centre);
            if kind == Kind::Gas {
                let dry = |link: &Link| Dry {
                    middle: along(&r, usize::from(link.out), 0.5),
                    out: link.out,
                    covered: link.covered,
                };
                found.dry.extend(links.iter().map(dry));
                continue;
            }
            let f = host.after(cell);
            let interface = kind == Kind::Interface;
            at_surface |= interface;
            let wet = if interface { host.fill(cell) } else { 1.0 };
            let beside = Beside { r, rho: 1.0 + density_excess(&f), wet, interface, f };
            found.around.clear();
            if interpolated {
                let here = self.shape.centre(cell);
                let from = |ball: &Ball| (self.shape.apart(&here, &ball.centre), ball.radius);
                found.around.extend(found.balls.iter().map(from));
            }
            for link in links {
                found.open.push(self.look(host, link, &found.around, &beside));
            }
        }
        if at_surface || !found.dry.is_empty() {
            found.share_out(&cover.cells);
        }
        found.friction = Friction::default();
        for open in &found.open {
            let out = usize::from(open.link.out);
            let c = C[out].map(f64::from);
            let turn = cross(open.arm(), c);
            let v = [c[0], c[1], c[2], turn[0], turn[1], turn[2]];
            found.friction.add(&v, open.leaving + open.base, 6.0 * W[out] * open.rho * open.share);
        }
    }

    /// One link with the surface at rest.
    fn look(&self, host: &dyn Host, link: &Link, balls: &[(L3, f64)], beside: &Beside) -> Open {
        let out = usize::from(link.out);
        let leaving = beside.f[out];
        let half = Open {
            link: *link,
            cell: beside.r,
            q: 0.5,
            leaving,
            base: leaving,
            share: 1.0,
            rho: beside.rho,
            wet: beside.wet,
            interface: beside.interface,
        };
        if self.config.wall == GrainWall::HalfWay || link.behind == NOBODY {
            return half;
        }
        let Some(from_behind) = host.fluid_one(link.behind as usize, out) else { return half };
        let q = cut(balls, out);
        let kappa = (1.0 - 2.0 * q) / (1.0 + 2.0 * q);
        let returning = beside.f[usize::from(link.slot)];
        Open { q, base: leaving + kappa * (from_behind - returning), share: 2.0 / (1.0 + 2.0 * q), ..half }
    }
}

/// The point of a link that leaves the cell at `r` along c_out, at a share of its length.
#[inline]
fn along(r: &L3, out: usize, share: f64) -> L3 {
    let c = C[out].map(f64::from);
    std::array::from_fn(|a| r[a] + share * c[a])
}
