//! Computes a study: rungs, exhibits and mutants, several at a time.

use std::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;

use super::{Options, Study};
use crate::claim::{Claim, VerifyError};
use crate::claims;
use crate::evaluate::{Outcome, judge, rung};
use crate::exhibit::{Exhibit, ExhibitRecord};
use crate::golden::circumstances;
use crate::mutant::{self, Detection, Mutant, MutantRecord};
use crate::record::Record;
use lahar::output::progress::Progress;
use lahar::solver::run::Backend;

/// What a study computed.
pub struct Results {
    /// Claims, with their records.
    pub records: Vec<(&'static Claim, Record)>,
    /// Exhibits, or why there is none.
    pub exhibits: Vec<(&'static Exhibit, Result<ExhibitRecord, VerifyError>)>,
    /// Mutants, with their records.
    pub mutants: Vec<(&'static Mutant, MutantRecord)>,
}

/// One independent piece of work.
#[derive(Clone, Copy)]
enum Job {
    Rung(&'static Claim, f64),
    Exhibit(&'static Exhibit),
    Mutant(&'static Mutant),
}

enum Done {
    Rung(&'static Claim, Outcome),
    Exhibit(&'static Exhibit, Result<ExhibitRecord, VerifyError>),
    Mutant(&'static Mutant, MutantRecord),
}

impl Results {
    /// Computes what the options select. The results do not depend on the number of threads.
    #[must_use]
    pub fn compute(study: &Study, backend: &dyn Backend, options: &Options) -> Self {
        let claims: Vec<&'static Claim> = study.claims.iter().filter(|c| options.selects(c.id)).collect();
        let (timed, untimed): (Vec<&Exhibit>, Vec<&Exhibit>) =
            study.exhibits.iter().filter(|e| options.selects(e.id)).partition(|e| e.timed);
        let mutants: Vec<&'static Mutant> = study.mutants.iter().filter(|m| options.selects(m.id)).collect();
        let mut jobs: Vec<Job> = rungs(study, &claims, &mutants, options);
        jobs.extend(untimed.into_iter().map(Job::Exhibit));
        jobs.extend(mutants.iter().copied().map(Job::Mutant));

        let total = jobs.len() + timed.len();
        let progress = Progress::new(study.id, total as u64, false);
        let finished = AtomicU64::new(0);
        let work = |job: &Job| {
            let done = run(study, backend, options.full, *job);
            let count = finished.fetch_add(1, Ordering::Relaxed) + 1;
            progress.set(count);
            progress.note(&format!("[{count}/{total}] {}", describe(&done)));
            done
        };
        let threads = options.threads.unwrap_or(0);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let mut done: Vec<Done> = match pool {
            // One job at a time per thread: rungs differ in cost by orders of magnitude.
            Ok(pool) => pool.install(|| jobs.par_iter().with_max_len(1).map(work).collect()),
            // No threads to be had: the same work, one after the other.
            Err(_) => jobs.iter().map(work).collect(),
        };
        done.extend(timed.into_iter().map(|e| work(&Job::Exhibit(e))));
        progress.finish();
        Self::gather(study, &claims, options, done)
    }

    fn gather(study: &Study, claims: &[&'static Claim], options: &Options, done: Vec<Done>) -> Self {
        let (mut outcomes, mut exhibits, mut mutants) = (Vec::new(), Vec::new(), Vec::new());
        for done in done {
            match done {
                Done::Rung(claim, outcome) => outcomes.push((claim.id, outcome)),
                Done::Exhibit(exhibit, record) => exhibits.push((exhibit, record)),
                Done::Mutant(mutant, record) => mutants.push((mutant, record)),
            }
        }
        let at = |claim: &Claim, rungs: &[f64]| -> Vec<Outcome> {
            let find = |p: &f64| outcomes.iter().find(|(id, o)| *id == claim.id && same(o.parameter, *p));
            rungs.iter().filter_map(find).map(|(_, o)| o.clone()).collect()
        };
        let judged =
            |&claim: &&'static Claim| (claim, judge(claim, &at(claim, claim.ladder.rungs(options.depth()))));
        let confirmed =
            |(mutant, record): (&'static Mutant, MutantRecord)| match find_claim(study, mutant.caught_by) {
                Some(claim) => {
                    let control = at(claim, &mutant::rungs(mutant, claim));
                    (mutant, mutant::confirm(record, mutant, claim, &control))
                }
                None => (mutant, record),
            };
        let records = claims.iter().map(judged).collect();
        let mutants = mutants.into_iter().map(confirmed).collect();
        Self { records, exhibits, mutants }
    }

    /// Whether every claim holds, every exhibit could be made and every mutant was caught.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.first_failure().is_none()
    }

    /// Id of the first claim, exhibit or mutant that is not as it should be.
    #[must_use]
    pub fn first_failure(&self) -> Option<&'static str> {
        let claim = self.records.iter().find(|(_, r)| !r.passed()).map(|(c, _)| c.id);
        let exhibit = self.exhibits.iter().find(|(_, e)| e.is_err()).map(|(e, _)| e.id);
        let mutant = self.mutants.iter().find(|(_, m)| !m.caught).map(|(m, _)| m.id);
        claim.or(exhibit).or(mutant)
    }
}

/// The rungs of the claims, and those at which the mutants' claims serve as control; each once.
fn rungs(
    study: &Study,
    claims: &[&'static Claim],
    mutants: &[&'static Mutant],
    options: &Options,
) -> Vec<Job> {
    let mut wanted: Vec<(&'static Claim, f64)> = Vec::new();
    let mut add = |claim: &'static Claim, rungs: &[f64]| {
        for &p in rungs {
            if !wanted.iter().any(|(c, q)| c.id == claim.id && same(*q, p)) {
                wanted.push((claim, p));
            }
        }
    };
    for claim in claims {
        add(claim, claim.ladder.rungs(options.depth()));
    }
    for mutant in mutants {
        if let Some(claim) = find_claim(study, mutant.caught_by) {
            add(claim, &mutant::rungs(mutant, claim));
        }
    }
    wanted.into_iter().map(|(claim, p)| Job::Rung(claim, p)).collect()
}

fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits()
}

fn run(study: &Study, backend: &dyn Backend, full: bool, job: Job) -> Done {
    match job {
        Job::Rung(claim, parameter) => Done::Rung(claim, rung(claim, backend, parameter)),
        Job::Exhibit(exhibit) => {
            let measured = exhibit.timed.then(circumstances);
            let record = (exhibit.run)(backend, full);
            let record =
                record.map(|data| ExhibitRecord { exhibit: exhibit.id.to_owned(), full, measured, data });
            Done::Exhibit(exhibit, record)
        }
        Job::Mutant(mutant) => {
            let record = match find_claim(study, mutant.caught_by) {
                Some(claim) => mutant::uncontrolled(mutant, claim, backend),
                None => orphan(mutant),
            };
            Done::Mutant(mutant, record)
        }
    }
}

/// A claim of this study, or of another one.
fn find_claim(study: &Study, id: &str) -> Option<&'static Claim> {
    let others = claims::studies().iter().flat_map(|s| s.claims);
    study.claims.iter().chain(others).find(|c| c.id == id)
}

fn orphan(mutant: &Mutant) -> MutantRecord {
    MutantRecord {
        mutant: mutant.id.to_owned(),
        erratum: mutant.erratum.to_owned(),
        description: mutant.description.to_owned(),
        caught_by: mutant.caught_by.to_owned(),
        caught: false,
        detection: Detection::Escaped,
        error: f64::NAN,
        tolerance: f64::NAN,
        how: format!("there is no claim `{}`", mutant.caught_by),
    }
}

fn describe(done: &Done) -> String {
    match done {
        Done::Rung(claim, outcome) => {
            let place = format!("{} {} = {}", claim.id, claim.ladder.symbol(), outcome.parameter);
            match &outcome.result {
                Ok(sample) => format!("{place}: error {:.3e}", sample.error),
                Err(error) => format!("{place}: {error}"),
            }
        }
        Done::Exhibit(exhibit, Ok(_)) => exhibit.id.to_owned(),
        Done::Exhibit(exhibit, Err(error)) => format!("{}: {error}", exhibit.id),
        Done::Mutant(mutant, record) => {
            format!("mutant {}: error {:.3e}", mutant.id, record.error)
        }
    }
}
