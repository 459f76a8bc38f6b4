//! The verbs that the terminal and Python share: run a scenario, resume a run.

mod error;
mod fit;
mod frames;
mod guests;
mod hard;
mod job;
mod origin;
mod own;
mod quiet;
mod recorder;
mod rehearsal;
mod session;
mod soft;
mod summary;
mod tables;
mod timers;
mod until;

#[cfg(test)]
mod distinct;
#[cfg(test)]
mod page_tests;

use std::io::ErrorKind;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;

pub use error::RunError;
pub use guests::{Guests, Look, Onlooker, Sight};
pub use hard::{
    CountQuantities, Growth, GrowthQuantities, HardSummary, MotionQuantities, RunQuantities, ScaleQuantities,
};
pub(crate) use origin::{Origin, State, state};
pub use quiet::quiet;
pub(crate) use rehearsal::{Rehearsal, Stretches, rehearse};
#[cfg(test)]
pub(crate) use rehearsal::{Stretch, Weights};
pub use soft::{Clusters, EnergyQuantities, PulseQuantities, SoftSummary, WallQuantities};
pub use summary::Summary;

use crate::engine::Start;
use crate::folder::{RunFolder, names};
use crate::packing::{PackingError, PlaceWatch, StartError};
use crate::record::{RecordError, columns, door};
use crate::scenario::Scenario;
use crate::units::Time;
use guests::Known;
use hard::Hard;
use job::{AnySaved, Job};
use session::{Session, TELL_EVERY, Way};
use soft::Soft;

/// The tables that grow with a run of hard or of soft spheres, with what is told of their columns.
///
/// ```
/// let tables = agglo::run::tables(true);
/// let grains = tables.iter().find(|table| table.file() == "series/grains.csv").unwrap();
/// let radius = grains.columns().into_iter().find(|column| column.name == "mean_radius_m").unwrap();
/// assert_eq!((radius.label, radius.unit), ("mean radius", "m"));
/// ```
pub fn tables(is_hard: bool) -> columns::Tables {
    if is_hard { Hard::TABLES } else { Soft::TABLES }
}

/// The tables that grow with the run of a scenario: of walls only where there are some.
pub fn tables_of(scenario: &Scenario) -> Vec<&'static dyn columns::Declared> {
    let has_walls = scenario.soft().is_some_and(|soft| !soft.walls.is_empty());
    let is_due = |table: &&dyn columns::Declared| has_walls || table.file() != names::WALLS;
    tables(scenario.is_hard()).iter().copied().filter(is_due).collect()
}

/// The tables that are written when such a run ends.
pub fn tables_at_the_end(is_hard: bool) -> columns::Tables {
    if is_hard { hard::tables::AT_THE_END } else { &[] }
}

/// The charts of such a run, in the order of the page.
pub fn panels(is_hard: bool) -> &'static [&'static columns::Panel] {
    if is_hard { hard::panels::ALL } else { soft::panels::ALL }
}

/// What an observer is told while a run goes on, about ten times a second.
#[derive(Clone, Debug)]
pub struct Progress {
    /// Simulated time [s].
    pub time: f64,
    /// Simulated time at the end [s].
    pub end: f64,
    /// Accepted steps so far, or events.
    pub step: u64,
    /// What `step` counts: "steps", "events".
    pub steps_are: &'static str,
    /// What happens now, in words: "pulse 2 of 4, 7312 rays in flight".
    pub now: String,
    /// Warnings that came up for the first time since the last call.
    pub warnings: Vec<String>,
}

/// How a run ended without an error.
#[derive(Clone, Debug)]
pub enum Ending {
    /// It reached its end.
    Finished(Summary),
    /// The observer asked to stop; a checkpoint at this simulated time [s] was written.
    Interrupted(f64),
}

/// Someone who is told of the progress and may ask to stop.
pub type Observer<'a> = dyn FnMut(&Progress) -> ControlFlow<()> + Send + 'a;

/// Runs a scenario from its start into the folder `dir`; `base` is the folder that its tables are relative to.
///
/// # Errors
/// [`RunError`] where the folder is in use, the start cannot be built, a step fails or a file cannot be written.
pub fn run(
    scenario: &Scenario,
    base: &Path,
    dir: &Path,
    observer: &mut Observer<'_>,
) -> Result<Ending, RunError> {
    run_with(scenario, base, dir, Guests::default(), observer)
}

