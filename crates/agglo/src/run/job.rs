//! What a session needs of soft and of hard spheres: the session and the recorder say when, the job says what.

use serde::{Deserialize, Serialize};

use crate::engine::soft::{Hook, RestWatch};
use crate::engine::{SimError, Simulation, Start};
use crate::folder::RunFolder;
use crate::record::{RecordError, columns};
use crate::scenario::Scenario;

use super::frames::Frames;
use super::guests::Sight;
use super::hard::HardState;
use super::recorder::RecorderState;
use super::soft::SoftState;
use super::summary::Summary;
use super::tables::Tables;
use super::timers::Moment;

/// What a checkpoint holds: the resolved scenario, the job's state and where the recorder stands.
#[derive(Debug, Serialize, Deserialize)]
pub struct Saved<S> {
    /// The resolved scenario.
    pub scenario: String,
    /// The job's state.
    pub state: S,
    /// Where the recorder stands.
    pub recorder: RecorderState,
    /// Ends [s] that the run had before it got a later one.
    pub ends_before: Vec<f64>,
    /// Wall time so far [s].
    pub wall_s: f64,
}

impl Saved<()> {
    /// The same with a state.
    pub fn with<S>(self, state: S) -> Box<Saved<S>> {
        let Self { scenario, state: (), recorder, ends_before, wall_s } = self;
        Box::new(Saved { scenario, state, recorder, ends_before, wall_s })
    }
}

/// A checkpoint of any job.
#[derive(Debug, Serialize, Deserialize)]
pub enum AnySaved<'a> {
    /// Soft spheres.
    Soft(Box<Saved<SoftState<'a>>>),
    /// Hard spheres.
    Hard(Box<Saved<HardState<'a>>>),
}

impl AnySaved<'_> {
    /// Simulated time [s].
    pub fn time(&self) -> f64 {
        match self {
            Self::Soft(saved) => saved.state.time(),
            Self::Hard(saved) => saved.state.time(),
        }
    }

    /// Ends [s] that the run had before it got a later one.
    pub fn ends_before(&self) -> &[f64] {
        match self {
            Self::Soft(saved) => &saved.ends_before,
            Self::Hard(saved) => &saved.ends_before,
        }
    }

    /// The scenario's text and the ends before, to be changed.
    pub fn end_mut(&mut self) -> (&mut String, &mut Vec<f64>) {
        match self {
            Self::Soft(saved) => (&mut saved.scenario, &mut saved.ends_before),
            Self::Hard(saved) => (&mut saved.scenario, &mut saved.ends_before),
        }
    }

    /// The scenario's text, and where the recorder stands.
    pub fn parts(&self) -> (&str, &RecorderState) {
        match self {
            Self::Soft(saved) => (&saved.scenario, &saved.recorder),
            Self::Hard(saved) => (&saved.scenario, &saved.recorder),
        }
    }
}

/// A simulation as a session sees it.
pub trait Job: Sized {
    /// All that it needs to go on with the same bits; borrowed where it is written, owned where it is read.
    type State<'a>
    where
        Self: 'a;

    /// What it drives.
    type Simulation: Simulation;

    /// All its tables; see [`tables_of`](super::tables_of).
    const TABLES: columns::Tables;

    /// Starts; `watch` is told how soft grains come to rest, if they are to.
    fn start(scenario: &Scenario, start: Start, watch: &mut RestWatch<'_>) -> Result<Self, SimError>;
    /// Goes on from a saved state.
    fn resume(scenario: &Scenario, state: Self::State<'_>) -> Result<Self, SimError>;
    /// Lets forces of the caller's own act from now on, those of before its state was saved.
    fn attach(&mut self, forces: Box<dyn Hook>) -> Result<(), SimError>;
    /// Spreads it over so many domains from now on; a run that cannot be has one.
    fn spread(&mut self, _scenario: &Scenario, _domains: usize) -> Result<(), SimError> {
        Ok(())
    }
    /// What another run can start from.
    fn into_start(self) -> Start;
    /// Adds its state to the rest of a checkpoint.
    fn save(&self, rest: Saved<()>) -> AnySaved<'_>;

    /// What it drives.
    fn simulation(&self) -> &Self::Simulation;
    /// The same, to go on.
    fn simulation_mut(&mut self) -> &mut Self::Simulation;

    /// Where it stands in time, for those who ask what is due.
    fn moment(&self) -> Moment;
    /// Simulated time [s].
    fn time(&self) -> f64 {
        self.simulation().time()
    }
    /// Steps, or events, so far.
    fn step(&self) -> u64 {
        self.simulation().steps()
    }
    /// What those are called.
    fn steps_are(&self) -> &'static str;
    /// Whether the end is reached.
    fn is_finished(&self) -> bool {
        self.simulation().is_finished()
    }
    /// Goes on for a little while, not past `due` [s] if it can stop there without a trace.
    fn advance(&mut self, due: f64) -> Result<(), SimError> {
        self.simulation_mut().advance(due)
    }
    /// Whether rays fly, so that steps are of another kind than without.
    fn is_ray_flight(&self) -> bool {
        false
    }
    /// Shows it to somebody.
    fn show<R>(&self, to: impl FnOnce(&Sight<'_>) -> R) -> R;
    /// Adds a warning.
    fn warn(&mut self, text: &str);
    /// Warnings that came up for the first time since the last call.
    fn fresh_warnings(&mut self) -> Vec<String>;
    /// What happens now, in words.
    fn now(&self) -> String;

    /// Drops what happened since the last call: nobody writes it down.
    fn forget_events(&mut self);
    /// Writes down what happened since the last call.
    fn record_events(&mut self, tables: &mut Tables) -> Result<(), RecordError>;
    /// Writes a row in each table over time.
    fn record_rows(&mut self, tables: &mut Tables) -> Result<(), RecordError>;
    /// Writes a frame.
    fn record_frame(&self, frames: &mut Frames) -> Result<(), RecordError>;
    /// Writes what is written once, at the end.
    fn record_end(&self, folder: &RunFolder) -> Result<(), RecordError>;
    /// Draws up the summary; `wall_s` is the wall time [s].
    fn summary(&self, scenario: &Scenario, wall_s: f64) -> Summary;
}
