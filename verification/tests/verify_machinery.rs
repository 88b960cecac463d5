//! The machinery of claims, tried on claims whose outcome is known, without a solver.

use lahar::setup::Setup;
use lahar::solver::run::{Backend, Run, StartError};
use lahar_verification::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use lahar_verification::evaluate::evaluate;
use lahar_verification::exhibit::{Exhibit, ExhibitData, Table};
use lahar_verification::golden::{Agreement, Evaluation, GoldenError, compare, merge, rejudge};
use lahar_verification::ladder::{Depth, faults};
use lahar_verification::mutant::{self, Detection, Mutant, Subject};
use lahar_verification::record::{Record, Verdict};
use lahar_verification::report::{Chapter, Entry, Tried, render};
use lahar_verification::study::{Options, Results, Study};

/// A backend that starts nothing.
struct Nothing;

impl Backend for Nothing {
    fn name(&self) -> &'static str {
        "nothing"
    }

    fn start(&self, _: &Setup) -> Result<Box<dyn Run>, StartError> {
        Err(StartError::NoFluid)
    }
}

/// Trapezoidal rule for ∫₀¹ 3x² dx = 1: the error is exactly ½ N⁻².
fn trapezoid(n: f64) -> f64 {
    let f = |k: f64| 3.0 * (k / n) * (k / n);
    (0..n as u64).map(|k| 0.5 * (f(k as f64) + f(k as f64 + 1.0)) / n).sum()
}

fn second_order(_: &dyn Backend, n: f64) -> Result<Sample, VerifyError> {
    Ok(Sample::relative(n, trapezoid(n), 1.0).with("evaluations [-]", n + 1.0))
}

/// Left rectangles instead of trapezoids.
fn first_order(_: &dyn Backend, n: f64) -> Result<Sample, VerifyError> {
    Ok(Sample::relative(n, trapezoid(n) - 1.5 / n, 1.0))
}

fn never(_: &dyn Backend, _: f64) -> Result<Sample, VerifyError> {
    Ok(Sample::relative(1.0, f64::NAN, 1.0))
}

fn unsettled(_: &dyn Backend, _: f64) -> Result<Sample, VerifyError> {
    Err(VerifyError::NotSteady { steps: 10, wanted: 0.1, found: "not steady".to_owned() })
}

fn unstartable(backend: &dyn Backend, n: f64) -> Result<Sample, VerifyError> {
    let law = lahar::rheology::Law::Newtonian { mu: 0.1 };
    let run = backend.start(&Setup::channel(n as usize, law, 0.0))?;
    Ok(Sample::absolute(n, run.step() as f64, 0.0))
}

const QUADRATURE: Claim = Claim {
    id: "quadrature",
    title: "The trapezoidal rule converges at second order",
    tags: &["L2", "004 Eq 3.10"],
    measures: "∫ 3x² dx over the unit interval",
    reference: Reference { source: "the integral, 1", uncertainty: 0.0 },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "N (intervals)", short: &[4.0, 8.0, 16.0], full: &[4.0, 8.0, 16.0, 32.0] },
    order: Some(OrderBand { expected: 2.0, band: 0.01, at_least: false }),
    tolerance: Tolerance {
        value: 0.5 / 256.0 + 1e-12,
        at: Rung::At(16.0),
        basis: Basis::Derived,
        because: "the rule's error is N⁻²/2, plus rounding",
    },
    kind: Kind::Verification,
    measure: second_order,
};

static CLAIMS: [Claim; 1] = [QUADRATURE];
static EXHIBITS: [Exhibit; 1] =
    [Exhibit { id: "squares", caption: "Squares of small numbers.", timed: false, run: squares }];
static MUTANTS: [Mutant; 1] = [Mutant {
    id: "left-rectangles",
    erratum: "none",
    description: "One-sided rule instead of the symmetric one.",
    caught_by: "quadrature",
    rung: Some(16.0),
    subject: Subject::Measure(first_order),
}];
static STUDY: Study = Study {
    id: "machinery",
    title: "Machinery",
    intro: "A study of the machinery itself.",
    claims: &CLAIMS,
    exhibits: &EXHIBITS,
    mutants: &MUTANTS,
    limits: &["It has no physics."],
    agreement: Agreement::Bits,
};

