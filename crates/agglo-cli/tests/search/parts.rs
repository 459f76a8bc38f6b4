//! Studies in parts, each in a process and a folder of its own, and the whole that they are put together to.

use std::path::{Path, PathBuf};
use std::process::Output;

use serde_json::json;

use crate::bench::{Bench, SEARCH, assert_same};
use crate::common::{agglo, complained, ended, objects, said};

/// The search's two parameters under a plan, two to eight replicates a point.
fn study(plan: &str) -> String {
    SEARCH[..SEARCH.find("[method").unwrap()].to_owned() + plan
}

const GRID: &str = "[plan.grid]\nlevels = 3\n";
/// Of its twelve points some come again, also in other parts.
const MORRIS: &str = "[plan.morris]\ntrajectories = 4\nlevels = 2\n";

/// One value after the other.
fn refinement() -> String {
    let study = study("[plan.refinement]\n");
    let (first, rest) = study.split_at(study.find("[[parameters]]").unwrap());
    let rest = &rest[rest.find("[ensemble]").unwrap()..];
    let ends = "[[parameters]]\nname = \"end\"\nkey = \"time.end\"\nrange.choices = [\"0.25 ms\", \"0.5 ms\", \"1 ms\"]\n";
    format!("{first}{ends}{rest}")
}

impl Bench {
    fn part(&self, number: u64, of: u64) -> PathBuf {
        self.file(&format!("part-{number}-of-{of}")).into()
    }

    /// Runs a part of the study, which must end with this code.
    fn runs(&self, number: u64, of: u64, more: &[&str], code: i32) -> Output {
        let (file, part, out) = (self.file("campaign.toml"), format!("{number}/{of}"), self.part(number, of));
        let study = ["study", &file, "--part", &part, "-o", out.to_str().unwrap(), "--threads", "1"];
        ended(agglo(&[&study[..], more].concat()), code)
    }

    /// Puts parts together, which must end with this code.
    fn joins(&self, parts: &[PathBuf], code: i32) -> Output {
        let parts = parts.iter().map(|part| part.to_str().unwrap());
        let out = self.out().display().to_string();
        let arguments: Vec<&str> = ["join", "--json", "-o", &out].into_iter().chain(parts).collect();
        ended(agglo(&arguments), code)
    }

    /// What is said of parts that cannot be put together; nothing is written.
    fn refuses(&self, parts: &[PathBuf]) -> String {
        let refused = objects(&self.joins(parts, 2)).pop().unwrap();
        assert_eq!(refused["type"], json!("refused"));
        assert_gone!(self.out());
        refused["message"].as_str().unwrap().to_owned()
    }
}

fn summary(folder: &Path) -> serde_json::Value {
    serde_json::from_slice(&std::fs::read(folder.join("summary.json")).unwrap()).unwrap()
}

#[test]
fn parts_put_together_are_what_one_process_writes() {
    for (plan, of) in [(study(GRID), 4), (study(MORRIS), 5), (refinement(), 2)] {
        let whole = Bench::with(&plan);
        whole.ends("study", &[], 0);
        let bench = Bench::with(&plan);
        let mut runs = 0;
        for number in 1..=of {
            let text = said(&bench.runs(number, of, &[], 0));
            assert_contains!(&text, &format!("{number} of {of}"));
            assert_contains!(&text, "`agglo join` puts all parts together");
            assert_gone!(bench.part(number, of).join("report.html"));
            runs += summary(&bench.part(number, of))["runs"].as_u64().unwrap();
        }
        // In any order, and wherever they have gone.
        let moved = bench.file("moved");
        std::fs::rename(bench.part(2, of), &moved).unwrap();
        let mut parts: Vec<PathBuf> =
            (1..=of).rev().filter(|number| *number != 2).map(|number| bench.part(number, of)).collect();
        parts.push(moved.into());
        let told = objects(&bench.joins(&parts, 0));
        // All was run in the parts, once, and nothing when they were put together.
        let progress: Vec<_> = told.iter().filter(|object| object["type"] == "progress").collect();
        assert!(!progress.is_empty() && progress.iter().all(|object| object["runs"] == 0), "{progress:?}");
        assert_eq!(json!(runs), whole.summary()["runs"]);
        assert_same(&bench.out(), &whole.out());
        assert!(whole.summary().get("part").is_none(), "the whole is no part");
    }
}

/// With its table of grains, which all parts took along.
#[test]
fn a_part_that_was_stopped_goes_on_with_the_same_bits() {
    let with_table = |bench: &Bench| {
        let at = |k: u32| -9.0 + 2.0 * f64::from(k);
        let places = (0..400).map(|n| [at(n % 10), at(n / 10 % 10), at(n / 100)]);
        let rows: Vec<String> = places.map(|[x, y, z]| format!("{x}e-3,{y}e-3,{z}e-3\n")).collect();
        std::fs::write(bench.file("grains.csv"), "x_m,y_m,z_m\n".to_owned() + &rows.concat()).unwrap();
        let text = std::fs::read_to_string(bench.file("scenario.toml")).unwrap();
        let fill = "[grains.placement.fill]\ncount = 400\n";
        std::fs::write(
            bench.file("scenario.toml"),
            text.replace(fill, "placement.table.file = \"grains.csv\"\n"),
        )
        .unwrap();
    };
    let [whole, bench] = [Bench::with(&study(GRID)), Bench::with(&study(GRID))];
    [&whole, &bench].into_iter().for_each(with_table);
    whole.ends("study", &[], 0);
    bench.runs(1, 2, &[], 0);
    let text = complained(&bench.runs(2, 2, &["--wall-time", "1 us"], 3));
    assert_contains!(text, &format!("`agglo resume {}` goes on from there", bench.part(2, 2).display()));
    let parts = [bench.part(1, 2), bench.part(2, 2)];
    let text = bench.refuses(&parts);
    assert_contains!(&text, "part 2 of 2 has not come to its end");
    assert_contains!(&text, &format!("`agglo resume {}` goes on with it", bench.part(2, 2).display()));
    ended(agglo(&["resume", bench.part(2, 2).to_str().unwrap()]), 0);
    assert_gone!(bench.part(2, 2).join("report.html"));
    let again = said(&ended(agglo(&["resume", bench.part(2, 2).to_str().unwrap()]), 0));
    assert_contains!(again, "has finished already");
    bench.joins(&parts, 0);
    assert_same(&bench.out(), &whole.out());
}

