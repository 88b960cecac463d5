//! What follows from a scene before anything is chosen, worked out once and carried through the plan.

use crate::rheology::{FlowCurve, Law};
use crate::scene::force::Forces;
use crate::scene::{Boundary, Scene};

/// A scene with what follows from it.
pub(crate) struct Facts<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// What acts on the fluid.
    pub forces: Forces,
    /// What happens at the faces, `[axis][low, high]`.
    pub faces: [[Boundary; 2]; 3],
    /// Axes along which nothing can flow through: a face is a wall or a mirror.
    pub closed: [bool; 3],
    /// Laws of all fluids in SI units, that of `fluid` first.
    pub laws: Vec<Law>,
    curves: Vec<Box<dyn FlowCurve>>,
}

impl<'a> Facts<'a> {
    /// Of a scene that was checked.
    #[must_use]
    pub fn of(scene: &'a Scene) -> Self {
        let faces = scene.domain.boundaries.by_axis();
        let laws: Vec<Law> = scene.rheologies().map(crate::scene::Rheology::law).collect();
        Self {
            scene,
            forces: Forces::of(scene),
            faces,
            closed: faces.map(|pair| pair[0] != Boundary::Periodic),
            curves: laws.iter().map(Law::curve).collect(),
            laws,
        }
    }

    /// Flow curve of the fluid, SI units.
    #[must_use]
    pub(crate) fn curve(&self) -> &dyn FlowCurve {
        &*self.curves[0]
    }

    /// Flow curves of all fluids, SI units.
    pub(crate) fn curves(&self) -> impl Iterator<Item = &dyn FlowCurve> {
        self.curves.iter().map(|curve| &**curve)
    }

    /// Whether any fluid can be rigid.
    #[must_use]
    pub(crate) fn any_plug(&self) -> bool {
        self.curves().any(FlowCurve::has_plug)
    }

    /// Whether no fluid's viscosity depends on the flow.
    #[must_use]
    pub(crate) fn is_newtonian(&self) -> bool {
        self.laws.iter().all(|law| law.constant_tau().is_some())
    }
}
