//! Balances close where they should, and nothing that is wrong passes for right.

use super::*;
use crate::impact::ImpactEnergy;

fn opened(kinetic: f64) -> Ledger {
    let stored = Stored { kinetic, ..Stored::default() };
    Ledger::of_soft(Opening { stored, ..Opening::default() }, 2)
}

/// 2 J of motion and 3 J of heat.
fn opened_hard() -> Ledger {
    let stored = Stored { kinetic: 2.0, thermal: 3.0, ..Stored::default() };
    Ledger::of_hard(Opening { stored, ..Opening::default() })
}

fn hot(kinetic: f64, thermal: f64) -> Stored {
    Stored { kinetic, thermal, ..Stored::default() }
}

/// 1 J at the start. Motion of 1000 J out of nothing, and drag of another 1000 J that it had: 2000 times all
/// energy, whichever entry it hides in.
#[test]
fn an_error_does_not_grow_its_own_scale() {
    let mut ledger = opened(1.0);
    ledger.flows.supplies.drag.power = -1000.0;
    let exploded = Stored { kinetic: 1001.0, ..Stored::default() };
    assert_eq!(ledger.balance(exploded, 0.0).drift_relative, 2000.0);
    assert_eq!(ledger.note(exploded), 2000.0);
    let mut ledger = opened(1.0);
    assert_eq!(ledger.note(Stored { kinetic: 1.0, near_field: -500.0, ..Stored::default() }), 500.0);
    assert_eq!(ledger.worst, 500.0);
}

/// Energy that came in and is explained counts, also when it has gone again.
#[test]
fn the_scale_is_the_most_energy_so_far() {
    let mut ledger = opened(0.0);
    ledger.flows.supplies.gravity.power = 8.0;
    assert_eq!(ledger.note(Stored { kinetic: 8.0, ..Stored::default() }), 0.0);
    ledger.flows.supplies.gravity.power = 0.0;
    assert_eq!(ledger.note(Stored { kinetic: 0.04, ..Stored::default() }), 0.005);
}

/// A dashpot that gives is as wrong as motion from nothing: 2 J of 4 J, though the sums agree.
#[test]
fn losses_below_zero_are_gains_from_nothing() {
    let mut ledger = opened(4.0);
    ledger.flows.damping = -2.0;
    assert_eq!(ledger.note(Stored { kinetic: 6.0, ..Stored::default() }), 0.5);
}

/// Whichever entry is spoiled: the balance is not finite, and neither is what is noted of it.
#[test]
fn what_is_not_finite_is_never_perfect() {
    type Spoil = fn(&mut Ledger, &mut Stored, f64);
    let entries: [Spoil; 18] = [
        |_, stored, bad| stored.kinetic = bad,
        |_, stored, bad| stored.rotational = bad,
        |_, stored, bad| stored.elastic = bad,
        |_, stored, bad| stored.tangential_spring = bad,
        |_, stored, bad| stored.bonds = bad,
        |_, stored, bad| stored.near_field = bad,
        |_, stored, bad| stored.fields = bad,
        |ledger, _, bad| ledger.flows.driven = bad,
        |ledger, _, bad| ledger.flows.supplies.hook.power = bad,
        |ledger, _, bad| ledger.flows.supplies.walls.power = bad,
        |ledger, _, bad| ledger.flows.rays.power = bad,
        |ledger, _, bad| ledger.flows.supplies.gravity.power = bad,
        |ledger, _, bad| ledger.flows.supplies.drag.power = bad,
        |ledger, _, bad| ledger.flows.supplies.field.power = bad,
        |ledger, _, bad| ledger.flows.damping = bad,
        |ledger, _, bad| ledger.flows.tangential = bad,
        |ledger, _, bad| ledger.flows.bond_damping = bad,
        |ledger, _, bad| ledger.flows.broken_bonds = bad,
    ];
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for (entry, spoil) in entries.iter().enumerate() {
            let (mut ledger, mut stored) = (opened(1.0), Stored { kinetic: 1.0, ..Stored::default() });
            spoil(&mut ledger, &mut stored, bad);
            assert!(!ledger.balance(stored, 0.0).is_finite(), "entry {entry}, {bad}");
            assert!(ledger.note(stored).is_nan(), "entry {entry}, {bad}");
        }
        for spoil in [
            |ledger: &mut Ledger, _: &mut Stored, bad: f64| ledger.flows.collisions.normal.add(bad),
            |ledger, _, bad| ledger.flows.collisions.tangential.add(bad),
            |ledger, _, bad| ledger.flows.collisions.reaction.add(bad),
            |ledger, _, bad| ledger.flows.collisions.surface.add(bad),
            |ledger, _, bad| ledger.flows.collisions.heat.add(bad),
            |ledger, _, bad| ledger.flows.unkept.add(bad),
            |ledger, _, bad| ledger.flows.cooled = bad,
            |_, stored, bad| stored.kinetic = bad,
            |_, stored, bad| stored.thermal = bad,
        ] as [Spoil; 9]
        {
            let (mut ledger, mut stored) = (opened_hard(), hot(1.0, 4.0));
            assert_true!(ledger.balance(stored, 0.0).is_finite(), "nothing is spoiled");
            spoil(&mut ledger, &mut stored, bad);
            assert_false!(ledger.balance(stored, 0.0).is_finite(), "one entry is {bad}");
        }
    }
}

