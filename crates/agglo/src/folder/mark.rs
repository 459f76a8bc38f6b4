//! Lengths and checksums that tell whether a file is still what it was.

use std::fs::OpenOptions;
use std::io::{self, Read, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::files;

/// Bytes that are read at a time.
const CHUNK: usize = 1 << 20;

/// Length and checksum of a file, or of its beginning.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Mark {
    /// Length [bytes].
    pub bytes: u64,
    /// CRC-32 of these.
    pub checksum: u32,
}

impl Mark {
    /// Whether the file at `path` is this, from its first byte to its last; else why not.
    ///
    /// # Errors
    /// What it is instead, as the end of a sentence that begins with its name.
    pub fn check(&self, path: &Path) -> Result<(), String> {
        let unreadable = |error: io::Error| match error.kind() {
            io::ErrorKind::NotFound => "is missing".to_owned(),
            _ => format!("cannot be read: {error}"),
        };
        let file = files::open(path, OpenOptions::new().read(true)).map_err(unreadable)?;
        let found = file.metadata().map_err(unreadable)?.len();
        if found != self.bytes {
            return Err(format!("has {found} bytes where the run wrote {}", self.bytes));
        }
        let marking = Marking::of(&file, self.bytes).map_err(unreadable)?;
        if marking.mark() == *self { Ok(()) } else { Err("is not what the run wrote there".to_owned()) }
    }
}

/// A mark that grows with its file.
#[derive(Clone, Debug, Default)]
pub struct Marking {
    hasher: crc32fast::Hasher,
    bytes: u64,
}

impl Marking {
    /// Of the next `bytes` of a file, or of all where it has fewer.
    ///
    /// # Errors
    /// Where the file cannot be read.
    pub fn of(file: impl Read, bytes: u64) -> io::Result<Self> {
        let mut marking = Self::default();
        let mut rest = file.take(bytes);
        let mut chunk = vec![0; CHUNK.min(bytes as usize)];
        loop {
            match rest.read(&mut chunk)? {
                0 => return Ok(marking),
                read => marking.add(&chunk[..read]),
            }
        }
    }

    /// Takes further bytes in.
    pub fn add(&mut self, bytes: &[u8]) {
        self.hasher.update(bytes);
        self.bytes += bytes.len() as u64;
    }

    /// The mark so far.
    pub fn mark(&self) -> Mark {
        Mark { bytes: self.bytes, checksum: self.hasher.clone().finalize() }
    }
}

/// A writer that marks what goes through it.
#[derive(Debug)]
pub struct Marked<W> {
    inner: W,
    marking: Marking,
}

impl<W> Marked<W> {
    /// Over another writer.
    pub fn over(inner: W) -> Self {
        Self { inner, marking: Marking::default() }
    }

    /// Over a writer that goes on after what was marked.
    pub fn after(inner: W, marking: Marking) -> Self {
        Self { inner, marking }
    }

    /// What is written into.
    pub fn inner(&self) -> &W {
        &self.inner
    }

    /// What was written into.
    pub fn into_inner(self) -> W {
        self.inner
    }

    /// The mark of what went through.
    pub fn mark(&self) -> Mark {
        self.marking.mark()
    }
}

impl<W: Write> Write for Marked<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.inner.write(bytes)?;
        self.marking.add(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

#[cfg(test)]
mod tests {
    use std::fs::File;

    use super::*;

    #[test]
    fn a_mark_goes_on_where_it_was_and_finds_every_change() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("table.csv");
        let content: Vec<u8> = (0..3 * CHUNK / 2).map(|k| (k % 251) as u8).collect();
        let mut through = Marked::over(Vec::new());
        through.write_all(&content).unwrap();
        std::fs::write(&path, &content).unwrap();
        let mark = through.mark();
        assert_eq!((mark.bytes, mark.check(&path)), (content.len() as u64, Ok(())));
        let cut = content.len() as u64 / 3;
        let mut begun = Marking::of(&File::open(&path).unwrap(), cut).unwrap();
        begun.add(&content[cut as usize..]);
        assert_eq!(begun.mark(), mark);
        for at in [0, CHUNK, content.len() - 1] {
            let mut changed = content.clone();
            changed[at] ^= 1;
            std::fs::write(&path, &changed).unwrap();
            assert_eq!(mark.check(&path).unwrap_err(), "is not what the run wrote there");
        }
        std::fs::write(&path, &content[1..]).unwrap();
        assert_contains!(mark.check(&path).unwrap_err(), "bytes where the run wrote");
        std::fs::remove_file(&path).unwrap();
        assert_eq!(mark.check(&path).unwrap_err(), "is missing");
    }
}
