//! A run without a folder: only what it came to.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use crate::engine::soft::Resting;
use crate::engine::{SimError, Start};
use crate::packing::{PackingError, StartError};
use crate::scenario::Scenario;

use super::hard::Hard;
use super::job::Job;
use super::origin::Origin;
use super::soft::Soft;
use super::{Ending, RunError};

/// A run looks at its flag at least this often in its simulated time.
const LOOKS: f64 = 200.0;

/// Runs a scenario without writing anything, until its end or until `stop` is set; `base` is the folder that its
/// tables are relative to. The summary's quantities are those of [`super::run`], to the last bit.
///
/// Loops inside the run use the rayon pool of the calling thread.
///
/// # Errors
/// [`RunError`] where the start cannot be built or a step fails.
pub fn quiet(scenario: &Scenario, base: &Path, stop: &AtomicBool) -> Result<Ending, RunError> {
    let began = Instant::now();
    let scenario = scenario.resolved();
    crate::forecast::refuse_quiet(&scenario, base, 1)?;
    let start = match Origin::of(&scenario, base, &mut || asked(stop)) {
        Err(StartError::Placement(PackingError::Stopped)) => return Ok(Ending::Interrupted(0.0)),
        placed => placed?.start,
    };
    let go = if scenario.is_hard() { sit::<Hard> } else { sit::<Soft> };
    go(&scenario, start, began, stop)
}

fn asked(stop: &AtomicBool) -> ControlFlow<()> {
    if stop.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}

fn sit<J: Job>(
    scenario: &Scenario,
    start: Start,
    began: Instant,
    stop: &AtomicBool,
) -> Result<Ending, RunError> {
    let end = scenario.time.end.si();
    let mut watch = |_: &Resting| asked(stop);
    let mut job = match J::start(scenario, start, &mut watch) {
        Err(SimError::StoppedAtRest) => return Ok(Ending::Interrupted(0.0)),
        started => started.map_err(RunError::Start)?,
    };
    while !job.is_finished() {
        if stop.load(Ordering::Relaxed) {
            return Ok(Ending::Interrupted(job.time()));
        }
        job.advance(job.time() + end / LOOKS).map_err(RunError::Quiet)?;
        job.forget_events();
    }
    let summary = job.summary(scenario, began.elapsed().as_secs_f64());
    Ok(Ending::Finished(summary.validated(job.time()).map_err(RunError::Quiet)?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::run;
    use crate::scenario::template;
    use crate::units::Quantity;

    /// The lines of a summary but for wall time.
    fn quantities(ending: &Ending) -> Vec<String> {
        let Ending::Finished(summary) = ending else { panic!("it was not asked to stop: {ending:?}") };
        let lines = summary.to_json();
        lines.lines().filter(|line| !line.contains("\"wall_s\"")).map(str::to_owned).collect()
    }

    fn small(name: &str, settings: &[&str]) -> Scenario {
        Scenario::with_overrides(template(name).unwrap().text, settings).unwrap()
    }

    fn assert_same_as_a_run(scenario: &Scenario) {
        let folder = tempfile::tempdir().unwrap();
        let dir = folder.path().join("run");
        let loud = run(scenario, Path::new(""), &dir, &mut |_| ControlFlow::Continue(())).unwrap();
        let quiet = quiet(scenario, Path::new(""), &AtomicBool::new(false)).unwrap();
        assert_eq!(quantities(&quiet), quantities(&loud));
        let written = std::fs::read_to_string(dir.join("summary.json")).unwrap();
        let written: Vec<&str> = written.lines().filter(|line| !line.contains("\"wall_s\"")).collect();
        assert_eq!(quantities(&quiet), written);
    }

    #[test]
    fn hard_spheres_come_to_the_same_as_in_a_folder() {
        assert_same_as_a_run(&small("reacting", &["time.end=2 ms"]));
        assert_same_as_a_run(&small("reacting-published", &["time.end=0.1 ms"]));
    }

    #[test]
    fn soft_spheres_come_to_the_same_as_in_a_folder() {
        assert_same_as_a_run(&small("acoustic-published", &["time.end=0.2 s", "acoustics.beams.0.rays=200"]));
    }

    #[test]
    fn starts_from_another_run_come_to_the_same_as_in_a_folder() {
        let folder = tempfile::tempdir().unwrap();
        for (name, settings) in [
            ("acoustic-published", &["time.end=20 ms", "acoustics.beams.0.rays=200"][..]),
            ("reacting", &["time.end=0.2 ms"]),
        ] {
            let mut scenario = small(name, settings);
            let dir = folder.path().join(name);
            run(&scenario, Path::new(""), &dir, &mut |_| ControlFlow::Continue(())).unwrap();
            scenario.grains.clear();
            scenario.from = Some(dir);
            assert_same_as_a_run(&scenario);
        }
    }

    /// Values that a library puts past the check come to an error, never to quantities: heat and masses beyond doubles.
    #[test]
    fn what_overflows_is_an_error_and_no_summary() {
        type Spoil = fn(&mut Scenario);
        let spoils: [(&str, Spoil); 5] = [
            ("reacting", |s| s.materials.values_mut().for_each(|m| m.heat_capacity = Some(Quantity(1e308)))),
            ("reacting", |s| s.materials.values_mut().for_each(|m| m.density = Quantity(1e308))),
            ("reacting", |s| s.grains[0].velocity[0] = Quantity(1e160)),
            ("acoustic-published", |s| {
                s.materials.values_mut().for_each(|m| m.density = Quantity(1e307));
                s.grains[0].velocity[0] = Quantity(1e4);
            }),
            ("acoustic-published", |s| s.grains[0].velocity[0] = Quantity(1e160)),
        ];
        for (number, (name, spoil)) in spoils.into_iter().enumerate() {
            let few = ["time.end=0.1 ms", "grains.0.placement.random.count=20", "acoustics.beams.0.rays=10"];
            let mut scenario = small(name, if name == "acoustic-published" { &few } else { &few[..1] });
            spoil(&mut scenario);
            let ending = quiet(&scenario, Path::new(""), &AtomicBool::new(false));
            assert!(ending.is_err(), "spoil {number}: {ending:?}");
        }
    }

    #[test]
    fn it_stops_when_it_is_told_to() {
        let ending = quiet(&small("reacting", &[]), Path::new(""), &AtomicBool::new(true)).unwrap();
        assert!(matches!(ending, Ending::Interrupted(time) if time == 0.0), "{ending:?}");
    }
}
