//! Rates by size against sums by hand and against Smoluchowski's constant kernel.

use super::*;
use crate::math::rng::{Purpose, Stream};

fn row(rates: &SizeRates, a: u32, b: u32, time: f64) -> KernelRow {
    let rows = rates.kernel_rows(time);
    *rows.iter().find(|row| row.a[0] == a && row.b[0] == b).unwrap()
}

/// 10 singles, 4 of class 2 in 3 m³ for 6 s: 45, 40 and 6 pairs.
#[test]
fn constant_populations() {
    let mut rates = SizeRates::new(SizeClasses::default(), [1; 10].into_iter().chain([4, 5, 6, 7]), 3.0);
    for _ in 0..9 {
        rates.collide([1, 1], false);
    }
    rates.collide([6, 1], false);
    rates.collide([1, 4], false);
    assert_eq!(row(&rates, 1, 1, 6.0).collision_kernel, Some(9.0 / (45.0 * 6.0 / 3.0)));
    assert_eq!(row(&rates, 4, 1, 6.0).collision_kernel, Some(2.0 / (40.0 * 6.0 / 3.0)));
    let large = row(&rates, 4, 4, 6.0);
    assert_eq!((large.exposure, large.collisions, large.sticking_probability), (6.0 * 6.0 / 3.0, 0, None));
    assert_eq!(large.b, [4, 7]);
    // Class 1 (2 or 3 primaries) is empty: none of its pairs could collide.
    assert_eq!(rates.kernel_rows(6.0).len(), 3);
}

/// Four singles in 1 m³. At 1 s two merge; at 3 s the double takes a single (a triple is of the same class); at
/// 4 s the triple takes the last one. All numbers are dyadic, so the sums are exact.
#[test]
fn merges_by_hand() {
    let mut rates = SizeRates::new(SizeClasses::default(), [1; 4].into_iter(), 1.0);
    for (primaries, time) in [([1, 1], 1.0), ([2, 1], 3.0), ([1, 3], 4.0)] {
        rates.collide(primaries, true);
        rates.merge(primaries, time);
    }
    rates.collide([4, 4], false);
    assert_eq!(rates.populations().collect::<Vec<_>>(), [0, 0, 1]);
    // Singles: 4 for 1 s (6 pairs), 2 for 2 s (1 pair), 1 for 1 s.
    assert_eq!(row(&rates, 1, 1, 9.0).exposure, 6.0 + 2.0);
    // One of class 1 beside 2 singles for 2 s, beside 1 for 1 s.
    assert_eq!(row(&rates, 2, 1, 9.0).exposure, 4.0 + 1.0);
    assert_eq!(row(&rates, 2, 1, 9.0).aggregation_kernel, Some(2.0 / 5.0));
    // A collision that could not be is counted, and no kernel made of it.
    let impossible = row(&rates, 4, 4, 9.0);
    assert_eq!((impossible.collisions, impossible.exposure, impossible.collision_kernel), (1, 0.0, None));
    assert_eq!(rates.kernel_rows(9.0).len(), 3);
    let times: Vec<f64> = rates.breakage_rows(9.0).iter().map(|row| row.grain_time).collect();
    assert_eq!(times, [4.0 + 2.0 * 2.0 + 1.0, 3.0, 5.0]);
}

