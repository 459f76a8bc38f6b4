//! Numeric trouble: the run ends with a message that says what, when, where and what to do.

use crate::common::{Bench, STAGGERED, VERLET, assert_same, checkpoints, complained, ended, reference};

fn failing(scenario: &str, settings: &[&str]) -> (Bench, String) {
    let bench = Bench::with(scenario);
    let more: Vec<&str> = settings.iter().flat_map(|setting| ["--set", setting]).collect();
    let failed = ended(bench.start(&more).output().unwrap(), 1);
    assert_gone!(bench.run().join("summary.json"));
    (bench, complained(&failed))
}

fn assert_says(text: &str, words: &[&str]) {
    for word in words {
        assert!(text.contains(word), "no \"{word}\" in:\n{text}");
    }
}

/// Two grains fly at one another, a millimeter apart, at 10 m/s.
const MEETING: &str = r#"
version = 1
title = "meeting"
time.end = "1 ms"
engine.verlet.step = "5 us"
[materials.soft]
density = "2000 kg/m3"
youngs_modulus = "1 MPa"
poisson_ratio = 0.3
[[grains]]
material = "soft"
size.constant.radius = "1 mm"
[grains.placement.list]
positions = [["0 mm", "0 m", "0 m"], ["3 mm", "0 m", "0 m"]]
velocities = [["10 m/s", "0 m/s", "0 m/s"], ["-10 m/s", "0 m/s", "0 m/s"]]
[contact.normal.hertz]
[output]
checkpoints = "20 us"
"#;

#[test]
fn a_step_too_large_names_step_time_grain_laws_and_what_to_do() {
    let (bench, text) = failing(MEETING, &["engine.verlet.step=\"60 us\""]);
    let run = bench.run().display().to_string();
    let words = ["step 1 at t = 0", "step size 6.000e-5 s", "grain 0 moves 0.600 of its radius"];
    assert_says(&text, &words);
    let words = ["contact.normal.hertz", "limits.displacement = 0.5", "make the step smaller", &run];
    assert_says(&text, &words);
    assert_eq!(checkpoints(&bench.run()).len(), 1);
}

#[test]
fn an_overlap_too_deep_names_both_grains() {
    let (bench, text) = failing(MEETING, &[]);
    let words =
        ["step ", " at t = ", "grains 0 and 1 overlap", "limits.strain = 0.1", "contact.normal.hertz"];
    assert_says(&text, &words);
    assert_says(&text, &["make the contact stiffer", "checkpoint is kept"]);
    // Met after about 50 us; checkpoints every 20 us, the newest two kept.
    assert_eq!(checkpoints(&bench.run()).len(), 2);
    // It fails again in the same way: a run is the same to the last bit.
    let again = complained(&ended(bench.resume().output().unwrap(), 1));
    assert_says(&again, &[text.lines().next().unwrap()]);
}

/// A field that is infinite where grain 0 is, under both schemes.
#[test]
fn a_motion_that_is_not_finite_names_the_grain() {
    let field = "[fields.lorentz]\nelectric_field = [\"1/x\", \"0 V/m\", \"0 V/m\"]\n";
    let verlet = MEETING
        .replace("[contact", &format!("{field}[contact"))
        .replace("size.constant", "charge = \"1 C\"\nsize.constant");
    let engine = "engine.staggered = { initial_step = \"5 us\", largest_step = \"5 us\" }";
    let staggered = verlet.replace("engine.verlet.step = \"5 us\"", engine);
    for scenario in [verlet, staggered] {
        // No warning can make up for it.
        let (_bench, text) = failing(&scenario, &["limits.on_breach=\"warn\""]);
        assert_says(&text, &["step 1 at t = 0", "the motion of grain 0 is not finite", "fields.lorentz"]);
    }
}

/// A start that fails leaves no folder behind: the mended scenario runs with the same command.
#[test]
fn a_start_that_fails_leaves_nothing() {
    let relax = "[start.relax]\nspeed = \"1e-12 m/s\"\nlongest = \"10 us\"\ndamping_time = \"1 s\"\n[contact";
    let near = MEETING.replace("\"3 mm\"", "\"1.9 mm\"").replace("[contact", relax);
    let (bench, text) = failing(&near, &[]);
    assert_says(&text, &["start.relax", "m/s"]);
    assert_gone!(bench.run());
}

