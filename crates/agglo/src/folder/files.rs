//! Files are opened where they are: links are not followed, and only regular files are opened at all.

use std::fs::{File, OpenOptions};
use std::io;
use std::path::Path;

use crate::record::door;

/// Opens a regular file as `options` say.
///
/// # Errors
/// As [`OpenOptions::open`]; also where a link, a pipe or a device has the name.
pub fn open(path: &Path, options: &mut OpenOptions) -> io::Result<File> {
    if let Ok(data) = path.symlink_metadata() {
        // Looked at before it is opened: opening a pipe waits for its other end.
        door::regular(&data)?;
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::OpenOptionsExt;
        // For a link that came between.
        options.custom_flags(rustix::fs::OFlags::NOFOLLOW.bits().cast_signed());
    }
    let file = options.open(path)?;
    door::regular(&file.metadata()?)?;
    Ok(file)
}

/// Makes a file; one that has the name is unlinked and not overwritten, so that another name of it keeps what it has.
///
/// # Errors
/// As [`open`].
pub fn create(path: &Path) -> io::Result<File> {
    if let Ok(data) = path.symlink_metadata() {
        door::regular(&data)?;
        std::fs::remove_file(path)?;
    }
    OpenOptions::new().read(true).write(true).create_new(true).open(path)
}

/// Reads a regular file of the folder, of at most `most` bytes.
///
/// # Errors
/// As [`open`], or that the file is too large.
pub fn read(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    door::read_all(open(path, OpenOptions::new().read(true))?, most)
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::os::unix::fs::symlink;

    #[test]
    fn links_and_devices_are_refused_and_what_they_lead_to_is_kept() {
        let folder = tempfile::tempdir().unwrap();
        let [precious, link] = ["precious", "table.csv"].map(|name| folder.path().join(name));
        std::fs::write(&precious, "kept").unwrap();
        symlink(&precious, &link).unwrap();
        let mut options = OpenOptions::new();
        options.read(true).write(true).create(true).truncate(true);
        for refused in [open(&link, &mut options), create(&link)] {
            let error = refused.unwrap_err();
            assert_eq!(error.to_string(), "it is a symbolic link, which is not followed");
        }
        assert_err!(open(Path::new("/dev/null"), OpenOptions::new().write(true)));
        assert_contains!(create(folder.path()).unwrap_err().to_string(), "folder");
        assert_eq!(read(&precious, 4).unwrap(), b"kept");
        assert_contains!(read(&precious, 3).unwrap_err().to_string(), "larger than");
    }

    #[test]
    fn another_name_of_a_file_keeps_its_content() {
        let folder = tempfile::tempdir().unwrap();
        let [precious, table] = ["precious", "table.csv"].map(|name| folder.path().join(name));
        std::fs::write(&precious, "kept").unwrap();
        std::fs::hard_link(&precious, &table).unwrap();
        create(&table).unwrap();
        assert_eq!(read(&precious, 4).unwrap(), b"kept");
        assert_eq!(read(&table, 4).unwrap(), b"");
    }
}
