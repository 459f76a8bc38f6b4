//! The frames of the replay, packed into one block of bytes.

mod block;
mod scene;
#[cfg(test)]
mod tests;
mod thinning;

use std::path::PathBuf;

use serde::Serialize;

use super::columns::{Column, SIZES, known};
use super::html::deflated;
use agglo::record::frames::Frame;
use agglo::text::readable;
use block::{Block, FramePlan};
use scene::Scene;
use thinning::{Choice, MOST_BYTES};

/// What the page needs to know of the block.
#[derive(Clone, Debug, Serialize)]
pub struct Plan {
    /// Times of the frames, to be read.
    pub times: Vec<String>,
    /// Where the arrays of each frame are.
    pub frames: Vec<FramePlan>,
    /// What grains can be colored by.
    pub columns: Vec<Column>,
    /// The first choice of those.
    pub color_by: String,
    /// Number of the frame that is shown first: where grains grow, the one that shows what came of it.
    pub first: usize,
    /// Power of the strongest ray [W].
    pub ray_power: f64,
    /// One of so many grains is shown: those whose names it divides.
    pub share: u64,
    /// Whether grains merge and break, so that a grain may be in some frames only.
    pub can_vanish: bool,
}

/// A packed replay.
#[derive(Clone, Debug)]
pub struct Replay {
    /// What the page needs to know of the block.
    pub plan: Plan,
    /// The block.
    pub bytes: Vec<u8>,
    /// The block as it stands in the page.
    pub packed: String,
    /// How many grains the last frame has.
    pub grains: usize,
    /// What was left out or could not be read.
    pub notes: Vec<String>,
}

/// Packs the frames; what was left out or could not be read is in the notes of a replay, or stands alone where no
/// frame can be read.
///
/// # Errors
/// The notes, where no frame can be read.
pub fn replay(files: &[PathBuf]) -> Result<Replay, Vec<String>> {
    within(files, MOST_BYTES)
}

/// The same with a bound on the bytes of the packed block.
fn within(files: &[PathBuf], most: usize) -> Result<Replay, Vec<String>> {
    let mut choice = Choice::of(files, most);
    loop {
        let replay = chosen(files, &choice)?;
        // The choice was an estimate from some of the frames.
        if replay.packed.len() <= most || !choice.thin_on(replay.packed.len(), most) {
            return Ok(replay);
        }
    }
}

fn chosen(files: &[PathBuf], choice: &Choice) -> Result<Replay, Vec<String>> {
    let mut notes = choice.notes(files.len());
    let mut scenes = Vec::new();
    let (mut grains, mut has_any) = (0, false);
    for at in choice.frames(files.len()) {
        match Scene::read(&files[at], &mut notes) {
            Ok(mut scene) => {
                grains = scene.grains.points.len();
                has_any |= grains > 0;
                // At once, so that large frames are not in memory together.
                scene.thin(choice.share);
                scenes.push(scene);
            }
            Err(error) => notes.push(format!("a frame is left out: {error}")),
        }
    }
    if !has_any {
        return Err(notes);
    }
    let Replay { plan, bytes, packed, notes, .. } = pack(&scenes, notes);
    Ok(Replay { plan: Plan { share: choice.share, ..plan }, bytes, packed, notes, grains })
}

fn pack(scenes: &[Scene], mut notes: Vec<String>) -> Replay {
    let grains: Vec<_> = scenes.iter().map(|scene| &scene.grains).collect();
    let columns = known(&grains);
    let mut block = Block::default();
    let frames = scenes.iter().map(|scene| block.frame(scene, &columns)).collect();
    let color_by = [if grow(&grains) { SIZES } else { "cluster" }, "cluster", "temperature", "speed"]
        .into_iter()
        .find(|wanted| columns.iter().any(|column| column.name == *wanted))
        .unwrap_or(SIZES);
    let rays: Vec<_> = scenes.iter().filter_map(|scene| scene.rays.as_ref()).collect();
    if !rays.is_empty() && rays.iter().all(|rays| rays.points.is_empty()) {
        notes.push(
            "no frame shows rays: they fly for less than the time between two frames; output.pulses.frames writes frames \
             while they do"
                .to_owned(),
        );
    }
    let powers = rays.iter().filter_map(|rays| block::numbers(rays, "power_W"));
    let plan = Plan {
        times: scenes.iter().map(|scene| readable(scene.grains.time, "s")).collect(),
        frames,
        color_by: color_by.to_owned(),
        first: if color_by == SIZES { scenes.len() - 1 } else { 0 },
        columns,
        ray_power: powers.flatten().fold(0.0, f64::max),
        share: 1,
        can_vanish: grains.iter().any(|grains| grains.field("primaries").is_some()),
    };
    let packed = deflated(&block.bytes);
    Replay { plan, bytes: block.bytes, packed, notes, grains: 0 }
}

/// Whether the largest grain of one frame is larger than that of another: grains merge or break.
fn grow(frames: &[&Frame]) -> bool {
    let largest =
        |frame: &&Frame| block::numbers(frame, "radius_m").map(|radii| radii.into_iter().fold(0.0, f64::max));
    let mut largest = frames.iter().filter_map(largest);
    largest.next().is_some_and(|first| largest.any(|other| other != first))
}
