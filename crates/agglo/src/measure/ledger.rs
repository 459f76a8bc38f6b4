//! The ledger: where energy and momentum came from and where they went.
//!
//! Stores (kinetic, elastic, bonds, near field) are functions of the state; flows (rays, gravity, fields in; drag,
//! dashpots, friction, broken bonds out) are added up step by step with the weights of the time stepping. What
//! stores and flows leave unexplained is the drift, a figure that the user sees.

use serde::{Deserialize, Serialize};

use crate::engine::soft::{Rates, Supplies, Supply};
use crate::math::Vec3;

/// Energy in the stores [J].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Stores {
    /// Kinetic energy of the centres' motion, added mass included.
    #[serde(rename = "kinetic_J")]
    pub kinetic: f64,
    /// Kinetic energy of spin.
    #[serde(rename = "spin_J")]
    pub spin: f64,
    /// Elastic energy of normal contact.
    #[serde(rename = "elastic_J")]
    pub elastic: f64,
    /// Energy of tangential springs in contacts.
    #[serde(rename = "tangential_spring_J")]
    pub tangential_spring: f64,
    /// Elastic energy of bonds.
    #[serde(rename = "bonds_J")]
    pub bonds: f64,
    /// Potential energy of the near field.
    #[serde(rename = "near_field_J")]
    pub near_field: f64,
}

impl Stores {
    /// All together [J].
    pub fn total(&self) -> f64 {
        self.kinetic + self.spin + self.elastic + self.tangential_spring + self.bonds + self.near_field
    }
}

/// Linear and angular momentum about the origin.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Momentum {
    /// Linear [kg m/s].
    pub linear: Vec3,
    /// Angular [kg m²/s].
    pub angular: Vec3,
}

/// What flowed in or out since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Flows {
    /// Rays: energy put in [J], impulse [N s] and its moment.
    pub rays: Supply,
    /// Drag, gravity, fields: energy put in [J], impulse [N s] and its moment.
    pub supplies: Supplies,
    /// Lost in contact dashpots [J].
    pub damping: f64,
    /// Taken from the motion by friction and tangential springs [J].
    pub tangential: f64,
    /// Lost in the dashpots of bonds [J].
    pub bond_damping: f64,
    /// Released by bonds that broke [J], put in by bonds that were made counting negative.
    pub broken_bonds: f64,
}

impl Flows {
    /// Adds the flow of a step of `dt` [s] with rates at both ends, `phi` being the weight of its end.
    pub fn add_step(&mut self, before: &Rates, after: &Rates, phi: f64, dt: f64) {
        let (early, late) = ((1.0 - phi) * dt, phi * dt);
        let sum = |a: f64, b: f64| early * a + late * b;
        self.damping += sum(before.damping, after.damping);
        self.tangential += sum(before.tangential, after.tangential);
        self.bond_damping += sum(before.bond_damping, after.bond_damping);
        let (old, new, own) = (&before.supplies, &after.supplies, &mut self.supplies);
        own.drag = own.drag.plus(old.drag, early).plus(new.drag, late);
        own.gravity = own.gravity.plus(old.gravity, early).plus(new.gravity, late);
        own.field = own.field.plus(old.field, early).plus(new.field, late);
    }

    fn impulse(&self) -> Supply {
        self.rays + self.supplies.drag + self.supplies.gravity + self.supplies.field
    }
}

/// The ledger of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Ledger {
    /// Stores at the start.
    pub stores_at_start: Stores,
    /// Momentum at the start.
    pub momentum_at_start: Momentum,
    /// Flows since the start.
    pub flows: Flows,
    /// Sum of the grains' momenta at the start, without regard to direction [kg m/s].
    pub momentum_size_at_start: f64,
}

/// The ledger drawn up at one moment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Balance {
    /// Stores now.
    #[serde(flatten)]
    pub stores: Stores,
    /// Stores at the start, all together [J].
    #[serde(rename = "at_start_J")]
    pub at_start: f64,
    /// Work of rays [J].
    #[serde(rename = "work_rays_J")]
    pub rays: f64,
    /// Work of gravity and buoyancy [J].
    #[serde(rename = "work_gravity_J")]
    pub gravity: f64,
    /// Work of electric and magnetic fields [J].
    #[serde(rename = "work_fields_J")]
    pub fields: f64,
    /// Lost to drag [J]; negative where the medium drives the grains.
    #[serde(rename = "lost_drag_J")]
    pub drag: f64,
    /// Lost in contact dashpots [J].
    #[serde(rename = "lost_contact_damping_J")]
    pub damping: f64,
    /// Lost to friction [J].
    #[serde(rename = "lost_friction_J")]
    pub friction: f64,
    /// Lost in the dashpots of bonds [J].
    #[serde(rename = "lost_bond_damping_J")]
    pub bond_damping: f64,
    /// Lost with broken bonds [J].
    #[serde(rename = "lost_broken_bonds_J")]
    pub broken_bonds: f64,
    /// What is not explained [J].
    #[serde(rename = "drift_J")]
    pub drift: f64,
    /// The drift over all energy that was there or came in.
    pub drift_relative: f64,
}

impl Ledger {
    /// Opens the ledger.
    pub fn open(stores: Stores, momentum: Momentum, momentum_size: f64) -> Self {
        Self {
            stores_at_start: stores,
            momentum_at_start: momentum,
            momentum_size_at_start: momentum_size,
            ..Self::default()
        }
    }

    /// Draws up the balance of energy.
    pub fn balance(&self, stores: Stores) -> Balance {
        let flows = &self.flows;
        let at_start = self.stores_at_start.total();
        // What tangential forces took is either in springs still or lost.
        let friction = flows.tangential - (stores.tangential_spring - self.stores_at_start.tangential_spring);
        let drag = 0.0 - flows.supplies.drag.power;
        let (gravity, fields) = (flows.supplies.gravity.power, flows.supplies.field.power);
        let lost = drag + flows.damping + friction + flows.bond_damping + flows.broken_bonds;
        let drift = stores.total() - at_start - (flows.rays.power + gravity + fields - lost);
        let first = &self.stores_at_start;
        let scale = first.kinetic
            + first.spin
            + first.elastic
            + first.bonds.abs()
            + first.near_field.abs()
            + flows.rays.power.abs()
            + gravity.abs()
            + fields.abs()
            + drag.abs()
            + stores.near_field.abs();
        Balance {
            stores,
            at_start,
            rays: flows.rays.power,
            gravity,
            fields,
            drag,
            damping: flows.damping,
            friction,
            bond_damping: flows.bond_damping,
            broken_bonds: flows.broken_bonds,
            drift,
            drift_relative: if scale > 0.0 { drift / scale } else { 0.0 },
        }
    }

    /// Momentum that impulses do not explain, linear [kg m/s] and angular [kg m²/s].
    pub fn momentum_drift(&self, momentum: &Momentum) -> Momentum {
        let impulse = self.flows.impulse();
        Momentum {
            linear: momentum.linear - self.momentum_at_start.linear - impulse.force,
            angular: momentum.angular - self.momentum_at_start.angular - impulse.moment,
        }
    }

    /// Linear drift over what the grains' momenta come to without regard to direction, at the start or now
    /// (`size`), whichever is more.
    pub fn momentum_drift_relative(&self, momentum: &Momentum, size: f64) -> f64 {
        let drift = self.momentum_drift(momentum).linear.norm();
        let scale = self.momentum_size_at_start.max(size);
        if scale > 0.0 { drift / scale } else { 0.0 }
    }
}
