//! Numbers of interface cells where their neighbours can read them: what links carry \[F1\], density and velocity \[F9\].

/// Numbers of a cell: ρ − 1 after the collision, u of it, and c.
pub(crate) const NUMBERS: usize = 5;

/// Which of them is c.
pub(crate) const CARRIED: usize = 4;

/// One number per cell of each kind, one kind after the other; empty in blocks without interface cells.
pub(crate) type Flow = Vec<f64>;

/// ρ − 1, u and c of a cell.
#[inline(always)]
#[must_use]
pub(crate) fn flow_at(flow: &[f64], local: usize) -> (f64, [f64; 3], f64) {
    let cells = flow.len() / NUMBERS;
    let number = |k: usize| flow[k * cells + local];
    (number(0), [number(1), number(2), number(3)], number(CARRIED))
}
