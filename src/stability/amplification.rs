//! One linearised step: exact Jacobian of a collision kernel times the phase of streaming.

use super::StabilityError;
use super::eigenvalues::{C64, EigenvalueSolver, Matrix, eigenvalues, modulus};
use crate::collision::Collision;
use crate::lane::Dual;
use crate::lattice::equilibrium::equilibrium;
use crate::lattice::moments::moments;
use crate::lattice::{C, Q};

/// A collision operator linearised about uniform flow.
#[derive(Clone, Debug)]
pub struct Linearised {
    /// `jacobian[i][j]` = ∂f*_i/∂f_j.
    jacobian: [[f64; Q]; Q],
    /// The velocity it was taken at.
    velocity: [f64; 3],
    /// What finds the eigenvalues of M(k).
    solver: EigenvalueSolver,
}

impl Linearised {
    /// J = ∂f*/∂f at density 1 and velocity `u`, without force, at constant ω⁺ = 1/τ.
    ///
    /// The derivatives are those of the kernel that runs, moments included, taken by [`Dual`]
    /// numbers: no difference quotient, no second copy of the operator. The operators of lahar are
    /// affine in the moments that are not conserved, so any base state with these ρ and u gives the
    /// same matrix; the second-order equilibrium is taken.
    ///
    /// # Arguments
    /// `collision`: the operator. `tau`: τ⁺ > ½. `u`: lattice units.
    /// # Exactness
    /// + − × ÷ √ of the kernel and its derivative, one order; bit-stable.
    /// # Source
    /// docs/method.md \[K5\].
    /// # Verified by
    /// Claims `neumann-noise-evolution`, `neumann-table`; test `conserves_mass_and_momentum_linearly`.
    #[must_use]
    pub fn about<O: Collision>(collision: &O, tau: f64, u: [f64; 3]) -> Self {
        let base = equilibrium(0.0, 1.0, &u);
        let omega = Dual::constant(1.0 / tau);
        let still = [Dual::constant(0.0); 3];
        let mut jacobian = [[0.0; Q]; Q];
        for j in 0..Q {
            let mut h = base.map(Dual::constant);
            h[j] = Dual::variable(base[j]);
            let m = moments(&h, &still);
            let post = collision.collide(&h, &m, omega);
            for i in 0..Q {
                jacobian[i][j] = post[i].slope;
            }
        }
        Self { jacobian, velocity: u, solver: eigenvalues }
    }

    /// The same step with another way to find eigenvalues, for comparisons.
    #[must_use]
    pub fn with_solver(self, solver: EigenvalueSolver) -> Self {
        Self { solver, ..self }
    }

    /// The Jacobian ∂f*_i/∂f_j.
    #[must_use]
    pub const fn jacobian(&self) -> &[[f64; Q]; Q] {
        &self.jacobian
    }

    /// The velocity of the uniform flow.
    #[must_use]
    pub const fn velocity(&self) -> [f64; 3] {
        self.velocity
    }

    /// M(k) = diag(exp(−i k·c)) J: what one step does to a wave exp(i k·x).
    ///
    /// # Arguments
    /// `k`: wave vector, radians per cell.
    /// # Source
    /// docs/method.md \[K5\]; J. D. Sterling and S. Chen, J. Comput. Phys. 123 (1996) 196.
    /// # Verified by
    /// Claim `neumann-noise-evolution`.
    #[must_use]
    pub fn amplification(&self, k: [f64; 3]) -> Matrix {
        let phase = phases(k);
        std::array::from_fn(|i| std::array::from_fn(|j| phase[i] * self.jacobian[i][j]))
    }

    /// Largest modulus of an eigenvalue of M(k).
    ///
    /// # Errors
    /// The matrix is not finite.
    pub fn spectral_radius(&self, k: [f64; 3]) -> Result<f64, StabilityError> {
        let found = (self.solver)(&self.amplification(k))
            .ok_or(StabilityError::Eigenvalues { velocity: self.velocity, wave: k })?;
        Ok(found.into_iter().map(modulus).fold(0.0, f64::max))
    }
}

/// exp(−i k·c_i).
#[must_use]
pub fn phases(k: [f64; 3]) -> [C64; Q] {
    let axis: [[C64; 3]; 3] = std::array::from_fn(|a| {
        let (s, c) = (libm::sin(k[a]), libm::cos(k[a]));
        [C64::new(c, s), C64::new(1.0, 0.0), C64::new(c, -s)]
    });
    std::array::from_fn(|i| {
        let factor = |a: usize| axis[a][(C[i][a] + 1) as usize];
        factor(0) * factor(1) * factor(2)
    })
}
