//! What to keep in mind: where the models do not hold, laws that do not converge, settings without effect.

use std::f64::consts::TAU;

use super::counts::{SLOW_FRACTION, asked_fraction, pulses_before};
use super::push::Push;
use super::{Plan, hard};
use crate::acoustics::{Beam, RayForce};
use crate::contact::{Bonds, Friction, Normal};
use crate::fields::DragLaw;
use crate::fields::near_field::{NearFieldLaw, Scaling};
use crate::math::Vec3;
use crate::packing::{GrainGroup, Placement};
use crate::scenario::Scenario;
use crate::text::{digits, readable};
use crate::units::vector;

/// Below this wave number times radius, sound goes around grains instead of being reflected as rays.
const SMALLEST_KA: f64 = 10.0;

/// Up to this one the push of rays is a per cent and more off that of a wave, on hard grains too.
const CLOSE_KA: f64 = 60.0;

pub(super) fn collect(plan: &mut Plan, scenario: &Scenario, pushes: &[Push], smallest: f64) {
    let notes = &mut plan.notes;
    wavelengths(notes, scenario, smallest);
    published_laws(notes, scenario);
    hard::notes(notes, scenario);
    motion(notes, scenario, pushes);
    without_effect(notes, scenario);
    packing(notes, scenario);
}

fn wavelengths(notes: &mut Vec<String>, scenario: &Scenario, smallest: f64) {
    let Some(acoustics) = &scenario.acoustics else { return };
    let sound = scenario.medium.sound_speed.si();
    let needed = readable(SMALLEST_KA * sound / (TAU * smallest), "Hz");
    for (index, beam) in acoustics.beams.iter().enumerate() {
        let Some(frequency) = beam.frequency else {
            notes.push(format!(
                "beam {index} has no frequency: rays hold where the wavelength is far below a grain, here from about {needed} (k a = 10)"
            ));
            continue;
        };
        let ka = TAU * frequency.si() * smallest / sound;
        if (SMALLEST_KA..CLOSE_KA).contains(&ka) {
            notes.push(format!(
                "beam {index}: k a = {}: a wave pushes less than rays do, at 10 to 20 by 3 % on a rigid grain to some 30 % on polystyrene (docs/validity.md)",
                digits(ka)
            ));
        }
        if ka < SMALLEST_KA {
            notes.push(format!(
                "beam {index}: k a = {} at {}: rays do not hold below 10, here {needed}; the sound would go around the grains",
                digits(ka),
                readable(frequency.si(), "Hz")
            ));
        }
    }
}

fn published_laws(notes: &mut Vec<String>, scenario: &Scenario) {
    let laws = scenario.contact.as_ref();
    if let Some(Friction::Regularized(_)) = laws.and_then(|laws| laws.friction.as_ref()) {
        notes.push("contact.friction.regularized: its stick force is proportional to the step and does not converge; mindlin does".to_owned());
    }
    match &scenario.bonds {
        Some(Bonds::StrainBond(_)) => notes.push(
            "bonds.strain_bond acts only between overlapping grains, cannot resist tension, and its tangential part is proportional to the step; beam bonds hold grains together"
                .to_owned(),
        ),
        Some(Bonds::Beam(law)) if law.gap == 0.0 => {
            notes.push("bonds.beam.gap is 0: only grains that overlap at the start are bonded".to_owned());
        }
        _ => {}
    }
    if let Some(RayForce::PublishedStep(_)) = scenario.acoustics.as_ref().map(|acoustics| &acoustics.force) {
        notes.push("acoustics.force.published_step: the impulse of a hit is proportional to the step and does not converge; impulse does".to_owned());
    }
    if laws.is_none() && !scenario.engine.is_hard() {
        notes.push("there is no [contact]: grains pass through one another".to_owned());
    }
}

fn motion(notes: &mut Vec<String>, scenario: &Scenario, pushes: &[Push]) {
    let drag = scenario.fields.drag.as_ref().map(|drag| drag.law);
    let limit = scenario.limits.strain;
    for push in pushes {
        let (beam, reynolds) = (push.beam, digits(push.reynolds));
        match drag {
            Some(DragLaw::Stokes) if push.reynolds > 1.0 => notes.push(format!(
                "beam {beam} makes grains so fast that the largest Reynolds number is about {reynolds}; stokes holds below 1, schiller_naumann up to 1000"
            )),
            Some(DragLaw::SchillerNaumann) if push.reynolds > 1000.0 => notes.push(format!(
                "beam {beam} makes grains so fast that the largest Reynolds number is about {reynolds}; schiller_naumann holds up to 1000"
            )),
            _ => {}
        }
        if push.strain.is_some_and(|strain| strain > limit) {
            notes.push(format!(
                "beam {beam} makes grains so fast that they overlap by more than limits.strain = {limit} when they collide"
            ));
        }
    }
    if let Some(Normal::Hooke(_)) = scenario.contact.as_ref().map(|laws| &laws.normal)
        && scenario.grains.len() > 1
    {
        notes.push("contact.normal.hooke: one stiffness for all sizes of grains".to_owned());
    }
}

