//! Tests of the states that checkpoints of hard spheres hold.

use std::ops::ControlFlow;
use std::path::Path;

use super::*;

/// Grains of many sizes that merge, break and cool.
const SCENARIO: &str = r#"
version = 1
seed = 5
time.end = "0.3 ms"
[engine.event_driven]
[volume]
lower = ["-5 mm", "-5 mm", "-5 mm"]
upper = ["5 mm", "5 mm", "5 mm"]
[materials.grain]
density = "2000 kg/m3"
hardness = "0.6 MPa"
activation_energy = "1 kJ"
heat_capacity = "800 J/(kg K)"
surface_energy = "200 J/m2"
emissivity = 0.5
[[grains]]
material = "grain"
size.constant.radius = "0.4 mm"
placement.fill.count = 200
velocity_spread.uniform.bounds = ["60 m/s", "60 m/s", "60 m/s"]
[impact.restitution.hardness]
[impact.fragmentation]
[impact.cooling]
"#;

fn bytes(job: &Hard) -> Vec<u8> {
    postcard::to_stdvec(&HardState { simulation: job.simulation.state(), memory: job.memory }).unwrap()
}

fn advance_to(job: &mut Hard, time: f64) {
    let mut turns = agglo_testing::Turns::at_most(10_000_000, "the time that is due");
    while job.time() < time && !job.is_finished() {
        turns.take();
        job.advance(time).unwrap();
    }
}

/// At forty moments the run is saved and goes on from there, under both engines: the end is the same to the last bit.
#[test]
fn a_run_resumed_at_any_moment_ends_in_the_same_state() {
    for engine in ["engine.event_driven", "engine.time_stepped"] {
        let text = SCENARIO.replace("engine.event_driven", engine);
        let scenario = Scenario::from_toml(&text).unwrap().resolved();
        let grains = crate::packing::place(&scenario, Path::new("")).unwrap();
        let mut whole = Hard::start(&scenario, grains.into(), &mut |_| ControlFlow::Continue(())).unwrap();
        let end = scenario.time.end.si();
        let mut saved = Vec::new();
        for turn in 0..40 {
            advance_to(&mut whole, f64::from(turn) * end / 40.0);
            saved.push(bytes(&whole));
        }
        advance_to(&mut whole, end);
        let counts = &whole.simulation.system().state.counts;
        assert!(counts.merges > 20 && counts.fragmentations > 5, "{counts:?}");
        let wanted = bytes(&whole);
        for (turn, state) in saved.iter().enumerate() {
            let mut resumed = Hard::resume(&scenario, postcard::from_bytes(state).unwrap()).unwrap();
            assert!(bytes(&resumed) == *state, "{engine}: another state right after turn {turn}");
            advance_to(&mut resumed, end);
            assert!(bytes(&resumed) == wanted, "{engine}: resumed at turn {turn}");
        }
    }
}

/// Quantities of the summary that are ratios of others, and false heat where the published sum makes some: without reaction the
/// consistent balance makes none.
#[test]
fn ratios_of_the_summary() {
    let published = SCENARIO
        .replace("[impact.cooling]", "[impact.heat]\nbalance = \"published\"")
        .replace("emissivity = 0.5\n", "");
    for (text, is_false) in [(SCENARIO, false), (published.as_str(), true)] {
        let scenario = Scenario::from_toml(text).unwrap().resolved();
        let grains = crate::packing::place(&scenario, Path::new("")).unwrap();
        let mut job = Hard::start(&scenario, grains.into(), &mut |_| ControlFlow::Continue(())).unwrap();
        advance_to(&mut job, scenario.time.end.si());
        let Summary::Hard(found) = job.summary(&scenario, 0.0) else { panic!("of hard spheres") };
        assert_eq!(
            found.counts.events_per_impact,
            Some(found.run.steps as f64 / found.counts.impacts as f64)
        );
        assert_near!(found.growth.largest_radius_ratio, found.growth.largest_radius_m / 0.4e-3, 1e-12);
        assert_near!(found.growth.radius_ratio, found.growth.mean_radius_m / 0.4e-3, 1e-12);
        assert_eq!(found.table().iter().any(|(label, _)| label == "false heat"), is_false);
        // Sums over some hundred impacts.
        assert_below!(found.energy.drift_relative.abs(), 1e-13);
    }
}
