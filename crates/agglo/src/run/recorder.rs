//! When what is written. The recorder sees the simulation and never changes it.

use serde::{Deserialize, Serialize};

use crate::contact::bond::Break;
use crate::contact::network::BondEvent;
use crate::engine::soft::Simulation;
use crate::measure::ClusterSummary;
use crate::record::{RecordError, Series};
use crate::scenario::Scenario;
use crate::units::Time;

use super::folder::Folder;
use super::frames::{FrameLists, Frames};
use super::tables::{Tables, TablesState, clusters_of};

const EVENTS: &[&str] = &["time_s", "grain_i", "grain_j", "event", "energy_J"];

/// Something that is due at equal intervals of simulated time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Timer {
    interval: f64,
    next: u64,
}

impl Timer {
    fn new(interval: Option<Time>, first: u64) -> Self {
        Self { interval: interval.map_or(f64::INFINITY, Time::si), next: first }
    }

    /// Whether it is due at `time` [s]; then the next turn is the first after that.
    fn is_due(&mut self, time: f64) -> bool {
        let turn = |next: u64| if next == 0 { 0.0 } else { next as f64 * self.interval };
        if time < turn(self.next) {
            return false;
        }
        let passed = (time / self.interval) as u64;
        self.next = self.next.max(passed);
        while time >= turn(self.next) {
            self.next += 1;
        }
        true
    }
}

/// Where the recorder stands; a checkpoint holds it, so that files can be cut back to it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct RecorderState {
    timers: Timers,
    last_row: f64,
    tables: TablesState,
    frames: FrameLists,
    events: u64,
}

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Timers {
    rows: Timer,
    frames: Timer,
    checkpoints: Timer,
}

/// Writes tables, frames and events.
#[derive(Debug)]
pub struct Recorder {
    timers: Timers,
    last_row: f64,
    tables: Tables,
    frames: Frames,
    events: Series,
    cluster_gap: f64,
    with_bonds: bool,
    with_rays: bool,
}

impl Recorder {
    /// Opens new files in the folder; the scenario is resolved.
    ///
    /// # Errors
    /// [`RecordError`] where a file cannot be made.
    pub fn create(scenario: &Scenario, folder: &Folder) -> Result<Self, RecordError> {
        let output = &scenario.output;
        let timers = Timers {
            rows: Timer::new(output.series, 0),
            frames: Timer::new(output.frames, 0),
            checkpoints: Timer::new(output.checkpoints, 1),
        };
        let (tables, events) = (Tables::create(&folder.series())?, Series::create(&folder.events(), EVENTS)?);
        Ok(Self::with(scenario, folder, timers, -1.0, (tables, events), FrameLists::default()))
    }

    /// Opens the files of a run that goes on and cuts them back to the checkpoint.
    ///
    /// # Errors
    /// [`RecordError`] where a file is missing or shorter than it was.
    pub fn resume(scenario: &Scenario, folder: &Folder, state: RecorderState) -> Result<Self, RecordError> {
        // All are looked at before the first is cut: a run that cannot go on stays as it is.
        Tables::check(&folder.series(), &state.tables)?;
        Series::check(&folder.events(), state.events)?;
        let tables = Tables::resume(&folder.series(), &state.tables)?;
        let events = Series::reopen_at(&folder.events(), state.events)?;
        Ok(Self::with(scenario, folder, state.timers, state.last_row, (tables, events), state.frames))
    }

    fn with(
        scenario: &Scenario,
        folder: &Folder,
        timers: Timers,
        last_row: f64,
        (tables, events): (Tables, Series),
        lists: FrameLists,
    ) -> Self {
        Self {
            timers,
            last_row,
            tables,
            events,
            frames: Frames::new(&folder.frames(), lists),
            cluster_gap: scenario.measures.cluster_gap,
            with_bonds: scenario.output.bonds,
            with_rays: scenario.output.rays,
        }
    }

    /// Where the recorder stands; call [`Recorder::sync`] first.
    pub fn state(&self) -> RecorderState {
        RecorderState {
            timers: self.timers,
            last_row: self.last_row,
            tables: self.tables.state(),
            frames: self.frames.lists().clone(),
            events: self.events.position(),
        }
    }

    /// Writes what is due.
    ///
    /// # Errors
    /// [`RecordError`] where a file cannot be written.
    pub fn record_due(&mut self, simulation: &mut Simulation) -> Result<(), RecordError> {
        let time = simulation.clock().time;
        for event in simulation.events.drain(..) {
            self.write_event(&event)?;
        }
        if self.timers.rows.is_due(time) {
            self.write_rows(simulation)?;
        }
        if self.timers.frames.is_due(time) {
            self.write_frame(simulation)?;
        }
        Ok(())
    }

    /// Writes the last row and frame, if they were not just written.
    ///
    /// # Errors
    /// [`RecordError`] where a file cannot be written.
    pub fn record_end(&mut self, simulation: &Simulation) -> Result<(), RecordError> {
        let time = simulation.clock().time;
        if self.last_row < time {
            self.write_rows(simulation)?;
        }
        if self.frames.last_time().is_none_or(|last| last < time) {
            self.write_frame(simulation)?;
        }
        self.sync()
    }

    /// Whether a checkpoint is due.
    pub fn checkpoint_is_due(&mut self, simulation: &Simulation) -> bool {
        self.timers.checkpoints.is_due(simulation.clock().time)
    }

    /// Puts all rows onto the disk.
    ///
    /// # Errors
    /// [`RecordError`] where a file cannot be written.
    pub fn sync(&mut self) -> Result<(), RecordError> {
        self.tables.sync()?;
        self.events.sync()
    }

    /// Clusters and what follows from them.
    pub fn clusters(&self, simulation: &Simulation) -> ClusterSummary {
        clusters_of(simulation, self.cluster_gap).0
    }

    fn write_rows(&mut self, simulation: &Simulation) -> Result<(), RecordError> {
        self.last_row = simulation.clock().time;
        self.tables.write(simulation, self.cluster_gap)
    }

    fn write_event(&mut self, event: &BondEvent) -> Result<(), RecordError> {
        let what = match event.broke {
            None => "made",
            Some(Break::Tension) => "broken_in_tension",
            Some(Break::Shear) => "broken_in_shear",
        };
        let [i, j] = event.ids.map(|id| id.to_string());
        self.events.words(&[&format!("{:?}", event.time), &i, &j, what, &format!("{:?}", event.energy)])
    }

    fn write_frame(&mut self, simulation: &Simulation) -> Result<(), RecordError> {
        let (_, labels) = clusters_of(simulation, self.cluster_gap);
        let time = simulation.clock().time;
        let (grains, network) = (&simulation.system.grains, &simulation.system.network);
        self.frames.grains(time, grains, &labels)?;
        if self.with_bonds && network.is_active() {
            self.frames.bonds(time, grains, network.bonds())?;
        }
        if self.with_rays && simulation.pulses.scheduled() > 0 {
            self.frames.rays(time, simulation.pulses.flight())?;
        }
        Ok(())
    }
}
