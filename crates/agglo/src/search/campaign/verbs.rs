//! The verbs that the terminal and Python share: conduct a search or study of scenarios, go on with it.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::archive::Stage;
use super::conduct::conduct;
use super::course::{Ask, Course, Polish, Results};
use super::part::Part;
use super::progress::CampaignObserver;
use super::summary::Goal;
use super::{CampaignEnding, CampaignError, Draw, kernels, pictures};
use crate::engine::SimError;
use crate::folder::{CampaignFolder, FolderError, names};
use crate::record::{RecordError, door};
use crate::run::{self, Ending, RunError};
use crate::scenario::{LoadError, Scenario};
use crate::search::optimizer::{Method, NelderMead, Optimizer};
use crate::search::{Base, Campaign, Confirm, Here, Problem, Range, Runner, Scalar};

/// By whom and how a campaign is conducted. What it comes to is the same to the last bit, whoever runs its simulations.
#[derive(Default)]
pub struct Means<'a> {
    /// How many simulations are under way at once; at least 1.
    pub threads: usize,
    /// Draws what it comes to; without one there are no pictures.
    pub draw: Option<&'a Draw<'a>>,
    /// Runs the simulations; without one they run on threads of this process.
    pub runner: Option<Arc<dyn Runner>>,
    /// Says which points are tried, where the campaign's method is [`External`](crate::search::optimizer::External).
    pub proposer: Option<Box<dyn Optimizer>>,
}

impl Means<'_> {
    /// So many threads of this process, and no pictures.
    pub fn threads(threads: usize) -> Self {
        Self { threads, ..Self::default() }
    }
}

/// Conducts a campaign in the folder `dir`; `base` is the folder that its files are relative to.
///
/// # Errors
/// [`CampaignError`] where the folder is in use, nothing can be evaluated, or a file cannot be written.
pub fn run(
    campaign: &Campaign,
    base: &Path,
    dir: &Path,
    means: Means<'_>,
    observer: &mut CampaignObserver<'_>,
) -> Result<CampaignEnding, CampaignError> {
    refuse_without_proposer(campaign, &means)?;
    let folder = begin(campaign, base, dir, means.threads, None)?;
    go_on(&folder, means, observer)
}

/// Runs a part of a study into a folder of its own; the rest is as in [`run`]. [`join`](super::join) makes the whole of all
/// parts.
///
/// # Errors
/// As [`run`]; [`CampaignError::Parts`] where the study has not so many evaluations, or it is a search.
pub fn run_part(
    campaign: &Campaign,
    base: &Path,
    (dir, part): (&Path, Part),
    means: Means<'_>,
    observer: &mut CampaignObserver<'_>,
) -> Result<CampaignEnding, CampaignError> {
    let folder = begin(campaign, base, dir, means.threads, Some(part))?;
    go_on(&folder, means, observer)
}

/// Refuses a campaign whose points come from a program outside where there is none, before anything is written.
fn refuse_without_proposer(campaign: &Campaign, means: &Means<'_>) -> Result<(), CampaignError> {
    let is_external = matches!(campaign.method, Some(Method::External(_)));
    match &means.proposer {
        None if is_external => Err(CampaignError::NoProposer),
        Some(_) if !is_external => {
            let (way, word) = way_of(campaign);
            Err(CampaignError::OwnMethod { found: format!("{way}.{word}") })
        }
        _ => Ok(()),
    }
}

/// Puts all that a campaign, or a part of it, needs into its folder.
fn begin(
    campaign: &Campaign,
    base: &Path,
    dir: &Path,
    threads: usize,
    part: Option<Part>,
) -> Result<CampaignFolder, CampaignError> {
    let problem = Problem::new(campaign, base)?;
    refuse_too_large(&problem, threads)?;
    if let Some(part) = part {
        own(part, campaign, &problem).map_err(CampaignError::Parts)?;
    }
    let head = |what: &str| {
        format!("# {what} of agglo {}: every default is written out.\n", env!("CARGO_PKG_VERSION"))
    };
    let own = Base::File(names::SCENARIO.to_owned());
    let resolved = Campaign { base: own, settings: Vec::new(), ..campaign.clone() };
    let folder = CampaignFolder::create(dir)?;
    let (scenario, resolved) = with_tables(&folder, &problem, resolved)?;
    let scenario = head("Scenario that is varied by a search or study") + &scenario.to_toml()?;
    let campaign = head("Resolved search or study") + &resolved.to_toml()?;
    if let Some(part) = part {
        part.write(&folder)?;
    }
    folder.put(&campaign, &scenario)?;
    Ok(folder)
}

