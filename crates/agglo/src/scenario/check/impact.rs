//! Rules of hard and soft spheres: which tables belong to which, laws of impact, and what they need of materials.

use super::contact::needs;
use super::{Check, used_materials};
use crate::engine::Engine;
use crate::engine::soft::Limits;
use crate::impact::cooling::Integration;
use crate::impact::fragmentation::Fragments;
use crate::impact::restitution::hardness::{FixedPoint, Solver};
use crate::impact::restitution::{Constant, Hardness};
use crate::impact::{Cooling, Fragmentation, Impact, Restitution};
use crate::particles::Material;
use crate::scenario::types::Scenario;

pub(super) fn check(check: &mut Check, scenario: &Scenario) {
    if scenario.engine.is_hard() {
        of_hard_spheres(check, scenario);
    } else {
        of_soft_spheres(check, scenario);
    }
    if let Some(law) = &scenario.impact {
        laws(check, scenario, law);
    }
}

/// The word of an engine, as a scenario writes it.
fn word(engine: &Engine) -> &'static str {
    match engine {
        Engine::Staggered(_) => "engine.staggered",
        Engine::Verlet(_) => "engine.verlet",
        Engine::EventDriven(_) => "engine.event_driven",
        Engine::TimeStepped(_) => "engine.time_stepped",
    }
}

fn of_hard_spheres(check: &mut Check, scenario: &Scenario) {
    let fields = &scenario.fields;
    let foreign = [
        ("contact", scenario.contact.is_some()),
        ("bonds", scenario.bonds.is_some()),
        ("acoustics", scenario.acoustics.is_some()),
        ("start.relax", scenario.start.relax.is_some()),
        ("limits", scenario.limits != Limits::default()),
        ("fields.gravity", fields.gravity.is_some()),
        ("fields.drag", fields.drag.is_some()),
        ("fields.lorentz", fields.lorentz.is_some()),
        ("fields.magnetic", fields.magnetic.is_some()),
        ("fields.near_field", fields.near_field.is_some()),
    ];
    for (key, _) in foreign.into_iter().filter(|(_, given)| *given) {
        let message = format!("belongs to soft spheres; {} moves hard ones", word(&scenario.engine));
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

fn of_soft_spheres(check: &mut Check, scenario: &Scenario) {
    let foreign = [("volume", scenario.volume.is_some()), ("impact", scenario.impact.is_some())];
    for (key, _) in foreign.into_iter().filter(|(_, given)| *given) {
        let message = format!("belongs to hard spheres; {} moves soft ones", word(&scenario.engine));
        check.fail_with(key, message, "remove it, or choose [engine.event_driven] or [engine.time_stepped]");
    }
}

fn laws(check: &mut Check, scenario: &Scenario, law: &Impact) {
    match &law.restitution {
        Restitution::Constant(law) => constant(check, law),
        Restitution::Hardness(law) => hardness(check, scenario, law),
    }
    if let Some(law) = &law.tangential {
        check.zero_or_more("impact.tangential.friction", law.friction);
    }
    if let Some(law) = &law.fragmentation {
        fragmentation(check, scenario, law);
    }
    if let Some(law) = &law.cooling {
        cooling(check, scenario, law);
    }
    heat_capacities(check, scenario, law);
}

fn constant(check: &mut Check, law: &Constant) {
    let key = "impact.restitution.constant.restitution";
    if law.restitution > 1.0 {
        let message = format!("found {}; a number from 0 to 1 is wanted", law.restitution);
        check.fail_with(key, message, "an impact with more than 1 would create energy");
    } else {
        check.within(key, law.restitution, 0.0, 1.0);
    }
}

fn hardness(check: &mut Check, scenario: &Scenario, law: &Hardness) {
    let key = |name: &str| format!("impact.restitution.hardness.{name}");
    check.above_zero(&key("deformation"), law.deformation);
    check.zero_or_more(&key("elastic_area"), law.elastic_area);
    check.above_zero(&key("sticking_area"), law.sticking_area);
    if law.elastic_area > law.sticking_area && law.sticking_area > 0.0 {
        let message = format!("{} is above sticking_area = {}", law.elastic_area, law.sticking_area);
        check.fail_with(&key("elastic_area"), message, "contacts grow as restitution falls");
    }
    if let Solver::FixedPoint(law) = &law.solver {
        fixed_point(check, law);
    }
    let who = "impact.restitution.hardness";
    needs(check, scenario, who, ("hardness", "\"1 MPa\""), |m| m.hardness.is_some());
}

/// An impact that takes longer than this never ends.
const MOST_ITERATIONS: u32 = 10_000;

fn fixed_point(check: &mut Check, law: &FixedPoint) {
    let key = |name: &str| format!("impact.restitution.hardness.solver.fixed_point.{name}");
    check.at_least_one(&key("most_iterations"), law.most_iterations);
    if law.most_iterations > MOST_ITERATIONS {
        let message = format!("found {}; at most {MOST_ITERATIONS} are allowed", law.most_iterations);
        check.fail(&key("most_iterations"), message);
    }
    if law.tolerance <= 0.0 || law.tolerance >= 1.0 {
        let message = format!("found {}; a number above 0 and below 1 is wanted", law.tolerance);
        check.fail(&key("tolerance"), message);
    }
}

fn fragmentation(check: &mut Check, scenario: &Scenario, law: &Fragmentation) {
    let breaks = |name: &str| scenario.materials.get(name).is_some_and(|m| m.surface_energy.is_some());
    if !used_materials(scenario).into_iter().any(breaks) {
        let message = "no material in use has a surface_energy: nothing would break".to_owned();
        let help =
            "give a material one, such as surface_energy = \"1 J/m2\", or remove [impact.fragmentation]";
        check.fail_with("impact.fragmentation", message, help);
    }
    if let Fragments::PowerLaw(law) = &law.fragments {
        check.exponent("impact.fragmentation.fragments.power_law.exponent", law.exponent);
    }
}

fn cooling(check: &mut Check, scenario: &Scenario, law: &Cooling) {
    if law.integration == Integration::Published && matches!(scenario.engine, Engine::EventDriven(_)) {
        // It would be one step from a grain's impact to its next.
        let message =
            "found \"published\", which takes the engine's steps; engine.event_driven has none".to_owned();
        let help = "choose \"exact\", or [engine.time_stepped]";
        check.fail_with("impact.cooling.integration", message, help);
    }
    check.not_negative("impact.cooling.convection", law.convection);
    check.positive("impact.cooling.gas_temperature", law.gas_temperature);
    check.positive("impact.cooling.surroundings", law.surroundings);
}

/// Heat changes the temperature of what has a heat capacity. It is asked for where temperature matters.
fn heat_capacities(check: &mut Check, scenario: &Scenario, law: &Impact) {
    let by_hardness = matches!(law.restitution, Restitution::Hardness(_));
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
