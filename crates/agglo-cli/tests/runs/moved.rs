//! Folders that are moved elsewhere.

use std::fs;

use crate::common::{
    STAGGERED, agglo, assert_same, command, complained, ended, hold, interrupted, signal, until_it_succeeds,
    wait_for_step,
};

/// A scenario whose grains stand in a table.
fn with_a_table(folder: &std::path::Path) {
    fs::create_dir_all(folder.join("data")).unwrap();
    fs::write(
        folder.join("data/grains.csv"),
        "x_m,y_m,z_m,radius_m\n0,0,0,1e-3\n0.0025,0,0,1.1e-3\n0,0.0025,0.0001,0.9e-3\n",
    )
    .unwrap();
    let scenario = r#"
version = 1
time.end = "5 ms"
[engine.verlet]
step = "1 us"
[materials.glass]
density = "2500 kg/m3"
youngs_modulus = "10 MPa"
poisson_ratio = 0.2
[[grains]]
material = "glass"
size.constant.radius = "1 mm"
placement.table.file = "data/grains.csv"
velocity = ["0 m/s", "0 m/s", "-0.1 m/s"]
[contact.normal.hertz]
[contact.damping.restitution]
restitution = 0.9
[fields.gravity]
acceleration = ["0 m/s2", "0 m/s2", "-9.81 m/s2"]
"#;
    fs::write(folder.join("scenario.toml"), scenario).unwrap();
}

/// Tables of placements are in the folder: moved, and without what it was made from, it runs again by the command of its
/// report, goes on, and is reported.
#[test]
fn a_moved_folder_runs_again_goes_on_and_is_reported() {
    let (home, away) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    with_a_table(home.path());
    let path = |folder: &tempfile::TempDir, name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let whole = path(&home, "whole");
    ended(agglo(&["run", &path(&home, "scenario.toml"), "-o", &whole]), 0);
    let stopped = home.path().join("stopped");
    until_it_succeeds(&stopped, || {
        let arguments = ["run", &path(&home, "scenario.toml"), "-o", stopped.to_str().unwrap()];
        let child = command(&arguments).spawn().unwrap();
        wait_for_step(&stopped, 200);
        (interrupted(child, "INT").0.status.code() == Some(1)).then_some(())
    });
    let text = fs::read_to_string(home.path().join("whole/scenario.toml")).unwrap();
    assert!(text.contains("file = \"tables/grains.csv\""), "{text}");
    for name in ["whole", "stopped"] {
        fs::rename(home.path().join(name), away.path().join(name)).unwrap();
    }
    fs::remove_dir_all(home.path()).unwrap();
    let mut again = command(&["run", "scenario.toml", "-o", "../again"]);
    ended(again.current_dir(away.path().join("whole")).output().unwrap(), 0);
    assert_same(&away.path().join("again"), &away.path().join("whole"));
    ended(agglo(&["resume", &path(&away, "stopped")]), 0);
    assert_same(&away.path().join("stopped"), &away.path().join("whole"));
    ended(agglo(&["report", &path(&away, "whole")]), 0);
}

/// Scenarios without tables have no folder for them.
#[test]
fn without_tables_there_is_no_folder_of_tables() {
    assert_gone!(crate::common::reference(STAGGERED).join("tables"));
}

/// A folder that is removed, or removed and used by another run, while a run writes into it: no advice to resume it, and
/// what is there now is as it was.
#[test]
fn a_folder_removed_while_a_run_goes_on_is_not_recommended() {
    // Much longer than it will live, so that it writes again for sure; and seldom, so that it is not held while it writes.
    const LONG: [&str; 8] = [
        "--set",
        "time.end=10 s",
        "--set",
        "output.series=0.1 s",
        "--set",
        "output.frames=0.1 s",
        "--set",
        "output.checkpoints=10 s",
    ];
    let bench = crate::common::Bench::with(STAGGERED);
    let held = || {
        let child = bench.start(&LONG).spawn().unwrap();
        wait_for_step(&bench.run(), 0);
        std::thread::sleep(std::time::Duration::from_millis(20));
        assert!(hold(&child), "it has ended");
        child
    };
    let child = held();
    fs::remove_dir_all(bench.run()).unwrap();
    signal(&child, "CONT");
    let text = complained(&ended(child.wait_with_output().unwrap(), 1));
    assert!(text.contains("was removed or taken over") && !text.contains("agglo resume"), "{text}");
    assert!(!bench.run().exists(), "it was made again");

    let child = held();
    fs::remove_dir_all(bench.run()).unwrap();
    ended(bench.start(&["--no-report"]).output().unwrap(), 0);
    let before = crate::common::bytes(&bench.run());
    signal(&child, "CONT");
    let text = complained(&ended(child.wait_with_output().unwrap(), 1));
    assert!(text.contains("was removed or taken over"), "{text}");
    assert!(crate::common::bytes(&bench.run()) == before, "the other run was changed");
}
