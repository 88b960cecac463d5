//! Loads on solids and walls: impulse, peaks, centre of pressure and overturning moment, from every step.

use super::Probes;
use super::fluid::Fluid;
use super::moving_mean::{MovingMean, Wrench};
use crate::coupling::Immersed;
use crate::dem::{Dem, V3};
use crate::geometry::Axis;
use crate::plan::Plan;
use crate::plan::grains::{GrainPlan, Walls};
use crate::run::load_summary::{LoadInstant, LoadPeaks, LoadSummary};
use crate::scene::{Measure, Scene, Target};
use crate::state::{State, StateError, Tape, fixed, state};

/// The loads that a scene asks for.
pub(in crate::run) struct Loads {
    list: Vec<Gauge>,
    /// Duration of a step, s.
    step_s: f64,
}

/// One of them.
struct Gauge {
    probe: String,
    measure: Measure,
    about_m: [f64; 3],
    up: Axis,
    impulse: Wrench,
    raw: Peaks,
    mean: MovingMean,
    windowed: Peaks,
}

/// The largest so far, by force, by its components and by overturning moment: size, time and load.
type Peaks = [Option<(f64, f64, Wrench)>; 5];

state!(Gauge: impulse raw mean windowed; but probe measure about_m up);

impl State for Loads {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let Self { list, step_s: _ } = self;
        fixed(list, tape)
    }
}

impl Loads {
    /// Of all `force` and `torque` probes.
    ///
    /// # Arguments
    /// `rows_s`: time between rows of the series, s; `step_s`: duration of a step, s; `about`: the point of the moments of
    /// a measure that names none, m.
    pub fn new(
        probes: &Probes,
        rows_s: f64,
        step_s: f64,
        up: Axis,
        about: &dyn Fn(&Measure) -> [f64; 3],
    ) -> Self {
        let gauge = |probe: &crate::scene::Probe| {
            let (about_m, window_s) = match probe.measure {
                Measure::Force { about_m, window_s, .. } | Measure::Torque { about_m, window_s, .. } => {
                    (about_m, window_s)
                }
                _ => return None,
            };
            Some(Gauge {
                probe: probe.name.clone(),
                measure: probe.measure.clone(),
                about_m: about_m.unwrap_or_else(|| about(&probe.measure)),
                up,
                impulse: Wrench::default(),
                raw: Peaks::default(),
                mean: MovingMean::over(window_s.unwrap_or(rows_s) / step_s),
                windowed: Peaks::default(),
            })
        };
        Self { list: probes.iter().filter_map(|listed| gauge(&listed.probe)).collect(), step_s }
    }

    /// Whether there are any.
    pub(crate) fn any(&self) -> bool {
        !self.list.is_empty()
    }

    /// Takes down the loads of the step that ended at `time`, s; `of` gives that of a measure about a point.
    pub(crate) fn sample(&mut self, time: f64, of: &dyn Fn(&Measure, [f64; 3]) -> Wrench) {
        for gauge in &mut self.list {
            let step = of(&gauge.measure, gauge.about_m);
            gauge.impulse = gauge.impulse.plus(&step.times(self.step_s));
            keep_larger(&mut gauge.raw, time, &step, gauge.up);
            if let Some(mean) = gauge.mean.push(&step) {
                let half = 0.5 * gauge.mean.steps() as f64 * self.step_s;
                keep_larger(&mut gauge.windowed, time - half, &mean, gauge.up);
            }
        }
    }

    /// What they have been so far.
    pub(crate) fn summaries(&self) -> Vec<LoadSummary> {
        let summary = |gauge: &Gauge| LoadSummary {
            probe: gauge.probe.clone(),
            load: words(&gauge.measure),
            about_m: gauge.about_m,
            up: gauge.up.letter(),
            sampled_every_s: self.step_s,
            impulse_n_s: gauge.impulse.force,
            angular_impulse_n_m_s: gauge.impulse.moment,
            raw: peaks(gauge, &gauge.raw),
            window_s: gauge.mean.steps() as f64 * self.step_s,
            windowed: peaks(gauge, &gauge.windowed),
        };
        self.list.iter().map(summary).collect()
    }
}

