//! Why a folder cannot be used.

use std::path::PathBuf;

use thiserror::Error;

use crate::record::RecordError;

/// Why a folder cannot be used.
#[derive(Debug, Error)]
pub enum FolderError {
    /// Another process writes there.
    #[error(
        "another agglo ({by}) is at work in {}: wait until it has ended, or stop it with Ctrl-C; `agglo watch` and \
         `agglo report` look at it meanwhile",
        dir.display()
    )]
    Held {
        /// The folder.
        dir: PathBuf,
        /// The other process, in words.
        by: String,
    },
    /// It holds a run, search or study already.
    #[error(
        "{} holds a run, search or study already; go on with it by `agglo resume {}`, or choose another folder with -o",
        dir.display(), dir.display()
    )]
    InUse {
        /// The folder.
        dir: PathBuf,
    },
    /// It holds something.
    #[error("the folder {} is not empty\nhelp: {help}", dir.display())]
    NotEmpty {
        /// The folder.
        dir: PathBuf,
        /// What can be done, according to what is in it.
        help: String,
    },
    /// It is no folder.
    #[error("{} is a file; choose a folder with -o", dir.display())]
    NoFolder {
        /// The file.
        dir: PathBuf,
    },
    /// A link that leads nowhere.
    #[error(
        "{} is a symbolic link to {}, which is not there: make that folder, or remove the link",
        link.display(), to.display()
    )]
    DanglingLink {
        /// The link.
        link: PathBuf,
        /// Where it leads.
        to: PathBuf,
    },
    /// A part of a run's folder that is a link.
    #[error(
        "{} is a symbolic link: agglo writes into folders of its own alone; put the folder itself there",
        path.display()
    )]
    Link {
        /// The link.
        path: PathBuf,
    },
    /// There is no run to go on with.
    #[error("{} holds no run that can be resumed; {help}", dir.display())]
    NoRun {
        /// The folder.
        dir: PathBuf,
        /// What can be done, according to what is in it.
        help: String,
    },
    /// There is no campaign to go on with.
    #[error("{} holds no campaign that can be resumed: {reason}", dir.display())]
    NoCampaign {
        /// The folder.
        dir: PathBuf,
        /// Why.
        reason: String,
    },
    /// Something in it cannot be made, read or removed.
    #[error(transparent)]
    Record(#[from] RecordError),
}

impl FolderError {
    /// Exit code of the program: 2, but for trouble with the disk.
    pub fn exit_code(&self) -> u8 {
        if matches!(self, Self::Record(_)) { 1 } else { 2 }
    }
}
