//! Writes grains, bonds and rays as VTK reads them: two frames, and a list of them. And a table of numbers that are hard
//! to write.
//!
//! `cargo run -p agglo --example write_frames -- out` writes into the folder `out`.

use std::error::Error;
use std::path::{Path, PathBuf};

use agglo::domain::Space;
use agglo::math::Vec3;
use agglo::particles::{Particles, Row};
use agglo::record::frames::{Collection, Field, write_bonds, write_grains, write_rays};
use agglo::record::{Cell, Series};

/// Five grains; the one named k is in memory at place 4 - k.
fn grains(time: f64) -> Particles {
    let mut grains = Particles::default();
    for k in (0..5_u32).rev() {
        let x = f64::from(k);
        grains.push(Row {
            id: k,
            position: Vec3::new(x, 0.5 * x, -x + time),
            velocity: Vec3::new(0.0, 0.0, 1.0),
            radius: 0.1 + 0.01 * x,
            mass: 1.0 / 3.0 + x,
            material: k % 2,
            temperature: 300.0,
            ..Row::default()
        });
    }
    grains
}

/// Numbers of every size, each beside its bits and a count.
fn table(path: &Path) -> Result<(), Box<dyn Error>> {
    let mut table = Series::create(path, &["value", "high_bits", "low_bits", "count"])?;
    for value in
        [0.1, 1.0 / 3.0, 1e-28, -1e-28, 5e-324, f64::MAX, 1e22, 1e16, 123_456_789.125, 2.5e-7, 1512.0]
    {
        let bits = value.to_bits();
        let halves = [bits >> 32, bits & 0xffff_ffff, 1512].map(Cell::Count);
        table.row([Cell::Number(value)].into_iter().chain(halves).collect::<Vec<_>>())?;
    }
    table.flush()?;
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args_os().nth(1).map_or_else(|| PathBuf::from("out"), PathBuf::from);
    std::fs::create_dir_all(folder.join("frames"))?;
    let mut list = Collection::default();
    for (frame, time) in [0.0, 0.25].into_iter().enumerate() {
        let name = |what: &str| format!("frames/{what}-{frame:05}.vtp");
        let path = |what: &str| folder.join(Path::new(&name(what)));
        let grains = grains(time);
        // Cluster numbers and pairs are in memory's order, as the columns are.
        let clusters = [2_u32, 1, 1, 0, 0];
        write_grains(&path("grains"), time, &grains, &[Field::new("cluster", clusters.as_slice())])?;
        let strain = [0.125, -0.25];
        let pairs = [[4, 3], [2, 1]];
        write_bonds(
            &path("bonds"),
            time,
            &grains,
            &Space::OPEN,
            &pairs,
            &[Field::new("strain", strain.as_slice())],
        )?;
        let directions = [Vec3::AXES[2], Vec3::new(0.6, 0.0, 0.8)];
        write_rays(&path("rays"), time, &grains.position[..2], &directions, &[1.5, 0.75])?;
        list.add(time, &name("grains"));
    }
    list.write(&folder.join("grains.pvd"))?;
    table(&folder.join("numbers.csv"))
}
