//! Integrals of functions that can be worked out anywhere.
//!
//! # Equation
//! ```text
//! ∫_a^b f dx = ∫_0^1 2 (b - a) s f(a + (b - a) s²) ds
//! ```
//! by Gauss and Legendre's rule of eight points, on halves of halves until these agree with the whole to 1e-12 of the integral of
//! |f|. The substitution makes powers of half numbers at a smooth: (x - a)^(3/2) is integrated to rounding in one go.

const NODES: [f64; 4] =
    [0.183_434_642_495_649_8, 0.525_532_409_916_329, 0.796_666_477_413_626_7, 0.960_289_856_497_536_3];
const WEIGHTS: [f64; 4] =
    [0.362_683_783_378_362, 0.313_706_645_877_887_3, 0.222_381_034_453_374_48, 0.101_228_536_290_376_26];

/// Part of the integral of |f| that halves may differ by from the whole.
const TOLERANCE: f64 = 1e-12;
/// How often a part is halved at most.
const MOST_HALVED: u32 = 20;

/// The integral of a function from `a` to `b`; not a number where the function is none.
pub fn integral(f: impl Fn(f64) -> f64, a: f64, b: f64) -> f64 {
    let inner = |s: f64| 2.0 * (b - a) * s * f(a + (b - a) * s * s);
    let whole = by_rule(&inner, 0.0, 1.0);
    let size = by_rule(&|s| inner(s).abs(), 0.0, 1.0);
    by_halves(&inner, [0.0, 1.0], whole, TOLERANCE * size, MOST_HALVED)
}

fn by_rule(f: &impl Fn(f64) -> f64, a: f64, b: f64) -> f64 {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    let pair = |(node, weight): (&f64, &f64)| weight * (f(middle - half * node) + f(middle + half * node));
    half * NODES.iter().zip(&WEIGHTS).map(pair).sum::<f64>()
}

fn by_halves(f: &impl Fn(f64) -> f64, [a, b]: [f64; 2], whole: f64, tolerance: f64, left: u32) -> f64 {
    let middle = 0.5 * (a + b);
    let halves = [by_rule(f, a, middle), by_rule(f, middle, b)];
    let sum = halves[0] + halves[1];
    if left == 0 || sum.is_nan() || (sum - whole).abs() <= tolerance {
        return sum;
    }
    by_halves(f, [a, middle], halves[0], 0.5 * tolerance, left - 1)
        + by_halves(f, [middle, b], halves[1], 0.5 * tolerance, left - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Smooth functions and half powers to rounding; a kink and a third root, which have to be halved, to the tolerance.
    #[test]
    fn integrals_in_closed_form() {
        type Row = (fn(f64) -> f64, f64, f64, f64, f64);
        let rows: [Row; 6] = [
            (|x| x.powf(1.5), 0.0, 1e-6, 0.4 * 1e-15, 1e-14),
            (f64::exp, -1.0, 2.0, 2.0_f64.exp() - (-1.0_f64).exp(), 1e-14),
            (|x| 3.0 - x, 1.0, 3.0, 2.0, 1e-14),
            (f64::cbrt, 0.0, 8.0, 12.0, 1e-11),
            (|x| (x - 0.3).abs(), 0.0, 1.0, 0.5 * (0.09 + 0.49), 1e-11),
            (|x| 1.0 / (1.0 + 1e4 * x * x), -1.0, 1.0, 2e-2 * 100.0_f64.atan(), 1e-11),
        ];
        for (number, (f, a, b, wanted, part)) in rows.into_iter().enumerate() {
            let found = integral(f, a, b);
            assert!((found / wanted - 1.0).abs() < part, "{number}: {found:e} for {wanted:e}");
            assert_eq!(integral(f, a, a), 0.0);
        }
        assert_nan!(integral(f64::ln, -1.0, 1.0));
    }
}
