//! Runs of hard spheres: their tables, frames and quantities.

mod growth;
mod now;
pub(super) mod panels;
mod quantities;
mod scales;
mod summary;
pub(super) mod tables;

pub use growth::Growth;
pub use quantities::{CountQuantities, GrowthQuantities, MotionQuantities, RunQuantities, ScaleQuantities};
pub use summary::HardSummary;

use serde::{Deserialize, Serialize};

use crate::engine::hard::{Clock, Simulation, SimulationState};
use crate::engine::soft::{Hook, RestWatch};
use crate::engine::{SimError, Start};
use crate::folder::RunFolder;
use crate::record::columns::{Declared, Table};
use crate::record::{RecordError, Series, columns};
use crate::scenario::Scenario;

use super::frames::Frames;
use super::guests::Sight;
use super::job::{AnySaved, Job, Saved};
use super::summary::Summary;
use super::tables::Tables;
use super::timers::Moment;
use now::{LastRow, Now};

/// What the tables and the summary have to remember of the past; it has no influence on the simulation.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Memory {
    /// Mean radius at the start [m].
    mean_radius_at_start: f64,
    last_row: LastRow,
}

/// All that a run of hard spheres needs to go on.
#[derive(Debug, Serialize, Deserialize)]
pub struct HardState<'a> {
    simulation: SimulationState<'a>,
    memory: Memory,
}

impl HardState<'_> {
    /// Simulated time [s].
    pub fn time(&self) -> f64 {
        self.simulation.clock().time
    }
}

/// A run of hard spheres.
pub struct Hard {
    simulation: Simulation,
    memory: Memory,
    steps_are: &'static str,
}

impl Hard {
    fn with(scenario: &Scenario, simulation: Simulation, memory: Memory) -> Self {
        let steps_are = if scenario.is_stepped() { "steps" } else { "events" };
        Self { simulation, memory, steps_are }
    }
}

impl Job for Hard {
    type State<'a> = HardState<'a>;
    type Simulation = Simulation;

    const TABLES: columns::Tables = tables::TABLES;

    fn start(scenario: &Scenario, start: Start, _: &mut RestWatch<'_>) -> Result<Self, SimError> {
        let simulation = Simulation::start(scenario, start)?;
        let mean_radius_at_start = Growth::of(&simulation.snapshot()).mean_radius;
        let memory = Memory { mean_radius_at_start, last_row: LastRow::of(&simulation) };
        Ok(Self::with(scenario, simulation, memory))
    }

    fn resume(scenario: &Scenario, state: HardState<'_>) -> Result<Self, SimError> {
        let simulation = Simulation::resume(scenario, state.simulation)?;
        Ok(Self::with(scenario, simulation, state.memory))
    }

    fn attach(&mut self, _: Box<dyn Hook>) -> Result<(), SimError> {
        // Nobody comes here: forces are refused before a run of hard spheres begins.
        Ok(())
    }

    fn into_start(self) -> Start {
        self.simulation.into_start()
    }

    fn save(&self, rest: Saved<()>) -> AnySaved<'_> {
        AnySaved::Hard(rest.with(HardState { simulation: self.simulation.state(), memory: self.memory }))
    }

    fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    fn simulation_mut(&mut self) -> &mut Simulation {
        &mut self.simulation
    }

    fn moment(&self) -> Moment {
        let Clock { time, lag, .. } = *self.simulation.clock();
        Moment { time, lag, pulse: None }
    }

    fn steps_are(&self) -> &'static str {
        self.steps_are
    }

    fn show<R>(&self, to: impl FnOnce(&Sight<'_>) -> R) -> R {
        let now = self.simulation.snapshot();
        to(&Sight { time: self.time(), grains: &now.grains, primaries: Some(&now.primaries) })
    }

    fn warn(&mut self, text: &str) {
        self.simulation.system_mut().state.warnings.add(text);
    }

    fn fresh_warnings(&mut self) -> Vec<String> {
        self.simulation.system_mut().state.warnings.take_fresh()
    }

    fn now(&self) -> String {
        let (grains, start) = (self.simulation.grains(), self.simulation.grains_at_start());
        let impacts = self.simulation.system().state.counts.collisions;
        format!("{grains} of {start} grains, {impacts} impacts")
    }

    fn forget_events(&mut self) {
        let system = self.simulation.system_mut();
        system.keeps_events = false;
        system.events.clear();
        system.descents.clear();
    }

    fn record_events(&mut self, to: &mut Tables) -> Result<(), RecordError> {
        let system = self.simulation.system_mut();
        for event in system.events.drain(..) {
            to.put(&tables::EVENTS, &event)?;
        }
        for descent in system.descents.drain(..) {
            to.put(&tables::GENEALOGY, &descent)?;
        }
        Ok(())
    }

    fn record_rows(&mut self, to: &mut Tables) -> Result<(), RecordError> {
        let Memory { mean_radius_at_start, last_row } = self.memory;
        let now = self.simulation.snapshot();
        let growth = Growth::of(&now);
        let row = Now::of(&self.simulation, growth, mean_radius_at_start, &last_row);
        tables::OVER_TIME.into_iter().try_for_each(|table| to.put(table, &row))?;
        self.memory.last_row = LastRow::of(&self.simulation);
        let classes = self.simulation.system().state.rates.classes();
        now::classes(self.time(), &now, (classes, &growth))
            .try_for_each(|class| to.put(&tables::SIZES, &class))
    }

    fn record_frame(&self, frames: &mut Frames) -> Result<(), RecordError> {
        let now = self.simulation.snapshot();
        frames.grains(self.time(), &now.grains, &[], ("primaries", &now.primaries))
    }

    fn record_end(&self, folder: &RunFolder) -> Result<(), RecordError> {
        let (rates, time) = (&self.simulation.system().state.rates, self.time());
        write_once(folder, &tables::KERNELS, &rates.kernel_rows(time))?;
        write_once(folder, &tables::BREAKAGE, &rates.breakage_rows(time))?;
        write_once(folder, &tables::DAUGHTERS, &rates.daughter_rows())
    }

    fn summary(&self, scenario: &Scenario, wall_s: f64) -> Summary {
        let start = self.memory.mean_radius_at_start;
        Summary::Hard(Box::new(HardSummary::new(scenario, &self.simulation, start, self.steps_are, wall_s)))
    }
}

/// Writes a whole table.
fn write_once<S>(folder: &RunFolder, table: &'static Table<S>, rows: &[S]) -> Result<(), RecordError> {
    let mut series = Series::create(&folder.root().join(table.file), &table.names())?;
    rows.iter().try_for_each(|row| series.put(table.columns, row))?;
    series.sync()
}

#[cfg(test)]
mod distinct_tests;
#[cfg(test)]
mod sizes_tests;
#[cfg(test)]
mod tests;
