//! The stability tables of an independent computation.

use lahar::collision::{CollisionChoice, OddRate};
use lahar::stability::Direction;

/// Operators of the reference table.
#[derive(Clone, Copy)]
pub(super) enum Op {
    Bgk,
    Trt316,
    Trt14,
}

impl Op {
    pub(super) fn collision(self) -> CollisionChoice {
        match self {
            Self::Bgk => CollisionChoice::Bgk,
            Self::Trt316 => CollisionChoice::Trt(OddRate::fixed(3.0 / 16.0)),
            Self::Trt14 => CollisionChoice::Trt(OddRate::fixed(0.25)),
        }
    }
}

/// τ⁺ of the reference tables.
pub(super) const TAUS: [f64; 8] = [0.5005, 0.501, 0.505, 0.51, 0.55, 0.6, 1.0, 1.8];

/// Largest stable speed along x, xy, xyz at each of [`TAUS`]: x and xy refined over k, xyz on a coarse
/// grid and therefore upper bounds.
pub(super) const BGK: [[f64; 3]; 8] = [
    [0.0435, 0.0495, 0.1336],
    [0.0611, 0.0733, 0.1344],
    [0.1339, 0.1479, 0.159],
    [0.2012, 0.1716, 0.2273],
    [0.3333, 0.2359, 0.3031],
    [0.3634, 0.2628, 0.3332],
    [0.4223, 0.4224, 0.4226],
    [0.4223, 0.4226, 0.4226],
];
/// As for [`BGK`], two relaxation times with Λ = 3/16: largest stable speed along x, xy, xyz.
pub(super) const TRT_316: [[f64; 3]; 8] = [
    [0.0116, 0.0031, 0.0039],
    [0.0232, 0.0061, 0.0078],
    [0.118, 0.0307, 0.0398],
    [0.2223, 0.0613, 0.0801],
    [0.3274, 0.2567, 0.2969],
    [0.3706, 0.295, 0.3395],
    [0.4223, 0.4225, 0.4226],
    [0.4223, 0.4226, 0.4226],
];
/// As for [`BGK`], two relaxation times with Λ = ¼: largest stable speed along x, xy, xyz.
pub(super) const TRT_14: [[f64; 3]; 8] = [
    [0.0137, 0.0026, 0.0031],
    [0.0268, 0.0053, 0.0066],
    [0.1328, 0.0273, 0.0344],
    [0.2465, 0.0529, 0.0691],
    [0.3174, 0.2453, 0.2879],
    [0.3586, 0.2832, 0.3285],
    [0.4223, 0.4224, 0.4226],
    [0.4223, 0.4222, 0.4226],
];

/// Growth per step of single waves: operator, direction, τ⁺, speed, k/π, spectral radius − 1.
pub(super) const GROWTH: [(Op, Direction, f64, f64, [f64; 3], f64); 31] = [
    (Op::Bgk, Direction::X, 0.5005, 0.2, [0.25, 0.625, 0.375], 0.016008639330926222),
    (Op::Bgk, Direction::X, 0.501, 0.2, [0.25, 0.625, 0.375], 0.014405968026391491),
    (Op::Bgk, Direction::X, 0.505, 0.2, [0.125, 0.625, 0.125], 0.002117505462081448),
    (Op::Bgk, Direction::Xy, 0.5005, 0.2, [0.75, 0.375, 0.0], 0.0308874945990405),
    (Op::Bgk, Direction::Xy, 0.501, 0.2, [0.75, 0.375, 0.0], 0.029313237303298934),
    (Op::Bgk, Direction::Xy, 0.505, 0.2, [0.75, 0.375, 0.0], 0.016938088230437076),
    (Op::Bgk, Direction::Xy, 0.51, 0.2, [0.75, 0.375, 0.0], 0.001994548595228629),
    (Op::Trt316, Direction::X, 0.5005, 0.05, [0.5, 0.75, 0.25], 0.0019639695290514236),
    (Op::Trt316, Direction::X, 0.5005, 0.2, [0.5, 0.75, 0.25], 0.010467308430075262),
    (Op::Trt316, Direction::X, 0.501, 0.05, [0.5, 0.75, 0.25], 0.0008853690361176891),
    (Op::Trt316, Direction::X, 0.501, 0.2, [0.5, 0.75, 0.25], 0.009373366308722542),
    (Op::Trt316, Direction::X, 0.505, 0.2, [0.25, 0.375, 0.125], 0.0020893188062347523),
    (Op::Trt316, Direction::Xy, 0.5005, 0.05, [0.25, -0.25, 0.625], 0.015894151666319356),
    (Op::Trt316, Direction::Xy, 0.5005, 0.2, [0.25, -0.25, 0.5], 0.06913563659008726),
    (Op::Trt316, Direction::Xy, 0.501, 0.05, [0.25, -0.25, 0.625], 0.014673981661697422),
    (Op::Trt316, Direction::Xy, 0.501, 0.2, [0.25, -0.25, 0.5], 0.06772743507329415),
    (Op::Trt316, Direction::Xy, 0.505, 0.05, [0.375, -0.375, 0.625], 0.005215014855950217),
    (Op::Trt316, Direction::Xy, 0.505, 0.2, [0.25, -0.25, 0.625], 0.05744862589727018),
    (Op::Trt316, Direction::Xy, 0.51, 0.2, [0.25, -0.25, 0.625], 0.04490464174302922),
    (Op::Trt14, Direction::X, 0.5005, 0.05, [0.5, 0.75, 0.25], 0.001988238166171552),
    (Op::Trt14, Direction::X, 0.5005, 0.2, [0.5, 0.75, 0.25], 0.010490436856140706),
    (Op::Trt14, Direction::X, 0.501, 0.05, [0.5, 0.75, 0.25], 0.0009463499289870114),
    (Op::Trt14, Direction::X, 0.501, 0.2, [0.5, 0.75, 0.25], 0.009423196563931757),
    (Op::Trt14, Direction::X, 0.505, 0.2, [0.25, 0.375, 0.125], 0.0015554855716504168),
    (Op::Trt14, Direction::Xy, 0.5005, 0.05, [0.25, -0.25, 0.625], 0.016009440016117038),
    (Op::Trt14, Direction::Xy, 0.5005, 0.2, [0.25, -0.25, 0.5], 0.06918277257154903),
    (Op::Trt14, Direction::Xy, 0.501, 0.05, [0.25, -0.25, 0.625], 0.01491347869082138),
    (Op::Trt14, Direction::Xy, 0.501, 0.2, [0.25, -0.25, 0.625], 0.06789820081044073),
    (Op::Trt14, Direction::Xy, 0.505, 0.05, [0.25, -0.25, 0.625], 0.006498771105554635),
    (Op::Trt14, Direction::Xy, 0.505, 0.2, [0.25, -0.25, 0.625], 0.05871466633568745),
    (Op::Trt14, Direction::Xy, 0.51, 0.2, [0.25, -0.25, 0.625], 0.04755320553892539),
];
