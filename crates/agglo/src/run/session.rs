//! One sitting of a run: steps, records and checkpoints until the end, an error or a stop.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use crate::engine::soft::{Simulation, SimulationState};
use crate::particles::Particles;
use crate::record::{RecordError, atomic, checkpoint};
use crate::scenario::Scenario;

use super::folder::Folder;
use super::recorder::{Recorder, RecorderState};
use super::summary::Summary;
use super::{Ending, Observer, Progress, RunError};

/// How often the observer is told.
const TELL_EVERY: Duration = Duration::from_millis(100);

/// What a checkpoint holds.
#[derive(Serialize, Deserialize)]
struct Saved<'a> {
    scenario: String,
    simulation: SimulationState<'a>,
    recorder: RecorderState,
    wall_s: f64,
}

/// One sitting of a run.
pub struct Session {
    scenario: Scenario,
    folder: Folder,
    simulation: Simulation,
    recorder: Recorder,
    wall_before: f64,
    sat_down: Instant,
    told: Instant,
    notes: Vec<String>,
}

impl Session {
    /// Starts a run in an empty folder; its wall time counts from `sat_down`.
    ///
    /// # Errors
    /// [`RunError`] where the start fails or a file cannot be written.
    pub fn start(
        scenario: &Scenario,
        grains: Particles,
        folder: Folder,
        sat_down: Instant,
    ) -> Result<Self, RunError> {
        let simulation = Simulation::start(scenario, grains).map_err(RunError::Start)?;
        let head = format!(
            "# Resolved scenario of a run of agglo {}: every default is written out.\n",
            env!("CARGO_PKG_VERSION")
        );
        let text = scenario.to_toml()?;
        atomic::write(&folder.scenario(), (head + &text).as_bytes())?;
        let recorder = Recorder::create(scenario, &folder)?;
        let mut session = Self {
            scenario: scenario.clone(),
            folder,
            simulation,
            recorder,
            wall_before: 0.0,
            sat_down,
            told: sat_down,
            notes: Vec::new(),
        };
        session.recorder.record_due(&mut session.simulation)?;
        session.save()?;
        Ok(session)
    }

    /// Goes on from the newest sound checkpoint.
    ///
    /// # Errors
    /// [`RunError`] where there is none, or a file cannot be brought back to its state at that time.
    pub fn resume(folder: Folder) -> Result<Self, RunError> {
        let dir = folder.root().to_owned();
        let (saved, _, refused) = match checkpoint::load_newest::<Saved<'_>>(&folder.checkpoints()) {
            Err(RecordError::NoCheckpoint { refused, .. }) if refused.is_empty() => {
                return Err(RunError::NoCheckpointYet { dir });
            }
            found => found?,
        };
        let scenario = Scenario::from_toml(&saved.scenario)
            .map_err(|faults| RunError::BadCheckpoint { dir, reason: faults.to_string() })?;
        let recorder = Recorder::resume(&scenario, &folder, saved.recorder)?;
        folder.sweep()?;
        let now = Instant::now();
        Ok(Self {
            simulation: Simulation::resume(&scenario, saved.simulation),
            scenario,
            folder,
            recorder,
            wall_before: saved.wall_s,
            sat_down: now,
            told: now,
            notes: refused
                .iter()
                .map(|damaged| format!("a checkpoint is damaged and was passed over: {damaged}"))
                .collect(),
        })
    }

    /// Steps to the end, unless the observer asks to stop.
    ///
    /// # Errors
    /// [`RunError`] where a step fails or a file cannot be written.
    pub fn carry_on(self, observer: &mut Observer<'_>) -> Result<Ending, RunError> {
        let dir = self.folder.root().to_owned();
        self.steps(observer).map_err(|error| match error {
            RunError::Record(error) => RunError::CutShort { error, dir },
            other => other,
        })
    }

    fn steps(mut self, observer: &mut Observer<'_>) -> Result<Ending, RunError> {
        // What is known at the start is told even if the first step fails.
        if self.tell(observer).is_break() {
            return self.interrupted();
        }
        while !self.simulation.is_finished() {
            let stepped = self.simulation.step();
            if let Err(error) = stepped {
                self.recorder.sync()?;
                return Err(RunError::Step { error, checkpoints: self.folder.checkpoints() });
            }
            self.recorder.record_due(&mut self.simulation)?;
            if self.recorder.checkpoint_is_due(&self.simulation) {
                self.save()?;
            }
            if self.told.elapsed() >= TELL_EVERY && self.tell(observer).is_break() {
                return self.interrupted();
            }
        }
        self.finish(observer)
    }

    fn interrupted(mut self) -> Result<Ending, RunError> {
        self.save()?;
        Ok(Ending::Interrupted(self.simulation.clock().time))
    }

    fn finish(mut self, observer: &mut Observer<'_>) -> Result<Ending, RunError> {
        self.recorder.record_end(&self.simulation)?;
        let clusters = self.recorder.clusters(&self.simulation);
        let title = &self.scenario.title;
        let summary = Summary::new(title, self.scenario.seed, &self.simulation, &clusters, self.wall_s());
        let text = summary.to_json();
        self.save()?;
        atomic::write(&self.folder.summary(), text.as_bytes())?;
        let _ = self.tell(observer);
        Ok(Ending::Finished(Box::new(summary)))
    }

    fn save(&mut self) -> Result<(), RunError> {
        self.recorder.sync()?;
        let saved = Saved {
            scenario: self.scenario.to_toml()?,
            simulation: self.simulation.state(),
            recorder: self.recorder.state(),
            wall_s: self.wall_s(),
        };
        checkpoint::save(&self.folder.checkpoints(), self.simulation.clock().step, &saved)?;
        Ok(())
    }

    fn wall_s(&self) -> f64 {
        self.wall_before + self.sat_down.elapsed().as_secs_f64()
    }

    fn tell(&mut self, observer: &mut Observer<'_>) -> ControlFlow<()> {
        self.told = Instant::now();
        let clock = self.simulation.clock();
        let mut warnings = std::mem::take(&mut self.notes);
        let progress = Progress {
            time: clock.time,
            end: self.scenario.time.end.si(),
            step: clock.step,
            now: what_happens(&self.simulation),
            warnings: {
                warnings.extend(self.simulation.warnings.take_fresh());
                warnings
            },
        };
        observer(&progress)
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
