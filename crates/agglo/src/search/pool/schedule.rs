//! Which replicate is run next, and when a candidate has enough: no threads in it.

use std::collections::BTreeSet;

use crate::search::Ensemble;

/// What a replicate came to.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// Its quantities, one for each column of the model, and its costs.
    Quantities {
        /// One for each column of the model.
        quantities: Vec<f64>,
        /// One for each objective.
        costs: Vec<f64>,
    },
    /// It failed: the reason.
    Failed(String),
}

/// The replicates of the candidates of one batch.
///
/// Which replicates have been run depends on how fast they were; what is decided does not: a decision looks at the replicates in
/// their order, and the first that fails, or the first after which there are enough, ends the candidate.
#[derive(Debug)]
pub struct Schedule {
    ensemble: Ensemble,
    candidates: Vec<Progress>,
    /// Candidates with a replicate to be given out: those that need it for certain first, then by the number of the replicate.
    open: BTreeSet<(bool, u32, usize)>,
    undecided: usize,
}

/// How far a candidate is.
#[derive(Debug, Default)]
struct Progress {
    /// By their replicates.
    outcomes: Vec<Option<Outcome>>,
    /// The first replicate that was not given out.
    next: u32,
    /// Replicates that a decision has looked at.
    seen: u32,
    /// Costs of these, by objective.
    costs: Vec<Vec<f64>>,
    is_decided: bool,
}

impl Progress {
    fn knows(&self, replicate: u32) -> bool {
        matches!(self.outcomes.get(replicate as usize), Some(Some(_)))
    }

    /// Where it stands among the open ones; none if nothing is left to be given out.
    fn urgency(&self, candidate: usize, ensemble: &Ensemble) -> Option<(bool, u32, usize)> {
        let is_open = !self.is_decided && self.next < ensemble.most();
        let is_ahead = self.next >= ensemble.least().max(self.seen + 1);
        is_open.then_some((is_ahead, self.next, candidate))
    }

    /// Looks at what is known in the order of the replicates, as far as there is no gap.
    fn decide(&mut self, ensemble: &Ensemble) {
        while !self.is_decided {
            match self.outcomes.get(self.seen as usize) {
                Some(Some(Outcome::Quantities { costs, .. })) => {
                    self.costs.resize(costs.len(), Vec::new());
                    self.costs.iter_mut().zip(costs).for_each(|(all, cost)| all.push(*cost));
                    self.seen += 1;
                    let is_least = self.seen >= ensemble.least();
                    self.is_decided = self.seen >= ensemble.most()
                        || is_least && self.costs.iter().all(|costs| ensemble.is_enough(costs));
                }
                Some(Some(Outcome::Failed(_))) => {
                    self.seen += 1;
                    self.is_decided = true;
                }
                _ => return,
            }
        }
    }

    fn skip_known(&mut self) {
        while self.knows(self.next) {
            self.next += 1;
        }
    }
}

impl Schedule {
    /// Of so many candidates, of whose replicates nothing is known.
    pub fn new(ensemble: &Ensemble, candidates: usize) -> Self {
        let mut schedule = Self {
            ensemble: ensemble.clone(),
            candidates: (0..candidates).map(|_| Progress::default()).collect(),
            open: BTreeSet::new(),
            undecided: candidates,
        };
        for candidate in 0..candidates {
            schedule.open.extend(schedule.candidates[candidate].urgency(candidate, ensemble));
        }
        schedule
    }

    /// The most urgent replicate that was not given out: candidate and replicate.
    pub fn next(&mut self) -> Option<(usize, u32)> {
        let (_, replicate, candidate) = self.open.pop_first()?;
        let progress = &mut self.candidates[candidate];
        progress.next += 1;
        progress.skip_known();
        self.open.extend(progress.urgency(candidate, &self.ensemble));
        Some((candidate, replicate))
    }

    /// Takes down what a replicate came to; true if that decides the candidate.
    pub fn report(&mut self, candidate: usize, replicate: u32, outcome: Outcome) -> bool {
        let progress = &mut self.candidates[candidate];
        // A journal may name replicates that no ensemble comes to.
        if progress.is_decided || progress.knows(replicate) || replicate >= self.ensemble.most() {
            return false;
        }
        if let Some(urgency) = progress.urgency(candidate, &self.ensemble) {
            self.open.remove(&urgency);
        }
        let index = replicate as usize;
        if progress.outcomes.len() <= index {
            progress.outcomes.resize(index + 1, None);
        }
        progress.outcomes[index] = Some(outcome);
        progress.skip_known();
        progress.decide(&self.ensemble);
        self.open.extend(progress.urgency(candidate, &self.ensemble));
        self.undecided -= usize::from(progress.is_decided);
        progress.is_decided
    }

    /// Whether all candidates are decided.
    pub fn is_over(&self) -> bool {
        self.undecided == 0
    }

    /// How many candidates are decided.
    pub fn decided(&self) -> usize {
        self.candidates.len() - self.undecided
    }

