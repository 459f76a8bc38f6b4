//! Energy, momentum and counts of hard spheres since the start.

use serde::{Deserialize, Serialize};

use crate::engine::hard::spheres::Spheres;
use crate::engine::validate::{Fault, MOST_COUNTED, ensure};
use crate::impact::ImpactEnergy;
use crate::math::Vec3;

/// What happened since the start.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Counts {
    /// Collisions.
    pub collisions: u64,
    /// Of these, bounces.
    pub bounces: u64,
    /// Merges.
    pub merges: u64,
    /// Agglomerates that broke.
    pub fragmentations: u64,
    /// Bounces that were made elastic, since their pair had bounced again and again just before.
    pub guarded: u64,
    /// Merges, and collisions in which one or both partners broke: lines of the table of events.
    pub events: u64,
    /// Agglomerates that did not break since there was no room for the fragments.
    pub no_room: u64,
    /// Collisions of spheres that overlapped: after a merge, or a step, or at a face.
    pub overlapping: u64,
    /// Bounces off walls.
    pub walls: u64,
    /// Iterations of all coupled solves.
    pub iterations: u64,
    /// Most iterations of one solve.
    pub most_iterations: u32,
    /// Solves that did not end within their tolerance.
    pub not_converged: u64,
}

impl Counts {
    /// Whether none is about to overflow.
    ///
    /// # Errors
    /// That one is.
    pub(in crate::engine::hard) fn validate(&self) -> Result<(), Fault> {
        let Self { collisions, bounces, merges, fragmentations, guarded, events, no_room, .. } = *self;
        let Self { overlapping, walls, iterations, not_converged, .. } = *self;
        let counts = [collisions, bounces, merges, fragmentations, guarded, events, no_room];
        let others = [overlapping, walls, iterations, not_converged];
        let holds = counts.iter().chain(&others).all(|count| *count < MOST_COUNTED);
        ensure(holds, || "a count is too large".to_owned())
    }
}

/// Energy of the spheres [J].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SphereEnergy {
    /// Kinetic energy.
    #[serde(rename = "kinetic_J")]
    pub kinetic: f64,
    /// Thermal energy m C T.
    #[serde(rename = "thermal_J")]
    pub thermal: f64,
}

/// Flows of energy and momentum since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Flows {
    /// Of all collisions.
    pub collisions: ImpactEnergy,
    /// Heat of collisions that bodies without heat capacity could not keep [J].
    pub unkept: f64,
    /// Heat given to gas and surroundings [J].
    pub cooled: f64,
    /// Momentum from walls [kg m/s].
    pub walls: Vec3,
    /// Kinetic energy that bounces would have lost that were made elastic, each counted by itself [J].
    pub kept: f64,
}

/// The ledger of hard spheres.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct HardLedger {
    /// Stored energy at the start.
    pub stored_at_start: SphereEnergy,
    /// Momentum at the start [kg m/s].
    pub momentum_at_start: Vec3,
    /// Sum of the momenta's sizes at the start [kg m/s].
    pub momentum_size_at_start: f64,
    /// Mass at the start [kg].
    pub mass_at_start: f64,
    /// Flows since.
    pub flows: Flows,
    /// What rounding left out of the sums over collisions so far.
    left_out: ImpactEnergy,
    unkept_left_out: f64,
}

/// The ledger drawn up at one moment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Balance {
    /// Stored energy now.
    #[serde(flatten)]
    pub stored: SphereEnergy,
    /// Kinetic energy at the start [J].
    #[serde(rename = "kinetic_at_start_J")]
    pub kinetic_at_start: f64,
    /// Thermal energy at the start [J].
    #[serde(rename = "thermal_at_start_J")]
    pub thermal_at_start: f64,
    /// Kinetic energy lost along the normals [J].
    #[serde(rename = "lost_normal_J")]
    pub normal: f64,
    /// Kinetic energy lost to friction [J].
    #[serde(rename = "lost_friction_J")]
    pub tangential: f64,
    /// Heat of reactions [J].
    #[serde(rename = "reaction_J")]
    pub reaction: f64,
    /// Energy of new surfaces [J].
    #[serde(rename = "surface_J")]
    pub surface: f64,
    /// Heat of collisions [J].
    #[serde(rename = "heat_J")]
    pub heat: f64,
    /// Heat that a published sum made out of nothing [J]; 0 in the consistent balance.
    #[serde(rename = "unbalanced_J")]
    pub unbalanced: f64,
    /// Heat given to gas and surroundings [J].
    #[serde(rename = "cooled_J")]
    pub cooled: f64,
    /// Kinetic energy that losses do not explain, over that at the start.
    pub kinetic_drift_relative: f64,
    /// Energy of all kinds that flows do not explain [J].
    #[serde(rename = "drift_J")]
    pub drift: f64,
    /// The same over all energy that was there or came in.
    pub drift_relative: f64,
}

