//! A folder with a campaign file in it, its results, and the comparison of two of them.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use serde_json::Value as Json;

use crate::common::{bytes, command, ended, lasting};

/// Hard spheres that stick or do not; a run takes some milliseconds.
pub const SCENARIO: &str = include_str!("scenario.toml");
/// A search over two of its keys.
pub const SEARCH: &str = include_str!("search.toml");
/// Bytes at the end of a checkpoint that tell the wall time [8], the length of the state [8] and the checksum [4].
const AFTER_THE_STATE: usize = 20;

/// A folder with a scenario and a campaign file in it, and the place of the results.
pub struct Bench {
    folder: PathBuf,
    /// Removes it at the end of a test.
    _guard: Option<tempfile::TempDir>,
}

impl Bench {
    /// With this campaign.
    pub fn with(campaign: &str) -> Self {
        let guard = tempfile::tempdir().unwrap();
        let bench = Self::at(guard.path().to_owned(), campaign);
        Self { _guard: Some(guard), ..bench }
    }

    /// With this campaign, in a folder that is there.
    fn at(folder: PathBuf, campaign: &str) -> Self {
        std::fs::write(folder.join("scenario.toml"), SCENARIO).unwrap();
        std::fs::write(folder.join("campaign.toml"), campaign).unwrap();
        Self { folder, _guard: None }
    }

    /// A file of the folder.
    pub fn file(&self, name: &str) -> String {
        self.folder.join(name).display().to_string()
    }

    /// The folder of the results.
    pub fn out(&self) -> PathBuf {
        self.folder.join("out")
    }

    /// A verb on the campaign file into the folder of the results.
    pub fn order(&self, verb: &str, more: &[&str]) -> Command {
        let (file, out) = (self.file("campaign.toml"), self.file("out"));
        let mut arguments = vec![verb, &file, "-o", &out];
        arguments.extend(more);
        command(&arguments)
    }

    /// `agglo resume` of the folder of the results.
    pub fn resume(&self) -> Command {
        command(&["resume", &self.file("out")])
    }

    /// A verb on the campaign file, which must end with this code.
    pub fn ends(&self, verb: &str, more: &[&str], code: i32) -> Output {
        ended(self.order(verb, more).output().unwrap(), code)
    }

    /// What `summary.json` holds.
    pub fn summary(&self) -> Json {
        serde_json::from_slice(&std::fs::read(self.out().join("summary.json")).unwrap()).unwrap()
    }

    /// The lines of a table of the results, without its heading.
    pub fn rows(&self, table: &str) -> Vec<String> {
        let text = std::fs::read_to_string(self.out().join(table)).unwrap();
        text.lines().skip(1).map(str::to_owned).collect()
    }

    /// Waits until so many replicates have ended, or all of them.
    pub fn wait_for_replicates(&self, replicates: usize) {
        let begun = Instant::now();
        loop {
            let journal = std::fs::read(self.out().join("replicates.journal")).unwrap_or_default();
            let ended = journal.split(|byte| *byte == b'\n').count() - 1;
            if ended > replicates || self.out().join("summary.json").exists() {
                return;
            }
            assert!(
                begun.elapsed() < Duration::from_secs(120),
                "no {replicates} replicates after two minutes"
            );
            std::thread::sleep(Duration::from_millis(1));
        }
    }
}

/// All files below a folder without what tells how long it took and on how many threads.
fn results(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = bytes(folder);
    for (name, content) in &mut files {
        if name.ends_with("summary.json") {
            let text = String::from_utf8(content.clone()).unwrap();
            let kept = |line: &&str| !line.contains("\"wall_s\"") && !line.contains("\"threads\"");
            *content = text.lines().filter(kept).collect::<Vec<_>>().join("\n").into_bytes();
        } else if name.ends_with("report.html") {
            let text = String::from_utf8(content.clone()).unwrap();
            let kept = |line: &&str| !line.starts_with("<tr><td>wall time</td>");
            *content = text.lines().filter(kept).collect::<Vec<_>>().join("\n").into_bytes();
        } else if name.contains("checkpoints/") {
            content.truncate(content.len() - AFTER_THE_STATE);
        }
    }
    files
}

/// Holds two folders to the same files, bit by bit.
pub fn assert_same(found: &Path, wanted: &Path) {
    let (found, wanted) = (results(found), results(wanted));
    let names = |files: &BTreeMap<String, Vec<u8>>| files.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&found), names(&wanted));
    for (name, content) in &wanted {
        let same = content.iter().zip(&found[name]).take_while(|(a, b)| a == b).count();
        assert!(found[name] == *content, "{name} differs from byte {same} on");
    }
}

/// The search, conducted once on two threads without a break.
pub fn reference() -> &'static Bench {
    static REFERENCE: OnceLock<Bench> = OnceLock::new();
    REFERENCE.get_or_init(|| {
        // What a static holds is never dropped.
        let bench = Bench::at(lasting().to_owned(), SEARCH);
        bench.ends("search", &["--threads", "2"], 0);
        bench
    })
}
