//! Another end for a run that was stopped or has finished.

use super::RunError;
use super::job::AnySaved;
use crate::folder::RunFolder;
use crate::record::RecordError;
use crate::scenario::Scenario;
use crate::units::Time;

/// Gives the run of a checkpoint another end. A summary goes first: without one the run counts as not finished, whatever
/// happens next.
///
/// # Errors
/// [`RunError::Until`] where the run is not before that end, [`RunError::Scenario`] where the scenario has faults with it.
pub fn change(folder: &RunFolder, saved: &mut AnySaved<'_>, until: Time) -> Result<(), RunError> {
    let dir = folder.root().to_owned();
    let time = saved.time();
    let (text, ends_before) = saved.end_mut();
    let bad = |faults: crate::scenario::Faults| RunError::BadCheckpoint {
        dir: dir.clone(),
        reason: faults.to_string(),
    };
    let mut scenario = Scenario::from_toml(text).map_err(bad)?;
    let summary = folder.summary();
    let end = scenario.time.end.si();
    // A run that has finished was at its end, wherever it goes on from.
    let reached = if summary.exists() { end } else { time };
    if until.si() <= reached {
        return Err(RunError::Until { dir, until: until.si(), reached });
    }
    scenario.time.end = until;
    scenario.check()?;
    *text = scenario.to_toml()?;
    ends_before.push(end);
    match std::fs::remove_file(&summary) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(RecordError::file("remove", &summary)(error).into())
        }
        _ => Ok(()),
    }
}
