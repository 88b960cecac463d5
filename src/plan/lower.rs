//! Scene and units to the lattice set-up.

use super::cells::Cells;
use super::facts::Facts;
use super::initial::initial_flow;
use super::surface::Pool;
use crate::boundary::cut::cut_cells;
use crate::collision::{CollisionChoice, OddRate};
use crate::free_surface::settle::settle;
use crate::scene::{
    BodyForce as SceneForce, Boundary, ClampLimits, ExcessChoice, InitialPressure, Motion, Operator,
    PrecisionChoice, RefillChoice, Scene, SolidSurface, SurfaceGravity, SurfaceRules, WallChoice,
    YieldChoice,
};
use crate::setup::{
    BodyForce, Course, Courses, ExcessRule, Face, FreeSurface, Precision, Refill, Setup, SolidMotion,
    SurfaceForce, WallRule, YieldTreatment,
};
use crate::units::Units;

/// The set-up of a scene.
#[must_use]
pub(crate) fn lower(facts: &Facts, units: &Units, mut cells: Cells) -> Setup {
    let scene = facts.scene;
    let mut setup = Setup::periodic(cells.extents, facts.laws[0].to_lattice(units));
    setup.faces = facts.faces.map(|faces| faces.map(|face| lower_face(face, units)));
    setup.fluids.extend(facts.laws[1..].iter().map(|law| law.to_lattice(units)));
    setup.force = force(&facts.forces.computed, units);
    let settled = scene.fluid.initial.as_ref().is_some_and(|i| i.pressure == InitialPressure::Settled);
    if settled {
        let is_solid = |cell: usize| cells.solids.get(cell).is_some_and(|&s| s != 0);
        let (periodic, force) = (setup.periodic_axes(), setup.force.at(0));
        cells.fill = settle(cells.extents, periodic, &cells.fill, is_solid, &force);
    }
    setup.initial = initial_flow(facts, units, &cells, &setup.force.at(0));
    if cells.pool.is_some() {
        setup.free_surface = Some(free_surface(scene.numerics.free_surface.unwrap_or_default(), cells.fill));
    }
    setup.loads = scene.output.all_probes().any(|(probe, _)| probe.measure.loaded_solid().is_some());
    setup.solids = cells.solids;
    setup.fluid_of_cell = cells.fluid_of_cell;
    setup.solid_motion = solid_motion(scene, units);
    setup.courses = courses(scene, units);
    setup.yielding = yield_treatment(&scene.numerics.yield_treatment, units);
    setup.collision = calmed(facts, &setup, cells.pool.as_ref());
    setup.wall_rule = match scene.numerics.wall_rule {
        WallChoice::HalfWay => WallRule::HalfWay,
        WallChoice::ViscosityIndependent => WallRule::ViscosityIndependent,
    };
    setup.stress_source = scene.numerics.stress_source;
    setup.precision = match scene.numerics.precision {
        PrecisionChoice::Double => Precision::Double,
        PrecisionChoice::Single => Precision::Single,
        PrecisionChoice::SingleStorage => Precision::SingleStorage,
    };
    if solid_surface(scene, &setup) == SolidSurface::CentralLinear {
        setup.cuts = cut_cells(&setup, in_solids(scene)).into();
    }
    setup
}

/// Where the surfaces of solids lie: as asked, or in their place where cut links are possible \[B4\].
fn solid_surface(scene: &Scene, setup: &Setup) -> SolidSurface {
    let best = if setup.can_be_cut() { SolidSurface::CentralLinear } else { SolidSurface::HalfWay };
    scene.numerics.solid_surface.unwrap_or(best)
}

/// Whether a point, in cells, lies in a solid of the scene: as the cells are painted.
fn in_solids(scene: &Scene) -> impl Fn([f64; 3]) -> bool {
    let dx = scene.domain.spacing_m;
    move |point| scene.solids.iter().any(|solid| solid.shape.contains(point.map(|x| x * dx)) != solid.invert)
}

