//! The rate of impacts in an elastic gas in equilibrium: D. Enskog, K. Svenska Vetensk. Handl. 63 (4) (1922), with the
//! contact value of N. F. Carnahan and K. E. Starling, J. Chem. Phys. 51, 635 (1969), and with that of the virial series,
//! N. Clisby and B. M. McCoy, J. Stat. Phys. 122, 15 (2006).

use crate::common;
use crate::support::{self, Gas, Mean};

/// Coefficients of φ, φ², ... of the compressibility factor.
const VIRIAL: [f64; 9] = [4.0, 10.0, 18.364_768, 28.2245, 39.8151, 53.344, 68.54, 85.81, 105.8];

/// Pair distribution at contact, (Z - 1)/(4 φ); what is left out is 1e-4 of it at φ = 0.25.
fn virial(solid_fraction: f64) -> f64 {
    VIRIAL.iter().rev().fold(0.0, |sum, coefficient| sum * solid_fraction + coefficient) / 4.0
}

/// Rates of a sphere's impacts over that of Enskog and Carnahan and Starling, from blocks of time, after 20 impacts a sphere.
fn ratio(gas: &Gas<'_>, impacts: u64) -> Mean {
    let mut simulation = gas.start();
    support::collide(&mut simulation, 10 * u64::from(gas.count));
    let expected = support::enskog(
        gas,
        support::carnahan_starling(gas.solid_fraction),
        support::temperature(&simulation),
    );
    let blocks = 32;
    let block = impacts as f64 / f64::from(blocks) * 2.0 / (f64::from(gas.count) * expected);
    let start = simulation.clock().time;
    let ratios: Vec<f64> = (1..=blocks)
        .map(|number| {
            let before = support::impacts(&simulation);
            support::run_until(&mut simulation, start + f64::from(number) * block);
            let rate = 2.0 * (support::impacts(&simulation) - before) as f64 / (f64::from(gas.count) * block);
            rate / expected
        })
        .collect();
    support::assert_ledger(&simulation);
    let counts = &simulation.system().state.counts;
    assert_eq!((counts.merges, counts.tc_bounces, counts.overlapping), (0, 0, 0));
    Mean::of(&ratios)
}

/// `published`: how far from Carnahan and Starling's value the rate may be. The virial series is exact there to 1e-4, a
/// finite number of spheres changes the rate by 1/N; `exact` is three standard errors and these.
fn compare(count: u32, impacts: u64, solid_fraction: f64, [published, exact]: [f64; 2]) {
    let gas = Gas { count, solid_fraction, ..Gas::default() };
    let found = ratio(&gas, impacts);
    let series = virial(solid_fraction) / support::carnahan_starling(solid_fraction);
    support::report(&format!(
        "elastic gas, {count} spheres, solid fraction {solid_fraction}: {:.5} +- {:.5} of Enskog's rate with Carnahan and \
         Starling, {:.5} with the virial series",
        found.mean,
        found.error,
        found.mean / series
    ));
    let figures = [("ratio", found.mean), ("error", found.error), ("of_series", found.mean / series)];
    common::found(&format!("enskog_{count}_{solid_fraction}"), &figures);
    assert!((found.mean - 1.0).abs() < published, "{found:?}");
    assert!((found.mean / series - 1.0).abs() < exact, "{found:?}");
    // So that each tolerance is three standard errors or more.
    assert!(3.0 * found.error < exact, "{found:?}");
}

/// Dilute: Carnahan and Starling are exact within 0.02 %.
#[test]
fn val_enskog_1922_rate_at_a_twentieth() {
    compare(4_000, 1_500_000, 0.05, [3e-3, 3e-3]);
}

/// Dense: the true contact value is 0.3 % above that of Carnahan and Starling.
#[test]
fn val_enskog_1922_rate_at_a_quarter() {
    compare(4_000, 1_000_000, 0.25, [6e-3, 3e-3]);
}

#[test]
#[ignore = "20 million impacts"]
fn val_enskog_1922_rates_to_four_digits() {
    compare(10_000, 10_000_000, 0.05, [1e-3, 1e-3]);
    compare(10_000, 10_000_000, 0.25, [6e-3, 1e-3]);
}
