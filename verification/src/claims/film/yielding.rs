//! Films of yield-stress fluid: profile and discharge at any fill level.

use super::support::{SLOPE, Sheet};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use lahar::rheology::Law;
use lahar::solver::run::Backend;
use lahar::solver::steady::SteadyRule;

/// Which law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fluid {
    /// n = 1.
    Bingham,
    /// n = 0.33.
    HerschelBulkley,
}

/// g H³: u falls as 1/H, u and the compression 3gH as the discretisation error.
const DRIVE: f64 = 0.04;

/// A film whose plug takes 30 % of the depth; apparent viscosity at the bed near 0.14 and 0.28 (τ = 0.9, 1.3).
pub fn sheet(fluid: Fluid, depth: f64) -> Sheet {
    let gravity = DRIVE / (depth * depth * depth);
    let load = gravity * libm::sin(SLOPE) * depth;
    let sigma0 = 0.3 * load;
    let law = match fluid {
        Fluid::Bingham => Law::Bingham { sigma0, mu: 0.1 },
        Fluid::HerschelBulkley => {
            let rate = DRIVE / (depth * depth);
            Law::HerschelBulkley { sigma0, k: 0.5 * load / libm::pow(rate, 0.33), n: 0.33 }
        }
    };
    Sheet::new(law, depth, gravity)
}

/// Steady to a change of 1e-9 per 500 steps.
pub const STEADY: SteadyRule = SteadyRule { tolerance: 1e-9, interval: 500, max_steps: 400_000 };

/// Fill levels of one rung: the error must not depend on where the surface or the plug lies in its cell.
const LEVELS: [f64; 4] = [0.0, 0.25, 0.5, 0.75];

fn rung(backend: &dyn Backend, fluid: Fluid, cells: f64) -> Result<Sample, VerifyError> {
    let (mut computed, mut exact) = (Vec::new(), Vec::new());
    let (mut flux, mut conversions) = (0.0_f64, 0);
    for level in LEVELS {
        let sheet = sheet(fluid, cells + level);
        let flow = sheet.steady(backend, STEADY)?;
        let unit = sheet.exact().surface_velocity();
        computed.extend(flow.liquid().iter().map(|u| u / unit));
        exact.extend(sheet.profile(flow.liquid().len()).iter().map(|u| u / unit));
        let error = (flow.flux() / sheet.exact().flux() - 1.0).abs();
        flux = if error <= flux { flux } else { error };
        conversions += flow.conversions;
    }
    Ok(Sample::l2(cells, &computed, &exact)
        .with("largest error of q", flux)
        .with("conversions", conversions as f64))
}

/// Bingham film.
pub const BINGHAM: Claim = Claim {
    id: "film-bingham",
    title: "The profile of a Bingham film converges at second order, at any fill level",
    tags: &["F1", "F2", "F3", "Y3", "B3"],
    measures: "L2 difference of u/u_s over the liquid cells of four films of N, N+¼, N+½ and N+¾ cells",
    reference: Reference { source: "REFERENCES §3 with n = 1", uncertainty: 0.0 },
    metric: Metric::L2,
    ladder: Ladder { parameter: "N (cells deep)", short: &[4.0, 8.0, 16.0], full: &[4.0, 8.0, 16.0, 32.0] },
    order: Some(OrderBand { expected: 2.0, band: 0.3, at_least: false }),
    tolerance: Tolerance {
        value: 0.02,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "second order at 0.3/N²",
    },
    kind: Kind::Verification,
    measure: |backend, n| rung(backend, Fluid::Bingham, n),
};

/// Herschel-Bulkley film.
pub const HERSCHEL_BULKLEY: Claim = Claim {
    id: "film-herschel-bulkley",
    title: "The profile of a Herschel-Bulkley film (n = 0.33) converges at second order, at any fill level",
    tags: &["F1", "F2", "F3", "Y3", "B3"],
    measures: "L2 difference of u/u_s over the liquid cells of four films of N, N+¼, N+½ and N+¾ cells",
    reference: Reference { source: "REFERENCES §3", uncertainty: 0.0 },
    metric: Metric::L2,
    ladder: Ladder { parameter: "N (cells deep)", short: &[6.0, 12.0, 24.0], full: &[6.0, 12.0, 24.0, 48.0] },
    order: Some(OrderBand { expected: 2.0, band: 0.4, at_least: false }),
    tolerance: Tolerance {
        value: 0.05,
        at: Rung::Every,
        basis: Basis::AfterSeeing,
        because: "0.7/N² and more on coarse grids: the apparent viscosity varies tenfold within the \
                  cell next to the plug; the order is 1.5 from 6 to 12 cells and 1.8 from 12 to 24",
    },
    kind: Kind::Verification,
    measure: |backend, n| rung(backend, Fluid::HerschelBulkley, n),
};
