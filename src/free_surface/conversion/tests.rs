use std::collections::BTreeMap;

use super::Cell;
use super::cells::Cells;
use super::hand_on::{STEPS_PER_MOVE, hand_on, move_parked};
use crate::boundary::links::{Source, resolve};
use crate::free_surface::Kind;
use crate::rheology::Law;
use crate::setup::{Face, Setup};

/// Kinds and masses, without a flow.
struct Still {
    setup: Setup,
    kinds: Vec<Kind>,
    mass: Vec<f64>,
}

impl Still {
    /// 5³ cells of one kind, periodic.
    fn new(kind: Kind) -> Self {
        let setup = Setup::periodic([5; 3], Law::Newtonian { mu: 0.1 });
        Self { kinds: vec![kind; setup.cells()], mass: vec![0.0; setup.cells()], setup }
    }

    fn at(&self, at: [usize; 3]) -> usize {
        self.setup.index(at)
    }
}

impl Cells for Still {
    fn source(&self, cell: usize, i: usize) -> Source {
        resolve(&self.setup, self.setup.coordinates(cell), i).0
    }
    fn kind(&self, cell: usize) -> Kind {
        self.kinds[cell]
    }
    fn fill(&self, _: usize) -> f64 {
        0.0
    }
    fn mass(&self, cell: usize) -> f64 {
        self.mass[cell]
    }
    fn touches(&self, _: usize) -> u8 {
        0
    }
    fn populations(&self, _: usize) -> Cell {
        Cell::default()
    }
    fn fill_up(&mut self, _: usize) {}
    fn empty(&mut self, _: usize) {}
    fn expose(&mut self, _: usize, _: f64) {}
    fn wet(&mut self, _: usize, _: &Cell) {}
    fn add_mass(&mut self, cell: usize, mass: f64) {
        self.mass[cell] += mass;
    }
}

/// Where a mass parked in the middle is after a move, and what has left.
fn moved(cells: &Still, force: [f64; 3], step: u64) -> (Vec<[usize; 3]>, f64) {
    let mut parked = BTreeMap::from([(cells.at([2; 3]) as u32, 0.25)]);
    let outflow = move_parked(cells, &mut parked, step, &force);
    assert_eq!(parked.values().sum::<f64>() + outflow, 0.25);
    (parked.keys().map(|&cell| cells.setup.coordinates(cell as usize)).collect(), outflow)
}

#[test]
fn parked_mass_falls_in_gas_and_rises_in_liquid_along_the_largest_force() {
    for kind in [Kind::Gas, Kind::Liquid] {
        let cells = Still::new(kind);
        for axis in 0..3 {
            for sign in [1.0, -1.0] {
                // The other two point elsewhere, and are smaller.
                let mut force = [-0.5 * sign, 0.25 * sign, -0.5 * sign];
                force[axis] = sign;
                let mut to = [2; 3];
                to[axis] = if (sign > 0.0) == (kind == Kind::Gas) { 3 } else { 1 };
                assert_eq!(moved(&cells, force, STEPS_PER_MOVE), (vec![to], 0.0), "{kind:?} {force:?}");
            }
        }
    }
}

#[test]
fn parked_mass_stays_between_moves_without_force_beside_interface_and_at_walls() {
    let mut cells = Still::new(Kind::Gas);
    let (down, stays) = ([0.0, 0.0, -1.0], (vec![[2; 3]], 0.0));
    assert_eq!(moved(&cells, down, STEPS_PER_MOVE - 1), stays);
    assert_eq!(moved(&cells, [0.0; 3], STEPS_PER_MOVE), stays);
    // Other kinds below it, and solid around it.
    let below = cells.at([2, 2, 1]);
    for kind in [Kind::Liquid, Kind::Solid] {
        cells.kinds[below] = kind;
        assert_eq!(moved(&cells, down, STEPS_PER_MOVE), stays, "{kind:?}");
    }
    cells.kinds[below] = Kind::Gas;
    let corner = cells.at([1, 3, 2]);
    cells.kinds[corner] = Kind::Interface;
    assert_eq!(moved(&cells, down, STEPS_PER_MOVE), stays);
}

#[test]
fn parked_mass_leaves_through_open_faces_and_stays_at_walls() {
    for (face, (places, outflow)) in [(Face::Open, (vec![], 0.25)), (Face::NoSlip, (vec![[2, 2, 0]], 0.0))] {
        let mut cells = Still::new(Kind::Gas);
        cells.setup.faces[2] = [face; 2];
        let at = cells.at([2, 2, 0]) as u32;
        let mut parked = BTreeMap::from([(at, 0.25)]);
        assert_eq!(move_parked(&cells, &mut parked, 0, &[0.0, 0.0, -1.0]), outflow);
        let found: Vec<_> = parked.keys().map(|&cell| cells.setup.coordinates(cell as usize)).collect();
        assert_eq!(found, places);
    }
}

#[test]
fn mass_is_handed_on_evenly_or_by_the_component_along_a_direction() {
    // Interface cells at +x, at +x+z, and at −x.
    let receivers = [[3, 2, 2], [3, 2, 3], [1, 2, 2]];
    // Along (½, 0, ¼) lie ½ and ¾ of c; along −z none of the three, so that all have the same.
    let cases: [(Option<[f64; 3]>, [f64; 3]); 3] = [
        (None, [0.5, 0.5, 0.5]),
        (Some([0.5, 0.0, 0.25]), [0.6, 0.9, 0.0]),
        (Some([0.0, 1.0, 0.0]), [0.5, 0.5, 0.5]),
    ];
    for (along, expected) in cases {
        let mut cells = Still::new(Kind::Gas);
        for at in receivers {
            let at = cells.at(at);
            cells.kinds[at] = Kind::Interface;
        }
        let donor = cells.at([2; 3]) as u32;
        let mut parked = BTreeMap::from([(donor, 1.5)]);
        let outward: Vec<_> = along.map(|n| (donor, n)).into_iter().collect();
        hand_on(&mut cells, &mut parked, &outward);
        assert!(parked.is_empty());
        for (at, share) in receivers.into_iter().zip(expected) {
            // A product and a quotient.
            let found = cells.mass[cells.at(at)];
            assert!((found - share).abs() < 1e-15, "{along:?} at {at:?}: {found}, {share} expected");
        }
    }
    // Without receivers it stays.
    let mut cells = Still::new(Kind::Gas);
    let mut parked = BTreeMap::from([(62, 1.5)]);
    hand_on(&mut cells, &mut parked, &[]);
    assert_eq!(parked, BTreeMap::from([(62, 1.5)]));
}
