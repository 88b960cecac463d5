//! State, steps and the backends that take them.

pub mod books;
pub mod boundary_cells;
pub mod cell;
pub mod check;
pub mod choose;
pub mod compiled;
pub mod fast;
pub mod initial;
pub mod layout;
pub mod observe;
pub mod physics;
pub mod plain;
pub mod pool;
pub mod run;
pub mod steady;
