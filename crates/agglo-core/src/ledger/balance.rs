//! The ledger drawn up at one moment.

use std::fmt;

use serde::de::{Error, IgnoredAny, MapAccess, Visitor};
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{Entries, Flows, Stored};

/// Heat from nothing below this part of all heat is rounding.
const ROUNDING: f64 = 1e-12;

/// The ledger drawn up at one moment. In files it is a map of its [`Entries`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Balance {
    /// Which entries are told of.
    pub entries: Entries,
    /// Stored energy now.
    pub stored: Stored,
    /// Stored energy at the start but for heat [J].
    pub mechanical_at_start: f64,
    /// Thermal energy at the start [J].
    pub thermal_at_start: f64,
    /// Work of rays [J].
    pub rays: f64,
    /// Work of gravity and buoyancy [J].
    pub gravity: f64,
    /// Work of electric and magnetic fields [J].
    pub fields: f64,
    /// Lost to drag [J]; negative where the medium drives the grains.
    pub drag: f64,
    /// Lost in contact dashpots [J].
    pub damping: f64,
    /// Lost to friction, or across the normals of collisions [J].
    pub friction: f64,
    /// Lost in the dashpots of bonds [J].
    pub bond_damping: f64,
    /// Lost with broken bonds [J].
    pub broken_bonds: f64,
    /// Lost along the normals of collisions [J].
    pub normal: f64,
    /// Heat of reactions [J].
    pub reaction: f64,
    /// Energy of new surfaces [J].
    pub surface: f64,
    /// Heat of collisions [J].
    pub heat: f64,
    /// Heat that a published sum made out of nothing [J]; 0 in the consistent balance.
    pub unbalanced: f64,
    /// Heat given to gas and surroundings [J].
    pub cooled: f64,
    /// Mechanical energy that flows do not explain, over that at the start; 0 where there was none.
    pub kinetic_drift_relative: f64,
    /// Energy of all kinds that flows do not explain [J].
    pub drift: f64,
    /// The same over the energy that was there or came in.
    pub drift_relative: f64,
}

impl Balance {
    /// Draws up all but the relative drift.
    pub(super) fn of(entries: Entries, start: &Stored, flows: &Flows, stored: Stored, pending: f64) -> Self {
        let collisions = flows.collisions.total();
        // What tangential forces took is either in springs still or lost.
        let rubbed = flows.tangential - (stored.tangential_spring - start.tangential_spring);
        let drag = 0.0 - flows.supplies.drag.power;
        let (rays, gravity, fields) =
            (flows.rays.power, flows.supplies.gravity.power, flows.supplies.field.power);
        let lost = drag + flows.damping + rubbed + flows.bond_damping + flows.broken_bonds;
        let mechanical_at_start = start.mechanical();
        let after_collisions = mechanical_at_start - collisions.normal - collisions.tangential;
        let mechanical_drift = stored.mechanical() - after_collisions - (rays + gravity + fields - lost);
        let cooled = flows.cooled + pending;
        let thermal_drift =
            stored.thermal - (start.thermal + collisions.heat - flows.unkept.value() - cooled);
        let made = collisions.normal + collisions.tangential + collisions.reaction - collisions.surface;
        Self {
            entries,
            stored,
            mechanical_at_start,
            thermal_at_start: start.thermal,
            rays,
            gravity,
            fields,
            drag,
            damping: flows.damping,
            friction: rubbed + collisions.tangential,
            bond_damping: flows.bond_damping,
            broken_bonds: flows.broken_bonds,
            normal: collisions.normal,
            reaction: collisions.reaction,
            surface: collisions.surface,
            heat: collisions.heat,
            unbalanced: collisions.heat - made,
            cooled,
            kinetic_drift_relative: over(mechanical_drift, mechanical_at_start),
            drift: mechanical_drift + thermal_drift,
            drift_relative: 0.0,
        }
    }

    /// The drift of hard spheres over all energy that was there or came in, that from nothing included.
    pub(super) fn drift_of_all(&self, start: &Stored) -> f64 {
        let all = start.kinetic + start.thermal + self.reaction + self.unbalanced.max(0.0);
        over(self.drift, all)
    }

    /// Whether every entry is a number.
    pub fn is_finite(&self) -> bool {
        self.entries.all().iter().all(|entry| (entry.of)(self).is_finite())
    }

    /// The larger of the drifts of motion and of all energy, without its sign.
    pub fn unexplained(&self) -> f64 {
        self.drift_relative.abs().max(self.kinetic_drift_relative.abs())
    }

    /// Heat that collisions made out of nothing, over the motion that they took; below zero where heat was lost. Nothing
    /// where it is no more than rounding.
    pub fn false_heat(&self) -> Option<f64> {
        let all = self.heat.abs() + self.reaction + self.surface;
        let taken = self.normal + self.friction;
        (self.unbalanced.abs() > ROUNDING * all && taken > 0.0).then(|| self.unbalanced / taken)
    }
}

fn over(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}

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
