//! When an interface cell fills or empties \[F4\] \[F6\].

/// Verdict on an interface cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mark {
    /// Stays interface.
    Stay,
    /// Becomes liquid.
    Fill,
    /// Becomes gas.
    Empty,
}

/// What an interface cell touches; itself does not count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Touches {
    /// A gas cell.
    pub gas: bool,
    /// A liquid cell.
    pub liquid: bool,
    /// A wall or solid, or an interface cell that touches liquid or a wall; and its links hold it.
    pub held: bool,
}

/// Fill if m > (1 + ε)ρ, or without gas neighbour if m > (1 − η)ρ. Empty if m < −ερ, or without liquid
/// neighbour if m < ηρ, or if neither liquid nor wall is within two links, or if there is no liquid neighbour and
/// the cell moves beside all links to walls and fluid ([`super::hold::Span`]) faster than parked mass falls. Drops
/// and threads that small cannot move: their mass has no filled neighbour to go to, and the force would accelerate
/// them in place without bound.
///
/// # Arguments
/// `mass`: m. `rho`: ρ. `margin`: ε. `lonely`: η.
/// # Source
/// docs/method.md \[F4\], \[F6\]; docs/errata.md 25. The last rule is ours.
/// # Verified by
/// Claims `flat-layer-without-flicker`, `isolated-cell`.
#[inline(always)]
#[must_use]
pub(crate) fn mark(mass: f64, rho: f64, touches: Touches, margin: f64, lonely: f64) -> Mark {
    if !touches.liquid && !touches.held {
        return Mark::Empty;
    }
    if mass > (1.0 + margin) * rho || (!touches.gas && mass > (1.0 - lonely) * rho) {
        Mark::Fill
    } else if mass < -margin * rho || (!touches.liquid && mass < lonely * rho) {
        Mark::Empty
    } else {
        Mark::Stay
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SURFACE: Touches = Touches { gas: true, liquid: true, held: true };

    #[test]
    fn exact_margins() {
        let judge = |mass| mark(mass, 1.0, SURFACE, 1e-2, 0.1);
        assert_eq!(judge(1.01), Mark::Stay);
        assert_eq!(judge(1.0101), Mark::Fill);
        assert_eq!(judge(-0.01), Mark::Stay);
        assert_eq!(judge(-0.0101), Mark::Empty);
    }

    #[test]
    fn exact_lonely_cells() {
        let bubble = Touches { gas: false, ..SURFACE };
        assert_eq!(mark(0.91, 1.0, bubble, 1e-2, 0.1), Mark::Fill);
        let film = Touches { liquid: false, ..SURFACE };
        assert_eq!(mark(0.09, 1.0, film, 1e-2, 0.1), Mark::Empty);
        let drop = Touches { gas: true, ..Touches::default() };
        assert_eq!(mark(0.4, 1.0, drop, 1e-2, 0.1), Mark::Empty);
    }
}
