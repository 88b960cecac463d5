//! Claims, ladders, records and exact solutions.
pub mod claim;
pub mod claims;
pub mod exact;
pub mod reference_values;