/// What is pushed, and by whom.
fn words(measure: &Measure) -> String {
    match measure {
        Measure::Force { on: Some(Target::Solid(name)), .. } => format!("of grains on solid `{name}`"),
        Measure::Force { on: Some(Target::Face(key)), .. } => format!("of grains on face `{key}`"),
        Measure::Force { solid: Some(name), .. } => format!("of fluid and grains on solid `{name}`"),
        Measure::Torque { solid: name, .. } => format!("of fluid on solid `{name}`"),
        _ => String::new(),
    }
}

/// Puts a load in place of those that it exceeds. NaN exceeds nothing.
fn keep_larger(peaks: &mut Peaks, time: f64, load: &Wrench, up: Axis) {
    let [x, y, z] = load.force;
    let sizes = [norm(load.force), x.abs(), y.abs(), z.abs(), overturning(load.moment, up)];
    for (peak, size) in peaks.iter_mut().zip(sizes) {
        if peak.is_none_or(|(largest, ..)| size > largest) {
            *peak = Some((size, time, *load));
        }
    }
}

fn peaks(gauge: &Gauge, peaks: &Peaks) -> Option<LoadPeaks> {
    let instant = |k: usize| peaks[k].map(|(_, time, load)| instant(time, &load, gauge.about_m, gauge.up));
    Some(LoadPeaks {
        force: instant(0)?,
        force_x: instant(1)?,
        force_y: instant(2)?,
        force_z: instant(3)?,
        overturning: instant(4)?,
    })
}

fn instant(time_s: f64, load: &Wrench, about_m: [f64; 3], up: Axis) -> LoadInstant {
    LoadInstant {
        time_s,
        force_n: load.force,
        magnitude_n: norm(load.force),
        moment_n_m: load.moment,
        overturning_n_m: overturning(load.moment, up),
        centre_of_pressure_m: centre_of_pressure(load, about_m),
    }
}

fn norm([x, y, z]: [f64; 3]) -> f64 {
    (x * x + y * y + z * z).sqrt()
}

/// Magnitude of the part of a moment across the vertical.
fn overturning(mut moment: [f64; 3], up: Axis) -> f64 {
    moment[up.index()] = 0.0;
    norm(moment)
}

/// Where the line of action meets the plane through p normal to the axis a along which the force is largest:
/// r_b = p_b − M_c/F_a, r_c = p_c + M_b/F_a for (a, b, c) in cyclic order, where the moments along b and c vanish; `None`
/// without a force.
fn centre_of_pressure(load: &Wrench, about_m: [f64; 3]) -> Option<[f64; 3]> {
    let f = load.force;
    let a = (0..3).fold(0, |most, k| if f[k].abs() > f[most].abs() { k } else { most });
    let (b, c) = ((a + 1) % 3, (a + 2) % 3);
    let mut place = about_m;
    place[b] -= load.moment[c] / f[a];
    place[c] += load.moment[b] / f[a];
    place.iter().all(|x| x.is_finite()).then_some(place)
}

/// Load of a step on a solid in a fluid: of the fluid, and in a `force` of contacts and lubrication too. What pushes a face,
/// or what is asked for as `on`, is the contacts alone.
pub(in crate::run) fn of_flow(
    fluid: &Fluid<'_>,
    grains: Option<(&Immersed, &Walls)>,
    measure: &Measure,
    about_m: [f64; 3],
) -> Wrench {
    let of_contacts = grains.map(|(immersed, walls)| {
        let mut load = of_walls(immersed.dem(), walls, measure, about_m);
        if let Measure::Force { on: None, .. } = measure {
            for wall in numbers(walls, measure) {
                let gaps = immersed.lubrication_wrench(wall);
                load = load.plus(&of_wall(immersed.dem(), wall, gaps, about_m));
            }
        }
        load
    });
    let of_contacts = of_contacts.unwrap_or_default();
    match measure {
        Measure::Force { solid: Some(solid), .. } => fluid.wrench(solid, Some(about_m)).plus(&of_contacts),
        Measure::Torque { solid, .. } => fluid.wrench(solid, Some(about_m)),
        _ => of_contacts,
    }
}

