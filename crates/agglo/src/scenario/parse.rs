//! From a text to a typed document: syntax, form, then the rules between keys; all faults of a stage at once.

use std::path::Path;

use serde::de::DeserializeOwned;
use serde_json::Value as Json;
use toml::de::DeTable;

use super::fault::{Fault, Faults, line_and_column};
use super::file::ScenarioFile;
use super::tree::{Node, Place};
use super::types::Scenario;
use super::walk::Walk;
use super::{check, settings};
use crate::record::door;
use crate::units::Quantity;

/// What a file is read as: a scenario, a search or a study.
pub(crate) trait Document: Sized {
    /// Its tables as the file has them.
    type File: DeserializeOwned;

    /// The JSON schema that its form is held to.
    fn schema() -> Json;

    /// Holds it to its rules.
    ///
    /// With `base`, the folder that other files are relative to, those must be there too.
    ///
    /// # Errors
    /// Everything that is wrong with it though its form is right; the keys are paths in it.
    fn checked(file: Self::File, base: Option<&Path>) -> Result<Self, Vec<Fault>>;
}

impl Document for Scenario {
    type File = ScenarioFile;

    fn schema() -> Json {
        schema()
    }

    fn checked(file: ScenarioFile, base: Option<&Path>) -> Result<Self, Vec<Fault>> {
        let faults = check::faults(&file, base);
        if !faults.is_empty() {
            return Err(faults);
        }
        Self::try_from(file).map_err(|reason| vec![Fault::new("", reason.to_owned())])
    }
}

/// Why a file could not be loaded.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// The file could not be read.
    #[error("cannot read {path}: {cause}")]
    Unreadable {
        /// The file.
        path: String,
        /// What the system says.
        cause: std::io::Error,
    },
    /// The file has faults.
    #[error("{path}:\n{faults}")]
    Faulty {
        /// The file.
        path: String,
        /// Its faults.
        faults: Faults,
        /// Its text, for [`Faults::render`].
        text: String,
    },
}

/// The JSON schema of a scenario.
pub fn schema() -> Json {
    schemars::schema_for!(ScenarioFile).to_value()
}

impl Scenario {
    /// Reads and checks a scenario.
    ///
    /// # Errors
    /// All faults of the first stage that has any: syntax; form; rules between keys.
    pub fn from_toml(text: &str) -> Result<Self, Faults> {
        Self::with_overrides::<&str>(text, &[])
    }

    /// Reads and checks a scenario in which settings `key.path=value` replace values of the text.
    ///
    /// A value is TOML, or else a bare string: `time.end=1 s`, `acoustics.beams.0.rays=500`.
    ///
    /// # Errors
    /// As [`Scenario::from_toml`]; the faults of settings come with their text.
    pub fn with_overrides<S: AsRef<str>>(text: &str, overrides: &[S]) -> Result<Self, Faults> {
        let overrides: Vec<&str> = overrides.iter().map(AsRef::as_ref).collect();
        read(text, &overrides, None)
    }

    /// Reads and checks a scenario file and that its tables are there.
    ///
    /// # Errors
    /// [`LoadError`] where the file cannot be read or has faults.
    pub fn load(path: &Path) -> Result<Self, LoadError> {
        Self::load_with_overrides::<&str>(path, &[])
    }

    /// As [`Scenario::load`], with settings as in [`Scenario::with_overrides`].
    ///
    /// # Errors
    /// [`LoadError`] where the file cannot be read, or it or a setting has faults.
    pub fn load_with_overrides<S: AsRef<str>>(path: &Path, overrides: &[S]) -> Result<Self, LoadError> {
        let overrides: Vec<&str> = overrides.iter().map(AsRef::as_ref).collect();
        load(path, &overrides)
    }

    /// As [`Scenario::with_overrides`], of a text that was read from somewhere; its tables are relative to `base` and must be
    /// there.
    ///
    /// # Errors
    /// As [`Scenario::with_overrides`].
    pub fn from_source<S: AsRef<str>>(text: &str, base: &Path, overrides: &[S]) -> Result<Self, Faults> {
        let overrides: Vec<&str> = overrides.iter().map(AsRef::as_ref).collect();
        read(text, &overrides, Some(base))
    }

    /// Holds a scenario that was not read from a text to the rules between keys.
    ///
    /// # Errors
    /// All faults, without lines.
    pub fn check(&self) -> Result<(), Faults> {
        let broken = check::faults(&self.clone().into(), None);
        if broken.is_empty() { Ok(()) } else { Err(Faults::new(broken)) }
    }

