//! Random scenes of one or two grains.

use serde_json::{Value, json};

use super::super::case::Draw;
use super::draw::{Drawn, G};
use crate::claim::VerifyError;
use crate::exact::grains::collision::{hertz_stiffness, visco_elastic};
use crate::exact::grains::rolling::{incline_acceleration, oblique_slip};
use lahar::dem::Dem;
use lahar::plan::expected::Kind;
use lahar::plan::grains::GrainPlan;

/// q of a rigid sphere.
const RIGID: f64 = 2.5;

/// Bounces on the floor within the time of a scene.
const BOUNCES: f64 = 50.0;

/// What becomes of one or two grains, rigid.
#[derive(Clone, Copy, Debug)]
pub enum Exact {
    /// Two grains that collide head on with this restitution.
    Collision(f64),
    /// A grain that strikes the floor: restitution, speed towards it, and along it afterwards.
    Strike(f64, f64, f64),
    /// A grain on the floor: speed at the end.
    Floor(f64),
}

/// Contact law with its restitution for a pair of effective mass and radius, stiffness and speed.
fn contact(draw: &mut Draw, mass: f64, stiffness: f64, speed: f64) -> (Value, f64) {
    let (kind, e) = (draw.unit(), draw.between(0.05, 1.0));
    if kind < 0.5 {
        (json!({ "tsuji": { "restitution": e } }), e)
    } else if kind < 0.75 {
        // Dimensionless damping a = A (k/m)^{2/5} v^{1/5}.
        let a = draw.between(0.0, 0.6);
        let time = a / (libm::pow(stiffness / mass, 0.4) * libm::pow(speed, 0.2));
        (json!({ "visco_elastic": { "dissipative_time_s": time } }), visco_elastic(a).cut_off)
    } else {
        // A linear spring as deep as Hertz's: v² m/δ².
        let depth = libm::pow(1.25 * mass * speed * speed / stiffness, 0.4);
        let spring = mass * speed * speed / (depth * depth);
        (json!({ "linear": { "stiffness_n_per_m": spring, "restitution": e } }), e)
    }
}

/// A scene of grains.
pub fn draw(draw: &mut Draw) -> Drawn {
    let kind = draw.unit();
    let (density, radius, poisson) =
        (draw.ratio(500.0, 8000.0), draw.ratio(1e-3, 0.1), draw.between(0.0, 0.45));
    let speed = draw.ratio(1e-2, 5.0);
    // Depth of an impact over the radius decides how soft a grain is: δ/r = 1.36 (ρ v²/E*)^{2/5} or so.
    let young = density * speed * speed * libm::pow(draw.ratio(1e-4, 0.06), -2.5);
    let mut numerics = serde_json::Map::new();
    if draw.unit() < 0.5 {
        numerics.insert("steps_per_contact".into(), json!(draw.ratio(10.0, 300.0)));
    }
    let friction = draw.ratio(0.05, 1.0);
    let volume = |r: f64| 4.0 / 3.0 * std::f64::consts::PI * r * r * r;
    let mut scene = json!({
        "domain": { "size_m": [1e4 * radius, 1e3 * radius, 1e3 * radius] },
        "grains": {
            "materials": [ {
                "name": "stone", "density_kg_per_m3": density, "young_modulus_pa": young, "poisson_ratio": poisson
            } ]
        }
    });
    let middle = 500.0 * radius;
    let (grains, exact, end) = if kind < 0.5 {
        let other = radius * draw.ratio(0.1, 1.0);
        let (a, b) = (density * volume(radius), density * volume(other));
        let mass = a * b / (a + b);
        let (law, e) = contact(draw, mass, hertz_stiffness(young, poisson, (radius, other)), speed);
        scene["grains"]["contact"] = json!({ "law": law, "friction": friction });
        let gap = 1e-6 * radius;
        let sets = json!([
            { "name": "a", "velocity_m_per_s": [0.5 * speed, 0.0, 0.0],
              "place": { "list": [ { "position_m": [middle, middle, middle], "radius_m": radius } ] } },
            { "name": "b", "velocity_m_per_s": [-0.5 * speed, 0.0, 0.0],
              "place": { "list": [ { "position_m": [middle + radius + other + gap, middle, middle], "radius_m": other } ] } }
        ]);
        (sets, Exact::Collision(e), radius / speed)
    } else {
        scene["domain"]["boundaries"] = json!({ "z_min": "no_slip", "z_max": "open" });
        floor(draw, &mut scene, [density * volume(radius), radius, young, poisson, speed, friction])
    };
    scene["grains"]["sets"] = grains;
    scene["stop"] = json!({ "end_time_s": end });
    if matches!(exact, Exact::Floor(_)) {
        // Nothing strikes: the contact that the weight holds closed decides.
        numerics.insert("design_speed_m_per_s".into(), json!((0.01 * G * radius).sqrt()));
    }
    scene["grains"]["numerics"] = Value::Object(numerics);
    Drawn { kind: Kind::Contact, scene, exact: super::draw::Exact::Grains(exact), step: None }
}

