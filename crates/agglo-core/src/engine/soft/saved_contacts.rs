//! Contacts in a saved state, known by the ids of their grains.

use std::borrow::Cow;

use serde::ser::{SerializeSeq, Serializer};
use serde::{Deserialize, Deserializer, Serialize};

use crate::contact::pass::{Contacts, Remembered};
use crate::neighbors::PairList;
use crate::particles::ById;

/// Contacts and what they remember: told one by one from where they are kept, or all at hand.
#[derive(Clone, Debug)]
pub(super) enum SavedContacts<'a> {
    /// Of a simulation, whose grains have these ids.
    Kept { contacts: &'a Contacts, list: &'a PairList, ids: &'a [u32] },
    /// By the ids of the grains.
    AtHand(Vec<Remembered>),
}

impl SavedContacts<'_> {
    /// All of them, by the ids of the grains.
    pub fn by_ids(&self) -> Cow<'_, [Remembered]> {
        match self {
            Self::AtHand(contacts) => Cow::Borrowed(contacts),
            Self::Kept { contacts, list, ids } => {
                contacts.remembered(list).map(|contact| named(contact, ids)).collect()
            }
        }
    }

    /// All of them, by the places of the grains; nothing of grains that are not there.
    pub fn by_places(self, places: &ById) -> Vec<Remembered> {
        let mut contacts = match self {
            Self::AtHand(contacts) => contacts,
            kept @ Self::Kept { .. } => kept.by_ids().into_owned(),
        };
        contacts.retain_mut(|(a, b, _)| {
            let [found, other] = [*a, *b].map(|id| places.find(id));
            let (Some(found), Some(other)) = (found, other) else { return false };
            (*a, *b) = (found as u32, other as u32);
            true
        });
        contacts
    }
}

fn named((a, b, spring): Remembered, ids: &[u32]) -> Remembered {
    (ids[a as usize], ids[b as usize], spring)
}

impl Serialize for SavedContacts<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::AtHand(contacts) => contacts.serialize(serializer),
            Self::Kept { contacts, list, ids } => {
                // A second list of them would take as much memory again as the grains.
                let mut sequence = serializer.serialize_seq(Some(contacts.remembered(list).count()))?;
                contacts
                    .remembered(list)
                    .try_for_each(|contact| sequence.serialize_element(&named(contact, ids)))?;
                sequence.end()
            }
        }
    }
}

impl<'de> Deserialize<'de> for SavedContacts<'_> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Vec::deserialize(deserializer).map(Self::AtHand)
    }
}
