//! Streaming and mass exchange of interface cells side by side \[F1\] \[F2\]: the same as
//! `Streaming::stream` for cells whose links are all the grid's.

use super::flow::{CARRIED, NUMBERS};
use super::record::InterfaceCell;
use super::streaming::Streaming;
use crate::free_surface::conversion::touch;
use crate::free_surface::exchange::{gas_link, link_mass, mean_share, share_with};
use crate::free_surface::shares::{dry_share, even, taken_back, viscous};
use crate::lane::Lane;
use crate::lattice::moments::density_excess;
use crate::lattice::unroll::{directions, three};
use crate::lattice::{C, Q, opposite};
use crate::solver::books::Entries;
use crate::solver::fast::around::Around;
use crate::solver::fast::element::{Element, MOST, index};
use crate::solver::fast::registers::Registers;
use crate::solver::fast::sources::{Sources, gather, gather_cells};
use crate::solver::physics::Physics;

/// What the exchange reads around a block.
pub(crate) struct Near<'a, E> {
    /// Populations after the last collision.
    pub populations: Around<'a, E>,
    /// φ of interface cells, and what stands for the others ([`share_with`]).
    pub fill: [&'a [f64]; 27],
    /// Numbers of interface cells ([`super::flow`]), any elsewhere.
    pub flow: [[&'a [f64]; 27]; NUMBERS],
}

/// What came over the links of the cells of a pack.
struct Streamed<L> {
    arrived: [L; Q],
    gained: [L; Q],
    /// (1 − A) v by link.
    apart: [L; Q],
    from_gas: [L; 3],
    /// 1 where the cell touches gas, liquid.
    touched: [L; 2],
}

/// Columns of one pack: one number per lane.
#[repr(align(64))]
struct Columns {
    velocity: [[f64; MOST]; 3],
    arrived: [[f64; MOST]; Q],
    rho: [f64; MOST],
    gained: [f64; MOST],
    from_gas: [[f64; MOST]; 3],
    dry: [[f64; MOST]; 3],
    /// 1 where the cell touches gas.
    gas: [f64; MOST],
    /// 1 where the cell touches liquid.
    liquid: [f64; MOST],
}

impl Columns {
    fn new() -> Self {
        Self {
            velocity: [[0.0; MOST]; 3],
            arrived: [[0.0; MOST]; Q],
            rho: [0.0; MOST],
            gained: [0.0; MOST],
            from_gas: [[0.0; MOST]; 3],
            dry: [[0.0; MOST]; 3],
            gas: [0.0; MOST],
            liquid: [0.0; MOST],
        }
    }

    /// Populations, Δm and neighbours of the lanes of one part of a pack.
    #[inline(always)]
    fn stream<R: Registers>(
        &mut self,
        near: &Near<R::Element>,
        sources: &Sources,
        local: usize,
        part: usize,
    ) {
        let (zero, one) = (R::Pack::zero(), R::Pack::one());
        let own = directions(
            #[inline(always)]
            |i| R::load(&near.populations.all()[13][index::<R::Element>(local, i) + part..]),
        );
        let from = gather::<R>(&near.populations, sources, part);
        let fill = R::load_wide(&near.fill[13][local + part..]);
        let u = three(
            #[inline(always)]
            |a| R::load_wide(&self.velocity[a][part..]),
        );
        let (mut gas, mut liquid, mut from_gas) = (zero, zero, [zero; 3]);
        let d_rho = R::load_wide(&near.flow[0][13][local + part..]);
        let carried = R::load_wide(&near.flow[CARRIED][13][local + part..]);
        let (mut gained, mut apart) = ([zero; Q], [zero; Q]);
        let arrived = directions(
            #[inline(always)]
            |i| {
                if i == 0 {
                    return own[0];
                }
                let out = opposite(i);
                let other = gather_cells::<R>(&near.fill, sources, part, i);
                let dry = other.less(zero);
                gas = <R::Pack as Lane>::select(dry, one, gas);
                liquid = <R::Pack as Lane>::select(one.less(other), one, liquid);
                let arrived = <R::Pack as Lane>::select(dry, gas_link(own[out], out, &u), from[i]);
                let level = <R::Pack as Lane>::not(one.less(other));
                let level = <R::Pack as Lane>::and(<R::Pack as Lane>::not(dry), level);
                let mut share = share_with(fill, other);
                if <R::Pack as Lane>::any(level) {
                    let number = |k: usize| gather_cells::<R>(&near.flow[k], sources, part, i);
                    let there = even(i, number(0), &[number(1), number(2), number(3)]);
                    let brought = viscous(from[i], own[out], there, even(out, d_rho, &u));
                    apart[i] = <R::Pack as Lane>::select(level, dry_share(fill, other) * brought, zero);
                    share = <R::Pack as Lane>::select(level, mean_share(carried, number(CARRIED)), share);
                }
                let mass = link_mass(share, from[i], own[out]);
                gained[i] = <R::Pack as Lane>::select(dry, zero, mass);
                // Arrives with c_i f_i, left with −c_i f_ī.
                let brought = <R::Pack as Lane>::select(dry, arrived + own[out], zero);
                for a in 0..3 {
                    match C[i][a] {
                        1 => from_gas[a] = from_gas[a] + brought,
                        -1 => from_gas[a] = from_gas[a] - brought,
                        _ => {}
                    }
                }
                arrived
            },
        );
        self.keep::<R>(&Streamed { arrived, gained, apart, from_gas, touched: [gas, liquid] }, &u, part);
    }

    /// Puts what has streamed into part of the columns.
    #[inline(always)]
    fn keep<R: Registers>(&mut self, streamed: &Streamed<R::Pack>, u: &[R::Pack; 3], part: usize) {
        let Streamed { arrived, gained, apart, from_gas, touched: [gas, liquid] } = streamed;
        R::store_wide(R::Pack::one() + density_excess(arrived), &mut self.rho[part..]);
        R::store_wide(density_excess(gained), &mut self.gained[part..]);
        for i in 0..Q {
            R::store_wide(arrived[i], &mut self.arrived[i][part..]);
        }
        for a in 0..3 {
            R::store_wide(from_gas[a], &mut self.from_gas[a][part..]);
        }
        let taken = taken_back(apart, u);
        for a in 0..3 {
            R::store_wide(taken[a], &mut self.dry[a][part..]);
        }
        R::store_wide(*gas, &mut self.gas[part..]);
        R::store_wide(*liquid, &mut self.liquid[part..]);
    }

    /// Hands the results to the records and the books.
    fn hand_out(&self, cells: &mut [InterfaceCell], alone: u16, line: usize, entries: &mut Entries) {
        for cell in cells {
            let lane = usize::from(cell.local) % line;
            if alone >> lane & 1 != 0 {
                continue;
            }
            for (f, column) in cell.f.iter_mut().zip(&self.arrived) {
                *f = column[lane];
            }
            cell.rho = self.rho[lane];
            cell.mass += self.gained[lane];
            cell.dry = self.dry.map(|column| column[lane]);
            cell.touches = 0;
            if self.gas[lane] != 0.0 {
                cell.touches |= touch::GAS;
                entries.from_gas.add(&self.from_gas.map(|column| column[lane]));
            }
            if self.liquid[lane] != 0.0 {
                cell.touches |= touch::LIQUID;
            }
        }
    }
}

/// Streams all interface cells of a block, with registers that compute in f64: those with irregular links one by
/// one, the others side by side.
#[inline(always)]
pub(crate) fn stream_block<R: Registers, P: Physics>(
    streaming: &Streaming<P, R::Element>,
    near: &Near<R::Element>,
    list: &mut [InterfaceCell],
    entries: &mut Entries,
) {
    let line = R::Element::PER_LINE;
    let sources = streaming.task.sources;
    let mut columns = Columns::new();
    // Cells beside grains go one by one.
    let apart = sources.is_empty() || streaming.among_grains();
    let mut rest = list;
    while let Some(first) = rest.first() {
        let pack = usize::from(first.local) / line;
        let same = rest.partition_point(|cell| usize::from(cell.local) / line == pack);
        let (cells, later) = rest.split_at_mut(same);
        rest = later;
        // Bit per lane.
        let mut alone = if apart { u16::MAX } else { 0 };
        for link in streaming.block.links_of(pack) {
            alone |= 1 << (usize::from(link.local) % line);
        }
        let mut together = 0_u16;
        for cell in cells.iter_mut() {
            let lane = usize::from(cell.local) % line;
            if alone >> lane & 1 != 0 {
                streaming.stream(cell, entries);
            } else {
                together |= 1 << lane;
                for a in 0..3 {
                    columns.velocity[a][lane] = cell.velocity[a];
                }
            }
        }
        if together == 0 {
            continue;
        }
        for part in (0..line).step_by(R::WIDTH) {
            if together >> part & (u16::MAX >> (16 - R::WIDTH)) != 0 {
                let local = pack * line;
                columns.stream::<R>(near, &sources[pack], local, part);
            }
        }
        columns.hand_out(cells, alone, line, entries);
    }
}
