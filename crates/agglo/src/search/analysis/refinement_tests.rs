//! Orders, limits and verdicts against sequences of known order and scatter.

use super::*;
use crate::math::rng::{Purpose, Stream};

fn exact(levels: &[(f64, f64)]) -> Vec<Level> {
    levels.iter().map(|&(size, mean)| Level { size, replicates: vec![mean] }).collect()
}

/// Two replicates that are `error` off their mean have the standard error `error`: √2 error/√2.
fn uncertain(size: f64, mean: f64, error: f64) -> Level {
    Level { size, replicates: vec![mean - error, mean + error] }
}

/// f = 3 - 2 h^p gives p and 3 for any order and any ratios. Round-off in the differences of f is 1e-15/(h^p) at the
/// finest level, which is 1e-12 in the order at worst.
#[test]
fn power_laws_give_their_order_and_limit() {
    for order in [0.5, 1.0, 1.7, 2.0, 4.0] {
        for sizes in [[0.8, 0.4, 0.2, 0.1], [0.8, 0.5, 0.3, 0.2], [0.81, 0.27, 0.2, 0.15]] {
            let levels = exact(&sizes.map(|h: f64| (h, 3.0 - 2.0 * h.powf(order))));
            let Convergence::Converging(found) = observed_order(&levels, Replicates::Own) else {
                panic!("{order}: {levels:?}")
            };
            assert!((found.order - order).abs() < 1e-11, "{found:?}");
            assert!((found.limit - 3.0).abs() < 1e-11, "{found:?}");
            assert_eq!(found.is_asymptotic, Some(true));
            // The index is 1.25 times the error that is left.
            assert!((found.uncertainty - 1.25 * 2.0 * sizes[3].powf(order)).abs() < 1e-10, "{found:?}");
        }
    }
}

#[test]
fn other_sequences_are_named() {
    let of = |means: &[f64]| {
        let levels: Vec<_> =
            means.iter().enumerate().map(|(k, &mean)| (0.5_f64.powf(k as f64), mean)).collect();
        observed_order(&exact(&levels), Replicates::Own)
    };
    assert_eq!(of(&[1.0, 2.0]), Convergence::TooFewLevels);
    assert_eq!(of(&[1.0, 2.0, 1.5]), Convergence::Oscillating);
    assert_eq!(of(&[1.0, 2.0, 4.0]), Convergence::Diverging);
    assert_eq!(of(&[1.0, 2.0, 2.0]), Convergence::WithinNoise);
    // Differences 4, 2, 0.5: order 1, then 2.
    let Convergence::Converging(found) = of(&[0.0, 4.0, 6.0, 6.5]) else { panic!("it converges") };
    assert!((found.order - 2.0).abs() < 1e-12 && found.is_asymptotic == Some(false), "{found:?}");
    // Sizes that do not fall have no ratio.
    let equal = exact(&[(1.0, 1.0), (1.0, 0.5), (1.0, 0.2)]);
    assert_eq!(observed_order(&equal, Replicates::Own), Convergence::TooFewLevels);
}

/// Order and limit of noisy levels scatter as their standard errors say: first-order propagation holds for small noise.
/// 4000 draws know a standard deviation to 1.1 %; the bound is four times that.
#[test]
fn noise_spreads_as_stated() {
    let error = 1e-3;
    let mut stream = Stream::new(11, Purpose::Sampling, 0);
    let (mut orders, mut limits) = (Vec::new(), Vec::new());
    let mean = |h: f64| 1.0 + h.powi(2);
    let sizes = [0.5, 0.3, 0.2];
    let clean = sizes.map(|size| uncertain(size, mean(size), error));
    let Convergence::Converging(stated) = observed_order(&clean, Replicates::Own) else {
        panic!("it converges")
    };
    for _ in 0..4000 {
        let noisy = sizes.map(|size| uncertain(size, mean(size) + error * stream.normal(), error));
        let Convergence::Converging(found) = observed_order(&noisy, Replicates::Own) else {
            panic!("{noisy:?}")
        };
        orders.push(found.order);
        limits.push(found.limit);
    }
    let ratio = |found: &[f64], stated: f64| Moments::of(found).standard_deviation / stated;
    assert!((ratio(&orders, stated.order_standard_error) - 1.0).abs() < 0.045, "{stated:?}");
    assert!((ratio(&limits, stated.limit_standard_error) - 1.0).abs() < 0.045, "{stated:?}");
}

