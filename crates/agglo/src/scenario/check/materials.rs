//! Rules of materials and of what pairs of them have in common.

use super::Check;
use crate::contact::{Damping, Friction};
use crate::particles::{Material, Mixture};
use crate::scenario::fault::nearest;
use crate::scenario::file::ScenarioFile;
use crate::text::told_apart;
use crate::units::{Kind, Stiffness, kind_of};

pub(super) fn check(check: &mut Check, scenario: &ScenarioFile) {
    if scenario.materials.is_empty() {
        let message = "is empty; at least one material is wanted".to_owned();
        check.fail_with(
            "materials",
            message,
            "for example [materials.ceramic] with density = \"6000 kg/m3\"",
        );
    }
    for (name, material) in &scenario.materials {
        one(check, &format!("materials.{name}"), material);
    }
    for (index, mixture) in scenario.mixtures.iter().enumerate() {
        pair(check, scenario, index, mixture);
    }
}

fn one(check: &mut Check, key: &str, material: &Material) {
    check.positive(&format!("{key}.density"), material.density);
    if let Some(speed) = material.sound_speed {
        check.positive(&format!("{key}.sound_speed"), speed);
    }
    shear(check, key, material);
    if let Some(modulus) = material.youngs_modulus {
        check.positive(&format!("{key}.youngs_modulus"), modulus);
    }
    if let Some(ratio) = material.poisson_ratio {
        check.within(&format!("{key}.poisson_ratio"), ratio, 0.0, 0.5);
    }
    if let Some(stiffness) = material.contact_stiffness {
        check.positive(&format!("{key}.contact_stiffness"), stiffness);
    }
    thermal(check, key, material);
    if let Some(law) = &material.softening {
        check.positive(&format!("{key}.softening.reference_temperature"), law.reference_temperature);
        check.zero_or_more(&format!("{key}.softening.sensitivity"), law.sensitivity);
        check.positive(&format!("{key}.softening.lowest_stiffness"), law.lowest_stiffness);
        if material.contact_stiffness.is_none() {
            let message = "there is no contact_stiffness to soften".to_owned();
            check.fail_with(&format!("{key}.softening"), message, format!("give {key}.contact_stiffness"));
        }
    }
}

/// Shear waves are slow enough for a solid that does not expand under pressure: its bulk modulus is ρ (c² - (4/3) c_s²).
fn shear(check: &mut Check, key: &str, material: &Material) {
    let Some(shear) = material.shear_sound_speed else { return };
    let key = format!("{key}.shear_sound_speed");
    check.positive(&key, shear);
    let Some(sound) = material.sound_speed else {
        let message = "there is no sound_speed beside it".to_owned();
        return check.fail_with(&key, message, "give the speed of sound, that of its compression waves");
    };
    let most = 0.75_f64.sqrt() * sound.si();
    if sound.si() > 0.0 && shear.si() >= most {
        let [found, most] = told_apart([shear.si(), most], "m/s");
        let message = format!(
            "found {found}; less than {most} is wanted, sound_speed times the root of 3/4: a solid's bulk modulus is above 0"
        );
        check.fail(&key, message);
    }
}

/// What hard spheres ask of a material.
fn thermal(check: &mut Check, key: &str, material: &Material) {
    if let Some(capacity) = material.heat_capacity {
        check.positive(&format!("{key}.heat_capacity"), capacity);
    }
    if let Some(hardness) = material.hardness {
        check.positive(&format!("{key}.hardness"), hardness);
    }
    if let Some(energy) = material.activation_energy {
        check.not_negative(&format!("{key}.activation_energy"), energy);
    }
    // Both have the dimension of a stiffness, whose unit would not be understood here.
    let by_area = Kind { symbol: "J/m^2", ..kind_of(Stiffness::DIMENSION) };
    if let Some(heat) = material.reaction_heat {
        check.size(&format!("{key}.reaction_heat"), heat.si(), &by_area, true);
    }
    if let Some(energy) = material.surface_energy {
        check.size(&format!("{key}.surface_energy"), energy.si(), &by_area, false);
    }
    if let Some(emissivity) = material.emissivity {
        check.within(&format!("{key}.emissivity"), emissivity, 0.0, 1.0);
    }
    if let Some(conductivity) = material.thermal_conductivity {
        check.positive(&format!("{key}.thermal_conductivity"), conductivity);
    }
}

