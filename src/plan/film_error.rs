//! How far off films are that are only a few cells deep.

use super::text::short;

/// Depth, cells, below which nothing flows: a partly filled cell without liquid beside it empties when it holds less (η of \[F4\]).
pub(super) const LEAST_DEPTH: f64 = 0.1;

/// Mean speed of a film of less than a cell, times its depth in cells, over the right one: there is one row of cells, and
/// all that is in it moves alike.
const ROW: f64 = 1.12;

/// What was measured of films of a depth, cells.
///
/// # Source
/// Newtonian films on 30° with the default walls, 0.2 to 4 cells deep, τ = 0.6, 1 and 2, against ρg sin θ h²/(3μ) in the mean
/// and ρg sin θ h²/(2μ) at the surface; 0.6 and 1 agree within a per cent.
#[must_use]
pub(super) fn film_error(depth: f64) -> String {
    if depth < 1.0 {
        let times = short((ROW / depth * 10.0).round() / 10.0);
        format!(
            "Newtonian films of less than one are a row of partly filled cells; their mean speed is {times} times the right one (τ ≤ 1)"
        )
    } else if depth < 2.0 {
        "Newtonian films of 1 to 2 cells are up to 12 % too fast in the mean and 25 % too slow at the surface (τ ≤ 1; 19 and 43 % at τ = 2)"
            .to_owned()
    } else {
        "Newtonian films of 2 to 4 cells are off by up to 3 % in the mean and 7 % at the surface (τ ≤ 1; 10 % at τ = 2)"
            .to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measured_errors_of_films() {
        // 2.808 were measured on 0.4 cells, 1.402 on 0.8.
        assert!(film_error(0.4).contains(" 2.8 times"), "{}", film_error(0.4));
        assert!(film_error(0.8).contains(" 1.4 times"), "{}", film_error(0.8));
        assert!(film_error(1.0).contains("12 %") && film_error(3.0).contains("3 %"));
    }
}
