//! 2ˣ, eˣ, log₂ x and ln x over any lane: the same bits for one number and for each entry of a pack.
//!
//! Only + − × ÷, comparison, selection and the bit primitives of [`Lane`]; no branch, no table. Every
//! function is written as *leading part + small rest*, where the leading part is exact and the rest is
//! at most a quarter of it: the rounding of the last addition is then nearly all of the error.
//!
//! # Errors
//! In units of the last place of the right result, largest found on 2·10⁵ arguments spread over the
//! whole range against 45-digit values: see each function. All are below one.

use super::Lane;

/// 1.5·2⁵²: adding it rounds |x| < 2⁵¹ to the nearest integer (ties to even), which stands in the low
/// bits of the sum.
pub(crate) const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// 1.5·2²⁶: adding and subtracting it rounds |x| < 2²⁵ to a multiple of 2⁻²⁶.
const COARSE_ROUNDER: f64 = 100_663_296.0;

/// 2²⁷ + 1: splits a number into halves of 26 bits (Veltkamp).
const SPLITTER: f64 = 134_217_729.0;

/// ln 2 = `LN2_HIGH` + `LN2_LOW`; the first has 32 bits, so that its product with an exponent is exact.
const LN2_HIGH: f64 = 0.693_147_180_369_123_8;
const LN2_LOW: f64 = 1.908_214_929_270_587_7e-10;

/// ln 2 with 27 bits in the first part: its product with a number of 26 bits is exact.
const LN2_27_HIGH: f64 = 0.693_147_175_014_019;
const LN2_27_LOW: f64 = 5.545_926_296_966_06e-9;

/// 1/ln 2 with 26 bits in the first part.
const INVERSE_LN2_HIGH: f64 = 1.442_695_021_629_333_5;
const INVERSE_LN2_LOW: f64 = 1.925_962_991_126_617_5e-8;

/// Σ c_k x^k for k < 12, in pairs (Estrin): short chains of dependent operations.
#[inline(always)]
fn polynomial<L: Lane>(x: L, c: &[f64; 12]) -> L {
    let x2 = x * x;
    let x4 = x2 * x2;
    (quartet(x, x2, c, 0) + quartet(x, x2, c, 4) * x4) + quartet(x, x2, c, 8) * (x4 * x4)
}

/// Four terms of a polynomial from coefficient `k` on.
#[inline(always)]
fn quartet<L: Lane>(x: L, x2: L, c: &[f64; 12], k: usize) -> L {
    let c0 = L::splat(c[k]) + L::splat(c[k + 1]) * x;
    c0 + (L::splat(c[k + 2]) + L::splat(c[k + 3]) * x) * x2
}

/// 1/(k+2)!: (eʳ − 1 − r)/r². The next term is below 5e-18 at |r| = ½ ln 2.
const EXP_TAIL: [f64; 12] = [
    1.0 / 2.0,
    1.0 / 6.0,
    1.0 / 24.0,
    1.0 / 120.0,
    1.0 / 720.0,
    1.0 / 5_040.0,
    1.0 / 40_320.0,
    1.0 / 362_880.0,
    1.0 / 3_628_800.0,
    1.0 / 39_916_800.0,
    1.0 / 479_001_600.0,
    1.0 / 6_227_020_800.0,
];

/// 2/(2j+3): (ln((1+s)/(1−s))/s − 2)/s² in powers of s². The next term is below 2e-20 of the sum.
const LN_TAIL: [f64; 12] = [
    2.0 / 3.0,
    2.0 / 5.0,
    2.0 / 7.0,
    2.0 / 9.0,
    2.0 / 11.0,
    2.0 / 13.0,
    2.0 / 15.0,
    2.0 / 17.0,
    2.0 / 19.0,
    2.0 / 21.0,
    2.0 / 23.0,
    2.0 / 25.0,
];

/// The integer nearest to x, ties to even, for |x| < 2⁵¹.
#[inline(always)]
pub fn nearest<L: Lane>(x: L) -> L {
    (x + L::splat(ROUNDER)) - L::splat(ROUNDER)
}

/// x limited to \[low, high\]; NaN stays NaN.
#[inline(always)]
fn limited<L: Lane>(x: L, low: f64, high: f64) -> L {
    let (low, high) = (L::splat(low), L::splat(high));
    let x = L::select(x.less(low), low, x);
    L::select(high.less(x), high, x)
}

/// 2ᵏ e^(high + low) for |high| ≤ ½ ln 2 and |low| below 2⁻²⁶.
///
/// 1 + high is split into its rounded value and what the rounding lost; the loss joins the tail.
#[inline(always)]
fn assemble<L: Lane>(k: L, high: L, low: L) -> L {
    let one = L::one();
    let r = high + low;
    let sum = one + high;
    let lost = (one - sum) + high;
    let tail = r * r * polynomial(r, &EXP_TAIL);
    (sum + (tail + (low + lost))).scale_by_power_of_two(k)
}

