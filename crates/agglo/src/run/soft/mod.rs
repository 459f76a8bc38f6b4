//! Runs of soft spheres: their tables, frames and quantities.

mod now;
pub(super) mod panels;
mod summary;
mod tables;
mod together;

#[cfg(test)]
mod distinct;
#[cfg(test)]
mod frames_tests;
#[cfg(test)]
mod rows_tests;
#[cfg(test)]
mod summary_tests;
#[cfg(test)]
mod walls_tests;

pub use summary::{Clusters, EnergyQuantities, PulseQuantities, SoftSummary, WallQuantities};

use serde::{Deserialize, Serialize};

use crate::engine::soft::{Clock, Hook, RestWatch, Simulation, SimulationState};
use crate::engine::{SimError, Start};
use crate::folder::RunFolder;
use crate::record::{RecordError, columns};
use crate::scenario::Scenario;

use super::frames::Frames;
use super::guests::Sight;
use super::job::{AnySaved, Job, Saved};
use super::summary::Summary;
use super::tables::Tables;
use super::timers::Moment;
use now::Now;
use together::Together;

/// All that a run of soft spheres needs to go on.
#[derive(Debug, Serialize, Deserialize)]
pub struct SoftState<'a> {
    simulation: SimulationState<'a>,
    start: Clusters,
}

impl SoftState<'_> {
    /// Simulated time [s].
    pub fn time(&self) -> f64 {
        self.simulation.clock().time
    }
}

/// A run of soft spheres.
pub struct Soft {
    simulation: Simulation,
    /// The clusters of the start, which quantities are relative to.
    start: Clusters,
    cluster_gap: f64,
    with_bonds: bool,
    with_rays: bool,
}

impl Soft {
    fn with(scenario: &Scenario, simulation: Simulation, start: Clusters) -> Self {
        Self {
            simulation,
            start,
            cluster_gap: scenario.measures.cluster_gap,
            with_bonds: scenario.output.bonds,
            with_rays: scenario.output.rays,
        }
    }
}

impl Job for Soft {
    type State<'a> = SoftState<'a>;
    type Simulation = Simulation;

    const TABLES: columns::Tables = tables::TABLES;

    fn start(scenario: &Scenario, start: Start, watch: &mut RestWatch<'_>) -> Result<Self, SimError> {
        let simulation = Simulation::start_watched(scenario, start, watch)?;
        let start = Together::of(&simulation, scenario.measures.cluster_gap).clusters();
        Ok(Self::with(scenario, simulation, start))
    }

    fn resume(scenario: &Scenario, state: SoftState<'_>) -> Result<Self, SimError> {
        Ok(Self::with(scenario, Simulation::resume(scenario, state.simulation)?, state.start))
    }

    fn attach(&mut self, forces: Box<dyn Hook>) -> Result<(), SimError> {
        self.simulation.attach(forces);
        self.simulation.hook_fault().map_or(Ok(()), Err)
    }

    fn spread(&mut self, scenario: &Scenario, domains: usize) -> Result<(), SimError> {
        if domains > 1 { self.simulation.spread(scenario, domains) } else { Ok(()) }
    }

    fn into_start(self) -> Start {
        self.simulation.into_start()
    }

    fn save(&self, rest: Saved<()>) -> AnySaved<'_> {
        AnySaved::Soft(rest.with(SoftState { simulation: self.simulation.state(), start: self.start }))
    }

    fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    fn simulation_mut(&mut self) -> &mut Simulation {
        &mut self.simulation
    }

    fn moment(&self) -> Moment {
        let Clock { time, lag, .. } = *self.simulation.clock();
        Moment { time, lag, pulse: self.simulation.pulses.since(time) }
    }

    fn steps_are(&self) -> &'static str {
        "steps"
    }

    fn is_ray_flight(&self) -> bool {
        !self.simulation.pulses.flight().rays().is_empty()
    }

    fn show<R>(&self, to: impl FnOnce(&Sight<'_>) -> R) -> R {
        to(&Sight { time: self.time(), grains: &self.simulation.system.grains, primaries: None })
    }

    fn warn(&mut self, text: &str) {
        self.simulation.warnings.add(text);
    }

    fn fresh_warnings(&mut self) -> Vec<String> {
        self.simulation.warnings.take_fresh()
    }

    fn now(&self) -> String {
        what_happens(&self.simulation)
    }

    fn forget_events(&mut self) {
        self.simulation.events.clear();
    }

    fn record_events(&mut self, to: &mut Tables) -> Result<(), RecordError> {
        self.simulation.events.drain(..).try_for_each(|event| to.put(&tables::EVENTS, &event))
    }

    fn record_rows(&mut self, to: &mut Tables) -> Result<(), RecordError> {
        let now = Now::of(&self.simulation, self.cluster_gap, &self.start);
        tables::OVER_TIME.into_iter().try_for_each(|table| to.put(table, &now))?;
        now::walls(&self.simulation).try_for_each(|wall| to.put(&tables::WALLS, &wall))
    }

    fn record_frame(&self, frames: &mut Frames) -> Result<(), RecordError> {
        let simulation = &self.simulation;
        let labels = Together::of(simulation, self.cluster_gap).labels;
        let system = &simulation.system;
        let (grains, network) = (&system.grains, &system.network);
        frames.grains(self.time(), grains, &system.images, ("cluster", &labels))?;
        if self.with_bonds && network.is_active() {
            frames.bonds(self.time(), grains, &system.space, network.bonds())?;
        }
        if self.with_rays && simulation.pulses.scheduled() > 0 {
            frames.rays(self.time(), simulation.pulses.flight(), &simulation.system.space)?;
        }
        if !simulation.system.laws.walls.is_empty() {
            frames.walls(self.time(), grains, &simulation.system.laws.walls)?;
        }
        Ok(())
    }

    fn record_end(&self, _folder: &RunFolder) -> Result<(), RecordError> {
        Ok(())
    }

    fn summary(&self, scenario: &Scenario, wall_s: f64) -> Summary {
        let clusters = [self.start, Together::of(&self.simulation, self.cluster_gap).clusters()];
        let (title, seed) = (&scenario.title, scenario.seed);
        Summary::Soft(Box::new(SoftSummary::new(title, seed, &self.simulation, clusters, wall_s)))
    }
}

/// What happens now, in words.
fn what_happens(simulation: &Simulation) -> String {
    let pulses = &simulation.pulses;
    let bonds = simulation.system.network.bonds().len();
    let rays = pulses.flight().rays().len();
    let mut words = Vec::new();
    if rays > 0 {
        words.push(format!(
            "pulse {} of {}, {rays} rays in flight",
            pulses.counts().len(),
            pulses.scheduled()
        ));
    } else if pulses.scheduled() > 0 {
        words.push(match pulses.counts().len() {
            0 => format!("before pulse 1 of {}", pulses.scheduled()),
            number => format!("after pulse {number} of {}", pulses.scheduled()),
        });
    }
    if simulation.system.network.made_at_start() > 0 {
        words.push(format!("{bonds} bonds"));
    }
    words.join(", ")
}
