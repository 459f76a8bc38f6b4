//! Frames for ParaView: grains, bonds, rays and walls, each with its list of files and times.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::acoustics::Flight;
use crate::contact::network::Bond;
use crate::domain::{Image, Space};
use crate::folder::names::{self, FRAMES};
use crate::folder::{Mark, RunFolder};
use crate::math::Vec3;
use crate::particles::{ColumnValues, Particles};
use crate::record::RecordError;
use crate::record::frames::{Collection, Field, write_bonds, write_grains, write_rays, write_walls};
use crate::walls::{Triangle, Walls};

use super::fit::Reading;

/// The frames of a kind: their list, and what their files are.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct FrameList {
    list: Collection,
    marks: Vec<Mark>,
}

/// The lists of frames; a checkpoint holds them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FrameLists {
    grains: FrameList,
    bonds: FrameList,
    rays: FrameList,
    walls: FrameList,
    last_time: Option<f64>,
}

impl FrameLists {
    /// What cannot be of a run that has come to `now` [s], if anything.
    pub fn fault(&self, now: f64) -> Option<&'static str> {
        let all = [&self.grains, &self.bonds, &self.rays, &self.walls];
        let can_be = |time: f64| (0.0..=now).contains(&time);
        let times = all.into_iter().flat_map(|frames| frames.list.frames()).map(|(time, _)| time);
        if all.into_iter().any(|frames| frames.marks.len() != frames.list.len()) {
            Some("its lists of frames do not fit each other")
        } else if !times.chain(self.last_time).all(can_be)
            || self.last_time != self.grains.list.frames().last().map(|(time, _)| time)
        {
            Some("the times of its frames cannot be")
        } else {
            None
        }
    }

    /// Whether the folder has the frames as they were written, and lists that begin with them; else why not.
    pub fn check(&self, folder: &RunFolder, reading: &mut Reading<'_>) -> Result<(), String> {
        let Self { grains, bonds, rays, walls, .. } = self;
        [("grains", grains), ("bonds", bonds), ("rays", rays), ("walls", walls)]
            .into_iter()
            .try_for_each(|(kind, frames)| frames.check(kind, folder, reading))
    }
}

impl FrameList {
    fn check(&self, kind: &str, folder: &RunFolder, reading: &mut Reading<'_>) -> Result<(), String> {
        let count = self.list.len();
        if count == 0 {
            return Ok(());
        }
        let listed = Collection::read(&folder.frame_list(kind)).map_err(|error| error.to_string())?;
        if !listed.frames().take(count).eq(self.list.frames()) || self.marks.len() != count {
            return Err(format!(
                "{FRAMES}/{} does not list the frames that the run had written",
                names::frame_list(kind)
            ));
        }
        for (number, ((_, file), mark)) in (1..).zip(self.list.frames().zip(&self.marks)) {
            if reading(&format!("reading frame {number} of {count} of {kind}")).is_break() {
                return Err("stopped".to_owned());
            }
            mark.check(&folder.frames().join(file)).map_err(|why| format!("{FRAMES}/{file} {why}"))?;
        }
        Ok(())
    }

    /// Takes up a frame that was written and writes the list.
    fn add(&mut self, time: f64, name: &str, mark: Mark, list: &Path) -> Result<(), RecordError> {
        self.list.add(time, name);
        self.marks.push(mark);
        self.list.write(list)
    }

    fn next_name(&self, kind: &str) -> String {
        names::frame(kind, self.list.len())
    }
}

/// Writes frames into a folder.
#[derive(Debug)]
pub struct Frames {
    folder: RunFolder,
    lists: FrameLists,
}

impl Frames {
    /// Frames in the folder of a run, going on after those of `lists`.
    pub fn new(folder: &RunFolder, lists: FrameLists) -> Self {
        Self { folder: folder.clone(), lists }
    }

    /// The lists so far.
    pub fn lists(&self) -> &FrameLists {
        &self.lists
    }

