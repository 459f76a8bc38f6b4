//! run(2n) = run(n), write, read, run(n): to the last bit.

use agglo::engine::soft::Simulation;

use crate::{common, crowd};

/// Runs on, from the state in memory and from one written and read, and compares.
fn assert_resumes(text: &str, before: usize, after: usize) {
    let mut whole = common::start(text, crowd::falling_in);
    common::steps(&mut whole, before);
    crowd::assert_busy(&whole);
    let scenario = common::scenario(text);
    let mut resumed = Simulation::resume(&scenario, common::written_and_read(&whole)).unwrap();
    common::assert_same_state(&common::bytes(&resumed), &common::bytes(&whole), "read again");
    for step in 0..after {
        common::steps(&mut whole, 1);
        common::steps(&mut resumed, 1);
        let when = format!("resumed, after {} steps", step + 1);
        common::assert_same_state(&common::bytes(&resumed), &common::bytes(&whole), &when);
    }
}

#[test]
fn with_history_bonds_rays_and_a_changing_step() {
    for engine in [crowd::VERLET, crowd::ADAPTIVE] {
        assert_resumes(&crowd::text(engine, 300), 150, 150);
    }
}

/// The grains are sorted in space after 2000 steps.
#[test]
fn across_a_sorting_of_the_grains() {
    for engine in [crowd::VERLET, crowd::ADAPTIVE] {
        // Stronger bonds, of which some are left by then.
        let text = crowd::text(engine, 60).replace("\"1 MPa\"", "\"3 MPa\"");
        assert_resumes(&text, 1990, 30);
        assert_resumes(&text, 2000, 20);
    }
}

/// A step that was cut short leaves rays that wait for the grains.
#[test]
fn resumes_at_any_step() {
    let scenario = common::scenario(&crowd::text(crowd::ADAPTIVE, 60));
    let mut whole = crowd::start(crowd::ADAPTIVE, 60);
    for step in 0..300 {
        let mut resumed = Simulation::resume(&scenario, common::written_and_read(&whole)).unwrap();
        common::steps(&mut whole, 1);
        common::steps(&mut resumed, 1);
        let when = format!("resumed at step {step}");
        common::assert_same_state(&common::bytes(&resumed), &common::bytes(&whole), &when);
    }
}
