//! Tables and figures of the study.

use super::orders::{contact_error, gear_error};
use super::restitution::{tsuji_bounce, visco_elastic_bounce};
use super::rotation::{SPIN, free, middle_spin};
use super::support::{G, RADIUS, elastic, mass, odd_clump, rest_on_floor, setup};
use crate::claim::VerifyError;
use crate::exact::grains::collision::{oscillator, visco_elastic};
use crate::exact::grains::top::Top;
use crate::exhibit::{Exhibit, ExhibitData, Table};
use lahar::dem::integrate::gear::{CORRECTOR, CORRECTOR_0_CONSERVATIVE};
use lahar::dem::{Dem, Integrator, V3};
use lahar::output::plot::{Axis, Plot, Series};
use lahar::solver::run::Backend;

/// Error against cost.
pub const ORDERS: Exhibit = Exhibit {
    id: "grains-orders",
    caption: "Error against steps for velocity Verlet and Gear's scheme: on a smooth force, across contacts, and in a vibration that \
              lasts. Every scheme evaluates the forces once per step, which is nearly all of a step's cost: steps are cost.",
    timed: false,
    run: orders,
};

/// The schemes with the names of the tables.
const SCHEMES: [(&str, Integrator); 3] = [
    ("Verlet", Integrator::Verlet),
    ("Gear, c0 = 3/16", Integrator::Gear),
    ("Gear, c0 = 3/20", Integrator::GearConservative),
];

fn row(name: &str, errors: &[f64], ratio: f64) -> Vec<crate::exhibit::Entry> {
    let last = errors.len() - 1;
    let order = libm::log(errors[0] / errors[last]) / (last as f64 * libm::log(ratio));
    let mut row = vec![name.into()];
    row.extend(errors.iter().map(|&e| e.into()));
    row.push(order.into());
    row
}

fn orders(_: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let (contact, plot) = across_contacts(full)?;
    let notes = vec![
        "Fifth order needs a smooth force and start derivatives that no contact has: at first touch the third derivative jumps. Across \
         contacts the orders are irregular and between 1.5 and 2.5. Per step, and so per cost, Gear is 4 to 10 times more accurate in \
         one elastic collision, and a little more in one damped collision."
            .to_owned(),
        "Velocity Verlet is the default all the same. In a contact that lasts, such as any in a heap, its energy stays where it is, \
         whereas Gear's grows at coarse steps (the mean of Verlet's is not zero because a quadratic energy of second order differs \
         from the true one, but it does not change). Its error in a collision at 50 steps, 6e-4 of the overlap, is far below what \
         contact laws are known to; and it carries no derivatives along (36 numbers less per grain)."
            .to_owned(),
    ];
    Ok(ExhibitData {
        tables: vec![smooth_force(), contact, lasting_vibration(full)?],
        plots: vec![plot],
        notes,
    })
}

fn smooth_force() -> Table {
    let mut smooth = Table::new(
        "Smooth: distance from the exact state of a damped oscillator (b = 0.1) after 8/omega",
        &["scheme", "100 steps", "200", "400", "800", "mean order"],
    );
    let mut push = |name: &str, f: &dyn Fn(f64) -> f64| {
        smooth.push(row(name, &[100.0, 200.0, 400.0, 800.0].map(f), 2.0));
    };
    push("Gear, c0 = 3/16, exact start derivatives", &|n| gear_error(n, 0.1, CORRECTOR[0], true));
    push("Gear, c0 = 3/16, zero start derivatives", &|n| gear_error(n, 0.1, CORRECTOR[0], false));
    push("Gear, c0 = 3/20, b = 0, exact start derivatives", &|n| {
        gear_error(n, 0.0, CORRECTOR_0_CONSERVATIVE, true)
    });
    push("Gear, c0 = 3/20, b = 0, zero start derivatives", &|n| {
        gear_error(n, 0.0, CORRECTOR_0_CONSERVATIVE, false)
    });
    smooth
}

fn across_contacts(full: bool) -> Result<(Table, Plot), VerifyError> {
    let steps: &[f64] =
        if full { &[12.5, 25.0, 50.0, 100.0, 200.0, 400.0] } else { &[12.5, 25.0, 50.0, 100.0] };
    let columns: Vec<String> = steps.iter().map(|n| format!("N = {n}")).collect();
    let heads: Vec<&str> =
        std::iter::once("scheme").chain(columns.iter().map(String::as_str)).chain(["mean order"]).collect();
    let mut contact = Table::new(
        "Across a contact: distance after a head-on collision over the largest overlap, mean error of eight starts, N steps per \
         contact",
        &heads,
    );
    let mut plot = Plot::new(
        "Error after a collision",
        Axis::log("steps per contact", ""),
        Axis::log("error of the distance / largest overlap", ""),
    );
    for (law, a) in [("elastic", 0.0), ("visco-elastic a = 0.2", 0.2)] {
        for (name, integrator) in SCHEMES {
            let errors: Result<Vec<f64>, VerifyError> =
                steps.iter().map(|&n| contact_error(a, integrator, n)).collect();
            let errors = errors?;
            contact.push(row(&format!("{name}, {law}"), &errors, 2.0));
            // The two variants of Gear lie on top of each other.
            if integrator != Integrator::GearConservative {
                let points = steps.iter().zip(&errors).map(|(n, e)| [*n, *e]).collect();
                plot = plot.with(Series::line_markers(format!("{name}, {law}"), points));
            }
        }
    }
    let slope = steps.iter().map(|n| [*n, 1.5 / (n * n)]).collect();
    plot = plot.with(Series::reference("second order", slope));
    Ok((contact, plot))
}

