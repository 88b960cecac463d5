//! What to write instead of a word that is not known where it stands.

use super::elsewhere::{Place, places_of};
use super::meaning::{MEANINGS, Meaning, NO_MESH};
use super::nearest::{is_typing_error, nearest};

/// Units that names end in here.
const UNITS: &[&str] = &[
    "_kg_per_m3",
    "_m_per_s2",
    "_m_per_s",
    "_rad_per_s",
    "_n_per_m3",
    "_n_per_m",
    "_m2_per_s",
    "_pa_s_n",
    "_pa_s",
    "_pa",
    "_deg",
    "_hz",
    "_m",
    "_s",
];

/// Units of other habits, those here, and the factor from the one to the other.
const CONVERSIONS: &[(&str, &str, &str)] = &[
    ("_um", "_m", "1e-6"),
    ("_mm", "_m", "0.001"),
    ("_cm", "_m", "0.01"),
    ("_km", "_m", "1000"),
    ("_ms", "_s", "0.001"),
    ("_min", "_s", "60"),
    ("_minutes", "_s", "60"),
    ("_h", "_s", "3600"),
    ("_hours", "_s", "3600"),
    ("_kpa", "_pa", "1000"),
    ("_mpa", "_pa", "1e6"),
    ("_gpa", "_pa", "1e9"),
    ("_mpa_s", "_pa_s", "0.001"),
    ("_cp", "_pa_s", "0.001"),
    ("_g_per_cm3", "_kg_per_m3", "1000"),
    ("_t_per_m3", "_kg_per_m3", "1000"),
    ("_mm_per_s", "_m_per_s", "0.001"),
    ("_cm_per_s", "_m_per_s", "0.01"),
    ("_km_per_h", "_m_per_s", "0.277778"),
    ("_rad", "_deg", "57.2958"),
    ("_deg", "_rad", "0.0174533"),
    ("_rpm", "_rad_per_s", "0.10472"),
    ("_hz", "_rad_per_s", "6.28319"),
    ("_deg_per_s", "_rad_per_s", "0.0174533"),
];

/// The unit that a name ends in, the longest that fits.
fn unit(word: &str) -> Option<&'static str> {
    let all = UNITS.iter().copied().chain(CONVERSIONS.iter().map(|&(from, ..)| from));
    all.filter(|unit| word.len() > unit.len() && word.ends_with(unit)).max_by_key(|unit| unit.len())
}

/// A word in lower case with underscores.
fn plain(word: &str) -> String {
    let (mut plain, mut after_small) = (String::new(), false);
    for c in word.chars() {
        // `endTime`, but not `MRT`.
        if c.is_uppercase() && after_small {
            plain.push('_');
        }
        after_small = c.is_lowercase();
        plain.extend(if c == '-' || c == ' ' { '_' } else { c }.to_lowercase());
    }
    plain
}

/// What a number is multiplied by if its key is renamed; `None` if the units are the same, or nobody knows.
fn factor(found: &str, name: &str) -> Option<&'static str> {
    let (from, to) = (unit(&plain(found))?, unit(name)?);
    CONVERSIONS.iter().find(|entry| (entry.0, entry.1) == (from, to)).map(|entry| entry.2)
}

/// What to write instead of an unknown word.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Hint {
    /// The name that was probably meant.
    pub name: Option<String>,
    /// What else has to be said; may be empty.
    pub note: String,
}

/// The allowed choice that was probably meant: by what the word means elsewhere, or as it is written.
#[must_use]
pub(crate) fn hint(found: &str, allowed: &[String]) -> Hint {
    let written = || nearest(found, allowed).map(|name| (name.to_owned(), String::new()));
    match named(found, allowed).or_else(written) {
        Some((name, note)) => Hint { name: Some(name), note },
        None => Hint { name: None, note: absent(found).unwrap_or_default().to_owned() },
    }
}

/// As [`hint`], of a key at a path, which may have its place elsewhere in a scene.
#[must_use]
pub(crate) fn hint_of_key(found: &str, allowed: &[String], path: &str, dry: bool) -> Hint {
    let near = nearest(found, allowed);
    let typed = near.filter(|name| is_typing_error(found, name));
    let written = |name: &str| (name.to_owned(), String::new());
    if let Some((name, mut note)) = named(found, allowed).or_else(|| typed.map(written)) {
        if let Some(factor) = factor(found, &name) {
            note = format!("its number times {factor}");
        }
        return Hint { name: Some(name), note };
    }
    let note = moved(found, path, dry).or_else(|| absent(found).map(str::to_owned));
    if let Some(note) = note.or_else(|| renamed_and_moved(found, path, dry)) {
        return Hint { name: None, note };
    }
    Hint { name: near.map(str::to_owned), note: String::new() }
}

/// Up to three places.
fn listed(places: Vec<Place>) -> String {
    let names: Vec<String> = places.into_iter().take(3).map(|place| place.to_string()).collect();
    names.join(" or ")
}

/// Where a key belongs.
fn moved(found: &str, path: &str, dry: bool) -> Option<String> {
    let places = places_of(found, path, dry);
    (!places.is_empty()).then(|| format!("it belongs in {}: move it there", listed(places)))
}