/// Sixteen become 8 + 7 + 1 at 2 s, then 12 become 6 + 6 at 4 s; read at 8 s.
#[test]
fn fragments_by_hand() {
    let mut rates = SizeRates::new(SizeClasses::default(), [16, 12].into_iter(), 1.0);
    rates.collide_and_break([16, 12]);
    rates.shatter(16, &[8, 7, 1], 2.0);
    rates.collide([8, 12], false);
    rates.collide_and_break([8, 12]);
    rates.shatter(12, &[6, 6], 4.0);
    let rows = rates.daughter_rows();
    let found: Vec<_> =
        rows.iter().map(|row| (row.parent, row.daughter, row.fragments, row.primaries)).collect();
    let expected = [
        ([8, 15], [4, 7], 2, 12),
        ([16, 31], [1, 1], 1, 1),
        ([16, 31], [4, 7], 1, 7),
        ([16, 31], [8, 15], 1, 8),
    ];
    assert_eq!(found, expected);
    assert_eq!((rows[0].fragments_per_breakage, rows[0].mass_fraction), (2.0, 1.0));
    assert_eq!(rows[1..].iter().map(|row| row.mass_fraction).sum::<f64>(), 1.0);
    // Class 3: one (12) for 2 s, two for 2 s (1 pair), then one (8).
    let large = row(&rates, 8, 8, 8.0);
    assert_eq!((large.exposure, large.collisions, large.breaking), (2.0, 2, 1));
    assert_eq!(large.breaking_kernel, Some(0.5));
    // The largest class: one beside one of class 3 for 2 s.
    assert_eq!(row(&rates, 16, 8, 8.0).exposure, 2.0);
    let breakage = rates.breakage_rows(8.0);
    let large = breakage.iter().find(|row| row.class == [8, 15]).unwrap();
    assert_eq!((large.grains, large.grain_time, large.breakages), (1, 2.0 + 4.0 + 4.0, 1));
    assert_eq!(large.breakage_rate, Some(0.1));
}

/// Singles that all collide with one kernel, at times drawn from the exact law.
struct Smoluchowski {
    rates: SizeRates,
    sizes: Vec<u32>,
    time: f64,
    /// Integral of the number of all pairs.
    pair_time: f64,
}

const KERNEL: f64 = 2.5;
const VOLUME: f64 = 7.0;

fn smoluchowski(grains: usize, least: usize) -> Smoluchowski {
    let mut stream = Stream::new(3, Purpose::Sampling, 1);
    let mut sizes = vec![1_u32; grains];
    let mut rates = SizeRates::new(SizeClasses::default(), sizes.iter().copied(), VOLUME);
    let (mut time, mut pair_time) = (0.0, 0.0);
    while sizes.len() > least {
        let n = sizes.len() as f64;
        let pairs = 0.5 * n * (n - 1.0);
        let wait = -(1.0 - stream.uniform()).ln() * VOLUME / (KERNEL * pairs);
        (time, pair_time) = (time + wait, pair_time + pairs * wait);
        let first = (stream.uniform() * n) as usize;
        let one = sizes.swap_remove(first);
        let second = (stream.uniform() * (n - 1.0)) as usize;
        let other = sizes[second];
        rates.collide([one, other], true);
        rates.merge([one, other], time);
        sizes[second] = one + other;
    }
    Smoluchowski { rates, sizes, time, pair_time }
}

/// The exposures of all pairs of classes add up to that of all pairs, to round-off of the sum (2e4 terms); reading
/// them changes nothing; and each kernel is the constant one within five standard errors 1/sqrt(merges).
#[test]
fn a_constant_kernel_is_found_again() {
    let Smoluchowski { rates, sizes, time, pair_time } = smoluchowski(20_000, 500);
    let before = rates.clone();
    let rows = rates.kernel_rows(time);
    assert_eq!(rates, before);
    let exposure: f64 = rows.iter().map(|row| row.exposure).sum();
    assert!((exposure * VOLUME / pair_time - 1.0).abs() < 1e-11, "{exposure}");
    assert_eq!(rows.iter().map(|row| row.merges).sum::<u64>(), 19_500);
    let mut tested = 0;
    for row in rows.iter().filter(|row| row.merges >= 100) {
        let error = 5.0 / (row.merges as f64).sqrt();
        let kernel = row.aggregation_kernel.unwrap();
        assert!((kernel / KERNEL - 1.0).abs() < error, "{row:?}");
        assert_eq!(row.collision_kernel, row.aggregation_kernel);
        tested += 1;
    }
    assert!(tested >= 15, "{tested}");
    let counted: Vec<u64> = rates.populations().collect();
    let mut expected = vec![0; counted.len()];
    for &size in &sizes {
        expected[rates.classes.class_of(size)] += 1;
    }
    assert_eq!(counted, expected);
}

