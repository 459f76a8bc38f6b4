//! The folder of a campaign and the names of what is in it.

use std::path::{Path, PathBuf};

use super::CampaignError;
use crate::record::{RecordError, atomic};

/// The folder of a campaign.
#[derive(Clone, Debug)]
pub struct Folder {
    root: PathBuf,
}

impl Folder {
    /// Makes the folder and puts the resolved campaign and its base scenario there.
    ///
    /// # Errors
    /// [`CampaignError::FolderInUse`] where it holds a campaign or a run, [`CampaignError::Record`].
    pub fn create(dir: &Path, campaign: &str, scenario: &str) -> Result<Self, CampaignError> {
        let folder = Self { root: dir.to_owned() };
        let taken = [folder.campaign(), folder.scenario(), folder.summary(), folder.journal()];
        if taken.iter().any(|path| path.exists()) {
            return Err(CampaignError::FolderInUse { dir: dir.to_owned() });
        }
        std::fs::create_dir_all(dir).map_err(RecordError::file("make the folder", dir))?;
        atomic::write(&folder.scenario(), scenario.as_bytes())?;
        // The last one: a folder with it can be resumed.
        atomic::write(&folder.campaign(), campaign.as_bytes())?;
        Ok(folder)
    }

    /// Whether a folder holds a campaign.
    pub fn holds(dir: &Path) -> bool {
        Self { root: dir.to_owned() }.campaign().is_file()
    }

    /// A folder that should hold a campaign.
    ///
    /// # Errors
    /// [`CampaignError::NoCampaign`]; [`CampaignError::Record`] where what a killed campaign left cannot be removed.
    pub fn open(dir: &Path) -> Result<Self, CampaignError> {
        let folder = Self { root: dir.to_owned() };
        if !Self::holds(dir) {
            let reason = "there is no search.toml".to_owned();
            return Err(CampaignError::NoCampaign { dir: dir.to_owned(), reason });
        }
        atomic::remove_leftovers(dir)?;
        Ok(folder)
    }

    /// The folder itself.
    pub fn root(&self) -> &Path {
        &self.root
    }
    /// The campaign with every default written out.
    pub fn campaign(&self) -> PathBuf {
        self.root.join("search.toml")
    }
    /// The scenario that is varied.
    pub fn scenario(&self) -> PathBuf {
        self.root.join("scenario.toml")
    }
    /// What the campaign came to.
    pub fn summary(&self) -> PathBuf {
        self.root.join("summary.json")
    }
    /// Starts that ended, while the campaign goes on.
    pub fn journal(&self) -> PathBuf {
        self.root.join("starts.journal")
    }
    /// The run of the best candidate.
    pub fn best(&self) -> PathBuf {
        self.root.join("best")
    }
    /// Pictures.
    pub fn pictures(&self) -> PathBuf {
        self.root.join("pictures")
    }
}
