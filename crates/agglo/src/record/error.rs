//! What can go wrong when files are written and read back.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use super::checkpoint::Refused;

/// Why something could not be recorded or read back.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// The operating system refused.
    #[error("cannot {action} {path}: {reason}", path = .path.display(), reason = reason(.source))]
    File {
        /// What was to be done, as a verb.
        action: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// What the operating system said.
        source: io::Error,
    },
    /// A row that does not fit the table, or columns that do not fit the points.
    #[error("cannot write {path}: {what} has {found} values where {expected} are due", path = .path.display())]
    Shape {
        /// The file.
        path: PathBuf,
        /// The row or column.
        what: String,
        /// How many values it has.
        found: usize,
        /// How many it should have.
        expected: usize,
    },
    /// A quantity of a row that is infinite, or not a number where one is due.
    #[error("cannot write {path}: {column} is not finite; the values of the scenario are too extreme", path = .path.display())]
    NotFinite {
        /// The table.
        path: PathBuf,
        /// The column.
        column: String,
    },
    /// A table that ends before the place where a checkpoint left it.
    #[error(
        "cannot go on with {path}: it has {found} bytes, but the checkpoint was written when it had {expected}; \
         it was cut or changed since",
        path = .path.display()
    )]
    Shorter {
        /// The table.
        path: PathBuf,
        /// Its length [bytes].
        found: u64,
        /// Its length at the checkpoint [bytes].
        expected: u64,
    },
    /// A file that is not what a run wrote.
    #[error("cannot go on with {path}: {reason}", path = .path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// A state or summary that cannot be turned into bytes that read back as the same.
    #[error("cannot write {path}: {reason}", path = .path.display())]
    Encode {
        /// The checkpoint or summary.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// A file that is not whole.
    #[error("cannot read {path}: {reason}", path = .path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// No whole checkpoint.
    #[error("no usable checkpoint in {dir}{}", list(.refused), dir = .dir.display())]
    NoCheckpoint {
        /// The folder.
        dir: PathBuf,
        /// The checkpoints that are there and why they cannot be used, newest first.
        refused: Vec<Refused>,
    },
}

impl RecordError {
    /// For `map_err`: an error of the operating system while doing `action` to `path`.
    pub fn file(action: &'static str, path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::File { action, path, source }
    }
}

/// The common cases in plain words, the others as the operating system says.
fn reason(source: &io::Error) -> String {
    match source.kind() {
        io::ErrorKind::StorageFull => "the disk is full".to_owned(),
        io::ErrorKind::QuotaExceeded => "the disk quota is used up".to_owned(),
        io::ErrorKind::PermissionDenied => "no permission to write or read there".to_owned(),
        io::ErrorKind::ReadOnlyFilesystem => "the file system is read-only".to_owned(),
        io::ErrorKind::NotFound => "no such file or folder".to_owned(),
        io::ErrorKind::NotADirectory => "a part of the path is a file, not a folder".to_owned(),
        io::ErrorKind::FileTooLarge => "it would be larger than the limit for files".to_owned(),
        _ => source.to_string(),
    }
}

fn list(refused: &[Refused]) -> impl fmt::Display {
    let lines: Vec<String> = refused.iter().map(|one| format!("\n  {one}")).collect();
    if lines.is_empty() { String::new() } else { format!(":{}", lines.concat()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn common_cases_in_plain_words() {
        let message = |kind: io::ErrorKind| {
            RecordError::file("write", Path::new("out/series.csv"))(io::Error::from(kind)).to_string()
        };
        assert_eq!(message(io::ErrorKind::StorageFull), "cannot write out/series.csv: the disk is full");
        assert_eq!(
            message(io::ErrorKind::PermissionDenied),
            "cannot write out/series.csv: no permission to write or read there"
        );
    }
}