/// The rules of the surface with defaults filled in.
#[must_use]
pub(crate) fn free_surface(rules: SurfaceRules, fill: Vec<f64>) -> FreeSurface {
    let default = FreeSurface::new(fill);
    FreeSurface {
        force: match rules.gravity {
            SurfaceGravity::Full => SurfaceForce::Full,
            SurfaceGravity::ByFill => SurfaceForce::ByFill,
            SurfaceGravity::ByFillAndInertia => SurfaceForce::ByFillAndInertia,
        },
        refill: match rules.refill {
            RefillChoice::Equilibrium => Refill::Equilibrium,
            RefillChoice::WithStress => Refill::WithStress,
        },
        excess: match rules.excess {
            ExcessChoice::Even => ExcessRule::Even,
            ExcessChoice::AlongNormal => ExcessRule::AlongNormal,
        },
        margin: rules.fill_margin.unwrap_or(default.margin),
        lonely_margin: rules.lonely_margin.unwrap_or(default.lonely_margin),
        ..default
    }
}

fn lower_face(face: Boundary, units: &Units) -> Face {
    match face {
        Boundary::Periodic => Face::Periodic,
        Boundary::NoSlip => Face::NoSlip,
        Boundary::MovingWall { velocity_m_per_s } => {
            Face::Moving(units.velocities_to_lattice(velocity_m_per_s))
        }
        Boundary::FreeSlip => Face::FreeSlip,
        Boundary::Open => Face::Open,
    }
}

fn solid_motion(scene: &Scene, units: &Units) -> Vec<SolidMotion> {
    let motion = |solid: &crate::scene::Solid| SolidMotion {
        velocity: units.velocities_to_lattice(solid.velocity_m_per_s),
        spin: solid.spin_rad_per_s.map(|w| units.rate_to_lattice(w)),
        centre: solid.centre_m.unwrap_or_else(|| solid.shape.centre()).map(|x| units.length_to_lattice(x)),
    };
    scene.solids.iter().map(motion).collect()
}

/// How walls and solids move in time; empty lists where all is steady.
fn courses(scene: &Scene, units: &Units) -> Courses {
    let mut courses = Courses::default();
    for (axis, side, _, motion) in scene.domain.motion.named() {
        courses.faces[axis][side] = course(motion, units);
    }
    if scene.solids.iter().any(|solid| solid.motion.is_some()) {
        let of = |motion: &Option<Motion>| motion.as_ref().map_or(Course::Constant, |m| course(m, units));
        courses.solids = scene.solids.iter().map(|solid| of(&solid.motion)).collect();
    }
    courses
}

fn course(motion: &Motion, units: &Units) -> Course {
    match motion {
        Motion::Oscillating { frequency_hz, amplitude, mean, phase_rad } => Course::Oscillating {
            mean: *mean,
            amplitude: *amplitude,
            frequency: units.rate_to_lattice(std::f64::consts::TAU * frequency_hz),
            phase: *phase_rad,
        },
        Motion::Table { points } => Course::Table(
            points.iter().map(|[time, factor]| [units.time_to_lattice(*time), *factor]).collect(),
        ),
    }
}

/// The collision operator with defaults filled in.
#[must_use]
pub(crate) fn collision(facts: &Facts) -> CollisionChoice {
    let scene = facts.scene;
    let choice = &scene.numerics.collision;
    let operator = operator(facts);
    let among_grains = scene.grains.is_some() && operator == Operator::CentralMoment;
    let default = if among_grains { OddRate::AMONG_GRAINS } else { OddRate::STANDARD };
    let odd = OddRate {
        magic: choice.magic.unwrap_or(default.magic),
        floor: choice.floor.unwrap_or(default.floor),
        lowered_below: choice.lowered_below.unwrap_or(default.lowered_below),
        calm: None,
    };
    operator.with(odd)
}

