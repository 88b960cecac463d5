//! From a set-up to the start of a run: checks and layout.

use super::bodies::{Bodies, Member};
use super::contact::pass::PairState;
use super::contact::{ContactEquations, Losses, StandardContact};
use super::integrate::Step;
use super::material::PairTable;
use super::neighbours::PairList;
use super::rotation::momentum_of;
use super::setup::{Grain, Shape};
use super::simulation::{Dem, place};
use super::stability::{Stable, stable};
use super::timestep::{FEWEST_STEPS, Shortest, shortest};
use super::walls::pass::Scenery;
use super::{Clump, DemError, Setup, V3};

/// Checks a set-up and lays out the state, without lists and forces.
pub(super) fn build(setup: &Setup) -> Result<Dem, DemError> {
    check_settings(setup)?;
    let table = setup.materials.compile()?;
    let count = setup.materials.list.len();
    let mut bodies = Bodies::default();
    let (mut members, mut offsets) = (Vec::new(), Vec::new());
    bodies.first_member.push(0);
    for (i, g) in setup.grains.iter().enumerate() {
        check_grain(i, g, count, setup.clumps.len())?;
        add_body(setup, i, g, &mut bodies, &mut members, &mut offsets)?;
    }
    let mut walls = Vec::with_capacity(setup.walls.len());
    for w in &setup.walls {
        if w.material >= count {
            return Err(DemError::UnknownMaterial { found: w.material, count });
        }
        walls.push(w.clone().checked()?);
    }
    let wall_materials: Vec<u32> = walls.iter().map(|w| w.material as u32).collect();
    let dt = time_step(setup, pace_of(setup, &table, (&bodies, &members, &offsets), &wall_materials))?;
    check_period(setup, &bodies, &members)?;
    for (m, offset) in members.iter_mut().zip(&offsets) {
        place(m, &bodies, offset);
    }
    Ok(Dem {
        bodies,
        members,
        offsets,
        table,
        scenery: Scenery::new(walls),
        period: setup.period,
        list: PairList::default(),
        pairs: PairState::default(),
        near: Vec::new(),
        near_of: Vec::new(),
        reference: Vec::new(),
        external: None,
        gear: None,
        step_setting: Step { dt, gravity: setup.gravity, turn_spheres: setup.turn_spheres },
        integrator: setup.integrator,
        skin: setup.skin,
        overlap_limit: setup.overlap_limit,
        steps: 0,
        rates: Losses::default(),
        lost: Losses::default(),
        external_work: 0.0,
        rebuilds: 0,
    })
}

/// What limits the time step of a set-up at its design speed.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Pace {
    /// The shortest contact.
    pub shortest: Shortest,
    /// Steps that springs and dashpots allow.
    pub stable: Stable,
    /// The step that `plan` chooses, s: as many steps in the shortest contact as asked for, and as short as dashpots and
    /// springs need for books of energy that close.
    pub suggested_s: f64,
}

impl Pace {
    /// Where nothing can be pushed, with a step for it, s.
    pub(crate) fn idle(step_s: f64) -> Self {
        let (seconds, limit_s, advised_s) = (f64::INFINITY, f64::INFINITY, f64::INFINITY);
        let nobody = String::from("none: all grains are driven");
        Self {
            shortest: Shortest { seconds, pair: nobody.clone() },
            stable: Stable { limit_s, advised_s, pair: nobody, motion: "anywhere" },
            suggested_s: step_s,
        }
    }
}

/// What limits the time step of a set-up, for showing it; `None` if nothing can touch.
///
/// # Errors
/// The bad input that [`Dem::new`] refuses, except for overlaps and the time step itself.
pub(crate) fn pace(setup: &Setup) -> Result<Option<Pace>, DemError> {
    let mut free = setup.clone();
    // Any step will do: only the layout is wanted.
    free.time_step_s = Some(f64::MIN_POSITIVE);
    let dem = build(&free)?;
    let walls: Vec<u32> = dem.scenery.walls.iter().map(|w| w.material as u32).collect();
    Ok(pace_of(setup, &dem.table, (&dem.bodies, &dem.members, &dem.offsets), &walls))
}

fn pace_of(
    setup: &Setup,
    table: &PairTable,
    parts: (&Bodies, &[Member], &[V3]),
    walls: &[u32],
) -> Option<Pace> {
    let shortest = shortest(table, parts.1, walls, setup.design_speed_m_s)?;
    let stable = stable(setup, table, parts, walls)?;
    let suggested_s = (shortest.seconds / setup.steps_per_contact).min(stable.advised_s);
    Some(Pace { shortest, stable, suggested_s })
}

