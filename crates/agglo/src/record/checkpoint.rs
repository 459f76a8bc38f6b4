//! The whole state of a run on disk, and back.
//!
//! # Format
//! | bytes      | what                                                             |
//! |------------|------------------------------------------------------------------|
//! | 8          | magic `AGGLO\r\n` and a byte above 127 (text-mode copies break it) |
//! | 4          | version of this format                                           |
//! | 1, then n  | length and text of the version of the library that wrote it      |
//! | 8          | step                                                             |
//! | n          | payload: the state in postcard's encoding                        |
//! | 8          | length of the payload                                            |
//! | 4          | CRC-32 of everything before                                      |
//!
//! Integers are little-endian. Checkpoints of another version of the library are refused: the payload does not
//! describe itself, and a run is the same to the last bit only under the same version.
//!
//! A checkpoint is written to a temporary file, put onto the disk, and renamed; the newest two are kept. A run that is
//! killed at any moment leaves the last whole one. State and file pass by piece by piece: the bytes of a checkpoint are never
//! in memory beside the state.

use std::fmt;
use std::fs::OpenOptions;
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::atomic::{self, Durability};
use super::{RecordError, door};
use crate::folder::{Marked, Marking, files, names};
use crate::text::cell;

const MAGIC: &[u8; 8] = b"AGGLO\r\n\x8a";
const FORMAT: u32 = 7;
const VERSION: &str = env!("CARGO_PKG_VERSION");
/// Bytes before the payload: magic, format, the version with its length, step.
const HEADING: u64 = (MAGIC.len() + 4 + 1 + VERSION.len() + 8) as u64;
/// Bytes after the payload: its length and the checksum.
const TRAILER: u64 = 12;
/// The longest text in a state: that of its scenario, with every default written out.
const LONGEST_TEXT: u64 = 4 * door::MOST_OF_A_TEXT;
/// Checkpoints that are kept.
const KEPT: usize = 2;

/// A checkpoint that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refused {
    /// The file.
    pub path: PathBuf,
    /// Why.
    pub reason: String,
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.path.display(), self.reason)
    }
}

/// Writes the state after `step` into the folder `dir` and drops all but the newest two checkpoints.
///
/// Checkpoints of later steps are dropped too: they belong to a course of the run that was given up.
///
/// # Errors
/// [`RecordError::File`] or [`RecordError::Encode`]; earlier checkpoints are then still there.
pub fn save<T: Serialize>(dir: &Path, step: u64, state: &T) -> Result<PathBuf, RecordError> {
    let path = dir.join(names::checkpoint(step));
    atomic::remove_leftovers(dir)?;
    let mut failed = None;
    let written = atomic::write_with(&path, Durability::Power, |file| {
        encode(file, step, state).inspect_err(|error| {
            let is_of_the_state = error.kind() == io::ErrorKind::InvalidData;
            failed = is_of_the_state.then(|| error.to_string());
        })
    });
    if let Some(reason) = failed {
        return Err(RecordError::Encode { path, reason });
    }
    written?;
    let (later, mut earlier): (Vec<_>, Vec<_>) = list(dir)?.into_iter().partition(|found| found.0 > step);
    let superseded = earlier.split_off(KEPT.min(earlier.len()));
    for (_, old) in later.into_iter().chain(superseded) {
        std::fs::remove_file(&old).map_err(RecordError::file("remove", &old))?;
    }
    Ok(path)
}

/// Removes all checkpoints beside this one.
///
/// # Errors
/// [`RecordError::File`].
pub fn keep_only(kept: &Path) -> Result<(), RecordError> {
    let others = list(kept.parent().unwrap_or(Path::new("")))?.into_iter().filter(|(_, path)| path != kept);
    others
        .into_iter()
        .try_for_each(|(_, path)| std::fs::remove_file(&path).map_err(RecordError::file("remove", &path)))
}

/// Reads the newest whole checkpoint in `dir` that `accept` takes: what it makes of the state, its step, and the newer ones that
/// cannot be used. `accept` gives the reason where it refuses one.
///
/// # Errors
/// [`RecordError::NoCheckpoint`] where none is whole, [`RecordError::File`] where the folder cannot be read.
pub fn load_newest<T: DeserializeOwned, U>(
    dir: &Path,
    mut accept: impl FnMut(T) -> Result<U, String>,
) -> Result<(U, u64, Vec<Refused>), RecordError> {
    let mut refused = Vec::new();
    for (_, path) in list(dir)? {
        match read(&path).and_then(|(state, step)| Ok((accept(state)?, step))) {
            Ok((state, step)) => return Ok((state, step, refused)),
            Err(reason) => refused.push(Refused { path, reason }),
        }
    }
    Err(RecordError::NoCheckpoint { dir: dir.to_owned(), refused })
}

