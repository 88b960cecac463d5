//! Bingham and Herschel-Bulkley channels with the exact yield stress.

use super::channel::{BINGHAM, Column, Plug, THESIS, steady_column, steady_from};
use crate::claim::{
    Basis, Claim, Kind, Ladder, Metric, OrderBand, Reference, Rung, Sample, Tolerance, VerifyError,
};
use lahar::rheology::Law;
use lahar::setup::WallRule;
use lahar::solver::run::Backend;

/// Lattice viscosity per unit viscosity, Δt/Δx²: plastic viscosity 0.2 becomes 0.05.
const VISCOSITY: f64 = 0.25;
/// Largest lattice velocity; steady channel flow has no inertia, so it only sets the Mach number.
const SPEED: f64 = 1e-3;

const EXACT: Reference = Reference {
    source: "u = (G/K)^{1/n} [(h − h₀)^N − (|y| − h₀)₊^N]/N, N = 1 + 1/n (REFERENCES 1)",
    uncertainty: 0.0,
};
const RESOLUTION: Ladder =
    Ladder { parameter: "N (cells across)", short: &[16.0, 32.0, 64.0], full: &[16.0, 32.0, 64.0, 128.0] };

fn l2(backend: &dyn Backend, n: f64, column: &Column) -> Result<Sample, VerifyError> {
    // A thousandth of the error at N = 128.
    let steady = steady_column(backend, column, 1e-8)?;
    let plug = Plug::of(column, &steady.fields)?;
    let theory = Sample::l2(n, &column.scheme()?, &column.reference()?).error;
    Ok(Sample::l2(n, &steady.velocity(0), &column.reference()?)
        .with("error of the scheme's closed form", theory)
        .with("plug cells", plug.cells as f64)
        .with("plug cells, exact", plug.exact_cells as f64)
        .with("steps", steady.steps as f64))
}

/// Order two for Bingham.
pub const BINGHAM_L2: Claim = Claim {
    id: "poiseuille-bingham",
    title: "Bingham flow with exact yield converges at second order",
    tags: &["Y1", "Y2", "Y3", "K3", "B3"],
    measures: "relative L2 error of the velocity; plug half of the channel, Δt/Δx² = 0.25",
    reference: EXACT,
    metric: Metric::L2,
    ladder: RESOLUTION,
    order: Some(OrderBand { expected: 2.0, band: 0.1, at_least: true }),
    tolerance: Tolerance {
        value: 5.5e-4,
        at: Rung::At(64.0),
        basis: Basis::Derived,
        because: "in closed form 4.5e-4 at N = 64 (column `error of the scheme's closed form`): the law by stress makes \
                  the plug right and leaves the sheared nodes off by the trapezoid rule's 2 G/(12μ) = (32/N²)/(12·8) \
                  of u_max at the wall, falling towards the plug",
    },
    kind: Kind::Verification,
    measure: |backend, n| l2(backend, n, &Column::unit(n as usize, &BINGHAM, VISCOSITY, SPEED)),
};

/// Order two for Herschel-Bulkley.
pub const HB_L2: Claim = Claim {
    id: "poiseuille-herschel-bulkley",
    title: "Herschel-Bulkley flow (n = 0.33) with exact yield converges at second order",
    tags: &["Y1", "Y2", "Y3", "K3", "B1"],
    measures: "relative L2 error of the velocity; plug half of the channel, half-way walls, Δt/Δx² = 4",
    reference: EXACT,
    metric: Metric::L2,
    ladder: RESOLUTION,
    order: Some(OrderBand { expected: 2.0, band: 0.1, at_least: false }),
    tolerance: Tolerance {
        value: 2.8e-3,
        at: Rung::At(64.0),
        basis: Basis::Derived,
        because: "the midpoint sum of γ̇ across the channel is off by Δx²γ̇′(wall)/24 and the half cell next to a \
                  node by Δx²γ̇′/8, less what the odd relaxation puts back: in closed form 2.74e-3 of u_max at \
                  N = 64 (column `error of the scheme's closed form`)",
    },
    kind: Kind::Verification,
    measure: |backend, n| l2(backend, n, &half_way(n as usize, &THESIS, 4.0)),
};

/// Herschel-Bulkley with the viscosity-independent wall.
pub const HB_B3_L2: Claim = Claim {
    id: "poiseuille-herschel-bulkley-b3",
    title: "Viscosity-independent walls make Herschel-Bulkley flow (n = 0.33) more accurate",
    tags: &["Y3", "K3", "B3"],
    measures: "relative L2 error of the velocity; plug half of the channel, Δt/Δx² = 1",
    reference: EXACT,
    metric: Metric::L2,
    ladder: Ladder {
        parameter: "N (cells across)",
        short: &[16.0, 24.0, 32.0],
        full: &[16.0, 24.0, 32.0, 64.0, 128.0],
    },
    order: Some(OrderBand { expected: 2.0, band: 0.1, at_least: true }),
    tolerance: Tolerance {
        value: 4.2e-3,
        at: Rung::At(32.0),
        basis: Basis::Derived,
        because: "the closed form gives 3.83e-3 at N = 32 (column `error of the scheme's closed form`): the plug is right, and \
                  nodes in the sheared layer are off by what the trapezoid rule misses between them and the plug; with \
                  half-way walls it would be 1.1e-2",
    },
    kind: Kind::Verification,
    measure: |backend, n| l2(backend, n, &Column::unit(n as usize, &THESIS, 1.0, SPEED)),
};