fn lasting_vibration(full: bool) -> Result<Table, VerifyError> {
    let mut lasting = Table::new(
        "A sphere vibrating elastically on a plane, half the overlap at rest up and down: change of the energy, mean of four \
         periods, over the energy of the vibration",
        &["scheme", "steps per period", "after 10 periods", "after 100", "after 1000"],
    );
    for (name, integrator) in SCHEMES {
        for n in [20.0, 50.0] {
            let [a, b, c] = vibration(integrator, n, if full { 1000 } else { 200 })?;
            let last = if full { c.into() } else { "".into() };
            lasting.push(vec![name.into(), n.into(), a.into(), b.into(), last]);
        }
    }
    Ok(lasting)
}

/// Change of the energy of a vibration about rest on a plane after 10, 100 and 1000 periods over what it was; mean of
/// the last four periods.
fn vibration(integrator: Integrator, steps: f64, most: u64) -> Result<[f64; 3], VerifyError> {
    let young = 7e6;
    let mut s = setup(young, elastic());
    let depth = (1.0 - rest_on_floor(&mut s, young, V3::z() * -G)) * RADIUS;
    // About rest m δ'' = −(3/2)(m g/δ) (δ − rest).
    let omega = (1.5 * G / depth).sqrt();
    s.grains[0].velocity = V3::z() * (0.5 * depth * omega);
    s.time_step_s = Some(2.0 * std::f64::consts::PI / omega / steps);
    s.design_speed_m_s = 1e-3;
    s.integrator = integrator;
    let mut d = Dem::new(&s)?;
    let speed = 0.5 * depth * omega;
    let size = 0.5 * mass(RADIUS) * speed * speed;
    let start = d.energies().mechanical();
    let mut found = [f64::NAN; 3];
    for (k, periods) in [10, 100, 1000].into_iter().enumerate().filter(|(_, p)| *p <= most) {
        d.step((periods - 4) * steps as u64 - d.steps())?;
        let mut sum = 0.0;
        for _ in 0..4 * steps as u64 {
            d.step(1)?;
            sum += (d.energies().mechanical() - start) / size;
        }
        found[k] = sum / (4.0 * steps);
    }
    Ok(found)
}

/// Restitution.
pub const RESTITUTION: Exhibit = Exhibit {
    id: "grains-restitution",
    caption: "Restitution against damping under both conventions, and against speed at one damping constant; 500 steps per contact.",
    timed: false,
    run: restitution,
};

fn restitution(_: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let steps = 500.0;
    let dampings: &[f64] =
        if full { &[0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7] } else { &[0.05, 0.1, 0.2, 0.5] };
    let mut measured = [Vec::new(), Vec::new()];
    let mut table = Table::new(
        "Restitution at 0.7 m/s",
        &["law", "damping", "measured", "force cut off (reference)", "attraction included (textbook)"],
    );
    for &a in dampings {
        let (e, exact) = (visco_elastic_bounce(a, 0.7, steps)?.restitution, visco_elastic(a));
        measured[0].push([a, e]);
        table.push(vec![
            "visco-elastic, a".into(),
            a.into(),
            e.into(),
            exact.cut_off.into(),
            exact.textbook.into(),
        ]);
    }
    for &a in dampings {
        let alpha = 5.0 * a;
        let (e, exact) = (tsuji_bounce(alpha, 0.7, steps)?.restitution, oscillator(alpha / 5f64.sqrt()));
        measured[1].push([alpha, e]);
        table.push(vec![
            "Tsuji, alpha".into(),
            alpha.into(),
            e.into(),
            exact.cut_off.into(),
            exact.textbook.into(),
        ]);
    }
    let grid = |most: f64| (0..=70).map(move |i| most * f64::from(i) / 70.0);
    let curves = |f: &dyn Fn(f64) -> crate::exact::grains::collision::Restitution, most: f64| {
        let cut = grid(most).map(|x| [x, f(x).cut_off]).collect();
        let book = grid(most).map(|x| [x, f(x).textbook]).collect();
        (Series::line("force cut off", cut), Series::reference("attraction included", book))
    };
    let (cut, book) = curves(&visco_elastic, 0.7);
    let by_damping = Plot::new("Visco-elastic", Axis::linear("a", ""), Axis::linear("restitution", ""))
        .with(Series::markers("measured", std::mem::take(&mut measured[0])))
        .with(cut)
        .with(book);
    let (cut, book) = curves(&|alpha| oscillator(alpha / 5f64.sqrt()), 3.5);
    let tsuji = Plot::new("Tsuji", Axis::linear("alpha", ""), Axis::linear("restitution", ""))
        .with(Series::markers("measured", std::mem::take(&mut measured[1])))
        .with(cut)
        .with(book);
    Ok(ExhibitData {
        tables: vec![table],
        plots: vec![by_damping, tsuji, by_speed(full, steps)?],
        notes: Vec::new(),
    })
}

