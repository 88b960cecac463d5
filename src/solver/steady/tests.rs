//! Series that must not count as steady, each of which the old check (residual between two checks) took for it, and
//! series that must.

use super::{SteadyOutcome, Watch, residual};
use crate::solver::run::Fields;

const TOLERANCE: f64 = 1e-6;
const LAST: u64 = 4000;

/// Two cells: u along x of both as a function of the step.
type Series = dyn Fn(u64) -> [f64; 2];

fn fields(series: &Series, step: u64) -> Fields {
    let mut fields = Fields::empty(2);
    for (u, x) in fields.velocity.iter_mut().zip(series(step)) {
        u[0] = x;
    }
    fields
}

/// The new check every `interval` steps.
fn watched(series: &Series, interval: f64, push: f64) -> SteadyOutcome {
    let mut watch = Watch::new(TOLERANCE, interval, 0, LAST);
    loop {
        let due = watch.next();
        assert!(due <= LAST);
        if watch.look(due, &fields(series, due), push) || due == LAST {
            return watch.outcome();
        }
    }
}

/// The old check: when it called the series steady.
fn old(series: &Series, interval: u64) -> Option<u64> {
    let step = |k: u64| fields(series, k * interval).velocity;
    (1..=LAST / interval).find(|&k| residual(&step(k - 1), &step(k)) <= TOLERANCE).map(|k| k * interval)
}

/// A cell that alternates about its mean with a period of 2, 3, 4, 5, 7 or 20 steps while the other decays quickly.
#[test]
fn exact_cycles_are_not_steady() {
    for period in [2, 3, 4, 5, 7, 20] {
        let series = move |step: u64| {
            let turn = std::f64::consts::TAU * (step % period) as f64 / period as f64;
            [1.0 + libm::exp(-0.1 * step as f64), 1.0 + 0.03 * libm::cos(turn)]
        };
        let interval = 2 * period * 10;
        assert!(old(&series, interval).is_some_and(|step| step < 1000), "the old check sees period {period}");
        let found = watched(&series, interval as f64, 0.0);
        assert!(!found.steady && found.steps == LAST, "period {period}: {found}");
        let swing = found.swing.unwrap();
        assert!((0.03..0.061).contains(&swing), "period {period}: {swing}");
    }
}

/// The end says that it alternates, and by how much.
#[test]
fn exact_alternation_is_told() {
    for (period, told) in [(2, true), (3, true), (4, true), (6, true), (400, false)] {
        let series = move |step: u64| {
            let turn = std::f64::consts::TAU * (step % period) as f64 / period as f64;
            [1.0, 1.0 + 0.03 * libm::cos(turn)]
        };
        // Checks that fall on any part of the cycle, and that fall on the same.
        for interval in [35.0, 2400.0] {
            let found = watched(&series, interval, 0.0);
            assert_eq!((found.steady, found.alternates), (false, told), "period {period}: {found}");
            assert_eq!(found.to_string().contains("alternates by"), told, "{found}");
        }
    }
}

/// Memory of 1e5 steps, checks 100 apart: 1e-6 of change between checks when 1e-3 is still to come.
#[test]
fn exact_slow_relaxation_is_not_steady() {
    let series = |step: u64| [1.0, 1.0 - 1e-3 * libm::exp(-1e-5 * step as f64)];
    assert_eq!(old(&series, 100), Some(100));
    let found = watched(&series, 100.0, 0.0);
    assert!(!found.steady && found.residual <= TOLERANCE);
    // 1e-3 e^(−0.04) are left; the ratio of single precision differences is good to a few per cent.
    assert!((found.remaining / 9.6e-4 - 1.0).abs() < 0.05, "{found:?}");
}

/// Linear growth has no end, however slow.
#[test]
fn exact_growth_is_not_steady() {
    let series = |step: u64| [1.0, 0.5 + 1e-9 * step as f64];
    assert!(old(&series, 100).is_some());
    let found = watched(&series, 100.0, 0.0);
    assert!(!found.steady && found.remaining > 1e-4, "{found:?}");
}

/// A momentum that grows by a thousandth of the force, hidden from the ratio of changes by two cells that swap speed.
#[test]
fn exact_momentum_is_bounded_by_the_force() {
    // Checks see ±4e-7 in turn, r < 0, and a mean that grows by 1e-9 per step.
    let series = |step: u64| {
        let swap = if (step / 100).is_multiple_of(2) { 2e-7 } else { -2e-7 };
        [1.0 + swap + 1e-9 * step as f64, 1.0 - swap + 1e-9 * step as f64]
    };
    assert!(old(&series, 100).is_some());
    assert!(watched(&series, 100.0, 0.0).steady);
    // 2e-9 of momentum per step of a force of 2e-6 is a thousandth; 1e-6 is allowed.
    let found = watched(&series, 100.0, 2e-6);
    assert!(!found.steady && (found.imbalance / 1e3 - 1.0).abs() < 0.01, "{found:?}");
    assert!(found.to_string().contains("momentum"));
}

/// A fluid at rest is steady at the second check, under a force that its yield stress carries too.
#[test]
fn exact_rest_is_steady() {
    for push in [0.0, 1.0] {
        let found = watched(&|_| [0.0, 0.0], 100.0, push);
        assert!(found.steady && found.steps == 200 && found.residual == 0.0, "{found:?}");
    }
}

/// A relaxation that ends does become steady, with what the tolerance says left.
#[test]
fn exact_relaxation_becomes_steady() {
    for (memory, interval) in [(20.0, 100.0), (100.0, 100.0), (200.0, 20.5)] {
        let left = move |step: u64| 0.5 * libm::exp(-(step as f64) / memory);
        let series = move |step: u64| [1.0, 1.0 - left(step)];
        // Force and volume that bring the flow to 1 in one memory.
        let found = watched(&series, interval, 2.0 / memory);
        assert!(found.steady && left(found.steps) <= TOLERANCE, "{memory}: {found:?}");
        // Two checks more than it takes, and a few for the stricter of the bounds.
        let needed = memory * libm::log(0.5 / TOLERANCE);
        assert!((found.steps as f64) < needed + 4.0 * interval + 3.0 * memory, "{memory}: {found:?}");
    }
}

/// Rounding that never stops does not keep a flow from being steady.
#[test]
fn exact_noise_is_steady() {
    let series = |step: u64| {
        let noise = (step.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 40) as f64 / (1_u64 << 24) as f64;
        [1.0, 1.0 + 1e-13 * noise]
    };
    assert!(watched(&series, 100.0, 0.0).steady);
}

/// Intervals shorter than the window, and attempts shorter than it, end where they shall.
#[test]
fn exact_short_attempts_end() {
    for (interval, last) in [(1.0, 40), (3.0, 12), (50.0, 13), (100.0, 50), (0.2, 1)] {
        let mut watch = Watch::new(TOLERANCE, interval, 7, 7 + last);
        let mut now = 7;
        watch.look(now, &fields(&|step| [step as f64, 1.0], now), 0.0);
        while now < 7 + last {
            let due = watch.next();
            assert!(due > now && due <= 7 + last, "{due} after {now}");
            now = due;
            assert!(!watch.look(now, &fields(&|step| [step as f64, 1.0], now), 0.0));
        }
        assert_eq!(watch.outcome().steps, last);
    }
}
