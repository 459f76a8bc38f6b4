//! Forces and torques on all grains.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::math::{Vec3, parallel::Split};

/// Force [N] and torque about the center [N m] on every grain; [n] each.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Loads {
    /// Forces [N].
    pub force: Vec<Vec3>,
    /// Torques [N m].
    pub torque: Vec<Vec3>,
}

impl Loads {
    /// No load on `n` grains.
    pub fn none(n: usize) -> Self {
        Self { force: vec![Vec3::ZERO; n], torque: vec![Vec3::ZERO; n] }
    }

    /// Makes room for `n` grains, with no load on any; where there is room for as many, loads stay as they are.
    pub fn fit(&mut self, n: usize) {
        if self.force.len() != n {
            *self = Self::none(n);
        }
    }

    /// Takes all loads away.
    pub fn clear(&mut self) {
        self.force.fill(Vec3::ZERO);
        self.torque.fill(Vec3::ZERO);
    }

    /// Puts the grains into another order, if there is room for any.
    pub fn reorder(&mut self, order: &[u32]) {
        if self.force.is_empty() {
            return;
        }
        self.force = order.iter().map(|&at| self.force[at as usize]).collect();
        self.torque = order.iter().map(|&at| self.torque[at as usize]).collect();
    }

    /// Views that can be cut between grains.
    pub fn views(&mut self) -> LoadViews<'_> {
        LoadViews { force: &mut self.force, torque: &mut self.torque }
    }
}

/// Mutable views of loads that can be cut between grains.
pub struct LoadViews<'a> {
    /// Forces [N].
    pub force: &'a mut [Vec3],
    /// Torques [N m].
    pub torque: &'a mut [Vec3],
}

impl Split for LoadViews<'_> {
    fn split(self, range: &Range<usize>, at: usize) -> (Self, Self) {
        let (force, force_after) = self.force.split(range, at);
        let (torque, torque_after) = self.torque.split(range, at);
        (Self { force, torque }, Self { force: force_after, torque: torque_after })
    }
}
