//! Files that are there wholly or not at all.
//!
//! A file is written beside its final place under a temporary name and then renamed, so that a reader, or a run that
//! is killed, never meets half of it.

use std::fs::File;
#[cfg(unix)]
use std::fs::OpenOptions;
use std::io::{BufWriter, Write};
#[cfg(unix)]
use std::io::{Seek, SeekFrom};
use std::path::Path;

use tempfile::{NamedTempFile, TempPath};

use super::RecordError;
#[cfg(unix)]
use crate::folder::files;
use crate::folder::{Mark, Marked};

/// Temporary files begin with this and end with [`SUFFIX`].
const PREFIX: &str = ".agglo-";
const SUFFIX: &str = ".part";

/// Whether the file outlives a loss of power (slow) or only the end of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Durability {
    /// Handed to the operating system.
    Process,
    /// On the disk, with its name.
    Power,
}

/// Puts `contents` into the file `path`, in place of what was there, and onto the disk.
///
/// # Errors
/// [`RecordError::File`]; the old file is then still there.
pub fn write(path: &Path, contents: &[u8]) -> Result<(), RecordError> {
    write_with(path, Durability::Power, |file| file.write_all(contents)).map(drop)
}

/// A file that is to be written on. Where it has other names, as copies by links have, it is copied first: what has those
/// names stays as it is.
///
/// # Errors
/// [`RecordError::File`].
#[cfg(unix)]
pub fn alone(path: &Path, mut file: File) -> Result<File, RecordError> {
    use std::os::unix::fs::MetadataExt;
    let names = file.metadata().map_err(RecordError::file("read", path))?.nlink();
    if names < 2 {
        return Ok(file);
    }
    file.seek(SeekFrom::Start(0)).map_err(RecordError::file("read", path))?;
    write_with(path, Durability::Power, |copy| std::io::copy(&mut file, copy).map(drop))?;
    let mut options = OpenOptions::new();
    files::open(path, options.read(true).write(true)).map_err(RecordError::file("reopen", path))
}

/// Other systems do not tell.
///
/// # Errors
/// None.
#[cfg(not(unix))]
pub fn alone(_: &Path, file: File) -> Result<File, RecordError> {
    Ok(file)
}

/// As [`write()`], with the contents written by `fill`; gives their mark.
pub(super) fn write_with(
    path: &Path,
    durability: Durability,
    fill: impl FnOnce(&mut BufWriter<Marked<&mut File>>) -> std::io::Result<()>,
) -> Result<Mark, RecordError> {
    let folder = folder_of(path);
    let mut temporary = new_temporary(folder).map_err(RecordError::file("write", path))?;
    let fill_file = || {
        let mut buffered = BufWriter::with_capacity(1 << 16, Marked::over(temporary.as_file_mut()));
        fill(&mut buffered)?;
        buffered.flush()?;
        let mark = buffered.get_ref().mark();
        drop(buffered);
        if durability == Durability::Power {
            temporary.as_file().sync_all()?;
        }
        Ok(mark)
    };
    let mark = fill_file().map_err(RecordError::file("write", path))?;
    temporary.persist(path).map_err(|error| RecordError::file("write", path)(error.error))?;
    if durability == Durability::Power {
        sync_folder(folder)?;
    }
    Ok(mark)
}

/// A temporary file beside `path` for another program to write, which then can take its place; it goes when dropped.
///
/// # Errors
/// [`RecordError::File`].
pub fn beside(path: &Path) -> Result<TempPath, RecordError> {
    Ok(new_temporary(folder_of(path)).map_err(RecordError::file("write", path))?.into_temp_path())
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

fn new_temporary(folder: &Path) -> std::io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).suffix(SUFFIX);
    // Temporary files are private by default; results are for everyone whom the user's umask allows.
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o644));
    }
    builder.tempfile_in(folder)
}

/// A rename is on the disk once the folder is.
#[cfg(unix)]
fn sync_folder(folder: &Path) -> Result<(), RecordError> {
    File::open(folder).and_then(|opened| opened.sync_all()).map_err(RecordError::file("write to", folder))
}

#[cfg(not(unix))]
fn sync_folder(_: &Path) -> Result<(), RecordError> {
    Ok(())
}

/// Removes temporary files that a killed run left in `folder`.
///
/// # Errors
/// [`RecordError::File`] where the folder cannot be read or a file not be removed.
pub fn remove_leftovers(folder: &Path) -> Result<(), RecordError> {
    let entries = std::fs::read_dir(folder).map_err(RecordError::file("read", folder))?;
    for entry in entries {
        let path = entry.map_err(RecordError::file("read", folder))?.path();
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        if name.starts_with(PREFIX) && name.ends_with(SUFFIX) {
            std::fs::remove_file(&path).map_err(RecordError::file("remove", &path))?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replaces_the_old_file_and_leaves_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("summary.json");
        write(&path, b"old").unwrap();
        write(&path, b"{}").unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"{}");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            assert_eq!(path.metadata().unwrap().permissions().mode() & 0o777 & !0o644, 0);
            assert_eq!(path.metadata().unwrap().permissions().mode() & 0o600, 0o600);
        }
    }

    #[test]
    fn a_failed_write_keeps_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("summary.json");
        write(&path, b"old").unwrap();
        let error = write_with(&path, Durability::Power, |file| {
            file.write_all(b"half")?;
            Err(std::io::ErrorKind::StorageFull.into())
        });
        assert_ends!(error.unwrap_err().to_string(), "summary.json: the disk is full");
        assert_eq!(std::fs::read(&path).unwrap(), b"old");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_missing_folder_is_named() {
        let message = write(Path::new("/nowhere/summary.json"), b"").unwrap_err().to_string();
        assert_eq!(message, "cannot write /nowhere/summary.json: no such file or folder");
    }

    #[test]
    fn leftovers_go_and_other_files_stay() {
        let folder = tempfile::tempdir().unwrap();
        for name in [".agglo-a1b2.part", "grains.part", ".agglo-notes"] {
            std::fs::write(folder.path().join(name), "").unwrap();
        }
        remove_leftovers(folder.path()).unwrap();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
    }
}
