//! What tests find, for the pages that tell of it.

use std::fmt::Write as _;
use std::fs::File;
use std::io::Write as _;

/// Adds a line `CASE NAME=VALUE ...` to the file that `AGGLO_FOUND` names, for `docs/measured/measure.py tests`. Without one it does
/// nothing.
pub fn found(case: &str, figures: &[(&str, f64)]) {
    let Some(path) = std::env::var_os("AGGLO_FOUND") else { return };
    let mut line = case.to_owned();
    for (name, value) in figures {
        let _ = write!(line, " {name}={value:e}");
    }
    line.push('\n');
    // In one piece, since tests run side by side.
    let file = File::options().append(true).create(true).open(path);
    let written = file.and_then(|mut file| file.write_all(line.as_bytes()));
    assert!(written.is_ok(), "the file of AGGLO_FOUND: {written:?}");
}
