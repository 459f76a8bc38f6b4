//! What to keep in mind: where the models do not hold, laws that do not converge, settings without effect.

use super::counts::{SLOW_FRACTION, asked_fraction, pulses_before};
use super::push::Push;
use super::{Plan, hard};
use crate::acoustics::Beam;
use crate::domain::{Boundary, Space};
use crate::math::Vec3;
use crate::packing::{GrainGroup, Placement};
use crate::scenario::Scenario;
use crate::text::{digits, readable};
use crate::units::vector;

pub(super) fn collect(plan: &mut Plan, scenario: &Scenario, pushes: &[Push], smallest: f64) {
    let notes = &mut plan.notes;
    wavelengths(notes, scenario, smallest);
    of_laws(notes, scenario);
    hard::notes(notes, scenario);
    motion(notes, scenario, pushes);
    without_effect(notes, scenario);
    packing(notes, scenario);
    walls(notes, scenario);
}

/// Radius of a curved wall over that of the largest grain from which on it counts as flat.
const FLAT: f64 = 10.0;

/// Curved walls that are hardly larger than grains.
fn walls(notes: &mut Vec<String>, scenario: &Scenario) {
    let largest = scenario.grains.iter().map(|group| group.size.largest()).fold(0.0, f64::max);
    for wall in scenario.soft().into_iter().flat_map(|soft| &soft.walls) {
        let part = wall.shape.curvature_radius() / largest;
        if part < FLAT {
            notes.push(format!(
                "the radius of the wall \"{}\" is {} times that of the largest grain: its contacts are those of a flat wall",
                wall.name,
                digits(part)
            ));
        }
    }
}

fn wavelengths(notes: &mut Vec<String>, scenario: &Scenario, smallest: f64) {
    let beams = scenario.acoustics().into_iter().flat_map(|acoustics| &acoustics.beams).enumerate();
    notes.extend(beams.filter_map(|(index, beam)| beam.note(index, &scenario.medium, smallest)));
}

/// What the laws say of themselves.
fn of_laws(notes: &mut Vec<String>, scenario: &Scenario) {
    let context = scenario.context();
    for law in scenario.laws() {
        notes.extend(law.notes(&context));
    }
    if scenario.soft().is_some_and(|soft| soft.contact.is_none()) {
        notes.push("there is no [contact]: grains pass through one another".to_owned());
    }
}

fn motion(notes: &mut Vec<String>, scenario: &Scenario, pushes: &[Push]) {
    let Some(soft) = scenario.soft() else { return };
    let validity = soft.fields.drag.as_ref().map(|drag| drag.law.validity());
    let limit = soft.limits.strain;
    for push in pushes {
        let (beam, reynolds) = (push.beam, digits(push.reynolds));
        if let Some(validity) = validity.filter(|validity| push.reynolds > validity.reynolds) {
            let holds = validity.holds;
            notes.push(format!(
                "beam {beam} makes grains so fast that the largest Reynolds number is about {reynolds}; {holds}"
            ));
        }
        if push.strain.is_some_and(|strain| strain > limit) {
            notes.push(format!(
                "beam {beam} makes grains so fast that they overlap by more than limits.strain = {limit} when they collide"
            ));
        }
    }
}

fn without_effect(notes: &mut Vec<String>, scenario: &Scenario) {
    let end = scenario.time.end.si();
    for (index, beam) in scenario.acoustics().into_iter().flat_map(|acoustics| &acoustics.beams).enumerate() {
        let (fired, wanted) = (pulses_before(beam, end), beam.pulses.count);
        if fired < wanted {
            notes.push(format!("beam {index}: only {fired} of {wanted} pulses start before the end"));
        }
    }
    faces(notes, scenario);
    aims(notes, scenario);
    trains(notes, scenario);
    if !scenario.context().is_charged && scenario.soft().is_some_and(|soft| soft.fields.are_by_charge()) {
        notes.push("no grain carries a charge: fields that act on charges do nothing".to_owned());
    }
    for name in scenario.materials.keys() {
        let of_walls = scenario.soft().into_iter().flat_map(|soft| &soft.walls);
        let is_used = scenario.grains.iter().map(|group| &group.material);
        if !is_used.chain(of_walls.map(|wall| &wall.material)).any(|used| used == name) {
            notes.push(format!("no grain is made of {name}"));
        }
    }
}

/// Sound at faces that are for grains alone.
fn faces(notes: &mut Vec<String>, scenario: &Scenario) {
    let ends = |face: &Boundary| matches!(face, Boundary::Reflecting | Boundary::Absorbing);
    let volume = scenario.soft().and_then(|soft| soft.volume.as_ref());
    if scenario.acoustics().is_some() && volume.is_some_and(|volume| volume.boundaries().iter().any(ends)) {
        let note = "volume: some faces turn grains back or take them out; rays of sound fly on through these, and walls reflect both";
        notes.push(note.to_owned());
    }
}

/// Beams that miss all grains, reach them too late, or start where grains may be.
fn aims(notes: &mut Vec<String>, scenario: &Scenario) {
    let (sound, end) = (scenario.medium.sound_speed.si(), scenario.time.end.si());
    let space = scenario.space();
    let comes_back = space.repeats() || scenario.soft().is_some_and(|soft| !soft.walls.is_empty());
    for (index, beam) in scenario.acoustics().into_iter().flat_map(|acoustics| &acoustics.beams).enumerate() {
        let ways: Vec<Option<f64>> =
            scenario.grains.iter().map(|group| way_to(beam, group, &space)).collect();
        let Some(shortest) = ways.iter().copied().flatten().min_by(f64::total_cmp) else {
            if comes_back {
                continue;
            }
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
                let images = list.positions.iter().flat_map(|place| space.images_about(vector(*place)));
                images.into_iter().any(|place| beam.disc().distance(place) < reach)
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
fn way_to(beam: &Beam, group: &GrainGroup, space: &Space) -> Option<f64> {
    let disc = beam.disc();
    let region = match &group.placement {
        Placement::Random(law) => &law.region,
        Placement::Lattice(law) => &law.region,
        Placement::List(list) => {
            let images = list.positions.iter().flat_map(|place| space.images_about(vector(*place)));
            let positions: Vec<Vec3> = images.collect();
            return beam.first_hit(&positions, &vec![group.size.largest(); positions.len()]);
        }
        Placement::Table(_) | Placement::Fill(_) => return Some(0.0),
    };
    if space.repeats() {
        // An image of the region may be nearer.
        return Some(0.0);
    }
    (disc.distance_of_way_to(region) == 0.0).then(|| disc.distance_to(region))
}

/// Pulses that overlap in time, or are too short to have a frequency.
fn trains(notes: &mut Vec<String>, scenario: &Scenario) {
    let Some(acoustics) = scenario.acoustics() else { return };
    if !acoustics.force.is_impulse() {
        return;
    }
    let duration = acoustics.force.duration(0.0, &scenario.medium);
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
        if let Some(fraction) = asked_fraction(group, scenario.volume())
            && fraction > SLOW_FRACTION
        {
            let fraction = digits(fraction);
            notes.push(format!(
                "grains.{index}: a solid fraction of {fraction} is close to saturation; placing takes long"
            ));
        }
    }
}