/// Numbers of the evaluations of a part.
fn own(part: Part, campaign: &Campaign, problem: &Problem) -> Result<std::ops::Range<u64>, String> {
    let Some(plan) = &campaign.plan else {
        return Err("a search has no parts: what it tries depends on what it has found".to_owned());
    };
    part.range(plan.evaluations(&levels(problem)))
}

/// Refuses simulations that the memory cannot hold, so many at a time as there are threads.
///
/// # Errors
/// [`CampaignError::TooLarge`] with the numbers.
pub fn refuse_too_large(problem: &Problem, threads: usize) -> Result<(), CampaignError> {
    let refused = crate::forecast::refuse_quiet(problem.base(), problem.folder(), threads);
    refused.map_err(CampaignError::TooLarge)
}

/// Takes the tables of grains into the folder, those of the scenario and those that parameters choose from.
fn with_tables(
    folder: &CampaignFolder,
    problem: &Problem,
    mut campaign: Campaign,
) -> Result<(Scenario, Campaign), FolderError> {
    let (mut tables, base) = (folder.tables(), problem.folder());
    let scenario = tables.adopt_all(problem.base(), base)?;
    for parameter in &mut campaign.parameters {
        let key = parameter.key.as_deref().unwrap_or_default();
        let is_table = key.ends_with(".placement.table.file") || key == "start.bonds";
        let is_state = key == "start.from";
        let Range::Choices(choices) = &mut parameter.range else { continue };
        for choice in choices.iter_mut().filter(|_| is_table || is_state) {
            if let Scalar::Text(file) = choice {
                let path = base.join(&*file);
                let place = if is_state { tables.adopt_state(&path)? } else { tables.adopt(&path)? };
                *file = place.to_string_lossy().into_owned();
            }
        }
    }
    Ok((scenario, campaign))
}

/// Goes on with the campaign in `dir`, by whatever means.
///
/// A campaign that has finished is left as it is, and its summary given again.
///
/// # Errors
/// [`CampaignError`] where there is no campaign, or a file cannot be written.
pub fn resume(
    dir: &Path,
    means: Means<'_>,
    observer: &mut CampaignObserver<'_>,
) -> Result<CampaignEnding, CampaignError> {
    let finished = || super::finished(dir).map(|summary| CampaignEnding::Finished(Box::new(summary)));
    if let Some(ending) = finished() {
        return Ok(ending);
    }
    let folder = CampaignFolder::take(dir)?;
    // Another process may have finished it in between.
    match finished() {
        Some(ending) => Ok(ending),
        None => go_on(&folder, means, observer),
    }
}

