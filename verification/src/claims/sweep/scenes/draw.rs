//! Random scenes as users write them, each with its exact solution.

use serde_json::{Value, json};

use super::super::case::Draw;
use super::grains;
use crate::claim::VerifyError;
use crate::exact::couette::LayeredCouette;
use crate::exact::film::Film;
use crate::exact::oscillating_wall::OscillatingWall;
use crate::exact::poiseuille::Channel;
use crate::exact::start_up::CouetteStartUp;
use lahar::plan::expected::Kind;
use lahar::rheology::Law;

/// m/s².
pub const G: f64 = 9.81;

/// What a scene is compared with, SI.
pub enum Exact {
    /// A film.
    Film(Film<Law>),
    /// Between walls.
    Channel(Channel<Law>),
    /// A wall that was set in motion.
    StartUp(CouetteStartUp),
    /// Uniform shear: speed of the wall, gap.
    Shear(f64, f64),
    /// Layers: speed of the wall.
    Layers(LayeredCouette<Law>, f64),
    /// Beside an oscillating wall; periods until the start is forgotten.
    Oscillating(OscillatingWall, f64),
    /// Rest below a level: depth.
    Pool(f64),
    /// Grains.
    Grains(grains::Exact),
}

/// A scene, drawn from a number alone.
pub struct Drawn {
    /// Kind.
    pub kind: Kind,
    /// The scene as it would be in a file.
    pub scene: Value,
    /// Its exact solution.
    pub exact: Exact,
    /// Factor of the time step that the plan chooses; `None`: as chosen.
    pub step: Option<f64>,
}

/// Law of a flow in which a wall stress gives a shear rate: flow index and share of the wall stress that is yield stress.
fn law([n, plug]: [f64; 2], stress: f64, rate: f64) -> (Law, Value) {
    let (sigma0, k) = (plug * stress, (1.0 - plug) * stress / libm::pow(rate, n));
    match (plug > 0.0, n == 1.0) {
        (false, true) => (Law::Newtonian { mu: k }, json!({ "newtonian": { "viscosity_pa_s": k } })),
        (false, false) => {
            (Law::PowerLaw { k, n }, json!({ "power_law": { "consistency_pa_s_n": k, "flow_index": n } }))
        }
        (true, true) => (
            Law::Bingham { sigma0, mu: k },
            json!({ "bingham": { "yield_stress_pa": sigma0, "plastic_viscosity_pa_s": k } }),
        ),
        (true, false) => (
            Law::HerschelBulkley { sigma0, k, n },
            json!({ "herschel_bulkley": { "yield_stress_pa": sigma0, "consistency_pa_s_n": k, "flow_index": n } }),
        ),
    }
}

impl Draw {
    /// Flow index and plug: of every five, one Newtonian, one power law, one Bingham, two Herschel-Bulkley.
    fn rheology(&mut self, [low, high]: [f64; 2]) -> [f64; 2] {
        let (kind, n, plug) = (self.unit(), self.ratio(low, high), self.between(0.0, 0.95));
        match (5.0 * kind) as u32 {
            0 => [1.0, 0.0],
            1 => [n, 0.0],
            2 => [1.0, plug],
            _ => [n, plug],
        }
    }

    fn numerics(&mut self) -> Value {
        let operator = if self.unit() < 0.8 { "central_moment" } else { "trt" };
        json!({ "collision": { "operator": operator } })
    }

    fn film(&mut self) -> Drawn {
        let dx = self.ratio(1e-3, 0.1);
        let (cells, slope) = (self.ratio(0.4, 24.0), self.ratio(3.0, 30.0));
        let index = self.rheology([0.33, 1.5]);
        let depth = cells * dx;
        let density = self.between(900.0, 2200.0);
        let stress = density * G * libm::sin(slope.to_radians()) * depth;
        // Froude number of the surface.
        let speed = self.ratio(1e-3, 1.0) * (G * depth).sqrt();
        let [n, plug] = index;
        let (law, rheology) = law(index, stress, speed * (n + 1.0) / (n * (1.0 - plug) * depth));
        let height = (cells.ceil() + 2.0) * dx;
        let scene = json!({
            "domain": {
                "size_m": [dx, dx, height], "spacing_m": dx, "boundaries": { "z_min": "no_slip", "z_max": "open" }
            },
            "gravity": { "magnitude_m_per_s2": G, "slope_deg": slope },
            "fluid": {
                "density_kg_per_m3": density, "rheology": rheology, "initial": { "fill_level": { "height_m": depth } }
            },
            "numerics": self.numerics(),
            "stop": { "end_time_s": 1e4 * depth / speed }
        });
        let exact = Film { law, thickness: depth, density, gravity: G, slope: slope.to_radians() };
        Drawn { kind: Kind::Film, scene, exact: Exact::Film(exact), step: self.step() }
    }

    /// Half of the scenes leave the time step to the plan.
    fn step(&mut self) -> Option<f64> {
        let (given, factor) = (self.unit(), self.ratio(0.2, 5.0));
        (given < 0.5).then_some(factor)
    }

