//! Ctrl-C and its kin.
//!
//! The first one asks for an end, which comes within a second wherever nothing has to be saved, and after the step at hand
//! elsewhere. The second one ends the program at once.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use agglo::folder::Traces;
use agglo_view::render::clear_at_exit;

use crate::{Failure, tell};

/// After this time without an end the program says that it has heard.
const PATIENCE: Duration = Duration::from_millis(700);

/// Hears signals, and knows what they find the program at.
#[derive(Clone)]
pub(crate) struct Ear {
    stop: Arc<AtomicBool>,
    /// What is said where nothing has to be saved: then the first signal ends the program at once.
    farewell: Arc<Mutex<Option<String>>>,
    /// What is said after [`PATIENCE`].
    late: Late,
}

/// What becomes of a program that did not end by itself after [`PATIENCE`].
#[derive(Clone, Copy)]
pub(crate) enum Late {
    /// It says that it goes on to the end of its step.
    GoesOn,
    /// It ends: the work at hand is not kept anyway.
    Ends(&'static str),
}

impl Ear {
    /// Listens; a program that ends at once leaves no empty folder where `folder` was to be.
    pub(crate) fn open(folder: Option<&Path>, late: Late) -> Result<Self, Failure> {
        let ear = Self { stop: Arc::default(), farewell: Arc::default(), late };
        let traces = folder.map(|folder| (folder.to_owned(), Traces::before(folder)));
        let hearing = ear.clone();
        ctrlc::set_handler(move || hearing.hear(traces.as_ref()))
            .map_err(|error| Failure::failed(format!("error: cannot listen for Ctrl-C: {error}")))?;
        Ok(ear)
    }

    /// Whether an end was asked for.
    pub(crate) fn is_asked(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// The flag itself.
    pub(crate) fn flag(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.stop)
    }

    /// From now on nothing has to be saved.
    pub(crate) fn ends_at_once(&self, farewell: String) {
        *self.farewell() = Some(farewell);
    }

    fn farewell(&self) -> MutexGuard<'_, Option<String>> {
        self.farewell.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn hear(&self, traces: Option<&(PathBuf, Traces)>) {
        let is_second = self.stop.swap(true, Ordering::Relaxed);
        let farewell = self.farewell();
        if is_second || farewell.is_some() {
            if let Some(words) = farewell.as_deref() {
                tell(words);
            }
            if let Some((folder, traces)) = traces {
                traces.clear_at_exit(folder);
            }
            end();
        }
        let late = self.late;
        std::thread::spawn(move || {
            std::thread::sleep(PATIENCE);
            let goes_on = "stopping as soon as the step at hand is done; once more ends at once";
            let words = if let Late::Ends(words) = late { words } else { goes_on };
            tell(words);
            if let Late::Ends(_) = late {
                end();
            }
        });
    }
}

/// Ends the program, which leaves nothing half-made.
fn end() -> ! {
    clear_at_exit();
    std::process::exit(1);
}

/// A file that grows beyond the limit for files is an error of its write, and not the end of the program.
#[cfg(unix)]
pub(crate) fn outlive_file_limits() {
    // The flag itself is of no use: the write says what happened. Where it cannot be set, all is as before.
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
}

/// There is no such signal.
#[cfg(not(unix))]
pub(crate) fn outlive_file_limits() {}
