//! The one door by which files are read: regular files only, and none larger than its kind may be.
//!
//! A device gives bytes without end and a pipe nobody writes to gives none for ever; both have a name like any file.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Files that people write: scenarios, searches, studies; and summaries [bytes].
pub const MOST_OF_A_TEXT: u64 = 64 << 20;
/// Tables, journals and frames [bytes].
pub const MOST_OF_A_TABLE: u64 = 4 << 30;
/// Checkpoints [bytes].
pub const MOST_OF_A_STATE: u64 = 64 << 30;

/// Opens a regular file; a folder, device, pipe or socket is refused before it could make one wait.
///
/// # Errors
/// What the system says, or that it is no regular file.
pub fn open(path: &Path) -> io::Result<File> {
    regular(&std::fs::metadata(path)?)?;
    let file = File::open(path)?;
    regular(&file.metadata()?)?;
    Ok(file)
}

/// Refuses what is no regular file; a link only where it was not followed.
///
/// # Errors
/// What it is instead.
pub fn regular(found: &std::fs::Metadata) -> io::Result<()> {
    let what = match found.file_type() {
        kind if kind.is_file() => return Ok(()),
        kind if kind.is_symlink() => "it is a symbolic link, which is not followed",
        kind if kind.is_dir() => "it is a folder, and only regular files are read",
        _ => "it is a device, pipe or socket, and only regular files are read",
    };
    Err(io::Error::new(io::ErrorKind::InvalidInput, what))
}

/// All bytes of a regular file of at most `most` bytes.
///
/// # Errors
/// As [`open`], or that the file is too large.
pub fn read(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    read_all(open(path)?, most)
}

/// All bytes of a regular file that is open, of at most `most` bytes.
///
/// # Errors
/// What the system says, or that the file is too large.
pub fn read_all(file: File, most: u64) -> io::Result<Vec<u8>> {
    length(&file, most)?;
    take(file, most)
}

/// How many bytes an open file has: at most `most`.
///
/// # Errors
/// What the system says, or that it is too large.
pub fn length(file: &File, most: u64) -> io::Result<u64> {
    let length = file.metadata()?.len();
    if length > most { Err(too_large(most)) } else { Ok(length) }
}

/// The text of a regular file of at most `most` bytes.
///
/// # Errors
/// As [`read`], or that it is no text.
pub fn read_text(path: &Path, most: u64) -> io::Result<String> {
    text(read(path, most)?)
}

/// The text of what is read once and has no name, such as the standard input, of at most `most` bytes.
///
/// # Errors
/// What the system says, or that it is too large or no text.
pub fn read_stream(stream: impl Read, most: u64) -> io::Result<String> {
    text(take(stream, most)?)
}

/// The text of a small file of the system; nothing where it cannot be read.
pub fn read_small(path: &Path) -> Option<String> {
    text(take(open(path).ok()?, 1 << 20).ok()?).ok()
}

fn take(stream: impl Read, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    stream.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most { Err(too_large(most)) } else { Ok(bytes) }
}

fn too_large(most: u64) -> io::Error {
    io::Error::other(format!("it is larger than the {} MB that are read of such a file", most >> 20))
}

fn text(bytes: Vec<u8>) -> io::Result<String> {
    String::from_utf8(bytes).map_err(|_| io::Error::other("it is no text in UTF-8"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regular_files_within_their_limit_are_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.toml");
        std::fs::write(&path, "version = 1\n").unwrap();
        assert_eq!(read_text(&path, 12).unwrap(), "version = 1\n");
        assert_contains!(read(&path, 11).unwrap_err().to_string(), "larger than");
        std::fs::write(&path, b"\xff\xfe").unwrap();
        assert_contains!(read_text(&path, 12).unwrap_err().to_string(), "UTF-8");
        assert_eq!(read(&folder.path().join("b"), 9).unwrap_err().kind(), io::ErrorKind::NotFound);
    }

    /// A gap of a terabyte takes no place on the disk, and would take all memory.
    #[test]
    fn what_is_too_large_is_refused_before_it_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("hole");
        if File::create(&path).unwrap().set_len(1 << 40).is_ok() {
            assert_contains!(
                read(&path, MOST_OF_A_STATE).unwrap_err().to_string(),
                "larger than the 65536 MB"
            );
        }
    }

    #[test]
    fn what_has_no_end_is_cut() {
        let refused = read_stream(io::repeat(b'#'), 1000).unwrap_err().to_string();
        assert!(refused.contains("larger than"), "{refused}");
        assert_eq!(read_stream(&b"ab"[..], 2).unwrap(), "ab");
    }

    #[cfg(unix)]
    #[test]
    fn devices_pipes_and_folders_are_refused_at_once() {
        let folder = tempfile::tempdir().unwrap();
        let pipe = folder.path().join("pipe");
        let made = std::process::Command::new("mkfifo").arg(&pipe).status();
        let pipes = made.is_ok_and(|status| status.success()).then_some(pipe.as_path());
        for path in [Path::new("/dev/zero"), folder.path()].into_iter().chain(pipes) {
            let refused = read(path, 1000).unwrap_err().to_string();
            assert!(refused.contains("only regular files are read"), "{}: {refused}", path.display());
        }
    }
}
