//! Tables of grains come into the folder, so that it runs again wherever it is moved to.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use super::{FolderError, RunFolder, names};
use crate::packing::Placement;
use crate::record::{RecordError, atomic, door};
use crate::scenario::Scenario;

/// The tables that are in a folder so far.
pub struct Tables<'a> {
    root: &'a Path,
    /// Their places in the folder, by where they came from.
    known: BTreeMap<PathBuf, PathBuf>,
}

impl<'a> Tables<'a> {
    /// Of a folder without tables.
    pub fn of(root: &'a Path) -> Self {
        Self { root, known: BTreeMap::new() }
    }

    /// Copies the tables of a scenario, which are relative to `base`; gives the scenario that names them in the folder.
    ///
    /// # Errors
    /// [`FolderError::Record`].
    pub fn adopt_all(&mut self, scenario: &Scenario, base: &Path) -> Result<Scenario, FolderError> {
        let mut scenario = scenario.clone();
        for group in &mut scenario.grains {
            if let Placement::Table(table) = &mut group.placement {
                table.file = self.adopt(&base.join(&table.file))?;
            }
        }
        if let Some(bonded) = scenario.soft_mut().and_then(|soft| soft.bonded.as_mut()) {
            *bonded = self.adopt(&base.join(&*bonded))?;
        }
        if let Some(from) = &mut scenario.from {
            *from = self.adopt_state(&base.join(&*from))?;
        }
        Ok(scenario)
    }

    /// Copies one; gives its place relative to the folder.
    ///
    /// # Errors
    /// [`FolderError::Record`].
    pub fn adopt(&mut self, from: &Path) -> Result<PathBuf, FolderError> {
        self.copy(from, door::MOST_OF_A_TABLE)
    }

    /// Copies a checkpoint, or the newest one of a run's folder, which may grow older meanwhile.
    ///
    /// # Errors
    /// [`FolderError::Record`].
    pub fn adopt_state(&mut self, from: &Path) -> Result<PathBuf, FolderError> {
        self.copy(&RunFolder::newest_state(from), door::MOST_OF_A_STATE)
    }

    fn copy(&mut self, from: &Path, most: u64) -> Result<PathBuf, FolderError> {
        if let Some(place) = self.known.get(from) {
            return Ok(place.clone());
        }
        let dir = self.root.join(names::TABLES);
        std::fs::create_dir_all(&dir).map_err(RecordError::file("make the folder", &dir))?;
        let name = from.file_name().map_or_else(|| OsString::from(names::PLACED), OsString::from);
        let mut place = Path::new(names::TABLES).join(&name);
        // Tables of one name may come from several folders.
        for number in 2.. {
            if self.known.values().all(|known| *known != place) {
                break;
            }
            let mut numbered = OsString::from(format!("{number}-"));
            numbered.push(&name);
            place = Path::new(names::TABLES).join(numbered);
        }
        let bytes = door::read(from, most).map_err(RecordError::file("read", from))?;
        atomic::write(&self.root.join(&place), &bytes)?;
        self.known.insert(from.to_owned(), place.clone());
        Ok(place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRAINS: &str = "version = 1\ntime.end = \"1 s\"\nengine.verlet.step = \"1 ms\"\n\
                          [materials.glass]\ndensity = \"2500 kg/m3\"\n";

    #[test]
    fn tables_of_one_name_from_two_folders_stay_apart_and_one_is_copied_once() {
        let folder = tempfile::tempdir().unwrap();
        let (base, root) = (folder.path().join("base"), folder.path().join("run"));
        for (place, text) in [("a/grains.csv", "one"), ("b/grains.csv", "two")] {
            std::fs::create_dir_all(base.join(place).parent().unwrap()).unwrap();
            std::fs::write(base.join(place), text).unwrap();
        }
        let group = |file: &str| {
            format!(
                "[[grains]]\nmaterial = \"glass\"\nsize.constant.radius = \"1 mm\"\nplacement.table.file = \"{file}\"\n"
            )
        };
        let text = [GRAINS, &group("a/grains.csv"), &group("b/grains.csv"), &group("a/grains.csv")].concat();
        let scenario = Scenario::from_toml(&text).unwrap();
        let own = Tables::of(&root).adopt_all(&scenario, &base).unwrap();
        let files: Vec<&Path> = own
            .grains
            .iter()
            .filter_map(|group| match &group.placement {
                Placement::Table(table) => Some(table.file.as_path()),
                _ => None,
            })
            .collect();
        let wanted = ["tables/grains.csv", "tables/2-grains.csv", "tables/grains.csv"].map(Path::new);
        assert_eq!(files, wanted);
        assert_eq!(std::fs::read_to_string(root.join(files[0])).unwrap(), "one");
        assert_eq!(std::fs::read_to_string(root.join(files[1])).unwrap(), "two");
    }
}
