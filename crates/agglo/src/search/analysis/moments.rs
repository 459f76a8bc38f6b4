//! Mean and spread of a few numbers.

/// Mean and spread of a few numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments {
    /// How many there are.
    pub count: usize,
    /// Their mean; not a number if there are none.
    pub mean: f64,
    /// Standard deviation of one of them, with count - 1 in the denominator; 0 for a single one.
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
    /// ```
    pub fn of(numbers: &[f64]) -> Self {
        let finite = numbers.iter().copied().filter(|number| number.is_finite());
        let count = finite.clone().count();
        let mean = finite.clone().sum::<f64>() / count as f64;
        let squares: f64 = finite.map(|number| (number - mean) * (number - mean)).sum();
        let standard_deviation = if count > 1 { (squares / (count - 1) as f64).sqrt() } else { 0.0 };
        Self { count, mean, standard_deviation }
    }

    /// Standard error of the mean; 0 for a single number, whose error is not known.
    pub fn standard_error(&self) -> f64 {
        if self.count > 1 {
            (self.standard_deviation * self.standard_deviation / self.count as f64).sqrt()
        } else {
            0.0
        }
    }
}
