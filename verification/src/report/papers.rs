//! The numbered equations of the source papers that carry no tag of a claim: what checks them, and which
//! have nothing to check.

use Check::{Claim, NotApplicable, UnitTest, Untested};

/// How an equation is covered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Check {
    /// A claim that does not name it would fail if lahar had it wrong.
    Claim(&'static str),
    /// Only a unit test would.
    UnitTest(&'static str),
    /// A definition, kinetic theory behind the method, or a step of a derivation.
    NotApplicable,
    /// It could be tested and is not.
    Untested,
}

/// Equations of a paper: its short name, the part of the number before the last point, the last number.
pub(super) const PAPERS: [(&str, &str, u32); 6] = [
    ("000", "", 19),
    ("001", "", 13),
    ("004", "2.", 4),
    ("004", "3.", 73),
    ("004", "4.", 18),
    ("004", "5.", 4),
];

/// Ranges of equations of a paper that no claim has as a tag: paper, chapter, first, last, cover.
pub(super) const UNTAGGED: [(&str, &str, u32, u32, Check); 53] = [
    ("000", "", 1, 1, UnitTest("src/rheology/bagnold.rs")),
    ("000", "", 3, 3, Claim("free-clump-flip-period")),
    ("000", "", 4, 4, Claim("conservation-collision")),
    ("000", "", 5, 5, Claim("acceleration-without-shear")),
    ("000", "", 6, 7, Claim("shear-wave-axis-bgk")),
    ("000", "", 8, 8, Claim("equilibrium-moments")),
    ("000", "", 9, 9, Claim("moment-identities")),
    ("000", "", 10, 10, Claim("couette-newtonian")),
    ("000", "", 16, 16, Claim("cubic-array-settling")),
    ("000", "", 17, 18, Claim("regular-array-misses-richardson-zaki")),
    ("001", "", 1, 2, Claim("poiseuille-bingham")),
    ("001", "", 3, 3, Claim("conservation-collision")),
    ("001", "", 4, 6, Claim("shear-wave-axis-bgk")),
    ("001", "", 7, 7, Claim("couette-all-laws")),
    ("001", "", 11, 11, NotApplicable),
    ("001", "", 13, 13, Untested),
    ("004", "2.", 1, 2, NotApplicable),
    ("004", "2.", 3, 4, UnitTest("src/rheology/bagnold.rs")),
    ("004", "3.", 1, 1, NotApplicable),
    ("004", "3.", 2, 2, Claim("poiseuille-bingham")),
    ("004", "3.", 4, 4, Claim("poiseuille-herschel-bulkley")),
    ("004", "3.", 5, 16, NotApplicable),
    ("004", "3.", 17, 18, Claim("moment-identities")),
    ("004", "3.", 19, 19, Claim("conservation-collision")),
    ("004", "3.", 20, 20, Claim("pool-pressure")),
    ("004", "3.", 21, 21, Claim("sound-wave-speed")),
    ("004", "3.", 22, 24, Claim("shear-wave-axis-bgk")),
    ("004", "3.", 26, 26, Claim("shear-wave-axis-bgk")),
    ("004", "3.", 29, 29, Claim("acceleration-without-shear")),
    ("004", "3.", 33, 33, Claim("poiseuille-herschel-bulkley")),
    ("004", "3.", 35, 35, Claim("couette-all-laws")),
    ("004", "3.", 36, 36, Claim("poiseuille-newtonian-bgk-slip")),
    ("004", "3.", 39, 42, NotApplicable),
    ("004", "3.", 43, 44, Claim("equilibrium-moments")),
    ("004", "3.", 45, 53, NotApplicable),
    ("004", "3.", 56, 66, NotApplicable),
    ("004", "3.", 67, 67, Claim("strain-tensor-couette")),
    ("004", "3.", 68, 68, Claim("taylor-green-3d")),
    ("004", "3.", 71, 71, Claim("poiseuille-newtonian-magic")),
    ("004", "3.", 72, 73, Claim("couette-all-laws")),
    ("004", "4.", 1, 2, Claim("poiseuille-newtonian-magic")),
    ("004", "4.", 3, 4, Claim("poiseuille-plug-cells")),
    ("004", "4.", 5, 6, Claim("poiseuille-herschel-bulkley")),
    ("004", "4.", 7, 7, NotApplicable),
    ("004", "4.", 8, 11, Claim("poiseuille-herschel-bulkley")),
    ("004", "4.", 12, 12, NotApplicable),
    ("004", "4.", 13, 15, Claim("poiseuille-herschel-bulkley")),
    ("004", "4.", 16, 16, Claim("poiseuille-bingham")),
    ("004", "4.", 17, 17, Claim("poiseuille-newtonian-magic")),
    ("004", "4.", 18, 18, Claim("over-yield-lagged")),
    ("004", "5.", 1, 1, Claim("film-herschel-bulkley")),
    ("004", "5.", 2, 3, Claim("thesis-run-h")),
    ("004", "5.", 4, 4, Untested),
];
