//! The list of pairs that may touch before any member has moved half a skin.

use super::cells::{Cells, fold};
use crate::dem::V3;
use crate::dem::bodies::Member;
use crate::state::state;
use rayon::prelude::*;

/// Members per block of the search.
const BLOCK: usize = 512;

/// Pairs (a, b), a < b, sorted; with rows for both sides.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PairList {
    /// The pairs.
    pub pairs: Vec<(u32, u32)>,
    /// x_a − x_b − shift is the distance vector, m; empty without periodic axes.
    pub shift: Vec<V3>,
    /// Pairs of member a as first side: `row[a]..row[a + 1]`.
    pub row: Vec<u32>,
    /// Pairs of member b as second side, ascending: `back[back_row[b]..back_row[b + 1]]`.
    pub back_row: Vec<u32>,
    /// Numbers of pairs, by their second side; see `back_row` for the rows.
    pub back: Vec<u32>,
}

state!(PairList: pairs shift row back_row back);

impl PairList {
    /// All pairs of members of different bodies nearer than (1 + `skin`) × the sum of their radii, except those of
    /// two driven bodies.
    ///
    /// # Exactness
    /// The list is a function of the members alone: any number of threads finds the same list in the same order.
    pub fn find(members: &[Member], period: [Option<f64>; 3], skin: f64) -> Self {
        let cells = Cells::new(members, period, skin);
        let periodic = period.iter().any(Option::is_some);
        let blocks: Vec<Vec<(u32, u32, [i32; 3])>> = (0..members.len().div_ceil(BLOCK))
            .into_par_iter()
            .map(|b| {
                let mut found = Vec::new();
                for i in b * BLOCK..((b + 1) * BLOCK).min(members.len()) {
                    search(members, &cells, &period, skin, i, &mut found);
                }
                found
            })
            .collect();
        let mut all = blocks.concat();
        if !all.is_sorted_by_key(|p| (p.0, p.1)) {
            all.par_sort_unstable_by_key(|p| (p.0, p.1));
        }
        let shift = |n: &[i32; 3]| V3::from_fn(|k, _| period[k].map_or(0.0, |l| f64::from(n[k]) * l));
        let shifts = if periodic { all.iter().map(|p| shift(&p.2)).collect() } else { Vec::new() };
        let pairs: Vec<(u32, u32)> = all.iter().map(|p| (p.0, p.1)).collect();
        Self::with_rows(pairs, shifts, members.len())
    }

    fn with_rows(pairs: Vec<(u32, u32)>, shift: Vec<V3>, members: usize) -> Self {
        let mut row = vec![0u32; members + 1];
        let mut back_row = vec![0u32; members + 1];
        for &(a, b) in &pairs {
            row[a as usize + 1] += 1;
            back_row[b as usize + 1] += 1;
        }
        for k in 0..members {
            row[k + 1] += row[k];
            back_row[k + 1] += back_row[k];
        }
        let mut cursor = back_row.clone();
        let mut back = vec![0u32; pairs.len()];
        for (p, &(_, b)) in pairs.iter().enumerate() {
            back[cursor[b as usize] as usize] = p as u32;
            cursor[b as usize] += 1;
        }
        Self { pairs, shift, row, back_row, back }
    }

    /// For every pair of `self`, where the same pair is in `old`.
    pub(crate) fn matches<'a>(&'a self, old: &'a PairList) -> impl Iterator<Item = (usize, usize)> + 'a {
        let mut o = 0;
        self.pairs.iter().enumerate().filter_map(move |(n, p)| {
            while o < old.pairs.len() && old.pairs[o] < *p {
                o += 1;
            }
            (o < old.pairs.len() && old.pairs[o] == *p).then_some((n, o))
        })
    }

    /// Number of the pair (a, b), if listed.
    pub fn position(&self, a: u32, b: u32) -> Option<usize> {
        self.pairs.binary_search(&(a, b)).ok()
    }
}

fn search(
    members: &[Member],
    cells: &Cells,
    period: &[Option<f64>; 3],
    skin: f64,
    i: usize,
    found: &mut Vec<(u32, u32, [i32; 3])>,
) {
    let m = &members[i];
    let from = found.len();
    cells.around(members, i, |j, wrap| {
        let o = &members[j as usize];
        // Two driven members feel nothing of each other.
        if o.body == m.body || (o.inverse_mass == 0.0 && m.inverse_mass == 0.0) {
            return;
        }
        let (_, image) = fold(&o.position, period);
        let n = [0, 1, 2].map(|k| wrap[k] - image[k]);
        let shift = V3::from_fn(|k, _| period[k].map_or(0.0, |l| f64::from(n[k]) * l));
        let reach = (1.0 + skin) * (m.radius + o.radius);
        if (m.position - o.position - shift).norm_squared() < reach * reach {
            let (i, j) = (i as u32, j);
            found.push(if i < j { (i, j, n) } else { (j, i, n.map(|k| -k)) });
        }
    });
    found[from..].sort_unstable();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::packing::random::Random;

    fn cloud(n: usize, ratio: f64, extent: f64, seed: u64) -> Vec<Member> {
        let mut r = Random::new(seed);
        (0..n)
            .map(|i| Member {
                position: V3::from_fn(|_, _| extent * (r.unit() - 0.3)),
                radius: libm::pow(ratio, -r.unit()),
                velocity: V3::zeros(),
                spin: V3::zeros(),
                inverse_mass: if i % 5 == 0 { 0.0 } else { 1.0 },
                body: i as u32 / 2,
                material: 0,
            })
            .collect()
    }

    fn brute(members: &[Member], period: [Option<f64>; 3], skin: f64) -> Vec<(u32, u32)> {
        let mut out = Vec::new();
        for a in 0..members.len() {
            for b in a + 1..members.len() {
                let mut d = members[a].position - members[b].position;
                for k in 0..3 {
                    if let Some(l) = period[k] {
                        d[k] -= l * (d[k] / l).round();
                    }
                }
                let reach = (1.0 + skin) * (members[a].radius + members[b].radius);
                let felt = members[a].inverse_mass + members[b].inverse_mass > 0.0;
                if d.norm_squared() < reach * reach && members[a].body != members[b].body && felt {
                    out.push((a as u32, b as u32));
                }
            }
        }
        out
    }

    /// Against all pairs: one size, ratio 20 and 1000, open and periodic.
    #[test]
    fn exact_all_pairs_found() {
        for (ratio, extent) in [(1.0, 12.0), (20.0, 8.0), (1000.0, 6.0)] {
            for period in [[None; 3], [Some(extent), None, Some(1.3 * extent)], [Some(extent); 3]] {
                let m = cloud(400, ratio, extent, 7);
                let list = PairList::find(&m, period, 0.1);
                assert_eq!(list.pairs, brute(&m, period, 0.1), "{ratio} {period:?}");
                for (p, s) in list.pairs.iter().zip(&list.shift) {
                    let (a, b) = (&m[p.0 as usize], &m[p.1 as usize]);
                    assert!((a.position - b.position - s).norm() < 1.1 * (a.radius + b.radius));
                }
                for b in 0..m.len() {
                    for &p in &list.back[list.back_row[b] as usize..list.back_row[b + 1] as usize] {
                        assert_eq!(list.pairs[p as usize].1 as usize, b);
                    }
                }
            }
        }
    }
}
