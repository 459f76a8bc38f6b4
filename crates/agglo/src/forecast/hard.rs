//! What is planned for hard spheres, and what to keep in mind of their laws.

use super::gas::Gas;
use super::mean_field::{Forecast, MeanField, Now};
use super::{Plan, about};
use crate::domain::Boundary;
use crate::engine::hard::{Distance, Driver, Pairs, TimeStepped};
use crate::impact::fragmentation::{BreakingEnergy, surface};
use crate::impact::restitution::Hardness;
use crate::impact::{Impact, Sticking, softening};
use crate::packing::GrainGroup;
use crate::particles::Material;
use crate::run::{Rehearsal, Summary};
use crate::scenario::{Measures, Scenario};
use crate::text::{digits, readable};

/// Impacts whose number says something of those to come.
const ENOUGH_IMPACTS: u64 = 30;
/// The fastest pair that matters for the step is about this many times as fast as the mean one.
const FASTEST: f64 = 2.0;

/// Impacts, steps and time of a run of hard spheres: as means have it, held to what the first moments came to.
pub(super) fn estimate(plan: &mut Plan, scenario: &Scenario, gas: &Gas, tried: Option<&Rehearsal>) {
    let (grains, end) = (plan.grains as f64, scenario.time.end.si());
    let Some(found) = means(scenario, gas, grains, end) else {
        plan.notes.push(
            "impacts, steps and time are not known: in the mean field they are beyond numbers".to_owned(),
        );
        return describe(plan, scenario, gas, grains);
    };
    plan.impacts = found.impacts;
    let reckoned = Some((found.grains, ", reckoned as equal ones"));
    let whose = match tried.map(|tried| (tried, &tried.summary)) {
        Some((Rehearsal { trouble: Some(trouble), time, .. }, _)) => {
            plan.notes.push(format!("a run would fail at {time} s: {trouble}"));
            None
        }
        Some((tried, Summary::Hard(summary))) if tried.is_finished => {
            (plan.impacts, plan.steps) = (summary.counts.impacts as f64, Some(summary.run.steps as f64));
            plan.seconds = Some(tried.start_s + tried.quiet.all.wall_s);
            Some((summary.growth.grains_end as f64, ""))
        }
        Some((tried, Summary::Hard(summary))) => {
            let part = means(scenario, gas, grains, tried.time).unwrap_or_default();
            carry_on(plan, end, tried, summary.counts.impacts, [&found, &part]);
            reckoned
        }
        _ => reckoned,
    };
    if let Some((left, how)) = whose {
        expectations(plan, left, how);
    }
    describe(plan, scenario, gas, grains);
}

/// What becomes of the means until `end` [s]; nothing where that is beyond numbers.
pub(super) fn means(scenario: &Scenario, gas: &Gas, grains: f64, end: f64) -> Option<Forecast> {
    let stepped = match &scenario.hard()?.driver {
        Driver::TimeStepped(law) => Some(law),
        Driver::EventDriven(_) => None,
    };
    let length = |now: &Now| stepped.map_or(f64::INFINITY, |law| step(law, now).min(end));
    if let Some(field) = MeanField::new(scenario, gas, grains) {
        return field.run(end, &length);
    }
    let step = stepped.map_or(f64::INFINITY, |law| law.longest_step.si().min(end));
    Some(Forecast { grains, steps: end / step, ..Forecast::default() })
}

/// Carries what was tried on to the end: as many more impacts and steps as the means have more until then.
fn carry_on(plan: &mut Plan, end: f64, tried: &Rehearsal, impacts: u64, [whole, part]: [&Forecast; 2]) {
    let (so_far, latest) = (tried.quiet.all, tried.quiet.latest());
    let is_known = impacts >= ENOUGH_IMPACTS && part.impacts > 0.0;
    if is_known {
        plan.impacts *= impacts as f64 / part.impacts;
    }
    // Nothing was tried that could be carried on.
    if latest.time <= 0.0 {
        return;
    }
    let more = if part.steps > 0.0 {
        so_far.steps * (whole.steps / part.steps - 1.0)
    } else if is_known {
        so_far.steps * (whole.impacts / part.impacts - 1.0)
    } else {
        latest.steps * (end - tried.time) / latest.time
    };
    plan.steps = Some(so_far.steps + more);
    plan.seconds = Some(tried.start_s + so_far.wall_s + more * latest.wall_s / latest.steps.max(1.0));
}

