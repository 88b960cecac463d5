use super::help::*;
use crate::dem::*;

pub(crate) fn odd_clump() -> Clump {
    let s = |x: f64, y: f64, z: f64, radius: f64| Sphere { centre: V3::new(x, y, z), radius };
    Clump::new("odd", &[s(0.0, 0.0, 0.0, 1.0), s(1.2, 0.3, 0.1, 0.8), s(0.1, 1.3, -0.2, 0.6)]).unwrap()
}

pub(crate) fn spinning(spin: V3, dt: f64, integrator: Integrator) -> Setup {
    let mut s = setup(soft(), elastic());
    s.clumps = vec![odd_clump()];
    s.grains = vec![Grain::clump(0, 5e-3, V3::zeros(), Orientation::identity(), 0).spinning(spin)];
    s.time_step_s = Some(dt);
    s.integrator = integrator;
    s
}

/// H17 on 1e5 steps in Dem: |L|, energy to 1e-11, |q| = 1.
#[test]
fn conserves_clump_free() {
    for integrator in [Integrator::Verlet, Integrator::Gear] {
        let mut d = Dem::new(&spinning(V3::new(3.0, 100.0, -20.0), 1e-5, integrator)).unwrap();
        let (l0, e0) = (d.ledger().angular_momentum, d.kinetic_energy());
        d.step(100_000).unwrap();
        assert!((d.ledger().angular_momentum - l0).norm() < 1e-11 * l0.norm());
        assert!((d.kinetic_energy() / e0 - 1.0).abs() < 1e-11);
        assert!((d.bodies().orientation[0].norm() - 1.0).abs() < 1e-15);
    }
}

/// Complete elliptic integral of the first kind by the arithmetic–geometric mean, parameter m = k².
pub(crate) fn elliptic_k(m: f64) -> f64 {
    let (mut a, mut g) = (1.0, (1.0 - m).sqrt());
    while (a - g).abs() > 1e-15 * a {
        (a, g) = (0.5 * (a + g), (a * g).sqrt());
    }
    std::f64::consts::FRAC_PI_2 / a
}

/// Period of the components about the outer axes, T = 4 K(m)/λ (Landau & Lifshitz, Mechanics §37).
pub(crate) fn free_period(i: V3, w: V3) -> f64 {
    let l2 = (0..3).map(|k| i[k] * i[k] * w[k] * w[k]).sum::<f64>();
    let e2 = (0..3).map(|k| i[k] * w[k] * w[k]).sum::<f64>();
    // Ascending moments; the case L² > 2 E I₂ is written out, the other follows by swapping 1 and 3.
    let (i1, i2, i3) = if l2 > e2 * i.y { (i.x, i.y, i.z) } else { (i.z, i.y, i.x) };
    let m = (i2 - i1) * (e2 * i3 - l2) / ((i3 - i2) * (l2 - e2 * i1));
    let rate = ((i3 - i2) * (l2 - e2 * i1) / (i1 * i2 * i3)).sqrt();
    4.0 * elliptic_k(m) / rate
}

/// Intermediate-axis flips, timed over several periods. ω Δt = 5e-3: the midpoint rule's error is (ω Δt)²/12.
#[test]
fn exact_flip_period() {
    let w = V3::new(0.5, 100.0, 1.0);
    let mut d = Dem::new(&spinning(w, 5e-5, Integrator::Verlet)).unwrap();
    let exact = free_period(d.bodies().inertia[0], w);
    // The body-frame spin about the middle axis changes sign twice per period.
    let mut crossings = Vec::new();
    let mid = |d: &Dem| d.bodies().orientation[0].inverse_transform_vector(&d.bodies().spin[0]).y;
    let mut before = mid(&d);
    while crossings.len() < 5 {
        d.step(1).unwrap();
        let now = mid(&d);
        if now * before < 0.0 {
            crossings.push(d.time() - d.time_step() * now / (now - before));
        }
        before = now;
    }
    let period = 0.5 * (crossings[4] - crossings[0]);
    assert!((period / exact - 1.0).abs() < 1e-4, "{period} {exact}");
}

/// A clump of one sphere and a sphere must move alike: same bounces, same spin to round-off.
#[test]
fn limit_clump_of_one_sphere() {
    let run = |clump: bool| {
        let mut s = setup(soft(), PairProperties { friction: 0.4, ..PairProperties::default() });
        s.clumps = vec![Clump::new("one", &[Sphere { centre: V3::x(), radius: 2.0 }]).unwrap()];
        s.walls = vec![floor()];
        s.gravity = V3::z() * -9.81;
        let at = V3::z() * 6e-3;
        let g = if clump {
            Grain::clump(0, 5e-3, at, Orientation::identity(), 0)
        } else {
            Grain::sphere(5e-3, at, 0)
        };
        s.grains = vec![g.moving(V3::new(0.5, 0.2, -0.3)).spinning(V3::new(1.0, 5.0, 2.0))];
        let mut d = Dem::new(&s).unwrap();
        d.step(3000).unwrap();
        (d.bodies().position[0], d.bodies().spin[0])
    };
    let ((xa, wa), (xb, wb)) = (run(false), run(true));
    assert!((xa - xb).norm() < 1e-12 && (wa - wb).norm() < 1e-8 * wa.norm());
}

/// Inertia taken as a sum of overlapping spheres is caught by the closed form of two spheres.
#[test]
fn mutant_caught_sum_of_spheres() {
    let s = |x: f64| Sphere { centre: V3::x() * x, radius: 1.0 };
    let right = Clump::new("two", &[s(-0.5), s(0.5)]).unwrap();
    let sum = union_moments::sum_of_spheres(&[s(-0.5), s(0.5)]);
    let wrong = Clump::with_moments("two", &[s(-0.5), s(0.5)], &sum).unwrap();
    // V = 4π/3 · 2 − lens, lens of two unit spheres at distance 1: 5π/12.
    let exact = std::f64::consts::PI * (8.0 / 3.0 - 5.0 / 12.0);
    assert!((right.volume / exact - 1.0).abs() < 1e-12);
    assert!((wrong.volume / exact - 1.0).abs() > 0.1);
}