#[test]
fn differences_within_the_noise_have_no_order() {
    let levels = [0.4_f64, 0.2, 0.1].map(|size| uncertain(size, 1.0 + size * size, 0.011));
    // The last difference is 0.03; two standard errors of it are 2*0.011*sqrt(2) = 0.0311.
    assert_eq!(observed_order(&levels, Replicates::Own), Convergence::WithinNoise);
    // Where both have met the same luck nothing of it is noise.
    assert_matches!(observed_order(&levels, Replicates::Shared), Convergence::Converging(_));
    // Differences of round-off are no differences, however regular they are.
    let flat = exact(&[(0.4, 1.0 + 4e-15), (0.2, 1.0 + 2e-15), (0.1, 1.0 + 1e-15)]);
    assert_eq!(observed_order(&flat, Replicates::Own), Convergence::WithinNoise);
}

fn verdicts(levels: &[Level], tolerance: f64, replicates: Replicates) -> Vec<Verdict> {
    differences(levels, tolerance, replicates).iter().map(|difference| difference.verdict).collect()
}

/// Levels that share replicates and whose differences from the finest are -1.30 ± 0.63 % of it: with eight replicates t(95 %, 7)
/// = 2.364624, so the difference is anywhere from -2.79 to +0.19 %. Within 1 % it is not shown to have settled, within 3 %
/// it has, and within 0.1 % of a finest value that is known better it has not.
#[test]
fn what_scatter_cannot_tell_is_not_shown() {
    let fine: Vec<f64> = (0..8).map(|replicate| 100.0 + 10.0 * f64::from(replicate - 4)).collect();
    let shape = [1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0];
    // Standard deviation √(8/7) times the amplitude, standard error that over √8: amplitude/√7.
    let away = |difference: f64, error: f64| {
        let amplitude = error * 7.0_f64.sqrt();
        let mean = Moments::of(&fine).mean;
        let shift = |(value, sign): (&f64, f64)| value + mean * (difference + amplitude * sign);
        Level { size: 2.0, replicates: fine.iter().zip(shape).map(shift).collect() }
    };
    let finest = Level { size: 1.0, replicates: fine.clone() };
    let levels = [away(-0.0130, 0.0063), finest.clone()];
    let found = differences(&levels, 0.01, Replicates::Shared)[0];
    let mean = finest.moments().mean;
    // Round-off of sums of eight; the quantile's own digits.
    assert_near!(found.value / mean, -0.0130, 1e-12);
    assert_near!(found.standard_error / mean, 0.0063, 1e-12);
    assert!((found.half_width / found.standard_error - 2.364_624).abs() < 1e-6, "{found:?}");
    assert_eq!(found.verdict, Verdict::NotShown);
    assert_eq!(settled(&[found]), (None, Verdict::NotShown));
    assert_eq!(verdicts(&levels, 0.03, Replicates::Shared), [Verdict::Settled]);
    assert_eq!(
        verdicts(&[away(-0.0130, 1e-4), finest.clone()], 0.01, Replicates::Shared),
        [Verdict::NotSettled]
    );
    // The same means with replicates of their own: 8.7 % of scatter in each hides what is paired.
    assert_eq!(verdicts(&levels, 0.03, Replicates::Own), [Verdict::NotShown]);
    // All levels from the first settled one on must be.
    let found = differences(
        &[away(0.001, 1e-4), away(0.02, 1e-4), away(0.002, 1e-4), finest.clone()],
        0.01,
        Replicates::Shared,
    );
    assert_eq!(settled(&found), (Some(2), Verdict::Settled));
}

/// A single replicate does not tell how much it scatters; equal replicates tell that they do not.
#[test]
fn a_single_replicate_shows_nothing() {
    let single = exact(&[(2.0, 1.0), (1.0, 1.0)]);
    for replicates in [Replicates::Shared, Replicates::Own] {
        let found = differences(&single, 0.5, replicates);
        assert_eq!(found[0].verdict, Verdict::NotShown);
        assert_true!(found[0].half_width.is_infinite(), "one level has no interval");
        let equal = [2.0, 1.0].map(|size| Level { size, replicates: vec![1.0; 3] });
        assert_eq!(verdicts(&equal, 1e-9, replicates), [Verdict::Settled]);
    }
    assert_eq!(settled(&[]), (None, Verdict::NotShown));
}

/// Welch: s²/n of 0.04 with 1 and of 0.01 with 2 degrees of freedom: 0.05²/(0.04²/1 + 0.01²/2) = 1.515, so 1, and t = 12.706.
#[test]
fn levels_with_their_own_replicates_have_welchs_freedom() {
    let coarse = Level { size: 2.0, replicates: vec![0.8, 1.2] };
    let third = 0.03_f64.sqrt();
    let fine = Level { size: 1.0, replicates: vec![1.0 - third, 1.0, 1.0 + third] };
    let found = differences(&[coarse, fine], 0.01, Replicates::Own)[0];
    assert_near!(found.standard_error, 0.05_f64.sqrt(), 1e-15);
    // The table has three decimals.
    assert!((found.half_width / found.standard_error - 12.706).abs() < 5e-4, "{found:?}");
}