/// As [`run`], with guests: forces, measures and a rule of the caller's own.
///
/// # Errors
/// As [`run`]; [`RunError::Guests`] where the guests cannot be those of such a run, [`RunError::FirstLook`] and [`RunError::Look`]
/// where one could not measure.
pub fn run_with(
    scenario: &Scenario,
    base: &Path,
    dir: &Path,
    guests: Guests<'_>,
    observer: &mut Observer<'_>,
) -> Result<Ending, RunError> {
    let began = Instant::now();
    let mut scenario = scenario.resolved();
    guests.check(scenario.is_hard())?;
    crate::forecast::refuse_run(&scenario, base, dir)?;
    let Origin { start, earlier, .. } = placed(&scenario, base, observer)?;
    if let Some(earlier) = earlier {
        // The very one that was taken: a run that goes on makes others.
        scenario.from = Some(absolute(&earlier.checkpoint)?);
    }
    let folder = RunFolder::create(dir)?;
    let scenario = folder.with_tables(&scenario, base).inspect_err(|_| folder.abandon())?;
    on_a_worker(|| {
        let go = if scenario.is_hard() { sit::<Hard> } else { sit::<Soft> };
        go(&scenario, start, &folder, began, guests, observer)
    })
}

/// The grains of a scenario before its clock starts: placed, or taken out of the run that it names. `base` is the folder that its
/// paths are relative to; `watch` may stop it.
///
/// ```
/// use agglo::engine::soft::Simulation;
/// # let text = agglo::scenario::template("acoustic").unwrap().text;
/// # let small = ["grains.0.placement.random.count=20"];
/// # let scenario = agglo::scenario::Scenario::with_overrides(text, &small).unwrap();
/// let start = agglo::run::start(&scenario, "".as_ref(), &mut || std::ops::ControlFlow::Continue(()))?;
/// assert_eq!(Simulation::start(&scenario, start)?.system.grains.len(), 20);
/// # Ok::<(), agglo::Error>(())
/// ```
///
/// # Errors
/// [`StartError`] where they cannot be placed or taken.
pub fn start(scenario: &Scenario, base: &Path, watch: &mut PlaceWatch<'_>) -> Result<Start, StartError> {
    Origin::of(scenario, base, watch).map(|origin| origin.start)
}

/// A path that holds wherever the scenario lies.
fn absolute(path: &Path) -> Result<PathBuf, RecordError> {
    std::path::absolute(path).map_err(RecordError::file("find", path))
}

/// Places the grains; the observer is told and may stop it.
fn placed(scenario: &Scenario, base: &Path, observer: &mut Observer<'_>) -> Result<Origin, RunError> {
    let mut told = Instant::now();
    let mut watch = || {
        if told.elapsed() < TELL_EVERY {
            return ControlFlow::Continue(());
        }
        told = Instant::now();
        before_the_start("placing grains", scenario.time.end.si(), observer)
    };
    match Origin::of(scenario, base, &mut watch) {
        Err(StartError::Placement(PackingError::Stopped)) => {
            Err(RunError::StoppedBefore("before the run began; nothing was written"))
        }
        placed => Ok(placed?),
    }
}

/// Tells the observer what is done before the clock starts or goes on.
fn before_the_start(words: &str, end: f64, observer: &mut Observer<'_>) -> ControlFlow<()> {
    let (now, warnings) = (words.to_owned(), Vec::new());
    observer(&Progress { time: 0.0, end, step: 0, steps_are: "steps", now, warnings })
}

/// The first session of a run.
fn sit<J: Job>(
    scenario: &Scenario,
    start: Start,
    folder: &RunFolder,
    began: Instant,
    guests: Guests<'_>,
    observer: &mut Observer<'_>,
) -> Result<Ending, RunError> {
    let started = Session::<J>::start(scenario, start, folder.clone(), began, guests, observer);
    started.inspect_err(|_| folder.abandon())?.carry_on(observer)
}

/// Goes on with the run in `dir` from its newest whole checkpoint.
///
/// A run that has finished is left as it is, and its summary given again.
///
/// # Errors
/// [`RunError`] where there is no whole checkpoint, a step fails or a file cannot be written.
pub fn resume(dir: &Path, observer: &mut Observer<'_>) -> Result<Ending, RunError> {
    resume_with(dir, None, Guests::default(), observer)
}

