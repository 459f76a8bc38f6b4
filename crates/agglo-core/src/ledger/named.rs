//! A balance in files: a map of its entries by their names.

use std::fmt;

use serde::de::{Error, IgnoredAny, MapAccess, Visitor};
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::balance::{Balance, Entries};

impl Serialize for Balance {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let entries = self.entries.all();
        let mut map = serializer.serialize_map(Some(entries.len()))?;
        entries.iter().try_for_each(|entry| map.serialize_entry(entry.name, &(entry.of)(self)))?;
        map.end()
    }
}

impl<'de> Deserialize<'de> for Balance {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(Named)
    }
}

/// Reads a balance from the names of its entries, whatever else there is.
struct Named;

impl<'de> Visitor<'de> for Named {
    type Value = Balance;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a map of the entries of a ledger")
    }

    fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<Balance, M::Error> {
        let is_known = |name: &str| [Entries::Soft, Entries::Hard].iter().any(|entries| has(*entries, name));
        let mut found: Vec<(String, f64)> = Vec::new();
        while let Some(name) = map.next_key::<String>()? {
            if is_known(&name) {
                found.push((name, map.next_value()?));
            } else {
                map.next_value::<IgnoredAny>()?;
            }
        }
        // Only one kind has heat.
        let is_hard = found.iter().any(|(name, _)| !has(Entries::Soft, name));
        let entries = if is_hard { Entries::Hard } else { Entries::Soft };
        let mut balance = Balance { entries, ..Balance::default() };
        for entry in entries.all() {
            let value = found.iter().find(|(name, _)| name == entry.name).map(|(_, value)| *value);
            (entry.put)(&mut balance, value.ok_or_else(|| M::Error::missing_field(entry.name))?);
        }
        Ok(balance)
    }
}

fn has(entries: Entries, name: &str) -> bool {
    entries.all().iter().any(|entry| entry.name == name)
}
