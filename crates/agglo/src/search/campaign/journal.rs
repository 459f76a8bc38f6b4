//! Replicates that ended, one a line in the order in which they ended: what a campaign goes on from.
//!
//! ```text
//! agglo 0.1.0,5a1f03c2                          version of the program and checksum of the campaign; the name of the function
//!                                               that gives the quantities, if one does
//! 17,0,5403271183612,12.3,ok,0.61,311.5,9e21ab04    evaluation, replicate, seed, wall time [s], quantities, checksum
//! 18,0,5403271183612,12.4,failed,"reason",11ce0792
//! budget,16,12.4,goes_on,8c31aa02                   what the clock decided once so many candidates were evaluated
//! point,17,5d0c9b1e,90b1d3f7                        the checksum of the point that a program proposed for an evaluation
//! ```
//! Each line is handed to the operating system at once. A line that a kill or a loss of power cut short, or that was
//! damaged, does not fit its checksum and is as if it had never been: its replicate is run again. Once the campaign has
//! ended, its tables hold the same and the journal is removed.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs::{File, OpenOptions};
use std::io::{Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use crate::folder::files;
use crate::record::{RecordError, atomic, door};
use crate::search::pool::Finished;
use crate::text::{Number, cell};

/// What a replicate came to in an earlier session.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Its seed.
    pub seed: u64,
    /// Quantities, or the reason of its failure.
    pub outcome: Result<Vec<f64>, String>,
}

impl Entry {
    /// Whether it is what a replicate with this seed can have come to, of so many quantities.
    pub fn is_of(&self, seed: u64, quantities: usize) -> bool {
        self.seed == seed && self.outcome.as_ref().map_or(true, |found| found.len() == quantities)
    }
}

/// The replicates of earlier sessions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Past {
    /// By evaluation and replicate.
    pub replicates: BTreeMap<(u64, u32), Entry>,
    /// Wall time of all earlier sessions [s].
    pub wall_s: f64,
    /// Checksums of the points that a program outside proposed, by evaluation.
    pub points: BTreeMap<u64, u32>,
    /// Candidates at which the budget of time let the search go on: the most.
    pub went_on: Option<u64>,
    /// Candidates at which the budget of time ended the search.
    pub ended: Option<u64>,
}

impl Past {
    /// Replicates of this evaluation.
    pub fn of(&self, evaluation: u64) -> impl Iterator<Item = (u32, &Entry)> {
        let replicates = self.replicates.range((evaluation, 0)..=(evaluation, u32::MAX));
        replicates.map(|((_, replicate), entry)| (*replicate, entry))
    }
}

/// The file that grows by a line with each replicate that ends.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    open: Mutex<(File, String)>,
}

/// What the replicates of a journal come from.
pub struct Origin<'a> {
    /// The text of the campaign.
    pub campaign: &'a str,
    /// The name of what gives the quantities instead of runs.
    pub function: Option<&'a str>,
}

impl Origin<'_> {
    /// The first line of their journal.
    pub fn heading(&self) -> String {
        let function = self.function.map(|name| format!(",{}", serde_json::Value::from(name)));
        format!("{}{}\n", self.campaign(), function.unwrap_or_default())
    }

    fn campaign(&self) -> String {
        format!("agglo {},{:08x}", env!("CARGO_PKG_VERSION"), crc32fast::hash(self.campaign.as_bytes()))
    }

    /// Why a journal with another first line is not theirs.
    fn differs(&self, found: &str) -> String {
        let rest = found.strip_prefix(&self.campaign());
        let function = rest.and_then(|rest| match rest.strip_prefix(',') {
            None => rest.is_empty().then_some(None),
            Some(name) => serde_json::from_str(name).ok().map(Some),
        });
        let whence = |function: Option<String>| {
            function.map_or("runs of agglo".to_owned(), |name| format!("the function {}", cell(&name)))
        };
        match function {
            Some(function) => format!(
                "its quantities come from {}, and this session's from {}; go on with what it began with, or begin anew",
                whence(function),
                whence(self.function.map(str::to_owned))
            ),
            None => {
                format!(
                    "its journal is of \"{}\" (version, campaign), this is \"{}\"",
                    cell(found),
                    self.campaign()
                )
            }
        }
    }
}

