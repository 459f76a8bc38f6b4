//! What can be typed.

use std::num::NonZeroU32;
use std::path::PathBuf;

use agglo::run::Guests;
use clap::{Args, Parser, Subcommand};

/// Simulates how particulate agglomerates grow, break up and disperse, and searches for the best conditions.
#[derive(Debug, Parser)]
#[command(name = "agglo", version, about, arg_required_else_help = true)]
#[command(
    after_help = "Exit codes: 0 done, 1 a run failed or was interrupted, 2 bad input, 3 stopped at the given wall time"
)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub verb: Verb,
}

/// The verbs.
#[derive(Debug, Subcommand)]
pub(crate) enum Verb {
    /// Print a commented scenario, search or study to start from: acoustic, reacting ...; all are listed for a wrong name
    New {
        /// Which one
        template: String,
    },
    /// Check a scenario, search or study: all faults at once, or else what it would do
    Check {
        /// The file
        scenario: PathBuf,
        /// Replace a value of the file, such as time.end="1 s"; may be repeated
        #[arg(long = "set", value_name = "KEY=VALUE")]
        settings: Vec<String>,
        /// Start from the last state of the run in this folder, or from one of its checkpoints
        #[arg(long, value_name = "FOLDER")]
        from: Option<PathBuf>,
        /// Tell programs: one JSON object on the standard output
        #[arg(long)]
        json: bool,
    },
    /// Print the page of a law or method, or a key with its unit and default; without a word the list of all pages
    Explain {
        /// A word or a path of keys: hertz, cma_es, hamaker, contact.normal
        word: Option<String>,
    },
    /// List all laws, methods and plans: words, equations, sources
    ListLaws(ListForm),
    /// Print the completions of a shell
    Completions {
        /// Which one
        shell: clap_complete::Shell,
    },
    /// Print the manual page of the program
    Man {
        /// Write it and the pages of all verbs into this folder instead
        #[arg(short, long = "output", value_name = "FOLDER")]
        output: Option<PathBuf>,
    },
    /// Print the JSON schema of scenario files, for editors
    Schema {
        /// That of searches and studies instead
        #[arg(long)]
        search: bool,
    },
    /// Run a scenario into a folder
    Run(RunOptions),
    /// Watch a run that goes on: a dashboard in the terminal, from the run's folder alone
    #[cfg(feature = "watch")]
    Watch {
        /// The folder of the run
        folder: PathBuf,
    },
    /// Search for the conditions that do something best, into a folder
    Search(CommonOptions),
    /// Study how an outcome depends on the conditions, into a folder
    Study(StudyOptions),
    /// Put the parts of a study (study --part) together into one folder, as one process would have written it
    Join(JoinOptions),
    /// Hand a run over to the other kind of spheres: a scenario in which grown grains are packed of their primaries, or clusters
    /// are one grain each
    HandOver(crate::hand_over::HandOverOptions),
    /// Draw a run: a picture, numbered pictures or a movie
    Render(Box<crate::render::RenderOptions>),
    /// Write report.html into the folder of a run, search or study: replay, charts, quantities; opens offline
    Report {
        /// The folder
        folder: PathBuf,
    },
    /// Print what to cite for the laws of a run
    Cite {
        /// The run's folder
        folder: PathBuf,
        /// As entries for BibTeX
        #[arg(long)]
        bibtex: bool,
    },
    /// Go on with a run from its newest whole checkpoint, or with a search or study
    Resume(ResumeOptions),
}

impl Verb {
    /// The number of threads that is asked for.
    pub(crate) fn threads(&self) -> Option<u32> {
        match self {
            Self::Run(options) => options.common.session.threads,
            Self::Search(options) => options.session.threads,
            Self::Study(options) => options.common.session.threads,
            Self::Join(options) => options.session.threads,
            Self::Resume(options) => options.session.threads,
            Self::Render(options) => options.threads,
            _ => None,
        }
    }

    /// Whether programs are told, and not people.
    pub(crate) fn is_json(&self) -> bool {
        match self {
            Self::Check { json, .. } => *json,
            Self::Run(options) => options.common.session.json,
            Self::Search(options) => options.session.json,
            Self::Study(options) => options.common.session.json,
            Self::Join(options) => options.session.json,
            Self::Resume(options) => options.session.json,
            _ => false,
        }
    }
}

