//! The ledger: where energy and momentum came from and where they went, of soft and of hard spheres.
//!
//! What grains hold ([`Stored`]) is a function of the state. What flows ([`Flows`]) is added up, by channel: step by step with the
//! weights of the time stepping, or collision by collision. What the two leave unexplained is the drift, which the user
//! sees. A [`Balance`] is the ledger drawn up at one moment; [`entry`] declares what is told of it, in tables and summaries.
//!
//! Both engines keep the same ledger. Channels that an engine has no use for stay empty, and [`Entries`] says which are
//! told of.

mod balance;
pub mod entry;
mod flows;
mod named;
mod rates;
mod stored;

#[cfg(test)]
mod tests;

pub use balance::{Balance, Entries};
pub use entry::Entry;
pub use flows::{CollisionFlows, Flows};
pub use rates::{Correction, Rates, Supplies, Supply};
pub use stored::{Momentum, Stored};

use serde::{Deserialize, Serialize};

use crate::constants::BOLTZMANN;

/// Temperature [K] of the thermal energy below which no energy of a soft grain counts.
const ROOM_TEMPERATURE: f64 = 300.0;

/// What the spheres had when the ledger was opened.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Opening {
    /// Stored energy.
    pub stored: Stored,
    /// Momentum.
    pub momentum: Momentum,
    /// Sum of the sizes of the grains' momenta, without regard to direction [kg m/s].
    pub momentum_size: f64,
    /// Mass [kg].
    pub mass: f64,
}

/// The ledger of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Ledger {
    /// What there was at the start.
    pub start: Opening,
    /// Flows since the start.
    pub flows: Flows,
    /// Most energy so far [J] against which the drift of soft spheres is measured.
    pub scale: f64,
    /// Largest unexplained part at any look so far.
    pub worst: f64,
    entries: Entries,
}

impl Ledger {
    /// Opens the ledger of a number of soft grains. Energies below k T for each are rounding, to which no drift is compared.
    pub fn of_soft(start: Opening, grains: usize) -> Self {
        let scale = grains as f64 * BOLTZMANN * ROOM_TEMPERATURE;
        Self { start, scale, entries: Entries::Soft, ..Self::default() }
    }

    /// Opens the ledger of hard spheres.
    pub fn of_hard(start: Opening) -> Self {
        Self { start, entries: Entries::Hard, ..Self::default() }
    }

    /// Takes note of the energies now and returns what of them is not explained, over the most energy so far: the
    /// drift, and losses below zero, which would be gains from nothing. Not a number where the balance has an entry that
    /// is not finite.
    pub fn note(&mut self, stored: Stored) -> f64 {
        let balance = self.balance(stored, 0.0);
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
        let first = &self.start.stored;
        let at_start = first.kinetic
            + first.rotational
            + first.elastic.abs()
            + first.tangential_spring
            + first.bonds.abs()
            + first.near_field.abs()
            + first.fields.abs();
        let since = balance.rays.abs()
            + balance.gravity.abs()
            + balance.fields.abs()
            + balance.strained.abs()
            + balance.custom.abs()
            + balance.walls.abs()
            + balance.drag.abs()
            + (-balance.stored.elastic).max(0.0)
            + balance.stored.near_field.abs()
            + balance.stored.fields.abs();
        at_start.max(at_start + since - balance.drift.abs())
    }

    /// Draws up the balance of energy; `pending` is heat [J] given off since the last heating of each sphere, not yet in the flows.
    pub fn balance(&self, stored: Stored, pending: f64) -> Balance {
        let mut balance = Balance::of(self.entries, &self.start.stored, &self.flows, stored, pending);
        balance.drift_relative = match self.entries {
            // A ledger that is not opened, as while grains come to rest, has no scale.
            Entries::Soft => balance::over(balance.drift, self.scale.max(self.explained(&balance))),
            Entries::Hard => balance.drift_of_all(&self.start.stored),
        };
        balance
    }

    /// Momentum that impulses do not explain.
    pub fn momentum_drift(&self, momentum: &Momentum) -> Momentum {
        let impulse = self.flows.impulse();
        *momentum - self.start.momentum - impulse
    }

    /// Linear drift over what the grains' momenta come to without regard to direction, at the start or now
    /// (`size`), whichever is more.
    pub fn momentum_drift_relative(&self, momentum: &Momentum, size: f64) -> f64 {
        let drift = self.momentum_drift(momentum).linear.norm();
        let scale = self.start.momentum_size.max(size);
        if scale > 0.0 { drift / scale } else { 0.0 }
    }
}
