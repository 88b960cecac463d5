//! A run on the plain backend against the same on every variant of the fast one.

#![allow(dead_code, reason = "each test file uses part of it")]

use lahar::setup::Setup;
use lahar::solver::fast::Fast;
use lahar::solver::fast::instructions::Instructions;
use lahar::solver::plain::Plain;
use lahar::solver::run::{Backend, Run, Runaway};

/// Compares two runs after the same calls.
pub fn differences(plain: &dyn Run, fast: &dyn Run) -> Vec<&'static str> {
    let checks = [
        ("fingerprint", plain.fingerprint() == fast.fingerprint()),
        ("fields", plain.fields() == fast.fields()),
        ("ledger", plain.ledger() == fast.ledger()),
        ("loads", plain.loads() == fast.loads()),
        ("cells", plain.fluid_cells() == fast.fluid_cells()),
    ];
    checks.iter().filter(|(_, same)| !same).map(|&(what, _)| what).collect()
}

/// Runs a set-up on the plain backend and on every variant of the fast one.
pub fn compare(name: &str, setup: &Setup, steps: u64, variants: &[(Instructions, usize)]) {
    compare_to(&Plain, name, setup, steps, variants);
}

/// Runs a set-up on a reference and on every variant of the fast backend.
pub fn compare_to(
    reference: &dyn Backend,
    name: &str,
    setup: &Setup,
    steps: u64,
    variants: &[(Instructions, usize)],
) {
    let mut plain = reference.start(setup).unwrap_or_else(|error| panic!("{name}: {error}"));
    let ended = plain.advance(steps);
    // Whatever else a random flow may do, its mass is accounted for.
    let leaks = ended.as_ref().is_err_and(|stopped| matches!(stopped.what, Runaway::Ledger { .. }));
    assert!(!leaks, "{name}: {ended:?}");
    for &(instructions, threads) in variants {
        let setup = Setup { threads, ..setup.clone() };
        let fast = Fast { instructions: Some(instructions) };
        let mut fast = fast.start(&setup).unwrap_or_else(|error| panic!("{name}: {error}"));
        // In two calls: a run does not depend on how its steps are asked for.
        let half = steps / 2;
        let end = fast.advance(half).and_then(|()| fast.advance(steps - half));
        let variant = format!("{name}, {}, {threads} threads", instructions.name());
        assert_eq!(format!("{ended:?}"), format!("{end:?}"), "{variant}: end of the run");
        assert_eq!(differences(&*plain, &*fast), Vec::<&str>::new(), "{variant}");
    }
}

pub fn variants() -> Vec<(Instructions, usize)> {
    Instructions::available().into_iter().flat_map(|set| [(set, 1), (set, 2)]).collect()
}

/// A repeatable number in 0..1 from a cell and a seed.
pub fn noise(cell: usize, seed: u64) -> f64 {
    let mixed = (cell as u64).wrapping_add(seed).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mixed = (mixed ^ (mixed >> 31)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (mixed >> 40) as f64 / (1_u64 << 24) as f64
}
