//! Sets of a scene to grains at places.

use std::ops::Range;

use super::beside::path_of;
use super::speed::check_count;
use crate::dem::packing::{self, Lattice, Random, Region, Sizes};
use crate::dem::{Clump, DemError, Grain, Orientation, Period, Setup, Shape as Form, Sphere, V3};
use crate::geometry::{Axis, Shape};
use crate::output::csv::Series;
use crate::plan::PlanProblem;
use crate::scene::dry::{
    ClumpMembers, DryScene, GrainAt, GrainSet, IntegratorChoice, LatticeKind, Orientations, Placement,
    SizeChoice,
};

type Refused = (String, PlanProblem);

/// Radii drawn to find the mean volume of a distribution.
const DRAWS: u32 = 20_000;

/// Fills in clumps and grains; gives the name and the numbers of each set.
pub(super) fn place(
    scene: &DryScene,
    setup: &mut Setup,
    available: Option<u64>,
) -> Result<Vec<(String, Range<usize>)>, Refused> {
    for (i, shape) in scene.grains.clumps.iter().enumerate() {
        let clump = match &shape.members {
            ClumpMembers::Tetrahedron { edge_over_radius } => Clump::tetrahedron(1.0, *edge_over_radius),
            ClumpMembers::Spheres(members) => {
                let sphere = |m: &crate::scene::dry::ClumpMember| Sphere {
                    centre: m.centre_m.into(),
                    radius: m.radius_m,
                };
                Clump::new(&shape.name, &members.iter().map(sphere).collect::<Vec<_>>())
            }
        };
        let clump = clump
            .map_err(|e| (format!("grains.clumps[{i}]"), PlanProblem::Grains { what: e.to_string() }))?;
        let sound = clump.volume > 0.0 && clump.inertia.iter().all(|i| *i > 0.0 && i.is_finite());
        if !sound {
            let problem = PlanProblem::GrainScale { quantity: "the inertia of this clump" };
            return Err((format!("grains.clumps[{i}].members"), problem));
        }
        setup.clumps.push(clump);
    }
    let mut sets = Vec::new();
    for (i, set) in scene.grains.sets.iter().enumerate() {
        let path = format!("grains.sets[{i}].place");
        let first = setup.grains.len();
        let one = Set::new(scene, setup, set, i);
        let counted = |grains: f64| {
            let total = first as f64 + grains;
            let gear = scene.grains.numerics.integrator != IntegratorChoice::Verlet;
            check_count(total, one.members, gear, available)
        };
        let grains =
            one.grains(scene, &counted).map_err(|(key, problem)| (format!("{path}.{key}"), problem))?;
        setup.grains.extend(grains);
        sets.push((set.name.clone(), first..setup.grains.len()));
    }
    Ok(sets)
}

/// One set with what its names mean.
struct Set<'a> {
    set: &'a GrainSet,
    material: usize,
    clump: Option<(usize, &'a Clump)>,
    /// Spheres per grain.
    members: f64,
    /// Radius of the sphere around a grain over its own.
    reach: f64,
    /// Makes sets with the same seed different.
    salt: u64,
}

impl<'a> Set<'a> {
    fn new(scene: &DryScene, setup: &'a Setup, set: &'a GrainSet, number: usize) -> Self {
        let index =
            set.clump.as_ref().and_then(|name| scene.grains.clumps.iter().position(|c| &c.name == name));
        let clump = index.and_then(|k| setup.clumps.get(k).map(|c| (k, c)));
        Self {
            set,
            material: scene.material(set.material.as_deref()).unwrap_or(0),
            clump,
            members: clump.map_or(1.0, |(_, c)| c.members.len() as f64),
            reach: clump.map_or(1.0, |(_, c)| c.reach / c.equivalent_radius()),
            salt: 0x5851_F42D_4C95_7F2D_u64.wrapping_mul(number as u64 + 1),
        }
    }