#[test]
fn parts_that_do_not_make_a_whole_are_refused() {
    let bench = Bench::with(&study(GRID));
    for number in 1..=3 {
        bench.runs(number, 3, &[], 0);
    }
    let [first, second, third] = [1, 2, 3].map(|number| bench.part(number, 3));
    let text = bench.refuses(&[first.clone(), third.clone()]);
    assert_contains!(text, "of 3 parts number 2 is missing");
    assert_contains!(bench.refuses(std::slice::from_ref(&third)), "of 3 parts numbers 1, 2 are missing");
    let text = bench.refuses(&[first.clone(), second.clone(), third.clone(), first.clone()]);
    assert_contains!(text, "are part 1 of 3; give each part once");
    bench.runs(1, 2, &[], 0);
    let text = bench.refuses(&[first.clone(), bench.part(1, 2)]);
    assert_contains!(text, "is part 1 of 3, ");
    assert_contains!(text, "is part 1 of 2; give the parts of one division");
    // The same part of the study with another seed.
    std::fs::rename(&second, bench.file("kept")).unwrap();
    bench.runs(2, 3, &["--seed", "6"], 0);
    let text = bench.refuses(&[first.clone(), second.clone(), third.clone()]);
    assert_contains!(text, "are of different studies: their search.toml is not the same");
    std::fs::remove_dir_all(&second).unwrap();
    bench.runs(2, 3, &["--set", "settings=[\"time.end=0.5 ms\"]"], 0);
    let text = bench.refuses(&[first.clone(), second.clone(), third.clone()]);
    assert_contains!(text, "their scenario.toml is not the same");
    // What is no part, or not any more.
    let whole = PathBuf::from(bench.file("whole"));
    ended(agglo(&["study", &bench.file("campaign.toml"), "-o", whole.to_str().unwrap(), "--no-report"]), 0);
    assert_contains!(bench.refuses(std::slice::from_ref(&whole)), "holds none: there is no part.json in it");
    assert_contains!(bench.refuses(&["nowhere".into()]), "there is no folder nowhere");
    std::fs::write(first.join("part.json"), "{\"number\":4,\"of\":3}").unwrap();
    assert_contains!(bench.refuses(std::slice::from_ref(&first)), "its part.json is damaged");
}

/// A journal that lost a line has that replicate run again: the whole is the same.
#[test]
fn what_a_part_lost_is_run_again() {
    let [whole, bench] = [Bench::with(&study(GRID)), Bench::with(&study(GRID))];
    whole.ends("study", &[], 0);
    for number in 1..=2 {
        bench.runs(number, 2, &[], 0);
    }
    let journal = bench.part(2, 2).join("replicates.journal");
    let mut bytes = std::fs::read(&journal).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(&journal, &bytes[..bytes.len() - 9]).unwrap();
    bench.joins(&[bench.part(1, 2), bench.part(2, 2)], 0);
    assert_same(&bench.out(), &whole.out());
    // That of another version is not taken.
    std::fs::write(&journal, String::from_utf8_lossy(&bytes).replacen("agglo ", "agglo 9", 1)).unwrap();
    std::fs::remove_dir_all(bench.out()).unwrap();
    let text = bench.refuses(&[bench.part(1, 2), bench.part(2, 2)]);
    assert_contains!(text, "its journal is of \"agglo 9");
}

#[test]
fn what_is_no_part_is_refused_and_nothing_is_written() {
    let bench = Bench::with(&study(GRID));
    for part in ["0/4", "5/4", "4", "-1/4", "a/b"] {
        let text = complained(&bench.ends("study", &["--part", part], 2));
        assert_contains!(
            text,
            &format!("error: --part: \"{part}\" is no part; one from 1/16 to 16/16 is wanted")
        );
        assert_gone!(bench.out());
    }
    let text = complained(&bench.ends("study", &["--part", "3/10"], 2));
    assert_contains!(text, "part 3/10: the study has 9 evaluations, and so at most as many parts");
    assert_gone!(bench.out());
    let search = Bench::with(SEARCH);
    let text = complained(&search.ends("search", &["--part", "1/2"], 2));
    assert_contains!(text, "unexpected argument '--part'");
    // Beside one another where no folder is named.
    let file = bench.file("campaign.toml");
    let home = Path::new(&file).parent().unwrap();
    let mut order = crate::common::command(&["study", "campaign.toml", "--part", "9/9"]);
    ended(order.current_dir(home).output().unwrap(), 0);
    assert_there!(home.join("out/campaign-9-of-9/part.json"));
}
