//! Hard cases: sizes, densities, edges and corners, far too fast impacts, no friction.

use super::support::{
    DENSITY, G, POISSON, RADIUS, elastic, floor, head_on, mass, material, plane, rest_on_floor, setup, wall,
    worst,
};
use crate::claim::{Basis, Claim, Kind, Ladder, Metric, Reference, Rung, Sample, Tolerance, VerifyError};
use crate::exact::grains::collision::{elastic_speeds, hertz_stiffness, hertz_time};
use crate::exact::grains::rolling::{arm_ratio, incline_acceleration};
use lahar::dem::walls::Mesh;
use lahar::dem::{Dem, DemError, Grain, Integrator, Material, PairProperties, Surface, V3};
use lahar::solver::run::Backend;

/// Elastic collision of a sphere at 1 m/s with a smaller one at rest: speeds afterwards against the closed form.
fn unequal(ratio: f64, densities: (f64, f64)) -> Result<[f64; 3], VerifyError> {
    let (big, small) = (0.1, 0.1 / ratio);
    let mut s = setup(7e6, elastic());
    s.materials.list[0].density_kg_m3 = densities.0;
    s.materials.list.push(Material { name: "other".into(), density_kg_m3: densities.1, ..material(7e6) });
    s.grains = vec![
        Grain::sphere(big, V3::zeros(), 0).moving(V3::x()),
        Grain::sphere(small, V3::x() * (big + small + 1e-3 * small), 1),
    ];
    s.steps_per_contact = 100.0;
    let mut d = Dem::new(&s)?;
    let (mut met, mut steps) = (false, 0);
    while !(met && d.pair_counts().1 == 0) && steps < 100_000 {
        d.step(1)?;
        steps += 1;
        met |= d.pair_counts().1 > 0;
    }
    let (v, w) = (d.bodies().velocity[0].x, d.bodies().velocity[1].x);
    let (v1, w1) = elastic_speeds(d.bodies().mass[0], d.bodies().mass[1], 1.0);
    Ok([w, w1, worst(&[v - v1, w - w1])])
}

const UNEQUAL_REFERENCE: Reference = Reference {
    source: "(m - n)/(m + n) and 2 m/(m + n): momentum and energy of an elastic collision",
    uncertainty: 0.0,
};
const UNEQUAL_BECAUSE: &str = "Where the contact begins and ends the force starts like time^(3/2): the trapezoidal rule errs by \
                               zeta(-3/2) = -0.0255 of dt^2.5 at either end, 9.5e-6 of the speed in all with dt = 3.22/100";

/// Sizes.
pub const SIZE: Claim = Claim {
    id: "hard-size-ratio",
    title: "Spheres of very different size collide as the closed form says",
    tags: &["D1", "D6"],
    measures: "Speeds after an elastic collision at 1 m/s of a sphere of 0.1 m with one that many times smaller, at rest; the worse \
               of the two, over 1 m/s",
    reference: UNEQUAL_REFERENCE,
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "R/r", short: &[1.0, 5.0, 20.0], full: &[1.0, 2.0, 5.0, 10.0, 20.0, 50.0] },
    order: None,
    tolerance: Tolerance { value: 9.5e-6, at: Rung::Every, basis: Basis::Derived, because: UNEQUAL_BECAUSE },
    kind: Kind::Verification,
    measure: |_, ratio| {
        let [w, exact, error] = unequal(ratio, (DENSITY, DENSITY))?;
        Ok(Sample { error, ..Sample::absolute(ratio, w, exact) })
    },
};

/// Densities.
pub const DENSITIES: Claim = Claim {
    id: "hard-densities",
    title: "Densities of 1e4 and 1e-3 kg/m3 in one scene",
    tags: &["D1", "D6"],
    measures: "As `hard-size-ratio`, the larger sphere of 1e4 kg/m3, the smaller of 1e-3 kg/m3",
    reference: UNEQUAL_REFERENCE,
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "R/r", short: &[1.0, 20.0], full: &[1.0, 5.0, 20.0] },
    order: None,
    tolerance: Tolerance { value: 9.5e-6, at: Rung::Every, basis: Basis::Derived, because: UNEQUAL_BECAUSE },
    kind: Kind::Verification,
    measure: |_, ratio| {
        let [w, exact, error] = unequal(ratio, (1e4, 1e-3))?;
        Ok(Sample { error, ..Sample::absolute(ratio, w, exact) })
    },
};

/// A floor of 80 x 80 mm in triangles of 2 mm; the line y = 0 runs along edges and through corners.
fn triangles() -> Result<Surface, VerifyError> {
    let n = 40u32;
    let corner = |k: u32| V3::new(f64::from(k % (n + 1)) * 2e-3, f64::from(k / (n + 1)) * 2e-3 - 0.04, 0.0);
    let corners: Vec<V3> = (0..(n + 1) * (n + 1)).map(corner).collect();
    let faces: Vec<[u32; 3]> = (0..n * n)
        .flat_map(|k| {
            let a = k / n * (n + 1) + k % n;
            [[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]]
        })
        .collect();
    Ok(Surface::Mesh(Mesh::new(&corners, &faces)?))
}

