//! Rules of walls.

use super::Check;
use super::materials::named;
use crate::contact::{ContactGeometry, Custom, OfPair, PairTable};
use crate::domain::Volume;
use crate::scenario::file::ScenarioFile;
use crate::text::readable;

pub(super) fn check(check: &mut Check, scenario: &ScenarioFile) {
    if scenario.walls.is_empty() || scenario.engine.is_hard() {
        return;
    }
    for (index, wall) in scenario.walls.iter().enumerate() {
        let key = format!("walls.{index}");
        check.under(&key, |check| wall.faults(check, scenario.time.end.si()));
        named(check, scenario, &format!("{key}.material"), &wall.material);
        let same = scenario.walls[..index].iter().position(|other| other.name == wall.name);
        if let Some(same) = same {
            let message = format!("\"{}\" is the name of walls.{same} as well", wall.name);
            check.fail_with(&format!("{key}.name"), message, "each wall has a name of its own");
        }
    }
    together(check, scenario);
}

/// What walls need, and what does not go with them.
fn together(check: &mut Check, scenario: &ScenarioFile) {
    let Some(laws) = &scenario.contact else {
        let message = "are given, and there is no [contact]: grains would pass through them".to_owned();
        return check.fail_with("walls", message, "give laws of contact, for example [contact.normal.hertz]");
    };
    if let Some(volume) = &scenario.volume {
        across_faces(check, scenario, volume);
    }
    if let Some(law) = &laws.custom {
        custom(check, scenario, law);
    }
}

/// Where space repeats itself, so must walls.
fn across_faces(check: &mut Check, scenario: &ScenarioFile, volume: &Volume) {
    let space = volume.space();
    for (index, wall) in scenario.walls.iter().enumerate() {
        if let Some(axis) = wall.cut_by(&space) {
            let name = ["x", "y", "z"][axis];
            let message = format!("is not the same all along {name}, on which space repeats itself");
            let help = "let the faces of [volume] across it be open, or take a plane or a cylinder without an end along it";
            check.fail_with(&format!("walls.{index}"), message, help);
        }
    }
    if volume.deformation.is_some() {
        let message = "is given beside [[walls]], which do not follow it".to_owned();
        check.fail_with("volume.deformation", message, "leave out one of the two");
    }
}

/// Overlaps at which a formula is tried, over the grain's radius.
const STRAINS: [f64; 5] = [1e-9, 1e-6, 1e-4, 1e-2, 0.1];

/// A formula must have a value at walls too, where there is no larger radius and the sum of the radii is the grain's.
fn custom(check: &mut Check, scenario: &ScenarioFile, law: &Custom) {
    if law.names(OfPair::LargerRadius) {
        let message = "names larger_radius, and a wall has none".to_owned();
        return check.fail_with("contact.custom", message, "leave out the name, or the [[walls]]");
    }
    if law.force.fault().is_some() || check.names("contact.custom.force") {
        return;
    }
    let pairs = PairTable::new(&scenario.materials, &scenario.mixtures, scenario.contact.as_ref());
    let number = |wanted: &str| scenario.materials.keys().position(|name| name == wanted);
    for sample in scenario.context().samples {
        for wall in &scenario.walls {
            let of_grain =
                scenario.materials.values().position(|material| std::ptr::eq(material, sample.material));
            let Some((grain, wall_number)) = of_grain.zip(number(&wall.material)) else { continue };
            let softened =
                |at: usize| scenario.materials.values().nth(at).map_or(0.0, |of| of.stiffness_at(300.0));
            let stiffness = [softened(grain), softened(wall_number)];
            let touching = ContactGeometry::at_wall(sample.radius, sample.mass, stiffness, sample.radius);
            let at = |strain: f64| ContactGeometry { overlap: strain * sample.radius, ..touching };
            let pair = pairs.of(grain as u32, wall_number as u32);
            let bad = STRAINS.into_iter().find(|strain| !law.force(pair, &at(*strain), 0.0).is_finite());
            if let Some(strain) = bad {
                let (overlap, radius) = (readable(strain * sample.radius, "m"), readable(sample.radius, "m"));
                let message = format!(
                    "\"{}\" has no value at an overlap of {overlap} of a grain of {radius} radius with the wall \"{}\", where \
                     radius_sum is that radius",
                    law.force.text(),
                    wall.name
                );
                let help = "give a formula that has a value wherever grains touch walls";
                return check.fail_with("contact.custom.force", message, help);
            }
        }
    }
}
