//! What a run of hard spheres came to.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::engine::hard::{Balance, Counts, Simulation};
use crate::engine::soft::Limits;
use crate::run::summary::{time_row, wall_row, warnings_row};
use crate::scenario::Scenario;
use crate::text::readable;

use super::growth::Growth;
use super::scales::Scales;

/// Part of all impacts that bounces made elastic may be before it is said that they can matter.
const GUARDED_SHARE: f64 = 0.01;
/// Part of the energy that impacts took that such bounces may have kept.
const KEPT_SHARE: f64 = 1e-3;
/// Told where they can matter.
const GUARD_MATTERS: &str = "bounces made elastic against inelastic collapse are more than 1 % of all impacts, or kept more \
                             than 0.1 % of the energy that impacts took: the gas is too dense or loses too much for hard \
                             spheres; see whether another engine.event_driven.contact_duration changes the answer";

/// What a run of hard spheres came to; `summary.json` holds the same. Figures that cannot be had are null.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct HardSummary {
    /// Version of agglo.
    pub version: String,
    /// The scenario's title.
    pub title: String,
    /// Wall time [s], all sittings together.
    pub wall_s: f64,
    /// Simulated time [s].
    pub time_s: f64,
    /// Ends [s] that the run had before it went on; none where it never got another end.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub went_on_from_s: Vec<f64>,
    /// Steps, or events.
    pub steps: u64,
    /// What `steps` counts: "steps" or "events".
    pub steps_are: String,
    /// Mean simulated time of a step, or between two events [s].
    pub step_mean_s: Option<f64>,
    /// Bounces of a pair that followed one another within this time again and again were elastic [s].
    pub contact_duration_s: f64,
    /// Grains at the end.
    pub grains: u64,
    /// Threads.
    pub threads: usize,
    /// Seed.
    pub seed: u64,
    /// Grains at the start.
    pub grains_start: u64,
    /// Grains at the end.
    pub grains_end: u64,
    /// Mean radius at the start [m].
    pub mean_radius_start_m: f64,
    /// Mean radius at the end [m].
    pub mean_radius_m: f64,
    /// Mean radius at the end over that at the start.
    pub radius_ratio: f64,
    /// The cost of [B] 7.1: 1 - mean radius over the radius of one sphere of all the solid.
    #[serde(alias = "pi")]
    pub growth_deficit: f64,
    /// The third power of `radius_ratio`.
    pub n_f: f64,
    /// Largest radius at the end [m].
    pub largest_radius_m: f64,
    /// Largest radius at the end over the mean radius at the start.
    pub largest_radius_ratio: f64,
    /// Most primaries of a grain at the end.
    pub largest_primaries: u32,
    /// Mass of the largest grain over that of all.
    pub largest_fraction: f64,
    /// Radius at which the largest grain's own gravity would matter ([B] 4.16) [m].
    pub self_gravity_radius_m: Option<f64>,
    /// Largest radius at the end over that.
    pub largest_over_self_gravity: Option<f64>,
    /// Largest Biot number at the end; null without cooling or without a thermal conductivity.
    pub biot_number: Option<f64>,
    /// Largest Reynolds number at the end, in the medium at rest; null where the scenario does not name a medium.
    pub reynolds_number: Option<f64>,
    /// Impacts.
    pub impacts: u64,
    /// Impacts after which both went on.
    pub bounces: u64,
    /// Impacts after which the two were one.
    pub merges: u64,
    /// Agglomerates that broke.
    pub fragmentations: u64,
    /// Agglomerates that did not break since there was no room for the fragments.
    pub fragmentations_without_room: u64,
    /// Bounces that were made elastic, since their pair had bounced again and again just before.
    pub impacts_guarded: u64,
    /// Kinetic energy that these would have lost, each by itself [J].
    #[serde(rename = "guarded_kept_J", default)]
    pub guarded_kept: f64,
    /// Impacts of spheres that overlapped.
    pub impacts_overlapping: u64,
    /// Bounces off walls.
    pub impacts_walls: u64,
    /// Merges, and impacts that broke one or both partners: rows of `events.csv`.
    pub events: u64,
    /// Steps, or events of the driver, per impact.
    pub events_per_impact: Option<f64>,
    /// Mean iterations of a coupled solve.
    pub solver_iterations_mean: Option<f64>,
    /// Most iterations of a coupled solve.
    pub solver_iterations_most: u32,
    /// Solves that did not end within their tolerance.
    pub solves_not_converged: u64,
    /// Mean temperature by mass at the end [K].
    #[serde(rename = "temperature_mean_K")]
    pub temperature_mean: f64,
    /// Lowest temperature at the end [K].
    #[serde(rename = "temperature_lowest_K")]
    pub temperature_lowest: f64,
    /// Highest temperature at the end [K].
    #[serde(rename = "temperature_highest_K")]
    pub temperature_highest: f64,
    /// Mean speed at the end [m/s].
    pub mean_speed_m_s: f64,
    /// Granular temperature at the end [m²/s²].
    pub granular_temperature_m2_s2: f64,
    /// The ledger of energy.
    pub energy: Balance,
    /// Momentum that walls do not explain, over the grains' momenta.
    pub momentum_drift_relative: f64,
    /// Warnings, with how often each came up.
    pub warnings: BTreeMap<String, u64>,
}

