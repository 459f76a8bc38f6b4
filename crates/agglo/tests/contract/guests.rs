//! Runs with guests: a caller's own forces, measures and rule. The same files after a stop, a closed ledger, and refusals.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Duration;

use agglo::engine::soft::{Hook, LoadViews, Scene};
use agglo::math::Vec3;
use agglo::run::{Ending, Guests, Look, Onlooker, Progress, RunError, Sight, resume, resume_with, run_with};
use agglo::scenario::{Scenario, template};
use agglo::units::Quantity;
use serde_json::Value as Json;

use crate::common;

/// A trap about the axis z: stiff enough to be seen, and known to the automatic step.
struct Trap {
    /// Stiffness over mass [1/s2].
    square: f64,
    /// When it cannot any more [s].
    until: f64,
    fault: std::sync::Mutex<Option<String>>,
}

impl Trap {
    fn boxed(until: f64) -> Vec<Box<dyn Hook>> {
        vec![Box::new(Self { square: 4e4, until, fault: std::sync::Mutex::new(None) })]
    }
}

impl Hook for Trap {
    fn name(&self) -> &'static str {
        "trap"
    }

    fn load(&self, now: &Scene<'_>, loads: &mut LoadViews<'_>) {
        if now.time > self.until {
            *self.fault.lock().unwrap() = Some("the trap is worn out".to_owned());
            return;
        }
        for (at, place) in now.motion.position.iter().enumerate() {
            loads.force[at] += Vec3::new(place.x, place.y, 0.0) * (-self.square * now.grains.mass[at]);
        }
    }

    fn pace(&self, _: &Scene<'_>) -> Option<agglo::math::Pace> {
        Some(agglo::math::Pace { square: self.square, rate: 0.0 })
    }

    fn fault(&self) -> Option<String> {
        self.fault.lock().unwrap().clone()
    }
}

/// Looks at how far and how fast grains are, and now and then does what it is told.
#[derive(Default)]
struct Eye {
    /// The look at which it sleeps, fails or ends the run, counted from 0.
    sleeps: Option<usize>,
    fails: Option<usize>,
    ends_at: Option<f64>,
    looks: usize,
}

impl Onlooker for Eye {
    fn measures(&self) -> Vec<String> {
        ["farthest_m", "none", "Largest_1"].map(str::to_owned).into()
    }

    fn has_rule(&self) -> bool {
        true
    }

    fn look(&mut self, now: &Sight<'_>) -> Result<Look, String> {
        let number = self.looks;
        self.looks += 1;
        if self.fails == Some(number) {
            return Err(format!("look {number} failed"));
        }
        if self.sleeps == Some(number) {
            // Longer than the tenth of a second in which an observer is told.
            std::thread::sleep(Duration::from_millis(150));
        }
        let farthest = now.grains.position.iter().map(|place| place.norm()).fold(0.0, f64::max);
        let largest = now.primaries.map_or(f64::NAN, |counts| f64::from(*counts.iter().max().unwrap()));
        let is_over = self.ends_at.is_some_and(|end| now.time >= end);
        Ok(Look { values: vec![farthest, f64::NAN, largest], is_over })
    }
}

fn guests(eye: &mut Eye, with_force: bool) -> Guests<'_> {
    let forces = if with_force { Trap::boxed(f64::INFINITY) } else { Vec::new() };
    Guests { forces, onlooker: Some(eye), ..Guests::default() }
}

/// Rows every hundredth of a run, frames every tenth, checkpoints every quarter of it.
fn small(name: &str, end: f64, settings: &[&str]) -> Scenario {
    let mut scenario = Scenario::with_overrides(template(name).unwrap().text, settings).unwrap();
    scenario.time.end = Quantity(end);
    scenario.output.series = Some(Quantity(0.01 * end));
    scenario.output.frames = Some(Quantity(0.1 * end));
    scenario.output.checkpoints = Some(Quantity(0.25 * end));
    scenario
}

fn soft() -> Scenario {
    small(
        "acoustic",
        2e-3,
        &["grains.0.placement.random.count=30", "acoustics.beams.0.rays=100", "engine.verlet.step=10 us"],
    )
}

fn hard() -> Scenario {
    small("reacting", 2e-3, &["grains.0.size.length_ratio.count=100", "grains.0.placement.fill.count=100"])
}

fn go(scenario: &Scenario, dir: &Path, guests: Guests<'_>) -> Result<Ending, RunError> {
    run_with(scenario, Path::new(""), dir, guests, &mut |_| ControlFlow::Continue(()))
}

fn on(dir: &Path, until: Option<f64>, guests: Guests<'_>) -> Result<Ending, RunError> {
    resume_with(dir, until.map(Quantity), guests, &mut |_| ControlFlow::Continue(()))
}

