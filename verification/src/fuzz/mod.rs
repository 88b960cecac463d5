//! Mutants of everything that lahar reads, put through its readers, `plan` and `run`: none may panic, hang, take more memory than
//! there is, or be planned and then refused by the run.
//!
//! A mutant is a seed of the corpus with some places changed, and nothing but the seed of the random numbers and its own number
//! decides which: `fuzz --seed 7 --from 123 --count 1` makes it again. Workers take them one by one and a watch looks at the
//! workers, so that a fault of any kind, also an abort, costs one mutant; the mutant is kept.

mod bytes;
mod checkpoints;
mod corpus;
mod json;
mod mutant;
mod program;
mod random;
mod tally;
mod watch;

pub use program::main;
