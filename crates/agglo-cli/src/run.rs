//! The verbs `run` and `resume`.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use agglo::run::{Ending, Observer, RunError, Summary};
use agglo::scenario::readable;

use crate::arguments::Orders;
use crate::progress::Display;
use crate::{Failure, print, read};

/// Runs a scenario into a folder.
pub(crate) fn run(orders: &Orders) -> Result<(), Failure> {
    read::refuse_other_kind(&orders.scenario, read::Kind::Scenario)?;
    let settings = settings(orders);
    let read = read::scenario(&orders.scenario, &settings)?;
    let folder = orders.output.clone().unwrap_or_else(|| default_folder(&orders.scenario));
    refuse_occupied(&folder)?;
    use_threads(orders.threads)?;
    go(&folder, |observer| agglo::run::run(&read.scenario, &read.base, &folder, observer))
}

/// Goes on with the run in a folder.
pub(crate) fn resume(folder: &Path, threads: Option<u32>) -> Result<(), Failure> {
    if !folder.is_dir() {
        return Err(Failure::bad_input(format!("error: there is no folder {}", folder.display())));
    }
    if let Some(summary) = agglo::run::finished(folder) {
        let shown = folder.display();
        return print(&format!("{}\nthe run in {shown} has finished already", table(&summary)));
    }
    use_threads(threads)?;
    go(folder, |observer| agglo::run::resume(folder, observer))
}

/// The settings of the command line, the seed among them.
pub(crate) fn settings(orders: &Orders) -> Vec<String> {
    let seed = orders.seed.map(|seed| format!("seed={seed}"));
    orders.settings.iter().cloned().chain(seed).collect()
}

/// Where the results go if no folder is named.
pub(crate) fn default_folder(scenario: &Path) -> PathBuf {
    Path::new("out").join(scenario.file_stem().unwrap_or("run".as_ref()))
}

/// A folder that holds anything is left alone: it may be the only copy of another run.
pub(crate) fn refuse_occupied(folder: &Path) -> Result<(), Failure> {
    let shown = folder.display();
    if folder.exists() && !folder.is_dir() {
        return Err(Failure::bad_input(format!("error: {shown} is a file; choose a folder with -o")));
    }
    let occupied = std::fs::read_dir(folder).is_ok_and(|mut entries| entries.next().is_some());
    if occupied {
        let help = format!("`agglo resume {shown}` goes on with a run; -o FOLDER writes elsewhere");
        return Err(Failure::bad_input(format!("error: the folder {shown} is not empty\nhelp: {help}")));
    }
    Ok(())
}

/// Makes the program's pool of threads.
pub(crate) fn use_threads(threads: Option<u32>) -> Result<(), Failure> {
    let Some(threads) = threads else { return Ok(()) };
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads as usize)
        .build_global()
        .map_err(|error| Failure::failed(format!("error: cannot start {threads} threads: {error}")))
}

/// Runs with a display, stops at Ctrl-C, and says how it ended.
fn go(
    folder: &Path,
    work: impl FnOnce(&mut Observer<'_>) -> Result<Ending, RunError>,
) -> Result<(), Failure> {
    let stop = listen()?;
    let mut display = Display::new();
    let outcome = work(&mut |progress| {
        display.show(progress);
        if stop.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let closing = display.finish();
    let shown = folder.display();
    match outcome {
        Ok(Ending::Finished(summary)) => print(&format!("{}\nin {shown} ({closing})", table(&summary))),
        Ok(Ending::Interrupted(time)) => {
            let time = readable(time, "s");
            let message =
                format!("stopped at t = {time} ({closing}); `agglo resume {shown}` goes on from there");
            Err(Failure::failed(message))
        }
        Err(error) => {
            Err(Failure { message: format!("error: {error}\n({closing})"), code: error.exit_code() })
        }
    }
}

/// A flag that Ctrl-C sets.
pub(crate) fn listen() -> Result<Arc<AtomicBool>, Failure> {
    let stop = Arc::new(AtomicBool::new(false));
    let asked = Arc::clone(&stop);
    ctrlc::set_handler(move || interrupt(&asked))
        .map_err(|error| Failure::failed(format!("error: cannot listen for Ctrl-C: {error}")))?;
    Ok(stop)
}

/// The first Ctrl-C asks the run to stop with a checkpoint, the second ends the program at once.
fn interrupt(asked: &AtomicBool) {
    if asked.swap(true, Ordering::Relaxed) {
        std::process::exit(1);
    }
}

fn table(summary: &Summary) -> String {
    columns(&summary.table())
}

/// Rows in two columns.
pub(crate) fn columns(rows: &[(String, String)]) -> String {
    let width = rows.iter().map(|(label, _)| label.chars().count()).max().unwrap_or(0);
    let lines: Vec<String> =
        rows.iter().map(|(label, value)| format!("  {label:<width$}  {value}")).collect();
    lines.join("\n")
}
