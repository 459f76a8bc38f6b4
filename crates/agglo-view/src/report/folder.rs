//! What a run's folder holds, and what of it cannot be used.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use agglo::folder::names::{self, SCENARIO, SUMMARY};
use agglo::record::{About, door};
use agglo::run::{Summary, tables};
use agglo::scenario::Scenario;

use super::due;
use super::listing::{Line, listing, plain};
use super::table::Table;

/// What a run's folder holds.
#[derive(Debug, Default)]
pub struct Folder {
    /// The folder.
    pub root: PathBuf,
    /// The resolved scenario.
    pub scenario: Option<Scenario>,
    /// The resolved scenario's text.
    pub scenario_text: Option<String>,
    /// The closing quantities.
    pub summary: Option<Summary>,
    /// Tables over time, by the name of their file without its ending.
    pub tables: Vec<(String, Table)>,
    /// Frames of grains in the order of time.
    pub frames: Vec<PathBuf>,
    /// What is missing, cut or damaged.
    pub notes: Vec<String>,
}

impl Folder {
    /// Reads what is there.
    pub fn read(root: &Path) -> Self {
        let mut folder = Self { root: root.to_owned(), ..Self::default() };
        folder.read_scenario();
        folder.read_summary();
        folder.read_tables();
        folder.find_frames();
        folder.compare_versions();
        if folder.is_a_run() {
            let notes = due::notes(&folder);
            folder.notes.extend(notes);
        }
        folder
    }

    /// Whether it is a run's folder at all.
    pub fn is_a_run(&self) -> bool {
        self.scenario_text.is_some()
            || self.summary.is_some()
            || !self.tables.is_empty()
            || !self.frames.is_empty()
    }

    /// The table of that name.
    pub fn table(&self, name: &str) -> Option<&Table> {
        self.tables.iter().find(|(known, _)| known == name).map(|(_, table)| table)
    }

    /// The scenario's lines, with marks of defaults where it can be understood.
    pub fn lines(&self) -> Vec<Line> {
        let text = self.scenario_text.as_deref().unwrap_or("");
        match &self.scenario {
            Some(scenario) => listing(scenario, text),
            None => plain(text),
        }
    }

    fn read_scenario(&mut self) {
        let text = match door::read_text(&self.root.join(SCENARIO), door::MOST_OF_A_TEXT) {
            Ok(text) => text,
            Err(error) => {
                let reason = why(&error);
                return self.notes.push(format!("{SCENARIO} {reason}: what was run is not known"));
            }
        };
        match Scenario::from_toml(&text) {
            Ok(scenario) => self.scenario = Some(scenario),
            Err(faults) => {
                let first = faults.iter().next().map(ToString::to_string).unwrap_or_default();
                self.notes.push(format!(
                    "{SCENARIO} is damaged or of another version ({first}): it is shown as it is, without marks of \
                     defaults, and what to cite is not known"
                ));
            }
        }
        self.scenario_text = Some(text);
    }

    fn read_summary(&mut self) {
        let text = match door::read_text(&self.root.join(SUMMARY), door::MOST_OF_A_TEXT) {
            Ok(text) => text,
            Err(error) if error.kind() == ErrorKind::NotFound => {
                return self.notes.push(format!("{SUMMARY} is missing: the run has not finished"));
            }
            Err(error) => {
                let reason = why(&error);
                return self.notes.push(format!("{SUMMARY} {reason}: closing quantities are left out"));
            }
        };
        match serde_json::from_str(&text) {
            Ok(summary) => self.summary = Some(summary),
            Err(_) => self.notes.push(not_understood(&text)),
        }
    }

    fn read_tables(&mut self) {
        for path in files(&self.root.join(names::SERIES), "", names::TABLE_ENDING) {
            let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            let place = names::series(&name);
            match Table::read(&path, &columns_of(&place)) {
                Ok(table) => {
                    if table.dropped > 0 {
                        let rows = if table.dropped == 1 {
                            "1 row is".to_owned()
                        } else {
                            format!("{} rows are", table.dropped)
                        };
                        self.notes.push(format!("{place} is cut or damaged: {rows} left out"));
                    }
                    self.tables.push((name, table));
                }
                Err(reason) => self.notes.push(format!("{place} cannot be used: {reason}")),
            }
        }
        if self.tables.is_empty() {
            self.notes.push("there are no tables in series/: charts are left out".to_owned());
        }
    }

    fn find_frames(&mut self) {
        self.frames = files(&self.root.join(names::FRAMES), "grains_", names::FRAME_ENDING);
        if self.frames.is_empty() {
            self.notes.push("there are no frames in frames/: the replay is left out".to_owned());
        }
    }

    /// The latest time of the tables [s].
    pub fn reached(&self) -> Option<f64> {
        let last = |(_, table): &(String, Table)| table.column("time_s")?.last().copied();
        self.tables.iter().filter_map(last).max_by(f64::total_cmp)
    }

    /// Whether there is a checkpoint, whole or not.
    pub fn has_checkpoint(&self) -> bool {
        let checkpoints = self.root.join(names::CHECKPOINTS);
        !files(&checkpoints, names::CHECKPOINT_BEGIN, names::CHECKPOINT_ENDING).is_empty()
    }

    /// The version that wrote the folder, as the scenario or the summary says it.
    pub fn version(&self) -> Option<&str> {
        let head = self.scenario_text.as_ref().and_then(|text| text.lines().next());
        let said =
            head.and_then(|line| line.strip_prefix("# ")?.split_once(" of agglo ")?.1.split(':').next());
        said.or_else(|| self.summary.as_ref().map(Summary::version))
    }

    fn compare_versions(&mut self) {
        let ours = env!("CARGO_PKG_VERSION");
        if let Some(version) = self.version().filter(|version| *version != ours) {
            let note = format!(
                "the run is of agglo {version}, this page of agglo {ours}: the same numbers come from agglo {version} only"
            );
            self.notes.push(note);
        }
    }
}

/// What is told of the columns of a table that is in this place in the folder of a run of either kind.
pub fn columns_of(place: &str) -> Vec<&'static About> {
    let all = [false, true].into_iter().flat_map(|is_hard| tables(is_hard).iter());
    all.filter(|table| table.file() == place).flat_map(|table| table.columns()).collect()
}

/// Why a file cannot be read, as the end of a sentence.
pub fn why(error: &std::io::Error) -> String {
    match error.kind() {
        ErrorKind::NotFound => "is missing".to_owned(),
        ErrorKind::InvalidData => "is damaged (it is not text)".to_owned(),
        _ => format!("cannot be read ({error})"),
    }
}

/// What is wrong with the text of a summary.
pub fn not_understood(text: &str) -> String {
    let ours = env!("CARGO_PKG_VERSION");
    let value: Option<serde_json::Value> = serde_json::from_str(text).ok();
    match value.as_ref().and_then(|value| value.get("version")?.as_str()) {
        Some(version) if version != ours => format!(
            "{SUMMARY} is of agglo {version}, which agglo {ours} does not know: closing quantities are left out"
        ),
        _ => format!("{SUMMARY} is cut or damaged: closing quantities are left out"),
    }
}

/// Files of a folder whose names begin and end so, in the order of their names.
pub fn files(folder: &Path, begin: &str, end: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut found: Vec<PathBuf> = entries
        .map(|entry| entry.path())
        .filter(|path| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            name.starts_with(begin) && name.ends_with(end)
        })
        .collect();
    found.sort();
    found
}
