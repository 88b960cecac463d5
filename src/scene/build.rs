//! Scenes made in Rust, in SI units, with the checks of a file.

use std::path::PathBuf;

use super::dry::Grains;
use super::parse::finite;
use super::{
    Arrested, BodyForce, Boundaries, Boundary, Cadence, Domain, End, FillLevel, Fluid, Gravity, InitialFluid,
    InitialVelocity, Layer, Measure, Motions, Numerics, Output, Probe, Rheology, Scene, SceneError, Solid,
    Steady, Stop, check,
};
use crate::geometry::{Axis, Shape};

/// A scene with fluid in the making.
#[derive(Clone, Debug)]
#[must_use = "`build` makes the scene"]
pub struct SceneBuilder {
    scene: Scene,
}

impl Scene {
    /// Starts a scene of one box full of fluid, all faces periodic, nothing that drives it.
    ///
    /// # Arguments
    /// `domain`: box and cells; `fluid`; `end_time_s`, s.
    ///
    /// # Examples
    /// Mud on a slope of 20°:
    /// ```
    /// use lahar::geometry::Axis;
    /// use lahar::plan::Plan;
    /// use lahar::scene::{Boundaries, Boundary, Domain, End, FillLevel, Fluid, Gravity, Motions, Rheology, Scene};
    ///
    /// let mud = Rheology::Bingham { yield_stress_pa: 40.0, plastic_viscosity_pa_s: 5.0 };
    /// let domain = Domain { size_m: [0.01, 0.01, 0.2], spacing_m: 0.01, boundaries: Boundaries::default(), motion: Motions::default() };
    /// let scene = Scene::builder(domain, Fluid::new(1500.0, mud), 2.0)
    ///     .title("mud on a slope")
    ///     .face(Axis::Z, End::Min, Boundary::NoSlip)
    ///     .face(Axis::Z, End::Max, Boundary::Open)
    ///     .gravity(Gravity::on_slope(9.81, 20.0))
    ///     .filled_to(FillLevel { height_m: 0.1, axis: None })
    ///     .build()?;
    /// let plan = Plan::new(&scene)?;
    /// assert_eq!(plan.numbers.extents, [1, 1, 20]);
    /// assert_eq!(plan.numbers.depth_cells, Some(10.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    /// What is wrong with a scene is said as for a file:
    /// ```
    /// # use lahar::scene::{Boundaries, Domain, Fluid, Motions, Rheology, Scene};
    /// let domain = Domain { size_m: [1.0; 3], spacing_m: 0.3, boundaries: Boundaries::default(), motion: Motions::default() };
    /// let water = Fluid::new(1000.0, Rheology::Newtonian { viscosity_pa_s: 1e-3 });
    /// let refused = Scene::builder(domain, water, 1.0).build().unwrap_err();
    /// assert_eq!(refused.path, "domain.size_m[0]");
    /// ```
    pub fn builder(domain: Domain, fluid: Fluid, end_time_s: f64) -> SceneBuilder {
        let scene = Scene {
            schema: None,
            title: None,
            description: None,
            domain,
            gravity: None,
            fluid,
            layers: Vec::new(),
            solids: Vec::new(),
            grains: None,
            numerics: Numerics::default(),
            stop: Stop { end_time_s, steady: None, arrested: None },
            output: Output::default(),
            file: "scene".to_owned(),
            folder: PathBuf::from("."),
        };
        SceneBuilder { scene }
    }

    /// Starts a plane channel: walls normal to z, a constant force along x, one cell along x and y.
    ///
    /// # Arguments
    /// `gap_m`: distance of the walls, m; `cells` across it; `fluid`, to which the force is added; `force_n_per_m3`,
    /// N/m³; `end_time_s`, s.
    ///
    /// # Examples
    /// ```
    /// use lahar::plan::Plan;
    /// use lahar::scene::{Fluid, Rheology, Scene};
    ///
    /// let oil = Fluid::new(900.0, Rheology::Newtonian { viscosity_pa_s: 0.1 });
    /// let scene = Scene::channel(0.01, 32, oil, 100.0, 1.0).build()?;
    /// let plan = Plan::new(&scene)?;
    /// // f a²/(2μ) with a = 5 mm.
    /// assert!((plan.numbers.reference_velocity_m_per_s - 0.0125).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn channel(
        gap_m: f64,
        cells: u32,
        fluid: Fluid,
        force_n_per_m3: f64,
        end_time_s: f64,
    ) -> SceneBuilder {
        let spacing_m = gap_m / f64::from(cells);
        let walls = Boundaries { z_min: Boundary::NoSlip, z_max: Boundary::NoSlip, ..Boundaries::default() };
        let domain = Domain {
            size_m: [spacing_m, spacing_m, gap_m],
            spacing_m,
            boundaries: walls,
            motion: Motions::default(),
        };
        let force = BodyForce::Constant { force_n_per_m3: [force_n_per_m3, 0.0, 0.0] };
        Self::builder(domain, Fluid { body_force: Some(force), ..fluid }, end_time_s)
    }
}

