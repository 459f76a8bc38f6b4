//! Worker threads that run the replicates of candidates, each replicate on one thread.
//!
//! A worker owns a rayon pool of one thread, itself, so that loops inside a simulation run inline. All workers live as
//! long as the campaign. A worker that has nothing certain to do runs further replicates of undecided candidates ahead of
//! the decision; what lies beyond the decision is dropped, so the outcome does not depend on the number of workers.

mod schedule;

use std::any::Any;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::Duration;

pub use schedule::Outcome;

use super::{Candidate, Ensemble, Model, Trouble};
use crate::record::RecordError;
use schedule::Schedule;

/// How long [`Pool::evaluate`] waits before it looks up.
const LOOK_UP_EVERY: Duration = Duration::from_millis(50);

/// A candidate to be evaluated.
#[derive(Clone, Debug)]
pub struct Task {
    /// Number of its evaluation in the campaign.
    pub evaluation: u64,
    /// What it stands for.
    pub candidate: Candidate,
    /// What its replicates are known to have come to, from an earlier session: replicate and outcome.
    pub known: Vec<(u32, Outcome)>,
}

/// A replicate that was run.
#[derive(Clone, Debug, PartialEq)]
pub struct Finished<'a> {
    /// Number of the candidate's evaluation.
    pub evaluation: u64,
    /// Number of the replicate.
    pub replicate: u32,
    /// Its seed.
    pub seed: u64,
    /// What it came to: quantities, or the reason of its failure.
    pub outcome: Result<&'a [f64], &'a str>,
}

/// Told of every replicate that was run, by the worker that ran it.
pub type Notebook<'a> = dyn Fn(&Finished<'_>) -> Result<(), RecordError> + Sync + 'a;

/// Gives the seed of a replicate from evaluation and replicate.
pub type Seeds = Arc<dyn Fn(u64, u32) -> u64 + Send + Sync>;

/// Why a batch was not evaluated to its end.
#[derive(Debug)]
pub enum Halt {
    /// It was asked to stop.
    Stopped,
    /// A replicate could not be written down.
    Record(RecordError),
}

/// Runs the replicates of batches of candidates on threads that call [`Pool::work`].
pub struct Pool<'a, M: Model> {
    model: &'a M,
    notebook: &'a Notebook<'a>,
    desk: Mutex<Desk<M::Prepared>>,
    /// There is something to be done, or nothing will ever be again.
    work: Condvar,
    /// A batch is evaluated, or cannot be.
    done: Condvar,
    /// Replicates run so far.
    replicates: AtomicU64,
}

/// What workers share.
struct Desk<P> {
    batch: Option<Batch<P>>,
    /// Number of the batch, so that a late replicate of an earlier one is known for what it is.
    number: u64,
    halt: Option<Halt>,
    is_closed: bool,
}

struct Batch<P> {
    slots: Arc<[Slot<P>]>,
    seeds: Seeds,
    schedule: Schedule,
}

/// A candidate and what its replicates share.
struct Slot<P> {
    evaluation: u64,
    candidate: Candidate,
    prepared: OnceLock<Result<P, String>>,
    /// Set once no further replicate of it is wanted.
    stop: AtomicBool,
}

/// A replicate that a worker runs.
struct Order<P> {
    batch: u64,
    slots: Arc<[Slot<P>]>,
    slot: usize,
    replicate: u32,
    seed: u64,
}

impl<'a, M: Model> Pool<'a, M> {
    /// A pool without workers.
    pub fn new(model: &'a M, notebook: &'a Notebook<'a>) -> Self {
        Self {
            model,
            notebook,
            desk: Mutex::new(Desk { batch: None, number: 0, halt: None, is_closed: false }),
            work: Condvar::new(),
            done: Condvar::new(),
            replicates: AtomicU64::new(0),
        }
    }

    /// Replicates run so far, those included that were run in vain.
    pub fn replicates(&self) -> u64 {
        self.replicates.load(Ordering::Relaxed)
    }

    /// Candidates of the batch at hand that are decided.
    pub fn decided(&self) -> u64 {
        self.desk().batch.as_ref().map_or(0, |batch| batch.schedule.decided() as u64)
    }

    /// A panic of a model is caught before it can poison the desk, and what lies on it is never half done.
    fn desk(&self) -> MutexGuard<'_, Desk<M::Prepared>> {
        self.desk.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Evaluates candidates: what the replicates of each came to, in their order, up to the one that decided.
    ///
    /// `look_up` is called now and then and may stop it.
    ///
    /// # Errors
    /// [`Halt`]; the pool is then of no further use.
    pub fn evaluate(
        &self,
        tasks: Vec<Task>,
        ensemble: &Ensemble,
        seeds: &Seeds,
        mut look_up: impl FnMut(&Self) -> ControlFlow<()>,
    ) -> Result<Vec<Vec<Outcome>>, Halt> {
        let mut schedule = Schedule::new(ensemble, tasks.len());
        let mut slots = Vec::with_capacity(tasks.len());
        for (number, Task { evaluation, candidate, known }) in tasks.into_iter().enumerate() {
            for (replicate, outcome) in known {
                schedule.report(number, replicate, outcome);
            }
            let (prepared, stop) = (OnceLock::new(), AtomicBool::new(false));
            slots.push(Slot { evaluation, candidate, prepared, stop });
        }
        let mut desk = self.desk();
        if !schedule.is_over() {
            desk.number += 1;
            desk.batch = Some(Batch { slots: slots.into(), seeds: Arc::clone(seeds), schedule });
            self.work.notify_all();
            desk = self.wait(desk, &mut look_up);
            if let Some(halt) = desk.halt.take() {
                return Err(halt);
            }
            let Some(batch) = desk.batch.take() else { return Err(Halt::Stopped) };
            schedule = batch.schedule;
        }
        drop(desk);
        Ok(schedule.into_outcomes())
    }

