//! Heaps and columns of yield-stress fluid on a plane floor, scaled to a lattice.

use lahar::rheology::Law;
use lahar::setup::{BodyForce, Face, FreeSurface, Setup, YieldTreatment};
use lahar::solver::run::Run;

/// Points per cell and direction at which the initial surface is sampled.
const SAMPLES: usize = 8;

/// A frustum of Bingham fluid that is let go on a floor. Lengths in units of its height H, stresses of
/// ρ g H, times of μ/(ρ g H).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heap {
    /// Radius at the top.
    pub top: f64,
    /// Radius at the base.
    pub base: f64,
    /// σ0/(ρ g H).
    pub yield_stress: f64,
    /// ρ² g H³/μ²: squared ratio of viscous to free-fall time.
    pub galileo: f64,
    /// 3 g H Δt²/Δx²: relative compression of the fluid at the base.
    pub compression: f64,
    /// Half-width of the box.
    pub reach: f64,
    /// Height of the box.
    pub room: f64,
    /// The floor.
    pub floor: Face,
    /// Quarter of the heap between two mirror planes, or the whole.
    pub quarter: bool,
}

impl Heap {
    /// F, lattice units.
    pub fn force(&self, n: f64) -> f64 {
        self.compression / (3.0 * n)
    }

    /// μ, lattice units: N (c/(3 Ga))^½.
    pub fn viscosity(&self, n: f64) -> f64 {
        n * (self.compression / (3.0 * self.galileo)).sqrt()
    }

    /// μ/(ρ g H) in steps.
    pub fn unit_of_time(&self, n: f64) -> f64 {
        3.0 * self.viscosity(n) / self.compression
    }

    /// Depth of the frustum at a distance from its axis.
    pub fn surface(&self, r: f64) -> f64 {
        if r <= self.top {
            1.0
        } else if r >= self.base {
            0.0
        } else {
            (self.base - r) / (self.base - self.top)
        }
    }

    /// Mass per area and ρ0 of the frustum in hydrostatic balance: h + ½ c h².
    pub fn weight(&self, r: f64) -> f64 {
        let h = self.surface(r);
        h + 0.5 * self.compression * h * h
    }

    /// Mass over ρ0 of the whole frustum, in units of H³: ∫ weight 2π r dr by the midpoint rule.
    pub fn mass(&self) -> f64 {
        const RINGS: usize = 20_000;
        let dr = self.base / RINGS as f64;
        let ring = |i: usize| {
            let r = (i as f64 + 0.5) * dr;
            self.weight(r) * r
        };
        2.0 * core::f64::consts::PI * dr * (0..RINGS).map(ring).sum::<f64>()
    }

    /// The set-up with H = `n` cells; z is up.
    pub fn setup(&self, n: f64) -> Setup {
        let law = Law::Bingham { sigma0: self.yield_stress * self.compression / 3.0, mu: self.viscosity(n) };
        let mut setup = Setup::periodic([1; 3], law);
        let across = libm::ceil(self.reach * n) as usize;
        let wide = if self.quarter { across } else { 2 * across };
        setup.extents = [wide, wide, libm::ceil(self.room * n) as usize];
        let low = if self.quarter { Face::FreeSlip } else { Face::NoSlip };
        setup.faces = [[low, Face::NoSlip], [low, Face::NoSlip], [self.floor, Face::NoSlip]];
        setup.force = BodyForce::Constant([0.0, 0.0, -self.force(n)]);
        let fill = (0..setup.cells()).map(|cell| self.fill(&setup, cell, n)).collect();
        setup.free_surface = Some(FreeSurface::new(fill));
        setup
    }

    /// The set-up under the papers' clamp: apparent viscosity at most `ratio` times the least one.
    pub fn clamped(&self, n: f64, tau_max: f64, ratio: f64) -> Setup {
        let mut setup = self.setup(n);
        setup.yielding = YieldTreatment::ImplicitClamped { tau_min: 0.5 + (tau_max - 0.5) / ratio, tau_max };
        setup
    }

    /// Whole cells between the axis and the near edge of cell (i, j).
    fn offsets(&self, setup: &Setup, [i, j, _]: [usize; 3]) -> [usize; 2] {
        let half = if self.quarter { 0 } else { setup.extents[0] / 2 };
        [i, j].map(|i| if i >= half { i - half } else { half - 1 - i })
    }

    /// Distance of a cell's centre from the axis in cells.
    pub fn distance(&self, setup: &Setup, cell: usize) -> f64 {
        let [x, y] = self.offsets(setup, setup.coordinates(cell)).map(|i| i as f64 + 0.5);
        (x * x + y * y).sqrt()
    }