/// Rounding of a system at rest is far below k T for each grain.
#[test]
fn rest_is_no_alarm() {
    let mut ledger = opened(0.0);
    assert_eq!(ledger.note(Stored::default()), 0.0);
    assert_below!(ledger.note(Stored { elastic: 1e-29, ..Stored::default() }), 1e-8);
}

/// A million parts, each a tenth of the last digit of the sum, come to 2.2e-11; added one by one they would be lost.
#[test]
fn small_losses_are_not_forgotten() {
    let mut ledger = opened_hard();
    let loss = |joule: f64| ImpactEnergy { normal: joule, heat: joule, ..ImpactEnergy::default() };
    ledger.flows.collisions.add(&loss(1.0));
    let part = 0.1 * f64::EPSILON;
    (0..1_000_000).for_each(|_| ledger.flows.collisions.add(&loss(part)));
    // One rounding of the sum.
    let wanted = 1.0 + 1e6 * part;
    assert_near!(ledger.flows.collisions.normal.value(), wanted, 3e-16);
    assert_near!(ledger.flows.collisions.heat.value(), wanted, 3e-16, "in J");
}

/// 4 J of reaction, and 7 J of heat of which 1 J was lost motion: 2 J of nothing, twice what motion gave.
#[test]
fn heat_from_nothing_is_named() {
    let mut ledger = opened_hard();
    let energy = ImpactEnergy { normal: 1.0, reaction: 4.0, heat: 7.0, ..ImpactEnergy::default() };
    ledger.flows.collisions.add(&energy);
    let balance = ledger.balance(hot(1.0, 10.0), 0.0);
    assert_eq!((balance.unbalanced, balance.drift), (2.0, 0.0));
    assert_eq!(balance.false_heat(), Some(2.0));
    assert_eq!(Balance { unbalanced: 1e-12, ..balance }.false_heat(), None);
    assert_eq!(Balance::default().false_heat(), None);
}

/// The drift is relative to all energy that was there or came in, that from nothing included: 1.1 J of 11 J.
#[test]
fn drift_is_relative_to_all_energy() {
    let mut ledger = opened_hard();
    let energy = ImpactEnergy { normal: 1.0, reaction: 4.0, heat: 7.0, ..ImpactEnergy::default() };
    ledger.flows.collisions.add(&energy);
    // 11.1 - 10 loses three bits.
    assert_near!(ledger.balance(hot(1.0, 11.1), 0.0).drift_relative, 0.1, 1e-14);
}

/// What is written under the names of the entries comes back, each to its own place, for both kinds; one that lacks an entry is
/// refused by its name, and what else there is does not matter.
#[test]
fn a_balance_comes_back_by_its_names() {
    for entries in [Entries::Soft, Entries::Hard] {
        let mut balance = Balance { entries, ..Balance::default() };
        for (entry, value) in entries.all().iter().zip(1_u32..) {
            (entry.put)(&mut balance, f64::from(value));
        }
        let mut written = serde_json::to_value(balance).unwrap();
        let all = written.as_object().unwrap();
        assert_eq!(all.len(), entries.all().len());
        for (entry, value) in entries.all().iter().zip(1_u32..) {
            assert_eq!(all[entry.name], f64::from(value), "{}", entry.name);
        }
        written["unexplained_largest"] = "words".into();
        assert_eq!(serde_json::from_value::<Balance>(written.clone()).unwrap(), balance);
        written.as_object_mut().unwrap().remove("drift_J");
        assert_contains!(serde_json::from_value::<Balance>(written).unwrap_err().to_string(), "`drift_J`");
    }
}
