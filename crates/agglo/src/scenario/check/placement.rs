//! Rules of placements.

use super::{Check, region, shown};
use crate::domain::{Region, Volume};
use crate::packing::{Fill, GrainGroup, Lattice, Placement, RandomAddition, SATURATION, Size};
use crate::scenario::file::ScenarioFile;
use crate::text::{digits, told_apart};
use crate::units::Length;

pub(super) fn check(check: &mut Check, key: &str, group: &GrainGroup, scenario: &ScenarioFile) {
    match &group.placement {
        Placement::Random(law) => random(check, &format!("{key}.random"), law, &group.size),
        Placement::Fill(law) => fill(check, &format!("{key}.fill"), law, &group.size, scenario),
        Placement::Lattice(law) => lattice(check, &format!("{key}.lattice"), law, &group.size),
        Placement::Table(law) if law.file.as_os_str().is_empty() => {
            check.fail(&format!("{key}.table.file"), "is empty; the name of a CSV file is wanted".to_owned());
        }
        Placement::Table(_) | Placement::List(_) => {}
    }
}

fn random(check: &mut Check, key: &str, law: &RandomAddition, size: &Size) {
    check.not_negative(&format!("{key}.gap"), law.gap);
    let fits = region(check, &format!("{key}.region"), &law.region) && holds(check, key, &law.region, size);
    let volume = fits.then(|| law.region.volume());
    let way_out = "take fewer grains or a larger region, or place them with `lattice` (relax afterwards)";
    let wanted =
        Amount { count: law.count, solid_fraction: law.solid_fraction, gap: law.gap, volume, way_out };
    if amount(check, key, &wanted, size)
        && fits
        && let Err(reason) = law.wanted(size)
    {
        check.fail(key, reason);
    }
}

fn fill(check: &mut Check, key: &str, law: &Fill, size: &Size, scenario: &ScenarioFile) {
    if !scenario.engine.is_hard() && scenario.volume.is_none() {
        let message = "fills [volume], and there is none".to_owned();
        check.fail_with(key, message, "give [volume], or take placement.random with a region");
    }
    check.not_negative(&format!("{key}.gap"), law.gap);
    let volume = scenario.volume.as_ref().filter(|volume| {
        let edges = volume.edges();
        edges.x > 0.0 && edges.y > 0.0 && edges.z > 0.0
    });
    let way_out = "take fewer or smaller grains or a larger volume, or place them with `lattice`";
    let wanted = Amount {
        count: law.count,
        solid_fraction: law.solid_fraction,
        gap: law.gap,
        volume: volume.map(Volume::volume),
        way_out,
    };
    if amount(check, key, &wanted, size)
        && let Some(volume) = volume
        && let Err(reason) = law.wanted(size, volume)
    {
        check.fail(key, reason);
    }
}

/// How many grains random addition is asked for, in which volume [m³] if that is valid.
struct Amount {
    count: Option<u32>,
    solid_fraction: Option<f64>,
    gap: Length,
    volume: Option<f64>,
    /// What to do where there is no room.
    way_out: &'static str,
}

/// Whether the amount is valid.
fn amount(check: &mut Check, key: &str, wanted: &Amount, size: &Size) -> bool {
    let before = check.found().len();
    match (wanted.count, wanted.solid_fraction) {
        (None, None) => check.fail(key, "needs count or solid_fraction; neither is given".to_owned()),
        (Some(_), Some(_)) => {
            let message = "count and solid_fraction are both given; one is wanted".to_owned();
            check.fail_with(&format!("{key}.solid_fraction"), message, "remove one of them");
        }
        (Some(0), None) => check.at_least_one(&format!("{key}.count"), 0),
        (Some(count), None) => {
            let fraction = wanted.volume.map(|volume| f64::from(count) * size.mean_volume() / volume);
            if let Some(fraction) = fraction
                && count >= 10
            {
                saturation(check, &format!("{key}.count"), fraction, wanted, size);
            }
        }
        (None, Some(fraction)) if fraction <= 0.0 || fraction >= 1.0 => {
            let message = format!("found {fraction}; a number above 0 and below 1 is wanted");
            check.fail(&format!("{key}.solid_fraction"), message);
        }
        (None, Some(fraction)) => {
            saturation(check, &format!("{key}.solid_fraction"), fraction, wanted, size);
        }
    }
    check.found().len() == before
}

/// Random addition jams: a denser packing must be refused, not waited for.
fn saturation(check: &mut Check, key: &str, fraction: f64, wanted: &Amount, size: &Size) {
    let equal = matches!(size, Size::Constant(_) | Size::LengthRatio(_));
    let limit = if equal { SATURATION } else { 0.6 };
    let gap = wanted.gap;
    let swollen = (1.0 + 0.5 * gap.si() / size.largest()).powi(3) * fraction;
    if swollen <= limit {
        return;
    }
    let of_what = if gap.si() > 0.0 { ", with half the gap around each grain," } else { "" };
    let [swollen_is, limit_is] = told_apart([swollen, limit], "");
    let message = format!(
        "the solid fraction{of_what} is {swollen_is}; random sequential addition saturates at {limit_is}"
    );
    if let Size::LengthRatio(law) = size {
        // In a box of side 2D the solid fraction is (4/3) pi L³/8.
        let most = (1000.0 * law.ratio * (limit / swollen).cbrt()).floor() / 1000.0;
        let help = format!(
            "take a ratio L up to {}: in the box of side 2D the solid fraction is (4/3) pi L^3/8",
            digits(most)
        );
        check.fail_with(key, message, help);
    } else {
        check.fail_with(key, message, wanted.way_out);
    }
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
    if region(check, &format!("{key}.region"), &law.region) {
        holds(check, key, &law.region, size);
    }
    let diameter = 2.0 * size.largest();
    check.positive(&format!("{key}.spacing"), law.spacing);
    // The bound leaves room for the rounding of a spacing that is written as twice a radius.
    if law.spacing.si() > 0.0 && law.spacing.si() < diameter * (1.0 - 1e-12) {
        let [spacing, least] = told_apart([law.spacing.si(), diameter], "m");
        let message = format!("{spacing} is less than the largest diameter {least}: grains would overlap");
        check.fail(&format!("{key}.spacing"), message);
    }
    if law.count == Some(0) {
        check.at_least_one(&format!("{key}.count"), 0);
    }
}
