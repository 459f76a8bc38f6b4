//! What is told of the ledger: an entry is declared once, with its name in tables and summaries, what people call it, what it
//! means, and how it is taken from the balance.

use super::balance::{Balance, Entries};

/// An entry of the balance.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Its name in files, which ends with its unit: `kinetic_J`.
    pub name: &'static str,
    /// Its unit; empty for parts of a whole.
    pub unit: &'static str,
    /// What people call it.
    pub label: &'static str,
    /// What there is to be said besides; may be empty.
    pub meaning: &'static str,
    /// How it is taken from the balance.
    pub of: fn(&Balance) -> f64,
    /// How it is put into one that is read from a file.
    pub(super) put: fn(&mut Balance, f64),
}

impl Balance {
    /// Whether every entry is a number.
    pub fn is_finite(&self) -> bool {
        self.entries.all().iter().all(|entry| (entry.of)(self).is_finite())
    }
}

impl Entries {
    /// The entries, in the order in which they are told.
    pub fn all(self) -> &'static [Entry] {
        match self {
            Self::Soft => soft::ALL,
            Self::Hard => hard::ALL,
        }
    }
}

macro_rules! entries {
    ($($constant:ident = $($field:ident).+, $name:literal, $unit:literal, $label:literal, $meaning:literal;)+) => {
        use super::Entry;

        $(
            #[doc = concat!("`", $name, "`: ", $label, ".")]
            pub const $constant: Entry = Entry {
                name: $name,
                unit: $unit,
                label: $label,
                meaning: $meaning,
                of: |balance| balance.$($field).+,
                put: |balance, value| balance.$($field).+ = value,
            };
        )+

        /// All, in the order in which they are told.
        pub const ALL: &[Entry] = &[$($constant),+];
    };
}

/// Entries of soft spheres.
#[rustfmt::skip]
pub mod soft {
    entries! {
        KINETIC = stored.kinetic, "kinetic_J", "J", "kinetic energy", "of centers, added mass included";
        ROTATIONAL = stored.rotational, "rotational_J", "J", "rotational energy", "";
        ELASTIC = stored.elastic, "elastic_J", "J", "elastic energy", "in contacts, along the normal";
        TANGENTIAL_SPRING = stored.tangential_spring, "tangential_spring_J", "J", "energy of tangential springs", "in contacts";
        BONDS = stored.bonds, "bonds_J", "J", "energy of bonds", "elastic; negative for `strain_bond`";
        NEAR_FIELD = stored.near_field, "near_field_J", "J", "energy of the near field", "potential";
        FIELD_ENERGY = stored.fields, "fields_J", "J", "energy in fields", "potential, of fields whose energy is given";
        AT_START = mechanical_at_start, "at_start_J", "J", "energy at the start", "all that was held";
        RAYS = rays, "work_rays_J", "J", "put in by rays", "since the start";
        GRAVITY = gravity, "work_gravity_J", "J", "put in by gravity", "since the start";
        FIELDS = fields, "work_fields_J", "J", "put in by fields", "since the start";
        STRAINED = strained, "work_volume_J", "J", "put in by the volume", "as it was pressed together, since the start; negative where it was drawn out";
        CUSTOM = custom, "work_custom_J", "J", "put in by custom laws", "by hooks and kicks, and by `contact.custom` where it drives grains, since the start";
        WALLS = walls, "work_walls_J", "J", "put in by walls", "by those that move, since the start; negative where grains drive them";
        DRAG = drag, "lost_drag_J", "J", "lost to drag", "since the start; negative where the medium drives the grains";
        DAMPING = damping, "lost_contact_damping_J", "J", "lost in contacts", "in their dashpots, since the start";
        FRICTION = friction, "lost_friction_J", "J", "lost to friction", "since the start";
        BOND_DAMPING = bond_damping, "lost_bond_damping_J", "J", "lost in bonds", "in their dashpots, since the start";
        BROKEN_BONDS = broken_bonds, "lost_broken_bonds_J", "J", "lost with broken bonds", "since the start";
        ABSORBED = absorbed, "lost_absorbed_J", "J", "lost with grains that left", "through absorbing faces, since the start";
        DRIFT = drift, "drift_J", "J", "not explained", "by the stores and the channels";
        DRIFT_RELATIVE = drift_relative, "drift_relative", "", "energy drift", "over the most energy so far that was there or came in and is explained";
    }
}

/// Entries of hard spheres.
#[rustfmt::skip]
pub mod hard {
    entries! {
        KINETIC = stored.kinetic, "kinetic_J", "J", "kinetic energy", "now";
        THERMAL = stored.thermal, "thermal_J", "J", "thermal energy", "m C T, now";
        KINETIC_AT_START = mechanical_at_start, "kinetic_at_start_J", "J", "kinetic energy at the start", "";
        THERMAL_AT_START = thermal_at_start, "thermal_at_start_J", "J", "thermal energy at the start", "";
        NORMAL = normal, "lost_normal_J", "J", "lost along the normal", "kinetic energy lost in impacts since the start";
        FRICTION = friction, "lost_friction_J", "J", "lost to friction", "kinetic energy lost across the normals since the start";
        REACTION = reaction, "reaction_J", "J", "set free by reactions", "since the start";
        SURFACE = surface, "surface_J", "J", "new surfaces", "their energy";
        HEAT = heat, "heat_J", "J", "heat of impacts", "in the consistent balance what was lost, plus `reaction_J`, less `surface_J`";
        UNBALANCED = unbalanced, "unbalanced_J", "J", "heat from nowhere", "made out of nothing by a published sum, round-off in the consistent balance; the drift leaves it out, and the closing table has it as \"false heat\"";
        COOLED = cooled, "cooled_J", "J", "given off", "heat given to gas and surroundings";
        KINETIC_DRIFT_RELATIVE = kinetic_drift_relative, "kinetic_drift_relative", "", "drift of kinetic energy", "what losses do not explain, over that at the start";
        DRIFT = drift, "drift_J", "J", "not explained", "energy of all kinds";
        DRIFT_RELATIVE = drift_relative, "drift_relative", "", "energy drift", "`drift_J` over all energy that was there or came in";
    }
}
