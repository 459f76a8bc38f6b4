//! Frames of soft spheres: from a state of distinct quantities through the run's own path into files, and back by the names of
//! the fields.

use super::distinct::*;
use super::*;
use crate::math::Vec3;
use crate::record::frames::{FieldValues, Frame};
use crate::run::frames::FrameLists;

/// The frames that a run writes, by kind; none where it writes none of this kind.
fn frames(job: &Soft) -> [Option<Frame>; 3] {
    let folder = tempfile::tempdir().unwrap();
    let folder = RunFolder::create(&folder.path().join("run")).unwrap();
    let mut frames = Frames::new(&folder, FrameLists::default());
    job.record_frame(&mut frames).unwrap();
    ["grains", "bonds", "rays"]
        .map(|kind| Frame::read(&folder.frames().join(format!("{kind}_000000.vtp"))).ok())
}

/// Holds the fields of a frame, all of them, to what is due: a row of one or three numbers a point or line.
fn assert_fields(kind: &str, frame: &Frame, wanted: &[(&str, Vec<Vec<f64>>)]) {
    let mut names: Vec<&str> = frame.fields.iter().map(|(name, _)| name.as_str()).collect();
    let mut due: Vec<&str> = wanted.iter().map(|(name, _)| *name).collect();
    names.sort_unstable();
    due.sort_unstable();
    assert_eq!(names, due, "{kind}: found on the left, due on the right");
    assert_eq!(frame.time, TIMES[0], "{kind}: time [s]");
    for (name, rows) in wanted {
        let found: Vec<Vec<f64>> = match frame.field(name).unwrap() {
            FieldValues::Integers(values) => values.iter().map(|value| vec![f64::from(*value)]).collect(),
            FieldValues::Scalars(values) => values.iter().map(|value| vec![*value]).collect(),
            FieldValues::Vectors(values) => values.iter().map(|value| value.to_vec()).collect(),
        };
        assert_eq!(&found, rows, "{kind}: field {name}: found on the left, due on the right (in its unit)");
    }
}

fn scalars(of: impl Fn(usize) -> f64) -> Vec<Vec<f64>> {
    (0..RADII.len()).map(|id| vec![of(id)]).collect()
}

fn vectors(of: impl Fn(usize) -> [f64; 3]) -> Vec<Vec<f64>> {
    (0..RADII.len()).map(|id| of(id).to_vec()).collect()
}

#[test]
fn fields_of_grains_stand_under_their_names() {
    let job = distinct();
    let [Some(frame), _, _] = frames(&job) else { panic!("no frame of grains") };
    assert_eq!(frame.points, PLACES, "grains: points [m]: found on the left, due on the right");
    // Sand comes after glass in the list of materials.
    let wanted = [
        ("id", scalars(|id| id as f64)),
        ("velocity_m_s", vectors(|id| VELOCITIES[id])),
        ("angular_velocity_rad_s", vectors(|id| angular_velocity(id).to_array())),
        ("radius_m", scalars(|id| RADII[id])),
        ("mass_kg", scalars(|id| MASSES[id])),
        ("material", scalars(|id| if id == 2 { 1.0 } else { 0.0 })),
        ("temperature_K", scalars(|id| 300.0 + id as f64)),
        ("charge_C", scalars(charge)),
        ("polarity", scalars(|id| if id % 3 == 0 { -1.0 } else { 1.0 })),
        ("contact_stiffness_Pa", scalars(|id| 1e5 + 10.0 * id as f64)),
        ("absorbed_power_W", scalars(|id| 50.0 + 0.5 * id as f64)),
        ("cluster", scalars(|id| f64::from(LABELS[id]))),
    ];
    assert_fields("grains", &frame, &wanted);
}

/// The bond 0-1 is 1 % longer than when it was made, the bond 1-2 is 2 % shorter.
#[test]
fn fields_of_bonds_stand_under_their_names() {
    let [_, Some(mut frame), _] = frames(&distinct()) else { panic!("no frame of bonds") };
    let ends: Vec<[[f64; 3]; 2]> =
        frame.lines.iter().map(|line| line.map(|end| frame.points[end as usize])).collect();
    assert_eq!(ends, [[PLACES[0], PLACES[1]], [PLACES[1], PLACES[2]]], "bonds: ends [m]");
    let at = frame.fields.iter().position(|(name, _)| name == "stretch").unwrap();
    let (_, FieldValues::Scalars(stretch)) = frame.fields.remove(at) else { panic!("stretch is no number") };
    for (bond, (found, wanted)) in stretch.iter().zip([0.01, -0.02]).enumerate() {
        // Rounding of a length over a length.
        assert!((found - wanted).abs() < 1e-14, "bond {bond}: field stretch is due {wanted}, found {found}");
    }
    let wanted = [
        ("id", scalars(|id| id as f64)),
        ("grain_i", vec![vec![0.0], vec![1.0]]),
        ("grain_j", vec![vec![1.0], vec![2.0]]),
    ];
    assert_fields("bonds", &frame, &wanted);
}

#[test]
fn fields_of_rays_stand_under_their_names() {
    let [_, _, Some(frame)] = frames(&distinct()) else { panic!("no frame of rays") };
    let places = RAYS
        .map(|(_, origin, direction, way, _)| (Vec3::from(origin) + Vec3::from(direction) * way).to_array());
    assert_eq!(frame.points, places, "rays: points [m]: found on the left, due on the right");
    let wanted = [
        ("direction", RAYS.iter().map(|ray| ray.2.to_vec()).collect()),
        ("power_W", RAYS.iter().map(|ray| vec![ray.4]).collect()),
    ];
    assert_fields("rays", &frame, &wanted);
}

#[test]
fn frames_of_bonds_and_rays_can_be_turned_off_one_by_one() {
    let written = |with_bonds: bool, with_rays: bool| {
        frames(&Soft { with_bonds, with_rays, ..distinct() }).map(|frame| frame.is_some())
    };
    assert_eq!(written(false, true), [true, false, true], "grains, bonds, rays");
    assert_eq!(written(true, false), [true, true, false], "grains, bonds, rays");
}
