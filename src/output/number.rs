//! Numbers in JSON: finite ones as they are (shortest form that reads back to the same bits),
//! the others as `"NaN"`, `"inf"`, `"-inf"`, which JSON has no number for.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A number as written.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Written {
    Finite(f64),
    Word(String),
}

impl From<f64> for Written {
    fn from(x: f64) -> Self {
        if x.is_finite() {
            Self::Finite(x)
        } else if x.is_nan() {
            Self::Word("NaN".to_owned())
        } else {
            Self::Word(if x > 0.0 { "inf" } else { "-inf" }.to_owned())
        }
    }
}

impl Written {
    fn number<E: serde::de::Error>(self) -> Result<f64, E> {
        match self {
            Self::Finite(x) => Ok(x),
            Self::Word(w) => match w.as_str() {
                "NaN" => Ok(f64::NAN),
                "inf" => Ok(f64::INFINITY),
                "-inf" => Ok(f64::NEG_INFINITY),
                _ => Err(E::custom(format!("`{w}` is not a number, NaN, inf or -inf"))),
            },
        }
    }
}

/// Writes one number.
///
/// # Errors
/// Those of the serialiser.
pub fn serialize<S: Serializer>(x: &f64, s: S) -> Result<S::Ok, S::Error> {
    Written::from(*x).serialize(s)
}

/// Reads one number.
///
/// # Errors
/// Not a number in the form above.
pub fn deserialize<'de, D: Deserializer<'de>>(d: D) -> Result<f64, D::Error> {
    Written::deserialize(d)?.number()
}

macro_rules! container {
    ($(#[$doc:meta])* $name:ident, $type:ty, $written:ty, |$x:ident| $write:expr, |$w:ident| $read:expr) => {
        $(#[$doc])*
        pub mod $name {
            use super::Written;
            use serde::{Deserialize, Deserializer, Serialize, Serializer};

            /// Writes the numbers.
            ///
            /// # Errors
            /// Those of the serialiser.
            #[allow(clippy::ptr_arg, reason = "serde passes the field's own type")]
            pub fn serialize<S: Serializer>($x: &$type, s: S) -> Result<S::Ok, S::Error> {
                let written: $written = $write;
                written.serialize(s)
            }

            /// Reads the numbers.
            ///
            /// # Errors
            /// Not numbers in the form above.
            pub fn deserialize<'de, D: Deserializer<'de>>(d: D) -> Result<$type, D::Error> {
                let $w = <$written>::deserialize(d)?;
                $read
            }
        }
    };
}
container!(
    /// Named numbers.
    map, std::collections::BTreeMap<String, f64>, std::collections::BTreeMap<String, Written>,
    |x| x.iter().map(|(k, v)| (k.clone(), Written::from(*v))).collect(),
    |w| w.into_iter().map(|(k, v)| Ok((k, v.number()?))).collect()
);
container!(
    /// A list of numbers.
    list, Vec<f64>, Vec<Written>,
    |x| x.iter().map(|v| Written::from(*v)).collect(),
    |w| w.into_iter().map(Written::number).collect()
);
container!(
    /// A list of points.
    points, Vec<[f64; 2]>, Vec<[Written; 2]>,
    |x| x.iter().map(|p| p.map(Written::from)).collect(),
    |w| w.into_iter().map(|[a, b]| Ok([a.number()?, b.number()?])).collect()
);
container!(
    /// A number that may be missing.
    option, Option<f64>, Option<Written>,
    |x| x.map(Written::from),
    |w| w.map(Written::number).transpose()
);
