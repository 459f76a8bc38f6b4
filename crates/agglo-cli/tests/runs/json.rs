//! What programs are told of runs: one object a line, with the keys that the guide has.

use serde_json::{Value as Json, json};

use crate::common::{
    Bench, EVENTS, STAGGERED, agglo, assert_documented, assert_same, bytes, complained, ended, interrupted,
    objects, reference, until_it_succeeds, wait_for_step,
};

fn types(objects: &[Json]) -> Vec<&str> {
    objects.iter().map(|object| object["type"].as_str().unwrap()).collect()
}

#[test]
fn a_run_tells_what_it_does_and_ends_with_its_summary() {
    for (scenario, steps_are) in [(STAGGERED, "steps"), (EVENTS, "events")] {
        let bench = Bench::with(scenario);
        let done = ended(bench.start(&["--json"]).output().unwrap(), 0);
        assert_empty!(complained(&done));
        let objects = objects(&done);
        let [started, progress, .., finished] = objects.as_slice() else { panic!("{objects:?}") };
        for (object, heading) in
            [(started, "`started`"), (progress, "`progress` of a run"), (finished, "`finished`")]
        {
            assert_documented(object, heading);
        }
        let folder = Json::from(bench.run().display().to_string());
        assert_eq!((&started["verb"], &started["folder"]), (&json!("run"), &folder));
        assert_eq!((&progress["time_s"], &progress["steps_are"]), (&json!(0.0), &json!(steps_are)));
        let middle = types(&objects[1..objects.len() - 1]);
        assert!(middle.iter().all(|kind| ["progress", "warning"].contains(kind)), "{middle:?}");
        let file: Json =
            serde_json::from_slice(&std::fs::read(bench.run().join("summary.json")).unwrap()).unwrap();
        assert_eq!(
            (&finished["summary"], &finished["exit_code"], &finished["folder"]),
            (&file, &json!(0), &folder)
        );
        let page = bench.run().join("report.html").display().to_string();
        assert_eq!(finished["report"], json!(page));
        // Who is told changes nothing.
        assert_same(&bench.run(), reference(scenario));
        let again = self::objects(&ended(bench.resume().arg("--json").output().unwrap(), 0));
        assert_eq!(types(&again), ["finished"]);
        assert_eq!((&again[0]["summary"], &again[0]["wall_s"]), (&file, &Json::Null));
    }
}

/// Warnings come as they are for people, each wording once; their count is the summary's.
#[test]
fn warnings_are_objects() {
    let bench = Bench::with(STAGGERED);
    let warns = ["--json", "--no-report", "--set", "limits.drift_warning=1e-30"];
    let objects = objects(&ended(bench.start(&warns).output().unwrap(), 0));
    let warnings: Vec<&Json> = objects.iter().filter(|object| object["type"] == "warning").collect();
    assert!(!warnings.is_empty(), "{objects:?}");
    assert_documented(warnings[0], "`warning`");
    let told: Vec<&str> = warnings.iter().map(|warning| warning["message"].as_str().unwrap()).collect();
    assert!(told.iter().any(|words| words.contains("the ledger does not explain")), "{told:?}");
    let finished = objects.last().unwrap();
    assert_eq!((finished["type"].as_str(), &finished["report"]), (Some("finished"), &Json::Null));
}

#[test]
fn what_was_stopped_says_why_and_whether_it_goes_on() {
    let bench = Bench::with(STAGGERED);
    let output = ended(bench.start(&["--json", "--wall-time", "1 us"]).output().unwrap(), 3);
    assert_empty!(complained(&output));
    let objects = objects(&output);
    let stopped = objects.last().unwrap();
    assert_documented(stopped, "`stopped`");
    assert_eq!((&stopped["reason"], &stopped["can_resume"]), (&json!("wall_time"), &json!(true)));
    assert_eq!((&stopped["time_s"], &stopped["exit_code"]), (&json!(0.0), &json!(3)));
    assert_contains!(stopped["message"].as_str().unwrap(), "stopped at t = 0 s: the wall time of 1 us is up");
    std::fs::remove_dir_all(bench.run()).unwrap();
    let by_signal = until_it_succeeds(&bench.run(), || {
        let child = bench.start(&["--json"]).spawn().unwrap();
        wait_for_step(&bench.run(), 30);
        let output = interrupted(child, "INT").0;
        (output.status.code() != Some(0)).then(|| ended(output, 1))
    });
    let stopped = self::objects(&by_signal).pop().unwrap();
    assert_eq!((&stopped["reason"], &stopped["exit_code"]), (&json!("signal"), &json!(1)));
    assert!(stopped["time_s"].as_f64().unwrap() > 0.0, "{stopped}");
    ended(bench.resume().arg("--json").output().unwrap(), 0);
    assert_same(&bench.run(), reference(STAGGERED));
}

