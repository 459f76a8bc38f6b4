//! Reads scenario, search and study files and shows their faults.

use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

use agglo::scenario::{LoadError, Scenario};
use agglo::search::Campaign;

use crate::Failure;

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

/// What a file is meant to be, told from its text without reading it closely.
pub(crate) fn kind(file: &Path) -> Kind {
    let Ok(text) = std::fs::read_to_string(file) else { return Kind::Scenario };
    if !Campaign::is_meant_by(&text) {
        return Kind::Scenario;
    }
    let is_plan = |line: &str| {
        let line = line.trim_start().trim_start_matches('[').trim_start();
        line.strip_prefix("plan").is_some_and(|rest| rest.trim_start().starts_with([']', '.', '=']))
    };
    if text.lines().any(is_plan) { Kind::Study } else { Kind::Search }
}

/// Refuses a file that another verb is for.
pub(crate) fn refuse_other_kind(file: &Path, wanted: Kind) -> Result<(), Failure> {
    let found = kind(file);
    if found == wanted || !file.is_file() {
        return Ok(());
    }
    let (shown, words, verb) = (file.display(), found.words(), found.verb());
    let message = format!("error: {shown} is {words}\nhelp: `agglo {verb} {shown}` is for it");
    Err(Failure::bad_input(message))
}

/// A checked search or study and the folder that its files are relative to.
pub(crate) fn campaign(file: &Path, settings: &[String]) -> Result<(Campaign, PathBuf), Failure> {
    let campaign = Campaign::load_with_overrides(file, settings).map_err(|error| refusal(&error))?;
    Ok((campaign, file.parent().unwrap_or(Path::new("")).to_path_buf()))
}

/// A checked scenario and the folder that its tables are relative to.
pub(crate) struct Read {
    pub scenario: Scenario,
    pub base: PathBuf,
}

/// Reads and checks a scenario with its settings.
pub(crate) fn scenario(file: &Path, settings: &[String]) -> Result<Read, Failure> {
    let scenario = Scenario::load_with_overrides(file, settings).map_err(|error| refusal(&error))?;
    Ok(Read { scenario, base: file.parent().unwrap_or(Path::new("")).to_path_buf() })
}

fn refusal(error: &LoadError) -> Failure {
    match error {
        LoadError::Faulty { path, faults, text } => {
            Failure::bad_input(faults.render(text, path, wants_color()))
        }
        LoadError::Unreadable { cause, .. } if cause.kind() == io::ErrorKind::NotFound => {
            let help = "`agglo new acoustic > my.toml` writes a scenario to start from";
            Failure::bad_input(format!("error: {error}\nhelp: {help}"))
        }
        LoadError::Unreadable { .. } => Failure::bad_input(format!("error: {error}")),
    }
}

/// Colours on a terminal, unless the user has asked for none (no-color.org).
fn wants_color() -> bool {
    io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}
