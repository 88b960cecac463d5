//! Claims of the study `sweep`: random steady flows between walls against their exact solutions.

mod case;
mod claims;
mod exhibits;
mod flow;
mod judge;
mod lattice;
mod program;
mod row;
mod scenes;
mod shipped;

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
            alone.\n\n\
            Random *scenes* (`--scenes N`, `--scene K`) go the way of a user's: text, plan, run. Films with a free surface from 0.4 \
            to 24 cells, channels, walls that were set in motion or oscillate, layers, pools at rest, grains that collide, slide and \
            roll; half of the fluids with another time step than the plan's. The plan says which error to expect, by the rows of \
            scenes like it, and the claim holds it to that.",
    claims: &[claims::WALLS, scenes::SCENES],
    exhibits: &[scenes::COUNTS, shipped::SHIPPED, scenes::ROWS, exhibits::ROWS],
    mutants: &[],
    limits: &[
        "Pipes and annuli lie in their place, turning cylinders are stairs with errors of ten per cent. In annuli whose sheared layer \
         is three cells or less (n ≤ 0.5) and in pipes with plugs above 0.9 links in place are further off than stairs. What a \
         start leaves in momentum of alternating sign stays for ever, up to 7 % of the speed in small gaps.",
        "Ducts of fluids that are not Newtonian have no exact solution here: they are held to one steady state.",
        "Where the force adds more than a twentieth of the speed in a step, ducts alternate by up to 7e-3 of the speed and plugs on \
         layers below a cell are off by any amount; half-way walls are steady in most of these. The plan warns.",
        "Channels of 5 and 7 cells have two steady states up to 8 % apart: whether the middle node, whose stress is zero up to \
         rounding, counts as the last one that the law by stress sees. The plan warns of fewer than 8 cells.",
    ],
    agreement: Agreement::Bits,
};
