//! Streaming and mass exchange of interface cells one by one \[F1\] \[F2\], and what the links bring in \[F5\].

use super::flow::flow_at;
use super::record::InterfaceCell;
use super::state::Surface;
use crate::boundary::links::Source;
use crate::free_surface::Kind;
use crate::free_surface::contact::{Contact, sent_back};
use crate::free_surface::conversion::touch;
use crate::free_surface::exchange::{carried_among, gas_link, link_mass, wetted_share};
use crate::free_surface::shares::{dry_share, dry_share_at_wall, even, taken_back, viscous};
use crate::lattice::moments::density_excess;
use crate::lattice::{Q, opposite};
use crate::solver::balance::{Carrying, LinkEnd};
use crate::solver::books::{CellEntries, Crossing, Entries};
use crate::solver::fast::block::{Block, Link, Origin};
use crate::solver::fast::element::{Element, index};
use crate::solver::fast::hand_over;
use crate::solver::fast::layout::NONE;
use crate::solver::fast::links::{after, density_at_wall, open_link, wall_link};
use crate::solver::fast::rim::Rim;
use crate::solver::fast::task::Task;
use crate::solver::loads::arm;
use crate::solver::physics::Physics;

/// A block while its interface cells stream.
pub(crate) struct Streaming<'a, P, E> {
    pub(super) task: &'a Task<'a, P, E>,
    pub(super) surface: &'a Surface,
    pub(super) rim: &'a [Rim],
    pub(super) block: &'a Block,
    pub(super) number: usize,
    /// Block numbers around it.
    pub(super) around: [u32; 27],
}

