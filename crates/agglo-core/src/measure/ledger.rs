//! The ledger: where energy and momentum came from and where they went.
//!
//! Stored energies (kinetic, elastic, bonds, near field) are functions of the state; flows (rays, gravity, fields in; drag,
//! dashpots, friction, broken bonds out) are added up step by step with the weights of the time stepping. What
//! they and flows leave unexplained is the drift, a figure that the user sees.

use serde::{Deserialize, Serialize};

use crate::constants::BOLTZMANN;
use crate::engine::soft::{Rates, Supplies, Supply};
use crate::math::Vec3;

/// Energy that the grains hold [J].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StoredEnergy {
    /// Kinetic energy of the centers' motion, added mass included.
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

impl StoredEnergy {
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
    /// Rays: energy put in [J], impulse [N s] and angular impulse [N m s].
    pub rays: Supply,
    /// Drag, gravity, fields: energy put in [J], impulse [N s] and angular impulse [N m s].
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
    ///
    /// Drag is solved for and may change much within a step. It is booked as its mean force on the mean velocity, as the
    /// step works with it: the mean of the powers less phi (1 - phi) ΔF · Δv.
    pub fn add_step(&mut self, before: &Rates, after: &Rates, phi: f64, dt: f64) {
        let (early, late) = ((1.0 - phi) * dt, phi * dt);
        let sum = |a: f64, b: f64| early * a + late * b;
        self.damping += sum(before.damping, after.damping);
        self.tangential += sum(before.tangential, after.tangential);
        self.bond_damping += sum(before.bond_damping, after.bond_damping);
        let (old, new, own) = (&before.supplies, &after.supplies, &mut self.supplies);
        own.drag = own.drag.plus(old.drag, early).plus(new.drag, late);
        own.drag.power += early * phi * after.bend;
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
    /// Stored energy at the start.
    pub stored_at_start: StoredEnergy,
    /// Momentum at the start.
    pub momentum_at_start: Momentum,
    /// Flows since the start.
    pub flows: Flows,
    /// Sum of the grains' momenta at the start, without regard to direction [kg m/s].
    pub momentum_size_at_start: f64,
    /// Most energy so far [J] against which the drift is measured.
    pub scale: f64,
    /// Largest unexplained part so far.
    pub worst: f64,
}

/// The ledger drawn up at one moment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Balance {
    /// Stored energy now.
    #[serde(flatten)]
    pub stored: StoredEnergy,
    /// Stored energy at the start, all together [J].
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
    /// The drift over the most energy so far that was there or came in and is explained.
    pub drift_relative: f64,
}

impl Balance {
    /// Whether every entry is a number. Each enters the drift, and none that is not finite can leave it finite.
    pub fn is_finite(&self) -> bool {
        self.drift.is_finite() && self.stored.total().is_finite()
    }
}

/// Temperature [K] of the thermal energy below which no energy of a grain counts.
const ROOM_TEMPERATURE: f64 = 300.0;

impl Ledger {
    /// Opens the ledger on a number of grains. Energies below k T for each are rounding, to which no drift is compared.
    pub fn open(stored: StoredEnergy, momentum: Momentum, momentum_size: f64, grains: usize) -> Self {
        Self {
            stored_at_start: stored,
            momentum_at_start: momentum,
            momentum_size_at_start: momentum_size,
            scale: grains as f64 * BOLTZMANN * ROOM_TEMPERATURE,
            ..Self::default()
        }
    }

    /// Takes note of the energies now and returns what of them is not explained, over the most energy so far: the
    /// drift, and losses below zero, which would be gains from nothing. Not a number where the balance has an entry that
    /// is not finite.
    pub fn note(&mut self, stored: StoredEnergy) -> f64 {
        let balance = self.balance(stored);
        if !balance.is_finite() {
            return f64::NAN;
        }
        self.scale = self.scale.max(self.explained(&balance));
        let gained = [balance.damping, balance.friction, balance.bond_damping].map(|lost| (-lost).max(0.0));
        let unexplained = balance.drift.abs() + gained.iter().sum::<f64>();
        let part = if unexplained > 0.0 { unexplained / self.scale } else { unexplained };
        self.worst = self.worst.max(part);
        part
    }

    /// Energy [J] that was there or came in and is explained. What a wrong step makes shows in the drift, and does not
    /// count: neither motion that came from nothing nor the drag that it then has.
    fn explained(&self, balance: &Balance) -> f64 {
        let first = &self.stored_at_start;
        let at_start = first.kinetic
            + first.spin
            + first.elastic
            + first.tangential_spring
            + first.bonds.abs()
            + first.near_field.abs();
        let since = balance.rays.abs()
            + balance.gravity.abs()
            + balance.fields.abs()
            + balance.drag.abs()
            + balance.stored.near_field.abs();
        at_start.max(at_start + since - balance.drift.abs())
    }

