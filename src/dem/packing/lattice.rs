//! Regular packings.

use super::{Region, order_by_place};
use crate::dem::{DemError, Sphere, V3};

/// Kind of lattice.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lattice {
    /// One sphere per cell.
    SimpleCubic,
    /// Corner and centre.
    BodyCentred,
    /// Corner and face centres: the densest.
    FaceCentred,
}

/// Spheres of one radius on a lattice, as many as fit wholly inside.
///
/// # Arguments
/// * `spacing` — distance of nearest centres, m, at least 2 × `radius`.
/// # Errors
/// Bad region, radius or spacing.
pub fn lattice(kind: Lattice, radius: f64, spacing: f64, region: &Region) -> Result<Vec<Sphere>, DemError> {
    region.check()?;
    if !(radius > 0.0 && radius.is_finite()) {
        return Err(DemError::Packing { what: "radius (m)", found: radius, allowed: "above 0" });
    }
    if !(spacing >= 2.0 * radius && spacing.is_finite()) {
        return Err(DemError::Packing {
            what: "spacing (m)",
            found: spacing,
            allowed: "at least the diameter",
        });
    }
    let corner = V3::zeros();
    let (basis, cell) = match kind {
        Lattice::SimpleCubic => (vec![corner], spacing),
        Lattice::BodyCentred => (vec![corner, V3::repeat(0.5)], 2.0 / 3f64.sqrt() * spacing),
        Lattice::FaceCentred => (
            vec![corner, V3::new(0.5, 0.5, 0.0), V3::new(0.5, 0.0, 0.5), V3::new(0.0, 0.5, 0.5)],
            2f64.sqrt() * spacing,
        ),
    };
    let (low, high) = region.bounds();
    let count = (high - low).map(|l| (l / cell) as i64 + 1);
    let start = low + V3::repeat(radius);
    let mut out = Vec::new();
    for k in 0..count.z {
        for j in 0..count.y {
            for i in 0..count.x {
                for b in &basis {
                    let centre = start + (V3::new(i as f64, j as f64, k as f64) + b) * cell;
                    // A layer that just fits must not be lost to round-off.
                    if region.holds(&centre, radius * (1.0 - 1e-12)) {
                        out.push(Sphere { centre, radius });
                    }
                }
            }
        }
    }
    order_by_place(&mut out, cell);
    Ok(out)
}