/// Load of the contacts of a step on the walls that a measure names, M_p = Σ M_w + (w − p) × F_w.
pub(in crate::run) fn of_walls(dem: &Dem, walls: &Walls, measure: &Measure, about_m: [f64; 3]) -> Wrench {
    let all = numbers(walls, measure).into_iter();
    all.fold(Wrench::default(), |sum, wall| sum.plus(&of_wall(dem, wall, dem.force_on_wall(wall), about_m)))
}

/// A force on a wall and its torque about the point about which the wall turns, seen from another point.
fn of_wall(dem: &Dem, wall: usize, (force, torque): (V3, V3), about_m: [f64; 3]) -> Wrench {
    let scenery = dem.scenery();
    let from = scenery.walls[wall].motion.about + scenery.poses[wall].shift;
    let moment = torque + (from - V3::from(about_m)).cross(&force);
    Wrench { force: force.into(), moment: moment.into() }
}

/// Numbers of the walls that a measure names.
fn numbers(walls: &Walls, measure: &Measure) -> Vec<usize> {
    let of_solid = |name: &str| {
        walls.solids.iter().filter(|(n, _)| n == name).flat_map(|(_, w)| w.clone()).collect::<Vec<_>>()
    };
    match measure {
        Measure::Force { on: Some(Target::Face(key)), .. } => {
            walls.faces.iter().filter(|(k, _)| k == key).map(|(_, wall)| *wall).collect()
        }
        Measure::Force { on: Some(Target::Solid(name)), .. }
        | Measure::Force { solid: Some(name), .. }
        | Measure::Torque { solid: name, .. } => of_solid(name),
        _ => Vec::new(),
    }
}

/// The point of the moments of grains where none is named: the centre of rotation of what they push.
pub(in crate::run) fn start_of_walls(plan: &GrainPlan, measure: &Measure) -> [f64; 3] {
    let wall = numbers(&plan.walls, measure).first().and_then(|&wall| plan.setup.walls.get(wall));
    wall.map_or([0.0; 3], |wall| wall.motion.about.into())
}