/// N(t) = N0/(1 + K N0 t/(2 V)): with the kernel found from all 19,500 merges the curve meets the number that is
/// left within five standard errors of that kernel, 5/sqrt(19,500) = 3.6 %.
#[test]
fn the_number_decays_as_smoluchowski_says() {
    let Smoluchowski { rates, time, .. } = smoluchowski(20_000, 500);
    let rows = rates.kernel_rows(time);
    let exposure: f64 = rows.iter().map(|row| row.exposure).sum();
    let kernel = rows.iter().map(|row| row.merges as f64).sum::<f64>() / exposure;
    let left = 20_000.0 / (1.0 + 0.5 * kernel * 20_000.0 * time / VOLUME);
    assert!((left / 500.0 - 1.0).abs() < 0.036, "{left}");
}

/// Going on from what was written gives the same bits.
#[test]
fn a_restart_changes_no_bit() {
    let mut whole = smoluchowski(200, 100).rates;
    let bytes = postcard::to_stdvec(&whole).unwrap();
    let mut again: SizeRates = postcard::from_bytes(&bytes).unwrap();
    assert_eq!(whole, again);
    for rates in [&mut whole, &mut again] {
        rates.collide([1, 2], true);
        rates.merge([1, 2], 1e3);
        rates.shatter(3, &[2, 1], 1.1e3);
    }
    assert_eq!(whole, again);
}

/// Classes of one, of two, and of more. Singles: 4 for 1 s, 2 for 2 s, 1 for 1 s, read at 9 s. A grain of 2 from 1 to 3 s. In the
/// last class 3 primaries from 3 to 4 s, then 4.
#[test]
fn classes_of_ones_own() {
    let classes = SizeClasses::from_bounds(&[1, 2, 3]);
    let mut rates = SizeRates::new(classes, [1; 4].into_iter(), 1.0);
    for (primaries, time) in [([1, 1], 1.0), ([2, 1], 3.0), ([1, 3], 4.0)] {
        rates.collide(primaries, true);
        rates.merge(primaries, time);
    }
    assert_eq!(rates.populations().collect::<Vec<_>>(), [0, 0, 1]);
    assert_eq!(row(&rates, 2, 1, 9.0).exposure, 2.0 * 2.0);
    assert_eq!(row(&rates, 3, 1, 9.0).exposure, 1.0);
    assert_eq!(row(&rates, 3, 1, 9.0).a, [3, u32::MAX]);
    let means: Vec<_> = rates.breakage_rows(9.0).iter().map(|row| row.mean_primaries).collect();
    assert_eq!(means, [Some(1.0), Some(2.0), Some((3.0 + 4.0 * 5.0) / 6.0)]);
    let totals = rates.totals(9.0).unwrap();
    assert_eq!((totals.class(0), totals.class(2)), ([9.0, 9.0, 0.0, 0.0], [6.0, 23.0, 0.0, 0.0]));
    assert_eq!((totals.pair(1, 0), totals.pair(0, 2)), ([4.0, 1.0, 1.0, 0.0], [1.0, 1.0, 1.0, 0.0]));
    let row = totals.to_vec();
    assert_eq!(row.len(), SizeTotals::len_of(3));
    assert_eq!(SizeTotals::from_slice(3, &row), Some(totals));
    assert_none!(SizeTotals::from_slice(3, &row[1..]));
    assert_none!(SizeTotals::from_slice(2, &row));
    rates.shatter(4, &[1, 3], 9.0);
    let totals = rates.totals(10.0).unwrap();
    assert_eq!((totals.class(2), totals.daughters(2, 0)), ([7.0, 26.0, 1.0, 4.0], [1.0, 1.0]));
    assert_eq!(totals.daughters(2, 2), [1.0, 3.0]);
    assert_none!(SizeRates::new(SizeClasses::default(), [1].into_iter(), 1.0).totals(1.0));
    let living = [1, 3];
    assert_none!(rates.validate(&SizeClasses::from_bounds(&[1, 2, 3]), living.into_iter()).err());
    for (classes, living) in
        [(SizeClasses::default(), [1, 3]), (SizeClasses::from_bounds(&[1, 2, 3]), [1, 4])]
    {
        assert!(rates.validate(&classes, living.into_iter()).is_err(), "{classes:?} with {living:?}");
    }
}
