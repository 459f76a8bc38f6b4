//! Walls in tables, summary and frames: from a run's own path into files, and back by their names.

use std::ops::ControlFlow;
use std::path::Path;

use super::summary::WallQuantities;
use super::*;
use crate::record::frames::{FieldValues, Frame};
use crate::run::distinct::tables;
use crate::run::frames::FrameLists;

/// Two grains that press with 0.2 N and 0.1 N on a floor that goes up at 0.5 m/s, and a cylinder that nothing touches.
fn job() -> Soft {
    started(TEXT)
}

const TEXT: &str = "version = 1\ntime.end = \"1 ms\"\nengine.verlet.step = \"10 ns\"\n[materials.glass]\n\
                density = \"2500 kg/m3\"\n[[grains]]\nmaterial = \"glass\"\nsize.constant.radius = \"1 mm\"\n\
                placement.list.positions = [[\"4 mm\", \"1 mm\", \"0.98 mm\"], [\"-2 mm\", \"3 mm\", \"0.99 mm\"]]\n\
                [contact.normal.hooke]\nstiffness = \"10 kN/m\"\n\
                [[walls]]\nname = \"pipe\"\nmaterial = \"glass\"\n\
                shape.cylinder = { point = [\"0 m\", \"0 m\", \"0 m\"], axis = [0.0, 0.0, 1.0], radius = \"20 mm\" }\n\
                [[walls]]\nname = \"floor\"\nmaterial = \"glass\"\n\
                shape.plane = { point = [\"1 mm\", \"2 mm\", \"0 m\"], normal = [0.0, 0.0, 1.0] }\n\
                motion.constant.velocity = [\"0 m/s\", \"0 m/s\", \"0.5 m/s\"]\n";

fn started(text: &str) -> Soft {
    let scenario = Scenario::from_toml(text).unwrap_or_else(|faults| panic!("{faults}"));
    let grains = crate::packing::place(&scenario, Path::new("")).unwrap();
    Soft::start(&scenario, grains.into(), &mut |_| ControlFlow::Continue(())).unwrap()
}

/// By hand: forces down, and torques (r - c) × F about the floor's point: x (-F) along -y, y (-F) along x, with r - c = (3, -1) mm and
/// (-3, 1) mm.
#[test]
fn walls_stand_under_their_names() {
    let mut job = job();
    let folder = tempfile::tempdir().unwrap();
    let mut tables = tables(Soft::TABLES, folder.path());
    job.record_rows(&mut tables).unwrap();
    tables.flush().unwrap();
    let text = std::fs::read_to_string(folder.path().join("series/walls.csv")).unwrap();
    let mut lines = text.lines();
    let head = "time_s,wall,contacts,force_x_N,force_y_N,force_z_N,torque_x_N_m,torque_y_N_m,torque_z_N_m,work_J,passed,\
         passed_kg,sound_impulse_x_N_s,sound_impulse_y_N_s,sound_impulse_z_N_s,sound_energy_J";
    assert_eq!(lines.next(), Some(head));
    let rows: Vec<Vec<f64>> =
        lines.map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect();
    let torque = [1e-3 * 0.2 - 1e-3 * 0.1, 3e-3 * 0.2 - 3e-3 * 0.1];
    let wanted = [[0.0; 10], [0.0, 1.0, 2.0, 0.0, 0.0, -0.3, torque[0], torque[1], 0.0, 0.0]];
    assert_eq!(rows.len(), wanted.len(), "rows: {rows:?}");
    for (row, wanted) in rows.iter().zip(wanted) {
        for ((found, wanted), name) in row.iter().zip(wanted).zip(head.split(',')) {
            // An overlap of 10 um is a difference of places of 1 mm.
            assert_near!(*found, wanted, 1e-13, "series/walls.csv: {name}");
        }
        assert_true!(row[10].is_nan() && row[11].is_nan(), "neither has an opening");
        assert_eq!(row[12..], [0.0; 4], "nothing sounds");
    }
}

