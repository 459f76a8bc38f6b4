//! Checkpoints that are damaged.

use std::fs;
use std::path::Path;

use crate::common::{Bench, STAGGERED, assert_same, bytes, checkpoints, complained, ended, reference};

fn flip_a_bit(path: &Path) {
    let mut content = fs::read(path).unwrap();
    let middle = content.len() / 2;
    content[middle] ^= 4;
    fs::write(path, content).unwrap();
}

fn name(path: &Path) -> &str {
    path.file_name().unwrap().to_str().unwrap()
}

#[test]
fn a_damaged_checkpoint_is_named_and_the_one_before_is_used() {
    let bench = Bench::with(STAGGERED);
    bench.stopped_after(150, &[]);
    let found = checkpoints(&bench.run());
    assert_eq!(found.len(), 2);
    flip_a_bit(&found[1].1);
    let done = ended(bench.resume().output().unwrap(), 0);
    let text = complained(&done);
    assert!(text.contains("warning: ") && text.contains(name(&found[1].1)), "{text}");
    assert!(text.contains("checksum"), "{text}");
    assert!(!text.contains(name(&found[0].1)), "{text}");
    assert_same(&bench.run(), reference(STAGGERED));
}

#[test]
fn without_a_whole_checkpoint_all_are_named_and_nothing_is_changed() {
    let bench = Bench::with(STAGGERED);
    bench.stopped_after(150, &[]);
    let found = checkpoints(&bench.run());
    for (_, path) in &found {
        flip_a_bit(path);
    }
    let before = bytes(&bench.run());
    let refused = ended(bench.resume().output().unwrap(), 1);
    let text = complained(&refused);
    assert!(found.iter().all(|(_, path)| text.contains(name(path))), "{text}");
    assert!(bytes(&bench.run()) == before, "the refused run was changed");
}

/// A table that someone shortened cannot be brought back to the checkpoint: nothing is touched.
#[test]
fn a_table_cut_short_is_named_and_nothing_is_changed() {
    let bench = Bench::with(STAGGERED);
    bench.stopped_after(150, &[]);
    let table = bench.run().join("series/momentum.csv");
    let content = fs::read(&table).unwrap();
    fs::write(&table, &content[..content.len() / 2]).unwrap();
    // Rows after the checkpoint, as a kill leaves them.
    let other = bench.run().join("series/energy.csv");
    let rows = fs::read_to_string(&other).unwrap();
    fs::write(&other, rows.clone() + rows.lines().last().unwrap() + "\n").unwrap();
    let before = bytes(&bench.run());
    let refused = ended(bench.resume().output().unwrap(), 1);
    let text = complained(&refused);
    assert!(text.contains("momentum.csv") && text.contains("cut or changed"), "{text}");
    assert!(bytes(&bench.run()) == before, "the refused run was changed");
}