/// The whole lines of the journal at `path`, the heading included; nothing where there is none.
///
/// # Errors
/// [`RecordError::File`]; or the reason why the journal does not belong to this campaign and program.
pub fn lines(path: &Path, origin: &Origin<'_>) -> Result<Result<Vec<u8>, String>, RecordError> {
    let mut found = if path.symlink_metadata().is_ok() {
        files::read(path, door::MOST_OF_A_TABLE).map_err(RecordError::file("read", path))?
    } else {
        Vec::new()
    };
    let whole = found.iter().rposition(|byte| *byte == b'\n').map_or(0, |last| last + 1);
    found.truncate(whole);
    if whole == 0 || found.starts_with(origin.heading().as_bytes()) {
        return Ok(Ok(found));
    }
    let text = String::from_utf8_lossy(&found);
    Ok(Err(origin.differs(text.lines().next().unwrap_or_default())))
}

impl Journal {
    /// Goes on with the journal at `path`, or begins one; `origin` is what its replicates come from.
    ///
    /// # Errors
    /// [`RecordError::File`]; or the reason why the journal does not belong to this campaign and program.
    pub fn open(path: &Path, origin: &Origin<'_>) -> Result<Result<(Self, Past), String>, RecordError> {
        let found = match lines(path, origin)? {
            Ok(found) => found,
            Err(reason) => return Ok(Err(reason)),
        };
        let mut past = Past::default();
        for line in String::from_utf8_lossy(&found).lines().skip(1) {
            past.take(line);
        }
        let journal = Self::at(path, found.len() as u64, &origin.heading())?;
        Ok(Ok((journal, past)))
    }

    /// Cuts the file to its whole lines; an empty one gets its heading.
    fn at(path: &Path, whole: u64, heading: &str) -> Result<Self, RecordError> {
        let mut open = OpenOptions::new();
        let opened = files::open(path, open.read(true).write(true).create(true).truncate(false));
        let mut file = atomic::alone(path, opened.map_err(RecordError::file("open", path))?)?;
        let mut cut = || {
            file.set_len(whole)?;
            file.seek(SeekFrom::Start(whole))?;
            if whole == 0 { file.write_all(heading.as_bytes()) } else { Ok(()) }
        };
        cut().map_err(RecordError::file("write", path))?;
        Ok(Self { path: path.to_owned(), open: Mutex::new((file, String::new())) })
    }

    /// Writes a replicate down; `wall_s` is the wall time of all sessions so far [s].
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn note(&self, finished: &Finished<'_>, wall_s: f64) -> Result<(), RecordError> {
        let Finished { evaluation, replicate, seed, outcome } = finished;
        self.add(|line| {
            // Writing to a string cannot fail.
            let _ = write!(line, "{evaluation},{replicate},{seed},{wall_s:.3},");
            match outcome {
                Ok(quantities) => {
                    line.push_str("ok");
                    quantities.iter().for_each(|quantity| {
                        let _ = write!(line, ",{}", Number(*quantity));
                    });
                }
                Err(reason) => {
                    let reason = serde_json::Value::from(*reason);
                    let _ = write!(line, "failed,{reason}");
                }
            }
        })
    }

    /// Writes down what the clock decided once so many candidates were evaluated, so that a later session decides the same.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn decide(&self, evaluations: u64, goes_on: bool, wall_s: f64) -> Result<(), RecordError> {
        let word = if goes_on { GOES_ON } else { ENDS };
        self.add(|line| {
            // Writing to a string cannot fail.
            let _ = write!(line, "{BUDGET},{evaluations},{wall_s:.3},{word}");
        })
    }

    /// Writes down which point a program outside proposed for an evaluation.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn propose(&self, evaluation: u64, checksum: u32) -> Result<(), RecordError> {
        self.add(|line| {
            // Writing to a string cannot fail.
            let _ = write!(line, "{POINT},{evaluation},{checksum:08x}");
        })
    }

    /// Adds a line with its checksum.
    fn add(&self, words: impl FnOnce(&mut String)) -> Result<(), RecordError> {
        let mut open = self.open.lock().unwrap_or_else(PoisonError::into_inner);
        let (file, line) = &mut *open;
        line.clear();
        words(line);
        seal(line);
        file.write_all(line.as_bytes()).map_err(RecordError::file("write", &self.path))
    }
}

const BUDGET: &str = "budget";
const POINT: &str = "point";
const GOES_ON: &str = "goes_on";
const ENDS: &str = "ends";

/// Ends a line with its checksum.
fn seal(line: &mut String) {
    let checksum = crc32fast::hash(line.as_bytes());
    // Writing to a string cannot fail.
    let _ = writeln!(line, ",{checksum:08x}");
}

impl Past {
    /// Takes a line; nothing of one that does not fit its checksum.
    fn take(&mut self, line: &str) {
        let Some(content) = content(line) else { return };
        if let Some((evaluations, wall_s, goes_on)) = decision(content) {
            self.wall_s = self.wall_s.max(wall_s);
            let kept = if goes_on { &mut self.went_on } else { &mut self.ended };
            *kept = (*kept).max(Some(evaluations));
        } else if let Some((evaluation, checksum)) = point(content) {
            self.points.entry(evaluation).or_insert(checksum);
        } else if let Some((key, wall_s, entry)) = replicate(content) {
            self.wall_s = self.wall_s.max(wall_s);
            self.replicates.entry(key).or_insert(entry);
        }
    }
}

