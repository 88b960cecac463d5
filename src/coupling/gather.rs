//! The links of a grain before its velocity is known \[C1\].

use super::L3;
use super::config::GrainWall;
use super::coverage::NOBODY;
use super::host::Host;
use super::immersed::Immersed;
use super::link::{Ball, Link, cross, cut};
use super::predict::Friction;
use super::pressure::{Fit, Samples};
use crate::boundary::links::Source;
use crate::free_surface::Kind;
use crate::lattice::moments::density_excess;
use crate::lattice::{C, W};

/// A link whose outer cell holds fluid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Open {
    pub link: Link,
    /// From the centre of the grain to where the link meets its surface.
    pub arm: L3,
    /// From the centre of the grain to the middle of the link.
    pub middle: L3,
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

/// A link whose outer cell is gas.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dry {
    /// Its middle, from the centre of the grain.
    pub middle: L3,
    pub out: u8,
    pub covered: u32,
}

/// What the links of one grain say before its velocity is known.
#[derive(Clone, Debug, Default)]
pub(super) struct Gathered {
    pub open: Vec<Open>,
    pub friction: Friction,
    /// Around the grain; only where a part of its surface is blocked.
    pub fit: Option<Fit>,
    /// Links to gas.
    pub dry: Vec<Dry>,
    pub blocked: bool,
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
    /// First look at the links of a grain.
    pub(super) fn gather(&self, host: &dyn Host, grain: usize) -> Gathered {
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
}

/// Middle of a link that leaves the cell at `r` along c_out.
#[inline]
fn half_way(r: &L3, out: usize) -> L3 {
    std::array::from_fn(|a| r[a] + 0.5 * f64::from(C[out][a]))
}
