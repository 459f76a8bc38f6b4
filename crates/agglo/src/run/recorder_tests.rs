//! What is written when, by all three engines: due times that coincide with steps, steps over several due times, and
//! denser output while rays fly.

use std::ops::ControlFlow;
use std::path::Path;

use crate::record::frames::Collection;
use crate::run::{resume, run};
use crate::scenario::Scenario;

/// A grain at rest in an engine of fixed steps.
fn at_rest(engine: &str, end: &str, output: &str) -> Scenario {
    let hard = if engine.contains("event_driven") || engine.contains("time_stepped") {
        "volume = { lower = [\"-1 m\", \"-1 m\", \"-1 m\"], upper = [\"1 m\", \"1 m\", \"1 m\"] }\n\
         impact.restitution.constant.restitution = 1.0\n"
    } else {
        ""
    };
    let text = format!(
        "version = 1\ntime.end = \"{end}\"\n{engine}\n{hard}output = {{ {output} }}\n\
         materials.glass.density = \"2500 kg/m3\"\n[[grains]]\nmaterial = \"glass\"\n\
         size.constant.radius = \"1 mm\"\nplacement.list.positions = [[\"0 m\", \"0 m\", \"0 m\"]]\n"
    );
    Scenario::from_toml(&text).unwrap_or_else(|faults| panic!("{faults}"))
}

/// Times of rows and of frames, and the notes.
fn record(scenario: &Scenario) -> (Vec<f64>, Vec<f64>, Vec<String>) {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path().join("run");
    let mut notes = Vec::new();
    let mut observer = |progress: &crate::run::Progress| {
        notes.extend(progress.warnings.clone());
        ControlFlow::Continue(())
    };
    run(scenario, Path::new(""), &dir, &mut observer).unwrap();
    let (rows, frames) = times(&dir);
    (rows, frames, notes)
}

fn times(dir: &Path) -> (Vec<f64>, Vec<f64>) {
    let text = std::fs::read_to_string(dir.join("series/energy.csv")).unwrap();
    let first = |line: &str| line.split(',').next().unwrap().parse().unwrap();
    let frames = Collection::read(&dir.join("frames/grains.pvd")).unwrap();
    (text.lines().skip(1).map(first).collect(), frames.frames().map(|(time, _)| time).collect())
}

const ENGINES: [(&str, &str); 3] = [
    ("soft", "engine.verlet.step = \"STEP\""),
    ("steps", "engine.time_stepped = { longest_step = \"STEP\", shortest_step = \"1 ns\" }"),
    ("events", "engine.event_driven = {}"),
];

/// End, step and interval are multiples of one another: there is a row at each multiple and none is late. Sums of the
/// steps are off by n/2 roundings at the most: 1e-16 n of the time.
#[test]
fn rows_stand_at_every_multiple_of_the_interval() {
    let cases = [
        ("0.94 s", "0.02 s", "0.02 s", 48),
        ("1 ms", "1 us", "10 us", 101),
        ("0.3 s", "0.1 s", "0.1 s", 4),
        ("1 s", "0.01 s", "0.05 s", 21),
        ("0.7 ms", "0.7 us", "7 us", 101),
    ];
    for (name, engine) in ENGINES {
        for (end, step, interval, count) in cases {
            let output = format!("series = \"{interval}\", frames = \"{interval}\"");
            let scenario = at_rest(&engine.replace("STEP", step), end, &output);
            let every = scenario.output.series.unwrap().si();
            let (rows, frames, notes) = record(&scenario);
            assert_eq!((rows.len(), &rows), (count, &frames), "{name}, {end}, {step}, {interval}");
            for (number, row) in rows.iter().enumerate() {
                let due = number as f64 * every;
                assert!((row - due).abs() <= 1e-12 * due, "{name}: row {number} at {row} s for {due} s");
            }
            assert!(notes.is_empty(), "{name}: {notes:?}");
        }
    }
}

/// Steps of 1 ms and rows every 0.3 ms: a row a step at its own time, and the run says how many fell together. The
/// event-driven engine stops at any time, and has every row.
#[test]
fn a_step_over_several_due_times_has_one_row_and_says_so() {
    for (name, engine) in ENGINES {
        let scenario =
            at_rest(&engine.replace("STEP", "1 ms"), "6 ms", "series = \"0.3 ms\", frames = \"2 ms\"");
        let (rows, frames, notes) = record(&scenario);
        assert_eq!(frames.len(), 4, "{name}");
        if name == "events" {
            assert_eq!((rows.len(), notes.len()), (21, 0), "{name}");
        } else {
            // Turns 0 to 20 at seven steps.
            assert_eq!(rows.len(), 7, "{name}");
            let told = "14 rows that were due fell into one with others";
            assert!(notes.len() == 1 && notes[0].contains(told), "{name}: {notes:?}");
        }
    }
}