fn squares(_: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let mut table = Table::new("Squares", &["n", "n²"]);
    for n in 1..if full { 9_u64 } else { 4 } {
        table.push(vec![n.into(), (n as f64 * n as f64).into()]);
    }
    Ok(ExhibitData { tables: vec![table], ..ExhibitData::default() })
}

fn record(depth: Depth) -> Record {
    evaluate(&QUADRATURE, &Nothing, depth)
}

fn reasons(record: &Record) -> String {
    match &record.verdict {
        Verdict::Pass => String::new(),
        Verdict::Fail { reasons } => reasons.join("; "),
    }
}

#[test]
fn exact_second_order_claim_passes() {
    let record = record(Depth::Full);
    assert!(record.passed(), "{}", reasons(&record));
    let order = record.order.unwrap();
    assert!((order.fitted.order - 2.0).abs() < 1e-9);
    assert!((order.richardson.unwrap().value - 1.0).abs() < 1e-12);
    assert!((1.0..1.001).contains(&record.slack), "slack {}", record.slack);
    assert_eq!(record.samples.len(), 4);
}

#[test]
fn wrong_order_missing_rung_and_nan_fail_with_words() {
    let wrong = Claim { measure: first_order, ..QUADRATURE };
    let text = reasons(&evaluate(&wrong, &Nothing, Depth::Short));
    assert!(text.contains("N = 16: error") && text.contains("order 0.952 in N, expected 2 ± 0.01"), "{text}");
    let nan = Claim { measure: never, order: None, ..QUADRATURE };
    let nan = evaluate(
        &Claim { tolerance: Tolerance { at: Rung::Every, ..nan.tolerance }, ..nan },
        &Nothing,
        Depth::Short,
    );
    assert!(!nan.passed() && nan.slack.is_nan());
    let text = reasons(&evaluate(&Claim { measure: unstartable, ..QUADRATURE }, &Nothing, Depth::Short));
    assert!(text.contains("N = 4 gave no result: could not start: the box has no fluid cell"), "{text}");
}

#[test]
fn declarations_are_checked() {
    assert_eq!(faults(&QUADRATURE), Vec::<String>::new());
    let short = Ladder { short: &[4.0, 5.0], ..QUADRATURE.ladder };
    let bad = Claim { id: "Bad id", tags: &[], ladder: short, ..QUADRATURE };
    let text = faults(&bad).join("\n");
    for fault in
        ["kebab-case", "no equation tag", "missing from the full", "three short rungs", "rung is not in"]
    {
        assert!(text.contains(fault), "{fault} not in\n{text}");
    }
    let silent = Claim { tolerance: Tolerance { because: " ", ..QUADRATURE.tolerance }, ..QUADRATURE };
    assert!(faults(&silent)[0].contains("the tolerance has no reason"));
}

#[test]
fn mutants_are_caught_and_healthy_code_is_not() {
    let caught = mutant::evaluate(&MUTANTS[0], &QUADRATURE, &Nothing);
    assert!(caught.caught && caught.error > 0.09, "{caught:?}");
    let whole = Mutant { rung: None, ..MUTANTS[0] };
    assert!(mutant::evaluate(&whole, &QUADRATURE, &Nothing).how.contains("order"));
    let healthy = Mutant { subject: Subject::Measure(second_order), ..MUTANTS[0] };
    assert!(!mutant::evaluate(&healthy, &QUADRATURE, &Nothing).caught);
    // Nothing is detected by a claim that fails without the mistake, too.
    let hopeless = Claim { measure: first_order, ..QUADRATURE };
    let blind = mutant::evaluate(&MUTANTS[0], &hopeless, &Nothing);
    assert!(!blind.caught && blind.how.contains("the honest claim fails as well"), "{blind:?}");
    // A run that does not settle is told apart from a wrong number.
    let restless = Mutant { subject: Subject::Measure(unsettled), ..MUTANTS[0] };
    assert_eq!(mutant::evaluate(&restless, &QUADRATURE, &Nothing).detection, Detection::NoResult);
    assert_eq!(caught.detection, Detection::Error);
    // A backend that refuses to start is not a detection, nor is a rung without tolerance.
    let refusing = Claim { measure: unstartable, ..QUADRATURE };
    let dead = Mutant { subject: Subject::Backend(|| Box::new(Nothing)), ..MUTANTS[0] };
    assert!(!mutant::evaluate(&dead, &refusing, &Nothing).caught);
    assert!(!mutant::evaluate(&Mutant { rung: Some(4.0), ..MUTANTS[0] }, &QUADRATURE, &Nothing).caught);
}

