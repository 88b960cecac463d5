//! The flows behind the cases, in lattice units.

use std::sync::Arc;

use super::scale::Scale;
use crate::coupling::Suspension;
use crate::dem::{self, Grain, Material, Materials, PairProperties, Period, V3};
use crate::rheology::Law;
use crate::setup::{BodyForce, Face, FlowPoint, FreeSurface, InitialFlow, Setup};
use crate::units::Units;

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
pub(super) fn shear_rate(n: usize) -> f64 {
    SPEED * std::f64::consts::TAU / n as f64
}

pub(super) fn newtonian() -> Law {
    Law::Newtonian { mu: VISCOSITY }
}

pub(super) fn bingham(gamma_dot: f64) -> Law {
    Law::Bingham { sigma0: YIELD * VISCOSITY * gamma_dot, mu: VISCOSITY }
}

/// K γ̇ⁿ = VISCOSITY·γ̇ at the given rate.
pub(super) fn herschel_bulkley(gamma_dot: f64) -> Law {
    let k = VISCOSITY * libm::pow(gamma_dot, 1.0 - INDEX);
    Law::HerschelBulkley { sigma0: YIELD * VISCOSITY * gamma_dot, k, n: INDEX }
}

/// Taylor-Green vortices in a periodic cube.
pub(super) fn vortices(n: usize, law: Law) -> Setup {
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
pub(super) fn rigid(n: usize) -> Setup {
    let mut setup = vortices(n, Law::HerschelBulkley { sigma0: 1.0, k: VISCOSITY, n: INDEX });
    setup.initial = Some(taylor_green(n, false));
    setup
}

/// A cube between two walls with viscosity-independent links; the parabola of largest speed `SPEED`.
pub(super) fn channel(n: usize) -> Setup {
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
pub(super) struct Dam {
    /// Length, width and mean depth of the fluid, cells.
    fluid: [usize; 3],
    /// Length and height of the box, cells.
    room: [usize; 2],
}

impl Dam {
    /// 10⁶ fluid cells, 14 to 18 deep; a tenth of it 9 to 13 deep.
    pub(super) const fn large(scale: Scale) -> Self {
        match scale {
            Scale::Full => Self { fluid: [320, 192, 16], room: [480, 24] },
            Scale::Quick => Self { fluid: [144, 64, 11], room: [216, 20] },
        }
    }

    /// A tenth of the large one.
    pub(super) const fn small(scale: Scale) -> Self {
        match scale {
            Scale::Full => Self { fluid: [144, 64, 11], room: [216, 20] },
            Scale::Quick => Self { fluid: [48, 24, 11], room: [72, 20] },
        }
    }

    /// This fluid with ten times the room: four times as long, two and a half times as high.
    pub(super) const fn roomy(self) -> Self {
        let [length, height] = self.room;
        Self { room: [4 * length, height * 5 / 2], ..self }
    }

    /// Weight of the fluid column: 3gH = 0.0075, and 2√(gH) = 0.1 cells per step, whatever the depth.
    fn gravity(self) -> f64 {
        2.5e-3 / self.fluid[2] as f64
    }

    /// The mud stops at a quarter of the depth; τ = 0.65 at a tenth of a cell per step over the depth.
    pub(super) fn mud(self) -> Law {
        let gamma_dot = 0.1 / self.fluid[2] as f64;
        let sigma0 = 0.25 * self.fluid[2] as f64 * self.gravity() * SLOPE[0];
        Law::HerschelBulkley { sigma0, k: VISCOSITY * libm::pow(gamma_dot, 1.0 - INDEX), n: INDEX }
    }

    pub(super) fn setup(self, law: Law) -> Setup {
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

pub(super) fn twin_bingham() -> Setup {
    vortices(TWIN, bingham(shear_rate(TWIN)))
}

pub(super) fn twin_herschel_bulkley() -> Setup {
    vortices(TWIN, herschel_bulkley(shear_rate(TWIN)))
}

pub(super) fn twin_rigid() -> Setup {
    rigid(TWIN)
}

pub(super) fn twin_dam() -> Setup {
    let dam = Dam::small(Scale::Quick);
    dam.setup(dam.mud())
}

/// `side`³ spheres of radius 3 on a lattice, each a little off its place, settling in a periodic box whose net force is
/// zero; without any, vortices in the same box.
pub(super) fn settling(scale: Scale, side: usize) -> Setup {
    let n = match scale {
        Scale::Full => 180,
        Scale::Quick => 84,
    };
    let mut setup = vortices(n, newtonian());
    if side == 0 {
        return setup;
    }
    let material = Material { name: "glass".to_owned(), density_kg_m3: 2.5, young_pa: 1.0, poisson: 0.25 };
    let mut grains = dem::Setup::new(Materials::single(material, PairProperties::default()));
    let length = n as f64;
    grains.period = Period([Some(length); 3]);
    grains.gravity = V3::new(0.0, 0.0, -1e-5);
    grains.design_speed_m_s = 0.02;
    let spacing = length / side as f64;
    for k in 0..side * side * side {
        let place = [k % side, k / side % side, k / side / side];
        let off = |a: usize| 0.3 * libm::sin((7 * k + 3 * a) as f64);
        let centre = V3::from_fn(|a, _| (place[a] as f64 + 0.5) * spacing + off(a));
        grains.grains.push(Grain::sphere(3.0, centre, 0));
    }
    let mut suspension = Suspension::new(grains, Units::new(1.0, 1.0, 1.0));
    suspension.sub_steps = 20;
    suspension.balanced = [true; 3];
    setup.force = BodyForce::Constant([0.0, 0.0, -1e-5]);
    setup.grains = Some(std::sync::Arc::new(suspension));
    setup
}
