//! Inputs shared by the property tests.

#![allow(dead_code, reason = "each test file uses part of it")]

use lahar::collision::{CollisionChoice, OddRate};
use lahar::lattice::{C, Q, W};
use lahar::rheology::Law;
use lahar::setup::YieldTreatment;

/// Every operator, the two-rate ones with and without floor.
pub const OPERATORS: [CollisionChoice; 6] = [
    CollisionChoice::Bgk,
    CollisionChoice::Trt(OddRate::fixed(3.0 / 16.0)),
    CollisionChoice::Trt(OddRate { magic: 0.25, ..OddRate::STANDARD }),
    CollisionChoice::CentralMoment(OddRate::STANDARD),
    CollisionChoice::CentralMoment(OddRate::fixed(3.0 / 16.0)),
    CollisionChoice::Regularised,
];

/// One law of each kind.
pub const LAWS: [Law; 7] = [
    Law::Newtonian { mu: 0.05 },
    Law::Bingham { sigma0: 1e-4, mu: 0.05 },
    Law::HerschelBulkley { sigma0: 1e-4, k: 0.01, n: 0.33 },
    Law::HerschelBulkley { sigma0: 1e-4, k: 0.2, n: 1.7 },
    Law::PowerLaw { k: 0.01, n: 0.5 },
    Law::Papanastasiou { sigma0: 1e-4, k: 0.02, n: 1.0, m: 1e3 },
    Law::Papanastasiou { sigma0: 1e-4, k: 0.02, n: 0.6, m: 1e4 },
];

/// Every treatment of the yield stress.
pub const TREATMENTS: [YieldTreatment; 3] = [
    YieldTreatment::Exact,
    YieldTreatment::ImplicitClamped { tau_min: 0.505, tau_max: 1.8 },
    YieldTreatment::LaggedClamped { tau_min: 0.505, tau_max: 1.8 },
];

/// Numbers in [−½, ½), the same for the same seed.
pub struct Numbers(u64);

impl Numbers {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(2).wrapping_add(1))
    }
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    }
    pub fn vector(&mut self, size: f64) -> [f64; 3] {
        std::array::from_fn(|_| size * self.next())
    }
    /// Populations f − w within ± half of `size` of their weights.
    pub fn populations(&mut self, size: f64) -> [f64; Q] {
        std::array::from_fn(|i| W[i] * size * self.next())
    }
}

/// One of the 48 symmetries of the cube: axis a goes to axis `axes[a]` with sign `signs[a]`.
#[derive(Clone, Copy, Debug)]
pub struct Symmetry {
    pub axes: [usize; 3],
    pub signs: [i32; 3],
}

impl Symmetry {
    pub fn all() -> Vec<Self> {
        let orders = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [1, 0, 2], [0, 2, 1], [2, 1, 0]];
        let signs = (0..8).map(|bits: i32| [0, 1, 2].map(|a| if bits >> a & 1 == 1 { -1 } else { 1 }));
        signs.flat_map(|signs| orders.map(|axes| Self { axes, signs })).collect()
    }

    /// Mirrors only: no axis changes its place.
    pub fn is_mirror(&self) -> bool {
        self.axes == [0, 1, 2]
    }

    pub fn vector(&self, v: [f64; 3]) -> [f64; 3] {
        let mut image = [0.0; 3];
        for a in 0..3 {
            image[self.axes[a]] = f64::from(self.signs[a]) * v[a];
        }
        image
    }

    pub fn tensor(&self, t: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
        let mut image = [[0.0; 3]; 3];
        for a in 0..3 {
            for b in 0..3 {
                image[self.axes[a]][self.axes[b]] = f64::from(self.signs[a] * self.signs[b]) * t[a][b];
            }
        }
        image
    }

    pub fn direction(&self, i: usize) -> usize {
        let mut image = [0; 3];
        for a in 0..3 {
            image[self.axes[a]] = self.signs[a] * C[i][a];
        }
        C.iter().position(|&c| c == image).expect("the velocity set is symmetric")
    }

    pub fn populations(&self, h: &[f64; Q]) -> [f64; Q] {
        let mut image = [0.0; Q];
        for i in 0..Q {
            image[self.direction(i)] = h[i];
        }
        image
    }

    pub fn extents(&self, n: [usize; 3]) -> [usize; 3] {
        let mut image = [0; 3];
        for a in 0..3 {
            image[self.axes[a]] = n[a];
        }
        image
    }

    /// Image of a cell of a box with these extents.
    pub fn cell(&self, cell: [usize; 3], n: [usize; 3]) -> [usize; 3] {
        let mut image = [0; 3];
        for a in 0..3 {
            image[self.axes[a]] = if self.signs[a] > 0 { cell[a] } else { n[a] - 1 - cell[a] };
        }
        image
    }
}
