//! The fixed list of flows that are timed, in lattice units.

use std::sync::Arc;

use crate::rheology::Law;
use crate::solver::setup::{BodyForce, Face, FlowPoint, FreeSurface, InitialFlow, Setup};

/// Full size, or about ten times fewer cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// As described.
    Full,
    /// About a tenth of the cells.
    Quick,
}

impl Scale {
    const fn pick(self, full: usize, quick: usize) -> usize {
        match self {
            Self::Full => full,
            Self::Quick => quick,
        }
    }
}

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

/// Speed of the vortices, cells per step.
const SPEED: f64 = 0.02;
/// Viscosity of the Newtonian fluid, and of the others at the shear rate of the vortices: τ = 0.65.
const VISCOSITY: f64 = 0.05;
/// Yield stress over viscous stress where a fluid is to be mostly yielded.
const YIELD: f64 = 0.1;
/// Flow index of the Herschel-Bulkley fluid.
const INDEX: f64 = 0.33;
/// Edge of the twins.
const TWIN: usize = 48;

/// Shear rate of the vortices in a cube of `n` cells: U·2π/n.
fn shear_rate(n: usize) -> f64 {
    SPEED * std::f64::consts::TAU / n as f64
}

fn newtonian() -> Law {
    Law::Newtonian { mu: VISCOSITY }
}

fn bingham(gamma_dot: f64) -> Law {
    Law::Bingham { sigma0: YIELD * VISCOSITY * gamma_dot, mu: VISCOSITY }
}

/// K γ̇ⁿ = VISCOSITY·γ̇ at the given rate.
fn herschel_bulkley(gamma_dot: f64) -> Law {
    let k = VISCOSITY * libm::pow(gamma_dot, 1.0 - INDEX);
    Law::HerschelBulkley { sigma0: YIELD * VISCOSITY * gamma_dot, k, n: INDEX }
}

/// Taylor-Green vortices in a periodic cube.
fn vortices(n: usize, law: Law) -> Setup {
    let mut setup = Setup::periodic([n; 3], law);
    setup.initial = Some(taylor_green(n, true));
    setup
}

/// u = U (sin kx cos ky cos kz, −cos kx sin ky cos kz, 0), with its pressure, and with its gradient if the
/// fluid is to carry the stress of it from the start.
fn taylor_green(n: usize, sheared: bool) -> InitialFlow {
    let k = std::f64::consts::TAU / n as f64;
    let waves: Vec<[f64; 2]> = (0..n)
        .map(|i| {
            let phase = k * (i as f64 + 0.5);
            [libm::sin(phase), libm::cos(phase)]
        })
        .collect();
    let rate = if sheared { SPEED * k } else { 0.0 };
    Arc::new(move |cell| {
        let [[sx, cx], [sy, cy], [sz, cz]] = cell.map(|i| waves[i]);
        // cos 2a = 2 cos² a − 1
        let double = |c: f64| 2.0 * c * c - 1.0;
        let pressure = SPEED * SPEED / 16.0 * (double(cx) + double(cy)) * (double(cz) + 2.0);
        FlowPoint {
            density: 1.0 + 3.0 * pressure,
            velocity: [SPEED * sx * cy * cz, -SPEED * cx * sy * cz, 0.0],
            gradient: [
                [rate * cx * cy * cz, -rate * sx * sy * cz, -rate * sx * cy * sz],
                [rate * sx * sy * cz, -rate * cx * cy * cz, rate * cx * sy * sz],
                [0.0; 3],
            ],
        }
    })
}

/// The vortices in a material that never yields: σ0 = 1 is a hundred times the largest inertial stress.
fn rigid(n: usize) -> Setup {
    let mut setup = vortices(n, Law::HerschelBulkley { sigma0: 1.0, k: VISCOSITY, n: INDEX });
    setup.initial = Some(taylor_green(n, false));
    setup
}

/// A cube between two walls with viscosity-independent links; the parabola of largest speed `SPEED`.
fn channel(n: usize) -> Setup {
    let mut setup = Setup::periodic([n; 3], newtonian());
    setup.faces[1] = [Face::NoSlip; 2];
    let height = n as f64;
    setup.force = BodyForce::Constant([8.0 * VISCOSITY * SPEED / (height * height), 0.0, 0.0]);
    setup.initial = Some(Arc::new(move |[_, j, _]| {
        let y = (j as f64 + 0.5) / height;
        let mut gradient = [[0.0; 3]; 3];
        gradient[0][1] = 4.0 * SPEED * (1.0 - 2.0 * y) / height;
        FlowPoint { density: 1.0, velocity: [4.0 * SPEED * y * (1.0 - y), 0.0, 0.0], gradient }
    }));
    setup
}

/// A reservoir behind a dam that has just gone, on a slope of 16°.
#[derive(Clone, Copy)]
struct Dam {
    /// Length, width and mean depth of the fluid, cells.
    fluid: [usize; 3],
    /// Length and height of the box, cells.
    room: [usize; 2],
}

