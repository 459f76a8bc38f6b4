//! The verb: pictures or a movie of a run.

use std::ops::{ControlFlow, RangeInclusive};
use std::path::Path;

use super::error::RenderError;
use super::frame_sequence::FrameSequence;
use super::output::Output;
use super::renderer::{Options, Renderer};
use super::scene::Background;

/// Which frames are shown and how fast.
#[derive(Clone, Debug, PartialEq)]
pub struct Shots {
    /// The first and last frame, from 0; all if left out.
    pub frames: Option<RangeInclusive<usize>>,
    /// Every how many-th frame.
    pub every: usize,
    /// Frames in a second of a movie.
    pub rate: f64,
}

impl Default for Shots {
    fn default() -> Self {
        Self { frames: None, every: 1, rate: 25.0 }
    }
}

/// What is made: where, of which frames, how it looks.
#[derive(Clone, Debug)]
pub struct Animation {
    /// Where pictures go.
    pub output: Output,
    /// Which frames.
    pub shots: Shots,
    /// How they look.
    pub options: Options,
}

/// What an observer is told.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum AnimationProgress {
    /// Something will not be in the pictures, and why.
    Without(String),
    /// So many of all frames were looked through.
    Looking(usize, usize),
    /// So many of all pictures are done.
    Drawing(usize, usize),
}

/// How it ended without an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnimationEnding {
    /// So many pictures were drawn.
    Finished(usize),
    /// The observer asked to stop after so many; an unfinished movie is gone, finished pictures stay.
    Interrupted(usize),
}

/// Draws the run in `dir`. A single picture is that of the last frame that is asked for.
///
/// # Errors
/// [`RenderError`].
pub fn animate(
    dir: &Path,
    animation: Animation,
    observer: &mut dyn FnMut(AnimationProgress) -> ControlFlow<()>,
) -> Result<AnimationEnding, RenderError> {
    let Animation { output, shots, mut options } = animation;
    if output.is_movie() && options.background == Background::Transparent {
        return Err(RenderError::TransparentMovie);
    }
    let sequence = FrameSequence::open(dir)?;
    if let Some(note) = sequence.note()
        && observer(AnimationProgress::Without(note)).is_break()
    {
        return Ok(AnimationEnding::Interrupted(0));
    }
    let mut numbers = numbers(&sequence, &shots)?;
    options.size = output.fitting(options.size);
    let size = options.size;
    let look = &mut |done| observer(AnimationProgress::Looking(done, numbers.len())).is_continue();
    let Some(renderer) = Renderer::prepare(sequence, options, &numbers, look)? else {
        return Ok(AnimationEnding::Interrupted(0));
    };
    for note in renderer.notes() {
        if observer(AnimationProgress::Without(note)).is_break() {
            return Ok(AnimationEnding::Interrupted(0));
        }
    }
    if output.is_single() {
        numbers.drain(..numbers.len() - 1);
    }
    let mut sink = output.open(size, shots.rate)?;
    for (done, &number) in numbers.iter().enumerate() {
        if observer(AnimationProgress::Drawing(done, numbers.len())).is_break() {
            return Ok(AnimationEnding::Interrupted(done));
        }
        sink.take(&renderer.picture(number)?)?;
    }
    sink.finish()?;
    if let Some(note) = renderer.note_of_rays() {
        // Everything is drawn: there is nothing left to stop.
        let _ = observer(AnimationProgress::Without(note));
    }
    Ok(AnimationEnding::Finished(numbers.len()))
}

/// Numbers of the frames that are asked for; at least one.
fn numbers(sequence: &FrameSequence, shots: &Shots) -> Result<Vec<usize>, RenderError> {
    let (last, asked) = (sequence.len() - 1, shots.frames.clone().unwrap_or(0..=sequence.len() - 1));
    if asked.is_empty() || *asked.end() > last {
        let asked = if asked.start() == asked.end() {
            asked.start().to_string()
        } else {
            format!("{}..{}", asked.start(), asked.end())
        };
        return Err(RenderError::FrameRange { dir: sequence.dir().to_owned(), asked, count: sequence.len() });
    }
    Ok(asked.step_by(shots.every.max(1)).collect())
}
