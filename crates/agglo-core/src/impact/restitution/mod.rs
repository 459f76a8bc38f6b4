//! Restitution: relative normal velocity after over before.

pub mod constant;
pub mod hardness;
mod law;

pub use law::{Rebound, RestitutionLaw};

family! {
    /// The closed set of laws of restitution.
    pub enum Restitution at "impact.restitution", pages in "impact/restitution", each by each_restitution ($) {
        Hardness in hardness: "From the pressure of the impact over the hardness, [B] 3.1.";
        Constant in constant: "The same for all impacts.";
    }
}

impl Restitution {
    /// Where the restitution comes from.
    pub fn rebound(&self) -> Rebound {
        each_restitution!(self, law => law.rebound())
    }

    /// The law of hardness, if it is that.
    pub fn hardness(&self) -> Option<&Hardness> {
        match self {
            Self::Hardness(law) => Some(law),
            Self::Constant(_) => None,
        }
    }
}