/// What will become of the grains: `left` at the end, and how that is known.
fn expectations(plan: &mut Plan, left: f64, how: &str) {
    let impacts = plan.impacts;
    let change = (left / plan.grains as f64).ln();
    let mut row = |label: &str, words: String| plan.quantities.push((label.to_owned(), words));
    if impacts > 0.0 {
        row("impacts", format!("about {}", about(impacts)));
    }
    if change < -0.01 {
        row("grains at the end", format!("about {}{how}", about(left.round())));
    } else if change > 0.01 {
        row("grains at the end", "more than at the start".to_owned());
    }
}

/// A mean step of the time-stepped engine [s].
fn step(law: &TimeStepped, now: &Now) -> f64 {
    let relative_speed = 4.0 / std::f64::consts::PI.sqrt() * now.deviation;
    let step = match law.distance {
        // With all gaps in play the next impact of any pair is what a step must not pass.
        Distance::Gap => 1.0 / now.rate / steps_to_an_impact(law, 1.0 / now.rate),
        Distance::Centers => law.fraction * 2.0 * now.radius / (FASTEST * relative_speed),
    };
    step.clamp(law.shortest_step.si(), law.longest_step.si())
}

/// Each step takes a part of the time that is left [s], until the shortest one is long enough.
fn steps_to_an_impact(law: &TimeStepped, left: f64) -> f64 {
    let steps = (left / law.shortest_step.si()).ln() / -(-law.fraction.min(0.99)).ln_1p();
    steps.max(1.0)
}

fn describe(plan: &mut Plan, scenario: &Scenario, gas: &Gas, grains: f64) {
    plan.quantities.push(("solid fraction".to_owned(), digits(gas.solid_fraction)));
    if gas.rate > 0.0 && grains > 1.0 && gas.free_path.is_finite() && gas.free_time.is_finite() {
        let way = format!("{}, {}", readable(gas.free_path, "m"), readable(gas.free_time, "s"));
        plan.quantities.push(("from impact to impact".to_owned(), format!("{way} at the start")));
    }
    let Some(laws) = scenario.impact() else { return };
    if let Some(law) = laws.restitution.hardness() {
        let unbreakable = is_unbreakable(scenario, laws, gas);
        for (index, group) in scenario.grains.iter().enumerate() {
            let found = scenario.materials.get(&group.material).and_then(|m| threshold(law, m, group));
            if let Some(threshold) = found {
                let words = threshold.words(laws, unbreakable);
                plan.quantities.push((format!("grains {index}"), words));
            }
        }
    }
    if laws.fragmentation.is_some() && is_unbreakable(scenario, laws, gas) {
        let words = "none: two grains in one cost more to part than all fly with".to_owned();
        plan.quantities.push(("breakage".to_owned(), words));
    }
}

/// Whether all kinetic energy together could not part two grains that are one.
fn is_unbreakable(scenario: &Scenario, laws: &Impact, gas: &Gas) -> bool {
    let Some(law) = &laws.fragmentation else { return true };
    let energy = match law.energy {
        BreakingEnergy::Published => gas.kinetic[0],
        BreakingEnergy::CenterOfMass => gas.kinetic[1],
    };
    let cost = |group: &GrainGroup| {
        let surface_energy = scenario.materials.get(&group.material)?.surface_energy?.si();
        Some(surface(2, surface_energy, 2_f64.cbrt() * group.size.smallest(), 2))
    };
    scenario.grains.iter().filter_map(cost).all(|cost| cost > energy)
}

/// Where grains of one group stop to rebound.
pub(super) struct Threshold {
    /// Speed of approach from which two equal grains stick, 2 sqrt(3 af H β/(2ρ)) [m/s], [B] 4.15.
    pub speed: f64,
    /// Radius at which an impact as fast as that breaks them into eight, 4 γ/(H af β) [m], [B] 5.5.
    pub radius: Option<f64>,
}

