//! What a probe measures at one time: values with the names and units of their columns beside them.

use std::borrow::Cow;

/// One column of a probe at one time.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::run) struct Quantity {
    /// What follows the name of the probe in the name of the column; nothing if it is the only one.
    pub part: Cow<'static, str>,
    /// Its unit, `-` if none.
    pub unit: &'static str,
    /// In that unit.
    pub value: f64,
}

impl Quantity {
    /// Name of the column.
    pub(crate) fn column(&self, probe: &str) -> String {
        if self.part.is_empty() { probe.to_owned() } else { format!("{probe}_{}", self.part) }
    }
}

/// A probe of one column.
pub(super) fn one(unit: &'static str, value: f64) -> Vec<Quantity> {
    vec![Quantity { part: Cow::Borrowed(""), unit, value }]
}

/// A probe of several columns: part, unit, value.
pub(super) fn several<const N: usize>(parts: [(&'static str, &'static str, f64); N]) -> Vec<Quantity> {
    let quantity = |(part, unit, value)| Quantity { part: Cow::Borrowed(part), unit, value };
    parts.into_iter().map(quantity).collect()
}

/// The components of a vector: `x`, `y`, `z`, after `prefix` if there is one.
pub(super) fn vector(prefix: &str, unit: &'static str, components: [f64; 3]) -> Vec<Quantity> {
    let named = |(axis, value): (&'static str, f64)| {
        let part =
            if prefix.is_empty() { Cow::Borrowed(axis) } else { Cow::Owned(format!("{prefix}_{axis}")) };
        Quantity { part, unit, value }
    };
    ["x", "y", "z"].into_iter().zip(components).map(named).collect()
}

/// Several vectors, one after the other.
pub(super) fn vectors<const N: usize>(parts: [(&str, &'static str, [f64; 3]); N]) -> Vec<Quantity> {
    parts.into_iter().flat_map(|(prefix, unit, components)| vector(prefix, unit, components)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_names_of_columns() {
        let names = |quantities: Vec<Quantity>| -> Vec<String> {
            quantities.iter().map(|quantity| quantity.column("p")).collect()
        };
        assert_eq!(names(one("m", 1.0)), ["p"]);
        assert_eq!(names(several([("low", "m", 1.0), ("high", "m", 2.0)])), ["p_low", "p_high"]);
        assert_eq!(names(vector("", "m", [0.0; 3])), ["p_x", "p_y", "p_z"]);
        assert_eq!(names(vector("spin", "rad/s", [0.0; 3])), ["p_spin_x", "p_spin_y", "p_spin_z"]);
    }
}
