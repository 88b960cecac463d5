//! How a yield stress is treated.

/// How the yield stress enters the relaxation time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum YieldTreatment {
    /// \[Y1\]–\[Y3\]: solved exactly in each cell, no viscosity cap.
    Exact,
    /// \[Y3\] with the resulting τ clamped: the trilinear law, implicit.
    ImplicitClamped {
        /// Least τ.
        tau_min: f64,
        /// Largest τ.
        tau_max: f64,
    },
    /// \[Y4\]: the papers' scheme; γ̇ from the previous step's τ, then clamped (one more field: τ).
    LaggedClamped {
        /// Least τ.
        tau_min: f64,
        /// Largest τ.
        tau_max: f64,
    },
}