#[test]
fn check_gives_the_plan_in_numbers() {
    let bench = Bench::with(STAGGERED);
    let objects = objects(&ended(agglo(&["check", &bench.scenario(), "--json"]), 0));
    assert_eq!(types(&objects), ["plan"]);
    assert_documented(&objects[0], "`plan`");
    assert_documented(&objects[0]["run"], "`plan.run`");
    assert_eq!((&objects[0]["kind"], &objects[0]["campaign"]), (&json!("scenario"), &Json::Null));
    assert_eq!((&objects[0]["run"]["grains"], &objects[0]["run"]["pulses"]), (&json!(200), &json!(2)));
    assert!(objects[0]["run"]["memory_B"].as_f64().unwrap() > 0.0, "{}", objects[0]);
}

/// All at once, with their places; nothing is written, and nothing is said elsewhere.
#[test]
fn bad_input_is_refused_in_json_too() {
    let bench = Bench::with(&STAGGERED.replace("seed = 11", "sead = 11").replace("\"40 ms\"", "\"40 m\""));
    let before = bytes(bench.folder());
    let (file, set) = (bench.scenario(), ["--set", "medium.viscosity=1 m"]);
    let run = bench.run().display().to_string();
    let (check, start) = (["check", &file, "--json"], ["run", &file, "-o", &run, "--json"]);
    for arguments in [[&check[..], &set].concat(), [&start[..], &set].concat()] {
        let output = ended(agglo(&arguments), 2);
        assert_empty!(complained(&output));
        let objects = objects(&output);
        assert_eq!(types(&objects), ["refused"]);
        let refused = &objects[0];
        assert_documented(refused, "`refused`");
        assert_eq!((&refused["file"], &refused["exit_code"]), (&json!(file), &json!(2)));
        let faults = refused["faults"].as_array().unwrap();
        for fault in faults {
            assert_documented(fault, "`refused.faults`");
        }
        let keys: Vec<_> =
            faults.iter().map(|fault| (fault["key"].as_str().unwrap(), fault["line"].as_u64())).collect();
        assert_eq!(keys, [("sead", Some(4)), ("time.end", Some(5)), ("medium.viscosity", None)]);
        assert_contains!(faults[0]["help"].as_str().unwrap(), "did you mean \"seed\"?");
        assert_contains!(
            faults[1]["message"].as_str().unwrap(),
            "\"40 m\" is a length [m]; a time is wanted"
        );
        assert_eq!(faults[2]["setting"], json!("medium.viscosity=1 m"));
        assert_eq!(refused["message"], json!(format!("3 faults in {file}; nothing was run or written")));
    }
    // What is not about a file has no faults.
    for (arguments, words) in [
        (
            vec!["run", &file, "--json", "--wall-time", "0 s"],
            "--wall-time: found \"0 s\"; more than 0 is wanted",
        ),
        (vec!["check", "nowhere.toml", "--json"], "cannot read nowhere.toml"),
        (vec!["resume", "nowhere", "--json"], "there is no folder nowhere"),
    ] {
        let refused = objects(&ended(agglo(&arguments), 2)).pop().unwrap();
        assert_documented(&refused, "`refused`");
        assert_starts!(refused["message"].as_str().unwrap(), words);
        assert_eq!((&refused["faults"], &refused["file"]), (&json!([]), &Json::Null));
    }
    assert!(bytes(bench.folder()) == before, "something was written");
}

#[test]
fn what_fails_says_so_last() {
    let bench = Bench::with(STAGGERED);
    let fails = ["--json", "--set", "limits.strain=1e-12"];
    let objects = objects(&ended(bench.start(&fails).output().unwrap(), 1));
    let failed = objects.last().unwrap();
    assert_documented(failed, "`failed`");
    assert_contains!(failed["message"].as_str().unwrap(), "The last good checkpoint is kept");
    assert_eq!(failed["exit_code"], json!(1));
}

/// A dashboard needs the terminal, and the lines need the same.
#[cfg(feature = "watch")]
#[test]
fn a_dashboard_and_json_exclude_each_other() {
    let bench = Bench::with(STAGGERED);
    let text = complained(&ended(bench.start(&["--json", "--watch"]).output().unwrap(), 2));
    assert_contains!(text, "cannot be used with");
    assert_gone!(bench.run());
}
