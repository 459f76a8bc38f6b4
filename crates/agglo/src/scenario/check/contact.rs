//! Rules of contact laws and bonds, and of the material properties that they need.

use super::{Check, used_materials};
use crate::contact::{Bonds, ContactLaws, Damping, Friction, Normal};
use crate::particles::Material;
use crate::scenario::types::Scenario;

pub(super) fn check(check: &mut Check, scenario: &Scenario) {
    if let Some(laws) = &scenario.contact {
        normal(check, scenario, &laws.normal);
        damping(check, laws);
        friction(check, scenario, laws);
    }
    if let Some(law) = &scenario.bonds {
        bonds(check, law);
    }
}

/// Asks every material in use for a property.
pub(super) fn needs(
    check: &mut Check,
    scenario: &Scenario,
    who: &str,
    property: (&str, &str),
    has: impl Fn(&Material) -> bool,
) {
    for name in used_materials(scenario) {
        let Some(material) = scenario.materials.get(name) else { continue };
        let key = format!("materials.{name}.{}", property.0);
        let told = check.faults.iter().any(|fault| fault.key == key);
        if !has(material) && !told {
            let message = format!("is missing; {who} needs it of every material in use");
            let help = format!("for example {} = {}", property.0, property.1);
            check.fail_with(&key, message, help);
        }
    }
}

fn elastic_constants(check: &mut Check, scenario: &Scenario, who: &str) {
    needs(check, scenario, who, ("youngs_modulus", "\"70 GPa\""), |m| m.youngs_modulus.is_some());
    needs(check, scenario, who, ("poisson_ratio", "0.25"), |m| m.poisson_ratio.is_some());
}

fn normal(check: &mut Check, scenario: &Scenario, law: &Normal) {
    match law {
        Normal::Hertz(_) => elastic_constants(check, scenario, "contact.normal.hertz"),
        Normal::Hooke(law) => check.positive("contact.normal.hooke.stiffness", law.stiffness),
        Normal::StrainPower(law) => {
            check.exponent("contact.normal.strain_power.exponent", law.exponent);
            let who = "contact.normal.strain_power";
            needs(check, scenario, who, ("contact_stiffness", "\"10 MPa\""), |m| {
                m.contact_stiffness.is_some()
            });
        }
    }
}

fn damping(check: &mut Check, laws: &ContactLaws) {
    match &laws.damping {
        Some(Damping::ViscousArea(law)) => {
            check.not_negative("contact.damping.viscous_area.coefficient", law.coefficient);
        }
        Some(Damping::Restitution(law)) => {
            check.within("contact.damping.restitution.restitution", law.restitution, 0.0, 1.0);
        }
        None => {}
    }
}

fn friction(check: &mut Check, scenario: &Scenario, laws: &ContactLaws) {
    match &laws.friction {
        Some(Friction::Regularized(law)) => {
            let key = "contact.friction.regularized";
            check.not_negative(&format!("{key}.stiffness"), law.stiffness);
            coefficients(check, key, law.static_friction, Some(law.dynamic_friction));
        }
        Some(Friction::Mindlin(law)) => {
            let key = "contact.friction.mindlin";
            coefficients(check, key, law.static_friction, law.dynamic_friction);
            check.zero_or_more(&format!("{key}.dashpot"), law.dashpot);
            match law.stiffness_ratio {
                Some(ratio) => check.above_zero(&format!("{key}.stiffness_ratio"), ratio),
                None => elastic_constants(check, scenario, &format!("{key} without stiffness_ratio")),
            }
        }
        None => {}
    }
}

fn coefficients(check: &mut Check, key: &str, at_rest: f64, in_motion: Option<f64>) {
    check.zero_or_more(&format!("{key}.static_friction"), at_rest);
    let Some(in_motion) = in_motion else { return };
    check.zero_or_more(&format!("{key}.dynamic_friction"), in_motion);
    if in_motion > at_rest {
        let message = format!("dynamic friction {in_motion} is above static friction {at_rest}");
        check.fail(&format!("{key}.dynamic_friction"), message);
    }
}

fn bonds(check: &mut Check, law: &Bonds) {
    match law {
        Bonds::StrainBond(law) => {
            let key = |name: &str| format!("bonds.strain_bond.{name}");
            check.not_negative(&key("stiffness"), law.stiffness);
            check.not_negative(&key("tangential_stiffness"), law.tangential_stiffness);
            check.exponent(&key("exponent"), law.exponent);
            check.within(&key("threshold_strain"), law.threshold_strain, 0.0, 1.0);
        }
        Bonds::Beam(law) => {
            let key = |name: &str| format!("bonds.beam.{name}");
            check.positive(&key("youngs_modulus"), law.youngs_modulus);
            check.positive(&key("tensile_strength"), law.tensile_strength);
            check.positive(&key("shear_strength"), law.shear_strength);
            check.above_zero(&key("shear_ratio"), law.shear_ratio);
            check.above_zero(&key("radius_ratio"), law.radius_ratio);
            check.zero_or_more(&key("gap"), law.gap);
            check.zero_or_more(&key("damping_ratio"), law.damping_ratio);
            if let Some(strain) = law.forming_strain {
                check.above_zero(&key("forming_strain"), strain);
            }
        }
    }
}
