//! Whole steps of small versions of the cases of `lahar bench`, by backend: `cargo bench --bench scenes`.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

use lahar::bench::Scale;
use lahar::bench::backends;
use lahar::bench::cases::GROUPS;

/// Largest box, cells: the caches of most machines hold it, so that a change of arithmetic shows.
const CELLS: usize = 250_000;

/// One step of each case; throughput in updates of fluid cells. A free surface moves on meanwhile.
fn steps(c: &mut Criterion) {
    for group in &GROUPS {
        let mut bench = c.benchmark_group(group.name);
        bench.sample_size(10);
        for case in group.cases {
            let setup = (case.setup)(Scale::Quick);
            if setup.cells() > CELLS {
                continue;
            }
            for backend in backends() {
                let Ok(mut run) = backend.start(&setup) else { continue };
                bench.throughput(Throughput::Elements(run.fluid_cells()));
                bench.bench_function(BenchmarkId::new(backend.name(), case.name), |b| {
                    b.iter(|| run.advance(1));
                });
            }
        }
        bench.finish();
    }
}

criterion_group!(benches, steps);
criterion_main!(benches);
