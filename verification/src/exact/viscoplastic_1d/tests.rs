use super::*;
use crate::exact::norms::relative_l2;
use crate::exact::poiseuille::Channel;
use crate::exact::poiseuille_clamped::Trilinear;
use crate::exact::start_up::{CouetteStartUp, NewtonianStartUp, bingham_stopping_bound};
use lahar::rheology::Law;

const BINGHAM: Law = Law::Bingham { sigma0: 0.5, mu: 0.2 };
const HB: Law = Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n: 0.33 };

fn half_channel(law: Law, cells: usize) -> Flow1d<Law> {
    let (lower, scheme) = (LowerEnd::Symmetry, Scheme::Sdirk2);
    Flow1d { law, density: 1.0, length: 1.0, cells, lower, wall_speed: 0.0, scheme }
}

fn nodes(cells: usize) -> impl Iterator<Item = f64> {
    (0..=cells).map(move |i| i as f64 / cells as f64)
}

fn run(flow: &Flow1d<Law>, steps: usize, until: f64) -> Profile {
    let mut now = flow.at_rest().unwrap();
    for _ in 0..steps {
        now = flow.step(&now, until / steps as f64, &|_| 1.0).unwrap();
    }
    now
}

#[test]
fn newtonian_start_up_follows_its_series_at_second_order() {
    let exact = NewtonianStartUp { mu: 0.2, density: 1.0, half_width: 1.0, force: 1.0 };
    let error = |cells: usize| {
        let now = run(&half_channel(Law::Newtonian { mu: 0.2 }, cells), cells, 1.0);
        let reference: Vec<f64> = nodes(cells).map(|y| exact.velocity(y, 1.0)).collect();
        relative_l2(&now.velocity, &reference)
    };
    let (coarse, fine) = (error(40), error(80));
    let order = libm::log2(coarse / fine);
    // Two refinements together: order 2 in Δy and Δt.
    assert!((order - 2.0).abs() < 0.1 && fine < 1e-4, "{order} {fine:e}");
}

#[test]
fn couette_start_up_follows_its_series() {
    let flow =
        Flow1d { lower: LowerEnd::Wall, wall_speed: 0.7, ..half_channel(Law::Newtonian { mu: 0.2 }, 100) };
    let exact = CouetteStartUp { nu: 0.2, gap: 1.0, wall_speed: 0.7 };
    let rest = flow.at_rest().unwrap();
    let out = flow.profiles(&rest, &[0.3, 1.0], 1e-5, 0.01, &|_| 0.0).unwrap();
    for profile in &out {
        let reference: Vec<f64> = nodes(100).map(|y| exact.velocity(y, profile.time)).collect();
        let error = relative_l2(&profile.velocity, &reference);
        // Δy²/12 and (Δt π²ν)²-like constants: 1e-4 each.
        assert!(error < 2e-4, "{} {error:e}", profile.time);
    }
}

#[test]
fn long_runs_reach_the_exact_steady_state_with_a_rigid_plug() {
    for (law, until) in [
        (BINGHAM, 40.0),
        (HB, 400.0),
        (Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n: 0.1 }, 1e6),
        (Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n: 2.0 }, 40.0),
        (Law::PowerLaw { k: 0.2, n: 0.5 }, 400.0),
        (Law::Papanastasiou { sigma0: 0.5, k: 0.2, n: 1.0, m: 100.0 }, 40.0),
    ] {
        let flow = half_channel(law, 200);
        let rest = flow.at_rest().unwrap();
        let out = flow.profiles(&rest, &[until], 1e-4, until / 20.0, &|_| 1.0).unwrap();
        let end = &out[0];
        let steady = flow.steady_half_channel(1.0).unwrap();
        // What is left of the slowest mode, e^{−μ(π/2h)²t} < 1e-6, and rounding through R.
        assert!(relative_l2(&end.velocity, &steady.velocity) < 1e-6, "{law:?}");
        let exact = Channel { law, half_width: 1.0, force: 1.0 };
        let reference: Vec<f64> = nodes(200).map(|y| exact.velocity(y)).collect();
        // Mid-point rule for ∫R: Δy²/24 of R″/u, largest (1e2) for n = 0.1; at n = 2 the square root
        // at the yield surface gives Δy^{3/2}.
        let error = relative_l2(&end.velocity, &reference);
        assert!(error < 1e-3, "{law:?} {error:e}");
        if exact.plug_half_width() > 0.4 {
            assert!(end.velocity[..100].windows(2).all(|w| w[0] == w[1]), "{law:?}");
        }
    }
}

#[test]
fn bingham_start_up_converges_at_second_order_in_time() {
    let flow = half_channel(BINGHAM, 100);
    let fine = run(&flow, 1600, 0.8);
    let error = |steps: usize| relative_l2(&run(&flow, steps, 0.8).velocity, &fine.velocity);
    let order = libm::log2(error(50) / error(200)) / 2.0;
    // The moving yield surface is not smooth; the jump of the force at t = 0 is on a step's end.
    assert!(order > 1.5, "{order} {:e}", error(50));
    let euler = Flow1d { scheme: Scheme::BackwardEuler, ..flow };
    let first = relative_l2(&run(&euler, 50, 0.8).velocity, &fine.velocity);
    assert!(first > error(50) && first < 0.05, "{first}");
}

