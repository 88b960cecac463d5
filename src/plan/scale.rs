//! How fast the flow is expected to be, from what drives it.

use super::cells::Cells;
use super::facts::Facts;
use super::surface::Pool;
use crate::rheology::FlowCurve;
use crate::scene::force::norm;
use crate::scene::{BodyForce, Boundary, InitialVelocity, Motion, Scene};

/// Expected scales, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scales {
    /// Largest velocity, m/s; 0 when nothing moves.
    pub velocity: f64,
    /// Length of the Reynolds number, m: the gap between walls, else the longest edge.
    pub length: f64,
    /// Shear rate that goes with them, 1/s: 2 U / L.
    pub shear_rate: f64,
    /// Largest shear rate expected, 1/s.
    pub shear_rate_max: f64,
    /// Largest magnitude of the body force, N/m³.
    pub force: f64,
}

/// Speeds that a scene gives, m/s.
#[derive(Clone, Copy, Debug)]
pub(super) struct GivenSpeeds {
    /// Of the fluid at the start.
    pub fluid: f64,
    /// Of walls of the box.
    pub faces: f64,
    /// Of solids and grains.
    pub bodies: f64,
}

/// Speeds of the fluid at the start and of walls and solids.
#[must_use]
pub(super) fn given_speeds(facts: &Facts, cells: &Cells) -> GivenSpeeds {
    let fastest = wall_speed(facts, cells);
    let moving = |s: &crate::scene::Solid| s.velocity_m_per_s != [0.0; 3] || s.spin_rad_per_s != [0.0; 3];
    let bodies = if facts.scene.solids.iter().any(moving) { fastest } else { 0.0 };
    GivenSpeeds { fluid: initial_scales(facts.scene).0, faces: fastest, bodies }
}

/// Scales of a scene.
#[must_use]
pub(crate) fn scales(facts: &Facts, cells: &Cells) -> Scales {
    let scene = facts.scene;
    let dx = scene.domain.spacing_m;
    let length = if let Some(pool) = &cells.pool {
        pool.depth
    } else if cells.gap.is_finite() {
        cells.gap * dx
    } else {
        scene.domain.size_m.into_iter().fold(0.0, greatest)
    };
    let extremes = facts.forces.driving_extremes;
    let driving = extremes
        .map(|f| norm(std::array::from_fn(|a| if facts.closed[a] { 0.0 } else { f[a] })))
        .into_iter()
        .fold(0.0, greatest);
    let half_gap = 0.5 * cells.gap * dx;
    let driven = match &cells.pool {
        Some(pool) => surface_velocity(facts, pool),
        None => {
            facts.curves().map(|curve| driven_velocity(scene, curve, driving, half_gap)).fold(0.0, greatest)
        }
    };
    let walls = wall_speed(facts, cells);
    let (initial, initial_rate) = initial_scales(scene);
    let estimate = greatest(walls, initial) + driven;
    let velocity = scene.numerics.reference_velocity_m_per_s.unwrap_or(estimate);
    let wall_rate = if cells.pool.is_some() {
        // No more than the whole velocity over one cell.
        least(facts.curve().shear_rate_at(driving * length), velocity / dx)
    } else if half_gap.is_finite() {
        facts.curves().map(|curve| curve.shear_rate_at(driving * half_gap)).fold(0.0, greatest)
    } else {
        0.0
    };
    let rate = 2.0 * velocity / length;
    Scales {
        velocity,
        length,
        shear_rate: rate,
        shear_rate_max: [wall_rate, initial_rate, rate].into_iter().fold(0.0, greatest),
        force: extremes.map(norm).into_iter().fold(0.0, greatest),
    }
}

