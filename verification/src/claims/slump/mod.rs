//! Claims of the study `slump`: heaps and columns of yield-stress fluid that come to rest on a floor.

use crate::golden::Agreement;
use crate::study::Study;

mod exhibits;
mod quarter;
pub(super) mod scene;
pub(super) mod shear;
mod tall;
pub(super) mod twin;

/// The study.
pub static STUDY: Study = Study {
    id: "slump",
    title: "Slump",
    intro: "A heap of Bingham fluid is let go on a floor and must come to rest in a shape that only the yield stress \
            decides: the test 000 Sec 3 uses, and the one that a clamped viscosity cannot pass.\n\n\
            A low heap is held by the shear stress at the bed. While it spreads it is compared with lubrication theory \
            (the depth-averaged twin), at rest with Roussel and Coussot's shape. Rest is approached only as 1/t, so the \
            comparison is made at stated times and with a limit extrapolated in 1/t. Both references leave out the \
            extensional stress of the plug, which holds the heap back a little and makes its front a step of height \
            pi sigma0/(rho g). A tall column collapses by extension instead, and is compared with the theory of slices. \
            Lengths are in units of the initial height H, times of mu/(rho g H) with the plastic viscosity mu; depths \
            are masses per area over the reference density.",
    claims: &[shear::TWIN, shear::REST, tall::TALL, quarter::QUARTER, quarter::MASS],
    exhibits: &[exhibits::PROFILES, exhibits::CLAMP, tall::GRIDS, tall::STANDING],
    mutants: &[],
    limits: &[
        "A front thinner than a cell does not advance as it should. At rest the last dx^2 rho g/(2 sigma0) of the thin shape \
         is missing, 11 % of the radius at 6 cells per initial height and 3 % at 12.",
        "Free-standing vertical sides creep, whatever the yield stress: the free-surface links of the outermost cells carry \
         no stress along the surface. A column of height H and radius R sinks by some 0.03 g dt (H/R)^2 with theta = 0.05, in \
         proportion to theta.",
        "The theory of slices needs H >> R and no inertia. At H/R = 2 and Ga = 100 finer grids lead away from it, towards 9 % \
         less height; that coarse grids lie closer is chance.",
    ],
    agreement: Agreement::Bits,
};
