//! Checkpoints that somebody has tampered with and that carry the right checksum: they are refused, or gone on with to other
//! quantities or an error, but nothing panics.

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use super::guests::Known;
use super::hard::Hard;
use super::job::{AnySaved, Job, Saved};
use super::recorder::Recorder;
use super::soft::Soft;
use crate::engine::SimError;
use crate::math::rng::{Purpose, Stream};
use crate::scenario::{Scenario, template};

/// Numbers that break what is not looked at.
const ODD: [f64; 10] =
    [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -1.0, 1e300, -1e300, 1e-300, 1e18, 4_294_967_296.0];

/// The state of a run after some steps, as a checkpoint holds it.
fn saved<J: Job>(scenario: &Scenario, steps: usize) -> Vec<u8> {
    let scenario = scenario.resolved();
    let grains = crate::packing::place(&scenario, Path::new("")).unwrap();
    let mut job = J::start(&scenario, grains.into(), &mut |_| ControlFlow::Continue(())).unwrap();
    let end = scenario.time.end.si();
    (0..steps).for_each(|_| job.advance(job.time() + 1e-3 * end).unwrap());
    let place = tempfile::tempdir().unwrap();
    let folder = crate::folder::RunFolder::create(&place.path().join("run")).unwrap();
    let recorder = Recorder::create(&scenario, &folder, Known::default()).unwrap().state();
    let rest = Saved {
        scenario: scenario.to_toml().unwrap(),
        state: (),
        recorder,
        wall_s: 0.0,
        ends_before: Vec::new(),
    };
    postcard::to_stdvec(&job.save(rest)).unwrap()
}

/// Goes on for some steps, and draws up what a run would write.
fn go_on<J: Job>(scenario: &Scenario, state: J::State<'_>) -> Result<(), SimError> {
    let mut job = J::resume(scenario, state)?;
    for _ in 0..20 {
        if job.is_finished() {
            break;
        }
        job.advance(job.time() + 1e-3 * scenario.time.end.si())?;
    }
    job.summary(scenario, 0.0).validated(job.time()).map(drop)
}

/// What becomes of a checkpoint's bytes: whether it could be gone on with.
fn resumed(scenario: &Scenario, bytes: &[u8]) -> bool {
    match postcard::from_bytes::<AnySaved<'_>>(bytes) {
        Ok(AnySaved::Soft(saved)) => go_on::<Soft>(scenario, saved.state).is_ok(),
        Ok(AnySaved::Hard(saved)) => go_on::<Hard>(scenario, saved.state).is_ok(),
        Err(_) => false,
    }
}

/// One to three bytes or numbers changed.
fn tampered(bytes: &[u8], from: usize, stream: &mut Stream) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    let below = |stream: &mut Stream, n: usize| (stream.uniform() * n as f64) as usize % n;
    for _ in 0..=below(stream, 3) {
        let at = from + below(stream, bytes.len() - from - 8);
        match below(stream, 5) {
            0 => bytes[at] ^= 1 << below(stream, 8),
            1 => bytes[at] = [0, 1, 127, 128, 255][below(stream, 5)],
            2 => bytes[at] = below(stream, 256) as u8,
            _ => bytes[at..at + 8].copy_from_slice(&ODD[below(stream, ODD.len())].to_le_bytes()),
        }
    }
    bytes
}

fn nothing_panics(name: &str, settings: &[&str], steps: usize, cases: u32) {
    let scenario = Scenario::with_overrides(template(name).unwrap().text, settings).unwrap().resolved();
    let whole =
        if scenario.is_hard() { saved::<Hard>(&scenario, steps) } else { saved::<Soft>(&scenario, steps) };
    assert!(resumed(&scenario, &whole), "untouched");
    // The scenario's text comes first, and is read by what reads scenarios.
    let from = scenario.to_toml().unwrap().len();
    let mut went_on = 0;
    for case in 0..cases {
        let mut stream = Stream::new(u64::from(case), Purpose::Search, 77);
        let bytes = tampered(&whole, from, &mut stream);
        let found = catch_unwind(AssertUnwindSafe(|| resumed(&scenario, &bytes)));
        assert!(found.is_ok(), "{name}: case {case} panics");
        went_on += u32::from(found.unwrap_or(false));
    }
    assert!(went_on < cases, "{name}: some are refused");
}

#[test]
fn forged_states_of_soft_spheres_do_not_panic() {
    let settings = ["grains.0.placement.random.count=40", "acoustics.beams.0.rays=100", "time.end=0.01 s"];
    nothing_panics("acoustic-published", &settings, 12, CASES);
}

#[test]
fn forged_states_of_event_driven_spheres_do_not_panic() {
    nothing_panics("reacting", &SMALL, 6, CASES);
}

#[test]
fn forged_states_of_time_stepped_spheres_do_not_panic() {
    nothing_panics("reacting-published", &SMALL, 6, CASES);
}

const CASES: u32 = 2000;
/// The same solid fraction with 60 grains.
const SMALL: [&str; 3] =
    ["time.end=1 ms", "grains.0.placement.fill.count=60", "grains.0.size.length_ratio.count=60"];
