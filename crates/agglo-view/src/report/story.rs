//! What happened, in plain words.

use super::folder::Folder;
use agglo::engine::soft::Limits;
use agglo::folder::names::SUMMARY;
use agglo::run::{HardSummary, SoftSummary, Summary};
use agglo::text::readable;

/// A few sentences on what a run came to.
pub fn story(summary: &Summary) -> String {
    match summary {
        Summary::Soft(summary) => soft(summary),
        Summary::Hard(summary) => hard(summary),
    }
}

/// What is known of a run without a summary: how far it got and how many grains it had then.
pub fn unfinished(folder: &Folder, grains: Option<u64>) -> String {
    let Some(reached) = folder.reached() else { return String::new() };
    let mut words = Vec::new();
    match folder.scenario.as_ref().map(|scenario| scenario.time.end.0) {
        Some(end) => {
            let part = (100.0 * reached / end).min(100.0);
            let verb = if reached < end { "stopped at" } else { "reached" };
            words.push(format!("The run {verb} {} of {}, {part:.0} %.", time(reached), time(end)));
            if reached < end && folder.has_checkpoint() {
                words.push(format!("Type \"agglo resume {}\" to go on.", folder.root.display()));
            } else if reached < end {
                words.push("There is no checkpoint from which it could go on.".to_owned());
            }
        }
        None => {
            words.push(format!("The tables go to {}; where the run was to end is not known.", time(reached)));
        }
    }
    words.extend(grains.map(|count| format!("It had {} then.", self::grains(count))));
    words.push(format!("Warnings are unknown: {SUMMARY}, which has them, is missing or damaged."));
    words.join(" ")
}

fn soft(summary: &SoftSummary) -> String {
    let mut words = Vec::new();
    if summary.energy.is_alarming() {
        words.push(unexplained(summary.energy.unexplained_largest, summary.energy.unexplained_limit));
    }
    let count = summary.grains as u64;
    words.push(format!("{} {} followed for {}.", grains(count), was(count), time(summary.time_s)));
    let rays: u64 = summary.pulses.iter().map(|pulse| pulse.rays).sum();
    if rays > 0 {
        let [launched, absorbed]: [f64; 2] = [
            summary.pulses.iter().map(|pulse| pulse.power_in).sum(),
            summary.pulses.iter().map(|pulse| pulse.power_absorbed).sum(),
        ];
        let pulses = counted(summary.pulses.len() as u64, "acoustic pulse");
        let part = percent(absorbed / launched);
        words.push(format!(
            "{pulses} of {rays} rays in all hit them; the grains took up {part} of the power."
        ));
    }
    if summary.bonds_start > 0 {
        let broken = summary.bonds_start.saturating_sub(summary.bonds_end);
        let part = percent(broken as f64 / summary.bonds_start as f64);
        words.push(format!("Of {} bonds {broken} broke ({part}).", summary.bonds_start));
    }
    let [start, clusters] = [&summary.clusters_start, &summary.clusters];
    if start.count > 1 {
        let part = percent(start.largest_fraction);
        words.push(format!("They began as {} clusters, the largest with {part} of the mass.", start.count));
    }
    words.push(match clusters.count {
        1 => "At the end they are one cluster.".to_owned(),
        count => format!(
            "At the end they are {count} clusters, the largest with {} of the mass: a dispersion degree of {:.3}, {:.3} \
             relative to the start.",
            percent(clusters.largest_fraction),
            summary.dispersion_degree,
            summary.dispersion_degree_relative
        ),
    });
    words.push(drift(summary.energy.balance.drift_relative));
    words.join(" ")
}

fn hard(summary: &HardSummary) -> String {
    let (part, limit) = (summary.energy.unexplained(), Limits::default().drift_warning);
    let mut words: Vec<String> = (part > limit).then(|| unexplained(part, limit)).into_iter().collect();
    words.push(format!(
        "{} moved for {} and collided {}: {}, {} and {}.",
        grains(summary.growth.grains_start),
        time(summary.run.time_s),
        counted(summary.counts.impacts, "time"),
        counted(summary.counts.bounces, "bounce"),
        counted(summary.counts.merges, "merge"),
        counted(summary.counts.fragmentations, "breakage"),
    ));
    words.push(format!(
        "{} {} left, in the mean {:.3} times as large as at the start.",
        grains(summary.growth.grains_end),
        if summary.growth.grains_end == 1 { "is" } else { "are" },
        summary.growth.radius_ratio
    ));
    if summary.growth.largest_primaries > 1 {
        words.push(format!(
            "The largest holds {} of the first grains, {} of the mass.",
            summary.growth.largest_primaries,
            percent(summary.growth.largest_fraction)
        ));
    }
    words.push(format!(
        "Their mean temperature is {} (the hottest has {}).",
        readable(summary.motion.temperature_mean, "K"),
        readable(summary.motion.temperature_highest, "K")
    ));
    words.push(drift(summary.energy.drift_relative));
    words.join(" ")
}

fn grains(count: u64) -> String {
    counted(count, "grain")
}

fn was(count: u64) -> &'static str {
    if count == 1 { "was" } else { "were" }
}

fn counted(count: u64, what: &str) -> String {
    if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") }
}

fn time(seconds: f64) -> String {
    readable(seconds, "s")
}

fn percent(part: f64) -> String {
    format!("{:.1} %", 100.0 * part)
}

/// The first thing to know of a run whose energy does not add up.
fn unexplained(part: f64, limit: f64) -> String {
    format!(
        "Not all energy is accounted for: up to {part:.1e} of all there was comes from nothing or is lost, above the limit of \
         {limit:e}. Make the step smaller before you trust these quantities."
    )
}

fn drift(relative: f64) -> String {
    format!("Energy is accounted for to {:.1e} of all there was.", relative.abs())
}

#[cfg(test)]
#[path = "story_tests.rs"]
mod tests;
