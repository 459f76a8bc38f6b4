//! The TC model of inelastic collapse: bounces that follow one another ever faster, infinitely many in a finite time.
//!
//! # Equation
//! A bounce is elastic if its pair has bounced with one another n times before, each time less than t_c after the last, and
//! both have bounced less than t_c before.
//!
//! # Source
//! S. Luding and S. McNamara, Granular Matter 1, 113 (1998): contacts last, and lose energy once in one.
//!
//! # Symbols
//! | symbol | name in code       | unit | meaning                                                       |
//! |--------|--------------------|------|---------------------------------------------------------------|
//! | t_c    | `contact_duration` | s    | default: 1e-6 of the time in which a mean radius is flown     |
//! | n      | `BEFORE`           | -    | bounces of a pair that lose energy, however fast they follow  |
//!
//! # Valid when
//! What bounces keep that are made elastic is small beside what collisions take. The summary has both, and warns where not.
//!
//! # Compared with others
//! Luding and McNamara make every bounce elastic of which a partner bounced less than t_c before. That takes first bounces of
//! one moment for a collapse: those of a merged sphere, which comes to lie over its neighbors, and those of a row that touches.
//! Here they lose what the laws say, as they do in the limit t_c -> 0.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::engine::validate::{Fault, ensure};

/// So many bounces of a pair in succession lose energy.
const BEFORE: u32 = 4;
/// From so many remembered pairs on, those of long ago are forgotten.
const MANY: usize = 64;

/// Pairs that bounced with one another again and again just before. Hardly any: who has not bounced within the contact
/// duration is not remembered.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Collapse {
    /// By the two ids, the smaller first.
    pairs: BTreeMap<[u32; 2], Succession>,
    /// How many are remembered before it is looked for some to forget.
    most: usize,
}

/// Bounces of a pair that follow one another.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Succession {
    /// The last one [s].
    last: f64,
    /// How many.
    bounces: u32,
}

impl Collapse {
    /// Whether it is one that a run can have come to.
    ///
    /// # Errors
    /// What is wrong with it.
    pub(in crate::engine::hard) fn validate(&self) -> Result<(), Fault> {
        let holds = |(names, succession): (&[u32; 2], &Succession)| {
            names[0] <= names[1] && succession.last.is_finite() && succession.bounces < u32::MAX / 2
        };
        ensure(self.pairs.iter().all(holds) && self.most < usize::MAX / 4, || {
            "a pair that bounces is none".to_owned()
        })
    }

    /// Takes note of a bounce at `time` [s] of two that both bounced less than `duration` [s] before, and says whether it
    /// belongs to a collapse.
    pub fn has_come(&mut self, mut names: [u32; 2], time: f64, duration: f64) -> bool {
        names.sort_unstable();
        let first = Succession { last: time, bounces: 0 };
        let succession = self.pairs.entry(names).or_insert(first);
        if time - succession.last >= duration {
            *succession = first;
        }
        *succession = Succession { last: time, bounces: succession.bounces + 1 };
        let has_come = succession.bounces > BEFORE;
        if self.pairs.len() > self.most.max(MANY) {
            self.pairs.retain(|_, succession| time - succession.last < duration);
            self.most = 2 * self.pairs.len();
        }
        has_come
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The fifth bounce of a pair in a row is elastic, those of others and later ones are not.
    #[test]
    fn only_a_pair_that_bounces_again_and_again() {
        let mut collapse = Collapse::default();
        for k in 0..BEFORE {
            assert_false!(
                collapse.has_come([7, 3], f64::from(k) * 0.9, 1.0),
                "the collapse of 3 and 7 by the impact at this time, s"
            );
            assert!(!collapse.has_come([7, 100 + k], f64::from(k) * 0.9, 1.0), "a first bounce");
        }
        assert_true!(
            collapse.has_come([3, 7], 3.0, 1.0),
            "the collapse of 3 and 7 by the impact at this time, s"
        );
        assert_true!(
            collapse.has_come([7, 3], 3.0, 1.0),
            "the collapse of 3 and 7 by the impact at this time, s"
        );
        assert!(!collapse.has_come([3, 7], 4.0, 1.0), "a contact duration later");
    }

    #[test]
    fn long_ago_is_forgotten() {
        let mut collapse = Collapse::default();
        (0..100_000).for_each(|k| {
            collapse.has_come([k, k + 1], f64::from(k), 10.0);
        });
        assert!(collapse.pairs.len() <= MANY + 1, "{}", collapse.pairs.len());
    }
}