fn half_way(n: usize, law: &Law, viscosity: f64) -> Column {
    Column { wall: WallRule::HalfWay, ..Column::unit(n, law, viscosity, SPEED) }
}

/// Where the yield surface lies.
pub const PLUG_CELLS: Claim = Claim {
    id: "poiseuille-plug-cells",
    title: "The plug is exact to the cell wherever the yield surface lies",
    tags: &["Y3"],
    measures: "number of cells with ω⁺ = 0; n = 0.5, N = 32",
    reference: Reference { source: "cells whose centre has G|y| ≤ σ0", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "plug ratio σ0/(Gh)",
        short: &[0.23, 0.5, 0.77],
        full: &[0.1, 0.23, 0.37, 0.5, 0.61, 0.77, 0.9],
    },
    order: None,
    tolerance: Tolerance {
        value: 0.0,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "the stress of the scheme at a cell centre is exactly G y: nothing is off unless a centre lies on \
                  the yield surface",
    },
    kind: Kind::Verification,
    measure: |backend, ratio| {
        let law = Law::HerschelBulkley { sigma0: ratio, k: 0.2, n: 0.5 };
        let column = Column::unit(32, &law, 1.0, SPEED);
        let steady = steady_column(backend, &column, 1e-10)?;
        let plug = Plug::of(&column, &steady.fields)?;
        let error = Sample::l2(ratio, &steady.velocity(0), &column.reference()?).error;
        Ok(Sample::absolute(ratio, plug.cells as f64, plug.exact_cells as f64)
            .with("relative L2 error of the velocity", error))
    },
};

/// How rigid the plug is.
pub const PLUG_RIGID: Claim = Claim {
    id: "poiseuille-plug-rigid",
    title: "The plug moves as a rigid body",
    tags: &["Y3", "K3"],
    measures: "(max u − min u)/u_max over the cells with ω⁺ = 0; N = 32, plug half of the channel",
    reference: Reference { source: "zero", uncertainty: 0.0 },
    metric: Metric::Absolute,
    ladder: Ladder { parameter: "n (flow index)", short: &[0.33, 1.0], full: &[0.33, 0.5, 0.7, 1.0, 1.3] },
    order: None,
    tolerance: Tolerance {
        value: 1e-12,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "rounding: 1e-16 of the populations against u_max = 1e-3 is 1e-13, a few times that over the cells \
                  of the plug",
    },
    kind: Kind::Verification,
    measure: |backend, n| {
        let column = Column::unit(32, &Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n }, 1.0, SPEED);
        let steady = steady_column(backend, &column, 1e-12)?;
        let plug = Plug::of(&column, &steady.fields)?;
        Ok(Sample::absolute(n, plug.spread, 0.0)
            .with("plug cells", plug.cells as f64)
            .with("plug cells, exact", plug.exact_cells as f64))
    },
};

/// Other flow indices.
pub const FLOW_INDEX: Claim = Claim {
    id: "poiseuille-flow-index",
    title: "Shear-thinning and shear-thickening channels are as accurate",
    tags: &["Y3", "B1"],
    measures: "relative L2 error of the velocity; N = 32, plug half of the channel, half-way walls",
    reference: EXACT,
    metric: Metric::L2,
    ladder: Ladder {
        parameter: "n (flow index)",
        short: &[0.5, 0.7, 1.3],
        full: &[0.25, 0.33, 0.5, 0.7, 1.0, 1.3, 1.8],
    },
    order: None,
    tolerance: Tolerance {
        value: 1.8e-2,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "the closed form's leading term grows as N²Δx²(1 + 1/n)/n; with n = 0.25 it is 1.75e-2 at N = 32 \
                  (column `error of the scheme's closed form`)",
    },
    kind: Kind::Verification,
    measure: |backend, n| {
        let mut sample =
            l2(backend, 32.0, &half_way(32, &Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n }, 1.0))?;
        sample.parameter = n;
        Ok(sample)
    },
};

