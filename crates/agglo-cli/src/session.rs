//! A session of a run, search or study: who is told of it, what stops it, how it ends.
//!
//! Whoever is told is a [`Listener`]: people, by bars and tables, or programs, by lines of JSON. Both hear the same.

use std::collections::BTreeSet;
use std::fmt;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use agglo::folder::RunFolder;
use agglo::folder::names::{BEST_RUN, REPORT};
use agglo::run::{Progress, Summary};
use agglo::search::campaign::{CampaignProgress, CampaignSummary};
use serde_json::Value as Json;

use crate::arguments::SessionOptions;
use crate::brake::{Brake, Reason, WallTime};
use crate::failure::{Failure, Stopped};
use crate::json::Lines;
use crate::progress::{Display, Pace, clock, count};
use crate::report::{self, Page};

/// Who is told of a session.
pub(crate) trait Listener: Send {
    /// Work has begun.
    fn started(&mut self, verb: &'static str, folder: &Path);
    /// How far it is, after so much wall time of this session [s].
    fn progress(&mut self, news: News<'_>, wall_s: f64);
    /// Something to keep in mind, each wording once.
    fn warning(&mut self, words: &str);
    /// There is no more progress to be told of.
    fn rest(&mut self);
    /// It came to its end.
    ///
    /// # Errors
    /// The standard output cannot be written to.
    fn finished(&mut self, end: &End<'_>) -> Result<(), Failure>;
}

/// Programs if they are meant, else people.
pub(crate) fn listener(is_json: bool) -> Box<dyn Listener> {
    if is_json { Box::new(Lines::new()) } else { Box::new(Display::new()) }
}

/// How far a session is.
#[derive(Clone, Copy)]
pub(crate) enum News<'a> {
    /// A run, and how fast it goes.
    Run(&'a Progress, &'a Pace),
    /// A search or study.
    Campaign(&'a CampaignProgress),
}

/// What a session came to.
pub(crate) enum Outcome {
    /// A run.
    Run(Summary),
    /// A search or study.
    Campaign(Box<CampaignSummary>),
}

impl Outcome {
    /// Whether it is a part of a study, and not the whole.
    pub(crate) fn is_part(&self) -> bool {
        matches!(self, Self::Campaign(summary) if summary.part.is_some())
    }

    /// The closing table: what, how much.
    pub(crate) fn table(&self) -> Vec<(String, String)> {
        match self {
            Self::Run(summary) => summary.table(),
            Self::Campaign(summary) => summary.table(),
        }
    }

    /// What `summary.json` holds.
    pub(crate) fn json(&self) -> Json {
        let json = match self {
            Self::Run(summary) => serde_json::to_value(summary),
            Self::Campaign(summary) => serde_json::to_value(summary),
        };
        // A struct of numbers and strings always has a value.
        json.unwrap_or_default()
    }
}

/// The end of a session.
pub(crate) struct End<'a> {
    /// What it came to.
    pub outcome: &'a Outcome,
    /// Its folder.
    pub folder: &'a Path,
    /// Its wall time [s]; none where the folder was found finished.
    pub wall_s: Option<f64>,
    /// Its report.
    pub page: Page,
    /// The folder of the best one's run with its report, where a search made one.
    pub best: Option<(PathBuf, Page)>,
}

/// A session on its way.
pub(crate) struct Session {
    verb: &'static str,
    folder: PathBuf,
    brake: Brake,
    listener: Box<dyn Listener>,
    began: Instant,
    has_started: bool,
    is_to_report: bool,
    /// Nothing before the first news: a resumed run does not begin at zero.
    pace: Option<Pace>,
    warnings: usize,
    told: BTreeSet<String>,
    held: Vec<String>,
}

impl Session {
    /// Listens to signals and keeps an eye on the clock; nobody is told of anything yet.
    pub(crate) fn open(
        verb: &'static str,
        folder: &Path,
        wall: WallTime,
        options: &SessionOptions,
    ) -> Result<Self, Failure> {
        Ok(Self {
            verb,
            folder: folder.to_owned(),
            brake: Brake::open(folder, wall)?,
            listener: listener(options.json),
            began: Instant::now(),
            has_started: false,
            is_to_report: !options.no_report,
            pace: None,
            warnings: 0,
            told: BTreeSet::new(),
            held: Vec::new(),
        })
    }

    /// The flag that asks for an end.
    pub(crate) fn flag(&self) -> Arc<AtomicBool> {
        self.brake.flag()
    }

    /// How far a run is. Where something else shows it, warnings are told of later.
    pub(crate) fn run(&mut self, progress: &Progress, is_shown_elsewhere: bool) -> ControlFlow<()> {
        self.note(&progress.warnings);
        let wall_s = self.wall_s();
        self.pace.get_or_insert_with(|| Pace::from(progress, wall_s)).note(progress, wall_s);
        if !is_shown_elsewhere {
            self.begin();
            self.release();
            if let Some(pace) = &self.pace {
                self.listener.progress(News::Run(progress, pace), wall_s);
            }
        }
        self.brake.look()
    }

    /// How far a search or study is.
    pub(crate) fn campaign(&mut self, progress: &CampaignProgress) -> ControlFlow<()> {
        self.note(&progress.warnings);
        self.begin();
        self.release();
        self.listener.progress(News::Campaign(progress), self.began.elapsed().as_secs_f64());
        self.brake.look()
    }

    /// There is no more progress.
    pub(crate) fn rest(&mut self) {
        self.release();
        self.listener.rest();
    }

    /// It came to its end: writes the reports and tells of all.
    pub(crate) fn finished(mut self, outcome: &Outcome) -> Result<(), Failure> {
        let wall_s = Some(self.wall_s());
        let (best, page) = self.pages(outcome);
        self.listener.finished(&End { outcome, folder: &self.folder, wall_s, page, best })
    }

    /// Writes the pages of what has finished: that of the best one's run, where a search made one, and its own.
    fn pages(&mut self, outcome: &Outcome) -> (Option<(PathBuf, Page)>, Page) {
        // A part is looked at in the whole.
        self.is_to_report &= !outcome.is_part();
        let best = Some(self.folder.join(BEST_RUN))
            .filter(|best| matches!(outcome, Outcome::Campaign(_)) && best.is_dir());
        let best = best.map(|best| {
            let page = self.page(&best);
            (best, page)
        });
        // It links to the page of the best one's run, which must be there.
        let page = self.page(&self.folder.clone());
        (best, page)
    }

    /// Writes the page of what has just finished.
    fn page(&mut self, of: &Path) -> Page {
        if !self.is_to_report {
            return Page::Unwanted;
        }
        let page = report::at_the_end(of, self.brake.ear());
        if let Page::Failed(reason) = &page {
            self.listener.warning(&format!("there is no report: {reason}"));
        }
        page
    }

    /// It was stopped and can be gone on with; `what` says what it was at, `kept` what there is to go on from.
    pub(crate) fn stopped(&self, what: &str, kept: &str, time_s: Option<f64>) -> Failure {
        let reason = self.brake.reason();
        let (why, closing, shown) = (reason.words(), self.closing(), self.folder.display());
        let message = format!("{what}{why} ({closing}); {kept}`agglo resume {shown}` goes on from there");
        let code = reason.exit_code();
        Failure::stopped(message, code, self.how(reason, time_s, true))
    }

    /// A run was stopped before its clock started or went on. Where the time is up with nothing to go on from, that is a
    /// failure: who resumes as long as the code is 3 would never end.
    pub(crate) fn stopped_before(&self, what: &str) -> Failure {
        let (reason, closing, shown) = (self.brake.reason(), self.closing(), self.folder.display());
        let (why, can_resume) = (reason.words(), RunFolder::at(&self.folder).has_checkpoint());
        let (message, code) = match (&reason, can_resume) {
            (Reason::Signal, _) => (format!("error: {what}\n({closing})"), 1),
            (Reason::WallTime(_), true) => {
                (format!("{what}{why} ({closing}); `agglo resume {shown}` goes on"), reason.exit_code())
            }
            (Reason::WallTime(_), false) => {
                (format!("error: {what}{why} ({closing})\nhelp: give it more, and run again"), 1)
            }
        };
        Failure::stopped(message, code, self.how(reason, None, can_resume))
    }

    /// It failed.
    pub(crate) fn failed(&self, error: impl fmt::Display, code: u8) -> Failure {
        Failure::with_code(format!("error: {error}\n({})", self.closing()), code)
    }

    fn how(&self, reason: Reason, time_s: Option<f64>, can_resume: bool) -> Stopped {
        Stopped { folder: self.folder.clone(), reason, time_s, wall_s: self.wall_s(), can_resume }
    }

    /// How long it took and how many warnings there were meanwhile.
    fn closing(&self) -> String {
        format!("{}, {}", clock(self.wall_s()), count(self.warnings))
    }

    fn wall_s(&self) -> f64 {
        self.began.elapsed().as_secs_f64()
    }

    fn begin(&mut self) {
        if !self.has_started {
            self.has_started = true;
            self.listener.started(self.verb, &self.folder);
        }
    }

    /// Takes note of warnings.
    fn note(&mut self, warnings: &[String]) {
        for warning in warnings {
            self.warnings += 1;
            if self.told.insert(warning.clone()) {
                self.held.push(warning.clone());
            }
        }
    }

    /// Tells of the warnings that were held back.
    fn release(&mut self) {
        for warning in std::mem::take(&mut self.held) {
            self.listener.warning(&warning);
        }
    }
}

/// Tells of a folder that was found finished. A kill may have come between its results and its page, which is then written.
pub(crate) fn has_finished(
    folder: &Path,
    outcome: &Outcome,
    options: &SessionOptions,
) -> Result<(), Failure> {
    let (best, page) = if folder.join(REPORT).is_file() {
        (None, Page::Unwanted)
    } else {
        Session::open("resume", folder, WallTime::of(None)?, options)?.pages(outcome)
    };
    listener(options.json).finished(&End { outcome, folder, wall_s: None, page, best })
}
