//! The scenario that a campaign varies: read once, kept as a tree of numbers in SI units.

use std::path::{Path, PathBuf};

use serde_json::Value as Json;

use super::file::{Base, Campaign};
use crate::scenario::{Fault, Faults, Keys, LoadError, Scenario, nearest, scenario_templates};

/// A base scenario with its fixed settings.
#[derive(Debug)]
pub struct BaseScenario {
    /// The scenario.
    pub scenario: Scenario,
    /// The same as a tree; quantities are numbers in SI units.
    pub tree: Json,
    /// The folder that its tables are relative to.
    pub folder: PathBuf,
    /// All keys that a scenario can have.
    pub keys: Keys,
}

impl BaseScenario {
    /// Reads the base of a campaign whose file stands in `folder`.
    ///
    /// # Errors
    /// What is wrong with the base and the settings; the keys are paths in the campaign.
    pub fn load(campaign: &Campaign, folder: &Path) -> Result<Self, Vec<Fault>> {
        let (scenario, folder) = match &campaign.base {
            Base::File(file) => {
                let path = folder.join(file);
                let scenario = Scenario::load_with_overrides(&path, &campaign.settings)
                    .map_err(|error| faults_of(campaign, file, error))?;
                (scenario, path.parent().unwrap_or(folder).to_owned())
            }
            Base::Template(name) => (from_template(campaign, name)?, folder.to_owned()),
        };
        let mut tree = serde_json::to_value(&scenario)
            .map_err(|error| vec![Fault::new("base", format!("cannot be kept: {error}"))])?;
        let keys = Keys::new();
        keys.to_si(&mut tree);
        Ok(Self { scenario, tree, folder, keys })
    }
}

fn from_template(campaign: &Campaign, name: &str) -> Result<Scenario, Vec<Fault>> {
    let known: Vec<&str> = scenario_templates().map(|template| template.name).collect();
    let Some(template) = scenario_templates().find(|template| template.name == name) else {
        let message = format!("there is no scenario \"{name}\" among the templates: {}", known.join(", "));
        let fault = Fault::new("base.template", message);
        return Err(vec![match nearest(name, known) {
            Some(near) => fault.with_help(format!("did you mean \"{near}\"?")),
            None => fault,
        }]);
    };
    Scenario::with_overrides(template.text, &campaign.settings)
        .map_err(|faults| placed(campaign, "base.template", name, &faults))
}

fn faults_of(campaign: &Campaign, file: &str, error: LoadError) -> Vec<Fault> {
    match error {
        LoadError::Unreadable { cause, .. } => {
            vec![Fault::new("base.file", format!("cannot read \"{file}\": {cause}"))]
        }
        LoadError::Faulty { faults, .. } => placed(campaign, "base.file", file, &faults),
    }
}

/// Faults of a base under its own name; those of settings at the settings.
fn placed(campaign: &Campaign, key: &str, name: &str, faults: &Faults) -> Vec<Fault> {
    let place = |fault: &Fault| {
        let setting = fault.setting.as_ref().and_then(|text| {
            campaign.settings.iter().position(|setting| setting == text).map(|at| format!("settings.{at}"))
        });
        let (key, message) = match (setting, fault.line, fault.column) {
            (Some(setting), _, _) => (setting, fault.headline()),
            (None, Some(line), Some(column)) => {
                (key.to_owned(), format!("{name}, line {line}, column {column}: {}", fault.headline()))
            }
            (None, _, _) => (key.to_owned(), format!("{name}: {}", fault.headline())),
        };
        Fault { help: fault.help.clone(), ..Fault::new(key, message) }
    };
    faults.iter().map(place).collect()
}
