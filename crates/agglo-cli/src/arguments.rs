//! What can be typed.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

/// Simulates how particulate agglomerates break up and disperse.
#[derive(Debug, Parser)]
#[command(name = "agglo", version, about, arg_required_else_help = true)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub verb: Verb,
}

/// The verbs.
#[derive(Debug, Subcommand)]
pub(crate) enum Verb {
    /// Print a commented scenario to start from: acoustic, acoustic-sound, microscale, reacting or reacting-published
    New {
        /// Which one
        template: String,
    },
    /// Check a scenario: all faults at once, or else the plan of the run
    Check {
        /// The scenario file
        scenario: PathBuf,
        /// Replace a value of the scenario, such as time.end="1 s"; may be repeated
        #[arg(long = "set", value_name = "KEY=VALUE")]
        settings: Vec<String>,
    },
    /// Print the page of a law, or the list of all laws
    Explain {
        /// The law's word in a scenario, such as hertz
        law: Option<String>,
    },
    /// Print the JSON schema of scenario files, for editors
    Schema,
    /// Run a scenario into a folder
    Run(Orders),
    /// Go on with a run from its newest sound checkpoint
    Resume {
        /// The run's folder
        folder: PathBuf,
        /// Number of threads; all processors if left out
        #[arg(long, value_parser = clap::value_parser!(u32).range(1..=4096))]
        threads: Option<u32>,
    },
}

/// What to run.
#[derive(Args, Debug)]
pub(crate) struct Orders {
    /// The scenario file
    pub scenario: PathBuf,
    /// Folder of the run; out/ and the scenario's name if left out
    #[arg(short, long = "output", value_name = "FOLDER")]
    pub output: Option<PathBuf>,
    /// Replace a value of the scenario, such as time.end="1 s"; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub settings: Vec<String>,
    /// Number of threads; all processors if left out
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub threads: Option<u32>,
    /// Seed of all random numbers instead of the scenario's
    #[arg(long)]
    pub seed: Option<u64>,
}