fn check_settings(s: &Setup) -> Result<(), DemError> {
    let above = |x: f64| x > 0.0 && x.is_finite();
    let checks = [
        ("design speed (m/s)", s.design_speed_m_s, above(s.design_speed_m_s), "above 0"),
        (
            "steps per contact",
            s.steps_per_contact,
            s.steps_per_contact >= FEWEST_STEPS && s.steps_per_contact.is_finite(),
            "at least 10",
        ),
        ("skin (share of the radius)", s.skin, s.skin > 0.0 && s.skin <= 2.0, "above 0 and at most 2"),
        (
            "overlap limit (share of the radius)",
            s.overlap_limit,
            s.overlap_limit > 0.0 && s.overlap_limit < 1.0,
            "above 0 and below 1",
        ),
        (
            "start overlap (share of the radius)",
            s.start_overlap,
            s.start_overlap >= 0.0 && s.start_overlap < 1.0,
            "0 or more and below 1",
        ),
        ("gravity (m/s2)", s.gravity.norm(), s.gravity.iter().all(|g| g.is_finite()), "finite"),
    ];
    for (what, found, fine, allowed) in checks {
        if !fine {
            return Err(DemError::Setting { what, found, allowed });
        }
    }
    for length in s.period.0.into_iter().flatten() {
        if !above(length) {
            return Err(DemError::Setting { what: "period (m)", found: length, allowed: "above 0" });
        }
    }
    Ok(())
}

fn check_grain(grain: usize, g: &Grain, materials: usize, shapes: usize) -> Result<(), DemError> {
    if g.material >= materials {
        return Err(DemError::UnknownMaterial { found: g.material, count: materials });
    }
    if !(g.radius > 0.0 && g.radius.is_finite()) {
        return Err(DemError::GrainValue { grain, what: "radius (m)", found: g.radius, positive: true });
    }
    let q = g.orientation.coords;
    for (what, v) in [("position (m)", g.position), ("velocity (m/s)", g.velocity), ("spin (rad/s)", g.spin)]
    {
        if let Some(&found) = v.iter().find(|x| !x.is_finite()) {
            return Err(DemError::GrainValue { grain, what, found, positive: false });
        }
    }
    if let Some(&found) = q.iter().find(|x| !x.is_finite()) {
        return Err(DemError::GrainValue { grain, what: "orientation", found, positive: false });
    }
    match g.shape {
        Shape::Clump(found) if found >= shapes => Err(DemError::UnknownShape { grain, found, count: shapes }),
        _ => Ok(()),
    }
}

fn add_body(
    setup: &Setup,
    i: usize,
    g: &Grain,
    b: &mut Bodies,
    members: &mut Vec<Member>,
    offsets: &mut Vec<V3>,
) -> Result<(), DemError> {
    let density = setup.materials.list[g.material].density_kg_m3;
    let member = |radius: f64, inverse_mass: f64| Member {
        position: V3::zeros(),
        radius,
        velocity: V3::zeros(),
        spin: V3::zeros(),
        inverse_mass,
        body: i as u32,
        material: g.material as u32,
    };
    let free = if g.driven { 0.0 } else { 1.0 };
    let (mass, inertia) = match g.shape {
        Shape::Sphere => {
            let mass = density * 4.0 / 3.0 * std::f64::consts::PI * g.radius * g.radius * g.radius;
            members.push(member(g.radius, free / mass));
            offsets.push(V3::zeros());
            (mass, V3::repeat(0.4 * mass * g.radius * g.radius))
        }
        Shape::Clump(k) => {
            let c: Clump = setup.clumps[k].with_equivalent_radius(g.radius)?;
            let mass = density * c.volume;
            for s in &c.members {
                members.push(member(s.radius, free / mass));
                offsets.push(s.centre);
            }
            (mass, c.inertia * density)
        }
    };
    b.position.push(g.position);
    b.velocity.push(g.velocity);
    b.spin.push(g.spin);
    b.orientation.push(g.orientation);
    b.momentum.push(if g.shape == Shape::Sphere {
        V3::zeros()
    } else {
        momentum_of(&g.orientation, &inertia, &g.spin)
    });
    b.force.push(V3::zeros());
    b.torque.push(V3::zeros());
    b.mass.push(mass);
    b.inverse_mass.push(free / mass);
    b.inertia.push(inertia);
    b.inverse_inertia.push(inertia.map(|x| free / x));
    b.radius.push(g.radius);
    b.shape.push(g.shape);
    b.first_member.push(members.len() as u32);
    if g.driven {
        b.driven.push(i as u32);
    }
    Ok(())
}

