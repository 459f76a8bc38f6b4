//! The part of a run that one domain works out.

use std::ops::Range;

use super::{Link, Row};
use crate::math::parallel::{self, BLOCK, Split};

/// A domain: which blocks it works out, and how it hears of the others'. Alone by default.
#[derive(Debug, Default)]
pub struct Domain {
    link: Option<Box<dyn Link>>,
}

impl Domain {
    /// One of several.
    pub fn linked(link: Box<dyn Link>) -> Self {
        Self { link: Some(link) }
    }

    /// How many there are.
    pub fn domains(&self) -> usize {
        self.link.as_ref().map_or(1, |link| link.domains())
    }

    /// Works through `range` as [`parallel::over`] does, each domain through its own leaves, and gives all of them the same result.
    /// What is written to views stays where it was written: see [`Domain::share`].
    pub fn over<S: Split, R: Row + Send>(
        &self,
        range: Range<usize>,
        leaf: usize,
        views: S,
        work: &(impl Fn(Range<usize>, S) -> R + Sync),
        join: &(impl Fn(R, R) -> R + Sync),
    ) -> R {
        let Some(link) = &self.link else { return parallel::over(range, leaf, views, work, join) };
        let leaves = range.len().div_ceil(leaf).max(1);
        let own = part_of(link.as_ref(), leaves);
        let [first, end] = [own.start, own.end].map(|at| (range.start + at * leaf).min(range.end));
        let (_, views) = views.split(&range, first);
        let (views, _) = views.split(&(first..range.end), end);
        let each = |range: Range<usize>, views: S| vec![work(range, views)];
        let both = |mut a: Vec<R>, b: Vec<R>| {
            a.extend(b);
            a
        };
        let mut message = Vec::with_capacity(own.len() * R::NUMBERS);
        if !own.is_empty() {
            for result in parallel::over(first..end, leaf, views, &each, &both) {
                result.put(&mut message);
            }
        }
        let told = link.exchange(message);
        let mut results = told.iter().flat_map(|message| message.iter().copied());
        joined(range.len(), leaf, &mut || R::taken(&mut results), join)
    }

    /// Lets all domains know what each has written of `all`: that of its own part of `leaves` leaves, which `of` finds.
    pub fn share<T: Row>(&self, all: &mut [T], leaves: usize, of: impl Fn(Range<usize>) -> Range<usize>) {
        let Some(link) = &self.link else { return };
        let mut message = Vec::new();
        for one in &all[of(part_of(link.as_ref(), leaves))] {
            one.put(&mut message);
        }
        let told = link.exchange(message);
        for (message, number) in told.iter().zip(0..).filter(|(_, number)| *number != link.number()) {
            let theirs = &mut all[of(part(leaves, number, link.domains()))];
            assert_eq!(message.len(), theirs.len() * T::NUMBERS, "domain {number} has another state");
            let mut row = message.iter().copied();
            for place in theirs {
                *place = T::taken(&mut row);
            }
        }
    }

    /// The same of a column of grains, whose leaves are blocks.
    pub fn share_grains<T: Row>(&self, column: &mut [T]) {
        let n = column.len();
        self.share(column, n.div_ceil(BLOCK), |own| (own.start * BLOCK).min(n)..(own.end * BLOCK).min(n));
    }

    /// Whether all domains have the same number.
    pub fn agree(&self, number: u64) -> bool {
        let Some(link) = &self.link else { return true };
        let halves = vec![(number >> 32) as f64, f64::from(number as u32)];
        link.exchange(halves.clone()).iter().all(|told| told[..] == halves[..])
    }
}

/// The leaves of one domain among all.
fn part_of(link: &dyn Link, leaves: usize) -> Range<usize> {
    part(leaves, link.number(), link.domains())
}

fn part(leaves: usize, number: usize, domains: usize) -> Range<usize> {
    leaves * number / domains..leaves * (number + 1) / domains
}

/// Joins the results of leaves over the tree of [`parallel::over`].
fn joined<R>(length: usize, leaf: usize, next: &mut impl FnMut() -> R, join: &impl Fn(R, R) -> R) -> R {
    if length <= leaf {
        return next();
    }
    let middle = parallel::middle(length, leaf);
    let (a, b) = (joined(middle, leaf, next, join), joined(length - middle, leaf, next, join));
    join(a, b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::link::threads;

    /// Every domain gets the sum and the squares of all numbers, with the bits that one alone has.
    #[test]
    fn sums_and_what_is_shared_have_the_bits_of_one_domain() {
        for n in [0, 1, 16, 17, 100, 1001] {
            let values: Vec<f64> = (0..n).map(|k| (f64::from(k) * 0.7).sin() * 1e3_f64.powi(k % 5)).collect();
            let found = |domain: &Domain| {
                let mut squares = vec![0.0; values.len()];
                let leaf = |range: Range<usize>, out: &mut [f64]| {
                    out.iter_mut().zip(&values[range.clone()]).for_each(|(o, v)| *o = v * v);
                    values[range].iter().sum::<f64>()
                };
                let sum = domain.over(0..values.len(), 16, squares.as_mut_slice(), &leaf, &|a, b| a + b);
                let of = |leaves: Range<usize>| 16 * leaves.start..(16 * leaves.end).min(values.len());
                domain.share(&mut squares, values.len().div_ceil(16), of);
                (sum.to_bits(), squares)
            };
            let alone = found(&Domain::default());
            for domains in [1, 2, 3, 5] {
                let found = std::thread::scope(|scope| {
                    let domains = threads(domains).into_iter().map(|link| Domain::linked(Box::new(link)));
                    let all: Vec<_> = domains.map(|domain| scope.spawn(move || found(&domain))).collect();
                    all.into_iter().map(|one| one.join().unwrap()).collect::<Vec<_>>()
                });
                assert_all!(found.iter(), |one| *one == alone);
            }
        }
    }

    #[test]
    fn domains_that_differ_do_not_agree() {
        for (numbers, is_one) in
            [([7, 7], true), ([7, 8], false), ([1 << 40, 1 << 41], false), ([u64::MAX; 2], true)]
        {
            let agreed = std::thread::scope(|scope| {
                let domains = threads(2).into_iter().map(|link| Domain::linked(Box::new(link)));
                let all: Vec<_> = domains
                    .zip(numbers)
                    .map(|(domain, number)| scope.spawn(move || domain.agree(number)))
                    .collect();
                all.into_iter().map(|one| one.join().unwrap()).collect::<Vec<_>>()
            });
            assert_eq!(agreed, [is_one; 2]);
        }
    }
}