/// As [`resume`], or [`resume_until`] where an end is given, with the guests of the run.
///
/// # Errors
/// As these; [`RunError::OtherGuests`] where the run began with others.
pub fn resume_with(
    dir: &Path,
    until: Option<Time>,
    guests: Guests<'_>,
    observer: &mut Observer<'_>,
) -> Result<Ending, RunError> {
    if let Some(until) = until {
        let folder = RunFolder::take(dir)?;
        return on_a_worker(|| go_on(&folder, Some(until), guests, observer));
    }
    if let Some(summary) = finished(dir) {
        return Ok(Ending::Finished(summary));
    }
    let folder = RunFolder::take(dir)?;
    // Another process may have finished it in between.
    if let Some(summary) = finished(dir) {
        return Ok(Ending::Finished(summary));
    }
    on_a_worker(|| go_on(&folder, None, guests, observer))
}

/// Goes on with the run in `dir` until another end [s], whether it has finished or not. The folder's scenario gets the
/// new end, and its first line but one and the summary say so.
///
/// A run that was stopped comes to the same files as one that had the new end from the start. One that had finished goes
/// on from the checkpoint before its end, with the same outcome: its last step was cut to the end, and is done again.
///
/// # Errors
/// As [`resume`]; [`RunError::Until`] where the run has come to that time already.
pub fn resume_until(dir: &Path, until: Time, observer: &mut Observer<'_>) -> Result<Ending, RunError> {
    resume_with(dir, Some(until), Guests::default(), observer)
}

fn go_on(
    folder: &RunFolder,
    until: Option<Time>,
    guests: Guests<'_>,
    observer: &mut Observer<'_>,
) -> Result<Ending, RunError> {
    let has_finished = folder.summary().exists();
    let mut reading = |words: &str| before_the_start(words, 0.0, observer);
    let mut found = fit::load(folder, until.is_some() && has_finished, &mut reading)?;
    same_guests(folder, found.saved.parts().1.own().known(), &guests)?;
    guests.check(matches!(found.saved, AnySaved::Hard(_)))?;
    if let Some(until) = until {
        until::change(folder, &mut found.saved, until)?;
    }
    // Only now that nothing refuses it: a folder that holds no run stays as it is.
    folder.complete()?;
    let (folder, way) = (folder.clone(), Way { is_new_end: until.is_some(), refused: found.refused });
    match found.saved {
        AnySaved::Soft(saved) => {
            Session::<Soft>::resume(folder, *saved, found.tables, &way, guests)?.carry_on(observer)
        }
        AnySaved::Hard(saved) => {
            Session::<Hard>::resume(folder, *saved, found.tables, &way, guests)?.carry_on(observer)
        }
    }
}

/// Refuses to go on with other guests than those that the run began with.
fn same_guests(folder: &RunFolder, began: &Known, guests: &Guests<'_>) -> Result<(), RunError> {
    let given = guests.known();
    if *began == given {
        return Ok(());
    }
    let (dir, began, given) = (folder.root().to_owned(), began.to_string(), given.to_string());
    Err(RunError::OtherGuests { dir, began, given })
}

/// The summary of the run in `dir`, if it has finished.
///
/// The summary is written last, so a run without one, or with one that cannot be read, has something left to do.
pub fn finished(dir: &Path) -> Option<Summary> {
    summary(dir).ok().flatten()
}

/// The summary of the run in `dir`; nothing where there is no run, or none that has finished.
///
/// # Errors
/// [`RecordError`] where there is one that cannot be read.
pub fn summary(dir: &Path) -> Result<Option<Summary>, RecordError> {
    let Ok(folder) = RunFolder::open(dir) else { return Ok(None) };
    let path = folder.summary();
    let text = match door::read_text(&path, door::MOST_OF_A_TEXT) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        read => read.map_err(RecordError::file("read", &path))?,
    };
    let damaged =
        |_| RecordError::Damaged { path, reason: "it is damaged, or of another version".to_owned() };
    serde_json::from_str(&text).map(Some).map_err(damaged)
}

/// Works on a thread of the pool, so that the many small parallel loops of a step need not wake one each time.
fn on_a_worker<R: Send>(work: impl FnOnce() -> R + Send) -> R {
    rayon::scope(|_| work())
}

#[cfg(test)]
mod forged_tests;