    /// The same with how often output is written worked out, where that was left to the program.
    #[must_use]
    pub fn resolved(&self) -> Self {
        let mut resolved = self.clone();
        let end = self.time.end.si();
        let output = &mut resolved.output;
        output.series.get_or_insert(Quantity(end / 200.0));
        output.frames.get_or_insert(Quantity(end / 40.0));
        output.checkpoints.get_or_insert(Quantity(end / 20.0));
        resolved
    }

    /// The scenario as TOML with every default written out; reads back as the same scenario.
    ///
    /// # Errors
    /// A fault where a number does not fit into TOML.
    pub fn to_toml(&self) -> Result<String, Faults> {
        toml::to_string(self).map_err(|error| Faults::new(vec![Fault::new("", error.to_string())]))
    }
}

/// Reads a file with its settings; other files that it names must be there.
pub(crate) fn load<D: Document>(path: &Path, overrides: &[&str]) -> Result<D, LoadError> {
    let shown = path.display().to_string();
    let text = door::read_text(path, door::MOST_OF_A_TEXT)
        .map_err(|cause| LoadError::Unreadable { path: shown.clone(), cause })?;
    let base = path.parent().unwrap_or(Path::new(""));
    read(&text, overrides, Some(base)).map_err(|faults| LoadError::Faulty { path: shown, faults, text })
}

/// Reads a text with its settings; with `base`, the folder that other files are relative to, those must be there.
pub(crate) fn read<D: Document>(text: &str, overrides: &[&str], base: Option<&Path>) -> Result<D, Faults> {
    let placed = |faults: Vec<(Place, Fault)>| {
        shortened(faults, |(place, fault)| put_in(place, fault, text, overrides))
    };
    let mut root = read_tree(text).map_err(placed)?;
    let mut faults = Vec::new();
    for (number, setting) in overrides.iter().enumerate() {
        faults.extend(settings::apply(&mut root, setting, number + 1));
    }
    faults.extend(Walk::faults(&D::schema(), &root));
    if !faults.is_empty() {
        return Err(placed(faults));
    }
    let file: D::File = root.to_value().try_into().map_err(|error: toml::de::Error| {
        Faults::new(vec![Fault::new("", error.message().trim().to_owned())])
    })?;
    D::checked(file, base).map_err(|broken| shortened(broken, |fault| locate(fault, &root, text, overrides)))
}

/// More faults than this are counted and not shown: nobody reads them, and each takes time to place.
const MOST_FAULTS: usize = 200;

/// The first faults, each placed, and how many more there are.
fn shortened<T>(mut faults: Vec<T>, place: impl FnMut(T) -> Fault) -> Faults {
    let more = faults.len().saturating_sub(MOST_FAULTS);
    faults.truncate(MOST_FAULTS);
    let mut shown: Vec<Fault> = faults.into_iter().map(place).collect();
    if more > 0 {
        shown.push(Fault::new("", format!("and {more} more faults, which are not shown")));
    }
    Faults::new(shown)
}

fn read_tree(text: &str) -> Result<Node, Vec<(Place, Fault)>> {
    let (table, errors) = DeTable::parse_recoverable(text);
    if errors.is_empty() {
        return Ok(Node::from_table(&table));
    }
    let faults = errors.into_iter().map(|error| {
        let span = error.span().unwrap_or(0..0);
        let fault = Fault::new("", format!("not TOML: {}", error.message().trim().replace('\n', ", ")));
        let bare = text[..span.start.min(text.len())].rsplit('\n').next().unwrap_or("");
        let fault = if looks_like_quantity(bare, &text[span.start.min(text.len())..]) {
            fault.with_help("a quantity is a string: write it in quotes, such as \"40 um\"")
        } else {
            fault
        };
        (Place { source: 0, span }, fault)
    });
    Err(faults.collect())
}

/// Whether `key = 3 um` was written without quotes.
fn looks_like_quantity(before: &str, after: &str) -> bool {
    let line = format!("{before}{}", after.lines().next().unwrap_or(""));
    let Some((_, value)) = line.split_once('=') else { return false };
    let value = value.trim();
    value.starts_with(|c: char| c.is_ascii_digit() || c == '-') && value.contains(char::is_alphabetic)
}

fn put_in(place: Place, mut fault: Fault, text: &str, overrides: &[&str]) -> Fault {
    if place.source == 0 {
        let (line, column) = line_and_column(text, place.span.start);
        fault.line = Some(line);
        fault.column = Some(column);
        fault.span = Some(place.span);
    } else if let Some(setting) = overrides.get(place.source - 1) {
        fault.setting = Some((*setting).to_owned());
        fault.span = Some(place.span);
    }
    fault
}

fn locate(fault: Fault, root: &Node, text: &str, overrides: &[&str]) -> Fault {
    match root.locate(&fault.key) {
        Some(place) => put_in(place, fault, text, overrides),
        None => fault,
    }
}
