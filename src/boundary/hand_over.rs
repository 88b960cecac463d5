//! Moving solids made of stairs keep mass: what enters a step comes out of the treads \[B1\].
//!
//! A solid that turns in its place, or slides along itself, carries fluid *through* its stairs: the links of a step take
//! mass in, those of the treads give it back, −6 w_i ρ c_i·u_w each. Over the whole surface that adds up to nothing
//! where ρ is uniform and all of it is wet, and to something everywhere else. Here the same mass is handed from each
//! boundary cell to its neighbours along the surface instead: q_ab from a to b is −q_ba, so that nothing is lost however
//! ρ varies, and a neighbour that is dry takes nothing and gives nothing.

use super::links::{Source, boundary_cell};
use super::surface_graph::{Graph, Node};
use crate::lattice::equilibrium::dot;
use crate::lattice::moments::density_excess;
use crate::lattice::{C, Q, W, opposite};
use crate::setup::Setup;
use crate::setup::course::Factors;

/// Mass that a boundary cell hands to one of its neighbours in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Edge {
    /// The neighbour.
    pub cell: u32,
    /// q at ρ = 1; the neighbour's edge back holds −q.
    pub flux: f64,
}

/// A boundary cell of one moving solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Record {
    cell: u32,
    body: u8,
    /// M = Σ 6 w_i c_i·u_w over the links to the solid, c_i towards it: what they take in at ρ = 1.
    taken: f64,
    /// Σ w_i over these links.
    weight: f64,
    /// Σ q over all edges.
    all: f64,
    /// First edge, and the one after the last.
    edges: [u32; 2],
}

impl Record {
    /// G where every neighbour is wet.
    #[inline]
    #[must_use]
    pub(crate) const fn all(&self) -> f64 {
        self.all
    }
}

/// Who hands what to whom: empty if no solid moves.
#[derive(Clone, Debug)]
pub(crate) struct HandOver {
    /// In order of cell and solid.
    records: Vec<Record>,
    edges: Vec<Edge>,
    /// Of the velocities now.
    factors: Factors,
}

impl Default for HandOver {
    fn default() -> Self {
        Self { records: Vec::new(), edges: Vec::new(), factors: Factors::one() }
    }
}

impl HandOver {
    /// Of a set-up that has passed `crate::solver::check::check`.
    #[must_use]
    pub(crate) fn new(setup: &Setup) -> Self {
        let mut table = Self::default();
        for body in moving(setup) {
            let (nodes, graph) = surface_of(setup, body);
            let taken: Vec<f64> = nodes.iter().map(|node| node.taken).collect();
            let fluxes = graph.fluxes(&taken);
            for (at, node) in nodes.iter().enumerate() {
                let first = table.edges.len() as u32;
                for (neighbour, flux) in graph.of(at).iter().zip(&fluxes[graph.range(at)]) {
                    let cell = nodes[neighbour.node as usize].cell;
                    table.edges.push(Edge { cell, flux: *flux });
                }
                let edges = [first, table.edges.len() as u32];
                // Fluxes are whole multiples of one number: their sum has no rounding.
                let all = fluxes[graph.range(at)].iter().sum();
                let Node { cell, taken, weight } = *node;
                table.records.push(Record { cell, body, taken, weight, all, edges });
            }
        }
        table.records.sort_by_key(|record| (record.cell, record.body));
        table
    }

    /// Whether no solid moves.
    #[inline(always)]
    #[must_use]
    pub(crate) const fn is_empty(&self) -> bool {
        self.records.is_empty()
    }

    /// Records of a cell, one for each moving solid that it touches.
    #[inline]
    #[must_use]
    pub(crate) fn of(&self, cell: usize) -> &[Record] {
        let first = self.records.partition_point(|record| (record.cell as usize) < cell);
        let count = self.records[first..].iter().take_while(|record| record.cell as usize == cell).count();
        &self.records[first..first + count]
    }

    /// Record of a cell at one solid; `None` at faces of the box (`body` 0) and solids at rest.
    #[inline]
    #[must_use]
    pub(crate) fn at(&self, cell: usize, body: u8) -> Option<&Record> {
        if body == 0 || self.is_empty() {
            return None;
        }
        self.of(cell).iter().find(|record| record.body == body)
    }

