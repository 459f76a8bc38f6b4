//! The folder of a search or study.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::run::lost;
use super::tables::Tables;
use super::{FolderError, Lock, RunFolder, files, names};
use crate::record::{RecordError, atomic, door};

/// The folder of a search or study.
#[derive(Clone, Debug)]
pub struct CampaignFolder {
    root: PathBuf,
    /// Nobody but its holder writes.
    lock: Option<Arc<Lock>>,
}

impl CampaignFolder {
    /// Names alone, for those who read.
    pub fn at(dir: &Path) -> Self {
        Self { root: dir.to_owned(), lock: None }
    }

    /// Makes the folder and takes its lock; it must not hold a campaign or a run.
    ///
    /// # Errors
    /// [`FolderError`].
    pub fn create(dir: &Path) -> Result<Self, FolderError> {
        let (_, lock) = Lock::take_new(dir)?;
        let folder = Self { lock: Some(Arc::new(lock)), ..Self::at(dir) };
        let taken = [folder.campaign(), folder.scenario(), folder.summary(), folder.journal(), folder.part()];
        if taken.iter().any(|path| path.exists()) {
            return Err(FolderError::InUse { dir: dir.to_owned() });
        }
        Ok(folder)
    }

    /// Puts the resolved campaign and its base scenario there.
    ///
    /// # Errors
    /// [`FolderError::Record`].
    pub fn put(&self, campaign: &str, scenario: &str) -> Result<(), FolderError> {
        atomic::write(&self.scenario(), scenario.as_bytes())?;
        // The last one: a folder with it can be resumed.
        Ok(atomic::write(&self.campaign(), campaign.as_bytes())?)
    }

    /// Takes the tables of another campaign's folder as they are.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub(crate) fn take_tables_of(&self, other: &Self) -> Result<(), RecordError> {
        let [from, to] = [&other.root, &self.root].map(|root| root.join(names::TABLES));
        let Ok(entries) = std::fs::read_dir(&from) else { return Ok(()) };
        std::fs::create_dir_all(&to).map_err(RecordError::file("make the folder", &to))?;
        for path in entries.flatten().map(|entry| entry.path()) {
            let bytes =
                files::read(&path, door::MOST_OF_A_TABLE).map_err(RecordError::file("read", &path))?;
            atomic::write(&to.join(path.file_name().unwrap_or_default()), &bytes)?;
        }
        Ok(())
    }

    /// Begins to take tables of placements into the folder.
    pub(crate) fn tables(&self) -> Tables<'_> {
        Tables::of(&self.root)
    }

    /// Names and checksums of the tables in the folder, a line each; a campaign is another one with other tables.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn told_of_tables(&self) -> Result<String, RecordError> {
        let dir = self.root.join(names::TABLES);
        let Ok(entries) = std::fs::read_dir(&dir) else { return Ok(String::new()) };
        let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
        paths.sort();
        let line = |path: &PathBuf| {
            let bytes = files::read(path, door::MOST_OF_A_TABLE).map_err(RecordError::file("read", path))?;
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            Ok(format!("# {name} {:08x}\n", crc32fast::hash(&bytes)))
        };
        paths.iter().map(line).collect()
    }

    /// Whether the folder is still the one whose lock was taken, and has what a resumed campaign needs.
    pub fn can_go_on(&self) -> bool {
        self.hold_on().is_ok() && Self::holds(&self.root)
    }

    /// Refuses to write into a folder that was removed or taken over by another process.
    ///
    /// # Errors
    /// [`RecordError::Foreign`].
    pub fn hold_on(&self) -> Result<(), RecordError> {
        if self.lock.as_ref().is_none_or(|lock| lock.is_there()) { Ok(()) } else { Err(lost(&self.root)) }
    }

    /// Whether a folder holds a campaign.
    pub fn holds(dir: &Path) -> bool {
        Self::at(dir).campaign().is_file()
    }

    /// A folder that should hold a campaign, to be gone on with: takes its lock.
    ///
    /// # Errors
    /// [`FolderError`].
    pub fn take(dir: &Path) -> Result<Self, FolderError> {
        if !Self::holds(dir) {
            let reason = format!("there is no {}", names::CAMPAIGN);
            return Err(FolderError::NoCampaign { dir: dir.to_owned(), reason });
        }
        let folder = Self { lock: Some(Arc::new(Lock::take(dir)?)), ..Self::at(dir) };
        for path in [folder.best(), folder.pictures()] {
            if path.is_symlink() {
                return Err(FolderError::Link { path });
            }
        }
        atomic::remove_leftovers(dir)?;
        Ok(folder)
    }

    /// That others are not kept away, where the file system has no locks.
    pub fn warning(&self) -> Option<&str> {
        self.lock.as_ref()?.warning()
    }

    /// The folder itself.
    pub fn root(&self) -> &Path {
        &self.root
    }
    /// The campaign with every default written out.
    pub fn campaign(&self) -> PathBuf {
        self.root.join(names::CAMPAIGN)
    }
    /// The scenario that is varied.
    pub fn scenario(&self) -> PathBuf {
        self.root.join(names::SCENARIO)
    }
    /// What the campaign came to.
    pub fn summary(&self) -> PathBuf {
        self.root.join(names::SUMMARY)
    }
    /// Starts that ended, while the campaign goes on.
    pub fn journal(&self) -> PathBuf {
        self.root.join(names::JOURNAL)
    }
    /// Which part of a study it holds, where it holds one.
    pub fn part(&self) -> PathBuf {
        self.root.join(names::PART)
    }
    /// The run of the best candidate.
    pub fn best(&self) -> PathBuf {
        self.root.join(names::BEST_RUN)
    }
    /// The folder of the best candidate's run, by its names.
    pub fn best_run(&self) -> RunFolder {
        RunFolder::at(&self.best())
    }
    /// Pictures.
    pub fn pictures(&self) -> PathBuf {
        self.root.join(names::PICTURES)
    }
}
