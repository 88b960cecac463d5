//! Threads of a run.

use std::sync::Arc;

use rayon::prelude::*;

/// Of each thread, bytes: that of a main thread, on which the same steps run without a pool. Pages that are not touched cost nothing.
const STACK: usize = 8 << 20;

/// As many threads as asked for; `None` for one, and where they cannot be had: results do not depend on it.
#[must_use]
pub(crate) fn start(threads: usize) -> Option<Arc<rayon::ThreadPool>> {
    let pool = || rayon::ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK).build().ok();
    (threads > 1).then(pool).flatten().map(Arc::new)
}

/// Runs `steps` on a thread of the pool: a caller outside it would be handed over to it, and back, at every pass of every
/// step.
pub(crate) fn within<T: Send>(pool: Option<&rayon::ThreadPool>, steps: impl FnOnce() -> T + Send) -> T {
    match pool {
        Some(pool) => pool.install(steps),
        None => steps(),
    }
}

/// Runs `work` on every item, on the pool if there is one; results in order.
pub(crate) fn each<I: Send, T: Send>(
    pool: Option<&rayon::ThreadPool>,
    items: Vec<I>,
    work: impl Fn(I) -> T + Sync + Send,
) -> Vec<T> {
    match pool {
        Some(pool) => pool.install(|| items.into_par_iter().map(work).collect()),
        None => items.into_iter().map(work).collect(),
    }
}
