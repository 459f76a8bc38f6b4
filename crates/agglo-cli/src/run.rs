//! The verbs `run` and `resume`.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use agglo::engine::SimError;
use agglo::run::{Ending, Observer, Progress, RunError};
use agglo::text::readable;
use agglo::units::{Quantity, Time, parse_quantity};

use crate::arguments::{CommonOptions, ResumeOptions, RunOptions};
use crate::brake::WallTime;
use crate::session::{self, Outcome, Session};
use crate::{Failure, print, read, tell};

/// Runs a scenario into a folder.
pub(crate) fn run(run_options: &RunOptions) -> Result<(), Failure> {
    let options = &run_options.common;
    let wall = WallTime::of(options.session.wall_time.as_deref())?;
    let source = read::Source::read(&options.scenario)?;
    source.refuse_other_kind(read::Kind::Scenario)?;
    let scenario = source.scenario(&starting_from(settings(options), run_options.from.as_deref())?)?;
    let folder = options.output.clone().unwrap_or_else(|| default_folder(&options.scenario));
    refuse_occupied(&folder)?;
    let beside = |stop| companion(run_options, &folder, stop);
    let session = Session::open("run", &folder, wall, &options.session)?;
    let guests = run_options.spread.guests();
    go(session, beside, |observer| agglo::run::run_with(&scenario, &source.base, &folder, guests, observer))
}

/// The dashboard, where it is wanted and there is a terminal for it.
#[cfg(feature = "watch")]
fn companion(options: &RunOptions, folder: &Path, stop: Arc<AtomicBool>) -> Option<Box<dyn Companion>> {
    let is_shown = options.watch && std::io::IsTerminal::is_terminal(&std::io::stdout());
    is_shown.then(|| -> Box<dyn Companion> { Box::new(crate::watch::Guest::new(folder, stop)) })
}

/// This program was built without the dashboard.
#[cfg(not(feature = "watch"))]
fn companion(_: &RunOptions, _: &Path, _: Arc<AtomicBool>) -> Option<Box<dyn Companion>> {
    None
}

/// Goes on with the run in a folder.
pub(crate) fn resume(options: &ResumeOptions) -> Result<(), Failure> {
    let folder = options.folder.as_path();
    let wall = WallTime::of(options.session.wall_time.as_deref())?;
    read::folder(folder)?;
    let until = options.until.as_ref().map(|until| {
        parse_quantity(until, Time::DIMENSION)
            .map_err(|error| Failure::bad_input(format!("error: --until: {error}")))
    });
    let until = until.transpose()?.map(Quantity);
    if until.is_none()
        && let Some(summary) = agglo::run::finished(folder)
    {
        return session::has_finished(folder, &Outcome::Run(summary), &options.session);
    }
    let session = Session::open("resume", folder, wall, &options.session)?;
    go(
        session,
        |_| None,
        |observer| agglo::run::resume_with(folder, until, options.spread.guests(), observer),
    )
}

/// The settings of the command line, the seed among them.
pub(crate) fn settings(options: &CommonOptions) -> Vec<String> {
    let seed = options.seed.map(|seed| format!("seed={seed}"));
    options.settings.iter().cloned().chain(seed).collect()
}

/// Settings, with the run that grains are taken from; its path holds from wherever the scenario lies.
pub(crate) fn starting_from(mut settings: Vec<String>, from: Option<&Path>) -> Result<Vec<String>, Failure> {
    if let Some(from) = from {
        let bad = |reason: String| Failure::bad_input(format!("error: --from {}: {reason}", from.display()));
        let path = std::path::absolute(from).map_err(|error| bad(error.to_string()))?;
        let text = path.to_str().ok_or_else(|| bad("the path is not text".to_owned()))?;
        // As JSON quotes a text, so does TOML.
        settings.push(format!("start.from={}", serde_json::Value::from(text)));
    }
    Ok(settings)
}

/// Where the results go if no folder is named.
pub(crate) fn default_folder(scenario: &Path) -> PathBuf {
    let stem = scenario.file_stem().filter(|stem| *stem != "-");
    Path::new("out").join(stem.unwrap_or("stdin".as_ref()))
}

/// A folder that holds anything is left alone: it may be the only copy of another run.
pub(crate) fn refuse_occupied(folder: &Path) -> Result<(), Failure> {
    agglo::folder::vacant(folder)
        .map_err(|error| Failure::with_code(format!("error: {error}"), error.exit_code()))
}

/// Threads that can be asked for at the most.
const MOST_THREADS: usize = 4096;

/// Makes the program's pool of threads: as many as are wanted, or as `RAYON_NUM_THREADS` says. More than could be asked for
/// by `--threads` are as many as there are processors.
pub(crate) fn use_threads(wanted: Option<u32>) -> Result<(), Failure> {
    let of_environment: Option<usize> =
        std::env::var("RAYON_NUM_THREADS").ok().and_then(|count| count.parse().ok());
    let threads = match (wanted, of_environment) {
        (Some(threads), _) => threads as usize,
        (None, Some(threads)) if threads > MOST_THREADS => {
            tell(&format!(
                "warning: RAYON_NUM_THREADS={threads} is more than {MOST_THREADS}: all processors are used"
            ));
            std::thread::available_parallelism().map_or(1, usize::from)
        }
        (None, _) => return Ok(()),
    };
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build_global()
        .map_err(|error| Failure::failed(format!("error: cannot start {threads} threads: {error}")))
}

/// What shows a run's progress in place of the bar.
pub(crate) trait Companion: Send {
    /// Tells of progress; false once nobody looks any more.
    fn tell(&mut self, progress: &Progress) -> bool;

    /// Gives the terminal back.
    fn close(self: Box<Self>) -> std::io::Result<()>;
}

/// Runs while somebody is told, stops at Ctrl-C or when the wall time is up, and says how it ended.
fn go(
    mut session: Session,
    beside: impl FnOnce(Arc<AtomicBool>) -> Option<Box<dyn Companion>>,
    work: impl FnOnce(&mut Observer<'_>) -> Result<Ending, RunError>,
) -> Result<(), Failure> {
    let mut companion = beside(session.flag());
    let outcome = work(&mut |progress| {
        let is_shown = companion.as_mut().is_some_and(|companion| companion.tell(progress));
        session.run(progress, is_shown)
    });
    let closed = companion.map_or(Ok(()), Companion::close);
    session.rest();
    if let Err(error) = closed {
        print(&format!("the dashboard could not be shown: {error}"))?;
    }
    match outcome {
        Ok(Ending::Finished(summary)) => session.finished(&Outcome::Run(summary)),
        Ok(Ending::Interrupted(time)) => {
            Err(session.stopped(&format!("stopped at t = {}", readable(time, "s")), "", Some(time)))
        }
        Err(error @ (RunError::StoppedBefore(_) | RunError::Start(SimError::StoppedAtRest))) => {
            Err(session.stopped_before(&error.to_string()))
        }
        Err(error) => Err(session.failed(&error, error.exit_code())),
    }
}
