//! Folders of runs, searches and studies: the names of what is in them, who may write there, and how files are opened.
//!
//! Nothing else names a file in such a folder. Whoever writes there holds its [`Lock`], which the system releases when
//! the process ends, however it ends. Files are opened without following links, so that nothing outside the folder is
//! ever written; a [`Mark`] tells whether one is still what it was.

mod campaign;
mod error;
pub(crate) mod files;
mod lock;
mod mark;
pub mod names;
mod run;
mod tables;
mod traces;

pub use campaign::CampaignFolder;
pub use error::FolderError;
pub use lock::Lock;
pub use mark::{Mark, Marked, Marking};
pub use run::RunFolder;
pub use traces::Traces;

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// Whether a new run, search or study may begin in `dir`: it is not there yet, or an empty folder.
///
/// # Errors
/// [`FolderError`] where it is not empty, another process is at work in it, or it is no folder.
pub fn vacant(dir: &Path) -> Result<(), FolderError> {
    traces::no_dangling_link(dir)?;
    if dir.exists() && !dir.is_dir() {
        return Err(FolderError::NoFolder { dir: dir.to_owned() });
    }
    if holds_something(dir) {
        if dir.join(names::LOCK).exists() {
            drop(Lock::take(dir)?);
        }
        // Advice to resume what is no run would only lead to advice to run.
        let goes_on = dir.join(names::CHECKPOINTS).is_dir() || CampaignFolder::holds(dir);
        let resume = format!("`agglo resume {}` goes on with what is in it; ", dir.display());
        let help = format!("{}-o FOLDER writes elsewhere", if goes_on { &resume } else { "" });
        return Err(FolderError::NotEmpty { dir: dir.to_owned(), help });
    }
    Ok(())
}

/// Whether there is a folder with anything in it. A process that was killed leaves its lock's file, which does not count.
fn holds_something(dir: &Path) -> bool {
    let mut entries = std::fs::read_dir(dir).into_iter().flatten().flatten();
    entries.any(|entry| entry.file_name() != names::LOCK)
}

/// The tables that stand in the folder of a run, search or study: names without their ending, and places, in the order of the
/// names.
pub fn tables_in(dir: &Path) -> Vec<(String, PathBuf)> {
    let is_table = |path: &PathBuf| path.extension() == Some(OsStr::new("csv")) && path.is_file();
    let entries = [dir.to_owned(), dir.join(names::SERIES)].map(std::fs::read_dir).into_iter().flatten();
    let paths = entries.flatten().flatten().map(|entry| entry.path()).filter(is_table);
    let mut tables: Vec<(String, PathBuf)> =
        paths.filter_map(|path| Some((path.file_stem()?.to_str()?.to_owned(), path))).collect();
    tables.sort();
    tables
}
