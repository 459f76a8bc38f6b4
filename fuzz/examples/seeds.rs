//! Fills `corpus/` with seeds: the shipped files, and those of small runs and searches made on the spot.
//!
//! `cargo run --manifest-path fuzz/Cargo.toml --no-default-features --example seeds`

use std::fs;
use std::io;
use std::path::Path;

use agglo_fuzz::BENCH;

/// Targets, and where the files are that they begin with: parts of their paths.
const OF_FOLDERS: [(&str, &[&str]); 7] = [
    ("table", &["table/grains.csv"]),
    ("checkpoint", &["stopped/checkpoints/", "finished/checkpoints/", "grown/checkpoints/"]),
    ("journal", &["search/replicates.journal"]),
    ("part", &["part/part.json"]),
    ("frame", &["finished/frames/"]),
    ("series", &["finished/series/"]),
    ("summary", &["finished/summary.json", "ended/summary.json", "ended/best/summary.json"]),
];

fn main() -> io::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for target in ["scenario", "plan", "campaign"] {
        for entry in fs::read_dir(root.join("../scenarios"))? {
            let path = entry?.path();
            put(root, target, &path.file_name().unwrap_or_default().to_string_lossy(), &fs::read(&path)?)?;
        }
    }
    for (target, places) in OF_FOLDERS {
        for name in places.iter().flat_map(|place| BENCH.named(place, "")) {
            put(root, target, &name.to_string_lossy().replace('/', "-"), BENCH.bytes(name))?;
        }
    }
    Ok(())
}

fn put(root: &Path, target: &str, name: &str, bytes: &[u8]) -> io::Result<()> {
    let folder = root.join("corpus").join(target);
    fs::create_dir_all(&folder)?;
    fs::write(folder.join(name), bytes)
}
