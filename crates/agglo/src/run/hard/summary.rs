//! What a run of hard spheres came to.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::engine::hard::Simulation;
use crate::engine::soft::Limits;
use crate::ledger::Balance;
use crate::measure::{SizeTotals, is_uniform};
use crate::run::summary::{time_row, wall_row, warnings_row};
use crate::scenario::Scenario;
use crate::text::readable;

use super::growth::Growth;
use super::quantities::{
    CountQuantities, GrowthQuantities, MotionQuantities, RunQuantities, ScaleQuantities,
};
use super::scales::Scales;

/// Part of all impacts that bounces made elastic may be before it is said that they can matter.
const TC_SHARE: f64 = 0.01;
/// Part of the energy that impacts took that such bounces may have kept.
const KEPT_SHARE: f64 = 1e-3;
/// Told where they can matter.
const TC_MATTERS: &str = "bounces made elastic against inelastic collapse are more than 1 % of all impacts, or kept more \
                             than 0.1 % of the energy that impacts took: the gas is too dense or loses too much for hard \
                             spheres; see whether another engine.event_driven.contact_duration changes the answer";

/// What a run of hard spheres came to; `summary.json` holds the same. Quantities that cannot be had are null.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct HardSummary {
    /// What was run, for how long and how.
    #[serde(flatten)]
    pub run: RunQuantities,
    /// How far the grains have grown.
    #[serde(flatten)]
    pub growth: GrowthQuantities,
    /// How far the models are from their limits.
    #[serde(flatten)]
    pub scales: ScaleQuantities,
    /// What happened.
    #[serde(flatten)]
    pub counts: CountQuantities,
    /// How warm and how fast the grains are at the end.
    #[serde(flatten)]
    pub motion: MotionQuantities,
    /// The ledger of energy.
    pub energy: Balance,
    /// Momentum that walls do not explain, over the grains' momenta.
    pub momentum_drift_relative: f64,
    /// Warnings, with how often each came up.
    pub warnings: BTreeMap<String, u64>,
    /// What rates by size are worked out from, where classes of one's own are given. The tables have it, not the file.
    #[serde(skip)]
    pub size_totals: Option<SizeTotals>,
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
        let now = simulation.snapshot();
        let growth = Growth::of(&now);
        let scales = Scales::of(scenario, &now, growth.largest);
        let (grains, state) = (growth.grains as u64, &simulation.system().state);
        Self {
            run: RunQuantities::of(scenario, simulation, grains, (steps_are, wall_s)),
            growth: GrowthQuantities::of(&growth, simulation.grains_at_start(), mean_radius_start_m),
            scales: ScaleQuantities::of(&scales, growth.largest_radius),
            counts: CountQuantities::of(&state.counts, simulation.clock().step, state.ledger.flows.kept),
            motion: MotionQuantities::of(&growth),
            energy: simulation.balance(),
            momentum_drift_relative: simulation.momentum_drift_relative(),
            warnings: state.warnings.counts().clone(),
            size_totals: state.rates.totals(simulation.clock().time),
        }
        .with_tc_warning()
    }

    /// The same with a warning where the TC model (bounces made elastic against inelastic collapse) can matter.
    fn with_tc_warning(mut self) -> Self {
        let CountQuantities { impacts, tc_bounces, tc_kept: kept, .. } = self.counts;
        let lost = self.energy.normal + self.energy.friction;
        let can_matter = tc_bounces as f64 > TC_SHARE * impacts as f64 || kept > KEPT_SHARE * (lost + kept);
        if tc_bounces > 0 && can_matter {
            self.warnings.insert(TC_MATTERS.to_owned(), tc_bounces);
        }
        self
    }

    /// How much the TC model did, where it did anything.
    fn tc_row(&self) -> Option<(&'static str, String)> {
        let CountQuantities { impacts, tc_bounces, tc_kept: kept, .. } = self.counts;
        let share = 100.0 * tc_bounces as f64 / impacts as f64;
        let lost = self.energy.normal + self.energy.friction;
        let part = 100.0 * kept / (lost + kept);
        let kept = readable(kept, "J");
        let quantities = format!(
            "{tc_bounces} bounces of pairs that bounced again and again, {share:.2} % of the impacts; they kept {kept}, \
             {part:.1e} % of what impacts took"
        );
        (tc_bounces > 0).then_some(("made elastic", quantities))
    }

    /// The summary as rows of a table: what, how much.
    pub fn table(&self) -> Vec<(String, String)> {
        let mut rows = vec![
            ("simulated time", time_row(self.run.time_s, self.run.steps, &self.run.steps_are)),
            ("wall time", wall_row(self.run.wall_s, self.run.threads)),
            ("grains", format!("{} left of {}", self.growth.grains_end, self.growth.grains_start)),
            ("mean radius", self.mean_radius_row()),
            ("growth", self.growth_row()),
            ("largest grain", self.largest_row()),
            ("impacts", self.impacts_row()),
        ];
        rows.extend(self.tc_row());
        rows.extend([
            ("temperature", self.temperature_row()),
            ("speed", format!("{} in the mean", readable(self.motion.mean_speed_m_s, "m/s"))),
        ]);
        rows.extend(self.scale_rows());
        rows.extend(self.false_heat_row());
        rows.extend(self.unexplained_row());
        rows.extend([
            ("energy drift", format!("{:.3e} of all energy", self.energy.drift_relative)),
            ("momentum drift", format!("{:.3e} of all momentum", self.momentum_drift_relative)),
            ("warnings", warnings_row(&self.warnings)),
        ]);
        rows.into_iter().map(|(what, quantity)| (what.to_owned(), quantity)).collect()
    }

    /// How far the models are from their limits, where that can be said.
    fn scale_rows(&self) -> impl Iterator<Item = (&'static str, String)> {
        let gravity = self.scales.self_gravity_radius_m.zip(self.scales.largest_over_self_gravity);
        let gravity = gravity.map(|(radius, over)| {
            let radius = readable(radius, "m");
            ("self-gravity", format!("from a radius of {radius}; the largest grain has {over:.1e} of that"))
        });
        let biot = self.scales.biot_number.map(|biot| {
            let holds = if is_uniform(biot) { "holds" } else { "does not hold" };
            ("Biot number", format!("{biot:.2e}: one temperature for a grain {holds}"))
        });
        let reynolds =
            self.scales.reynolds_number.map(|reynolds| ("Reynolds number", format!("{reynolds:.2e}")));
        [gravity, biot, reynolds].into_iter().flatten()
    }

    /// What is not to be overlooked.
    fn unexplained_row(&self) -> Option<(&'static str, String)> {
        let part = self.energy.unexplained();
        let is_alarming = part > Limits::default().drift_warning;
        is_alarming.then(|| {
            ("unexplained energy", format!("{part:.3e} of all energy: these numbers are not to be believed"))
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
        let [now, start] =
            [self.growth.mean_radius_m, self.growth.mean_radius_start_m].map(|radius| readable(radius, "m"));
        format!("{now}, {:.4} times the {start} at the start", self.growth.radius_ratio)
    }

    fn growth_row(&self) -> String {
        format!("n_f {:.4}, Pi {:.5} (0 if all were one sphere)", self.growth.n_f, self.growth.growth_deficit)
    }

    fn largest_row(&self) -> String {
        let radius = readable(self.growth.largest_radius_m, "m");
        let (count, part) = (self.growth.largest_primaries, 100.0 * self.growth.largest_fraction);
        let primaries = if count == 1 { "a single primary".to_owned() } else { format!("{count} primaries") };
        format!("radius {radius}, {primaries}, {part:.2} % of the mass")
    }

    fn impacts_row(&self) -> String {
        let CountQuantities { impacts, bounces, merges, fragmentations, .. } = self.counts;
        format!("{impacts}: {bounces} bounces, {merges} merges, {fragmentations} breakages")
    }

    fn temperature_row(&self) -> String {
        let [mean, lowest, highest] =
            [self.motion.temperature_mean, self.motion.temperature_lowest, self.motion.temperature_highest]
                .map(|kelvin| readable(kelvin, "K"));
        format!("{mean} in the mean, {lowest} to {highest}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn summary(tc_bounces: u64, kept: f64) -> HardSummary {
        let energy = Balance { normal: 0.9, friction: 0.1, ..Balance::default() };
        let counts =
            CountQuantities { impacts: 1000, tc_bounces, tc_kept: kept, ..CountQuantities::default() };
        HardSummary { counts, energy, ..HardSummary::default() }.with_tc_warning()
    }

    /// Up to 1 % of the impacts and 0.1 % of the energy it is told in a row, beyond that in a warning too.
    #[test]
    fn bounces_made_elastic_are_told() {
        let row = |summary: &HardSummary| {
            summary
                .table()
                .into_iter()
                .find(|(what, _)| what == "made elastic")
                .map(|(_, quantities)| quantities)
        };
        assert_eq!(row(&summary(0, 0.0)), None);
        let few = summary(9, 0.5e-3);
        let quantities = row(&few).unwrap();
        assert!(
            quantities.contains("9 bounces")
                && quantities.contains("0.90 %")
                && quantities.contains("5.0e-2 % of"),
            "{quantities}"
        );
        assert_empty!(few.warnings);
        assert_eq!(summary(11, 0.5e-3).warnings[TC_MATTERS], 11);
        assert_eq!(summary(9, 1.1e-3).warnings[TC_MATTERS], 9);
    }
}
