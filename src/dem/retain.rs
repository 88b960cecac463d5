//! Leaving bodies and walls out of a run.

use super::Dem;
use super::bodies::Bodies;

/// Keeps the entries marked in `keep`.
pub(crate) fn keep_marked<T>(list: &mut Vec<T>, keep: &[bool]) {
    let mut marks = keep.iter();
    // Entries beyond the marks stay: there are none in the lists of a run.
    list.retain(|_| marks.next().is_none_or(|&kept| kept));
}

impl Bodies {
    /// Keeps the bodies marked in `keep`.
    fn retain(&mut self, keep: &[bool]) {
        for list in [
            &mut self.position,
            &mut self.velocity,
            &mut self.spin,
            &mut self.momentum,
            &mut self.force,
            &mut self.torque,
            &mut self.inertia,
            &mut self.inverse_inertia,
        ] {
            keep_marked(list, keep);
        }
        for list in [&mut self.mass, &mut self.inverse_mass, &mut self.radius] {
            keep_marked(list, keep);
        }
        keep_marked(&mut self.orientation, keep);
        keep_marked(&mut self.shape, keep);
        let sizes =
            self.first_member.windows(2).zip(keep).filter(|(_, kept)| **kept).map(|(w, _)| w[1] - w[0]);
        let mut end = 0;
        let ends: Vec<u32> = sizes
            .map(|size| {
                end += size;
                end
            })
            .collect();
        self.first_member.truncate(1);
        self.first_member.extend(ends);
        let mut number = 0;
        let numbers: Vec<u32> = keep
            .iter()
            .map(|&kept| {
                number += u32::from(kept);
                number - u32::from(kept)
            })
            .collect();
        self.driven.retain(|&i| keep[i as usize]);
        for i in &mut self.driven {
            *i = numbers[*i as usize];
        }
    }
}

impl Dem {
    /// Leaves out the bodies that `keep` does not mark, and all walls from number `walls` on. What stays goes on bit
    /// for bit as it would have, with its springs, forces and books; what left takes its energy with it.
    ///
    /// # Arguments
    /// `keep`: one entry per body.
    pub fn retain(&mut self, keep: &[bool], walls: usize) {
        let mut next = 0;
        let numbers: Vec<Option<u32>> = (self.members.iter())
            .map(|member| {
                let stays = keep[member.body as usize];
                next += u32::from(stays);
                stays.then(|| next - 1)
            })
            .collect();
        let members: Vec<bool> = numbers.iter().map(Option::is_some).collect();
        self.bodies.retain(keep);
        keep_marked(&mut self.members, &members);
        keep_marked(&mut self.offsets, &members);
        for i in 0..self.bodies.len() {
            let (from, to) = (self.bodies.first_member[i], self.bodies.first_member[i + 1]);
            for member in &mut self.members[from as usize..to as usize] {
                member.body = i as u32;
            }
        }
        if let Some((force, torque)) = &mut self.external {
            keep_marked(force, keep);
            keep_marked(torque, keep);
        }
        if let Some((places, turns)) = &mut self.gear {
            keep_marked(places, keep);
            keep_marked(turns, keep);
        }
        // Old lists under new numbers: making them anew carries everything over. Numbers keep their order.
        let new = |member: u32| numbers[member as usize];
        let pairs: Vec<Option<(u32, u32)>> =
            self.list.pairs.iter().map(|&(a, b)| Some((new(a)?, new(b)?))).collect();
        let kept: Vec<bool> = pairs.iter().map(Option::is_some).collect();
        self.list.pairs = pairs.into_iter().flatten().collect();
        keep_marked(&mut self.pairs.history, &kept);
        keep_marked(&mut self.pairs.rolling, &kept);
        keep_marked(&mut self.pairs.force, &kept);
        keep_marked(&mut self.pairs.touching, &kept);
        self.near.retain_mut(|near| {
            near.contacts.retain(|contact| (contact.wall as usize) < walls);
            let number = new(near.member);
            near.member = number.unwrap_or(near.member);
            number.is_some()
        });
        self.scenery.truncate(walls);
        self.renew_lists();
    }
}
