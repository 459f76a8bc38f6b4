//! Rules of the fields.

use super::{Check, HIGHEST_EXPONENT};
use crate::fields::near_field::NearFieldLaw;
use crate::fields::{Drag, NearField};
use crate::scenario::types::Scenario;
use crate::text::told_apart;

pub(super) fn check(check: &mut Check, scenario: &Scenario) {
    let fields = &scenario.fields;
    if let Some(law) = &fields.drag {
        drag(check, scenario, law);
    }
    if let Some(law) = &fields.lorentz
        && law.electric_field.is_none()
        && law.magnetic_flux_density.is_none()
    {
        let message = "has neither electric_field nor magnetic_flux_density".to_owned();
        check.fail_with("fields.lorentz", message, "give one of them or remove the table");
    }
    if let Some(difference) = fields.magnetic.as_ref().and_then(|law| law.difference) {
        check.positive("fields.magnetic.difference", difference);
    }
    if let Some(law) = &fields.near_field {
        near_field(check, scenario, law);
    }
    if fields.gravity.as_ref().is_some_and(|law| law.buoyancy) && scenario.medium.density.si() == 0.0 {
        let message = "buoyancy is on, but medium.density is 0".to_owned();
        check.fail_with("fields.gravity.buoyancy", message, "give the medium a density or turn buoyancy off");
    }
}

fn drag(check: &mut Check, scenario: &Scenario, law: &Drag) {
    check.zero_or_more("fields.drag.added_mass", law.added_mass);
    if scenario.medium.viscosity.si() == 0.0 {
        let message = "the medium has no viscosity: there would be no drag".to_owned();
        let help = "give medium.viscosity, such as \"1 mPa s\" for water, or remove [fields.drag]";
        check.fail_with("fields.drag.law", message, help);
    }
}

/// What is wrong with the cut-off where the largest grain has this radius [m].
pub(crate) fn fault_of_cutoff(law: &NearField, largest: f64) -> Option<String> {
    let cutoff = law.cutoff?.si();
    let [found, least] = told_apart([cutoff, 2.0 * largest], "m");
    (cutoff <= 2.0 * largest)
        .then(|| format!("{found} is not above the largest diameter {least}: touching grains are left out"))
}

fn near_field(check: &mut Check, scenario: &Scenario, law: &NearField) {
    let largest = scenario.grains.iter().map(|group| group.size.largest()).fold(0.0, f64::max);
    if let Some(message) = fault_of_cutoff(law, largest) {
        check.fail_with("fields.near_field.cutoff", message, "it counts from center to center");
    }
    check.above_zero("fields.near_field.truncation", law.truncation);
    match &law.law {
        NearFieldLaw::PowerPair(law) => {
            let exponents = [
                ("attraction_exponent", law.attraction_exponent),
                ("repulsion_exponent", law.repulsion_exponent),
            ];
            for (name, exponent) in exponents {
                let key = format!("fields.near_field.law.power_pair.{name}");
                check.within(&key, exponent, -HIGHEST_EXPONENT, HIGHEST_EXPONENT);
            }
        }
        NearFieldLaw::Coulomb(law) => {
            check
                .above_zero("fields.near_field.law.coulomb.relative_permittivity", law.relative_permittivity);
        }
        NearFieldLaw::VanDerWaals(law) => {
            check.not_negative("fields.near_field.law.van_der_waals.hamaker", law.hamaker);
            check.positive("fields.near_field.law.van_der_waals.smallest_gap", law.smallest_gap);
        }
    }
}
