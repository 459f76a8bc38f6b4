//! The verb `hand-over`.

use std::path::{Path, PathBuf};

use agglo::hand_over::{Grown, HandOverError, Options};
use agglo::scenario::{Scenario, template};
use clap::Args;

use crate::failure::{Failure, shown};
use crate::print;
use crate::read::{Kind, Source};

/// What to hand over, and how.
#[derive(Args, Debug)]
pub(crate) struct HandOverOptions {
    /// The folder of the run, finished or not, or one of its checkpoints
    #[arg(value_name = "GROWN")]
    pub grown: PathBuf,
    /// The scenario to write; tables and a record are written beside it
    #[arg(short, long = "output", value_name = "FILE")]
    pub output: PathBuf,
    /// The scenario of the other kind of spheres that gives all but the grains: a file, or a template by its name; acoustic for
    /// soft spheres and reacting for hard ones if left out
    #[arg(long, value_name = "SCENARIO")]
    pub with: Option<String>,
    /// Replace a value of that scenario, such as time.end="1 s"; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub settings: Vec<String>,
    /// Pores over the whole volume of an agglomerate, 0 or more and below 1
    #[arg(long, value_name = "PART", default_value_t = agglo::hand_over::POROSITY, allow_hyphen_values = true)]
    pub porosity: f64,
    /// Seed of the packing; the scenario's if left out
    #[arg(long)]
    pub seed: Option<u64>,
}

/// Hands a run over to the other kind of spheres.
pub(crate) fn hand_over(options: &HandOverOptions) -> Result<(), Failure> {
    let grown = Grown::read(&options.grown).map_err(|error| refusal(&error))?;
    let name = options.with.as_deref().unwrap_or_else(|| grown.usual_template());
    let with = scenario(name, &options.settings)?;
    let how = Options { with: (&with, name), porosity: options.porosity, seed: options.seed };
    let record = grown.hand_over(&how, &options.output).map_err(|error| refusal(&error))?;
    let next = shown(&options.output);
    print(&format!("{record}\n`agglo check {next}` says what it would do"))
}

/// A file where there is one, else a template.
fn scenario(name: &str, settings: &[String]) -> Result<Scenario, Failure> {
    let source = match template(name).filter(|_| !Path::new(name).exists()) {
        Some(found) => Source::of_text(name, found.text),
        None => Source::read(Path::new(name))?,
    };
    source.refuse_other_kind(Kind::Scenario)?;
    source.scenario(settings)
}

fn refusal(error: &HandOverError) -> Failure {
    Failure::with_code(format!("error: {error}"), error.exit_code())
}
