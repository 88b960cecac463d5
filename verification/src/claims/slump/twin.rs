//! Heaps that slump by lubrication theory, and their rest shapes.

use super::scene::{Heap, View};
use crate::claim::VerifyError;
use crate::exact::ExactError;
use crate::exact::flow_curve::FlowCurve;
use crate::exact::poiseuille_clamped::Trilinear;
use crate::exact::slump::SpreadRest;
use crate::exact::thin_layer::{Geometry, Snapshot, ThinLayer};
use lahar::rheology::Law;

/// Cells per H of the depth-averaged solution; a test says what half as many change.
const CELLS: f64 = 40.0;

/// Radius of the Roussel-Coussot shape over its radius of gyration.
pub const EDGE_OVER_GYRATION: f64 = 1.620_185_174_601_965;

/// A reference that could not be computed, as an error of the claim.
pub fn no_reference(error: ExactError) -> VerifyError {
    VerifyError::Numerics { what: "the reference", detail: error.to_string() }
}

fn law(heap: &Heap) -> Law {
    Law::Bingham { sigma0: heap.yield_stress, mu: 1.0 }
}

/// The spreading heap at the given times (units of [`Heap`]), ideal Bingham fluid.
pub fn ideal(heap: &Heap, times: &[f64]) -> Result<Vec<Snapshot>, VerifyError> {
    history(heap, law(heap), CELLS, times)
}

/// The spreading heap at the given times (units of [`Heap`]), the apparent viscosity clamped to `most` and `most/ratio`, in units of μ.
pub fn clamped(heap: &Heap, most: f64, ratio: f64, times: &[f64]) -> Result<Vec<Snapshot>, VerifyError> {
    history(heap, Trilinear::new(law(heap), most / ratio, most).map_err(no_reference)?, CELLS, times)
}

fn history<C: FlowCurve>(
    heap: &Heap,
    law: C,
    cells: f64,
    times: &[f64],
) -> Result<Vec<Snapshot>, VerifyError> {
    let layer = ThinLayer {
        law,
        density: 1.0,
        gravity: 1.0,
        slope: 0.0,
        geometry: Geometry::Axisymmetric,
        dx: 1.0 / cells,
        bed: vec![0.0; libm::ceil(1.5 * heap.reach * cells) as usize],
        tolerance: 1e-4,
    };
    let surface: Vec<f64> = layer.centres().iter().map(|r| heap.weight(*r)).collect();
    layer.run(&surface, times).map(|history| history.snapshots).map_err(no_reference)
}

/// (∫ h r³ dr/∫ h r dr)^½ of a snapshot.
pub fn gyration(snapshot: &Snapshot) -> f64 {
    let sums =
        snapshot.x.iter().zip(&snapshot.h).fold([0.0; 2], |[a, b], (r, h)| [a + h * r, b + h * r * r * r]);
    (sums[1] / sums[0]).sqrt()
}

/// Depth of a snapshot at r, linear between cell centres.
pub fn depth(snapshot: &Snapshot, r: f64) -> f64 {
    let place = (r * CELLS - 0.5).max(0.0);
    let i = place as usize;
    let at = |i: usize| snapshot.h.get(i).copied().unwrap_or(0.0);
    at(i) + (at(i + 1) - at(i)) * (place - i as f64)
}

/// Volume that lies elsewhere than in the reference, over the whole: ½ ∫ |h − h_ref| dA/V.
pub fn misplaced(view: &View, reference: impl Fn(f64) -> f64) -> f64 {
    let (mut apart, mut whole) = (0.0, 0.0);
    for ((r, h), columns) in view.r.iter().zip(&view.h).zip(&view.columns) {
        apart += columns * (h - reference(*r)).abs();
        whole += columns * h;
    }
    0.5 * apart / whole
}

/// The Roussel-Coussot shape of the heap's volume.
pub fn rest(heap: &Heap) -> Result<SpreadRest, VerifyError> {
    SpreadRest::round(heap.yield_stress, 1.0, 1.0, heap.mass()).map_err(no_reference)
}

