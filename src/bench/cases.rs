//! The fixed list of flows that are timed, in lattice units.

use super::flows::{
    Dam, bingham, channel, herschel_bulkley, newtonian, rigid, settling, shear_rate, twin_bingham, twin_dam,
    twin_herschel_bulkley, twin_rigid, vortices,
};
use super::scale::Scale;
use crate::setup::{Precision, Setup};

/// One flow.
#[derive(Clone, Copy)]
pub struct Case {
    /// `group/flow`.
    pub name: &'static str,
    /// What it shows.
    pub shows: &'static str,
    /// The set-up.
    pub setup: fn(Scale) -> Setup,
    /// A small relative with the same share of yielded fluid; `None` where everything flows.
    pub twin: Option<fn() -> Setup>,
}

/// What two cases are compared by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Updates per second.
    Rate,
    /// Seconds per update.
    TimePerUpdate,
    /// Seconds per step.
    TimePerStep,
    /// Bytes held.
    Bytes,
}

/// A ratio of two cases of a group.
#[derive(Clone, Copy)]
pub struct Compare {
    /// As printed.
    pub name: &'static str,
    /// By what.
    pub quantity: Quantity,
    /// Numerator.
    pub of: &'static str,
    /// Denominator.
    pub to: &'static str,
}

/// Cases that are timed in turns, so that whatever else the machine does hits all of them.
pub struct Group {
    /// Short name.
    pub name: &'static str,
    /// What it is about.
    pub about: &'static str,
    /// The cases.
    pub cases: &'static [Case],
    /// Their ratios.
    pub compare: &'static [Compare],
    /// Timed on one thread too, or only on all of them.
    pub single_thread: bool,
}

const fn bulk(scale: Scale) -> usize {
    scale.pick(192, 88)
}

const fn small(scale: Scale) -> usize {
    scale.pick(96, 44)
}

const fn case(name: &'static str, shows: &'static str, setup: fn(Scale) -> Setup) -> Case {
    Case { name, shows, setup, twin: None }
}

const fn yielding(
    name: &'static str,
    shows: &'static str,
    setup: fn(Scale) -> Setup,
    twin: fn() -> Setup,
) -> Case {
    Case { name, shows, setup, twin: Some(twin) }
}

const fn ratio(name: &'static str, quantity: Quantity, of: &'static str, to: &'static str) -> Compare {
    Compare { name, quantity, of, to }
}

/// A flow with populations in single precision.
fn single(setup: Setup) -> Setup {
    Setup { precision: Precision::Single, ..setup }
}

/// As [`single`], computed with in f64.
fn stored(setup: Setup) -> Setup {
    Setup { precision: Precision::SingleStorage, ..setup }
}

fn bulk_newtonian(s: Scale) -> Setup {
    vortices(bulk(s), newtonian())
}

fn bulk_bingham(s: Scale) -> Setup {
    vortices(bulk(s), bingham(shear_rate(bulk(s))))
}

fn bulk_mud(s: Scale) -> Setup {
    vortices(bulk(s), herschel_bulkley(shear_rate(bulk(s))))
}

fn small_newtonian(s: Scale) -> Setup {
    vortices(small(s), newtonian())
}

/// Names of a case in three precisions, and what single precision gains.
macro_rules! precisions {
    ($group:literal, $flow:literal) => {
        [
            ratio(
                concat!($flow, ": single / double"),
                Quantity::Rate,
                concat!($group, "/", $flow, "-single"),
                concat!($group, "/", $flow),
            ),
            ratio(
                concat!($flow, ": single storage / double"),
                Quantity::Rate,
                concat!($group, "/", $flow, "-single-storage"),
                concat!($group, "/", $flow),
            ),
        ]
    };
}

const NEWTONIAN: [Compare; 2] = precisions!("precision", "newtonian");
const BINGHAM: [Compare; 2] = precisions!("precision", "bingham");
const MUD: [Compare; 2] = precisions!("precision", "herschel-bulkley");

