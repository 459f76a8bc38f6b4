//! A campaign from its first proposal to its summary, over any model.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use super::archive::{Archive, Evaluation, Stage, Status};
use super::folder::Folder;
use super::journal::{Journal, Past};
use super::progress::CampaignObserver;
use super::records::{Records, Start};
use super::summary::{CampaignSummary, Goal};
use super::watch::{Now, Watch};
use super::{CampaignEnding, CampaignError};
use crate::record::{RecordError, atomic};
use crate::search::optimiser::{Optimiser, Point};
use crate::search::pool::{self, Finished, Halt, Outcome, Pool, Seeds, Task};
use crate::search::{Axis, Candidate, Confirm, Ensemble, Fitness, Model};

/// Candidates that are evaluated at once at most: what is prepared for them is kept until all are done.
const AT_ONCE: usize = 512;
/// A campaign of which so many candidates fail before one succeeds is given up.
const HOPELESS_FROM: u64 = 20;

/// How often tables are brought up to date for whoever looks at them meanwhile.
const FLUSH_EVERY: Duration = Duration::from_secs(1);

/// Begins the improvement of the best point.
pub type Polish<'a> = dyn Fn(&[f64]) -> Box<dyn Optimiser> + 'a;

/// What is done in the folder once all is evaluated, before the summary is written. It may find its own work done, and
/// it breaks off where the second argument does.
pub type Closing<'a> = dyn FnMut(&Results<'_>, &mut Ask<'_>) -> Result<ControlFlow<()>, CampaignError> + 'a;

/// Tells the observer, who may ask to stop.
pub type Ask<'a> = dyn FnMut() -> ControlFlow<()> + Send + 'a;

/// Everything of a campaign but its model.
pub struct Course<'a> {
    /// One line that says what it is.
    pub title: &'a str,
    /// Seed of the random starts.
    pub seed: u64,
    /// Worker threads; at least 1.
    pub threads: usize,
    /// The parameters, in the order of a candidate's values.
    pub parameters: Vec<Axis>,
    /// What is to be small or large.
    pub objectives: Vec<Goal>,
    /// How many random starts a candidate gets.
    pub ensemble: Ensemble,
    /// What proposes the points.
    pub optimiser: Box<dyn Optimiser>,
    /// Candidates that there will be at most, if that is known.
    pub evaluations_at_most: Option<u64>,
    /// Improves the best point at the end.
    pub polish: Option<&'a Polish<'a>>,
    /// What the best candidates are held to.
    pub confirm: Confirm,
    /// Settings that make a candidate's scenario of the base.
    pub settings: &'a dyn Fn(&Candidate) -> Vec<String>,
    /// What the evaluations say, in sentences.
    pub findings: &'a dyn Fn(&[Evaluation]) -> Vec<String>,
    /// What is done once all is evaluated.
    pub closing: &'a mut Closing<'a>,
}

/// What a campaign came to, for its closing.
pub struct Results<'a> {
    /// The campaign's folder.
    pub folder: &'a Folder,
    /// Its summary but for the wall time.
    pub summary: &'a CampaignSummary,
    /// The best candidate.
    pub best: Option<&'a Candidate>,
    /// All that was evaluated.
    pub evaluations: &'a [Evaluation],
    /// Names of the model's columns.
    pub columns: &'a [String],
}

/// Why the steps of a campaign end early.
pub(super) enum Stop {
    /// It was asked to.
    Asked,
    /// It cannot go on.
    Failed(CampaignError),
}

impl From<CampaignError> for Stop {
    fn from(error: CampaignError) -> Self {
        Self::Failed(error)
    }
}

impl From<RecordError> for Stop {
    fn from(error: RecordError) -> Self {
        Self::Failed(error.into())
    }
}

impl From<Halt> for Stop {
    fn from(halt: Halt) -> Self {
        match halt {
            Halt::Stopped => Self::Asked,
            Halt::Record(error) => error.into(),
        }
    }
}