/// Not the work of the initial state.
pub const FROM_REST: Claim = Claim {
    id: "poiseuille-from-rest",
    title: "From rest the same steady state is reached",
    tags: &["Y3", "K3", "B3"],
    measures: "max |u − u_scheme| / u_max, run from rest; N = 16, plug half of the channel",
    reference: Reference { source: "the scheme's steady state in closed form", uncertainty: 0.0 },
    metric: Metric::LInf,
    ladder: Ladder { parameter: "n (flow index)", short: &[1.0], full: &[0.5, 1.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-8,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "a thousand times the change per fifth of a relaxation time at which the run stops; the Mach term \
                  is (8u/N)² = 3e-9 of u_max at most, with a coefficient below one",
    },
    kind: Kind::Verification,
    measure: |backend, n| {
        let column = Column::unit(16, &Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n }, VISCOSITY, 1e-4);
        let steady = steady_from(backend, &column, &column.setup(), 1e-12)?;
        Ok(Sample::linf(n, &steady.velocity(0), &column.scheme()?).with("steps", steady.steps as f64))
    },
};

/// The scheme's own steady state.
pub const SCHEME: Claim = Claim {
    id: "poiseuille-scheme-closed-form",
    title: "The steady state of the scheme is known in closed form, and is what it gives",
    tags: &["Y1", "Y2", "Y3", "K2", "K3", "B1", "B3"],
    measures: "max |u − u_scheme| / u_max, half-way walls (1–3) and viscosity-independent walls (4–6); N = 32; \
               1, 4: Bingham; 2, 5: n = 0.33; 3, 6: n = 1.3",
    reference: Reference { source: "u_j = Σγ̇_i + ½γ̇_j + 2G(τ⁻_j − ½) + u_w", uncertainty: 0.0 },
    metric: Metric::LInf,
    ladder: Ladder { parameter: "case", short: &[1.0, 5.0], full: &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0] },
    order: None,
    tolerance: Tolerance {
        value: 1e-9,
        at: Rung::Every,
        basis: Basis::Derived,
        because: "the run stops at a change of 1e-12 per fifth of a relaxation time; the Mach term is \
                  (wall shear)² = (16u/N)² = 6e-10 for n = 0.33 at u = 5e-5, with a coefficient below one",
    },
    kind: Kind::Verification,
    measure: |backend, case| {
        let (law, wall) = match case as usize {
            1 => (BINGHAM, WallRule::HalfWay),
            2 => (THESIS, WallRule::HalfWay),
            3 => (Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n: 1.3 }, WallRule::HalfWay),
            4 => (BINGHAM, WallRule::ViscosityIndependent),
            5 => (THESIS, WallRule::ViscosityIndependent),
            _ => (Law::HerschelBulkley { sigma0: 0.5, k: 0.2, n: 1.3 }, WallRule::ViscosityIndependent),
        };
        let column = Column { wall, ..Column::unit(32, &law, 1.0, 5e-5) };
        let steady = steady_column(backend, &column, 1e-12)?;
        let continuum = Sample::linf(case, &steady.velocity(0), &column.reference()?).error;
        Ok(Sample::linf(case, &steady.velocity(0), &column.scheme()?)
            .with("distance to the continuum", continuum))
    },
};

/// The thesis' channel at the settings that a scene gets.
pub const THESIS_CHANNEL: Claim = Claim {
    id: "poiseuille-thesis-channel",
    title: "The thesis' channel has its speed on few cells, from three times the exact flow as well",
    tags: &["B3", "Y3", "K3"],
    measures: "largest |u_max/u_exact − 1| over both starts, in parts of what is allowed: 2.5, 1, 0.5, 0.2, 0.1 % at N = 8, 12, 16, 32, 64; \
               n = 0.33, plug half of the channel, largest speed 0.1",
    reference: EXACT,
    metric: Metric::Absolute,
    ladder: Ladder {
        parameter: "N (cells across)",
        short: &[8.0, 12.0, 16.0],
        full: &[8.0, 12.0, 16.0, 32.0, 64.0],
    },
    order: None,
    tolerance: Tolerance {
        value: 1.0,
        at: Rung::Every,
        basis: Basis::Reference,
        because: "the accuracy that was asked of the wall law; half-way walls are off by 12.6, 5.6, 3.2, 0.8 and 0.2 %",
    },
    kind: Kind::Verification,
    measure: |backend, n| {
        let cells = n as usize;
        // The step that the plan of a scene chooses: 0.1 cells per step at the speed of the plug, 1.993.
        let column = Column::unit(cells, &THESIS, 0.4 * n / 16.0, 0.1);
        let exact = column.exact()?.plug_velocity();
        let mut worst = 0.0_f64;
        let mut found = Vec::new();
        for start in [1.0, 3.0] {
            let steady = steady_from(backend, &column, &column.started(start)?, 1e-9)?;
            let fastest = steady.velocity(0).into_iter().fold(0.0, f64::max);
            worst = worst.max((fastest / exact - 1.0).abs());
            found.push(fastest / exact - 1.0);
        }
        let allowed = match cells {
            ..12 => 2.5e-2,
            12..16 => 1e-2,
            16..32 => 5e-3,
            32..64 => 2e-3,
            _ => 1e-3,
        };
        Ok(Sample::absolute(n, worst / allowed, 0.0)
            .with("u_max/u_exact − 1", found[0])
            .with("the same from three times the flow", found[1]))
    },
};
