//! All laws that a scenario can choose from, and all pages: one line for each family, and for each law that is the only one
//! of its table.

use crate::acoustics::RayForce;
use crate::contact::{Bonds, Custom, Damping, Friction, Normal};
use crate::fields::near_field::NearFieldLaw;
use crate::fields::{Fields, NearField};
use crate::impact::{Cooling, Fragmentation, HeatBalance, Restitution, Tangential};
use crate::law::Entry;
use crate::pages::{OF_SINGLE_FILES, Page};

/// Laws by families.
const FAMILIES: &[&[Entry]] = &[
    Normal::LAWS,
    &[Custom::ENTRY],
    Damping::LAWS,
    Friction::LAWS,
    Bonds::LAWS,
    Fields::LAWS,
    NearFieldLaw::LAWS,
    Restitution::LAWS,
    &[Tangential::ENTRY, Fragmentation::ENTRY, HeatBalance::ENTRY, Cooling::ENTRY],
    RayForce::LAWS,
];

/// Their pages, and those of what else has one.
const PAGES: &[&[Page]] = &[
    Normal::PAGES,
    &[Custom::PAGE],
    Damping::PAGES,
    Friction::PAGES,
    Bonds::PAGES,
    Fields::PAGES,
    &[NearField::PAGE],
    NearFieldLaw::PAGES,
    Restitution::PAGES,
    &[Tangential::PAGE, Fragmentation::PAGE, HeatBalance::PAGE, Cooling::PAGE],
    RayForce::PAGES,
    OF_SINGLE_FILES,
];

/// All pages, in the order of the code.
pub fn pages() -> impl Iterator<Item = &'static Page> {
    PAGES.iter().copied().flatten()
}

/// All laws.
pub fn all() -> impl Iterator<Item = &'static Entry> {
    FAMILIES.iter().copied().flatten()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particles::property::PROPERTIES;

    /// A property that nothing reads could not be given at all.
    #[test]
    fn every_property_is_read_by_a_law() {
        for property in PROPERTIES {
            assert!(all().any(|law| law.reads.contains(property)), "{property:?} is read by no law");
        }
    }
}
