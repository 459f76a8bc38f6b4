//! Rules of hard and soft spheres: which tables belong to which, laws of impact, and what they need of materials.

use super::{Check, used_materials};
use crate::engine::soft::Limits;
use crate::fields::Fields;
use crate::impact::Impact;
use crate::particles::Material;
use crate::scenario::file::{EngineTable, ScenarioFile};

pub(super) fn check(check: &mut Check, scenario: &ScenarioFile) {
    if scenario.engine.is_hard() {
        of_hard_spheres(check, scenario);
    } else {
        of_soft_spheres(check, scenario);
    }
    if let Some(law) = &scenario.impact {
        if law.fragmentation.is_some() {
            fragmentation(check, scenario);
        }
        heat_capacities(check, scenario, law);
    }
}

impl EngineTable {
    /// Whether it moves hard spheres.
    pub fn is_hard(&self) -> bool {
        matches!(self, Self::EventDriven(_) | Self::TimeStepped(_))
    }

    /// Its key.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Staggered(_) => "engine.staggered",
            Self::Verlet(_) => "engine.verlet",
            Self::EventDriven(_) => "engine.event_driven",
            Self::TimeStepped(_) => "engine.time_stepped",
        }
    }
}

fn of_hard_spheres(check: &mut Check, scenario: &ScenarioFile) {
    let nothing = Fields::default();
    let fields = scenario.fields.as_ref().unwrap_or(&nothing);
    let foreign = [
        ("walls", !scenario.walls.is_empty()),
        ("contact", scenario.contact.is_some()),
        ("bonds", scenario.bonds.is_some()),
        ("acoustics", scenario.acoustics.is_some()),
        ("start.relax", scenario.start.relax.is_some()),
        ("start.bonds", scenario.start.bonds.is_some()),
        ("limits", scenario.limits.as_ref().is_some_and(|limits| *limits != Limits::default())),
        ("fields.gravity", fields.gravity.is_some()),
        ("fields.drag", fields.drag.is_some()),
        ("fields.lorentz", fields.lorentz.is_some()),
        ("fields.magnetic", fields.magnetic.is_some()),
        ("fields.near_field", fields.near_field.is_some()),
    ];
    for (key, _) in foreign.into_iter().filter(|(_, given)| *given) {
        let message = format!("belongs to soft spheres; {} moves hard ones", scenario.engine.key());
        check.fail_with(key, message, "remove it, or choose [engine.staggered] or [engine.verlet]");
    }
    if scenario.volume.is_none() {
        let message = "is missing; hard spheres need a control volume".to_owned();
        let help = "for example [volume] with lower = [\"0 m\", \"0 m\", \"0 m\"] and upper = [\"1 cm\", \"1 cm\", \"1 cm\"]";
        check.fail_with("volume", message, help);
    }
    if scenario.impact.is_none() {
        let message = "is missing; hard spheres need laws of impact".to_owned();
        let help = "for example [impact.restitution.constant] with restitution = 0.9";
        check.fail_with("impact", message, help);
    }
}

fn of_soft_spheres(check: &mut Check, scenario: &ScenarioFile) {
    if scenario.impact.is_some() {
        let message = format!("belongs to hard spheres; {} moves soft ones", scenario.engine.key());
        let help = "remove it, or choose [engine.event_driven] or [engine.time_stepped]";
        check.fail_with("impact", message, help);
    }
}

/// Something must have a surface that costs energy, or nothing breaks.
fn fragmentation(check: &mut Check, scenario: &ScenarioFile) {
    let breaks = |name: &str| scenario.materials.get(name).is_some_and(|m| m.surface_energy.is_some());
    if !used_materials(scenario).into_iter().any(breaks) {
        let message = "no material in use has a surface_energy: nothing would break".to_owned();
        let help =
            "give a material one, such as surface_energy = \"1 J/m2\", or remove [impact.fragmentation]";
        check.fail_with("impact.fragmentation", message, help);
    }
}

/// Heat changes the temperature of what has a heat capacity. It is asked for where temperature matters.
fn heat_capacities(check: &mut Check, scenario: &ScenarioFile, law: &Impact) {
    let by_hardness = law.restitution.hardness().is_some();
    let who = |material: &Material| {
        if material.reaction_heat.is_some_and(|heat| heat.si() > 0.0) {
            Some("reaction_heat")
        } else if by_hardness && material.activation_energy.is_some_and(|energy| energy.si() > 0.0) {
            Some("activation_energy")
        } else {
            law.cooling.as_ref().map(|_| "impact.cooling")
        }
    };
    for name in used_materials(scenario) {
        let Some(material) = scenario.materials.get(name) else { continue };
        if let (Some(who), None) = (who(material), material.heat_capacity) {
            let message = format!("is missing; {who} needs it");
            let help = "for example heat_capacity = \"1000 J/(kg K)\"";
            check.fail_with(&format!("materials.{name}.heat_capacity"), message, help);
        }
    }
}
