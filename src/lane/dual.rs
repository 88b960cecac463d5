//! A number with its derivative along one direction: exact Jacobians of any kernel written over
//! [`Lane`], for the von Neumann analysis.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Lane, powers};

/// Value and directional derivative. Comparisons look at the value only, so a branch is
/// differentiated as taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual {
    /// The value.
    pub value: f64,
    /// Its derivative.
    pub slope: f64,
}

impl Dual {
    /// A constant.
    #[must_use]
    pub const fn constant(value: f64) -> Self {
        Self { value, slope: 0.0 }
    }
    /// The variable that is differentiated by.
    #[must_use]
    pub const fn variable(value: f64) -> Self {
        Self { value, slope: 1.0 }
    }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self { value: self.value + o.value, slope: self.slope + o.slope }
    }
}
impl Sub for Dual {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self { value: self.value - o.value, slope: self.slope - o.slope }
    }
}
impl Mul for Dual {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self { value: self.value * o.value, slope: self.slope * o.value + self.value * o.slope }
    }
}
impl Div for Dual {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let value = self.value / o.value;
        Self { value, slope: (self.slope - value * o.slope) / o.value }
    }
}
impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, slope: -self.slope }
    }
}

impl Lane for Dual {
    type Mask = bool;

    fn splat(x: f64) -> Self {
        Self::constant(x)
    }
    /// At zero the slope is taken as zero: the magnitudes that are square-rooted have a kink there.
    fn sqrt(self) -> Self {
        let value = self.value.sqrt();
        let slope = if value > 0.0 { self.slope / (2.0 * value) } else { 0.0 };
        Self { value, slope }
    }
    fn abs(self) -> Self {
        if self.value < 0.0 { -self } else { self }
    }
    /// Linear; k is a constant.
    fn scale_by_power_of_two(self, k: Self) -> Self {
        let scaled = |x: f64| x.scale_by_power_of_two(k.value);
        Self { value: scaled(self.value), slope: scaled(self.slope) }
    }
    /// The exponent is a constant, the mantissa x 2⁻ᵉ.
    fn exponent_mantissa(self) -> (Self, Self) {
        let (exponent, mantissa) = self.value.exponent_mantissa();
        let slope = self.slope.scale_by_power_of_two(-exponent);
        (Self::constant(exponent), Self { value: mantissa, slope })
    }
    /// Rows are constants.
    fn lookup<const K: usize>(self, table: &[[f64; K]]) -> [Self; K] {
        self.value.lookup(table).map(Self::constant)
    }
    fn exp(self) -> Self {
        let value = powers::exp(self.value);
        Self { value, slope: value * self.slope }
    }
    fn exp_m1(self) -> Self {
        Self { value: libm::expm1(self.value), slope: powers::exp(self.value) * self.slope }
    }
    fn ln(self) -> Self {
        Self { value: powers::ln(self.value), slope: self.slope / self.value }
    }
    fn less(self, other: Self) -> bool {
        self.value < other.value
    }
    fn less_equal(self, other: Self) -> bool {
        self.value <= other.value
    }
    fn select(mask: bool, then: Self, otherwise: Self) -> Self {
        if mask { then } else { otherwise }
    }
    fn and(a: bool, b: bool) -> bool {
        a && b
    }
    fn not(a: bool) -> bool {
        !a
    }
    fn any(mask: bool) -> bool {
        mask
    }
}