fn with_rays(pulses: &str) -> Scenario {
    let text = format!(
        "version = 1\ntime.end = \"40 us\"\nengine.verlet.step = \"0.1 us\"\n\
         output = {{ series = \"10 us\", frames = \"20 us\"{pulses} }}\n\
         [materials.glass]\ndensity = \"2500 kg/m3\"\nsound_speed = \"5000 m/s\"\n\
         [[grains]]\nmaterial = \"glass\"\nsize.constant.radius = \"1 mm\"\n\
         placement.list.positions = [[\"0 m\", \"0 m\", \"0 m\"], [\"0 m\", \"2.5 mm\", \"0 m\"]]\n\
         [acoustics.force.impulse]\nduration = \"1 us\"\n\
         [[acoustics.beams]]\nstart = [\"-4 mm\", \"0 m\", \"0 m\"]\ndirection = [1.0, 0.0, 0.0]\n\
         radius = \"1 mm\"\nrays = 40\nstrength.pressure = \"1 kPa\"\n\
         pulses = {{ first = \"5 us\", period = \"20 us\", count = 2 }}\n"
    );
    Scenario::from_toml(&text).unwrap_or_else(|faults| panic!("{faults}"))
}

const DENSE: &str = ", pulses = { series = \"0.5 us\", frames = \"2 us\" }";

/// From each launch to the first step without rays rows are half a microsecond apart; between pulses they are not.
#[test]
fn rows_and_frames_are_dense_while_rays_fly() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path().join("run");
    run(&with_rays(DENSE), Path::new(""), &dir, &mut |_| ControlFlow::Continue(())).unwrap();
    let text = std::fs::read_to_string(dir.join("series/rays.csv")).unwrap();
    let rows: Vec<Vec<f64>> = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|entry| entry.parse().unwrap_or(f64::NAN)).collect())
        .collect();
    let (time, in_flight) = (|row: &Vec<f64>| row[0], |row: &Vec<f64>| row[2]);
    for launch in [5e-6, 25e-6] {
        let first = rows.iter().position(|row| (time(row) - launch).abs() < 1e-12).unwrap();
        let flying = rows[first + 1..].iter().take_while(|row| in_flight(row) > 0.0).count();
        // The way of 4 mm at 1500 m/s takes 2.7 us.
        assert!(flying >= 5, "{flying} rows with rays after {launch} s");
        for (number, row) in (1..).zip(&rows[first + 1..=first + flying]) {
            let regular = (time(row) * 1e5).round() / 1e5;
            let due = launch + 0.5e-6 * f64::from(number);
            assert!((time(row) - due).abs() < 1e-12 || (time(row) - regular).abs() < 1e-12, "{}", time(row));
        }
        let gone = &rows[first + flying + 1];
        assert_eq!(in_flight(gone), 0.0, "the last row of a pulse has no rays");
        assert_at_most!(time(gone) - time(&rows[first + flying]), 0.5e-6 + 1e-12);
    }
    let between = rows.iter().filter(|row| (16e-6..24.9e-6).contains(&time(row))).count();
    assert_eq!(between, 1, "one row at 20 us: {rows:?}");
    let (_, frames) = times(&dir);
    assert!(frames.len() > 6 && frames.is_sorted_by(|a, b| a < b), "{frames:?}");
}

/// Dense output changes nothing: the summary is that of a run without, to the last bit.
#[test]
fn asking_for_output_in_pulses_changes_no_trajectory() {
    let quantities = |scenario: &Scenario| {
        let folder = tempfile::tempdir().unwrap();
        let dir = folder.path().join("run");
        run(scenario, Path::new(""), &dir, &mut |_| ControlFlow::Continue(())).unwrap();
        let text = std::fs::read_to_string(dir.join("summary.json")).unwrap();
        text.lines().filter(|line| !line.contains("wall_s")).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(quantities(&with_rays(DENSE)), quantities(&with_rays("")));
}

/// Stopped at any report and gone on with, the tables are those of a run that never stopped.
#[test]
fn rows_in_pulses_are_the_same_after_a_resume() {
    let whole = {
        let folder = tempfile::tempdir().unwrap();
        let dir = folder.path().join("run");
        run(&with_rays(DENSE), Path::new(""), &dir, &mut |_| ControlFlow::Continue(())).unwrap();
        std::fs::read_to_string(dir.join("series/rays.csv")).unwrap()
    };
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path().join("run");
    let mut scenario = with_rays(DENSE);
    scenario.output.checkpoints = Some(crate::units::Quantity(1.7e-6));
    run(&scenario, Path::new(""), &dir, &mut |_| ControlFlow::Break(())).unwrap();
    resume(&dir, &mut |_| ControlFlow::Continue(())).unwrap();
    assert_eq!(std::fs::read_to_string(dir.join("series/rays.csv")).unwrap(), whole);
}
