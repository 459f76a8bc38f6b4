//! Steps, time and bytes carried on to the end, by hand.

use super::*;
use crate::run::{Stretch, Summary, Weights};
use crate::scenario::template;

/// A run of 2 s with rows every 10 ms, 20 us while rays fly; frames every 50 ms and 0.5 ms.
fn scenario() -> Scenario {
    Scenario::from_toml(template("acoustic-published").unwrap().text).unwrap()
}

/// Two beams, of three and one pulse; their rays fly for 0.04 s and 0.03 s and are followed in 7 s and 11 s.
fn pushes() -> [Push; 2] {
    let push = |beam, pulses, flight_s, wall_s| Push {
        beam,
        pulses,
        flight_s,
        wall_s,
        duration: 0.1,
        ..Push::default()
    };
    [push(0, 3.0, 0.04, 7.0), push(1, 1.0, 0.03, 11.0)]
}

fn stretch(time: f64, steps: f64, wall_s: f64) -> Stretches {
    let mut stretches = Stretches::default();
    stretches.add(Stretch { time, steps, wall_s });
    stretches
}

/// Half a second was tried, without rays: 400 steps a second, each a thousandth of a second of the clock.
fn tried() -> Rehearsal {
    Rehearsal {
        time: 0.5,
        is_finished: false,
        quiet: stretch(0.5, 200.0, 0.2),
        flying: Stretches::default(),
        calm: None,
        start_s: 3.0,
        writing_s: 0.0,
        weights: None,
        summary: Summary::Soft(Box::default()),
        trouble: None,
    }
}

/// Rays fly for 3 x 0.04 s + 0.03 s = 0.15 s of the 1.5 s that are left. Following them takes 3 x 7 s + 11 s = 32 s.
#[test]
fn rays_that_were_not_tried() {
    let (scenario, pushes) = (scenario(), pushes());
    assert_close!(flights(&scenario, &pushes), 0.15, 1e-12, "in s");
    let mut plan = Plan::default();
    of_soft(&mut plan, &scenario, &tried(), &pushes);
    // A hit presses for 0.1 s, so that the law of the rays asks for no shorter step than the grains do.
    assert_close!(plan.steps.unwrap(), 200.0 + 400.0 * 1.5, 1e-12);
    assert_close!(plan.seconds.unwrap(), 3.0 + 0.2 + 0.4 * 1.5 + 32.0, 1e-12, "in s");
    // One that presses for 1 ms asks for 1,000 steps a second.
    let hasty = pushes.map(|push| Push { duration: 1e-3, ..push });
    of_soft(&mut plan, &scenario, &tried(), &hasty);
    assert_close!(plan.steps.unwrap(), 200.0 + 400.0 * 1.35 + 1000.0 * 0.15, 1e-12);
    assert_close!(plan.seconds.unwrap(), 3.0 + 0.2 + 0.4 * 1.35 + 0.15 + 32.0, 1e-12, "in s");
}

/// Where both were tried each goes on at its own pace.
#[test]
fn rays_that_were_tried() {
    let (scenario, pushes) = (scenario(), pushes());
    let tried = Rehearsal { time: 0.6, flying: stretch(0.1, 50.0, 4.0), ..tried() };
    let mut plan = Plan::default();
    of_soft(&mut plan, &scenario, &tried, &pushes);
    assert_close!(plan.steps.unwrap(), 250.0 + 400.0 * 1.35 + 500.0 * 0.05, 1e-12);
    assert_close!(plan.seconds.unwrap(), 3.0 + 4.2 + 0.4 * 1.35 + 40.0 * 0.05, 1e-12, "in s");
}

/// Rows, frames without rays and with half of all rays, two checkpoints, the report.
#[test]
fn bytes_of_a_folder() {
    let (scenario, pushes) = (scenario(), pushes());
    let weights = Weights {
        so_far: 1000.0,
        row: 300.0,
        frame: Some(50_000.0),
        flying_frame: Some(450_000.0),
        checkpoint: 70_000.0,
    };
    let tried = Rehearsal { weights: Some(weights), writing_s: 0.25, ..tried() };
    let mut plan = Plan { grains: 2000, rays_per_pulse: 10_000, seconds: Some(5.0), ..Plan::default() };
    of_files(&mut plan, &scenario, &tried, &pushes);
    let rows = 300.0 * (1.35 / 0.01 + 0.15 / 20e-6);
    let frames = 50_000.0 * 1.35 / 0.05 + (50_000.0 + 0.5 * 400_000.0) * 0.15 / 0.5e-3;
    // Of the frames of the whole run 38 are without rays and 300 with half of them; they are few enough to be shown whole.
    let shown = 14.0 * 2000.0 * (1.0 + 1.85 / 0.05 + 0.15 / 0.5e-3) + 14.0 * 5000.0 * 0.15 / 0.5e-3;
    let by_hand = 1000.0 + rows + frames + 2.0 * 70_000.0 + 2e6 + shown;
    assert_close!(plan.disk.unwrap(), by_hand, 1e-9, "in B");
    assert_close!(plan.seconds.unwrap(), 5.0 + 0.25 * (1.0 + (rows + frames) / 1000.0), 1e-9, "in s");
}
