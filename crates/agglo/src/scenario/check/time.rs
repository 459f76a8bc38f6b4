//! Rules of time, stepping, limits, start, medium and output.

use super::Check;
use crate::engine::hard::TimeStepped;
use crate::measure::SizeClasses;
use crate::scenario::file::{EngineTable, ScenarioFile};
use crate::text::told_apart;

pub(super) fn check(check: &mut Check, scenario: &ScenarioFile) {
    if scenario.version != 1 {
        let message = format!("found {}; this program reads version 1", scenario.version);
        check.fail_with("version", message, "write version = 1");
    }
    if i64::try_from(scenario.seed).is_err() {
        check.fail("seed", format!("found {}; at most {} is allowed", scenario.seed, i64::MAX));
    }
    check.positive("time.end", scenario.time.end);
    engine(check, &scenario.engine);
    if let Some(limits) = &scenario.limits {
        check.above_zero("limits.displacement", limits.displacement);
        check.above_zero("limits.strain", limits.strain);
        check.above_zero("limits.drift_warning", limits.drift_warning);
        check.above_zero("limits.drift_error", limits.drift_error);
    }
    check.zero_or_more("measures.cluster_gap", scenario.measures.cluster_gap);
    if let Some(relax) = &scenario.start.relax {
        check.positive("start.relax.speed", relax.speed);
        check.positive("start.relax.longest", relax.longest);
        check.positive("start.relax.damping_time", relax.damping_time);
    }
    output(check, scenario);
    medium(check, scenario);
}

/// Part of the run's length below which turns can neither be counted nor told apart.
const SHORTEST_INTERVAL: f64 = 1e-12;

fn output(check: &mut Check, scenario: &ScenarioFile) {
    let output = &scenario.output;
    let pulses = output.pulses.clone().unwrap_or_default();
    let intervals = [
        ("series", output.series),
        ("frames", output.frames),
        ("checkpoints", output.checkpoints),
        ("pulses.series", pulses.series),
        ("pulses.frames", pulses.frames),
    ];
    for (name, interval) in intervals {
        if let Some(interval) = interval {
            check.positive(&format!("output.{name}"), interval);
            let least = SHORTEST_INTERVAL * scenario.time.end.si();
            if interval.si() > 0.0 && interval.si() < least {
                let [found, least] = told_apart([interval.si(), least], "s");
                check.fail(
                    &format!("output.{name}"),
                    format!("found {found}; at least {least}, a trillionth of time.end, is wanted"),
                );
            }
        }
    }
    if output.pulses.is_some() && scenario.acoustics.is_none() {
        let message = "is for rays, and there are none".to_owned();
        check.fail_with("output.pulses", message, "give [acoustics], or leave out [output.pulses]");
    }
    if let Some(classes) = &output.size_classes {
        size_classes(check, classes, scenario.engine.is_hard());
    }
}

fn size_classes(check: &mut Check, lower: &[u32], is_hard: bool) {
    let key = "output.size_classes";
    if !is_hard {
        let message = "is for hard spheres, whose merges and breakages are counted".to_owned();
        return check.fail_with(key, message, "leave it out");
    }
    let help = "give the fewest primaries of each class, such as [1, 2, 5, 20]";
    if lower.first() != Some(&1) {
        let found = lower.first().map_or("an empty list".to_owned(), |first| format!("{first} first"));
        check.fail_with(key, format!("found {found}; the first class begins at 1"), help);
    } else if let Some((before, next)) = lower.iter().zip(&lower[1..]).find(|(before, next)| before >= next) {
        let message = format!("found {next} after {before}; each class begins above the one before");
        check.fail_with(key, message, help);
    } else if lower.len() > SizeClasses::MOST {
        let message = format!("found {} classes; at most {} are allowed", lower.len(), SizeClasses::MOST);
        check.fail_with(key, message, help);
    }
}

fn engine(check: &mut Check, engine: &EngineTable) {
    match engine {
        EngineTable::Staggered(law) => {
            let key = |name: &str| format!("engine.staggered.{name}");
            check.positive(&key("initial_step"), law.initial_step);
            check.positive(&key("largest_step"), law.largest_step);
            if law.initial_step > law.largest_step {
                let [first, largest] = told_apart([law.initial_step.si(), law.largest_step.si()], "s");
                check.fail(&key("initial_step"), format!("{first} is longer than largest_step = {largest}"));
            }
            if law.tolerance <= 0.0 || law.tolerance >= 1.0 {
                let message = format!("found {}; a number above 0 and below 1 is wanted", law.tolerance);
                check.fail(&key("tolerance"), message);
            }
            check.at_least_one(&key("target_iterations"), law.target_iterations);
            check.within(&key("implicitness"), law.implicitness, 0.0, 1.0);
        }
        EngineTable::EventDriven(law) => {
            if let Some(duration) = law.contact_duration {
                check.not_negative("engine.event_driven.contact_duration", duration);
            }
        }
        EngineTable::TimeStepped(law) => time_stepped(check, law),
        EngineTable::Verlet(law) => {
            if let Some(step) = law.step {
                check.positive("engine.verlet.step", step);
            }
            if law.safety <= 0.0 || law.safety > 1.0 {
                let message = format!("found {}; a number above 0 and up to 1 is wanted", law.safety);
                check.fail("engine.verlet.safety", message);
            }
        }
    }
}

fn time_stepped(check: &mut Check, law: &TimeStepped) {
    let key = |name: &str| format!("engine.time_stepped.{name}");
    if law.fraction <= 0.0 || law.fraction > 1.0 {
        let message = format!("found {}; a number above 0 and up to 1 is wanted", law.fraction);
        check.fail(&key("fraction"), message);
    }
    check.positive(&key("shortest_step"), law.shortest_step);
    check.positive(&key("longest_step"), law.longest_step);
    if law.longest_step.si() > 0.0 && law.shortest_step > law.longest_step {
        let [shortest, longest] = told_apart([law.shortest_step.si(), law.longest_step.si()], "s");
        let message = format!("{shortest} is longer than longest_step = {longest}");
        check.fail(&key("shortest_step"), message);
    }
}

fn medium(check: &mut Check, scenario: &ScenarioFile) {
    let medium = &scenario.medium;
    check.positive("medium.sound_speed", medium.sound_speed);
    check.not_negative("medium.viscosity", medium.viscosity);
    if scenario.acoustics.is_some() && medium.density.si() == 0.0 {
        let message = "found 0 kg/m^3, but sound needs a medium".to_owned();
        check.fail_with("medium.density", message, "give a density above 0, or leave out [acoustics]");
    } else {
        check.not_negative("medium.density", medium.density);
    }
}
