//! Files that must be read, and files that must be refused with the words written beside their faults.
//!
//! A bad file says what it must be refused with: `#^ text` below a line stands for a fault of that line, `#! text` for
//! a fault without a line. The text is the key, the message and the advice.

#![allow(clippy::unwrap_used, reason = "a test that cannot read its files has failed")]

#[macro_use]
extern crate agglo_testing;

use std::fs;
use std::path::{Path, PathBuf};

use agglo::forecast::{Effort, Plan};
use agglo::scenario::{Fault, Faults, Scenario};
use agglo::search::{Campaign, Problem};

fn files(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let mut files: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
}

fn shipped_and_good() -> Vec<PathBuf> {
    let folders = ["tests/scenario/good", "tests/scenario/good_campaign", "../../scenarios"];
    let is_toml = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "toml");
    folders.map(files).concat().into_iter().filter(is_toml).collect()
}

fn is_campaign(path: &Path) -> bool {
    Campaign::is_meant_by(&fs::read_to_string(path).unwrap())
}

/// Line (0 where there is none) and text of the faults that a bad file announces.
fn announced(text: &str) -> Vec<(usize, String)> {
    let mut line = 0;
    let mut faults = Vec::new();
    for (index, words) in text.lines().enumerate() {
        if let Some(words) = words.strip_prefix("#^ ") {
            faults.push((line, words.to_owned()));
        } else if let Some(words) = words.strip_prefix("#! ") {
            faults.push((0, words.to_owned()));
        } else {
            line = index + 1;
        }
    }
    faults.sort();
    faults
}

fn found(fault: &Fault) -> (usize, String) {
    let help = fault.help.as_ref().map(|help| format!("; {help}")).unwrap_or_default();
    (fault.line.unwrap_or(0), format!("{}{help}", fault.headline()))
}

#[test]
fn bad_files_are_refused_with_the_words_beside_their_faults() {
    refused("tests/scenario/bad", 110, |text| Scenario::from_toml(text).err());
}

/// Files that they name are relative to the folder in which tests run, that of the crate.
#[test]
fn bad_searches_and_studies_are_refused_with_the_words_beside_their_faults() {
    refused("tests/scenario/bad_campaign", 60, |text| Campaign::from_toml(text).err());
}

