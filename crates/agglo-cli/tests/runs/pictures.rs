//! `agglo render`: what a user gets, and what is said where it cannot be had.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use crate::common::{EVENTS, STAGGERED, agglo, command, complained, ended, reference, said};

fn render(run: &Path, to: &Path, more: &[&str]) -> Output {
    let (run, to) = (run.display().to_string(), to.display().to_string());
    let mut arguments = vec!["render", &run, "-o", &to];
    if !more.contains(&"--size") {
        arguments.extend(["--size", "160x90"]);
    }
    arguments.extend(more);
    agglo(&arguments)
}

fn refused(output: Output, code: i32, words: &[&str]) {
    let message = complained(&ended(output, code));
    for word in words {
        assert!(message.contains(word), "no \"{word}\" in {message}");
    }
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// Width and height in a PNG's head.
fn size(png: &[u8]) -> [u32; 2] {
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    [16, 20].map(|at| u32::from_be_bytes(png[at..at + 4].try_into().unwrap()))
}

#[test]
fn pictures_of_soft_and_hard_spheres() {
    for (scenario, colors) in [
        (STAGGERED, &["speed", "cluster", "absorbed-power", "size", "id", "material", "temperature"][..]),
        (EVENTS, &["speed", "temperature", "primaries"][..]),
    ] {
        let folder = tempfile::tempdir().unwrap();
        for color in colors {
            let to = folder.path().join(format!("new/{color}.png"));
            let made = ended(render(reference(scenario), &to, &["--color", color, "--ground"]), 0);
            assert!(said(&made).starts_with("1 picture in "), "{}", said(&made));
            assert_eq!(size(&fs::read(to).unwrap()), [160, 90]);
        }
    }
}

/// The same bits for any number of threads.
#[test]
fn threads_do_not_show() {
    let folder = tempfile::tempdir().unwrap();
    let made = ["1", "2"].map(|threads| {
        let to = folder.path().join(format!("{threads}.png"));
        ended(render(reference(STAGGERED), &to, &["--threads", threads]), 0);
        fs::read(to).unwrap()
    });
    assert_eq!(made[0], made[1]);
}

#[test]
fn numbered_pictures_of_some_frames() {
    let folder = tempfile::tempdir().unwrap();
    let to = folder.path().join("frames/");
    let more = ["--frames", "0..2", "--every", "2", "--background", "transparent", "--no-words"];
    ended(render(reference(STAGGERED), &to.join("p*.png"), &more), 0);
    assert_eq!(names(&to), ["p000000.png", "p000001.png"]);
    // A folder that is in use is left alone.
    refused(render(reference(STAGGERED), &to, &[]), 2, &["is not empty", "help: "]);
}

#[test]
fn movies_where_there_is_ffmpeg() {
    let has_ffmpeg =
        Command::new("ffmpeg").arg("-version").output().is_ok_and(|output| output.status.success());
    let is_due = std::env::var_os("AGGLO_NEEDS_FFMPEG").is_some();
    assert!(has_ffmpeg || !is_due, "test.sh has installed ffmpeg, and it does not run");
    let folder = tempfile::tempdir().unwrap();
    for (name, head, at) in [("m.mp4", &b"ftyp"[..], 4), ("m.gif", &b"GIF89a"[..], 0)] {
        let to = folder.path().join(name);
        let made = render(reference(STAGGERED), &to, &["--frames", "0..2", "--size", "161x91"]);
        if has_ffmpeg {
            ended(made, 0);
            let movie = fs::read(&to).unwrap();
            assert_eq!(&movie[at..at + head.len()], head);
        } else {
            refused(made, 2, &["ffmpeg"]);
        }
    }
    let wanted = if has_ffmpeg { &["m.gif", "m.mp4"][..] } else { &[] };
    assert_eq!(names(folder.path()), wanted, "nothing half-written is left");
}

/// In the place of ffmpeg stands a script that begins its file and then asks the program to end at once.
#[cfg(unix)]
#[test]
fn a_movie_that_was_stopped_leaves_no_part_of_it() {
    use std::os::unix::fs::PermissionsExt;
    let (folder, programs) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let script = "#!/bin/sh\nfor last; do :; done\necho part > \"$last\"\ntouch \"${0%/*}/began\"\n\
                  for n in 1 2 3; do kill -INT $PPID; sleep 0.05; done\ncat > /dev/null\n";
    let program = programs.path().join("ffmpeg");
    fs::write(&program, script).unwrap();
    fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();
    let path = format!("{}:{}", programs.path().display(), std::env::var("PATH").unwrap());
    let (run, to) = (reference(STAGGERED).display().to_string(), folder.path().join("m.mp4"));
    // Pictures that take so long that the program ends in the middle of one.
    let mut slow = command(&["render", &run, "-o", to.to_str().unwrap(), "--size", "6000x6000"]);
    ended(slow.env("PATH", path).output().unwrap(), 1);
    assert_there!(programs.path().join("began"));
    assert!(names(folder.path()).is_empty(), "{:?}", names(folder.path()));
}

#[test]
fn without_ffmpeg_the_package_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let (run, to) = (reference(STAGGERED).display().to_string(), folder.path().join("m.mp4"));
    let mut without = command(&["render", &run, "-o", to.to_str().unwrap(), "--size", "64x64"]);
    let made = without.env("PATH", folder.path()).output().unwrap();
    refused(made, 2, &["install the package `ffmpeg`", "-o frames/"]);
    assert_empty!(names(folder.path()));
}