/// All files of a run but for its checkpoints, without the wall time.
fn files(dir: &Path) -> BTreeMap<PathBuf, String> {
    let mut found = BTreeMap::new();
    for part in [dir.to_owned(), dir.join("series"), dir.join("frames")] {
        for entry in std::fs::read_dir(part).unwrap().map(Result::unwrap) {
            let path = entry.path();
            if path.is_file() && entry.file_name() != ".agglo.lock" {
                let text = String::from_utf8_lossy(&std::fs::read(&path).unwrap()).into_owned();
                let text =
                    text.lines().filter(|line| !line.contains("\"wall_s\"")).collect::<Vec<_>>().join("\n");
                found.insert(path.strip_prefix(dir).unwrap().to_owned(), text);
            }
        }
    }
    found
}

fn assert_same_files(found: &Path, wanted: &Path, what: &str) {
    let [found, wanted] = [found, wanted].map(files);
    assert_eq!(found.keys().collect::<Vec<_>>(), wanted.keys().collect::<Vec<_>>(), "{what}");
    for (name, text) in &wanted {
        assert!(found[name] == *text, "{what}: {} differs", name.display());
    }
}

fn own(dir: &Path) -> Vec<Vec<f64>> {
    let text = std::fs::read_to_string(dir.join("series/own.csv")).unwrap();
    assert!(text.starts_with("time_s,farthest_m,none,Largest_1\n0,"), "{text}");
    text.lines().skip(1).map(|line| line.split(',').map(|word| word.parse().unwrap()).collect()).collect()
}

