//! Complex arithmetic of the oscillating flows.

/// A complex number, as little of one as is needed here.
#[derive(Clone, Copy)]
pub(super) struct Complex {
    pub re: f64,
    pub im: f64,
}

impl Complex {
    pub(super) fn exp(self) -> Self {
        let size = libm::exp(self.re);
        Self { re: size * libm::cos(self.im), im: size * libm::sin(self.im) }
    }

    pub(super) fn scale(self, by: f64) -> Self {
        Self { re: self.re * by, im: self.im * by }
    }

    pub(super) fn times(self, o: Self) -> Self {
        Self { re: self.re * o.re - self.im * o.im, im: self.re * o.im + self.im * o.re }
    }

    pub(super) fn over(self, o: Self) -> Self {
        let size = o.re * o.re + o.im * o.im;
        self.times(Self { re: o.re / size, im: -o.im / size })
    }

    pub(super) fn plus_one(self) -> Self {
        Self { re: self.re + 1.0, im: self.im }
    }
}
