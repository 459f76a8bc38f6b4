//! What stands in the folder of a run: its scenario, its quantities, a table over time and the last frame of its grains.
//!
//! `cargo run --release -p agglo --example read_run -- FOLDER`

#![allow(clippy::print_stdout, reason = "it is a program")]

use std::error::Error;
use std::path::Path;

use agglo::folder::RunFolder;
use agglo::record::Sheet;
use agglo::record::frames::{Collection, FieldValues, Frame};
use agglo::scenario::Scenario;

fn main() -> Result<(), Box<dyn Error>> {
    let dir = std::env::args().nth(1).ok_or("give the folder of a run")?;
    let folder = RunFolder::open(Path::new(&dir))?;
    let scenario = Scenario::load(&folder.scenario())?;
    println!("{}, to {} s", scenario.title, scenario.time.end.si());

    // The tables over time are CSV files; what their columns mean is asked for by the kind of spheres.
    for table in agglo::run::tables(scenario.is_hard()) {
        let Ok(sheet) = Sheet::read(&folder.root().join(table.file())) else { continue };
        println!("\n{}", table.file());
        for column in table.columns() {
            let numbers = sheet.numbers(column.name).unwrap_or_default();
            if let (Some(first), Some(last)) = (numbers.first(), numbers.last()) {
                println!("  {:<40} {first:>12.4e} -> {last:>12.4e} {}", column.label, column.unit);
            }
        }
    }

    // Frames are VTK files, listed with their times.
    let list = folder.frame_list("grains");
    let frames = Collection::read(&list)?;
    if let Some((time, file)) = frames.frames().last() {
        let frame = Frame::read(&list.with_file_name(file))?;
        println!("\n{} grains at {time} s, in {file}", frame.points.len());
        for (name, values) in &frame.fields {
            if let FieldValues::Scalars(values) = values {
                let mean = values.iter().sum::<f64>() / values.len() as f64;
                println!("  {name:<40} {mean:>12.4e} in the mean");
            }
        }
    }
    Ok(())
}
