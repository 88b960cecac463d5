//! Files of grains, in a fluid or without.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::walls;
use crate::output::OutputError;
use crate::output::csv::Series;
use crate::output::pvd::Collection;
use crate::output::vtp::{Cells, PolyData};
use crate::plan::grains::{COLUMNS, GrainPlan};
use crate::run::folder::Folder;
use crate::run::view::View;
use crate::state::{State, StateError, Tape};

/// Knows the folder and what has been written.
pub(in crate::run) struct Files<'a> {
    folder: Arc<Folder>,
    plan: &'a GrainPlan,
    size_m: [f64; 3],
    collections: [(&'static str, Collection); 4],
    written: usize,
}

impl State for Files<'_> {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let Self { collections, written, folder: _, plan: _, size_m: _ } = self;
        collections.iter_mut().try_for_each(|(_, collection)| collection.state(tape))?;
        written.state(tape)
    }
}

impl<'a> Files<'a> {
    /// Of a plan in a box of edges `size_m`, m.
    pub fn new(plan: &'a GrainPlan, size_m: [f64; 3], folder: Arc<Folder>) -> Self {
        Self {
            folder,
            plan,
            size_m,
            collections: ["grains", "spheres", "contacts", "walls"].map(|name| (name, Collection::default())),
            written: 0,
        }
    }

    fn path(&self, name: &str) -> Result<PathBuf, OutputError> {
        self.folder.file(name)
    }

    /// Grains, their spheres, contacts and walls now.
    pub(crate) fn snapshot(&mut self, grains: &View<'_>) -> Result<(), OutputError> {
        let (pieces, faces) = (&self.plan.setup.walls, self.plan.walls.faces.len());
        // Spheres of clumps only where there are clumps; walls once, unless they move.
        let moving = self.written == 0 || pieces.iter().any(crate::dem::Wall::shifts);
        let wanted = [true, self.plan.numbers.clumps > 0, true, moving && walls::any(pieces, faces)];
        for kind in (0..4).filter(|&kind| wanted[kind]) {
            let name = format!("{}_{:06}.vtp", self.collections[kind].0, self.written);
            let path = self.path(&name)?;
            match kind {
                0 => self.bodies(grains, &path)?,
                1 => self.spheres(grains, &path)?,
                2 => contacts(grains, &path)?,
                _ => walls::write(&path, grains.dem, faces, self.size_m)?,
            }
            let (stem, collection) = &mut self.collections[kind];
            collection.push(grains.time, &name);
            collection.write(&self.folder.file(&format!("{stem}.pvd"))?)?;
        }
        self.written += 1;
        Ok(())
    }

    /// Number of the set of a grain.
    fn set(&self, id: u32) -> i64 {
        self.plan.sets.iter().position(|(_, range)| range.contains(&(id as usize))).map_or(-1, |k| k as i64)
    }

    fn bodies(&self, grains: &View<'_>, path: &Path) -> Result<(), OutputError> {
        let b = grains.dem.bodies();
        let points: Vec<[f64; 3]> = b.position.iter().map(|&x| x.into()).collect();
        let turned: Vec<[f64; 4]> = (0..b.len()).map(|i| self.orientation(grains, i)).collect();
        PolyData::new(&points, Cells::Points, grains.time)
            .at_points("velocity_m_per_s", &triples(&b.velocity))
            .at_points("spin_rad_per_s", &triples(&b.spin))
            .at_points("contact_force_n", &triples(&b.force))
            .at_points("radius_m", &b.radius.iter().map(|&r| [r]).collect::<Vec<_>>())
            .at_points("orientation_wxyz", &turned)
            .count_at_points("number", grains.ids.iter().map(|&id| i64::from(id)))
            .count_at_points("set", grains.ids.iter().map(|&id| self.set(id)))
            .count_at_points("material", grains.setup.grains.iter().map(|g| g.material as i64))
            .count_at_points("driven", b.inverse_mass.iter().map(|&m| i64::from(m == 0.0)))
            .write(path)
    }