/// At the temperature of the start; heat softens.
pub(super) fn threshold(law: &Hardness, material: &Material, group: &GrainGroup) -> Option<Threshold> {
    let hardness = softening::Hardness::of(material)?.at(group.temperature.si());
    let resistance = hardness * law.sticking_area * law.deformation;
    Some(Threshold {
        speed: 2.0 * (1.5 * resistance / material.density.si()).sqrt(),
        radius: material.surface_energy.map(|energy| 4.0 * energy.si() / resistance),
    })
}

impl Threshold {
    fn words(&self, laws: &Impact, unbreakable: bool) -> String {
        let what = match laws.sticking {
            Sticking::Merge => "stick",
            Sticking::Never => "do not rebound",
        };
        let approach = readable(self.speed, "m/s");
        match (&laws.fragmentation, self.radius) {
            (Some(_), Some(radius)) if !unbreakable => {
                let radius = readable(radius, "m");
                format!(
                    "two equal ones {what} from an approach of {approach}; above a radius of {radius} they break into eight there"
                )
            }
            _ => format!("two equal ones {what} from an approach of {approach}"),
        }
    }
}

/// Laws that do not converge, and what has no effect.
pub(super) fn notes(notes: &mut Vec<String>, scenario: &Scenario) {
    let Some(hard) = scenario.hard() else { return };
    let mut note = |words: &str| notes.push(words.to_owned());
    if let Driver::TimeStepped(law) = &hard.driver {
        if law.pairs == Pairs::Nearest {
            note(
                "engine.time_stepped.pairs = nearest: grains that touch others than their nearest neighbor pass into them; all does not",
            );
        }
        if law.distance == Distance::Centers {
            note(
                "engine.time_stepped.distance = centers: steps are longer than gaps allow, so impacts are missed; gap does not",
            );
        }
    }
    if let Driver::EventDriven(law) = &hard.driver
        && law.contact_duration.is_some_and(|duration| duration.si() == 0.0)
    {
        note("engine.event_driven.contact_duration is 0: inelastic collapse may bring the clock to a halt");
    }
    match hard.volume.boundary {
        Boundary::Antipodal => note(
            "volume.boundary = antipodal: grains on two sides of a face do not see one another, and may enter into others; periodic is consistent",
        ),
        Boundary::Open => {
            note("volume.boundary = open: grains that leave the volume do not come back");
        }
        _ => {}
    }
    idle(&mut note, scenario, &hard.impact);
    without_effect(&mut note, scenario);
}

/// Laws that find nothing to act on.
fn idle(note: &mut dyn FnMut(&str), scenario: &Scenario, laws: &Impact) {
    let used = || scenario.grains.iter().filter_map(|group| scenario.materials.get(&group.material));
    let radiates = used().any(|material| material.emissivity.is_some_and(|emissivity| emissivity > 0.0));
    if laws.cooling.as_ref().is_some_and(|law| law.convection.si() == 0.0) && !radiates {
        note("impact.cooling has no effect: convection is 0 and no material in use has an emissivity");
    }
    if laws.tangential.as_ref().is_some_and(|law| law.friction == 0.0) && scenario.mixtures.is_empty() {
        note("impact.tangential has no effect: friction is 0");
    }
}

/// Keys that hard spheres do not ask for.
fn without_effect(note: &mut dyn FnMut(&str), scenario: &Scenario) {
    for (index, group) in scenario.grains.iter().enumerate() {
        let given = [
            ("angular_velocity", group.angular_velocity.iter().any(|one| one.si() != 0.0)),
            ("charge", group.charge.si() != 0.0),
            ("polarity", group.polarity != 1.0),
        ];
        for (key, _) in given.into_iter().filter(|(_, given)| *given) {
            note(&format!("grains.{index}.{key} has no effect on hard spheres"));
        }
    }
    if scenario.medium != crate::acoustics::Medium::default() {
        note("medium has no effect on hard spheres: they fly straight between impacts");
    }
    if scenario.measures != Measures::default() {
        note("measures.cluster_gap has no effect on hard spheres: what sticks becomes one sphere");
    }
}
