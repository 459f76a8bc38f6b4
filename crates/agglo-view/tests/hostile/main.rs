//! Hostile input: every reader of files is given made-up ones, always the same. `fuzz/` looks for further ones.
//!
//! The input of the case at hand lies in `target/tmp/hostile-READER-PROCESS` while it is read, so that it is there after a crash
//! or a hang; that of one that fails stays as `hostile-READER-PROCESS.CASE`.
//! `AGGLO_INPUT=FILE cargo test -p agglo-view --test hostile READER` reads that again, and
//! `AGGLO_CASES=30 cargo test -p agglo-view --test hostile` reads thirty times as many cases.

#[macro_use]
extern crate agglo_testing;

mod mutate;
mod readers;
mod seeds;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use mutate::Mutator;
use readers::{Bench, READERS};

/// More memory is asked for by no file of this size [bytes].
const MOST_MEMORY: u64 = 1 << 30;

/// After so many failed cases one has seen enough.
const MOST_FAILED: usize = 20;

/// Reads so many cases with a reader; gives how many of them it took.
fn read(name: &str, bench: &Bench, mutator: &Mutator, cases: u32) -> u32 {
    let (_, reader) = READERS.iter().find(|(known, _)| *known == name).expect("a reader");
    if let Some(input) = std::env::var_os("AGGLO_INPUT") {
        let verdict = reader(bench, &std::fs::read(input).expect("the input"));
        panic!("{name}: {verdict:?}");
    }
    let kept = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("hostile-{name}-{}", std::process::id()));
    let (mut taken, mut failed) = (0, Vec::new());
    for case in 0..cases {
        let bytes = mutator.case(case);
        std::fs::write(&kept, &bytes).expect("the input is kept");
        if let Ok(verdict) = catch_unwind(AssertUnwindSafe(|| reader(bench, &bytes))) {
            taken += u32::from(verdict.is_ok());
        } else {
            std::fs::rename(&kept, kept.with_extension(case.to_string())).expect("the input is kept");
            failed.push(case);
        }
        if failed.len() == MOST_FAILED {
            break;
        }
    }
    let kept_as = kept.display();
    assert!(failed.is_empty(), "{name}: the cases {failed:?} fail; their inputs are kept as {kept_as}.CASE");
    let _ = std::fs::remove_file(&kept);
    taken
}

/// Both happen: what is never taken says nothing of what comes after, nor does what is never refused.
fn read_some(name: &str, bench: &Bench, mutator: &Mutator, cases: u32) {
    let times = std::env::var("AGGLO_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(1);
    let cases = cases.saturating_mul(times);
    let taken = read(name, bench, mutator, cases);
    assert!(taken > cases / 100 && taken < cases, "{name}: {taken} of {cases} were taken");
    if let Some(peak) = peak_memory() {
        assert!(peak < MOST_MEMORY, "{name}: {peak} bytes of memory were in use");
    }
}

/// Most memory in use so far [bytes], by all that this program has read; unknown where the system does not say.
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(1024 * line.split_whitespace().nth(1)?.parse::<u64>().ok()?)
}

fn shipped(begins: &[&str]) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(folder).expect("a folder").flatten().map(|entry| entry.path()).collect();
    files.sort();
    let is_one = |path: &&PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        begins.iter().any(|begin| name.starts_with(begin))
    };
    files.iter().filter(is_one).map(|path| std::fs::read(path).expect("a file")).collect()
}

/// All keys and words that a schema knows.
fn words(schema: &serde_json::Value) -> Vec<String> {
    let mut words = Vec::new();
    let mut left = vec![schema];
    while let Some(value) = left.pop() {
        match value {
            serde_json::Value::Object(table) => {
                words.extend(table.keys().cloned());
                left.extend(table.values());
            }
            serde_json::Value::Array(items) => {
                words.extend(items.iter().filter_map(|item| item.as_str().map(str::to_owned)));
                left.extend(items);
            }
            _ => {}
        }
    }
    words.retain(|word| !word.contains(['$', ' ', '/']));
    words
}

fn scenarios() -> Mutator {
    let seeds = shipped(&["acoustic", "ink", "reacting"]);
    Mutator::new(seeds, &words(&agglo::scenario::schema()), true)
}

fn of_files(bench: &Bench, names: &[(&str, &str)], is_text: bool) -> Mutator {
    let named = names.iter().flat_map(|(begin, end)| bench.named(begin, end));
    Mutator::new(named.map(|name| bench.bytes(name).to_vec()).collect(), &[], is_text)
}

#[test]
fn scenarios_of_anybody() {
    read_some("scenario", &Bench::new(), &scenarios(), 4000);
}

#[test]
fn plans_of_anything() {
    read_some("plan", &Bench::new(), &scenarios(), 400);
}

#[test]
fn searches_of_anybody() {
    let seeds = shipped(&["search", "study"]);
    read_some(
        "campaign",
        &Bench::new(),
        &Mutator::new(seeds, &words(&agglo::search::campaign_schema()), true),
        1000,
    );
}

#[test]
fn tables_of_anybody() {
    let bench = Bench::new();
    read_some("table", &bench, &of_files(&bench, &[("table/", ".csv")], true), 1000);
}

#[test]
fn checkpoints_of_anybody() {
    let bench = Bench::new();
    let names = [("stopped/", ".agglo"), ("grown/", ".agglo"), ("finished/", ".agglo")];
    read_some("checkpoint", &bench, &of_files(&bench, &names, false), 500);
}

#[test]
fn journals_of_anybody() {
    let bench = Bench::new();
    read_some("journal", &bench, &of_files(&bench, &[("search/", ".journal")], true), 200);
}

#[test]
fn parts_of_anybody() {
    let bench = Bench::new();
    read_some("part", &bench, &of_files(&bench, &[("part/part", ".json")], true), 200);
}

#[test]
fn frames_of_anybody() {
    let bench = Bench::new();
    let mutator = of_files(&bench, &[("finished/frames/", ".vtp"), ("finished/frames/", ".pvd")], true);
    read_some("frame", &bench, &mutator, 500);
}

#[test]
fn series_of_anybody() {
    let bench = Bench::new();
    read_some("series", &bench, &of_files(&bench, &[("finished/series/", ".csv")], true), 300);
}

/// Settings from the command line, nearly right.
#[test]
fn settings_of_anybody() {
    let seeds = [
        "grains.0.size.lognormal.median=25 um",
        "materials.\"pigment\".density=2500 kg/m3",
        "acoustics.beams.0.start.2=3 mm",
        "output.pulses={series=\"20 ns\", frames=\"0.2 us\"}",
    ];
    let seeds = seeds.iter().map(|seed| seed.as_bytes().to_vec()).collect();
    let mutator = Mutator::new(seeds, &words(&agglo::scenario::schema()), true);
    read_some("setting", &Bench::new(), &mutator, 1000);
}

#[test]
fn summaries_of_anybody() {
    let bench = Bench::new();
    let names = [("finished/summary", ".json"), ("ended/summary", ".json"), ("ended/best/summary", ".json")];
    read_some("summary", &bench, &of_files(&bench, &names, true), 500);
}