    /// Waits until the batch is decided or there is a reason to give up.
    fn wait<'d>(
        &'d self,
        mut desk: MutexGuard<'d, Desk<M::Prepared>>,
        look_up: &mut impl FnMut(&Self) -> ControlFlow<()>,
    ) -> MutexGuard<'d, Desk<M::Prepared>> {
        while desk.halt.is_none() && desk.batch.as_ref().is_some_and(|batch| !batch.schedule.is_over()) {
            let woken = self.done.wait_timeout(desk, LOOK_UP_EVERY).unwrap_or_else(PoisonError::into_inner);
            if !woken.1.timed_out() {
                desk = woken.0;
                continue;
            }
            drop(woken);
            let asked = look_up(self);
            desk = self.desk();
            if asked.is_break() && desk.halt.is_none() {
                desk.halt = Some(Halt::Stopped);
            }
        }
        if desk.halt.is_some()
            && let Some(batch) = &desk.batch
        {
            batch.slots.iter().for_each(|slot| slot.stop.store(true, Ordering::Relaxed));
        }
        desk
    }

    /// Sends the workers home; replicates in progress are dropped.
    pub fn close(&self) {
        let mut desk = self.desk();
        desk.is_closed = true;
        if let Some(batch) = &desk.batch {
            batch.slots.iter().for_each(|slot| slot.stop.store(true, Ordering::Relaxed));
        }
        self.work.notify_all();
    }

    /// Works until the pool is closed. The calling thread must not belong to a rayon pool.
    pub fn work(&self) {
        // Where a pool cannot be had, loops inside use the program's; that is slower and gives the same bits.
        let alone = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
        let mut desk = self.desk();
        while !desk.is_closed {
            let Some(order) = desk.next_order() else {
                desk = self.work.wait(desk).unwrap_or_else(PoisonError::into_inner);
                continue;
            };
            drop(desk);
            let outcome = self.run(&order);
            desk = self.desk();
            match outcome {
                Ok(Some(outcome)) => desk.take_down(&order, outcome),
                Ok(None) => {}
                Err(error) => desk.halt = Some(Halt::Record(error)),
            }
            if desk.halt.is_some() || desk.batch.as_ref().is_none_or(|batch| batch.schedule.is_over()) {
                self.done.notify_all();
            }
        }
        drop(desk);
        drop(alone);
    }

    /// Runs a replicate and has it written down; nothing comes of it if it was asked to stop.
    fn run(&self, order: &Order<M::Prepared>) -> Result<Option<Outcome>, RecordError> {
        let slot = &order.slots[order.slot];
        let quantities = catch_unwind(AssertUnwindSafe(|| self.quantities(slot, order.seed)));
        let quantities = match quantities {
            Ok(Err(Trouble::Stopped)) => return Ok(None),
            Ok(Err(Trouble::Failed(reason))) => Err(reason),
            Ok(Ok(quantities)) => Ok(quantities),
            Err(panic) => Err(format!("the program made an error: {}", words_of(panic.as_ref()))),
        };
        self.replicates.fetch_add(1, Ordering::Relaxed);
        let outcome = outcome(self.model, &slot.candidate, quantities);
        let told = match &outcome {
            Outcome::Quantities { quantities, .. } => Ok(quantities.as_slice()),
            Outcome::Failed(reason) => Err(reason.as_str()),
        };
        let Order { replicate, seed, .. } = *order;
        (self.notebook)(&Finished { evaluation: slot.evaluation, replicate, seed, outcome: told })?;
        Ok(Some(outcome))
    }

    fn quantities(&self, slot: &Slot<M::Prepared>, seed: u64) -> Result<Vec<f64>, Trouble> {
        match slot.prepared.get_or_init(|| self.model.prepare(&slot.candidate)) {
            Ok(prepared) => self.model.run(prepared, seed, &slot.stop),
            Err(reason) => Err(Trouble::Failed(reason.clone())),
        }
    }
}

/// What quantities, or the reason why there are none, amount to: costs that are not finite numbers are a failure.
pub fn outcome<M: Model>(model: &M, candidate: &Candidate, quantities: Result<Vec<f64>, String>) -> Outcome {
    let quantities = match quantities {
        Ok(quantities) => quantities,
        Err(reason) => return Outcome::Failed(reason),
    };
    let costs = model.costs(candidate, &quantities);
    match costs.iter().find(|cost| !cost.is_finite()) {
        None => Outcome::Quantities { quantities, costs },
        Some(cost) => Outcome::Failed(format!("its cost is {cost}")),
    }
}

impl<P> Desk<P> {
    fn next_order(&mut self) -> Option<Order<P>> {
        if self.halt.is_some() {
            return None;
        }
        let batch = self.batch.as_mut()?;
        let (slot, replicate) = batch.schedule.next()?;
        let seed = (batch.seeds)(batch.slots[slot].evaluation, replicate);
        Some(Order { batch: self.number, slots: Arc::clone(&batch.slots), slot, replicate, seed })
    }

    fn take_down(&mut self, order: &Order<P>, outcome: Outcome) {
        let Some(batch) = self.batch.as_mut().filter(|_| order.batch == self.number) else { return };
        if batch.schedule.report(order.slot, order.replicate, outcome) {
            batch.slots[order.slot].stop.store(true, Ordering::Relaxed);
        }
    }
}

fn words_of(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<&str>().copied();
    text.or_else(|| panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("it does not say which")
}

#[cfg(test)]
mod tests;
