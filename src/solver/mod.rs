//! State, steps and the backends that take them.

pub mod books;
pub mod check;
pub mod choose;
pub mod conversion;
pub mod fast;
pub mod fingerprint;
pub mod initial;
pub mod physics;
pub mod plain;
pub mod run;
pub mod setup;
pub mod steady;