    fn channel(&mut self) -> Drawn {
        let dx = self.ratio(1e-3, 0.1);
        let cells = libm::floor(self.ratio(4.0, 49.0));
        let index = self.rheology([0.2, 2.0]);
        let half = 0.5 * cells * dx;
        let (density, speed, reynolds) =
            (self.between(900.0, 2200.0), self.ratio(1e-3, 1.0), self.ratio(0.01, 30.0));
        let [n, plug] = index;
        let rate = speed * (n + 1.0) / (n * (1.0 - plug) * half);
        // Plastic viscosity at the wall: ρ U h/Re.
        let stress = density * speed * half / reynolds * rate / (1.0 - plug);
        let (law, rheology) = law(index, stress, rate);
        let force = stress / half;
        let scene = json!({
            "domain": {
                "size_m": [dx, cells * dx, dx], "spacing_m": dx, "boundaries": { "y_min": "no_slip", "y_max": "no_slip" }
            },
            "fluid": {
                "density_kg_per_m3": density, "rheology": rheology,
                "body_force": { "constant": { "force_n_per_m3": [force, 0.0, 0.0] } }
            },
            "numerics": self.numerics(),
            "stop": { "end_time_s": 1e4 * half / speed }
        });
        let exact = Exact::Channel(Channel { law, half_width: half, force });
        Drawn { kind: Kind::Channel, scene, exact, step: self.step() }
    }

    fn moving_wall(&mut self) -> Drawn {
        let dx = self.ratio(1e-3, 0.1);
        let cells = libm::floor(self.ratio(4.0, 41.0));
        let gap = cells * dx;
        let (density, speed, reynolds) =
            (self.between(900.0, 2200.0), self.ratio(1e-3, 1.0), self.ratio(0.01, 50.0));
        let index = if self.unit() < 0.5 { [1.0, 0.0] } else { self.rheology([0.2, 2.0]) };
        let (rate, viscosity) = (speed / gap, density * speed * gap / reynolds);
        let (_, rheology) = law(index, viscosity * rate / (1.0 - index[1]), rate);
        let nu = viscosity / density;
        // Share of the gap that the motion reached, squared.
        let time = self.ratio(0.01, 3.0) * gap * gap / nu;
        let start_up = index == [1.0, 0.0];
        let exact = if start_up {
            Exact::StartUp(CouetteStartUp { nu, gap, wall_speed: speed })
        } else {
            Exact::Shear(speed, gap)
        };
        let scene = json!({
            "domain": {
                "size_m": [dx, gap, dx], "spacing_m": dx,
                "boundaries": {
                    "y_min": "no_slip", "y_max": { "moving_wall": { "velocity_m_per_s": [speed, 0.0, 0.0] } }
                }
            },
            "fluid": { "density_kg_per_m3": density, "rheology": rheology },
            "numerics": self.numerics(),
            "stop": { "end_time_s": if start_up { time } else { 1e4 * gap / speed } }
        });
        let kind = if start_up { Kind::MovingWall } else { Kind::Couette };
        Drawn { kind, scene, exact, step: self.step() }
    }

    fn layers(&mut self) -> Result<Drawn, VerifyError> {
        let dx = self.ratio(1e-3, 0.1);
        let count = 2 + (2.0 * self.unit()) as usize;
        let (density, speed) = (self.between(900.0, 2200.0), self.ratio(1e-3, 1.0));
        let thick: Vec<f64> = (0..count).map(|_| libm::floor(self.ratio(2.0, 13.0))).collect();
        let gap = thick.iter().sum::<f64>() * dx;
        let viscosity = density * speed * gap / self.ratio(0.05, 20.0);
        let mut laws = Vec::new();
        for cells in &thick {
            // Bingham fluids of at most the mean stress: some are rigid.
            let plug = if self.unit() < 0.3 { self.between(0.1, 0.9) } else { 0.0 };
            let mean = viscosity * self.ratio(0.2, 5.0) * speed / gap;
            let (law, rheology) = law([1.0, plug], mean, speed / gap);
            laws.push((law, rheology, cells * dx));
        }
        let exact = LayeredCouette::new(laws.iter().map(|(law, _, h)| (*law, *h)).collect(), speed);
        let exact = exact
            .map_err(|e| VerifyError::Numerics { what: "layers between walls", detail: e.to_string() })?;
        let mut low = 0.0;
        let mut parts = Vec::new();
        for (k, (_, rheology, height)) in laws.iter().enumerate() {
            let (min, max) = ([-1.0, low, -1.0], [1.0, low + height, 1.0]);
            let name = format!("layer_{k}");
            parts.push(json!({ "name": name, "shape": { "box": { "min_m": min, "max_m": max } }, "rheology": rheology }));
            low += height;
        }
        let scene = json!({
            "domain": {
                "size_m": [dx, gap, dx], "spacing_m": dx,
                "boundaries": {
                    "y_min": "no_slip", "y_max": { "moving_wall": { "velocity_m_per_s": [speed, 0.0, 0.0] } }
                }
            },
            "fluid": { "density_kg_per_m3": density, "rheology": laws[0].1 },
            "layers": parts[1..],
            "numerics": self.numerics(),
            "stop": { "end_time_s": 1e4 * gap / speed }
        });
        Ok(Drawn { kind: Kind::Layers, scene, exact: Exact::Layers(exact, speed), step: self.step() })
    }

