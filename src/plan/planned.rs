//! A scene of any kind together with its plan.

use std::fmt;

use serde::Serialize;

use super::grains::{GrainNumbers, GrainPlan};
use super::target::{self, Quote, Target};
use super::{Layout, Numbers, Plan, PlanError, Warning};
use crate::scene::dry::DryScene;
use crate::scene::{AnyScene, Scene};

/// A scene of any kind together with its plan.
#[derive(Clone, Debug)]
pub enum Planned {
    /// With fluid, and grains in it if there are any.
    Flow(Box<Scene>, Box<Plan>),
    /// Grains without fluid.
    Dry(Box<DryScene>, Box<GrainPlan>),
}

/// The numbers of a plan, with the answer about an error where it was asked for.
#[derive(Serialize)]
struct Json<'a, N> {
    #[serde(flatten)]
    numbers: &'a N,
    #[serde(skip_serializing_if = "Option::is_none")]
    target: Option<&'a Quote>,
}

impl Planned {
    /// Plans a scene on this machine, for a solver whose memory has this layout.
    ///
    /// # Errors
    /// As [`Plan::new`] and [`GrainPlan::new`].
    pub fn new(scene: AnyScene, layout: Layout) -> Result<Self, PlanError> {
        match scene {
            AnyScene::Flow(scene) => {
                let plan = Plan::for_layout(&scene, layout)?;
                Ok(Self::Flow(scene, Box::new(plan)))
            }
            AnyScene::Dry(scene) => {
                let plan = GrainPlan::new(&scene)?;
                Ok(Self::Dry(scene, Box::new(plan)))
            }
        }
    }

    /// Name of the scene file.
    #[must_use]
    pub fn file(&self) -> &str {
        match self {
            Self::Flow(scene, _) => &scene.file,
            Self::Dry(scene, _) => &scene.file,
        }
    }

    /// What will be run, in a line.
    #[must_use]
    pub fn headline(&self) -> String {
        match self {
            Self::Flow(_, plan) => {
                let n = &plan.numbers;
                let [nx, ny, nz] = n.extents;
                let sentence = n.time_step_rule.sentence();
                let (title, steps, dt) = (&n.title, n.steps, n.time_step_s);
                format!("{title}: {nx} × {ny} × {nz} cells, {steps} steps of {dt:.4e} s ({sentence})")
            }
            Self::Dry(_, plan) => {
                let n = &plan.numbers;
                let (title, grains, spheres, steps) = (&n.title, n.grains, n.spheres, n.steps);
                let dt = n.time_step_s;
                format!("{title}: {grains} grains of {spheres} spheres, {steps} steps of {dt:.4e} s")
            }
        }
    }

    /// What people should know before they run it.
    #[must_use]
    pub fn warnings(&self) -> &[Warning] {
        match self {
            Self::Flow(_, plan) => &plan.numbers.warnings,
            Self::Dry(_, plan) => &plan.numbers.warnings,
        }
    }

    /// Which spacing, scheme and time step reach a relative error; `None` without fluid.
    ///
    /// # Errors
    /// As [`target::quote`].
    pub fn quote(&self, target: Target) -> serde_json::Result<Option<Quote>> {
        match self {
            Self::Flow(scene, plan) => target::quote(scene, plan, target).map(Some),
            Self::Dry(..) => Ok(None),
        }
    }

    /// The numbers as JSON, with an answer of [`Self::quote`] beside them.
    ///
    /// # Errors
    /// Those of the serialiser.
    pub fn json(&self, target: Option<&Quote>) -> serde_json::Result<String> {
        match self {
            Self::Flow(_, plan) => pretty::<Numbers>(&plan.numbers, target),
            Self::Dry(_, plan) => pretty::<GrainNumbers>(&plan.numbers, target),
        }
    }
}

fn pretty<N: Serialize>(numbers: &N, target: Option<&Quote>) -> serde_json::Result<String> {
    serde_json::to_string_pretty(&Json { numbers, target })
}

impl fmt::Display for Planned {
    /// The table of `lahar plan`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Flow(_, plan) => plan.fmt(f),
            Self::Dry(_, plan) => plan.fmt(f),
        }
    }
}
