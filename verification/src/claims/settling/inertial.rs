//! Random boxes at finite Reynolds number, averaged over their fall.

use std::f64::consts::PI;

use super::random::{RADIUS, RandomBox};
use crate::claim::VerifyError;
use crate::claims::immersed::{exact, volume};
use crate::exact::suspension::settling::{
    garside_al_dibouni_exponent, richardson_zaki, richardson_zaki_exponent,
};
use crate::exact::suspension::single_sphere::DragCurve;
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::output::plot::{Axis, Plot, Series};
use lahar::solver::run::Backend;

/// Of one sphere that falls alone.
const REYNOLDS: f64 = 10.0;
/// τ = 0.6: one sphere falls at 0.067 cells per step.
const MU: f64 = 1.0 / 30.0;
/// Density of the spheres over that of the fluid.
const DENSITY: f64 = 2.0;
/// Edges of the box that the spheres fall, before and while their speed is averaged.
const WAY: [f64; 2] = [1.0, 3.0];

/// Mean speed over that of one sphere by the standard drag curve, without net volume flux, averaged over a fall.
fn fall(backend: &dyn Backend, (c, count): (f64, usize), seed: u64) -> Result<f64, VerifyError> {
    let alone = REYNOLDS * MU / (2.0 * RADIUS);
    let drag = 6.0 * PI * MU * RADIUS * alone * exact(DragCurve::SchillerNaumann.ratio(REYNOLDS))?;
    let gravity = drag / ((DENSITY - 1.0) * volume(RADIUS));
    let random = RandomBox { c, count, seed, density: DENSITY, mu: MU, gravity, sub_steps: 4 };
    let mut run = backend.start(&random.setup()?)?;
    let expected = alone * exact(richardson_zaki(c, exact(richardson_zaki_exponent(REYNOLDS))?))?;
    let [before, during] = WAY.map(|edges| (edges * random.edge() / expected).ceil() as u64);
    run.advance(before)?;
    let looks = 200;
    let mut sum = 0.0;
    for _ in 0..looks {
        run.advance(during.div_ceil(looks))?;
        sum += random.speed(run.as_ref())?;
    }
    Ok(sum / looks as f64 / alone)
}

/// Finite Reynolds number.
pub const INERTIAL: Exhibit = Exhibit {
    id: "random-boxes-with-inertia",
    caption: "Settling of random boxes at a Reynolds number of 10 (of one sphere that falls alone), averaged over a fall of three edges of \
              the box, beside the law of Richardson and Zaki with its exponent at that Reynolds number.",
    timed: false,
    run: inertial,
};

