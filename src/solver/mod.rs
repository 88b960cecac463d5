//! State, steps and the backends that take them.

pub(crate) mod balance;
pub(crate) mod books;
pub mod boundary_cells;
pub(crate) mod cell;
pub(crate) mod check;
pub mod choose;
pub(crate) mod compiled;
pub(crate) mod cuts;
pub mod fast;
pub mod initial;
pub(crate) mod layout;
pub(crate) mod loads;
pub(crate) mod observe;
pub mod physics;
pub mod plain;
pub(crate) mod pool;
pub mod run;
pub mod steady;