/// Largest speed of a flow with a free surface: a level film flows as the force along it says; anything
/// else collapses, falls freely, or runs down the slope.
fn surface_velocity(facts: &Facts, pool: &Pool) -> f64 {
    let (scene, curve) = (facts.scene, facts.curve());
    let rho = scene.fluid.density_kg_per_m3;
    let mut most = 0.0;
    for force in facts.forces.extremes {
        let along: [f64; 3] = std::array::from_fn(|a| if a == pool.up.index() { 0.0 } else { force[a] });
        let walled = (0..3).any(|a| facts.closed[a] && along[a] != 0.0);
        let (along, across) = (norm(along), force[pool.up.index()].abs());
        let film = least(curve.channel_velocity(along, pool.depth), along / rho * scene.stop.end_time_s);
        let longest = scene.domain.size_m.into_iter().fold(0.0, greatest);
        let slope = least(film, (2.0 * along / rho * longest).sqrt());
        let fall = least((2.0 * across / rho * pool.fall).sqrt(), across / rho * scene.stop.end_time_s);
        let speed = if pool.level && !walled {
            film
        } else {
            greatest(slope, collapse_velocity(curve, rho, norm(force), pool.depth))
        };
        most = greatest(most, greatest(speed, fall));
    }
    most
}

/// U of a collapsing heap of depth h: ½ρU² + 2σ(2U/h) = 2 f h. Without viscosity it is Ritter's front,
/// 2√(gh); for a slow Newtonian fluid f h²/(2μ), that of a film on a slope of 45°.
fn collapse_velocity(curve: &dyn FlowCurve, rho: f64, force: f64, depth: f64) -> f64 {
    let drive = 2.0 * force * depth;
    let excess = |u: f64| {
        let rate = 2.0 * u / depth;
        0.5 * rho * u * u + 2.0 * curve.apparent_viscosity(rate) * rate - drive
    };
    let (mut low, mut high) = (0.0, 2.0 * (force * depth / rho).sqrt());
    if high <= 0.0 {
        return 0.0;
    }
    // Halving the interval 60 times leaves nothing but rounding.
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if excess(middle) > 0.0 { high = middle } else { low = middle }
    }
    if low < 1e-12 * high.abs() { 0.0 } else { low }
}

/// The steady channel flow, or what the force can accelerate to before the end or within one
/// oscillation, whichever is less.
fn driven_velocity(scene: &Scene, curve: &dyn FlowCurve, driving: f64, half_gap: f64) -> f64 {
    if driving == 0.0 {
        return 0.0;
    }
    let acceleration = driving / scene.fluid.density_kg_per_m3;
    let time = match scene.fluid.body_force {
        Some(BodyForce::Oscillating { mean_n_per_m3: [0.0, 0.0, 0.0], frequency_hz, .. })
            if scene.gravity.is_none() =>
        {
            1.0 / (std::f64::consts::TAU * frequency_hz)
        }
        _ => scene.stop.end_time_s,
    };
    let inertial = acceleration * time;
    if half_gap.is_finite() { least(curve.channel_velocity(driving, half_gap), inertial) } else { inertial }
}

/// Fastest wall: faces of the box and surfaces of solids, m/s.
fn wall_speed(facts: &Facts, cells: &Cells) -> f64 {
    let scene = facts.scene;
    let mut fastest: f64 = 0.0;
    let motions = scene.domain.motion.by_axis();
    for (face, motion) in facts.faces.into_iter().flatten().zip(motions.into_iter().flatten()) {
        if let Boundary::MovingWall { velocity_m_per_s } = face {
            fastest = greatest(fastest, most(motion) * norm(velocity_m_per_s));
        }
    }
    if scene.solids.iter().any(|s| s.velocity_m_per_s != [0.0; 3] || s.spin_rad_per_s != [0.0; 3]) {
        fastest = greatest(fastest, solid_speed(scene, cells));
    }
    fastest
}

/// Largest factor of a velocity in time.
fn most(motion: Option<&Motion>) -> f64 {
    motion.map_or(1.0, Motion::most)
}

