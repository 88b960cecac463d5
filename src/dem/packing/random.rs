//! A small generator of random numbers, the same on every machine.

/// xoshiro256** (Blackman & Vigna 2018), seeded by SplitMix64.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Random([u64; 4]);

impl Random {
    /// Generator for a seed; any seed is good.
    pub fn new(seed: u64) -> Self {
        let mut s = seed;
        Self([0; 4].map(|_: u64| {
            s = s.wrapping_add(0x9E37_79B9_7F4A_7C15);
            let z = (s ^ (s >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
            z ^ (z >> 31)
        }))
    }

    /// 64 random bits.
    pub(crate) fn bits(&mut self) -> u64 {
        let s = &mut self.0;
        let out = s[1].wrapping_mul(5).rotate_left(7).wrapping_mul(9);
        let t = s[1] << 17;
        s[2] ^= s[0];
        s[3] ^= s[1];
        s[1] ^= s[2];
        s[0] ^= s[3];
        s[2] ^= t;
        s[3] = s[3].rotate_left(45);
        out
    }

    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
    }

    /// Standard normal (Box–Muller).
    pub fn normal(&mut self) -> f64 {
        let u = 1.0 - self.unit();
        (-2.0 * libm::log(u)).sqrt() * libm::cos(2.0 * std::f64::consts::PI * self.unit())
    }

    /// Uniformly distributed orientation (Shoemake 1992).
    pub fn orientation(&mut self) -> crate::dem::Orientation {
        let tau = 2.0 * std::f64::consts::PI;
        let (u, a, b) = (self.unit(), tau * self.unit(), tau * self.unit());
        let (p, q) = ((1.0 - u).sqrt(), u.sqrt());
        crate::dem::Orientation::new_normalize(nalgebra::Quaternion::new(
            q * libm::cos(b),
            p * libm::sin(a),
            p * libm::cos(a),
            q * libm::sin(b),
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// SplitMix64's published first output for seed 0, and mean and variance within 5 standard errors.
    #[test]
    fn reference_stream() {
        assert_eq!(Random::new(0).0[0], 0xE220_A839_7B1D_CDAF);
        let mut r = Random::new(1);
        let n = 100_000;
        let (mut m, mut v) = (0.0, 0.0);
        for _ in 0..n {
            let x = r.unit() - 0.5;
            m += x;
            v += x * x;
        }
        let n = f64::from(n);
        assert!((m / n).abs() < 5.0 * (1.0 / 12.0 / n).sqrt());
        assert!((v / n - 1.0 / 12.0).abs() < 5.0 * (1.0 / 180.0 / n).sqrt());
    }
}