    /// Draws up the balance of energy.
    pub fn balance(&self, stored: StoredEnergy) -> Balance {
        let flows = &self.flows;
        let at_start = self.stored_at_start.total();
        // What tangential forces took is either in springs still or lost.
        let friction = flows.tangential - (stored.tangential_spring - self.stored_at_start.tangential_spring);
        let drag = 0.0 - flows.supplies.drag.power;
        let (gravity, fields) = (flows.supplies.gravity.power, flows.supplies.field.power);
        let lost = drag + flows.damping + friction + flows.bond_damping + flows.broken_bonds;
        let drift = stored.total() - at_start - (flows.rays.power + gravity + fields - lost);
        let mut balance = Balance {
            stored,
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
            drift_relative: 0.0,
        };
        let scale = self.scale.max(self.explained(&balance));
        if drift != 0.0 {
            balance.drift_relative = drift / scale;
        }
        balance
    }

    /// Momentum that impulses do not explain, linear [kg m/s] and angular [kg m²/s].
    pub fn momentum_drift(&self, momentum: &Momentum) -> Momentum {
        let impulse = self.flows.impulse();
        Momentum {
            linear: momentum.linear - self.momentum_at_start.linear - impulse.force,
            angular: momentum.angular - self.momentum_at_start.angular - impulse.torque,
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

#[cfg(test)]
mod tests {
    use super::*;

    fn opened(kinetic: f64) -> Ledger {
        Ledger::open(StoredEnergy { kinetic, ..StoredEnergy::default() }, Momentum::default(), 0.0, 2)
    }

    /// 1 J at the start. Motion of 1000 J out of nothing, and drag of another 1000 J that it had: 2000 times all
    /// energy, whichever entry it hides in.
    #[test]
    fn an_error_does_not_grow_its_own_scale() {
        let mut ledger = opened(1.0);
        ledger.flows.supplies.drag.power = -1000.0;
        let exploded = StoredEnergy { kinetic: 1001.0, ..StoredEnergy::default() };
        assert_eq!(ledger.balance(exploded).drift_relative, 2000.0);
        assert_eq!(ledger.note(exploded), 2000.0);
        let mut ledger = opened(1.0);
        assert_eq!(
            ledger.note(StoredEnergy { kinetic: 1.0, near_field: -500.0, ..StoredEnergy::default() }),
            500.0
        );
        assert_eq!(ledger.worst, 500.0);
    }

    /// Energy that came in and is explained counts, also when it has gone again.
    #[test]
    fn the_scale_is_the_most_energy_so_far() {
        let mut ledger = opened(0.0);
        ledger.flows.supplies.gravity.power = 8.0;
        assert_eq!(ledger.note(StoredEnergy { kinetic: 8.0, ..StoredEnergy::default() }), 0.0);
        ledger.flows.supplies.gravity.power = 0.0;
        assert_eq!(ledger.note(StoredEnergy { kinetic: 0.04, ..StoredEnergy::default() }), 0.005);
    }

    /// A dashpot that gives is as wrong as motion from nothing: 2 J of 4 J, though the sums agree.
    #[test]
    fn losses_below_zero_are_gains_from_nothing() {
        let mut ledger = opened(4.0);
        ledger.flows.damping = -2.0;
        assert_eq!(ledger.note(StoredEnergy { kinetic: 6.0, ..StoredEnergy::default() }), 0.5);
    }

    /// Whichever entry is spoiled: the balance is not finite, and neither is what is noted of it.
    #[test]
    fn what_is_not_finite_is_never_perfect() {
        type Spoil = fn(&mut Ledger, &mut StoredEnergy, f64);
        let entries: [Spoil; 13] = [
            |_, stored, bad| stored.kinetic = bad,
            |_, stored, bad| stored.spin = bad,
            |_, stored, bad| stored.elastic = bad,
            |_, stored, bad| stored.tangential_spring = bad,
            |_, stored, bad| stored.bonds = bad,
            |_, stored, bad| stored.near_field = bad,
            |ledger, _, bad| ledger.flows.rays.power = bad,
            |ledger, _, bad| ledger.flows.supplies.gravity.power = bad,
            |ledger, _, bad| ledger.flows.supplies.drag.power = bad,
            |ledger, _, bad| ledger.flows.supplies.field.power = bad,
            |ledger, _, bad| ledger.flows.damping = bad,
            |ledger, _, bad| ledger.flows.tangential = bad,
            |ledger, _, bad| ledger.flows.broken_bonds = bad,
        ];
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for (entry, spoil) in entries.iter().enumerate() {
                let (mut ledger, mut stored) =
                    (opened(1.0), StoredEnergy { kinetic: 1.0, ..StoredEnergy::default() });
                spoil(&mut ledger, &mut stored, bad);
                assert!(!ledger.balance(stored).is_finite(), "entry {entry}, {bad}");
                assert!(ledger.note(stored).is_nan(), "entry {entry}, {bad}");
            }
        }
    }

    /// Rounding of a system at rest is far below k T for each grain.
    #[test]
    fn rest_is_no_alarm() {
        let mut ledger = opened(0.0);
        assert_eq!(ledger.note(StoredEnergy::default()), 0.0);
        assert_below!(ledger.note(StoredEnergy { elastic: 1e-29, ..StoredEnergy::default() }), 1e-8);
    }
}
