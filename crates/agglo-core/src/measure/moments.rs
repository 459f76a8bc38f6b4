//! Moments of a quantity over the grains.
//!
//! # Equation
//! ```text
//! mean      M1 = sum(m q)/sum(m)
//! about A   Mp = sum(m (q - A)^p)/sum(m)                                        ([A] 40)
//! deviation    = sqrt(M2),  skewness = M3/M2^(3/2),  kurtosis = M4/M2^2,  all about the mean
//! ```
//!
//! # Source
//! T. I. Zohdi, Comput. Mech. 57, 465 (2016), equation 40.
//!
//! # Symbols
//! | symbol | name in code | unit        | meaning                                   |
//! |--------|--------------|-------------|-------------------------------------------|
//! | q      | `values`     | any         | the quantity, one value per grain [n]      |
//! | m      | `weights`    | any (kg)    | weights, not below zero, e.g. masses [n]   |
//! | A      | `reference`  | that of q   | what the moment is about                  |
//! | p      | `order`      | 1           | order of the moment                       |
//!
//! # Valid when
//! At least one weight is above zero. These are moments of the grains that are there, not estimates for a population
//! they were drawn from: nothing is divided by n - 1.
//!
//! # Compared with others
//! [A] uses the raw third and fourth moments; skewness and kurtosis here are normalized, so that a normal distribution
//! has 0 and 3 (not the excess). [`moment_about`] gives the raw ones.
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::measure::moments;
//! let found = moments(&[1.0, 3.0], &[1.0, 1.0]).ok_or("no weight")?;
//! assert_eq!((found.mean, found.deviation, found.skewness, found.kurtosis), (2.0, 1.0, 0.0, 1.0));
//! # Ok::<(), &str>(())
//! ```

use serde::{Deserialize, Serialize};

/// The first four moments of a quantity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Moments {
    /// Weighted mean, in the quantity's unit.
    pub mean: f64,
    /// Standard deviation, in the quantity's unit.
    pub deviation: f64,
    /// Third moment over the third power of the deviation; 0 where the deviation is 0.
    pub skewness: f64,
    /// Fourth moment over the fourth power of the deviation, 3 for a normal distribution; 0 where the deviation is 0.
    pub kurtosis: f64,
}

/// The first four moments of `values` [n] with `weights` [n]; nothing where no weight is above zero.
pub fn moments(values: &[f64], weights: &[f64]) -> Option<Moments> {
    // About the first value: a quantity that is the same for all then has exactly no deviation.
    let first = *values.first()?;
    let mean = first + moment_about(values, weights, first, 1)?;
    let second = moment_about(values, weights, mean, 2)?;
    let normalized = |order: i32| {
        let moment = moment_about(values, weights, mean, order).unwrap_or_default();
        if second > 0.0 { moment / second.sqrt().powi(order) } else { 0.0 }
    };
    Some(Moments { mean, deviation: second.sqrt(), skewness: normalized(3), kurtosis: normalized(4) })
}

/// The moment of `order` of `values` [n] with `weights` [n] about `reference`; nothing where no weight is above zero.
pub fn moment_about(values: &[f64], weights: &[f64], reference: f64, order: i32) -> Option<f64> {
    let (mut sum, mut total) = (0.0, 0.0);
    for (value, weight) in values.iter().zip(weights) {
        sum += weight * (value - reference).powi(order);
        total += weight;
    }
    (total > 0.0).then(|| sum / total)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A coin with weight p on 1 and q = 1 - p on 0: variance p q, skewness (q - p)/sqrt(p q), kurtosis
    /// 3 + (1 - 6 p q)/(p q). Round-off only.
    #[test]
    fn weighted_coin() {
        let (p, q) = (0.2, 0.8);
        let found = moments(&[1.0, 0.0, 0.0], &[2.0 * p, q, q]).unwrap();
        let variance: f64 = p * q;
        let expected =
            [p, variance.sqrt(), (q - p) / variance.sqrt(), 3.0 + (1.0 - 6.0 * variance) / variance];
        for (found, expected) in
            [found.mean, found.deviation, found.skewness, found.kurtosis].iter().zip(expected)
        {
            assert_near!(*found, expected, 1e-14);
        }
    }

    /// Evenly spaced values: kurtosis 9/5 (n² - 7/3)/(n² - 1), deviation sqrt((n² - 1)/12) spacings.
    #[test]
    fn evenly_spaced_far_from_zero() {
        let n = 1001.0_f64;
        let values: Vec<f64> = (0..1001).map(|k| 1e6 + f64::from(k)).collect();
        let found = moments(&values, &vec![0.3; 1001]).unwrap();
        // The offset of 1e6 costs nothing: all differences are exact.
        assert_near!(found.mean, 1_000_500.0, 1e-9);
        assert_close!(found.deviation, ((n * n - 1.0) / 12.0).sqrt(), 1e-13);
        assert_below!(found.skewness.abs(), 1e-12);
        assert_close!(found.kurtosis, 1.8 * (n * n - 7.0 / 3.0) / (n * n - 1.0), 1e-13);
    }

    #[test]
    fn about_a_reference() {
        // (2 (1 - 4)³ + 1 (7 - 4)³)/3 = -9
        assert_eq!(moment_about(&[1.0, 7.0], &[2.0, 1.0], 4.0, 3), Some(-9.0));
    }

    #[test]
    fn equal_values_and_no_values() {
        let same = moments(&[300.1; 7], &[0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]).unwrap();
        assert_eq!(same, Moments { mean: 300.1, ..Moments::default() });
        assert_eq!(moments(&[], &[]), None);
        assert_eq!(moments(&[1.0], &[0.0]), None);
    }
}