/// What to go on with.
#[derive(Args, Debug)]
pub(crate) struct ResumeOptions {
    /// The folder
    pub folder: PathBuf,
    /// Go on to another end, such as "40 s", with a run that was stopped or has finished
    #[arg(long, value_name = "TIME")]
    pub until: Option<String>,
    #[command(flatten)]
    pub spread: SpreadOptions,
    #[command(flatten)]
    pub session: SessionOptions,
}

/// Over what a run is spread.
#[derive(Args, Debug)]
pub(crate) struct SpreadOptions {
    /// Number of domains that the soft spheres of a run are spread over, each with threads of its own; the results are the same to the
    /// last bit
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u32).range(1..=256))]
    domains: Option<u32>,
}

impl SpreadOptions {
    /// Whether there is one.
    pub(crate) fn is_given(&self) -> bool {
        self.domains.is_some()
    }

    /// What takes part in the run.
    pub(crate) fn guests(&self) -> Guests<'static> {
        Guests { domains: self.domains.and_then(NonZeroU32::new), ..Guests::default() }
    }
}

/// How a run, search or study is carried on.
#[derive(Args, Debug)]
pub(crate) struct SessionOptions {
    /// Number of threads; all processors if left out
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub threads: Option<u32>,
    /// Stop after so long on the clock, such as "2 h" or "90 s", with all that is needed to resume; the exit code is then 3
    #[arg(long, value_name = "DURATION", allow_hyphen_values = true)]
    pub wall_time: Option<String>,
    /// Write no report.html at the end
    #[arg(long)]
    pub no_report: bool,
    /// Tell programs: one JSON object a line on the standard output, and nothing else there
    #[arg(long)]
    pub json: bool,
}

/// What to run, and what to see meanwhile.
#[derive(Args, Debug)]
pub(crate) struct RunOptions {
    #[command(flatten)]
    pub common: CommonOptions,
    #[command(flatten)]
    pub spread: SpreadOptions,
    /// Start from the last state of the run in this folder, or from one of its checkpoints
    #[arg(long, value_name = "FOLDER")]
    pub from: Option<PathBuf>,
    /// Show a dashboard in the terminal meanwhile, as `agglo watch` does
    #[cfg(feature = "watch")]
    #[arg(long, conflicts_with = "json")]
    pub watch: bool,
}

/// What to study.
#[derive(Args, Debug)]
pub(crate) struct StudyOptions {
    #[command(flatten)]
    pub common: CommonOptions,
    /// Run one part of all evaluations, such as 3/16, into a folder of its own; `agglo join` makes the whole of all of them
    #[arg(long, value_name = "NUMBER/PARTS", allow_hyphen_values = true)]
    pub part: Option<String>,
}

/// What to put together.
#[derive(Args, Debug)]
pub(crate) struct JoinOptions {
    /// The folders of all parts, in any order
    #[arg(value_name = "FOLDER", required = true)]
    pub parts: Vec<PathBuf>,
    /// Folder of the whole study
    #[arg(short, long = "output", value_name = "FOLDER")]
    pub output: PathBuf,
    #[command(flatten)]
    pub session: SessionOptions,
}

/// How to print the list of laws.
#[derive(Args, Clone, Copy, Debug)]
#[group(multiple = false)]
pub(crate) struct ListForm {
    /// As a table in Markdown
    #[arg(long)]
    pub markdown: bool,
    /// As JSON
    #[arg(long)]
    pub json: bool,
    /// The whole pages one after another, in Markdown
    #[arg(long)]
    pub pages: bool,
}

/// What to run, search or study.
#[derive(Args, Debug)]
pub(crate) struct CommonOptions {
    /// The file
    #[arg(value_name = "FILE")]
    pub scenario: PathBuf,
    /// Folder of the results; out/ and the file's name if left out
    #[arg(short, long = "output", value_name = "FOLDER")]
    pub output: Option<PathBuf>,
    /// Replace a value of the file, such as time.end="1 s"; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub settings: Vec<String>,
    #[command(flatten)]
    pub session: SessionOptions,
    /// Seed of all random numbers instead of the file's
    #[arg(long)]
    pub seed: Option<u64>,
}
