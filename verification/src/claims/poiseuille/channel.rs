//! What the claims on plane channels share: scaling to the lattice, steady runs, and the steady
//! solution of the scheme itself in closed form.

use std::sync::Arc;

use crate::claim::VerifyError;
use crate::exact::flow_curve::FlowCurve;
use crate::exact::poiseuille::Channel;
use crate::exact::poiseuille_clamped::Trilinear;
use lahar::collision::{CollisionChoice, OddRate};
use lahar::rheology::Law;
use lahar::setup::{FlowPoint, Setup, WallRule, YieldTreatment};
use lahar::solver::run::{Backend, Fields};
use lahar::solver::steady::{SteadyRule, run_to_steady};

/// Consistency, flow index and yield stress of the thesis' channel, with half-width and wall stress 1.
pub const THESIS: Law = Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n: 0.33 };

/// The Bingham fluid of the same yield stress and consistency.
pub const BINGHAM: Law = Law::Bingham { sigma0: 0.5, mu: 0.2 };

/// ρ Δx²/(3Δt) of the thesis' channel in Pa s: viscosity per unit of τ.
pub const THESIS_VISCOSITY_PER_TAU: f64 = 80.0 / 3.0;

/// From a channel of half-width 1, wall stress 1 and density 1 to a column of cells.
///
/// A steady unidirectional flow has no inertia, so speed and viscosity on the lattice can be chosen
/// separately: the first sets the Mach number, the second τ.
#[derive(Clone, Copy, Debug)]
pub struct Scale {
    /// Cells across.
    pub n: usize,
    /// Lattice shear rate per unit shear rate.
    pub rate: f64,
    /// Lattice stress per unit stress.
    pub stress: f64,
}

impl Scale {
    /// `viscosity`: lattice viscosity per unit viscosity, Δt/Δx². `fastest`: largest velocity of the
    /// flow in its own units; `speed`: what it shall be on the lattice.
    pub fn new(n: usize, viscosity: f64, fastest: f64, speed: f64) -> Self {
        let rate = speed / (fastest * 0.5 * n as f64);
        Self { n, rate, stress: viscosity * rate }
    }

    /// The law in lattice units.
    pub fn law(&self, law: &Law) -> Law {
        let (stress, rate) = (self.stress, self.rate);
        let consistency = |k: f64, n: f64| k * stress / libm::pow(rate, n);
        match *law {
            Law::Newtonian { mu } => Law::Newtonian { mu: mu * stress / rate },
            Law::Bingham { sigma0, mu } => Law::Bingham { sigma0: sigma0 * stress, mu: mu * stress / rate },
            Law::HerschelBulkley { sigma0, k, n } => {
                Law::HerschelBulkley { sigma0: sigma0 * stress, k: consistency(k, n), n }
            }
            Law::PowerLaw { k, n } => Law::PowerLaw { k: consistency(k, n), n },
            Law::Papanastasiou { sigma0, k, n, m } => {
                Law::Papanastasiou { sigma0: sigma0 * stress, k: consistency(k, n), n, m: m / rate }
            }
        }
    }

    /// Body force that makes the wall stress 1.
    pub fn force(&self) -> f64 {
        2.0 * self.stress / self.n as f64
    }
}

/// A plane channel on the lattice: `n` cells of `law` driven by `force`.
#[derive(Clone, Copy, Debug)]
pub struct Column {
    /// Cells across.
    pub n: usize,
    /// The law, lattice units.
    pub law: Law,
    /// Body force along x.
    pub force: f64,
    /// Collision operator.
    pub collision: CollisionChoice,
    /// Yield treatment.
    pub yielding: YieldTreatment,
    /// Wall rule.
    pub wall: WallRule,
}

impl Column {
    /// Exact yield, default collision, viscosity-independent walls.
    pub fn new(scale: &Scale, law: &Law) -> Self {
        Self {
            n: scale.n,
            law: scale.law(law),
            force: scale.force(),
            collision: CollisionChoice::default(),
            yielding: YieldTreatment::Exact,
            wall: WallRule::ViscosityIndependent,
        }
    }

    /// The thesis' fluids (half-width 1, wall stress 1) at `viscosity` = Δt/Δx² and largest speed `speed`.
    pub fn unit(n: usize, law: &Law, viscosity: f64, speed: f64) -> Self {
        let fastest = Channel { law: *law, half_width: 1.0, force: 1.0 }.plug_velocity();
        Self::new(&Scale::new(n, viscosity, fastest, speed), law)
    }

