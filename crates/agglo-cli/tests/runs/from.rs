//! Runs that start from the state of another run.

use std::fs;
use std::path::{Path, PathBuf};

use crate::common::{
    Bench, EVENTS, STAGGERED, STEPS, VERLET, agglo, assert_same, bytes, checkpoints, command, complained,
    ended, number, reference, said, summary,
};

/// A scenario without its grains, with another title, and with a material before all others by name.
fn next(scenario: &str) -> String {
    let (before, rest) = scenario.split_once("[[grains]]").unwrap();
    // The tables of the group end where the next table that is not of the group begins.
    let lines: Vec<&str> = rest.lines().collect();
    let is_next = |line: &&str| line.starts_with('[') && !line.starts_with("[grains");
    let at = lines.iter().position(is_next).unwrap();
    let text = format!("{before}{}\n", lines[at..].join("\n"));
    let text: String =
        text.lines().filter(|line| !line.starts_with("title")).flat_map(|line| [line, "\n"]).collect();
    format!("title = \"the next\"\n{text}[materials.aaa]\n{}", another_material(scenario))
}

/// What the first material of a scenario says, with another density.
fn another_material(scenario: &str) -> String {
    let (_, rest) = scenario.split_once("[materials.").unwrap();
    let own = rest.lines().skip(1).take_while(|line| !line.starts_with('['));
    let others = own.filter(|line| !line.starts_with("density")).flat_map(|line| [line, "\n"]);
    others.chain(["density = \"1 g/cm3\"\n"]).collect()
}

/// A folder with the scenario that goes on, and where its run goes.
struct Next {
    bench: Bench,
}

impl Next {
    fn of(scenario: &str) -> Self {
        Self { bench: Bench::with(scenario) }
    }

    fn run(&self, from: &Path, more: &[&str]) -> std::process::Command {
        let mut order = self.bench.start(more);
        order.arg("--from").arg(from);
        order
    }

    fn refused(&self, from: &Path, words: &[&str]) {
        let text = complained(&ended(self.run(from, &[]).output().unwrap(), 2));
        assert!(words.iter().all(|word| text.contains(word)), "{words:?} in {text}");
        assert!(!self.bench.run().exists(), "something was written: {text}");
    }
}

/// Entries of a row of a table by the names of its columns.
fn entries(run: &Path, table: &str, is_last: bool) -> Vec<(String, String)> {
    let text = fs::read_to_string(run.join(table)).unwrap();
    let mut lines = text.lines();
    let names = lines.next().unwrap().split(',').map(str::to_owned);
    let row = if is_last { lines.next_back() } else { lines.next() };
    names.zip(row.unwrap().split(',').map(str::to_owned)).collect()
}

fn entry(run: &Path, table: &str, is_last: bool, column: &str) -> f64 {
    let found = entries(run, table, is_last);
    found.iter().find(|(name, _)| name == column).unwrap_or_else(|| panic!("{column}")).1.parse().unwrap()
}

/// Frames of grains without their times.
fn frame(run: &Path, number: usize) -> Vec<u8> {
    let bytes = fs::read(run.join(format!("frames/grains_{number:06}.vtp"))).unwrap();
    let grains = bytes.windows(6).position(|word| word == b"<Piece").unwrap();
    bytes[grains..].to_vec()
}

fn last_frame(run: &Path) -> usize {
    fs::read_dir(run.join("frames"))
        .unwrap()
        .filter(|entry| entry.as_ref().unwrap().file_name().to_string_lossy().starts_with("grains_"))
        .count()
        - 1
}

