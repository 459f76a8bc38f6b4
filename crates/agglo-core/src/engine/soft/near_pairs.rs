//! Pairs of the near field: which they are, and how fast.

use crate::contact::pass::Centers;
use crate::math::{Pace, Vec3};
use crate::neighbors::PairList;

use super::forces::laws::source;
use super::system::System;

impl System {
    /// Pairs within the near field's cut-off and a little more; nothing where all pairs count.
    pub fn near_list(&self) -> Option<&PairList> {
        self.laws.fields.near_field.as_ref().and_then(|law| law.cutoff).map(|_| &self.near)
    }

    /// How fast the fastest pair of the near field is where grains are.
    pub fn near_pace_now(&self) -> Pace {
        self.near_pace(&self.grains.position)
    }

    /// The same at the trial motion, where neither a contact nor the law's own cap keeps grains apart; else nothing.
    pub fn near_pace_at_trial(&mut self) -> Pace {
        let is_capped = self.laws.fields.near_field.as_ref().is_none_or(|law| law.law.is_capped());
        if is_capped || self.laws.contact.is_some() {
            return Pace::NONE;
        }
        self.look_at_trial();
        self.near_pace(&self.trial.position)
    }

    fn near_pace(&self, positions: &[Vec3]) -> Pace {
        let Some(law) = &self.laws.fields.near_field else { return Pace::NONE };
        let pace = |a: usize, b: usize| {
            let distance = self.space.shortest(positions[b] - positions[a]).norm();
            law.pace(&source(&self.grains, a), &source(&self.grains, b), distance)
        };
        self.over_grains(|a| match self.near_list() {
            Some(list) => {
                list.owned(a).map(|pair| pace(a, list.partners()[pair] as usize)).fold(Pace::NONE, Pace::max)
            }
            None => (a + 1..self.grains.len()).map(|b| pace(a, b)).fold(Pace::NONE, Pace::max),
        })
    }

    /// Lists the pairs of the near field anew, if it has a cut-off, where the records have the grains.
    pub(super) fn list_near(&mut self) {
        let Some(cutoff) = self.laws.fields.near_field.as_ref().and_then(|law| law.cutoff) else { return };
        let skin = self.skin.of_near_field(cutoff.si());
        self.near.build(&self.space, &Centers(&self.records), cutoff.si(), skin);
        self.near.join_back();
    }
}
