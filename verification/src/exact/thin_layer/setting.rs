//! Initial states and beds of slope flows: the reservoir and the erodible bed of 004 Ch. 5.

use crate::exact::ExactError;

/// Surface of a reservoir on a slope behind a gate that stands normal to the bed: horizontal free
/// surface, rear wall at x = 0, gate at x = `length`, cell averages.
///
/// Horizontal means ∂h/∂x = tan θ, so h = V0/L + (x − L/2) tan θ; if that would leave the rear wall
/// dry, a wedge of length (2 V0/tan θ)^½ before the gate.
///
/// # Errors
/// `Argument` for volumes (per width), lengths or Δx that are not positive, a slope outside
/// \[0, π/2\) or a gate beyond the last cell.
pub fn reservoir(
    slope: f64,
    volume: f64,
    length: f64,
    dx: f64,
    cells: usize,
) -> Result<Vec<f64>, ExactError> {
    ExactError::positive("volume", volume)?;
    ExactError::positive("length", length)?;
    ExactError::positive("dx", dx)?;
    if !(0.0..core::f64::consts::FRAC_PI_2).contains(&slope) {
        return Err(ExactError::Argument {
            what: "slope",
            value: slope,
            allowed: "must be at least 0 and less than pi/2",
        });
    }
    if length > cells as f64 * dx {
        return Err(ExactError::Argument {
            what: "length",
            value: length,
            allowed: "must not exceed that of the cells",
        });
    }
    let rise = libm::tan(slope);
    let gate = volume / length + 0.5 * length * rise;
    let (start, depth) = if gate >= length * rise {
        (0.0, gate - length * rise)
    } else {
        (length - (2.0 * volume / rise).sqrt(), 0.0)
    };
    // ∫ from `start` to x of depth + rise (x − start), inside the reservoir.
    let filled = |x: f64| {
        let x = x.clamp(start, length) - start;
        x * (depth + 0.5 * rise * x)
    };
    Ok((0..cells).map(|i| (filled((i + 1) as f64 * dx) - filled(i as f64 * dx)) / dx).collect())
}

/// Bed with a recess of the given depth from `start` over `length`, cell averages; its two edges fall
/// and rise linearly over a distance `ramp` centred on the nominal edge, which keeps its volume.
/// Filled to z = 0 with fluid it is the erodible bed.
///
/// # Errors
/// `Argument` for a negative start, depth or ramp, Δx or a length that are not positive or edges
/// that overlap (ramp > length).
pub fn recess(
    start: f64,
    length: f64,
    depth: f64,
    ramp: f64,
    dx: f64,
    cells: usize,
) -> Result<Vec<f64>, ExactError> {
    ExactError::positive("length", length)?;
    ExactError::positive("dx", dx)?;
    for (what, value) in [("start", start), ("depth", depth), ("ramp", ramp)] {
        if !(value >= 0.0 && value.is_finite()) {
            return Err(ExactError::Argument { what, value, allowed: "must be finite and not negative" });
        }
    }
    if ramp > length {
        return Err(ExactError::Argument {
            what: "ramp",
            value: ramp,
            allowed: "must not exceed the length",
        });
    }
    // ∫ of the ramp function clamp(x/ramp, 0, 1).
    let ramped = |x: f64| {
        if x <= 0.0 {
            0.0
        } else if x < ramp {
            0.5 * x * x / ramp
        } else {
            x - 0.5 * ramp
        }
    };
    let dug = |x: f64| ramped(x - start + 0.5 * ramp) - ramped(x - start - length + 0.5 * ramp);
    Ok((0..cells)
        .map(|i| {
            let share = (dug((i + 1) as f64 * dx) - dug(i as f64 * dx)) / dx;
            -depth * share.clamp(0.0, 1.0)
        })
        .collect())
}

/// Surface over a bed filled up to z = 0 with a reservoir on top: the larger of the two, max(h, 0).
pub fn filled_to_zero(reservoir: &[f64]) -> Vec<f64> {
    reservoir.iter().map(|h| h.max(0.0)).collect()
}
