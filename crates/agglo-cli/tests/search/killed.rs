//! A search that is killed or stopped, and goes on.

use std::fs;
use std::time::Duration;

use crate::bench::{Bench, SEARCH, assert_same, reference};
use crate::common::{complained, ended, interrupted, kill_at_ten_moments, said, until_it_succeeds};

fn runs() -> usize {
    reference().summary()["runs"].as_u64().unwrap() as usize
}

#[test]
fn one_thread_writes_the_same_files_as_two() {
    let bench = Bench::with(SEARCH);
    bench.ends("search", &["--threads", "1"], 0);
    assert_same(&bench.out(), &reference().out());
}

/// SIGKILL at ten moments spread over the search, each time in the session that went on after the last; then the rest.
#[test]
fn a_search_killed_at_ten_moments_ends_with_the_same_files() {
    let (bench, runs) = (Bench::with(SEARCH), runs());
    kill_at_ten_moments(
        &bench.out(),
        reference().summary()["wall_s"].as_f64().unwrap(),
        |is_first| if is_first { bench.order("search", &[]) } else { bench.resume() },
        |part| bench.wait_for_replicates((runs as f64 * part) as usize),
    );
    ended(bench.resume().output().unwrap(), 0);
    assert_same(&bench.out(), &reference().out());
}

#[test]
fn ctrl_c_keeps_what_ended_and_says_how_to_go_on() {
    let (bench, runs) = (Bench::with(SEARCH), runs());
    let stopped = until_it_succeeds(&bench.out(), || {
        let child = bench.order("search", &[]).spawn().unwrap();
        bench.wait_for_replicates(runs / 3);
        let output = interrupted(child, "INT").0;
        (output.status.code() != Some(0)).then(|| ended(output, 1))
    });
    let text = complained(&stopped);
    let advice = format!("`agglo resume {}` goes on from there", bench.out().display());
    assert!(text.contains("stopped (") && text.contains(&advice), "{text}");
    assert_gone!(bench.out().join("summary.json"));
    // Torn, as by a loss of power: the last line is cut in half, one in the middle is damaged.
    let journal = bench.out().join("replicates.journal");
    let mut bytes = fs::read(&journal).unwrap();
    bytes.truncate(bytes.len() - 9);
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&journal, &bytes).unwrap();
    // Another name of the journal, as a backup has, keeps what is there now.
    let backup = bench.file("backup.journal");
    fs::hard_link(&journal, &backup).unwrap();
    let done = ended(bench.resume().output().unwrap(), 0);
    assert!(said(&done).contains("best"), "{}", said(&done));
    assert_same(&bench.out(), &reference().out());
    assert!(!journal.exists() && fs::read(&backup).unwrap() == bytes, "the backup was changed");
    let again = said(&ended(bench.resume().output().unwrap(), 0));
    assert!(again.contains("has finished already") && again.contains("hardness"), "{again}");
}

/// Two processes at once, as often as `AGGLO_STORMS` says: one is refused, and no replicate is lost.
#[test]
fn two_searches_at_once_lose_no_replicate() {
    let storms = std::env::var("AGGLO_STORMS").ok().and_then(|count| count.parse().ok()).unwrap_or(20_u64);
    for storm in 0..storms {
        let bench = Bench::with(SEARCH);
        let mut second = if storm % 2 == 0 { bench.order("search", &[]) } else { bench.resume() };
        let first = bench.order("search", &[]).spawn().unwrap();
        if storm % 2 == 1 {
            bench.wait_for_replicates(1);
        }
        std::thread::sleep(Duration::from_millis(storm * 5 % 43));
        let second = second.spawn().unwrap();
        let outputs = [first, second].map(|child| child.wait_with_output().unwrap());
        let refused: Vec<_> = outputs.iter().filter(|output| !output.status.success()).collect();
        for output in &refused {
            let words = complained(output);
            let reasons = ["is at work in", "is not empty", "holds a run"];
            assert!(
                output.status.code() == Some(2) && reasons.iter().any(|why| words.contains(why)),
                "{words}"
            );
        }
        assert!(refused.len() < 2, "both were refused");
        ended(bench.resume().output().unwrap(), 0);
        assert_same(&bench.out(), &reference().out());
    }
}

/// The wall time of a session is not the file's budget: the search is the same, in as many sessions as it takes.
#[test]
fn a_search_whose_wall_time_is_up_goes_on_with_the_same_files() {
    let bench = Bench::with(SEARCH);
    let text = complained(&bench.ends("search", &["--wall-time", "1 us"], 3));
    let advice = format!("`agglo resume {}` goes on from there", bench.out().display());
    for words in ["stopped: the wall time of 1 us is up (", "all simulations that ended are kept", &advice] {
        assert_contains!(&text, words);
    }
    assert_gone!(bench.out().join("summary.json"));
    let again = bench.resume().args(["--wall-time", "1 us"]).output().unwrap();
    assert_contains!(complained(&ended(again, 3)), &advice);
    ended(bench.resume().args(["--wall-time", "2 h"]).output().unwrap(), 0);
    assert_same(&bench.out(), &reference().out());
    let other = Bench::with(SEARCH);
    let text = complained(&other.ends("search", &["--wall-time", "-1 s"], 2));
    assert_contains!(text, "error: --wall-time: found \"-1 s\"; more than 0 is wanted");
    assert_gone!(other.out());
}