/// Small steps on a fine grid, where a yield surface moves little per step, once defeated Newton's
/// method for n = 2: the slope of the rate is infinite at yield.
#[test]
fn shear_thickening_start_up_in_small_steps() {
    let law = Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n: 2.0 };
    let (coarse, fine) = (run(&half_channel(law, 100), 100, 0.8), run(&half_channel(law, 400), 1600, 0.8));
    // Δy^{3/2} of the square root at the yield surface.
    assert!((coarse.velocity[0] / fine.velocity[0] - 1.0).abs() < 1e-3);
    let power = run(&half_channel(Law::PowerLaw { k: 0.2, n: 2.0 }, 100), 400, 0.8);
    assert!(power.velocity.windows(2).all(|w| w[0] >= w[1]));
}

#[test]
fn momentum_balance_of_a_step() {
    let flow = Flow1d { scheme: Scheme::BackwardEuler, ..half_channel(HB, 80) };
    let before = run(&flow, 20, 0.1);
    let after = flow.step(&before, 0.004, &|_| 1.0).unwrap();
    let gain = (after.flux() - before.flux()) / 0.004;
    let balance = 1.0 + after.wall_stress(1.0);
    // Exact for backward Euler up to the Newton iteration's 1e-10 of the stress.
    assert!((gain - balance).abs() < 1e-9, "{gain} {balance}");
}

#[test]
fn kinetic_energy_never_grows_without_force() {
    let flow = half_channel(HB, 80);
    let mut now = flow.steady_half_channel(1.0).unwrap();
    for _ in 0..50 {
        let next = flow.step(&now, 0.05, &|_| 0.0).unwrap();
        assert!(next.kinetic_energy_over_density() <= now.kinetic_energy_over_density());
        now = next;
    }
    assert_eq!(now.largest_velocity(), 0.0);
}

#[test]
fn stopping_time_is_finite_converges_and_keeps_its_bound() {
    // Case H14: G from 2σ0/h to σ0/2h.
    let time = |cells: usize, dt: f64| {
        let flow = half_channel(BINGHAM, cells);
        let steady = flow.steady_half_channel(1.0).unwrap();
        let norm = (2.0 * steady.kinetic_energy_over_density()).sqrt();
        (flow.stopping_time(&steady, 0.25, dt, 100.0).unwrap(), norm)
    };
    let ((coarse, _), (fine, norm)) = (time(100, 0.02), time(200, 0.005));
    let bound = bingham_stopping_bound(0.5, 0.2, 1.0, 1.0, 0.25, norm).unwrap();
    assert!(fine > 0.5 * bound && fine < bound, "{fine} {bound}");
    // First-order agreement of two resolutions.
    assert!((coarse / fine - 1.0).abs() < 0.01, "{coarse} {fine}");
    let newtonian = half_channel(Law::Newtonian { mu: 0.2 }, 50);
    let steady = newtonian.steady_half_channel(1.0).unwrap();
    assert!(matches!(newtonian.stopping_time(&steady, 0.0, 0.1, 2.0), Err(ExactError::StillMoving { .. })));
}

#[test]
fn limit_unyielded_fluid_does_not_move() {
    for law in [BINGHAM, HB] {
        let flow = half_channel(law, 50);
        let rest = flow.at_rest().unwrap();
        let next = flow.step(&rest, 0.1, &|_| 0.49).unwrap();
        assert_eq!(next.largest_velocity(), 0.0);
        let walls = Flow1d { lower: LowerEnd::Wall, ..flow };
        let next = walls.step(&walls.at_rest().unwrap(), 0.1, &|_| 0.9).unwrap();
        assert_eq!(next.largest_velocity(), 0.0);
    }
}

#[test]
fn clamped_law_tends_to_its_own_steady_state() {
    let law = Trilinear::new(HB, 0.01, 5.0).unwrap();
    let (lower, scheme) = (LowerEnd::Symmetry, Scheme::Sdirk2);
    let flow = Flow1d { law, density: 1.0, length: 1.0, cells: 200, lower, wall_speed: 0.0, scheme };
    let out = flow.profiles(&flow.at_rest().unwrap(), &[200.0], 1e-4, 5.0, &|_| 1.0).unwrap();
    let exact = Channel { law: flow.law.clone(), half_width: 1.0, force: 1.0 };
    let reference: Vec<f64> = nodes(200).map(|y| exact.velocity(y)).collect();
    // Mid-point rule, Δy²/24 R″/u.
    assert!(relative_l2(&out[0].velocity, &reference) < 1e-3);
}

#[test]
fn interpolates_between_nodes_and_mirrors() {
    let flow = half_channel(BINGHAM, 10);
    let steady = flow.steady_half_channel(1.0).unwrap();
    assert_eq!(steady.velocity_at(-0.7), steady.velocity_at(0.7));
    let middle = 0.5 * (steady.velocity[7] + steady.velocity[8]);
    // One rounding of the position.
    assert!((steady.velocity_at(0.75) - middle).abs() < 1e-15);
    assert_eq!(steady.velocity_at(1.0), 0.0);
}