    fn oscillating(&mut self) -> Drawn {
        let dx = self.ratio(1e-4, 1e-2);
        let (depth, gaps) = (self.ratio(2.0, 12.0), self.ratio(0.7, 6.0));
        let cells = libm::ceil(depth * gaps).max(3.0);
        let (density, speed, frequency) =
            (self.between(900.0, 2200.0), self.ratio(1e-3, 0.1), self.ratio(0.1, 10.0));
        let omega = 2.0 * std::f64::consts::PI * frequency;
        let nu = 0.5 * omega * depth * depth * dx * dx;
        let gap = cells * dx;
        // The start decays as exp(−π² ν t/H²).
        let periods = libm::ceil(9.0 * gap * gap / (9.87 * nu) * frequency) + 1.0;
        let scene = json!({
            "domain": {
                "size_m": [dx, gap, dx], "spacing_m": dx,
                "boundaries": {
                    "y_min": { "moving_wall": { "velocity_m_per_s": [speed, 0.0, 0.0] } }, "y_max": "no_slip"
                },
                "motion": { "y_min": { "oscillating": { "frequency_hz": frequency } } }
            },
            "fluid": {
                "density_kg_per_m3": density, "rheology": { "newtonian": { "viscosity_pa_s": density * nu } }
            },
            "numerics": self.numerics(),
            "stop": { "end_time_s": (periods + 1.0) / frequency }
        });
        let exact = OscillatingWall { nu, gap, speed, frequency: omega };
        Drawn {
            kind: Kind::OscillatingWall,
            scene,
            exact: Exact::Oscillating(exact, periods),
            step: self.step(),
        }
    }

    fn pool(&mut self) -> Drawn {
        let dx = self.ratio(1e-3, 0.1);
        let up = (3.0 * self.unit()) as usize;
        let downwards = self.unit() < 0.5;
        let cells = self.ratio(0.4, 12.0);
        let wide = 1.0 + libm::floor(self.ratio(1.0, 8.0));
        let tall = libm::ceil(cells) + 2.0;
        let mut size = [wide * dx; 3];
        size[(up + 1) % 3] = dx;
        size[up] = tall * dx;
        let depth = cells * dx;
        let mut direction = [0.0; 3];
        direction[up] = if downwards { -1.0 } else { 1.0 };
        let names = [["x_min", "x_max"], ["y_min", "y_max"], ["z_min", "z_max"]];
        let mut boundaries = serde_json::Map::new();
        let [floor, lid] = if downwards { names[up] } else { [names[up][1], names[up][0]] };
        boundaries.insert(floor.to_owned(), json!("no_slip"));
        boundaries.insert(lid.to_owned(), json!("open"));
        if self.unit() < 0.7 {
            let face = if self.unit() < 0.7 { "no_slip" } else { "free_slip" };
            for name in names[(up + 2) % 3] {
                boundaries.insert(name.to_owned(), json!(face));
            }
        }
        let axis = ["x", "y", "z"][up];
        let height = if downwards { depth } else { tall * dx - depth };
        let density = self.between(900.0, 2200.0);
        let nu = (G * depth).sqrt() * dx * self.ratio(0.02, 1.0);
        let rheology = if self.unit() < 0.5 {
            json!({ "newtonian": { "viscosity_pa_s": density * nu } })
        } else {
            let stress = self.ratio(0.01, 1.0) * density * G * depth;
            json!({ "bingham": { "yield_stress_pa": stress, "plastic_viscosity_pa_s": density * nu } })
        };
        let scene = json!({
            "domain": { "size_m": size, "spacing_m": dx, "boundaries": boundaries },
            "gravity": { "magnitude_m_per_s2": G, "direction": direction },
            "fluid": {
                "density_kg_per_m3": density, "rheology": rheology,
                "initial": { "fill_level": { "height_m": height, "axis": axis } }
            },
            "numerics": self.numerics(),
            "stop": { "end_time_s": 10.0 * (depth / G).sqrt() }
        });
        Drawn { kind: Kind::Pool, scene, exact: Exact::Pool(depth), step: None }
    }
}

impl Drawn {
    /// The scene of a number; of one number every attempt is another scene.
    ///
    /// # Errors
    /// An exact solution has no root.
    pub fn new(number: u64, attempt: u64) -> Result<Self, VerifyError> {
        // Far from the numbers of the flows without scenes.
        let mut draw = Draw::new((1 << 40) + (number << 6) + attempt);
        let kind = draw.unit();
        Ok(match (100.0 * kind) as u32 {
            0..40 => draw.film(),
            40..60 => draw.channel(),
            60..70 => draw.moving_wall(),
            70..80 => draw.layers()?,
            80..87 => draw.oscillating(),
            87..90 => draw.pool(),
            _ => grains::draw(&mut draw),
        })
    }
}
