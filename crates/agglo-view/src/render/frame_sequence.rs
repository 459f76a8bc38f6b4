//! The frames of a run, in order.

use std::path::{Path, PathBuf};

use super::error::RenderError;
use super::sheet::Sheet;
use agglo::domain::{SpaceInTime, Volume};
use agglo::folder::{CampaignFolder, RunFolder};
use agglo::math::Vec3;
use agglo::record::frames::{Collection, FieldValues, Frame};
use agglo::record::{RecordError, door};
use agglo::scenario::Scenario;
use agglo::walls::Shape;

/// The frames of a run.
#[derive(Clone, Debug)]
pub struct FrameSequence {
    dir: PathBuf,
    /// Times [s] and files of grains, and of bonds, rays and walls where there are such.
    grains: Vec<(f64, PathBuf)>,
    bonds: Vec<(f64, PathBuf)>,
    rays: Vec<(f64, PathBuf)>,
    walls: Vec<(f64, PathBuf)>,
    /// The scenario, or why there is none.
    scenario: Result<Scenario, String>,
}

/// Parts of the longest length of the grains that walls without an end may be seen beside them.
const ROUND: f64 = 1.0;
const FLAT: f64 = 0.06;

/// A grain's place and size: center [m] and radius [m].
pub(super) type Ball = (Vec3, f64);

impl FrameSequence {
    /// Opens the frames in the folder of a run; of a search or study those of its best run.
    ///
    /// # Errors
    /// [`RenderError::NoFrames`], or [`RenderError::Frame`] where the list of frames cannot be read.
    pub fn open(dir: &Path) -> Result<Self, RenderError> {
        let best = CampaignFolder::at(dir).best();
        let dir = if !has_frames(dir) && has_frames(&best) { best } else { dir.to_owned() };
        let list = list_of(&dir, "grains");
        let grains = if list.is_file() { listed(&list).map_err(RenderError::Frame)? } else { Vec::new() };
        if grains.is_empty() {
            return Err(RenderError::NoFrames { dir, list });
        }
        let others = |kind| {
            let list = list_of(&dir, kind);
            if list.is_file() { listed(&list).map_err(RenderError::Frame) } else { Ok(Vec::new()) }
        };
        let scenario = scenario(&RunFolder::at(&dir).scenario());
        let [bonds, rays, walls] = [others("bonds")?, others("rays")?, others("walls")?];
        Ok(Self { dir, grains, bonds, rays, walls, scenario })
    }

    /// The folder of the run.
    pub fn dir(&self) -> &Path {
        &self.dir
    }

    /// How many frames.
    pub fn len(&self) -> usize {
        self.grains.len()
    }

    /// Never: a sequence without frames cannot be opened.
    pub fn is_empty(&self) -> bool {
        self.grains.is_empty()
    }

    /// Times of the frames [s].
    pub fn times(&self) -> impl Iterator<Item = f64> {
        self.grains.iter().map(|(time, _)| *time)
    }

    /// The file of a frame.
    pub fn path(&self, number: usize) -> &Path {
        &self.grains[number].1
    }

    /// The scenario, where the folder has one that this version reads.
    pub fn scenario(&self) -> Option<&Scenario> {
        self.scenario.as_ref().ok()
    }

    /// What is not known of the run, and why.
    pub fn note(&self) -> Option<String> {
        let reason = self.scenario.as_ref().err()?;
        Some(format!("the edges of the control volume and the names of materials are left out: {reason}"))
    }

    /// The control volume at the start, where there is one.
    pub(super) fn volume(&self) -> Option<&Volume> {
        self.scenario()?.volume()
    }

    /// Corners [m] of the control volume at the time of a frame with these grains, where there is one.
    pub(super) fn volume_at(&self, number: usize, balls: &[Ball]) -> Option<[Vec3; 2]> {
        let space = SpaceInTime::new(Some(self.volume()?), balls.iter().map(|ball| ball.1));
        Some(space.at(self.grains[number].0).corners())
    }

    /// Reads a frame of grains.
    ///
    /// # Errors
    /// [`RenderError::Frame`].
    pub fn read(&self, number: usize) -> Result<Frame, RenderError> {
        Frame::read(self.path(number)).map_err(RenderError::Frame)
    }

    /// Places and sizes of a frame's grains.
    pub(super) fn balls(&self, number: usize, frame: &Frame) -> Result<Vec<Ball>, RenderError> {
        let Some(FieldValues::Scalars(radii)) = frame.field("radius_m") else {
            return Err(RenderError::Field { path: self.path(number).to_owned(), field: "radius_m" });
        };
        Ok(frame.points.iter().map(|&point| Vec3::from(point)).zip(radii.iter().copied()).collect())
    }

