//! Whether a checkpoint and the folder that it lies in belong together: scenario, tables and frames.

use std::ops::ControlFlow;

use serde_json::Value as Json;

use super::RunError;
use super::job::AnySaved;
use super::recorder::Reopened;
use crate::folder::names::SCENARIO;
use crate::folder::{RunFolder, files};
use crate::record::checkpoint::{self, Refused};
use crate::record::{RecordError, door};
use crate::scenario::Scenario;
use crate::text::cell;

/// Keys that a message names at the most.
const MOST_KEYS: usize = 6;

/// Told what is read, in words; may ask to stop.
pub type Reading<'a> = dyn FnMut(&str) -> ControlFlow<()> + 'a;

/// A checkpoint to go on from.
pub struct Found {
    /// The checkpoint.
    pub saved: AnySaved<'static>,
    /// The tables as it left them, not yet cut.
    pub tables: Reopened,
    /// Newer ones that cannot be used.
    pub refused: Vec<Refused>,
}

/// Reads the newest whole checkpoint that belongs to its folder; if wanted one from before the end of the run, where there
/// is such a one. Nothing is changed.
///
/// # Errors
/// [`RunError`] where there is none, or the folder's scenario is not what was run.
pub fn load(folder: &RunFolder, before_the_end: bool, reading: &mut Reading<'_>) -> Result<Found, RunError> {
    if !folder.has_checkpoint() {
        return Err(RunError::NoCheckpointYet { dir: folder.root().to_owned() });
    }
    let scenario = own_scenario(folder)?;
    let mut fit = Fit { folder, scenario, reading, edits: Vec::new(), others: 0, is_stopped: false };
    let dir = folder.checkpoints();
    let mut found = Err(RecordError::NoCheckpoint { dir: dir.clone(), refused: Vec::new() });
    if before_the_end {
        found = checkpoint::load_newest(&dir, |saved: AnySaved<'static>| {
            let is_over = saved.parts().1.own().is_over();
            let is_before = !is_over && saved.time() < fit.scenario.time.end.si();
            if is_before { fit.accept(saved) } else { Err(String::new()) }
        });
        // That it is not the newest is as it should be.
        if let Ok((.., refused)) = &mut found {
            refused.retain(|refused| !refused.reason.is_empty());
        }
    }
    if found.is_err() {
        (fit.edits, fit.others) = (Vec::new(), 0);
        found = checkpoint::load_newest(&dir, |saved| fit.accept(saved));
    }
    if fit.is_stopped {
        return Err(RunError::StoppedBefore("while the run's files were read; nothing was changed"));
    }
    match found {
        Ok(((saved, tables), _, refused)) => Ok(Found { saved, tables, refused }),
        Err(RecordError::NoCheckpoint { refused, .. }) if refused.is_empty() => {
            Err(RunError::NoCheckpointYet { dir: folder.root().to_owned() })
        }
        Err(RecordError::NoCheckpoint { .. }) if !fit.edits.is_empty() && fit.others == 0 => {
            Err(RunError::Edited { dir: folder.root().to_owned(), keys: listed(&fit.edits) })
        }
        Err(error) => Err(error.into()),
    }
}

/// The scenario in the folder.
fn own_scenario(folder: &RunFolder) -> Result<Scenario, RunError> {
    let path = folder.scenario();
    let refused = |reason: String| RunError::ScenarioLost { path: path.clone(), reason };
    let bytes = files::read(&path, door::MOST_OF_A_TEXT).map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound => refused("is missing".to_owned()),
        _ => refused(format!("cannot be read: {error}")),
    })?;
    let text = String::from_utf8(bytes).map_err(|_| refused("is damaged: it is not text".to_owned()))?;
    let scenario = Scenario::from_toml(&text)
        .map_err(|faults| refused(format!("is damaged, or was edited, and has faults:\n{faults}")))?;
    Ok(scenario.resolved())
}

/// Holds one checkpoint after another to the folder.
struct Fit<'a, 'r> {
    folder: &'a RunFolder,
    scenario: Scenario,
    reading: &'a mut Reading<'r>,
    /// Keys in which the newest checkpoint of another scenario differs.
    edits: Vec<String>,
    /// Checkpoints that were refused for another reason than their scenario.
    others: usize,
    is_stopped: bool,
}