/// Energies, bonds and clusters at its start are those at the other's end; its folder needs the other no more, runs again to
/// the same bits, and is resumed to the same bits.
#[test]
fn soft_grains_go_on_with_bonds_and_names() {
    let first = reference(VERLET);
    let next = Next::of(&next(VERLET));
    let (home, run) = (tempfile::tempdir().unwrap(), next.bench.run());
    let copied = home.path().join("first");
    assert_eq!(
        std::process::Command::new("cp").arg("-r").arg(first).arg(&copied).status().unwrap().code(),
        Some(0),
        "exit code"
    );

    let mut check = command(&["check", &next.bench.scenario()]);
    let plan = said(&ended(check.arg("--from").arg(&copied).output().unwrap(), 0));
    let bonds = entry(first, "series/clusters.csv", true, "bonds");
    assert!(plan.contains(&format!("verlet at t = 30 ms: 200 grains, {bonds} bonds")), "{plan}");
    assert!(
        plan.contains("no grain is made of aaa") && !plan.contains("no grain is made of ceramic"),
        "{plan}"
    );

    ended(next.run(&copied, &[]).output().unwrap(), 0);
    for column in ["kinetic_J", "rotational_J", "elastic_J", "bonds_J"] {
        let [before, after] = [(first, true), (run.as_path(), false)]
            .map(|(run, is_last)| entry(run, "series/energy.csv", is_last, column));
        // Sums are made in another order.
        assert!((after - before).abs() <= 1e-12 * before, "{column}: {before} J before, {after} J after");
    }
    assert_above!(bonds, 10.0);
    assert_eq!(entry(&run, "series/clusters.csv", false, "bonds"), bonds);
    let ends = summary(first)["clusters"].clone();
    let starts = summary(&run)["clusters_start"].clone();
    assert_eq!(number(&ends, "count"), number(&starts, "count"));
    assert_eq!(fs::read_dir(run.join("tables")).unwrap().count(), 1);

    fs::remove_dir_all(home.path()).unwrap();
    let again = next.bench.folder().join("again");
    let mut order = command(&["run", "scenario.toml", "-o", again.to_str().unwrap()]);
    ended(order.current_dir(&run).output().unwrap(), 0);
    assert_same(&again, &run);
    let stopped = Bench::with(&fs::read_to_string(run.join("scenario.toml")).unwrap());
    assert_eq!(
        std::process::Command::new("cp")
            .arg("-r")
            .arg(run.join("tables"))
            .arg(stopped.folder())
            .status()
            .unwrap()
            .code(),
        Some(0),
        "exit code"
    );
    stopped.stopped_after(60, &[]);
    ended(stopped.resume().output().unwrap(), 0);
    assert_same(&stopped.run(), &run);
}

/// From impact to impact, and step by step; what has grown is what it was.
#[test]
fn hard_grains_go_on_with_what_they_grew_from() {
    for scenario in [EVENTS, STEPS] {
        let first = reference(scenario);
        // After its own, so that the number of that is the same.
        let next = Next::of(&next(scenario).replace("[materials.aaa]", "[materials.zzz]"));
        let run = next.bench.run();
        ended(next.run(first, &[]).output().unwrap(), 0);
        let [before, after] = [first, &run].map(summary);
        assert_eq!(number(&before, "grains_end"), number(&after, "grains_start"));
        // Names, places, velocities, primary grains and all else that a frame has.
        assert!(frame(first, last_frame(first)) == frame(&run, 0), "the first frame is not the last one");
        for column in ["kinetic_J", "thermal_J"] {
            let [before, after] = [(first, true), (run.as_path(), false)]
                .map(|(run, is_last)| entry(run, "series/energy.csv", is_last, column));
            assert!((after / before - 1.0).abs() < 1e-12, "{column}: {before} J before, {after} J after");
        }
        let again = next.bench.folder().join("again");
        let mut order = command(&["run", "scenario.toml", "-o", again.to_str().unwrap()]);
        ended(order.current_dir(&run).output().unwrap(), 0);
        assert_same(&again, &run);
    }
}

/// A step leaves grains in walls, in one another, and outside of an antipodal volume; a merger leaves a larger one in its
/// neighbors: any checkpoint will do.
#[test]
fn any_state_of_hard_spheres_is_a_start() {
    let cases = [(STEPS, "reflecting"), (STEPS, "antipodal"), (STEPS, "periodic")];
    for (scenario, boundary) in cases.into_iter().chain([(EVENTS, "periodic"), (EVENTS, "reflecting")]) {
        let faces = |word: &str| format!("boundary = \"{word}\"");
        let scenario = scenario.replace(&faces("reflecting"), &faces(boundary));
        let scenario = scenario.replace(&faces("periodic"), &faces(boundary));
        assert!(scenario.contains(&faces(boundary)), "{scenario}");
        let first = Bench::with(&scenario);
        ended(first.start(&["--no-report"]).output().unwrap(), 0);
        for (step, checkpoint) in checkpoints(&first.run()) {
            let next = Next::of(&next(&scenario));
            let done = next.run(&checkpoint, &["--no-report"]).output().unwrap();
            assert!(done.status.success(), "{boundary}, step {step}: {}", complained(&done));
        }
    }
}

/// An earlier state is named by its checkpoint, in the scenario as well, relative to where that lies.
#[test]
fn a_checkpoint_is_as_good_as_a_folder() {
    let first = reference(STEPS);
    let earlier = checkpoints(first)[0].1.clone();
    let by_order = Next::of(&next(STEPS));
    ended(by_order.run(&earlier, &["--no-report"]).output().unwrap(), 0);
    let by_key = Bench::with(&("start.from = \"state.agglo\"\n".to_owned() + &next(STEPS)));
    fs::copy(&earlier, by_key.folder().join("state.agglo")).unwrap();
    ended(by_key.start(&["--no-report"]).output().unwrap(), 0);
    let [a, b] = [by_order.bench.run(), by_key.run()].map(|run| bytes(&run.join("series")));
    assert!(a == b, "the series differ");
    let by_end = Next::of(&next(STEPS));
    ended(by_end.run(first, &["--no-report"]).output().unwrap(), 0);
    assert!(bytes(&by_end.bench.run().join("series")) != a, "the state was that of the end");
}

