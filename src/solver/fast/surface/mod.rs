//! The free surface in blocks: interface cells have a record of their own, liquid cells none.
//!
//! A step is: collide all cells (the populations of interface cells come from their records), wall
//! corrections, stream and exchange mass in interface cells, marks and conversions. Liquid cells stream when
//! they are gathered for the next collision; the densities found there close the ledger of the step
//! before.

mod accelerate;
pub(crate) mod carry;
mod convert;
mod exchange;
pub(crate) mod flow;
pub(crate) mod inertia;
pub(crate) mod packed;
mod pass;
pub(crate) mod record;
mod report;
mod spread;
mod start;
pub(crate) mod state;
pub(crate) mod streaming;
