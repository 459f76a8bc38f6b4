//! How often values fall into bins.

use serde::Serialize;

use super::Axis;

/// Bins of equal width and how many values each holds.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Histogram {
    /// What the values are.
    pub axis: Axis,
    /// Where the first bin begins and the last ends.
    pub range: [f64; 2],
    /// Values in each bin.
    pub counts: Vec<u64>,
    /// Mean of the values and its standard error, where they are known.
    pub mean: Option<[f64; 2]>,
}

impl Histogram {
    /// Bins by the rule of Freedman and Diaconis, 2 IQR/n^(1/3), at least 5 and at most 60; values that are not finite are
    /// left out.
    ///
    /// Source: D. Freedman and P. Diaconis, Z. Wahrscheinlichkeitstheorie 57, 453 (1981).
    pub fn of(axis: Axis, values: &[f64]) -> Self {
        let mut sorted: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
        sorted.sort_by(f64::total_cmp);
        let (Some(&low), Some(&high)) = (sorted.first(), sorted.last()) else {
            return Self { axis, range: [0.0, 1.0], counts: Vec::new(), mean: None };
        };
        let count = sorted.len() as f64;
        let quartile = |part: f64| sorted[(part * (count - 1.0)).round() as usize];
        let width = 2.0 * (quartile(0.75) - quartile(0.25)) / count.cbrt();
        let bins = if width > 0.0 { ((high - low) / width).ceil().clamp(5.0, 60.0) } else { 5.0 };
        let [low, high] = if high > low { [low, high] } else { [low - 0.5, high + 0.5] };
        let mut counts = vec![0_u64; bins as usize];
        for value in &sorted {
            let bin = ((value - low) / (high - low) * bins) as usize;
            counts[bin.min(bins as usize - 1)] += 1;
        }
        Self { axis, range: [low, high], counts, mean: None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_is_in_one_bin() {
        let values: Vec<f64> = (0..100).map(f64::from).chain([f64::NAN]).collect();
        let histogram = Histogram::of(Axis::new("x", ""), &values);
        assert_eq!(histogram.counts.iter().sum::<u64>(), 100);
        // Quartiles are 50 apart (index 25 and 74: 49), so bins are 2*49/100^(1/3) = 21.1 wide: 99/21.1 = 4.7, so 5.
        assert_eq!(histogram.counts, [20, 20, 20, 20, 20]);
    }

    #[test]
    fn equal_values_and_none() {
        assert_eq!(Histogram::of(Axis::default(), &[2.0; 9]).counts.iter().sum::<u64>(), 9);
        assert_empty!(Histogram::of(Axis::default(), &[]).counts);
    }
}