    /// The bonds of a frame: a pair of places [m] each.
    pub(super) fn bonds(&self, number: usize) -> Result<Vec<[Vec3; 2]>, RenderError> {
        let Some(frame) = self.beside(&self.bonds, number)? else { return Ok(Vec::new()) };
        let place = |end: u32| Vec3::from(frame.points[end as usize]);
        Ok(frame.lines.iter().map(|pair| pair.map(place)).collect())
    }

    /// The rays of a frame: where they are [m] and where they go.
    pub(super) fn rays(&self, number: usize) -> Result<Vec<[Vec3; 2]>, RenderError> {
        let Some(frame) = self.beside(&self.rays, number)? else { return Ok(Vec::new()) };
        let Some(FieldValues::Vectors(directions)) = frame.field("direction") else {
            return Ok(Vec::new());
        };
        Ok(frame.points.iter().zip(directions).map(|(&at, &to)| [at.into(), to.into()]).collect())
    }

    /// The walls of a frame; triangles that cannot be are left out.
    pub(super) fn walls(&self, number: usize) -> Result<Vec<Sheet>, RenderError> {
        let Some(frame) = self.beside(&self.walls, number)? else { return Ok(Vec::new()) };
        let walls = match frame.field("wall") {
            Some(FieldValues::Integers(walls)) => walls.as_slice(),
            _ => &[],
        };
        let (triangles, _) = frame.points.as_chunks::<3>();
        let sheet = |(number, corners): (usize, &[[f64; 3]; 3])| {
            let is_whole = corners.as_flattened().iter().all(|part| part.is_finite());
            let wall = walls.get(3 * number).copied().unwrap_or(0);
            is_whole.then(|| Sheet { corners: corners.map(Vec3::from), wall })
        };
        Ok(triangles.iter().enumerate().filter_map(sheet).collect())
    }

    /// How far beside grains a wall is looked at, over the longest length of these: all of one with ends, a round one without an end as
    /// far as it is likely to be of interest, and little of a plane.
    pub(super) fn room_for(&self, wall: u32) -> f64 {
        let walls = self.scenario().and_then(Scenario::soft).map_or(&[][..], |soft| &soft.walls);
        match walls.get(wall as usize).map(|wall| &wall.shape) {
            Some(shape) if shape.is_bounded() => f64::INFINITY,
            Some(Shape::Cylinder(_)) => ROUND,
            _ => FLAT,
        }
    }

    /// The frame of the same time in another list: lists may begin later than that of grains.
    fn beside(&self, list: &[(f64, PathBuf)], number: usize) -> Result<Option<Frame>, RenderError> {
        let time = self.grains[number].0;
        let path = list.iter().find(|(known, _)| *known == time).map(|(_, path)| path);
        path.map(|path| Frame::read(path)).transpose().map_err(RenderError::Frame)
    }

    /// That there are frames of bonds or rays.
    pub(super) fn needs(&self, what: &'static str) -> Result<(), RenderError> {
        let list = if what == "bonds" { &self.bonds } else { &self.rays };
        if list.is_empty() {
            let dir = self.dir.clone();
            return Err(RenderError::NoLines { list: list_of(&dir, what), dir, what });
        }
        Ok(())
    }
}

/// The scenario of a run, or why it cannot be had.
fn scenario(path: &Path) -> Result<Scenario, String> {
    let shown = path.display();
    let text = door::read_text(path, door::MOST_OF_A_TEXT)
        .map_err(|error| format!("{shown} cannot be read: {error}"))?;
    Scenario::from_toml(&text).map_err(|faults| format!("{shown} is none for this version: {faults}"))
}

fn list_of(dir: &Path, kind: &str) -> PathBuf {
    RunFolder::at(dir).frame_list(kind)
}

fn has_frames(dir: &Path) -> bool {
    list_of(dir, "grains").is_file()
}

/// Times and files of a list of frames. What stands in it counts, not what is in the folder: a run that was killed may
/// have left frames that it will write anew.
fn listed(list: &Path) -> Result<Vec<(f64, PathBuf)>, RecordError> {
    let folder = list.parent().unwrap_or(Path::new("."));
    let frames = Collection::read(list)?;
    Ok(frames.frames().map(|(time, file)| (time, folder.join(file))).collect())
}
