//! Places to fill.

use super::Random;
use crate::dem::{DemError, V3};

/// A place to fill with grains that stay wholly inside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Region {
    /// Between two corners.
    Box {
        /// Corner with the smallest coordinates, m.
        low: V3,
        /// Corner with the largest, m.
        high: V3,
    },
    /// A ball.
    Sphere {
        /// Centre, m.
        centre: V3,
        /// Radius, m.
        radius: f64,
    },
    /// An upright cylinder about `axis` with its base centred at `base`.
    Cylinder {
        /// Centre of the base, m.
        base: V3,
        /// Direction from base to top; its length does not matter.
        axis: V3,
        /// Radius, m.
        radius: f64,
        /// Height, m.
        height: f64,
    },
}

impl Region {
    /// Checks the numbers.
    ///
    /// # Errors
    /// Sizes that are not above zero, numbers that are not finite.
    pub(crate) fn check(&self) -> Result<(), DemError> {
        let (what, found) = match self {
            Region::Box { low, high } => ("smallest edge of the box (m)", (high - low).min()),
            Region::Sphere { radius, .. } => ("radius of the sphere (m)", *radius),
            Region::Cylinder { radius, height, axis, .. } => (
                "smallest of axis length, radius and height of the cylinder",
                radius.min(*height).min(axis.norm()),
            ),
        };
        if found > 0.0
            && found.is_finite()
            && self.bounds().0.iter().chain(self.bounds().1.iter()).all(|x| x.is_finite())
        {
            Ok(())
        } else {
            Err(DemError::Packing { what, found, allowed: "finite and above 0" })
        }
    }

    /// Box around the place.
    pub(crate) fn bounds(&self) -> (V3, V3) {
        match *self {
            Region::Box { low, high } => (low, high),
            Region::Sphere { centre, radius } => (centre - V3::repeat(radius), centre + V3::repeat(radius)),
            Region::Cylinder { base, axis, radius, height } => {
                let a = axis.normalize();
                let side = a.map(|x| radius * (1.0 - x * x).max(0.0).sqrt());
                let top = base + a * height;
                (base.inf(&top) - side, base.sup(&top) + side)
            }
        }
    }

    /// m³.
    pub(crate) fn volume(&self) -> f64 {
        let pi = std::f64::consts::PI;
        match *self {
            Region::Box { low, high } => (high - low).product(),
            Region::Sphere { radius, .. } => 4.0 / 3.0 * pi * radius * radius * radius,
            Region::Cylinder { radius, height, .. } => pi * radius * radius * height,
        }
    }

    /// Whether a ball at `x` lies wholly inside.
    pub(crate) fn holds(&self, x: &V3, radius: f64) -> bool {
        match *self {
            Region::Box { low, high } => (x - low).min() >= radius && (high - x).min() >= radius,
            Region::Sphere { centre, radius: r } => (x - centre).norm() + radius <= r,
            Region::Cylinder { base, axis, radius: r, height } => {
                let a = axis.normalize();
                let along = (x - base).dot(&a);
                let off = (x - base - a * along).norm();
                off + radius <= r && along >= radius && along + radius <= height
            }
        }
    }

    /// A random point of the box around the place, at least `radius` from that box's faces.
    pub(crate) fn point(&self, random: &mut Random, radius: f64) -> V3 {
        let (low, high) = self.bounds();
        V3::from_fn(|k, _| low[k] + radius + random.unit() * (high[k] - low[k] - 2.0 * radius))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn volumes_of_places() {
        let pi = std::f64::consts::PI;
        let low = V3::new(0.5, -1.0, 2.0);
        assert_eq!(Region::Box { low, high: V3::new(1.5, 1.0, 6.0) }.volume(), 8.0);
        assert!((Region::Sphere { centre: low, radius: 0.5 }.volume() - pi / 6.0).abs() < 1e-15);
        let axis = V3::new(0.0, 0.0, 3.0);
        assert!(
            (Region::Cylinder { base: low, axis, radius: 0.5, height: 2.0 }.volume() - pi / 2.0).abs()
                < 1e-15
        );
    }
}