fn refused(folder: &str, least: usize, read: impl Fn(&str) -> Option<Faults>) {
    let files = files(folder);
    assert!(files.len() >= least, "only {} bad files", files.len());
    let mut wrong = Vec::new();
    for path in files {
        let text = fs::read_to_string(&path).unwrap();
        let mut faults: Vec<(usize, String)> = read(&text).iter().flatten().map(found).collect();
        faults.sort();
        let wanted = announced(&text);
        if faults != wanted || wanted.is_empty() {
            wrong.push(format!("{}\n  found  {faults:#?}\n  wanted {wanted:#?}", path.display()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn good_and_shipped_files_are_read_and_written_back_the_same() {
    for path in shipped_and_good().into_iter().filter(|path| !is_campaign(path)) {
        let scenario = Scenario::load(&path).unwrap_or_else(|error| panic!("{error}"));
        let written = scenario.to_toml().unwrap();
        let again = Scenario::from_toml(&written).unwrap_or_else(|error| panic!("{error}\n{written}"));
        assert_eq!(scenario, again, "{}", path.display());
    }
}

#[test]
fn searches_and_studies_are_read_and_written_back_the_same() {
    let mut count = 0;
    for path in shipped_and_good().into_iter().filter(|path| is_campaign(path)) {
        let campaign = Campaign::load(&path).unwrap_or_else(|error| panic!("{error}"));
        let problem = Problem::new(&campaign, path.parent().unwrap()).unwrap();
        assert_eq!(problem.refused_ends(), Vec::<String>::new(), "{}", path.display());
        let written = campaign.to_toml().unwrap();
        let again: Campaign = toml::from_str(&written).unwrap_or_else(|error| panic!("{error}\n{written}"));
        assert_eq!(campaign, again, "{}", path.display());
        count += 1;
    }
    assert!(count >= 5, "{count}");
}

#[test]
fn every_default_of_hard_spheres_is_written_out() {
    let written = |text: &str| Scenario::from_toml(text).unwrap().to_toml().unwrap();
    let stepped = written(include_str!("scenario/good/hard_time_stepped_shortest.toml"));
    for line in [
        "boundary = \"periodic\"",
        "fraction = 0.5",
        "distance = \"gap\"",
        "pairs = \"all\"",
        "deformation = 1.0",
        "elastic_area = 0.0",
        "sticking_area = 1.0",
        "force_over = \"impact\"",
        "solver = \"bracketed\"",
        "sticking = \"merge\"",
        "balance = \"energy\"",
        "share = \"mass\"",
    ] {
        assert!(stepped.contains(line), "{line} in\n{stepped}");
    }
    // What is off stays off.
    for word in ["tangential", "fragmentation", "cooling"] {
        assert!(!stepped.contains(word), "{word} in\n{stepped}");
    }
}

/// What the rules let pass can be placed: no overlap, none outside.
#[test]
fn good_files_of_hard_spheres_can_be_placed() {
    let base = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/scenario/good");
    let mut placed = 0;
    for path in shipped_and_good().into_iter().filter(|path| !is_campaign(path)) {
        let scenario = Scenario::load(&path).unwrap_or_else(|error| panic!("{error}"));
        if scenario.is_hard() {
            let grains = agglo::packing::place(&scenario, &base)
                .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            // Lattice points are counted by volume where they are not placed, and one by one here.
            let plan = Plan::with(&scenario, &base, Effort::NONE).unwrap();
            let (planned, found) = (plan.grains as f64, grains.len() as f64);
            assert!((planned - found).abs() <= 0.1 * found, "{}: {planned} {found}", path.display());
            placed += 1;
        }
    }
    assert!(placed >= 14, "{placed}");
}

#[test]
fn every_default_is_written_out() {
    let text = fs::read_to_string(&files("tests/scenario/good")[0]).unwrap();
    let written = Scenario::from_toml(&text).unwrap().to_toml().unwrap();
    for line in ["viscosity = \"0.001 Pa s\"", "temperature = \"300 K\"", "on_breach = \"stop\"", "seed = 1"]
    {
        assert!(written.contains(line), "{line} in\n{written}");
    }
}

const SHORT: &str = include_str!("scenario/good/a_single_grain.toml");

#[test]
fn settings_replace_values_by_path() {
    let settings =
        ["time.end=2 s", "grains.0.size.constant.radius = \"1 mm\"", "seed=7", "limits.on_breach=warn"];
    let scenario = Scenario::with_overrides(SHORT, &settings).unwrap();
    let by_hand = SHORT
        .replace("time.end = \"1 ms\"", "time.end = \"2 s\"\nseed = 7\nlimits.on_breach = \"warn\"")
        .replace("40 um", "1 mm");
    assert_eq!(scenario, Scenario::from_toml(&by_hand).unwrap());
}

#[test]
fn faults_of_settings_show_the_setting() {
    let refused = |setting: &str| Scenario::with_overrides(SHORT, &[setting]).unwrap_err().to_string();
    assert_starts!(refused("time.end=2 m"), "--set time.end=2 m: time.end: \"2 m\" is a length");
    assert_contains!(refused("time.ende=2 s"), "did you mean \"end\"?");
    assert_contains!(refused("grains.1.charge=1 pC"), "no entry of a list of 1");
    assert_contains!(refused("time.end"), "key.path=value is wanted");
    assert_contains!(refused("time..end=1 s"), "not a path of keys");
    assert!(
        refused("seed.x=1").contains("unknown key") || refused("seed.x=1").contains("found a table"),
        "{}",
        refused("seed.x=1")
    );
    assert!(refused("title.x=1").contains("found a table"), "{}", refused("title.x=1"));
    assert!(refused("time.end=-1 s").contains("more than 0"), "rules hold for settings too");
    let page = Scenario::with_overrides(SHORT, &["time.end=2 m"]).unwrap_err().render(SHORT, "x.toml", false);
    assert!(page.contains("--set:1:10"), "{page}");
}

#[test]
fn tables_that_are_not_there_are_faults_of_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("my.toml");
    let list = "placement.list.positions = [[\"0 m\", \"0 m\", \"0 m\"]]";
    fs::write(&path, SHORT.replace(list, "placement.table.file = \"grains.csv\"")).unwrap();
    let refused = Scenario::load(&path).unwrap_err().to_string();
    assert!(refused.contains("grains.0.placement.table.file: cannot open \"grains.csv\""), "{refused}");
    fs::write(folder.path().join("grains.csv"), "x_m,y_m,z_m\n0,0,0\n1,0,0\n").unwrap();
    let scenario = Scenario::load(&path).unwrap();
    assert_eq!(Plan::new(&scenario, folder.path()).unwrap().grains, 2);
}

#[test]
fn choices_left_to_the_program_are_made() {
    let resolved = Scenario::from_toml(SHORT).unwrap().resolved();
    // 1 ms / 200, / 40 and / 20.
    let intervals = [resolved.output.series, resolved.output.frames, resolved.output.checkpoints];
    assert_eq!(intervals.map(|interval| interval.unwrap().si()), [5e-6, 2.5e-5, 5e-5]);
    assert_eq!(resolved, resolved.resolved());
    let again = Scenario::from_toml(&resolved.to_toml().unwrap()).unwrap();
    assert_eq!(resolved, again);
}

#[test]
fn settings_replace_values_of_searches_too() {
    let text = agglo::scenario::template("search").unwrap().text;
    let read = |setting: &str| Campaign::with_overrides(text, &[setting]);
    let campaign = read("parameters.1.range.linear.upper=0.7").unwrap();
    assert_contains!(campaign.to_toml().unwrap(), "upper = 0.7");
    let refused = |setting: &str| read(setting).unwrap_err().to_string();
    let message = refused("parameters.1.range.linear.upper=0.7 m");
    assert!(message.starts_with("--set parameters.1.range.linear.upper=0.7 m: parameters.1"), "{message}");
    assert_contains!(refused("sed=3"), "did you mean \"seed\"?");
}

/// Spoiled files are refused or read, but never end the program.
#[test]
fn spoiled_files_do_no_harm() {
    spoil(include_str!("scenario/good/every_choice.toml"));
    spoil(include_str!("scenario/good/hard_every_choice.toml"));
    spoil(include_str!("../../../scenarios/acoustic-dispersal-published.toml"));
    spoil_with(agglo::scenario::template("study-rays").unwrap().text, &|text| {
        if let Err(faults) = Campaign::from_toml(text) {
            assert_filled!(faults);
            assert_all!(faults.iter(), |fault| !fault.message.is_empty());
        }
    });
}

fn spoil(text: &str) {
    spoil_with(text, &survive);
}

fn spoil_with(text: &str, survive: &dyn Fn(&str)) {
    let lines: Vec<&str> = text.lines().collect();
    for left_out in 0..lines.len() {
        let rest = [&lines[..left_out], &lines[left_out + 1..]].concat().join("\n");
        survive(&rest);
    }
    for end in (0..text.len()).step_by(7) {
        survive(&text[..end]);
    }
    for (old, new) in
        [("1", "-1"), ("1", "0"), ("\"", ""), ("um", "m"), ("=", "."), ("0", "9e999"), ("[", "[[")]
    {
        survive(&text.replace(old, new));
        for at in text.match_indices(old).map(|(at, _)| at) {
            survive(&format!("{}{new}{}", &text[..at], &text[at + old.len()..]));
        }
    }
}

fn survive(text: &str) {
    match Scenario::from_toml(text) {
        Ok(scenario) => {
            let plan = Plan::with(&scenario, Path::new("tests/scenario/good"), Effort::NONE).unwrap();
            assert!(!plan.memory.is_nan() && !plan.impacts.is_nan(), "{plan}\n{text}");
        }
        Err(faults) => {
            assert_filled!(faults);
            assert_all!(faults.iter(), |fault| !fault.message.is_empty());
            assert_contains!(faults.render(text, "spoiled.toml", true), "nothing was run");
        }
    }
}
