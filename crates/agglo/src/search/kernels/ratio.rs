//! Events over exposure, over replicates.
//!
//! # Equation
//! ```text
//! R = sum of x_i/sum of y_i
//! s² = n/(n - 1) sum of (x_i - R y_i)²/(sum of y_i)²
//! ```
//!
//! # Source
//! W. G. Cochran, *Sampling Techniques* (3rd ed., 1977), chapter 6: the ratio estimate and its standard error, without the
//! correction for finite populations.
//!
//! # Symbols
//! | symbol | name in code | unit          | meaning                                      |
//! |--------|--------------|---------------|----------------------------------------------|
//! | n      | `seen`       | 1             | replicates with any exposure                 |
//! | x_i    | `events`     | 1             | events of replicate i                        |
//! | y_i    | `exposures`  | that of rates | what they had the time for in replicate i    |
//! | R      | `value`      | 1/that        | the rate                                     |
//! | s      | `error`      | 1/that        | its standard error                           |
//!
//! # Valid when
//! The replicates are independent. R is biased by the order of 1/n, and s is itself uncertain by about 1/sqrt(2 (n - 1)) of it. It
//! holds events that come in bursts, as those of one grain that goes on growing do; 1/sqrt(events) does not. Without a single
//! event nothing is known of s; the rate is below about 3/sum of y_i then, with a confidence of 95 %.
//!
//! # Compared with others
//! The mean of the replicates' own rates gives those that saw little as much say as those that saw much, and has no value where one
//! saw nothing.
//!
//! # Example
//! ```
//! use agglo::search::kernels::ratio;
//! // 2 events in 1 s, 4 in 3 s: 6 in 4 s; the replicates are 0.5 above and below that.
//! let rate = ratio(&[2.0, 4.0], &[1.0, 3.0]);
//! assert_eq!(rate.value, Some(1.5));
//! assert_eq!(rate.error, Some((2.0 * (0.5_f64.powi(2) + 0.5_f64.powi(2))).sqrt() / 4.0));
//! ```

/// A rate over replicates, as far as there is one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ratio {
    /// All events over all exposures; none without exposure.
    pub value: Option<f64>,
    /// Its standard error; none where a single replicate had exposure, or without any event.
    pub error: Option<f64>,
}

/// The rate of events over exposures, one of each for each replicate.
pub fn ratio(events: &[f64], exposures: &[f64]) -> Ratio {
    let [all, exposed] = [events, exposures].map(|numbers| numbers.iter().sum::<f64>());
    if exposed <= 0.0 {
        return Ratio::default();
    }
    let value = all / exposed;
    let seen = exposures.iter().filter(|exposure| **exposure > 0.0).count() as f64;
    let squares: f64 = events.iter().zip(exposures).map(|(x, y)| (x - value * y).powi(2)).sum();
    let error = (seen > 1.0 && all > 0.0).then(|| (seen / (seen - 1.0) * squares).sqrt() / exposed);
    Ratio { value: Some(value), error }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rng::{Purpose, Stream};

    #[test]
    fn what_cannot_be_had_is_left_out() {
        assert_eq!(ratio(&[], &[]), Ratio::default());
        assert_eq!(ratio(&[0.0, 0.0], &[0.0, 0.0]), Ratio::default());
        assert_eq!(ratio(&[3.0], &[2.0]), Ratio { value: Some(1.5), error: None });
        // All that was seen was seen in one of them.
        assert_eq!(ratio(&[3.0, 0.0], &[2.0, 0.0]), Ratio { value: Some(1.5), error: None });
        assert_eq!(ratio(&[0.0, 0.0], &[1.0, 2.0]), Ratio { value: Some(0.0), error: None });
        // Replicates that agree to the last bit scatter by nothing.
        assert_eq!(ratio(&[2.0, 4.0], &[1.0, 2.0]), Ratio { value: Some(2.0), error: Some(0.0) });
    }

    /// Events drawn at a rate of 3, with waits of an exponential, for 1 to 2 s in each of 40 replicates; 2000 times over. The error
    /// that is told is that of the rates about 3 within 5 %: s has 1/sqrt(2 · 39) = 11 % each time, and the bias of its mean is below
    /// that over its square, 2 %; the scatter of 2000 rates is known to 1/sqrt(4000) = 1.6 %.
    #[test]
    fn the_error_is_that_of_rates_that_are_known() {
        const RATE: f64 = 3.0;
        let mut stream = Stream::new(11, Purpose::Sampling, 1);
        let (mut told, mut squares) = (0.0, 0.0);
        for _ in 0..2000 {
            let exposures: Vec<f64> = (0..40).map(|_| 1.0 + stream.uniform()).collect();
            let events: Vec<f64> = exposures
                .iter()
                .map(|exposure| {
                    let (mut time, mut count) = (0.0, -1.0);
                    while time < *exposure {
                        time -= (1.0 - stream.uniform()).ln() / RATE;
                        count += 1.0;
                    }
                    count
                })
                .collect();
            let rate = ratio(&events, &exposures);
            told += rate.error.unwrap() / 2000.0;
            squares += (rate.value.unwrap() - RATE).powi(2) / 2000.0;
        }
        assert_close!(told, squares.sqrt(), 0.05, "1/s");
    }
}
