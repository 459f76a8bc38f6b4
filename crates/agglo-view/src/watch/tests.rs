//! Small runs followed from their folders.

use std::ops::ControlFlow;

use super::*;
use agglo::run::run;

const SOFT: &str = r#"
    version = 1
    title = "two grains"
    time.end = "1 ms"
    [engine.verlet]
    [materials.glass]
    density = "2500 kg/m3"
    youngs_modulus = "1 MPa"
    poisson_ratio = 0.2
    [[grains]]
    material = "glass"
    velocity = ["0.3 m/s", "0 m/s", "0 m/s"]
    size.constant.radius = "0.1 mm"
    placement.list.positions = [["0 m", "0 m", "0 m"], ["1 mm", "0 m", "0 m"]]
    [contact.normal.hertz]
"#;

fn last_row(path: &Path) -> Vec<(String, f64)> {
    let text = std::fs::read_to_string(path).unwrap();
    let columns = text.lines().next().unwrap().split(',').map(str::to_owned);
    columns.zip(text.lines().last().unwrap().split(',').map(|word| word.parse().unwrap())).collect()
}

/// Each quantity is the number in the last row of the column that it names, and each curve ends there.
#[test]
fn quantities_are_those_of_the_last_rows() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path().join("run");
    let scenario = Scenario::from_toml(SOFT).unwrap_or_else(|faults| panic!("{faults}"));
    run(&scenario, folder.path(), &dir, &mut |_| ControlFlow::Continue(())).unwrap();
    let mut follower = Follower::open(&dir).unwrap();
    assert_eq!((follower.title(), follower.end(), follower.steps_are()), ("two grains", 1e-3, "steps"));
    let sight = follower.look().unwrap();
    assert_some!(sight.summary);
    assert_near!(sight.time, 1e-3, 1e-5, "in s");
    assert_at_least!(sight.quantities.len(), 8);
    for quantity in &sight.quantities {
        let (table, column) = quantity.column;
        let row = last_row(&dir.join("series").join(format!("{table}.csv")));
        let wanted = row.iter().find(|(name, _)| name == column).unwrap().1;
        assert_eq!(quantity.value.to_bits(), wanted.to_bits(), "{}", quantity.name);
        let shown = sight.curves.iter().find(|curve| curve.name == quantity.name);
        assert!(
            shown.is_none_or(|curve| curve.points.last().unwrap().1 == wanted),
            "wanted {wanted} at the end of {:?}",
            shown.map(|curve| &curve.points)
        );
    }
    let speed = sight.quantities.iter().find(|quantity| quantity.name == "mean speed").unwrap();
    assert_eq!(speed.text(), "300 mm/s");
    // There are no beams, so nothing is told of rays.
    assert_all!(sight.quantities.iter(), |quantity| !quantity.name.contains("ray"));
    assert_eq!(
        sight.curves.iter().map(|curve| curve.name).collect::<Vec<_>>(),
        ["dispersion degree", "mean speed"]
    );
}

#[test]
fn a_run_that_has_just_begun_has_no_quantities() {
    let folder = tempfile::tempdir().unwrap();
    let missing = Follower::open(folder.path()).unwrap_err().to_string();
    assert!(missing.ends_with("scenario.toml") && missing.contains("holds no run"), "{missing}");
    std::fs::write(folder.path().join("scenario.toml"), SOFT).unwrap();
    let sight = Follower::open(folder.path()).unwrap().look().unwrap();
    assert_empty!(sight.quantities);
    assert_none!(sight.summary);
    assert_eq!(sight.time, 0.0);
    std::fs::create_dir(folder.path().join("checkpoints")).unwrap();
    std::fs::write(folder.path().join("summary.json"), "{\"version\": ").unwrap();
    let damaged = Follower::open(folder.path()).unwrap().look().unwrap_err().to_string();
    assert!(damaged.contains("summary.json: it is damaged"), "{damaged}");
    std::fs::write(folder.path().join("scenario.toml"), "version = 1\nvelocity = 2\n").unwrap();
    assert_matches!(Follower::open(folder.path()), Err(WatchError::Scenario { .. }));
}
