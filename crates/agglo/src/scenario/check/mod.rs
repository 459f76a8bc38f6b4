//! The rules between the keys of a scenario, and the bounds of single values; all faults at once.

mod acoustics;
mod grains;
mod impact;
mod laws;
mod materials;
mod placement;
mod time;
mod volume;
mod walls;

use std::collections::BTreeSet;
use std::path::Path;

use super::fault::Fault;
use super::file::ScenarioFile;
use crate::domain::Region;
use crate::law::Faults as Check;
use crate::math::Vec3;
use crate::text::{readable, told_apart};
use crate::units::{Dimension, Length, Triple};

/// Everything that is wrong with a scenario whose form is right; the keys are paths in it.
///
/// With `base`, the folder that tables are relative to, tables must be there too.
pub(super) fn faults(scenario: &ScenarioFile, base: Option<&Path>) -> Vec<Fault> {
    let mut check = Check::default();
    time::check(&mut check, scenario);
    materials::check(&mut check, scenario);
    grains::check(&mut check, scenario);
    if let Some(base) = base {
        grains::tables(&mut check, scenario, base);
        grains::earlier_run(&mut check, scenario, base);
    }
    laws::check(&mut check, scenario);
    acoustics::check(&mut check, scenario);
    impact::check(&mut check, scenario);
    volume::check(&mut check, scenario);
    walls::check(&mut check, scenario);
    let faults = check.found().iter().map(|found| {
        let fault = Fault::new(found.key.clone(), found.message.clone());
        match &found.help {
            Some(help) => fault.with_help(help.clone()),
            None => fault,
        }
    });
    faults.collect()
}

/// Two corners, the upper above the lower along each axis.
fn corners(check: &mut Check, key: &str, lower: Triple<Length>, upper: Triple<Length>) -> bool {
    let before = check.found().len();
    for (axis, name) in ["x", "y", "z"].iter().enumerate() {
        let (low, high) = (lower[axis].si(), upper[axis].si());
        if high <= low {
            let [low, high] = told_apart([low, high], "m");
            let message = format!("upper {name} = {high} is not above lower {name} = {low}");
            check.fail(&format!("{key}.upper.{axis}"), message);
        }
    }
    check.found().len() == before
}

/// A region with a volume.
fn region(check: &mut Check, key: &str, region: &Region) -> bool {
    let before = check.found().len();
    match region {
        Region::Sphere(ball) => check.positive(&format!("{key}.sphere.radius"), ball.radius),
        Region::Box(block) => {
            corners(check, &format!("{key}.box"), block.lower, block.upper);
        }
        Region::Cylinder(cylinder) => {
            check.positive(&format!("{key}.cylinder.radius"), cylinder.radius);
            check.positive(&format!("{key}.cylinder.length"), cylinder.length);
            if Vec3::from(cylinder.axis).norm() == 0.0 {
                let message = "has no direction: all components are 0".to_owned();
                check.fail_with(&format!("{key}.cylinder.axis"), message, "for example [0, 0, 1]");
            }
        }
    }
    check.found().len() == before
}

/// A quantity as a message shows it.
fn shown(value: f64, dimension: Dimension) -> String {
    readable(value, &dimension.symbol())
}

/// Names of the materials that grains and walls are made of; of all where an earlier run brings the grains.
fn used_materials(scenario: &ScenarioFile) -> BTreeSet<&str> {
    if scenario.start.from.is_some() {
        return scenario.materials.keys().map(String::as_str).collect();
    }
    let of_walls = scenario.walls.iter().map(|wall| wall.material.as_str());
    scenario.grains.iter().map(|group| group.material.as_str()).chain(of_walls).collect()
}
