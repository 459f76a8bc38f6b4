//! Rules of sizes, velocities and written-out places.

use std::collections::BTreeMap;
use std::path::Path;

use super::materials::named;
use super::{Check, placement};
use crate::contact::Bonds;
use crate::domain::Volume;
use crate::folder::RunFolder;
use crate::packing::{GrainGroup, GrainList, LengthRatio, Placement, Size, VelocitySpread};
use crate::record::door;
use crate::scenario::file::ScenarioFile;
use crate::text::{readable, told_apart};
use crate::units::Length;

/// Moments of a lognormal distribution go with the square of the logarithm of this.
const WIDEST_DEVIATION: f64 = 100.0;

pub(super) fn check(check: &mut Check, scenario: &ScenarioFile) {
    match (&scenario.start.from, scenario.grains.is_empty()) {
        (None, true) => check.fail_with(
            "grains",
            "is missing or empty; at least one group is wanted".to_owned(),
            "add a [[grains]] table, or take the grains of another run by start.from",
        ),
        (Some(from), false) => check.fail_with(
            "grains",
            format!("is given, but start.from takes the grains of {}", from.display()),
            "remove the [[grains]] tables, or start.from",
        ),
        _ => {}
    }
    bonded(check, scenario);
    let mut places = BTreeMap::new();
    for (index, group) in scenario.grains.iter().enumerate() {
        let key = format!("grains.{index}");
        named(check, scenario, &format!("{key}.material"), &group.material);
        check.positive(&format!("{key}.temperature"), group.temperature);
        if group.polarity.abs() != 1.0 {
            check.fail(&format!("{key}.polarity"), format!("found {}; 1 or -1 is wanted", group.polarity));
        }
        if size(check, &format!("{key}.size"), &group.size) {
            placement::check(check, &format!("{key}.placement"), group, scenario);
            if let Size::LengthRatio(law) = &group.size {
                length_ratio(check, &format!("{key}.size.length_ratio"), law, group, scenario);
            }
        }
        if let Some(spread) = &group.velocity_spread {
            velocity_spread(check, &format!("{key}.velocity_spread"), spread);
        }
        if let Placement::List(list) = &group.placement {
            written_out(check, &format!("{key}.placement.list"), list, &mut places);
        }
    }
}

/// The run that grains come from must be there.
pub(super) fn earlier_run(check: &mut Check, scenario: &ScenarioFile, base: &Path) {
    let Some(from) = &scenario.start.from else { return };
    let path = base.join(from);
    let shown = from.display();
    let found = if path.is_dir() {
        RunFolder::open(&path).map(|_| ()).map_err(|_| format!("the folder \"{shown}\" holds no run"))
    } else {
        door::open(&path).map(|_| ()).map_err(|error| format!("cannot open \"{shown}\": {error}"))
    };
    if let Err(message) = found {
        let help = "the folder of a run, or one of its checkpoints; relative to the scenario's folder";
        check.fail_with("start.from", message, help);
    }
}

/// A table of bonds is for grains that are placed and for a law that holds them.
fn bonded(check: &mut Check, scenario: &ScenarioFile) {
    let key = "start.bonds";
    if scenario.start.bonds.is_none() || scenario.engine.is_hard() {
        return;
    }
    if scenario.start.from.is_some() {
        let message = "is given, but start.from takes the bonds of another run".to_owned();
        check.fail_with(key, message, "remove one of them");
    } else if scenario.bonds.as_ref().and_then(Bonds::lasting).is_none() {
        let message = "is given, and there is no [bonds.beam] that says how bonds hold".to_owned();
        check.fail_with(key, message, "add [bonds.beam], or remove it");
    }
}

/// Tables of grains and of bonds must be files that can be opened.
pub(super) fn tables(check: &mut Check, scenario: &ScenarioFile, base: &Path) {
    if let Some(file) = &scenario.start.bonds
        && let Err(error) = door::open(&base.join(file))
    {
        let message = format!("cannot open \"{}\": {error}", file.display());
        check.fail_with("start.bonds", message, "the path is relative to the scenario's folder");
    }
    for (index, group) in scenario.grains.iter().enumerate() {
        let Placement::Table(table) = &group.placement else { continue };
        if let Err(error) = door::open(&base.join(&table.file)) {
            let key = format!("grains.{index}.placement.table.file");
            let message = format!("cannot open \"{}\": {error}", table.file.display());
            check.fail_with(&key, message, "the path is relative to the scenario's folder");
        }
    }
}