impl Dam {
    /// 10⁶ fluid cells, 14 to 18 deep; a tenth of it 9 to 13 deep.
    const fn large(scale: Scale) -> Self {
        match scale {
            Scale::Full => Self { fluid: [320, 192, 16], room: [480, 24] },
            Scale::Quick => Self { fluid: [144, 64, 11], room: [216, 20] },
        }
    }

    /// A tenth of the large one.
    const fn small(scale: Scale) -> Self {
        match scale {
            Scale::Full => Self { fluid: [144, 64, 11], room: [216, 20] },
            Scale::Quick => Self { fluid: [48, 24, 11], room: [72, 20] },
        }
    }

    /// The same fluid with ten times the room: four times as long, two and a half times as high.
    const fn roomy(self) -> Self {
        let [length, height] = self.room;
        Self { room: [4 * length, height * 5 / 2], ..self }
    }

    /// Weight of the fluid column: 3gH = 0.0075, and 2√(gH) = 0.1 cells per step, whatever the depth.
    fn gravity(self) -> f64 {
        2.5e-3 / self.fluid[2] as f64
    }

    /// The mud stops at a quarter of the depth; τ = 0.65 at a tenth of a cell per step over the depth.
    fn mud(self) -> Law {
        let gamma_dot = 0.1 / self.fluid[2] as f64;
        let sigma0 = 0.25 * self.fluid[2] as f64 * self.gravity() * SLOPE[0];
        Law::HerschelBulkley { sigma0, k: VISCOSITY * libm::pow(gamma_dot, 1.0 - INDEX), n: INDEX }
    }

    fn setup(self, law: Law) -> Setup {
        let [length, width, depth] = self.fluid;
        let mut setup = Setup::periodic([self.room[0], width, self.room[1]], law);
        setup.faces[0] = [Face::NoSlip, Face::Open];
        setup.faces[2] = [Face::NoSlip, Face::Open];
        let g = self.gravity();
        setup.force = BodyForce::Constant([g * SLOPE[0], 0.0, -g * SLOPE[1]]);
        // Waves on the surface, so that cells fill and empty everywhere and not only at the front.
        let level = |i: usize, j: usize| {
            let x = std::f64::consts::TAU * (i as f64 + 0.5) / 32.0;
            let y = std::f64::consts::TAU * (j as f64 + 0.5) / width as f64;
            depth as f64 + 2.0 * libm::cos(x) * libm::cos(2.0 * y)
        };
        let levels: Vec<f64> =
            (0..length * width).map(|column| level(column % length, column / length)).collect();
        let mut fill = vec![0.0; setup.cells()];
        for (cell, fill) in fill.iter_mut().enumerate() {
            let [i, j, k] = setup.coordinates(cell);
            if i < length {
                *fill = (levels[i + length * j] - k as f64).clamp(0.0, 1.0);
            }
        }
        setup.free_surface = Some(FreeSurface::new(fill));
        setup
    }
}

/// Sine and cosine of 16°.
const SLOPE: [f64; 2] = [0.275_637_355_816_999_2, 0.961_261_695_938_318_9];

const fn bulk(scale: Scale) -> usize {
    scale.pick(192, 88)
}

const fn small(scale: Scale) -> usize {
    scale.pick(96, 44)
}

fn twin_bingham() -> Setup {
    vortices(TWIN, bingham(shear_rate(TWIN)))
}

fn twin_herschel_bulkley() -> Setup {
    vortices(TWIN, herschel_bulkley(shear_rate(TWIN)))
}

fn twin_rigid() -> Setup {
    rigid(TWIN)
}

fn twin_dam() -> Setup {
    let dam = Dam::small(Scale::Quick);
    dam.setup(dam.mud())
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

/// All groups, in the order in which they run.
pub const GROUPS: [Group; 6] = [
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
            case("sizes/1e5", "10⁵ cells", |s| vortices(s.pick(46, 22), newtonian())),
            case("sizes/1e6", "10⁶ cells", |s| vortices(s.pick(100, 46), newtonian())),
            case("sizes/1e7", "10⁷ cells", |s| vortices(s.pick(216, 100), newtonian())),
            case("sizes/3e7", "3·10⁷ cells", |s| vortices(s.pick(311, 144), newtonian())),
        ],
        compare: &[
            ratio("10⁵ / 10⁶ cells", Quantity::TimePerUpdate, "sizes/1e5", "sizes/1e6"),
            ratio("10⁷ / 10⁶ cells", Quantity::TimePerUpdate, "sizes/1e7", "sizes/1e6"),
            ratio("3·10⁷ / 10⁶ cells", Quantity::TimePerUpdate, "sizes/3e7", "sizes/1e6"),
        ],
        single_thread: false,
    },
];