    /// Quaternion (w, x, y, z) that turns the clump as the scene draws it.
    fn orientation(&self, grains: &View<'_>, i: usize) -> [f64; 4] {
        let q = grains.dem.bodies().orientation[i];
        let q = match grains.setup.grains[i].shape {
            crate::dem::Shape::Sphere => q,
            crate::dem::Shape::Clump(k) => q * grains.setup.clumps[k].frame.inverse(),
        };
        [q.w, q.i, q.j, q.k]
    }

    /// The spheres that clumps consist of, with those of single spheres.
    fn spheres(&self, grains: &View<'_>, path: &Path) -> Result<(), OutputError> {
        let members = grains.dem.members();
        let points: Vec<[f64; 3]> = members.iter().map(|m| m.position.into()).collect();
        let velocity: Vec<[f64; 3]> = members.iter().map(|m| m.velocity.into()).collect();
        let id = |body: u32| grains.ids[body as usize];
        PolyData::new(&points, Cells::Points, grains.time)
            .at_points("velocity_m_per_s", &velocity)
            .at_points("radius_m", &members.iter().map(|m| [m.radius]).collect::<Vec<_>>())
            .count_at_points("number", members.iter().map(|m| i64::from(id(m.body))))
            .count_at_points("set", members.iter().map(|m| self.set(id(m.body))))
            .write(path)
    }

    /// One table per set, as a scene can read it.
    pub(crate) fn tables(&self, grains: &View<'_>) -> Result<(), OutputError> {
        let b = grains.dem.bodies();
        for (name, range) in &self.plan.sets {
            let mut table = Series::new(&COLUMNS);
            for i in (0..b.len()).filter(|&i| range.contains(&(grains.ids[i] as usize))) {
                let vectors = [b.velocity[i], b.spin[i]];
                let mut row: Vec<f64> = b.position[i].iter().copied().collect();
                row.push(b.radius[i]);
                row.extend(vectors.iter().flat_map(|v| v.iter().copied()));
                row.extend(self.orientation(grains, i));
                table.push(&row)?;
            }
            table.write(&self.path(&format!("grains_final_{name}.csv"))?)?;
        }
        Ok(())
    }
}

fn triples(vectors: &[crate::dem::V3]) -> Vec<[f64; 3]> {
    vectors.iter().map(|&v| v.into()).collect()
}

/// The contact network: a line per contact, from centre to centre, or from centre to wall.
fn contacts(grains: &View<'_>, path: &Path) -> Result<(), OutputError> {
    let dem = grains.dem;
    let members = dem.members();
    let (mut points, mut force, mut strength, mut overlap) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut add =
        |from: crate::dem::V3, to: crate::dem::V3, f: crate::dem::V3, n: crate::dem::V3, depth: f64| {
            points.extend([<[f64; 3]>::from(from), to.into()]);
            force.push(f.into());
            strength.push([f.dot(&n)]);
            overlap.push([depth]);
        };
    for c in dem.contacts() {
        let (a, b) = (&members[c.members.0], &members[c.members.1]);
        let apart = a.radius + b.radius - c.overlap;
        add(a.position, a.position - c.normal * apart, c.force, c.normal, c.overlap);
    }
    for near in dem.wall_contacts() {
        let m = &members[near.member as usize];
        for c in &near.contacts {
            add(m.position, m.position - c.normal * (m.radius - c.overlap), c.force, c.normal, c.overlap);
        }
    }
    let lines: Vec<[u32; 2]> = (0..points.len() as u32 / 2).map(|k| [2 * k, 2 * k + 1]).collect();
    PolyData::new(&points, Cells::Lines(&lines), grains.time)
        .at_cells("force_n", &force)
        .at_cells("normal_force_n", &strength)
        .at_cells("overlap_m", &overlap)
        .write(path)
}
