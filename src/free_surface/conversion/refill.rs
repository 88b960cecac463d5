//! What a cell that becomes interface starts from \[F4\].

use super::Cell;
use super::cells::Cells;
use crate::boundary::links::Source;
use crate::lattice::equilibrium::equilibrium;
use crate::lattice::moments::{density_excess, moments};
use crate::lattice::{C, Q};
use crate::setup::{FreeSurface, Refill};

/// −1 where a mirror plane has reversed component `a` between direction `i` at the receiver and `from`
/// at the source, else 1.
#[inline(always)]
#[must_use]
pub fn mirrored(i: usize, from: usize, a: usize) -> f64 {
    if C[i][a] == C[from][a] { 1.0 } else { -1.0 }
}

/// Means over the fluid neighbours of a cell.
#[derive(Clone, Copy, Debug)]
pub struct Neighbourhood {
    /// ρ − 1.
    pub d_rho: f64,
    /// u without force.
    pub u: [f64; 3],
    /// Populations beyond equilibrium.
    pub beyond: [f64; Q],
}

/// Means over the fluid neighbours of a cell, seen through mirror planes; `None` without any. `stress`: with
/// [`Neighbourhood::beyond`], else zero.
pub fn neighbourhood<C: Cells + ?Sized>(cells: &C, cell: usize, stress: bool) -> Option<Neighbourhood> {
    let mut rho = [0.0; Q];
    let mut u = [[0.0; Q]; 3];
    let mut parts = [[0.0; Q]; Q];
    let mut count = 0;
    for i in 1..Q {
        let Source::Cell { cell: from, direction } = cells.source(cell, i) else { continue };
        let (from, direction) = (from as usize, usize::from(direction));
        if !cells.kind(from).is_fluid() {
            continue;
        }
        count += 1;
        let f = cells.populations(from);
        let m = moments(&f, &[0.0; 3]);
        rho[i] = m.d_rho;
        for a in 0..3 {
            u[a][i] = mirrored(i, direction, a) * m.u[a];
        }
        if stress {
            let rest = equilibrium(m.d_rho, m.rho, &m.u);
            for (d, part) in parts.iter_mut().enumerate() {
                let d_from = reflected(d, i, direction);
                part[i] = f[d_from] - rest[d_from];
            }
        }
    }
    let mean = |parts: &[f64; Q]| density_excess(parts) / f64::from(count);
    (count > 0).then(|| Neighbourhood {
        d_rho: mean(&rho),
        u: [mean(&u[0]), mean(&u[1]), mean(&u[2])],
        beyond: std::array::from_fn(|d| mean(&parts[d])),
    })
}

/// Populations of a new interface cell, from the mean of its fluid neighbours before conversion.
pub(super) fn refill(cells: &impl Cells, rules: &FreeSurface, cell: usize) -> Cell {
    let stress = rules.refill == Refill::WithStress;
    let Some(around) = neighbourhood(cells, cell, stress) else { return [0.0; Q] };
    let rest = equilibrium(around.d_rho, 1.0 + around.d_rho, &around.u);
    match rules.refill {
        Refill::Equilibrium => rest,
        Refill::WithStress => std::array::from_fn(|d| rest[d] + around.beyond[d]),
    }
}

/// Direction at the source that direction `d` at the receiver becomes through the mirror planes between
/// direction `i` and `from`.
fn reflected(d: usize, i: usize, from: usize) -> usize {
    let c = std::array::from_fn(|a| if C[i][a] == C[from][a] { C[d][a] } else { -C[d][a] });
    crate::lattice::direction(c).unwrap_or(d)
}
