//! What rounding takes from a sum.

/// a + b less the double nearest to it, exactly (D. E. Knuth, *The Art of Computer Programming* 2, 4.2.2, theorem B).
///
/// ```
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