    /// (ρM − G)/Σw: what a link to the solid sends back besides \[B1\], divided by its weight.
    ///
    /// # Arguments
    /// `rho`: density of the cell. `given`: G = Σ q over wet neighbours, velocities as in the set-up.
    /// # Returns
    /// With it the links of the cell take in G instead of ρM.
    #[inline]
    #[must_use]
    pub(crate) fn raise(&self, record: &Record, rho: f64, given: f64) -> f64 {
        self.factors.solid(record.body) * ((rho * record.taken - given) / record.weight)
    }

    /// What a record hands over an edge now, at ρ = 1.
    #[inline]
    #[must_use]
    pub(crate) fn flux(&self, record: &Record, edge: &Edge) -> f64 {
        self.factors.solid(record.body) * edge.flux
    }

    /// Gives the solids the velocities of a time.
    pub(crate) fn move_solids(&mut self, factors: &Factors) {
        self.factors = factors.clone();
    }

    /// Neighbours of a cell along the surface.
    #[inline]
    #[must_use]
    pub(crate) fn edges(&self, record: &Record) -> &[Edge] {
        &self.edges[record.edges[0] as usize..record.edges[1] as usize]
    }

    /// G = Σ q over the neighbours that hold fluid.
    #[inline]
    #[must_use]
    pub(crate) fn given(&self, record: &Record, is_fluid: impl Fn(usize) -> bool) -> f64 {
        self.edges(record).iter().filter(|edge| is_fluid(edge.cell as usize)).map(|edge| edge.flux).sum()
    }

    /// Bytes held.
    #[must_use]
    pub(crate) fn bytes(&self) -> u64 {
        (size_of_val(self.records.as_slice()) + size_of_val(self.edges.as_slice())) as u64
    }

    /// Bytes that [`Self::new`] would hold, without the work of finding the fluxes.
    #[must_use]
    pub(crate) fn bytes_of(setup: &Setup) -> u64 {
        let of = |body| {
            let (nodes, graph) = surface_of(setup, body);
            nodes.len() * size_of::<Record>() + graph.edges() * size_of::<Edge>()
        };
        moving(setup).map(of).sum::<usize>() as u64
    }
}

/// Numbers of the solids that move.
fn moving(setup: &Setup) -> impl Iterator<Item = u8> {
    let list: Vec<u8> =
        (1..=u8::MAX).zip(&setup.solid_motion).filter(|(_, m)| m.moves()).map(|x| x.0).collect();
    list.into_iter()
}

/// Boundary cells of a solid in index order, and how they hang together along its surface.
fn surface_of(setup: &Setup, body: u8) -> (Vec<Node>, Graph) {
    let mut cells: Vec<u32> = (0..setup.cells())
        .filter(|&cell| setup.solids.get(cell) == Some(&body))
        .flat_map(|cell| around(setup, cell))
        .filter(|&cell| !setup.is_solid(cell as usize))
        .collect();
    cells.sort_unstable();
    cells.dedup();
    let records = cells.into_iter().filter_map(|cell| Some((cell, boundary_cell(setup, cell as usize)?)));
    // Cut cells keep mass in their own way [B4].
    let records =
        records.filter(|(_, record)| record.cut.is_none()).map(|(cell, record)| (cell, record.sources));
    let found: Vec<_> =
        records.filter_map(|(cell, sources)| Some((node(cell, &sources, body)?, sources))).collect();
    let nodes: Vec<Node> = found.iter().map(|(node, _)| *node).collect();
    let at = |cell: u32| nodes.binary_search_by_key(&cell, |node| node.cell).ok();
    let mut graph = Graph::new(nodes.len());
    for (here, (_, sources)) in found.iter().enumerate() {
        for (i, source) in sources.iter().enumerate().skip(1) {
            if let Source::Cell { cell, .. } = *source
                && let Some(there) = at(cell)
            {
                // Two cells beside each other conduct twice as well as two that meet at an edge.
                graph.join(here, there, if i <= 6 { 1.0 } else { 0.5 });
            }
        }
    }
    graph.sort();
    (nodes, graph)
}