impl HardSummary {
    /// Draws up the summary of a simulation that ended; `mean_radius_start_m` in [m].
    pub fn new(
        scenario: &Scenario,
        simulation: &Simulation,
        mean_radius_start_m: f64,
        steps_are: &str,
        wall_s: f64,
    ) -> Self {
        let clock = simulation.clock();
        let now = simulation.snapshot();
        let growth = Growth::of(&now);
        let scales = Scales::of(scenario, &now, growth.largest);
        let per = |whole: f64, parts: u64| (parts > 0).then(|| whole / parts as f64);
        let impacts = simulation.system().state.counts.collisions;
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            title: scenario.title.clone(),
            wall_s,
            time_s: clock.time,
            steps: clock.step,
            steps_are: steps_are.to_owned(),
            step_mean_s: per(clock.time, clock.step),
            contact_duration_s: simulation.system().contact_duration,
            threads: rayon::current_num_threads(),
            seed: scenario.seed,
            grains_start: simulation.grains_at_start(),
            events_per_impact: per(clock.step as f64, impacts),
            energy: simulation.balance(),
            momentum_drift_relative: simulation.momentum_drift_relative(),
            warnings: simulation.system().state.warnings.counts().clone(),
            ..Self::default()
        }
        .with_growth(&growth, mean_radius_start_m)
        .with_scales(&scales)
        .with_counts(&simulation.system().state.counts)
        .with_guard(simulation.system().state.ledger.flows.kept)
    }

    fn with_growth(self, growth: &Growth, mean_radius_start_m: f64) -> Self {
        let ratio = growth.mean_radius / mean_radius_start_m;
        Self {
            grains: growth.grains as u64,
            grains_end: growth.grains as u64,
            mean_radius_start_m,
            mean_radius_m: growth.mean_radius,
            radius_ratio: ratio,
            growth_deficit: growth.cost(),
            n_f: ratio * ratio * ratio,
            largest_radius_m: growth.largest_radius,
            largest_radius_ratio: growth.largest_radius / mean_radius_start_m,
            largest_primaries: growth.largest_primaries,
            largest_fraction: growth.largest_fraction,
            temperature_mean: growth.mean_temperature,
            temperature_lowest: growth.lowest_temperature,
            temperature_highest: growth.highest_temperature,
            mean_speed_m_s: growth.mean_speed,
            granular_temperature_m2_s2: growth.granular_temperature,
            ..self
        }
    }

    fn with_scales(self, scales: &Scales) -> Self {
        let over = |radius: f64| self.largest_radius_m / radius;
        Self {
            self_gravity_radius_m: scales.self_gravity_radius,
            largest_over_self_gravity: scales.self_gravity_radius.map(over),
            biot_number: scales.biot,
            reynolds_number: scales.reynolds,
            ..self
        }
    }

    fn with_counts(self, counts: &Counts) -> Self {
        let solves = (counts.collisions > 0).then_some(counts.collisions);
        Self {
            impacts: counts.collisions,
            bounces: counts.bounces,
            merges: counts.merges,
            fragmentations: counts.fragmentations,
            fragmentations_without_room: counts.no_room,
            impacts_guarded: counts.guarded,
            impacts_overlapping: counts.overlapping,
            impacts_walls: counts.walls,
            events: counts.events,
            solver_iterations_mean: solves.map(|solves| counts.iterations as f64 / solves as f64),
            solver_iterations_most: counts.most_iterations,
            solves_not_converged: counts.not_converged,
            ..self
        }
    }

    /// What the guard against inelastic collapse kept [J]; and a warning where that can matter.
    fn with_guard(mut self, kept: f64) -> Self {
        self.guarded_kept = kept;
        let lost = self.energy.normal + self.energy.tangential;
        let can_matter = self.impacts_guarded as f64 > GUARDED_SHARE * self.impacts as f64
            || kept > KEPT_SHARE * (lost + kept);
        if self.impacts_guarded > 0 && can_matter {
            self.warnings.insert(GUARD_MATTERS.to_owned(), self.impacts_guarded);
        }
        self
    }

    /// How much the guard against inelastic collapse did, where it did anything.
    fn guard_row(&self) -> Option<(&'static str, String)> {
        let share = 100.0 * self.impacts_guarded as f64 / self.impacts as f64;
        let lost = self.energy.normal + self.energy.tangential;
        let part = 100.0 * self.guarded_kept / (lost + self.guarded_kept);
        let kept = readable(self.guarded_kept, "J");
        let figures = format!(
            "{} bounces of pairs that bounced again and again, {share:.2} % of the impacts; they kept {kept}, {part:.1e} % of what \
             impacts took",
            self.impacts_guarded
        );
        (self.impacts_guarded > 0).then_some(("made elastic", figures))
    }

    /// The summary as rows of a table: what, how much.
    pub fn table(&self) -> Vec<(String, String)> {
        let mut rows = vec![
            ("simulated time", time_row(self.time_s, self.steps, &self.steps_are)),
            ("wall time", wall_row(self.wall_s, self.threads)),
            ("grains", format!("{} left of {}", self.grains_end, self.grains_start)),
            ("mean radius", self.mean_radius_row()),
            ("growth", self.growth_row()),
            ("largest grain", self.largest_row()),
            ("impacts", self.impacts_row()),
        ];
        rows.extend(self.guard_row());
        rows.extend([
            ("temperature", self.temperature_row()),
            ("speed", format!("{} in the mean", readable(self.mean_speed_m_s, "m/s"))),
        ]);
        rows.extend(self.scale_rows());
        rows.extend(self.false_heat_row());
        rows.extend(self.unexplained_row());
        rows.extend([
            ("energy drift", format!("{:.3e} of all energy", self.energy.drift_relative)),
            ("momentum drift", format!("{:.3e} of all momentum", self.momentum_drift_relative)),
            ("warnings", warnings_row(&self.warnings)),
        ]);
        rows.into_iter().map(|(what, figure)| (what.to_owned(), figure)).collect()
    }

    /// How far the models are from their limits, where that can be said.
    fn scale_rows(&self) -> impl Iterator<Item = (&'static str, String)> {
        let gravity = self.self_gravity_radius_m.zip(self.largest_over_self_gravity);
        let gravity = gravity.map(|(radius, over)| {
            let radius = readable(radius, "m");
            ("self-gravity", format!("from a radius of {radius}; the largest grain has {over:.1e} of that"))
        });
        let biot = self.biot_number.map(|biot| {
            let holds = if biot < 0.1 { "holds" } else { "does not hold" };
            ("Biot number", format!("{biot:.2e}: one temperature for a grain {holds}"))
        });
        let reynolds = self.reynolds_number.map(|reynolds| ("Reynolds number", format!("{reynolds:.2e}")));
        [gravity, biot, reynolds].into_iter().flatten()
    }

    /// What is not to be overlooked.
    fn unexplained_row(&self) -> Option<(&'static str, String)> {
        let part = self.energy.unexplained();
        let is_alarming = part > Limits::default().drift_warning;
        is_alarming.then(|| {
            ("unexplained energy", format!("{part:.3e} of all energy: these figures are not to be believed"))
        })
    }

    /// What the drift of energy does not show: the ledger takes it as a flow of its own.
    fn false_heat_row(&self) -> Option<(&'static str, String)> {
        let part = self.energy.false_heat()?;
        let (joule, percent) = (readable(self.energy.unbalanced.abs(), "J"), 100.0 * part.abs());
        let what = if part > 0.0 { "made of nothing" } else { "lost without a trace" };
        Some(("false heat", format!("{joule} {what} at impacts, {percent:.1} % of the motion they took")))
    }

    fn mean_radius_row(&self) -> String {
        let [now, start] = [self.mean_radius_m, self.mean_radius_start_m].map(|radius| readable(radius, "m"));
        format!("{now}, {:.4} times the {start} at the start", self.radius_ratio)
    }

    fn growth_row(&self) -> String {
        format!("n_f {:.4}, Pi {:.5} (0 if all were one sphere)", self.n_f, self.growth_deficit)
    }

    fn largest_row(&self) -> String {
        let radius = readable(self.largest_radius_m, "m");
        let (count, part) = (self.largest_primaries, 100.0 * self.largest_fraction);
        let primaries = if count == 1 { "a single primary".to_owned() } else { format!("{count} primaries") };
        format!("radius {radius}, {primaries}, {part:.2} % of the mass")
    }

    fn impacts_row(&self) -> String {
        let Self { impacts, bounces, merges, fragmentations, .. } = self;
        format!("{impacts}: {bounces} bounces, {merges} merges, {fragmentations} breakages")
    }

    fn temperature_row(&self) -> String {
        let [mean, lowest, highest] =
            [self.temperature_mean, self.temperature_lowest, self.temperature_highest]
                .map(|kelvin| readable(kelvin, "K"));
        format!("{mean} in the mean, {lowest} to {highest}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn summary(guarded: u64, kept: f64) -> HardSummary {
        let energy = Balance { normal: 0.9, tangential: 0.1, ..Balance::default() };
        HardSummary { impacts: 1000, impacts_guarded: guarded, energy, ..HardSummary::default() }
            .with_guard(kept)
    }

    /// Up to 1 % of the impacts and 0.1 % of the energy it is told in a row, beyond that in a warning too.
    #[test]
    fn bounces_made_elastic_are_told() {
        let row = |summary: &HardSummary| {
            summary.table().into_iter().find(|(what, _)| what == "made elastic").map(|(_, figures)| figures)
        };
        assert_eq!(row(&summary(0, 0.0)), None);
        let few = summary(9, 0.5e-3);
        let figures = row(&few).unwrap();
        assert!(
            figures.contains("9 bounces") && figures.contains("0.90 %") && figures.contains("5.0e-2 % of"),
            "{figures}"
        );
        assert_empty!(few.warnings);
        assert_eq!(summary(11, 0.5e-3).warnings[GUARD_MATTERS], 11);
        assert_eq!(summary(9, 1.1e-3).warnings[GUARD_MATTERS], 9);
    }
}
