//! What the page unpacks is what was in the frames.

use super::block::STEPS;
use super::*;
use agglo::domain::Space;
use agglo::math::Vec3;
use agglo::particles::{Particles, Row};
use agglo::record::frames::{write_bonds, write_grains, write_rays, write_walls};

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
    assert_empty!(replay.notes);
    assert_any!(replay.plan.columns.iter(), |column| column.name == "temperature");
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
    // Grains in memory stand in another order than their names: here the other way round.
    let mut backwards = grains(5, 0);
    backwards.id.reverse();
    write_bonds(&place("bonds_000000.vtp"), 0.0, &backwards, &Space::OPEN, &[[0, 3]], &[]).unwrap();
    write_rays(&place("rays_000000.vtp"), 0.0, &[here, -here], &[way, way], &[4.0, 2.0]).unwrap();
    std::fs::write(place("rays_000001.vtp"), "nothing").unwrap();
    let replay = replay(&paths).unwrap();
    assert_eq!(whole(&replay, 0, "bonds"), [1, 4]);
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

#[test]
fn large_runs_are_thinned_and_said() {
    let (folder, paths) = folder(40, 600);
    // Places without any pattern, as those of a run: frames do not shrink by what they have in common.
    let mut state = 1_u32;
    let mut noise = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state >> 8) / f64::from(1 << 24)
    };
    let mut last = grains(600, 39);
    for (frame, path) in paths.iter().enumerate() {
        for grain in 0..600 {
            last.position[grain] = Vec3::new(noise(), noise(), noise());
            last.temperature[grain] = 300.0 + noise();
        }
        write_grains(path, 0.5 * frame as f64, &last, &[]).unwrap();
    }
    let chain: Vec<[u32; 2]> = (0..599).map(|grain| [grain, grain + 1]).collect();
    let skip: Vec<[u32; 2]> = (0..597).map(|grain| [grain, grain + 3]).collect();
    let bonds = [chain, skip].concat();
    write_bonds(&folder.path().join("bonds_000039.vtp"), 0.0, &last, &Space::OPEN, &bonds, &[]).unwrap();
    let whole = replay(&paths).unwrap();
    assert_empty!(whole.notes);
    assert_eq!(whole.plan.frames.len(), 40);
    assert_eq!(whole.plan.share, 1);
    let bytes = whole.packed.len();
    // First frames go, the first and the last of them never.
    let fewer = within(&paths, bytes * 8 / 10).unwrap();
    let frames = fewer.plan.frames.len();
    assert!((24..40).contains(&frames) && fewer.plan.share == 1, "{frames} frames");
    assert_at_most!(fewer.packed.len(), bytes * 8 / 10);
    let times = fewer.plan.frames.iter().map(|frame| frame.time).collect::<Vec<_>>();
    assert_eq!((times[0], times[frames - 1]), (0.0, 0.5 * 39.0));
    assert!(fewer.notes[0].contains(&format!("{frames} of 40 frames")), "{:?}", fewer.notes);
    // 40 frames are not thinned below 24; then grains go, the same ones in all frames, with their bonds.
    let thinned = within(&paths, bytes / 5).unwrap();
    let share = thinned.plan.share;
    assert_at_most!(thinned.packed.len(), bytes / 5);
    assert_above!(share, 1);
    assert_eq!((thinned.plan.frames.len(), thinned.grains), (24, 600));
    let kept: Vec<u32> = (0..600).filter(|name| u64::from(*name).is_multiple_of(share)).collect();
    assert_eq!(names(&thinned, 0), kept);
    assert_eq!(names(&thinned, 23), kept);
    assert_any!(thinned.notes.iter(), |note| note.contains(&format!("one of {share} grains")));
    let both_ends = |pair: &&[u32; 2]| pair.iter().all(|&name| u64::from(name).is_multiple_of(share));
    let due = bonds.iter().filter(both_ends).flatten().copied().collect::<Vec<_>>();
    let found =
        thinned.plan.frames[23].arrays.get("bonds").map_or(Vec::new(), |_| whole_names(&thinned, 23, &kept));
    assert_eq!(found, due);
}

/// Names of the grains that bonds join.
fn whole_names(replay: &Replay, frame: usize, kept: &[u32]) -> Vec<u32> {
    whole(replay, frame, "bonds").into_iter().map(|at| kept[at as usize]).collect()
}

#[test]
fn numbers_that_cannot_be_true_are_found() {
    let (_folder, paths) = folder(3, 5);
    let whole = std::fs::read(&paths[1]).unwrap();
    let mark = b"<AppendedData encoding=\"raw\">\n_";
    let data = whole.windows(mark.len()).position(|part| part == mark).unwrap() + mark.len();
    let head = String::from_utf8_lossy(&whole[..data]);
    let (_, places) = head.split_once("Name=\"Points\"").unwrap();
    let offset: usize = places.split("offset=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
    let data = data + offset;
    for number in 0..15 {
        let mut bytes = whole.clone();
        let at = data + 8 + 8 * number;
        bytes[at..at + 8].fill(0xff);
        std::fs::write(&paths[1], &bytes).unwrap();
        let packed = replay(&paths).unwrap();
        assert_eq!(packed.plan.frames.len(), 2);
        let note = &packed.notes[0];
        assert!(note.contains("grains_000001.vtp") && note.contains("not finite"), "{note}");
    }
}

#[test]
fn grains_that_grow_are_colored_by_size_first() {
    let (folder, paths) = folder(2, 5);
    assert_eq!(replay(&paths).unwrap().plan.color_by, "temperature");
    let mut grown = grains(5, 1);
    grown.radius[2] = 0.5;
    write_grains(&folder.path().join("grains_000001.vtp"), 0.5, &grown, &[]).unwrap();
    assert_eq!(replay(&paths).unwrap().plan.color_by, "size");
}

/// Corners come back as grains' places do; walls that stand still are in the page once.
#[test]
fn walls_are_packed_and_those_at_rest_once() {
    let (folder, paths) = folder(3, 5);
    for (frame, height) in [1.0, 1.0, 3.0].into_iter().enumerate() {
        let triangle = [[0.0, 0.0, height], [2.0, 0.0, height], [0.0, 4.0, height]].map(Vec3::from);
        let path = folder.path().join(format!("walls_{frame:06}.vtp"));
        write_walls(&path, 0.5 * frame as f64, &[triangle], &[0; 3]).unwrap();
    }
    let replay = replay(&paths).unwrap();
    assert_empty!(replay.notes);
    for (frame, height) in [1.0, 1.0, 3.0].into_iter().enumerate() {
        for (name, wanted) in
            [("wall_x", [0.0, 2.0, 0.0]), ("wall_y", [0.0, 0.0, 4.0]), ("wall_z", [height; 3])]
        {
            let found = unpacked(&replay, frame, name);
            assert_eq!(found.len(), 3, "corners");
            found
                .iter()
                .zip(wanted)
                .for_each(|(at, due)| assert_near!(*at, due, 1e-12, "{name} of frame {frame}, in m"));
        }
    }
    let place = |frame: usize| replay.plan.frames[frame].arrays["wall_x"].offset;
    assert_true!(place(0) == place(1) && place(1) != place(2), "places in the block");
    std::fs::write(folder.path().join("walls_000001.vtp"), "nothing").unwrap();
    let damaged = super::replay(&paths).unwrap();
    assert_eq!(damaged.plan.frames.len(), 3, "frames");
    assert_contains!(damaged.notes[0], "walls_000001.vtp");
}
