//! Views, colors and animations of small folders.

use std::ops::ControlFlow;
use std::path::Path;

use super::*;
use crate::render::{Animation, AnimationEnding, AnimationProgress, Output, Shots, animate};
use agglo::math::rng::{Purpose, Stream};
use agglo::record::frames::{Cells, Collection, Field, PolyData};

/// Writes frames of grains of radius 0.05: each a list of places with a speed along x.
fn write_frames(dir: &Path, frames: &[Vec<(Vec3, f64)>]) {
    let folder = dir.join("frames");
    std::fs::create_dir_all(&folder).unwrap();
    let mut list = Collection::default();
    for (number, grains) in frames.iter().enumerate() {
        let points: Vec<Vec3> = grains.iter().map(|grain| grain.0).collect();
        let velocity: Vec<Vec3> = grains.iter().map(|grain| Vec3::AXES[0] * grain.1).collect();
        let (radius, cluster) = (vec![0.05; grains.len()], vec![0_u32; grains.len()]);
        let point_fields = vec![
            Field::new("velocity_m_s", &velocity[..]),
            Field::new("radius_m", &radius[..]),
            Field::new("cluster", &cluster[..]),
        ];
        let name = format!("grains_{number:06}.vtp");
        let (time, cells, cell_fields) = (0.5 * number as f64, Cells::Vertices, Vec::new());
        PolyData { time, points: &points, order: None, point_fields, cells, cell_fields }
            .write(&folder.join(&name))
            .unwrap();
        list.add(time, &name);
    }
    list.write(&folder.join("grains.pvd")).unwrap();
}

fn ball(count: usize, size: f64) -> Vec<(Vec3, f64)> {
    let mut stream = Stream::new(1, Purpose::Sampling, 0);
    (0..count).map(|k| (stream.direction() * (size * stream.uniform().cbrt()), k as f64)).collect()
}

fn small(color: &str) -> Options {
    Options { color: color.to_owned(), size: [64, 48], ..Options::default() }
}

fn prepared(dir: &Path, options: Options) -> Result<Renderer, RenderError> {
    let sequence = FrameSequence::open(dir)?;
    let numbers: Vec<usize> = (0..sequence.len()).collect();
    Ok(Renderer::prepare(sequence, options, &numbers, &mut |_| true)?.unwrap())
}

/// Two frames; the second is three times as large and has a grain that flew away.
fn two_frames() -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    let mut late = ball(400, 3.0);
    late.push((Vec3::new(1e7, -1e7, 1e7), 1e6));
    write_frames(dir.path(), &[ball(400, 1.0), late]);
    dir
}

/// All but the outermost grains are in the picture, and one that is far away does not push them together.
#[test]
fn the_view_holds_nearly_all_grains_of_all_frames() {
    let dir = two_frames();
    let inside = |view: View| {
        let renderer = prepared(dir.path(), Options { view, ..small("speed") }).unwrap();
        let seen = ball(400, 3.0).into_iter().filter(|(place, _)| {
            let ([x, y], _) = renderer.camera().project(*place).unwrap();
            (0.0..64.0).contains(&x) && (0.0..48.0).contains(&y)
        });
        (seen.count() as f64 / 400.0, renderer.camera().distance())
    };
    let (fit, distance) = inside(View::Fit);
    assert!(fit > 0.9, "{fit}");
    let (first, near) = inside(View::First);
    assert!(first < 0.6 && (distance / near - 3.0).abs() < 0.3, "{first} {distance} {near}");
}

#[test]
fn a_place_can_be_looked_at() {
    let dir = two_frames();
    let place = Vec3::new(0.5, -1.0, 0.25);
    let renderer = prepared(dir.path(), Options { view: View::At(place), ..small("speed") }).unwrap();
    let ([x, y], _) = renderer.camera().project(place).unwrap();
    assert_near!(x, 32.0, 1e-6);
    assert_near!(y, 24.0, 1e-6);
}