fn time_step(s: &Setup, pace: Option<Pace>) -> Result<f64, DemError> {
    let dt = match (s.time_step_s, &pace) {
        (Some(dt), _) => dt,
        (None, Some(pace)) => {
            let asked = pace.shortest.seconds / s.steps_per_contact;
            if asked <= pace.stable.limit_s { asked } else { pace.suggested_s }
        }
        (None, None) => {
            return Err(DemError::Setting {
                what: "time step (s)",
                found: f64::NAN,
                allowed: "given, as no grain can touch",
            });
        }
    };
    if !(dt > 0.0 && dt.is_finite()) {
        return Err(DemError::Setting { what: "time step (s)", found: dt, allowed: "above 0" });
    }
    let Some(Pace { shortest, stable, suggested_s }) = pace else { return Ok(dt) };
    if dt * FEWEST_STEPS > shortest.seconds * (1.0 + 1e-12) {
        return Err(DemError::TimeStep {
            found_s: dt,
            pair: shortest.pair,
            contact_s: shortest.seconds,
            speed_m_s: s.design_speed_m_s,
            steps: FEWEST_STEPS,
            limit_s: (shortest.seconds / FEWEST_STEPS).min(stable.limit_s),
        });
    }
    if dt > stable.limit_s * (1.0 + 1e-12) {
        return Err(DemError::Unstable {
            found_s: dt,
            pair: stable.pair,
            motion: stable.motion,
            speed_m_s: s.design_speed_m_s,
            limit_s: stable.limit_s,
            advised_s: suggested_s,
        });
    }
    Ok(dt)
}

fn check_period(s: &Setup, b: &Bodies, members: &[Member]) -> Result<(), DemError> {
    let largest = members.iter().map(|m| m.radius).fold(0.0, f64::max);
    // A clump must not meet its own image: its extent is below its members' offsets plus radii.
    let extent = (0..b.len())
        .filter_map(|i| match s.grains[i].shape {
            Shape::Sphere => None,
            Shape::Clump(k) => Some(2.0 * s.clumps[k].reach * b.radius[i] / s.clumps[k].equivalent_radius()),
        })
        .fold(0.0, f64::max);
    // A single sphere only has to leave room for itself.
    let needed_m = match b.len() {
        1 if extent == 0.0 => 2.0 * largest,
        _ => (4.0 * largest * (1.0 + s.skin)).max(extent + 2.0 * largest * (1.0 + s.skin)),
    };
    for k in 0..3 {
        if let Some(length_m) = s.period.0[k].filter(|&l| l <= needed_m) {
            return Err(DemError::PeriodTooShort { axis: ['x', 'y', 'z'][k], length_m, needed_m });
        }
    }
    Ok(())
}

impl Dem {
    /// Checks a set-up and finds the forces at the start.
    ///
    /// # Errors
    /// Everything [`DemError`] lists as bad input.
    pub fn new(setup: &Setup) -> Result<Self, DemError> {
        Self::with_equations(setup, StandardContact)
    }

    /// As [`Dem::new`], with other equations of contact: for trials, which go on with [`Dem::step_with`].
    ///
    /// # Errors
    /// Everything [`DemError`] lists as bad input.
    pub fn with_equations(setup: &Setup, equations: impl ContactEquations) -> Result<Self, DemError> {
        let mut dem = build(setup)?;
        dem.renew_lists();
        dem.check_start(setup)?;
        dem.forces(equations, 0.0)?;
        dem.rates = dem.rates_now();
        dem.start_gear();
        Ok(dem)
    }

    /// No overlap beyond what the set-up allows, between bodies and with walls.
    pub(super) fn check_start(&self, setup: &Setup) -> Result<(), DemError> {
        for (p, &(a, b)) in self.list.pairs.iter().enumerate() {
            let (_, overlap_m, _) = self.overlap_of(p);
            let (a, b) = (&self.members[a as usize], &self.members[b as usize]);
            let allowed_m = setup.start_overlap * a.radius.min(b.radius);
            if overlap_m > allowed_m && a.inverse_mass + b.inverse_mass > 0.0 {
                let (first, second) = (a.body as usize, b.body as usize);
                return Err(DemError::StartOverlap { first, second, overlap_m, allowed_m });
            }
        }
        let mut found = Vec::new();
        for n in &self.near {
            let m = &self.members[n.member as usize];
            for c in &n.candidates {
                found.clear();
                let k = c.wall as usize;
                let wall = &self.scenery.walls[k];
                let x = m.position + c.image;
                super::walls::near(
                    wall,
                    &self.scenery.poses[k],
                    false,
                    &x,
                    m.radius,
                    c.triangles.as_deref(),
                    &mut found,
                );
                let overlap_m = found.iter().map(|t| m.radius - t.distance).fold(0.0, f64::max);
                let allowed_m = setup.start_overlap * m.radius;
                if overlap_m > allowed_m && m.inverse_mass > 0.0 {
                    let (grain, wall) = (m.body as usize, wall.name.clone());
                    return Err(DemError::StartOverlapWall { grain, wall, overlap_m, allowed_m });
                }
            }
        }
        Ok(())
    }
}
