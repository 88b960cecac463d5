//! Claims of the study `sweep`: random steady flows between walls against their exact solutions.

mod case;
mod claims;
mod exhibits;
mod flow;
mod judge;
mod lattice;
mod program;
mod row;

pub use program::main;

use crate::golden::Agreement;
use crate::study::Study;

/// The study.
pub static STUDY: Study = Study {
    id: "sweep",
    title: "Random flows between walls",
    intro: "A wall rule that is right in the flows it was made for may fail in the next one. Here flows are drawn at random: \
            channels, films, ducts, pipes, annuli, Couette flow and turning cylinders; Newtonian, power-law, Bingham and \
            Herschel-Bulkley fluids; any flow index, plug, number of cells, time step and operator. Each is run from rest and \
            from three times its exact speed, and once with half-way walls, and has to end in one steady state near the exact \
            solution.\n\n\
            `study-sweep --count N` runs any number of further cases and `study-sweep --case K` one of them, from its number \
            alone.",
    claims: &[claims::WALLS],
    exhibits: &[exhibits::ROWS],
    mutants: &[],
    limits: &[],
    agreement: Agreement::Bits,
};
