//! A free-surface run is the same to the last bit on any number of threads.

use lahar::rheology::Law;
use lahar::setup::{BodyForce, Face, FreeSurface, Setup, SurfaceForce};
use lahar::solver::plain::Plain;
use lahar::solver::run::Backend;

/// A corner column of Bingham fluid that collapses; more cells than one chunk of work.
fn collapse(threads: usize, force: SurfaceForce) -> Setup {
    let mut setup = Setup::periodic([32, 12, 20], Law::Bingham { sigma0: 1e-5, mu: 0.05 });
    setup.faces = [[Face::NoSlip; 2]; 3];
    setup.force = BodyForce::Constant([0.0, 0.0, -4e-5]);
    let fill = |cell| match setup.coordinates(cell) {
        [i, j, k] if i < 12 && j < 8 && k < 14 => 1.0,
        _ => 0.0,
    };
    let fill = (0..setup.cells()).map(fill).collect();
    setup.free_surface = Some(FreeSurface { force, ..FreeSurface::new(fill) });
    setup.threads = threads;
    setup
}

#[test]
fn exact_fingerprint_on_any_number_of_threads() {
    for force in [SurfaceForce::ByFill, SurfaceForce::ByFillAndInertia] {
        let fingerprints = [1, 2, 3].map(|threads| {
            let mut run = Plain.start(&collapse(threads, force)).unwrap();
            run.advance(150).unwrap();
            let ledger = run.ledger().unwrap();
            assert!(ledger.conversions > 100, "nothing happens: {ledger:?}");
            (run.fingerprint(), ledger)
        });
        assert_eq!(fingerprints[0], fingerprints[1]);
        assert_eq!(fingerprints[0], fingerprints[2]);
    }
}
