//! `REPORT.md` and its figures are the ones the golden files give.

use lahar_verification::report::{ReportOutcome, command};

#[test]
fn regress_report_is_current() {
    let root = lahar_verification::golden::package_root();
    match command(&root, true).unwrap() {
        ReportOutcome::Current => {}
        outcome => panic!("{outcome:?}\nrun `cargo run --release --bin report` and look at what changed"),
    }
}
