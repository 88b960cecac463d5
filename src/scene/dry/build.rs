//! Scenes of grains made in Rust, and their parts with the defaults of a file.

use std::path::PathBuf;

use super::{
    Contact, ContactLaw, DryDomain, DryScene, GrainAt, GrainMaterial, GrainNumerics, GrainOutput, GrainSet,
    GrainSolid, GrainStop, Grains, Orientations, Placement, check,
};
use crate::geometry::{Axis, Shape};
use crate::scene::parse::finite;
use crate::scene::{Arrested, Boundaries, Boundary, End, Gravity, Measure, Probe, SceneError};

/// A scene without fluid in the making.
#[derive(Clone, Debug)]
#[must_use = "`build` makes the scene"]
pub struct DrySceneBuilder {
    scene: DryScene,
}

impl DryScene {
    /// Starts a scene of grains in a box, all faces periodic, without gravity.
    ///
    /// # Arguments
    /// `size_m`: edge lengths, m; `grains`: materials, contacts and places; `end_time_s`, s.
    ///
    /// # Examples
    /// ```
    /// use lahar::geometry::Axis;
    /// use lahar::plan::grains::GrainPlan;
    /// use lahar::scene::dry::{
    ///     Contact, ContactLaw, DryScene, GrainAt, GrainMaterial, GrainSet, Grains, Placement,
    /// };
    /// use lahar::scene::{Boundary, End, Gravity};
    ///
    /// let glass = GrainMaterial {
    ///     name: "glass".to_owned(),
    ///     density_kg_per_m3: 2500.0,
    ///     young_modulus_pa: 7e7,
    ///     poisson_ratio: 0.22,
    /// };
    /// let contact = Contact::new(ContactLaw::Tsuji { restitution: 0.9 }, 0.3);
    /// let ball = GrainSet::new("ball", Placement::List(vec![GrainAt::new([0.05, 0.05, 0.08], 0.005)]));
    /// let scene = DryScene::builder([0.1; 3], Grains::new(glass, contact, vec![ball]), 0.5)
    ///     .face(Axis::Z, End::Min, Boundary::NoSlip)
    ///     .face(Axis::Z, End::Max, Boundary::Open)
    ///     .gravity(Gravity::down(9.81))
    ///     .build()?;
    /// let plan = GrainPlan::new(&scene)?;
    /// assert_eq!((plan.numbers.grains, plan.numbers.walls), (1, 1));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn builder(size_m: [f64; 3], grains: Grains, end_time_s: f64) -> DrySceneBuilder {
        let scene = DryScene {
            schema: None,
            title: None,
            description: None,
            domain: DryDomain { size_m, boundaries: Boundaries::default(), spacing_m: None },
            gravity: None,
            grains,
            solids: Vec::new(),
            stop: GrainStop { end_time_s, arrested: None },
            output: GrainOutput::default(),
            file: "scene".to_owned(),
            folder: PathBuf::from("."),
        };
        DrySceneBuilder { scene }
    }
}

impl DrySceneBuilder {
    /// One line for people.
    pub fn title(mut self, title: &str) -> Self {
        self.scene.title = Some(title.to_owned());
        self
    }

    /// Name used in messages and for the folder of results, and the folder where meshes and tables are looked for.
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

    /// A wall besides the faces.
    pub fn solid(mut self, solid: GrainSolid) -> Self {
        self.scene.solids.push(solid);
        self
    }

    /// End earlier when the grains have come to rest.
    pub fn until_arrested(mut self, rule: Arrested) -> Self {
        self.scene.stop.arrested = Some(rule);
        self
    }

    /// A measurement.
    pub fn probe(mut self, name: &str, measure: Measure) -> Self {
        self.scene.output.probes.push(Probe { name: name.to_owned(), measure });
        self
    }

    /// All that is written.
    pub fn output(mut self, output: GrainOutput) -> Self {
        self.scene.output = output;
        self
    }

    /// The scene.
    ///
    /// # Errors
    /// Values that a file may not hold either, with the JSON path they would have there.
    pub fn build(self) -> Result<DryScene, SceneError> {
        finite(&self.scene, &self.scene.file)?;
        check(&self.scene)?;
        Ok(self.scene)
    }
}

impl Grains {
    /// Grains of one material.
    #[must_use]
    pub fn new(material: GrainMaterial, contact: Contact, sets: Vec<GrainSet>) -> Self {
        Self {
            materials: vec![material],
            contact,
            pairs: Vec::new(),
            wall_material: None,
            clumps: Vec::new(),
            sets,
            numerics: GrainNumerics::default(),
            coupling: None,
        }
    }
}

impl Contact {
    /// Without rolling resistance.
    ///
    /// # Arguments
    /// `law`: the normal force; `friction`: Coulomb's coefficient, no unit, ≥ 0.
    #[must_use]
    pub const fn new(law: ContactLaw, friction: f64) -> Self {
        Self { law, friction, rolling_friction: 0.0, tangential_damping: 1.0 }
    }
}

impl GrainSet {
    /// Spheres of the first material, at rest.
    #[must_use]
    pub fn new(name: &str, place: Placement) -> Self {
        Self {
            name: name.to_owned(),
            material: None,
            clump: None,
            orientation: Orientations::default(),
            place,
            velocity_m_per_s: [0.0; 3],
            random_speed_m_per_s: 0.0,
            spin_rad_per_s: [0.0; 3],
            driven: false,
        }
    }
}

impl GrainAt {
    /// A grain that moves as its set does.
    ///
    /// # Arguments
    /// `position_m`: centre, m; `radius_m`, m.
    #[must_use]
    pub const fn new(position_m: [f64; 3], radius_m: f64) -> Self {
        let (velocity_m_per_s, spin_rad_per_s) = ([0.0; 3], [0.0; 3]);
        Self { position_m, radius_m, velocity_m_per_s, spin_rad_per_s, orientation: None }
    }
}

impl GrainSolid {
    /// A wall at rest around a shape; grains are outside of it.
    #[must_use]
    pub fn new(name: &str, shape: Shape) -> Self {
        Self {
            name: name.to_owned(),
            shape: Some(shape),
            mesh: None,
            invert: false,
            material: None,
            velocity_m_per_s: [0.0; 3],
            spin_rad_per_s: [0.0; 3],
            centre_m: None,
        }
    }
}
