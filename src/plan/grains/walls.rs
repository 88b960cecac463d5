//! Faces of the box and solids to walls that grains touch \[D5\].

use super::beside::path_of;
use super::meshes;
use crate::dem::walls::{Mesh, Side, Surface, Wall, WallMotion};
use crate::dem::{Orientation, V3};
use crate::geometry::{Axis, Shape};
use crate::plan::PlanProblem;
use crate::scene::dry::{DryScene, GrainSolid, MeshFile};
use crate::scene::{Boundary, FACE_KEYS};

/// Which walls belong to which name: one face is one wall, a union is several.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Walls {
    /// Face key and wall.
    pub faces: Vec<(&'static str, usize)>,
    /// Name of a solid and its walls.
    pub solids: Vec<(String, Vec<usize>)>,
}

type Refused = (String, PlanProblem);

/// Walls of a scene; `slippery` is the material of frictionless faces.
pub(super) fn walls(scene: &DryScene, slippery: Option<usize>) -> Result<(Walls, Vec<Wall>), Refused> {
    let (mut names, mut list) = (Walls::default(), Vec::new());
    let material = scene.material(scene.grains.wall_material.as_deref()).unwrap_or(0);
    for (axis, faces) in Axis::ALL.into_iter().zip(scene.domain.boundaries.by_axis()) {
        let a = axis.index();
        for (side, face) in faces.into_iter().enumerate() {
            let (material, velocity) = match face {
                Boundary::Periodic | Boundary::Open => continue,
                Boundary::NoSlip => (material, [0.0; 3]),
                Boundary::FreeSlip => (slippery.unwrap_or(material), [0.0; 3]),
                Boundary::MovingWall { velocity_m_per_s } => (material, velocity_m_per_s),
            };
            let (mut point, mut normal) = (V3::zeros(), V3::zeros());
            (point[a], normal[a]) = if side == 0 { (0.0, 1.0) } else { (scene.domain.size_m[a], -1.0) };
            let key = FACE_KEYS[a][side];
            names.faces.push((key, list.len()));
            let mut wall = Wall::fixed(key, Surface::Plane { point, normal }, material);
            wall.motion.velocity = velocity.into();
            list.push(wall);
        }
    }
    for (i, solid) in scene.solids.iter().enumerate() {
        let first = list.len();
        let material = scene.material(solid.material.as_deref()).unwrap_or(0);
        let surfaces =
            surfaces(scene, solid).map_err(|(key, problem)| (format!("solids[{i}].{key}"), problem))?;
        let motion = motion(solid, &surfaces);
        list.extend(surfaces.into_iter().map(|surface| Wall {
            name: solid.name.clone(),
            surface,
            material,
            motion,
        }));
        names.solids.push((solid.name.clone(), (first..list.len()).collect()));
    }
    Ok((names, list))
}

fn motion(solid: &GrainSolid, surfaces: &[Surface]) -> WallMotion {
    let drawn = solid.shape.as_ref().map(Shape::centre).filter(|c| c.iter().all(|x| x.is_finite()));
    let of_mesh = || match surfaces.first() {
        Some(Surface::Mesh(mesh)) => {
            let (low, high) = mesh.bounds();
            0.5 * (low + high)
        }
        _ => V3::zeros(),
    };
    WallMotion {
        velocity: solid.velocity_m_per_s.into(),
        spin: solid.spin_rad_per_s.into(),
        about: solid.centre_m.or(drawn).map_or_else(of_mesh, V3::from),
    }
}

fn surfaces(scene: &DryScene, solid: &GrainSolid) -> Result<Vec<Surface>, (&'static str, PlanProblem)> {
    if let Some(file) = &solid.mesh {
        return Ok(vec![Surface::Mesh(read(scene, file).map_err(|problem| ("mesh.file", problem))?)]);
    }
    let mut out = Vec::new();
    if let Some(shape) = &solid.shape {
        add(scene, shape, solid.invert, &mut out).map_err(|problem| ("shape", problem))?;
    }
    Ok(out)
}

