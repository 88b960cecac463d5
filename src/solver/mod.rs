//! State, steps and the backends that take them.

pub mod books;
pub mod cell;
pub mod boundary_cells;
pub mod check;
pub mod choose;
pub mod compiled;
pub mod fast;
pub mod initial;
pub mod observe;
pub mod layout;
pub mod physics;
pub mod plain;
pub mod pool;
pub mod run;
pub mod steady;
