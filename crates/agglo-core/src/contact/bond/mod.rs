//! What holds grains together.

mod beam;
mod strain_bond;

pub use beam::{BeamLoad, BeamPair, BeamState, Break};

family! {
    /// The closed set of bond laws.
    pub enum Bonds at "bonds", pages in "contact/bond", each by each_bond ($) {
        StrainBond in strain_bond: "The paper's bond (Zohdi 2016, eqs 25-26), which acts in contact only and cannot resist tension.";
        Beam in beam: "Parallel-bond beam (Potyondy and Cundall 2004).";
    }
}

impl Bonds {
    /// The law, if it acts between overlapping grains and remembers nothing.
    #[inline]
    pub fn in_contact(&self) -> Option<&StrainBond> {
        match self {
            Self::StrainBond(law) => Some(law),
            Self::Beam(_) => None,
        }
    }

    /// The law, if it holds grains together from when they are bonded until they break apart.
    #[inline]
    pub fn lasting(&self) -> Option<&Beam> {
        match self {
            Self::Beam(law) => Some(law),
            Self::StrainBond(_) => None,
        }
    }
}