    /// Newtonian at a given even relaxation time and largest speed.
    pub fn newtonian(n: usize, tau: f64, speed: f64, collision: CollisionChoice, wall: WallRule) -> Self {
        let mu = (tau - 0.5) / 3.0;
        let force = 8.0 * mu * speed / (n * n) as f64;
        let law = Law::Newtonian { mu };
        Self { n, law, force, collision, yielding: YieldTreatment::Exact, wall }
    }

    /// The continuum flow that the run should approach.
    pub fn exact(&self) -> Result<Channel<Curve>, VerifyError> {
        Ok(Channel {
            law: Curve::new(&self.law, self.yielding)?,
            half_width: 0.5 * self.n as f64,
            force: self.force,
        })
    }

    /// Distance of cell j's centre from the mid-plane, with its sign.
    pub fn height(&self, j: usize) -> f64 {
        j as f64 + 0.5 - 0.5 * self.n as f64
    }

    /// u at the cell centres of the continuum flow.
    pub fn reference(&self) -> Result<Vec<f64>, VerifyError> {
        let exact = self.exact()?;
        Ok((0..self.n).map(|j| exact.velocity(self.height(j))).collect())
    }

    /// The set-up, at rest.
    pub fn setup(&self) -> Setup {
        let mut setup = Setup::channel(self.n, self.law, self.force);
        setup.collision = self.collision;
        setup.yielding = self.yielding;
        setup.wall_rule = self.wall;
        setup
    }

    /// The set-up, started from the continuum flow: saves the time of the start-up.
    pub fn developed(&self) -> Result<Setup, VerifyError> {
        self.started(1.0)
    }

    /// The set-up, started from `times` the continuum flow.
    pub fn started(&self, times: f64) -> Result<Setup, VerifyError> {
        let (exact, column) = (self.exact()?, *self);
        let mut setup = self.setup();
        setup.initial = Some(Arc::new(move |[_, j, _]| {
            let y = column.height(j);
            let mut gradient = [[0.0; 3]; 3];
            gradient[0][1] = if y < 0.0 { times * exact.shear_rate(y) } else { -times * exact.shear_rate(y) };
            FlowPoint { density: 1.0, velocity: [times * exact.velocity(y), 0.0, 0.0], gradient }
        }));
        Ok(setup)
    }

    /// The steady solution of the scheme itself (see [`scheme_solution`]).
    pub fn scheme(&self) -> Result<Vec<f64>, VerifyError> {
        scheme_solution(self)
    }

    /// Steps in which a disturbance of the whole channel decays by a factor e: (n/π)²/ν with the
    /// tangent viscosity at the wall, where it is least for the laws used here.
    pub fn relaxation_steps(&self) -> Result<f64, VerifyError> {
        let exact = self.exact()?;
        let slope = exact.law.rate_slope(exact.wall_stress());
        let across = self.n as f64 / core::f64::consts::PI;
        Ok(across * across * slope)
    }
}

/// A law as the yield treatment makes it: itself, or clamped.
#[derive(Clone, Debug)]
pub enum Curve {
    /// The law itself.
    Ideal(Law),
    /// With τ limited.
    Clamped(Trilinear),
}

impl Curve {
    /// The law a treatment solves, at density 1.
    pub fn new(law: &Law, yielding: YieldTreatment) -> Result<Self, VerifyError> {
        match yielding {
            YieldTreatment::Exact => Ok(Self::Ideal(*law)),
            YieldTreatment::ImplicitClamped { tau_min, tau_max }
            | YieldTreatment::LaggedClamped { tau_min, tau_max } => {
                Trilinear::new(*law, (tau_min - 0.5) / 3.0, (tau_max - 0.5) / 3.0)
                    .map(Self::Clamped)
                    .map_err(|e| VerifyError::Numerics { what: "the clamped law", detail: e.to_string() })
            }
        }
    }

    fn get(&self) -> &dyn FlowCurve {
        match self {
            Self::Ideal(law) => law,
            Self::Clamped(law) => law,
        }
    }
}

