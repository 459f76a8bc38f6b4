//! Lists of frames with their times (`.pvd`).

use std::fmt::Write as _;
use std::path::{Component, Path};

use serde::{Deserialize, Serialize};

use super::polydata::escaped;
use crate::record::{RecordError, atomic, door};
use crate::text::{Number, cell};

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

    /// Reads a list of ours back.
    ///
    /// # Errors
    /// [`RecordError::File`] where it cannot be read, [`RecordError::Damaged`] where it is not a whole list.
    pub fn read(path: &Path) -> Result<Self, RecordError> {
        let bytes = door::read(path, door::MOST_OF_A_TABLE).map_err(RecordError::file("read", path))?;
        let text = String::from_utf8_lossy(&bytes);
        let entry = |row: &str| {
            let value =
                |key: &str| Some(row.split_once(&format!("{key}=\""))?.1.split_once('"')?.0.to_owned());
            Some((value("timestep")?.parse().ok()?, value("file")?))
        };
        let damaged = |reason: String| RecordError::Damaged { path: path.to_owned(), reason };
        let rows = text.lines().filter(|line| line.starts_with("<DataSet "));
        let frames = rows.map(entry).collect::<Option<Vec<_>>>();
        match frames.filter(|_| text.ends_with("</Collection>\n</VTKFile>\n")) {
            None => Err(damaged("it is not a whole list of frames".to_owned())),
            Some(frames) => match frames.iter().find_map(|(_, file)| fault_of_name(file)) {
                Some(reason) => Err(damaged(reason)),
                None => Ok(Self { frames }),
            },
        }
    }

    /// Times [s] and files, as they stand in the list.
    pub fn frames(&self) -> impl Iterator<Item = (f64, &str)> {
        self.frames.iter().map(|(time, file)| (*time, file.as_str()))
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
            let (time, file) = (Number(*time), escaped(file));
            // Writing to a string cannot fail.
            let _ = writeln!(text, "<DataSet timestep=\"{time}\" group=\"\" part=\"0\" file=\"{file}\"/>");
        }
        text += "</Collection>\n</VTKFile>\n";
        atomic::write(path, text.as_bytes())
    }
}

/// Why a name is none of a frame: it leads out of the folder that it is relative to, or no frame is called so.
fn fault_of_name(file: &str) -> Option<String> {
    if !Path::new(file).components().all(|part| matches!(part, Component::Normal(_))) {
        return Some(format!("its entry \"{}\" lies outside of its folder", cell(file)));
    }
    let shown = cell(file);
    (shown != file || file.is_empty()).then(|| format!("its entry \"{shown}\" is no name of a frame"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use agglo_testing::AWKWARD;

    #[test]
    fn awkward_times_come_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("grains.pvd");
        let mut list = Collection::default();
        for time in AWKWARD {
            list.add(time, "frame.vtp");
        }
        list.write(&path).unwrap();
        let read = Collection::read(&path).unwrap();
        assert_eq!(read.frames().map(|(time, _)| time).collect::<Vec<_>>(), AWKWARD);
    }

    #[test]
    fn entries_outside_of_the_folder_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("grains.pvd");
        for outside in ["/etc/passwd", "../grains-0.vtp", "frames/../../x.vtp"] {
            let mut list = Collection::default();
            list.add(0.0, outside);
            list.write(&path).unwrap();
            let text = Collection::read(&path).unwrap_err().to_string();
            assert!(text.contains(outside) && text.contains("lies outside"), "{text}");
        }
    }

    #[test]
    fn names_that_no_frame_has_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("grains.pvd");
        let long = "x".repeat(10_000);
        for odd in ["a\0.vtp", "\u{1b}[2J.vtp", "a\u{202e}.vtp", long.as_str(), ""] {
            let mut list = Collection::default();
            list.add(0.0, odd);
            list.write(&path).unwrap();
            let text = Collection::read(&path).unwrap_err().to_string();
            assert!(text.contains("is no name of a frame") && text.len() < 300, "{text}");
            assert!(!text.contains(char::is_control), "{text:?}");
        }
    }

    #[test]
    fn the_list_names_every_frame() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("grains.pvd");
        let mut list = Collection::default();
        list.add(0.0, "frames/grains-0.vtp");
        list.add(2.5e-7, "frames/a&b.vtp");
        list.write(&path).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        assert_contains!(text, "timestep=\"0\" group=\"\" part=\"0\" file=\"frames/grains-0.vtp\"");
        assert_contains!(text, "timestep=\"2.5e-7\" group=\"\" part=\"0\" file=\"frames/a&amp;b.vtp\"");
        assert_eq!(list.len(), 2);
        assert_eq!(Collection::read(&path).unwrap().frames().next(), Some((0.0, "frames/grains-0.vtp")));
        std::fs::write(&path, &text[..text.len() - 20]).unwrap();
        assert_matches!(Collection::read(&path), Err(RecordError::Damaged { .. }));
        std::fs::write(&path, [0xff, 0x00, 0x81]).unwrap();
        assert_err!(Collection::read(&path));
    }
}
