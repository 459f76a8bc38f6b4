//! Folders that were made for something that then did not begin.

use std::path::{Path, PathBuf};

use super::{FolderError, names};
use crate::record::RecordError;

/// The folders that were made, the outermost first.
#[derive(Clone, Debug, Default)]
pub struct Traces(Vec<PathBuf>);

impl Traces {
    /// The folders that are not there yet, of `dir` itself and those above it.
    pub fn before(dir: &Path) -> Self {
        let missing = dir.ancestors().filter(|part| !part.as_os_str().is_empty());
        let mut missing: Vec<PathBuf> =
            missing.take_while(|part| part.symlink_metadata().is_err()).map(Path::to_owned).collect();
        missing.reverse();
        Self(missing)
    }

    /// Makes the folder and those above it.
    ///
    /// # Errors
    /// [`FolderError`].
    pub(super) fn make(dir: &Path) -> Result<Self, FolderError> {
        no_dangling_link(dir)?;
        let made = Self::before(dir);
        std::fs::create_dir_all(dir).map_err(RecordError::file("make the folder", dir))?;
        Ok(made)
    }

    /// Takes away the folders that were made, as far as they hold nothing.
    pub(super) fn clear(&self) {
        for part in self.0.iter().rev() {
            let _ = std::fs::remove_dir(part);
        }
    }

    /// Takes away what a process that ends at once leaves of `dir`, in which it was at work, where it wrote nothing.
    pub fn clear_at_exit(&self, dir: &Path) {
        clear_parts(dir);
        let is_other = |entry: std::fs::DirEntry| entry.file_name() != names::LOCK;
        let holds_nothing =
            std::fs::read_dir(dir).is_ok_and(|mut entries| !entries.any(|entry| entry.is_ok_and(is_other)));
        if holds_nothing {
            let _ = std::fs::remove_file(dir.join(names::LOCK));
            self.clear();
        }
    }
}

/// Takes away the parts of a run's folder that hold nothing.
pub(super) fn clear_parts(dir: &Path) {
    for part in [names::CHECKPOINTS, names::FRAMES, names::SERIES] {
        let _ = std::fs::remove_dir(dir.join(part));
    }
}

/// Refuses a path of which a part is a link that leads nowhere.
///
/// # Errors
/// [`FolderError::DanglingLink`].
pub(super) fn no_dangling_link(dir: &Path) -> Result<(), FolderError> {
    for part in dir.ancestors() {
        if part.is_symlink() && !part.exists() {
            let to = std::fs::read_link(part).unwrap_or_default();
            return Err(FolderError::DanglingLink { link: part.to_owned(), to });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_made_goes_and_what_was_there_or_holds_something_stays() {
        let folder = tempfile::tempdir().unwrap();
        let dir = folder.path().join("out/a/run");
        let traces = Traces::make(&dir).unwrap();
        std::fs::create_dir(dir.join(names::SERIES)).unwrap();
        std::fs::write(dir.join(names::LOCK), "").unwrap();
        traces.clear_at_exit(&dir);
        assert_there!(folder.path());
        assert_gone!(folder.path().join("out"));
        let traces = Traces::make(&dir).unwrap();
        std::fs::write(folder.path().join("out/notes"), "").unwrap();
        traces.clear_at_exit(&dir);
        assert_there!(folder.path().join("out/notes"));
        assert_gone!(folder.path().join("out/a"));
        Traces::make(&dir).unwrap();
        Traces::make(&dir).unwrap().clear_at_exit(&dir);
        assert!(dir.is_dir(), "it was there before");
    }

    #[cfg(unix)]
    #[test]
    fn a_link_that_leads_nowhere_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let link = folder.path().join("out");
        std::os::unix::fs::symlink("nowhere", &link).unwrap();
        for dir in [link.clone(), link.join("run")] {
            let text = Traces::make(&dir).unwrap_err().to_string();
            assert!(text.contains("out is a symbolic link to nowhere"), "{text}");
        }
    }
}