impl FlowCurve for Curve {
    fn rate(&self, stress: f64) -> f64 {
        self.get().rate(stress)
    }
    fn rate_slope(&self, stress: f64) -> f64 {
        self.get().rate_slope(stress)
    }
    fn stress(&self, rate: f64) -> f64 {
        self.get().stress(rate)
    }
    fn yield_stress(&self) -> f64 {
        self.get().yield_stress()
    }
    fn steep_at_yield(&self) -> bool {
        self.get().steep_at_yield()
    }
    fn moment(&self, power: u32, stress: f64) -> f64 {
        self.get().moment(power, stress)
    }
}

/// The steady solution that the lattice scheme itself has in a plane channel, in closed form.
///
/// Write t for the third moment Σ c_y² c_x f and p for Σ c_x c_y f. Steady streaming along y makes
/// the shear stress exactly G y, and leaves t_{j+1} − t_j equal to a sixth of γ̇_j + γ̇_{j+1}; the
/// odd relaxation gives 3t = u − 2G(τ⁻ − ½); half-way bounce-back gives u_0 = γ̇_0/2 + 2G(τ⁻_0 − ½).
/// Hence, counting from the wall,
///
/// u_j = Σ_{i<j} γ̇_i + ½γ̇_j + 2G(τ⁻_j − ½) + u_w,
///
/// with γ̇_i the law at the stress of the cell's centre and u_w the velocity that \[B3\] gives the wall
/// ([`wall_velocity`]). Terms of order Mach² are left out: only BGK and TRT with a constant viscosity have none.
///
/// # Source
/// Derived here from \[K2\], \[L5\] and \[B1\]; for a Newtonian fluid it is the slip of Ginzburg &
/// d'Humières 2003, Phys. Rev. E 68, 066614.
fn scheme_solution(column: &Column) -> Result<Vec<f64>, VerifyError> {
    let exact = column.exact()?;
    let rates: Vec<f64> = (0..column.n).map(|j| exact.shear_rate(column.height(j))).collect();
    let odd: Vec<f64> = (0..column.n)
        .map(|j| {
            let stress = exact.stress(column.height(j));
            // τ − ½ = 3σ/γ̇; infinite where rigid, 3/(dγ̇/dσ) where both vanish.
            let even = if rates[j] > 0.0 { stress / rates[j] } else { 1.0 / exact.law.rate_slope(stress) };
            odd_excess(&column.collision, 3.0 * even)
        })
        .collect();
    let force = column.force;
    let wall = match column.wall {
        WallRule::HalfWay => 0.0,
        WallRule::ViscosityIndependent => wall_velocity(column, &exact, odd[0]),
    };
    let half = column.n.div_ceil(2);
    let mut u = vec![0.0; column.n];
    let mut sum = 0.0;
    for j in 0..half {
        u[j] = sum + 0.5 * rates[j] + 2.0 * force * odd[j] + wall;
        u[column.n - 1 - j] = u[j];
        sum += rates[j];
    }
    Ok(u)
}

/// The velocity that the law by stress \[B3\] gives a channel's wall, from the exact stresses: the integral of γ̇ over the
/// first three and a half cells, less what the scheme makes of it, and further in by the Euler–Maclaurin term;
/// `odd`: τ⁻ − ½ of the wall cell.
fn wall_velocity(column: &Column, exact: &Channel<Curve>, odd: f64) -> f64 {
    let (law, f) = (&exact.law, column.force);
    let rate = |s: f64| if s < 0.0 { -law.rate(-s) } else { law.rate(s) };
    // Γ; even in the stress.
    let integral = |s: f64| law.moment(0, s.abs());
    let even = |s: f64| if rate(s) > 0.0 { s / rate(s) } else { 1.0 / law.rate_slope(s) };
    let s = exact.stress(column.height(0));
    let carried = f * (3.0 / (8.0 * (3.0 * even(s)))).min(2.0 * odd);
    // Nodes of this half of the channel.
    let nodes: Vec<f64> = (0..4).map(|k| s - f64::from(k) * f).collect();
    let within: Vec<f64> = nodes.iter().copied().filter(|&s| s > 0.0).collect();
    let last = within.last().copied().unwrap_or(s);
    let mut missed = (integral(exact.wall_stress()) - integral(s)) / f - 0.5 * rate(s);
    for &from in within.iter().take(3) {
        let to = from - f;
        missed += (integral(from) - integral(to)) / f - 0.5 * (rate(from) + rate(to));
    }
    if nodes[3] >= f {
        missed += f * rate(nodes[3]) / nodes[3] / 12.0 - (rate(nodes[3]) - rate(nodes[3] - f)) / 12.0;
    }
    let far = odd_excess(&column.collision, 3.0 * even(last));
    ((missed - carried) + 2.0 * f * (odd - far)).max(0.0) + carried - 2.0 * odd * f
}