/// Heat from nothing below this part of all heat is rounding.
const ROUNDING: f64 = 1e-12;

impl Balance {
    /// Whether every entry is a number.
    pub fn is_finite(&self) -> bool {
        let entries = [
            self.stored.kinetic,
            self.stored.thermal,
            self.normal,
            self.tangential,
            self.reaction,
            self.surface,
            self.heat,
            self.unbalanced,
            self.cooled,
            self.kinetic_drift_relative,
            self.drift,
            self.drift_relative,
        ];
        entries.iter().all(|entry| entry.is_finite())
    }

    /// The larger of the two drifts, without its sign.
    pub fn unexplained(&self) -> f64 {
        self.drift_relative.abs().max(self.kinetic_drift_relative.abs())
    }

    /// Heat that collisions made out of nothing, over the motion that they took; below zero where heat was lost. Nothing
    /// where it is no more than rounding.
    pub fn false_heat(&self) -> Option<f64> {
        let all = self.heat.abs() + self.reaction + self.surface;
        let taken = self.normal + self.tangential;
        (self.unbalanced.abs() > ROUNDING * all && taken > 0.0).then(|| self.unbalanced / taken)
    }
}

impl HardLedger {
    /// Opens the ledger of spheres at the start.
    pub fn open(spheres: &Spheres) -> Self {
        let momentum_size = |at: u32| {
            let (motion, bulk) = (&spheres.motion[at as usize], &spheres.bulk[at as usize]);
            bulk.mass * motion.velocity.norm()
        };
        let order = spheres.by_id();
        Self {
            stored_at_start: stored(spheres, &order, |at| spheres.bulk[at as usize].temperature),
            momentum_at_start: momentum(spheres, &order),
            momentum_size_at_start: order.iter().map(|&at| momentum_size(at)).sum(),
            mass_at_start: order.iter().map(|&at| spheres.bulk[at as usize].mass).sum(),
            flows: Flows::default(),
            left_out: ImpactEnergy::default(),
            unkept_left_out: 0.0,
        }
    }

    /// Draws up the ledger; `pending` is heat given off since the last heating of each sphere, not yet in the flows.
    pub fn balance(&self, stored: SphereEnergy, pending: f64) -> Balance {
        let (flows, start) = (&self.flows, &self.stored_at_start);
        let collisions = &flows.collisions;
        let cooled = flows.cooled + pending;
        let explained = collisions.normal + collisions.tangential + collisions.reaction - collisions.surface;
        let unbalanced = collisions.heat - explained;
        let kinetic_drift = stored.kinetic - (start.kinetic - collisions.normal - collisions.tangential);
        let thermal_drift = stored.thermal - (start.thermal + collisions.heat - flows.unkept - cooled);
        let drift = kinetic_drift + thermal_drift;
        let all = start.kinetic + start.thermal + collisions.reaction + unbalanced.max(0.0);
        let over = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { 0.0 };
        Balance {
            stored,
            kinetic_at_start: start.kinetic,
            thermal_at_start: start.thermal,
            normal: collisions.normal,
            tangential: collisions.tangential,
            reaction: collisions.reaction,
            surface: collisions.surface,
            heat: collisions.heat,
            unbalanced,
            cooled,
            kinetic_drift_relative: over(kinetic_drift, start.kinetic),
            drift,
            drift_relative: over(drift, all),
        }
    }

    /// What walls do not explain of a momentum [kg m/s] now.
    pub fn momentum_drift(&self, momentum: Vec3) -> Vec3 {
        momentum - self.momentum_at_start - self.flows.walls
    }

    /// Adds heat [J] that grains without a heat capacity cannot keep.
    pub fn add_unkept(&mut self, heat: f64) {
        compensated(&mut self.flows.unkept, &mut self.unkept_left_out, heat);
    }

    /// Adds the energies of a collision. The sums are compensated (W. Kahan, Commun. ACM 8, 40 (1965)): in a gas that has cooled,
    /// millions of collisions each lose less than the last digit of the sum.
    pub fn add(&mut self, energy: &ImpactEnergy) {
        let (sum, left_out) = (&mut self.flows.collisions, &mut self.left_out);
        compensated(&mut sum.normal, &mut left_out.normal, energy.normal);
        compensated(&mut sum.tangential, &mut left_out.tangential, energy.tangential);
        compensated(&mut sum.reaction, &mut left_out.reaction, energy.reaction);
        compensated(&mut sum.surface, &mut left_out.surface, energy.surface);
        compensated(&mut sum.heat, &mut left_out.heat, energy.heat);
    }
}

