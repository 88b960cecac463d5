//! The mass-tracking free surface \[F1\]–\[F6\], \[F8\], \[F9\]: one file per group of equations.
//!
//! Cells are gas (not computed), liquid (full) or interface (partly full, with a mass of their own). A
//! liquid cell never touches gas. The passes over arrays are in `solver/plain/surface`; here is what
//! one cell or one link does.

mod columns;
mod confined;
pub(crate) mod contact;
pub mod conversion;
pub mod exchange;
pub(crate) mod force;
pub(crate) mod hold;
pub mod hydrostatic;
pub mod ledger;
pub(crate) mod marks;
pub mod normal;
pub mod settle;
pub(crate) mod shares;
pub mod voids;

use crate::state::{State, StateError, Tape};

/// What a cell is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Kind {
    /// Empty; not computed.
    #[default]
    Gas = 0,
    /// Partly filled; has a mass m of its own.
    Interface = 1,
    /// Full; its mass is its density.
    Liquid = 2,
    /// Wall material; not computed.
    Solid = 3,
}

impl Kind {
    /// Liquid or interface: has populations.
    #[inline(always)]
    #[must_use]
    pub(crate) const fn is_fluid(self) -> bool {
        matches!(self, Self::Liquid | Self::Interface)
    }
}

/// Kind of each cell from its initial fill: partly filled cells and full cells next to gas are interface.
///
/// # Arguments
/// `fill`: 0 to 1 per cell. `is_solid(cell)`. `neighbours(cell)`: the cells its links lead to.
/// # Source
/// docs/method.md \[F1\]; 004 Sec 3.2.2.
/// # Verified by
/// Claim `flat-layer-without-flicker`.
pub(crate) fn classify<N: IntoIterator<Item = usize>>(
    fill: &[f64],
    is_solid: impl Fn(usize) -> bool,
    neighbours: impl Fn(usize) -> N,
) -> Vec<Kind> {
    let own = |cell: usize| {
        if is_solid(cell) {
            Kind::Solid
        } else if fill[cell] <= 0.0 {
            Kind::Gas
        } else if fill[cell] < 1.0 {
            Kind::Interface
        } else {
            Kind::Liquid
        }
    };
    (0..fill.len())
        .map(|cell| match own(cell) {
            Kind::Liquid if neighbours(cell).into_iter().any(|n| own(n) == Kind::Gas) => Kind::Interface,
            kind => kind,
        })
        .collect()
}

impl State for Kind {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let mut number = *self as u8;
        number.state(tape)?;
        *self = match number {
            0 => Self::Gas,
            1 => Self::Interface,
            2 => Self::Liquid,
            3 => Self::Solid,
            _ => return Err(StateError::Malformed("a cell is of no known kind")),
        };
        Ok(())
    }
}
