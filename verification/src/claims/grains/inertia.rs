//! Volume, centre and inertia of clumps.

use super::support::worst;
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use crate::exact::grains::two_spheres::{Axial, union};
use lahar::dem::union_moments::union as quadrature;
use lahar::dem::{Clump, DemError, Sphere, V3};

/// Line of centres, oblique to everything.
fn axis() -> V3 {
    V3::new(0.36, 0.48, 0.8)
}

/// Two spheres on that line, the first at an odd place.
fn pair(a: f64, b: f64, distance: f64) -> [Sphere; 2] {
    let first = V3::new(0.3, -0.2, 0.5);
    [Sphere { centre: first, radius: a }, Sphere { centre: first + axis() * distance, radius: b }]
}

/// Worst relative error of volume, centre (over the distance) and the moments of inertia of a clump of two.
pub(super) fn two(
    distance: f64,
    clump: impl Fn(&[Sphere]) -> Result<Clump, DemError>,
) -> Result<Sample, VerifyError> {
    let mut errors = Vec::new();
    let mut first = (0.0, 0.0);
    for (a, b) in [(1.0, 1.0), (1.0, 0.7)] {
        let spheres = pair(a, b, distance);
        let (c, exact) = (clump(&spheres)?, union(a, b, distance));
        let (least, others) = (c.inertia.x, [c.inertia.y, c.inertia.z]);
        errors.extend([
            c.volume / exact.volume - 1.0,
            (c.centre - spheres[0].centre - axis() * exact.centre).norm() / distance,
            least / exact.about_axis - 1.0,
            others[0] / exact.across - 1.0,
            others[1] / exact.across - 1.0,
        ]);
        if a == b {
            first = (others[1], exact.across);
        }
    }
    let mut sample = Sample::relative(distance, first.0, first.1);
    sample.error = worst(&errors);
    Ok(sample)
}

/// Closed form.
pub const TWO: Claim = Claim {
    id: "clump-two-spheres",
    title: "A clump of two overlapping spheres has the volume, centre and inertia of their union",
    tags: &["D4", "000 Sec 2.1"],
    measures: "Volume, centre and principal moments, relative, the worst; radii 1 and 1, 1 and 0.7, on an oblique line",
    reference: Reference {
        source: "Two spheres without caps, integrated slice by slice (closed form)",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "d (distance of centres)",
        short: &[0.4, 1.0, 1.6],
        full: &[0.31, 0.4, 0.6, 0.8, 1.0, 1.2, 1.4, 1.6, 1.69],
    },
    order: None,
    tolerance: Tolerance {
        value: 1e-13,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "`clump-quadrature` leaves nothing at 40 nodes per piece; rounding of about 1e3 terms of size up to 4 volumes, 1e-13, \
                  and of the Jacobi rotations",
    },
    kind: Kind::Verification,
    measure: |_, distance| two(distance, |s| Clump::new("two", s)),
};

/// Touching and apart.
pub const APART: Claim = Claim {
    id: "clump-spheres-apart",
    title: "Spheres that do not overlap have exactly the sum of their moments",
    tags: &["D4", "000 Sec 2.1"],
    measures: "Volume and principal moments of a touching tetrahedron of unit spheres and of pairs apart, relative, the worst",
    reference: Reference {
        source: "Parallel-axis theorem; four spheres at the corners: I = 4 m (2/5 + (2/3) (3/8) edge^2)",
        uncertainty: 0.0,
    },
    metric: Metric::Relative,
    ladder: Ladder { parameter: "d (distance of centres)", short: &[2.0, 3.0], full: &[2.0, 2.5, 3.0, 10.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-14,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "No quadrature: about 50 roundings of 1.1e-16",
    },
    kind: Kind::Verification,
    measure: |_, distance| {
        let mut sample = two(distance, |s| Clump::new("two", s))?;
        let c = Clump::tetrahedron(1.0, distance)?;
        let m = 4.0 / 3.0 * std::f64::consts::PI;
        let exact = 4.0 * m * (0.4 + 0.25 * distance * distance);
        let errors = [0, 1, 2].map(|k| c.inertia[k] / exact - 1.0);
        sample.error = worst(&[sample.error, worst(&errors), c.volume / (4.0 * m) - 1.0]);
        Ok(sample)
    },
};

/// Convergence.
pub const QUADRATURE: Claim = Claim {
    id: "clump-quadrature",
    title: "The quadrature of overlapping clumps converges faster than any power",
    tags: &["D4"],
    measures: "Volume and second moment along an oblique line of centres of two unit spheres 0.4 and 1.8 apart; the worst",
    reference: Reference { source: "As for `clump-two-spheres`", uncertainty: 0.0 },
    metric: Metric::Relative,
    ladder: Ladder {
        parameter: "n (Gauss nodes per piece)",
        short: &[5.0, 7.0, 10.0, 14.0],
        full: &[5.0, 6.0, 7.0, 8.0, 10.0, 12.0, 14.0],
    },
    order: Some(OrderBand { expected: 15.0, band: 3.0, at_least: true }),
    tolerance: Tolerance {
        value: 3e-9,
        at: Rung::Last,
        basis: Basis::AfterSeeing,
        because: "4.3e-7 at 10 nodes carried on with the order 15 asked for: (10/14)^15 4.3e-7 = 2.7e-9",
    },
    kind: Kind::Verification,
    measure: |_, nodes| {
        let mut errors = Vec::new();
        for distance in [0.4, 1.8] {
            let Axial { volume, about_axis, across, .. } = union(1.0, 1.0, distance);
            let m = quadrature(&pair(1.0, 1.0, distance), nodes as usize);
            let (s, n) = (m.second, axis());
            let along = n.x * n.x * s[0]
                + n.y * n.y * s[1]
                + n.z * n.z * s[2]
                + 2.0 * (n.x * n.y * s[3] + n.y * n.z * s[4] + n.z * n.x * s[5]);
            // ∫ x² dV along the axis is the moment across it less half the one about it.
            let exact = across - 0.5 * about_axis;
            errors.extend([m.volume / volume - 1.0, along / exact - 1.0]);
        }
        Ok(Sample::absolute(nodes, worst(&errors), 0.0))
    },
};