    fn grains(
        &self,
        scene: &DryScene,
        counted: &dyn Fn(f64) -> Result<(), PlanProblem>,
    ) -> Result<Vec<Grain>, (&'static str, PlanProblem)> {
        match &self.set.place {
            Placement::List(list) => {
                counted(list.len() as f64).map_err(|problem| ("list", problem))?;
                Ok(self.listed(list))
            }
            Placement::Csv { file } => {
                let list = table(scene, file).map_err(|problem| ("csv.file", problem))?;
                counted(list.len() as f64).map_err(|problem| ("csv.file", problem))?;
                Ok(self.listed(&list))
            }
            Placement::Lattice { kind, region, radius_m, spacing_m, seed } => {
                let at = |problem| ("lattice", problem);
                let radius = radius_m * self.reach;
                let spacing = spacing_m.unwrap_or(2.0 * radius).max(2.0 * radius);
                let (kind, room) = match kind {
                    LatticeKind::SimpleCubic => (Lattice::SimpleCubic, 1.0),
                    LatticeKind::BodyCentred => (Lattice::BodyCentred, 4.0 / (3.0 * 3f64.sqrt())),
                    LatticeKind::FaceCentred => (Lattice::FaceCentred, std::f64::consts::FRAC_1_SQRT_2),
                };
                let region = self::region(region);
                counted(region.volume() / (room * spacing * spacing * spacing)).map_err(at)?;
                let spheres =
                    packing::lattice(kind, radius, spacing, &region).map_err(packing_error).map_err(at)?;
                if spheres.is_empty() {
                    return Err(at(PlanProblem::NoGrainFits { radius_m: radius }));
                }
                Ok(self.filled(&spheres, *seed))
            }
            Placement::Random { region, count, solid_fraction, sizes, gap_m, seed } => {
                let at = |problem| ("random", problem);
                let region = self::region(region);
                let sizes = self.sizes(sizes);
                let count = match (count, solid_fraction) {
                    (Some(count), _) => *count as f64,
                    (None, share) => {
                        let cube = self.reach * self.reach * self.reach;
                        let volume = mean_volume(&sizes, *seed).map_err(packing_error).map_err(at)? / cube;
                        (share.unwrap_or(0.0) * region.volume() / volume).round().max(1.0)
                    }
                };
                counted(count).map_err(at)?;
                let spheres = packing::scatter(count as usize, &sizes, *gap_m, &region, *seed);
                Ok(self.filled(&spheres.map_err(packing_error).map_err(at)?, *seed))
            }
        }
    }

    /// The distribution of the spheres around the grains.
    fn sizes(&self, sizes: &SizeChoice) -> Sizes {
        let s = self.reach;
        match sizes {
            SizeChoice::Equal { radius_m } => Sizes::One(s * radius_m),
            SizeChoice::Uniform { least_radius_m, largest_radius_m } => {
                Sizes::Uniform { least: s * least_radius_m, largest: s * largest_radius_m }
            }
            SizeChoice::LogNormal { median_radius_m, deviation, least_radius_m, largest_radius_m } => {
                Sizes::LogNormal {
                    median: s * median_radius_m,
                    deviation: *deviation,
                    least: s * least_radius_m,
                    largest: s * largest_radius_m,
                }
            }
            SizeChoice::Sieve { passing } => Sizes::Sieve(passing.iter().map(|p| (s * p[0], p[1])).collect()),
        }
    }

    fn filled(&self, spheres: &[Sphere], seed: u64) -> Vec<Grain> {
        let mut random = Random::new(seed ^ self.salt);
        let turned = self.clump.is_some() && self.set.orientation == Orientations::Random;
        spheres
            .iter()
            .map(|s| {
                let drawn = if turned { random.orientation() } else { Orientation::identity() };
                self.grain(s.centre, s.radius / self.reach, drawn, &mut random)
            })
            .collect()
    }

    fn listed(&self, list: &[GrainAt]) -> Vec<Grain> {
        let mut random = Random::new(self.salt);
        list.iter()
            .map(|g| {
                let [w, x, y, z] = g.orientation.unwrap_or([1.0, 0.0, 0.0, 0.0]);
                let drawn = Orientation::new_normalize(nalgebra::Quaternion::new(w, x, y, z));
                let mut grain = self.grain(g.position_m.into(), g.radius_m, drawn, &mut random);
                grain.velocity += V3::from(g.velocity_m_per_s);
                grain.spin += V3::from(g.spin_rad_per_s);
                grain
            })
            .collect()
    }

    /// A grain; `drawn` turns the clump as the scene draws it.
    fn grain(&self, centre: V3, radius: f64, drawn: Orientation, random: &mut Random) -> Grain {
        let shape = self.clump.map_or(Form::Sphere, |(k, _)| Form::Clump(k));
        let frame = self.clump.map_or_else(Orientation::identity, |(_, c)| c.frame);
        let noise = self.set.random_speed_m_per_s;
        let jitter = if noise > 0.0 { V3::from_fn(|_, _| noise * random.normal()) } else { V3::zeros() };
        Grain {
            shape,
            radius,
            material: self.material,
            position: centre,
            velocity: V3::from(self.set.velocity_m_per_s) + jitter,
            orientation: drawn * frame,
            spin: self.set.spin_rad_per_s.into(),
            driven: self.set.driven,
        }
    }
}

fn region(shape: &Shape) -> Region {
    match shape {
        Shape::Sphere { centre_m, radius_m } => {
            Region::Sphere { centre: (*centre_m).into(), radius: *radius_m }
        }
        Shape::Cylinder { point_m, direction, radius_m, length_m } => Region::Cylinder {
            base: (*point_m).into(),
            axis: V3::from(*direction).normalize(),
            radius: *radius_m,
            height: length_m.unwrap_or(0.0),
        },
        // The check of the scene lets only boxes come here.
        other => {
            let bounds = other.bounds();
            Region::Box { low: bounds.min.into(), high: bounds.max.into() }
        }
    }
}

