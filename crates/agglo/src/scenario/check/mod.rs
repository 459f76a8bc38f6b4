//! The rules between the keys of a scenario, and the bounds of single values; all faults at once.

mod acoustics;
mod contact;
mod fields;
mod grains;
mod impact;
mod materials;
mod placement;
mod time;
mod volume;

pub(crate) use fields::fault_of_cutoff;

use std::collections::BTreeSet;
use std::path::Path;

use super::fault::Fault;
use super::types::Scenario;
use crate::domain::Region;
use crate::math::Vec3;
use crate::text::{readable, told_apart};
use crate::units::{Dimension, KINDS, Kind, Length, Quantity, Triple, kind_of};

/// Everything that is wrong with a scenario whose form is right; the keys are paths in it.
///
/// With `base`, the folder that tables are relative to, tables must be there too.
pub(super) fn faults(scenario: &Scenario, base: Option<&Path>) -> Vec<Fault> {
    let mut check = Check::default();
    time::check(&mut check, scenario);
    materials::check(&mut check, scenario);
    grains::check(&mut check, scenario);
    if let Some(base) = base {
        grains::tables(&mut check, scenario, base);
        grains::earlier_run(&mut check, scenario, base);
    }
    contact::check(&mut check, scenario);
    fields::check(&mut check, scenario);
    acoustics::check(&mut check, scenario);
    impact::check(&mut check, scenario);
    volume::check(&mut check, scenario);
    check.faults
}

/// What was found so far.
#[derive(Default)]
struct Check {
    faults: Vec<Fault>,
}

impl Check {
    fn fail(&mut self, key: &str, message: String) {
        self.faults.push(Fault::new(key, message));
    }

    fn fail_with(&mut self, key: &str, message: String, help: impl Into<String>) {
        self.faults.push(Fault::new(key, message).with_help(help));
    }

    /// A quantity above zero, and not so near to it that its powers vanish.
    fn positive<const KG: i8, const M: i8, const S: i8, const K: i8, const A: i8>(
        &mut self,
        key: &str,
        value: Quantity<KG, M, S, K, A>,
    ) {
        self.size(key, value.si(), &kind_of(Quantity::<KG, M, S, K, A>::DIMENSION), false);
    }

    /// A quantity not below zero.
    fn not_negative<const KG: i8, const M: i8, const S: i8, const K: i8, const A: i8>(
        &mut self,
        key: &str,
        value: Quantity<KG, M, S, K, A>,
    ) {
        self.size(key, value.si(), &kind_of(Quantity::<KG, M, S, K, A>::DIMENSION), true);
    }

    /// A pure number above zero.
    fn above_zero(&mut self, key: &str, value: f64) {
        self.size(key, value, &PURE, false);
    }

    /// A pure number not below zero.
    fn zero_or_more(&mut self, key: &str, value: f64) {
        self.size(key, value, &PURE, true);
    }

    /// The exponent of a power law: above zero, and no higher than powers of lengths can be computed.
    fn exponent(&mut self, key: &str, value: f64) {
        if value > HIGHEST_EXPONENT {
            let found = readable(value, "");
            self.fail(key, format!("found {found}; more than 0 and at most {HIGHEST_EXPONENT} is wanted"));
        } else {
            self.above_zero(key, value);
        }
    }

    /// A size within the range of its kind; `or_zero` where it may be 0.
    fn size(&mut self, key: &str, value: f64, kind: &Kind, or_zero: bool) {
        let symbol = if kind.dimension == Dimension::default() { "" } else { kind.symbol };
        let found = readable(value, symbol);
        if value < 0.0 && or_zero {
            self.fail(key, format!("found {found}; 0 or more is wanted"));
        } else if value <= 0.0 && !or_zero {
            self.fail(key, format!("found {found}; more than 0 is wanted"));
        } else if value != 0.0 && !(kind.smallest..=kind.largest).contains(&value) {
            let [least, most] = [kind.smallest, kind.largest].map(|bound| format!("{bound:e} {symbol}"));
            let zero = if or_zero { "0, or " } else { "" };
            let message = format!(
                "found {found}, with which one cannot compute; {zero}{} to {} is allowed",
                least.trim_end(),
                most.trim_end()
            );
            self.fail(key, message);
        }
    }

    /// A count above zero.
    fn at_least_one(&mut self, key: &str, count: u32) {
        if count == 0 {
            self.fail(key, "found 0; 1 or more is wanted".to_owned());
        }
    }

    /// A pure number between two bounds, both allowed.
    fn within(&mut self, key: &str, value: f64, least: f64, most: f64) {
        if !(least..=most).contains(&value) {
            self.fail(key, format!("found {value}; a number from {least} to {most} is wanted"));
        }
    }

    /// Two corners, the upper above the lower along each axis.
    fn corners(&mut self, key: &str, lower: Triple<Length>, upper: Triple<Length>) -> bool {
        let before = self.faults.len();
        for (axis, name) in ["x", "y", "z"].iter().enumerate() {
            let (low, high) = (lower[axis].si(), upper[axis].si());
            if high <= low {
                let [low, high] = told_apart([low, high], "m");
                let message = format!("upper {name} = {high} is not above lower {name} = {low}");
                self.fail(&format!("{key}.upper.{axis}"), message);
            }
        }
        self.faults.len() == before
    }

    /// A region with a volume.
    fn region(&mut self, key: &str, region: &Region) -> bool {
        let before = self.faults.len();
        match region {
            Region::Sphere(ball) => self.positive(&format!("{key}.sphere.radius"), ball.radius),
            Region::Box(block) => {
                self.corners(&format!("{key}.box"), block.lower, block.upper);
            }
            Region::Cylinder(cylinder) => {
                self.positive(&format!("{key}.cylinder.radius"), cylinder.radius);
                self.positive(&format!("{key}.cylinder.length"), cylinder.length);
                if Vec3::from(cylinder.axis).norm() == 0.0 {
                    let message = "has no direction: all components are 0".to_owned();
                    self.fail_with(&format!("{key}.cylinder.axis"), message, "for example [0, 0, 1]");
                }
            }
        }
        self.faults.len() == before
    }
}

/// Powers higher than this of lengths and strains are beyond numbers.
const HIGHEST_EXPONENT: f64 = 64.0;

/// Numbers without a unit.
const PURE: Kind = KINDS[0];

/// A quantity as a message shows it.
fn shown(value: f64, dimension: Dimension) -> String {
    readable(value, &dimension.symbol())
}

/// Names of the materials that grains are made of; of all where an earlier run brings the grains.
fn used_materials(scenario: &Scenario) -> BTreeSet<&str> {
    if scenario.start.from.is_some() {
        return scenario.materials.keys().map(String::as_str).collect();
    }
    scenario.grains.iter().map(|group| group.material.as_str()).collect()
}
