//! Lists of frames with their times (`.pvd`).

use std::fmt::Write as _;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::polydata::escaped;
use crate::record::{RecordError, atomic};

/// The frames written so far. It belongs into checkpoints, so that a resumed run goes on with the same list.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Collection {
    frames: Vec<(f64, String)>,
}

impl Collection {
    /// Adds a frame: its time [s] and its file, relative to that of the list.
    pub fn add(&mut self, time: f64, file: &str) {
        self.frames.push((time, file.to_owned()));
    }

    /// How many frames.
    pub fn len(&self) -> usize {
        self.frames.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.frames.is_empty()
    }

    /// Writes the list, in place of what was there.
    ///
    /// # Errors
    /// [`RecordError::File`].
    pub fn write(&self, path: &Path) -> Result<(), RecordError> {
        let mut text = String::from(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n",
        );
        for (time, file) in &self.frames {
            let file = escaped(file);
            // Writing to a string cannot fail.
            let _ = writeln!(text, "<DataSet timestep=\"{time:?}\" group=\"\" part=\"0\" file=\"{file}\"/>");
        }
        text += "</Collection>\n</VTKFile>\n";
        atomic::write(path, text.as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_names_every_frame() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("grains.pvd");
        let mut list = Collection::default();
        list.add(0.0, "frames/grains-0.vtp");
        list.add(2.5e-7, "frames/a&b.vtp");
        list.write(&path).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.contains("timestep=\"0.0\" group=\"\" part=\"0\" file=\"frames/grains-0.vtp\""));
        assert!(text.contains("timestep=\"2.5e-7\" group=\"\" part=\"0\" file=\"frames/a&amp;b.vtp\""));
        assert_eq!(list.len(), 2);
    }
}
