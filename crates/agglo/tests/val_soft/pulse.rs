//! The first pulse of the published sample problem, with grains that move.

use std::path::Path;

use agglo::scenario::Scenario;

use crate::common;

/// T. I. Zohdi, Comput. Mech. 57, 465 (2016), section 7: 59,238 "reflections", 58,000-62,000 over realisations, which
/// are straight segments. Three independent programs, ten packings, grains at rest: 50,450 ± 1,000 reflections and
/// 60,450 ± 1,000 segments. Three standard deviations.
#[test]
fn val_zohdi_2016_first_pulse() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/acoustic-dispersal.toml");
    let text = std::fs::read_to_string(file).unwrap();
    let settings = ["acoustics.beams.0.pulses.count=1", "seed=3"];
    let scenario = Scenario::with_overrides(&text, &settings).unwrap_or_else(|faults| panic!("{faults}"));
    let mut simulation =
        agglo::engine::soft::Simulation::start(&scenario, common::grains(&scenario, |_| {})).unwrap();
    common::steps(&mut simulation, 1);
    while simulation.pulses.counts()[0].in_flight > 0 {
        common::steps(&mut simulation, 1);
        assert!(simulation.clock().time < 0.05, "rays are caught");
    }
    let count = simulation.pulses.counts()[0];
    assert!(count.reflections.abs_diff(50_450) < 3_000, "{count:?}");
    assert!(count.segments.abs_diff(60_450) < 3_000, "{count:?}");
    assert_eq!(count.segments, count.reflections + 10_000, "{count:?}");
    // About 7 % of the power is absorbed.
    let absorbed = count.power_absorbed / count.power_in;
    assert!((absorbed - 0.07).abs() < 0.01, "{absorbed}");
    let books = count.power_absorbed + count.power_escaped + count.power_truncated;
    assert!((books / count.power_in - 1.0).abs() < 1e-12);
}