/// One range for all frames, without the uppermost hundredth of each frame's speeds.
#[test]
fn colors_have_one_range() {
    let dir = two_frames();
    let found = prepared(dir.path(), small("speed")).unwrap();
    // Of 0 to 399, and 1e6: a hundredth of 400 is 4.
    assert_eq!((found.range, found.beyond), ([0.0, 396.0], [false, true]));
    let given = Options { range: Some([100.0, 1e7]), ..small("speed") };
    let given = prepared(dir.path(), given).unwrap();
    assert_eq!((given.range, given.beyond), ([100.0, 1e7], [true, false]));
    assert_eq!(given.colors(&[50.0, 1e9]), [0.0, 1.0].map(|part| light_of(Map::Viridis.color(part))));
    // All radii are the same: their color is in the middle of the map.
    let same = prepared(dir.path(), small("size")).unwrap();
    let middle = light_of(Map::Cividis.color(0.5));
    assert_all!(same.colors(&[0.05])[0].iter().zip(middle), |(a, b)| (a - b).abs() < 0.01);
}

#[test]
fn clusters_have_colors_and_single_grains_are_gray() {
    let dir = two_frames();
    let renderer = prepared(dir.path(), small("cluster")).unwrap();
    let colors = renderer.colors(&[0.0, 0.0, 1.0, 1.0, 2.0, 0.0, 7.0, 7.0]);
    assert_eq!(colors[0], colors[5]);
    assert_ne!(colors[0], colors[2]);
    assert_eq!(colors[4], light_of(name_color(None)));
    // However many there are, none looks like the heaviest.
    assert_ne!(colors[6], colors[0]);
    // Numbers that no run writes are names as well, and take no room.
    let odd = [4e9, 4e9, 1e300, f64::NAN, f64::NEG_INFINITY, -1.0, -1.0];
    let colors = renderer.colors(&odd);
    assert_eq!(colors[0], colors[1]);
    assert_eq!([2, 3, 4].map(|at| colors[at]), [light_of(name_color(None)); 3]);
}

#[test]
fn what_frames_do_not_hold_is_told() {
    let dir = two_frames();
    let message = prepared(dir.path(), small("speeds")).unwrap_err().to_string();
    assert!(message.contains("\"speeds\"; did you mean \"speed\"?"), "{message}");
    assert!(message.ends_with("they can be by speed, cluster, size"), "{message}");
    let bonds = prepared(dir.path(), Options { bonds: true, ..small("speed") }).unwrap_err().to_string();
    assert!(bonds.contains("has no frames of bonds"), "{bonds}");
    let empty = tempfile::tempdir().unwrap();
    let nothing = prepared(empty.path(), small("speed")).unwrap_err();
    assert_matches!(nothing, RenderError::NoFrames { .. });
    assert_eq!(nothing.exit_code(), 2);
    write_frames(empty.path(), &[Vec::new()]);
    assert_matches!(prepared(empty.path(), small("speed")), Err(RenderError::NoGrains { .. }));
}

fn make(dir: &Path, to: &Path, shots: Shots) -> Result<AnimationEnding, RenderError> {
    let wanted = Animation { output: Output::of(to)?, shots, options: small("speed") };
    animate(dir, wanted, &mut |_| ControlFlow::Continue(()))
}

