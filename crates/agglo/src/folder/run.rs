//! The folder of a run.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::tables::Tables;
use super::{FolderError, Lock, Traces, names, traces};
use crate::record::{RecordError, atomic, checkpoint};
use crate::scenario::Scenario;

/// The folder of a run.
#[derive(Clone, Debug)]
pub struct RunFolder {
    root: PathBuf,
    /// What was made for this run.
    made: Traces,
    /// Nobody but its holder writes.
    lock: Option<Arc<Lock>>,
}

impl RunFolder {
    /// Names alone, for those who read.
    pub fn at(dir: &Path) -> Self {
        Self { root: dir.to_owned(), made: Traces::default(), lock: None }
    }

    /// Makes the folder and takes its lock; it must not hold a run.
    ///
    /// # Errors
    /// [`FolderError`].
    pub fn create(dir: &Path) -> Result<Self, FolderError> {
        let (made, lock) = Lock::take_new(dir)?;
        let folder = Self { made, lock: Some(Arc::new(lock)), ..Self::at(dir) };
        if folder.checkpoints().exists() || folder.summary().exists() || folder.scenario().exists() {
            return Err(FolderError::InUse { dir: dir.to_owned() });
        }
        folder.complete().inspect_err(|_| folder.abandon())?;
        folder.refuse_links()?;
        Ok(folder)
    }

    fn parts(&self) -> [PathBuf; 4] {
        [self.root.clone(), self.checkpoints(), self.frames(), self.series()]
    }

    fn refuse_links(&self) -> Result<(), FolderError> {
        match self.parts().into_iter().skip(1).find(|part| part.is_symlink()) {
            Some(path) => Err(FolderError::Link { path }),
            None => Ok(()),
        }
    }

    /// Takes the folder away again where nothing was written into it.
    pub fn abandon(&self) {
        // As long as the lock holds: what another process makes afterwards is its own.
        traces::clear_parts(&self.root);
        if let Some(lock) = &self.lock {
            lock.remove();
        }
        self.made.clear();
    }

    /// That others are not kept away, where the file system has no locks.
    pub fn warning(&self) -> Option<&str> {
        self.lock.as_ref()?.warning()
    }

    /// Whether the folder is still the one whose lock was taken, and was not removed or taken over by another process.
    pub fn is_ours(&self) -> bool {
        self.lock.as_ref().is_none_or(|lock| lock.is_there())
    }

    /// Refuses to write into a folder that is no longer [its own](Self::is_ours).
    ///
    /// # Errors
    /// [`RecordError::Foreign`].
    pub fn hold_on(&self) -> Result<(), RecordError> {
        if self.is_ours() { Ok(()) } else { Err(lost(&self.root)) }
    }

    /// Whether it has a checkpoint, whole or not.
    pub fn has_checkpoint(&self) -> bool {
        std::fs::read_dir(self.checkpoints()).is_ok_and(|mut entries| entries.next().is_some())
    }

    /// Removes half-written files that a killed run left.
    ///
    /// # Errors
    /// [`FolderError::Record`] where one cannot be removed.
    pub fn sweep(&self) -> Result<(), FolderError> {
        for part in self.parts() {
            atomic::remove_leftovers(&part)?;
        }
        Ok(())
    }

    /// A folder that should hold a run, to be read.
    ///
    /// # Errors
    /// [`FolderError::NoRun`] where it has no checkpoints.
    pub fn open(dir: &Path) -> Result<Self, FolderError> {
        let folder = Self::at(dir);
        if folder.checkpoints().is_dir() {
            Ok(folder)
        } else {
            let help = if super::holds_something(dir) {
                "there is no folder checkpoints/ in it, which every run has".to_owned()
            } else {
                format!("start one with `agglo run SCENARIO -o {}`", dir.display())
            };
            Err(FolderError::NoRun { dir: dir.to_owned(), help })
        }
    }

    /// The newest checkpoint, whole or not, where a path names a run's folder; else the path itself, which names one.
    pub fn newest_state(path: &Path) -> PathBuf {
        let all = checkpoint::newest_first(&Self::at(path).checkpoints()).unwrap_or_default();
        all.into_iter().next().unwrap_or_else(|| path.to_owned())
    }

    /// A folder that should hold a run, to be gone on with: takes its lock.
    ///
    /// # Errors
    /// [`FolderError`].
    pub fn take(dir: &Path) -> Result<Self, FolderError> {
        let mut folder = Self::open(dir)?;
        folder.refuse_links()?;
        folder.lock = Some(Arc::new(Lock::take(dir)?));
        Ok(folder)
    }

    /// Makes what a run writes into, where it is gone.
    ///
    /// # Errors
    /// [`FolderError::Record`].
    pub fn complete(&self) -> Result<(), FolderError> {
        for part in self.parts() {
            std::fs::create_dir_all(&part).map_err(RecordError::file("make the folder", &part))?;
        }
        Ok(())
    }

    /// Copies the tables of placements into the folder; gives the scenario that names them there.
    ///
    /// # Errors
    /// [`FolderError::Record`].
    pub fn with_tables(&self, scenario: &Scenario, base: &Path) -> Result<Scenario, FolderError> {
        Tables::of(&self.root).adopt_all(scenario, base)
    }

    /// The folder itself.
    pub fn root(&self) -> &Path {
        &self.root
    }
    /// The scenario with every default written out.
    pub fn scenario(&self) -> PathBuf {
        self.root.join(names::SCENARIO)
    }
    /// The summary.
    pub fn summary(&self) -> PathBuf {
        self.root.join(names::SUMMARY)
    }
    /// Tables over time.
    pub fn series(&self) -> PathBuf {
        self.root.join(names::SERIES)
    }
    /// Frames for ParaView.
    pub fn frames(&self) -> PathBuf {
        self.root.join(names::FRAMES)
    }
    /// The list of frames of a kind: grains, bonds, rays.
    pub fn frame_list(&self, kind: &str) -> PathBuf {
        self.frames().join(names::frame_list(kind))
    }
    /// Checkpoints.
    pub fn checkpoints(&self) -> PathBuf {
        self.root.join(names::CHECKPOINTS)
    }
}

/// A folder that was taken away from the process that writes into it.
pub(super) fn lost(root: &Path) -> RecordError {
    let reason = "it is another folder now, or its lock was removed".to_owned();
    RecordError::Foreign { path: root.to_owned(), reason }
}
