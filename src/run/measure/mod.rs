//! What the probes of a run measure. A probe's columns and its values come out of one function, together.

pub(super) mod columns;
pub(super) mod contacts;
mod coupled;
mod crossings;
pub(super) mod fields;
pub(super) mod fluid;
pub(super) mod grains;
pub(super) mod loads;
mod moving_mean;
mod quantile;
pub(super) mod quantity;
pub(super) mod rest;

use contacts::Contacts;
use crossings::Crossings;
use fluid::Fluid;
use grains::Grains;
use quantity::{Quantity, several};

use crate::scene::dry::DryScene;
use crate::scene::series::{self, Listed};
use crate::scene::{Measure, Scene, Subject};
use crate::state::{self, StateError, Tape, fixed, part};

/// What there is to be measured at one time.
#[derive(Clone, Copy)]
pub(super) struct State<'a> {
    pub fluid: Option<Fluid<'a>>,
    pub grains: Option<Grains<'a>>,
    /// Forces of contacts on the solids of a fluid with grains.
    pub contacts: Option<&'a Contacts<'a>>,
}

/// A probe and what it has gathered so far.
struct Gauge {
    listed: Listed,
    /// What has crossed its plane, if it has one.
    crossings: Option<Crossings>,
}

/// The probes of a run, in the order of their columns.
pub(super) struct Probes {
    list: Vec<Gauge>,
}

impl state::State for Gauge {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let Self { crossings, listed: _ } = self;
        part(crossings, tape)
    }
}

impl state::State for Probes {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let Self { list } = self;
        fixed(list, tape)
    }
}

impl Probes {
    /// Of a scene with fluid, and with grains if there are any.
    pub(crate) fn of_flow(scene: &Scene) -> Self {
        Self::new(series::of_flow(scene))
    }

    /// Of a scene without fluid.
    pub(crate) fn of_grains(scene: &DryScene) -> Self {
        Self::new(series::of_grains(scene))
    }

    fn new(list: Vec<Listed>) -> Self {
        let gauge = |listed: Listed| {
            let crossings = match listed.probe.measure {
                Measure::Flux { normal, at_m } => Some(Crossings::new(normal, at_m)),
                _ => None,
            };
            Gauge { listed, crossings }
        };
        Self { list: list.into_iter().map(gauge).collect() }
    }

    /// The probes.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &Listed> {
        self.list.iter().map(|gauge| &gauge.listed)
    }

    /// The columns of every probe at one time.
    pub(crate) fn row(&mut self, state: &State<'_>) -> Vec<(String, Vec<Quantity>)> {
        let row = |gauge: &mut Gauge| {
            let found = gauge.measure(state).unwrap_or_default();
            let names = || found.iter().map(|quantity| (&quantity.part, quantity.unit));
            let declared = gauge.listed.columns();
            debug_assert!(names().eq(declared.iter().map(|column| (&column.part, column.unit))));
            (gauge.listed.probe.name.clone(), found)
        };
        self.list.iter_mut().map(row).collect()
    }
}

impl Gauge {
    /// What the probe says; `None` where the scene lacks what it needs, which its check has refused.
    fn measure(&mut self, state: &State<'_>) -> Option<Vec<Quantity>> {
        let (fluid, grains) = (state.fluid.as_ref(), state.grains.as_ref());
        Some(match &self.listed.probe.measure {
            Measure::KineticEnergy => match self.listed.subject {
                Subject::Fluid => fluid?.kinetic_energy(),
                Subject::Grains => grains?.kinetic_energy(),
            },
            Measure::MaxSpeed => match self.listed.subject {
                Subject::Fluid => fluid?.max_speed(),
                Subject::Grains => grains?.max_speed(),
            },
            Measure::Mass => match self.listed.subject {
                Subject::Fluid => fluid?.mass(),
                Subject::Grains => grains?.mass(),
            },
            Measure::PointVelocity { at_m } => fluid?.point_velocity(*at_m),
            Measure::PlugFraction => fluid?.plug_fraction(),
            Measure::YieldedFraction => fluid?.yielded_fraction(),
            Measure::FlowRate { normal, at_m } => fluid?.flow_rate(*normal, *at_m),
            Measure::Volume => fluid?.volume(),
            Measure::Front { along, threshold_m, from_m, above_m } => {
                fluid?.front(*along, *threshold_m, *from_m, *above_m)
            }
            Measure::WindowVelocity { min_m, max_m } => fluid?.window_velocity(*min_m, *max_m),
            Measure::Ledger => fluid?.ledger(),
            Measure::Force { on: Some(on), .. } => grains?.force(on),
            Measure::Force { solid, on: None, .. } => {
                let solid = solid.as_deref()?;
                let mut row = fluid?.load(solid);
                row.extend(state.contacts.map_or_else(Vec::new, |contacts| contacts.on(solid)));
                row
            }
            Measure::Torque { solid, about_m, .. } => fluid?.torque(solid, *about_m),
            Measure::Contacts => grains?.contacts(),
            Measure::Energies => grains?.energies(),
            Measure::Momentum => grains?.momentum(),
            Measure::Grain { set, number } => grains?.grain(set, *number),
            Measure::Flux { .. } => {
                let crossings = self.crossings.as_mut()?;
                crossings.look(&grains?.view);
                several([("mass", "kg", crossings.mass_kg), ("number", "-", crossings.number)])
            }
            Measure::Pile { along, up, share } => grains?.pile(*along, *up, *share),
            Measure::SetSpeed { set } => grains?.set_speed(set),
            Measure::Segregation { up, classes } => grains?.segregation(*up, *classes),
            Measure::GrainFront { along, share } => grains?.front(*along, *share),
            Measure::FluidForce { set, number } => coupled::fluid_force(fluid?, grains?.find(set, *number)),
            Measure::Submergence { set, number } => coupled::submergence(fluid?, grains?.find(set, *number)),
            // Written with the fields.
            Measure::Profile { .. } | Measure::SurfaceProfile { .. } | Measure::DepthMap { .. } => Vec::new(),
        })
    }
}