#[test]
fn options_that_make_no_difference_are_said() {
    let folder = tempfile::tempdir().unwrap();
    let to = folder.path().join("p.png");
    let made = render(reference(STAGGERED), &to, &["--color", "cluster", "--map", "cividis", "--rays"]);
    let words = complained(&ended(made, 0));
    assert!(words.contains("warning: the map is left aside"), "{words}");
    assert!(words.contains("has rays in flight"), "{words}");
    // A quiet run with rays that are there: nothing is said of them.
    let all = render(reference(STAGGERED), &folder.path().join("all/"), &["--rays"]);
    let words = complained(&ended(all, 0));
    let frames = names(&reference(STAGGERED).join("frames"));
    let has_rays = frames.iter().filter(|name| name.starts_with("rays_")).any(|name| {
        let text = fs::read(reference(STAGGERED).join("frames").join(name)).unwrap();
        !String::from_utf8_lossy(&text).contains("NumberOfPoints=\"0\"")
    });
    assert_eq!(words.contains("has rays in flight"), !has_rays, "{words}");
}

#[test]
fn options_that_cannot_be_met() {
    let folder = tempfile::tempdir().unwrap();
    let to = folder.path().join("p.png");
    let run = reference(EVENTS);
    refused(
        render(run, &to, &["--color", "sped"]),
        2,
        &["did you mean \"speed\"?", "they can be by speed, temperature"],
    );
    refused(render(run, &to, &["--rays"]), 2, &["has no frames of rays"]);
    refused(render(run, &to, &["--frames", "9999"]), 2, &["there are no frames 9999"]);
    refused(render(run, &to, &["--size", "big"]), 2, &["1280x720"]);
    refused(render(run, &to, &["--range", "3,1"]), 2, &["the first must be below the second"]);
    refused(render(run, &folder.path().join("m.avi"), &[]), 2, &["m.avi", ".mp4 and .gif are movies"]);
    let movie = folder.path().join("m.mp4");
    refused(render(run, &movie, &["--background", "transparent"]), 2, &["cannot be transparent"]);
    refused(render(folder.path(), &to, &[]), 2, &["has no frames", "grains.pvd"]);
    refused(render(&folder.path().join("nowhere"), &to, &[]), 2, &["there is no folder"]);
    assert_empty!(names(folder.path()));
}

#[test]
fn a_cut_frame_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let frames = folder.path().join("frames");
    fs::create_dir(&frames).unwrap();
    for name in names(&reference(STAGGERED).join("frames")) {
        fs::copy(reference(STAGGERED).join("frames").join(&name), frames.join(&name)).unwrap();
    }
    let cut = frames.join("grains_000001.vtp");
    let bytes = fs::read(&cut).unwrap();
    fs::write(&cut, &bytes[..bytes.len() * 2 / 3]).unwrap();
    let to = folder.path().join("p.png");
    refused(render(folder.path(), &to, &[]), 2, &["grains_000001.vtp", "cut short", "--frames"]);
    // Frames before it are whole; without a scenario there is less to see, which is said.
    let made = render(folder.path(), &to, &["--frames", "0"]);
    assert!(complained(&made).contains("names of materials are left out"), "{}", complained(&made));
    ended(made, 0);
}
