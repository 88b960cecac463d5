//! SI to lattice units and back: the only converter.
//!
//! Lattice units have Δx = Δt = 1 and reference density 1, so every quantity is scaled by
//! powers of the three numbers held here.

use serde::Serialize;

/// The three scales that fix all others.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Units {
    /// Cell size Δx, metres.
    pub dx_m: f64,
    /// Time step Δt, seconds.
    pub dt_s: f64,
    /// Reference density ρ0, kg/m³.
    pub rho0_kg_per_m3: f64,
}

impl Units {
    /// Scales from cell size (m), time step (s) and reference density (kg/m³).
    #[must_use]
    pub fn new(dx_m: f64, dt_s: f64, rho0_kg_per_m3: f64) -> Self {
        Self { dx_m, dt_s, rho0_kg_per_m3 }
    }

    /// One lattice velocity in m/s.
    #[must_use]
    pub fn velocity_unit(&self) -> f64 {
        self.dx_m / self.dt_s
    }

    /// One lattice force density in N/m³.
    #[must_use]
    pub fn force_unit(&self) -> f64 {
        self.rho0_kg_per_m3 * self.dx_m / (self.dt_s * self.dt_s)
    }

    /// One lattice stress or pressure in Pa.
    #[must_use]
    pub fn stress_unit(&self) -> f64 {
        let u = self.velocity_unit();
        self.rho0_kg_per_m3 * u * u
    }

    /// One lattice dynamic viscosity in Pa s.
    #[must_use]
    pub fn viscosity_unit(&self) -> f64 {
        self.rho0_kg_per_m3 * self.dx_m * self.velocity_unit()
    }

    /// One lattice consistency in Pa sⁿ: stress unit times Δtⁿ.
    #[must_use]
    pub fn consistency_unit(&self, n: f64) -> f64 {
        self.stress_unit() * libm::pow(self.dt_s, n)
    }

    /// m/s to lattice.
    #[must_use]
    pub fn velocity_to_lattice(&self, m_per_s: f64) -> f64 {
        m_per_s / self.velocity_unit()
    }

    /// Lattice to m/s.
    #[must_use]
    pub fn velocity_to_si(&self, lattice: f64) -> f64 {
        lattice * self.velocity_unit()
    }

    /// A velocity vector, m/s to lattice.
    #[must_use]
    pub fn velocities_to_lattice(&self, m_per_s: [f64; 3]) -> [f64; 3] {
        m_per_s.map(|u| self.velocity_to_lattice(u))
    }

    /// A velocity vector, lattice to m/s.
    #[must_use]
    pub fn velocities_to_si(&self, lattice: [f64; 3]) -> [f64; 3] {
        lattice.map(|u| self.velocity_to_si(u))
    }

    /// N/m³ to lattice.
    #[must_use]
    pub fn force_to_lattice(&self, n_per_m3: f64) -> f64 {
        n_per_m3 / self.force_unit()
    }

    /// Lattice to N/m³.
    #[must_use]
    pub fn force_to_si(&self, lattice: f64) -> f64 {
        lattice * self.force_unit()
    }

    /// A force density vector, N/m³ to lattice.
    #[must_use]
    pub fn forces_to_lattice(&self, n_per_m3: [f64; 3]) -> [f64; 3] {
        n_per_m3.map(|f| self.force_to_lattice(f))
    }

    /// Pa to lattice (stress, pressure difference, yield stress).
    #[must_use]
    pub fn stress_to_lattice(&self, pa: f64) -> f64 {
        pa / self.stress_unit()
    }

    /// Lattice to Pa.
    #[must_use]
    pub fn stress_to_si(&self, lattice: f64) -> f64 {
        lattice * self.stress_unit()
    }

    /// Pa s to lattice.
    #[must_use]
    pub fn viscosity_to_lattice(&self, pa_s: f64) -> f64 {
        pa_s / self.viscosity_unit()
    }

    /// Lattice to Pa s.
    #[must_use]
    pub fn viscosity_to_si(&self, lattice: f64) -> f64 {
        lattice * self.viscosity_unit()
    }

    /// Pa sⁿ to lattice.
    #[must_use]
    pub fn consistency_to_lattice(&self, pa_s_n: f64, n: f64) -> f64 {
        pa_s_n / self.consistency_unit(n)
    }

    /// Lattice to Pa sⁿ.
    #[must_use]
    pub fn consistency_to_si(&self, lattice: f64, n: f64) -> f64 {
        lattice * self.consistency_unit(n)
    }

    /// 1/s (shear rate, angular velocity, angular frequency) to lattice (per step).
    #[must_use]
    pub fn rate_to_lattice(&self, per_s: f64) -> f64 {
        per_s * self.dt_s
    }

    /// Lattice (per step) to 1/s.
    #[must_use]
    pub fn rate_to_si(&self, per_step: f64) -> f64 {
        per_step / self.dt_s
    }

    /// Seconds to steps (not rounded).
    #[must_use]
    pub fn time_to_lattice(&self, s: f64) -> f64 {
        s / self.dt_s
    }

    /// Steps to seconds.
    #[must_use]
    pub fn time_to_si(&self, steps: f64) -> f64 {
        steps * self.dt_s
    }

    /// Metres to cells (not rounded).
    #[must_use]
    pub fn length_to_lattice(&self, m: f64) -> f64 {
        m / self.dx_m
    }

    /// Cells to metres.
    #[must_use]
    pub fn length_to_si(&self, cells: f64) -> f64 {
        cells * self.dx_m
    }

    /// Lattice density to gauge pressure in Pa: (ρ − 1) c_s², c_s² = 1/3.
    #[must_use]
    pub fn pressure_of_density(&self, rho: f64) -> f64 {
        self.stress_to_si((rho - 1.0) / 3.0)
    }

    /// Position of a cell centre, metres.
    #[must_use]
    pub fn cell_centre_m(&self, cell: [usize; 3]) -> [f64; 3] {
        cell.map(|i| (i as f64 + 0.5) * self.dx_m)
    }

    /// Relaxation time of a dynamic viscosity in Pa s: τ = ½ + 3ν \[L6\].
    #[must_use]
    pub fn tau_of_viscosity(&self, pa_s: f64) -> f64 {
        0.5 + 3.0 * self.viscosity_to_lattice(pa_s)
    }
}
