//! Cost of the kernels and of whole steps: `cargo bench`.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;

use lahar::collision::{Collision, CollisionChoice, OddRate};
use lahar::lane::{Lane, Pack, powers};
use lahar::lattice::moments::moments;
use lahar::rheology::{Law, Rheology};
use lahar::setup::{FlowPoint, Setup};
use lahar::solver::initial::start;
use lahar::solver::plain::Plain;
use lahar::solver::run::Backend;

const LAWS: [(&str, Law); 4] = [
    ("newtonian", Law::Newtonian { mu: 0.1 }),
    ("bingham", Law::Bingham { sigma0: 1e-5, mu: 0.1 }),
    ("herschel_bulkley", Law::HerschelBulkley { sigma0: 1e-5, k: 0.01, n: 0.33 }),
    ("papanastasiou", Law::Papanastasiou { sigma0: 1e-5, k: 0.1, n: 1.0, m: 1e4 }),
];

/// One collision of one cell, by operator.
fn collide(c: &mut Criterion) {
    let point = FlowPoint {
        density: 1.01,
        velocity: [0.03, -0.02, 0.05],
        gradient: [[1e-3, 2e-3, -3e-3], [4e-3, -2e-3, 1e-3], [5e-4, 6e-4, 1e-3]],
    };
    let force = [1e-5, 0.0, 0.0];
    let h = start(&point, &LAWS[0].1, &force);
    let operators = [
        ("bgk", CollisionChoice::Bgk),
        ("trt", CollisionChoice::Trt(OddRate::default())),
        ("central_moment", CollisionChoice::CentralMoment(OddRate::default())),
        ("regularised", CollisionChoice::Regularised),
    ];
    let mut group = c.benchmark_group("collide");
    for (name, operator) in operators {
        group.bench_function(name, |b| {
            b.iter(|| {
                let h = black_box(h);
                let m = moments(&h, &force);
                operator.collide(&h, &m, black_box(1.25))
            });
        });
    }
    group.finish();
}

/// Stresses of the benchmark: a decade above the yield stress.
const STRESSES: [f64; 8] = [3e-4, 5e-5, 1.1e-5, 4e-4, 2e-5, 1e-4, 6e-5, 2e-4];

/// The local solve [Y3], by law: one yielded cell, and eight at once (divide by eight).
fn shear_rate(c: &mut Criterion) {
    let mut group = c.benchmark_group("shear_rate");
    for (name, law) in LAWS {
        let law = law.prepare();
        group.throughput(Throughput::Elements(1));
        group.bench_function(BenchmarkId::new("f64", name), |b| {
            b.iter(|| law.shear_rate(black_box(1.0_f64), black_box(3e-4)));
        });
        group.throughput(Throughput::Elements(8));
        group.bench_function(BenchmarkId::new("Pack<8>", name), |b| {
            b.iter(|| law.shear_rate(black_box(Pack::<8>::one()), black_box(Pack(STRESSES))));
        });
    }
    group.finish();
}

/// exp and ln: one number and eight at once.
fn power(c: &mut Criterion) {
    let mut group = c.benchmark_group("power");
    group.throughput(Throughput::Elements(1));
    group.bench_function("exp f64", |b| b.iter(|| powers::exp(black_box(-3.7_f64))));
    group.bench_function("ln f64", |b| b.iter(|| powers::ln(black_box(3e-4_f64))));
    group.throughput(Throughput::Elements(8));
    group.bench_function("exp Pack<8>", |b| b.iter(|| powers::exp(black_box(Pack(STRESSES)))));
    group.bench_function("ln Pack<8>", |b| b.iter(|| powers::ln(black_box(Pack(STRESSES)))));
    group.finish();
}

/// Whole steps: a cube with walls on two sides, by law; throughput in cell updates.
fn step(c: &mut Criterion) {
    let mut group = c.benchmark_group("step");
    group.sample_size(20);
    for (name, law) in &LAWS[..3] {
        let mut setup = Setup::channel(32, *law, 1e-6);
        setup.extents = [32; 3];
        group.throughput(Throughput::Elements(setup.cells() as u64));
        let Ok(mut run) = Plain.start(&setup) else { continue };
        group.bench_function(BenchmarkId::new("plain 32^3", name), |b| {
            b.iter(|| run.advance(1));
        });
    }
    group.finish();
}

criterion_group!(benches, collide, shear_rate, power, step);
criterion_main!(benches);
