//! What makes energy out of nothing does not run: contacts get a step that their damping allows, books that stay open stop a
//! run, and a step that a guard stops is booked by no backend.

mod program;

use lahar::dem::{Grain, Material, Materials, NormalLaw, PairProperties};
use lahar::rheology::Law;
use lahar::run::{Ended, Summary};
use lahar::setup::{BodyForce, Face, FreeSurface, Setup};
use lahar::solver::fast::Fast;
use lahar::solver::plain::Plain;
use lahar::solver::run::{Backend, Runaway};
use program::lahar;

/// Two grains of 5 mm that meet at 2 m/s.
fn collision(law: &serde_json::Value, numerics: &serde_json::Value) -> serde_json::Value {
    let grain = |x: f64, v: f64| serde_json::json!({ "position_m": [x, 0.05, 0.05], "radius_m": 0.005, "velocity_m_per_s": [v, 0, 0] });
    serde_json::json!({
        "domain": { "size_m": [0.1, 0.1, 0.1], "boundaries": { "x_min": "no_slip", "x_max": "no_slip", "y_min": "no_slip",
            "y_max": "no_slip", "z_min": "no_slip", "z_max": "no_slip" } },
        "grains": {
            "materials": [ { "name": "m", "density_kg_per_m3": 2500, "young_modulus_pa": 1e7, "poisson_ratio": 0.25 } ],
            "contact": { "law": law, "friction": 0.4 },
            "numerics": numerics,
            "sets": [ { "name": "a", "place": { "list": [ grain(0.044, 1.0), grain(0.056, -1.0) ] } } ] },
        "stop": { "end_time_s": 0.003 },
        "output": { "probes": [ { "name": "e", "measure": "energies" } ] }
    })
}

/// Runs a scene; exit code, standard error and summary.
fn run(name: &str, scene: &serde_json::Value) -> (Option<i32>, String, Option<Summary>) {
    let out = program::folder("guards", name);
    let path = out.join("scene.json");
    std::fs::write(&path, scene.to_string()).expect("a written scene");
    let output = lahar(&["run", &path.to_string_lossy(), "--out", &out.to_string_lossy(), "--quiet"]);
    let summary = Summary::read(&out.join("summary.json")).ok();
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned(), summary)
}

/// Restitution of a thousandth, and a dashpot that stops everything: 1 m/s became 30 m/s.
#[test]
fn strong_damping_makes_no_energy() {
    let tsuji = serde_json::json!({ "tsuji": { "restitution": 0.001 } });
    let visco = serde_json::json!({ "visco_elastic": { "dissipative_time_s": 0.01 } });
    for (name, law, numerics) in [
        ("tsuji", tsuji, serde_json::json!({ "steps_per_contact": 10 })),
        ("visco_elastic", visco, serde_json::json!({})),
    ] {
        let (code, error, summary) = run(name, &collision(&law, &numerics));
        assert_eq!(code, Some(0), "{error}");
        let summary = summary.expect("a summary");
        let part = summary.dry().expect("a part of dry grains");
        // The restitution asked for at most, and books within what `no_energy_is_made` allows a collision.
        assert!(part.grains.max_speed_m_per_s < 0.04, "{name}: {}", part.grains.max_speed_m_per_s);
        assert!(part.energy_residual.abs() < 0.008, "{name}: {}", part.energy_residual);
    }
}

/// A restitution of 1e-100 needs steps of 1e-45 s: refused, not computed.
#[test]
fn tiny_restitution_is_refused() {
    let law = serde_json::json!({ "tsuji": { "restitution": 1e-100 } });
    let (code, error, summary) = run("tiny", &collision(&law, &serde_json::json!({})));
    assert!(code == Some(2) && summary.is_none() && error.contains("allowed: "), "{code:?} {error}");
}

/// A step beyond the limit is refused with one that would do, and that one runs.
#[test]
fn an_unstable_step_is_refused_with_one_that_does() {
    let law = serde_json::json!({ "tsuji": { "restitution": 0.001 } });
    let (code, error, _) = run("given", &collision(&law, &serde_json::json!({ "time_step_s": 2e-5 })));
    assert_eq!(code, Some(2), "{error}");
    assert!(error.contains("`grains.numerics.time_step_s`") && error.contains("make energy"), "{error}");
    let advised = error.split("take ").nth(1).and_then(|rest| rest.split(' ').next()).expect("a step");
    let step: f64 = advised.parse().expect("a number");
    let (code, error, _) = run("taken", &collision(&law, &serde_json::json!({ "time_step_s": step })));
    assert_eq!(code, Some(0), "{error}");
}

