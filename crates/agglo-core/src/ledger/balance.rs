//! The ledger drawn up at one moment.

use serde::{Deserialize, Serialize};

use super::{Flows, Stored};

/// Heat from nothing below this part of all heat is rounding.
const ROUNDING: f64 = 1e-12;

/// Which entries are told of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Entries {
    /// Those of soft spheres.
    #[default]
    Soft,
    /// Those of hard spheres.
    Hard,
}

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
    /// Put in by the control volume as it was pressed together [J]; negative where it was drawn out.
    pub strained: f64,
    /// Put in by hooks and kicks, and by a formula of contact where it drives grains [J].
    pub custom: f64,
    /// Put in by walls that move [J].
    pub walls: f64,
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
    /// Carried off by grains that left [J].
    pub absorbed: f64,
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
        let custom = flows.supplies.hook.power + flows.driven;
        let walls = flows.supplies.walls.power;
        let lost = drag + flows.damping + rubbed + flows.bond_damping + flows.broken_bonds + flows.absorbed;
        let mechanical_at_start = start.mechanical();
        let after_collisions = mechanical_at_start - collisions.normal - collisions.tangential;
        let mechanical_drift = stored.mechanical()
            - after_collisions
            - (rays + gravity + fields + flows.strained + custom + walls - lost);
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
            strained: flows.strained,
            custom,
            walls,
            drag,
            damping: flows.damping,
            friction: rubbed + collisions.tangential,
            bond_damping: flows.bond_damping,
            broken_bonds: flows.broken_bonds,
            absorbed: flows.absorbed,
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

/// The part of a whole; 0 where there is none.
pub(super) fn over(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}