/// Reads one checkpoint.
///
/// # Errors
/// Why it cannot be used.
pub fn load<T: DeserializeOwned>(path: &Path) -> Result<T, String> {
    read(path).map(|(state, _)| state)
}

fn read<T: DeserializeOwned>(path: &Path) -> Result<(T, u64), String> {
    let open = || {
        let file = files::open(path, OpenOptions::new().read(true))?;
        let length = door::length(&file, door::MOST_OF_A_STATE)?;
        Ok((file, length))
    };
    let (file, length) = open().map_err(|error: io::Error| error.to_string())?;
    decode(BufReader::with_capacity(1 << 16, file), length)
}

/// The checkpoints in `dir`, newest first, whole or not.
///
/// # Errors
/// [`RecordError::File`] where the folder cannot be read.
pub fn newest_first(dir: &Path) -> Result<Vec<PathBuf>, RecordError> {
    Ok(list(dir)?.into_iter().map(|(_, path)| path).collect())
}

/// The checkpoints in `dir` by the step in their names, newest first.
fn list(dir: &Path) -> Result<Vec<(u64, PathBuf)>, RecordError> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(dir).map_err(RecordError::file("read", dir))? {
        let path = entry.map_err(RecordError::file("read", dir))?.path();
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let step = name
            .strip_prefix(names::CHECKPOINT_BEGIN)
            .and_then(|rest| rest.strip_suffix(names::CHECKPOINT_ENDING));
        if let Some(step) = step.and_then(|digits| digits.parse().ok()) {
            found.push((step, path));
        }
    }
    found.sort_unstable_by(|a, b| b.cmp(a));
    Ok(found)
}

/// A writer that keeps why it failed, below a layer that does not tell.
struct Telling<W> {
    inner: W,
    failed: Option<io::Error>,
}

impl<W> Telling<W> {
    /// Keeps a failure, and passes on one of its kind.
    fn told<T>(&mut self, outcome: io::Result<T>) -> io::Result<T> {
        outcome.map_err(|error| {
            let told = io::Error::from(error.kind());
            self.failed = Some(error);
            told
        })
    }
}

impl<W: Write> Write for Telling<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.inner.write(bytes);
        self.told(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        let flushed = self.inner.flush();
        self.told(flushed)
    }
}

/// Writes a checkpoint piece by piece; [`io::ErrorKind::InvalidData`] where the state cannot be put into bytes.
fn encode<T: Serialize>(out: impl Write, step: u64, state: &T) -> io::Result<()> {
    let mut out = Marked::over(Telling { inner: out, failed: None });
    out.write_all(MAGIC)?;
    out.write_all(&FORMAT.to_le_bytes())?;
    out.write_all(&[VERSION.len() as u8])?;
    out.write_all(VERSION.as_bytes())?;
    out.write_all(&step.to_le_bytes())?;
    if let Err(error) = postcard::to_io(state, &mut out) {
        let of_the_state = || io::Error::new(io::ErrorKind::InvalidData, error.to_string());
        return Err(out.into_inner().failed.unwrap_or_else(of_the_state));
    }
    let length = out.mark().bytes - HEADING;
    out.write_all(&length.to_le_bytes())?;
    let sum = out.mark().checksum;
    out.write_all(&sum.to_le_bytes())
}

/// Reads a checkpoint of so many bytes: once to see that it is whole, and once to understand it.
fn decode<T: DeserializeOwned>(mut file: impl Read + Seek, length: u64) -> Result<(T, u64), String> {
    let words = |error: io::Error| error.to_string();
    check_sum(&mut file, length)?;
    file.seek(SeekFrom::Start(0)).map_err(words)?;
    let step = read_heading(&mut file)?;
    let payload = length.checked_sub(HEADING + TRAILER).ok_or(CUT)?;
    file.seek(SeekFrom::Start(length - TRAILER)).map_err(words)?;
    if u64::from_le_bytes(take(&mut file)?) != payload {
        return Err("the payload has another length than it should".to_owned());
    }
    file.seek(SeekFrom::Start(HEADING)).map_err(words)?;
    let mut text = vec![0; payload.min(LONGEST_TEXT) as usize];
    match postcard::from_io((file.take(payload), &mut text[..])) {
        Ok((state, (rest, _))) if rest.limit() == 0 => Ok((state, step)),
        Ok(_) => Err("the payload holds more than a state".to_owned()),
        Err(error) => Err(format!("the payload cannot be read: {error}")),
    }
}

const CUT: &str = "the file is cut short";

