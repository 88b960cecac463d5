//! State, steps and the backends that take them.
pub mod fingerprint;
pub mod plain;
pub mod run;
pub mod setup;