/// One grain is above a floor with a hole, the other one below it. Its mass by hand:
/// 2500 kg/m³ times 4/3 π (1 mm)³.
#[test]
fn a_plate_tells_what_is_beyond_it() {
    let hole =
        "normal = [0.0, 0.0, 1.0], opening = { center = [\"1 mm\", \"2 mm\", \"0 m\"], radius = \"20 mm\" }";
    let text = TEXT.replacen("normal = [0.0, 0.0, 1.0]", hole, 1).replace("\"0.99 mm\"", "\"-0.99 mm\"");
    let mut job = started(&text);
    let folder = tempfile::tempdir().unwrap();
    let mut tables = tables(Soft::TABLES, folder.path());
    job.record_rows(&mut tables).unwrap();
    tables.flush().unwrap();
    let rows = std::fs::read_to_string(folder.path().join("series/walls.csv")).unwrap();
    let cells: Vec<&str> = rows.lines().last().unwrap().split(',').collect();
    let mass = 2500.0 * 4.0 / 3.0 * std::f64::consts::PI * 1e-9;
    assert_eq!((cells[1], cells[10]), ("1", "1"), "number of the wall, grains beyond it");
    assert_close!(cells[11].parse::<f64>().unwrap(), mass, 1e-12, "in kg");
    let walls = WallQuantities::of_all(&job.simulation);
    assert_eq!((walls[0].passed, walls[1].passed), (None, Some(1)), "grains beyond walls");
    assert_contains!(walls[1].told(), ", 1 grain beyond it with 1.047e-5 kg");
}

/// A run without walls has no table of them.
#[test]
fn a_run_without_walls_has_no_table_of_walls() {
    let (bare, _) = TEXT.split_once("[[walls]]").unwrap();
    let files = |text: &str| -> Vec<&str> {
        let scenario = Scenario::from_toml(text).unwrap_or_else(|faults| panic!("{faults}"));
        crate::run::tables_of(&scenario).iter().map(|table| table.file()).collect()
    };
    assert_false!(files(bare).contains(&"series/walls.csv"), "no walls");
    let mut with = files(TEXT);
    with.retain(|file| *file != "series/walls.csv");
    assert_eq!(with, files(bare), "all other tables");
    assert_eq!(files(TEXT).len(), with.len() + 1, "and that of walls");
}

/// After a step of 10 ns the floor has put in F v Δt = 0.3 N · 0.5 m/s · 10 ns, but for what the overlaps changed by meanwhile: v Δt over
/// them.
#[test]
fn the_summary_names_walls() {
    let mut job = job();
    job.simulation.step().unwrap();
    let walls = WallQuantities::of_all(&job.simulation);
    let names: Vec<&str> = walls.iter().map(|wall| wall.name.as_str()).collect();
    assert_eq!(names, ["pipe", "floor"]);
    assert_close!(walls[1].work, 1.5e-9, 1e-3, "in J");
    assert_close!(walls[1].force[2], -0.3, 1e-3, "in N");
    assert_eq!((walls[0].contacts, walls[1].contacts), (0, 2));
    let told = [&walls[0], &walls[1]].map(WallQuantities::told);
    assert_eq!(told[0], "0 contacts, 0 N on it, 0 J put in");
    assert_starts!(told[1], "2 contacts, 300.");
    assert_ends!(told[1], "nJ put in");
}

/// A frame lists the corners of triangles three by three, with the number of their wall; the floor goes up with the time.
#[test]
fn frames_show_walls() {
    let mut job = job();
    job.simulation.step().unwrap();
    let folder = tempfile::tempdir().unwrap();
    let folder = RunFolder::create(&folder.path().join("run")).unwrap();
    let mut frames = Frames::new(&folder, FrameLists::default());
    job.record_frame(&mut frames).unwrap();
    let frame = Frame::read(&folder.frames().join("walls_000000.vtp")).unwrap();
    let Some(FieldValues::Integers(walls)) = frame.field("wall") else { panic!("no field wall") };
    assert_eq!(frame.points.len() % 3, 0, "corners");
    let of = |number: u32| frame.points.iter().zip(walls).filter(move |(_, wall)| **wall == number);
    assert_above!(of(0).count(), 3 * 40, "corners of the pipe");
    for ([x, y, _], _) in of(0) {
        assert_near!(x.hypot(*y), 20e-3, 1e-15, "in m");
    }
    assert_above!(of(1).count(), 3 * 40, "corners of the floor");
    for ([_, _, z], _) in of(1) {
        assert_near!(*z, 5e-9, 1e-18, "in m");
    }
    let text = std::fs::read(folder.frames().join("walls_000000.vtp")).unwrap();
    let head = String::from_utf8_lossy(&text[..text.len().min(2000)]).into_owned();
    assert_contains!(head, &format!("NumberOfPolys=\"{}\"", frame.points.len() / 3));
}
