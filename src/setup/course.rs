//! How walls and solids move in time: their velocity is that of the set-up times a factor.

use std::sync::Arc;

use super::Setup;

/// Factor of a velocity in time.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Course {
    /// 1 at all times.
    #[default]
    Constant,
    /// `mean + amplitude · cos(frequency · t + phase)`, t in steps, frequency in radians per step.
    Oscillating {
        /// Mean factor.
        mean: f64,
        /// Amplitude of the factor.
        amplitude: f64,
        /// Angular frequency, radians per step.
        frequency: f64,
        /// Phase at step 0, radians.
        phase: f64,
    },
    /// Linear between (time in steps, factor), times ascending; constant before the first and after the last.
    Table(Arc<[[f64; 2]]>),
}

impl Course {
    /// The factor at a time, in steps.
    #[must_use]
    pub fn at(&self, time: f64) -> f64 {
        match self {
            Self::Constant => 1.0,
            Self::Oscillating { mean, amplitude, frequency, phase } => {
                mean + amplitude * libm::cos(frequency * time + phase)
            }
            Self::Table(points) => between(points, time),
        }
    }

    /// The largest magnitude of the factor at any time.
    #[must_use]
    pub fn most(&self) -> f64 {
        match self {
            Self::Constant => 1.0,
            Self::Oscillating { mean, amplitude, .. } => mean.abs() + amplitude.abs(),
            Self::Table(points) => {
                points.iter().fold(0.0, |most: f64, p| if p[1].abs() > most { p[1].abs() } else { most })
            }
        }
    }

    /// Whether the times of a table ascend and all numbers are finite, and there is at least one.
    pub(crate) fn is_sound(&self) -> bool {
        match self {
            Self::Constant => true,
            Self::Oscillating { mean, amplitude, frequency, phase } => {
                [mean, amplitude, frequency, phase].iter().all(|x| x.is_finite())
            }
            Self::Table(points) => {
                !points.is_empty()
                    && points.iter().flatten().all(|x| x.is_finite())
                    && points.windows(2).all(|pair| pair[0][0] < pair[1][0])
            }
        }
    }
}

/// The value at a time of a function that is linear between points.
fn between(points: &[[f64; 2]], time: f64) -> f64 {
    let after = points.partition_point(|point| point[0] <= time);
    match (after.checked_sub(1).and_then(|before| points.get(before)), points.get(after)) {
        (Some([t, a]), Some([u, b])) => a + (b - a) * ((time - t) / (u - t)),
        (Some([_, value]), None) | (None, Some([_, value])) => *value,
        (None, None) => 1.0,
    }
}

/// Courses of everything that can move.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Courses {
    /// Of the faces of the box, `faces[axis][0]` the low one: those of [`super::Face::Moving`].
    pub faces: [[Course; 2]; 3],
    /// Of the numbered solids, their velocity and spin; those beyond the end are constant.
    pub solids: Vec<Course>,
}

/// Factors at one time.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Factors {
    faces: [[f64; 2]; 3],
    solids: Vec<f64>,
}

impl Courses {
    /// Whether anything changes in time.
    #[must_use]
    pub fn vary(&self) -> bool {
        self.all().any(|course| *course != Course::Constant)
    }

    pub(crate) fn all(&self) -> impl Iterator<Item = &Course> {
        self.faces.iter().flatten().chain(&self.solids)
    }
}

impl Factors {
    /// Of a step: at its middle, where half-way links meet the wall.
    #[must_use]
    pub(crate) fn at(setup: &Setup, step: u64) -> Self {
        let time = step as f64 + 0.5;
        let courses = &setup.courses;
        Self {
            faces: std::array::from_fn(|a| std::array::from_fn(|side| courses.faces[a][side].at(time))),
            solids: courses.solids.iter().map(|course| course.at(time)).collect(),
        }
    }

    /// Of velocities as they stand in the set-up.
    #[must_use]
    pub(crate) const fn one() -> Self {
        Self { faces: [[1.0; 2]; 3], solids: Vec::new() }
    }

    /// Of a face.
    #[inline]
    #[must_use]
    pub(crate) const fn face(&self, axis: usize, side: usize) -> f64 {
        self.faces[axis][side]
    }

    /// Of a solid, by its number from 1.
    #[inline]
    #[must_use]
    pub(crate) fn solid(&self, body: u8) -> f64 {
        self.solids.get(usize::from(body).wrapping_sub(1)).copied().unwrap_or(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_table_is_linear_between_its_points() {
        let table = Course::Table([[2.0, 1.0], [4.0, -3.0], [5.0, 0.0]].into());
        for (time, factor) in
            [(0.0, 1.0), (2.0, 1.0), (2.5, 0.0), (4.0, -3.0), (4.5, -1.5), (5.0, 0.0), (9.0, 0.0)]
        {
            assert_eq!(table.at(time), factor, "{time}");
        }
        assert_eq!(table.most(), 3.0);
        assert!(table.is_sound());
        assert_eq!(Course::Table([[3.0, 0.5]].into()).at(-1.0), 0.5);
    }

    #[test]
    fn oscillation_by_hand() {
        let course = Course::Oscillating {
            mean: 0.5,
            amplitude: 2.0,
            frequency: 0.1,
            phase: std::f64::consts::FRAC_PI_3,
        };
        // cos(π/3) = ½, to a rounding.
        assert!((course.at(0.0) - 1.5).abs() < 1e-15);
        assert_eq!(course.most(), 2.5);
        assert_eq!(Course::Constant.at(7.0), 1.0);
    }

    #[test]
    fn limit_tables_that_are_none() {
        for points in
            [vec![], vec![[1.0, 0.0], [1.0, 2.0]], vec![[2.0, 0.0], [1.0, 2.0]], vec![[0.0, f64::NAN]]]
        {
            assert!(!Course::Table(points.into()).is_sound());
        }
    }
}
