//! Student's distribution: how far a mean of few values may be off.
//!
//! # Equation
//! ```text
//! θ = atan(t/√ν)
//! A(t|ν) = (2/π) {θ + sin θ [cos θ + 2/3 cos³ θ + ... + (2·4···(ν-3))/(1·3···(ν-2)) cos^(ν-2) θ]}      ν odd    (26.7.3)
//! A(t|ν) = sin θ {1 + 1/2 cos² θ + ... + (1·3···(ν-3))/(2·4···(ν-2)) cos^(ν-2) θ}                     ν even   (26.7.4)
//! ```
//! A is the probability that |T| is at most t; for ν = 1 the bracket is empty.
//!
//! # Source
//! M. Abramowitz and I. A. Stegun, *Handbook of Mathematical Functions* (1964), section 26.7.
//!
//! # Symbols
//! | symbol | name in code | unit | meaning                                     |
//! |--------|--------------|------|---------------------------------------------|
//! | t      | `t`          | 1    | deviation of a mean in its standard errors  |
//! | ν      | `freedom`    | 1    | degrees of freedom: values less one         |
//! | A      | `within`     | 1    | probability of |T| <= t                     |
//!
//! # Valid when
//! The values are independent and normally distributed. Above [`NORMAL_FROM`] degrees of freedom the correction of first
//! order to the normal quantile is used ([`quantile`] only), which is then right to 1e-6.

use std::f64::consts::FRAC_PI_2;

use crate::math::roots::root_between;

/// Degrees of freedom beyond which the exact sum gets long.
const NORMAL_FROM: u64 = 2000;

/// The probability that a mean is off by at most `t` standard errors, these found from `freedom` + 1 values.
pub(crate) fn within(t: f64, freedom: u64) -> f64 {
    if t.is_infinite() {
        return 1.0;
    }
    of_angle((t / (freedom as f64).sqrt()).atan(), freedom)
}

fn of_angle(angle: f64, freedom: u64) -> f64 {
    let (sine, cosine) = angle.sin_cos();
    let is_odd = freedom % 2 == 1;
    let mut term = if is_odd { cosine } else { 1.0 };
    let mut sum = if freedom == 1 { 0.0 } else { term };
    let mut next = if is_odd { 3 } else { 2 };
    while next <= freedom.saturating_sub(2) {
        term *= cosine * cosine * (next - 1) as f64 / next as f64;
        sum += term;
        next += 2;
    }
    if is_odd { (angle + sine * sum) / FRAC_PI_2 } else { sine * sum }
}

/// How many standard errors a mean is off by at most, with the probability `level` in (0, 1).
pub(crate) fn quantile(level: f64, freedom: u64) -> f64 {
    let exact = |freedom: u64| {
        let ends = [0.0, FRAC_PI_2];
        let root = root_between(|angle| of_angle(angle, freedom) - level, ends, [-level, 1.0 - level], 1e-15);
        root.at.tan() * (freedom as f64).sqrt()
    };
    if freedom <= NORMAL_FROM {
        return exact(freedom);
    }
    // t(ν) = z + a/ν + O(1/ν²), from the quantiles of two ν for which the sum is short (26.7.5).
    let (few, many) = (exact(NORMAL_FROM / 2), exact(NORMAL_FROM));
    let slope = (few - many) * NORMAL_FROM as f64;
    many - slope * (1.0 / NORMAL_FROM as f64 - 1.0 / freedom as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The handbook's table 26.10, which has three decimals.
    #[test]
    fn quantiles_of_the_table() {
        let table = [
            (0.95, 1, 12.706),
            (0.95, 2, 4.303),
            (0.95, 3, 3.182),
            (0.95, 10, 2.228),
            (0.95, 29, 2.045),
            (0.99, 5, 4.032),
            (0.90, 8, 1.860),
            (0.999, 120, 3.373),
            (0.95, 1_000_000, 1.960),
        ];
        for (level, freedom, wanted) in table {
            let found = quantile(level, freedom);
            // Half a unit of the last decimal.
            assert!((found - wanted).abs() < 5.1e-4, "{level} {freedom}: {found} instead of {wanted}");
        }
    }

    /// ν = 1: A = 2 atan(t)/π; ν = 2: A = t/√(2 + t²); ν = 3: A = (2/π)(atan s + s/(1 + s²)) with s = t/√3.
    #[test]
    fn closed_forms() {
        for t in [0.1_f64, 1.0, 3.5, 40.0] {
            let s = t / 3.0_f64.sqrt();
            let wanted =
                [t.atan() / FRAC_PI_2, t / (2.0 + t * t).sqrt(), (s.atan() + s / (1.0 + s * s)) / FRAC_PI_2];
            for (freedom, wanted) in (1..).zip(wanted) {
                // Round-off.
                assert!((within(t, freedom) - wanted).abs() < 1e-14, "{t} {freedom}");
            }
        }
        assert_eq!((within(0.0, 7), within(f64::INFINITY, 7)), (0.0, 1.0));
    }

    /// The normal quantile of 97.5 % is 1.959963985; the next term is (z³ + z)/4ν (26.7.5), with O(1/ν²) left out.
    #[test]
    fn many_degrees_of_freedom_join_smoothly() {
        let z = 1.959_963_985_f64;
        for freedom in [1999, 2001, 10_000, 10_000_000] {
            let wanted = z + (z * z * z + z) / (4.0 * freedom as f64);
            assert!((quantile(0.95, freedom) - wanted).abs() < 2e-6, "{freedom}");
        }
    }
}