#[test]
fn pictures_of_chosen_frames() {
    let dir = two_frames();
    write_frames(dir.path(), &vec![ball(20, 1.0); 7]);
    let out = tempfile::tempdir().unwrap();
    let names = |folder: &Path| -> Vec<String> {
        let entries = std::fs::read_dir(folder).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    };
    let shots = Shots { frames: Some(1..=6), every: 2, ..Shots::default() };
    let pattern = out.path().join("some/shot*.png");
    assert_eq!(make(dir.path(), &pattern, shots.clone()).unwrap(), AnimationEnding::Finished(3));
    assert_eq!(names(&out.path().join("some")), ["shot000000.png", "shot000001.png", "shot000002.png"]);
    // Pictures that are there already are not mixed with others.
    assert_matches!(make(dir.path(), &pattern, shots.clone()), Err(RenderError::Occupied { .. }));
    let single = out.path().join("one.png");
    assert_eq!(make(dir.path(), &single, shots).unwrap(), AnimationEnding::Finished(1));
    assert_eq!(names(out.path()), ["one.png", "some"]);
    let beyond = Shots { frames: Some(5..=7), ..Shots::default() };
    let message = make(dir.path(), &single, beyond).unwrap_err().to_string();
    assert_starts!(message, "there are no frames 5..7");
    assert_ends!(message, "has 7, from 0 to 6");
}

#[test]
fn a_cut_frame_is_named() {
    let dir = two_frames();
    let path = dir.path().join("frames/grains_000001.vtp");
    let bytes = std::fs::read(&path).unwrap();
    std::fs::write(&path, &bytes[..bytes.len() / 2]).unwrap();
    let to = dir.path().join("picture.png");
    let error = make(dir.path(), &to, Shots::default()).unwrap_err();
    let message = error.to_string();
    assert!(message.contains("grains_000001.vtp") && message.contains("it is cut short"), "{message}");
    assert_eq!(error.exit_code(), 2);
    assert_gone!(to);
}

#[test]
fn a_stop_leaves_no_half_movie() {
    let dir = two_frames();
    let to = dir.path().join("out/movie.mp4");
    let wanted =
        Animation { output: Output::of(&to).unwrap(), shots: Shots::default(), options: small("speed") };
    let ending = animate(dir.path(), wanted, &mut |progress| match progress {
        AnimationProgress::Drawing(1, 2) => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    });
    match ending {
        Ok(ending) => assert_eq!(ending, AnimationEnding::Interrupted(1)),
        Err(error) => assert!(matches!(error, RenderError::NoFfmpeg), "{error}"),
    }
    assert_eq!(std::fs::read_dir(dir.path().join("out")).unwrap().count(), 0);
}

#[test]
fn outputs_are_told_by_their_names() {
    let of = |path: &str| Output::of(Path::new(path));
    assert_eq!(of("a.PNG").unwrap(), Output::Picture("a.PNG".into()));
    assert_eq!(of("x/m.gif").unwrap(), Output::Gif("x/m.gif".into()));
    let pattern = Output::Pictures(".".into(), ["s".into(), ".png".into()]);
    assert_eq!(of("s*.png").unwrap(), pattern);
    for unknown in ["m.avi", "movie", "a/*.mp4", "a*b*.png"] {
        assert!(matches!(of(unknown), Err(RenderError::Output { .. })), "{unknown}");
    }
    assert_eq!(of("m.mp4").unwrap().fitting([641, 360]), [642, 360]);
    let options = Options { background: Background::Transparent, ..small("speed") };
    let wanted = Animation { output: of("m.mp4").unwrap(), shots: Shots::default(), options };
    let refused = animate(Path::new("nowhere"), wanted, &mut |_| ControlFlow::Continue(()));
    assert_matches!(refused, Err(RenderError::TransparentMovie));
}

