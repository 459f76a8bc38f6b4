//! From a text to a checked campaign, and back.

use std::path::Path;

use serde_json::Value as Json;

use super::{Campaign, check};
use crate::scenario::{Document, Fault, Faults, LoadError, load, read};

/// The JSON schema of a search or study.
pub fn campaign_schema() -> Json {
    schemars::schema_for!(Campaign).to_value()
}

impl Document for Campaign {
    type File = Self;

    fn schema() -> Json {
        campaign_schema()
    }

    fn checked(file: Self, base: Option<&Path>) -> Result<Self, Vec<Fault>> {
        let faults = check::faults(&file, base.unwrap_or(Path::new("")));
        if faults.is_empty() { Ok(file) } else { Err(faults) }
    }
}

impl Campaign {
    /// Reads and checks a search or study; files that it names are relative to the current folder.
    ///
    /// # Errors
    /// All faults of the first stage that has any: syntax; form; rules between keys, base included.
    pub fn from_toml(text: &str) -> Result<Self, Faults> {
        Self::with_overrides::<&str>(text, &[])
    }

    /// As [`Campaign::from_toml`], with settings `key.path=value` that replace values of the text.
    ///
    /// # Errors
    /// As [`Campaign::from_toml`]; the faults of settings come with their text.
    pub fn with_overrides<S: AsRef<str>>(text: &str, overrides: &[S]) -> Result<Self, Faults> {
        let overrides: Vec<&str> = overrides.iter().map(AsRef::as_ref).collect();
        read(text, &overrides, None)
    }

    /// Reads and checks a file; files that it names are relative to its folder.
    ///
    /// # Errors
    /// [`LoadError`] where the file cannot be read or has faults.
    pub fn load(path: &Path) -> Result<Self, LoadError> {
        Self::load_with_overrides::<&str>(path, &[])
    }

    /// As [`Campaign::load`], with settings as in [`Campaign::with_overrides`].
    ///
    /// # Errors
    /// [`LoadError`] where the file cannot be read, or it or a setting has faults.
    pub fn load_with_overrides<S: AsRef<str>>(path: &Path, overrides: &[S]) -> Result<Self, LoadError> {
        let overrides: Vec<&str> = overrides.iter().map(AsRef::as_ref).collect();
        load(path, &overrides)
    }

    /// As [`Campaign::with_overrides`], of a text that was read from somewhere; files that it names are relative to `base`.
    ///
    /// # Errors
    /// As [`Campaign::with_overrides`].
    pub fn from_source<S: AsRef<str>>(text: &str, base: &Path, overrides: &[S]) -> Result<Self, Faults> {
        let overrides: Vec<&str> = overrides.iter().map(AsRef::as_ref).collect();
        read(text, &overrides, Some(base))
    }

    /// The campaign as TOML with every default written out; reads back as the same campaign.
    ///
    /// # Errors
    /// A fault where a number does not fit into TOML.
    pub fn to_toml(&self) -> Result<String, Faults> {
        toml::to_string(self).map_err(|error| Faults::new(vec![Fault::new("", error.to_string())]))
    }

    /// Whether a text is meant as a search or a study, and not as a scenario: whether it has a base.
    pub fn is_meant_by(text: &str) -> bool {
        let is_key = |line: &str| {
            let line = line.trim_start();
            let rest = line.strip_prefix('[').unwrap_or(line).trim_start().strip_prefix("base");
            rest.is_some_and(|rest| rest.trim_start().starts_with([']', '.', '=']))
        };
        text.lines().any(is_key)
    }
}
