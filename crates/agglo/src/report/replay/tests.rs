//! What the page unpacks is what was in the frames.

use super::block::STEPS;
use super::*;
use crate::math::Vec3;
use crate::particles::{Particles, Row};
use crate::record::frames::{write_grains, write_lines, write_rays};

fn grains(count: u32, frame: usize) -> Particles {
    let mut grains = Particles::default();
    for id in 0..count {
        let at = f64::from(id) + frame as f64;
        grains.push(Row {
            id,
            position: Vec3::new(at, -at, 0.5),
            radius: 0.25,
            mass: 1.0,
            temperature: 300.0 + at,
            ..Row::default()
        });
    }
    grains
}

fn folder(frames: usize, count: u32) -> (tempfile::TempDir, Vec<PathBuf>) {
    let folder = tempfile::tempdir().unwrap();
    let paths: Vec<PathBuf> =
        (0..frames).map(|frame| folder.path().join(format!("grains_{frame:06}.vtp"))).collect();
    for (frame, path) in paths.iter().enumerate() {
        write_grains(path, 0.5 * frame as f64, &grains(count, frame), &[]).unwrap();
    }
    (folder, paths)
}

/// What the page reads: low + step * number, within half a step of what was packed.
fn unpacked(replay: &Replay, frame: usize, name: &str) -> Vec<f64> {
    let array = replay.plan.frames[frame].arrays[name];
    assert_eq!(array.kind, "u16");
    let bytes = &replay.bytes[array.offset..array.offset + 2 * array.count];
    let step = (array.high - array.low) / STEPS;
    bytes.chunks(2).map(|pair| array.low + step * f64::from(u16::from_le_bytes([pair[0], pair[1]]))).collect()
}

fn names(replay: &Replay, frame: usize) -> Vec<u32> {
    whole(replay, frame, "id")
}

fn whole(replay: &Replay, frame: usize, name: &str) -> Vec<u32> {
    let array = replay.plan.frames[frame].arrays[name];
    assert_eq!(array.kind, "u32");
    let (numbers, _) = replay.bytes[array.offset..array.offset + 4 * array.count].as_chunks::<4>();
    numbers.iter().map(|bytes| u32::from_le_bytes(*bytes)).collect()
}

#[test]
fn packed_places_come_back_within_half_a_step_and_names_exactly() {
    let (_folder, paths) = folder(3, 50);
    let replay = replay(&paths).unwrap();
    assert_eq!(replay.plan.times, ["0 s", "500 ms", "1 s"]);
    for (frame, start) in [0.0, 1.0, 2.0].into_iter().enumerate() {
        for (id, x) in unpacked(&replay, frame, "x").into_iter().enumerate() {
            assert!((x - (id as f64 + start)).abs() <= 0.5 * 49.0 / STEPS * 1.000_001, "{x}");
        }
        assert_eq!(names(&replay, frame), (0..50).collect::<Vec<u32>>());
    }
    assert!(replay.notes.is_empty());
    assert!(replay.plan.columns.iter().any(|column| column.name == "temperature"));
    assert!(!replay.plan.columns.iter().any(|column| column.name == "charge"), "all charges are 0");
}

#[test]
fn a_damaged_frame_is_left_out_and_said() {
    let (_folder, paths) = folder(3, 5);
    std::fs::write(&paths[1], "nothing").unwrap();
    let packed = replay(&paths).unwrap();
    assert_eq!(packed.plan.frames.len(), 2);
    assert!(packed.notes[0].contains("grains_000001.vtp"), "{:?}", packed.notes);
    std::fs::write(&paths[0], "").unwrap();
    std::fs::write(&paths[2], "").unwrap();
    assert_eq!(replay(&paths).unwrap_err().len(), 3);
}

#[test]
fn bonds_and_rays_are_packed_and_damaged_ones_left_out() {
    let (folder, paths) = folder(2, 5);
    let place = |name: &str| folder.path().join(name);
    let [here, way] = [Vec3::new(7.0, 8.0, 9.0), Vec3::new(0.0, 0.6, -0.8)];
    // Points of bonds are in another order than the grains: here the other way round.
    let points: Vec<Vec3> = grains(5, 0).position.iter().rev().copied().collect();
    write_lines(&place("bonds_000000.vtp"), 0.0, &points, &[[0, 3]], &[]).unwrap();
    write_rays(&place("rays_000000.vtp"), 0.0, &[here, -here], &[way, way], &[4.0, 2.0]).unwrap();
    std::fs::write(place("rays_000001.vtp"), "nothing").unwrap();
    let replay = replay(&paths).unwrap();
    assert_eq!(whole(&replay, 0, "bonds"), [4, 1]);
    let close = |name: &str, wanted: [f64; 2]| {
        let found = unpacked(&replay, 0, name);
        assert!(found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-3), "{name}: {found:?}");
    };
    close("ray_z", [9.0, -9.0]);
    close("ray_w", [-0.8, -0.8]);
    close("ray_power", [4.0, 2.0]);
    assert_eq!(replay.plan.ray_power, 4.0);
    assert_eq!(replay.plan.frames.len(), 2);
    assert!(replay.notes.len() == 1 && replay.notes[0].contains("rays_000001.vtp"), "{:?}", replay.notes);
}

/// A sparse file of the wanted length stands for frames that are too much for a page.
#[test]
fn large_runs_are_thinned_and_said() {
    let (folder, mut paths) = folder(40, 60);
    let large = |name: &str, bytes: u64| {
        let path = folder.path().join(name);
        std::fs::File::options().create(true).append(true).open(&path).unwrap().set_len(bytes).unwrap();
        path
    };
    large("rays_000001.vtp", MOST_BYTES / 2);
    assert!(replay(&paths).unwrap().notes.iter().all(|note| note.contains("rays_000001")));
    // 40 frames are not thinned below 24, so that one of three grains is left.
    paths.push(large("grains_000040.vtp", 2 * MOST_BYTES));
    let replay = replay(&paths[..40]).unwrap();
    assert_eq!(names(&replay, 39).len(), 60);
    let thinned = super::replay(&paths).unwrap();
    assert_eq!(names(&thinned, 0), (0..60).step_by(3).collect::<Vec<u32>>());
    assert_eq!(names(&thinned, 39), (0..60).step_by(3).collect::<Vec<u32>>());
    assert!(thinned.notes.iter().any(|note| note.contains("one of 3 grains")), "{:?}", thinned.notes);
}
