//! The time step that contacts allow.

use super::bodies::Member;
use super::contact::restitution::hertz_contact_time;
use super::material::{Compiled, PairLaw, PairTable};

/// Fewest steps inside the shortest contact; below that a run is refused. At 10 steps a head-on Hertz collision
/// still keeps its energy to about a percent (see the order tables).
pub(crate) const FEWEST_STEPS: f64 = 10.0;

/// The shortest contact of a set-up.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Shortest {
    /// Its duration at the design speed, s.
    pub seconds: f64,
    /// Which pair, in words.
    pub pair: String,
}

/// Duration of a contact, s: Hertz's closed form at the given speed, or half a period of the linear oscillator.
pub(crate) fn contact_time(law: &PairLaw, mass: f64, radius: f64, speed: f64) -> f64 {
    match law.normal {
        Compiled::Linear { stiffness, .. } => std::f64::consts::PI * (mass / stiffness).sqrt(),
        Compiled::ViscoElastic { .. } | Compiled::Tsuji { .. } => {
            hertz_contact_time(mass, law.young, radius, speed)
        }
    }
}

/// Shortest contact among members, and between members and walls.
///
/// For each material only the lightest and the smallest members can be part of it: t_c rises with m* and falls
/// with R* only as R*^{−1/5}.
pub(crate) fn shortest(
    table: &PairTable,
    members: &[Member],
    wall_materials: &[u32],
    speed: f64,
) -> Option<Shortest> {
    let mut chosen: Vec<usize> = Vec::new();
    let materials = members.iter().map(|m| m.material).max()? + 1;
    for material in 0..materials {
        let mine = || {
            (0..members.len()).filter(|&i| members[i].material == material && members[i].inverse_mass > 0.0)
        };
        let by_mass = mine().max_by(|&a, &b| members[a].inverse_mass.total_cmp(&members[b].inverse_mass));
        let by_size = mine().min_by(|&a, &b| members[a].radius.total_cmp(&members[b].radius));
        chosen.extend(by_mass.into_iter().chain(by_size));
    }
    chosen.dedup();
    let mut best: Option<Shortest> = None;
    let mut consider = |seconds: f64, pair: &dyn Fn() -> String| {
        if best.as_ref().is_none_or(|b| seconds < b.seconds) {
            best = Some(Shortest { seconds, pair: pair() });
        }
    };
    for &i in &chosen {
        let a = &members[i];
        for &j in &chosen {
            let b = &members[j];
            let mass = 1.0 / (a.inverse_mass + b.inverse_mass);
            let radius = a.radius * b.radius / (a.radius + b.radius);
            let t = contact_time(table.law(a.material, b.material), mass, radius, speed);
            consider(t, &|| {
                format!(
                    "grains like {} and {} (radii {:.3e} m and {:.3e} m)",
                    a.body, b.body, a.radius, b.radius
                )
            });
        }
        for &w in wall_materials {
            let t = contact_time(table.law(a.material, w), 1.0 / a.inverse_mass, a.radius, speed);
            consider(t, &|| format!("a grain like {} (radius {:.3e} m) and a wall", a.body, a.radius));
        }
    }
    best
}