/// Stopped by the observer, by a look that fails and by a force that fails, and gone on with: the files of a whole run.
#[test]
fn same_files_after_stops_of_all_kinds() {
    for (scenario, is_hard) in [(soft(), false), (hard(), true)] {
        let place = tempfile::tempdir().unwrap();
        let [whole, cut] = ["whole", "cut"].map(|name| place.path().join(name));
        go(&scenario, &whole, guests(&mut Eye::default(), !is_hard)).unwrap();
        let rows = own(&whole);
        let energy = std::fs::read_to_string(whole.join("series/energy.csv")).unwrap();
        let times =
            energy.lines().skip(1).map(|line| line.split(',').next().unwrap().parse::<f64>().unwrap());
        assert_eq!(rows.iter().map(|row| row[0]).collect::<Vec<_>>(), times.collect::<Vec<_>>());
        assert!(rows.len() > 100, "{} rows of {}", rows.len(), scenario.title);
        assert!(rows.iter().all(|row| row[2].is_nan() && row[3].is_nan() != is_hard), "{:?}", rows[100]);

        let mut sleepy = Eye { sleeps: Some(30), ..Eye::default() };
        let mut stop = |now: &Progress| {
            if now.time > 0.0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let ending = run_with(&scenario, Path::new(""), &cut, guests(&mut sleepy, !is_hard), &mut stop);
        assert_matches!(ending, Ok(Ending::Interrupted(_)));
        // Look 55 of the whole, and the one at its end. The observer stopped it after look 30.
        for fails in [24, rows.len() - 1 - 55] {
            let mut blind = Eye { fails: Some(fails), ..Eye::default() };
            let error = on(&cut, None, guests(&mut blind, !is_hard)).unwrap_err();
            assert!(error.to_string().starts_with(&format!("look {fails} failed\nA checkpoint")), "{error}");
            assert_eq!(error.exit_code(), 1);
        }
        if !is_hard {
            let worn = Guests {
                forces: Trap::boxed(1.1e-3),
                onlooker: Some(&mut Eye::default()),
                ..Guests::default()
            };
            let error = on(&cut, None, worn).unwrap_err().to_string();
            assert!(error.contains("trap gave no forces: the trap is worn out"), "{error}");
        }
        on(&cut, None, guests(&mut Eye::default(), !is_hard)).unwrap();
        assert_same_files(&cut, &whole, &scenario.title);
    }
}

/// Its work is in the ledger, which closes as well as without it.
#[test]
fn the_ledger_closes_with_a_force() {
    let place = tempfile::tempdir().unwrap();
    let dir = place.path().join("run");
    go(&soft(), &dir, guests(&mut Eye::default(), true)).unwrap();
    let summary: Json = serde_json::from_slice(&std::fs::read(dir.join("summary.json")).unwrap()).unwrap();
    let number = |key: &str| summary["energy"][key].as_f64().unwrap();
    assert!(number("work_custom_J").abs() > 1e-6 * number("at_start_J").abs(), "{summary}");
    assert_below!(number("unexplained_largest"), 1e-3);
}

/// How far the grain is along x.
struct Far;

impl Onlooker for Far {
    fn measures(&self) -> Vec<String> {
        vec!["x_m".to_owned()]
    }

    fn look(&mut self, now: &Sight<'_>) -> Result<Look, String> {
        Ok(Look { values: vec![now.grains.position[0].x], is_over: false })
    }
}

/// Overwrites instead of adding: what it is given is its own.
fn push(acceleration: f64) -> Box<dyn Hook> {
    Box::new(move |now: &Scene<'_>, loads: &mut LoadViews<'_>| {
        loads.force[0] = Vec3::new(acceleration * now.grains.mass[0], 0.0, 0.0);
    })
}

/// Free grains under two constant accelerations: x = (a + b) t²/2, which velocity Verlet has to rounding; work m (a + b) x.
#[test]
fn forces_add_up_and_are_those_of_newton() {
    let text = "version = 1\ntime.end = \"10 ms\"\nengine.verlet.step = \"10 us\"\n\
                output = { series = \"1 ms\" }\nmaterials.glass.density = \"2500 kg/m3\"\n[[grains]]\n\
                material = \"glass\"\nsize.constant.radius = \"1 mm\"\n\
                placement.list.positions = [[\"0 m\", \"0 m\", \"0 m\"]]\n";
    let place = tempfile::tempdir().unwrap();
    let dir = place.path().join("run");
    let mut far = Far;
    let forces = vec![push(3.0), push(-1.0)];
    go(&common::scenario(text), &dir, Guests { forces, onlooker: Some(&mut far), ..Guests::default() })
        .unwrap();
    let table = std::fs::read_to_string(dir.join("series/own.csv")).unwrap();
    let last: Vec<f64> = table.lines().last().unwrap().split(',').map(|word| word.parse().unwrap()).collect();
    assert_close!(last[1], 0.5 * 2.0 * last[0] * last[0], 1e-12, "m");
    let summary: Json = serde_json::from_slice(&std::fs::read(dir.join("summary.json")).unwrap()).unwrap();
    let mass = 4.0 / 3.0 * std::f64::consts::PI * 1e-9 * 2500.0;
    assert_close!(summary["energy"]["work_custom_J"].as_f64().unwrap(), mass * 2.0 * last[1], 1e-12, "J");
}

/// The rule ends a run at the first row that it is true for, with last row, frame, summary and a warning; whoever goes on to a
/// later end comes to the same as one that had this end from the start.
#[test]
fn a_rule_ends_a_run() {
    for (scenario, is_hard) in [(soft(), false), (hard(), true)] {
        let place = tempfile::tempdir().unwrap();
        let [dir, longer] = ["run", "longer"].map(|name| place.path().join(name));
        let rule = || Eye { ends_at: Some(1.23e-3), ..Eye::default() };
        let Ending::Finished(summary) = go(&scenario, &dir, guests(&mut rule(), !is_hard)).unwrap() else {
            panic!("nobody stopped it")
        };
        let rows = own(&dir);
        let last = rows.last().unwrap()[0];
        assert!((1.23e-3..1.26e-3).contains(&last), "{last} s");
        assert_eq!(rows.len(), 63, "{}", scenario.title);
        let told: Vec<_> = summary.warnings().iter().filter(|(text, _)| text.contains("by a rule")).collect();
        assert!(told.len() == 1 && *told[0].1 == 1, "{told:?}");
        assert!(told[0].0.contains("before its end at 2 ms"), "{told:?}");
        let frames = std::fs::read_to_string(dir.join("frames/grains.pvd")).unwrap();
        assert!(frames.contains(&format!("timestep=\"{last}\"")), "no frame at {last} s: {frames}");
        assert_matches!(on(&dir, None, Guests::default()), Ok(Ending::Finished(_)));

        let mut scenario = scenario;
        scenario.time.end = Quantity(3e-3);
        go(&scenario, &longer, guests(&mut rule(), !is_hard)).unwrap();
        on(&dir, Some(3e-3), guests(&mut rule(), !is_hard)).unwrap();
        assert_eq!(own(&dir).len(), own(&longer).len(), "{}", scenario.title);
        for table in ["series/own.csv", "series/energy.csv", "frames/grains.pvd"] {
            let [found, wanted] =
                [&dir, &longer].map(|dir| std::fs::read_to_string(dir.join(table)).unwrap());
            assert!(found == wanted, "{table} of {} differs", scenario.title);
        }
    }
}

/// A rule that holds at the start, and a run killed between its last checkpoint and its summary.
#[test]
fn what_a_rule_ended_is_ended_after_a_restart_too() {
    let place = tempfile::tempdir().unwrap();
    let dir = place.path().join("run");
    let rule = || Eye { ends_at: Some(0.0), ..Eye::default() };
    go(&hard(), &dir, guests(&mut rule(), false)).unwrap();
    assert_eq!(own(&dir).len(), 1);
    let before = files(&dir);
    std::fs::remove_file(dir.join("summary.json")).unwrap();
    on(&dir, None, guests(&mut rule(), false)).unwrap();
    assert!(files(&dir) == before, "the files of a run that was killed at its end differ");
}

/// What cannot be a guest is refused before anything is written, and a first look or force that fails leaves no folder.
#[test]
fn what_cannot_be_is_refused_and_leaves_nothing() {
    struct Named(Vec<&'static str>, f64, bool);
    impl Onlooker for Named {
        fn measures(&self) -> Vec<String> {
            self.0.iter().map(|name| (*name).to_owned()).collect()
        }

        fn look(&mut self, _: &Sight<'_>) -> Result<Look, String> {
            Ok(Look { values: vec![self.1], is_over: self.2 })
        }
    }
    let place = tempfile::tempdir().unwrap();
    let dir = place.path().join("run");
    let cases = [
        (vec!["a b"], 0.0, false, 2, "the measure \"a b\": letters, digits and underscores"),
        (vec![""], 0.0, false, 2, "the measure \"\": letters"),
        (vec!["größe"], 0.0, false, 2, "letters, digits"),
        (vec!["time_s"], 0.0, false, 2, "has the time already"),
        (vec!["a", "b", "a"], 0.0, false, 2, "\"a\": two measures have this name"),
        (vec!["a", "b"], 0.0, false, 1, "a look gave 1 values, and there are 2 measures"),
        (vec!["a"], f64::INFINITY, false, 1, "the measure a is infinite"),
        (vec!["a"], 0.0, true, 1, "has_rule()"),
    ];
    for (names, value, is_over, code, words) in cases {
        let mut named = Named(names, value, is_over);
        let guests = Guests { onlooker: Some(&mut named), ..Guests::default() };
        let error = go(&hard(), &dir, guests).unwrap_err();
        assert!(error.to_string().contains(words), "{error}");
        assert_eq!(error.exit_code(), code, "{error}");
        assert!(!dir.exists(), "{words}: the folder was left");
    }
    let error = go(&hard(), &dir, guests(&mut Eye::default(), true)).unwrap_err();
    assert!(error.to_string().contains("forces act on soft spheres"), "{error}");
    assert_eq!((error.exit_code(), dir.exists()), (2, false), "{error}");
    let worn = Guests { forces: Trap::boxed(-1.0), ..Guests::default() };
    let error = go(&soft(), &dir, worn).unwrap_err();
    assert!(error.to_string().contains("worn out"), "{error}");
    assert!(!dir.exists(), "the folder was left");
}

/// Nobody goes on with a run without its guests, or with others, and nothing is changed.
#[test]
fn a_run_goes_on_with_its_own_guests_alone() {
    let place = tempfile::tempdir().unwrap();
    let [dir, alone] = ["run", "alone"].map(|name| place.path().join(name));
    let mut blind = Eye { fails: Some(30), ..Eye::default() };
    go(&soft(), &dir, guests(&mut blind, true)).unwrap_err();
    let before = files(&dir);
    let refused = |outcome: Result<Ending, RunError>, words: &[&str]| {
        let error = outcome.unwrap_err();
        assert_eq!(error.exit_code(), 2, "{error}");
        for words in words {
            assert!(error.to_string().contains(words), "{error}");
        }
        assert!(files(&dir) == before, "files were changed by what was refused: {error}");
    };
    let began = "began with the force \"trap\", the measure farthest_m, the measure none, the measure Largest_1, a rule";
    let nothing = "and is to go on with nothing of the caller's own";
    refused(resume(&dir, &mut |_| ControlFlow::Continue(())), &[began, nothing, "agglo::run::resume_with"]);
    refused(on(&dir, Some(9.0), Guests::default()), &[began, nothing]);
    refused(on(&dir, None, guests(&mut Eye::default(), false)), &["to go on with the measure farthest_m"]);
    let force = Guests { forces: Trap::boxed(f64::INFINITY), ..Guests::default() };
    refused(on(&dir, None, force), &["to go on with the force \"trap\"\n"]);
    on(&dir, None, guests(&mut Eye::default(), true)).unwrap();

    let stopped = &mut |_: &Progress| ControlFlow::Break(());
    run_with(&hard(), Path::new(""), &alone, Guests::default(), stopped).unwrap();
    let error = on(&alone, None, guests(&mut Eye::default(), false)).unwrap_err();
    assert!(
        error.to_string().contains("began with nothing of the caller's own, and is to go on with the"),
        "{error}"
    );
    on(&alone, None, Guests::default()).unwrap();
    assert!(!alone.join("series/own.csv").exists(), "a table without measures");
}
