//! The free surface of a run as a mesh.

use crate::lattice::C;
use crate::output::isosurface::{Grid, Mesh, surface};
use crate::setup::{Face, Setup};
use crate::solver::run::Fields;
use crate::units::Units;

/// The surface where the fill, taken at cell centres, is ½; corners in m, carried vectors in m/s.
///
/// Solids and the outside of walls count as empty, so that the mesh closes there: full cells end exactly
/// on the wall. Through periodic faces and mirror planes the fluid goes on, and the mesh is open there. A
/// film of less than half a cell has no mesh.
pub(super) fn free_surface(setup: &Setup, fields: &Fields, units: &Units) -> Mesh {
    let n = setup.extents;
    let goes_on = |face: Face| matches!(face, Face::Periodic | Face::FreeSlip);
    let planes: [Vec<f64>; 3] = std::array::from_fn(|a| {
        let [low, high] = setup.faces[a].map(goes_on);
        let mut planes = vec![if low { 0.0 } else { -0.5 }];
        planes.extend((0..n[a]).map(|i| i as f64 + 0.5));
        planes.push(if high { n[a] as f64 } else { n[a] as f64 + 0.5 });
        planes.into_iter().map(|x| units.length_to_si(x)).collect()
    });
    // The cell whose values a plane takes; none outside a wall.
    let cell_of = |a: usize, plane: usize| match plane {
        0 => goes_on(setup.faces[a][0]).then_some(0),
        p if p > n[a] => goes_on(setup.faces[a][1]).then_some(n[a] - 1),
        p => Some(p - 1),
    };
    let count = planes.iter().map(Vec::len).product();
    let (mut values, mut vectors) = (Vec::with_capacity(count), Vec::with_capacity(count));
    for k in 0..planes[2].len() {
        for j in 0..planes[1].len() {
            for i in 0..planes[0].len() {
                let (Some(x), Some(y), Some(z)) = (cell_of(0, i), cell_of(1, j), cell_of(2, k)) else {
                    values.push(0.0);
                    vectors.push([0.0; 3]);
                    continue;
                };
                let cell = setup.index([x, y, z]);
                values.push(fields.fill[cell].clamp(0.0, 1.0));
                vectors.push(units.velocities_to_si(velocity(setup, fields, [x, y, z])));
            }
        }
    }
    surface(&Grid { planes, values, vectors }, 0.5)
}

/// Velocity of a fluid cell; in gas the mean of its fluid neighbours, in solids 0.
fn velocity(setup: &Setup, fields: &Fields, at: [usize; 3]) -> [f64; 3] {
    let cell = setup.index(at);
    if setup.is_solid(cell) {
        return [0.0; 3];
    }
    if fields.is_fluid(cell, false) {
        return fields.velocity[cell];
    }
    let (mut count, mut sum) = (0.0, [0.0; 3]);
    for c in &C[1..] {
        let next: [Option<usize>; 3] = std::array::from_fn(|a| {
            let to = at[a].checked_add_signed(c[a] as isize)?;
            (to < setup.extents[a]).then_some(to)
        });
        if let [Some(x), Some(y), Some(z)] = next {
            let next = setup.index([x, y, z]);
            if fields.is_fluid(next, setup.is_solid(next)) {
                count += 1.0;
                for a in 0..3 {
                    sum[a] += fields.velocity[next][a];
                }
            }
        }
    }
    if count > 0.0 { sum.map(|s| s / count) } else { [0.0; 3] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rheology::Law;

    /// A pool of 2½ cells in a box with walls, periodic along y: the mesh lies at the level above cell
    /// centres, ends on the floor and the side walls, and is open along y.
    #[test]
    fn exact_mesh_of_a_pool() {
        let mut setup = Setup::periodic([4, 1, 5], Law::Newtonian { mu: 0.1 });
        setup.faces[0] = [Face::NoSlip; 2];
        setup.faces[2] = [Face::NoSlip; 2];
        let fill: Vec<f64> = (0..20).map(|c| [1.0, 1.0, 0.75, 0.0, 0.0][c / 4]).collect();
        let kind = (0..20).map(|c| [2, 2, 1, 0, 0][c / 4]).collect();
        let velocity = vec![[1.0, 0.0, 0.0]; 20];
        let fields = Fields { fill, kind, velocity, ..Fields::default() };
        let mesh = free_surface(&setup, &fields, &Units::new(2.0, 2.0, 1.0));
        let range = |a: usize| {
            let all = mesh.points.iter().map(|p| p[a]);
            all.fold((9.0_f64, -9.0_f64), |(low, high), x| (low.min(x), high.max(x)))
        };
        assert_eq!(range(1), (0.0, 2.0));
        // Between 0.75 at 2.5 and 0 at 3.5 cells: 2.5 + 1/3 cells.
        let level = 2.0 * (2.5 + 1.0 / 3.0);
        assert!(range(2).0 == 0.0 && (range(2).1 - level).abs() < 8.0 * f64::EPSILON, "{:?}", range(2));
        assert_eq!(range(0), (0.0, 8.0));
    }
}