/// A box of 4 m, pressed together by 30 % a second from all sides: after half a second its edges are drawn 4 exp(-0.15) m long.
#[test]
fn the_volume_is_drawn_as_it_is_by_then() {
    let dir = tempfile::tempdir().unwrap();
    write_frames(dir.path(), &[ball(3, 1.0), ball(3, 0.8)]);
    let text = "version = 1\ntime.end = \"1 s\"\nengine.verlet.step = \"1 ms\"\nmaterials.clay.density = \"2000 kg/m3\"\n\
                [volume]\nlower = [\"-2 m\", \"-2 m\", \"-2 m\"]\nupper = [\"2 m\", \"2 m\", \"2 m\"]\n\
                deformation.strain_rate = [\"-0.3 1/s\", \"-0.3 1/s\", \"-0.3 1/s\"]\n[[grains]]\nmaterial = \"clay\"\n\
                size.constant.radius = \"5 cm\"\nplacement.fill.count = 3\n";
    std::fs::write(dir.path().join("scenario.toml"), text).unwrap();
    let sequence = FrameSequence::open(dir.path()).unwrap();
    for (number, factor) in [(0, 1.0), (1, (-0.15_f64).exp())] {
        let balls = sequence.balls(number, &sequence.read(number).unwrap()).unwrap();
        let [lower, upper] = sequence.volume_at(number, &balls).unwrap();
        assert_near_vector!(upper - lower, Vec3::new(4.0, 4.0, 4.0) * factor, 1e-14, "m");
    }
}

/// All of a box is in the picture; of a plane without an end no more than is near what else is seen, however large it is in the frame.
#[test]
fn the_view_holds_walls_that_end() {
    let wall = |name: &str, shape: &str| {
        format!("[[walls]]\nname = \"{name}\"\nmaterial = \"clay\"\nshape.{shape}\n")
    };
    let text = "version = 1\ntime.end = \"1 s\"\nengine.verlet.step = \"1 ms\"\nmaterials.clay.density = \"2000 kg/m3\"\n\
                [[grains]]\nmaterial = \"clay\"\nsize.constant.radius = \"5 cm\"\n\
                placement.list.positions = [[\"0 m\", \"0 m\", \"0 m\"]]\n[contact.normal.hooke]\nstiffness = \"1 kN/m\"\n"
        .to_owned()
        + &wall("box", "box = { lower = [\"-4 m\", \"-4 m\", \"-4 m\"], upper = [\"4 m\", \"4 m\", \"4 m\"] }")
        + &wall("floor", "plane = { point = [\"0 m\", \"0 m\", \"-1 m\"], normal = [0.0, 0.0, 1.0] }");
    let triangle = |size: f64| [[-size, -size, -1.0], [size, -size, -1.0], [0.0, size, -1.0]].map(Vec3::from);
    let distance = |walls: &[(f64, u32)], options: Options| {
        let dir = tempfile::tempdir().unwrap();
        write_frames(dir.path(), &[ball(400, 1.0)]);
        std::fs::write(dir.path().join("scenario.toml"), &text).unwrap();
        let triangles: Vec<[Vec3; 3]> = walls.iter().map(|(size, _)| triangle(*size)).collect();
        let numbers: Vec<u32> = walls.iter().flat_map(|(_, number)| [*number; 3]).collect();
        let frames = dir.path().join("frames");
        agglo::record::frames::write_walls(&frames.join("walls_000000.vtp"), 0.0, &triangles, &numbers)
            .unwrap();
        let mut list = Collection::default();
        list.add(0.0, "walls_000000.vtp");
        list.write(&frames.join("walls.pvd")).unwrap();
        let renderer = prepared(dir.path(), options).unwrap();
        let drawn = renderer.picture(0).unwrap();
        (renderer.camera().clone(), drawn)
    };
    let of_grains = Options { walls: false, ..small("speed") };
    let (alone, bare) = distance(&[(1000.0, 1)], of_grains);
    let (with_floor, floored) = distance(&[(1000.0, 1)], small("speed"));
    assert_between!(with_floor.distance() / alone.distance(), 1.0..1.2, "distance beside that without walls");
    assert_false!(bare == floored, "the floor is not drawn");
    let (with_box, _) = distance(&[(4.0, 0)], small("speed"));
    for corner in triangle(4.0) {
        let ([x, y], _) = with_box.project(corner).unwrap();
        assert_true!((0.0..64.0).contains(&x) && (0.0..48.0).contains(&y), "{corner:?} is seen at {x}, {y}");
    }
}
