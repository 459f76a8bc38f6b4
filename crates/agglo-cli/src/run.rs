//! The verbs `run` and `resume`.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use agglo::run::{Ending, Observer, Progress, RunError, Summary};
use agglo::scenario::readable;

use crate::arguments::{Orders, RunOrders};
use crate::progress::Display;
use crate::{Failure, print, progress, read, report};

/// Runs a scenario into a folder.
pub(crate) fn run(run_orders: &RunOrders) -> Result<(), Failure> {
    let orders = &run_orders.orders;
    read::refuse_other_kind(&orders.scenario, read::Kind::Scenario)?;
    let settings = settings(orders);
    let read = read::scenario(&orders.scenario, &settings)?;
    let folder = orders.output.clone().unwrap_or_else(|| default_folder(&orders.scenario));
    refuse_occupied(&folder)?;
    use_threads(orders.threads)?;
    let beside = |stop| companion(run_orders, &folder, stop);
    go(&folder, beside, !orders.no_report, |observer| {
        agglo::run::run(&read.scenario, &read.base, &folder, observer)
    })
}

/// The dashboard, where it is wanted and there is a terminal for it.
#[cfg(feature = "watch")]
fn companion(orders: &RunOrders, folder: &Path, stop: Arc<AtomicBool>) -> Option<Box<dyn Companion>> {
    let is_shown = orders.watch && std::io::IsTerminal::is_terminal(&std::io::stdout());
    is_shown.then(|| -> Box<dyn Companion> { Box::new(crate::watch::Guest::new(folder, stop)) })
}

/// This program was built without the dashboard.
#[cfg(not(feature = "watch"))]
fn companion(_: &RunOrders, _: &Path, _: Arc<AtomicBool>) -> Option<Box<dyn Companion>> {
    None
}

/// Goes on with the run in a folder.
pub(crate) fn resume(folder: &Path, threads: Option<u32>, reports: bool) -> Result<(), Failure> {
    if !folder.is_dir() {
        return Err(Failure::bad_input(format!("error: there is no folder {}", folder.display())));
    }
    if let Some(summary) = agglo::run::finished(folder) {
        let shown = folder.display();
        return print(&format!("{}\nthe run in {shown} has finished already", table(&summary)));
    }
    use_threads(threads)?;
    go(folder, |_| None, reports, |observer| agglo::run::resume(folder, observer))
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

/// What shows a run's progress in place of the bar.
pub(crate) trait Companion: Send {
    /// Tells of progress; false once nobody looks any more.
    fn tell(&mut self, progress: &Progress) -> bool;

    /// Gives the terminal back.
    fn close(self: Box<Self>) -> std::io::Result<()>;
}

/// Runs with a display, stops at Ctrl-C, writes the report of what finished, and says how it ended.
fn go(
    folder: &Path,
    beside: impl FnOnce(Arc<AtomicBool>) -> Option<Box<dyn Companion>>,
    reports: bool,
    work: impl FnOnce(&mut Observer<'_>) -> Result<Ending, RunError>,
) -> Result<(), Failure> {
    let stop = listen()?;
    let mut display = Display::new();
    let mut companion = beside(Arc::clone(&stop));
    let outcome = work(&mut |progress| {
        if companion.as_mut().is_some_and(|companion| companion.tell(progress)) {
            display.note(progress);
        } else {
            display.show(progress);
        }
        if stop.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let closed = companion.map_or(Ok(()), Companion::close);
    let (wall, closing) = display.finish();
    let shown = folder.display();
    if let Err(error) = closed {
        print(&format!("the dashboard could not be shown: {error}"))?;
    }
    match outcome {
        Ok(Ending::Finished(summary)) => {
            let page = if reports { report::at_the_end(folder) } else { String::new() };
            // Of the whole run, also where this was only the end of it.
            let warnings = progress::count(summary.warnings().len());
            print(&format!("{}\nin {shown} ({wall}, {warnings}){page}", table(&summary)))
        }
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

/// The closing table.
pub(crate) fn table(summary: &Summary) -> String {
    columns(&summary.table())
}

/// Rows in two columns.
pub(crate) fn columns(rows: &[(String, String)]) -> String {
    let width = rows.iter().map(|(label, _)| label.chars().count()).max().unwrap_or(0);
    let lines: Vec<String> =
        rows.iter().map(|(label, value)| format!("  {label:<width$}  {value}")).collect();
    lines.join("\n")
}
