//! What happened, in words: each quantity of a summary of distinct quantities where it belongs.

use super::*;
use agglo::run::{Clusters, PulseQuantities};
use agglo::run::{CountQuantities, GrowthQuantities, MotionQuantities, RunQuantities};

#[test]
fn a_run_of_soft_spheres_is_told_with_its_own_quantities() {
    let pulse = |rays, power_in, power_absorbed| PulseQuantities {
        rays,
        power_in,
        power_absorbed,
        power_escaped: 1e3,
        reflections: 77,
        ..PulseQuantities::default()
    };
    let mut summary = SoftSummary {
        grains: 31,
        time_s: 2.0,
        pulses: vec![pulse(10, 60.0, 6.0), pulse(20, 40.0, 3.0)],
        bonds_start: 8,
        bonds_end: 5,
        clusters_start: Clusters { count: 4, largest_fraction: 0.75 },
        clusters: Clusters { count: 6, largest_fraction: 0.6 },
        dispersion_degree: 0.4,
        dispersion_degree_relative: 0.2,
        ..SoftSummary::default()
    };
    summary.energy.balance.drift_relative = -3e-5;
    let wanted = "31 grains were followed for 2 s. 2 acoustic pulses of 30 rays in all hit them; the grains took up 9.0 % of \
                  the power. Of 8 bonds 3 broke (37.5 %). They began as 4 clusters, the largest with 75.0 % of the mass. At \
                  the end they are 6 clusters, the largest with 60.0 % of the mass: a dispersion degree of 0.400, 0.200 \
                  relative to the start. Energy is accounted for to 3.0e-5 of all there was.";
    assert_eq!(soft(&summary), wanted, "found on the left, due on the right");
    (summary.energy.unexplained_largest, summary.energy.unexplained_limit) = (0.25, 0.003);
    let first = "Not all energy is accounted for: up to 2.5e-1 of all there was comes from nothing or is lost, above the \
                 limit of 3e-3.";
    assert!(soft(&summary).starts_with(first), "{}", soft(&summary));
}

#[test]
fn a_run_of_hard_spheres_is_told_with_its_own_quantities() {
    let mut summary = HardSummary {
        run: RunQuantities { grains: 7, time_s: 2.0, ..RunQuantities::default() },
        growth: GrowthQuantities {
            grains_start: 9,
            grains_end: 7,
            radius_ratio: 1.25,
            n_f: 1.953,
            largest_radius_ratio: 1.5,
            largest_primaries: 3,
            largest_fraction: 0.375,
            ..GrowthQuantities::default()
        },
        counts: CountQuantities {
            impacts: 100,
            bounces: 61,
            merges: 1,
            fragmentations: 8,
            ..CountQuantities::default()
        },
        motion: MotionQuantities {
            temperature_mean: 310.0,
            temperature_lowest: 290.0,
            temperature_highest: 420.0,
            ..MotionQuantities::default()
        },
        ..HardSummary::default()
    };
    summary.energy.drift_relative = -2e-5;
    let wanted = "9 grains moved for 2 s and collided 100 times: 61 bounces, 1 merge and 8 breakages. 7 grains are left, in the mean \
                  1.250 times as large as at the start. The largest holds 3 of the first grains, 37.5 % of the mass. Their \
                  mean temperature is 310 K (the hottest has 420 K). Energy is accounted for to 2.0e-5 of all there was.";
    assert_eq!(hard(&summary), wanted, "found on the left, due on the right");
}
