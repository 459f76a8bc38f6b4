//! What the chosen laws find wrong with their settings, and miss in the materials.

use super::{Check, used_materials};
use crate::law::Chosen;
use crate::particles::Property;
use crate::scenario::types::Scenario;

pub(super) fn check(check: &mut Check, scenario: &Scenario) {
    let context = scenario.context();
    for law in scenario.laws() {
        law.faults(check, &context);
        needs(check, scenario, law);
    }
}

/// Asks every material in use for what a law needs.
fn needs(check: &mut Check, scenario: &Scenario, law: Chosen<'_>) {
    let needs = law.needs();
    let who = format!("{} {}", law.key(), needs.because);
    for property in needs.properties {
        needed(check, scenario, who.trim_end(), property);
    }
}

/// Asks every material in use for a property.
pub(super) fn needed(check: &mut Check, scenario: &Scenario, who: &str, property: &Property) {
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
