//! How many grains, rays and pulses, and the memory that they take.

use std::io::{BufRead, BufReader};
use std::path::Path;

use super::Plan;
use crate::domain::{Region, Volume};
use crate::folder::RunFolder;
use crate::packing::{GrainGroup, Lattice, LatticeKind, Placement, SATURATION};
use crate::record::door;
use crate::scenario::Scenario;
use crate::units::Time;

/// The program itself, with what writes its tables.
const BYTES_OF_PROGRAM: f64 = 14e6;
/// What makes a report, and what it keeps of each grain in each frame that it shows.
const BYTES_OF_REPORT: f64 = 10e6;
const BYTES_PER_SHOWN_GRAIN: f64 = 190.0;
/// What it keeps of each ray in each frame: place, direction and power.
const BYTES_PER_SHOWN_RAY: f64 = 56.0;
/// A report shows no more grains than this, all frames together: the rest is thinned out.
const MOST_SHOWN: f64 = 1.3e6;
/// Of the rays of a pulse, those that are in flight in the mean of its time.
pub(super) const PART_IN_FLIGHT: f64 = 0.5;
const BYTES_PER_GRAIN: f64 = 400.0;
const BYTES_PER_CONTACT: f64 = 200.0;
const BYTES_PER_RAY: f64 = 120.0;
/// A checkpoint has hardly fewer than this for each grain.
const BYTES_PER_SAVED_GRAIN: f64 = 150.0;
/// A row of a table of grains has hardly fewer than this.
const BYTES_PER_TABLE_ROW: f64 = 20.0;
/// Contacts and bonds per grain: a random packing has about six neighbors each, shared by two.
const CONTACTS_PER_GRAIN: f64 = 3.0;

/// Expected number of grains of each group.
pub(super) fn grains(plan: &mut Plan, scenario: &Scenario, base: &Path) -> Vec<u64> {
    let mut counts = Vec::new();
    for (index, group) in scenario.grains.iter().enumerate() {
        let count = match &group.placement {
            Placement::Table(table) => rows(&base.join(&table.file)).unwrap_or_else(|reason| {
                let file = table.file.display();
                plan.notes.push(format!("grains.{index}: cannot count the rows of {file}: {reason}"));
                0
            }),
            _ => count_of(group, scenario.volume()),
        };
        counts.push(count);
    }
    plan.grains = counts.iter().fold(0, |sum: u64, count| sum.saturating_add(*count));
    counts
}

/// Memory of the run, its report included; `flights` is how long rays fly in all [s].
pub(super) fn memory(plan: &mut Plan, scenario: &Scenario, flights: f64) {
    let [shown_grains, shown_rays] = shown(plan, scenario, flights);
    let report = BYTES_OF_REPORT + shown_grains * BYTES_PER_SHOWN_GRAIN + shown_rays * BYTES_PER_SHOWN_RAY;
    let [grains, rays] = [plan.grains, plan.rays_per_pulse].map(|count| count as f64);
    plan.memory = BYTES_OF_PROGRAM + of_state(grains, rays, scenario.is_hard()) + report;
}

/// Memory of grains, with the contacts of soft ones, and of rays [B].
pub(super) fn of_state(grains: f64, rays: f64, is_hard: bool) -> f64 {
    let contacts = if is_hard { 0.0 } else { CONTACTS_PER_GRAIN };
    grains * (BYTES_PER_GRAIN + contacts * BYTES_PER_CONTACT) + rays * BYTES_PER_RAY
}

/// Rows or frames that are due in a time without rays in flight and in one with rays [s]: while rays fly the denser of two
/// intervals holds.
pub(super) fn due([always, often]: [Option<Time>; 2], [quiet, flying]: [f64; 2]) -> [f64; 2] {
    let within = |interval: Option<Time>, time: f64| interval.map_or(0.0, |interval| time / interval.si());
    [within(always, quiet), within(always, flying).max(within(often, flying))]
}

/// Grains and rays in the frames that a report shows, all frames together.
pub(super) fn shown(plan: &Plan, scenario: &Scenario, flights: f64) -> [f64; 2] {
    let [quiet, flying] = frames(scenario, flights);
    let grains = (quiet + flying) * plan.grains as f64;
    let rays = flying * PART_IN_FLIGHT * plan.rays_per_pulse as f64;
    // The page leaves out frames, and with them rays, in the same part.
    let part = (MOST_SHOWN / grains.max(1.0)).min(1.0);
    [part * grains, part * rays]
}

/// Frames without and with rays in flight.
fn frames(scenario: &Scenario, flights: f64) -> [f64; 2] {
    let output = scenario.resolved().output;
    let intervals = [output.frames, output.pulses.unwrap_or_default().frames];
    let [quiet, flying] = due(intervals, [scenario.time.end.si() - flights, flights]);
    let first = if output.frames.is_some() { 1.0 } else { 0.0 };
    [first + quiet, flying]
}