/// Rest shape to the next order in h/R: h²/2 − κ l h = l (R − r), l = σ0/(ρ g).
///
/// With the shear stress σ0 (1 − z/h) of the bed's stress balance, what the yield criterion leaves for
/// the differences of normal stress is σ0 (1 − (1 − z/h)²)^½, whose depth integral is π σ0 h/4. Spreading
/// in one direction makes the difference of horizontal and vertical normal stress 2 times this,
/// κ = π/2 (planar: Dubash et al. 2009; Liu et al. 2016); spreading alike in both √3 times,
/// κ = √3π/4. A round deposit lies between them. The front becomes a step of height 2 κ l.
#[derive(Clone, Copy, Debug)]
pub struct SteepRest {
    length: f64,
    factor: f64,
    /// R.
    pub edge: f64,
}

impl SteepRest {
    /// κ of a planar and of an equally biaxial spread.
    pub const FACTORS: [f64; 2] = [core::f64::consts::FRAC_PI_2, 1.360_349_523_175_663_3];

    /// For a heap; R from its volume, by bisection.
    pub fn new(heap: &Heap, factor: f64) -> Self {
        let mass = heap.mass();
        let (mut low, mut high) = (0.0, 100.0);
        for _ in 0..60 {
            let edge = 0.5 * (low + high);
            let shape = Self { length: heap.yield_stress, factor, edge };
            if shape.moment(1) < mass {
                low = edge;
            } else {
                high = edge;
            }
        }
        Self { length: heap.yield_stress, factor, edge: 0.5 * (low + high) }
    }

    /// h(r).
    pub fn height(&self, r: f64) -> f64 {
        if r >= self.edge {
            return 0.0;
        }
        let step = self.factor * self.length;
        step + (step * step + 2.0 * self.length * (self.edge - r)).sqrt()
    }

    /// 2π ∫ h r^power dr by the midpoint rule.
    fn moment(&self, power: i32) -> f64 {
        const RINGS: usize = 4000;
        let dr = self.edge / RINGS as f64;
        let ring = |i: usize| {
            let r = (i as f64 + 0.5) * dr;
            self.height(r) * (0..power).fold(1.0, |p, _| p * r)
        };
        2.0 * core::f64::consts::PI * dr * (0..RINGS).map(ring).sum::<f64>()
    }

    /// Radius of gyration.
    pub fn gyration(&self) -> f64 {
        (self.moment(3) / self.moment(1)).sqrt()
    }
}

/// The limit at 1/t → 0 of a straight line in 1/t through the last two points: Bingham fluid comes to
/// rest as 1/t (Matson & Hogg 2007).
pub fn limit(times: &[f64], values: &[f64]) -> f64 {
    match (times, values) {
        ([.., s, t], [.., a, b]) => (b * t - a * s) / (t - s),
        _ => f64::NAN,
    }
}

#[cfg(test)]
mod tests {
    use super::super::shear::{HEAP, TIMES};
    use super::*;

    #[test]
    fn limit_of_no_extensional_stress_is_roussel_coussot() {
        let (plain, steep) = (rest(&HEAP).unwrap(), SteepRest::new(&HEAP, 0.0));
        // Midpoint rule with 4000 rings near a square-root edge: 4000^-1.5.
        assert!((steep.edge / plain.edge() - 1.0).abs() < 1e-5);
        assert!((steep.gyration() * EDGE_OVER_GYRATION / plain.edge() - 1.0).abs() < 1e-5);
        assert!((EDGE_OVER_GYRATION - (21.0_f64 / 8.0).sqrt()).abs() < 1e-15);
    }

    #[test]
    fn exact_limit_of_one_over_t() {
        let at = |t: f64| 3.0 - 2.0 / t;
        assert_eq!(limit(&[1.0, 2.0, 4.0], &[at(1.0), at(2.0), at(4.0)]), 3.0);
    }

    #[test]
    fn reference_does_not_depend_on_its_grid() {
        let fine = ideal(&HEAP, &TIMES).unwrap();
        let coarse = history(&HEAP, law(&HEAP), 0.5 * CELLS, &TIMES).unwrap();
        for (a, b) in coarse.iter().zip(&fine) {
            // The uncertainty that claim slump-shear-regime states for it.
            assert!((gyration(a) / gyration(b) - 1.0).abs() < 5e-4);
        }
    }
}
