//! How fast grains move in a fluid, for the choice of the time steps.

use crate::dem::{Grain, Setup};
use crate::plan::cells::Cells;
use crate::plan::facts::Facts;
use crate::rheology::FlowCurve;
use crate::scene::Scene;

/// Yield number σ0/(|ρs − ρ| g d) above which a sphere is held.
///
/// # Source
/// Beris, Tsamopoulos, Armstrong & Brown 1985, J. Fluid Mech. 158, 219: 2πR²σ0/F = 0.143.
pub(crate) const HELD_ABOVE: f64 = 0.143 / 3.0;

/// σ0/(|ρs − ρ| g d); infinite without a weight.
#[must_use]
pub(crate) fn yield_number(curve: &dyn FlowCurve, excess: f64, gravity: f64, diameter: f64) -> f64 {
    let sigma0 = curve.plastic_stress();
    let weight = excess.abs() * gravity * diameter;
    if sigma0 == 0.0 {
        0.0
    } else if weight == 0.0 {
        f64::INFINITY
    } else {
        sigma0 / weight
    }
}

/// Speed at which a single sphere sinks or rises in the unbounded fluid, m/s: Stokes drag with the correction of
/// Schiller & Naumann, 3πμd w (1 + 0.15 Re^0.687), with the viscosity at the rate w/d; a yield stress takes its share
/// σ0/σ0,held of the weight. An estimate for time steps, within some tens of per cent.
///
/// # Arguments
/// `excess`: ρs − ρ, kg/m³; `density`: of the fluid; `gravity`, m/s²; `diameter`, m.
#[must_use]
pub(crate) fn terminal(curve: &dyn FlowCurve, density: f64, excess: f64, gravity: f64, diameter: f64) -> f64 {
    let held = yield_number(curve, excess, gravity, diameter) / HELD_ABOVE;
    let cube = diameter * diameter * diameter;
    let pull = std::f64::consts::PI / 6.0 * cube * excess.abs() * gravity * (1.0 - held);
    if pull.is_nan() || pull <= 0.0 {
        return 0.0;
    }
    let drag = |w: f64| {
        let mu = curve.plastic_viscosity(w / diameter);
        let reynolds = density * w * diameter / mu;
        3.0 * std::f64::consts::PI * mu * diameter * w * (1.0 + 0.15 * libm::pow(reynolds, 0.687))
    };
    let (mut low, mut high) = (0.0, 1e-12);
    while drag(high) < pull && high < 1e9 {
        (low, high) = (high, 2.0 * high);
    }
    // Halving an octave 50 times leaves nothing but rounding.
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if drag(middle) < pull { low = middle } else { high = middle }
    }
    high
}

/// Speed of a grain relative to the fluid around it, m/s: terminal, or what it gains by falling through air before it
/// reaches the fluid, whichever is more.
#[must_use]
pub(crate) fn relative(facts: &Facts, setup: &Setup, cells: &Cells, grain: &Grain) -> f64 {
    let scene = facts.scene;
    let density = scene.fluid.density_kg_per_m3;
    let own = setup.materials.list[grain.material].density_kg_m3;
    let (gravity, excess) = (setup.gravity.norm(), own - density);
    if gravity == 0.0 || grain.driven {
        return 0.0;
    }
    let longest = scene.domain.size_m.into_iter().fold(0.0, f64::max);
    let drop = air_below(scene, cells, grain);
    // From rest it gains no more than this on its way through the box.
    let way = (2.0 * gravity * (excess / own).abs() * longest).sqrt();
    let sink = terminal(facts.curve(), density, excess, gravity, 2.0 * grain.radius).min(way);
    sink.max((2.0 * gravity * drop).sqrt())
}

/// Air between a grain's centre and the fluid or the solid below it, m; 0 in the fluid.
fn air_below(scene: &Scene, cells: &Cells, grain: &Grain) -> f64 {
    let Some(pool) = &cells.pool else { return 0.0 };
    let (axis, n, dx) = (pool.up.index(), cells.extents, scene.domain.spacing_m);
    let mut at: [usize; 3] = std::array::from_fn(|a| {
        let x = (grain.position[a] / dx).floor().max(0.0) as usize;
        x.min(n[a] - 1)
    });
    let mut drop = 0.0;
    loop {
        let cell = at[0] + n[0] * (at[1] + n[1] * at[2]);
        let solid = cells.solids.get(cell).is_some_and(|&s| s != 0);
        if solid || cells.fill.get(cell).is_some_and(|&fill| fill > 0.0) {
            return drop;
        }
        drop += dx;
        let next = if pool.down_is_low { at[axis].checked_sub(1) } else { Some(at[axis] + 1) };
        match next {
            Some(next) if next < n[axis] => at[axis] = next,
            _ => return drop,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rheology::Law;

    #[test]
    fn terminal_speeds_of_known_cases() {
        // Stokes, Re = 1e-6: 2/9 Δρ g r²/μ up to 0.15 Re^0.687 = 1e-5.
        let honey = Law::Newtonian { mu: 10.0 }.curve();
        let slow = terminal(&*honey, 1000.0, 100.0, 9.81, 2e-3);
        let stokes = 2.0 / 9.0 * 100.0 * 9.81 * 1e-6 / 10.0;
        assert!((slow / stokes - 1.0).abs() < 1e-4, "{slow} {stokes}");
        // ten Cate's case E1: 0.038 m/s by Abraham's drag, which lies up to 10 % above this curve.
        let oil = Law::Newtonian { mu: 0.373 }.curve();
        let e1 = terminal(&*oil, 970.0, 150.0, 9.81, 0.015);
        assert!((0.038..0.043).contains(&e1), "{e1}");
        // Held: σ0 = 0.05 Δρ g d.
        let mud = Law::Bingham { sigma0: 0.05 * 1500.0 * 9.81 * 0.01, mu: 1.0 }.curve();
        assert_eq!(terminal(&*mud, 1000.0, 1500.0, 9.81, 0.01), 0.0);
        let thin = Law::Bingham { sigma0: 1.0, mu: 1.0 }.curve();
        assert!(terminal(&*thin, 1000.0, 1500.0, 9.81, 0.01) > 0.0);
        assert_eq!(terminal(&*thin, 1000.0, 0.0, 9.81, 0.01), 0.0);
    }
}
