//! What programs are told: one JSON object a line on the standard output. docs/json.md has every type with its keys.

use std::borrow::Cow;
use std::io::{self, Write};
use std::path::Path;
use std::time::{Duration, Instant};

use agglo::forecast::Plan;
use agglo::run::Progress;
use agglo::scenario::Fault;
use agglo::search::campaign::CampaignProgress;
use agglo::text::visible;
use serde::Serialize;
use serde_json::Value as Json;

use crate::brake::Reason;
use crate::failure::{About, Failure, Stopped, shown};
use crate::progress::Pace;
use crate::report::Page;
use crate::session::{End, Listener, News};

/// How often progress is told of.
const EVERY: Duration = Duration::from_secs(1);

/// A line. What is not known is null.
#[derive(Serialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub(crate) enum Line<'a> {
    /// What a file would do.
    Plan { file: &'a str, kind: &'static str, run: Option<&'a Plan>, campaign: Option<Json> },
    /// Work has begun.
    Started { version: &'static str, verb: &'static str, folder: String },
    /// How far a run is.
    #[serde(rename = "progress")]
    Run {
        wall_s: f64,
        time_s: f64,
        end_s: f64,
        steps: u64,
        steps_are: &'static str,
        steps_per_s: f64,
        left_s: Option<f64>,
        now: &'a str,
    },
    /// How far a search or study is.
    #[serde(rename = "progress")]
    Campaign {
        wall_s: f64,
        #[serde(flatten)]
        progress: &'a CampaignProgress,
    },
    /// Something to keep in mind.
    Warning { message: &'a str },
    /// It came to its end.
    Finished {
        folder: String,
        wall_s: Option<f64>,
        report: Option<String>,
        best_run: Option<String>,
        exit_code: u8,
        summary: Json,
    },
    /// It was stopped on its way.
    Stopped {
        folder: String,
        reason: &'static str,
        time_s: Option<f64>,
        wall_s: f64,
        can_resume: bool,
        message: &'a str,
        exit_code: u8,
    },
    /// It failed.
    Failed { message: &'a str, exit_code: u8 },
    /// What was asked for cannot be done.
    Refused { file: Option<&'a str>, faults: Vec<&'a Fault>, message: &'a str, exit_code: u8 },
}

impl Line<'_> {
    /// Writes it; a reader that closed the pipe has seen enough.
    pub(crate) fn print(&self) -> Result<(), Failure> {
        // A struct of numbers and strings always has a text.
        let text = serde_json::to_string(self).unwrap_or_default();
        match writeln!(io::stdout(), "{}", without_effect(&text)) {
            Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
                Err(Failure::failed(format!("error: cannot write: {error}")))
            }
            _ => Ok(()),
        }
    }

    /// Writes it; work goes on where nobody reads.
    fn tell(&self) {
        let _ = self.print();
    }
}

/// The same JSON, in which nothing acts on a terminal: such characters stand in its texts alone, and are written by their
/// numbers.
fn without_effect(json: &str) -> Cow<'_, str> {
    if let Cow::Borrowed(same) = visible(json) {
        return Cow::Borrowed(same);
    }
    let escaped = |c: char| match visible(c.encode_utf8(&mut [0; 4])) {
        Cow::Borrowed(_) => c.to_string(),
        Cow::Owned(_) => format!("\\u{:04x}", u32::from(c)),
    };
    Cow::Owned(json.chars().map(escaped).collect())
}

/// Writes a line for each thing that happens in a session.
pub(crate) struct Lines {
    told: Option<Instant>,
}

impl Lines {
    /// Nothing is written yet.
    pub(crate) fn new() -> Self {
        Self { told: None }
    }
}

impl Listener for Lines {
    fn started(&mut self, verb: &'static str, folder: &Path) {
        Line::Started { version: env!("CARGO_PKG_VERSION"), verb, folder: shown(folder) }.tell();
    }

    fn progress(&mut self, news: News<'_>, wall_s: f64) {
        if self.told.is_some_and(|told| told.elapsed() < EVERY) {
            return;
        }
        self.told = Some(Instant::now());
        match news {
            News::Run(progress, pace) => of_run(progress, pace, wall_s).tell(),
            News::Campaign(progress) => Line::Campaign { wall_s, progress }.tell(),
        }
    }

    fn warning(&mut self, words: &str) {
        Line::Warning { message: words }.tell();
    }

    fn rest(&mut self) {}

    fn finished(&mut self, end: &End<'_>) -> Result<(), Failure> {
        let report = if let Page::Written(page) = &end.page { Some(shown(page)) } else { None };
        let best_run = end.best.as_ref().map(|(folder, _)| shown(folder));
        let (folder, wall_s, summary) = (shown(end.folder), end.wall_s, end.outcome.json());
        Line::Finished { folder, wall_s, report, best_run, exit_code: 0, summary }.print()
    }
}

fn of_run<'a>(progress: &'a Progress, pace: &Pace, wall_s: f64) -> Line<'a> {
    Line::Run {
        wall_s,
        time_s: progress.time,
        end_s: progress.end,
        steps: progress.step,
        steps_are: progress.steps_are,
        steps_per_s: pace.steps(),
        left_s: pace.left(progress),
        now: &progress.now,
    }
}

/// Tells programs why the program ends early.
pub(crate) fn tell(failure: &Failure) {
    let (message, exit_code) = (failure.message.as_str(), failure.code);
    let message = message.strip_prefix("error: ").unwrap_or(message);
    match &failure.about {
        About::Stopped(how) => of_stopped(how, message, exit_code).tell(),
        About::Faults { file, faults } => {
            let (count, faults) = (faults.len(), faults.iter().collect());
            let words = if count == 1 { "1 fault".to_owned() } else { format!("{count} faults") };
            let message = &format!("{words} in {file}; nothing was run or written");
            Line::Refused { file: Some(file), faults, message, exit_code }.tell();
        }
        About::Words if exit_code == 2 => {
            Line::Refused { file: None, faults: Vec::new(), message, exit_code }.tell();
        }
        About::Words => Line::Failed { message, exit_code }.tell(),
    }
}

fn of_stopped<'a>(how: &Stopped, message: &'a str, exit_code: u8) -> Line<'a> {
    let Stopped { folder, reason, time_s, wall_s, can_resume } = how;
    let reason = match reason {
        Reason::Signal => "signal",
        Reason::WallTime(_) => "wall_time",
    };
    let (folder, time_s, wall_s, can_resume) = (shown(folder), *time_s, *wall_s, *can_resume);
    Line::Stopped { folder, reason, time_s, wall_s, can_resume, message, exit_code }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_acts_on_a_terminal_is_written_by_its_number() {
        let text = "a \u{9b}2J b \u{202e}\u{1b} µ \n";
        let json = serde_json::to_string(&Line::Warning { message: text }).unwrap_or_default();
        let safe = without_effect(&json);
        assert_eq!(safe, r#"{"type":"warning","message":"a \u009b2J b \u202e\u001b µ \n"}"#);
        let back: Json = serde_json::from_str(&safe).unwrap_or_default();
        assert_eq!(back["message"], text);
    }
}
