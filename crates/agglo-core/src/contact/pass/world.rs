//! What a pass over contacts is given, and what it adds up.

use crate::contact::bond::{Bonds, StrainBond};
use crate::contact::{ContactLaws, PairTable};
use crate::neighbors::PairList;
use crate::particles::{Motion, Particles};

/// What a pass needs to know besides the pairs.
pub struct ContactWorld<'a> {
    /// The grains' constant columns.
    pub grains: &'a Particles,
    /// Laws of contact, if any.
    pub laws: Option<&'a ContactLaws>,
    /// Bond law, of which only the one that acts in contact concerns this pass.
    pub bonds: Option<&'a Bonds>,
    /// Constants of pairs of materials.
    pub pairs: &'a PairTable,
    /// Candidate pairs.
    pub list: &'a PairList,
    /// Motion at the start of the step.
    pub before: Motion<'a>,
    /// Motion at which forces are wanted.
    pub now: Motion<'a>,
    /// Time between the two [s]: the step, or zero before the first.
    pub elapsed: f64,
    /// Length of the step [s], for laws that carry it.
    pub dt: f64,
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
    /// Largest overlap over the sum of radii, with the pair's grains.
    pub worst_strain: f64,
    /// The grains of that pair.
    pub worst_pair: [u32; 2],
}

impl ContactRates {
    pub(super) fn join(a: Self, b: Self) -> Self {
        let worst = if b.worst_strain > a.worst_strain { b } else { a };
        Self {
            damping: a.damping + b.damping,
            driven: a.driven + b.driven,
            tangential: a.tangential + b.tangential,
            ..worst
        }
    }
}