fn inertial(backend: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let (boxes, count) = if full { (20, 27) } else { (2, 8) };
    let fractions: &[f64] = if full { &[0.1, 0.2, 0.3] } else { &[0.2] };
    let exponents =
        [exact(richardson_zaki_exponent(REYNOLDS))?, exact(garside_al_dibouni_exponent(REYNOLDS))?];
    let mut table = Table::new(
        format!("u/u0, {boxes} boxes of {count} spheres, R = 2.5 cells, Re = 10, density ratio 2"),
        &["c", "mean", "standard error", "Richardson-Zaki", "Garside and Al-Dibouni", "exponent of the mean"],
    );
    let (mut points, mut logs) = (Vec::new(), Vec::new());
    for &c in fractions {
        let n = libm::cbrt(count as f64 * volume(RADIUS) / c).round();
        let fraction = count as f64 * volume(RADIUS) / (n * n * n);
        let all = (1..=boxes)
            .map(|seed| fall(backend, (c, count), seed))
            .collect::<Result<Vec<f64>, VerifyError>>()?;
        let mean = all.iter().sum::<f64>() / boxes as f64;
        let variance = all.iter().map(|u| (u - mean) * (u - mean)).sum::<f64>() / (boxes as f64 - 1.0);
        points.push([fraction, mean]);
        let error = (variance / boxes as f64).sqrt() / mean;
        logs.push([libm::log(1.0 - fraction), libm::log(mean), 1.0 / (error * error)]);
        table.push(vec![
            fraction.into(),
            mean.into(),
            (variance / boxes as f64).sqrt().into(),
            exact(richardson_zaki(fraction, exponents[0]))?.into(),
            exact(richardson_zaki(fraction, exponents[1]))?.into(),
            (libm::log(mean) / libm::log(1.0 - fraction)).into(),
        ]);
    }
    let curve = |n: f64| (0..=35).map(|i| 0.01 * f64::from(i)).map(|c| [c, libm::pow(1.0 - c, n)]).collect();
    let plot = Plot::new("Settling at Re = 10", Axis::linear("c", ""), Axis::linear("u/u0", ""))
        .with(Series::markers("random boxes", points))
        .with(Series::reference(format!("(1 - c)^{:.2}, Richardson-Zaki", exponents[0]), curve(exponents[0])))
        .with(Series::reference(
            format!("(1 - c)^{:.2}, Garside and Al-Dibouni", exponents[1]),
            curve(exponents[1]),
        ));
    let mut tables = vec![table];
    if let Some([[k, k_error], [n, n_error]]) = power_law(&logs) {
        let mut fit = Table::new(
            "Fit of u/u0 = k (1 - c)^n, weighted by the standard errors".to_owned(),
            &["", "fit", "standard error", "Richardson-Zaki"],
        );
        fit.push(vec!["k".into(), k.into(), k_error.into(), 1.0.into()]);
        fit.push(vec!["n".into(), n.into(), n_error.into(), exponents[0].into()]);
        tables.push(fit);
    }
    let notes = vec![
        "u0 is that of the drag curve of Schiller and Naumann; no correction for the size of the box, whose wakes at this \
         Reynolds number reach across it."
            .to_owned(),
        "Spheres that settle at moderate Reynolds numbers are reported to follow the exponent with a prefactor below one: 0.8 to \
         0.9 in experiments (Di Felice 1999, Int. J. Multiphase Flow 25, 559), 0.86 to 0.92 at Re = 1 to 20 in other \
         lattice-Boltzmann simulations (Yin & Koch 2007, Phys. Fluids 19, 093302)."
            .to_owned(),
    ];
    Ok(ExhibitData { tables, plots: vec![plot], notes })
}

/// k and n of u = k (1 − c)ⁿ with their standard errors, from (ln(1 − c), ln u, weight): weighted least squares.
fn power_law(points: &[[f64; 3]]) -> Option<[[f64; 2]; 2]> {
    if points.len() < 2 {
        return None;
    }
    let sum = |f: &dyn Fn(&[f64; 3]) -> f64| points.iter().map(f).sum::<f64>();
    let (s, x, y) = (sum(&|p| p[2]), sum(&|p| p[2] * p[0]), sum(&|p| p[2] * p[1]));
    let (xx, xy) = (sum(&|p| p[2] * p[0] * p[0]), sum(&|p| p[2] * p[0] * p[1]));
    let determinant = s * xx - x * x;
    let (n, intercept) = ((s * xy - x * y) / determinant, (xx * y - x * xy) / determinant);
    let k = libm::exp(intercept);
    Some([[k, k * (xx / determinant).sqrt()], [n, (s / determinant).sqrt()]])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_power_law() {
        let point = |c: f64, weight: f64| {
            let x = libm::log(1.0 - c);
            [x, libm::log(0.8) + 3.5 * x, weight]
        };
        let found = power_law(&[point(0.1, 1e4), point(0.2, 4e4), point(0.3, 1e4)]).unwrap_or_default();
        // A dozen roundings, amplified by 1 over the spread of the points, 0.1.
        assert!((found[0][0] - 0.8).abs() < 1e-13 && (found[1][0] - 3.5).abs() < 1e-12, "{found:?}");
        assert!(power_law(&[point(0.1, 1.0)]).is_none());
    }
}
