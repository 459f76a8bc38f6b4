//! All forces on one grain, gathered from whoever has them.

use std::ops::Add;

use crate::contact::network::{BondRates, Network};
use crate::contact::pass::Contacts;
use crate::domain::Space;
use crate::ledger::Supplies;
use crate::link::row_of_fields;
use crate::math::Vec3;
use crate::neighbors::PairList;
use crate::particles::Particles;
use crate::walls::WallContacts;

use super::laws::{Laws, near_force};
use super::loads::Loads;
use crate::engine::soft::hook::Attached;

/// What the grains read while they gather their loads.
pub struct Gather<'a> {
    /// The grains' constant columns.
    pub grains: &'a Particles,
    /// The laws.
    pub laws: &'a Laws,
    /// Bonds, with their loads.
    pub network: &'a Network,
    /// Contacts, with theirs.
    pub contacts: &'a Contacts,
    /// Contacts with walls, with theirs.
    pub walls: &'a WallContacts,
    /// Pairs of the near field.
    pub near: &'a PairList,
    /// Centers of all grains [m], for the near field.
    pub positions: &'a [Vec3],
    /// Space, which may repeat itself.
    pub space: &'a Space,
    /// Time [s].
    pub time: f64,
    /// What a hook adds.
    pub hook: Option<&'a Loads>,
}

/// What is added up over all grains while they gather their loads.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gathered {
    /// What forces from outside supply.
    pub supplies: Supplies,
    /// What bonds do.
    pub bonds: BondRates,
}

row_of_fields!(Gathered { supplies: Supplies, bonds: BondRates });

impl Add for Gathered {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { supplies: self.supplies + other.supplies, bonds: self.bonds + other.bonds }
    }
}

impl Gather<'_> {
    /// Force [N] and torque [N m] on a grain at a place [m] with a velocity [m/s] and an angular velocity [rad/s].
    #[inline(always)]
    pub fn on(&self, grain: usize, motion: (Vec3, Vec3, Vec3), sums: &mut Gathered) -> (Vec3, Vec3) {
        let Gathered { supplies, bonds } = sums;
        let (mut force, mut torque) = self.contacts.load_on(grain);
        if let Some(of_walls) = self.walls.load_on(grain) {
            force += of_walls.0;
            torque += of_walls.1;
        }
        self.network.gather(grain, &mut force, &mut torque, bonds);
        if self.laws.fields.near_field.is_some() {
            self.near_field(grain, &mut force, supplies);
        }
        if self.laws.has_single() {
            let single = self.laws.on_single(self.grains, grain, motion, self.time, supplies);
            force += single.force;
            torque += single.torque;
        }
        if let Some(loads) = self.hook {
            supplies.hook = supplies.hook + Attached::supply(loads, motion, grain);
            force += loads.force[grain];
            torque += loads.torque[grain];
        }
        (force, torque)
    }

    /// Adds the near-field force [N].
    fn near_field(&self, grain: usize, force: &mut Vec3, supplies: &mut Supplies) {
        let Some(law) = &self.laws.fields.near_field else { return };
        let push = |other: usize| near_force(law, self.grains, self.space, self.positions, [grain, other]);
        if law.cutoff.is_some() {
            let (owners, partners) = (self.near.owners(), self.near.partners());
            *force += self.near.joined(grain).iter().map(|pair| push(owners[*pair as usize] as usize)).sum();
            let mut owned = Vec3::ZERO;
            for partner in self.near.owned(grain).map(|pair| partners[pair] as usize) {
                let of_pair = push(partner);
                owned += of_pair;
                if self.space.is_strained() {
                    let apart = self.space.shortest(self.positions[partner] - self.positions[grain]);
                    supplies.strained += of_pair.dot(self.space.flow(apart));
                }
            }
            *force += owned;
        } else {
            *force += (0..self.grains.len()).filter(|other| *other != grain).map(push).sum();
        }
    }
}