/// Impacts four orders of magnitude faster than the design speed: the dashpot of the visco-elastic law, which grows with the
/// overlap, makes energy at a step that was stable at that speed. The run stops, with what it has.
#[test]
fn open_books_stop_a_run() {
    let law = serde_json::json!({ "visco_elastic": { "dissipative_time_s": 0.01 } });
    let numerics = serde_json::json!({ "design_speed_m_per_s": 1e-4 });
    let (code, error, summary) = run("open", &collision(&law, &numerics));
    assert_eq!(code, Some(3), "{error}");
    let summary = summary.expect("a summary");
    assert!(summary.ended == Ended::Stopped && summary.steps > 0, "{summary:?}");
    for word in ["no force explains", "set `a`", "turned over", "design_speed"] {
        assert!(error.contains(word), "{word}: {error}");
    }
}

/// A pile at rest turns next to nothing over: rounding does not stop it.
#[test]
fn books_of_a_rest_are_closed() {
    let mut scene = collision(
        &serde_json::json!({ "tsuji": { "restitution": 0.3 } }),
        &serde_json::json!({ "design_speed_m_per_s": 0.01 }),
    );
    scene["gravity"] = serde_json::json!({ "magnitude_m_per_s2": 9.81, "direction": [0, 0, -1] });
    scene["domain"]["size_m"][2] = 1000.0.into();
    scene["grains"]["sets"][0]["place"] = serde_json::json!({ "list": [
        { "position_m": [0.02, 0.05, 0.005], "radius_m": 0.005 }, { "position_m": [0.08, 0.05, 0.0048], "radius_m": 0.0048 } ] });
    scene["stop"]["end_time_s"] = 0.2.into();
    let (code, error, _) = run("rest", &scene);
    assert_eq!(code, Some(0), "{error}");
}

/// A column that falls over until it is faster than a low limit: both backends stop in the same cell, with books that say the
/// same, and to rounding.
#[test]
fn parity_of_a_stopped_run() {
    for force in [[0.0, 0.0, -4e-4], [2e-4, 0.0, -4e-4]] {
        let mut setup = Setup::periodic([20, 4, 12], Law::Bingham { sigma0: 1e-5, mu: 0.05 });
        setup.faces = [[Face::NoSlip; 2], [Face::Periodic; 2], [Face::NoSlip; 2]];
        setup.force = BodyForce::Constant(force);
        let fill = |cell: usize| {
            let [i, _, k] = setup.coordinates(cell);
            if i < 8 && k < 9 { 1.0 } else { 0.0 }
        };
        setup.free_surface = Some(FreeSurface::new((0..setup.cells()).map(fill).collect()));
        setup.speed_limit = 0.015;
        let stopped = |backend: &dyn Backend| {
            let mut run = backend.start(&setup).unwrap_or_else(|error| panic!("{error}"));
            let stopped = run.advance(2000).expect_err("too fast");
            (stopped, run.ledger().expect("a ledger"), run.fingerprint())
        };
        let (plain, fast) = (stopped(&Plain), stopped(&Fast::default()));
        assert!(
            matches!(plain.0.what, Runaway::TooFast { limit: 0.015, .. }) && plain.0.step > 5,
            "{plain:?}"
        );
        assert_eq!(plain, fast);
        // Momenta of 1e-3 to 1e-2 in a thousand cells, as many roundings of 1e-16 per step as steps.
        assert!(plain.1.momentum_residual < 1e-12, "{}", plain.1.momentum_residual);
    }
}

/// The largest step of a set-up without a given one is that of its contacts, whatever their damping.
#[test]
fn library_runs_take_stable_steps_too() {
    let material = Material { name: "m".into(), density_kg_m3: 2500.0, young_pa: 1e7, poisson: 0.25 };
    let pair = |restitution| PairProperties {
        normal: NormalLaw::Tsuji { restitution },
        ..PairProperties::default()
    };
    let step = |restitution| {
        let mut setup = lahar::dem::Setup::new(Materials::single(material.clone(), pair(restitution)));
        setup.grains = vec![Grain::sphere(0.005, lahar::dem::V3::zeros(), 0)];
        lahar::dem::Dem::new(&setup).unwrap_or_else(|error| panic!("{error}")).time_step()
    };
    assert_eq!(step(0.9), step(0.5));
    assert!(step(1e-3) < 0.1 * step(0.5));
}