impl<P: Physics, E: Element> Streaming<'_, P, E> {
    /// Populations, Δm and neighbours of an interface cell.
    #[inline(never)]
    pub(super) fn stream(&self, cell: &mut InterfaceCell, entries: &mut Entries) {
        let local = usize::from(cell.local);
        let own = after(self.task, self.number, local);
        let here = self.here(cell, &own);
        let mut links = self.block.links_of_cell(local, E::PER_LINE).iter().peekable();
        let (mut arrived, mut gained, mut apart) = (own, [0.0; Q], [0.0; Q]);
        let (mut touches, mut contact, mut booked) = (0, None, CellEntries::default());
        let at = self.at(local);
        for i in 1..Q {
            let out = opposite(i);
            let link = links.next_if(|link| usize::from(link.direction) == i);
            let mut gas = false;
            let source = match self.end(local, i, link) {
                End::Wall { velocity, body, edge, link } => {
                    touches |= touch::WALL;
                    let u = &self.task.velocities[velocity as usize];
                    let contact = contact.get_or_insert_with(|| self.contact(local, here.fill));
                    [arrived[i], apart[i]] = self.sent_by_wall(&here, contact, link, u, body);
                    Source::Wall { velocity: *u, body, edge }
                }
                End::Open(link) => {
                    arrived[i] = open_link(self.task, self.number, self.rim, link);
                    gained[i] = here.fill * (arrived[i] - own[out]);
                    Source::Open
                }
                End::Cell { number, local, direction } => {
                    let kind = self.kind(number, local);
                    if kind == Kind::Solid {
                        // Covered by a grain: what its surface returns has been put there, and booked.
                        touches |= touch::WALL;
                        arrived[i] = self.sent(number, local, direction);
                        continue;
                    }
                    gas = !kind.is_fluid();
                    if gas {
                        touches |= touch::GAS;
                        arrived[i] = gas_link(own[out], out, &cell.velocity);
                    } else {
                        if kind == Kind::Liquid {
                            touches |= touch::LIQUID;
                        }
                        arrived[i] = self.sent(number, local, direction);
                        [gained[i], apart[i]] =
                            self.exchanged(&here, arrived[i], kind, [out, direction], (number, local));
                    }
                    Source::Cell { cell: 0, direction: direction as u8 }
                }
            };
            let [leaving, arrived] = [own[out], arrived[i]];
            let crossing = Crossing { i, leaving, arrived, share: here.fill, liquid: false, at };
            booked.link(self.task.setup, &crossing, &source, gas, entries);
        }
        booked.close(entries);
        cell.rho = 1.0 + density_excess(&arrived);
        cell.mass += density_excess(&gained) - self.handed(local, here.fill, entries);
        if contact.is_some() {
            self.carry(cell, &own, &arrived, entries);
        }
        (cell.f, cell.touches, cell.dry) = (arrived, touches, taken_back(&apart, &cell.velocity));
    }

    /// What comes back along a link to a wall \[F10\], and its dry viscous momentum \[F9\].
    fn sent_by_wall(
        &self,
        here: &Here,
        contact: &Contact,
        link: &Link,
        velocity: &[f64; 3],
        body: u8,
    ) -> [f64; 2] {
        let out = opposite(usize::from(link.direction));
        let wall = wall_link(self.task, self.number, self.rim, link, 1.0 + here.d_rho, velocity, body);
        let gas = gas_link(here.own[out], out, &here.u);
        let arrived = sent_back(wall, gas, contact.meeting(out));
        [arrived, here.dry_at_wall(out, arrived, &contact.along)]
    }

    /// Loads of an interface cell by balance \[C7\]; `arrived`: its populations after streaming.
    fn carry(&self, cell: &InterfaceCell, own: &[f64; Q], arrived: &[f64; Q], entries: &mut Entries) {
        let Some(surface) = self.task.surface.as_ref().filter(|_| !entries.loads.is_empty()) else { return };
        let local = usize::from(cell.local);
        let mut links = self.block.links_of_cell(local, E::PER_LINE).iter().peekable();
        let ends = std::array::from_fn(|i| {
            let link = links.next_if(|link| usize::from(link.direction) == i);
            match self.end(local, i, link) {
                End::Wall { body, .. } => LinkEnd::Wall(body),
                End::Open(_) => LinkEnd::Open,
                End::Cell { number: NONE, .. } => LinkEnd::Cell(Kind::Gas, 0.0),
                End::Cell { number, local, .. } => {
                    LinkEnd::Cell(self.kind(number, local), self.surface.fill[number as usize][local])
                }
            }
        });
        let carrying = Carrying {
            fill: [self.surface.fill[self.number][local], cell.mass / cell.rho],
            after: own,
            arrived,
            force: surface.force_of(self.number, cell, &self.task.force),
            weight: self.task.force,
            ends,
        };
        let at = self.at(local);
        carrying.enter(entries, |i, body| arm(self.task.setup, at, i, body));
    }

    /// What a cell exchanges with.
    fn here<'c>(&self, cell: &InterfaceCell, own: &'c [f64; Q]) -> Here<'c> {
        let local = usize::from(cell.local);
        // An interface cell's own φ; that of a liquid neighbour is not used.
        let fill = self.surface.fill[self.number][local];
        let (.., carried) = flow_at(&self.surface.flow[self.number], local);
        Here { own, d_rho: density_excess(own), fill, carried, u: cell.velocity }
    }

    /// Mass and dry viscous momentum of a link from a fluid cell. `directions`: towards it, and of what it sends.
    fn exchanged(
        &self,
        here: &Here,
        arrived: f64,
        kind: Kind,
        [out, direction]: [usize; 2],
        (number, local): (u32, usize),
    ) -> [f64; 2] {
        let other = self.surface.fill[number as usize][local];
        let (mut shares, mut apart) = ([here.fill, other], 0.0);
        if kind == Kind::Interface {
            let (there, u, carried) = flow_at(&self.surface.flow[number as usize], local);
            shares = [here.carried, carried];
            let ends = [even(direction, there, &u), even(out, here.d_rho, &here.u)];
            apart = dry_share(here.fill, other) * viscous(arrived, here.own[out], ends[0], ends[1]);
        }
        [link_mass(wetted_share(kind, shares[0], shares[1]), arrived, here.own[out]), apart]
    }

    /// c of an interface cell \[F1\].
    pub(super) fn carried(&self, local: usize) -> f64 {
        let fill = self.surface.fill[self.number][local];
        let mut links = self.block.links_of_cell(local, E::PER_LINE).iter().peekable();
        // Links are listed in the order of the directions.
        carried_among(fill, &self.contact(local, fill).along, |i| {
            let link = links.next_if(|link| usize::from(link.direction) == i);
            match self.end(local, i, link) {
                End::Cell { number, local, .. } => Some(self.kind(number, local)),
                End::Wall { .. } | End::Open(_) => None,
            }
        })
    }

    /// The surface at a cell beside walls; grains count as the cell itself.
    fn contact(&self, local: usize, fill: f64) -> Contact {
        let mut by_direction = [None; Q];
        for link in self.block.links_of_cell(local, E::PER_LINE) {
            by_direction[usize::from(link.direction)] = Some(link);
        }
        Contact::new(
            fill,
            &std::array::from_fn(|i| match self.end(local, opposite(i), by_direction[opposite(i)]) {
                End::Cell { number: NONE, .. } => Some(0.0),
                End::Cell { number, local, .. } => Some(match self.surface.kinds[number as usize][local] {
                    Kind::Solid => fill,
                    Kind::Liquid => 1.0,
                    Kind::Interface => self.surface.fill[number as usize][local],
                    Kind::Gas => 0.0,
                }),
                End::Wall { .. } | End::Open(_) => None,
            }),
        )
    }

    /// Mass that an interface cell hands along the surfaces of moving solids \[B1\].
    fn handed(&self, local: usize, fill: f64, entries: &mut Entries) -> f64 {
        let handed = hand_over::handed(self.task, self.number, local, |number, there| {
            wetted_share(self.surface.kinds[number][there], fill, self.surface.fill[number][there])
        });
        entries.from_walls.add(-handed);
        handed
    }

    /// Kind of a cell; gas where there is no block.
    #[inline]
    fn kind(&self, number: u32, local: usize) -> Kind {
        match number {
            NONE => Kind::Gas,
            number => self.surface.kinds[number as usize][local],
        }
    }

    /// Box coordinates of a cell.
    #[inline]
    fn at(&self, local: usize) -> [usize; 3] {
        self.task.layout.cell(self.block.origin, local)
    }

    /// What a cell sends in a direction.
    #[inline]
    fn sent(&self, number: u32, local: usize, direction: usize) -> f64 {
        self.task.old[number as usize].get()[index::<E>(local, direction)].to_f64()
    }

    /// Whether grains cover cells in the block or beside it.
    #[inline]
    pub(super) fn among_grains(&self) -> bool {
        !self.surface.covered.is_empty()
            && self.around.iter().any(|&n| n != NONE && self.surface.covered[n as usize] > 0)
    }

    /// The other end of the link that population `i` arrives through.
    #[inline]
    fn end<'l>(&self, local: usize, i: usize, link: Option<&'l Link>) -> End<'l> {
        let Some(link) = link else {
            let (entry, from) = self.task.layout.upstream(local, i);
            return End::Cell { number: self.around[entry], local: from, direction: i };
        };
        match link.from {
            Origin::Cell { cell, direction } => End::Cell {
                number: self.task.layout.block_at(cell.block as usize),
                local: cell.local as usize,
                direction: usize::from(direction),
            },
            Origin::Wall { velocity, body, edge } => End::Wall { velocity, body, edge, link },
            Origin::Open => End::Open(link),
        }
    }

    /// Books the irregular links of liquid cells; `returned`: what comes back from walls and open faces, by
    /// link.
    pub(super) fn book_liquid(&self, returned: &mut [f64], entries: &mut Entries) {
        let mut links = self.block.links.as_slice();
        let mut returned = returned;
        while let Some(first) = links.first() {
            let same = links.iter().take_while(|link| link.local == first.local).count();
            let (cell, rest) = links.split_at(same);
            let (back, later) = returned.split_at_mut(same);
            (links, returned) = (rest, later);
            let local = usize::from(first.local);
            if self.surface.kinds[self.number][local] == Kind::Liquid {
                self.book_cell(local, cell, back, entries);
            }
        }
    }

    fn book_cell(&self, local: usize, links: &[Link], returned: &mut [f64], entries: &mut Entries) {
        let own = self.task.old[self.number].get();
        let mut booked = CellEntries::default();
        let at = self.at(local);
        for (link, back) in links.iter().zip(returned) {
            let i = usize::from(link.direction);
            let (arrived, source) = match self.end(local, i, Some(link)) {
                End::Wall { velocity, body, edge, link } => {
                    let u = &self.task.velocities[velocity as usize];
                    let rho = density_at_wall(self.task, self.number, local, u);
                    let arrived = wall_link(self.task, self.number, self.rim, link, rho, u, body);
                    (arrived, Source::Wall { velocity: *u, body, edge })
                }
                End::Open(link) => (open_link(self.task, self.number, self.rim, link), Source::Open),
                // A liquid cell touches no gas.
                End::Cell { direction, .. } if direction == i => continue,
                End::Cell { number, local, direction } => {
                    let arrived = self.sent(number, local, direction);
                    if self.surface.kinds[number as usize][local] == Kind::Solid {
                        // Behind a mirror plane and covered by a grain: booked where its surface returned it.
                        *back = arrived;
                        continue;
                    }
                    (arrived, Source::Cell { cell: 0, direction: direction as u8 })
                }
            };
            *back = arrived;
            let leaving = own[index::<E>(local, opposite(i))].to_f64();
            let crossing = Crossing { i, leaving, arrived, share: 1.0, liquid: true, at };
            booked.link(self.task.setup, &crossing, &source, false, entries);
        }
        booked.close(entries);
    }
}

/// An interface cell after its collision.
struct Here<'a> {
    own: &'a [f64; Q],
    d_rho: f64,
    /// φ.
    fill: f64,
    /// c \[F1\].
    carried: f64,
    u: [f64; 3],
}

impl Here<'_> {
    /// Dry viscous momentum of a link to a wall \[F9\].
    fn dry_at_wall(&self, out: usize, arrived: f64, normal: &[f64; 3]) -> f64 {
        let even = even(out, self.d_rho, &self.u);
        dry_share_at_wall(self.fill, out, normal) * viscous(arrived, self.own[out], even, even)
    }
}

/// The other end of a link.
enum End<'l> {
    Cell { number: u32, local: usize, direction: usize },
    Wall { velocity: u32, body: u8, edge: bool, link: &'l Link },
    Open(&'l Link),
}
