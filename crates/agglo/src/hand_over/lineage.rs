//! Which primaries each grown grain is made of, from the tables of merges and breakages of its run.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::Path;

use crate::folder::names;
use crate::particles::Particles;
use crate::record::Sheet;
use crate::run::{Origin, State};

/// The grains at the start, and of which of them [index] each grain is made now, by its id. Grains that come out of a breakage
/// are not in it: which primaries went into which fragment nobody knows.
pub(super) struct Lineage {
    /// The grains at the start.
    pub first: Particles,
    members: BTreeMap<u32, Vec<u32>>,
}

impl Lineage {
    /// Reads it; none where the folder does not tell.
    pub fn read(folder: &Path, state: &State) -> Option<Self> {
        let start = Origin::of(&state.past, folder, &mut || ControlFlow::Continue(())).ok()?.start;
        let is_primary = |at: usize| start.grown.get(at).is_none_or(|grown| grown.primaries == 1);
        let single = (0..start.grains.len()).filter(|&at| is_primary(at));
        let members = single.map(|at| (start.grains.id[at], vec![at as u32])).collect();
        let mut lineage = Self { first: start.grains, members };
        let [events, genealogy] =
            [names::EVENTS, names::GENEALOGY].map(|name| Sheet::read(&folder.join(name)).ok());
        let (events, genealogy) = (events?, genealogy?);
        let (numbers, times, kinds) =
            (events.words("event")?, events.numbers("time_s")?, events.words("kind")?);
        let [of, parents, children] = ["event", "parent", "child"].map(|name| genealogy.words(name));
        let (of, parents, children) = (of?, parents?, children?);
        let mut at = 0;
        for ((number, time), kind) in numbers.iter().zip(times).zip(kinds) {
            // A run that was killed may have written more than its checkpoint knows.
            if time > state.time {
                break;
            }
            let mut rows = Vec::new();
            while of.get(at).is_some_and(|event| event == number) {
                rows.push((parents[at].parse().ok()?, children[at].parse().ok()?));
                at += 1;
            }
            lineage.follow(&rows, kind == "merge");
        }
        Some(lineage)
    }

    /// One event: rows of parent and child.
    fn follow(&mut self, rows: &[(u32, u32)], is_merge: bool) {
        let mut parents: BTreeMap<u32, Option<Vec<u32>>> = BTreeMap::new();
        for &(parent, _) in rows {
            parents.entry(parent).or_insert_with(|| self.members.remove(&parent));
        }
        if is_merge {
            let all: Option<Vec<Vec<u32>>> = parents.into_values().collect();
            if let (Some(all), Some(&(_, child))) = (all, rows.first()) {
                self.members.insert(child, all.concat());
            }
            return;
        }
        for (parent, members) in parents {
            let mut own = rows.iter().filter(|row| row.0 == parent);
            // A partner that stayed whole goes on under its one row.
            if let (Some(members), Some(&(_, child)), None) = (members, own.next(), own.next()) {
                self.members.insert(child, members);
            }
        }
    }

    /// The primaries [index] of a grain of so many; none where they are not known.
    pub fn of(&self, grain: u32, primaries: u32) -> Option<&[u32]> {
        self.members.get(&grain).map(Vec::as_slice).filter(|members| members.len() == primaries as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(grains: u32) -> Lineage {
        Lineage { first: Particles::default(), members: (0..grains).map(|id| (id, vec![id])).collect() }
    }

    /// 0 and 1 merge, then 3 joins; 2 breaks 4, which nobody knew the parts of, and stays whole itself.
    #[test]
    fn merges_are_followed_and_fragments_are_not_known() {
        let mut lineage = of(6);
        lineage.follow(&[(1, 1), (0, 1)], true);
        lineage.follow(&[(3, 1), (1, 1)], true);
        let mut members = lineage.of(1, 3).unwrap().to_vec();
        members.sort_unstable();
        assert_eq!(members, [0, 1, 3]);
        assert_eq!(
            (lineage.of(0, 1), lineage.of(1, 2)),
            (None, None),
            "what has merged away, or has another count"
        );
        lineage.follow(&[(4, 6), (4, 7), (2, 2)], false);
        assert_eq!((lineage.of(2, 1), lineage.of(4, 1), lineage.of(6, 1)), (Some(&[2][..]), None, None));
        lineage.follow(&[(5, 5), (6, 5)], true);
        assert_eq!(lineage.of(5, 2), None, "a grain with a part that is not known");
    }
}