/// Fastest surface of a solid: over solid cells with a fluid neighbour.
fn solid_speed(scene: &Scene, cells: &Cells) -> f64 {
    let [nx, ny, nz] = cells.extents;
    let index = |c: [usize; 3]| c[0] + nx * (c[1] + ny * c[2]);
    let mut fastest: f64 = 0.0;
    for k in 0..nz {
        for j in 0..ny {
            for i in 0..nx {
                let cell = [i, j, k];
                let number = cells.solids[index(cell)];
                if number == 0 || !touches_fluid(cells, cell, index) {
                    continue;
                }
                let solid = &scene.solids[usize::from(number) - 1];
                let centre = solid.centre_m.unwrap_or_else(|| solid.shape.centre());
                let r: [f64; 3] =
                    std::array::from_fn(|a| (cell[a] as f64 + 0.5) * scene.domain.spacing_m - centre[a]);
                let (v, w) = (solid.velocity_m_per_s, solid.spin_rad_per_s);
                let u = [
                    v[0] + w[1] * r[2] - w[2] * r[1],
                    v[1] + w[2] * r[0] - w[0] * r[2],
                    v[2] + w[0] * r[1] - w[1] * r[0],
                ];
                fastest = greatest(fastest, most(solid.motion.as_ref()) * norm(u));
            }
        }
    }
    fastest
}

fn touches_fluid(cells: &Cells, cell: [usize; 3], index: impl Fn([usize; 3]) -> usize) -> bool {
    (0..3).any(|a| {
        let n = cells.extents[a];
        [1, n - 1].into_iter().any(|step| {
            let mut neighbour = cell;
            neighbour[a] = (cell[a] + step) % n;
            cells.solids[index(neighbour)] == 0
        })
    })
}

/// Largest velocity and shear rate of the initial flow.
fn initial_scales(scene: &Scene) -> (f64, f64) {
    let size = scene.domain.size_m;
    let k = |a: usize, count: f64| std::f64::consts::TAU * count.abs() / size[a];
    match scene.fluid.initial_velocity {
        InitialVelocity::AtRest => (0.0, 0.0),
        InitialVelocity::Uniform { velocity_m_per_s } => (norm(velocity_m_per_s), 0.0),
        InitialVelocity::ShearWave { amplitude_m_per_s, wave_counts, mean_m_per_s } => {
            let amplitude = norm(amplitude_m_per_s);
            let wave = norm(std::array::from_fn(|a| k(a, f64::from(wave_counts[a]))));
            (amplitude + norm(mean_m_per_s), amplitude * wave)
        }
        InitialVelocity::TaylorGreen { amplitude_m_per_s, normal, wave_counts, mean_m_per_s } => {
            let [a, b] = normal.others();
            let (ka, kb) = (k(a, f64::from(wave_counts[0])), k(b, f64::from(wave_counts[1])));
            let amplitude = amplitude_m_per_s.abs() * greatest(1.0, ka / kb);
            (amplitude + norm(mean_m_per_s), 2.0 * amplitude * greatest(ka, kb))
        }
        InitialVelocity::TaylorGreen3d { amplitude_m_per_s, wave_counts } => {
            let amplitude = amplitude_m_per_s.abs();
            (amplitude, 2.0 * amplitude * k(0, f64::from(wave_counts[0])))
        }
        InitialVelocity::Abc { amplitudes_m_per_s, wave_counts } => {
            let amplitude = amplitudes_m_per_s.iter().map(|a| a.abs()).sum::<f64>();
            (amplitude, 2.0 * amplitude * k(0, f64::from(wave_counts[0])))
        }
    }
}

fn greatest(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}

fn least(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rheology::Law;

    #[test]
    fn limits_of_the_collapse_velocity() {
        let (rho, g, h): (f64, f64, f64) = (1000.0, 9.81, 0.1);
        let newtonian = |mu: f64| Law::Newtonian { mu }.curve();
        let inviscid = collapse_velocity(&*newtonian(1e-9), rho, rho * g, h);
        assert!((inviscid / (2.0 * (g * h).sqrt()) - 1.0).abs() < 1e-6, "Ritter: {inviscid}");
        // Inertia is ρU²/2 against 4μU/h: a share of 1e-7 for U = 5e-4 m/s.
        let creeping = collapse_velocity(&*newtonian(1e5), rho, rho * g, h);
        assert!((creeping / (rho * g * h * h / 2e5) - 1.0).abs() < 1e-6, "film: {creeping}");
        let stiff = Law::Bingham { sigma0: 1000.0, mu: 1.0 }.curve();
        assert_eq!(collapse_velocity(&*stiff, rho, rho * g, h), 0.0, "2σ0 > 2ρgh: it stands");
    }
}