fn add(scene: &DryScene, shape: &Shape, inverted: bool, out: &mut Vec<Surface>) -> Result<(), PlanProblem> {
    let side = if inverted { Side::Inside } else { Side::Outside };
    let broken = |error: crate::dem::DemError| {
        let what = error.to_string().trim_start_matches("mesh: ").to_owned();
        PlanProblem::BadWall { what }
    };
    match shape {
        Shape::Box { min_m, max_m } => {
            let (low, high) = (V3::from(*min_m), V3::from(*max_m));
            let (centre, half) = (0.5 * (low + high), 0.5 * (high - low));
            out.push(Surface::Box { centre, half, orientation: Orientation::identity(), side });
        }
        Shape::Cylinder { point_m, direction, radius_m, length_m } => {
            let axis = V3::from(*direction).normalize();
            let (point, radius) = (V3::from(*point_m), *radius_m);
            match length_m {
                None => out.push(Surface::Cylinder { point, axis, radius, half_length: None, side }),
                Some(length) if inverted => {
                    // Around grains: an endless cylinder closed by two planes.
                    out.push(Surface::Cylinder { point, axis, radius, half_length: None, side });
                    out.push(Surface::Plane { point, normal: axis });
                    out.push(Surface::Plane { point: point + axis * *length, normal: -axis });
                }
                Some(length) => {
                    let half = 0.5 * length;
                    let point = point + axis * half;
                    out.push(Surface::Cylinder { point, axis, radius, half_length: Some(half), side });
                }
            }
        }
        Shape::Sphere { centre_m, radius_m } => {
            out.push(Surface::Sphere { centre: (*centre_m).into(), radius: *radius_m, side });
        }
        Shape::HalfSpace { point_m, normal } => {
            let normal = V3::from(*normal) * if inverted { -1.0 } else { 1.0 };
            out.push(Surface::Plane { point: (*point_m).into(), normal });
        }
        Shape::Polygon { axis, points_m, from_m, to_m } => {
            let size = scene.domain.size_m[axis.index()];
            // An endless prism reaches one box length beyond the box.
            let ends = [from_m.unwrap_or(-size), to_m.unwrap_or(2.0 * size)];
            out.push(Surface::Mesh(meshes::prism(*axis, points_m, ends).map_err(broken)?));
        }
        Shape::Heightfield(field) => {
            out.push(Surface::Mesh(meshes::terrain(field, scene.domain.size_m).map_err(broken)?));
        }
        Shape::Union(parts) => parts.iter().try_for_each(|part| add(scene, part, false, out))?,
        Shape::Cone { base_m, direction, height_m, base_radius_m, top_radius_m } => {
            let (base, axis) = (V3::from(*base_m), V3::from(*direction).normalize());
            let radii = [*base_radius_m, *top_radius_m];
            // Around grains it is a funnel: open at both ends.
            let mesh = meshes::cone(base, axis, *height_m, radii, !inverted).map_err(broken)?;
            out.push(Surface::Mesh(mesh));
        }
        Shape::Intersection(_) | Shape::Difference { .. } => {
            // The check of the scene names these; nothing to touch is left here.
        }
    }
    Ok(())
}

fn read(scene: &DryScene, given: &MeshFile) -> Result<Mesh, PlanProblem> {
    let refused = |error: crate::dem::DemError| {
        // The message of the file names its folder; the scene's author knows the name.
        let what = match error {
            crate::dem::DemError::MeshFile { source, .. } => source.message.clone(),
            other => other.to_string().trim_start_matches("mesh: ").to_owned(),
        };
        PlanProblem::BadFile { file: given.file.clone(), kind: "an STL or OBJ mesh", what }
    };
    let kind = "an STL or OBJ mesh";
    let path = path_of(scene, &given.file).map_err(|what| PlanProblem::BadFile {
        file: given.file.clone(),
        kind,
        what,
    })?;
    let mesh = Mesh::read(&path).map_err(refused)?;
    let mesh = mesh.moved(given.scale.unwrap_or(1.0), given.shift_m.into()).map_err(refused)?;
    reaches_box(&mesh, scene.domain.size_m)?;
    Ok(mesh)
}

/// Meshes of which nothing is in the box are a wrong unit or place.
fn reaches_box(mesh: &Mesh, size_m: [f64; 3]) -> Result<(), PlanProblem> {
    let (low, high) = mesh.bounds();
    for axis in Axis::ALL {
        let (a, size) = (axis.index(), size_m[axis.index()]);
        // On a face it still touches grains.
        if high[a] < 0.0 || low[a] > size {
            let (low, high) = (low[a], high[a]);
            return Err(PlanProblem::MeshOutside { axis: axis.letter(), low, high, size });
        }
    }
    Ok(())
}
