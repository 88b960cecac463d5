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
    /// Of the fastest wall of the box or solid.
    pub faces: f64,
    /// The same where a solid moves, an upper bound of its speed; and of grains.
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

    /// What is given in a box of 10 cm in cells of 1 cm; `faces`: its boundaries and how they move; `fluid`, `solids`: more of
    /// these.
    fn given(faces: &str, fluid: &str, solids: &str) -> GivenSpeeds {
        let text = format!(
            r#"{{ "domain": {{ {faces} "size_m": [0.1, 0.1, 0.1], "spacing_m": 0.01 }},
            "fluid": {{ "density_kg_per_m3": 1000, "rheology": {{ "newtonian": {{ "viscosity_pa_s": 1 }} }} {fluid} }},
            "solids": [{solids}], "stop": {{ "end_time_s": 0.1 }} }}"#
        );
        let scene = crate::scene::flow_from_json(&text, "given.json", std::path::Path::new(".")).unwrap();
        let facts = Facts::of(&scene);
        given_speeds(&facts, &super::super::cells::fill(&facts))
    }

    /// A wall at rest below, and one with a velocity above.
    fn wall(velocity: &str) -> String {
        let moving = format!(r#"{{ "moving_wall": {{ "velocity_m_per_s": {velocity} }} }}"#);
        format!(r#""boundaries": {{ "z_min": "no_slip", "z_max": {moving} }},"#)
    }

    const CYLINDER: &str = r#""shape": { "cylinder":
        { "point_m": [0.05, 0, 0.05], "direction": [0, 1, 0], "radius_m": 0.03 } }"#;

    fn close(found: f64, expected: f64) {
        // Few operations, each rounded.
        assert!((found - expected).abs() <= 1e-14 * expected, "{found} {expected}");
    }

    #[test]
    fn exact_given_speeds_of_a_scene_at_rest() {
        let at_rest = given(&wall("[0, 0, 0]"), "", &format!(r#"{{ "name": "post", {CYLINDER} }}"#));
        assert_eq!((at_rest.fluid, at_rest.faces, at_rest.bodies), (0.0, 0.0, 0.0));
    }

    /// A wall with the velocity (3, 4, 0) m/s, in time at most 0.5 + 0.25 of it; a solid at rest is no moving body.
    #[test]
    fn exact_given_speed_of_a_wall() {
        let post = format!(r#"{{ "name": "post", {CYLINDER} }}"#);
        let steady = given(&wall("[3, 4, 0]"), "", &post);
        close(steady.faces, 5.0);
        assert_eq!((steady.fluid, steady.bodies), (0.0, 0.0));
        let motion = r#""motion": { "z_max": { "oscillating":
            { "frequency_hz": 1, "amplitude": 0.5, "mean": -0.25 } } },"#;
        close(given(&(wall("[3, 4, 0]") + motion), "", &post).faces, 3.75);
    }

    /// ω r of the outermost cells of a post that turns about its axis: of those with centres within 3 cm of it, which lie at odd
    /// halves of 1 cm, the farthest is (2.5, 1.5) cm off.
    #[test]
    fn exact_given_speed_of_a_turning_post() {
        let turns = |axis: &str| format!(r#"{{ "name": "post", {CYLINDER}, "spin_rad_per_s": {axis} }}"#);
        let rim = (0.025_f64 * 0.025 + 0.015 * 0.015).sqrt();
        for spin in ["[0, 8, 0]", "[0, -8, 0]"] {
            let found = given("", "", &turns(spin));
            close(found.bodies, 8.0 * rim);
            assert_eq!(found.fluid, 0.0);
        }
        let at_a_wall = given(&wall("[0.01, 0, 0]"), "", &turns("[0, 8, 0]"));
        close(at_a_wall.bodies, 8.0 * rim);
    }

    /// A post that slides along its axis: in every cell the same; in time twice that.
    #[test]
    fn exact_given_speed_of_a_sliding_post() {
        let slides = |more: &str| {
            format!(r#"{{ "name": "post", {CYLINDER}, "velocity_m_per_s": [0, -0.5, 0] {more} }}"#)
        };
        close(given("", "", &slides("")).bodies, 0.5);
        let table = r#", "motion": { "table": { "points": [[0, 0], [1, -2], [2, 1]] } }"#;
        close(given("", "", &slides(table)).bodies, 1.0);
    }

    /// One cell that moves and turns about a point off its middle: r = (0.03, 0.04, −0.07) m, ω × r = (−0.09, 0.26, 0.11) m/s.
    #[test]
    fn exact_given_speed_of_a_cell_about_a_point() {
        let cell = r#""shape": { "box": { "min_m": [0.04, 0.06, 0.02], "max_m": [0.05, 0.07, 0.03] } }"#;
        let motion = r#""velocity_m_per_s": [-0.1, 0.2, 0.3], "spin_rad_per_s": [2, -1, 4],
            "centre_m": [0.015, 0.025, 0.095]"#;
        let found = given("", "", &format!(r#"{{ "name": "cell", {cell}, {motion} }}"#));
        close(found.bodies, (0.19_f64 * 0.19 + 0.46 * 0.46 + 0.41 * 0.41).sqrt());
    }

    /// Largest speed of initial flows in closed form, which some point of the flow has.
    #[test]
    fn exact_given_speed_of_the_fluid() {
        let of = |flow: &str| {
            let found = given("", &format!(r#", "initial_velocity": {{ {flow} }}"#), "");
            assert_eq!((found.faces, found.bodies), (0.0, 0.0));
            found.fluid
        };
        close(of(r#""uniform": { "velocity_m_per_s": [0.03, -0.04, 0] }"#), 0.05);
        // The wave and the mean point the same way.
        let wave =
            r#""amplitude_m_per_s": [0, -0.03, 0], "wave_counts": [1, 0, 0], "mean_m_per_s": [0, 0.04, 0]"#;
        close(of(&format!(r#""shear_wave": {{ {wave} }}"#)), 0.07);
        // Continuity: half the wave length along x gives twice the speed along y.
        let vortices = |counts: &str| {
            format!(
                r#""taylor_green": {{ "amplitude_m_per_s": 0.02, "normal": "z", "wave_counts": {counts} }}"#
            )
        };
        close(of(&vortices("[2, 1]")), 0.04);
        close(of(&vortices("[1, 2]")), 0.02);
        close(of(r#""taylor_green_3d": { "amplitude_m_per_s": 0.02, "wave_counts": [1, 1, 1] }"#), 0.02);
        // Of A and B alone: √(A² + B² + 2 A B sin kx cos kz).
        close(of(r#""abc": { "amplitudes_m_per_s": [0.02, -0.01, 0], "wave_counts": [1, 1, 1] }"#), 0.03);
    }
}
