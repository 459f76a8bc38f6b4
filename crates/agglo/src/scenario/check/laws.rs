//! What the chosen laws find wrong with their settings, miss in the materials, and do not read there.

use super::{Check, used_materials};
use crate::catalog;
use crate::law::Chosen;
use crate::particles::Property;
use crate::particles::property::PROPERTIES;
use crate::scenario::file::ScenarioFile;

pub(super) fn check(check: &mut Check, scenario: &ScenarioFile) {
    if let Some(laws) = &scenario.contact {
        check.under("contact", |check| laws.faults(check));
    }
    let context = scenario.context();
    for law in scenario.laws() {
        law.faults(check, &context);
        needs(check, scenario, law);
    }
    unread(check, scenario);
}

/// Refuses what materials say to laws that are not chosen.
fn unread(check: &mut Check, scenario: &ScenarioFile) {
    let read: Vec<&Property> = scenario.laws().flat_map(Chosen::reads).collect();
    for property in PROPERTIES.iter().filter(|property| !read.contains(property)) {
        let readers = catalog::all().filter(|law| law.reads.contains(property)).map(|law| law.key);
        let readers: Vec<&str> = readers.collect();
        for (name, _) in scenario.materials.iter().filter(|(_, material)| property.is_given(material)) {
            let key = format!("materials.{name}.{}", property.key);
            let help = format!("remove it, or choose a law that does: {}", readers.join(", "));
            if !check.names(&key) {
                check.fail_with(&key, "no law of the scenario reads it".to_owned(), help);
            }
        }
    }
}

/// Asks every material in use for what a law needs.
fn needs(check: &mut Check, scenario: &ScenarioFile, law: Chosen<'_>) {
    let needs = law.needs();
    let who = format!("{} {}", law.key(), needs.because);
    for property in needs.properties {
        needed(check, scenario, who.trim_end(), property);
    }
}

/// Asks every material in use for a property.
pub(super) fn needed(check: &mut Check, scenario: &ScenarioFile, who: &str, property: &Property) {
    for name in used_materials(scenario) {
        let Some(material) = scenario.materials.get(name) else { continue };
        let key = format!("materials.{name}.{}", property.key);
        if !property.is_given(material) && !check.names(&key) {
            let message = format!("is missing; {who} needs it of every material in use");
            let help = format!("for example {} = {}", property.key, property.example);
            check.fail_with(&key, message, help);
        }
    }
}