/// Holds a file to the checksum at its end.
fn check_sum(file: &mut (impl Read + Seek), length: u64) -> Result<(), String> {
    const DAMAGED: &str = "the checksum does not match: the file is damaged or cut short";
    let words = |error: io::Error| error.to_string();
    if length == 0 {
        return Err("the file is empty".to_owned());
    }
    if take(file) != Ok(*MAGIC) {
        return Err("not a checkpoint, or its first bytes are damaged".to_owned());
    }
    file.seek(SeekFrom::Start(0)).map_err(words)?;
    let marking = Marking::of(&mut *file, length.saturating_sub(4)).map_err(words)?;
    let is_whole = u32::from_le_bytes(take(file)?) == marking.mark().checksum;
    if is_whole { Ok(()) } else { Err(DAMAGED.to_owned()) }
}

/// The step, if what stands before the payload is as this program writes it.
fn read_heading(file: &mut impl Read) -> Result<u64, String> {
    let _: [u8; MAGIC.len()] = take(file)?;
    let format = u32::from_le_bytes(take(file)?);
    if format != FORMAT {
        return Err(format!("its format is version {format}, this program reads version {FORMAT}"));
    }
    let [length] = take(file)?;
    let mut version = vec![0; usize::from(length)];
    file.read_exact(&mut version).map_err(|_| CUT)?;
    if version != VERSION.as_bytes() {
        let version = cell(&String::from_utf8_lossy(&version));
        return Err(format!("written by agglo {version}; resume it with that version, this is {VERSION}"));
    }
    take(file).map(u64::from_le_bytes)
}

