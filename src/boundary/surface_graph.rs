//! The boundary cells of a solid as a graph, and the smallest fluxes along it that feed given sinks.

use std::ops::Range;

/// A boundary cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Node {
    /// Its index.
    pub cell: u32,
    /// What its links take in per step at ρ = 1.
    pub taken: f64,
    /// Σ w_i of these links.
    pub weight: f64,
}

/// A neighbour along the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Neighbour {
    /// Its number.
    pub node: u32,
    /// g of the connection, the same from both sides.
    conductance: f64,
}

/// Which nodes are neighbours.
#[derive(Clone, Debug)]
pub(crate) struct Graph {
    /// By node, until sorted.
    lists: Vec<Vec<Neighbour>>,
    /// In order of the nodes; filled by [`Self::sort`].
    neighbours: Vec<Neighbour>,
    /// First neighbour of every node, and the end.
    first: Vec<usize>,
}

/// Fluxes are whole multiples of 2⁻⁴⁰ of the power of two below the largest sink, so that sums of them
/// have no rounding and do not depend on the order; 1e-12 of it is far below what a velocity is known to.
const UNITS: f64 = (1_u64 << 40) as f64;

/// Residual at which the search for the potential stops, relative to the sinks: what is left is rounding.
const RESIDUAL: f64 = 1e-15;

/// Most steps of the search. A step carries knowledge one cell further, so that a surface is known after as
/// many steps as it is cells around, times a small factor for its stairs.
const STEPS: usize = 20_000;

impl Graph {
    /// Without connections yet.
    #[must_use]
    pub(crate) fn new(nodes: usize) -> Self {
        Self { lists: vec![Vec::new(); nodes], neighbours: Vec::new(), first: Vec::new() }
    }

    /// Adds half of a connection from both sides: it is told of from both. Nothing is its own neighbour.
    pub(crate) fn join(&mut self, one: usize, other: usize, conductance: f64) {
        if one == other {
            return;
        }
        for (from, to) in [(one, other), (other, one)] {
            let list = &mut self.lists[from];
            match list.iter_mut().find(|n| n.node as usize == to) {
                Some(known) => known.conductance += 0.5 * conductance,
                None => list.push(Neighbour { node: to as u32, conductance: 0.5 * conductance }),
            }
        }
    }

    /// Puts every list in order; none is added to after this.
    pub(crate) fn sort(&mut self) {
        for list in &mut self.lists {
            self.first.push(self.neighbours.len());
            list.sort_by_key(|neighbour| neighbour.node);
            self.neighbours.append(list);
        }
        self.first.push(self.neighbours.len());
    }

    /// Neighbours of a node.
    #[must_use]
    pub(crate) fn of(&self, node: usize) -> &[Neighbour] {
        &self.neighbours[self.range(node)]
    }

    /// Where they stand among those of all nodes.
    #[must_use]
    pub(crate) fn range(&self, node: usize) -> Range<usize> {
        self.first[node]..self.first[node + 1]
    }

    /// Number of directed connections.
    #[must_use]
    pub(crate) fn edges(&self) -> usize {
        self.neighbours.len()
    }

    /// Fluxes q_ab = g_ab (p_a − p_b) that carry away from every node what its sink takes too little, in the order of
    /// the connections: Σ_b q_ab = m_a, with Σ q²/g as small as it can be.
    ///
    /// # Arguments
    /// `sinks`: m by node. Its mean over each connected part, which no flux along the surface can feed, is left out.
    /// # Exactness
    /// q_ba = −q_ab to the bit; whole multiples of one power of two.
    /// # Source
    /// Normal equations of the least squares, a Laplace equation on the graph; conjugate gradients of M. R. Hestenes and
    /// E. Stiefel, J. Res. Natl. Bur. Stand. 49, 409 (1952).
    #[must_use]
    pub(crate) fn fluxes(&self, sinks: &[f64]) -> Vec<f64> {
        let largest = sinks.iter().fold(0.0, |most: f64, m| if m.abs() > most { m.abs() } else { most });
        if largest == 0.0 || !largest.is_finite() {
            return vec![0.0; self.neighbours.len()];
        }
        // The power of two at or below the largest: its exponent with an empty fraction.
        let unit = f64::from_bits(largest.to_bits() >> 52 << 52) / UNITS;
        let enough = RESIDUAL * RESIDUAL * product(sinks, sinks);
        let potential = self.potential(&self.without_mean(sinks), enough);
        let mut fluxes = Vec::with_capacity(self.neighbours.len());
        for (a, here) in potential.iter().enumerate() {
            for n in self.of(a) {
                fluxes.push((n.conductance * (here - potential_of(&potential, n)) / unit).round() * unit);
            }
        }
        fluxes
    }