fn without_effect(notes: &mut Vec<String>, scenario: &Scenario) {
    let end = scenario.time.end.si();
    for (index, beam) in scenario.acoustics.iter().flat_map(|acoustics| &acoustics.beams).enumerate() {
        let (fired, wanted) = (pulses_before(beam, end), beam.pulses.count);
        if fired < wanted {
            notes.push(format!("beam {index}: only {fired} of {wanted} pulses start before the end"));
        }
    }
    aims(notes, scenario);
    trains(notes, scenario);
    cutoff(notes, scenario);
    let charged = scenario.grains.iter().any(|group| group.charge.si() != 0.0);
    let by_charge = match scenario.fields.near_field.as_ref().map(|field| &field.law) {
        Some(NearFieldLaw::Coulomb(_)) => true,
        Some(NearFieldLaw::PowerPair(law)) => law.scaling == Scaling::Charge,
        _ => false,
    };
    if !charged && (by_charge || scenario.fields.lorentz.is_some()) {
        notes.push("no grain carries a charge: fields that act on charges do nothing".to_owned());
    }
    for name in scenario.materials.keys() {
        if !scenario.grains.iter().any(|group| group.material == *name) {
            notes.push(format!("no grain is made of {name}"));
        }
    }
}

/// What a cut-off of the near field costs.
fn cutoff(notes: &mut Vec<String>, scenario: &Scenario) {
    let Some(field) = &scenario.fields.near_field else { return };
    if field.cutoff.is_none() {
        return;
    }
    let limit = digits(100.0 * field.truncation);
    let slow = match &field.law {
        NearFieldLaw::Coulomb(_) => true,
        NearFieldLaw::PowerPair(law) => law.attraction_exponent.min(law.repulsion_exponent) <= 3.0,
        NearFieldLaw::VanDerWaals(_) => false,
    };
    let falls = if slow {
        "the force falls off so slowly that sums over a cloud do not converge, and a cut-off can turn the sign of the energy; "
    } else {
        ""
    };
    notes.push(format!(
        "fields.near_field.cutoff: {falls}the run measures what is left out of the forces at the start, and refuses more than \
         truncation = {limit} %"
    ));
}

/// Beams that miss all grains, reach them too late, or start where grains may be.
fn aims(notes: &mut Vec<String>, scenario: &Scenario) {
    let (sound, end) = (scenario.medium.sound_speed.si(), scenario.time.end.si());
    for (index, beam) in scenario.acoustics.iter().flat_map(|acoustics| &acoustics.beams).enumerate() {
        let ways: Vec<Option<f64>> = scenario.grains.iter().map(|group| way_to(beam, group)).collect();
        let Some(shortest) = ways.iter().copied().flatten().min_by(f64::total_cmp) else {
            notes.push(format!("beam {index} misses all grains: it passes by or flies away from them"));
            continue;
        };
        let late = pulses_before(beam, end) - pulses_before(beam, end - shortest / sound);
        if late > 0 {
            notes.push(format!(
                "beam {index}: {late} of its pulses would reach the first grain after the end: rays fly {} to it",
                readable(shortest / sound, "s")
            ));
        }
        let inside = |group: &GrainGroup| match &group.placement {
            Placement::Random(law) => beam.disc().distance_to(&law.region) == 0.0,
            Placement::Lattice(law) => beam.disc().distance_to(&law.region) == 0.0,
            Placement::List(list) => {
                let reach = group.size.largest() * (1.0 - 1e-9);
                list.positions.iter().any(|place| beam.disc().distance(vector(*place)) < reach)
            }
            Placement::Table(_) | Placement::Fill(_) => false,
        };
        for group in (0..scenario.grains.len()).filter(|group| inside(&scenario.grains[*group])) {
            notes.push(format!(
                "beam {index} starts where grains.{group} are placed: a ray that starts in a grain stops the run, or is dropped once grains have moved"
            ));
        }
    }
}

/// Way [m] that a beam's rays fly at least until they meet a grain of a group; 0 where that is not known, none if they miss.
fn way_to(beam: &Beam, group: &GrainGroup) -> Option<f64> {
    let disc = beam.disc();
    let region = match &group.placement {
        Placement::Random(law) => &law.region,
        Placement::Lattice(law) => &law.region,
        Placement::List(list) => {
            let positions: Vec<Vec3> = list.positions.iter().map(|place| vector(*place)).collect();
            return beam.first_meeting(&positions, &vec![group.size.largest(); positions.len()]);
        }
        Placement::Table(_) | Placement::Fill(_) => return Some(0.0),
    };
    (disc.distance_of_way_to(region) == 0.0).then(|| disc.distance_to(region))
}

/// Pulses that overlap in time, or are too short to have a frequency.
fn trains(notes: &mut Vec<String>, scenario: &Scenario) {
    let Some(acoustics) = &scenario.acoustics else { return };
    let duration = match &acoustics.force {
        RayForce::Impulse(law) => law.duration.si(),
        RayForce::RadiationPressure(law) => law.duration.si(),
        RayForce::PublishedStep(_) => return,
    };
    let long = readable(duration, "s");
    for (index, beam) in acoustics.beams.iter().enumerate() {
        if let Some(period) =
            beam.pulses.period.filter(|period| beam.pulses.count > 1 && period.si() < duration)
        {
            notes.push(format!(
                "beam {index}: pulses overlap in time: each presses for {long}, and the next starts {} after it",
                readable(period.si(), "s")
            ));
        }
        if let Some(frequency) = beam.frequency.filter(|frequency| frequency.si() * duration < 1.0) {
            notes.push(format!(
                "beam {index}: a pulse of {long} is shorter than a cycle of {}: it has no such frequency",
                readable(frequency.si(), "Hz")
            ));
        }
    }
}

fn packing(notes: &mut Vec<String>, scenario: &Scenario) {
    for (index, group) in scenario.grains.iter().enumerate() {
        if let Some(fraction) = asked_fraction(group, scenario.volume.as_ref())
            && fraction > SLOW_FRACTION
        {
            let fraction = digits(fraction);
            notes.push(format!(
                "grains.{index}: a solid fraction of {fraction} is close to saturation; placing takes long"
            ));
        }
    }
}
