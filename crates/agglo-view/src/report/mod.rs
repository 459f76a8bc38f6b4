//! One page that shows a run, search or study: what happened in words, a replay in three dimensions, charts, quantities, the
//! scenario, and what to cite. It is one file and asks nothing of the network.

mod campaign;
mod charts;
mod cite;
mod columns;
mod due;
mod folder;
mod html;
mod lines;
mod listing;
mod pulses;
mod replay;
mod story;
mod table;
#[cfg(test)]
mod testing;
mod walls;

use std::path::{Path, PathBuf};

pub use cite::{Citation, bibtex, citations, program};
pub use listing::Line;
pub use replay::Replay;

use crate::chart::Chart;
use agglo::folder::names;
use agglo::record::{RecordError, atomic};
use folder::Folder;

/// What a page shows.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// What kind of thing it is: "A run of soft spheres".
    pub kind: String,
    /// The scenario's title.
    pub title: String,
    /// What happened, in plain words.
    pub story: String,
    /// What is missing, damaged or left out.
    pub notes: Vec<String>,
    /// The replay.
    pub replay: Option<Replay>,
    /// The charts.
    pub charts: Vec<Chart>,
    /// Other pages below the folder: their places and what they show.
    pub links: Vec<[String; 2]>,
    /// Tables of quantities.
    pub tables: Vec<QuantityTable>,
    /// The files that were run.
    pub files: Vec<Listing>,
    /// What to cite.
    pub citations: Vec<Citation>,
    /// Whether there may be more to cite, since it is not known what was run.
    pub laws_are_unknown: bool,
}

/// A table of quantities.
#[derive(Clone, Debug, Default)]
pub struct QuantityTable {
    /// Heading.
    pub title: String,
    /// What it shows.
    pub about: String,
    /// Whether it stands before the charts.
    pub is_first: bool,
    /// Names of the columns; none for a list of names and values.
    pub head: Vec<String>,
    /// Rows.
    pub rows: Vec<Vec<String>>,
}

/// A file that was run.
#[derive(Clone, Debug, Default)]
pub struct Listing {
    /// Heading.
    pub title: String,
    /// Its lines; none where it is not there.
    pub lines: Vec<Line>,
}

/// Why there is no report.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The folder holds nothing that could be shown.
    #[error(
        "{} holds no run, search or study: neither {} nor {}, {}, tables or frames; give the folder that `agglo run`, `search` or \
         `study` wrote into",
        dir.display(), names::SCENARIO, names::CAMPAIGN, names::SUMMARY
    )]
    NothingThere {
        /// The folder.
        dir: PathBuf,
    },
    /// The page could not be written.
    #[error(transparent)]
    Record(#[from] RecordError),
}

/// Writes `report.html` into the folder of a run, search or study; gives the file and what was missing, damaged or left
/// out.
///
/// # Errors
/// [`ReportError`].
pub fn write(dir: &Path) -> Result<(PathBuf, Vec<String>), ReportError> {
    let report =
        if agglo::search::campaign::is_one(dir) { Report::of_campaign(dir) } else { Report::of_run(dir)? };
    let path = dir.join(names::REPORT);
    atomic::write(&path, report.page().as_bytes())?;
    Ok((path, report.notes))
}

impl Report {
    /// The report of the folder of a search or study, which has at least its `search.toml`.
    pub fn of_campaign(dir: &Path) -> Self {
        campaign::report(dir)
    }

    /// The report of a run's folder.
    ///
    /// # Errors
    /// [`ReportError::NothingThere`].
    pub fn of_run(dir: &Path) -> Result<Self, ReportError> {
        let folder = Folder::read(dir);
        if !folder.is_a_run() {
            return Err(ReportError::NothingThere { dir: dir.to_owned() });
        }
        let mut notes = folder.notes.clone();
        let replay = if folder.frames.is_empty() { None } else { noting(&folder, &mut notes) };
        let last = folder.table("grains").and_then(|table| table.column("grains")?.last().copied());
        let grains =
            last.map(|count| count as u64).or_else(|| replay.as_ref().map(|replay| replay.grains as u64));
        let story = match &folder.summary {
            Some(summary) => story::story(summary),
            None => story::unfinished(&folder, grains),
        };
        let scenario = folder.scenario.as_ref();
        let title = scenario.map(|scenario| scenario.title.clone()).filter(|title| !title.is_empty());
        Ok(Self {
            kind: kind(&folder).to_owned(),
            title: title.unwrap_or_else(|| "A run without a title".to_owned()),
            story,
            notes,
            replay,
            charts: charts::charts(&folder),
            links: Vec::new(),
            tables: tables(&folder),
            files: vec![Listing { title: "Scenario".to_owned(), lines: folder.lines() }],
            citations: scenario.map(citations).unwrap_or_default(),
            laws_are_unknown: scenario.is_none(),
        })
    }
}

/// The replay, with what it leaves out among the notes.
fn noting(folder: &Folder, notes: &mut Vec<String>) -> Option<Replay> {
    match replay::replay(&folder.frames) {
        Ok(replay) => {
            notes.extend(replay.notes.iter().cloned());
            Some(replay)
        }
        Err(reasons) => {
            notes.extend(reasons);
            notes.push("no frame shows grains: the replay is left out".to_owned());
            None
        }
    }
}

fn kind(folder: &Folder) -> &'static str {
    match &folder.scenario {
        Some(scenario) if scenario.is_hard() => "A run of hard spheres",
        Some(_) => "A run of soft spheres",
        None => "A run",
    }
}

/// The closing quantities, the warnings, and how to run it again.
fn tables(folder: &Folder) -> Vec<QuantityTable> {
    let mut tables = Vec::new();
    if let Some(summary) = &folder.summary {
        let pair = |(what, quantity): (String, String)| vec![what, quantity];
        let rows = summary.table().into_iter().map(pair).collect();
        tables.push(QuantityTable { title: "Quantities".to_owned(), rows, ..QuantityTable::default() });
        tables.extend(walls::table(summary));
        let warnings = summary.warnings();
        let rows: Vec<_> =
            warnings.iter().map(|(warning, count)| vec![warning.clone(), count.to_string()]).collect();
        if !rows.is_empty() {
            let head = vec!["warning".to_owned(), "how often".to_owned()];
            tables.push(QuantityTable {
                title: "Warnings".to_owned(),
                head,
                rows,
                ..QuantityTable::default()
            });
        }
    }
    tables.extend(again(folder));
    tables
}

/// How to run it again: version, seed, command.
fn again(folder: &Folder) -> Option<QuantityTable> {
    let mut rows = Vec::new();
    let mut row = |what: &str, value: String| rows.push(vec![what.to_owned(), value]);
    if let Some(version) = folder.version() {
        row("version", format!("agglo {version}"));
    }
    if let Some(scenario) = &folder.scenario {
        row("seed", scenario.seed.to_string());
        row("command", format!("agglo run {} -o again", names::SCENARIO));
    }
    if rows.is_empty() {
        return None;
    }
    let about = match folder.scenario {
        Some(_) => {
            "In this folder. The same version, scenario and seed give the same numbers, to the last bit, on the same \
             machine and any number of threads."
        }
        None => "The scenario cannot be read, so this folder alone does not run again.",
    };
    Some(QuantityTable {
        title: "To run it again".to_owned(),
        about: about.to_owned(),
        rows,
        ..QuantityTable::default()
    })
}