/// Where a key of the same meaning belongs.
fn renamed_and_moved(found: &str, path: &str, dry: bool) -> Option<String> {
    about(found).flat_map(|meaning| meaning.names).find_map(|name| {
        let places = places_of(name, path, dry);
        (!places.is_empty()).then(|| {
            let times = factor(found, name).map_or_else(String::new, |f| format!(", its number times {f}"));
            format!("it is `{name}` in {}{times}", listed(places))
        })
    })
}

/// Meanings of a word, without its unit.
fn about(found: &str) -> impl Iterator<Item = &'static Meaning> {
    let whole = plain(found);
    let bare = unit(&whole).map_or(whole.clone(), |unit| whole[..whole.len() - unit.len()].to_owned());
    MEANINGS.iter().filter(move |m| m.words.contains(&bare.as_str()) || m.words.contains(&whole.as_str()))
}

/// The allowed name with the meaning of `found`, and what else has to be said.
fn named(found: &str, allowed: &[String]) -> Option<(String, String)> {
    about(found).find_map(|meaning| {
        let mut names = meaning.names.iter().filter(|name| allowed.iter().any(|other| other == *name));
        names.next().map(|name| ((*name).to_owned(), meaning.note.to_owned()))
    })
}

/// What is said of things that are not to be had here.
fn absent(found: &str) -> Option<&'static str> {
    about(found).find(|m| m.names.is_empty() || m.note == NO_MESH).map(|m| m.note)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(names: &[&str]) -> Vec<String> {
        names.iter().map(|&name| name.to_owned()).collect()
    }

    #[test]
    fn words_of_other_programs() {
        let cases: &[(&str, &[&str], &str)] = &[
            ("max_height", &["point_velocity", "surface_profile", "mass"], "surface_profile"),
            ("base_diameter_m", &["base_m", "base_radius_m", "direction"], "base_radius_m"),
            ("dx", &["size_m", "spacing_m", "boundaries"], "spacing_m"),
            ("endTime", &["end_time_s", "steady"], "end_time_s"),
            ("t_end", &["end_time_s", "steady"], "end_time_s"),
            ("outlet", &["periodic", "no_slip", "open"], "open"),
            ("MRT", &["bgk", "trt", "central_moment"], "central_moment"),
            ("obstacles", &["domain", "solids", "fluid"], "solids"),
            ("bounce-back", &["no_slip", "free_slip"], "no_slip"),
        ];
        for (found, allowed, name) in cases {
            let allowed = words(allowed);
            assert_eq!(hint(found, &allowed).name.as_deref(), Some(*name), "{found}");
            assert_eq!(hint_of_key(found, &allowed, "", false).name.as_deref(), Some(*name), "{found}");
        }
    }

    #[test]
    fn limit_what_does_not_exist_gets_a_note_and_no_name() {
        let inflow = hint("inflow", &words(&["periodic", "no_slip", "moving_wall", "open"]));
        assert!(inflow.name.is_none() && inflow.note.starts_with("there is no inflow"), "{inflow:?}");
        let mesh = hint_of_key("mesh", &words(&["name", "shape"]), "solids[0]", false);
        assert!(mesh.name.is_none() && mesh.note.starts_with("meshes are walls"), "{mesh:?}");
        assert_eq!(hint("entropy", &words(&["periodic"])), Hint::default());
    }

    /// A key in the wrong object is not to be removed but moved.
    #[test]
    fn keys_have_a_place() {
        let top = words(&["domain", "gravity", "fluid", "solids", "numerics", "stop", "output"]);
        let cases = [
            ("end_time_s", "", "it belongs in `stop`: move it there"),
            ("duration", "", "it is `end_time_s` in `stop`"),
            ("duration_min", "", "it is `end_time_s` in `stop`, its number times 60"),
            ("boundaries", "", "it belongs in `domain`: move it there"),
            ("timestep", "", "it is `time_step_s` in `numerics`"),
            ("viscosity_pa_s", "fluid", "it belongs in `fluid.rheology.newtonian`: move it there"),
            (
                "box",
                "fluid.initial.shapes[2]",
                "it belongs in `fluid.initial.shapes[2].shape`: move it there",
            ),
        ];
        for (found, path, note) in cases {
            let allowed = if path.contains('[') { words(&["name", "shape"]) } else { top.clone() };
            let hint = hint_of_key(found, &allowed, path, false);
            assert_eq!((hint.name, hint.note.as_str()), (None, note), "{found}");
        }
    }

    #[test]
    fn units_of_other_habits_come_with_a_factor() {
        let cases = [
            ("size_mm", "size_m", "0.001"),
            ("slope_rad", "slope_deg", "57.2958"),
            ("endTimeMs", "end_time_s", "0.001"),
            ("density_g_per_cm3", "density_kg_per_m3", "1000"),
        ];
        for (found, name, factor) in cases {
            let hint = hint_of_key(found, &words(&[name, "title"]), "", false);
            assert_eq!(hint.name.as_deref(), Some(name), "{found}");
            assert_eq!(hint.note, format!("its number times {factor}"), "{found}");
        }
    }
}