/// Goes on with the campaign in a folder whose lock is held.
pub(super) fn go_on(
    folder: &CampaignFolder,
    means: Means<'_>,
    observer: &mut CampaignObserver<'_>,
) -> Result<CampaignEnding, CampaignError> {
    let dir = folder.root();
    let text = text_of(folder)?;
    let unreadable = |error: LoadError| {
        let reason = format!("its {} cannot be read: {error}", names::CAMPAIGN);
        FolderError::NoCampaign { dir: dir.to_owned(), reason }
    };
    let campaign = Campaign::load(&folder.campaign()).map_err(unreadable)?;
    refuse_without_proposer(&campaign, &means)?;
    let Means { threads, draw, runner, proposer } = means;
    let problem = Problem::new(&campaign, dir)?.run_by(runner.unwrap_or_else(|| Arc::new(Here)));
    let no_part = |reason| FolderError::NoCampaign { dir: dir.to_owned(), reason };
    let part = match Part::read(folder)? {
        Some(part) => Some((part, own(part, &campaign, &problem).map_err(no_part)?)),
        None => None,
    };
    let of_part = part.as_ref().map(|(_, own)| vec![(Stage::Search, own.end - own.start)]);
    let is_search = campaign.plan.is_none();
    let polish = |point: &[f64]| -> Box<dyn Optimizer> {
        let simplex = campaign.polish.clone().unwrap_or_default();
        Box::new(NelderMead { start: point.to_vec(), ..simplex }.start(point.len()))
    };
    let course = Course {
        title: &campaign.title,
        seed: campaign.seed,
        is_study: !is_search,
        part,
        threads,
        parameters: problem.axes().to_vec(),
        objectives: problem.objectives().map(|(formula, large)| goal(formula, large)).collect(),
        ensemble: campaign.ensemble.clone(),
        function: problem.function().map(str::to_owned),
        is_led: proposer.is_some(),
        optimizer: optimizer(&campaign, &problem, proposer)?,
        planned: of_part.unwrap_or_else(|| planned(&campaign, &problem)),
        budget_s: campaign.budget.as_ref().map(|budget| budget.time.si()),
        polish: campaign.polish.as_ref().map(|_| &polish as &Polish<'_>),
        confirm: if is_search { campaign.confirm } else { Confirm { candidates: 0, replicates: 0 } },
        settings: &|candidate| problem.settings(candidate),
        limits: &|evaluation| problem.limits_of(&evaluation.candidate, &evaluation.quantities),
        findings: &|known| pictures::findings(&campaign, &problem, known),
        closing: &mut |results, ask| {
            pictures::clear(&results.folder.pictures())?;
            pictures::write(&campaign, &problem, results, draw)?;
            kernels::write(results.folder, &problem, results.evaluations)?;
            if is_search { run_best(&problem, results, ask) } else { Ok(ControlFlow::Continue(())) }
        },
    };
    conduct(&problem, course, (folder, &text), observer)
}

/// What the journal of the campaign in a folder belongs to.
pub(super) fn text_of(folder: &CampaignFolder) -> Result<String, RecordError> {
    let read = |path: PathBuf| {
        door::read_text(&path, door::MOST_OF_A_TEXT).map_err(RecordError::file("read", &path))
    };
    Ok(read(folder.campaign())? + &read(folder.scenario())? + &folder.told_of_tables()?)
}

fn goal(formula: &str, is_to_be_large: bool) -> Goal {
    Goal { formula: formula.to_owned(), is_to_be_large }
}

/// Runs the best candidate with frames, from the first of its replicates that count.
fn run_best(
    problem: &Problem,
    results: &Results<'_>,
    ask: &mut Ask<'_>,
) -> Result<ControlFlow<()>, CampaignError> {
    let Some((candidate, best)) = results.best.zip(results.summary.best.as_ref()) else {
        return Ok(ControlFlow::Continue(()));
    };
    let dir = results.folder.best();
    if run::finished(&dir).is_some() {
        return Ok(ControlFlow::Continue(()));
    }
    if dir.exists() {
        // What a killed session left; the run is no longer than any other of the campaign.
        std::fs::remove_dir_all(&dir).map_err(RecordError::file("remove", &dir))?;
    }
    let scenario = Scenario { seed: best.replicate_seed, ..problem.scenario(candidate)? };
    match run::run(&scenario, problem.folder(), &dir, &mut |_| ask()) {
        Ok(Ending::Finished(_)) => Ok(ControlFlow::Continue(())),
        Ok(Ending::Interrupted(_))
        | Err(RunError::StoppedBefore(_) | RunError::Start(SimError::StoppedAtRest)) => {
            Ok(ControlFlow::Break(()))
        }
        Err(error) => Err(error.into()),
    }
}

fn levels(problem: &Problem) -> Vec<Option<usize>> {
    problem.axes().iter().map(|axis| axis.scale.levels()).collect()
}

/// What proposes the points of a search or study; its file has been checked.
fn optimizer(
    campaign: &Campaign,
    problem: &Problem,
    proposer: Option<Box<dyn Optimizer>>,
) -> Result<Box<dyn Optimizer>, CampaignError> {
    if let Some(plan) = &campaign.plan {
        return Ok(plan.start(&levels(problem), campaign.seed));
    }
    let method = campaign.method.clone().unwrap_or_default();
    let led = match (&method, proposer) {
        (Method::External(external), Some(proposer)) => Some(external.led_by(proposer)),
        _ => method.start(problem.axes().len(), campaign.objectives.len(), campaign.seed),
    };
    led.ok_or(CampaignError::NoProposer)
}

/// Candidates that each stage of a search or study is allowed.
pub fn planned(campaign: &Campaign, problem: &Problem) -> Vec<(Stage, u64)> {
    if let Some(plan) = &campaign.plan {
        return vec![(Stage::Search, plan.evaluations(&levels(problem)))];
    }
    let searched = campaign.method.as_ref().map_or(0, Method::evaluations) as u64;
    let polished = campaign.polish.as_ref().map_or(0, |polish| polish.evaluations) as u64;
    let Confirm { candidates, replicates } = campaign.confirm;
    let confirmed = if replicates > 0 { u64::from(candidates) } else { 0 };
    // Where there is a choice, the one that was chosen is run once more.
    let last = u64::from(confirmed > 1);
    let all = [
        (Stage::Search, searched),
        (Stage::Polish, polished),
        (Stage::Confirm, confirmed),
        (Stage::Final, last),
    ];
    all.into_iter().filter(|(_, candidates)| *candidates > 0).collect()
}

/// How the points are chosen, in words: "method" or "plan" and its name in the file.
pub fn way_of(campaign: &Campaign) -> (&'static str, String) {
    if let Some(plan) = &campaign.plan {
        return ("plan", plan.word().to_owned());
    }
    // A method is written as a table whose only key is its name.
    let tree = serde_json::to_value(&campaign.method).unwrap_or_default();
    let name = tree.as_object().and_then(|table| table.keys().next().cloned());
    ("method", name.unwrap_or_default())
}