    /// Time [s] of the last frame.
    pub fn last_time(&self) -> Option<f64> {
        self.lists.last_time
    }

    /// Writes the grains at `time` [s] with an integer field [n] of this name and, where space repeats itself, how often each went
    /// out through the faces across each axis.
    pub fn grains(
        &mut self,
        time: f64,
        grains: &Particles,
        images: &[Image],
        (field, values): (&str, &[u32]),
    ) -> Result<(), RecordError> {
        // Here and not for each file: those of a moment are written one after another.
        self.folder.hold_on()?;
        self.lists.last_time = Some(time);
        let name = self.lists.grains.next_name("grains");
        let mut extra = vec![Field::new(field, ColumnValues::Integers(values))];
        let images: Vec<Vec3> = images.iter().map(|image| image.map(f64::from).into()).collect();
        if !images.is_empty() {
            extra.push(Field::new("image", ColumnValues::Vectors(&images)));
        }
        let mark = write_grains(&self.folder.frames().join(&name), time, grains, &extra)?;
        self.lists.grains.add(time, &name, mark, &self.folder.frame_list("grains"))
    }

    /// Writes the bonds at `time` [s] as lines between centers, in the order of the names that they join.
    pub fn bonds(
        &mut self,
        time: f64,
        grains: &Particles,
        space: &Space,
        bonds: &[Bond],
    ) -> Result<(), RecordError> {
        let name = self.lists.bonds.next_name("bonds");
        let mut bonds: Vec<&Bond> = bonds.iter().collect();
        bonds.sort_by_key(|bond| {
            let [a, b] = bond.grains.map(|grain| grains.id[grain as usize]);
            [a.min(b), a.max(b)]
        });
        let pairs: Vec<[u32; 2]> = bonds.iter().map(|bond| bond.grains).collect();
        let stretch: Vec<f64> = bonds
            .iter()
            .map(|bond| {
                let [a, b] = bond.grains.map(|grain| grains.position[grain as usize]);
                space.shortest(b - a).norm() / bond.state.length - 1.0
            })
            .collect();
        let fields = [Field::new("stretch", ColumnValues::Scalars(&stretch))];
        let mark = write_bonds(&self.folder.frames().join(&name), time, grains, space, &pairs, &fields)?;
        self.lists.bonds.add(time, &name, mark, &self.folder.frame_list("bonds"))
    }

    /// Writes the rays in flight at `time` [s].
    pub fn rays(&mut self, time: f64, flight: &Flight, space: &Space) -> Result<(), RecordError> {
        let name = self.lists.rays.next_name("rays");
        let rays = flight.rays();
        let positions: Vec<Vec3> = rays.iter().map(|ray| space.home(ray.position()).0).collect();
        let directions: Vec<Vec3> = rays.iter().map(|ray| ray.direction).collect();
        let powers: Vec<f64> = rays.iter().map(|ray| ray.power).collect();
        let mark = write_rays(&self.folder.frames().join(&name), time, &positions, &directions, &powers)?;
        self.lists.rays.add(time, &name, mark, &self.folder.frame_list("rays"))
    }

    /// Writes the walls at `time` [s] as triangles; of those without an end what is beside the grains.
    pub fn walls(&mut self, time: f64, grains: &Particles, walls: &Walls) -> Result<(), RecordError> {
        let name = self.lists.walls.next_name("walls");
        let (mut triangles, mut numbers) = (Vec::<Triangle>::new(), Vec::<u32>::new());
        for (wall, number) in (0..walls.len()).zip(0_u32..) {
            let own = walls.triangles(wall, time, grains);
            numbers.extend(own.iter().flat_map(|_| [number; 3]));
            triangles.extend(own);
        }
        let mark = write_walls(&self.folder.frames().join(&name), time, &triangles, &numbers)?;
        self.lists.walls.add(time, &name, mark, &self.folder.frame_list("walls"))
    }
}