/// Restitution against speed, `steps` per contact.
fn by_speed(full: bool, steps: f64) -> Result<Plot, VerifyError> {
    let speeds: &[f64] =
        if full { &[1e-3, 3e-3, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0] } else { &[1e-3, 0.01, 0.1, 1.0] };
    let (mut elastic_points, mut tsuji_points) = (Vec::new(), Vec::new());
    for &v in speeds {
        elastic_points.push([v, visco_elastic_bounce(0.1 * libm::pow(v, 0.2), v, steps)?.restitution]);
        tsuji_points.push([v, tsuji_bounce(0.2, v, steps)?.restitution]);
    }
    let line = |f: &dyn Fn(f64) -> f64| {
        (0..=40)
            .map(|i| libm::pow(10.0, -3.0 + 3.5 * f64::from(i) / 40.0))
            .map(|v| [v, f(v)])
            .collect::<Vec<_>>()
    };
    Ok(Plot::new("Against speed", Axis::log("v", "m/s"), Axis::linear("restitution", ""))
        .with(Series::markers("visco-elastic, a = 0.1 at 1 m/s", elastic_points))
        .with(Series::markers("Tsuji, alpha = 0.2", tsuji_points))
        .with(Series::line("its integral", line(&|v| visco_elastic(0.1 * libm::pow(v, 0.2)).cut_off)))
        .with(Series::reference("its closed form", line(&|_| oscillator(0.2 / 5f64.sqrt()).cut_off))))
}

/// Tumbling.
pub const FREE_CLUMP: Exhibit = Exhibit {
    id: "grains-free-clump",
    caption: "A free clump of three spheres spun about its intermediate axis with 1 % about the others: it stays, turns over, and comes \
              back. Spin about that axis beside Jacobi's sn; omega dt = 0.01.",
    timed: false,
    run: free_clump,
};

fn free_clump(_: &dyn Backend, full: bool) -> Result<ExhibitData, VerifyError> {
    let mut d = free(odd_clump()?, V3::from(SPIN), 1e-4, Integrator::Verlet)?;
    let i = d.bodies().inertia[0];
    let top = Top::new([i.x, i.y, i.z], SPIN);
    let until = if full { 3.0 * top.period() } else { 1.2 * top.period() };
    let (mut path, mut flips) = (vec![[0.0, middle_spin(&d)]], Vec::new());
    let mut before = middle_spin(&d);
    while d.time() < until {
        d.step(1)?;
        let now = middle_spin(&d);
        if now * before < 0.0 {
            flips.push((d.time() - d.time_step() * now / (now - before), now > before));
        }
        before = now;
        if d.steps() % 100 == 0 {
            path.push([d.time(), now]);
        }
    }
    let first = flips.first().copied().unwrap_or((f64::NAN, true));
    let sign = if first.1 { 1.0 } else { -1.0 };
    let mut table =
        Table::new("Turns", &["turn", "time (s)", "time by the elliptic integral (s)", "difference (s)"]);
    for (k, (t, _)) in flips.iter().enumerate() {
        let exact = first.0 + 0.5 * k as f64 * top.period();
        table.push(vec![(k + 1).into(), (*t).into(), exact.into(), (t - exact).into()]);
    }
    let exact: Vec<[f64; 2]> = path.iter().map(|p| [p[0], sign * top.middle_spin(p[0] - first.0)]).collect();
    let largest = path.iter().zip(&exact).map(|(p, e)| (p[1] - e[1]).abs()).fold(0.0, f64::max);
    let plot =
        Plot::new("Spin about the intermediate axis", Axis::linear("t", "s"), Axis::linear("spin", "rad/s"))
            .with(Series::line("measured", path))
            .with(Series::reference("sn", exact));
    let notes = vec![format!(
        "The elliptic function is started at the first turn. Largest difference of the spins: {largest:.2e} rad/s of {:.1}.",
        top.amplitude
    )];
    Ok(ExhibitData { tables: vec![table], plots: vec![plot], notes })
}
