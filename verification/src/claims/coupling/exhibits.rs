//! Tables and figures of the study.

use super::approach;
use crate::claim::VerifyError;
use crate::claims::immersed::{Array, OFFSETS, WALLS, exact, radius_in_cube};
use crate::claims::settling::TRT;
use crate::exact::suspension::cubic_array;
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::collision::CollisionChoice;
use lahar::output::plot::{Axis, Plot, Series};
use lahar::solver::run::Backend;

/// Lubrication.
pub const APPROACH: Exhibit = Exhibit {
    id: "lubrication-parts",
    caption: "Force between two approaching spheres: what the lattice carries, what lubrication adds below its cut-off of 0.74 cells, and \
              the exact series; mean over 128 places of the pair within a cell.",
    timed: false,
    run: parts,
};

fn parts(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let gaps: &[f64] = if full {
        &[0.02, 0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.7, 0.8, 1.0, 1.3, 1.7, 2.0]
    } else {
        &[0.1, 0.5, 1.0]
    };
    let radii: &[f64] = if full { &[2.5, 4.0, 6.0] } else { &[2.5] };
    let mut table = Table::new(
        "Force over 6 pi mu R U",
        &[
            "R (cells)",
            "gap (cells)",
            "lattice",
            "lubrication",
            "sum",
            "exact",
            "error",
            "deviation over places",
        ],
    );
    let mut enter = |radius: f64, rows: &[[f64; 5]]| {
        for [gap, lattice, contact, reference, spread] in rows {
            let sum = lattice + contact;
            let numbers =
                [radius, *gap, *lattice, *contact, sum, *reference, sum / reference - 1.0, spread / sum];
            table.push(numbers.map(Into::into).to_vec());
        }
    };
    let rows = approach::table(backend, 4.0, gaps)?;
    enter(4.0, &rows);
    for &radius in radii.iter().filter(|&&radius| radius != 4.0) {
        enter(radius, &approach::table(backend, radius, &[0.1, 0.3, 0.5, 0.7, 0.8, 1.0, 1.5, 2.0])?);
    }
    let column = |f: &dyn Fn(&[f64; 5]) -> f64| rows.iter().map(|r| [r[0], f(r)]).collect::<Vec<_>>();
    let plot = Plot::new(
        "Two spheres of 4 cells approaching",
        Axis::log("gap", "cells"),
        Axis::log("F/(6 pi mu R U)", ""),
    )
    .with(Series::line_markers("lattice", column(&|r| r[1])))
    .with(Series::line_markers("with lubrication", column(&|r| r[1] + r[2])))
    .with(Series::reference("exact", column(&|r| r[3])));
    Ok(ExhibitData { tables: vec![table], plots: vec![plot], notes: vec![] })
}

/// Work-precision.
pub const WORK_PRECISION: Exhibit = Exhibit {
    id: "grains-work-precision",
    caption: "Error of drag (held) and of settling (falling) against the cost of a sphere, c = 0.1: root mean square over places, radii of 2 \
              to 8 cells, two kinds of surface, BGK at tau = 0.8 and Lambda = 3/16. Cost is R^5, cells times steps of a given flow.",
    timed: false,
    run: work_precision,
};

fn work_precision(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let radii: &[f64] = if full { &[2.0, 2.5, 3.0, 4.0, 5.0, 6.5, 8.0] } else { &[2.0, 3.0] };
    let reference = exact(cubic_array::drag(0.1))?;
    let mut table = Table::new(
        "Error at c = 0.1, root mean square over three places",
        &["surface", "operator", "R (cells)", "cost R^5", "drag", "settling"],
    );
    let mut plot =
        Plot::new("Error against cost", Axis::log("R^5", "cells^5"), Axis::log("error of the drag", ""));
    for (name, wall) in WALLS {
        for (operator, collision) in [("BGK, tau = 0.8", CollisionChoice::Bgk), ("TRT 3/16, tau = 0.8", TRT)]
        {
            let mut points = Vec::new();
            for &radius in radii {
                let cells = (radius / radius_in_cube(0.1, 1.0)).round() as usize;
                let array = Array { collision, mu: 0.1, ..Array::new(0.1, cells, wall) };
                let (mut held, mut falling) = (0.0, 0.0);
                for offset in OFFSETS {
                    let placed = Array { offset, ..array };
                    let (a, b) = (placed.fixed(backend)?, placed.falling(backend, 2.0)?);
                    held += (a / reference - 1.0) * (a / reference - 1.0) / OFFSETS.len() as f64;
                    falling += (reference / b - 1.0) * (reference / b - 1.0) / OFFSETS.len() as f64;
                }
                let r = array.radius();
                let cost = r * r * r * r * r;
                points.push([cost, held.sqrt()]);
                table.push(vec![
                    name.into(),
                    operator.into(),
                    r.into(),
                    cost.into(),
                    held.sqrt().into(),
                    falling.sqrt().into(),
                ]);
            }
            plot = plot.with(Series::line_markers(format!("{name}, {operator}"), points));
        }
    }
    let notes = vec![
        "Recommendation: two relaxation times with Lambda = 3/16, the only choice here whose drag does not depend on the viscosity, and \
             the interpolated surface from a radius of three cells on: it converges at second order. At two cells it is hardly better than \
             half-way links, which need no second fluid cell and stay the choice where grains touch walls and each other most of the time."
            .to_owned(),
    ];
    Ok(ExhibitData { tables: vec![table], plots: vec![plot], notes })
}