    fn fill(&self, setup: &Setup, cell: usize, n: f64) -> f64 {
        let at = setup.coordinates(cell);
        // Counted from the axis, so that mirrored cells get the same bits; the smaller offset first, so
        // that x and y are alike.
        let [a, b] = self.offsets(setup, at);
        let (a, b) = (a.min(b) as f64, a.max(b) as f64);
        let part = |s: usize| (s as f64 + 0.5) / SAMPLES as f64;
        let mut sum = 0.0;
        for s in 0..SAMPLES {
            for t in 0..SAMPLES {
                let (x, y) = (a + part(s), b + part(t));
                let h = n * self.surface((x * x + y * y).sqrt() / n);
                sum += (h - at[2] as f64).clamp(0.0, 1.0);
            }
        }
        sum / (SAMPLES * SAMPLES) as f64
    }
}

/// The heap as seen at one time. Lengths in units of H.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// Mean radius of the columns of each ring; rings are one cell wide.
    pub r: Vec<f64>,
    /// Mass per area and ρ0, mean of the ring.
    pub h: Vec<f64>,
    /// Number of columns of each ring.
    pub columns: Vec<f64>,
    /// (∫ h r² dA/∫ h dA)^½.
    pub gyration: f64,
    /// Height by fill of the column next to the axis.
    pub top: f64,
    /// Radius of a disc of the area that fluid covers in the lowest layer.
    pub base: f64,
    /// Largest speed of a cell, lattice units.
    pub speed: f64,
    /// Distance of the last column deeper than a quarter of a cell, along an axis and along a diagonal.
    pub ends: [f64; 2],
}

impl View {
    /// The heap of a run with H = `n` cells.
    pub fn of(heap: &Heap, run: &dyn Run, n: f64) -> Self {
        let (setup, fields) = (run.setup(), run.fields());
        let [nx, ny, nz] = setup.extents;
        let layer = nx * ny;
        let depth = |column: usize| {
            let cells = (0..nz).map(|k| column + layer * k);
            cells.fold(0.0, |sum, c| sum + fields.fill[c] * fields.density[c])
        };
        let rings = nx.max(ny) * 3 / 2;
        let (mut r, mut h, mut columns) = (vec![0.0; rings], vec![0.0; rings], vec![0.0; rings]);
        let (mut weight, mut moment) = (0.0, 0.0);
        let mut ends = [0.0_f64; 2];
        for column in 0..layer {
            let (distance, depth) = (heap.distance(setup, column), depth(column));
            let ring = distance as usize;
            r[ring] += distance / n;
            h[ring] += depth / n;
            columns[ring] += 1.0;
            weight += depth;
            moment += depth * (distance / n) * (distance / n);
            let [i, j, _] = setup.coordinates(column);
            if depth > 0.25 {
                let [a, b] = heap.offsets(setup, [i, j, 0]);
                if b == 0 {
                    ends[0] = ends[0].max(distance / n);
                }
                if a == b {
                    ends[1] = ends[1].max(distance / n);
                }
            }
        }
        let kept: Vec<usize> = (0..rings).filter(|&ring| columns[ring] > 0.0).collect();
        let mean = |sums: &[f64]| kept.iter().map(|&ring| sums[ring] / columns[ring]).collect();
        let middle = if heap.quarter { 0 } else { nx / 2 + nx * (ny / 2) };
        let covered = fields.fill[..layer].iter().fold(0.0, |sum, fill| sum + fill);
        let speed2 = fields.velocity.iter().map(|u| (u[0] * u[0] + u[1] * u[1]) + u[2] * u[2]);
        Self {
            r: mean(&r),
            h: mean(&h),
            columns: kept.iter().map(|&ring| columns[ring]).collect(),
            gyration: (moment / weight).sqrt(),
            top: (0..nz).fold(0.0, |sum, k| sum + fields.fill[middle + layer * k]) / n,
            base: (covered * if heap.quarter { 4.0 } else { 1.0 } / core::f64::consts::PI).sqrt() / n,
            speed: speed2.fold(0.0, f64::max).sqrt(),
            ends,
        }
    }

    /// Where the mean depth last falls through `threshold`; 0 if it is nowhere above.
    pub fn front(&self, threshold: f64) -> f64 {
        let Some(i) = self.h.iter().rposition(|&h| h > threshold) else { return 0.0 };
        let next = (i + 1).min(self.h.len() - 1);
        let (fall, step) = (self.h[i] - self.h[next], self.r[next] - self.r[i]);
        if fall > 0.0 { self.r[i] + step * (self.h[i] - threshold) / fall } else { self.r[i] }
    }
}
