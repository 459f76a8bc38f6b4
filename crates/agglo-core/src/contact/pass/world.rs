//! What a pass over contacts is given, and what it adds up.

use super::record::Record;
use crate::contact::bond::{Bonds, StrainBond};
use crate::contact::{ContactLaws, PairTable};
use crate::domain::Space;
use crate::link::row_of_fields;
use crate::neighbors::PairList;
use crate::particles::{Motion, Particles};

/// Laws of contact and the pairs that they may act on.
#[derive(Clone, Copy)]
pub struct ContactWorld<'a> {
    /// Laws of contact, if any.
    pub laws: Option<&'a ContactLaws>,
    /// Bond law, of which only the one that acts in contact concerns this pass.
    pub bonds: Option<&'a Bonds>,
    /// Constants of pairs of materials.
    pub pairs: &'a PairTable,
    /// Candidate pairs.
    pub list: &'a PairList,
    /// Space, which may repeat itself: a pair meets where it is nearest.
    pub space: &'a Space,
}

/// The step at whose end a pass is made.
#[derive(Clone, Copy)]
pub struct Passage<'a> {
    /// All grains on their way.
    pub records: &'a [Record],
    /// Time between its start and its end [s]: its length, or zero before the first.
    pub elapsed: f64,
    /// Its length [s], for laws that carry it.
    pub dt: f64,
}

/// Grains at one moment, to be looked at.
pub struct Snapshot<'a> {
    /// Laws and pairs.
    pub world: ContactWorld<'a>,
    /// The grains' constant columns.
    pub grains: &'a Particles,
    /// Where they are and how they move.
    pub now: Motion<'a>,
}

impl ContactWorld<'_> {
    /// How far beyond touching the laws act [m].
    pub(super) fn beyond(&self) -> f64 {
        self.laws.map_or(0.0, ContactLaws::reach)
    }

    /// The bond that acts in contact.
    #[inline]
    pub(super) fn bond(&self) -> Option<&StrainBond> {
        self.bonds.and_then(Bonds::in_contact)
    }
}

/// What one pass over the contacts adds up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactRates {
    /// Power lost in normal dashpots [W].
    pub damping: f64,
    /// Power that a formula of contact puts in where it drives grains [W].
    pub driven: f64,
    /// Power that tangential forces take from the motion [W].
    pub tangential: f64,
    /// Power that space puts in as it is pressed together [W].
    pub strained: f64,
    /// Largest overlap over the sum of radii.
    pub worst_strain: f64,
}

row_of_fields!(ContactRates { damping: f64, driven: f64, tangential: f64, strained: f64, worst_strain: f64 });

impl ContactRates {
    /// Those of both.
    #[must_use]
    pub fn join(self, other: Self) -> Self {
        Self {
            damping: self.damping + other.damping,
            driven: self.driven + other.driven,
            tangential: self.tangential + other.tangential,
            strained: self.strained + other.strained,
            worst_strain: self.worst_strain.max(other.worst_strain),
        }
    }
}