/// All groups, in the order in which they run.
pub const GROUPS: [Group; 9] = [
    Group {
        name: "bulk",
        about: "vortices in a periodic cube of 192³",
        cases: &[
            case("bulk/newtonian", "one relaxation time", |s| vortices(bulk(s), newtonian())),
            yielding(
                "bulk/bingham",
                "the shear-rate solve in closed form",
                |s| vortices(bulk(s), bingham(shear_rate(bulk(s)))),
                twin_bingham,
            ),
            yielding(
                "bulk/herschel-bulkley",
                "the shear-rate solve with powers, n = 0.33",
                |s| vortices(bulk(s), herschel_bulkley(shear_rate(bulk(s)))),
                twin_herschel_bulkley,
            ),
        ],
        compare: &[
            ratio("bingham / newtonian", Quantity::Rate, "bulk/bingham", "bulk/newtonian"),
            ratio("herschel-bulkley / newtonian", Quantity::Rate, "bulk/herschel-bulkley", "bulk/newtonian"),
        ],
        single_thread: true,
    },
    Group {
        name: "bulk-small",
        about: "the same in 96³, for every backend",
        cases: &[
            case("bulk-small/newtonian", "one relaxation time", |s| vortices(small(s), newtonian())),
            yielding(
                "bulk-small/bingham",
                "the shear-rate solve in closed form",
                |s| vortices(small(s), bingham(shear_rate(small(s)))),
                twin_bingham,
            ),
            yielding(
                "bulk-small/herschel-bulkley",
                "the shear-rate solve with powers, n = 0.33",
                |s| vortices(small(s), herschel_bulkley(shear_rate(small(s)))),
                twin_herschel_bulkley,
            ),
            yielding(
                "bulk-small/unyielded",
                "a Herschel-Bulkley material that never yields",
                |s| rigid(small(s)),
                twin_rigid,
            ),
        ],
        compare: &[
            ratio("bingham / newtonian", Quantity::Rate, "bulk-small/bingham", "bulk-small/newtonian"),
            ratio(
                "herschel-bulkley / newtonian",
                Quantity::Rate,
                "bulk-small/herschel-bulkley",
                "bulk-small/newtonian",
            ),
            ratio(
                "unyielded / yielded herschel-bulkley",
                Quantity::Rate,
                "bulk-small/unyielded",
                "bulk-small/herschel-bulkley",
            ),
        ],
        single_thread: true,
    },
    Group {
        name: "precision",
        about: "the cube of 192³ with populations in f64 and f32, all threads",
        cases: &[
            case("precision/newtonian", "f64", bulk_newtonian),
            case("precision/newtonian-single", "f32", |s| single(bulk_newtonian(s))),
            case("precision/newtonian-single-storage", "kept in f32, computed in f64", |s| {
                stored(bulk_newtonian(s))
            }),
            case("precision/bingham", "f64", bulk_bingham),
            case("precision/bingham-single", "f32", |s| single(bulk_bingham(s))),
            case("precision/bingham-single-storage", "kept in f32, computed in f64", |s| {
                stored(bulk_bingham(s))
            }),
            case("precision/herschel-bulkley", "f64", bulk_mud),
            case("precision/herschel-bulkley-single", "f32, powers in f64", |s| single(bulk_mud(s))),
            case("precision/herschel-bulkley-single-storage", "kept in f32, computed in f64", |s| {
                stored(bulk_mud(s))
            }),
        ],
        compare: &[NEWTONIAN[0], NEWTONIAN[1], BINGHAM[0], BINGHAM[1], MUD[0], MUD[1]],
        single_thread: false,
    },
    Group {
        name: "precision-small",
        about: "the Newtonian cube of 96³ in three precisions",
        cases: &[
            case("precision-small/newtonian", "f64", small_newtonian),
            case("precision-small/newtonian-single", "f32", |s| single(small_newtonian(s))),
            case("precision-small/newtonian-single-storage", "kept in f32, computed in f64", |s| {
                stored(small_newtonian(s))
            }),
        ],
        compare: &precisions!("precision-small", "newtonian"),
        single_thread: true,
    },
    Group {
        name: "walls",
        about: "a channel of 128³ with viscosity-independent walls [B3]",
        cases: &[
            case("walls/channel", "two walls", |s| channel(s.pick(128, 60))),
            case("walls/bulk", "the same number of cells without walls", |s| {
                vortices(s.pick(128, 60), newtonian())
            }),
        ],
        compare: &[ratio("walls / bulk", Quantity::Rate, "walls/channel", "walls/bulk")],
        single_thread: true,
    },
    Group {
        name: "dam-break",
        about: "a thin layer of 10⁶ fluid cells with a free surface",
        cases: &[
            case("dam-break/newtonian", "a thin layer, 14 to 18 cells deep", |s| {
                Dam::large(s).setup(newtonian())
            }),
            yielding(
                "dam-break/herschel-bulkley",
                "the same, of mud",
                |s| Dam::large(s).setup(Dam::large(s).mud()),
                twin_dam,
            ),
            case("dam-break/newtonian-roomy", "the same fluid in ten times the box", |s| {
                Dam::large(s).roomy().setup(newtonian())
            }),
            yielding(
                "dam-break/herschel-bulkley-roomy",
                "the same mud in ten times the box",
                |s| Dam::large(s).roomy().setup(Dam::large(s).mud()),
                twin_dam,
            ),
            case("dam-break/newtonian-bulk", "as many fluid cells without a surface", |s| {
                vortices(s.pick(100, 46), newtonian())
            }),
            yielding(
                "dam-break/herschel-bulkley-bulk",
                "as many mud cells without a surface",
                |s| vortices(s.pick(100, 46), herschel_bulkley(shear_rate(s.pick(100, 46)))),
                twin_herschel_bulkley,
            ),
        ],
        compare: &[
            ratio(
                "free surface / bulk, newtonian",
                Quantity::Rate,
                "dam-break/newtonian",
                "dam-break/newtonian-bulk",
            ),
            ratio(
                "free surface / bulk, herschel-bulkley",
                Quantity::Rate,
                "dam-break/herschel-bulkley",
                "dam-break/herschel-bulkley-bulk",
            ),
            ratio(
                "box ×10 / box, newtonian",
                Quantity::TimePerStep,
                "dam-break/newtonian-roomy",
                "dam-break/newtonian",
            ),
            ratio(
                "box ×10 / box, herschel-bulkley",
                Quantity::TimePerStep,
                "dam-break/herschel-bulkley-roomy",
                "dam-break/herschel-bulkley",
            ),
            ratio(
                "box ×10 / box, newtonian",
                Quantity::Bytes,
                "dam-break/newtonian-roomy",
                "dam-break/newtonian",
            ),
        ],
        single_thread: true,
    },
    Group {
        name: "dam-break-small",
        about: "a tenth of that fluid, for every backend",
        cases: &[
            case("dam-break-small/newtonian", "a thin layer, 9 to 13 cells deep", |s| {
                Dam::small(s).setup(newtonian())
            }),
            yielding(
                "dam-break-small/herschel-bulkley",
                "the same, of mud",
                |s| Dam::small(s).setup(Dam::small(s).mud()),
                twin_dam,
            ),
        ],
        compare: &[ratio(
            "herschel-bulkley / newtonian, free surface",
            Quantity::Rate,
            "dam-break-small/herschel-bulkley",
            "dam-break-small/newtonian",
        )],
        single_thread: true,
    },
    Group {
        name: "sizes",
        about: "the Newtonian cube from 10⁵ to 3·10⁷ cells, all threads",
        cases: &[
            // Whole blocks, so that only the number of cells differs; and one size that is not.
            case("sizes/1e5", "48³ cells", |s| vortices(s.pick(48, 24), newtonian())),
            case("sizes/1e5-odd", "46³ cells: packs at the seams are cut", |s| {
                vortices(s.pick(46, 22), newtonian())
            }),
            case("sizes/1e6", "104³ cells", |s| vortices(s.pick(104, 48), newtonian())),
            case("sizes/1e7", "216³ cells", |s| vortices(s.pick(216, 104), newtonian())),
            case("sizes/3e7", "312³ cells", |s| vortices(s.pick(312, 144), newtonian())),
        ],
        compare: &[
            ratio("10⁵ / 10⁶ cells", Quantity::TimePerUpdate, "sizes/1e5", "sizes/1e6"),
            ratio("46³ / 48³ cells", Quantity::TimePerUpdate, "sizes/1e5-odd", "sizes/1e5"),
            ratio("10⁷ / 10⁶ cells", Quantity::TimePerUpdate, "sizes/1e7", "sizes/1e6"),
            ratio("3·10⁷ / 10⁶ cells", Quantity::TimePerUpdate, "sizes/3e7", "sizes/1e6"),
        ],
        single_thread: false,
    },
    Group {
        name: "coupled",
        about: "grains that settle in a Newtonian fluid, radius of 3 cells",
        cases: &[
            case("coupled/none", "the fluid alone, 180³ cells", |s| settling(s, 0)),
            case("coupled/1", "one grain", |s| settling(s, 1)),
            case("coupled/100", "125 grains", |s| settling(s, s.pick(5, 3))),
            case("coupled/1e4", "10 648 grains: a fifth of the volume", |s| settling(s, s.pick(22, 10))),
        ],
        compare: &[
            ratio("1 grain / none", Quantity::TimePerStep, "coupled/1", "coupled/none"),
            ratio("125 grains / none", Quantity::TimePerStep, "coupled/100", "coupled/none"),
            ratio("10⁴ grains / none", Quantity::TimePerStep, "coupled/1e4", "coupled/none"),
        ],
        single_thread: true,
    },
];