/// The next bytes.
fn take<const N: usize>(file: &mut impl Read) -> Result<[u8; N], String> {
    let mut bytes = [0; N];
    file.read_exact(&mut bytes).map_err(|_| CUT)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use serde::Deserialize;

    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    struct State {
        time: f64,
        values: Vec<f64>,
        names: Vec<u32>,
    }

    fn state(step: u64) -> State {
        State {
            time: 0.1 * step as f64,
            values: vec![f64::MIN_POSITIVE, -0.0, 1.0 / 3.0],
            names: vec![7; 40],
        }
    }

    fn bytes_of(step: u64, state: &impl Serialize) -> Vec<u8> {
        let mut bytes = Vec::new();
        encode(&mut bytes, step, state).unwrap();
        bytes
    }

    fn from_bytes<T: DeserializeOwned>(bytes: &[u8]) -> Result<(T, u64), String> {
        decode(io::Cursor::new(bytes), bytes.len() as u64)
    }

    fn names(dir: &Path) -> Vec<String> {
        let mut names: Vec<String> = std::fs::read_dir(dir)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn the_newest_two_are_kept_and_the_newest_is_read() {
        let dir = tempfile::tempdir().unwrap();
        for step in [5, 10, 999, 1000] {
            save(dir.path(), step, &state(step)).unwrap();
        }
        assert_eq!(names(dir.path()), ["checkpoint-000000000999.agglo", "checkpoint-000000001000.agglo"]);
        assert_eq!(load_newest(dir.path(), Ok::<State, _>).unwrap(), (state(1000), 1000, vec![]));
    }

    #[test]
    fn a_damaged_one_is_named_and_the_one_before_is_used() {
        type Damage = fn(&mut Vec<u8>);
        let damages: [(Damage, &str); 4] = [
            (|bytes| bytes[60] ^= 1, "checksum"),
            (|bytes| bytes.truncate(50), "cut short"),
            (Vec::clear, "empty"),
            (|bytes| bytes[0] = b'B', "not a checkpoint"),
        ];
        for (damage, words) in damages {
            let dir = tempfile::tempdir().unwrap();
            save(dir.path(), 1, &state(1)).unwrap();
            let newest = save(dir.path(), 2, &state(2)).unwrap();
            let mut bytes = std::fs::read(&newest).unwrap();
            damage(&mut bytes);
            std::fs::write(&newest, bytes).unwrap();
            let (found, step, refused) = load_newest(dir.path(), Ok::<State, _>).unwrap();
            assert_eq!((found, step), (state(1), 1));
            assert_eq!(refused.len(), 1);
            assert_eq!(refused[0].path, newest);
            assert!(refused[0].reason.contains(words), "{}", refused[0]);
            // The run goes on from step 1; the damaged one of the course given up must not push out whole ones.
            save(dir.path(), 2, &state(2)).unwrap();
            assert_eq!(load_newest(dir.path(), Ok::<State, _>).unwrap().2, []);
        }
    }

    /// Full after so many bytes, which it tells as they come or when they are flushed.
    struct Full(usize, bool);

    impl Write for Full {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            let is_full = bytes.len() > self.0;
            self.0 = self.0.saturating_sub(bytes.len());
            if is_full && !self.1 { Err(io::ErrorKind::StorageFull.into()) } else { Ok(bytes.len()) }
        }

        fn flush(&mut self) -> io::Result<()> {
            if self.0 == 0 { Err(io::ErrorKind::StorageFull.into()) } else { Ok(()) }
        }
    }

    #[test]
    fn what_the_file_says_comes_through() {
        let whole = bytes_of(7, &state(7)).len();
        for is_told_late in [false, true] {
            for room in 0..whole + 2 {
                let found = encode(Full(room, is_told_late), 7, &state(7)).map_err(|error| error.kind());
                // What comes after the payload is flushed by whoever opened the file.
                let fits = if is_told_late { room > whole - TRAILER as usize } else { room >= whole };
                let wanted = if fits { Ok(()) } else { Err(io::ErrorKind::StorageFull) };
                assert_eq!(found, wanted, "room for {room} of {whole} bytes");
            }
        }
    }

    #[test]
    fn a_later_course_that_was_given_up_goes() {
        let dir = tempfile::tempdir().unwrap();
        for step in [10, 30, 20] {
            save(dir.path(), step, &state(step)).unwrap();
        }
        assert_eq!(names(dir.path()), ["checkpoint-000000000010.agglo", "checkpoint-000000000020.agglo"]);
    }

    #[test]
    fn none_is_an_error_that_lists_all() {
        let dir = tempfile::tempdir().unwrap();
        let message = load_newest(dir.path(), Ok::<State, _>).unwrap_err().to_string();
        assert!(message.starts_with("no usable checkpoint in "), "{message}");
        std::fs::write(dir.path().join("checkpoint-000000000003.agglo"), "text").unwrap();
        let message = load_newest(dir.path(), Ok::<State, _>).unwrap_err().to_string();
        assert!(message.contains("checkpoint-000000000003.agglo: not a checkpoint"), "{message}");
        let nowhere = load_newest(Path::new("/nowhere"), Ok::<State, _>).unwrap_err().to_string();
        assert_eq!(nowhere, "cannot read /nowhere: no such file or folder");
    }

    /// With a right checksum, so that the fields themselves are looked at.
    #[test]
    fn other_versions_and_other_states_are_refused() {
        let resealed = |change: &dyn Fn(&mut Vec<u8>)| {
            let mut bytes = bytes_of(4, &state(4));
            bytes.truncate(bytes.len() - 4);
            change(&mut bytes);
            let sum = crc32fast::hash(&bytes);
            bytes.extend_from_slice(&sum.to_le_bytes());
            from_bytes::<State>(&bytes).unwrap_err()
        };
        assert_contains!(resealed(&|bytes| bytes[8] = 9), "format is version 9");
        assert_contains!(resealed(&|bytes| bytes[13] = b'7'), "resume it with that version");
        assert_contains!(resealed(&|bytes| bytes[13] = 0x1b), "written by agglo \\u{1b}");
        assert_contains!(resealed(&|bytes| bytes.push(0)), "another length");
        let other = bytes_of(4, &(state(4), 1_u8));
        assert_contains!(from_bytes::<State>(&other).unwrap_err(), "more than a state");
        assert_contains!(from_bytes::<(State, u64)>(&bytes_of(4, &state(4))).unwrap_err(), "cannot be read");
    }

    /// Every single bit, not a sample: a CRC finds all single-bit errors.
    #[test]
    fn any_flipped_bit_is_refused() {
        let whole = bytes_of(3, &state(3));
        assert_eq!(from_bytes(&whole), Ok((state(3), 3)));
        for bit in 0..8 * whole.len() {
            let mut damaged = whole.clone();
            damaged[bit / 8] ^= 1 << (bit % 8);
            assert!(from_bytes::<State>(&damaged).is_err(), "bit {bit}");
        }
        for length in 0..whole.len() {
            assert!(from_bytes::<State>(&whole[..length]).is_err(), "cut at {length}");
        }
    }

    proptest! {
        #[test]
        fn states_come_back_and_damage_is_found(
            values in prop::collection::vec(any::<f64>(), 0..200),
            names in prop::collection::vec(any::<u32>(), 0..50),
            step in any::<u64>(),
            place in any::<prop::sample::Index>(),
            bit in 0..8_u32,
        ) {
            let state = State { time: 0.0, values, names };
            let mut bytes = bytes_of(step, &state);
            let (back, back_step) = from_bytes::<State>(&bytes).unwrap();
            prop_assert_eq!(back_step, step);
            prop_assert_eq!(back.names, state.names);
            let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
            prop_assert_eq!(bits(&back.values), bits(&state.values));
            let at = place.index(bytes.len());
            bytes[at] ^= 1 << bit;
            prop_assert!(from_bytes::<State>(&bytes).is_err());
        }
    }
}
