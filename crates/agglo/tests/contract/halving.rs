//! Convergence: what halving the step does to the shipped sample problems.

use agglo::engine::soft::Simulation;
use agglo::packing::place;
use agglo::scenario::Scenario;
use std::path::Path;

/// Motion and bonds when the first pulse has passed, at 10 ms.
fn after_the_pulse(scenario: &str, settings: &[&str]) -> (f64, usize) {
    let mut settings = settings.to_vec();
    settings.push("time.end=10 ms");
    let scenario = Scenario::with_overrides(scenario, &settings).unwrap_or_else(|faults| panic!("{faults}"));
    let grains = place(&scenario, Path::new(".")).unwrap();
    let mut simulation = Simulation::start(&scenario, grains).unwrap();
    super::common::finish(&mut simulation);
    (simulation.stored_energy().kinetic, simulation.system.network.bonds().len())
}

/// With the consistent laws the impulse of a hit does not depend on the step. A crowd in which bonds break is chaotic: the
/// energy of one start scatters by 2 %, so the means of four starts may differ by three times 2 % sqrt(2/4).
#[test]
fn consistent_laws_do_not_depend_on_the_step() {
    let scenario = include_str!("../../../../scenarios/acoustic-dispersal.toml");
    let mean = |safety: &str| {
        let starts = (1..=4).map(|seed| {
            let settings = [format!("engine.verlet.safety={safety}"), format!("seed={seed}")];
            let (energy, bonds) = after_the_pulse(scenario, &settings.each_ref().map(String::as_str));
            (energy / 4.0, bonds as f64 / 4.0)
        });
        starts.fold((0.0, 0.0), |sum, one| (sum.0 + one.0, sum.1 + one.1))
    };
    let ((energy, bonds), (fine_energy, fine_bonds)) = (mean("0.1"), mean("0.05"));
    assert!((energy / fine_energy - 1.0).abs() < 0.042, "{energy} {fine_energy}");
    assert!((bonds / fine_bonds - 1.0).abs() < 0.05, "{bonds} {fine_bonds}");
}

/// The published force acts for one step: half the step, half the impulse, a quarter of the energy. Between 3 and 4.5,
/// since collisions take some of it and more of it where grains are faster.
#[test]
fn published_laws_do_not_converge() {
    let scenario = include_str!("../../../../scenarios/acoustic-dispersal-published.toml");
    let part = |fraction: &str| {
        let fraction = format!("acoustics.force.published_step.step_fraction={fraction}");
        after_the_pulse(scenario, &[fraction.as_str()]).0
    };
    let ratio = part("0.1") / part("0.05");
    assert!((3.0..4.5).contains(&ratio), "{ratio}");
}
