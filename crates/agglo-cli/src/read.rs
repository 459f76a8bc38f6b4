//! Reads scenario files and shows their faults.

use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

use agglo::scenario::{LoadError, Scenario};

use crate::Failure;

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
