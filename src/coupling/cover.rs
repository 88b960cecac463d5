//! Cells that grains take and give back \[C3\]: mass and momentum go through the ledger.

use super::coverage::Changes;
use super::host::{Host, Uncovered};
use super::immersed::Immersed;
use crate::boundary::links::Source;
use crate::dem::keep_marked;
use crate::free_surface::Kind;
use crate::lattice::moments::{density_excess, momentum};
use crate::lattice::{Q, W};
use std::collections::BTreeMap;

impl Immersed {
    /// Covers and uncovers cells after the grains have moved.
    pub(super) fn follow(&mut self, host: &mut dyn Host) {
        let changes = self.update_coverage(host.setup(), host.pool());
        self.apply(host, &changes);
    }

    /// Takes newly covered cells out of the fluid and gives freed ones back.
    fn apply(&mut self, host: &mut dyn Host, changes: &Changes) {
        for &(cell, grain) in &changes.covered {
            let cell = cell as usize;
            let kind = host.kind(cell);
            let mut mass = host.take_parked(cell);
            let mut taken = [0.0; 3];
            if kind.is_fluid() {
                let f = host.populations(cell);
                taken = momentum(&f);
                let rho = 1.0 + density_excess(&f);
                mass += if kind == Kind::Liquid { rho } else { host.mass(cell) };
                if kind == Kind::Liquid {
                    self.owed[grain as usize] += rho - 1.0;
                }
            }
            host.cover(cell);
            self.debt[grain as usize] += mass;
            let (gained, momentum) = self.config.equations.covering(mass, taken);
            host.book(gained, &momentum);
            self.books.cover(mass, &taken);
        }
        if changes.freed.is_empty() {
            return;
        }
        let kinds = self.kinds_of_freed(host, changes);
        let mut volume: BTreeMap<u32, f64> = BTreeMap::new();
        for (&(_, grain), (kind, _)) in changes.freed.iter().zip(&kinds) {
            *volume.entry(grain).or_insert(0.0) += if *kind == Kind::Liquid { 1.0 } else { 0.0 };
        }
        let cells: Vec<(u32, u32, f64, Uncovered)> = changes
            .freed
            .iter()
            .zip(kinds)
            .map(|(&(cell, grain), (kind, fill))| {
                let liquid = volume[&grain];
                let share = if liquid > 0.0 { self.owed[grain as usize] / liquid } else { 0.0 };
                (cell, grain, fill, self.uncovered(host, cell as usize, grain as usize, (kind, fill), share))
            })
            .collect();
        for (cell, grain, volume, to) in &cells {
            let fill = match to.kind {
                Kind::Liquid => 1.0 + density_excess(&to.populations),
                Kind::Interface => to.mass,
                Kind::Gas | Kind::Solid => 0.0,
            };
            if to.kind == Kind::Liquid {
                self.owed[*grain as usize] -= fill - volume;
            }
            self.debt[*grain as usize] -= fill;
            let given = momentum(&to.populations);
            host.uncover(*cell as usize, to);
            host.book(fill, &given);
            self.books.free(fill, &given);
        }
    }

    /// Takes grains out of the run: their cells become fluid or gas again, and the others are numbered anew.
    pub(crate) fn leave(&mut self, host: &mut dyn Host, keep: &[bool]) {
        let mut changes = Changes::default();
        for grain in (0..self.grains()).filter(|&grain| !keep[grain]) {
            let freed = self.coverage.clear(grain);
            changes.freed.extend(freed.into_iter().map(|cell| (cell, grain as u32)));
        }
        changes.freed.sort_unstable();
        self.apply(host, &changes);
        self.coverage.retain(keep);
        keep_marked(&mut self.loads, keep);
        keep_marked(&mut self.contact, keep);
        keep_marked(&mut self.owed, keep);
        keep_marked(&mut self.debt, keep);
        let walls = self.dem.scenery().walls.len();
        self.dem.retain(keep, walls);
        if let Some(gaps) = &mut self.gaps {
            gaps.forget();
        }
        let force = host.setup().force.at(host.step_number());
        self.balance(host.fluid_count(), &force);
    }

    /// What freed cells become, one after the other: liquid where no gas is beside them, interface where liquid is
    /// too, else gas. Liquid never touches gas that way.
    ///
    /// The fill of an interface cell is the mean around it.
    fn kinds_of_freed(&self, host: &dyn Host, changes: &Changes) -> Vec<(Kind, f64)> {
        let mut decided: BTreeMap<u32, (Kind, f64)> = BTreeMap::new();
        for &(cell, _) in &changes.freed {
            let (mut gas, mut liquid, mut interface) = (0, 0, 0);
            let (mut wet, mut weight) = (0.0, 0.0);
            for i in 1..Q {
                let (kind, fill) = match self.shape.source(host.setup(), cell as usize, i) {
                    Source::Cell { cell: n, .. } => match decided.get(&n) {
                        Some(known) => *known,
                        None => match host.kind(n as usize) {
                            Kind::Interface => (Kind::Interface, host.fill(n as usize)),
                            kind => (kind, if kind == Kind::Liquid { 1.0 } else { 0.0 }),
                        },
                    },
                    Source::Open => (Kind::Gas, 0.0),
                    Source::Wall { .. } => continue,
                };
                match kind {
                    Kind::Solid => continue,
                    Kind::Gas => gas += 1,
                    Kind::Interface => interface += 1,
                    Kind::Liquid => liquid += 1,
                }
                wet += W[i] * fill;
                weight += W[i];
            }
            let verdict = if !self.with_gas || (gas == 0 && liquid + interface > 0) {
                (Kind::Liquid, 1.0)
            } else if liquid > 0 {
                (Kind::Interface, wet / weight)
            } else {
                (Kind::Gas, 0.0)
            };
            decided.insert(cell, verdict);
        }
        changes.freed.iter().map(|(cell, _)| decided[cell]).collect()
    }

    /// `share`: ρ − 1 that would settle what the grain owes.
    fn uncovered(
        &self,
        host: &dyn Host,
        cell: usize,
        grain: usize,
        (kind, fill): (Kind, f64),
        share: f64,
    ) -> Uncovered {
        if !kind.is_fluid() {
            return Uncovered { kind, populations: [0.0; Q], mass: 0.0 };
        }
        let populations = self.refill(host, cell, grain, share);
        let mass = if kind == Kind::Interface { fill * (1.0 + density_excess(&populations)) } else { 0.0 };
        Uncovered { kind, populations, mass }
    }
}