/// Rays are not part of a start; what else is left behind is warned of, too.
#[test]
fn what_is_left_behind_is_warned_of() {
    let flying = Bench::with(STAGGERED);
    ended(flying.start(&["--no-report", "--set", "time.end=1.5 ms"]).output().unwrap(), 0);
    let without_springs = next(STAGGERED)
        .replace("[contact.friction.mindlin]\nstatic_friction = 0.4\ndynamic_friction = 0.3\n", "");
    let next = Next::of(&without_springs);
    let text = complained(&ended(next.run(&flying.run(), &["--no-report"]).output().unwrap(), 0));
    assert!(text.contains("rays were in flight in the run that this one starts from"), "{text}");
    let warnings = summary(&next.bench.run())["warnings"].to_string();
    assert!(warnings.contains("rays were in flight"), "{warnings}");
}

#[test]
fn what_does_not_fit_is_refused_by_name_and_nothing_is_written() {
    let (soft, hard) = (reference(VERLET), reference(EVENTS));
    let next_soft = next(VERLET);
    let with = |from: &str, to: &str| {
        assert!(next_soft.contains(from), "{from}");
        Next::of(&next_soft.replace(from, to))
    };
    let of = Next::of(&next_soft);
    of.refused(hard, &["a run of hard spheres", "an engine of soft ones"]);
    Next::of(&next(EVENTS)).refused(soft, &["a run of soft spheres", "an engine of hard ones"]);
    Next::of(VERLET).refused(soft, &["start.from takes the grains", "remove the [[grains]] tables"]);
    with("materials.ceramic", "materials.clay").refused(soft, &["made of ceramic", "aaa, clay"]);
    with("density = \"6000 kg/m3\"", "density = \"6001 kg/m3\"")
        .refused(soft, &["materials.ceramic.density", "6000 kg/m3", "6001 kg/m3"]);
    let heat = next(EVENTS).replace("heat_capacity = \"800 J/(kg K)\"", "heat_capacity = \"900 J/(kg K)\"");
    Next::of(&heat).refused(hard, &["materials.grain.heat_capacity", "800 J/kg/K", "900 J/kg/K"]);
    let (before, rest) = next_soft.split_once("[bonds.beam]").unwrap();
    let unbound = format!("{before}{}", &rest[rest.find("[fields").unwrap()..]);
    Next::of(&unbound).refused(soft, &["are held by", "bonds, and the scenario has no law for them"]);
    let cut = next_soft.replace(
        "[fields.drag]",
        "[fields.near_field]\ncutoff = \"9 cm\"\nlaw.coulomb.relative_permittivity = 80.0\n[fields.drag]",
    );
    Next::of(&cut).refused(soft, &["near_field.cutoff = 90 mm", "largest diameter"]);
    let narrow = next(EVENTS).replace("\"1 cm\", \"1 cm\", \"1 cm\"", "\"0 cm\", \"1 cm\", \"1 cm\"");
    Next::of(&narrow).refused(hard, &["lies outside [volume]"]);

    let elsewhere = tempfile::tempdir().unwrap();
    of.refused(elsewhere.path(), &["holds no run"]);
    of.refused(&elsewhere.path().join("nothing"), &["cannot open", "start.from"]);
    let text = elsewhere.path().join("text.agglo");
    fs::write(&text, "no checkpoint").unwrap();
    of.refused(&text, &["text.agglo", "not a checkpoint"]);
    let damaged = elsewhere.path().join("damaged");
    fs::create_dir_all(damaged.join("checkpoints")).unwrap();
    of.refused(&damaged, &["it has no checkpoint"]);
    for (_, path) in checkpoints(soft) {
        let mut bytes = fs::read(&path).unwrap();
        let middle = bytes.len() / 2;
        bytes[middle] ^= 1;
        fs::write(damaged.join("checkpoints").join(path.file_name().unwrap()), bytes).unwrap();
    }
    of.refused(&damaged, &["no whole checkpoint", "checksum"]);
    let good: Vec<PathBuf> = checkpoints(soft).into_iter().map(|(_, path)| path).collect();
    fs::copy(&good[0], damaged.join("checkpoints").join(good[0].file_name().unwrap())).unwrap();
    ended(of.run(&damaged, &["--no-report", "--set", "time.end=1.1 ms"]).output().unwrap(), 0);
}

/// Searches and studies have the key in their scenario.
#[test]
fn a_search_is_refused() {
    let bench = Bench::with("");
    let search = said(&ended(agglo(&["new", "search"]), 0));
    let file = bench.folder().join("search.toml");
    fs::write(&file, search).unwrap();
    let file = file.to_str().unwrap();
    for verb in ["run", "check"] {
        let text = complained(&ended(agglo(&[verb, file, "--from", bench.folder().to_str().unwrap()]), 2));
        assert!(text.contains("is a search"), "{text}");
    }
}