    /// Sinks less their mean over each connected part.
    fn without_mean(&self, sinks: &[f64]) -> Vec<f64> {
        let mut left = sinks.to_vec();
        let mut seen = vec![false; sinks.len()];
        for start in 0..sinks.len() {
            if std::mem::replace(&mut seen[start], true) {
                continue;
            }
            let mut part = vec![start];
            let mut at = 0;
            while let Some(&node) = part.get(at) {
                at += 1;
                for neighbour in self.of(node) {
                    let there = neighbour.node as usize;
                    if !std::mem::replace(&mut seen[there], true) {
                        part.push(there);
                    }
                }
            }
            let mean = part.iter().map(|&node| sinks[node]).sum::<f64>() / part.len() as f64;
            for node in part {
                left[node] -= mean;
            }
        }
        left
    }

    /// p with Σ_b g_ab (p_a − p_b) = m_a, by conjugate gradients scaled with the diagonal, until the square of the
    /// residual is `enough`.
    fn potential(&self, m: &[f64], enough: f64) -> Vec<f64> {
        let diagonal: Vec<f64> = (0..m.len())
            .map(|a| self.of(a).iter().map(|n| n.conductance).sum::<f64>())
            .map(|sum| if sum > 0.0 { sum } else { 1.0 })
            .collect();
        let mut p = vec![0.0; m.len()];
        let mut residual = m.to_vec();
        let mut direction: Vec<f64> = residual.iter().zip(&diagonal).map(|(r, d)| r / d).collect();
        let mut along = product(&residual, &direction);
        for _ in 0..STEPS {
            if along <= enough {
                break;
            }
            let image: Vec<f64> = (0..m.len())
                .map(|a| {
                    self.of(a)
                        .iter()
                        .map(|n| n.conductance * (direction[a] - potential_of(&direction, n)))
                        .sum()
                })
                .collect();
            let step = along / product(&direction, &image);
            for a in 0..m.len() {
                p[a] += step * direction[a];
                residual[a] -= step * image[a];
            }
            let scaled: Vec<f64> = residual.iter().zip(&diagonal).map(|(r, d)| r / d).collect();
            let next = product(&residual, &scaled);
            for a in 0..m.len() {
                direction[a] = scaled[a] + next / along * direction[a];
            }
            along = next;
        }
        p
    }
}

fn potential_of(values: &[f64], neighbour: &Neighbour) -> f64 {
    values[neighbour.node as usize]
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ring of `n` nodes.
    fn ring(n: usize) -> Graph {
        let mut graph = Graph::new(n);
        for a in 0..n {
            graph.join(a, (a + 1) % n, 1.0);
            graph.join((a + 1) % n, a, 1.0);
        }
        graph.sort();
        graph
    }

    #[test]
    fn fluxes_of_a_ring_go_the_shorter_way() {
        let mut sinks = [0.0; 6];
        (sinks[0], sinks[2]) = (1.0, -1.0);
        // By hand: two resistors in line beside four, 2/3 and 1/3 of the current.
        let graph = ring(6);
        let fluxes = graph.fluxes(&sinks);
        let q = |a: usize, b: usize| {
            let at = graph.of(a).iter().position(|n| n.node as usize == b).expect("a neighbour");
            fluxes[graph.range(a)][at]
        };
        for (found, exact) in
            [(q(0, 1), 2.0 / 3.0), (q(1, 2), 2.0 / 3.0), (q(0, 5), 1.0 / 3.0), (q(3, 2), 1.0 / 3.0)]
        {
            assert!((found - exact).abs() < 1.0 / UNITS, "{found} {exact}");
        }
    }

    #[test]
    fn limit_sinks_that_nothing_feeds() {
        // A node alone, and a pair that takes the same at both ends.
        let mut graph = Graph::new(3);
        graph.join(1, 2, 1.0);
        graph.join(2, 1, 1.0);
        graph.sort();
        assert_eq!(graph.fluxes(&[0.5, 0.25, 0.25]), [0.0, 0.0]);
        assert!(Graph { first: vec![0], ..Graph::new(0) }.fluxes(&[]).is_empty());
    }

    #[test]
    fn exact_when_all_sinks_change_sign() {
        let graph = ring(40);
        let sinks: Vec<f64> = (0..40).map(|k| f64::from(k % 7) - 0.3 * f64::from(k % 4)).collect();
        let turned: Vec<f64> = sinks.iter().map(|m| -m).collect();
        let turned: Vec<f64> = graph.fluxes(&turned).iter().map(|q| -q).collect();
        assert_eq!(graph.fluxes(&sinks), turned);
    }
}
