//! Size classes of the grains: Bagnold number, resolution, and what to do with each.

use serde::Serialize;

use crate::dem::Setup;
use crate::rheology::bagnold::{Mixture, Regime, SizeClass, classify};

/// Most classes of a table.
const MOST: usize = 6;
/// Radii closer than this share are one size.
const SAME: f64 = 1e-3;
/// Radius in cells at which the drag of a sphere is within about 1 %.
const GOOD: f64 = 4.0;
/// Radius in cells from which grains are worth resolving at all.
const FAIR: f64 = 2.0;
/// Random packing of equal spheres; mixtures pack a little denser.
pub(crate) const PACKING: f64 = 0.64;

/// Grains of about one size.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ClassNumbers {
    /// Least and largest radius, m.
    pub radius_m: [f64; 2],
    /// Number of grains.
    pub grains: usize,
    /// Share of the volume of all grains.
    pub volume_share: f64,
    /// Radius of mean volume, cells.
    pub radius_cells: f64,
    /// Bagnold number among all grains; `null` where nothing shears or the box is packed.
    pub bagnold: Option<f64>,
    /// As if the class were alone.
    pub bagnold_alone: Option<f64>,
    /// By the thresholds 40 and 450.
    pub regime: Option<Regime>,
    /// ρ γ̇ d²/μ.
    pub grain_reynolds: Option<f64>,
    /// Spacing at which its radius would be 4 cells, m.
    pub spacing_for_4_cells_m: f64,
    /// Cost at that spacing over the cost at this one: fourth and fifth power of the ratio of spacings.
    pub cost_factor: [f64; 2],
    /// What to do with it.
    pub recommendation: &'static str,
}

/// Classes of a set-up in a mixture; the reason where there is no Bagnold number.
///
/// # Arguments
/// `spacing`, m; `mixture`: its solid fraction is that of all grains.
pub(super) fn classes(setup: &Setup, spacing: f64, mixture: &Mixture) -> (Vec<ClassNumbers>, Option<String>) {
    let mut radii: Vec<f64> = setup.grains.iter().filter(|g| !g.driven).map(|g| g.radius).collect();
    radii.sort_by(f64::total_cmp);
    let groups = groups(&radii);
    let volume = |radii: &[f64]| radii.iter().map(|r| r * r * r).sum::<f64>();
    let whole = volume(&radii);
    let mean = |group: &[f64]| libm::cbrt(volume(group) / group.len() as f64);
    let sizes: Vec<SizeClass> = (groups.iter())
        .map(|group| SizeClass { diameter_m: 2.0 * mean(group), volume_share: volume(group) / whole })
        .collect();
    let (reports, note) = match classify(&sizes, mixture) {
        _ if mixture.shear_rate.is_nan() || mixture.shear_rate <= 0.0 => {
            (Vec::new(), Some("nothing is expected to shear the fluid".to_owned()))
        }
        Ok(reports) => (reports, None),
        Err(error) => (Vec::new(), Some(error.to_string())),
    };
    let numbers = groups.iter().zip(&sizes).enumerate().map(|(k, (group, size))| {
        let report = reports.get(k);
        let radius = 0.5 * size.diameter_m;
        let ratio = GOOD * spacing / radius;
        let square = ratio * ratio;
        ClassNumbers {
            radius_m: [group.first().copied().unwrap_or(0.0), group.last().copied().unwrap_or(0.0)],
            grains: group.len(),
            volume_share: size.volume_share,
            radius_cells: radius / spacing,
            bagnold: report.map(|r| r.bagnold),
            bagnold_alone: report.map(|r| r.bagnold_alone),
            regime: report.map(|r| r.regime),
            grain_reynolds: report.map(|r| r.grain_reynolds),
            spacing_for_4_cells_m: radius / GOOD,
            cost_factor: [square * square, square * square * ratio],
            recommendation: recommendation(report.map(|r| r.regime), radius / spacing),
        }
    });
    (numbers.collect(), note)
}

fn recommendation(regime: Option<Regime>, cells: f64) -> &'static str {
    match regime {
        _ if cells >= GOOD && regime != Some(Regime::MacroViscous) => "grains, resolved here",
        None if cells >= FAIR => "grains, resolved here within a few per cent",
        None => "a finer spacing, or into the rheology",
        Some(Regime::MacroViscous) => "into the rheology; as grains only if its own motion matters",
        Some(Regime::Transitional) if cells >= FAIR => "either; as grains within a few per cent here",
        Some(Regime::Transitional) => "either; as grains at a finer spacing",
        Some(Regime::GrainInertia) if cells >= FAIR => "grains, resolved here within a few per cent",
        Some(Regime::GrainInertia) => "grains, at a finer spacing",
    }
}

/// Sorted radii as they are if there are few sizes, else in classes of equal width of ln r.
fn groups(radii: &[f64]) -> Vec<&[f64]> {
    let mut sizes: Vec<&[f64]> = radii.chunk_by(|a, b| b / a - 1.0 < SAME).collect();
    let alike =
        |group: &&[f64]| group.last().zip(group.first()).is_some_and(|(b, a)| b / a - 1.0 < 10.0 * SAME);
    if sizes.len() > MOST || !sizes.iter().all(alike) {
        let (Some(&first), Some(&last)) = (radii.first(), radii.last()) else { return Vec::new() };
        let width = libm::log(last / first) / MOST as f64;
        let class = |r: f64| ((libm::log(r / first) / width) as usize).min(MOST - 1);
        sizes = radii.chunk_by(|&a, &b| class(a) == class(b)).collect();
    }
    sizes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_groups_of_radii() {
        let lengths = |radii: &[f64]| groups(radii).iter().map(|g| g.len()).collect::<Vec<_>>();
        assert_eq!(lengths(&[1.0, 1.0, 2.0, 3.0, 3.0]), [2, 1, 2]);
        assert!(lengths(&[]).is_empty());
        // From 1 to 64 in steps of 2^(1/4): six octaves, the last with its end.
        let radii: Vec<f64> =
            (0..=24).map(|k| libm::exp2(f64::from(k) / 4.0 + 1e-9 * f64::from(k % 4 + 1))).collect();
        assert_eq!(lengths(&radii).len(), 6);
        assert_eq!(lengths(&radii).iter().sum::<usize>(), 25);
    }
}
