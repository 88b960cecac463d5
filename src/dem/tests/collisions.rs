use super::help::*;
use crate::dem::contact::restitution::{self, cut_off, hertz_contact_time, hertz_largest_overlap};
use crate::dem::*;

/// reference_values.json hertz_example_glass_5mm: δ = 10.45781 µm, t_c = 30.78022 µs. With 2000 steps per contact
/// the duration is known to one step (5e-4), the overlap to (π/2000)²/8.
#[test]
fn exact_hertz_contact() {
    let mut s = head_on(setup(glass(), elastic()), 5e-3, 1.0);
    s.steps_per_contact = 2000.0;
    let (e, t, depth) = bounce(&s);
    assert!((e - 1.0).abs() < 1e-6, "{e}");
    assert!((t / 3.078022098e-5 - 1.0).abs() < 1e-3, "{t}");
    assert!((depth / 1.045781283e-5 - 1.0).abs() < 1e-5, "{depth}");
    let m = 0.5 * 2650.0 * 4.0 / 3.0 * std::f64::consts::PI * 125e-9;
    let young = 70e9 / 2.0 / (1.0 - 0.22 * 0.22);
    assert!((hertz_contact_time(m, young, 2.5e-3, 1.0) / 3.078022098e-5 - 1.0).abs() < 1e-9);
    assert!((hertz_largest_overlap(m, young, 2.5e-3, 1.0) / 1.045781283e-5 - 1.0).abs() < 1e-9);
}

/// Visco-elastic: A chosen so that the dimensionless damping A (k/m)^{2/5} v^{1/5} has the reference's value.
/// Second order: 4000 steps leave about 1e-6; the reference has 7 digits. H15.
#[test]
fn reference_restitution_viscoelastic() {
    for (a, cut) in [(0.05, 0.918132856), (0.2, 0.72208544), (0.11, restitution::visco_elastic(0.11, 4000).0)]
    {
        let (r, v) = (5e-3, 0.7);
        let m = 0.5 * 2650.0 * 4.0 / 3.0 * std::f64::consts::PI * r * r * r;
        let k = 4.0 / 3.0 * 7e6 / 2.0 / (1.0 - 0.22 * 0.22) * (0.5 * r).sqrt();
        let time_s = a / libm::pow(k / m, 0.4) / libm::pow(v, 0.2);
        let mut s = head_on(
            setup(soft(), PairProperties { normal: NormalLaw::ViscoElastic { time_s }, ..elastic() }),
            r,
            v,
        );
        s.steps_per_contact = 4000.0;
        let (e, ..) = bounce(&s);
        assert!((e - cut).abs() < 1e-5, "{a}: {e} {cut}");
    }
}

/// Tsuji: restitution as in the closed form, the same at speeds that differ a hundredfold.
#[test]
fn reference_restitution_tsuji() {
    for (alpha, cut) in [(0.1, 0.872291467), (0.6, 0.484938946), (1.7, cut_off(1.7 / 5f64.sqrt()))] {
        for v in [0.05, 5.0] {
            let normal = NormalLaw::TsujiAlpha { alpha };
            let mut s = head_on(setup(glass(), PairProperties { normal, ..elastic() }), 5e-3, v);
            s.steps_per_contact = 4000.0;
            let (e, ..) = bounce(&s);
            assert!((e - cut).abs() < 2e-5, "{alpha} {v}: {e} {cut}");
        }
    }
}

/// The restitution asked for is the one obtained, Tsuji and linear.
#[test]
fn exact_linear_restitution() {
    for e in [0.95, 0.5, 0.2] {
        let linear = NormalLaw::Linear { stiffness_n_m: 1e5, restitution: e, tangential_ratio: 2.0 / 7.0 };
        for normal in [linear, NormalLaw::Tsuji { restitution: e }] {
            let mut s = head_on(setup(soft(), PairProperties { normal, ..elastic() }), 5e-3, 0.3);
            s.steps_per_contact = 2000.0;
            let (found, ..) = bounce(&s);
            // A linear dashpot acts at once: the first and last partial steps count to first order.
            assert!((found - e).abs() < 2e-3, "{e} {found} {normal:?}");
        }
    }
}

/// Force never attracts: watched at every step of a strongly damped bounce.
#[test]
fn limit_no_attraction() {
    let normal = NormalLaw::TsujiAlpha { alpha: 1.5 };
    let s = head_on(setup(soft(), PairProperties { normal, ..elastic() }), 5e-3, 1.0);
    let mut d = Dem::new(&s).unwrap();
    let mut cut = 0;
    while d.steps() < 3 || d.pair_counts().1 > 0 {
        d.step(1).unwrap();
        for c in d.contacts() {
            assert!(c.force.dot(&c.normal) >= 0.0);
            cut += u32::from(c.force.norm() == 0.0);
        }
    }
    assert!(cut > 0, "the cut-off was never needed");
}

/// Observed order of velocity Verlet on a smooth path: two spheres stay in contact, an oscillation about the
/// equilibrium of a stack is smooth.
#[test]
fn order_verlet_smooth() {
    let run = |n: u64| {
        let mut s = setup(soft(), elastic());
        s.walls = vec![floor()];
        s.gravity = V3::z() * -9.81;
        s.grains = vec![Grain::sphere(5e-3, V3::z() * (5e-3 - 6e-6), 0)];
        s.start_overlap = 0.01;
        s.time_step_s = Some(4e-3 / n as f64);
        let mut d = Dem::new(&s).unwrap();
        d.step(n).unwrap();
        d.bodies().position[0].z
    };
    let (a, b, c) = (run(200), run(400), run(800));
    let order = libm::log2((a - b) / (b - c));
    assert!((1.9..2.1).contains(&order), "{order}");
}

/// Newton's cradle with a touching chain: linear contacts pass nearly all momentum on only if separated; here the
/// balls are apart by a hair, so collisions are binary and the last ball leaves with the first one's speed.
#[test]
fn exact_newtons_cradle() {
    let (r, n) = (5e-3, 5);
    let mut s = setup(glass(), elastic());
    s.grains =
        (0..n).map(|i| Grain::sphere(r, V3::x() * (2.0 * r * i as f64 + 2e-5 * i as f64), 0)).collect();
    s.grains[0].velocity = V3::x();
    s.steps_per_contact = 200.0;
    let mut d = Dem::new(&s).unwrap();
    while d.bodies().velocity[n - 1].x < 0.5 || d.pair_counts().1 > 0 {
        d.step(1).unwrap();
        assert!(d.time() < 1e-3);
    }
    for i in 0..n - 1 {
        // Energy error of 200 steps per contact, four collisions.
        assert!(d.bodies().velocity[i].norm() < 1e-4);
    }
    assert!((d.bodies().velocity[n - 1].x - 1.0).abs() < 1e-4);
}