fn size(check: &mut Check, key: &str, size: &Size) -> bool {
    let before = check.found().len();
    match size {
        Size::Constant(law) => check.positive(&format!("{key}.constant.radius"), law.radius),
        Size::Uniform(law) => {
            check.positive(&format!("{key}.uniform.smallest"), law.smallest);
            ordered(
                check,
                &format!("{key}.uniform"),
                &[("smallest", law.smallest), ("largest", law.largest)],
            );
        }
        Size::Lognormal(law) => {
            check.positive(&format!("{key}.lognormal.smallest"), law.smallest);
            let bounds = [("smallest", law.smallest), ("median", law.median), ("largest", law.largest)];
            ordered(check, &format!("{key}.lognormal"), &bounds);
            if law.geometric_deviation <= 1.0 || law.geometric_deviation > WIDEST_DEVIATION {
                let found = readable(law.geometric_deviation, "");
                let message =
                    format!("found {found}; a number above 1 and up to {WIDEST_DEVIATION} is wanted");
                let help = "it is a factor: 1.3 puts two thirds of the grains within 30 % of the median";
                check.fail_with(&format!("{key}.lognormal.geometric_deviation"), message, help);
            }
        }
        Size::LengthRatio(law) => {
            check.above_zero(&format!("{key}.length_ratio.ratio"), law.ratio);
            check.positive(&format!("{key}.length_ratio.half_edge"), law.half_edge);
            check.at_least_one(&format!("{key}.length_ratio.count"), law.count);
        }
        Size::Table(law) => {
            let (radii, shares) = (law.radii.len(), law.shares.len());
            if radii != shares || radii == 0 {
                let message = format!("found {shares} shares for {radii} radii; one for each is wanted");
                check.fail(&format!("{key}.table.shares"), message);
            }
            for (index, radius) in law.radii.iter().enumerate() {
                check.positive(&format!("{key}.table.radii.{index}"), *radius);
            }
            for (index, share) in law.shares.iter().enumerate() {
                check.above_zero(&format!("{key}.table.shares.{index}"), *share);
            }
        }
    }
    check.found().len() == before
}

/// [B]'s ratio says a radius through the number of grains and half the edge of their box: they must be the true ones.
fn length_ratio(
    check: &mut Check,
    key: &str,
    law: &LengthRatio,
    group: &GrainGroup,
    scenario: &ScenarioFile,
) {
    let (placed, by_fraction) = match &group.placement {
        Placement::Random(law) => (law.count, law.solid_fraction.is_some()),
        Placement::Fill(law) => (law.count, law.solid_fraction.is_some()),
        Placement::Lattice(law) => (law.count, false),
        Placement::List(list) => (u32::try_from(list.positions.len()).ok(), false),
        Placement::Table(_) => (None, false),
    };
    match placed {
        Some(placed) if placed != law.count && placed > 0 => {
            let message = format!("found {}, but the placement has {placed} grains", law.count);
            check.fail_with(&format!("{key}.count"), message, "make them equal: the radius follows from it");
        }
        None if by_fraction => {
            let message = "the placement is asked for a solid fraction and not for this count".to_owned();
            check.fail_with(&format!("{key}.count"), message, "give the placement the same count");
        }
        _ => {}
    }
    let Some(edges) = scenario.volume.as_ref().map(Volume::edges) else { return };
    let is_close = |a: f64, b: f64| (a - b).abs() <= 1e-9 * b.abs();
    let cube = is_close(edges.y, edges.x) && is_close(edges.z, edges.x);
    if cube && edges.x > 0.0 && !is_close(2.0 * law.half_edge.si(), edges.x) {
        let [found, half] = told_apart([law.half_edge.si(), 0.5 * edges.x], "m");
        let message = format!("found {found}; half the edge of [volume] is {half}");
        check.fail(&format!("{key}.half_edge"), message);
    }
}

fn velocity_spread(check: &mut Check, key: &str, spread: &VelocitySpread) {
    match spread {
        VelocitySpread::Uniform(law) => {
            for (axis, bound) in law.bounds.iter().enumerate() {
                check.not_negative(&format!("{key}.uniform.bounds.{axis}"), *bound);
            }
        }
        VelocitySpread::Maxwell(law) => {
            check.not_negative(&format!("{key}.maxwell.deviation"), law.deviation);
        }
    }
}

/// Lengths that must not fall from one to the next.
fn ordered(check: &mut Check, key: &str, bounds: &[(&str, Length)]) {
    for pair in bounds.windows(2) {
        if let [(low, small), (high, large)] = pair
            && small > large
        {
            let [found, bound] = told_apart([large.si(), small.si()], "m");
            check.fail(&format!("{key}.{high}"), format!("{high} = {found} is below {low} = {bound}"));
        }
    }
}

fn written_out(check: &mut Check, key: &str, list: &GrainList, places: &mut BTreeMap<[u64; 3], String>) {
    if list.positions.is_empty() {
        check.fail(&format!("{key}.positions"), "is empty; at least one position is wanted".to_owned());
    }
    let (positions, velocities) = (list.positions.len(), list.velocities.len());
    if velocities > 0 && velocities != positions {
        let message =
            format!("found {velocities} velocities for {positions} positions; one for each is wanted");
        check.fail(&format!("{key}.velocities"), message);
    }
    for (index, position) in list.positions.iter().enumerate() {
        let here = format!("{key}.positions.{index}");
        // Adding zero makes -0 and 0 the same place.
        let place = position.map(|x| (x.si() + 0.0).to_bits());
        if let Some(first) = places.get(&place) {
            check.fail(&here, format!("is the same place as {first}"));
        } else {
            places.insert(place, here);
        }
    }
}