/// eˣ. Overflows to infinity above 709.78, underflows gradually to zero below −745.13.
///
/// # Exactness
/// Bit-stable. At most 0.70 units in the last place from the exact value (half a unit is
/// unavoidable; 0.76 where the result is subnormal).
#[inline(always)]
pub fn exp<L: Lane>(x: L) -> L {
    let x = limited(x, -746.0, 710.0);
    let k = nearest(x * L::splat(core::f64::consts::LOG2_E));
    // Exact: the difference is a multiple of the last bit of x and smaller than x.
    let high = x - k * L::splat(LN2_HIGH);
    assemble(k, high, -(k * L::splat(LN2_LOW)))
}

/// 2ˣ. Overflows to infinity from 1024 on, underflows gradually to zero below −1075.
///
/// # Exactness
/// Bit-stable; exact for integers. At most 0.68 units in the last place.
#[inline(always)]
pub fn exp2<L: Lane>(x: L) -> L {
    let x = limited(x, -1076.0, 1025.0);
    let k = nearest(x);
    let rest = x - k;
    let coarse = (rest + L::splat(COARSE_ROUNDER)) - L::splat(COARSE_ROUNDER);
    let low = coarse * L::splat(LN2_27_LOW) + (rest - coarse) * L::splat(core::f64::consts::LN_2);
    assemble(k, coarse * L::splat(LN2_27_HIGH), low)
}

/// Parts of a logarithm: x = 2ᵏ (1 + f) with 1 + f from √½ to √2, and ln(1 + f) = f − half + rest.
struct Parts<L> {
    k: L,
    /// f, exact.
    f: L,
    /// f²/2.
    half: L,
    /// s (f²/2 + R(s²)) with s = f/(2 + f).
    rest: L,
}

/// For positive, finite x; anything else gives meaningless numbers, never a panic.
#[inline(always)]
fn parts<L: Lane>(x: L) -> Parts<L> {
    let one = L::one();
    let subnormal = x.less(L::splat(f64::MIN_POSITIVE));
    // 2⁵⁴ makes every subnormal number normal.
    let normal = L::select(subnormal, x * L::splat(18_014_398_509_481_984.0), x);
    let (exponent, mantissa) = normal.exponent_mantissa();
    let exponent = L::select(subnormal, exponent - L::splat(54.0), exponent);
    let upper = L::splat(core::f64::consts::SQRT_2).less(mantissa);
    let k = L::select(upper, exponent + one, exponent);
    let f = L::select(upper, mantissa * L::splat(0.5), mantissa) - one;
    let s = f / (L::splat(2.0) + f);
    let z = s * s;
    let half = L::splat(0.5) * f * f;
    Parts { k, f, half, rest: s * (half + z * polynomial(z, &LN_TAIL)) }
}

/// The logarithm's values where it is not finite: −∞ at zero, ∞ at ∞, NaN below zero and at NaN.
#[inline(always)]
fn with_limits<L: Lane>(x: L, logarithm: L) -> L {
    let finite = L::select(x.less_equal(L::splat(f64::MAX)), logarithm, x);
    let below = L::select(x.less(L::zero()), L::splat(f64::NAN), L::splat(f64::NEG_INFINITY));
    L::select(x.less_equal(L::zero()), below, finite)
}

/// ln x; −∞ at zero, NaN below.
///
/// # Exactness
/// Bit-stable; ln 1 = 0. At most 0.78 units in the last place, near 1 too.
#[inline(always)]
pub fn ln<L: Lane>(x: L) -> L {
    with_limits(x, ln_of_positive(x))
}

/// [`ln`] of a positive, finite x only: its bits without its checks. Elsewhere a number without
/// meaning, never a panic.
#[inline(always)]
pub fn ln_of_positive<L: Lane>(x: L) -> L {
    let Parts { k, f, half, rest } = parts(x);
    let whole = k * L::splat(LN2_HIGH);
    // |whole| is zero or larger than |f|: what the addition loses is found exactly.
    let high = whole + f;
    let lost = (whole - high) + f;
    high + (lost - (half - (rest + k * L::splat(LN2_LOW))))
}

/// log₂ x; −∞ at zero, NaN below.
///
/// # Exactness
/// Bit-stable; exact for powers of two. At most 0.83 units in the last place, near 1 too.
#[inline(always)]
pub fn log2<L: Lane>(x: L) -> L {
    let Parts { k, f, half, rest } = parts(x);
    // The upper 26 bits of f − half: their product with the upper bits of 1/ln 2 is exact.
    let sum = f - half;
    let widened = L::splat(SPLITTER) * sum;
    let high = widened - (widened - sum);
    let low = ((f - high) - half) + rest;
    let fraction = high * L::splat(INVERSE_LN2_HIGH);
    let small = (low + high) * L::splat(INVERSE_LN2_LOW) + low * L::splat(INVERSE_LN2_HIGH);
    let whole = k + fraction;
    let lost = (k - whole) + fraction;
    with_limits(x, whole + (small + lost))
}
