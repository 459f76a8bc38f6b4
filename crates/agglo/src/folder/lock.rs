//! One writer at a time.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

use super::{FolderError, Traces, files, names};
use crate::record::RecordError;

/// The right to write into a folder; it ends when this is dropped, or the process ends.
#[derive(Debug)]
pub struct Lock {
    path: PathBuf,
    file: File,
    /// Whether the file system tells files apart, so that a file that was taken away is known for it.
    tells_apart: bool,
    warning: Option<String>,
}

/// Processes that take their lock's file away just now are waited for so often.
const TRIES: u32 = 50;

impl Lock {
    /// Takes the lock of a folder that is there.
    ///
    /// Where the file system has no locks, [`Lock::warning`] says so, and nothing keeps others away.
    ///
    /// # Errors
    /// [`FolderError::Held`] where another process, or another place in this one, has it; [`FolderError::Record`]
    /// where its file cannot be opened.
    pub fn take(dir: &Path) -> Result<Self, FolderError> {
        let path = dir.join(names::LOCK);
        let mut tries = 0;
        loop {
            tries += 1;
            let mut options = OpenOptions::new();
            options.read(true).write(true).create(true).truncate(false);
            let file = files::open(&path, &mut options).map_err(RecordError::file("open", &path))?;
            match held(file.try_lock(), dir) {
                // Another process released it and took its file away between our two calls.
                Ok(_) if !is_at(&file, &path) && tries < TRIES => {}
                Ok(warning) => return Ok(Self::signed(path, file, tries < TRIES, warning)),
                Err(Taken) => {
                    return Err(FolderError::Held { dir: dir.to_owned(), by: holder(file) });
                }
            }
        }
    }

    /// Makes the folder and takes its lock; gives what was made, too.
    ///
    /// # Errors
    /// [`FolderError`].
    pub(super) fn take_new(dir: &Path) -> Result<(Traces, Self), FolderError> {
        const FOLDERS: u32 = 5;
        let mut made = Traces::make(dir)?;
        for _ in 1..FOLDERS {
            match Self::take(dir) {
                // A process that gave up took the folder away between our two calls.
                Err(FolderError::Record(_)) if !dir.exists() => made = Traces::make(dir)?,
                taken => return Ok((made, taken?)),
            }
        }
        Ok((made, Self::take(dir)?))
    }

    /// Puts who has it into the file, for those who are refused.
    fn signed(path: PathBuf, mut file: File, tells_apart: bool, warning: Option<String>) -> Self {
        let host = std::fs::read_to_string("/proc/sys/kernel/hostname").unwrap_or_default();
        let on = if host.trim().is_empty() { String::new() } else { format!(" on {}", host.trim()) };
        // The lock holds without these words.
        let _ = file.set_len(0).and_then(|()| write!(file, "process {}{on}", std::process::id()));
        Self { path, file, tells_apart, warning }
    }

    /// That the file system has no locks, where it has none.
    pub fn warning(&self) -> Option<&str> {
        self.warning.as_deref()
    }

    /// Whether its file is still where it was made.
    pub(super) fn is_there(&self) -> bool {
        if self.tells_apart { is_at(&self.file, &self.path) } else { self.path.exists() }
    }

    /// Takes the file away; the lock holds until this is dropped.
    pub(super) fn remove(&self) {
        // Somebody may have removed the whole folder and begun another one in its place.
        if self.is_there() {
            let _ = std::fs::remove_file(&self.path);
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        self.remove();
    }
}

/// Somebody else has the lock.
#[derive(Debug, PartialEq, Eq)]
struct Taken;

/// What an attempt to lock came to: a warning where there are no locks.
fn held(attempt: Result<(), TryLockError>, dir: &Path) -> Result<Option<String>, Taken> {
    match attempt {
        Ok(()) => Ok(None),
        Err(TryLockError::WouldBlock) => Err(Taken),
        Err(TryLockError::Error(error)) => Ok(Some(format!(
            "the file system of {} has no locks ({error}): nothing keeps a second agglo from writing there at the same \
             time",
            dir.display()
        ))),
    }
}

fn holder(file: File) -> String {
    let mut words = String::new();
    // Where locks keep readers away too, it stays unknown.
    let _ = file.take(200).read_to_string(&mut words);
    if words.is_empty() { "another process".to_owned() } else { words.escape_debug().to_string() }
}

/// Whether the open file is the one that has the name.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let place = |data: std::io::Result<std::fs::Metadata>| data.ok().map(|data| (data.dev(), data.ino()));
    place(file.metadata()) == place(path.symlink_metadata()) && file.metadata().is_ok()
}

/// An open file cannot be removed there.
#[cfg(not(unix))]
fn is_at(_: &File, path: &Path) -> bool {
    path.exists()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_second_is_refused_and_named_until_the_first_is_done() {
        let folder = tempfile::tempdir().unwrap();
        let first = Lock::take(folder.path()).unwrap();
        assert_eq!(first.warning(), None);
        let refused = Lock::take(folder.path()).unwrap_err();
        let text = refused.to_string();
        assert!(matches!(refused, FolderError::Held { .. }) && refused.exit_code() == 2, "{text}");
        assert!(text.contains(&format!("process {}", std::process::id())), "{text}");
        drop(first);
        assert_gone!(folder.path().join(names::LOCK));
        Lock::take(folder.path()).unwrap();
    }

    /// A lock whose file was removed with its folder does not take away that of the folder's successor.
    #[test]
    fn a_successor_keeps_its_lock() {
        let folder = tempfile::tempdir().unwrap();
        let dir = folder.path().join("run");
        std::fs::create_dir(&dir).unwrap();
        let first = Lock::take(&dir).unwrap();
        std::fs::remove_dir_all(&dir).unwrap();
        std::fs::create_dir(&dir).unwrap();
        let second = Lock::take(&dir).unwrap();
        drop(first);
        assert_there!(dir.join(names::LOCK));
        assert_err!(Lock::take(&dir));
        drop(second);
    }

    #[test]
    fn without_locks_there_is_a_warning_and_it_goes_on() {
        let dir = Path::new("out/run");
        let unsupported = TryLockError::Error(std::io::Error::from(std::io::ErrorKind::Unsupported));
        let warning = held(Err(unsupported), dir).unwrap().unwrap();
        assert!(warning.contains("out/run has no locks"), "{warning}");
        assert_eq!(held(Ok(()), dir), Ok(None));
        assert_eq!(held(Err(TryLockError::WouldBlock), dir), Err(Taken));
    }

    #[cfg(unix)]
    #[test]
    fn a_link_in_its_place_is_not_followed() {
        let folder = tempfile::tempdir().unwrap();
        let precious = folder.path().join("precious");
        std::fs::write(&precious, "kept").unwrap();
        std::os::unix::fs::symlink(&precious, folder.path().join(names::LOCK)).unwrap();
        let text = Lock::take(folder.path()).unwrap_err().to_string();
        assert!(text.contains(names::LOCK) && text.contains("symbolic link"), "{text}");
        assert_eq!(std::fs::read_to_string(&precious).unwrap(), "kept");
    }
}