/// Rolling down a slope of triangles.
pub const MESH_ROLLING: Claim = Claim {
    id: "mesh-rolling",
    title: "A sphere rolls over edges and corners of a triangulated floor as over a plane",
    tags: &["D5", "D2"],
    measures: "Acceleration over 40 mm of triangles of 2 mm edge, at distance y from a line of edges and corners; further columns: \
               steps with other than one contact, difference in place from the same run on a plane",
    reference: Reference { source: "q/(1 + q) g sin(theta), q = (5/2)(1 - delta/r)^2", uncertainty: 0.0 },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "y (mm)", short: &[0.0, 0.7], full: &[0.0, 0.2, 0.7, 1.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-11,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "Constant forces after the spring has found its elongation: rounding of 1e-16 in each of 2e4 steps, 2e-12, and what is \
                  left of the damped oscillation",
    },
    kind: Kind::Verification,
    measure: mesh_rolling,
};

fn mesh_rolling(_: &dyn Backend, y_mm: f64) -> Result<Sample, VerifyError> {
    let young = 7e6;
    let theta = 0.3f64;
    let gravity = V3::new(G * libm::sin(theta), 0.0, -G * libm::cos(theta));
    let run = |mesh: bool| -> Result<(f64, V3, u64, f64), VerifyError> {
        let mut s = setup(young, PairProperties { friction: 0.4, ..PairProperties::default() });
        let arm = rest_on_floor(&mut s, young, gravity);
        if mesh {
            s.walls = vec![wall("mesh", triangles()?)];
        }
        s.design_speed_m_s = 0.1;
        s.grains[0].position += V3::new(0.02, 1e-3 * y_mm, 0.0);
        let mut d = Dem::new(&s)?;
        let (mut odd, mut mark) = (0, None);
        while d.bodies().position[0].x < 0.06 {
            d.step(1)?;
            odd += u64::from(d.wall_contacts().iter().any(|w| w.contacts.len() != 1));
            if mark.is_none() && d.bodies().position[0].x > 0.025 {
                mark = Some((d.bodies().velocity[0].x, d.time()));
            }
        }
        let (v, t) = mark.unwrap_or((f64::NAN, f64::NAN));
        let acceleration = (d.bodies().velocity[0].x - v) / (d.time() - t);
        Ok((acceleration, d.bodies().position[0], odd, arm))
    };
    let (found, place, odd, arm) = run(true)?;
    let (_, on_plane, _, _) = run(false)?;
    let exact = incline_acceleration(arm_ratio(arm), 0.4, G, theta);
    Ok(Sample::relative(y_mm, found, exact)
        .with("steps with other than one contact", odd as f64)
        .with("distance from the place on a plane (m)", (place - on_plane).norm()))
}

/// A cube of half-width 1 cm, outward faces.
fn cube() -> Result<Surface, VerifyError> {
    let corners: Vec<V3> = (0..8)
        .map(|k| {
            V3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)) * 0.02 - V3::repeat(0.01)
        })
        .collect();
    let faces = [
        [0, 2, 3],
        [0, 3, 1],
        [4, 5, 7],
        [4, 7, 6],
        [0, 1, 5],
        [0, 5, 4],
        [2, 6, 7],
        [2, 7, 3],
        [0, 4, 6],
        [0, 6, 2],
        [1, 3, 7],
        [1, 7, 5],
    ];
    Ok(Surface::Mesh(Mesh::new(&corners, &faces)?))
}

/// Head-on against a face's diagonal, an edge, a corner.
pub const MESH_IMPACT: Claim = Claim {
    id: "mesh-edge-and-corner",
    title: "Head-on against an edge or a corner a sphere meets one contact, not two or three",
    tags: &["D5"],
    measures: "Contact time against a cube of triangles, and the velocity it returns with, sideways included: the worse of the two \
               relative errors. k: 1 the diagonal of a face, 2 an edge, 3 a corner, exactly",
    reference: Reference {
        source: "Hertz's time with the stiffness of a sphere on a plane, which the code takes for every feature; -v",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "k (faces that meet)", short: &[1.0, 2.0, 3.0], full: &[1.0, 2.0, 3.0] },
    order: None,
    tolerance: Tolerance {
        value: 2e-5,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "The error of the contact time at 200 steps, see `hertz-contact-time`; a second contact would shorten it by a quarter",
    },
    kind: Kind::Verification,
    measure: |_, faces| {
        let direction = match faces as u32 {
            1 => V3::x(),
            2 => V3::new(1.0, 1.0, 0.0),
            _ => V3::repeat(1.0),
        };
        let feature = direction * 0.01;
        let direction = direction.normalize();
        let (young, v) = (7e8, 0.5);
        let mut s = setup(young, elastic());
        s.walls = vec![wall("cube", cube()?)];
        s.steps_per_contact = 200.0;
        s.design_speed_m_s = v;
        s.grains = vec![
            Grain::sphere(RADIUS, feature + direction * (RADIUS * (1.0 + 1e-12)), 0).moving(direction * -v),
        ];
        let mut d = Dem::new(&s)?;
        d.step(1)?;
        let mut most = 0;
        while let Some(n) = d.wall_contacts().iter().map(|w| w.contacts.len()).max().filter(|&n| n > 0) {
            most = most.max(n);
            d.step(1)?;
        }
        let b = d.bodies();
        let apart = (b.position[0] - feature).norm() - RADIUS;
        let time = d.time() - apart / b.velocity[0].norm();
        let exact = hertz_time(mass(RADIUS), hertz_stiffness(young, POISSON, (RADIUS, f64::INFINITY)), v);
        let returned = (b.velocity[0] - direction * v).norm() / v;
        let mut sample = Sample::relative(faces, time, exact)
            .with("error of the velocity", returned)
            .with("contacts at once", most as f64);
        sample.error = worst(&[sample.error, returned]);
        Ok(sample)
    },
};

