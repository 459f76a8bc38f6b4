//! Points of which none depends on what came of another: what methods share that only sample.

use super::{Candidate, Optimizer, Point, candidates, keep_best};
use crate::search::Fitness;

/// Points in one batch; this only says how often results are seen.
const BATCH: usize = 32;

/// So many points, one after another as `next` gives them.
pub(super) struct Samples<N> {
    left: usize,
    next: N,
    asked: Vec<Point>,
    best: Option<Candidate>,
}

impl<N: FnMut() -> Point + Send> Samples<N> {
    pub(super) fn new(points: usize, next: N) -> Self {
        Self { left: points, next, asked: Vec::new(), best: None }
    }
}

impl<N: FnMut() -> Point + Send> Optimizer for Samples<N> {
    fn ask(&mut self) -> Vec<Point> {
        let count = self.left.min(BATCH);
        self.left -= count;
        self.asked = (0..count).map(|_| (self.next)()).collect();
        self.asked.clone()
    }

    fn tell(&mut self, fitnesses: &[Fitness]) {
        keep_best(&mut self.best, candidates(&mut self.asked, fitnesses));
    }

    fn recommended(&self) -> Option<Point> {
        self.best.as_ref().map(|best| best.point.clone())
    }
}
