//! What a guard found, for people.

use std::fmt;

/// Why a guard stopped a run.
#[derive(Clone, Debug, PartialEq)]
pub struct StopReport {
    /// Scene file.
    pub file: String,
    /// Step.
    pub step: u64,
    /// Time, s.
    pub time_s: f64,
    /// Where it happened.
    pub place: StopPlace,
    /// What was found, with its unit.
    pub found: String,
    /// The likely cause and what to do.
    pub cause: &'static str,
}

/// Where a run came to its stop.
#[derive(Clone, Debug, PartialEq)]
pub enum StopPlace {
    /// In the fluid, or at a grain in it.
    Cell {
        /// The cell.
        cell: [usize; 3],
        /// Its centre, m.
        position_m: [f64; 3],
        /// τ of the cell; NaN where it has none.
        tau: f64,
    },
    /// Among grains without fluid.
    Grains {
        /// Which ones.
        who: String,
        /// Where, m.
        position_m: Option<[f64; 3]>,
    },
}

impl fmt::Display for StopPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cell { cell: [i, j, k], position_m: [x, y, z], .. } => {
                write!(f, "cell ({i}, {j}, {k}), at ({x:.6}, {y:.6}, {z:.6}) m")
            }
            Self::Grains { who, position_m: None } => f.write_str(who),
            Self::Grains { who, position_m: Some([x, y, z]) } => {
                write!(f, "{who}, at ({x:.6}, {y:.6}, {z:.6}) m")
            }
        }
    }
}

impl fmt::Display for StopReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // A step of dry grains is a microsecond, one of a fluid a millisecond.
        let (digits, tau) = match self.place {
            // Guards of grains have no relaxation time.
            StopPlace::Cell { tau, .. } if !tau.is_nan() => (6, format!("; relaxation time {tau:.4}")),
            StopPlace::Cell { .. } => (6, String::new()),
            StopPlace::Grains { .. } => (9, String::new()),
        };
        writeln!(f, "{}: stopped at step {}, time {:.digits$} s", self.file, self.step, self.time_s)?;
        writeln!(f, "  where: {}", self.place)?;
        writeln!(f, "  found: {}{tau}", self.found)?;
        writeln!(f, "  likely cause: {}", self.cause)?;
        write!(f, "  files written before stay as they are")
    }
}