/// The collision operator with the floor of τ⁻ that fades at rest \[K3\], where mud may creep: below a free surface that is no
/// film without ends. A film has a straight profile of stress, which does not creep, and nothing but the floor damps its
/// waves: level fluid, no solids, and around it faces that are periodic or mirrors. A floor that is asked for holds at any speed.
fn calmed(facts: &Facts, setup: &Setup, pool: Option<&Pool>) -> CollisionChoice {
    let chosen = collision(facts);
    let asked = facts.scene.numerics.collision.floor.is_some();
    let open_ended = |pool: &Pool| {
        let mut across = (0..3).filter(|&axis| axis != pool.up.index()).flat_map(|axis| setup.faces[axis]);
        across.all(|face| matches!(face, Face::Periodic | Face::FreeSlip))
    };
    let endless = setup.solids.is_empty() && pool.is_some_and(|pool| pool.level && open_ended(pool));
    match chosen {
        CollisionChoice::CentralMoment(odd)
            if facts.any_plug() && setup.free_surface.is_some() && !asked && !endless =>
        {
            let calm = Some(odd.calm_speed(setup.force.largest()));
            CollisionChoice::CentralMoment(OddRate { calm, ..odd })
        }
        _ => chosen,
    }
}

/// The operator that is asked for; by default the one that suits the fluid.
///
/// In a plug only central moments keep the stress of an unyielded cell honest \[K3\]. Around grains in a Newtonian fluid
/// two relaxation times do better: the drag does not depend on the viscosity, and fast grains stay stable.
#[must_use]
pub(crate) fn operator(facts: &Facts) -> Operator {
    let two_rates = facts.scene.grains.is_some() && facts.is_newtonian();
    let default = if two_rates { Operator::Trt } else { Operator::CentralMoment };
    facts.scene.numerics.collision.operator.unwrap_or(default)
}

/// The yield treatment with its limits as relaxation times.
#[must_use]
pub(crate) fn yield_treatment(choice: &YieldChoice, units: &Units) -> YieldTreatment {
    match choice {
        YieldChoice::Exact => YieldTreatment::Exact,
        YieldChoice::ImplicitClamped(limits) => {
            let (tau_min, tau_max) = clamp(limits, units);
            YieldTreatment::ImplicitClamped { tau_min, tau_max }
        }
        YieldChoice::LaggedClamped(limits) => {
            let (tau_min, tau_max) = clamp(limits, units);
            YieldTreatment::LaggedClamped { tau_min, tau_max }
        }
    }
}

/// The scene's checks leave exactly one complete pair.
fn clamp(limits: &ClampLimits, units: &Units) -> (f64, f64) {
    let tau = |tau: Option<f64>, viscosity: Option<f64>, none: f64| {
        tau.or_else(|| viscosity.map(|mu| units.tau_of_viscosity(mu))).unwrap_or(none)
    };
    (
        tau(limits.tau_min, limits.viscosity_min_pa_s, 0.5),
        tau(limits.tau_max, limits.viscosity_max_pa_s, f64::INFINITY),
    )
}

fn force(force: &SceneForce, units: &Units) -> BodyForce {
    let lattice = |f| units.forces_to_lattice(f);
    match *force {
        SceneForce::Constant { force_n_per_m3 } => BodyForce::Constant(lattice(force_n_per_m3)),
        SceneForce::Oscillating { mean_n_per_m3, amplitude_n_per_m3, frequency_hz, phase_rad } => {
            BodyForce::Oscillating {
                mean: lattice(mean_n_per_m3),
                amplitude: lattice(amplitude_n_per_m3),
                frequency: units.rate_to_lattice(std::f64::consts::TAU * frequency_hz),
                phase: phase_rad,
            }
        }
        SceneForce::Stepped { before_n_per_m3, after_n_per_m3, at_s } => BodyForce::Stepped {
            before: lattice(before_n_per_m3),
            after: lattice(after_n_per_m3),
            // A negative time was refused; a cast saturates.
            at: units.time_to_lattice(at_s).round() as u64,
        },
    }
}
