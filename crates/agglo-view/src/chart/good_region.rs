//! What a search has narrowed down to: its best candidates, and the parameters that these pin down.

/// Candidates that the good region has at least, where there are so many.
const FEWEST: usize = 50;
/// Most parameters that are shown in pairs: with more, names and marks run into each other.
const PAIRED: usize = 6;

/// The best quarter of candidates that stand in order, the best first; at least 50, where there are so many.
pub(crate) fn good<T>(ranked: &[T]) -> &[T] {
    &ranked[..ranked.len().min((ranked.len() / 4).max(FEWEST))]
}

/// Of so many parameters those over which good candidates scatter least, in their order; no more than can be shown in pairs.
pub(crate) fn narrowed(parameters: usize, scatter: impl Fn(usize) -> f64) -> Vec<usize> {
    let mut axes: Vec<usize> = (0..parameters).collect();
    axes.sort_by(|&a, &b| scatter(a).total_cmp(&scatter(b)));
    axes.truncate(PAIRED);
    axes.sort_unstable();
    axes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_best_quarter_and_at_least_fifty() {
        let ranked: Vec<u32> = (0..400).collect();
        assert_eq!(good(&ranked), &ranked[..100]);
        assert_eq!(good(&ranked[..120]), &ranked[..50]);
        assert_eq!(good(&ranked[..7]), &ranked[..7]);
    }

    #[test]
    fn the_least_scattered_in_their_order() {
        let scatter = [9.0, 1.0, 8.0, 2.0, 7.0, 3.0, 6.0, 4.0];
        assert_eq!(narrowed(8, |axis| scatter[axis]), [1, 3, 4, 5, 6, 7]);
        assert_eq!(narrowed(3, |axis| scatter[axis]), [0, 1, 2]);
    }
}
