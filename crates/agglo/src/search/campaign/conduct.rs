//! A campaign from its first proposal to its summary, over any model.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::sync::Arc;
use std::time::{Duration, Instant};

use super::archive::{Archive, Evaluation, Stage, Status};
use super::clock::Clock;
use super::course::{Course, Results};
use super::journal::{Journal, Past};
use super::progress::CampaignObserver;
use super::proposals::Proposals;
use super::records::{Records, Replicate};
use super::summary::CampaignSummary;
use super::watch::{Now, Watch};
use super::{CampaignEnding, CampaignError};
use crate::folder::{CampaignFolder, FolderError};
use crate::record::{RecordError, atomic};
use crate::search::optimizer::{Optimizer, Point};
use crate::search::pool::{self, Finished, Halt, Outcome, Pool, Seeds, Task};
use crate::search::{Candidate, Ensemble, Fitness, Model};

/// Candidates that are evaluated at once at most: what is prepared for them is kept until all are done.
pub(super) const AT_ONCE: usize = 512;
/// A campaign of which so many candidates fail before one succeeds is given up.
const HOPELESS_FROM: u64 = 20;

/// How often tables are brought up to date for whoever looks at them meanwhile.
const FLUSH_EVERY: Duration = Duration::from_secs(1);

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
    (folder, text): (&CampaignFolder, &str),
    observer: &mut CampaignObserver<'_>,
) -> Result<CampaignEnding, CampaignError> {
    let began = Instant::now();
    let foreign = |reason| FolderError::NoCampaign { dir: folder.root().to_owned(), reason };
    let (journal, past) = Journal::open(&folder.journal(), &course.origin(text))?.map_err(foreign)?;
    let wall_before = past.wall_s;
    let wall_s = || wall_before + began.elapsed().as_secs_f64();
    let notebook = |finished: &Finished<'_>| journal.note(finished, wall_s());
    let pool = Pool::new(model, &notebook);
    let known = past.replicates.keys().next_back().map_or(0, |(evaluation, _)| *evaluation);
    let known = known.saturating_sub(course.first());
    let mut observer = |progress: &super::CampaignProgress| observer(progress);
    let sign = course.objectives.first().map(|goal| if goal.is_to_be_large { -1.0 } else { 1.0 });
    let most = Some(course.planned.iter().map(|(_, candidates)| candidates).sum()).filter(|most| *most > 0);
    let watch = Watch::new(&mut observer, began, most, known, sign).warning(folder.warning());
    let clock = Clock::new(&course, &journal, &past, &wall_s);
    let proposals = Proposals::new(&journal, course.is_led);
    let ended = std::thread::scope(|scope| {
        let _home = Home(&pool);
        for _ in 0..course.threads.max(1) {
            scope.spawn(|| pool.work());
        }
        Conductor::new(model, &course, folder, &pool, (past, clock, proposals), watch)?.all(course, &wall_s)
    });
    match ended {
        Ok(summary) => Ok(CampaignEnding::Finished(Box::new(summary))),
        Err(Stop::Asked) => Ok(CampaignEnding::Interrupted),
        Err(Stop::Failed(CampaignError::Record(error))) if !folder.can_go_on() => {
            Err(CampaignError::Gone { error, dir: folder.root().to_owned() })
        }
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

/// One session of a campaign.
pub(super) struct Conductor<'a, M: Model> {
    model: &'a M,
    pool: &'a Pool<'a, M>,
    pub(super) folder: &'a CampaignFolder,
    ensemble: Ensemble,
    fresh: Ensemble,
    /// Of the search, of the replicates that choose the best, and of those that it is reported by.
    seeds: [Seeds; 3],
    past: Past,
    clock: Clock<'a>,
    proposals: Proposals<'a>,
    /// Evaluations of the search by the bits of their values.
    evaluated: BTreeMap<Vec<u64>, u64>,
    pub(super) records: Records,
    pub(super) archive: Archive,
    pub(super) generations: u64,
    first_failure: String,
    watch: Watch<'a>,
    flushed: Instant,
}

impl<'a, M: Model> Conductor<'a, M> {
    fn new(
        model: &'a M,
        course: &Course<'_>,
        folder: &'a CampaignFolder,
        pool: &'a Pool<'a, M>,
        (past, clock, proposals): (Past, Clock<'a>, Proposals<'a>),
        watch: Watch<'a>,
    ) -> Result<Self, RecordError> {
        let Course { ensemble, seed, confirm, .. } = course;
        let fresh = Ensemble {
            common_random_numbers: ensemble.common_random_numbers,
            ..Ensemble::fixed(confirm.replicates)
        };
        let (seen, unseen, last, seed) = (ensemble.clone(), fresh.clone(), fresh.clone(), *seed);
        let chosen_by = confirm.replicates;
        let records =
            Records::create(folder.root(), &course.parameters, course.objectives.len(), model.shown())?;
        Ok(Self {
            model,
            pool,
            folder,
            ensemble: ensemble.clone(),
            fresh,
            seeds: [
                Arc::new(move |evaluation, replicate| seen.seed(seed, evaluation, replicate)),
                Arc::new(move |evaluation, replicate| unseen.fresh_seed(seed, evaluation, replicate)),
                Arc::new(move |evaluation, replicate| {
                    last.fresh_seed(seed, evaluation, replicate + chosen_by)
                }),
            ],
            past,
            clock,
            proposals,
            evaluated: BTreeMap::new(),
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
        let ended = match course.part.clone() {
            Some(part) => self.part(course, &part, wall_s),
            None => self.stages(course, wall_s),
        };
        // What is known so far is worth reading, however it ended.
        let flushed = self.records.flush();
        let summary = ended?;
        flushed?;
        Ok(summary)
    }

    fn stages(&mut self, mut course: Course<'_>, wall_s: &dyn Fn() -> f64) -> Result<CampaignSummary, Stop> {
        let mut recommended = self.ask_and_tell(Stage::Search, course.optimizer.as_mut())?;
        self.refuse_hopeless(1)?;
        let replicate =
            recommended.clone().or_else(|| self.archive.best().map(|best| best.candidate.point.clone()));
        if let Some((polish, replicate)) = course.polish.zip(replicate) {
            recommended = self.ask_and_tell(Stage::Polish, polish(&replicate).as_mut())?;
        }
        let best = self.confirm(&course, recommended)?;
        self.folder.hold_on()?;
        self.records.flush()?;
        let mut summary = self.summary(&course, best);
        let results = Results {
            folder: self.folder,
            summary: &summary,
            best: best.map(|best| &self.archive.evaluations[best.at].candidate),
            evaluations: &self.archive.evaluations,
            columns: self.model.shown(),
        };
        let (watch, pool, generations) = (&mut self.watch, self.pool, self.generations);
        let now = || Now { stage: Stage::Close, generations, decided: 0, replicates: pool.replicates() };
        if (course.closing)(&results, &mut || watch.tell(&self.archive, &now()))?.is_break() {
            return Err(Stop::Asked);
        }
        self.write_summary(&mut summary, wall_s)?;
        let journal = self.folder.journal();
        std::fs::remove_file(&journal).map_err(RecordError::file("remove", &journal))?;
        Ok(summary)
    }

    /// Writes the summary: from now on the campaign has finished.
    pub(super) fn write_summary(
        &self,
        summary: &mut CampaignSummary,
        wall_s: &dyn Fn() -> f64,
    ) -> Result<(), Stop> {
        summary.wall_s = wall_s();
        self.folder.hold_on()?;
        let text = summary.to_json();
        // What could not be read back, since a quantity is not finite, is not written.
        if let Err(error) = serde_json::from_str::<CampaignSummary>(&text) {
            let (path, reason) = (self.folder.summary(), format!("a quantity is not finite: {error}"));
            return Err(Stop::from(RecordError::Encode { path, reason }));
        }
        Ok(atomic::write(&self.folder.summary(), text.as_bytes())?)
    }

    /// Evaluates what the optimizer asks until it asks no more; returns what it recommends.
    fn ask_and_tell(&mut self, stage: Stage, optimizer: &mut dyn Optimizer) -> Result<Option<Point>, Stop> {
        loop {
            let points = optimizer.ask();
            if optimizer.has_failed() {
                return Err(Stop::Asked);
            }
            if points.is_empty() {
                return Ok(optimizer.recommended());
            }
            self.proposals.hold(&self.past, self.archive.evaluations.len() as u64, &points)?;
            let candidates = points.iter().map(|point| self.model.candidate(point)).collect();
            let fitnesses = self.generation(stage, candidates)?;
            if fitnesses.len() < points.len() {
                // The time is up; what was evaluated counts, but part of a generation teaches nothing.
                return Ok(optimizer.recommended());
            }
            optimizer.tell(&fitnesses);
            self.refuse_hopeless(HOPELESS_FROM)?;
        }
    }

    /// Evaluates candidates, writes them down, and says how good they are; the first ones only where the time is up.
    pub(super) fn generation(
        &mut self,
        stage: Stage,
        mut candidates: Vec<Candidate>,
    ) -> Result<Vec<Fitness>, Stop> {
        let first = self.archive.evaluations.len();
        while !candidates.is_empty() {
            let most = AT_ONCE.min(candidates.len());
            let count =
                if stage.is_search() { self.clock.allows(&self.archive, self.pool, most)? } else { most };
            if count == 0 {
                break;
            }
            let rest = candidates.split_off(count);
            let now = std::mem::replace(&mut candidates, rest);
            self.batch(stage, (self.archive.evaluations.len() as u64..).zip(now).collect())?;
        }
        let count = self.archive.evaluations.len() - first;
        if count > 0 {
            self.records.generation((self.generations, stage), &self.archive, count)?;
            self.generations += 1;
        }
        Ok(self.archive.evaluations[first..].iter().map(|one| one.fitness.clone()).collect())
    }

    /// Evaluates candidates with their numbers, which rise, and writes them down.
    pub(super) fn batch(&mut self, stage: Stage, candidates: Vec<(u64, Candidate)>) -> Result<(), Stop> {
        let seeds = Arc::clone(&self.seeds[family(stage)]);
        let ways: Vec<Way> =
            candidates.iter().map(|(number, candidate)| self.way(*number, stage, candidate)).collect();
        let tasks = candidates.iter().zip(&ways).filter(|(_, way)| **way == Way::Run);
        let tasks = tasks.map(|((number, candidate), _)| self.task(*number, candidate, &seeds)).collect();
        let ensemble = if stage.is_search() { &self.ensemble } else { &self.fresh };
        let (watch, archive, generations) = (&mut self.watch, &self.archive, self.generations);
        let look_up = |pool: &Pool<'_, M>| {
            let (decided, replicates) = (pool.decided(), pool.replicates());
            watch.tell(archive, &Now { stage, generations, decided, replicates })
        };
        let mut ended = self.pool.evaluate(tasks, ensemble, &seeds, look_up)?.into_iter();
        for ((number, candidate), way) in candidates.into_iter().zip(ways) {
            match way {
                Way::Repeat(earlier) => self.repeat(number, stage, candidate, earlier, &seeds)?,
                Way::Run => self.take_down(number, stage, candidate, ended.next(), &seeds)?,
                Way::Excluded => self.take_down(number, stage, candidate, None, &seeds)?,
            }
        }
        if self.flushed.elapsed() >= FLUSH_EVERY {
            self.records.flush()?;
            self.flushed = Instant::now();
        }
        let now = Now { stage, generations, decided: 0, replicates: self.pool.replicates() };
        if self.watch.tell(&self.archive, &now).is_break() { Err(Stop::Asked) } else { Ok(()) }
    }

    /// What is done with a candidate that gets this number.
    pub(super) fn way(&mut self, number: u64, stage: Stage, candidate: &Candidate) -> Way {
        if candidate.violation != 0.0 {
            return Way::Excluded;
        }
        if !stage.is_search() {
            return Way::Run;
        }
        let bits = candidate.values.iter().map(|value| value.to_bits()).collect();
        match self.evaluated.entry(bits) {
            Entry::Occupied(earlier) => Way::Repeat(*earlier.get()),
            Entry::Vacant(free) => {
                free.insert(number);
                Way::Run
            }
        }
    }

    /// Writes down a candidate whose values were evaluated before: it has what is known of them.
    fn repeat(
        &mut self,
        number: u64,
        stage: Stage,
        candidate: Candidate,
        earlier: u64,
        seeds: &Seeds,
    ) -> Result<(), RecordError> {
        let (generation, repeats) = (self.generations, Some(earlier));
        let Some(known) = self.archive.numbered(earlier).cloned() else {
            // It is in another part of the study. They are put together with what both have come to.
            self.archive.repeats += 1;
            return Ok(());
        };
        if known.status == Status::Failed {
            let reason = format!("its values are those of evaluation {earlier}, which failed");
            self.records.failure(number, 0, seeds(number, 0), &reason)?;
        }
        let evaluation = Evaluation { number, stage, generation, candidate, repeats, ..known };
        self.records.evaluation(&evaluation)?;
        self.archive.add(evaluation);
        Ok(())
    }

    /// A task with what earlier sessions know of it; another seed or other quantities would be another replicate.
    fn task(&self, evaluation: u64, candidate: &Candidate, seeds: &Seeds) -> Task {
        let columns = self.model.columns().len();
        let known = self.past.of(evaluation);
        let known = known
            .filter(|(replicate, entry)| entry.is_of(seeds(evaluation, *replicate), columns))
            .map(|(replicate, entry)| {
                (replicate, pool::outcome(self.model, candidate, entry.outcome.clone()))
            })
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
        let mut replicates = Vec::new();
        let mut costs = Vec::new();
        let mut failure = None;
        for (replicate, outcome) in (0_u32..).zip(outcomes.unwrap_or_default()) {
            let seed = seeds(number, replicate);
            match outcome {
                Outcome::Quantities { quantities, costs: of_it } => {
                    let row = Replicate { number: replicate, seed, costs: &of_it, quantities: &quantities };
                    self.records.replicate(number, &row)?;
                    costs.push(of_it);
                    replicates.push(quantities);
                }
                Outcome::Failed(reason) => failure = Some((replicate, seed, reason)),
            }
        }
        let (status, fitness) = self.judge(&candidate, is_excluded, &replicates, &mut failure);
        if let Some((replicate, seed, reason)) = &failure {
            self.records.failure(number, *replicate, *seed, reason)?;
            if self.first_failure.is_empty() {
                self.first_failure.clone_from(reason);
            }
        }
        let (generation, count) = (self.generations, replicates.len() as u32);
        let evaluation = Evaluation {
            number,
            stage,
            generation,
            candidate,
            status,
            replicates: count,
            repeats: None,
            fitness,
            quantities: replicates,
            costs,
        };
        self.records.evaluation(&evaluation)?;
        self.archive.add(evaluation);
        Ok(())
    }

    fn judge(
        &self,
        candidate: &Candidate,
        is_excluded: bool,
        replicates: &[Vec<f64>],
        failure: &mut Option<(u32, u64, String)>,
    ) -> (Status, Fitness) {
        if is_excluded {
            // How far it is from being allowed guides the search back.
            return (Status::Excluded, Fitness { violation: candidate.violation, ..Fitness::failed() });
        }
        if failure.is_some() {
            return (Status::Failed, Fitness::failed());
        }
        let mut fitness = self.model.fitness(candidate, replicates);
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

    pub(super) fn seed_of_first_replicate(&self, evaluation: &Evaluation) -> u64 {
        self.seeds[family(evaluation.stage)](evaluation.number, 0)
    }

    pub(super) fn columns(&self) -> &[String] {
        self.model.shown()
    }

    pub(super) fn candidate(&self, point: &[f64]) -> Candidate {
        self.model.candidate(point)
    }

    pub(super) fn is_out_of_time(&self) -> bool {
        self.clock.has_ended()
    }
}

/// What is done with a candidate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// It is run.
    Run,
    /// It misses a constraint between parameters.
    Excluded,
    /// Its values are those of the evaluation with this number.
    Repeat(u64),
}

/// Which of the seeds a stage has.
fn family(stage: Stage) -> usize {
    match stage {
        Stage::Search | Stage::Polish | Stage::Close => 0,
        Stage::Confirm => 1,
        Stage::Final => 2,
    }
}