/// Mean volume of the grains of a distribution, m³.
fn mean_volume(sizes: &Sizes, seed: u64) -> Result<f64, DemError> {
    sizes.check()?;
    let mut random = Random::new(seed);
    let cubes = (0..DRAWS).map(|_| {
        let r = sizes.draw(&mut random);
        r * r * r
    });
    Ok(4.0 / 3.0 * std::f64::consts::PI * cubes.sum::<f64>() / f64::from(DRAWS))
}

fn packing_error(error: DemError) -> PlanProblem {
    match error {
        DemError::PackingFull { placed, wanted, .. } => PlanProblem::PackingFull { placed, wanted },
        other => PlanProblem::Grains { what: other.to_string() },
    }
}

/// Columns of a table of grains, in the order they are written.
pub(crate) const COLUMNS: [(&str, &str); 14] = [
    ("x", "m"),
    ("y", "m"),
    ("z", "m"),
    ("radius", "m"),
    ("velocity_x", "m/s"),
    ("velocity_y", "m/s"),
    ("velocity_z", "m/s"),
    ("spin_x", "rad/s"),
    ("spin_y", "rad/s"),
    ("spin_z", "rad/s"),
    ("orientation_w", "-"),
    ("orientation_x", "-"),
    ("orientation_y", "-"),
    ("orientation_z", "-"),
];

fn table(scene: &DryScene, file: &str) -> Result<Vec<GrainAt>, PlanProblem> {
    let refuse =
        |what: String| PlanProblem::BadFile { file: file.to_owned(), kind: "a table of grains", what };
    let path = path_of(scene, file).map_err(refuse)?;
    let series = Series::read(&path).map_err(|error| {
        refuse(match error {
            crate::output::OutputError::Io { source, .. } => source.kind().to_string(),
            crate::output::OutputError::Malformed { line, problem, .. } => format!("line {line}: {problem}"),
            other => other.to_string(),
        })
    })?;
    let mut index = [None; 14];
    for (k, column) in series.columns.iter().enumerate() {
        let Some(known) = COLUMNS.iter().position(|(name, _)| *name == column.name) else {
            return Err(refuse(format!("line 1: column `{}` is not known", column.name)));
        };
        if column.unit != COLUMNS[known].1 {
            let (name, unit) = COLUMNS[known];
            return Err(refuse(format!("line 1: `{name}` is in {}, not in {unit}", column.unit)));
        }
        index[known] = Some(k);
    }
    let missing = COLUMNS.iter().zip(&index).take(4).find(|(_, index)| index.is_none());
    if let Some(((name, unit), _)) = missing {
        return Err(refuse(format!("line 1: column `{name} [{unit}]` is missing")));
    }
    if series.rows.is_empty() {
        return Err(refuse("it has no rows".to_owned()));
    }
    let turned = index[10..].iter().all(Option::is_some);
    let mut list = Vec::with_capacity(series.rows.len());
    for (k, row) in series.rows.iter().enumerate() {
        let at = |i: usize| index[i].map_or(0.0, |column| row[column]);
        let grain = GrainAt {
            position_m: [at(0), at(1), at(2)],
            radius_m: at(3),
            velocity_m_per_s: [at(4), at(5), at(6)],
            spin_rad_per_s: [at(7), at(8), at(9)],
            orientation: turned.then(|| [at(10), at(11), at(12), at(13)]),
        };
        let line = k + 2;
        if row.iter().any(|x| !x.is_finite()) {
            return Err(refuse(format!("line {line}: a number is not finite")));
        }
        if grain.radius_m <= 0.0 {
            return Err(refuse(format!("line {line}: the radius is {} m", grain.radius_m)));
        }
        if grain.orientation == Some([0.0; 4]) {
            return Err(refuse(format!("line {line}: the orientation is 0")));
        }
        list.push(grain);
    }
    Ok(list)
}

/// No centre outside the box; along periodic axes places are folded back into it.
pub(super) fn inside(
    scene: &DryScene,
    setup: &Setup,
    sets: &[(String, Range<usize>)],
    open: [[bool; 2]; 3],
) -> Result<(), Refused> {
    let Period(period) = setup.period;
    for (grain, g) in setup.grains.iter().enumerate() {
        for axis in Axis::ALL {
            let (k, size) = (axis.index(), scene.domain.size_m[axis.index()]);
            let x = g.position[k];
            // A driven grain may stand outside, as part of a bed.
            if period[k].is_none() && !(0.0..=size).contains(&x) && !g.driven {
                let grain = super::name(sets, grain);
                let open = open[k][usize::from(x > size)];
                let problem =
                    PlanProblem::GrainOutside { grain, axis: axis.letter(), at_m: x, size_m: size, open };
                return Err(("grains.sets".to_owned(), problem));
            }
        }
    }
    Ok(())
}
