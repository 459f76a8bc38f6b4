//! Rules of sizes and placements.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::path::Path;

use super::materials::named;
use super::{Check, shown};
use crate::domain::Region;
use crate::packing::{GrainList, Lattice, Placement, RandomAddition, SATURATION, Size};
use crate::scenario::figures::{digits, readable};
use crate::scenario::types::{GrainGroup, Scenario};
use crate::units::Length;

pub(super) fn check(check: &mut Check, scenario: &Scenario) {
    if scenario.grains.is_empty() {
        check.fail_with(
            "grains",
            "is empty; at least one group is wanted".to_owned(),
            "add a [[grains]] table",
        );
    }
    let mut places = BTreeMap::new();
    for (index, group) in scenario.grains.iter().enumerate() {
        let key = format!("grains.{index}");
        named(check, scenario, &format!("{key}.material"), &group.material);
        check.positive(&format!("{key}.temperature"), group.temperature);
        if group.polarity.abs() != 1.0 {
            check.fail(&format!("{key}.polarity"), format!("found {}; 1 or -1 is wanted", group.polarity));
        }
        if size(check, &format!("{key}.size"), &group.size) {
            placement(check, &format!("{key}.placement"), group);
        }
        if let Placement::List(list) = &group.placement {
            written_out(check, &format!("{key}.placement.list"), list, &mut places);
        }
    }
}

/// Tables of grains must be files that can be opened.
pub(super) fn tables(check: &mut Check, scenario: &Scenario, base: &Path) {
    for (index, group) in scenario.grains.iter().enumerate() {
        let Placement::Table(table) = &group.placement else { continue };
        if let Err(error) = std::fs::File::open(base.join(&table.file)) {
            let key = format!("grains.{index}.placement.table.file");
            let message = format!("cannot open \"{}\": {error}", table.file.display());
            check.fail_with(&key, message, "the path is relative to the scenario's folder");
        }
    }
}

fn size(check: &mut Check, key: &str, size: &Size) -> bool {
    let before = check.faults.len();
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
            if law.geometric_deviation <= 1.0 {
                let message = format!("found {}; a number above 1 is wanted", law.geometric_deviation);
                let help = "it is a factor: 1.3 puts two thirds of the grains within 30 % of the median";
                check.fail_with(&format!("{key}.lognormal.geometric_deviation"), message, help);
            }
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
    check.faults.len() == before
}

/// Lengths that must not fall from one to the next.
fn ordered(check: &mut Check, key: &str, bounds: &[(&str, Length)]) {
    for pair in bounds.windows(2) {
        if let [(low, small), (high, large)] = pair
            && small > large
        {
            let found = readable(large.si(), "m");
            let bound = readable(small.si(), "m");
            check.fail(&format!("{key}.{high}"), format!("{high} = {found} is below {low} = {bound}"));
        }
    }
}

fn placement(check: &mut Check, key: &str, group: &GrainGroup) {
    match &group.placement {
        Placement::Random(law) => random(check, &format!("{key}.random"), law, &group.size),
        Placement::Lattice(law) => lattice(check, &format!("{key}.lattice"), law, &group.size),
        Placement::Table(law) if law.file.as_os_str().is_empty() => {
            check.fail(&format!("{key}.table.file"), "is empty; the name of a CSV file is wanted".to_owned());
        }
        Placement::Table(_) | Placement::List(_) => {}
    }
}

fn random(check: &mut Check, key: &str, law: &RandomAddition, size: &Size) {
    check.not_negative(&format!("{key}.gap"), law.gap);
    let fits = check.region(&format!("{key}.region"), &law.region) && holds(check, key, &law.region, size);
    match (law.count, law.solid_fraction) {
        (None, None) => check.fail(key, "needs count or solid_fraction; neither is given".to_owned()),
        (Some(_), Some(_)) => {
            let message = "count and solid_fraction are both given; one is wanted".to_owned();
            check.fail_with(&format!("{key}.solid_fraction"), message, "remove one of them");
        }
        (Some(0), None) => check.at_least_one(&format!("{key}.count"), 0),
        (None, Some(fraction)) if fraction <= 0.0 || fraction >= 1.0 => {
            let message = format!("found {fraction}; a number above 0 and below 1 is wanted");
            check.fail(&format!("{key}.solid_fraction"), message);
        }
        (Some(count), None) if fits => {
            let fraction = f64::from(count) * mean_volume(size) / law.region.volume();
            if count >= 10 {
                saturation(check, &format!("{key}.count"), fraction, law, size);
            }
        }
        (None, Some(fraction)) => saturation(check, &format!("{key}.solid_fraction"), fraction, law, size),
        _ => {}
    }
}

/// Random addition jams: a denser packing must be refused, not waited for.
fn saturation(check: &mut Check, key: &str, fraction: f64, law: &RandomAddition, size: &Size) {
    let limit = if matches!(size, Size::Constant(_)) { SATURATION } else { 0.6 };
    let swollen = (1.0 + 0.5 * law.gap.si() / size.largest()).powi(3) * fraction;
    if swollen > limit {
        let of_what = if law.gap.si() > 0.0 { ", with half the gap around each grain," } else { "" };
        let message = format!(
            "the solid fraction{of_what} is {}; random sequential addition saturates at {limit}",
            digits(swollen)
        );
        let help = "take fewer grains or a larger region, or place them with `lattice` (relax afterwards)";
        check.fail_with(key, message, help);
    }
}

/// Mean volume [m³] of one grain; that of a lognormal without its cuts.
pub(in crate::scenario) fn mean_volume(size: &Size) -> f64 {
    let cube = match size {
        Size::Constant(law) => law.radius.si().powi(3),
        Size::Uniform(law) => {
            let (a, b) = (law.smallest.si(), law.largest.si());
            0.25 * (a + b) * (a * a + b * b)
        }
        Size::Lognormal(law) => {
            let spread = law.geometric_deviation.ln();
            let whole = law.median.si().powi(3) * (4.5 * spread * spread).exp();
            whole.clamp(law.smallest.si().powi(3), law.largest.si().powi(3))
        }
        Size::Table(law) => {
            let total: f64 = law.shares.iter().sum();
            law.radii.iter().zip(&law.shares).map(|(r, share)| share * r.si().powi(3)).sum::<f64>() / total
        }
    };
    4.0 / 3.0 * PI * cube
}

/// Whether the largest grain fits into the region.
fn holds(check: &mut Check, key: &str, region: &Region, size: &Size) -> bool {
    let radius = size.largest();
    let fits = region.contains(region.center(), radius);
    if !fits {
        let diameter = shown(2.0 * radius, Length::DIMENSION);
        let message = format!("a grain of diameter {diameter} does not fit into it");
        check.fail_with(&format!("{key}.region"), message, "enlarge the region or take smaller grains");
    }
    fits
}

fn lattice(check: &mut Check, key: &str, law: &Lattice, size: &Size) {
    if check.region(&format!("{key}.region"), &law.region) {
        holds(check, key, &law.region, size);
    }
    let diameter = 2.0 * size.largest();
    check.positive(&format!("{key}.spacing"), law.spacing);
    // The bound leaves room for the rounding of a spacing that is written as twice a radius.
    if law.spacing.si() > 0.0 && law.spacing.si() < diameter * (1.0 - 1e-12) {
        let (spacing, least) = (readable(law.spacing.si(), "m"), readable(diameter, "m"));
        let message = format!("{spacing} is less than the largest diameter {least}: grains would overlap");
        check.fail(&format!("{key}.spacing"), message);
    }
    if law.count == Some(0) {
        check.at_least_one(&format!("{key}.count"), 0);
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
