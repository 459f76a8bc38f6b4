//! Disks that are full and folders that cannot be written.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::common::{
    Bench, STAGGERED, agglo, assert_same, bytes, checkpoints, command, complained, ended, reference,
};

/// A file system in memory, of a given size.
struct Mount {
    at: PathBuf,
}

impl Mount {
    /// Nothing where mounting is not allowed.
    fn new(at: PathBuf, options: &str) -> Option<Self> {
        fs::create_dir(&at).unwrap();
        mount(&["-t", "tmpfs", "-o", options, "tmpfs"], &at).then_some(Self { at })
    }
}

impl Drop for Mount {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(&self.at).status();
    }
}

fn mount(arguments: &[&str], at: &Path) -> bool {
    let mut order = Command::new("mount");
    order.args(arguments).arg(at).stderr(Stdio::null());
    order.status().is_ok_and(|status| status.success())
}

#[allow(clippy::print_stderr, reason = "a test that is left out must say so")]
fn left_out(why: &str) {
    eprintln!("left out: {why}");
}

#[test]
fn a_full_disk_ends_the_run_and_room_lets_it_go_on() {
    let bench = Bench::with(STAGGERED);
    // About half of the 0.9 MB that the run writes.
    let Some(disk) = Mount::new(bench.folder().join("disk"), "size=500k") else {
        return left_out("this user cannot mount a small disk");
    };
    let run = disk.at.join("run");
    let shown = run.to_str().unwrap();
    let failed = ended(agglo(&["run", &bench.scenario(), "-o", shown]), 1);
    let text = complained(&failed);
    assert!(text.contains("cannot write ") && text.contains("the disk is full"), "{text}");
    assert!(text.contains(&format!("agglo resume {shown}")), "{text}");
    // Without room the checkpoint is refused nothing: it is read, and the same message comes again.
    assert_filled!(checkpoints(&run));
    let again = ended(agglo(&["resume", shown]), 1);
    assert!(complained(&again).contains("the disk is full"), "{}", complained(&again));
    assert_true!(mount(&["-o", "remount,size=10M"], &disk.at), "needs the rights of root");
    let done = ended(agglo(&["resume", shown]), 0);
    assert!(!complained(&done).contains("damaged"), "{}", complained(&done));
    assert_same(&run, reference(STAGGERED));
}

/// Files may not grow beyond 128 kB: the tables pass that, checkpoints do not.
#[test]
fn a_table_that_cannot_grow_ends_the_run_with_its_name() {
    let bench = Bench::with(STAGGERED);
    let series = ["--set", "output.series=\"1 us\""];
    let whole = Bench::with(STAGGERED);
    ended(whole.start(&series).output().unwrap(), 0);
    let (scenario, run) = (bench.scenario(), bench.run());
    let arguments = ["run", &scenario, "-o", run.to_str().unwrap(), series[0], series[1]];
    let limited = Command::new("sh")
        .args(["-c", "ulimit -f 250; trap '' XFSZ; exec \"$@\"", "sh", env!("CARGO_BIN_EXE_agglo")])
        .args(arguments)
        .output()
        .unwrap();
    let text = complained(&ended(limited, 1));
    assert!(text.contains("cannot write ") && text.contains(".csv"), "{text}");
    assert!(text.contains("larger than the limit"), "{text}");
    ended(bench.resume().output().unwrap(), 0);
    assert_same(&bench.run(), &whole.run());
}

#[test]
fn a_place_that_cannot_be_written_is_named_and_left_alone() {
    let bench = Bench::with(STAGGERED);
    fs::write(bench.folder().join("file"), "precious").unwrap();
    let below = bench.folder().join("file/run");
    let refused = ended(agglo(&["run", &bench.scenario(), "-o", below.to_str().unwrap()]), 1);
    let text = complained(&refused);
    assert!(text.contains("cannot make the folder") && text.contains("file/run"), "{text}");
    assert!(text.contains("is a file, not a folder"), "{text}");
    assert_eq!(bytes(bench.folder()).len(), 2);
    let Some(disk) = Mount::new(bench.folder().join("disk"), "ro") else {
        return left_out("this user cannot mount a read-only disk");
    };
    let place = disk.at.join("run");
    let refused = ended(agglo(&["run", &bench.scenario(), "-o", place.to_str().unwrap()]), 1);
    assert!(complained(&refused).contains("read-only"), "{}", complained(&refused));
    assert_gone!(place);
}

/// A closed standard output must not look like success.
#[test]
fn a_summary_that_cannot_be_shown_is_an_error() {
    let Ok(full) = fs::OpenOptions::new().write(true).open("/dev/full") else {
        return left_out("there is no /dev/full");
    };
    let shown = command(&["explain", "hertz"]).stdout(full).output().unwrap();
    assert_contains!(complained(&ended(shown, 1)), "cannot write");
}

/// Without anybody who ignores the signal: the program itself does not end without a word.
#[test]
fn a_limit_for_files_is_told_in_words() {
    let bench = Bench::with(STAGGERED);
    let (scenario, run) = (bench.scenario(), bench.run());
    let arguments = ["run", &scenario, "-o", run.to_str().unwrap(), "--set", "output.series=\"1 us\""];
    let limited = Command::new("sh")
        .args(["-c", "ulimit -f 250; exec \"$@\"", "sh", env!("CARGO_BIN_EXE_agglo")])
        .args(arguments)
        .output()
        .unwrap();
    let text = complained(&ended(limited, 1));
    assert!(text.contains("larger than the limit") && text.contains("agglo resume"), "{text}");
    ended(bench.resume().output().unwrap(), 0);
}

#[test]
fn a_link_that_leads_nowhere_is_named() {
    let bench = Bench::with(STAGGERED);
    std::os::unix::fs::symlink("nowhere", bench.run()).unwrap();
    for verb in [bench.start(&[]), bench.start(&["--no-report"])] {
        let mut verb = verb;
        let text = complained(&ended(verb.output().unwrap(), 2));
        assert!(text.contains("is a symbolic link to nowhere"), "{text}");
    }
    // A link to a folder is as good as the folder.
    fs::create_dir(bench.folder().join("nowhere")).unwrap();
    ended(bench.start(&[]).output().unwrap(), 0);
    assert_same(&bench.folder().join("nowhere"), reference(STAGGERED));
}

#[test]
fn threads_of_the_environment_are_capped() {
    let mut order = command(&["list-laws"]);
    let done = ended(order.env("RAYON_NUM_THREADS", "100000").output().unwrap(), 0);
    let text = complained(&done);
    assert!(text.contains("RAYON_NUM_THREADS=100000 is more than 4096"), "{text}");
}
