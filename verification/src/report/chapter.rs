//! One study as the report needs it.

use crate::claim::{Basis, Kind};
use crate::exhibit::ExhibitRecord;
use crate::golden::{Evaluation, Evaluations, Golden, GoldenError, rejudge};
use crate::mutant::{MutantRecord, Subject};
use crate::record::Record;
use crate::study::Study;

/// A study with its golden files.
pub struct Chapter {
    /// Id of the study.
    pub id: String,
    /// Heading.
    pub title: String,
    /// Introduction, Markdown.
    pub intro: String,
    /// Known limits, sentences.
    pub limits: Vec<String>,
    /// Claims with a golden record.
    pub claims: Vec<Entry>,
    /// Exhibits with their captions; the timed ones carry date and machine.
    pub exhibits: Vec<(String, ExhibitRecord)>,
    /// Mutants.
    pub mutants: Vec<Tried>,
    /// Ids of claims, exhibits and mutants without a golden file.
    pub missing: Vec<String>,
}

/// A claim with its golden record.
pub struct Entry {
    /// The record, judged by the claim's present declaration.
    pub record: Record,
    /// What its tolerance stands on.
    pub basis: Basis,
    /// All rungs that it declares.
    pub declared: Vec<f64>,
    /// The rungs that `cargo test` evaluates.
    pub short: Vec<f64>,
    /// When and how far it was last evaluated.
    pub evaluation: Option<Evaluation>,
}

/// A mutant with its golden record.
pub struct Tried {
    /// The record.
    pub record: MutantRecord,
    /// The mistake sits in a solver; otherwise in the function that measures.
    pub in_solver: bool,
}

impl Entry {
    /// Rungs with a result that no test evaluates.
    #[must_use]
    pub fn unwatched(&self) -> usize {
        let watched = |p: f64| self.short.iter().any(|s| s.to_bits() == p.to_bits());
        self.record.samples.iter().filter(|s| !watched(s.parameter)).count()
    }

    /// Declared rungs without a result.
    #[must_use]
    pub fn open_rungs(&self) -> Vec<f64> {
        let recorded = |p: &f64| self.record.samples.iter().any(|s| s.parameter.to_bits() == p.to_bits());
        self.declared.iter().copied().filter(|p| !recorded(p)).collect()
    }
}

impl Chapter {
    /// Its records.
    #[must_use]
    pub fn records(&self) -> Vec<&Record> {
        self.claims.iter().map(|c| &c.record).collect()
    }

    /// Its claims of one kind.
    #[must_use]
    pub fn of(&self, kind: Kind) -> Vec<&Entry> {
        self.claims.iter().filter(|c| c.record.kind == kind).collect()
    }

    /// Collects the golden files of a study.
    ///
    /// # Errors
    /// A golden file is there but cannot be read.
    pub fn read(study: &Study, golden: &Golden, evaluations: &Evaluations) -> Result<Self, GoldenError> {
        let mut chapter = Self {
            id: study.id.to_owned(),
            title: study.title.to_owned(),
            intro: study.intro.to_owned(),
            limits: study.limits.iter().map(|&l| l.to_owned()).collect(),
            claims: Vec::new(),
            exhibits: Vec::new(),
            mutants: Vec::new(),
            missing: Vec::new(),
        };
        for claim in study.claims {
            let Some(mut record) = golden.record(claim.id)? else {
                chapter.missing.push(claim.id.to_owned());
                continue;
            };
            let in_ladder = |p: f64| claim.ladder.full.iter().any(|f| f.to_bits() == p.to_bits());
            record.samples.retain(|s| in_ladder(s.parameter));
            chapter.claims.push(Entry {
                record: rejudge(claim, &record.samples),
                basis: claim.tolerance.basis,
                declared: claim.ladder.full.to_vec(),
                short: claim.ladder.short.to_vec(),
                evaluation: evaluations.0.get(claim.id).cloned(),
            });
        }
        for exhibit in study.exhibits {
            match golden.exhibit(exhibit.id, exhibit.timed)? {
                Some(record) => chapter.exhibits.push((exhibit.caption.to_owned(), record)),
                None => chapter.missing.push(exhibit.id.to_owned()),
            }
        }
        for mutant in study.mutants {
            let in_solver = matches!(mutant.subject, Subject::Backend(_));
            match golden.mutant(mutant.id)? {
                Some(record) => chapter.mutants.push(Tried { record, in_solver }),
                None => chapter.missing.push(mutant.id.to_owned()),
            }
        }
        Ok(chapter)
    }
}
