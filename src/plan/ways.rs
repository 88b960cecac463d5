//! Ways out of a refusal that were tried before they are named.

use std::fmt;

use super::text::significant;

/// Changes of a scene with each of which it has a plan; found by planning the changed scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ways(pub Vec<Way>);

/// One change.
#[derive(Clone, Debug, PartialEq)]
pub enum Way {
    /// A number at a JSON path.
    Set {
        /// The path.
        path: String,
        /// The number.
        value: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// A choice at a JSON path.
    Choose {
        /// The path.
        path: &'static str,
        /// The choice.
        choice: &'static str,
    },
    /// A key that is left to `plan`.
    LeaveOut {
        /// Its path.
        path: &'static str,
    },
}

impl fmt::Display for Way {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Set { path, value, unit } => {
                let space = if unit.is_empty() { "" } else { " " };
                write!(f, "`{path}` of {}{space}{unit}", significant(*value))
            }
            Self::Choose { path, choice } => write!(f, "`{path}` of `{choice}`"),
            Self::LeaveOut { path } => write!(f, "leave out `{path}`, and `plan` chooses"),
        }
    }
}

impl fmt::Display for Ways {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [first, rest @ ..] = self.0.as_slice() else {
            return f.write_str(
                "a finer `domain.spacing_m`, a larger viscosity, or a slower flow; none that does was found within a few \
                 million cells and a millionfold viscosity",
            );
        };
        write!(f, "{first}")?;
        rest.iter().try_for_each(|way| write!(f, "; or {way}"))?;
        f.write_str(" (tried: each has a plan)")
    }
}
