//! Who may touch whom \[D6\]: cells in levels by size, pairs with a skin, in an order that depends on nothing
//! but the members' numbers.

pub(crate) mod cells;
pub(crate) mod pairs;

pub use pairs::PairList;