/// Warned, counted, and not stopped.
#[test]
fn breaches_may_be_warnings() {
    let bench = Bench::with(MEETING);
    let done = ended(bench.start(&["--set", "limits.on_breach=\"warn\""]).output().unwrap(), 0);
    assert_says(&complained(&done), &["warning: grains overlapped by more than limits.strain"]);
    let summary = std::fs::read_to_string(bench.run().join("summary.json")).unwrap();
    assert_says(&summary, &["grains overlapped by more than limits.strain"]);
}

/// Energy from nowhere: the step of 2.9/w is above the border of stability, 2/w of the spring, by far. It ends the run with a
/// message; where that much is allowed, the summary, the closing table and the first lines of the report say it.
#[test]
fn unexplained_energy_is_an_error_or_a_warning() {
    let unstable = MEETING
        .replace("\"5 us\"", "\"0.15 ms\"")
        .replace("contact.normal.hertz]", "contact.normal.hooke]\nstiffness = \"1650 N/m\"")
        .replace("youngs_modulus = \"1 MPa\"\npoisson_ratio = 0.3\n", "")
        .replace("\"10 m/s\"", "\"1 m/s\"")
        .replace("\"-10 m/s\"", "\"-1 m/s\"")
        .replace("\"3 mm\"", "\"2 mm\"")
        .replace("time.end = \"1 ms\"", "time.end = \"3 ms\"");
    let wide = ["limits.displacement=1e9", "limits.on_breach=\"warn\""];
    let (_, text) = failing(&unstable, &wide);
    assert_says(
        &text,
        &["the ledger does not explain", "more than limits.drift_error = 0.1", "make the step smaller"],
    );
    let bench = Bench::with(&unstable);
    let more: Vec<&str> =
        wide.iter().chain(&["limits.drift_error=1e9"]).flat_map(|set| ["--set", set]).collect();
    let done = ended(bench.start(&more).output().unwrap(), 0);
    assert_says(
        &complained(&done),
        &["warning: energy that the ledger does not explain is above limits.drift_warning"],
    );
    assert_says(
        &String::from_utf8_lossy(&done.stdout),
        &["unexplained energy", "above limits.drift_warning = 1e-3"],
    );
    let page = std::fs::read_to_string(bench.run().join("report.html")).unwrap();
    let lead = page.find("Not all energy is accounted for").expect("the report says it");
    assert!(lead < page.find("Energy is accounted for to").unwrap(), "in the first lines");
    // A limit of the user's own.
    let more: Vec<&str> = wide
        .iter()
        .chain(&["limits.drift_error=1e9", "limits.drift_warning=1e8"])
        .flat_map(|set| ["--set", set])
        .collect();
    let calm = Bench::with(&unstable);
    let done = ended(calm.start(&more).output().unwrap(), 0);
    assert_lacks!(complained(&done), "drift_warning");
}

/// Warnings of validity are the same after a stop; they are told once and counted at each look.
#[test]
fn models_out_of_their_range_are_warned_of() {
    let stokes = STAGGERED
        .replace("schiller_naumann", "stokes")
        .replace("strength.pressure", "frequency = \"20 kHz\"\nstrength.pressure");
    let bench = Bench::with(&stokes);
    let stopped = bench.stopped_after(150, &[]);
    let text = complained(&stopped);
    assert_says(&text, &["warning: ", "fields.drag", "Reynolds", "k a", "limits.drift_warning"]);
    assert_eq!(text.lines().filter(|line| line.starts_with("warning: ")).count(), 3, "{text}");
    ended(bench.resume().output().unwrap(), 0);
    let whole = Bench::with(&stokes);
    ended(whole.start(&[]).output().unwrap(), 0);
    assert_same(&bench.run(), &whole.run());
    // Grains of 10 cm at some m/s in water: far above 1000, too.
    let verlet = std::fs::read_to_string(reference(VERLET).join("summary.json")).unwrap();
    assert_says(&verlet, &["schiller_naumann", "1000"]);
}
