//! What rounding takes from a sum, and sums that give it back.

use serde::{Deserialize, Serialize};

/// a + b less the double nearest to it, exactly (D. E. Knuth, *The Art of Computer Programming* 2, 4.2.2, theorem B).
///
/// ```
/// # extern crate agglo_core as agglo;
/// use agglo::math::rounding_of_sum;
/// assert_eq!(rounding_of_sum(1.0, 1e-20), 1e-20);
/// assert_eq!(rounding_of_sum(0.5, 0.25), 0.0);
/// ```
#[inline]
pub fn rounding_of_sum(a: f64, b: f64) -> f64 {
    let sum = a + b;
    let b_taken = sum - a;
    (a - (sum - b_taken)) + (b - b_taken)
}

/// A sum that keeps what rounding leaves out for the next part (W. Kahan, Commun. ACM 8, 40 (1965)).
///
/// ```
/// # extern crate agglo_core as agglo;
/// use agglo::math::Sum;
/// let mut sum = Sum::from(1.0);
/// (0..1000).for_each(|_| sum.add(1e-18));
/// assert_eq!(sum.value(), 1.0 + 1e-15);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sum {
    value: f64,
    left_out: f64,
}

impl Sum {
    /// Adds a part.
    #[inline]
    pub fn add(&mut self, part: f64) {
        let part = part + self.left_out;
        let before = self.value;
        self.value = before + part;
        self.left_out = part - (self.value - before);
    }

    /// The sum.
    #[inline]
    pub fn value(self) -> f64 {
        self.value
    }
}

impl From<f64> for Sum {
    fn from(value: f64) -> Self {
        Self { value, left_out: 0.0 }
    }
}
