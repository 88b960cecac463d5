//! Bytes of the arrays of the plain backend, for the prediction of `plan`; `tests/memory.rs` compares them with what a
//! run holds.

use super::cut_cells;
use crate::boundary::cut::CutLink;
use crate::boundary::links::BoundaryCell;
use crate::lattice::Q;

const NUMBER: u64 = size_of::<f64>() as u64;
const VECTOR: u64 = size_of::<[f64; 3]>() as u64;

/// Of a cell: two copies of the populations.
pub(crate) const POPULATIONS: u64 = 2 * Q as u64 * NUMBER;
/// Of a cell: what it is for streaming.
pub(crate) const NEIGHBOURS: u64 = size_of::<u32>() as u64;
/// Of one coordinate of an axis: upstream offsets.
pub(crate) const AXIS: u64 = 3 * size_of::<usize>() as u64;
/// Of a cell with a link that is not regular.
pub(crate) const RECORD: u64 = size_of::<BoundaryCell>() as u64;
/// Of such a cell: what the wall correction keeps.
pub(crate) const CORRECTION: u64 = Q as u64 * NUMBER;
/// Of a cut cell, and of a link of one with what comes back along it.
pub(crate) const CUT_CELL: u64 = cut_cells::CUT_CELL as u64;
pub(crate) const CUT_LINK: u64 = size_of::<CutLink>() as u64 + NUMBER;
/// Of a cell: ω⁺ of the previous step.
pub(crate) const LAG: u64 = NUMBER;
/// Of a cell below a free surface or among grains: kind, touched kinds, mass, fill now and at time 0, velocity, and what
/// interface cells take back.
pub(crate) const SURFACE: u64 = 1 + 1 + NUMBER + NUMBER + NUMBER + VECTOR + VECTOR;
/// Of a cell below a free surface: smoothed acceleration and the velocity it is made from.
pub(crate) const INERTIA: u64 = VECTOR + VECTOR;
