//! Runs that are spread over domains.

use crate::common::{Bench, EVENTS, STAGGERED, VERLET, assert_same, complained, ended, reference, said};

/// Enough grains for several blocks, so that every domain has some.
const CROWD: [&str; 4] = [
    "--set",
    "grains.0.placement.random.count=2500",
    "--set",
    "grains.0.placement.random.region.sphere.radius=\"1.1 m\"",
];

#[test]
fn any_number_of_domains_writes_the_same_files() {
    for scenario in [VERLET, STAGGERED] {
        for domains in ["1", "3"] {
            let bench = Bench::with(scenario);
            ended(bench.start(&["--domains", domains]).output().unwrap(), 0);
            assert_same(&bench.run(), reference(scenario));
        }
    }
}

/// Stopped as three domains it goes on as two, and none can tell.
#[test]
fn a_run_of_several_blocks_goes_on_with_another_number_of_domains() {
    let mut set = vec!["--set", "time.end=\"4 ms\""];
    set.extend(CROWD);
    let whole = Bench::with(VERLET);
    ended(whole.start(&set).output().unwrap(), 0);
    let cut = Bench::with(VERLET);
    set.extend(["--domains", "3", "--threads", "3"]);
    cut.stopped_after(20, &set);
    ended(cut.resume().args(["--domains", "2"]).output().unwrap(), 0);
    assert_same(&cut.run(), &whole.run());
}

#[test]
fn hard_spheres_are_not_spread() {
    let bench = Bench::with(EVENTS);
    let refused = ended(bench.start(&["--domains", "2"]).output().unwrap(), 2);
    let told = complained(&refused);
    assert!(told.contains("2 domains: events of hard spheres come one after the other"), "{told}");
    assert!(told.contains("run it with one domain") && said(&refused).is_empty(), "{told}");
    assert!(!bench.run().exists(), "a folder was made for a run that cannot be");
    let none = ended(bench.start(&["--domains", "0"]).output().unwrap(), 2);
    assert!(complained(&none).contains("0 is not in 1..=256"), "{}", complained(&none));
}
