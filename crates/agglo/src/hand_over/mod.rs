//! A run handed over to the other kind of spheres: agglomerates that grew as hard spheres are taken apart into their
//! primaries, packed and bonded, for soft ones; clusters of soft spheres become one hard sphere each.
//!
//! What comes out is a scenario with the table of its grains, which is checked and run like any other, and a record of what
//! was kept and what was not: momentum, angular momentum, energy, places.

mod came_out;
mod error;
mod files;
mod lineage;
mod materials;
mod record;
mod to_hard;
mod to_soft;

use std::path::{Path, PathBuf};

pub use error::HandOverError;
pub use record::{HandOver, Motion, Packing};

use crate::engine::Start;
use crate::run::{State, state};
use crate::scenario::{Scenario, template};

/// The porosity that agglomerates are packed to, where none is given.
pub const POROSITY: f64 = 0.6;

/// How to hand over.
#[derive(Clone, Debug)]
pub struct Options<'a> {
    /// The scenario whose engine, laws and output are taken, and what it is called; its grains are replaced.
    pub with: (&'a Scenario, &'a str),
    /// Volume of the pores over that of the envelope of an agglomerate; used where soft spheres come out.
    pub porosity: f64,
    /// Seed of the packing; the scenario's if left out.
    pub seed: Option<u64>,
}

/// The state of a run that is to be handed over.
pub struct Grown {
    state: State,
    /// The folder of the run, where one was named and not a checkpoint.
    folder: Option<PathBuf>,
    shown: String,
}

impl Grown {
    /// Reads the newest state of the run in a folder, finished or not, or one of its checkpoints.
    ///
    /// # Errors
    /// [`HandOverError::Grown`] where there is none.
    pub fn read(path: &Path) -> Result<Self, HandOverError> {
        let shown = path.display().to_string();
        let state = state(path).map_err(|reason| HandOverError::Grown { path: path.to_owned(), reason })?;
        Ok(Self { state, folder: path.is_dir().then(|| path.to_owned()), shown })
    }

    /// Its grains, with what they bring along.
    pub fn start(&self) -> &Start {
        &self.state.start
    }

    /// Its scenario, with every default written out.
    pub fn scenario(&self) -> &Scenario {
        &self.state.past
    }

    /// Whether its spheres are hard, so that soft ones come out.
    pub fn is_hard(&self) -> bool {
        self.state.past.is_hard()
    }

    /// The template of the other kind of spheres that is taken where none is named.
    pub fn usual_template(&self) -> &'static str {
        if self.is_hard() { "acoustic" } else { "reacting" }
    }

    /// Writes the scenario `to`, and the tables and the record beside it.
    ///
    /// # Errors
    /// [`HandOverError`] where the two do not go together, or a file is there already or cannot be written.
    pub fn hand_over(&self, options: &Options<'_>, to: &Path) -> Result<HandOver, HandOverError> {
        let (scenario, name) = options.with;
        if scenario.is_hard() == self.is_hard() {
            let kind = if self.is_hard() { "hard" } else { "soft" };
            let (grown, usual) = (&self.shown, self.usual_template());
            return Err(HandOverError::Refused(format!(
                "{grown} is a run of {kind} spheres, and so is {name}: hand it over with a scenario of the other kind, such \
                 as {usual}; `agglo run {name} --from {grown}` goes on with spheres of the same kind"
            )));
        }
        files::refuse_existing(to)?;
        if self.is_hard() {
            to_soft::hand_over(self, options, to)
        } else {
            to_hard::hand_over(self, options, to)
        }
    }
}

/// Hands the run in the folder `grown` over: writes the scenario `to`, and the tables and the record beside it. With the
/// [usual template](Grown::usual_template) where `options` are left out.
///
/// ```no_run
/// let record = agglo::hand_over::hand_over("out/grown".as_ref(), None, "soft.toml".as_ref())?;
/// println!("{record}");
/// # Ok::<(), agglo::Error>(())
/// ```
///
/// # Errors
/// [`HandOverError`].
pub fn hand_over(grown: &Path, options: Option<&Options<'_>>, to: &Path) -> Result<HandOver, HandOverError> {
    let grown = Grown::read(grown)?;
    if let Some(options) = options {
        return grown.hand_over(options, to);
    }
    let name = grown.usual_template();
    let text = template(name).map_or("", |template| template.text);
    let scenario = Scenario::from_toml(text).map_err(HandOverError::Faults)?;
    grown.hand_over(&Options { with: (&scenario, name), porosity: POROSITY, seed: None }, to)
}