/// Conducts a campaign, or goes on with it if its folder has a journal; `text` is what the journal must belong to.
///
/// # Errors
/// [`CampaignError`].
pub fn conduct<M: Model>(
    model: &M,
    course: Course<'_>,
    (folder, text): (&Folder, &str),
    observer: &mut CampaignObserver<'_>,
) -> Result<CampaignEnding, CampaignError> {
    let sat_down = Instant::now();
    let foreign = |reason| CampaignError::NoCampaign { dir: folder.root().to_owned(), reason };
    let (journal, past) = Journal::open(&folder.journal(), text)?.map_err(foreign)?;
    let wall_before = past.wall_s;
    let wall_s = || wall_before + sat_down.elapsed().as_secs_f64();
    let notebook = |finished: &Finished<'_>| journal.note(finished, wall_s());
    let pool = Pool::new(model, &notebook);
    let known = past.starts.keys().next_back().map_or(0, |(evaluation, _)| *evaluation);
    let mut observer = |progress: &super::CampaignProgress| observer(progress);
    let sign = if course.objectives.first().is_some_and(|goal| goal.is_to_be_large) { -1.0 } else { 1.0 };
    let watch = Watch::new(&mut observer, sat_down, course.evaluations_at_most, known, sign);
    let ended = std::thread::scope(|scope| {
        let _home = Home(&pool);
        for _ in 0..course.threads.max(1) {
            scope.spawn(|| pool.work());
        }
        Conductor::new(model, &course, folder, &pool, past, watch)?.all(course, &wall_s)
    });
    match ended {
        Ok(summary) => Ok(CampaignEnding::Finished(Box::new(summary))),
        Err(Stop::Asked) => Ok(CampaignEnding::Interrupted),
        Err(Stop::Failed(CampaignError::Record(error))) => {
            Err(CampaignError::CutShort { error, dir: folder.root().to_owned() })
        }
        Err(Stop::Failed(error)) => Err(error),
    }
}

/// Sends the workers home however the campaign ends.
struct Home<'a, 'm, M: Model>(&'a Pool<'m, M>);

impl<M: Model> Drop for Home<'_, '_, M> {
    fn drop(&mut self) {
        self.0.close();
    }
}

/// One sitting of a campaign.
pub(super) struct Conductor<'a, M: Model> {
    model: &'a M,
    pool: &'a Pool<'a, M>,
    folder: &'a Folder,
    ensemble: Ensemble,
    fresh: Ensemble,
    seeds: [Seeds; 2],
    past: Past,
    pub(super) records: Records,
    pub(super) archive: Archive,
    generations: u64,
    first_failure: String,
    watch: Watch<'a>,
    flushed: Instant,
}

impl<'a, M: Model> Conductor<'a, M> {
    fn new(
        model: &'a M,
        course: &Course<'_>,
        folder: &'a Folder,
        pool: &'a Pool<'a, M>,
        past: Past,
        watch: Watch<'a>,
    ) -> Result<Self, RecordError> {
        let Course { ensemble, seed, confirm, .. } = course;
        let fresh = Ensemble {
            common_random_numbers: ensemble.common_random_numbers,
            ..Ensemble::fixed(confirm.starts)
        };
        let (seen, unseen, seed) = (ensemble.clone(), fresh.clone(), *seed);
        let records =
            Records::create(folder.root(), &course.parameters, course.objectives.len(), model.columns())?;
        Ok(Self {
            model,
            pool,
            folder,
            ensemble: ensemble.clone(),
            fresh,
            seeds: [
                Arc::new(move |evaluation, start| seen.seed(seed, evaluation, start)),
                Arc::new(move |evaluation, start| unseen.fresh_seed(seed, evaluation, start)),
            ],
            past,
            records,
            archive: Archive::default(),
            generations: 0,
            first_failure: String::new(),
            watch,
            flushed: Instant::now(),
        })
    }

    /// Search, polish, confirmation, closing, summary.
    fn all(mut self, course: Course<'_>, wall_s: &dyn Fn() -> f64) -> Result<CampaignSummary, Stop> {
        let ended = self.stages(course, wall_s);
        // What is known so far is worth reading, however it ended.
        let flushed = self.records.flush();
        let summary = ended?;
        flushed?;
        Ok(summary)
    }

