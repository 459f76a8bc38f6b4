//! The frames of the replay, packed into one block of bytes.

mod block;
mod scene;
#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};

use serde::Serialize;

use super::columns::{Column, known};
use crate::scenario::readable;
use block::{Block, FramePlan};
use scene::Scene;

/// Bytes of the files of all frames together that are shown, at the most; the block holds less than a quarter of that.
const MOST_BYTES: u64 = 56_000_000;
/// Frames are left out until there are this many; then grains are.
const FRAMES_KEPT: u64 = 24;

/// What the page needs to know of the block.
#[derive(Clone, Debug, Serialize)]
pub struct Plan {
    /// Times of the frames, to be read.
    pub times: Vec<String>,
    /// Where the arrays of each frame are.
    pub frames: Vec<FramePlan>,
    /// What grains can be coloured by.
    pub columns: Vec<Column>,
    /// The first choice of those.
    pub color_by: String,
    /// Power of the strongest ray [W].
    pub ray_power: f64,
}

/// A packed replay.
#[derive(Clone, Debug)]
pub struct Replay {
    /// What the page needs to know of the block.
    pub plan: Plan,
    /// The block.
    pub bytes: Vec<u8>,
    /// What was left out or could not be read.
    pub notes: Vec<String>,
}

/// What of a run's frames is shown.
struct Choice {
    /// One of so many frames.
    frames: u64,
    /// One of so many grains.
    grains: u64,
}

/// Packs the frames; what was left out or could not be read is in the notes of a replay, or stands alone where no
/// frame can be read.
///
/// # Errors
/// The notes, where no frame can be read.
pub fn replay(files: &[PathBuf]) -> Result<Replay, Vec<String>> {
    let choice = Choice::of(files);
    let mut notes = choice.notes(files.len() as u64);
    let mut scenes = Vec::new();
    for path in files.iter().step_by(choice.frames as usize) {
        match Scene::read(path, choice.grains, &mut notes) {
            Ok(scene) => scenes.push(scene),
            Err(error) => notes.push(format!("a frame is left out: {error}")),
        }
    }
    if scenes.iter().all(|scene| scene.grains.points.is_empty()) {
        return Err(notes);
    }
    Ok(pack(&scenes, notes))
}

impl Choice {
    fn of(files: &[PathBuf]) -> Self {
        let size = |path: &Path| path.metadata().map_or(0, |data| data.len());
        let all = |path: &PathBuf| {
            size(path) + size(&scene::beside(path, "bonds")) + size(&scene::beside(path, "rays"))
        };
        let bytes: u64 = files.iter().map(all).sum();
        let wanted = bytes.div_ceil(MOST_BYTES).max(1);
        let frames = wanted.min((files.len() as u64 / FRAMES_KEPT).max(1));
        Self { frames, grains: wanted.div_ceil(frames) }
    }

    fn notes(&self, frames: u64) -> Vec<String> {
        let mut notes = Vec::new();
        if self.frames > 1 {
            let shown = frames.div_ceil(self.frames);
            notes.push(format!("the replay shows {shown} of {frames} frames, to keep the file small"));
        }
        if self.grains > 1 {
            let share = self.grains;
            notes.push(format!(
                "the replay shows one of {share} grains and rays, and no bonds, to keep the file small"
            ));
        }
        notes
    }
}

fn pack(scenes: &[Scene], mut notes: Vec<String>) -> Replay {
    let grains: Vec<_> = scenes.iter().map(|scene| &scene.grains).collect();
    let columns = known(&grains);
    let mut block = Block::default();
    let frames = scenes.iter().map(|scene| block.frame(scene, &columns)).collect();
    let color_by = ["cluster", "temperature", "speed"]
        .into_iter()
        .find(|wanted| columns.iter().any(|column| column.name == *wanted))
        .unwrap_or("radius");
    let rays: Vec<_> = scenes.iter().filter_map(|scene| scene.rays.as_ref()).collect();
    if !rays.is_empty() && rays.iter().all(|rays| rays.points.is_empty()) {
        notes.push(
            "no frame shows rays: they fly for less than the time between two frames; a shorter output.frames \
             shows them"
                .to_owned(),
        );
    }
    let powers = rays.iter().filter_map(|rays| block::numbers(rays, "power_w"));
    let plan = Plan {
        times: scenes.iter().map(|scene| readable(scene.grains.time, "s")).collect(),
        frames,
        color_by: color_by.to_owned(),
        columns,
        ray_power: powers.flatten().fold(0.0, f64::max),
    };
    Replay { plan, bytes: block.bytes, notes }
}