/// τ⁻ − ½ that goes with τ⁺ − ½ (infinite: rigid).
fn odd_excess(collision: &CollisionChoice, even: f64) -> f64 {
    match collision {
        CollisionChoice::Bgk => even,
        CollisionChoice::Regularised => 0.5,
        CollisionChoice::Trt(odd) | CollisionChoice::CentralMoment(odd) => {
            let OddRate { magic, floor, lowered_below, .. } = *odd;
            let wanted = magic / even;
            let wanted = if lowered_below > 0.0 {
                wanted.min(magic * even / (lowered_below * lowered_below))
            } else {
                wanted
            };
            wanted.max(floor)
        }
    }
}

/// A steady flow.
#[derive(Clone, Debug)]
pub struct Steady {
    /// Its fields.
    pub fields: Fields,
    /// Steps it took.
    pub steps: u64,
}

impl Steady {
    /// One velocity component of all cells.
    pub fn velocity(&self, axis: usize) -> Vec<f64> {
        self.fields.velocity.iter().map(|u| u[axis]).collect()
    }
}

/// Runs until the velocity changes by less than `tolerance` over `interval` steps and has less than that still to change.
pub fn run_steady(
    backend: &dyn Backend,
    setup: &Setup,
    tolerance: f64,
    interval: u64,
    max_steps: u64,
) -> Result<Steady, VerifyError> {
    let mut run = backend.start(setup)?;
    let outcome = run_to_steady(&mut *run, SteadyRule { tolerance, interval, max_steps })?;
    if !outcome.steady {
        return Err(VerifyError::not_steady(&outcome, tolerance));
    }
    Ok(Steady { fields: run.fields(), steps: outcome.steps })
}

/// Runs a column until it changes by less than `tolerance` over a fifth of its relaxation time, and is to change by no more.
pub fn steady_column(backend: &dyn Backend, column: &Column, tolerance: f64) -> Result<Steady, VerifyError> {
    steady_from(backend, column, &column.developed()?, tolerance)
}

/// Runs a column to its steady state from the set-up given.
pub fn steady_from(
    backend: &dyn Backend,
    column: &Column,
    setup: &Setup,
    tolerance: f64,
) -> Result<Steady, VerifyError> {
    let relaxation = column.relaxation_steps()?;
    let interval = (0.2 * relaxation).ceil().clamp(20.0, 1e6);
    // 40 relaxation times would take a start-up from rest below rounding; the rest is margin for
    // the slow adjustment of a plug.
    run_steady(backend, setup, tolerance, interval as u64, (400.0 * relaxation).max(20_000.0) as u64)
}

/// What the unyielded core of a steady column does.
#[derive(Clone, Copy, Debug)]
pub struct Plug {
    /// Cells with ω⁺ = 0.
    pub cells: usize,
    /// Cells whose centre lies where G|y| does not exceed the yield stress.
    pub exact_cells: usize,
    /// max u − min u over those with ω⁺ = 0, over the largest speed.
    pub spread: f64,
}

impl Plug {
    /// From fields along a column.
    pub fn of(column: &Column, fields: &Fields) -> Result<Self, VerifyError> {
        let exact = column.exact()?;
        let rigid = |j: usize| exact.stress(column.height(j)) <= exact.law.yield_stress();
        let fastest = fields.velocity.iter().map(|u| u[0].abs()).fold(0.0, f64::max);
        let inside =
            || fields.omega.iter().zip(&fields.velocity).filter(|(w, _)| **w == 0.0).map(|(_, u)| u[0]);
        let highest = inside().fold(f64::NEG_INFINITY, f64::max);
        let lowest = inside().fold(f64::INFINITY, f64::min);
        Ok(Self {
            cells: inside().count(),
            exact_cells: (0..column.n).filter(|&j| rigid(j)).count(),
            spread: if highest >= lowest { (highest - lowest) / fastest } else { 0.0 },
        })
    }
}