    fn stages(&mut self, mut course: Course<'_>, wall_s: &dyn Fn() -> f64) -> Result<CampaignSummary, Stop> {
        let mut recommended = self.ask_and_tell(Stage::Search, course.optimiser.as_mut())?;
        self.refuse_hopeless(1)?;
        let start =
            recommended.clone().or_else(|| self.archive.best().map(|best| best.candidate.point.clone()));
        if let Some((polish, start)) = course.polish.zip(start) {
            recommended = self.ask_and_tell(Stage::Polish, polish(&start).as_mut())?;
        }
        let best = self.confirm(&course, recommended)?;
        self.records.flush()?;
        let mut summary = self.summary(&course, best);
        let results = Results {
            folder: self.folder,
            summary: &summary,
            best: best.map(|best| &self.archive.evaluations[best.at].candidate),
            evaluations: &self.archive.evaluations,
            columns: self.model.columns(),
        };
        let (watch, pool, generations) = (&mut self.watch, self.pool, self.generations);
        let now = || Now { stage: Stage::Close, generations, decided: 0, starts: pool.starts() };
        if (course.closing)(&results, &mut || watch.tell(&self.archive, &now()))?.is_break() {
            return Err(Stop::Asked);
        }
        summary.wall_s = wall_s();
        atomic::write(&self.folder.summary(), summary.to_json().as_bytes())?;
        remove(&self.folder.journal())?;
        Ok(summary)
    }

    /// Evaluates what the optimiser asks until it asks no more; returns what it recommends.
    fn ask_and_tell(&mut self, stage: Stage, optimiser: &mut dyn Optimiser) -> Result<Option<Point>, Stop> {
        loop {
            let points = optimiser.ask();
            if points.is_empty() {
                return Ok(optimiser.recommended());
            }
            let candidates = points.iter().map(|point| self.model.candidate(point)).collect();
            let fitnesses = self.generation(stage, candidates)?;
            optimiser.tell(&fitnesses);
            self.refuse_hopeless(HOPELESS_FROM)?;
        }
    }

    /// Evaluates candidates, writes them down, and says how good they are.
    pub(super) fn generation(
        &mut self,
        stage: Stage,
        mut candidates: Vec<Candidate>,
    ) -> Result<Vec<Fitness>, Stop> {
        let count = candidates.len();
        while !candidates.is_empty() {
            let rest = candidates.split_off(AT_ONCE.min(candidates.len()));
            self.batch(stage, std::mem::replace(&mut candidates, rest))?;
        }
        self.records.generation((self.generations, stage), &self.archive, count)?;
        self.generations += 1;
        let first = self.archive.evaluations.len() - count;
        Ok(self.archive.evaluations[first..].iter().map(|one| one.fitness.clone()).collect())
    }