/// The point of the moments where a scene with fluid names none: the middle of the foot of a solid in a `force`, its centre of
/// rotation in a `torque` and of what grains push.
pub(in crate::run) fn start_of_moments(scene: &Scene, plan: &Plan, measure: &Measure) -> [f64; 3] {
    let number = measure.loaded_solid().and_then(|name| scene.solids.iter().position(|s| s.name == name));
    let Some(number) = number else {
        return plan.grains.as_ref().map_or([0.0; 3], |coupled| start_of_walls(&coupled.grains, measure));
    };
    if let Measure::Torque { .. } = measure {
        let centre = plan.setup.solid_motion.get(number).map_or([0.0; 3], |motion| motion.centre);
        return centre.map(|x| plan.units.length_to_si(x));
    }
    let (solid, size) = (&scene.solids[number], scene.domain.size_m);
    // Outside of a shape is everywhere.
    let (mut min, mut max) = ([0.0; 3], size);
    if !solid.invert {
        let bounds = solid.shape.bounds();
        min = std::array::from_fn(|a| bounds.min[a].clamp(0.0, size[a]));
        max = std::array::from_fn(|a| bounds.max[a].clamp(0.0, size[a]));
    }
    let (up, down_is_low) = crate::scene::force::up(scene);
    let mut foot: [f64; 3] = std::array::from_fn(|a| 0.5 * (min[a] + max[a]));
    foot[up.index()] = if down_is_low { min[up.index()] } else { max[up.index()] };
    foot
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::{cross, sub};

    fn probes() -> Probes {
        let measure = Measure::Force {
            solid: Some("wall".to_owned()),
            on: None,
            about_m: Some([1.0, 0.0, 0.0]),
            window_s: Some(0.4),
        };
        let mut scene: Scene = crate::scene::flow_from_json(
            r#"{
            "domain": { "size_m": [1, 1, 1], "spacing_m": 0.1 },
            "fluid": { "density_kg_per_m3": 1, "rheology": { "newtonian": { "viscosity_pa_s": 1 } } },
            "numerics": { "reference_velocity_m_per_s": 0.1 },
            "stop": { "end_time_s": 1 }
        }"#,
            "probes.json",
            std::path::Path::new("."),
        )
        .unwrap();
        scene.output.probes = vec![crate::scene::Probe { name: "load".to_owned(), measure }];
        Probes::of_flow(&scene)
    }

    /// A force in a point, seen from another.
    fn push(force: [f64; 3], at: [f64; 3], about: [f64; 3]) -> Wrench {
        Wrench { force, moment: cross(sub(at, about), force) }
    }

    #[test]
    fn exact_centre_of_pressure_of_a_force_in_a_point() {
        let about = [1.0, 2.0, 3.0];
        for (force, at) in [
            ([4.0, 0.0, 0.0], [1.0, 2.5, 5.0]),
            ([0.0, -8.0, 0.0], [0.5, 2.0, 4.0]),
            ([0.0, 0.0, 2.0], [0.5, 7.0, 3.0]),
            // The line through (1, 0.5, 4) along (4, 1, −2) meets the plane there.
            ([4.0, 1.0, -2.0], [1.0, 0.5, 4.0]),
        ] {
            assert_eq!(centre_of_pressure(&push(force, at, about), about), Some(at));
        }
        // A point further along the same line of action.
        let shifted = push([4.0, 1.0, -2.0], [5.0, 1.5, 2.0], about);
        assert_eq!(centre_of_pressure(&shifted, about), Some([1.0, 0.5, 4.0]));
        assert_eq!(centre_of_pressure(&Wrench::default(), about), None);
    }

    #[test]
    fn exact_peaks_and_impulse_of_known_loads() {
        let mut loads = Loads::new(&probes(), 9.0, 0.125, Axis::Z, &|_| [9.0; 3]);
        assert!(loads.any());
        // A spike of one step, then a lower push for three steps higher up, of a window of three steps (0.4 s of 0.125 s).
        let steps = [(8.0, 0.5), (0.0, 0.0), (-6.0, 2.0), (-6.0, 2.0), (-6.0, 2.0), (0.0, 0.0)];
        for (k, (force, height)) in steps.into_iter().enumerate() {
            let about = [1.0, 0.0, 0.0];
            loads.sample(0.125 * (k + 1) as f64, &|_, p| {
                assert_eq!(p, about);
                push([force, 0.0, 0.0], [1.0, 0.0, height], p)
            });
        }
        let summary = &loads.summaries()[0];
        assert_eq!((summary.probe.as_str(), summary.up), ("load", 'z'));
        assert_eq!(summary.load, "of fluid and grains on solid `wall`");
        assert_eq!((summary.sampled_every_s, summary.window_s), (0.125, 0.375));
        assert_eq!(summary.impulse_n_s, [-1.25, 0.0, 0.0]);
        // 8 · 0.5 − 3 · 6 · 2 = −32 N m over steps of ⅛ s.
        assert_eq!(summary.angular_impulse_n_m_s, [0.0, -4.0, 0.0]);
        let (raw, windowed) = (summary.raw.unwrap(), summary.windowed.unwrap());
        assert_eq!((raw.force.time_s, raw.force.magnitude_n, raw.force_x), (0.125, 8.0, raw.force));
        assert_eq!(raw.force.centre_of_pressure_m, Some([1.0, 0.0, 0.5]));
        assert_eq!((raw.overturning.time_s, raw.overturning.overturning_n_m), (0.375, 12.0));
        // Steps 3 to 5, from 0.25 to 0.625 s.
        assert_eq!((windowed.force.time_s, windowed.force.force_n), (0.4375, [-6.0, 0.0, 0.0]));
        assert_eq!(windowed.force.moment_n_m, [0.0, -12.0, 0.0]);
        assert_eq!(windowed.overturning, windowed.force);
    }

    #[test]
    fn exact_overturning_is_across_the_vertical() {
        assert_eq!(overturning([3.0, 4.0, 100.0], Axis::Z), 5.0);
        assert_eq!(overturning([100.0, -3.0, 4.0], Axis::X), 5.0);
    }
}