impl Fit<'_, '_> {
    fn accept(&mut self, saved: AnySaved<'static>) -> Result<(AnySaved<'static>, Reopened), String> {
        let (text, recorder) = saved.parts();
        let keys = match Scenario::from_toml(text) {
            Ok(scenario) => differences(&self.with_its_end(scenario, saved.ends_before()), &self.scenario),
            Err(faults) => return self.other(format!("its scenario cannot be read: {faults}")),
        };
        if !keys.is_empty() {
            let reason = format!("it is of another run than {SCENARIO}: {}", listed(&keys));
            if self.edits.is_empty() {
                self.edits = keys;
            }
            return Err(reason);
        }
        let tables = match recorder.check_tables(&self.scenario, self.folder) {
            Ok(tables) => tables,
            Err(error) => return self.other(error.to_string()),
        };
        match recorder.check_frames(self.folder, &mut |words| self.read_on(words)) {
            Ok(()) => Ok((saved, tables)),
            Err(reason) => self.other(reason),
        }
    }

    /// The checkpoint's scenario with the end that the run had before, if the folder still has that: a run that got
    /// another end was killed before its scenario was written.
    fn with_its_end(&self, mut scenario: Scenario, ends_before: &[f64]) -> Scenario {
        let end = self.scenario.time.end;
        if ends_before.last() == Some(&end.si()) {
            scenario.time.end = end;
        }
        scenario
    }

    fn other<T>(&mut self, reason: String) -> Result<T, String> {
        self.others += 1;
        Err(reason)
    }

    fn read_on(&mut self, words: &str) -> ControlFlow<()> {
        self.is_stopped |= (self.reading)(words).is_break();
        if self.is_stopped { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// Keys in which two scenarios differ, with both values: `seed: 1, in scenario.toml 9`.
fn differences(checkpoint: &Scenario, file: &Scenario) -> Vec<String> {
    if checkpoint == file {
        return Vec::new();
    }
    let tree = |scenario: &Scenario| serde_json::to_value(scenario).unwrap_or_default();
    let mut found = Vec::new();
    compare(&tree(checkpoint), &tree(file), "", &mut found);
    found
}

fn compare(checkpoint: &Json, file: &Json, key: &str, found: &mut Vec<String>) {
    let below = |word: &str| if key.is_empty() { word.to_owned() } else { format!("{key}.{word}") };
    match (checkpoint, file) {
        (Json::Object(a), Json::Object(b)) => {
            for word in a.keys().chain(b.keys().filter(|word| !a.contains_key(*word))) {
                let value =
                    |table: &serde_json::Map<String, Json>| table.get(word).cloned().unwrap_or_default();
                compare(&value(a), &value(b), &below(word), found);
            }
        }
        (Json::Array(a), Json::Array(b)) if a.len() == b.len() => {
            for (number, (a, b)) in a.iter().zip(b).enumerate() {
                compare(a, b, &below(&number.to_string()), found);
            }
        }
        _ if checkpoint == file => {}
        _ => found.push(format!("{key}: {}, in {SCENARIO} {}", short(checkpoint), short(file))),
    }
}

/// A value as it stands in a message.
fn short(value: &Json) -> String {
    if value.is_null() { "not there".to_owned() } else { cell(&value.to_string()) }
}

fn listed(keys: &[String]) -> String {
    let shown = keys.iter().take(MOST_KEYS).cloned().collect::<Vec<_>>().join("; ");
    match keys.len().saturating_sub(MOST_KEYS) {
        0 => shown,
        more => format!("{shown}; and {more} more"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::template;

    #[test]
    fn keys_that_differ_are_named_with_both_values() {
        let of = |settings: &[&str]| {
            Scenario::with_overrides(template("acoustic-published").unwrap().text, settings).unwrap()
        };
        let (run, other) = (of(&[]), of(&["seed=9", "time.end=3 s", "acoustics.beams.0.rays=77"]));
        assert_empty!(differences(&run, &run.clone()));
        let found = differences(&run, &other);
        assert_eq!(found.len(), 3, "{found:?}");
        assert!(found.iter().any(|key| key == "seed: 1, in scenario.toml 9"), "{found:?}");
        assert!(found.iter().any(|key| key.starts_with("time.end: ")), "{found:?}");
        assert!(found.iter().any(|key| key.starts_with("acoustics.beams.0.rays: ")), "{found:?}");
        let many: Vec<String> = (0..9).map(|number| number.to_string()).collect();
        assert_eq!(listed(&many), "0; 1; 2; 3; 4; 5; and 3 more");
    }
}
