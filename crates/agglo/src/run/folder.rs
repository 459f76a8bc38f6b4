//! The folder of a run and the names of what is in it.

use std::path::{Path, PathBuf};

use crate::record::{RecordError, atomic};

use super::RunError;

/// The folder of a run.
#[derive(Clone, Debug)]
pub struct Folder {
    root: PathBuf,
    /// Whether it was made for this run.
    is_new: bool,
}

impl Folder {
    /// Makes the folder; it must not hold a run.
    ///
    /// # Errors
    /// [`RunError::FolderInUse`], or [`RunError::Record`] where it cannot be made.
    pub fn create(dir: &Path) -> Result<Self, RunError> {
        let folder = Self { root: dir.to_owned(), is_new: !dir.exists() };
        if folder.checkpoints().exists() || folder.summary().exists() || folder.scenario().exists() {
            return Err(RunError::FolderInUse { dir: dir.to_owned() });
        }
        for part in folder.parts() {
            std::fs::create_dir_all(&part).map_err(RecordError::file("make the folder", &part))?;
        }
        Ok(folder)
    }

    fn parts(&self) -> [PathBuf; 4] {
        [self.root.clone(), self.checkpoints(), self.frames(), self.series()]
    }

    /// Takes the folder away again where nothing was written into it.
    pub fn abandon(&self) {
        for part in self.parts().iter().skip(usize::from(!self.is_new)).rev() {
            // A folder that holds something stays, as it should.
            let _ = std::fs::remove_dir(part);
        }
    }

    /// Removes half-written files that a killed run left.
    ///
    /// # Errors
    /// [`RunError::Record`] where one cannot be removed.
    pub fn sweep(&self) -> Result<(), RunError> {
        for part in self.parts() {
            atomic::remove_leftovers(&part)?;
        }
        Ok(())
    }

    /// A folder that should hold a run.
    ///
    /// # Errors
    /// [`RunError::NoRun`] where it has no checkpoints.
    pub fn open(dir: &Path) -> Result<Self, RunError> {
        let folder = Self { root: dir.to_owned(), is_new: false };
        if folder.checkpoints().is_dir() { Ok(folder) } else { Err(RunError::NoRun { dir: dir.to_owned() }) }
    }

    /// The folder itself.
    pub fn root(&self) -> &Path {
        &self.root
    }
    /// The scenario with every default written out.
    pub fn scenario(&self) -> PathBuf {
        self.root.join("scenario.toml")
    }
    /// The summary.
    pub fn summary(&self) -> PathBuf {
        self.root.join("summary.json")
    }
    /// Tables over time.
    pub fn series(&self) -> PathBuf {
        self.root.join("series")
    }
    /// Frames for ParaView.
    pub fn frames(&self) -> PathBuf {
        self.root.join("frames")
    }
    /// Checkpoints.
    pub fn checkpoints(&self) -> PathBuf {
        self.root.join("checkpoints")
    }
}
