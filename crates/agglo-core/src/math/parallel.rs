//! Parallel loops whose results do not depend on the number of threads.
//!
//! A range is halved until its parts are small; where it is cut depends on its length alone, so sums are
//! taken over the same tree whatever thread computes which leaf. Nothing is allocated.
//!
//! Sums over grains have leaves of one [`BLOCK`]: the tree is one of blocks, whoever has which of them.

use std::ops::Range;

/// Grains per block, by their places in memory: what one leaf of a sum over grains takes.
pub const BLOCK: usize = 1024;

/// Mutable views that belong to a range of items and can be cut where the range is cut.
pub trait Split: Sized + Send {
    /// Cuts before item `at`; `range` is what the views belong to.
    fn split(self, range: &Range<usize>, at: usize) -> (Self, Self);
}

impl Split for () {
    fn split(self, _: &Range<usize>, _: usize) -> (Self, Self) {
        ((), ())
    }
}

impl<T: Send> Split for &mut [T] {
    fn split(self, range: &Range<usize>, at: usize) -> (Self, Self) {
        self.split_at_mut(at - range.start)
    }
}

impl<S: Split> Split for Option<S> {
    fn split(self, range: &Range<usize>, at: usize) -> (Self, Self) {
        self.map(|views| views.split(range, at)).unzip()
    }
}

impl<A: Split, B: Split> Split for (A, B) {
    fn split(self, range: &Range<usize>, at: usize) -> (Self, Self) {
        let (a, b) = (self.0.split(range, at), self.1.split(range, at));
        ((a.0, b.0), (a.1, b.1))
    }
}

impl<A: Split, B: Split, C: Split> Split for (A, B, C) {
    fn split(self, range: &Range<usize>, at: usize) -> (Self, Self) {
        let (a, b, c) = (self.0.split(range, at), self.1.split(range, at), self.2.split(range, at));
        ((a.0, b.0, c.0), (a.1, b.1, c.1))
    }
}

/// Works through `range` in leaves of `leaf` items, which is above zero, the last one of what is left, and joins their results
/// pairwise.
pub fn over<S: Split, R: Send>(
    range: Range<usize>,
    leaf: usize,
    views: S,
    work: &(impl Fn(Range<usize>, S) -> R + Sync),
    join: &(impl Fn(R, R) -> R + Sync),
) -> R {
    let length = range.len();
    if length <= leaf {
        return work(range, views);
    }
    let middle = range.start + middle(length, leaf);
    let (left, right) = views.split(&range, middle);
    let (a, b) = rayon::join(
        || over(range.start..middle, leaf, left, work, join),
        || over(middle..range.end, leaf, right, work, join),
    );
    join(a, b)
}

/// Where a range of so many items, more than a leaf, is cut.
pub fn middle(length: usize, leaf: usize) -> usize {
    (length / 2).next_multiple_of(leaf)
}

/// Sum over all grains of what `of` gives for the grain at a place, block by block.
pub fn sum(grains: usize, of: impl Fn(usize) -> f64 + Sync) -> f64 {
    let leaf = |range: Range<usize>, ()| range.map(&of).fold(0.0, |a, b| a + b);
    over(0..grains, BLOCK, (), &leaf, &|a, b| a + b)
}

/// Mean of a column of grains; 0 without grains.
pub fn mean(column: &[f64]) -> f64 {
    sum(column.len(), |at| column[at]) / column.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sum_on(threads: usize, values: &[f64]) -> (f64, Vec<f64>) {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut squares = vec![0.0; values.len()];
        let sum = pool.install(|| {
            over(
                0..values.len(),
                16,
                squares.as_mut_slice(),
                &|range: Range<usize>, out: &mut [f64]| {
                    out.iter_mut().zip(&values[range.clone()]).for_each(|(o, v)| *o = v * v);
                    values[range].iter().sum::<f64>()
                },
                &|a, b| a + b,
            )
        });
        (sum, squares)
    }

    #[test]
    fn leaves_are_blocks() {
        for n in [1, 15, 16, 17, 31, 33, 47, 1000] {
            let list = |range: Range<usize>, ()| vec![range];
            let leaves = over(0..n, 16, (), &list, &|mut a: Vec<Range<usize>>, b| {
                a.extend(b);
                a
            });
            let blocks = (0..n.div_ceil(16)).map(|block| 16 * block..(16 * (block + 1)).min(n));
            assert_eq!(leaves, blocks.collect::<Vec<_>>(), "{n} items");
        }
    }

    #[test]
    fn same_bits_for_any_number_of_threads() {
        for n in [0, 1, 16, 17, 33, 1000, 1001] {
            let values: Vec<f64> = (0..n).map(|k| (f64::from(k) * 0.7).sin() * 1e3_f64.powi(k % 5)).collect();
            let (one, squares) = sum_on(1, &values);
            assert_eq!(squares, values.iter().map(|v| v * v).collect::<Vec<_>>());
            for threads in [2, 7] {
                assert_eq!(sum_on(threads, &values).0.to_bits(), one.to_bits());
            }
        }
    }
}
