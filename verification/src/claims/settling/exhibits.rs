//! Tables and figures of the study.

use super::arrays::{TRT, over_places};
use crate::claim::VerifyError;
use crate::claims::immersed::{Array, WALLS, exact, radius_in_cube};
use crate::exact::suspension::cubic_array;
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::collision::CollisionChoice;
use lahar::output::plot::{Axis, Plot, Series};
use lahar::solver::run::Backend;

/// Error against radius.
pub const ARRAYS: Exhibit = Exhibit {
    id: "cubic-array-errors",
    caption: "Error of drag (held) and of settling (falling) of cubic arrays against the radius in cells, for both kinds of surface, mean \
              over three places and the largest deviation of one of them.",
    timed: false,
    run: arrays,
};

fn arrays(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let fractions: &[f64] = if full { &[0.008, 0.027, 0.1, 0.2, 0.343] } else { &[0.1] };
    let radii: &[f64] = if full { &[2.0, 3.0, 4.0, 5.5, 8.0] } else { &[2.0, 3.0] };
    let mut table = Table::new(
        "Error of the drag coefficient, TRT 3/16, tau = 2",
        &["c", "surface", "R (cells)", "held", "largest deviation", "falling", "largest deviation"],
    );
    let mut plot = Plot::new(
        "Error of the drag of cubic arrays, held",
        Axis::log("radius", "cells"),
        Axis::log("error of K", ""),
    );
    for &c in fractions {
        let reference = exact(cubic_array::drag(c))?;
        for (name, wall) in WALLS {
            let mut points = Vec::new();
            for &radius in radii {
                let cells = (radius / radius_in_cube(c, 1.0)).round() as usize;
                if cells > 44 {
                    continue;
                }
                let array = super::arrays::array(c, cells, wall);
                let (held, deviation) = over_places(|offset| Array { offset, ..array }.fixed(backend))?;
                let (fall, scatter) = over_places(|offset| Array { offset, ..array }.falling(backend, 2.0))?;
                points.push([array.radius(), (held / reference - 1.0).abs()]);
                table.push(vec![
                    c.into(),
                    name.into(),
                    array.radius().into(),
                    (held / reference - 1.0).into(),
                    deviation.into(),
                    (fall / reference - 1.0).into(),
                    scatter.into(),
                ]);
            }
            plot = plot.with(Series::line_markers(format!("c = {c}, {name}"), points));
        }
    }
    let bound = radii.iter().map(|r| [*r, 0.25 / (r * r)]).collect();
    plot = plot.with(Series::reference("0.25/R^2", bound));
    Ok(ExhibitData { tables: vec![table], plots: vec![plot], notes: vec![] })
}

/// Error against viscosity.
pub const OPERATORS: Exhibit = Exhibit {
    id: "cubic-array-viscosity-errors",
    caption: "Error of the drag of a cubic array, c = 0.1, R = 2.9 cells, against the relaxation time, for three collision operators and both \
              kinds of surface.",
    timed: false,
    run: operators,
};

fn operators(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let times: &[f64] = if full { &[0.52, 0.55, 0.6, 0.8, 1.0, 2.0, 4.0] } else { &[0.8, 2.0] };
    let heads: Vec<String> = times.iter().map(|t| format!("tau = {t}")).collect();
    let columns: Vec<&str> =
        ["operator", "surface"].into_iter().chain(heads.iter().map(String::as_str)).collect();
    let mut table = Table::new("Error of K, mean over three places", &columns);
    let mut plot = Plot::new("Error of the drag", Axis::log("tau - 1/2", ""), Axis::linear("error of K", ""));
    let reference = exact(cubic_array::drag(0.1))?;
    let operators = [
        ("BGK", CollisionChoice::Bgk),
        ("TRT 3/16", TRT),
        ("central moments, 3/16", CollisionChoice::default()),
    ];
    for (operator, collision) in operators {
        for (name, wall) in WALLS {
            let mut row = vec![operator.into(), name.into()];
            let mut points = Vec::new();
            for tau in times {
                let mu = (tau - 0.5) / 3.0;
                let array = Array { collision, mu, ..Array::new(0.1, 10, wall) };
                let (k, _) = over_places(|offset| Array { offset, ..array }.fixed(backend))?;
                row.push((k / reference - 1.0).into());
                points.push([tau - 0.5, k / reference - 1.0]);
            }
            table.push(row);
            plot = plot.with(Series::line_markers(format!("{operator}, {name}"), points));
        }
    }
    Ok(ExhibitData { tables: vec![table], plots: vec![plot], notes: vec![] })
}