    /// What the replicates of each candidate came to, as far as its decision looked.
    pub fn into_outcomes(self) -> Vec<Vec<Outcome>> {
        let of = |progress: Progress| {
            progress.outcomes.into_iter().take(progress.seen as usize).flatten().collect()
        };
        self.candidates.into_iter().map(of).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rng::{Purpose, Stream};
    use crate::search::{RunningMean, Until};

    fn settling() -> Ensemble {
        let until = Until::RunningMean(RunningMean { tolerance: 0.02, least: 2, most: 6 });
        Ensemble { until, common_random_numbers: false }
    }

    /// A cost that scatters; every 40th replicate fails.
    fn outcome(candidate: usize, replicate: u32) -> Outcome {
        let mut stream = Stream::new(5, Purpose::Sampling, candidate as u32);
        stream.jump_to(u64::from(replicate));
        let cost = 1.0 + stream.uniform();
        if (candidate + 7 * replicate as usize) % 40 == 39 {
            return Outcome::Failed(format!("replicate {replicate}"));
        }
        Outcome::Quantities { quantities: vec![cost], costs: vec![cost] }
    }

    /// As many workers as wanted, each replicate as long as it pleases: all of them decide the same.
    #[test]
    fn decisions_do_not_depend_on_the_order_of_arrival() {
        let decided = |workers: usize, seed: u64| {
            let mut schedule = Schedule::new(&settling(), 25);
            let mut stream = Stream::new(seed, Purpose::Sampling, 0);
            let mut running = Vec::new();
            let mut run = 0;
            while !schedule.is_over() {
                while running.len() < workers {
                    let Some(task) = schedule.next() else { break };
                    running.push(task);
                    run += 1;
                }
                let (candidate, replicate) =
                    running.remove((stream.uniform() * running.len() as f64) as usize);
                schedule.report(candidate, replicate, outcome(candidate, replicate));
            }
            (schedule.into_outcomes(), run)
        };
        let (alone, run_alone) = decided(1, 0);
        assert_eq!(run_alone, alone.iter().map(Vec::len).sum::<usize>(), "one worker runs nothing in vain");
        assert_any!(alone.iter(), |replicates| replicates.len() == 6);
        assert_any!(alone.iter(), |replicates| replicates.len() == 2);
        let failed = |replicates: &Vec<Outcome>| matches!(replicates.last(), Some(Outcome::Failed(_)));
        assert_any!(alone.iter(), failed);
        for workers in [2, 3, 40] {
            for seed in 1..6 {
                assert_eq!(decided(workers, seed).0, alone, "{workers} workers");
            }
        }
    }

    #[test]
    fn replicates_that_are_needed_go_before_those_that_may_be() {
        let mut schedule = Schedule::new(&settling(), 2);
        let order: Vec<_> = (0..6).map_while(|_| schedule.next()).collect();
        assert_eq!(order, [(0, 0), (1, 0), (0, 1), (1, 1), (0, 2), (1, 2)]);
        // Candidate 1 is undecided after its two replicates: its third, already given out, is needed; the fourth may be.
        for (replicate, cost) in [(0, 1.0), (1, 2.0)] {
            assert_false!(
                schedule.report(
                    1,
                    replicate,
                    Outcome::Quantities { quantities: vec![cost], costs: vec![cost] }
                ),
                "the search has all that it waits for"
            );
        }
        assert_eq!(schedule.next(), Some((0, 3)));
        let steady = Outcome::Quantities { quantities: vec![1.0], costs: vec![1.0] };
        assert_false!(schedule.report(0, 0, steady.clone()), "the search has all that it waits for");
        assert_true!(schedule.report(0, 1, steady), "the search has all that it waits for");
        assert_eq!(schedule.next(), Some((1, 3)), "the decided one gets no more");
    }

    #[test]
    fn known_replicates_are_not_run_again() {
        let mut schedule = Schedule::new(&Ensemble::fixed(4), 1);
        for replicate in [0, 2] {
            schedule.report(0, replicate, outcome(0, replicate));
        }
        assert_eq!([schedule.next(), schedule.next(), schedule.next()], [Some((0, 1)), Some((0, 3)), None]);
    }

    /// One that names the four billionth replicate would have room made for all before it.
    #[test]
    fn replicates_that_no_ensemble_comes_to_are_left_aside() {
        let mut schedule = Schedule::new(&Ensemble::fixed(4), 1);
        for replicate in [4, u32::MAX] {
            assert_false!(
                schedule.report(0, replicate, outcome(0, replicate)),
                "the search has all that it waits for"
            );
        }
        assert_empty!(schedule.candidates[0].outcomes);
        assert_eq!(schedule.next(), Some((0, 0)));
    }

    #[test]
    fn several_costs_must_all_be_enough() {
        let mut schedule = Schedule::new(&settling(), 1);
        let both = |a: f64, b: f64| Outcome::Quantities { quantities: vec![a, b], costs: vec![a, b] };
        assert_false!(schedule.report(0, 0, both(1.0, 1.0)), "the search has all that it waits for");
        assert_false!(schedule.report(0, 1, both(1.0, 2.0)), "the search has all that it waits for");
        assert_true!(schedule.report(0, 2, both(1.0, 1.5)), "the search has all that it waits for");
    }
}