fn pair(check: &mut Check, scenario: &ScenarioFile, index: usize, mixture: &Mixture) {
    let key = format!("mixtures.{index}");
    for (side, name) in mixture.between.iter().enumerate() {
        named(check, scenario, &format!("{key}.between.{side}"), name);
    }
    let same = |other: &&Mixture| {
        let [a, b] = &mixture.between;
        other.between == mixture.between || other.between == [b.clone(), a.clone()]
    };
    if scenario.mixtures[..index].iter().any(|other| same(&other)) {
        let [a, b] = &mixture.between;
        check.fail_with(
            &format!("{key}.between"),
            format!("{a} and {b} stand twice"),
            "merge the two entries",
        );
    }
    if let Some(restitution) = mixture.restitution {
        check.within(&format!("{key}.restitution"), restitution, 0.0, 1.0);
        if !uses_restitution(scenario) {
            let message = "no law of the scenario reads it".to_owned();
            let help = "use [contact.damping.restitution] or remove it";
            check.fail_with(&format!("{key}.restitution"), message, help);
        }
    }
    friction(check, scenario, &key, mixture);
}

/// Impacts of hard spheres have a restitution whatever their law; the mixture's takes its place.
fn uses_restitution(scenario: &ScenarioFile) -> bool {
    let law = scenario.contact.as_ref().and_then(|laws| laws.damping.as_ref());
    scenario.engine.is_hard() || law.is_some_and(Damping::reads_restitution)
}

fn friction(check: &mut Check, scenario: &ScenarioFile, key: &str, mixture: &Mixture) {
    let given =
        [("static_friction", mixture.static_friction), ("dynamic_friction", mixture.dynamic_friction)];
    let hard = scenario.engine.is_hard();
    let law = scenario.contact.as_ref().and_then(|laws| laws.friction.as_ref());
    for (name, value) in given {
        let Some(value) = value else { continue };
        check.zero_or_more(&format!("{key}.{name}"), value);
        let help = match name {
            "static_friction" if hard => "impacts of hard spheres take dynamic_friction",
            _ if hard || law.is_some() => continue,
            _ => "give [contact.friction] a law or remove it",
        };
        check.fail_with(&format!("{key}.{name}"), "no law of the scenario reads it".to_owned(), help);
    }
    let Some(of_law) = law.map(Friction::coefficients) else { return };
    let at_rest = mixture.static_friction.unwrap_or(of_law.0);
    let in_motion = mixture.dynamic_friction.or(of_law.1).unwrap_or(at_rest);
    if given.iter().any(|(_, value)| value.is_some()) && in_motion > at_rest {
        let message = format!("dynamic friction {in_motion} is above static friction {at_rest}");
        let name = if mixture.dynamic_friction.is_some() { "dynamic_friction" } else { "static_friction" };
        check.fail(&format!("{key}.{name}"), message);
    }
}

/// More materials than this are not listed in a message.
const MOST_NAMED: usize = 20;

/// A name that a material must have.
pub(super) fn named(check: &mut Check, scenario: &ScenarioFile, key: &str, name: &str) {
    if scenario.materials.contains_key(name) {
        return;
    }
    let known: Vec<&str> = scenario.materials.keys().map(String::as_str).collect();
    let message = match known.as_slice() {
        [] => format!("there is no material \"{name}\""),
        _ if known.len() > MOST_NAMED => {
            format!("there is no material \"{name}\"; there are {}, ...", known[..MOST_NAMED].join(", "))
        }
        _ => format!("there is no material \"{name}\"; there are {}", known.join(", ")),
    };
    match nearest(name, known) {
        Some(word) => check.fail_with(key, message, format!("did you mean \"{word}\"?")),
        None => check.fail_with(key, message, format!("add [materials.{name}]")),
    }
}