pub(super) fn pulses(plan: &mut Plan, scenario: &Scenario) {
    for beam in scenario.acoustics().into_iter().flat_map(|acoustics| &acoustics.beams) {
        plan.rays_per_pulse += u64::from(beam.rays);
        plan.pulses += u64::from(pulses_before(beam, scenario.time.end.si()));
    }
}

/// Pulses of a beam that start before the end of the run [s].
pub(super) fn pulses_before(beam: &crate::acoustics::Beam, end: f64) -> u32 {
    let pulses = &beam.pulses;
    let room = end - pulses.first.si();
    match pulses.period {
        _ if room <= 0.0 => 0,
        Some(period) => pulses.count.min((room / period.si()).ceil() as u32),
        None => pulses.count.min(1),
    }
}

/// Expected number of grains of a group that is not read from a table.
pub(super) fn count_of(group: &GrainGroup, volume: Option<&Volume>) -> u64 {
    match &group.placement {
        Placement::Random(law) => law.wanted(&group.size).map_or(0, u64::from),
        Placement::Fill(law) => {
            volume.map_or(0, |volume| law.wanted(&group.size, volume).map_or(0, u64::from))
        }
        Placement::Lattice(law) => lattice(law, group.size.largest()) as u64,
        Placement::List(list) => list.positions.len() as u64,
        Placement::Table(_) => 0,
    }
}

/// The same however many they are, tables by the size of their files.
pub(super) fn expected(group: &GrainGroup, volume: Option<&Volume>, base: &Path) -> f64 {
    match &group.placement {
        // A run works all lattice points out before it takes `count` of them.
        Placement::Lattice(law) => lattice(&Lattice { count: None, ..law.clone() }, group.size.largest()),
        Placement::Table(table) => {
            let bytes = std::fs::metadata(base.join(&table.file)).map_or(0, |found| found.len());
            bytes as f64 / BYTES_PER_TABLE_ROW
        }
        _ => count_of(group, volume) as f64,
    }
}

/// Grains that another run brings, by the size of its newest checkpoint; 0 where none is asked for, or found.
pub(super) fn of_earlier_run(scenario: &Scenario, base: &Path) -> f64 {
    let Some(from) = &scenario.from else { return 0.0 };
    let state = RunFolder::newest_state(&base.join(from));
    let bytes = std::fs::metadata(state).map_or(0, |found| found.len());
    bytes as f64 / BYTES_PER_SAVED_GRAIN
}

/// Lattice points per volume, in a region smaller by a grain's radius on all sides.
fn lattice(law: &Lattice, radius: f64) -> f64 {
    let points_per_cube = match law.kind {
        LatticeKind::Cubic => 1.0,
        LatticeKind::Fcc | LatticeKind::Hcp => std::f64::consts::SQRT_2,
        LatticeKind::Bcc => 0.75 * 3.0_f64.sqrt(),
    };
    let found = (volume_inside(&law.region, radius) * points_per_cube / law.spacing.si().powi(3)).round();
    law.count.map_or(found, |most| f64::from(most).min(found)).max(1.0)
}

fn volume_inside(region: &Region, margin: f64) -> f64 {
    use std::f64::consts::PI;
    match region {
        Region::Sphere(ball) => 4.0 / 3.0 * PI * (ball.radius.si() - margin).max(0.0).powi(3),
        Region::Box(block) => (0..3)
            .map(|axis| (block.upper[axis].si() - block.lower[axis].si() - 2.0 * margin).max(0.0))
            .product(),
        Region::Cylinder(cylinder) => {
            PI * (cylinder.radius.si() - margin).max(0.0).powi(2)
                * (cylinder.length.si() - 2.0 * margin).max(0.0)
        }
    }
}

/// Rows of a table below its header.
fn rows(path: &Path) -> std::io::Result<u64> {
    let mut count = 0_u64;
    for line in BufReader::new(door::open(path)?).lines() {
        let line = line?;
        count += u64::from(!line.trim().is_empty() && !line.starts_with('#'));
    }
    Ok(count.saturating_sub(1))
}

/// Solid fraction that random addition is asked for.
pub(super) fn asked_fraction(group: &GrainGroup, volume: Option<&Volume>) -> Option<f64> {
    let (count, fraction, room) = match &group.placement {
        Placement::Random(law) => (law.count, law.solid_fraction, law.region.volume()),
        Placement::Fill(law) => (law.count, law.solid_fraction, volume?.volume()),
        Placement::Lattice(_) | Placement::Table(_) | Placement::List(_) => return None,
    };
    fraction.or_else(|| count.map(|count| f64::from(count) * group.size.mean_volume() / room))
}

/// Solid fraction from which random addition becomes slow.
pub(super) const SLOW_FRACTION: f64 = 0.9 * SATURATION;
