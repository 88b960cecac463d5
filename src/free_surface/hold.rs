//! Whether the links of an interface cell hold it \[F6\].

/// Directions that links carry momentum along: at most three that span what all of them span.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Span {
    rank: u8,
    /// The first direction, or the normal of the plane of two.
    vector: [i32; 3],
}

impl Span {
    /// Adds a direction.
    pub(crate) fn add(&mut self, c: [i32; 3]) {
        match self.rank {
            0 => *self = Self { rank: u8::from(c != [0; 3]), vector: c },
            1 => {
                let normal = cross(self.vector, c);
                if normal != [0; 3] {
                    *self = Self { rank: 2, vector: normal };
                }
            }
            2 => self.rank += u8::from((0..3).map(|a| self.vector[a] * c[a]).sum::<i32>() != 0),
            _ => {}
        }
    }

    /// Whether all of space is spanned.
    #[must_use]
    pub(crate) const fn is_full(&self) -> bool {
        self.rank == 3
    }

    /// Length of the part of a vector that is orthogonal to all directions.
    ///
    /// Links exchange momentum along themselves only: what a force gives to a cell beside all of them adds up from
    /// step to step, and the cell accelerates in its place without bound.
    ///
    /// # Verified by
    /// Test `exact_spans`; claim `isolated-cell`.
    #[must_use]
    pub(crate) fn beside(&self, u: &[f64; 3]) -> f64 {
        let v = self.vector.map(f64::from);
        let along = v[0] * u[0] + v[1] * u[1] + v[2] * u[2];
        let length2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
        let size2 = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
        match self.rank {
            0 => size2.sqrt(),
            // Rounding may leave less than nothing.
            1 => (size2 - along * along / length2).max(0.0).sqrt(),
            2 => along.abs() / length2.sqrt(),
            _ => 0.0,
        }
    }
}

fn cross(a: [i32; 3], b: [i32; 3]) -> [i32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn span(links: &[[i32; 3]]) -> Span {
        let mut span = Span::default();
        for c in links {
            span.add(*c);
        }
        span
    }

    #[test]
    fn exact_spans() {
        let down = [0.0, 0.0, -0.5];
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-15, "{a} {b}");
        // By nothing, by the edge of a pillar, by two drops below (their links leave (1, 1, 1) free).
        close(span(&[]).beside(&down), 0.5);
        close(span(&[[-1, 1, 0]]).beside(&down), 0.5);
        close(span(&[[-1, 1, 0]]).beside(&[1.0, -1.0, 0.0]), 0.0);
        close(span(&[[1, 0, -1], [0, 1, -1]]).beside(&down), 0.5 / 3.0_f64.sqrt());
        // From below, in a plane that holds the vector, by the links of a floor.
        close(span(&[[0, 0, -1]]).beside(&down), 0.0);
        close(span(&[[0, 1, -1], [0, 0, 0], [0, -1, -1]]).beside(&[0.1, 0.0, -0.5]), 0.1);
        let floor = span(&[[0, 0, -1], [1, 0, -1], [-1, 0, -1], [0, 1, -1]]);
        assert!(floor.is_full());
        close(floor.beside(&[3.0, -2.0, 1.0]), 0.0);
    }
}
