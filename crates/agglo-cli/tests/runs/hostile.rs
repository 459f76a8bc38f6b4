//! Input that would hang, crash or deceive: without end, through pipes, beyond the machine, with codes for the terminal.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use crate::common::{EVENTS, agglo, complained, ended, said};

/// The program in a folder, with a text on its standard input.
fn fed(folder: &Path, arguments: &[&str], text: &str) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_agglo"))
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(text.as_bytes()).unwrap();
    child.wait_with_output().unwrap()
}

#[test]
fn the_standard_input_is_a_scenario() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["-", "/dev/stdin"] {
        let checked = ended(fed(folder.path(), &["check", name], EVENTS), 0);
        assert!(said(&checked).contains("is valid"), "{}", said(&checked));
    }
    ended(fed(folder.path(), &["run", "-", "--no-report", "--set", "time.end=0.1 ms"], EVENTS), 0);
    assert_there!(folder.path().join("out/stdin/summary.json"));
    let refused = ended(fed(folder.path(), &["check", "-"], "version = 2\n"), 2);
    assert!(complained(&refused).contains("faults in standard input"), "{}", complained(&refused));
}

/// Shells give the other end of a pipe a name.
#[test]
fn a_pipe_of_a_shell_is_read_once() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("events.toml");
    fs::write(&file, EVENTS).unwrap();
    let script = format!("{} check <(cat {})", env!("CARGO_BIN_EXE_agglo"), file.display());
    let Ok(checked) = Command::new("bash").args(["-c", &script]).output() else { return };
    ended(checked, 0);
}

#[test]
fn what_is_no_file_is_refused_wherever_a_file_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe.toml");
    let made = Command::new("mkfifo").arg(&pipe).status();
    let pipes = made.is_ok_and(|status| status.success()).then(|| pipe.display().to_string());
    for file in ["/dev/zero".to_owned()].into_iter().chain(pipes) {
        for verb in ["check", "run", "search", "study"] {
            let refused = ended(agglo(&[verb, &file]), 2);
            assert!(complained(&refused).contains("only regular files are read"), "{}", complained(&refused));
        }
        let wanted = "[grains.placement.fill]\ncount = 1500";
        let table = EVENTS.replace(wanted, &format!("[grains.placement.table]\nfile = \"{file}\""));
        assert_ne!(table, EVENTS);
        let scenario = folder.path().join("table.toml");
        fs::write(&scenario, table).unwrap();
        let refused = ended(agglo(&["check", &scenario.display().to_string()]), 2);
        assert!(complained(&refused).contains("only regular files are read"), "{}", complained(&refused));
    }
}

#[test]
fn nothing_of_the_input_acts_on_the_terminal() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("red\u{1b}[31m.toml");
    let name = file.display().to_string();
    fs::write(&file, EVENTS).unwrap();
    let checked = ended(agglo(&["check", &name]), 0);
    assert!(said(&checked).contains("red\\u{1b}[31m.toml is valid"), "{}", said(&checked));
    let acting =
        ["title = \"\\u001b[31m\"\nseed = \"a\u{202e}b\"\n", "\"a\\u001b[2Jb\" = 1\n", "\u{1b}[2J = 1\n"];
    for text in acting {
        fs::write(&file, format!("{text}{EVENTS}")).unwrap();
        let refused = ended(agglo(&["check", &name]), 2);
        let words = complained(&refused);
        assert!(!words.contains(['\u{1b}', '\u{202e}']), "{words:?}");
    }
}

/// A hundred thousand unknown keys, and one of a megabyte.
#[test]
fn faults_without_number_are_counted() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("many.toml");
    let keys: Vec<String> = (0..100_000).map(|number| format!("unknown_key_{number} = {number}\n")).collect();
    let text = [keys.concat(), "k".repeat(1_000_000), " = 1\n".to_owned(), EVENTS.to_owned()].concat();
    fs::write(&file, text).unwrap();
    let refused = ended(agglo(&["check", &file.display().to_string()]), 2);
    let words = complained(&refused);
    assert!(
        words.contains("more faults, which are not shown"),
        "{}",
        &words[words.len().saturating_sub(500)..]
    );
    assert!(words.len() < 1_000_000, "{}", words.len());
}

#[test]
fn what_the_machine_cannot_hold_is_refused_with_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("my.toml");
    let name = file.display().to_string();
    let out = folder.path().join("run").display().to_string();
    fs::write(&file, agglo(&["new", "acoustic-published"]).stdout).unwrap();
    let rays: Vec<String> = (0..64)
        .map(|_| {
            "[[acoustics.beams]]\nstart = [\"-1 m\", \"0 m\", \"0 m\"]\n\
        direction = [1, 0, 0]\nradius = \"1 mm\"\nrays = 4000000000\nstrength.power = \"1 W\"\n"
                .to_owned()
        })
        .collect();
    let text = fs::read_to_string(&file).unwrap();
    fs::write(&file, text + &rays.concat()).unwrap();
    for arguments in [&["check", &name][..], &["run", &name, "-o", &out]] {
        let refused = ended(agglo(arguments), 2);
        assert!(complained(&refused).contains("of memory"), "{}", complained(&refused));
    }
    assert_gone!(Path::new(&out));
}
