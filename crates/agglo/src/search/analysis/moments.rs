//! Mean and spread of a few numbers.

/// Numbers that differ by no more than this part of the largest of them are the same: round-off makes as much.
pub const ROUND_OFF: f64 = 1e-12;

/// Mean and spread of a few numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments {
    /// How many there are.
    pub count: usize,
    /// Their mean; not a number if there are none.
    pub mean: f64,
    /// Standard deviation of one of them, with count - 1 in the denominator; not a number for fewer than two.
    pub standard_deviation: f64,
}

impl Moments {
    /// Of these numbers; those that are not finite are left out.
    /// ```
    /// use agglo::search::analysis::Moments;
    /// let moments = Moments::of(&[1.0, 2.0, 6.0]);
    /// // Squares of the deviations: 4 + 1 + 9 = 14, over 2.
    /// assert_eq!((moments.mean, moments.standard_deviation), (3.0, 7.0_f64.sqrt()));
    /// assert_eq!(moments.standard_error(), (7.0_f64 / 3.0).sqrt());
    /// assert!(Moments::of(&[1.0]).standard_error().is_nan(), "one number does not tell how it scatters");
    /// ```
    pub fn of(numbers: &[f64]) -> Self {
        let finite = numbers.iter().copied().filter(|number| number.is_finite());
        let count = finite.clone().count();
        let mean = finite.clone().sum::<f64>() / count as f64;
        let squares: f64 = finite.map(|number| (number - mean) * (number - mean)).sum();
        let standard_deviation = if count > 1 { (squares / (count - 1) as f64).sqrt() } else { f64::NAN };
        Self { count, mean, standard_deviation }
    }

    /// Standard error of the mean; not a number for fewer than two numbers.
    pub fn standard_error(&self) -> f64 {
        (self.standard_deviation * self.standard_deviation / self.count as f64).sqrt()
    }
}

/// Whether numbers differ by more than round-off makes; no if there are none.
/// ```
/// use agglo::search::analysis::varies;
/// assert!(varies([192.53, 192.54]));
/// assert!(!varies([192.53, 192.53 + 3e-14]) && !varies([0.0; 4]));
/// ```
pub fn varies(numbers: impl IntoIterator<Item = f64>) -> bool {
    let mut ends = [f64::INFINITY, f64::NEG_INFINITY];
    for number in numbers {
        ends = [ends[0].min(number), ends[1].max(number)];
    }
    ends[1] - ends[0] > ROUND_OFF * ends[0].abs().max(ends[1].abs())
}