type Line = ((u64, u32), f64, Entry);

/// A line without its checksum, if it fits that.
fn content(line: &str) -> Option<&str> {
    let (content, checksum) = line.rsplit_once(',')?;
    (u32::from_str_radix(checksum, 16).ok()? == crc32fast::hash(content.as_bytes())).then_some(content)
}

fn decision(content: &str) -> Option<(u64, f64, bool)> {
    let mut words = content.strip_prefix(BUDGET)?.strip_prefix(',')?.split(',');
    let (evaluations, wall_s) = (words.next()?.parse().ok()?, time(words.next()?)?);
    Some((evaluations, wall_s, words.next()? == GOES_ON))
}

fn point(content: &str) -> Option<(u64, u32)> {
    let (evaluation, checksum) = content.strip_prefix(POINT)?.strip_prefix(',')?.split_once(',')?;
    Some((evaluation.parse().ok()?, u32::from_str_radix(checksum, 16).ok()?))
}

/// A wall time [s].
fn time(word: &str) -> Option<f64> {
    word.parse().ok().filter(|wall_s: &f64| wall_s.is_finite() && *wall_s >= 0.0)
}

fn replicate(content: &str) -> Option<Line> {
    let mut words = content.splitn(6, ',');
    let key = (words.next()?.parse().ok()?, words.next()?.parse().ok()?);
    let seed = words.next()?.parse().ok()?;
    let wall_s = time(words.next()?)?;
    let is_ok = words.next()? == "ok";
    let rest = words.next();
    let outcome = if is_ok {
        Ok(rest
            .into_iter()
            .flat_map(|rest| rest.split(','))
            .map(str::parse)
            .collect::<Result<_, _>>()
            .ok()?)
    } else {
        Err(serde_json::from_str(rest?).ok()?)
    };
    Some((key, wall_s, Entry { seed, outcome }))
}

#[cfg(test)]
mod tests {
    use super::*;

    const CAMPAIGN: Origin<'static> = Origin { campaign: "version = 1", function: None };

    fn open(path: &Path) -> (Journal, Past) {
        Journal::open(path, &CAMPAIGN).unwrap().unwrap()
    }

    fn written(path: &Path) -> BTreeMap<(u64, u32), Entry> {
        let mut quantities = vec![0.1 + 0.2, -0.0, f64::INFINITY, 1e-300];
        quantities.extend(agglo_testing::AWKWARD);
        let (journal, past) = open(path);
        assert_eq!(past, Past::default());
        let outcomes: [Result<&[f64], &str>; 4] =
            [Ok(&quantities), Err("it,\nfailed \"there\""), Ok(&[]), Ok(&[1.5])];
        let mut entries = BTreeMap::new();
        for (k, outcome) in (0..).zip(outcomes) {
            let seed = (1 << 53) - 1 - k;
            journal.note(&Finished { evaluation: k, replicate: 7, seed, outcome }, 0.5 * k as f64).unwrap();
            let outcome = outcome.map(<[f64]>::to_vec).map_err(str::to_owned);
            entries.insert((k, 7), Entry { seed, outcome });
        }
        entries
    }