/// Adds to a sum, and keeps what rounding leaves out for the next time.
#[inline]
fn compensated(sum: &mut f64, left_out: &mut f64, part: f64) {
    let part = part + *left_out;
    let before = *sum;
    *sum = before + part;
    *left_out = part - (*sum - before);
}

/// Energies of spheres [J], summed in `order`; `temperature` gives that of the sphere of an index.
pub fn stored(spheres: &Spheres, order: &[u32], mut temperature: impl FnMut(u32) -> f64) -> SphereEnergy {
    let mut stored = SphereEnergy::default();
    for &at in order {
        let (motion, bulk) = (&spheres.motion[at as usize], &spheres.bulk[at as usize]);
        stored.kinetic += 0.5 * bulk.mass * motion.velocity.norm_squared();
        stored.thermal += bulk.heat_capacity * temperature(at);
    }
    stored
}

/// Momentum of spheres [kg m/s], summed in `order`.
pub fn momentum(spheres: &Spheres, order: &[u32]) -> Vec3 {
    let of = |at: u32| spheres.motion[at as usize].velocity * spheres.bulk[at as usize].mass;
    order.iter().fold(Vec3::ZERO, |sum, &at| sum + of(at))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A million parts, each a tenth of the last digit of the sum, come to 2.2e-11; added one by one they would be lost.
    #[test]
    fn small_losses_are_not_forgotten() {
        let mut ledger = HardLedger::default();
        let loss = |joule: f64| ImpactEnergy { normal: joule, heat: joule, ..ImpactEnergy::default() };
        ledger.add(&loss(1.0));
        let part = 0.1 * f64::EPSILON;
        (0..1_000_000).for_each(|_| ledger.add(&loss(part)));
        // One rounding of the sum.
        let wanted = 1.0 + 1e6 * part;
        assert_near!(ledger.flows.collisions.normal, wanted, 3e-16);
        assert_near!(ledger.flows.collisions.heat, wanted, 3e-16, "in J");
    }

    /// 4 J of reaction, and 7 J of heat of which 1 J was lost motion: 2 J of nothing, twice what motion gave.
    #[test]
    fn heat_from_nothing_is_named() {
        let mut ledger = HardLedger {
            stored_at_start: SphereEnergy { kinetic: 2.0, thermal: 3.0 },
            ..HardLedger::default()
        };
        ledger.add(&ImpactEnergy { normal: 1.0, reaction: 4.0, heat: 7.0, ..ImpactEnergy::default() });
        let balance = ledger.balance(SphereEnergy { kinetic: 1.0, thermal: 10.0 }, 0.0);
        assert_eq!((balance.unbalanced, balance.drift), (2.0, 0.0));
        assert_eq!(balance.false_heat(), Some(2.0));
        assert_eq!(Balance { unbalanced: 1e-12, ..balance }.false_heat(), None);
        assert_eq!(Balance::default().false_heat(), None);
    }

    #[test]
    fn what_is_not_finite_is_never_perfect() {
        let spoiled = |normal, heat, thermal| {
            let mut ledger = HardLedger {
                stored_at_start: SphereEnergy { kinetic: 2.0, thermal: 3.0 },
                ..HardLedger::default()
            };
            ledger.add(&ImpactEnergy { normal, heat, ..ImpactEnergy::default() });
            ledger.balance(SphereEnergy { kinetic: 1.0, thermal }, 0.0).is_finite()
        };
        assert_true!(spoiled(1.0, 1.0, 4.0), "the balance is finite with this work, heat and energy, J");
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_false!(spoiled(bad, 1.0, 4.0), "the balance is finite with this work, heat and energy, J");
            assert_false!(spoiled(1.0, bad, 4.0), "the balance is finite with this work, heat and energy, J");
            assert_false!(spoiled(1.0, 1.0, bad), "the balance is finite with this work, heat and energy, J");
        }
    }

    /// The drift is relative to all energy that was there or came in, that from nothing included: 1.1 J of 11 J.
    #[test]
    fn drift_is_relative_to_all_energy() {
        let mut ledger = HardLedger {
            stored_at_start: SphereEnergy { kinetic: 2.0, thermal: 3.0 },
            ..HardLedger::default()
        };
        ledger.add(&ImpactEnergy { normal: 1.0, reaction: 4.0, heat: 7.0, ..ImpactEnergy::default() });
        let balance = ledger.balance(SphereEnergy { kinetic: 1.0, thermal: 11.1 }, 0.0);
        // 11.1 - 10 loses three bits.
        assert_near!(balance.drift_relative, 0.1, 1e-14);
    }
}