/// Head-on far beyond the design speed.
pub const GUARD: Claim = Claim {
    id: "guard-names-the-pair",
    title: "A run that overlaps too far stops and names the pair",
    tags: &["D3"],
    measures: "Of six collisions (pair and wall; design speed 0.5 m/s; Verlet, Gear, Gear conservative) those that end otherwise than \
               they should",
    reference: Reference {
        source: "At the design speed and at twice it no guard stops the run; at a hundred times it the guard does, and names grains 0 \
                 and 1, or grain 0 and the wall",
        uncertainty: 0.0,
    },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "v/v_design", short: &[1.0, 100.0], full: &[1.0, 2.0, 100.0, 1000.0] },
    order: None,
    tolerance: Tolerance {
        value: 0.0,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "It stops or it does not",
    },
    kind: Kind::Verification,
    measure: guard,
};

fn guard(_: &dyn Backend, factor: f64) -> Result<Sample, VerifyError> {
    let design = 0.5;
    let (mut wrong, mut largest) = (0, 0.0f64);
    for integrator in [Integrator::Verlet, Integrator::Gear, Integrator::GearConservative] {
        for with_wall in [false, true] {
            let mut s = head_on(setup(7e6, elastic()), (RADIUS, RADIUS), factor * design, 0.0);
            if with_wall {
                s.walls = vec![floor()];
                s.grains =
                    vec![Grain::sphere(RADIUS, V3::z() * RADIUS, 0).moving(V3::z() * (-factor * design))];
            }
            (s.design_speed_m_s, s.integrator) = (design, integrator);
            let named = if with_wall { "grain 0 and wall `floor`" } else { "grains 0 and 1" };
            let ended = Dem::new(&s)?.step(1000);
            let as_it_should = match ended {
                Ok(()) => factor < 50.0,
                Err(DemError::Overlap { pair, share, .. }) => {
                    largest = largest.max(share);
                    factor > 50.0 && pair.to_string() == named
                }
                Err(_) => false,
            };
            wrong += u32::from(!as_it_should);
        }
    }
    Ok(Sample::absolute(factor, f64::from(wrong), 0.0).with("largest overlap when stopped / r", largest))
}

/// No friction at all.
pub const NO_FRICTION: Claim = Claim {
    id: "hard-no-friction",
    title: "Without friction nothing ever changes a spin",
    tags: &["D2"],
    measures: "Change of a sphere's spin over its size, and of its tangential speed over 1 m/s, after bounces between floor and \
               ceiling; the worse of the two",
    reference: Reference { source: "Zero: the normal force has no arm", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "n (steps)", short: &[2e4], full: &[2e4, 2e5] },
    order: None,
    tolerance: Tolerance {
        value: 0.0,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "The tangential force is not computed at all: exact",
    },
    kind: Kind::Verification,
    measure: |_, steps| {
        let mut s = setup(7e6, elastic());
        s.walls = vec![floor(), plane("ceiling", V3::z() * 0.011, -V3::z())];
        s.gravity = V3::z() * -G;
        let (v, w) = (V3::new(1.0, 0.5, -0.8), V3::new(30.0, -20.0, 10.0));
        s.grains = vec![Grain::sphere(RADIUS, V3::z() * 5.5e-3, 0).moving(v).spinning(w)];
        let mut d = Dem::new(&s)?;
        let (mut bounces, mut before) = (0u32, false);
        for _ in 0..steps as u64 {
            d.step(1)?;
            let now = d.wall_contacts().iter().any(|w| !w.contacts.is_empty());
            bounces += u32::from(now && !before);
            before = now;
        }
        let b = d.bodies();
        let change =
            worst(&[(b.spin[0] - w).norm() / w.norm(), b.velocity[0].x - v.x, b.velocity[0].y - v.y]);
        Ok(Sample::absolute(steps, change, 0.0).with("bounces", f64::from(bounces)))
    },
};