    fn batch(&mut self, stage: Stage, candidates: Vec<Candidate>) -> Result<(), Stop> {
        let first = self.archive.evaluations.len() as u64;
        let is_fresh = stage == Stage::Confirm;
        let seeds = Arc::clone(&self.seeds[usize::from(is_fresh)]);
        let tasks = (first..).zip(&candidates).filter(|(_, candidate)| candidate.violation == 0.0);
        let tasks = tasks.map(|(number, candidate)| self.task(number, candidate, &seeds)).collect();
        let ensemble = if is_fresh { &self.fresh } else { &self.ensemble };
        let (watch, archive, generations) = (&mut self.watch, &self.archive, self.generations);
        let look_up = |pool: &Pool<'_, M>| {
            let (decided, starts) = (pool.decided(), pool.starts());
            watch.tell(archive, &Now { stage, generations, decided, starts })
        };
        let mut ended = self.pool.evaluate(tasks, ensemble, &seeds, look_up)?.into_iter();
        for (number, candidate) in (first..).zip(candidates) {
            let is_excluded = candidate.violation != 0.0;
            let outcomes = if is_excluded { None } else { ended.next() };
            self.take_down(number, stage, candidate, outcomes, &seeds)?;
        }
        if self.flushed.elapsed() >= FLUSH_EVERY {
            self.records.flush()?;
            self.flushed = Instant::now();
        }
        let now = Now { stage, generations, decided: 0, starts: self.pool.starts() };
        if self.watch.tell(&self.archive, &now).is_break() { Err(Stop::Asked) } else { Ok(()) }
    }

    /// A task with what earlier sittings know of it; another seed would be another start.
    fn task(&self, evaluation: u64, candidate: &Candidate, seeds: &Seeds) -> Task {
        let known = self.past.of(evaluation).filter(|(start, entry)| entry.seed == seeds(evaluation, *start));
        let known = known
            .map(|(start, entry)| (start, pool::outcome(self.model, candidate, entry.outcome.clone())))
            .collect();
        Task { evaluation, candidate: candidate.clone(), known }
    }

    /// Writes an evaluation down; without outcomes it was not run.
    fn take_down(
        &mut self,
        number: u64,
        stage: Stage,
        candidate: Candidate,
        outcomes: Option<Vec<Outcome>>,
        seeds: &Seeds,
    ) -> Result<(), RecordError> {
        let is_excluded = outcomes.is_none();
        let mut starts = Vec::new();
        let mut costs = Vec::new();
        let mut failure = None;
        for (start, outcome) in (0_u32..).zip(outcomes.unwrap_or_default()) {
            let seed = seeds(number, start);
            match outcome {
                Outcome::Figures { figures, costs: of_it } => {
                    let row = Start { number: start, seed, costs: &of_it, figures: &figures };
                    self.records.start(number, &row)?;
                    costs.push(of_it);
                    starts.push(figures);
                }
                Outcome::Failed(reason) => failure = Some((start, seed, reason)),
            }
        }
        let (status, fitness) = self.judge(&candidate, is_excluded, &starts, &mut failure);
        if let Some((start, seed, reason)) = &failure {
            self.records.failure(number, *start, *seed, reason)?;
            if self.first_failure.is_empty() {
                self.first_failure.clone_from(reason);
            }
        }
        let (generation, count) = (self.generations, starts.len() as u32);
        let evaluation = Evaluation {
            number,
            stage,
            generation,
            candidate,
            status,
            starts: count,
            fitness,
            figures: starts,
            costs,
        };
        self.records.evaluation(&evaluation, self.model.columns().len())?;
        self.archive.add(evaluation);
        Ok(())
    }

    fn judge(
        &self,
        candidate: &Candidate,
        is_excluded: bool,
        starts: &[Vec<f64>],
        failure: &mut Option<(u32, u64, String)>,
    ) -> (Status, Fitness) {
        if is_excluded {
            // How far it is from being allowed guides the search back.
            return (Status::Excluded, Fitness { violation: candidate.violation, ..Fitness::failed() });
        }
        if failure.is_some() {
            return (Status::Failed, Fitness::failed());
        }
        let mut fitness = self.model.fitness(candidate, starts);
        // An empty sum is a negative zero, which would rank before the others.
        fitness.violation += 0.0;
        if fitness.violation.is_nan() || fitness.costs.iter().any(|cost| !cost.is_finite()) {
            *failure = Some((0, 0, "a limit or the mean cost is not a number".to_owned()));
            return (Status::Failed, Fitness::failed());
        }
        (if fitness.is_feasible() { Status::Ok } else { Status::Infeasible }, fitness)
    }

    /// Gives a campaign up that has not come to anything after so many failures.
    fn refuse_hopeless(&self, failures_at_least: u64) -> Result<(), Stop> {
        let Archive { evaluations, failures, excluded, .. } = &self.archive;
        let none = evaluations.len() as u64 == failures + excluded;
        let is_over = failures_at_least <= 1;
        if none && (is_over || *failures >= failures_at_least) {
            let first = match self.first_failure.as_str() {
                "" => String::new(),
                reason => format!("\nthe first one failed so: {reason}"),
            };
            let candidates = evaluations.len() as u64;
            let (failures, excluded) = (*failures, *excluded);
            return Err(CampaignError::Hopeless { candidates, failures, excluded, first }.into());
        }
        Ok(())
    }

    pub(super) fn seed_of_first_start(&self, evaluation: &Evaluation) -> u64 {
        self.seeds[usize::from(evaluation.stage == Stage::Confirm)](evaluation.number, 0)
    }

    pub(super) fn folder(&self) -> &Path {
        self.folder.root()
    }

    pub(super) fn columns(&self) -> &[String] {
        self.model.columns()
    }

    pub(super) fn candidate(&self, point: &[f64]) -> Candidate {
        self.model.candidate(point)
    }

    pub(super) fn generations(&self) -> u64 {
        self.generations
    }
}

fn remove(path: &Path) -> Result<(), RecordError> {
    std::fs::remove_file(path).map_err(RecordError::file("remove", path))
}
