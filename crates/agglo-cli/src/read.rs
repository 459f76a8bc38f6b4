//! Reads scenario, search and study files and shows their faults.

use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

use agglo::record::door;
use agglo::scenario::{Faults, Scenario};
use agglo::search::Campaign;

use crate::Failure;

/// A place that must be a folder to be read: of a run, search or study.
pub(crate) fn folder(place: &Path) -> Result<(), Failure> {
    let shown = place.display();
    if place.is_dir() {
        Ok(())
    } else if place.exists() {
        Err(Failure::bad_input(format!(
            "error: {shown} is a file; give the folder that `agglo run`, `search` or `study` wrote into"
        )))
    } else {
        Err(Failure::bad_input(format!("error: there is no folder {shown}")))
    }
}

/// What a file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A scenario, or nothing that can be told.
    Scenario,
    /// A search, or a campaign that is neither.
    Search,
    /// A study.
    Study,
}

impl Kind {
    /// Its word with an article.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Scenario => "a scenario",
            Self::Search => "a search",
            Self::Study => "a study",
        }
    }

    /// The verb for it.
    pub(crate) fn verb(self) -> &'static str {
        match self {
            Self::Scenario => "run",
            Self::Search => "search",
            Self::Study => "study",
        }
    }
}

/// A file that was read, once: what comes through a pipe is gone then.
pub(crate) struct Source {
    /// What messages call it.
    pub shown: String,
    /// The folder that files named in it are relative to.
    pub base: PathBuf,
    text: String,
}

impl Source {
    /// Reads a file; `-` is the standard input, and the names that shells give to pipes are pipes.
    pub(crate) fn read(file: &Path) -> Result<Self, Failure> {
        let most = door::MOST_OF_A_TEXT;
        let (is_input, is_pipe) = (file == Path::new("-"), is_of_a_shell(file));
        let read = if is_input {
            door::read_stream(io::stdin().lock(), most)
        } else if is_pipe {
            std::fs::File::open(file).and_then(|stream| door::read_stream(stream, most))
        } else {
            door::read_text(file, most)
        };
        let shown = if is_input { "standard input".to_owned() } else { file.display().to_string() };
        let folder = file.parent().unwrap_or(Path::new(""));
        let base = if is_input || is_pipe { PathBuf::new() } else { folder.to_path_buf() };
        match read {
            Ok(text) => Ok(Self { shown, base, text }),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                let help = "`agglo new acoustic > my.toml` writes a scenario to start from";
                Err(Failure::bad_input(format!("error: cannot read {shown}: {error}\nhelp: {help}")))
            }
            Err(error) => Err(Failure::bad_input(format!("error: cannot read {shown}: {error}"))),
        }
    }

    /// A text of the program's own.
    pub(crate) fn of_text(shown: &str, text: &str) -> Self {
        Self { shown: shown.to_owned(), base: PathBuf::new(), text: text.to_owned() }
    }

    /// What it is meant to be, told from its text without reading it closely.
    pub(crate) fn kind(&self) -> Kind {
        if !Campaign::is_meant_by(&self.text) {
            return Kind::Scenario;
        }
        let is_plan = |line: &str| {
            let line = line.trim_start().trim_start_matches('[').trim_start();
            line.strip_prefix("plan").is_some_and(|rest| rest.trim_start().starts_with([']', '.', '=']))
        };
        if self.text.lines().any(is_plan) { Kind::Study } else { Kind::Search }
    }

    /// Refuses a file that another verb is for.
    pub(crate) fn refuse_other_kind(&self, wanted: Kind) -> Result<(), Failure> {
        let found = self.kind();
        if found == wanted {
            return Ok(());
        }
        let (shown, words, verb) = (&self.shown, found.words(), found.verb());
        let message = format!("error: {shown} is {words}\nhelp: `agglo {verb} {shown}` is for it");
        Err(Failure::bad_input(message))
    }

    /// Checks a search or study with its settings.
    pub(crate) fn campaign(&self, settings: &[String]) -> Result<Campaign, Failure> {
        Campaign::from_source(&self.text, &self.base, settings).map_err(|faults| self.refusal(faults))
    }

    /// Checks a scenario with its settings.
    pub(crate) fn scenario(&self, settings: &[String]) -> Result<Scenario, Failure> {
        Scenario::from_source(&self.text, &self.base, settings).map_err(|faults| self.refusal(faults))
    }

    fn refusal(&self, faults: Faults) -> Failure {
        Failure::page(faults.render(&self.text, &self.shown, wants_color()), &self.shown, faults)
    }
}

/// Whether a file is the standard input by another name, or a pipe that a shell has made: `<(agglo new acoustic)`.
fn is_of_a_shell(file: &Path) -> bool {
    file == Path::new("/dev/stdin") || file.starts_with("/dev/fd") || file.starts_with("/proc/self/fd")
}

/// Colors on a terminal, unless the user has asked for none (no-color.org).
fn wants_color() -> bool {
    io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}
