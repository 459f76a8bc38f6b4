//! Who survives: the best, or the first fronts and of the last one that fits in part the least crowded.

use super::Ranked;
use crate::search::optimizer::Candidate;

/// The best of one cost, best first.
pub(super) fn best(mut all: Vec<Candidate>, count: usize) -> Vec<Ranked> {
    all.sort_by(|a, b| a.fitness.compare(&b.fitness));
    all.truncate(count);
    let rank = |(front, candidate)| Ranked { candidate, front, distance: f64::INFINITY };
    all.into_iter().enumerate().map(rank).collect()
}

/// The first fronts.
pub(super) fn best_fronts(all: Vec<Candidate>, count: usize) -> Vec<Ranked> {
    let places = fronts(&all);
    let mut ranked: Vec<Ranked> = all
        .into_iter()
        .zip(places)
        .map(|(candidate, front)| Ranked { candidate, front, distance: f64::INFINITY })
        .collect();
    ranked.sort_by_key(|ranked| ranked.front);
    ranked.chunk_by_mut(|a, b| a.front == b.front).for_each(crowd);
    ranked.sort_by(Ranked::compare);
    ranked.truncate(count);
    ranked
}

/// The front of each: 0 for those that none dominates, 1 for those that only these dominate, and so on.
fn fronts(all: &[Candidate]) -> Vec<usize> {
    let dominates = |a: usize, b: usize| all[a].fitness.dominates(&all[b].fitness);
    let beaten: Vec<Vec<usize>> =
        (0..all.len()).map(|a| (0..all.len()).filter(|b| dominates(a, *b)).collect()).collect();
    let mut better = vec![0_usize; all.len()];
    beaten.iter().flatten().for_each(|b| better[*b] += 1);
    let mut places = vec![0; all.len()];
    let mut front: Vec<usize> = (0..all.len()).filter(|a| better[*a] == 0).collect();
    let mut place = 0;
    while !front.is_empty() {
        let mut next = Vec::new();
        for a in front {
            places[a] = place;
            for b in &beaten[a] {
                better[*b] -= 1;
                if better[*b] == 0 {
                    next.push(*b);
                }
            }
        }
        front = next;
        place += 1;
    }
    places
}

/// Crowding distances within a front: sum over costs of the gap between neighbors, in units of the front's extent.
fn crowd(front: &mut [Ranked]) {
    let costs = front.iter().map(|ranked| ranked.candidate.fitness.costs.len()).min().unwrap_or(0);
    for ranked in front.iter_mut() {
        ranked.distance = 0.0;
    }
    for k in 0..costs {
        let cost = |ranked: &Ranked| ranked.candidate.fitness.costs[k];
        front.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
        let last = front.len() - 1;
        let extent = cost(&front[last]) - cost(&front[0]);
        for i in 1..last {
            let gap = cost(&front[i + 1]) - cost(&front[i - 1]);
            front[i].distance += if extent > 0.0 { gap / extent } else { 0.0 };
        }
        front[0].distance = f64::INFINITY;
        front[last].distance = f64::INFINITY;
    }
}

/// The candidate nearest to the lowest of each cost, in units of the extent of all.
pub(super) fn nearest_to_ideal<'a>(front: &[&'a Candidate]) -> Option<&'a Candidate> {
    let costs = front.iter().map(|candidate| candidate.fitness.costs.len()).min()?;
    let column = |k: usize| front.iter().map(move |candidate| candidate.fitness.costs[k]);
    let lows: Vec<f64> = (0..costs).map(|k| column(k).fold(f64::INFINITY, f64::min)).collect();
    let highs: Vec<f64> = (0..costs).map(|k| column(k).fold(f64::NEG_INFINITY, f64::max)).collect();
    let distance = |candidate: &Candidate| -> f64 {
        let part = |k: usize| {
            if highs[k] > lows[k] {
                (candidate.fitness.costs[k] - lows[k]) / (highs[k] - lows[k])
            } else {
                0.0
            }
        };
        (0..costs).map(|k| part(k).powi(2)).sum()
    };
    front.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::Fitness;

    fn of(costs: [f64; 2]) -> Candidate {
        Candidate { point: vec![0.0], fitness: Fitness::new(costs.to_vec()) }
    }

    #[test]
    fn fronts_by_hand() {
        let all = [[1.0, 5.0], [2.0, 4.0], [2.0, 5.0], [3.0, 3.0], [3.0, 6.0], [4.0, 4.0]].map(of);
        assert_eq!(fronts(&all), [0, 0, 1, 0, 2, 1]);
        let mut with_failure = all.to_vec();
        with_failure.push(Candidate { point: vec![0.0], fitness: Fitness::failed() });
        assert_eq!(fronts(&with_failure).last(), Some(&3));
    }

    /// Gaps over extents of 4 and 4: (3 - 1)/4 + (5 - 2)/4 and so on.
    #[test]
    fn crowding_by_hand() {
        let ranked = best_fronts([[1.0, 5.0], [2.0, 4.0], [3.0, 2.0], [5.0, 1.0]].map(of).to_vec(), 4);
        let found: Vec<(f64, f64)> =
            ranked.iter().map(|r| (r.candidate.fitness.costs[0], r.distance)).collect();
        assert_eq!(found, [(5.0, f64::INFINITY), (1.0, f64::INFINITY), (3.0, 1.5), (2.0, 1.25)]);
    }
}
