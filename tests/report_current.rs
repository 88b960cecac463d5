//! `REPORT.md` and its figures are the ones the golden files give.

use lahar::report::{ReportOutcome, command};

#[test]
fn regress_report_is_current() {
    let root = lahar::verify::golden::package_root();
    match command(&root, true).unwrap() {
        ReportOutcome::Current => {}
        outcome => panic!("{outcome:?}\nrun `lahar report` and look at what changed"),
    }
}
