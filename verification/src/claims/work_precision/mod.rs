//! Claims of the study `work-precision`: what an error costs.

use crate::golden::Agreement;
use crate::study::Study;

mod claims;
mod exhibits;
mod flows;
mod points;
mod precision;
mod releases;
mod steady;
mod times;
mod trial;

/// The study.
pub static STUDY: Study = Study {
    id: "work-precision",
    title: "Work and precision",
    intro: "How long does it take to get an answer that is right to one per cent? A scheme that is twice as slow per \
            cell and step is the better one if it needs a coarser grid or fewer steps. So every flow here has a \
            reference, and each scheme, wall rule, resolution and time step is a point: the error it reached, and the \
            updates of cells it took to come there. A steady flow starts from rest and ends when its error stays within \
            a tenth of what it becomes.\n\n\
            Errors and updates are the same bits on every machine and with both backends. Seconds are updates times \
            the measured time of one update; they stand, with date and machine, under *Measured speeds*, together with \
            the recommended choice for 1 %, 0.1 % and 0.01 %, which `lahar plan SCENE --target-error 1%` quotes.",
    claims: &[
        claims::UPDATES,
        claims::CLAMP,
        claims::ORDER_BINGHAM,
        claims::ORDER_HERSCHEL_BULKLEY,
        claims::ORDER_VORTEX,
        claims::ORDER_FILM,
        claims::BACKENDS,
        precision::CHANNEL,
        precision::FLOWS,
        precision::MASS,
    ],
    exhibits: &[exhibits::POINTS, precision::ERRORS, exhibits::TIMES],
    mutants: &[],
    limits: &[
        "A heap that slumps has no exact solution. Its reference in *Work and precision* is lahar's own finest run with \
         the default scheme, so an error that all grids share does not show; the study of slumps compares with theory.",
        "The dam break of *Work and precision* is compared with lubrication theory, which itself is off by a few per \
         cent: smaller errors than that cannot be seen there, and no choice is recommended for them.",
        "The table of runs, the speeds and the recommendations of *Work and precision* are in double precision; what single \
         precision changes is shown apart, in `single-precision-errors`.",
    ],
    agreement: Agreement::Bits,
};
