//! The gate: every claim on its short ladder against its tolerance and its golden record, every
//! mutant caught, every declaration sound. One test per claim and mutant.

use std::collections::BTreeSet;
use std::process::ExitCode;

use lahar::solver::choose::Best;
use lahar::solver::plain::Plain;
use lahar::solver::run::Backend;
use lahar_verification::claim::Claim;
use lahar_verification::claims::studies;
use lahar_verification::evaluate::{Outcome, judge, rung};
use lahar_verification::golden::{Golden, compare};
use lahar_verification::ladder::{Depth, faults};
use lahar_verification::mutant::{self, Mutant};
use lahar_verification::record::Verdict;
use lahar_verification::study::Study;
use libtest_mimic::{Arguments, Failed, Trial};

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    let mut trials = vec![Trial::test("declarations", declarations)];
    for study in studies() {
        for claim in study.claims {
            trials.push(Trial::test(format!("{}::{}", study.id, claim.id), || holds(study, claim)));
        }
        for mutant in study.mutants {
            let name = format!("{}::mutant::{}", study.id, mutant.id);
            trials.push(Trial::test(name, || caught(mutant)));
        }
    }
    libtest_mimic::run(&arguments, trials).exit_code()
}

/// Ids are unique, and every declaration says what it must.
fn declarations() -> Result<(), Failed> {
    let mut problems = Vec::new();
    let mut ids = BTreeSet::new();
    for study in studies() {
        let claims = study.claims.iter().map(|c| c.id);
        let exhibits = study.exhibits.iter().map(|e| e.id);
        for id in claims.chain(exhibits).chain(study.mutants.iter().map(|m| m.id)) {
            if !ids.insert(id) {
                problems.push(format!("`{id}` is declared twice"));
            }
        }
        problems.extend(study.claims.iter().flat_map(faults));
        for m in study.mutants {
            if find(m.caught_by).is_none() {
                problems.push(format!("mutant `{}`: there is no claim `{}`", m.id, m.caught_by));
            }
        }
    }
    if problems.is_empty() { Ok(()) } else { Err(problems.join("\n").into()) }
}

fn find(claim: &str) -> Option<&'static Claim> {
    studies().iter().flat_map(|s| s.claims).find(|c| c.id == claim)
}

/// The short ladder, its last rung, which takes longest, by the fast backend and all before by the plain one: the
/// golden record is one for both, to the last bit.
fn outcomes(claim: &Claim) -> Vec<Outcome> {
    let rungs = claim.ladder.rungs(Depth::Short);
    let backend = |k: usize| -> &dyn Backend { if k + 1 == rungs.len() { &Best } else { &Plain } };
    rungs.iter().enumerate().map(|(k, &parameter)| rung(claim, backend(k), parameter)).collect()
}

/// The claim passes, and its samples are the golden ones.
fn holds(study: &Study, claim: &Claim) -> Result<(), Failed> {
    let record = judge(claim, &outcomes(claim));
    if let Verdict::Fail { reasons } = &record.verdict {
        return Err(reasons.join("\n").into());
    }
    let again = format!(
        "cargo run --release --bin study-{} -- --full --only {} --bless \"REASON\"",
        study.id, claim.id
    );
    let Some(golden) = Golden::here().record(claim.id).map_err(|e| e.to_string())? else {
        return Err(format!("no golden record; make one with\n    {again}").into());
    };
    let differences = compare(&record, &golden, study.agreement);
    if differences.is_empty() {
        return Ok(());
    }
    let lines: Vec<String> = differences.iter().map(ToString::to_string).collect();
    Err(format!("{}\nif this change is meant:\n    {again}", lines.join("\n")).into())
}

fn caught(m: &Mutant) -> Result<(), Failed> {
    let claim = find(m.caught_by).ok_or_else(|| format!("there is no claim `{}`", m.caught_by))?;
    // The control, the honest claim, is a test of its own in this gate.
    let record = mutant::uncontrolled(m, claim, &Plain);
    if record.caught { Ok(()) } else { Err(record.how.into()) }
}
