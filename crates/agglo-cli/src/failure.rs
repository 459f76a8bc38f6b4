//! Why the program ends early.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use agglo::scenario::Faults;
use agglo::text::visible;

use crate::brake::Reason;

/// Why the program ends early: the message for the user and the exit code.
#[derive(Debug)]
pub(crate) struct Failure {
    pub message: String,
    pub code: u8,
    /// Whether it has colors of our own, and nothing else that acts on a terminal.
    is_page: bool,
    /// What programs are told besides.
    pub about: About,
}

/// What programs are told of a failure besides its message.
#[derive(Debug, Default)]
pub(crate) enum About {
    /// Nothing.
    #[default]
    Words,
    /// What is wrong with a file, or with the scenario or campaign that became of it.
    Faults {
        /// What the file is called.
        file: String,
        /// All that is wrong with it.
        faults: Faults,
    },
    /// A session was stopped on its way.
    Stopped(Box<Stopped>),
}

/// How a session was stopped.
#[derive(Debug)]
pub(crate) struct Stopped {
    /// Its folder.
    pub folder: PathBuf,
    /// Why.
    pub reason: Reason,
    /// Simulated time of the checkpoint [s]; none of searches and of runs that did not begin.
    pub time_s: Option<f64>,
    /// Wall time of the session [s].
    pub wall_s: f64,
    /// Whether there is something to go on from.
    pub can_resume: bool,
}

impl Failure {
    /// Something that the user asked for cannot be done.
    pub(crate) fn bad_input(message: impl Into<String>) -> Self {
        Self::with_code(message, 2)
    }

    /// Something went wrong on the way.
    pub(crate) fn failed(message: impl Into<String>) -> Self {
        Self::with_code(message, 1)
    }

    /// An error of the library with its exit code.
    pub(crate) fn with_code(message: impl Into<String>, code: u8) -> Self {
        Self { message: message.into(), code, is_page: false, about: About::Words }
    }

    /// Faults of a file, drawn by [`Faults::render`].
    pub(crate) fn page(page: String, file: &str, faults: Faults) -> Self {
        Self { is_page: true, ..Self::bad_input(page) }.with_faults(file, faults)
    }

    /// The same with faults one by one.
    pub(crate) fn with_faults(self, file: &str, faults: Faults) -> Self {
        Self { about: About::Faults { file: file.to_owned(), faults }, ..self }
    }

    /// A session that was stopped on its way.
    pub(crate) fn stopped(message: String, code: u8, how: Stopped) -> Self {
        Self { about: About::Stopped(Box::new(how)), ..Self::with_code(message, code) }
    }

    /// Tells people of it.
    pub(crate) fn tell(&self) {
        // Nothing is left to do where even this message cannot be written.
        let message = if self.is_page { self.message.as_str().into() } else { visible(&self.message) };
        let _ = writeln!(io::stderr(), "{message}");
    }
}

/// A path as messages show it.
pub(crate) fn shown(path: &Path) -> String {
    path.display().to_string()
}