    #[test]
    fn replicates_come_back_as_they_were() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("replicates.journal");
        let entries = written(&path);
        let (journal, past) = open(&path);
        assert_eq!((&past.replicates, past.wall_s), (&entries, 1.5));
        assert_eq!(past.of(1).map(|(replicate, _)| replicate).collect::<Vec<_>>(), [7]);
        journal.note(&Finished { evaluation: 9, replicate: 0, seed: 1, outcome: Ok(&[]) }, 2.0).unwrap();
        assert_eq!(open(&path).1.replicates.len(), 5);
    }

    #[test]
    fn what_the_clock_decided_comes_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("replicates.journal");
        let (journal, _) = open(&path);
        journal.decide(8, true, 1.25).unwrap();
        journal.decide(16, true, 2.5).unwrap();
        journal.decide(24, false, 3.75).unwrap();
        let (_, past) = open(&path);
        let wanted = Past { wall_s: 3.75, went_on: Some(16), ended: Some(24), ..Past::default() };
        assert_eq!(past, wanted);
    }

    #[test]
    fn what_was_proposed_comes_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("replicates.journal");
        let (journal, _) = open(&path);
        journal.propose(0, 0x1f).unwrap();
        journal.propose(7, u32::MAX).unwrap();
        assert_eq!(open(&path).1.points, BTreeMap::from([(0, 0x1f), (7, u32::MAX)]));
    }

    /// Cut at any byte: all lines that are whole come back, and the next one does not stick to what was cut.
    #[test]
    fn a_torn_journal_loses_its_last_line_only() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("replicates.journal");
        let entries = written(&path);
        let whole = std::fs::read(&path).unwrap();
        for length in 0..whole.len() {
            std::fs::write(&path, &whole[..length]).unwrap();
            let lines = whole[..length].split(|byte| *byte == b'\n').count() - 1;
            let (journal, past) = open(&path);
            let kept: BTreeMap<_, _> = entries.clone().into_iter().take(lines.saturating_sub(1)).collect();
            assert_eq!(past.replicates, kept, "cut at {length}");
            journal
                .note(&Finished { evaluation: 9, replicate: 0, seed: 1, outcome: Ok(&[2.5]) }, 0.0)
                .unwrap();
            assert_eq!(open(&path).1.replicates.len(), kept.len() + 1);
        }
    }

    #[test]
    fn damaged_lines_are_as_if_they_had_never_been() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("replicates.journal");
        written(&path);
        let whole = std::fs::read(&path).unwrap();
        let heading = whole.iter().position(|byte| *byte == b'\n').unwrap() + 1;
        for at in heading..whole.len() {
            let mut damaged = whole.clone();
            damaged[at] ^= 1;
            std::fs::write(&path, &damaged).unwrap();
            let kept = open(&path).1.replicates.len();
            // A damaged end of a line takes the next line along.
            let is_end = whole[at] == b'\n';
            assert!(kept == 3 || is_end && kept >= 2, "{kept} kept with byte {at} damaged");
        }
    }

    /// Lines with right checksums that no search writes.
    #[test]
    fn forged_lines_are_left_aside() {
        for wall_s in ["inf", "NaN", "-1", "1e999"] {
            for content in [format!("0,0,1,{wall_s},ok,1"), format!("budget,8,{wall_s},goes_on")] {
                let mut line = content;
                seal(&mut line);
                let mut past = Past::default();
                past.take(line.trim_end());
                assert_eq!(past, Past::default(), "{line}");
            }
        }
        let entry = |outcome| Entry { seed: 7, outcome };
        let quantities = entry(Ok(vec![1.0, 2.0]));
        assert_true!(quantities.is_of(7, 2), "an outcome of this candidate and replicate");
        assert_false!(quantities.is_of(7, 3), "an outcome of this candidate and replicate");
        assert_false!(quantities.is_of(7, 1), "an outcome of this candidate and replicate");
        assert_false!(quantities.is_of(8, 2), "an outcome of this candidate and replicate");
        assert_true!(
            entry(Err("it failed".to_owned())).is_of(7, 3),
            "an outcome of this candidate and replicate"
        );
    }

    #[test]
    fn a_journal_of_another_campaign_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("replicates.journal");
        written(&path);
        let other = Origin { campaign: "version = 2", ..CAMPAIGN };
        let reason = Journal::open(&path, &other).unwrap().unwrap_err();
        assert!(reason.contains("its journal is of \"agglo "), "{reason}");
        std::fs::write(&path, "\u{1b}[31magglo,1\n").unwrap();
        let reason = Journal::open(&path, &CAMPAIGN).unwrap().unwrap_err();
        assert!(reason.contains("its journal is of \"\\u{1b}[31magglo,1\""), "{reason}");
    }

    /// Outcomes of a function and of runs, or of two functions, never stand in one journal.
    #[test]
    fn a_journal_of_another_function_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let by = |name| Origin { function: Some(name), ..CAMPAIGN };
        let [of_runs, of_bowl] = ["runs.journal", "bowl.journal"].map(|name| folder.path().join(name));
        written(&of_runs);
        drop(Journal::open(&of_bowl, &by("bowl, \"the\" first")).unwrap().unwrap());
        drop(Journal::open(&of_bowl, &by("bowl, \"the\" first")).unwrap().unwrap());
        let refused = |path, origin: &Origin<'_>| Journal::open(path, origin).unwrap().unwrap_err();
        let reason = refused(&of_runs, &by("bowl"));
        assert_contains!(reason, "come from runs of agglo, and this session's from the function bowl; go on");
        let reason = refused(&of_bowl, &CAMPAIGN);
        assert_contains!(
            reason,
            "come from the function bowl, \"the\" first, and this session's from runs of agglo"
        );
        let reason = refused(&of_bowl, &by("bowl"));
        assert_contains!(
            reason,
            "come from the function bowl, \"the\" first, and this session's from the function bowl;"
        );
    }
}
