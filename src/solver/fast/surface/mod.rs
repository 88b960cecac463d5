//! The free surface in blocks: interface cells have a record of their own, liquid cells none.
//!
//! A step is: collide all cells (the populations of interface cells come from their records), wall
//! corrections, stream and exchange mass in interface cells, marks and conversions. Liquid cells stream when
//! they are gathered for the next collision; the densities found there close the ledger of the step
//! before.

mod accelerate;
mod convert;
mod exchange;
pub mod inertia;
pub mod packed;
mod pass;
pub mod record;
mod report;
mod start;
pub mod state;
pub mod streaming;