impl SceneBuilder {
    /// One line for people.
    pub fn title(mut self, title: &str) -> Self {
        self.scene.title = Some(title.to_owned());
        self
    }

    /// Name used in messages and for the folder of results, and the folder where tables of grains are looked for.
    pub fn file(mut self, name: &str, folder: impl Into<PathBuf>) -> Self {
        name.clone_into(&mut self.scene.file);
        self.scene.folder = folder.into();
        self
    }

    /// What happens at a face.
    pub fn face(mut self, axis: Axis, end: End, boundary: Boundary) -> Self {
        *self.scene.domain.boundaries.at(axis, end) = boundary;
        self
    }

    /// Gravity.
    pub fn gravity(mut self, gravity: Gravity) -> Self {
        self.scene.gravity = Some(gravity);
        self
    }

    /// Velocity at time 0.
    pub fn initial_velocity(mut self, flow: InitialVelocity) -> Self {
        self.scene.fluid.initial_velocity = flow;
        self
    }

    /// Where the fluid is at time 0, with a free surface to the air in the rest of the box.
    pub fn initial(mut self, initial: InitialFluid) -> Self {
        self.scene.fluid.initial = Some(initial);
        self
    }

    /// Fluid up to a level, with a free surface there.
    pub fn filled_to(mut self, level: FillLevel) -> Self {
        self.scene.fluid.initial.get_or_insert_default().fill_level = Some(level);
        self
    }

    /// Another fluid in a part of the box.
    pub fn layer(mut self, name: &str, shape: Shape, rheology: Rheology) -> Self {
        self.scene.layers.push(Layer { name: name.to_owned(), shape, rheology });
        self
    }

    /// A solid.
    pub fn solid(mut self, solid: Solid) -> Self {
        self.scene.solids.push(solid);
        self
    }

    /// Grains in the fluid.
    pub fn grains(mut self, grains: Grains) -> Self {
        self.scene.grains = Some(grains);
        self
    }

    /// Numerical choices.
    pub fn numerics(mut self, numerics: Numerics) -> Self {
        self.scene.numerics = numerics;
        self
    }

    /// End earlier when nothing changes any more.
    pub fn until_steady(mut self, rule: Steady) -> Self {
        self.scene.stop.steady = Some(rule);
        self
    }

    /// End earlier when the fluid has come to rest.
    pub fn until_arrested(mut self, rule: Arrested) -> Self {
        self.scene.stop.arrested = Some(rule);
        self
    }

    /// How often fields are written.
    pub fn fields(mut self, cadence: Cadence) -> Self {
        self.scene.output.fields = Some(cadence);
        self
    }

    /// How often the time series has a row.
    pub fn series(mut self, cadence: Cadence) -> Self {
        self.scene.output.series = Some(cadence);
        self
    }

    /// A measurement.
    pub fn probe(mut self, name: &str, measure: Measure) -> Self {
        self.scene.output.probes.push(Probe { name: name.to_owned(), measure });
        self
    }

    /// All that is written.
    pub fn output(mut self, output: Output) -> Self {
        self.scene.output = output;
        self
    }

    /// The scene.
    ///
    /// # Errors
    /// Values that a file may not hold either, with the JSON path they would have there.
    pub fn build(self) -> Result<Scene, SceneError> {
        finite(&self.scene, &self.scene.file)?;
        check::check(&self.scene)?;
        Ok(self.scene)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn water() -> Fluid {
        Fluid::new(1000.0, Rheology::Newtonian { viscosity_pa_s: 1e-3 })
    }

    #[test]
    fn built_scenes_are_what_their_files_say() {
        let ball = Shape::Sphere { centre_m: [0.5; 3], radius_m: 0.2 };
        let domain = Domain {
            size_m: [1.0; 3],
            spacing_m: 0.125,
            boundaries: Boundaries::default(),
            motion: Motions::default(),
        };
        let scene = Scene::builder(domain, water(), 1.0)
            .gravity(Gravity::down(9.81))
            .solid(Solid::new("ball", ball))
            .probe("fastest", Measure::MaxSpeed)
            .build()
            .unwrap_or_else(|error| panic!("{error}"));
        let text = serde_json::to_string(&scene).expect("JSON");
        let read = super::super::flow_from_json(&text, "scene", &PathBuf::from("."));
        assert_eq!(read, Ok(scene));
    }

    #[test]
    fn numbers_that_are_not_finite_are_refused_where_they_stand() {
        let refused = Scene::channel(0.01, 8, water(), f64::NAN, 1.0).build().expect_err("a force of NaN");
        assert!(refused.path.starts_with("fluid.body_force"), "{refused}");
    }
}