#[test]
fn golden_comparison_sees_one_bit_and_ignores_rungs_not_run() {
    let (short, full) = (record(Depth::Short), record(Depth::Full));
    let text = serde_json::to_string(&full).unwrap();
    let golden: Record = serde_json::from_str(&text).unwrap();
    assert_eq!(golden, full);
    assert_eq!(compare(&short, &golden, Agreement::Bits), []);
    assert_eq!(compare(&full, &short, Agreement::Bits).len(), 1, "a rung without golden sample must show");
    let mut moved = golden;
    let bits = moved.samples[1].computed.to_bits();
    moved.samples[1].computed = f64::from_bits(bits + 1);
    let differences = compare(&short, &moved, Agreement::Bits);
    assert_eq!(differences.len(), 1);
    assert_eq!(differences[0].place, "N = 8, computed");
    assert_eq!(compare(&short, &moved, Agreement::Relative(1e-9)), []);
    moved.samples[0].extra.clear();
    assert_eq!(compare(&short, &moved, Agreement::Relative(1e-9)).len(), 1);
}

#[test]
fn blessing_a_short_ladder_keeps_further_rungs_only_if_nothing_moved() {
    let (short, full) = (record(Depth::Short), record(Depth::Full));
    assert_eq!(merge(&QUADRATURE, &short, Some(&full), Agreement::Bits).unwrap(), full);
    assert_eq!(merge(&QUADRATURE, &short, None, Agreement::Bits).unwrap(), short);
    let mut moved = full;
    moved.samples[0].error = 0.25;
    let refused = merge(&QUADRATURE, &short, Some(&moved), Agreement::Bits);
    assert!(matches!(refused, Err(GoldenError::NeedsFull { .. })));
    assert!(!rejudge(&QUADRATURE, &moved.samples).passed(), "order 2 with a wrong first rung");
}

#[test]
fn exact_results_do_not_depend_on_threads() {
    let compute = |threads| {
        Results::compute(&STUDY, &Nothing, &Options { threads: Some(threads), ..Options::default() })
    };
    let (one, four) = (compute(1), compute(4));
    assert!(one.passed());
    assert_eq!(one.records[0].1, four.records[0].1);
    assert_eq!(one.mutants[0].1, four.mutants[0].1);
    assert_eq!(one.exhibits[0].1.as_ref().unwrap(), four.exhibits[0].1.as_ref().unwrap());
}

#[test]
fn report_shows_claims_mutants_limits_and_unchecked_equations() {
    let results = Results::compute(&STUDY, &Nothing, &Options { full: true, ..Options::default() });
    let evaluation = Evaluation {
        depth: Depth::Full,
        revision: Some("abc1234".to_owned()),
        date: "2026-11-22".to_owned(),
        machine: None,
    };
    let entry = |(claim, record): (&Claim, Record)| Entry {
        record,
        basis: claim.tolerance.basis,
        declared: [claim.ladder.full, &[64.0]].concat(),
        short: claim.ladder.short.to_vec(),
        evaluation: Some(evaluation.clone()),
    };
    let tried = |(_, record)| Tried { record, in_solver: false };
    let chapter = Chapter {
        id: STUDY.id.to_owned(),
        title: STUDY.title.to_owned(),
        intro: STUDY.intro.to_owned(),
        limits: STUDY.limits.iter().map(|&l| l.to_owned()).collect(),
        claims: results.records.into_iter().map(entry).collect(),
        exhibits: results.exhibits.into_iter().map(|(e, r)| (e.caption.to_owned(), r.unwrap())).collect(),
        mutants: results.mutants.into_iter().map(tried).collect(),
        missing: vec!["not-yet".to_owned()],
    };
    let mut text = String::new();
    for (path, content) in render(&[chapter]) {
        text += &format!("=== {}\n\n{content}\n", path.display());
    }
    insta::with_settings!({ snapshot_path => "../../golden/snapshots", prepend_module_to_snapshot => false }, {
        insta::assert_snapshot!("report_machinery", text);
    });
}