/// Cells one link away, through every face.
fn around(setup: &Setup, cell: usize) -> impl Iterator<Item = u32> {
    let (at, extents) = (setup.coordinates(cell), setup.extents);
    let neighbours: [u32; Q] = std::array::from_fn(|i| {
        let there = std::array::from_fn(|a| {
            (at[a] as i64 + i64::from(C[i][a])).rem_euclid(extents[a] as i64) as usize
        });
        setup.index(there) as u32
    });
    neighbours.into_iter()
}

/// What a cell is in the surface of a solid; `None` without a link to it.
fn node(cell: u32, sources: &[Source; Q], body: u8) -> Option<Node> {
    let mut taken = [0.0; Q];
    let mut weight = [0.0; Q];
    let mut touches = false;
    for (i, source) in sources.iter().enumerate().skip(1) {
        if let Source::Wall { velocity, body: of, .. } = source
            && *of == body
        {
            let out = opposite(i);
            taken[i] = 6.0 * W[out] * dot(out, velocity);
            weight[i] = W[out];
            touches = true;
        }
    }
    // Sums that do not change when the set-up is mirrored.
    touches.then(|| Node { cell, taken: density_excess(&taken), weight: density_excess(&weight) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rheology::Law;
    use crate::setup::SolidMotion;

    /// A disc of `radius` in a box with a margin of 3 cells, turning and with its centre off the grid's.
    fn disc(radius: f64) -> Setup {
        let n = (2.0 * radius) as usize + 6;
        let mut setup = Setup::periodic([n, n, 2], Law::Newtonian { mu: 0.1 });
        let centre = [0.5 * n as f64 + 0.21, 0.5 * n as f64 - 0.13, 0.0];
        let inside = |cell| {
            let at = setup.coordinates(cell);
            let [x, y] = [0, 1].map(|a| at[a] as f64 + 0.5 - centre[a]);
            x * x + y * y < radius * radius
        };
        setup.solids = (0..setup.cells()).map(|cell| u8::from(inside(cell))).collect();
        setup.solid_motion = vec![SolidMotion { spin: [0.0, 0.0, 1e-3], centre, ..SolidMotion::default() }];
        setup
    }

    #[test]
    fn exact_what_one_gives_the_other_takes() {
        let table = HandOver::new(&disc(7.3));
        assert!(!table.is_empty());
        let mut total = 0.0;
        for record in &table.records {
            for edge in table.edges(record) {
                let other = table.at(edge.cell as usize, 1).expect("a neighbour on the surface");
                let back: Vec<f64> =
                    table.edges(other).iter().filter(|e| e.cell == record.cell).map(|e| e.flux).collect();
                assert_eq!(back, [-edge.flux]);
            }
            total += record.all();
        }
        assert_eq!(total, 0.0);
    }

    #[test]
    fn wet_surface_hands_over_what_the_links_take() {
        // Fluxes are rounded to 2⁻⁴⁰ of the largest, eight of them or fewer per cell.
        for radius in [2.4, 7.3, 20.0] {
            let table = HandOver::new(&disc(radius));
            let most = table.records.iter().map(|r| r.taken.abs()).fold(0.0, f64::max);
            assert!(most > 1e-4 * radius);
            for record in &table.records {
                assert!((record.taken - record.all()).abs() < 1e-11 * most, "{record:?}");
                assert!(table.raise(record, 1.0, record.all()).abs() < 1e-9 * most);
            }
        }
    }

    #[test]
    fn exact_sum_of_any_wet_part() {
        let setup = disc(6.0);
        let table = HandOver::new(&setup);
        let wet = |cell: usize| setup.coordinates(cell)[1] < 8 || cell % 5 == 1;
        let given: f64 = table
            .records
            .iter()
            .filter(|r| wet(r.cell as usize))
            .map(|record| table.given(record, wet))
            .sum();
        assert_eq!(given, 0.0);
        let taken: f64 = table.records.iter().filter(|r| wet(r.cell as usize)).map(|r| r.taken).sum();
        assert!(taken.abs() > 1e-4, "plain links would lose {taken} per step");
    }

    #[test]
    fn limit_solids_at_rest_hand_nothing_over() {
        let mut setup = disc(4.0);
        setup.solid_motion = vec![SolidMotion::default()];
        assert!(HandOver::new(&setup).is_empty());
        assert_eq!(HandOver::bytes_of(&setup), 0);
        let turning = disc(4.0);
        assert_eq!(HandOver::new(&turning).bytes(), HandOver::bytes_of(&turning));
    }
}
