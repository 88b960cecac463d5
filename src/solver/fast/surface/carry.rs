//! What links between interface cells carry of the mass \[F1\], cells of a pack side by side: the same as
//! `Streaming::carried` for cells whose links are all the grid's.

use crate::free_surface::exchange::{carried, tangential_weight};
use crate::free_surface::normal::outward;
use crate::lane::Lane;
use crate::lattice::moments::density_excess;
use crate::lattice::unroll::directions;
use crate::lattice::{Q, opposite};
use crate::solver::fast::element::Element;
use crate::solver::fast::registers::Registers;
use crate::solver::fast::sources::{Sources, gather_cells};

/// c of the interface cells of some packs of a block; any numbers in their other cells.
///
/// # Arguments
/// `fill`: φ or what stands for it, for each of the 27 blocks. `sources`: of every pack. `packs`: their numbers. `to`: one
/// number per cell.
#[inline(always)]
pub(crate) fn carry_packs<R: Registers>(
    fill: &[&[f64]; 27],
    sources: &[Sources],
    packs: &[usize],
    to: &mut [f64],
) {
    let line = R::Element::PER_LINE;
    for &pack in packs {
        for part in (0..line).step_by(R::WIDTH) {
            let at = pack * line + part;
            let own = R::load_wide(&fill[13][at..]);
            R::store_wide(carry_pack::<R>(fill, &sources[pack], own, part), &mut to[at..]);
        }
    }
}

#[inline(always)]
fn carry_pack<R: Registers>(fill: &[&[f64]; 27], sources: &Sources, own: R::Pack, part: usize) -> R::Pack {
    let (zero, one) = (R::Pack::zero(), R::Pack::one());
    let upstream = directions(
        #[inline(always)]
        |i| if i == 0 { own } else { gather_cells::<R>(fill, sources, part, i) },
    );
    let normal = outward(&directions(
        #[inline(always)]
        |i| R::Pack::larger(R::Pack::smaller(upstream[opposite(i)], one), zero),
    ));
    let square = (normal[0] * normal[0] + normal[1] * normal[1]) + normal[2] * normal[2];
    let some = zero.less(square);
    let safe = R::Pack::select(some, square, one);
    let (mut gas, mut liquid, mut level) = ([zero; Q], [zero; Q], [zero; Q]);
    for i in 1..Q {
        let weight = tangential_weight(i, &normal, safe);
        let (dry, full) = (upstream[i].less(zero), one.less(upstream[i]));
        gas[i] = R::Pack::select(dry, weight, zero);
        liquid[i] = R::Pack::select(full, weight, zero);
        let between = R::Pack::and(R::Pack::not(dry), R::Pack::not(full));
        level[i] = R::Pack::select(between, weight, zero);
    }
    let share = carried(own, density_excess(&gas), density_excess(&liquid), density_excess(&level));
    R::Pack::select(some, share, own)
}