/// One grain above the floor: its set, what becomes of it, and the time.
fn floor(draw: &mut Draw, scene: &mut Value, numbers: [f64; 6]) -> (Value, Exact, f64) {
    let [mass, radius, young, poisson, speed, friction] = numbers;
    let stiffness = hertz_stiffness(young, poisson, (radius, f64::INFINITY));
    let (law, e) = contact(draw, mass, stiffness, speed);
    scene["grains"]["contact"] = json!({ "law": law, "friction": friction });
    let place = |height: f64| json!({ "list": [ { "position_m": [2.0 * radius, 2.0 * radius, height], "radius_m": radius } ] });
    let set = |velocity: [f64; 3], height: f64| json!([ { "name": "a", "velocity_m_per_s": velocity, "place": place(height) } ]);
    if draw.unit() < 0.3 {
        // Slips to the end.
        let along = draw.between(1.05, 3.0) * 3.5 * friction * (1.0 + e) * speed;
        let (after, _) = oblique_slip(speed, along, e, friction).unwrap_or((f64::NAN, f64::NAN));
        let exact = Exact::Strike(e, speed, after);
        return (set([along, 0.0, -speed], radius * (1.0 + 1e-6)), exact, radius / speed);
    }
    scene["grains"]["contact"]["law"] = json!({ "tsuji": { "restitution": e } });
    let level = draw.unit() < 0.5;
    let slope = if level { 0.0 } else { draw.between(2.0, 60.0) };
    let time = if level {
        1.5 * speed / (friction * G * (1.0 + RIGID))
    } else {
        draw.ratio(10.0, 100.0) * (radius / G).sqrt()
    };
    // So stiff that the bounces of its weight are a small part of the radius and of the time: friction is μ m g in their mean.
    let bounce =
        G * (time / (2.0 * std::f64::consts::PI * BOUNCES)) * (time / (2.0 * std::f64::consts::PI * BOUNCES));
    let depth = (1e-3 * radius).min(bounce) * draw.ratio(0.01, 1.0);
    let weight = mass * G * libm::cos(slope.to_radians());
    let young = weight / (depth * depth.sqrt()) * young / stiffness;
    scene["grains"]["materials"][0]["young_modulus_pa"] = json!(young);
    if level {
        scene["gravity"] = json!({ "magnitude_m_per_s2": G, "direction": [0.0, 0.0, -1.0] });
        (set([speed, 0.0, 0.0], radius), Exact::Floor(RIGID / (1.0 + RIGID) * speed), time)
    } else {
        scene["gravity"] = json!({ "magnitude_m_per_s2": G, "slope_deg": slope });
        let a = incline_acceleration(RIGID, friction, G, slope.to_radians());
        (set([0.0; 3], radius), Exact::Floor(a * time), time)
    }
}

/// Steps that a collision may take, in contacts.
const LONGEST: f64 = 60.0;

/// Errors of restitution, and of the speed afterwards; NaN where a scene has none.
///
/// # Errors
/// The grains refuse.
pub fn errors(plan: &GrainPlan, exact: &Exact) -> Result<[f64; 2], VerifyError> {
    let mut d = Dem::new(&plan.setup)?;
    match *exact {
        Exact::Collision(e) => {
            let before = d.bodies().velocity[0].x - d.bodies().velocity[1].x;
            apart(&mut d, plan, |d| d.contacts().next().is_none())?;
            let after = d.bodies().velocity[1].x - d.bodies().velocity[0].x;
            Ok([after / before - e, f64::NAN])
        }
        Exact::Strike(e, speed, along) => {
            apart(&mut d, plan, |d| d.wall_contacts().iter().all(|near| near.contacts.is_empty()))?;
            let v = d.bodies().velocity[0];
            Ok([v.z / speed - e, v.x / along - 1.0])
        }
        Exact::Floor(speed) => {
            d.step(plan.steps)?;
            // The exact speed is that at the end of the last step.
            let late = d.time() / plan.numbers.end_time_s;
            let exact = if plan.setup.gravity.x == 0.0 { speed } else { speed * late };
            Ok([f64::NAN, d.bodies().velocity[0].x / exact - 1.0])
        }
    }
}

/// Steps until grains have touched and are apart again.
fn apart(d: &mut Dem, plan: &GrainPlan, free: impl Fn(&Dem) -> bool) -> Result<(), VerifyError> {
    let most = (LONGEST * plan.numbers.steps_per_contact) as u64;
    let mut touched = false;
    while d.steps() < most {
        d.step(1)?;
        let apart = free(d);
        if touched && apart {
            return Ok(());
        }
        touched |= !apart;
    }
    Err(VerifyError::Numerics { what: "a collision", detail: "still in contact".into() })
}
