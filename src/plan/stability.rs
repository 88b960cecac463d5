//! Largest stable speed of a uniform flow, from von Neumann analysis \[K5\].

use crate::collision::CollisionChoice;

/// τ, then the largest stable speed (cells per step) of BGK and of TRT with Λ = 3/16, the lesser of
/// the axis and the face diagonal.
const TABLE: [[f64; 3]; 8] = [
    [0.5005, 0.0435, 0.0031],
    [0.501, 0.0611, 0.0061],
    [0.505, 0.1339, 0.0307],
    [0.51, 0.1716, 0.0613],
    [0.55, 0.2359, 0.2567],
    [0.6, 0.2628, 0.2950],
    [1.0, 0.4223, 0.4223],
    [1.8, 0.4223, 0.4223],
];

/// Largest speed at which no wave grows; `None` where there is no table.
#[must_use]
pub fn max_stable_speed(collision: &CollisionChoice, tau: f64) -> Option<f64> {
    let column = match collision {
        CollisionChoice::Bgk => 1,
        CollisionChoice::Trt(odd) if odd.lowered_below == 0.0 && odd.floor == 0.0 => 2,
        _ => return None,
    };
    let last = TABLE.len() - 1;
    if tau < TABLE[0][0] {
        return None;
    }
    let upper = TABLE.iter().position(|row| row[0] >= tau).unwrap_or(last).max(1);
    let (a, b) = (TABLE[upper - 1], TABLE[upper]);
    let share = ((tau - a[0]) / (b[0] - a[0])).clamp(0.0, 1.0);
    Some(a[column] + share * (b[column] - a[column]))
}
